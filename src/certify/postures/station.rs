//! Stations: positions of the rotary axes that consecutive motions share.
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, asin};
use trunnion_interp::{MotionKind, Orientation, Swivel};
use trunnion_machine::{
    Joints, LIMIT_SLACK, Leg, Limits, Machine, Orientations, Stance, forward, inverse, orientations,
};

/// Bits of X, Y and Z among the axis letters.
const XYZ: u16 = 0b111;

/// What may be chosen at a station.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Freedom {
    /// Nothing: what follows depends on the position as it is written.
    AsWritten,
    /// Whole turns of the rotary axes: another posture would change what the words of the linear axes mean.
    Windings,
    /// Posture and whole turns.
    Any,
}

/// A position of the rotary axes that consecutive motions share.
#[derive(Clone, Debug)]
pub struct Station {
    /// Index of the motion that reaches it.
    pub first: usize,
    /// Index of the last motion that keeps it.
    pub last: usize,
    /// Unit tool axis, workpiece frame.
    pub axis: Vec3,
    /// Rotary joints as written, workpiece side first, rad.
    pub written: [f64; 2],
    /// Sign of the posture as written; 0 at the pole.
    pub sign: i8,
    /// What may be chosen.
    pub freedom: Freedom,
    /// It is reached from a known position.
    pub from_known: bool,
    /// It is reached in a cut (a feed motion).
    pub cut: bool,
    /// The pole lies inside the motion that reaches it: between the tool axes at its ends there is one inside the pole cone.
    pub over_pole: bool,
    /// The motion that reaches it runs linearly in the joints, without tool centre point control.
    pub in_joints: bool,
    /// The other posture (rad, in -pi..=pi) and its sign, where there is one that keeps the linear axes inside their travel.
    pub(super) other: Option<([f64; 2], i8)>,
    /// The first rotary axis is free: the tool axis is parallel to it.
    pub(super) at_pole: bool,
    /// Tip at its first and its last motion with the work offset (workpiece frame), mm, and tool length there, mm.
    pub(super) tips: [(Vec3, f64); 2],
    /// All joints at its first and its last motion as written.
    pub(super) joints: [Joints; 2],
}

/// Builds the stations of a program, leg by leg.
pub struct Stations<'m> {
    machine: &'m Machine,
    all: Vec<Station>,
    motions: usize,
    broken: bool,
}

impl<'m> Stations<'m> {
    /// None yet.
    pub fn new(machine: &'m Machine) -> Self {
        Self {
            machine,
            all: Vec::new(),
            motions: 0,
            broken: true,
        }
    }

    /// The stations so far.
    pub fn all(&self) -> &[Station] {
        &self.all
    }

    /// Takes the next motion. A motion whose end is unknown holds the stations on both sides of it as they are written.
    pub fn add(&mut self, leg: &Leg) {
        let index = self.motions;
        self.motions += 1;
        let Ok(end) = &leg.end else {
            if let Some(last) = self.all.last_mut() {
                last.freedom = Freedom::AsWritten;
            }
            self.broken = true;
            return;
        };
        let written = rotary(self.machine, &end.joints);
        let turns = self.broken || self.all.last().is_none_or(|last| last.written != written);
        let freedom = freedom(leg, turns);
        if let (true, Freedom::AsWritten, Some(last)) = (turns, freedom, self.all.last_mut()) {
            last.freedom = Freedom::AsWritten;
        }
        if turns {
            self.begin(index, leg, end, written);
        }
        let Some(station) = self.all.last_mut() else { return };
        station.freedom = station.freedom.min(freedom);
        let point = forward(self.machine, &end.joints, end.tool_length).tip;
        station.last = index;
        station.tips[1] = (point, end.tool_length);
        station.joints[1] = end.joints;
        if turns {
            station.tips[0] = station.tips[1];
            station.joints[0] = end.joints;
        }
        let known = leg.motion.undeclared.zero & XYZ == 0 && !leg.motion.undeclared.length;
        if known
            && station
                .other
                .is_some_and(|(q, _)| !inside_travel(self.machine, &end.joints, q, &station.tips[1]))
        {
            station.other = None;
        }
        self.broken = false;
    }

