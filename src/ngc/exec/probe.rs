//! G38.2-G38.5: straight probing.
use super::{ends, motion, problems};
use crate::{At, Block, Canon, Engine, Error, FeedMode, Pose, Side, Sink};

/// How far short of the programmed end the listing of `rs274` leaves the tool, mm: it has no machine that could touch anything.
const SHORT_MM: f64 = 0.254;

/// G38.2-G38.5.
pub(crate) fn run(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let state = &engine.state;
    if state.side != Side::Off {
        return Err(Error::new(&problems::PROBE_COMPENSATION, block.g_range(1)));
    }
    if state.feed_rate == 0.0 || state.feed_mode == FeedMode::InverseTime {
        return Err(Error::new(&problems::ZERO_FEED_PROBE, motion::code_range(block)));
    }
    if state.feed_mode == FeedMode::PerRevolution {
        return Err(Error::new(&problems::PROBE_PER_REV, motion::code_range(block)));
    }
    let end = ends::end(state, block)?;
    if end == state.current {
        return Err(Error::new(&problems::PROBE_TOO_CLOSE, motion::code_range(block)));
    }
    engine.state.motion = block.motion;
    engine.emit(Canon::Probe((block.motion - 380) as u8, end), at, sink);
    engine.state.probed = true;
    let unknown = engine.setup.start == crate::Start::Unknown;
    let touched = if unknown {
        unknown_along(&engine.state.current, &end)
    } else {
        short_of(&engine.state.told.position, &end, SHORT_MM / engine.state.units.mm())
    };
    if unknown {
        // G38.2 and G38.4 stop the program where nothing was found (LinuxCNC documentation, G38.n): after them it was
        let must_find = matches!(block.motion, 382 | 384);
        engine.set_parameter(5070, if must_find { 1.0 } else { f64::NAN });
    }
    // the listing of rs274 stores the programmed end; on the machine it is where the probe touched
    let stored = if unknown { touched } else { end };
    for (axis, value) in stored.into_iter().enumerate() {
        let wrapped = ends::is_wrapped(&engine.state, axis);
        engine.set_parameter(5061 + axis, if wrapped { value.rem_euclid(360.0) } else { value });
    }
    engine.state.current = touched;
    engine.state.told.reach(&touched);
    engine.emit(Canon::ProbeResult, at, sink);
    Ok(())
}

/// Axes that move end anywhere.
fn unknown_along(from: &Pose, to: &Pose) -> Pose {
    std::array::from_fn(|axis| if from[axis] == to[axis] { to[axis] } else { f64::NAN })
}

/// The end, drawn back along X Y Z.
fn short_of(from: &Pose, to: &Pose, by: f64) -> Pose {
    let length = (0..3).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt();
    let back = if length > 0.0 { by / length } else { 0.0 };
    std::array::from_fn(|axis| {
        if axis < 3 {
            to[axis] - (to[axis] - from[axis]) * back
        } else {
            to[axis]
        }
    })
}
