//! What LinuxCNC makes of a corner: it passes it, rounds it with an arc, lets both legs overlap, or stops.
//!
//! Source: the behaviour of LinuxCNC 2.9's trajectory planner (src/emc/tp of LinuxCNC/linuxcnc), measured with tests/linuxcnc. Formulas:
//! docs/kinematics.md#time.
use crate::PathControl;
use crate::corner::{Passage, Round, Side};
use trunnion_geometry::math::{cos, sin, tan};
use trunnion_machine::{AxisKind, Joints, Machine};

/// Time between two points of the path where the machine file gives none, s.
const CYCLE: f64 = 0.001;
/// The share of the acceleration that a change of direction within one cycle may take.
const KINK: f64 = 0.1;
/// The share of the acceleration that points into an arc, and the one that is left along it.
const ACROSS: f64 = 0.866_025_403_784_438_6;
const ALONG: f64 = 0.5;
/// Without P an arc leaves the corner by no more than this share of the shorter leg.
const OPEN: f64 = 0.25;
/// Half angles between the legs below which no arc is laid, rad.
const SHARP: f64 = 1e-6;
/// The same beside an arc.
const BACK: f64 = core::f64::consts::PI / 12.0;

/// Time between two points of the path, s.
pub(crate) fn cycle(machine: &Machine) -> f64 {
    machine.control.planning.servo_sample.unwrap_or(CYCLE)
}

/// After the last leg before a stop that is no corner, LinuxCNC waits for a leg to blend with: it brakes with half of the acceleration.
pub(crate) fn end(machine: &Machine, control: PathControl) -> Passage {
    let blends = matches!(control, PathControl::ByMachine | PathControl::Blend(_));
    Passage {
        halved: blends && machine.control.corner_model.as_deref() == Some("linuxcnc-g64"),
        ..Passage::STOP
    }
}