    fn begin(&mut self, index: usize, leg: &Leg, end: &Stance, written: [f64; 2]) {
        let start = leg.start.as_ref().filter(|_| !self.broken);
        let (other, at_pole) = match orientations(self.machine, &end.axis) {
            Orientations::Postures(postures) => {
                let other = postures.iter().find(|one| one.branch * end.branch < 0);
                (other.map(|one| (one.q, one.branch)), false)
            }
            Orientations::Pole(_) => (None, true),
            Orientations::Unreachable(_) => (None, false),
        };
        let over_pole = start
            .is_some_and(|start| passes_pole(self.machine, &start.axis, &end.axis) < self.machine.tolerances.pole_cone);
        if let (true, Some(station)) = (self.broken, self.all.last_mut()) {
            station.freedom = Freedom::AsWritten;
        }
        self.all.push(Station {
            first: index,
            last: index,
            axis: end.axis,
            written,
            sign: end.branch,
            // after a position that is unknown the program is kept as it is written
            freedom: if self.broken && !self.all.is_empty() {
                Freedom::AsWritten
            } else {
                Freedom::Any
            },
            from_known: start.is_some(),
            cut: leg.motion.is_feed(),
            over_pole,
            in_joints: !(leg.motion.tcp || matches!(leg.motion.orientation, Orientation::Vector(..))),
            other,
            at_pole,
            tips: [(Vec3::zeros(), 0.0); 2],
            joints: [end.joints; 2],
        });
    }
}

/// Rotary joints, workpiece side first; 0 for missing ones.
fn rotary(machine: &Machine, joints: &Joints) -> [f64; 2] {
    let mut out = [0.0; 2];
    for (slot, &joint) in out.iter_mut().zip(&machine.rotary) {
        *slot = joints[joint];
    }
    out
}

/// What a motion leaves free. `turns`: it moves a rotary axis.
fn freedom(leg: &Leg, turns: bool) -> Freedom {
    let motion = &leg.motion;
    let vector = matches!(motion.orientation, Orientation::Vector(..));
    let tilted = motion.tilt.normal.is_some() || motion.tilt.swivel != Swivel::No || motion.tilt.free != 0;
    if vector || tilted || leg.open.is_some() || leg.start_given || motion.undeclared.set_here {
        return Freedom::AsWritten;
    }
    let straight = matches!(
        motion.kind,
        MotionKind::Rapid | MotionKind::Linear | MotionKind::Dwell(_)
    );
    if turns && (!straight || motion.machine_coordinates) {
        return Freedom::AsWritten;
    }
    let rests = matches!(motion.kind, MotionKind::Dwell(_));
    if motion.machine_coordinates || !motion.tcp && !rests && !straight {
        return Freedom::Windings;
    }
    Freedom::Any
}

/// Whether all linear joints stay inside their travel when the rotary joints are `q` and the tip stays.
fn inside_travel(machine: &Machine, joints: &Joints, q: [f64; 2], &(tip, length): &(Vec3, f64)) -> bool {
    let Some(joints) = posed(machine, joints, q, &tip, length) else {
        return false;
    };
    machine
        .axes
        .iter()
        .zip(joints)
        .enumerate()
        .all(|(joint, (axis, value))| match axis.limits {
            Limits::Range(low, high) if !machine.rotary.contains(&joint) => {
                value >= low - LIMIT_SLACK && value <= high + LIMIT_SLACK
            }
            _ => true,
        })
}

/// All joints for rotary joints `q` with the tip at `tip` (with the work offset); `None` where the linear axes cannot bring it there.
pub(super) fn posed(machine: &Machine, joints: &Joints, q: [f64; 2], tip: &Vec3, length: f64) -> Option<Joints> {
    let mut joints = *joints;
    for (&joint, value) in machine.rotary.iter().zip(q) {
        joints[joint] = value;
    }
    inverse(machine, &mut joints, tip, length)?;
    Some(joints)
}

