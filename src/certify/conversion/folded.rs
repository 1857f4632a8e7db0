//! What a program adds to the zero point of its work offset (G52, G92, TRANS), put into the coordinates: a conversion writes none of it.
use trunnion_geometry::Vec3;
use trunnion_interp::{ModalState, Motion, MotionKind, Setup};

/// Shifts of the zero point that differ by less are the same, mm or deg.
pub(super) const SHIFT: f64 = 1e-9;

/// What the zero point adds to the declared values of the work offset; `unnamed`: the active offset where the program names none.
pub(super) fn shift_of(zero: &[f64; 9], state: &ModalState, setup: &Setup, unnamed: &str) -> [f64; 9] {
    let name = state.zero.offset().unwrap_or(unnamed);
    let base = setup.work_offset(name).map_or([0.0; 9], |offset| offset.values);
    core::array::from_fn(|axis| zero[axis] - base[axis])
}

/// The motion in the coordinates of the work offset, without what the program adds to it: the same positions of the machine. Machine coordinates
/// know nothing of a shift.
pub(super) fn folded(motion: &Motion, shift: &[f64; 9]) -> Motion {
    let mut own = *motion;
    if shift.iter().any(|shift| !shift.is_finite()) || shift.iter().all(|shift| *shift == 0.0) {
        return own;
    }
    for (zero, shift) in own.zero.iter_mut().zip(shift) {
        *zero -= shift;
    }
    if motion.machine_coordinates {
        return own;
    }
    for position in [&mut own.start, &mut own.end] {
        for (value, shift) in position.values.iter_mut().zip(shift) {
            *value += shift;
        }
    }
    if let MotionKind::Arc(Some(arc)) = &mut own.kind {
        let by = Vec3::new(shift[0], shift[1], shift[2]);
        for point in [&mut arc.start, &mut arc.end, &mut arc.centre] {
            *point += by;
        }
    }
    own
}
