//! Motion that the control makes itself in a cycle: with the checks of a block that contains only G0, G1, G2 or G3 and its end.
use super::{arcs, motion, problems};
use crate::{At, Block, Engine, Error, Pose, Sink};

/// G0 or G1 to a pose in program coordinates.
pub(crate) fn made_straight(
    engine: &mut Engine,
    rapid: bool,
    end: Pose,
    block: &Block,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    if rapid {
        engine.state.motion = 0;
        return motion::traverse(engine, end, block, at, sink);
    }
    motion::check_feed(engine, block, &problems::INVERSE_G1, &problems::ZERO_FEED_G1)?;
    engine.state.motion = 10;
    motion::feed(engine, end, block, at, sink)
}

/// G2 (`turns` -1) or G3 (1) in the plane in effect to a pose in program coordinates.
pub(crate) fn made_arc(
    engine: &mut Engine,
    (end, centre, turns): (Pose, [f64; 2], i32),
    block: &Block,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    motion::check_feed(engine, block, &problems::INVERSE_ARC, &problems::ZERO_FEED_ARC)?;
    engine.state.motion = if turns < 0 { 20 } else { 30 };
    if let Some(axes) = arcs::axes(engine.state.plane) {
        let [first, second, _] = axes.places;
        let start = engine.state.current;
        let (from, to) = ([start[first], start[second]], [end[first], end[second]]);
        arcs::check_radii(engine.state.units, block, &axes, from, to, centre)?;
    }
    arcs::sweep(engine, end, centre, turns, block, at, sink)
}
