//! Between the coordinates of canonical calls and those of motions: mm and degrees, offsets separated from what is programmed.
use crate::Position;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::sin_cos;
use trunnion_ngc::{Pose, State};

/// Axes of [`crate::AXIS_LETTERS`] that turn.
#[inline]
fn is_rotary(axis: usize) -> bool {
    (3..6).contains(&axis)
}

/// The difference between program coordinates and machine coordinates. LinuxCNC: machine = R (program + G92) + G5x + tool offset, with R the
/// rotation about Z (LinuxCNC documentation, Coordinate Systems).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Shift {
    /// mm per program unit.
    unit: f64,
    /// The same axis by axis: degrees are degrees.
    units: Pose,
    /// Cosine and sine of the rotation; `None` without one.
    rotation: Option<(f64, f64)>,
    /// G92 where there is a rotation, mm and deg.
    inside: Pose,
    /// To be added to what [`Shift::coordinates`] gives, mm and deg: the zero point of a motion.
    pub(super) zero: Pose,
    /// Tool offset along Z, mm.
    pub(super) length: f64,
}

impl Shift {
    /// `g92`, `tool`: the last shift and the last tool offset that were set, mm and deg. Under compensation of the cutter radius,
    /// and when the unit changes, the interpreter changes its own values without a call.
    pub(super) fn of(state: &State, g92: &Pose, tool: &Pose) -> Self {
        let unit = state.units.mm();
        let scale = |axis: usize| if is_rotary(axis) { 1.0 } else { unit };
        let rotation = (state.rotation_xy != 0.0).then(|| {
            let (sine, cosine) = sin_cos(state.rotation_xy.to_radians());
            (cosine, sine)
        });
        let mut inside = [0.0; 9];
        let mut zero = [0.0; 9];
        for axis in 0..9 {
            zero[axis] = state.origin_offset[axis] * scale(axis);
            if axis != 2 {
                zero[axis] += tool[axis];
            }
            if rotation.is_some() {
                inside[axis] = g92[axis];
            } else {
                zero[axis] += g92[axis];
            }
        }
        Self {
            unit,
            units: std::array::from_fn(scale),
            rotation,
            inside,
            zero,
            length: tool[2],
        }
    }

    /// A pose of a canonical call as coordinates of a motion; what is not a number is unknown.
    #[inline]
    pub(super) fn coordinates(&self, pose: &Pose) -> Position {
        let mut values = *pose;
        for ((value, unit), inside) in values.iter_mut().zip(&self.units).zip(&self.inside) {
            *value = *value * unit + inside;
        }
        if let Some((cosine, sine)) = self.rotation {
            let [x, y, ..] = values;
            values[0] = x * cosine - y * sine;
            values[1] = x * sine + y * cosine;
        }
        if all_finite(&values) {
            return Position { values, known: ALL };
        }
        let mut position = Position::default();
        for (axis, value) in values.into_iter().enumerate() {
            if value.is_finite() {
                position.set(axis, value);
            }
        }
        position
    }

    /// Moves the named axes (bit per axis) of an end, and of the same in coordinates of the machine, to a pose, whose other axes are
    /// already there. `false` where the short path does not apply: then the two are of no use.
    #[inline]
    pub(super) fn reach(&self, pose: &Pose, named: u16, end: &mut Position, machine: &mut Position) -> bool {
        if self.rotation.is_some() {
            return false;
        }
        let named = named & ALL;
        let mut left = named;
        while left != 0 {
            let axis = (left.trailing_zeros() as usize).min(8);
            left &= left - 1;
            let value = pose[axis] * self.units[axis] + self.inside[axis];
            let mut there = value + self.zero[axis];
            if axis == 2 {
                there += self.length;
            }
            // no value is infinite or NaN if the position is finite
            if !there.is_finite() {
                return false;
            }
            end.values[axis] = value;
            machine.values[axis] = there;
        }
        end.known |= named;
        machine.known |= named;
        true
    }

    /// mm and deg from program units.
    #[inline]
    pub(super) fn metric(pose: &Pose, unit: f64) -> Pose {
        let [x, y, z, a, b, c, u, v, w] = *pose;
        [x * unit, y * unit, z * unit, a, b, c, u * unit, v * unit, w * unit]
    }

    /// A point X Y Z of a canonical call, program units.
    pub(super) fn point(&self, [x, y, z]: [f64; 3]) -> Vec3 {
        let mut pose = [0.0; 9];
        (pose[0], pose[1], pose[2]) = (x, y, z);
        let mut values = pose.map(|value| value * self.unit);
        for (value, inside) in values.iter_mut().zip(self.inside).take(3) {
            *value += inside;
        }
        self.turned(Vec3::new(values[0], values[1], values[2]))
    }

