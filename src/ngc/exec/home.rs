//! G28, G30: to the stored points; G28.1, G30.1: where the machine is becomes the stored point.
use super::{
    access::{HOME, SECOND_HOME},
    ends, frame, problems,
};
use crate::{At, Block, Canon, Engine, Error, Side, Sink};

/// G28, G28.1, G30, G30.1.
pub(crate) fn run(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    match block.g[0] {
        280 => go(engine, HOME, block, at, sink),
        300 => go(engine, SECOND_HOME, block, at, sink),
        281 | 301 if engine.state.side != Side::Off => Err(Error::new(&problems::STORE_COMPENSATION, block.g_range(0))),
        281 => {
            store(engine, HOME);
            Ok(())
        }
        301 => {
            store(engine, SECOND_HOME);
            Ok(())
        }
        _ => Ok(()),
    }
}

fn store(engine: &mut Engine, first: usize) {
    let mut machine = frame::to_machine(&engine.state, &engine.state.current);
    for (axis, value) in machine.iter_mut().enumerate() {
        if ends::is_wrapped(&engine.state, axis) {
            *value = value.rem_euclid(360.0);
        }
    }
    engine.store_pose(first, &machine);
}

/// By way of the programmed point; with axis words only the named axes go to the stored point.
fn go(engine: &mut Engine, first: usize, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if engine.state.side != Side::Off {
        return Err(Error::new(&problems::HOME_COMPENSATION, block.g_range(0)));
    }
    let by_way_of = ends::end(&engine.state, block)?;
    rapid(engine, by_way_of, at, sink);
    let stored = engine.stored_pose(first);
    let home = frame::named_point(&engine.state, &stored);
    let named = block.given & crate::block::AXES != 0;
    let mut end = by_way_of;
    for axis in 0..9 {
        if !named || block.has(ends::AXES[axis]) {
            end[axis] = ends::named_end(&engine.state, block, axis, end[axis], stored[axis], home[axis])?;
        }
    }
    rapid(engine, end, at, sink);
    Ok(())
}

fn rapid(engine: &mut Engine, end: crate::Pose, at: At, sink: &mut dyn Sink) {
    engine.state.current = end;
    engine.emit(Canon::Traverse(end), at, sink);
}