/// Between two legs; `turn` is the change of direction, rad. `control` is none that stops everywhere.
pub(crate) fn passage(machine: &Machine, control: PathControl, sides: [&Side<'_>; 2], turn: f64) -> Passage {
    let turning = sides.iter().any(|side| side.turning);
    if sides[0].rapid != sides[1].rapid {
        return Passage::STOP;
    }
    let target = sides[0].cap.min(sides[1].cap);
    let exact = control == PathControl::ExactPath;
    // the jump of direction within one cycle, in units of each axis's acceleration
    let kink = if turning || !target.is_finite() {
        f64::INFINITY
    } else {
        let instant = target / cycle(machine) + sides[1].acceleration;
        let bent = if sides.iter().any(|side| side.bent) { ALONG } else { 1.0 };
        largest_share(machine, sides[0].tangent, sides[1].tangent) * instant / bent
    };
    if kink < KINK {
        return Passage {
            loss: kink,
            ..Passage::SMOOTH
        };
    }
    // what a corner costs although it is not passed: LinuxCNC reserves it on both legs
    let reserved = if turning { 0.0 } else { KINK };
    if exact {
        return Passage {
            loss: reserved,
            ..Passage::STOP
        };
    }
    let half = 0.5 * (core::f64::consts::PI - turn);
    let tolerance = match control {
        PathControl::Blend(Some(tolerance)) => Some(tolerance),
        _ => machine.control.planning.corner_tolerance,
    };
    let kinked = if turning { 0.0 } else { target * KINK / kink };
    let round = (!turning).then(|| arc(machine, sides, tolerance, half)).flatten();
    let rounded = round.map_or(0.0, |round| round.cap);
    let [overlap, net] = overlap(sides, tolerance, half, reserved);
    if 0.5 * net >= kinked.max(rounded) {
        return Passage {
            halved: true,
            overlap,
            corner: net,
            ..Passage::STOP
        };
    }
    if kinked >= rounded {
        return Passage {
            speed: [f64::INFINITY, kinked],
            loss: KINK,
            ..Passage::SMOOTH
        };
    }
    Passage {
        round,
        ..Passage::SMOOTH
    }
}

/// The largest share of its acceleration that an axis would need for a change of direction, per mm/s^2.
fn largest_share(machine: &Machine, before: &Joints, after: &Joints) -> f64 {
    let each = machine.axes.iter().zip(before.iter().zip(after));
    each.filter_map(|(axis, (a, b))| Some((b - a).abs() / axis.max_acceleration?))
        .fold(0.0, f64::max)
}

/// The least of a limit of the linear axes in the plane of both legs: that of a circle in it.
fn in_plane(machine: &Machine, sides: [&Side<'_>; 2], of: impl Fn(&trunnion_machine::Axis) -> Option<f64>) -> f64 {
    let unit = |v: Joints| {
        let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        (norm > 1e-12).then(|| v.map(|x| x / norm))
    };
    let (Some(a), Some(b)) = (unit(*sides[0].tangent), unit(*sides[1].tangent)) else {
        return f64::INFINITY;
    };
    let along = a.iter().zip(&b).map(|(x, y)| x * y).sum::<f64>();
    let mut across = b;
    for (across, a) in across.iter_mut().zip(&a) {
        *across -= along * a;
    }
    let across = unit(across).unwrap_or([0.0; _]);
    let each = machine.axes.iter().zip(a.iter().zip(&across));
    each.filter(|(axis, _)| axis.kind == AxisKind::Linear)
        .filter_map(|(axis, (x, y))| {
            let reach = (x * x + y * y).sqrt();
            (reach > 1e-9).then(|| of(axis).map(|limit| limit / reach))?
        })
        .fold(f64::INFINITY, f64::min)
}

/// An arc that leaves the corner by no more than the tolerance and takes at most half of each leg.
fn arc(machine: &Machine, sides: [&Side<'_>; 2], tolerance: Option<f64>, half: f64) -> Option<Round> {
    let turn = core::f64::consts::PI - 2.0 * half;
    let least = if sides.iter().any(|side| side.bent) {
        BACK
    } else {
        SHARP
    };
    if half < least || turn < SHARP {
        return None;
    }
    let shorter = sides[0].length.min(sides[1].length);
    let tolerance = tolerance.unwrap_or(OPEN * shorter);
    let depth = (0.5 * shorter).min(tolerance / (1.0 - sin(half)) * cos(half));
    let radius = depth * tan(half);
    let acceleration = in_plane(machine, sides, |axis| axis.max_acceleration);
    if !acceleration.is_finite() {
        return None;
    }
    // the arc runs at the higher one of both feeds
    let most = sides[0]
        .cap
        .max(sides[1].cap)
        .min(in_plane(machine, sides, |axis| axis.max_speed));
    let planned = (ACROSS * acceleration * radius).sqrt().min(most);
    // no larger than its speed needs, but as long as half of the acceleration would take for the corner
    let lazy = ALONG * acceleration;
    let blended = planned * (2.0 * lazy * depth).sqrt().min(planned) / lazy;
    let radius = (planned * planned / (ACROSS * acceleration)).max((blended / turn).min(radius));
    let length = radius * turn;
    Some(Round {
        depth: radius / tan(half),
        length,
        cap: planned.min(length / cycle(machine)),
        free: (acceleration * radius).sqrt().min(most),
        along: ALONG * acceleration,
        acceleration,
    })
}

/// Both legs at half of their acceleration, the second one starting while the first one brakes: for how long both run, s, and the speed in the middle.
fn overlap(sides: [&Side<'_>; 2], tolerance: Option<f64>, half: f64, reserved: f64) -> [f64; 2] {
    let run = |lost: f64| {
        let acceleration = sides.map(|side| side.acceleration * lost);
        let reach = [0, 1].map(|side| {
            let own: &Side<'_> = sides[side];
            (acceleration[side] * 0.5 * own.length).sqrt().min(own.cap)
        });
        let longest = (sides[0].length / reach[0]).min(sides[1].length / reach[1]);
        let time = longest.min((reach[0] / acceleration[0]).max(reach[1] / acceleration[1]));
        let mut speed = [0, 1].map(|side| reach[side].min(time * acceleration[side]));
        if let Some(tolerance) = tolerance
            && cos(half) > SHARP
        {
            let most = 2.0 * (acceleration[0] * tolerance / cos(half)).sqrt();
            speed = speed.map(|own| own.min(most));
        }
        (speed, acceleration)
    };
    let ([a, b], _) = run(1.0 - reserved);
    let net = sin(half) * 0.5 * (a + b);
    // as it runs
    let ([a, b], [slow, fast]) = run(0.5);
    let seconds = (a / slow).min(b / fast);
    if seconds.is_finite() {
        [seconds, net]
    } else {
        [0.0, 0.0]
    }
}