    /// A direction of the program, turned with the coordinate system.
    pub(super) fn turned(&self, direction: Vec3) -> Vec3 {
        match self.rotation {
            Some((cosine, sine)) => Vec3::new(
                direction.x * cosine - direction.y * sine,
                direction.x * sine + direction.y * cosine,
                direction.z,
            ),
            None => direction,
        }
    }

    /// Coordinates of a motion as the machine has them.
    #[inline]
    pub(super) fn machine(&self, coordinates: &Position) -> Position {
        self.moved(coordinates, 1.0)
    }

    /// Coordinates of a motion from those of the machine.
    #[inline]
    pub(super) fn programmed(&self, machine: &Position) -> Position {
        self.moved(machine, -1.0)
    }

    #[inline]
    fn moved(&self, position: &Position, sign: f64) -> Position {
        let mut moved = *position;
        for (value, zero) in moved.values.iter_mut().zip(self.zero) {
            *value += sign * zero;
        }
        moved.values[2] += sign * self.length;
        if !all_finite(&moved.values) {
            let finite = |axis: usize| u16::from(moved.values[axis].is_finite()) << axis;
            moved.known &= (0..9).fold(0, |mask, axis| mask | finite(axis));
        }
        moved
    }
}

/// All axes as a mask.
const ALL: u16 = (1 << 9) - 1;

/// Whether all values are surely finite: a sum that is finite has no other in it. One of huge values may not be.
#[inline]
fn all_finite(values: &Pose) -> bool {
    let [a, b, c, d, e, f, g, h, i] = values;
    (((a + c) + (e + g)) + ((b + d) + (f + h)) + i).is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_g92_and_offset_add_up_as_linuxcnc_does() {
        let mut state = State::new(false);
        state.rotation_xy = 90.0;
        state.origin_offset[0] = 100.0;
        let mut tool = [0.0; 9];
        tool[2] = 50.0;
        let mut g92 = [0.0; 9];
        g92[1] = 5.0;
        let shift = Shift::of(&state, &g92, &tool);
        let at = shift.coordinates(&[10.0, 0.0, 1.0, 7.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let machine = shift.machine(&at);
        // (10, 0) + (0, 5) turned by 90 deg is (-5, 10)
        for (axis, expected) in [(0, 95.0), (1, 10.0), (2, 51.0), (3, 7.0)] {
            let value = machine.get(axis).expect("known");
            assert!((value - expected).abs() < 1e-12, "{axis}: {value}");
        }
        let back = shift.programmed(&machine);
        assert!((back.values[0] - at.values[0]).abs() < 1e-12);
    }

    #[test]
    fn what_is_not_a_number_is_unknown() {
        let shift = Shift::of(&State::new(false), &[0.0; 9], &[0.0; 9]);
        let mut pose = [1.0; 9];
        pose[1] = f64::NAN;
        let at = shift.coordinates(&pose);
        assert_eq!((at.get(0), at.get(1)), (Some(1.0), None));
    }

    #[test]
    fn only_what_is_finite_is_known_also_where_values_are_huge() {
        let huge = [f64::MAX; 9];
        assert!(!all_finite(&huge));
        let shift = Shift::of(&State::new(false), &[0.0; 9], &[0.0; 9]);
        let at = shift.coordinates(&huge);
        assert_eq!((at.values, at.known), (huge, ALL));
        assert_eq!(shift.machine(&at).known, ALL);
        for axis in 0..9 {
            for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut pose = [-1.0; 9];
                assert!(all_finite(&pose));
                pose[axis] = odd;
                assert!(!all_finite(&pose));
                pose[(axis + 1) % 9] = -odd;
                assert!(!all_finite(&pose));
                assert_eq!(
                    shift.coordinates(&pose).known,
                    ALL & !(1 << axis) & !(1 << ((axis + 1) % 9))
                );
            }
        }
    }

    #[test]
    fn inches_become_millimetres_and_degrees_stay() {
        let mut state = State::new(false);
        state.units = trunnion_ngc::Units::Inch;
        let at = Shift::of(&state, &[0.0; 9], &[0.0; 9]).coordinates(&[1.0; 9]);
        assert_eq!((at.get(0), at.get(3), at.get(6)), (Some(25.4), Some(1.0), Some(25.4)));
    }
}
