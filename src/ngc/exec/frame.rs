//! Between program coordinates and machine coordinates: tool offset, coordinate system, XY rotation, G92.
//!
//! machine = origin + tool + rotate(program + axis offset); X and Y are rotated, the other seven axes are not. Observed from `rs274`.
use crate::{Pose, State};
use trunnion_geometry::math;

/// X and Y turned by an angle in deg.
pub(crate) fn rotated(x: f64, y: f64, degrees: f64) -> (f64, f64) {
    // without rotation nothing is multiplied: an unknown coordinate must not make the other one unknown
    if degrees == 0.0 {
        return (x, y);
    }
    let (sin, cos) = math::sin_cos(degrees.to_radians());
    (x * cos - y * sin, x * sin + y * cos)
}

/// The pose with X and Y turned.
fn turned(mut pose: Pose, degrees: f64) -> Pose {
    (pose[0], pose[1]) = rotated(pose[0], pose[1], degrees);
    pose
}

/// a + b, axis by axis.
pub(crate) fn sum(a: &Pose, b: &Pose) -> Pose {
    std::array::from_fn(|axis| a[axis] + b[axis])
}

/// a - b, axis by axis.
pub(crate) fn difference(a: &Pose, b: &Pose) -> Pose {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

/// Machine coordinates (program units) of program coordinates.
pub(crate) fn to_machine(state: &State, program: &Pose) -> Pose {
    let turned = turned(sum(program, &state.axis_offset), state.rotation_xy);
    sum(&sum(&turned, &state.origin_offset), &state.tool_offset)
}

/// Program coordinates of machine coordinates (program units).
pub(crate) fn to_program(state: &State, machine: &Pose) -> Pose {
    let shifted = difference(&difference(machine, &state.origin_offset), &state.tool_offset);
    difference(&turned(shifted, -state.rotation_xy), &state.axis_offset)
}

/// Program coordinates of a point that G28, G30 or G53 names: as on the control the tool offset is not used for the rotary axes.
pub(crate) fn named_point(state: &State, machine: &Pose) -> Pose {
    let program = to_program(state, machine);
    std::array::from_fn(|axis| {
        if (3..6).contains(&axis) && !state.wrapped[axis - 3] {
            program[axis] + state.tool_offset[axis]
        } else {
            program[axis]
        }
    })
}

/// Another coordinate system becomes active while the machine does not move.
pub(crate) fn move_origin(state: &mut State, origin: Pose, rotation: f64) {
    let machine = [to_machine(state, &state.current), to_machine(state, &state.compensated)];
    state.origin_offset = origin;
    state.rotation_xy = rotation;
    [state.current, state.compensated] = machine.map(|machine| to_program(state, &machine));
}

/// The active coordinate system is written: another origin and rotation while the machine does not move. As on the control, G92 does
/// not take part in the rotation here.
pub(crate) fn change_origin(state: &mut State, origin: Pose, rotation: f64) {
    let shift = difference(&state.origin_offset, &origin);
    for pose in [&mut state.current, &mut state.compensated] {
        *pose = turned(sum(&turned(*pose, state.rotation_xy), &shift), -rotation);
    }
    state.origin_offset = origin;
    state.rotation_xy = rotation;
}

/// The tool offset changes while the machine does not move: X and Y through the rotation.
pub(crate) fn change_tool_offset(state: &mut State, offset: Pose) {
    let shift = difference(&state.tool_offset, &offset);
    let shift = turned(shift, -state.rotation_xy);
    for pose in [&mut state.current, &mut state.compensated] {
        *pose = sum(pose, &shift);
    }
    state.tool_offset = offset;
}
