//! Equality of motions and of modal states to the bit, in which a number that is unknown (NaN) equals another unknown number: both texts
//! say the same words, so both are unknown for one reason.
use trunnion_interp::{ModalState, Motion, MotionKind, Position};

/// Stands for an unknown number; no program holds it, because the interpreter takes no number above 1e12.
const UNKNOWN: f64 = f64::MAX;

fn known(value: &mut f64) {
    if value.is_nan() {
        *value = UNKNOWN;
    }
}

fn place(position: &mut Position) {
    position.values.iter_mut().for_each(known);
}

/// Whether two motions are the same.
pub(crate) fn same_motion(a: &Motion, b: &Motion) -> bool {
    let comparable = |motion: &Motion| {
        let mut motion = *motion;
        place(&mut motion.start);
        place(&mut motion.end);
        motion.zero.iter_mut().for_each(known);
        known(&mut motion.tool_length_mm);
        motion.spindle_rpm.iter_mut().for_each(known);
        if let MotionKind::Arc(Some(arc)) = &mut motion.kind {
            let values = [&mut arc.sweep, &mut arc.radius_start, &mut arc.radius_end];
            values.into_iter().for_each(known);
            for point in [&mut arc.start, &mut arc.end, &mut arc.centre, &mut arc.normal] {
                point.iter_mut().for_each(known);
            }
        }
        motion
    };
    a == b || comparable(a) == comparable(b)
}

/// Whether two modal states are the same.
pub(crate) fn same_state(a: &ModalState, b: &ModalState) -> bool {
    let comparable = |state: &ModalState| {
        let mut state = state.clone();
        place(&mut state.position);
        state.zero.iter_mut().for_each(known);
        let values = [
            &mut state.feed,
            &mut state.spindle_rpm,
            &mut state.spindle_limit_rpm,
            &mut state.tool_length_mm,
        ];
        values.into_iter().flatten().for_each(known);
        state
    };
    a == b || comparable(a) == comparable(b)
}
