//! Programmable frames of a Sinumerik that turn out of the plane (ROT X30, CROT, ROTS), and all that turn under tool centre point control: a
//! tilted plane that the program has set. Its words are turned coordinates; the tool need not stand on it.
//!
//! Sources: several angles of ROT turn about Z, the new Y, the new X where machine data 10600 is 1, in whatever order they are written (SINUMERIK
//! 840D sl Function Manual, Basic Functions, K2, 11/2006, p. 2-56). ROTS with two angles: the traces of the plane (08/2005, p. 2-101).
use super::programmable::FrameStep;
use super::{Linear, Tilted};
use crate::arc::plane_axes;
use crate::core::Report;
use crate::frames::tilt::turn_about;
use crate::iso::Iso;
use crate::{FaultKind, FrameAngles};
use trunnion_geometry::math::{atan2, hypot};
use trunnion_geometry::{Mat3, Vec3};

/// A point p of the frame is at `turn` p + `shift` outside, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrameValue {
    pub(crate) turn: Mat3,
    pub(crate) shift: Vec3,
    /// A part of the shift is a fine one (CFINE): how it is divided is not followed.
    pub(crate) fine: bool,
}

impl Default for FrameValue {
    fn default() -> Self {
        Self {
            turn: Mat3::identity(),
            shift: Vec3::zeros(),
            fine: false,
        }
    }
}

impl FrameValue {
    pub(crate) fn new(turn: Mat3, shift: Vec3) -> Self {
        Self {
            turn,
            shift,
            fine: false,
        }
    }
    pub(crate) fn turn(&self) -> Mat3 {
        self.turn
    }
    pub(crate) fn shift(&self) -> Vec3 {
        self.shift
    }
    pub(crate) fn then(&self, inner: &Self) -> Self {
        Self {
            turn: self.turn * inner.turn,
            shift: self.shift + self.turn * inner.shift,
            fine: self.fine || inner.fine,
        }
    }
    pub(crate) fn turns(&self) -> bool {
        self.turn != Mat3::identity()
    }
}

/// Rounding of a matrix.
const TINY: f64 = 1e-12;

/// Rz(z) Ry(y) Rx(x), degrees.
fn roll_pitch_yaw([x, y, z]: [f64; 3]) -> Mat3 {
    turn_about(2, z) * turn_about(1, y) * turn_about(0, x)
}

/// The angles of a turn about Z, the new Y, the new X, degrees: -180 to 180, -90 to 90, -180 to 180. Where Y is 90 or -90, X is 0.
pub(crate) fn angles_of(turn: &Mat3) -> [f64; 3] {
    let flat = hypot(turn[(2, 1)], turn[(2, 2)]);
    let y = atan2(-turn[(2, 0)], flat);
    let angles = if flat <= TINY {
        [0.0, y, atan2(-turn[(0, 1)], turn[(1, 1)])]
    } else {
        [atan2(turn[(2, 1)], turn[(2, 2)]), y, atan2(turn[(1, 0)], turn[(0, 0)])]
    };
    angles.map(f64::to_degrees)
}

/// ROTS: one angle turns as ROT does. Two are those of the lines in which the plane cuts the old planes: of the two axes, the one whose angle is
/// given for the other is turned about that other, and the first of them lies in the old plane of itself and the third axis.
pub(crate) fn by_traces(angles: [Option<f64>; 3]) -> Option<Mat3> {
    let (first, second) = match angles {
        [Some(x), None, None] => return Some(turn_about(0, x)),
        [None, Some(y), None] => return Some(turn_about(1, y)),
        [None, None, Some(z)] => return Some(turn_about(2, z)),
        [Some(_), Some(_), None] => (0, 1),
        [Some(_), None, Some(_)] => (2, 0),
        [None, Some(_), Some(_)] => (1, 2),
        _ => return None,
    };
    let unit = |axis: usize| {
        let mut unit = Vec3::zeros();
        unit[axis] = 1.0;
        unit
    };
    let new_first = turn_about(second, angles[second]?) * unit(first);
    let trace = turn_about(first, angles[first]?) * unit(second);
    let normal = new_first.cross(&trace);
    (normal.norm() > 1e-9).then_some(())?;
    let normal = normal.normalize();
    let mut turn = Mat3::zeros();
    turn.set_column(first, &new_first);
    turn.set_column(second, &normal.cross(&new_first));
    turn.set_column((second + 1) % 3, &normal);
    Some(turn)
}

/// Whether a matrix only turns.
pub(crate) fn is_rigid(turn: &Mat3) -> bool {
    (turn.transpose() * turn - Mat3::identity()).amax() <= TINY && turn.determinant() > 0.0
}

