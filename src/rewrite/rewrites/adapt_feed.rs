//! Writes the feed that the axes allow, where the programmed one asks for more.
//!
//! # Why
//! Near the pole, or far from the rotary axes, a feed that looks harmless demands more than the highest speed of an axis; on a small arc it demands more than its
//! acceleration. Some controls slow down,
//! some stop with an alarm, and some leave the path. A feed that the axes can follow is the same on every control, and the time of
//! the program is then known.
//!
//! # How
//! In each cut the highest feed at which no axis exceeds its speed, nor needs more than its acceleration in a bend, is computed over the whole block, in the
//! model of the planner behind `stats --time`. Where the programmed feed is
//! higher, the block gets the highest feed that the digits of an F word can say below the limit, and the next block that allows more gets its own feed
//! back. Under inverse time (G93) the block gets the shortest time that the axes need. With `--feed` a cut that is slower than
//! asked is made as fast as the axes allow, up to that feed.
//!
//! # Example
//! ```gcode before sinumerik-840d mikron-ucp710
//! TRAORI
//! G0 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 S8000 M3
//! N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822 F2000
//! N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
//! N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086
//! N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
//! M30
//! ```
//! ```gcode after
//! TRAORI
//! G0 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 S8000 M3
//! N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822 F1506
//! N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595 F46
//! N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086 F33
//! N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905 F892
//! M30
//! ```
//!
//! # Claim
//! The programs do the same except for the feeds of cuts. No feed is higher than before (or than `--feed`), a feed is lower only where an axis would exceed its
//! highest speed or, in a bend, its acceleration, and no axis does with a feed that was changed.
//!
//! # Traps
//! - A lower feed changes the load of the tooth and may rub; a path around the pole (`smooth-pole`, `switch-angles`) is better where it
//!   exists. `fix` applies this rewrite last.
//! - The acceleration along the path is not considered: a short block may not reach its feed whatever F says. `stats --time` shows where.
//! - Axes whose acceleration is not declared limit no bend.
//! - Taps, threads and boring cycles keep their feed: it belongs to the speed of the spindle. `--feed` does not raise the feed of drilling cycles.
//! - `--feed` makes plunges with G1 faster too: name the lines with `--lines`.
//! - Where a parameter of the control decides what F means (Fanuc and Haas without tool centre point control while rotary axes move), the feed
//!   stays until `[control] feed` of the machine file declares it.
//! - Feeds per revolution, feeds of motions of rotary axes alone, and F words with expressions are left as they are.
//!
//! # Sources
//! docs/kinematics.md#axis-speed-and-feed, docs/kinematics.md#time.
use super::Body;
use crate::pitch::Pitches;
use crate::style::{NumberStyle, blank_before_f, end_of_words};
use crate::{Change, Known, Options, Place, Proposal, Proposed, Refusal};
use trunnion_certify::Claim;
use trunnion_check::{Assume, Settings};
use trunnion_dialect::{Action, RotaryFeed};
use trunnion_interp::{Fault, Feed, Interpreter, ModalState, Motion, Placed, Sink};
use trunnion_machine::{Follower, Machine, feed_is_ambiguous, feed_limit_tight, leads_tip, shortest_time, turns};
use trunnion_planner::bend_limit;
use trunnion_syntax::{Address, BlockId, Program, TextEdit, TextRange, Value};

pub(super) const REWRITE: Body = Body {
    cures: &["axis-overspeed", "feed-drop", "axis-acceleration"],
    writes: Some("F words of blocks"),
    propose,
};

/// Most decimals of a feed that is written.
const MOST_DECIMALS: usize = 3;

/// What the axes allow in a block.
#[derive(Clone, Copy, Debug)]
struct Cut {
    block: BlockId,
    /// G93.
    inverse: bool,
    /// F as programmed: mm/min, or blocks per minute.
    feed: f64,
    /// The highest F that the axes allow, in the same unit; none where that is unknown.
    limit: Option<f64>,
    /// The F that is asked for, in the same unit.
    asked: f64,
    /// What the limit depends on and nobody declares.
    missing: Option<&'static str>,
}

/// The meaning of F.
const MEANING: &str = "what F means while rotary axes move is a parameter of the control: declare [control] feed = \"xyz\" or \"combined\" in the machine file";

/// Zero points and tool lengths.
const ZEROS: &str = "how fast the linear axes run while rotary axes turn depends on work offset and tool length, which are not declared: declare them in \
                     trunnion.toml or take them as zero with --assume work-offset,tool-length";

struct Collector<'m> {
    machine: &'m Machine,
    follower: Follower<'m>,
    rotary_feed: RotaryFeed,
    assume: Assume,
    asked_mm_min: f64,
    pitches: Pitches,
    cuts: Vec<Cut>,
}

