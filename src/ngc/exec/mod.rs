//! Runs one evaluated block: checks, modal changes, motion, stop, in the order of the control.
mod access;
mod arcs;
mod checks;
mod compensation;
mod end;
mod ends;
pub(crate) mod frame;
mod home;
mod made;
mod modal;
mod motion;
mod offsets;
mod outputs;
mod probe;
mod problems;
mod spindle;
mod tools;
mod unused;

use crate::{At, Block, Canon, Engine, Error, Side, Sink, comp, cycles, flow};
pub(crate) use access::G92_ON;
pub(crate) use end::start;
pub(crate) use ends::{cycle_end, end as end_of, word as axis_word};
pub(crate) use frame::to_machine;
pub(crate) use made::{made_arc, made_straight};
pub(crate) use motion::{code_range, inverse_time, length, traverse};

/// How a block ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum After {
    /// The program continues.
    Go,
    /// M2, M30.
    Ended,
}

/// Checks a block before it does anything; `block.motion` is filled in. The line's comment comes between this and
/// [`execute`].
pub(crate) fn check(engine: &Engine, block: &mut Block) -> Result<(), Error> {
    if !block.own.is_empty() {
        // what its words mean depends on the machine; a motion code next to M codes is still active after them
        if block.own.iter().all(|own| own.letter == b'M') {
            return checks::choose_motion(block, &engine.state);
        }
        return Ok(());
    }
    checks::codes(block)?;
    checks::modelled(block, &engine.state)?;
    checks::choose_motion(block, &engine.state)?;
    checks::check(block, &engine.state)
}

/// Runs one block that was checked. What was done before a refusal stays done, as on the control.
pub(crate) fn execute(engine: &mut Engine, block: &mut Block, at: At, sink: &mut dyn Sink) -> Result<After, Error> {
    engine.state.named_axes = named_axes(block);
    engine.state.machine_frame = matches!(block.g[0], 280 | 300 | 530);
    if !block.own.is_empty() {
        own_codes(engine, block, at, sink);
    }
    let only = block.is_motion_only();
    engine.state.motion_only = only && matches!(block.motion, 0 | 10) && engine.state.side == Side::Off;
    if only {
        return move_only(engine, block, at, sink);
    }
    modes(engine, block, at, sink)?;
    switches(engine, block, at, sink)?;
    if flow::context::run(engine, block, at, sink)? {
        // the rest of the block is lost, including its dwell
        engine.refresh_parameters();
        return Ok(After::Go);
    }
    if block.g[0] == 40 {
        engine.emit(Canon::Dwell(block.word(b'P').unwrap_or(0.0)), at, sink);
    }
    geometry(engine, block, at, sink)?;
    setting(engine, block, at, sink)?;
    move_tool(engine, block, at, sink)?;
    // after a change of the tool or its table the control asks where the machine is; in a check there is no answer
    let reloads = block.g[0] == 100 && block.word(b'L') == Some(0.0);
    if (matches!(block.m[6], 6 | 61) || reloads) && engine.setup.start == crate::Start::Zero {
        let told = engine.state.told.position;
        engine.state.current = told;
    }
    // a turning cycle goes into its subprogram from here, and stops of its block are lost
    let after = if engine.turning.as_ref().is_some_and(|turning| turning.is_called()) {
        After::Go
    } else {
        end::stop(engine, block, at, sink)?
    };
    engine.refresh_parameters();
    Ok(after)
}

/// The machine's own codes: emitted, with what they may leave active.
#[cold]
fn own_codes(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    engine.emit(Canon::OwnCodes(block.own.clone()), at, sink);
    for own in &block.own {
        let motion = engine.setup.own_motions.binary_search(&own.tenths).is_ok();
        // what a remap runs may leave a motion code in effect
        if own.letter == b'G' && (motion || engine.state.motion == 800) {
            engine.state.unmodelled = Some(own.tenths);
        }
    }
}

/// Whether a block is only a line (G0, G1) and its F: then [`check`] finds nothing, and [`line()`] does what [`execute`] would.
/// `block.motion` is filled in.
#[inline]
pub(crate) fn choose_line(engine: &Engine, block: &mut Block) -> bool {
    let state = &engine.state;
    let code = if block.g[1] >= 0 { block.g[1] } else { state.motion };
    let is_line = matches!(code, 0 | 10) && block.is_line_only();
    if is_line && state.unmodelled.is_none() && state.side == Side::Off {
        block.motion = code;
        if cfg!(debug_assertions) {
            let mut checked = block.clone();
            let found = check(engine, &mut checked);
            debug_assert!(found.is_ok() && checked.motion == code, "a line that the check refuses");
        }
        return true;
    }
    false
}