impl Iso<'_> {
    /// The turn of ROT and CROT with the angles of X, Y, Z; `None`: the order of several is not known.
    pub(crate) fn turn_of(&self, angles: [Option<f64>; 3]) -> Option<Mat3> {
        let mut named = angles
            .iter()
            .enumerate()
            .filter_map(|(axis, angle)| Some((axis, (*angle)?)));
        match (named.next(), named.next()) {
            (Some((axis, angle)), None) => Some(turn_about(axis, angle)),
            (None, _) => None,
            _ if self.core.setup.control.frame_angles != Some(FrameAngles::RollPitchYaw) => None,
            _ => Some(roll_pitch_yaw(angles.map(Option::unwrap_or_default))),
        }
    }

    /// Whether the program has set a frame of this kind.
    pub(super) fn is_solid(&self) -> bool {
        self.memory.frames.tilt.is_some_and(|tilt| tilt.programmed)
    }

    /// One more code of the frame. `None`: it stays in the plane and is followed there; `Some(false)`: it is not followed.
    pub(super) fn solid_step(&mut self, step: &FrameStep) -> Option<bool> {
        let inner = match step {
            FrameStep::Shift(by) if by[3..] == [0.0; 6] => {
                FrameValue::new(Mat3::identity(), Vec3::new(by[0], by[1], by[2]))
            }
            FrameStep::Shift(_) => return self.is_solid().then_some(false),
            FrameStep::Linear(linear) => FrameValue::new(linear.matrix(), Vec3::zeros()),
        };
        let whole = self.programmable().then(&inner);
        self.needs_solid(&whole.turn()).then(|| self.set_solid(&whole))
    }

    /// Whether a frame cannot be followed in the plane alone.
    pub(crate) fn needs_solid(&self, turn: &Mat3) -> bool {
        let normal = plane_axes(self.core.state.coordinates.plane())[2];
        let tip = self.core.state.tool_axis.tcp() && *turn != Mat3::identity();
        self.is_solid() || tip || Linear::from_matrix(*turn).leaves(normal)
    }

    /// The whole programmable frame; false: it scales or mirrors too, or lies in one that is not of the program.
    pub(crate) fn set_solid(&mut self, frame: &FrameValue) -> bool {
        let free = self.memory.frames.tilt.is_none_or(|tilt| tilt.programmed)
            && !self.memory.compensation.is_busy()
            && self.core.state.compensation == 0
            && !self.memory.corners.is_busy()
            && self.memory.frames.local[3..] == [0.0; 6];
        if !free || !is_rigid(&frame.turn()) {
            return false;
        }
        self.end_programmable();
        let tilt = Tilted {
            origin: frame.shift(),
            turn: frame.turn(),
            programmed: true,
        };
        let place = tilt.to_plane(&self.core.state.position);
        self.memory.frames.tilt = Some(tilt);
        self.arrives(place);
        true
    }

    /// The frame of the program ends; the machine stays where it is.
    pub(super) fn end_solid(&mut self) {
        let Some(tilt) = self.memory.frames.tilt.filter(|tilt| tilt.programmed) else {
            return;
        };
        let place = tilt.to_work(&self.core.state.position);
        self.memory.frames.tilt = None;
        self.memory.frames.must_be_absolute |= super::XYZ;
        self.arrives(place);
    }

    fn arrives(&mut self, place: crate::Position) {
        self.core.state.position = place;
        self.core.state.orientation = crate::Orientation::Words;
        self.memory.frames.refresh(&place);
    }

    /// Tool centre point control begins while the program turns the plane: the same frame, as one that vectors and positions of the tip follow.
    pub(crate) fn frame_of_tip(&mut self, report: &mut Report<'_>) {
        if self.memory.frames.shape.linear.is_none() || !self.core.dialect.quirks.declares_names() {
            return;
        }
        let frame = self.programmable();
        if self.set_solid(&frame) {
            return;
        }
        let what = "a frame that mirrors or scales, or lies in a swivelled plane, under tool centre point control";
        report.fault(report.whole(), FaultKind::NotModelled { what: what.to_owned() });
        if let Some(code) = self.core.dialect.name("TRANS") {
            self.core.unknown.begin(code, false);
        }
        self.core.forget_position();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of the function manual: what is written, and what reads back.
    #[test]
    fn angles_read_back_in_their_ranges() {
        for (written, read) in [
            ([10.0, 90.0, 40.0], [0.0, 90.0, 30.0]),
            ([190.0, 0.0, -200.0], [-170.0, 0.0, 160.0]),
            ([10.0, 20.0, 30.0], [10.0, 20.0, 30.0]),
            ([10.0, -90.0, 40.0], [0.0, -90.0, 50.0]),
        ] {
            let found = angles_of(&roll_pitch_yaw(written));
            assert!((0..3).all(|axis| (found[axis] - read[axis]).abs() < 1e-9), "{found:?}");
        }
    }

    /// The plane holds both traces, and its first axis lies where the manual says.
    #[test]
    fn a_plane_by_its_traces() {
        for (first, second) in [(0usize, 1usize), (2, 0), (1, 2)] {
            let mut angles = [None; 3];
            (angles[first], angles[second]) = (Some(-25.0), Some(40.0));
            let turn = by_traces(angles).expect("a plane");
            assert!(is_rigid(&turn), "{turn}");
            let third = (second + 1) % 3;
            let normal: Vec3 = turn.column(third).into();
            // the first axis has no part along the old second axis
            assert!(turn[(second, first)].abs() < 1e-12);
            let mut unit = Vec3::zeros();
            unit[second] = 1.0;
            assert!(normal.dot(&(turn_about(first, -25.0) * unit)).abs() < 1e-12);
            // with one angle of zero it is the turn about the other axis
            angles[first] = Some(0.0);
            let single = by_traces(angles).expect("a plane");
            assert!((single - turn_about(second, 40.0)).amax() < 1e-12);
        }
    }
}