impl Sink for Collector<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        if self.pitches.holds(motion.effects) {
            return;
        }
        // the feed of a drill is not that of a path
        let drills = state.motion.is_some_and(Action::is_hole_cycle);
        let asked_mm_min = if drills { 0.0 } else { self.asked_mm_min };
        let left = self.assume.leaves(motion.undeclared);
        let missing = if feed_is_ambiguous(self.machine, self.rotary_feed, &leg) {
            Some(MEANING)
        } else {
            ((left.zero & 0b111 != 0 || left.length) && leads_tip(motion) && turns(&leg)).then_some(ZEROS)
        };
        let bends = bend_limit(self.machine, &leg).map_or(f64::INFINITY, |(feed, _)| feed);
        let cut = match motion.feed {
            _ if !motion.is_feed() => return,
            Feed::PerMinute(feed) => Cut {
                block: motion.block,
                inverse: false,
                feed,
                limit: feed_limit_tight(self.machine, &leg).map(|limit| limit.feed_mm_min.min(bends)),
                asked: asked_mm_min,
                missing,
            },
            Feed::InverseTime(feed) => Cut {
                block: motion.block,
                inverse: true,
                feed,
                limit: shortest_time(self.machine, &leg, 0.0)
                    .map(|time| (60.0 / time.seconds).min(bends / leg.length.max(f64::MIN_POSITIVE))),
                asked: if leg.length > 0.0 {
                    asked_mm_min / leg.length
                } else {
                    0.0
                },
                missing,
            },
            Feed::PerRevolution(_) | Feed::Unknown | Feed::Rapid => return,
        };
        // a cycle makes several cuts in one block, and its F is for all of them
        match self.cuts.last_mut().filter(|last| last.block == cut.block) {
            Some(last) => {
                last.limit = last.limit.zip(cut.limit).map(|(a, b)| a.min(b));
                last.asked = last.asked.min(cut.asked);
                last.missing = last.missing.or(cut.missing);
                if last.inverse != cut.inverse || last.feed != cut.feed {
                    last.limit = None;
                }
            }
            None => self.cuts.push(cut),
        }
    }
    fn effect(&mut self, placed: Placed) {
        self.pitches.take(&placed);
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, _: &Known) -> Proposed {
    let Some(machine) = settings.machine else {
        return Err("no machine is named, and feeds depend on its axes (--machine)".into());
    };
    let mut collector = Collector {
        machine,
        follower: Follower::new(machine),
        rotary_feed: settings.dialect.advice.rotary_feed,
        assume: settings.assume,
        asked_mm_min: options.feed_mm_min,
        pitches: Pitches::default(),
        cuts: Vec::new(),
    };
    let mut interpreter = Interpreter::new(settings.dialect, &settings.setup);
    interpreter.watch_effects();
    while interpreter.advance(program, &mut collector).is_some() {}
    let mut writer = Writer::new(program);
    for cut in &collector.cuts {
        writer.cut(cut);
    }
    let changed = writer.changed;
    let places = writer.finish();
    if places.is_empty() {
        return Ok(None);
    }
    if !places.iter().any(|place| matches!(place.change, Change::Edits(_))) {
        return Err(Refusal::Places(places));
    }
    Ok(Some(Proposal {
        places,
        claim: Claim::AdaptedFeed {
            tolerance_mm: options.tolerance_mm.min(1e-6),
            tolerance_deg: options.tolerance_deg.min(1e-6),
            asked_mm_min: options.feed_mm_min,
        },
        summary: format!("{changed} blocks get the feed that the axes allow"),
    }))
}

/// Writes feeds into a program.
struct Writer<'a> {
    program: &'a Program,
    style: NumberStyle,
    /// The next block whose F word is not yet read.
    next: u32,
    /// The F word in effect in the program before, and in the one after; none before the first, and after one that is no number.
    current: [Option<f64>; 2],
    /// The F word in effect in the program before has a decimal point: without one it may be another number on the same control.
    pointed: bool,
    /// The place that is open: its blocks and edits so far.
    open: Option<Place>,
    places: Vec<Place>,
    changed: usize,
}

impl<'a> Writer<'a> {
    fn new(program: &'a Program) -> Self {
        let words = program.blocks().flat_map(|block| block.words().collect::<Vec<_>>());
        let texts: Vec<TextRange> = words
            .filter(|word| word.address == Address::Letter(b'F') && matches!(word.value, Value::Number(_)))
            .map(|word| word.value_range)
            .collect();
        let texts = texts
            .iter()
            .filter_map(|range| core::str::from_utf8(&program.source()[range.as_usize()]).ok());
        // without any F word nothing is written
        let style = NumberStyle::learn(texts).unwrap_or(NumberStyle {
            decimals: 0,
            trims: true,
            whole_point: false,
            leading_zero: true,
        });
        Self {
            program,
            style,
            next: 0,
            current: [None; 2],
            pointed: false,
            open: None,
            places: Vec::new(),
            changed: 0,
        }
    }

    fn finish(mut self) -> Vec<Place> {
        self.places.extend(self.open.take());
        self.places
    }

