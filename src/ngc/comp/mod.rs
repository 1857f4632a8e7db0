//! Cutter radius compensation (G40-G42.1): the programmed contour becomes the path of the cutter's centre.
//!
//! The end of a move is known only when the next one is: it is held in the [`Queue`] until then, and calls that come in between
//! wait after it. At outside corners the centre goes around the corner point on an arc, at inside corners both paths end where they
//! meet; moves that would then run backwards are refused. All of this is observed from `rs274` and written down in the tests.
mod corner;
mod moves;
mod plane;
mod problems;
mod queue;

use crate::{At, Block, Canon, Engine, Error, Side, Sink};
pub(crate) use moves::{Arc, Kind, along, arc, check_entry_arc, straight};
pub(crate) use queue::Queue;
use std::sync::Arc as Shared;

/// G41, G42 (and .1): compensation begins with the next motion. `radius` in program units; negative means the other side. The caller
/// has checked that the plane is XY or XZ and that compensation is off.
pub(crate) fn begin(engine: &mut Engine, side: Side, radius: f64, orientation: i32, at: At, sink: &mut dyn Sink) {
    let side = match side {
        Side::Left if radius < 0.0 => Side::Right,
        Side::Right if radius < 0.0 => Side::Left,
        same => same,
    };
    let text = if side == Side::Left {
        "interpreter: cutter radius compensation on left"
    } else {
        "interpreter: cutter radius compensation on right"
    };
    engine.emit(Canon::Comment(Shared::from(text.as_bytes())), at, sink);
    let state = &mut engine.state;
    state.side = side;
    state.radius = radius.abs();
    state.orientation = orientation;
    state.first_compensated = true;
    state.compensated = state.current;
}

/// G40: the held moves are emitted, compensation ends; the next motion starts where the cutter is and must be straight.
pub(crate) fn end(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    flush(engine, block, sink)?;
    let text = "interpreter: cutter radius compensation off";
    engine.emit(Canon::Comment(Shared::from(text.as_bytes())), at, sink);
    let state = &mut engine.state;
    // the first move after compensation goes from the cutter's path to the contour, which an arc cannot do
    state.exit_pending = state.side != Side::Off && state.radius != 0.0 && !state.first_compensated;
    state.side = Side::Off;
    Ok(())
}

/// Emits what is held, for calls that stop the machine (M0, M1, M2, M30, M60) or end the program. Refused where the held move would run
/// backwards.
pub(crate) fn flush(engine: &mut Engine, block: &Block, sink: &mut dyn Sink) -> Result<(), Error> {
    if engine.queue.is_empty() {
        return Ok(());
    }
    let last = plane::point(engine.state.plane, &engine.state.compensated);
    queue::settle(engine, last, block.range, sink)
}

/// Whether a call is queued after held moves. Those that do not reach the machine in time order anyway are emitted at once, as `rs274` does.
pub(crate) fn waits(call: &Canon) -> bool {
    match call {
        Canon::Comment(text) => !text.starts_with(b"interpreter: Lathe diameter mode"),
        Canon::FeedRate(_)
        | Canon::FeedMode(..)
        | Canon::Dwell(_)
        | Canon::SpindleSpeed(..)
        | Canon::SpindleMode(..)
        | Canon::Spindle(..)
        | Canon::OrientSpindle(..)
        | Canon::WaitOrient(..)
        | Canon::Coolant(_)
        | Canon::UserCode(..) => true,
        _ => false,
    }
}
