//! Outputs and inputs (M62-M68), override switches (M48-M53), coolant, user M codes.
use super::problems;
use crate::state::said;
use crate::{At, Block, Canon, Coolant, Engine, Error, Side, Sink, Switch};

/// M62-M68.
pub(crate) fn signals(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let code = block.m[5];
    let held = match code {
        62 => Some(&problems::M62_COMPENSATION),
        63 => Some(&problems::M63_COMPENSATION),
        64 | 65 => Some(&problems::M64_COMPENSATION),
        67 => Some(&problems::M67_COMPENSATION),
        68 => Some(&problems::M68_COMPENSATION),
        _ => None,
    };
    if let Some(problem) = held.filter(|_| engine.state.side != Side::Off) {
        return Err(Error::new(problem, block.m_range(5)));
    }
    let no_output = match code {
        62 => Some(&problems::M62_P),
        63 => Some(&problems::M63_P),
        64 => Some(&problems::M64_P),
        65 => Some(&problems::M65_P),
        _ => None,
    };
    if let Some(problem) = no_output.filter(|_| !block.has(b'P')) {
        return Err(Error::new(problem, block.m_range(5)));
    }
    match code {
        62..=65 => {
            let index = block.word(b'P').unwrap_or(0.0).round_ties_even() as i32;
            let call = Canon::DigitalOutput {
                index,
                on: code == 62 || code == 64,
                with_motion: code <= 63,
            };
            engine.emit(call, at, sink);
        }
        66 => wait(engine, block, at, sink)?,
        67 | 68 => {
            let problem = if code == 67 { &problems::M67_E } else { &problems::M68_E };
            let index = block.word(b'E').map_or(-1, |e| e.round_ties_even() as i32);
            if index < 0 {
                return Err(Error::new(problem, block.m_range(5)));
            }
            let call = Canon::AnalogOutput {
                index,
                value: block.word(b'Q').unwrap_or(-1.0),
                with_motion: code == 67,
            };
            engine.emit(call, at, sink);
        }
        _ => {}
    }
    Ok(())
}

/// M66: what is read is put into parameter 5399; only the machine knows it.
fn wait(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let range = block.m_range(5);
    let digital = block.word(b'P').map(f64::round_ties_even);
    let analog = block.word(b'E').map(f64::round_ties_even);
    if digital.is_some() && analog.is_some() {
        return Err(Error::new(&problems::M66_BOTH, range));
    }
    let until = block.word(b'L').map_or(0, |l| l as i32);
    let timeout = block.word(b'Q').unwrap_or(-1.0);
    if until > 0 && timeout <= 0.0 {
        return Err(Error::new(&problems::M66_TIMEOUT, range));
    }
    if analog.is_some() && until != 0 {
        return Err(Error::new(&problems::M66_ANALOG, range));
    }
    let (Some(index), analog) = (
        digital.or(analog).filter(|&index| index.is_nan() || index >= 0.0),
        analog.is_some(),
    ) else {
        return Err(Error::new(&problems::M66_NONE, range));
    };
    if engine.state.side != Side::Off {
        return Err(Error::new(&problems::M66_COMPENSATION, range));
    }
    let call = Canon::WaitInput {
        index: index as i32,
        analog,
        until,
        timeout,
    };
    engine.emit(call, at, sink);
    let read = engine.unknown(0.0);
    engine.set_parameter(5399, read);
    Ok(())
}

/// M7, M8, M9.
pub(crate) fn coolant(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    if block.m[8] >= 0 {
        engine.state.said |= said::COOLANT;
    }
    match block.m[8] {
        7 => {
            engine.state.mist = true;
            engine.emit(Canon::Coolant(Coolant::MistOn), at, sink);
        }
        8 => {
            engine.state.flood = true;
            engine.emit(Canon::Coolant(Coolant::FloodOn), at, sink);
        }
        9 => {
            engine.state.mist = false;
            engine.state.flood = false;
            engine.emit(Canon::Coolant(Coolant::MistOff), at, sink);
            engine.emit(Canon::Coolant(Coolant::FloodOff), at, sink);
        }
        _ => {}
    }
}

/// M48-M53.
pub(crate) fn overrides(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    // without P, or with any P but 0, the switch is on
    let on = block.word(b'P').is_none_or(|p| p != 0.0);
    let spindles = engine.setup.spindles() as i32;
    // M51 takes one spindle, but not the first, and without $ all of them
    let chosen = block.spindle.filter(|_| block.m[9] == 51);
    if chosen.is_some_and(|spindle| spindle == 0 || !engine.setup.has_spindle(spindle)) {
        return Err(Error::new(&problems::SPINDLE_RANGE_M51, block.range));
    }
    let code = block.m[9];
    if code >= 0 && engine.state.side != Side::Off {
        let enables = code == 48 || code != 49 && on;
        let problem = if enables {
            &problems::ENABLE_COMPENSATION
        } else {
            &problems::DISABLE_COMPENSATION
        };
        return Err(Error::new(problem, block.m_range(9)));
    }
    match code {
        48 | 49 => {
            let on = code == 48;
            engine.state.feed_override = on;
            engine.state.speed_override = on;
            engine.emit(Canon::Switch(Switch::FeedOverride, on), at, sink);
            for spindle in 0..spindles {
                engine.emit(Canon::Switch(Switch::SpeedOverride(spindle), on), at, sink);
            }
        }
        50 => {
            engine.state.feed_override = on;
            engine.emit(Canon::Switch(Switch::FeedOverride, on), at, sink);
        }
        51 => {
            if chosen.is_none() {
                engine.state.speed_override = on;
            }
            for spindle in chosen.map_or(0..spindles, |spindle| spindle..spindle + 1) {
                engine.emit(Canon::Switch(Switch::SpeedOverride(spindle), on), at, sink);
            }
        }
        52 => {
            engine.state.adaptive_feed = on;
            engine.emit(Canon::Switch(Switch::AdaptiveFeed, on), at, sink);
        }
        53 => {
            engine.state.feed_hold = on;
            engine.emit(Canon::Switch(Switch::FeedHold, on), at, sink);
        }
        _ => {}
    }
    Ok(())
}

/// M100-M199.
pub(crate) fn user(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if let Some(code) = block.m_code(10) {
        if !engine.setup.user_codes {
            let text = problems::UNKNOWN_M.message.replace("{}", &code.to_string());
            return Err(Error::with(&problems::UNKNOWN_M, block.m_range(10), text));
        }
        let word = |letter| block.word(letter).unwrap_or(-1.0);
        engine.emit(Canon::UserCode(i32::from(code), word(b'P'), word(b'Q')), at, sink);
    }
    Ok(())
}