    /// The F word of a block: its number, and the bytes of that.
    fn word(&mut self, block: BlockId) -> Option<(Option<f64>, TextRange)> {
        let words = self.program.block(block).words();
        let mut found = words.filter(|word| word.address == Address::Letter(b'F'));
        let word = found.next()?;
        let number = match word.value {
            Value::Number(value) if found.next().is_none() => Some(value.to_f64()),
            _ => None,
        };
        self.pointed = self.program.text(word.value_range).contains('.');
        Some((number, word.value_range))
    }

    /// Takes over the F words before a block.
    fn read_up_to(&mut self, block: BlockId) {
        while self.next < block.0 {
            if let Some((number, _)) = self.word(BlockId(self.next)) {
                self.current = [number; 2];
            }
            self.next += 1;
        }
    }

    fn cut(&mut self, cut: &Cut) {
        self.read_up_to(cut.block);
        self.next = cut.block.0 + 1;
        let own = self.word(cut.block);
        let before = own.map_or(self.current[0], |(number, _)| number);
        let target = cut.target();
        let wanted = match (before, target) {
            (_, None) => Ok(before),
            (_, Some(_)) if cut.missing.is_some() => Err(cut.missing.map_or_else(String::new, str::to_owned)),
            (None, Some(_)) => Err("the feed in effect is not a plain number in the text".to_owned()),
            (Some(before), Some(target)) => self.written(cut, before, target).map(Some),
        };
        let wanted = wanted.unwrap_or_else(|why| {
            self.places.extend(self.open.take());
            self.places.push(Place {
                first: cut.block,
                last: cut.block,
                change: if cut.missing.is_some() {
                    Change::Possible(why)
                } else {
                    Change::Refused(why)
                },
            });
            before
        });
        let edit = match (wanted, own) {
            (Some(value), Some((_, range))) if wanted != before => Some((range, self.text(value, self.pointed))),
            (Some(value), None) if wanted != self.current[1] => {
                let at = end_of_words(self.program, cut.block);
                Some((
                    TextRange::new(at, at),
                    format!(
                        "{}F{}",
                        blank_before_f(self.program, at),
                        self.text(value, self.pointed)
                    ),
                ))
            }
            _ => None,
        };
        self.current = [before, wanted];
        if let Some((range, new_text)) = edit {
            self.changed += usize::from(wanted != before);
            self.edit(cut.block, TextEdit { range, new_text });
        }
        if before == wanted {
            self.places.extend(self.open.take());
        }
    }

    /// Adds an edit to the place that is open.
    fn edit(&mut self, block: BlockId, edit: TextEdit) {
        let open = self.open.get_or_insert_with(|| Place {
            first: block,
            last: block,
            change: Change::Edits(Vec::new()),
        });
        open.last = block;
        if let Change::Edits(edits) = &mut open.change {
            edits.push(edit);
        }
    }

    /// The F word that says `target` and no more, in the program's digits or a few more; the word before where it says as much.
    fn written(&self, cut: &Cut, before: f64, target: f64) -> Result<f64, String> {
        let ratio = cut.feed / before;
        let known = if cut.inverse { &[1.0][..] } else { &[1.0, 25.4][..] };
        if !known.iter().any(|known| (ratio - known).abs() < 1e-9 * known) {
            return Err("the feed in effect does not come from the F word before it".to_owned());
        }
        let goal = target / ratio;
        for decimals in self.style.decimals..=self.style.decimals.max(MOST_DECIMALS) {
            let scale = 10f64.powi(i32::try_from(decimals).unwrap_or(i32::MAX));
            let value = (goal * scale).floor() / scale;
            if value >= 0.99 * goal || decimals >= MOST_DECIMALS {
                if value <= 0.0 {
                    return Err(format!(
                        "the axes allow a feed of {goal:.6} only, which F cannot express"
                    ));
                }
                return Ok(if target > cut.feed { value.max(before) } else { value });
            }
        }
        Ok(before)
    }

    /// A feed in the program's digits, or a few more where it needs them; `pointed`: with a decimal point, else without one where it is whole.
    fn text(&self, value: f64, pointed: bool) -> String {
        let exact = |decimals: &usize| {
            let style = NumberStyle {
                decimals: *decimals,
                ..self.style
            };
            style.write(value, false).parse() == Ok(value)
        };
        let decimals = (self.style.decimals..=self.style.decimals.max(MOST_DECIMALS)).find(exact);
        let style = NumberStyle {
            decimals: decimals.unwrap_or(MOST_DECIMALS),
            whole_point: pointed,
            ..self.style
        };
        style.write(value, false)
    }
}

impl Cut {
    /// The feed that it is to have; none: the one that it has.
    fn target(&self) -> Option<f64> {
        let limit = self.limit?;
        if limit < self.feed {
            return Some(limit);
        }
        let raised = self.asked.min(limit);
        (raised > self.feed).then_some(raised)
    }
}
