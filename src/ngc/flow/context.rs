//! M70 to M73: the modal state is saved and restored. Only what differs is restored, by a block of the codes that set it, so that
//! the machine is commanded in the order and with the quirks of the control: M51 is restored as on, F 0 stays if G94 has cleared it.
use crate::exec;
use crate::{
    At, Block, DistanceMode, Engine, Error, FeedMode, MotionMode, Plane, RetractMode, Side, Sink, SpindleMode, State,
};
use crate::{Problem, Units};
use std::fmt::Write;
use trunnion_syntax::TextRange;

use super::problems;

/// A saved modal state.
#[derive(Clone, Debug)]
pub(crate) struct Context {
    state: State,
    /// Parameter 5210: G92 is on, whatever its offsets are.
    axis_offset_on: bool,
    /// M73: restored when the call ends.
    auto: bool,
}

/// M70 to M73 of a block. `true`: something was restored, and the rest of the block is gone with it.
///
/// # Errors
/// Nothing was saved at this level of calls, or a code cannot be restored.
pub(crate) fn run(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<bool, Error> {
    let range = block.m_range(7);
    match block.m[7] {
        code @ (70 | 73) => {
            let context = Context {
                // no tool is restored: a shared table would be copied by the next change
                state: State {
                    tools: std::sync::Arc::default(),
                    ..engine.state.clone()
                },
                axis_offset_on: axis_offset_on(engine),
                auto: code == 73,
            };
            *engine.flow.saved() = Some(Box::new(context));
        }
        71 => *engine.flow.saved() = None,
        72 => {
            let Some(context) = engine.flow.saved().clone() else {
                return Err(Error::new(&problems::NO_CONTEXT, range));
            };
            return to(engine, &context, range, at, sink);
        }
        _ => {}
    }
    Ok(false)
}

/// The end of a call: what M73 saved is restored.
pub(super) fn restore_after_call(engine: &mut Engine, context: &Context, sink: &mut dyn Sink) -> Result<(), Error> {
    if !context.auto {
        return Ok(());
    }
    let at = engine.at();
    let range = engine.files[at.file.0 as usize].line(at.line).unwrap_or_default();
    to(engine, context, range, at, sink).map(drop)
}

/// Blocks that set what differs.
fn to(engine: &mut Engine, context: &Context, range: TextRange, at: At, sink: &mut dyn Sink) -> Result<bool, Error> {
    let saved = &context.state;
    let mut any = false;
    let mut run = |engine: &mut Engine, block: Option<Block>| -> Result<(), Error> {
        let Some(mut block) = block else { return Ok(()) };
        any = true;
        exec::check(engine, &mut block).map_err(|error| failed(&error, &block))?;
        match exec::execute(engine, &mut block, at, sink) {
            Ok(_) => Ok(()),
            Err(error) => Err(failed(&error, &block)),
        }
    };
    let units = unit_code(saved);
    let block = (units != unit_code(&engine.state)).then(|| with_g(range, &[(6, units)]));
    run(engine, block)?;
    let g92 = [context.axis_offset_on, axis_offset_on(engine)];
    let mut block = modes(&engine.state, saved, g92, range);
    let mut changed = switches(&engine.state, saved)
        .into_iter()
        .filter_map(|(group, [wanted, now])| (wanted != now && wanted >= 0).then_some((group, wanted)))
        .collect::<Vec<_>>()
        .into_iter();
    // one M code fits into the block of G codes
    if let Some(block) = block.as_mut().filter(|block| block.m_count == 0)
        && let Some((group, code)) = changed.next()
    {
        block.put_m(group, code, range);
        block.m_count = 1;
        if block.g[13] == path_code(MotionMode::Continuous(0.0)) && !block.has(b'P') {
            // P of G64 is P of the M code, too: M50 to M53 switch off
            put(block, b'P', 0.0, range);
        }
    }
    run(engine, block)?;
    for (group, code) in changed {
        run(engine, Some(with_m(range, group, code)))?;
    }
    Ok(any)
}

fn axis_offset_on(engine: &Engine) -> bool {
    engine.parameter(exec::G92_ON) != 0.0
}

/// One block of G codes, F, S and the spindle's direction: what differs.
fn modes(now: &State, saved: &State, g92: [bool; 2], range: TextRange) -> Option<Block> {
    let mut block = Block::new();
    block.clear(range);
    let (wanted, present) = (codes(saved), codes(now));
    let mut any = false;
    for ((group, code), (_, other)) in wanted.into_iter().zip(present) {
        if code != other {
            block.put_g(group, code, range);
            any = true;
        }
    }
    if g92[0] != g92[1] {
        // G92 comes back by G92.2 or G92.3
        block.put_g(16, if g92[0] { 923 } else { 922 }, range);
        any = true;
    }
    if saved.motion_mode != now.motion_mode || saved.naive_tolerance.to_bits() != now.naive_tolerance.to_bits() {
        block.put_g(13, path_code(saved.motion_mode), range);
        if let MotionMode::Continuous(tolerance) = saved.motion_mode {
            for (letter, value) in [(b'P', tolerance), (b'Q', saved.naive_tolerance)] {
                if value != 0.0 {
                    put(&mut block, letter, value, range);
                }
            }
        }
        any = true;
    }
    if differs(saved.feed_rate, now.feed_rate) {
        put(&mut block, b'F', rounded(saved.feed_rate, 1), range);
        any = true;
    }
    if differs(saved.speed[0], now.speed[0]) {
        put(&mut block, b'S', rounded(saved.speed[0], 0), range);
        any = true;
    }
    let turn = |state: &State| match state.turning[0] {
        0 => 5,
        1 => 3,
        _ => 4,
    };
    if turn(saved) != turn(now) {
        block.put_m(7, turn(saved), range);
        block.m_count = 1;
        any = true;
    }
    any.then_some(block)
}

/// The control writes the block as text: F with one decimal, S with none. Restored values are rounded like that on the machine, too.
fn rounded(value: f64, decimals: usize) -> f64 {
    format!("{value:.decimals$}").parse().unwrap_or(value)
}

/// Whether two numbers differ; two unknown numbers are equal.
fn differs(a: f64, b: f64) -> bool {
    a != b && !(a.is_nan() && b.is_nan())
}

/// The codes of a state, by group.
fn codes(state: &State) -> [(usize, i16); 10] {
    [
        (2, plane_code(state.plane)),
        (
            3,
            if state.distance == DistanceMode::Absolute {
                900
            } else {
                910
            },
        ),
        (
            4,
            if state.arc_distance == DistanceMode::Absolute {
                901
            } else {
                911
            },
        ),
        (
            5,
            match state.feed_mode {
                FeedMode::InverseTime => 930,
                FeedMode::PerMinute => 940,
                FeedMode::PerRevolution => 950,
            },
        ),
        (
            7,
            match state.side {
                Side::Off => 400,
                Side::Left => 410,
                Side::Right => 420,
            },
        ),
        (
            8,
            if state.tool_offset.iter().all(|&offset| offset == 0.0) {
                490
            } else {
                430
            },
        ),
        (10, if state.retract == RetractMode::OldZ { 980 } else { 990 }),
        (12, system_code(state.origin_index)),
        (
            14,
            if matches!(state.spindle_mode[0], SpindleMode::ConstantRpm) {
                970
            } else {
                960
            },
        ),
        (15, if state.lathe_diameter { 70 } else { 80 }),
    ]
}

fn unit_code(state: &State) -> i16 {
    if state.units == Units::Inch { 200 } else { 210 }
}

fn plane_code(plane: Plane) -> i16 {
    match plane {
        Plane::Xy => 170,
        Plane::Xz => 180,
        Plane::Yz => 190,
        Plane::Uv => 171,
        Plane::Uw => 181,
        Plane::Vw => 191,
    }
}

/// G54 to G59.3; where the system is not known it is left alone.
fn system_code(index: i32) -> i16 {
    match index {
        1..=6 => 530 + 10 * index as i16,
        7..=9 => 584 + index as i16,
        _ => -1,
    }
}

fn path_code(mode: MotionMode) -> i16 {
    match mode {
        MotionMode::ExactPath => 610,
        MotionMode::ExactStop => 611,
        MotionMode::Continuous(_) => 640,
    }
}

/// M codes of coolant and overrides: group, and the code that is wanted and the active one; -1: none shows it.
fn switches(now: &State, saved: &State) -> [(usize, [i16; 2]); 5] {
    let mist = |state: &State| match (state.mist, state.flood) {
        (true, _) => 7,
        (false, true) => -1,
        (false, false) => 9,
    };
    let flood = |state: &State| if state.flood { 8 } else { -1 };
    // M51 is what the control restores for every state without feed override
    let overrides = |state: &State| if state.feed_override { 48 } else { 51 };
    let adaptive = |state: &State| if state.adaptive_feed { 52 } else { -1 };
    let hold = |state: &State| if state.feed_hold { 53 } else { -1 };
    [
        (8, [mist(saved), mist(now)]),
        (8, [flood(saved), flood(now)]),
        (9, [overrides(saved), overrides(now)]),
        (9, [adaptive(saved), adaptive(now)]),
        (9, [hold(saved), hold(now)]),
    ]
}

fn with_g(range: TextRange, codes: &[(usize, i16)]) -> Block {
    let mut block = Block::new();
    block.clear(range);
    for &(group, code) in codes {
        block.put_g(group, code, range);
    }
    block
}

fn with_m(range: TextRange, group: usize, code: i16) -> Block {
    let mut block = with_g(range, &[]);
    block.put_m(group, code, range);
    block.m_count = 1;
    block
}

fn put(block: &mut Block, letter: u8, value: f64, range: TextRange) {
    let place = letter - b'A';
    block.given |= 1 << place;
    block.words[usize::from(place)] = value;
    block.ranges[usize::from(place)] = range;
}

/// A restoring block was refused: the control shows the block's text.
fn failed(error: &Error, block: &Block) -> Error {
    let mut text = String::new();
    for code in block.g.iter().filter(|&&code| code >= 0) {
        let (whole, tenth) = (code / 10, code % 10);
        // writing to a string does not fail
        let _ = if tenth == 0 {
            write!(text, " G{whole}")
        } else {
            write!(text, " G{whole}.{tenth}")
        };
    }
    let problem: &'static Problem = error.problem;
    let detail = format!("M7x: restore_settings failed executing: '{text}': {}", error.message());
    Error::with(problem, error.range, detail)
}
