//! Compares the requests of two programs: each must be between the same motions, in the same order and state.
use super::ask::{Ask, Asked, Own, Why};
use super::coolants::{AtStop, Coolants, after_stop, after_tool_change};
use super::{Part, Reading};
use crate::Outcome;
use core::fmt;
use trunnion_dialect::PathMode;
use trunnion_interp::AllClampCodes;
use trunnion_syntax::{Address, BlockId, Format, LineIndex, Value, Word};

/// What a comparison may assume in addition to both texts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Terms<'a> {
    /// Requests that the user leaves out, by name (`M64`); only those that [`super::Why::may_be_dropped`].
    pub dropped: &'a [String],
    /// What own codes of the control mean in the program after, as its post says: the text of a request, and the request. `None`: it
    /// belongs to the header or footer of every program.
    pub meanings: &'a [(String, Option<Ask>)],
}

/// What must come between two motions, in order.
#[derive(Clone, Debug, PartialEq)]
enum Event {
    Stop {
        optional: bool,
        coolants: Coolants,
        turning: Turning,
    },
    /// A request of one control; `None`: by its number alone (AUXFUN).
    Own(String, Option<String>),
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stop { optional: true, .. } => f.write_str("an optional stop"),
            Self::Stop { .. } => f.write_str("a stop"),
            Self::Own(text, _) => f.write_str(text),
        }
    }
}

/// How the spindle turns: counter-clockwise, 1/min. `None`: it is stopped, or nothing was programmed.
type Turning = Option<(bool, Option<f64>)>;

/// Events with the block that requests each.
type Events = Vec<(Event, BlockId)>;

/// One program's requests while its motions are compared.
struct Side<'a> {
    reading: &'a Reading,
    next: usize,
    coolants: Coolants,
    path: Option<PathMode>,
    dropped: &'a [String],
    meanings: &'a [(String, Option<Ask>)],
    clamps: &'a AllClampCodes,
    /// It is the program after.
    written: bool,
    /// M0 stops the spindle.
    stop_ends_spindle: bool,
    /// What becomes of the coolant in a tool change, and in a stop.
    tool_change: AtStop,
    stop: AtStop,
    /// Blocks that were looked at for a tool change.
    blocks: usize,
}

/// Compares the requests of both programs.
///
/// # Errors
/// Refuted where a request is lost, added or in another place; unknown where not all requests of a program are known.
pub(super) fn same_requests(
    before: &Reading,
    after: &Reading,
    parts: &[Part],
    terms: &Terms<'_>,
) -> Result<(), Outcome> {
    for (reading, which) in [(before, "original"), (after, "converted")] {
        if let Some(block) = reading.elsewhere {
            let line = line(reading, block);
            return Err(Outcome::unknown(format!(
                "line {line} of the {which} program continues in another file, where only motions are compared"
            )));
        }
    }
    for (reading, which) in [(before, "original"), (after, "converted")] {
        let switch = |asked: &&Asked| matches!(&asked.ask, Ask::Own(own) if own.why == Why::Switch);
        if let Some(asked) = reading.asks.iter().find(switch) {
            let line = line(reading, asked.block);
            return Err(Outcome::unknown(format!(
                "line {line} of the {which} program: whether it runs depends on a switch"
            )));
        }
    }
    let mut was = Side::new(before, terms.dropped, &[], &after.clamp_codes, false);
    let mut is = Side::new(after, &[], terms.meanings, &after.clamp_codes, true);
    let (mut at_was, mut at_is) = (0, 0);
    for part in parts {
        match *part {
            Part::Left => at_was += 1,
            Part::Added(count) => at_is += count as usize,
            Part::Moves(_) | Part::Words => {
                let count = if let Part::Moves(count) = *part { count } else { 1 };
                both(&mut was, &mut is, at_was, at_is)?;
                at_was += 1;
                at_is += count as usize;
                if let Some(asked) = is.reading.asks.get(is.next).filter(|asked| asked.at < at_is) {
                    let line = line(after, asked.block);
                    return Err(Outcome::refuted_at(
                        at_is - 1,
                        line,
                        "a function runs in the middle of what was one motion".to_owned(),
                    ));
                }
            }
        }
    }
    both(&mut was, &mut is, usize::MAX, usize::MAX)
}

