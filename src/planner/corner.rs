//! How fast a corner between two motions may be passed.
use trunnion_geometry::deg;
use trunnion_geometry::math::{acos, sin};
use trunnion_machine::{AxisKind, Joints, Machine};
use trunnion_servo::{Corner, slowest_corner_speed};

/// What the program says about corners.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum PathControl {
    /// Nothing: as the machine file says.
    #[default]
    ByMachine,
    /// A stop at the end of every block (G61.1 of LinuxCNC, G60, G61 of a Fanuc).
    ExactStop,
    /// The exact path: a stop where its direction changes (G61 of LinuxCNC).
    ExactPath,
    /// Corners may be rounded within this distance, mm (G64 P); `None`: without a bound.
    Blend(Option<f64>),
}

/// One side of a corner.
pub(crate) struct Side<'a> {
    /// Joints per mm of path.
    pub(crate) tangent: &'a Joints,
    /// mm.
    pub(crate) length: f64,
    /// Highest speed away from the corner, mm/s.
    pub(crate) cap: f64,
    /// Acceleration along the path, mm/s^2.
    pub(crate) acceleration: f64,
    /// Rotary axes turn.
    pub(crate) turning: bool,
    /// It is an arc.
    pub(crate) bent: bool,
    /// It is a rapid.
    pub(crate) rapid: bool,
}

/// How a corner is passed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Passage {
    /// Highest speed at the corner, optimistic and planned, mm/s: infinite where it does not limit, 0 for a stop.
    pub(crate) speed: [f64; 2],
    /// The share of the acceleration of both legs that it takes.
    pub(crate) loss: f64,
    /// Both legs run at half of their acceleration.
    pub(crate) halved: bool,
    /// How long both legs run at once, s.
    pub(crate) overlap: f64,
    /// The speed in the middle of that, mm/s.
    pub(crate) corner: f64,
    /// An arc in place of the corner.
    pub(crate) round: Option<Round>,
}

/// An arc that takes the same part of both legs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Round {
    /// What it takes of each leg, and its own length, mm.
    pub(crate) depth: f64,
    pub(crate) length: f64,
    /// Highest speed on it, planned and optimistic, mm/s.
    pub(crate) cap: f64,
    pub(crate) free: f64,
    /// Acceleration along it, planned and optimistic, mm/s^2.
    pub(crate) along: f64,
    pub(crate) acceleration: f64,
}

impl Passage {
    pub(crate) const SMOOTH: Self = Self {
        speed: [f64::INFINITY; 2],
        loss: 0.0,
        halved: false,
        overlap: 0.0,
        corner: 0.0,
        round: None,
    };
    pub(crate) const STOP: Self = Self {
        speed: [0.0; 2],
        ..Self::SMOOTH
    };

    fn at(speed: [f64; 2]) -> Self {
        Self { speed, ..Self::SMOOTH }
    }
}

/// Changes of direction below this are none, rad.
const STRAIGHT: f64 = 1e-4;

