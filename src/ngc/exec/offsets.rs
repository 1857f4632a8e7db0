//! G10 L2 and L20, G92 to G92.3, G52: the zero points.
use super::{access, checks::WHOLE, frame, modal, problems};
use crate::{At, Block, Canon, Engine, Error, Pose, Side, Sink};

/// G10 L2, L20: offset and rotation of a coordinate system.
pub(crate) fn coordinate_system(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    // observed: 2.9999 is 3, 2.8 is 2
    let number = (block.word(b'P').unwrap_or(0.0) + WHOLE) as i32;
    let active = engine.state.origin_index;
    let index = if number == 0 { active } else { number };
    if let Some(letter) = [b'I', b'J'].into_iter().find(|&letter| block.has(letter)) {
        return Err(Error::new(&problems::G10_IJ, block.range_of(letter)));
    }
    if engine.state.side != Side::Off && index == active {
        return Err(Error::new(&problems::G10_COMPENSATION, block.g_range(0)));
    }
    if let (Some(20.0), true) = (block.word(b'L'), block.has(b'R')) {
        return Err(Error::new(&problems::G10_L20_R, block.range_of(b'R')));
    }
    let (stored, stored_rotation) = engine.stored_origin(index);
    let rotation = block.word(b'R').unwrap_or(stored_rotation);
    let from_position = block.word(b'L') == Some(20.0);
    let origin = if from_position {
        origin_of_position(engine, block, &stored, rotation)
    } else {
        engine.over(block, stored)
    };
    if let Some(axes) = engine.state.set_from_position.get_mut(index.unsigned_abs() as usize) {
        let given = (0..9)
            .filter(|axis| block.has(super::ends::AXES[*axis]))
            .fold(0, |mask, axis| mask | 1 << axis);
        *axes = if from_position { *axes | given } else { *axes & !given };
    }
    let first = access::system(index);
    engine.store_pose(first, &origin);
    engine.set_parameter(first + 9, rotation);
    if index != active {
        modal::remark(engine, "interpreter: setting coordinate system origin", at, sink);
        return Ok(());
    }
    frame::change_origin(&mut engine.state, origin, rotation);
    engine.emit(Canon::G5xOffset(index, origin), at, sink);
    engine.emit(Canon::XyRotation(rotation), at, sink);
    Ok(())
}

/// The origin for which the present position of the machine has the programmed coordinates.
fn origin_of_position(engine: &Engine, block: &Block, stored: &Pose, rotation: f64) -> Pose {
    let state = &engine.state;
    let machine = frame::to_machine(state, &state.current);
    // the same place in the other system as it is now
    let mut other = state.clone();
    other.origin_offset = *stored;
    other.rotation_xy = rotation;
    // the control takes the parameters here, which the program may have written since G92
    other.axis_offset = engine.stored_axis_offset();
    let here = frame::to_program(&other, &machine);
    let wanted = engine.over(block, here);
    other.origin_offset = [0.0; 9];
    let reached = frame::to_machine(&other, &wanted);
    let origin = frame::difference(&machine, &reached);
    let turned = rotation != 0.0 && (block.has(b'X') || block.has(b'Y'));
    std::array::from_fn(|axis| {
        let changes = block.has(super::ends::AXES[axis]) || (turned && axis < 2);
        if changes { origin[axis] } else { stored[axis] }
    })
}

/// G92, G52, G92.1, G92.2, G92.3.
pub(crate) fn axis_offsets(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let (code, range) = if matches!(block.g[0], 520 | 920) {
        (block.g[0], block.g_range(0))
    } else if block.g[16] >= 0 {
        (block.g[16], block.g_range(16))
    } else {
        return Ok(());
    };
    if matches!(code, 520 | 920) && engine.state.side != Side::Off {
        return Err(Error::new(&problems::G92_COMPENSATION, range));
    }
    let old = engine.state.axis_offset;
    let new: Pose = match code {
        920 => {
            let here = engine.state.current;
            let wanted = engine.over(block, here);
            std::array::from_fn(|axis| here[axis] + old[axis] - wanted[axis])
        }
        520 => engine.over(block, old),
        923 => engine.stored_pose(access::G92),
        _ => [0.0; 9],
    };
    for pose in [&mut engine.state.current, &mut engine.state.compensated] {
        *pose = std::array::from_fn(|axis| {
            if old[axis] == new[axis] {
                pose[axis]
            } else {
                pose[axis] + old[axis] - new[axis]
            }
        });
    }
    engine.state.axis_offset = new;
    // observed: under compensation the offset changes without a call to the machine
    if engine.state.side == Side::Off {
        engine.emit(Canon::G92Offset(new), at, sink);
    }
    match code {
        920 | 520 => engine.store_pose(access::G92, &new),
        921 => engine.store_pose(access::G92, &[0.0; 9]),
        _ => {}
    }
    let on = matches!(code, 920 | 520 | 923);
    engine.set_parameter(access::G92_ON, f64::from(u8::from(on)));
    Ok(())
}
