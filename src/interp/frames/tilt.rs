//! A tilted working plane: its position and rotation in the workpiece frame. While one is active all positions of the interpreter are expressed in
//! its coordinates, so that cycles, compensation and lengths work as in any plane; motions are turned into the workpiece frame when they
//! are emitted.
use super::XYZ;
use super::shape::sin_cos_degrees;
use crate::{AXIS_LETTERS, Motion, MotionKind, Orientation, Position, Swivel};
use trunnion_geometry::arc::Arc;
use trunnion_geometry::{Mat3, Vec3};

/// Z in [`crate::AXIS_LETTERS`].
const Z: u16 = 0b100;

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tilted {
    /// Zero of the plane's coordinates, workpiece frame, mm.
    pub(crate) origin: Vec3,
    /// Columns: its axes in the workpiece frame.
    pub(crate) turn: Mat3,
    /// It is a frame of the program (ROT of a Sinumerik): the words are turned, and the tool need not stand on the plane.
    pub(crate) programmed: bool,
}

/// Turn about axis 0, 1, 2 (X, Y, Z) by an angle in degrees, right-handed; quarter turns are exact.
pub(crate) fn turn_about(axis: usize, degrees: f64) -> Mat3 {
    let (sin, cos) = sin_cos_degrees(degrees);
    match axis {
        0 => Mat3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos),
        1 => Mat3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos),
        _ => Mat3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0),
    }
}

impl Tilted {
    /// Turns about the axes as they come out of the turns before: axis and degrees, in order.
    pub(crate) fn new(origin: Vec3, turns: &[(usize, f64)]) -> Self {
        let turn = turns.iter().fold(Mat3::identity(), |turn, &(axis, degrees)| {
            turn * turn_about(axis, degrees)
        });
        Self {
            origin,
            turn,
            programmed: false,
        }
    }
    /// Axes that are turned about the zero point.
    pub(crate) fn turned(turn: Mat3) -> Self {
        Self {
            origin: Vec3::zeros(),
            turn,
            programmed: false,
        }
    }
    /// A plane that is given in the coordinates of this one, in the workpiece frame.
    pub(crate) fn then(&self, inner: &Self) -> Self {
        Self {
            origin: self.origin + self.turn * inner.origin,
            turn: self.turn * inner.turn,
            programmed: false,
        }
    }
    /// The direction that the tool must have.
    pub(crate) fn normal(&self) -> Vec3 {
        self.turn.column(2).into()
    }
    /// From coordinates of the plane to the workpiece frame. A coordinate is known where all that it depends on is.
    pub(crate) fn to_work(self, position: &Position) -> Position {
        carry(position, |known| {
            let point = self.turn * known + self.origin;
            (point, self.turn)
        })
    }
    /// The way back.
    pub(crate) fn to_plane(self, position: &Position) -> Position {
        let back = self.turn.transpose();
        carry(position, |known| (back * (known - self.origin), back))
    }
    /// A motion of the plane in the workpiece frame.
    pub(crate) fn motion_to_work(&self, in_plane: &Motion) -> Motion {
        let mut motion = *in_plane;
        motion.start = self.to_work(&motion.start);
        motion.end = self.to_work(&motion.end);
        if let MotionKind::Arc(Some(arc)) = &mut motion.kind {
            *arc = self.arc_to_work(arc);
        }
        if let Orientation::Vector(before, vector) = motion.orientation {
            motion.orientation = Orientation::Vector(before.map(|before| self.turn * before), self.turn * vector);
        }
        if !motion.tcp && motion.tilt.swivel == Swivel::No && !self.programmed {
            motion.tilt.normal = Some(self.normal());
            self.leave_free(&mut motion, in_plane);
        } else {
            // a coordinate of the plane that changes, or whose end is not known, moves the axes along it, wherever they go
            let changes = |axis: &usize| match in_plane.end.get(*axis) {
                Some(to) => in_plane.start.get(*axis) != Some(to),
                None => in_plane.says_way & 1 << *axis != 0,
            };
            for axis in (0..3).filter(changes) {
                let along = (0..3).filter(|own| self.turn[(*own, axis)] != 0.0);
                motion.says_way |= along.fold(0, |all, own| all | 1 << own) & !motion.end.known;
            }
        }
        motion
    }
    /// Coordinates of the plane that the program does not know: the machine floor finds the position of the tool from the normal. Where
    /// it cannot, the end is unknown.
    fn leave_free(self, motion: &mut Motion, in_plane: &Motion) {
        let free = XYZ & !in_plane.end.known;
        let turns = (3..AXIS_LETTERS.len()).any(|axis| in_plane.start.get(axis) != in_plane.end.get(axis));
        let is_line = matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear);
        if free == 0 {
            return;
        }
        let unread = motion.says_way & free != 0;
        if free == XYZ && !unread {
            (motion.tilt.normal, motion.tilt.free) = (None, free);
        } else if is_line && !unread && !turns && (free == Z || free == XYZ & !Z) {
            let known = Vec3::from_fn(|axis, _| in_plane.end.get(axis).unwrap_or(0.0));
            let point = self.turn * known + self.origin;
            motion.end.values[..3].copy_from_slice(point.as_slice());
            motion.end.known &= !XYZ;
            motion.tilt.free = free;
        } else {
            motion.says_way |= XYZ & !motion.end.known;
        }
    }
    fn arc_to_work(&self, arc: &Arc) -> Arc {
        let place = |point: Vec3| self.turn * point + self.origin;
        Arc {
            start: place(arc.start),
            end: place(arc.end),
            centre: place(arc.centre),
            normal: self.turn * arc.normal,
            ..*arc
        }
    }
}