/// Compares what comes before the motions with these indices.
fn both(was: &mut Side<'_>, is: &mut Side<'_>, at_was: usize, at_is: usize) -> Result<(), Outcome> {
    let (old, new) = (was.until(at_was), is.until(at_is));
    let mut pairs = old.iter().zip(&new);
    let differs = pairs.find(|((one, _), (other, _))| !alike(one, other));
    let is_line = |block: Option<BlockId>| {
        let last = is.reading.motions.get(at_is).or(is.reading.motions.last());
        let block = block.or(last.map(|posed| posed.motion.block));
        block.map_or(0, |block| line(is.reading, block))
    };
    let refute = |block: Option<BlockId>, message: String| {
        Err(Outcome::refuted_at(
            at_is.min(is.reading.motions.len()),
            is_line(block),
            message,
        ))
    };
    if let Some(((one, old_block), (other, new_block))) = differs {
        let line = line(was.reading, *old_block);
        let (one, other) = (one.to_string(), other.to_string());
        let message = if one == other {
            format!(
                "at {one} (line {line} of the original) spindle or coolant are in another state than in the original"
            )
        } else {
            format!(
                "{other} takes the place of {one} (line {line} of the original), or spindle or coolant are in a different state there"
            )
        };
        return refute(Some(*new_block), message);
    }
    if let Some((lost, block)) = old.get(new.len()) {
        let line = line(was.reading, *block);
        return refute(None, format!("{lost} (line {line} of the original) is lost"));
    }
    if let Some((more, block)) = new.get(old.len()) {
        return refute(Some(*block), format!("{more} is added"));
    }
    // the end of a program switches all coolant off
    let ended = at_was >= was.reading.motions.len();
    if was.coolants != is.coolants && !ended {
        return refute(
            None,
            format!(
                "the coolant is {}, but the original program has {}",
                is.coolants, was.coolants
            ),
        );
    }
    if !ended && !follows_alike(was.path, is.path) {
        return refute(
            None,
            format!(
                "{}, but in the original program {}",
                path_words(is.path),
                path_words(was.path)
            ),
        );
    }
    Ok(())
}

/// Whether both programs demand the same of the end of a block. A permission to round corners need not be used: where no mode is programmed, the
/// control starts in its own.
fn follows_alike(was: Option<PathMode>, is: Option<PathMode>) -> bool {
    let demand = |mode: Option<PathMode>| mode.filter(|mode| *mode != PathMode::Continuous);
    match (was, is) {
        (Some(was), Some(is)) => was == is,
        (was, is) => demand(was) == demand(is),
    }
}

fn path_words(mode: Option<PathMode>) -> &'static str {
    match mode {
        None => "no mode of path control is programmed",
        Some(PathMode::ExactStop) => "the axes stop at the end of every block",
        Some(PathMode::ExactPath) => "the tool follows the path exactly",
        Some(PathMode::Continuous) => "the control may round corners",
    }
}

fn alike(one: &Event, other: &Event) -> bool {
    match (one, other) {
        (
            Event::Stop {
                optional,
                coolants,
                turning,
            },
            Event::Stop {
                optional: other_optional,
                coolants: other_coolants,
                turning: other_turning,
            },
        ) => {
            let turns = match (turning, other_turning) {
                (Some((ccw, rpm)), Some((other_ccw, other_rpm))) => {
                    let speeds = match (rpm, other_rpm) {
                        (Some(rpm), Some(other)) => (rpm - other).abs() <= 5e-4,
                        (None, None) => true,
                        _ => false,
                    };
                    ccw == other_ccw && speeds
                }
                (None, None) => true,
                _ => false,
            };
            optional == other_optional && coolants == other_coolants && turns
        }
        // the same text means something else on another control
        (Event::Own(one, of), Event::Own(other, other_of)) => {
            one == other && (of == other_of || of.is_none() || other_of.is_none())
        }
        _ => false,
    }
}

impl<'a> Side<'a> {
    fn new(
        reading: &'a Reading,
        dropped: &'a [String],
        meanings: &'a [(String, Option<Ask>)],
        clamps: &'a AllClampCodes,
        written: bool,
    ) -> Self {
        Self {
            reading,
            next: 0,
            coolants: Coolants::default(),
            path: None,
            dropped,
            meanings,
            clamps,
            written,
            tool_change: after_tool_change(reading),
            stop: after_stop(reading),
            blocks: 0,
            stop_ends_spindle: reading.program.options().format == Format::Klartext
                || trunnion_dialect::builtin(&reading.dialect)
                    .is_some_and(|dialect| dialect.quirks.program_stop_stops_spindle),
        }
    }

    /// Runs all requests before the motion with this index.
    fn until(&mut self, motion: usize) -> Events {
        let mut events = Vec::new();
        while let Some(asked) = self.reading.asks.get(self.next).filter(|asked| asked.at <= motion) {
            self.next += 1;
            self.change_tools(asked.ran + 1);
            self.hear(&asked.ask, asked.ran, &mut events);
        }
        let done = self.reading.blocks.partition_point(|ran| ran.motions <= motion);
        self.change_tools(done);
        events
    }

