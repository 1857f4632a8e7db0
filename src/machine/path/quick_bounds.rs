//! Upper bounds for a block in which all joints move linearly, from its joints alone: enough to decide most blocks.
use crate::follow::follower::leads_path;
use crate::path::limits::LIMIT_SLACK;
use crate::{AxisKind, Leg, Limits, MAX_AXES, Machine, RotaryRadii};
use trunnion_interp::MotionKind;

/// Room for rounding in a bound, relative.
const ROUNDED_UP: f64 = 1.0 + 1e-9;

/// What the axes of a machine allow, axis by axis, so that a loop over them need not test what is declared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowances {
    axes: [Allowance; MAX_AXES],
    count: usize,
}

/// What one axis allows.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Allowance {
    /// Travel, mm or rad, with the room for rounding; infinite without one.
    low: f64,
    high: f64,
    /// Seconds per mm or rad at the highest speed; infinite where none is declared.
    per_speed: f64,
    /// One for linear axes, zero for rotary ones.
    linear: f64,
}

impl Allowances {
    /// Of a machine.
    pub fn of(machine: &Machine) -> Self {
        let free = Allowance {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
            per_speed: f64::INFINITY,
            linear: 0.0,
        };
        let mut allowances = Self {
            axes: [free; MAX_AXES],
            count: machine.axes.len().min(MAX_AXES),
        };
        for (own, axis) in allowances.axes.iter_mut().zip(&machine.axes) {
            if let Limits::Range(low, high) = axis.limits {
                (own.low, own.high) = (low - LIMIT_SLACK, high + LIMIT_SLACK);
            }
            if let Some(speed) = axis.max_speed {
                own.per_speed = 1.0 / speed;
            }
            if axis.kind == AxisKind::Linear {
                own.linear = 1.0;
            }
        }
        allowances
    }
}

/// Upper bounds for a leg whose joints all move linearly from one known stance to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuickBounds {
    /// All joints stay inside their travel ([`crate::limit_excess`] finds nothing).
    pub inside: bool,
    /// Seconds that the slowest axis needs for its travel; infinite where an axis that moves declares no speed.
    pub axes_s: f64,
    /// Length of the path of the linear axes, mm ([`crate::linear_travel`]).
    pub linear_mm: f64,
    /// Distance of the tip from end to end, mm ([`crate::Stance::tip_distance_to`]): no bound.
    pub tip_mm: f64,
    /// How far the tip leaves its segment, mm ([`crate::tip_deviation`]); roughly where that is within the machine's tolerance.
    pub stray_mm: f64,
}

/// Bounds for a line along which all joints move linearly; `None` for all other legs. `allowances` are those of the machine, `near` is kept
/// from leg to leg. Source: kinematics notes 3, as in the functions that [`QuickBounds`] names.
#[inline]
pub fn quick_bounds(
    machine: &Machine,
    allowances: &Allowances,
    near: &mut RotaryRadii,
    leg: &Leg,
) -> Option<QuickBounds> {
    let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
        return None;
    };
    if !matches!(leg.motion.kind, MotionKind::Linear) || leg.start_given || leads_path(&leg.motion) {
        return None;
    }
    let (mut inside, mut axes_s, mut way2) = (true, 0.0_f64, 0.0);
    let joints = end.joints.iter().zip(&start.joints);
    for (own, (&value, before)) in allowances.axes[..allowances.count.min(MAX_AXES)].iter().zip(joints) {
        let way = (value - before).abs();
        if !(value >= own.low && value <= own.high) {
            inside = false;
        }
        // an axis that does not move needs no speed: then the product is not a number, which is not larger
        let seconds = way * own.per_speed;
        if seconds > axes_s {
            axes_s = seconds;
        }
        // where a value is not finite the sum is none either, also that of a rotary axis
        way2 += own.linear * way * way;
    }
    if !way2.is_finite() {
        return None;
    }
    let linear_mm = way2.sqrt() * ROUNDED_UP;
    let tip_mm = start.tip_distance_to(end);
    let [first, second] = leg.rotary_change;
    let stray_mm = if first == 0.0 && second == 0.0 {
        0.0
    } else {
        let went = (leg.rotary_change, tip_mm, linear_mm);
        near.stray(machine, [start, end], went, machine.tolerances.tip_mm)
    };
    Some(QuickBounds {
        inside,
        axes_s: axes_s * ROUNDED_UP,
        linear_mm,
        tip_mm,
        stray_mm,
    })
}

#[cfg(test)]
mod tests {
    use super::{Allowances, RotaryRadii, quick_bounds};
    use crate::follow::joint_line::tests::motion;
    use crate::{BUILTIN_MACHINES, Follower, builtin, limit_excess, linear_travel, tip_deviation};
    use proptest::prelude::*;
    use trunnion_interp::{AXIS_LETTERS, MotionKind, Position};

    proptest! {
        /// What the bounds rule out, the full functions rule out too, and no bound is below what they find.
        #[test]
        fn a_look_promises_no_more_than_the_full_functions(
            machine in 0..BUILTIN_MACHINES.len(),
            from in proptest::array::uniform9(-400.0..400.0),
            by in proptest::array::uniform9(-30.0..30.0),
            share in prop_oneof![Just(1.0), 0.0..0.1],
            still in 0..512_u16,
        ) {
            let machine = builtin(BUILTIN_MACHINES[machine]).expect("built in");
            let (mut start, mut end) = (Position::default(), Position::default());
            let own = |axis: &usize| machine.own_axes().any(|(_, own)| own.letter == AXIS_LETTERS[*axis]);
            if let Some(absent) = machine.absent_axis() {
                start.set(usize::from(absent), 0.0);
                end.set(usize::from(absent), 0.0);
            }
            for axis in (0..9).filter(own) {
                start.set(axis, from[axis]);
                let way = if still & (1 << axis) == 0 { by[axis] * share } else { 0.0 };
                end.set(axis, from[axis] + way);
            }
            let mut follower = Follower::new(machine);
            follower.follow(&motion(Position::default(), start, MotionKind::Rapid, 0.0));
            let leg = follower.follow(&motion(start, end, MotionKind::Linear, 0.0));
            let Some(seen) = quick_bounds(machine, &Allowances::of(machine), &mut RotaryRadii::default(), &leg) else {
                // held axes get another position
                prop_assert!(leg.end.is_err(), "{:?}", leg.motion);
                return Ok(());
            };
            let mut found = Vec::new();
            prop_assert!(limit_excess(machine, &leg, &mut found));
            prop_assert_eq!(seen.inside, found.is_empty());
            let (from, to) = (leg.start.expect("followed"), leg.end.clone().expect("followed"));
            for (joint, axis) in machine.axes.iter().enumerate() {
                let way = (to.joints[joint] - from.joints[joint]).abs();
                match axis.max_speed {
                    Some(speed) => prop_assert!(seen.axes_s >= way / speed),
                    None => prop_assert!(way == 0.0 || seen.axes_s == f64::INFINITY),
                }
            }
            let travel = linear_travel(machine, &leg, 0.0).expect("a line");
            prop_assert!(seen.linear_mm >= travel.most_mm && seen.linear_mm <= travel.most_mm * (1.0 + 1e-6));
            let stray = tip_deviation(machine, &leg, f64::INFINITY).expect("a line");
            prop_assert!(seen.stray_mm >= stray.bound_mm);
            let stray = tip_deviation(machine, &leg, 0.0).expect("a line");
            prop_assert!(seen.stray_mm >= stray.sampled_mm);
        }
    }
}
