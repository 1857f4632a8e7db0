//! How far the tip leaves its segment at most, from a bound of a block before: its distance from an axis grows by no more than it moves.
use crate::Stance;
use crate::path::tip_path::{ROUNDING, straight_stray};
use crate::{Constants, Machine};
use trunnion_geometry::Vec3;

/// Room for rounding in a bound, relative.
const ROUNDED_UP: f64 = 1.0 + 1e-9;
/// The same in one sum of many.
const ROUNDED_SUM: f64 = 1.0 + 1e-15;

/// How far the tool is from both rotary axes at most, on a table that carries both: kept from line to line.
#[derive(Clone, Copy, Debug, Default)]
pub struct RotaryRadii(Option<Radii>);

#[derive(Clone, Copy, Debug)]
struct Radii {
    /// The position of the machine: the tool in the workpiece, the linear joints and the length of the tool.
    point: Vec3,
    linear: [f64; 3],
    tool_length: f64,
    /// Distance of the tool from the first axis, in the workpiece, and from the second, before that turns it, mm.
    radius: [f64; 2],
    /// What rounding may cost, mm.
    rounding: f64,
}

/// Whether the chain is two rotary axes followed by linear axes at right angles.
#[inline]
fn is_table(constants: &Constants) -> bool {
    let at_right_angles = constants.linear_count == 3 && constants.cartesian.is_some();
    constants.rotary_count == 2 && constants.only_segment == Some(2) && at_right_angles
}

#[inline]
fn linear(constants: &Constants, stance: &Stance) -> [f64; 3] {
    let joint = |axis: usize| stance.joints[constants.linear[axis].joint];
    [joint(0), joint(1), joint(2)]
}

impl Radii {
    /// Computed in full at the position of the machine.
    fn of(machine: &Machine, stance: &Stance) -> Option<Self> {
        let constants = &machine.constants;
        if !is_table(constants) {
            return None;
        }
        let mut arm = machine.gauge_point - machine.tool_axis * stance.tool_length;
        for axis in constants.linear() {
            arm += axis.motion * stance.joints[axis.joint];
        }
        let [first, second] = &constants.rotary;
        let radius = [(first, &stance.point), (second, &arm)].map(|(axis, point)| {
            let off = axis.direction.cross(&(point - axis.point)).norm();
            off * ROUNDED_UP + ROUNDING * (point.abs().sum() + axis.point.abs().sum())
        });
        let size = arm.abs().sum() + stance.point.abs().sum() + first.point.abs().sum() + second.point.abs().sum();
        Some(Self {
            point: stance.point,
            linear: linear(constants, stance),
            tool_length: stance.tool_length,
            radius,
            rounding: size * ROUNDING,
        })
    }

    /// Whether a block with this tool begins here.
    #[inline]
    fn begins(&self, constants: &Constants, start: &Stance, tool_length: f64) -> bool {
        let same_length = start.tool_length == self.tool_length && tool_length == self.tool_length;
        let (a, b) = (linear(constants, start), &self.linear);
        same_length && start.point == self.point && a[0] == b[0] && a[1] == b[1] && a[2] == b[2]
    }

    /// Goes along a block that begins here, whose tip goes `tip` mm and whose linear joints go `way` mm.
    #[inline]
    fn go(&mut self, constants: &Constants, end: &Stance, tip: f64, way: f64) {
        let chord = tip * ROUNDED_UP;
        let [first, second] = self.radius;
        self.point = end.point;
        self.linear = linear(constants, end);
        self.radius = [(first + chord) * ROUNDED_SUM, (second + way) * ROUNDED_SUM];
        // a sum of coordinates grows by less than twice a distance in space, and both distances count twice in the size of a run
        self.rounding = (self.rounding + 4.0 * ROUNDING * (way + chord)) * ROUNDED_SUM;
    }
}

impl RotaryRadii {
    /// A bound of the distance between the tip's path and its chord while all joints run straight from one stance to the other, mm.
    /// It may be loose where it proves `enough`. `turned`: by how much both rotary joints turn, rad; `tip`: how far the tip goes, mm; `way`: how
    /// far the linear joints go at most, mm. Source: docs/kinematics.md#between-the-ends-of-a-block; the distances from the axes are those at an earlier block and the travel of the tool since.
    #[inline]
    pub(crate) fn stray(
        &mut self,
        machine: &Machine,
        ends: [&Stance; 2],
        (turned, tip, way): ([f64; 2], f64, f64),
        enough: f64,
    ) -> f64 {
        let constants = &machine.constants;
        if let Some(near) = &mut self.0
            && near.begins(constants, ends[0], ends[1].tool_length)
        {
            // where it is of no use, the next one is computed in full
            near.go(constants, ends[1], tip, way);
            // as in the bound in full: axis by axis from the tool to the workpiece
            let [first, second] = turned;
            let mut bend = 2.0 * second * way + second * second * near.radius[1];
            let rate = way + second * near.radius[1];
            bend += 2.0 * first * rate + first * first * (near.radius[0] + bend * 0.125);
            let stray = bend * 0.125 * ROUNDED_UP + near.rounding;
            if stray <= enough {
                return stray;
            }
        }
        self.0 = Radii::of(machine, ends[1]);
        straight_stray(machine, ends[0], ends[1])
    }
}