/// How a corner is passed.
pub(crate) fn passage(machine: &Machine, control: PathControl, sides: [&Side<'_>; 2]) -> Passage {
    let model = machine.control.corner_model.as_deref();
    if control == PathControl::ExactStop || model == Some("exact-stop") {
        return Passage::STOP;
    }
    if model == Some("linuxcnc-g64") {
        return crate::linuxcnc::passage(machine, control, sides, angle(sides[0].tangent, sides[1].tangent));
    }
    let turn = turn(machine, sides[0].tangent, sides[1].tangent);
    if turn < STRAIGHT && smooth(sides[0].tangent, sides[1].tangent) {
        return Passage::SMOOTH;
    }
    if control == PathControl::ExactPath {
        return Passage::STOP;
    }
    let planning = &machine.control.planning;
    let acceleration = sides[0].acceleration.min(sides[1].acceleration);
    let half = 0.5 * (core::f64::consts::PI - turn);
    let junction = |deviation: f64| (acceleration * deviation * sin(half) / (1.0 - sin(half))).sqrt();
    let speed = match model {
        Some("axis-jump") => axis_jump(machine, sides[0].tangent, sides[1].tangent),
        Some("grbl") => planning.corner_deviation.map(junction),
        Some("klipper") => planning
            .corner_speed
            .map(|speed| junction(speed * speed * (core::f64::consts::SQRT_2 - 1.0) / acceleration)),
        Some("servo") => servo(machine, sides, planning.corner_tolerance),
        _ => None,
    };
    Passage::at(match speed {
        Some(speed) if !speed.is_nan() => [speed; 2],
        // nobody says: anything from full speed to a stop
        _ => [f64::INFINITY, 0.0],
    })
}

/// Angle between two directions of the joints, rad.
fn angle(before: &Joints, after: &Joints) -> f64 {
    let product = |a: &Joints, b: &Joints| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let norms = (product(before, before) * product(after, after)).sqrt();
    if norms == 0.0 {
        return 0.0;
    }
    acos((product(before, after) / norms).clamp(-1.0, 1.0))
}

/// Angle between two directions of the joints in mm and degrees, rad: these controls know rotary axes as lengths, and a degree is a millimetre to them.
fn turn(machine: &Machine, before: &Joints, after: &Joints) -> f64 {
    let (mut dot, mut a, mut b) = (0.0, 0.0, 0.0);
    for (axis, (u, v)) in machine.axes.iter().zip(before.iter().zip(after)) {
        let weight = match axis.kind {
            AxisKind::Linear => 1.0,
            AxisKind::Rotary => deg(1.0),
        };
        let (u, v) = (u * weight, v * weight);
        dot += u * v;
        a += u * u;
        b += v * v;
    }
    if a == 0.0 || b == 0.0 {
        0.0
    } else {
        acos((dot / (a * b).sqrt()).clamp(-1.0, 1.0))
    }
}

/// The rates of the joints per mm go on, not only their direction.
fn smooth(before: &Joints, after: &Joints) -> bool {
    before
        .iter()
        .zip(after)
        .all(|(a, b)| (a - b).abs() <= 1e-3 * a.abs().max(b.abs()).max(1e-6))
}

/// Each axis changes its speed by no more than declared; `None` where one that does declares nothing.
fn axis_jump(machine: &Machine, before: &Joints, after: &Joints) -> Option<f64> {
    let mut speed = f64::INFINITY;
    let jumps = machine
        .control
        .planning
        .corner_jump
        .iter()
        .zip(before.iter().zip(after));
    for (jump, (a, b)) in jumps {
        let change = (b - a).abs();
        if change > 1e-9 {
            speed = speed.min((*jump)? / change);
        }
    }
    Some(speed)
}

/// The speed at which the servo loops leave the corner by no more than the tolerance; in the space of the first three linear axes.
fn servo(machine: &Machine, sides: [&Side<'_>; 2], tolerance: Option<f64>) -> Option<f64> {
    let joints: [usize; 3] = machine.linear.get(..3)?.try_into().ok()?;
    let of = |tangent: &Joints| trunnion_geometry::Vec3::from(joints.map(|joint| tangent[joint]));
    let corner = Corner::new(&of(sides[0].tangent), &of(sides[1].tangent))?;
    let axis = &machine.axes[joints[0]].extra;
    Some(slowest_corner_speed(
        &corner,
        axis.position_gain?,
        axis.feed_forward.unwrap_or(0.0),
        tolerance?,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MACHINE: &str = r#"schema = "ncmachine/1"
axis = [{letter="X", sign=1, dyn={vmax=100, amax=@}}, {letter="Y", sign=1, dyn={vmax=100, amax=@}}, {letter="Z", sign=1, dyn={vmax=100, amax=@}}]
[control]
corner = { CORNER }
"#;

    fn at(corner: &str, amax: f64, control: PathControl) -> [f64; 2] {
        let text = MACHINE.replace('@', &amax.to_string()).replace("CORNER", corner);
        let machine = trunnion_machine::load("m", &text).expect("valid");
        let (mut x, mut y) = ([0.0; _], [0.0; _]);
        (x[0], y[1]) = (1.0, 1.0);
        let sides = [&x, &y].map(|tangent| Side {
            tangent,
            length: 10.0,
            cap: 100.0,
            acceleration: amax,
            turning: false,
            bent: false,
            rapid: false,
        });
        let passage = passage(&machine, control, [&sides[0], &sides[1]]);
        passage.round.map_or(passage.speed, |round| [round.cap; 2])
    }

    /// Known values at 90 deg (docs/kinematics.md#time).
    #[test]
    fn known_speeds() {
        let near = |found: [f64; 2], wanted: f64| {
            assert!(
                (found[1] - wanted).abs() < 1e-3 * wanted && found[0] == found[1],
                "{found:?}"
            );
        };
        near(
            at("model = \"grbl\", deviation = 0.01", 500.0, PathControl::ByMachine),
            3.4743,
        );
        for amax in [100.0, 3000.0] {
            near(at("model = \"klipper\", speed = 5", amax, PathControl::ByMachine), 5.0);
        }
        near(
            at("model = \"linuxcnc-g64\"", 300.0, PathControl::Blend(Some(0.01))),
            2.5045,
        );
        near(
            at(
                "model = \"axis-jump\", dv = { X = 2, Y = 3 }",
                300.0,
                PathControl::ByMachine,
            ),
            2.0,
        );
        assert_eq!(at("model = \"exact-stop\"", 300.0, PathControl::ByMachine), [0.0; 2]);
        assert_eq!(at("model = \"linuxcnc-g64\"", 300.0, PathControl::ExactPath), [0.0; 2]);
        assert_eq!(at("", 300.0, PathControl::ByMachine), [f64::INFINITY, 0.0]);
        assert_eq!(
            at("model = \"axis-jump\", dv = { X = 2 }", 300.0, PathControl::ByMachine),
            [f64::INFINITY, 0.0]
        );
    }
}
