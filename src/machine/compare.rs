//! Two machines that should be the same: where the tip is if a control believes the first and the second is true.
//!
//! A control solves the joints for a programmed tip with the machine it believes in; the true machine carries the tool to its own forward
//! kinematics of these joints. With a rotary axis 0.05 mm away from the believed position, a fixed tip under tool centre point control
//! moves by up to 0.1 mm: the sweep that calibrates pivots on real machines.
use crate::file::text::{number, triple};
use crate::kinematics::selftest::SplitMix;
use crate::{Axis, AxisKind, Joints, Leg, Limits, MAX_AXES, Machine, forward, inverse};
use core::f64::consts::PI;
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, deg};

mod proof;
#[cfg(test)]
mod tests;

pub use proof::{AlongBlock, Effort};

/// What the second machine does with joints that are right for the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipDifference {
    /// How far the tip is from its position on the first machine, mm.
    pub tip_mm: f64,
    /// How far the tool axis is turned, rad.
    pub axis: f64,
    /// The joints, in the order of the first machine, mm and rad.
    pub joints: Joints,
    /// Tip of the first machine, part frame, mm.
    pub tip: [f64; 3],
}

/// Two machines whose axes have the same letters.
pub struct Comparison<'m> {
    believed: &'m Machine,
    truth: &'m Machine,
    /// For each joint of the true machine, that of the believed machine.
    order: Vec<usize>,
}

impl<'m> Comparison<'m> {
    /// The letters that only one of the two has, where they differ.
    pub fn new(believed: &'m Machine, truth: &'m Machine) -> Result<Self, String> {
        let letters = |machine: &Machine| machine.axes.iter().map(|axis| axis.letter).collect::<Vec<u8>>();
        let (first, second) = (letters(believed), letters(truth));
        let order = second
            .iter()
            .map(|letter| first.iter().position(|other| other == letter));
        match order.collect::<Option<Vec<usize>>>() {
            Some(order) if first.len() == second.len() => Ok(Self { believed, truth, order }),
            _ => {
                let only =
                    |of: &[u8], not: &[u8]| of.iter().filter(|l| !not.contains(l)).map(|l| char::from(*l)).collect();
                let [a, b]: [String; 2] = [only(&first, &second), only(&second, &first)];
                let name = |text: String| if text.is_empty() { "no others".to_owned() } else { text };
                Err(format!(
                    "the machines have different axes: in addition to the common ones {} has {}, and {} has {}",
                    believed.id,
                    name(a),
                    truth.id,
                    name(b)
                ))
            }
        }
    }

    /// At joints of the believed machine. `tool_length` in mm.
    pub fn at(&self, joints: &Joints, tool_length: f64) -> TipDifference {
        let other = self.ordered(joints);
        let first = forward(self.believed, joints, tool_length);
        let second = forward(self.truth, &other, tool_length);
        TipDifference {
            tip_mm: (second.tip - first.tip).norm(),
            axis: angle_between(&first.axis, &second.axis),
            joints: *joints,
            tip: first.tip.into(),
        }
    }

    /// At the end of a block. `None` where it is unknown.
    pub fn at_end(&self, leg: &Leg) -> Option<TipDifference> {
        let end = leg.end.as_ref().ok()?;
        Some(self.at(&end.joints, end.tool_length))
    }

    /// The tip is held at `tip` (part frame, mm) while each rotary axis moves through its travel (an endless one: a turn), alone and
    /// together with the others, in `steps` steps; the linear axes follow as the believed machine solves them. `None` where they cannot.
    pub fn fixed_tip_sweep(&self, tip: &Vec3, tool_length: f64, steps: usize) -> Option<TipDifference> {
        let machine = self.believed;
        let span = |joint: usize| match machine.axes[joint].limits {
            Limits::Range(low, high) => (low.max(-PI), high.min(PI)),
            Limits::Unbounded => (-PI, PI),
        };
        let sweeps = machine
            .rotary
            .iter()
            .map(|joint| vec![*joint])
            .chain([machine.rotary.clone()]);
        let mut worst: Option<TipDifference> = None;
        for swept in sweeps {
            for step in 0..=steps {
                let share = step as f64 / steps.max(1) as f64;
                let mut joints = self.at_rest();
                for &joint in &swept {
                    let (low, high) = span(joint);
                    joints[joint] = low + (high - low) * share;
                }
                inverse(machine, &mut joints, tip, tool_length)?;
                let found = self.at(&joints, tool_length);
                worst = Some(worst.map_or(found, |known| worse(known, found)));
            }
        }
        worst
    }

