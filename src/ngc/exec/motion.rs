//! Straight motion: G0 and G1, with compensation of the cutter radius where it is on.
use super::{ends, problems};
use crate::{At, Block, Canon, Engine, Error, FeedMode, Pose, Problem, Side, Sink, comp};

/// Rapid to a pose in program coordinates of the contour.
pub(crate) fn traverse(
    engine: &mut Engine,
    end: Pose,
    block: &Block,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    if engine.state.side != Side::Off {
        return comp::straight(engine, true, end, block, at, sink);
    }
    engine.state.exit_pending = false;
    engine.state.current = end;
    engine.emit(Canon::Traverse(end), at, sink);
    Ok(())
}

/// Feed to a pose in program coordinates of the contour.
pub(crate) fn feed(engine: &mut Engine, end: Pose, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if engine.state.side != Side::Off {
        return comp::straight(engine, false, end, block, at, sink);
    }
    if engine.state.feed_mode == FeedMode::InverseTime {
        inverse_time(engine, block, length(&engine.state.current, &end), at, sink);
    }
    engine.state.exit_pending = false;
    engine.state.current = end;
    engine.emit(Canon::Feed(end), at, sink);
    Ok(())
}

/// Length that F of a straight motion is measured along: X Y Z, else U V W, else A B C; program units or deg.
pub(crate) fn length(from: &Pose, to: &Pose) -> f64 {
    let part = |axes: [usize; 3]| {
        axes.iter()
            .map(|&axis| (to[axis] - from[axis]).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let linear = part([0, 1, 2]);
    if linear != 0.0 {
        return linear;
    }
    let second = part([6, 7, 8]);
    if second == 0.0 { part([3, 4, 5]) } else { second }
}

/// Under G93: the rate that makes a motion of this length last 1/F minutes, as the control gives it to the machine (at least 0.1).
pub(crate) fn inverse_time(engine: &mut Engine, block: &Block, length: f64, at: At, sink: &mut dyn Sink) {
    let per_minute = block.word(b'F').unwrap_or(0.0);
    engine.state.inverse_time = per_minute;
    let rate = length * per_minute;
    let rate = if rate < 0.1 { 0.1 } else { rate };
    engine.state.feed_rate = rate;
    engine.emit(Canon::FeedRate(rate), at, sink);
}

/// Whether feed is possible: F under G93 in the block, a rate otherwise, a turning spindle under G95.
#[inline]
pub(crate) fn check_feed(
    engine: &Engine,
    block: &Block,
    missing_f: &'static Problem,
    zero: &'static Problem,
) -> Result<(), Error> {
    let state = &engine.state;
    match state.feed_mode {
        FeedMode::InverseTime if !block.has(b'F') => return Err(Error::new(missing_f, block.g_range(1))),
        FeedMode::PerMinute | FeedMode::PerRevolution if state.feed_rate == 0.0 => {
            return Err(Error::new(zero, code_range(block)));
        }
        FeedMode::PerRevolution if state.speed[state.chosen_spindle] == 0.0 => {
            return Err(Error::new(&problems::ZERO_SPEED_PER_REV, code_range(block)));
        }
        _ => {}
    }
    Ok(())
}

/// The motion code's bytes, or the line's where the code is modal.
pub(crate) fn code_range(block: &Block) -> trunnion_syntax::TextRange {
    if block.g[1] >= 0 { block.g_range(1) } else { block.range }
}

/// [`straight`] of a block that `choose_line` has chosen: compensation is off.
#[inline]
pub(crate) fn line(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let is_feed = block.motion == 10;
    if is_feed {
        check_feed(engine, block, &problems::INVERSE_G1, &problems::ZERO_FEED_G1)?;
    }
    engine.state.motion = block.motion;
    if !ends::takes_words(&engine.state, block) {
        let end = ends::end(&engine.state, block)?;
        return if is_feed {
            feed(engine, end, block, at, sink)
        } else {
            traverse(engine, end, block, at, sink)
        };
    }
    if is_feed && engine.state.feed_mode == FeedMode::InverseTime {
        let mut end = engine.state.current;
        ends::put_words(&mut end, block);
        inverse_time(engine, block, length(&engine.state.current, &end), at, sink);
    }
    engine.state.exit_pending = false;
    ends::put_words(&mut engine.state.current, block);
    if engine.queue.is_empty() {
        // what `emit` does
        let state = &mut engine.state;
        state.told.reach(&state.current);
        sink.straight(!is_feed, &state.current, at, state);
        return Ok(());
    }
    let end = engine.state.current;
    let call = if is_feed {
        Canon::Feed(end)
    } else {
        Canon::Traverse(end)
    };
    engine.emit(call, at, sink);
    Ok(())
}

/// G0, G1.
pub(crate) fn straight(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if block.motion == 10 {
        check_feed(engine, block, &problems::INVERSE_G1, &problems::ZERO_FEED_G1)?;
    }
    engine.state.motion = block.motion;
    let end = ends::end(&engine.state, block)?;
    if block.motion == 0 {
        traverse(engine, end, block, at, sink)
    } else {
        feed(engine, end, block, at, sink)
    }
}