/// Runs a block that [`choose_line`] has chosen.
#[inline]
pub(crate) fn line(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<After, Error> {
    engine.state.named_axes = named_axes(block);
    engine.state.machine_frame = false;
    engine.state.motion_only = true;
    modal::feed_rate(engine, block, at, sink);
    // what `move_tool` does with a motion code and without G53
    engine.state.last_motion = engine.state.motion;
    motion::line(engine, block, at, sink)?;
    engine.refresh_parameters();
    Ok(After::Go)
}

/// A block with only a motion and its F: there is nothing for the other steps.
fn move_only(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<After, Error> {
    modal::feed_rate(engine, block, at, sink);
    move_tool(engine, block, at, sink)?;
    engine.refresh_parameters();
    Ok(After::Go)
}

/// Axes with words: bit i is axis i of a pose. Polar words move X and Y.
#[inline]
fn named_axes(block: &Block) -> u16 {
    let polar = u16::from(block.radius.is_some() || block.angle.is_some()) * 0b11;
    let letters = |first: u8| (block.given >> (first - b'A') & 0b111) as u16;
    letters(b'X') | letters(b'A') << 3 | letters(b'U') << 6 | polar
}

/// Feed mode, F, S, T.
fn modes(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    modal::spindle_mode(engine, block, at, sink)?;
    modal::feed_mode(engine, block, at, sink)?;
    modal::feed_rate(engine, block, at, sink);
    spindle::speed(engine, block, at, sink)?;
    tools::select(engine, block, at, sink)
}

/// M codes except the stops.
fn switches(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if block.m_count > 0 {
        outputs::signals(engine, block, at, sink)?;
        tools::change(engine, block, at, sink)?;
        spindle::turn(engine, block, at, sink)?;
        outputs::coolant(engine, block, at, sink);
        outputs::overrides(engine, block, at, sink)?;
        outputs::user(engine, block, at, sink)?;
    }
    Ok(())
}

/// Plane, units, compensation, offsets, path control, distance and retract modes.
fn geometry(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    modal::plane(engine, block, at, sink)?;
    modal::units(engine, block, at, sink);
    modal::diameters(engine, block, at, sink);
    compensation::run(engine, block, at, sink)?;
    tools::length(engine, block, at, sink)?;
    modal::coordinate_system(engine, block, at, sink)?;
    modal::control_mode(engine, block, at, sink)?;
    modal::distance(engine, block, at, sink);
    modal::arc_distance(engine, block, at, sink);
    modal::retract(engine, block, at, sink)?;
    Ok(())
}

/// G10, G28, G30, G52, G92.
fn setting(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    match block.g[0] {
        100 if matches!(block.word(b'L'), Some(2.0 | 20.0)) => offsets::coordinate_system(engine, block, at, sink),
        100 => tools::table(engine, block, at, sink),
        // the end of a spline is not a modal motion
        code @ (53 | 63) => cycles::run(engine, code, block, at, sink),
        280 | 281 | 300 | 301 => home::run(engine, block, at, sink),
        _ => offsets::axis_offsets(engine, block, at, sink),
    }
}

/// The motion of the block.
fn move_tool(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if block.g[0] == 530 && block.motion >= 0 && engine.state.side != Side::Off {
        return Err(Error::new(&problems::G53_COMPENSATION, block.g_range(0)));
    }
    engine.state.last_motion = engine.state.motion;
    match block.motion {
        -1 => Ok(()),
        0 | 10 => motion::straight(engine, block, at, sink),
        20 | 30 => arcs::run(engine, block, at, sink),
        382..=385 => probe::run(engine, block, at, sink),
        800 => {
            modal::remark(engine, "interpreter: motion mode set to none", at, sink);
            engine.state.motion = 800;
            Ok(())
        }
        code => cycles::run(engine, code, block, at, sink),
    }
}

/// Emits what compensation holds back.
fn flush(engine: &mut Engine, block: &Block, sink: &mut dyn Sink) -> Result<(), Error> {
    comp::flush(engine, block, sink)
}