    /// The worst at `poses` random positions within the travel (endless: a turn, or 300 mm in both directions), tool lengths 0 to 200 mm.
    pub fn random_poses(&self, poses: usize, seed: u64) -> Option<TipDifference> {
        let mut random = SplitMix(seed);
        let pose = |_| {
            let mut joints = self.at_rest();
            for (slot, axis) in joints.iter_mut().zip(&self.believed.axes) {
                let (low, high) = match (axis.limits, axis.kind) {
                    (Limits::Range(low, high), _) => (low, high),
                    (Limits::Unbounded, AxisKind::Rotary) => (-PI, PI),
                    (Limits::Unbounded, AxisKind::Linear) => (-300.0, 300.0),
                };
                if axis.extra.hold.is_none() {
                    *slot = random.between(low, high);
                }
            }
            let length = random.between(0.0, 200.0);
            self.at(&joints, length)
        };
        (0..poses).map(pose).reduce(worse)
    }

    /// All joints at zero, held axes at their values.
    fn at_rest(&self) -> Joints {
        let mut joints: Joints = [0.0; MAX_AXES];
        for (joint, value) in self.believed.held() {
            joints[joint] = value;
        }
        joints
    }

    /// Which entries differ, one sentence each: order, kind, side, direction, point, sign, travel, speed, tool axis and gauge point.
    pub fn entries(&self) -> Vec<String> {
        let mut out = Vec::new();
        let order = |machine: &Machine| {
            machine
                .axes
                .iter()
                .map(|axis| char::from(axis.letter))
                .collect::<String>()
        };
        let (first, second) = (order(self.believed), order(self.truth));
        if first != second {
            out.push(format!("order of the axes: {first} versus {second}"));
        }
        for (axis, from) in self.truth.axes.iter().zip(&self.order) {
            entries_of(&self.believed.axes[*from], axis, &mut out);
        }
        let (a, b) = (&self.believed.home, &self.truth.home);
        if a.tool_axis != b.tool_axis {
            out.push(format!(
                "tool_axis: {} versus {}",
                triple(&a.tool_axis),
                triple(&b.tool_axis)
            ));
        }
        if a.gauge_point != b.gauge_point {
            let (a, b) = (triple(&a.gauge_point), triple(&b.gauge_point));
            out.push(format!("gauge_point: {a} versus {b} mm"));
        }
        out
    }
}

/// Directions nearer than this are the same: rounding of sine and cosine.
const SAME_DIRECTION: f64 = 1e-12;

/// What differs between two axes of the same letter.
fn entries_of(a: &Axis, b: &Axis, out: &mut Vec<String>) {
    let letter = char::from(a.letter);
    let mut say = |differs: bool, text: String| {
        if differs {
            out.push(format!("axis {letter}: {text}"));
        }
    };
    say(a.kind != b.kind, format!("kind {:?} versus {:?}", a.kind, b.kind));
    say(a.side != b.side, format!("side {:?} versus {:?}", a.side, b.side));
    say(a.sign != b.sign, format!("sign {:+} versus {:+}", a.sign, b.sign));
    say(
        (a.direction - b.direction).norm() > SAME_DIRECTION,
        format!("dir {} versus {}", triple(&a.direction), triple(&b.direction)),
    );
    say(
        a.point != b.point && a.kind == AxisKind::Rotary,
        format!(
            "point {} versus {} mm, {} mm apart",
            triple(&a.point),
            triple(&b.point),
            number((a.point - b.point).norm())
        ),
    );
    let plain = |value: f64| if a.kind == AxisKind::Rotary { deg(value) } else { value };
    let travel = |axis: &Axis| match axis.limits {
        Limits::Unbounded => "endless or undeclared".to_owned(),
        Limits::Range(low, high) => format!("{} to {}", number(plain(low)), number(plain(high))),
    };
    say(
        a.limits != b.limits,
        format!("travel {} versus {}", travel(a), travel(b)),
    );
    let speed = |speed: Option<f64>| speed.map_or_else(|| "undeclared".to_owned(), |speed| number(plain(speed)));
    say(
        a.max_speed != b.max_speed,
        format!("speed {} versus {}", speed(a.max_speed), speed(b.max_speed)),
    );
    say(
        a.max_acceleration != b.max_acceleration,
        format!(
            "acceleration {} versus {}",
            speed(a.max_acceleration),
            speed(b.max_acceleration)
        ),
    );
    say(a.extra.hold != b.extra.hold, "held at a different value".to_owned());
}

/// The one with the larger difference of the tip.
fn worse(a: TipDifference, b: TipDifference) -> TipDifference {
    if b.tip_mm > a.tip_mm || a.tip_mm.is_nan() { b } else { a }
}
