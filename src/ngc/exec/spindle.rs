//! S, M3-M5, M19: per spindle of `$`.
use super::problems;
use crate::state::said;
use crate::{At, Block, Canon, Engine, Error, Problem, Sink, SpindleTurn};
use std::ops::Range;

/// The spindles of a block's `$`: all of them for -1, the first where there is none.
fn chosen(engine: &Engine, block: &Block, problem: &'static Problem) -> Result<Range<usize>, Error> {
    let count = engine.setup.spindles();
    match block.spindle {
        None => Ok(0..1),
        Some(-1) => Ok(0..count),
        Some(number) if engine.setup.has_spindle(number) => Ok(number as usize..number as usize + 1),
        Some(number) => {
            // S alone does it in one line
            let text = format!("{}\nnum_spindles ={count}. $={number}\n", problem.message);
            let short = *problem == problems::SPINDLE_RANGE;
            Err(if short {
                Error::new(problem, block.range)
            } else {
                Error::with(problem, block.range, text)
            })
        }
    }
}

/// S.
pub(crate) fn speed(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(speed) = block.word(b'S') else { return Ok(()) };
    engine.state.said |= said::SPEED;
    for spindle in chosen(engine, block, &problems::SPINDLE_RANGE)? {
        engine.state.speed[spindle] = speed;
        engine.emit(Canon::SpindleSpeed(spindle as i32, speed), at, sink);
    }
    Ok(())
}

/// M3, M4, M5, M19.
pub(crate) fn turn(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if block.m[7] >= 0 {
        engine.state.said |= said::SPINDLE;
    }
    match block.m[7] {
        3 => turn_to(
            engine,
            block,
            SpindleTurn::Clockwise,
            &problems::SPINDLE_RANGE_M3,
            at,
            sink,
        ),
        4 => turn_to(
            engine,
            block,
            SpindleTurn::CounterClockwise,
            &problems::SPINDLE_RANGE_M4,
            at,
            sink,
        ),
        5 => turn_to(engine, block, SpindleTurn::Stop, &problems::SPINDLE_RANGE_M5, at, sink),
        19 => orient(engine, block, at, sink),
        _ => Ok(()),
    }
}

fn turn_to(
    engine: &mut Engine,
    block: &Block,
    turn: SpindleTurn,
    problem: &'static Problem,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    for spindle in chosen(engine, block, problem)? {
        engine.state.turning[spindle] = match turn {
            SpindleTurn::Clockwise => 1,
            SpindleTurn::CounterClockwise => -1,
            SpindleTurn::Stop => 0,
        };
        engine.emit(Canon::Spindle(spindle as i32, turn), at, sink);
    }
    Ok(())
}

fn orient(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let angle = block.word(b'R').unwrap_or(0.0);
    let mode = block.word(b'P').unwrap_or(0.0).round();
    // it cannot turn all of them at once (-1)
    let number = block.spindle.unwrap_or(0);
    if !engine.setup.has_spindle(number) {
        return Err(Error::new(&problems::SPINDLE_RANGE_M19, block.range));
    }
    // the control takes all of them as stopped, whichever it turns
    engine.state.turning = [0; 8];
    if block.has(b'R') || block.has(b'P') {
        let angle = angle + engine.setup.orient_offset();
        engine.emit(Canon::OrientSpindle(number, angle, mode as i32), at, sink);
    }
    if let Some(timeout) = block.word(b'Q') {
        if timeout <= 0.0 {
            return Err(Error::new(&problems::M19_Q, block.range_of(b'Q')));
        }
        engine.emit(Canon::WaitOrient(number, timeout), at, sink);
    }
    Ok(())
}