    /// Tool changes in the blocks before this one.
    fn change_tools(&mut self, before: usize) {
        let reading = self.reading;
        let blocks = &reading.blocks;
        for at in self.blocks.max(1)..before.min(blocks.len()) {
            if blocks[at].tool != blocks[at - 1].tool {
                self.coolants.stopped(self.tool_change);
            }
        }
        self.blocks = self.blocks.max(before);
    }

    fn hear(&mut self, ask: &Ask, ran: usize, events: &mut Events) {
        match ask {
            Ask::Coolant(coolant) => self.coolants.set(*coolant),
            Ask::Stop { optional } => {
                let stop = Event::Stop {
                    optional: *optional,
                    coolants: self.coolants,
                    turning: self.turning_at_stop(ran),
                };
                if !self.changes_tool_by_hand(ran) {
                    events.push((stop, self.reading.blocks[ran].block));
                }
                // an optional stop may not come
                let stop = if *optional { self.stop.perhaps() } else { self.stop };
                self.coolants.stopped(stop);
            }
            // where the program after has clamps of its own, they are judged by what its axes do
            Ask::Clamp(name) if *self.clamps == AllClampCodes::default() => self.own(name, name, true, ran, events),
            Ask::Path { name, .. } if self.drops(name) => {}
            Ask::Path { mode, .. } => self.path = Some(*mode),
            Ask::Idle(_) | Ask::Clamp(_) => {}
            Ask::Auxiliary(number) => self.auxiliary(*number, ran, events),
            Ask::Own(Own { name, text, why }) => {
                if let Some((_, meaning)) = self.meanings.iter().find(|(known, _)| known == text) {
                    if let Some(ask) = meaning.clone() {
                        self.hear(&ask, ran, events);
                    }
                    return;
                }
                // its tolerances are lengths in the unit of the program
                let inch = *why == Why::PathControl && self.reading.blocks[ran].unit_mm > 1.0;
                let text = if inch {
                    format!("{text} in inches")
                } else {
                    text.clone()
                };
                self.own(name, &text, why.may_be_dropped(), ran, events);
            }
        }
    }

    fn drops(&self, name: &str) -> bool {
        self.dropped.iter().any(|drop| drop.eq_ignore_ascii_case(name))
    }

    fn own(&self, name: &str, text: &str, may_drop: bool, ran: usize, events: &mut Events) {
        if !(may_drop && self.drops(name)) {
            let own = Event::Own(text.to_owned(), Some(self.reading.dialect.clone()));
            events.push((own, self.reading.blocks[ran].block));
        }
    }

    /// An M code by its number: what it is called on the control for which it is written.
    fn auxiliary(&self, number: u32, ran: usize, events: &mut Events) {
        let is = |code: u16| u32::from(code) == number;
        if !self.clamps.iter().flatten().any(|codes| is(codes.on) || is(codes.off)) {
            events.push((Event::Own(format!("M{number}"), None), self.reading.blocks[ran].block));
        }
    }

    /// Whether a stop only lets the operator change the tool, on a control that cannot: it follows the block with the tool's number.
    fn changes_tool_by_hand(&self, ran: usize) -> bool {
        let Some(before) = ran
            .checked_sub(1)
            .filter(|_| self.written && !self.reading.changes_tools)
        else {
            return false;
        };
        let program = &self.reading.program;
        let mut words = program.block(self.reading.blocks[before].block).words();
        words.any(|word| word.address == Address::Letter(b'T'))
    }

    /// How it turned when the stop of a block came, which may have ended it.
    fn turning_at_stop(&self, ran: usize) -> Turning {
        let block = self.reading.program.block(self.reading.blocks[ran].block);
        let is_m5 = |word: Word| {
            word.address == Address::Letter(b'M')
                && matches!(word.value, Value::Number(number) if number.to_f64() == 5.0)
        };
        let ends = self.stop_ends_spindle && !block.words().any(is_m5);
        self.turning(if ends { ran.saturating_sub(1) } else { ran })
    }

    /// The spindle after a block.
    fn turning(&self, ran: usize) -> Turning {
        let ran = &self.reading.blocks[ran];
        let turns = ran.spindle_on == Some(true) || ran.spindle_left;
        turns.then(|| (ran.counter_clockwise.unwrap_or(false), ran.spindle_rpm))
    }
}

fn line(reading: &Reading, block: BlockId) -> u32 {
    let source = reading.program.source();
    let start = reading.program.block(block).range().start;
    LineIndex::new(source).line_column(source, start).0
}