/// X Y Z of a position through a turn and shift; what depends on an unknown coordinate is unknown.
fn carry(position: &Position, map: impl Fn(Vec3) -> (Vec3, Mat3)) -> Position {
    let mut out = *position;
    let values = Vec3::from_fn(|axis, _| position.get(axis).unwrap_or(0.0));
    let (point, turn) = map(values);
    for axis in 0..3 {
        let depends = (0..3).fold(0u16, |mask, other| {
            mask | u16::from(turn[(axis, other)] != 0.0) << other
        });
        if position.known & depends == depends {
            out.set(axis, point[axis]);
        } else {
            out.forget(axis);
        }
    }
    debug_assert!(
        position.known & XYZ != XYZ || out.known & XYZ == XYZ,
        "all known stays known"
    );
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(values: [f64; 3], known: u16) -> Position {
        let mut position = Position {
            known,
            ..Position::default()
        };
        position.values[..3].copy_from_slice(&values);
        position
    }

    /// G68.2 I-90 J15 K90 and Y turned by -15 deg are the same plane: the pair of programs for A-15 C90.
    #[test]
    fn euler_angles_and_turns_about_axes_agree() {
        let euler = Tilted::new(Vec3::zeros(), &[(2, -90.0), (0, 15.0), (2, 90.0)]);
        let axes = Tilted::new(Vec3::zeros(), &[(0, 0.0), (1, -15.0), (2, 0.0)]);
        assert!((euler.turn - axes.turn).norm() < 1e-12, "{}", euler.turn - axes.turn);
        let (sin, cos) = trunnion_geometry::math::sin_cos(15f64.to_radians());
        assert!((euler.normal() - Vec3::new(-sin, 0.0, cos)).norm() < 1e-12);
    }

    #[test]
    fn a_coordinate_is_known_where_all_that_it_depends_on_is() {
        let front = Tilted::new(Vec3::new(0.0, 0.0, -50.0), &[(2, 0.0), (0, 90.0), (2, 0.0)]);
        // Y of the plane is Z of the part, Z of the plane is -Y of it
        let found = front.to_work(&at([25.0, 15.0, 0.0], 0b011));
        assert_eq!(
            (found.get(0), found.get(1), found.get(2)),
            (Some(25.0), None, Some(-35.0))
        );
        let back = front.to_plane(&found);
        assert_eq!((back.get(0), back.get(1), back.get(2)), (Some(25.0), Some(15.0), None));
    }

    proptest! {
        #[test]
        fn there_and_back_is_the_same(x in -500.0..500.0f64, y in -500.0..500.0f64, z in -500.0..500.0f64,
            i in -360.0..360.0f64, j in -360.0..360.0f64, k in -360.0..360.0f64) {
            let tilted = Tilted::new(Vec3::new(y, z, x), &[(2, i), (0, j), (2, k)]);
            let position = at([x, y, z], XYZ);
            let back = tilted.to_plane(&tilted.to_work(&position));
            for axis in 0..3 {
                prop_assert!((back.values[axis] - position.values[axis]).abs() < 1e-9);
            }
            prop_assert!((tilted.turn.determinant() - 1.0).abs() < 1e-12);
        }
    }
}