#[cfg(test)]
mod tests {
    use super::RotaryRadii;
    use crate::follow::joint_line::tests::motion;
    use crate::path::tip_path::straight_stray;
    use crate::{BUILTIN_MACHINES, Follower, builtin};
    use proptest::prelude::*;
    use trunnion_interp::{AXIS_LETTERS, MotionKind, Position};

    proptest! {
        /// On every machine, along many lines: never below the bound in full, which it is where that is asked for.
        #[test]
        fn it_is_never_below_the_bound_in_full(
            machine in 0..BUILTIN_MACHINES.len(),
            from in proptest::array::uniform9(-300.0..300.0),
            steps in proptest::collection::vec((proptest::array::uniform9(-20.0..20.0), 0..512_u16, any::<bool>()), 1..12),
            share in prop_oneof![Just(1.0), 0.0..0.05],
            offset in prop_oneof![Just(0.0), -50.0..50.0],
        ) {
            let machine = builtin(BUILTIN_MACHINES[machine]).expect("built in");
            let own = |axis: &usize| machine.axes.iter().any(|own| own.letter == AXIS_LETTERS[*axis]);
            let mut at = Position::default();
            (0..9).filter(own).for_each(|axis| at.set(axis, from[axis]));
            let mut follower = Follower::new(machine);
            follower.follow(&motion(Position::default(), at, MotionKind::Rapid, offset));
            let (mut loose, mut tight) = (RotaryRadii::default(), RotaryRadii::default());
            for (index, (by, still, shown)) in steps.into_iter().enumerate() {
                let mut to = at;
                for axis in (0..9).filter(own).filter(|axis| still & (1 << axis) == 0) {
                    to.set(axis, at.values[axis] + by[axis] * share);
                }
                let leg = follower.follow(&motion(at, to, MotionKind::Linear, offset));
                at = to;
                let (Some(start), Ok(end)) = (&leg.start, &leg.end) else { continue };
                // also where it was not shown all of them
                if index > 0 && !shown {
                    continue;
                }
                let way2: f64 = machine.constants.linear().iter().map(|axis| (end.joints[axis.joint] - start.joints[axis.joint]).powi(2)).sum();
                let went = (leg.rotary_change, start.tip_distance_to(end), way2.sqrt() * (1.0 + 1e-9));
                let full = straight_stray(machine, start, end);
                let found = loose.stray(machine, [start, end], went, f64::INFINITY);
                prop_assert!(found >= full, "{found} {full}");
                prop_assert_eq!(tight.stray(machine, [start, end], went, -1.0), full);
            }
        }
    }

    /// Along a pass on a table that turns and swivels nearly all blocks are settled without the bound in full.
    #[test]
    fn most_blocks_of_a_pass_are_settled_so() {
        let machine = builtin("mikron-ucp710").expect("built in");
        let place = |step: f64| {
            let mut at = Position::default();
            let axes = [
                (0, 40.0 + step * 0.05),
                (1, 10.0),
                (2, 30.0),
                (3, 20.0 + step * 0.01),
                (5, step * 0.02),
            ];
            for (axis, value) in axes {
                at.set(axis, value);
            }
            at
        };
        let mut follower = Follower::new(machine);
        follower.follow(&motion(Position::default(), place(0.0), MotionKind::Rapid, 0.0));
        let (mut near, mut full, mut most) = (RotaryRadii::default(), 0, 0.0_f64);
        for step in 0..1000 {
            let step = f64::from(step);
            let leg = follower.follow(&motion(place(step), place(step + 1.0), MotionKind::Linear, 0.0));
            let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
                panic!("followed")
            };
            let exact = straight_stray(machine, start, end);
            let found = near.stray(
                machine,
                [start, end],
                (leg.rotary_change, start.tip_distance_to(end), 0.05 * (1.0 + 1e-9)),
                1e-3,
            );
            full += usize::from(found == exact);
            most = most.max(found / exact);
        }
        assert!(full < 5 && most > 1.0 && most < 3.0, "{full} {most}");
    }
}