/// Smallest angle between the first rotary axis (either end) and a tool axis on the great circle from `a` to `b`, rad; pi/2 for machines
/// without two rotary axes. The angle to a great circle with normal n is asin |n . e|, taken at e's projection where that lies between a and b.
fn passes_pole(machine: &Machine, a: &Vec3, b: &Vec3) -> f64 {
    let [first, _] = *machine.rotary.as_slice() else {
        return FRAC_PI_2;
    };
    let e = machine.axes[first].direction;
    let nearer = |angle: f64| angle.min(PI - angle);
    let ends = nearer(angle_between(&e, a)).min(nearer(angle_between(&e, b)));
    let normal = a.cross(b);
    let size = normal.norm();
    if size < 1e-12 {
        return ends;
    }
    let normal = normal / size;
    let foot = e - normal * normal.dot(&e);
    let between = |foot: &Vec3| a.cross(foot).dot(&normal) >= 0.0 && foot.cross(b).dot(&normal) >= 0.0;
    if between(&foot) || between(&-foot) {
        ends.min(asin(normal.dot(&e).abs().min(1.0)))
    } else {
        ends
    }
}

/// All values `q + 2 pi m` inside the limits of a rotary axis, the one nearest to `near` first; where the axis is endless only that one.
/// At most [`MOST_WINDINGS`]. A value beyond a limit by no more than rounding in the program's numbers is taken as on it.
pub(super) fn windings(limits: Limits, q: f64, near: f64) -> Vec<f64> {
    let nearest = q + TAU * ((near - q) / TAU).round();
    let Limits::Range(low, high) = limits else {
        return vec![nearest];
    };
    let slack = SLACK;
    let (lowest, highest) = (((low - slack - q) / TAU).ceil(), ((high + slack - q) / TAU).floor());
    if lowest > highest || !(lowest.is_finite() && highest.is_finite()) {
        return Vec::new();
    }
    let centre = ((near - q) / TAU).round().clamp(lowest, highest);
    let mut turns = vec![centre];
    let mut off = 1.0;
    while turns.len() < MOST_WINDINGS && (centre - off >= lowest || centre + off <= highest) {
        turns.extend(
            [centre - off, centre + off]
                .into_iter()
                .filter(|&m| m >= lowest && m <= highest),
        );
        off += 1.0;
    }
    turns.into_iter().map(|m| (q + TAU * m).clamp(low, high)).collect()
}

/// How far beyond a limit a rotary value may be and still be taken as on it, rad: 1e-5 deg, as in the machine's choice of postures.
const SLACK: f64 = 1e-5 * PI / 180.0;

/// Windings of one axis that are looked at: more only where the travel exceeds 31 turns.
const MOST_WINDINGS: usize = 31;

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::{deg, rad};

    #[test]
    fn all_windings_inside_the_travel_are_found() {
        let found = |low: f64, high: f64, q: f64, near: f64| -> Vec<i64> {
            let values = windings(Limits::Range(rad(low), rad(high)), rad(q), rad(near));
            values.iter().map(|&value| deg(value).round() as i64).collect()
        };
        assert_eq!(found(-360.0, 360.0, 10.0, 300.0), [10, -350]);
        assert_eq!(found(-360.0, 720.0, 10.0, 300.0), [370, 10, -350]);
        assert_eq!(found(-30.0, 120.0, 150.0, 0.0), [0_i64; 0]);
        assert_eq!(found(0.0, 360_000.0, 0.0, 0.0).len(), MOST_WINDINGS);
        assert!((deg(windings(Limits::Unbounded, rad(10.0), rad(700.0))[0]) - 730.0).abs() < 1e-9);
    }

    #[test]
    fn a_great_circle_passes_the_pole_where_it_does() {
        let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
        let axis = |tilt: f64, azimuth: f64| trunnion_machine::tool_axis_at(machine, [rad(azimuth), rad(tilt)]);
        let angle = |a: &Vec3, b: &Vec3| deg(passes_pole(machine, a, b));
        assert!(
            angle(&axis(30.0, 0.0), &axis(30.0, 180.0)) < 1e-9,
            "right over the pole"
        );
        assert!(
            (angle(&axis(5.0, 0.0), &axis(20.0, 0.0)) - 5.0).abs() < 1e-9,
            "away from it"
        );
        // the line between two points of the disc at r = 1.6 and 0.72 deg, 115.3 deg apart, passes 0.517 deg from its centre
        assert!((angle(&axis(1.6, 0.0), &axis(0.72, 115.3)) - 0.517).abs() < 2e-3);
    }
}
