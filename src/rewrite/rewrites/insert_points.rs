//! Puts points into lines on which rotary axes turn, so that the tip stays near the programmed segment.
//!
//! # Why
//! Without tool centre point control the axes run linearly from one end of a block to the other, and the tip runs on a curve between them.
//! Points on the programmed segment cut the curve into pieces: the deviation falls with the square of their number.
//!
//! # How
//! From the start of the line, the rewrite searches for the farthest point up to which the proven bound of the deviation stays within the tolerance; from there
//! for the next one, and so on. So there are no more points than needed. Then the points are moved together until all
//! pieces deviate equally. At each point the rotary axes are at positions that they also pass on the original line, and X Y Z are solved so that the tip is on the segment. The first piece keeps the words of the block; the others are new lines with
//! axis words only.
//!
//! # Example
//! ```gcode before fanuc-30i mikron-ucp710
//! G21 G90 G94 G17 G54
//! G0 X0. Y0. Z100. A0. C0.
//! S8000 M3
//! N10 G1 X20. Y5. Z90. A2. C4. F1000
//! N20 X30. Y5.
//! M30
//! ```
//! ```gcode after
//! G21 G90 G94 G17 G54
//! G0 X0. Y0. Z100. A0. C0.
//! S8000 M3
//! N10 G1 X2.487 Y0.818 Z98.759 A0.251 C0.501 F1000
//! X4.979 Y1.579 Z97.515 A0.501 C1.002
//! X7.468 Y2.285 Z96.270 A0.751 C1.501
//! X9.962 Y2.935 Z95.023 A1.000 C2.000
//! X12.465 Y3.533 Z93.770 A1.250 C2.500
//! X14.977 Y4.077 Z92.513 A1.500 C3.001
//! X17.491 Y4.567 Z91.255 A1.751 C3.501
//! X20. Y5. Z90. A2. C4.
//! N20 X30. Y5.
//! M30
//! ```
//!
//! # Claim
//! The programs do the same, except that lines are divided into pieces. Each piece keeps the tip within the tolerance of the segment that the original line
//! programs, and its rotary axes are where that line takes them.
//!
//! # Traps
//! - The tolerance is the one of `path-deviation` (`tip` of `[tolerances]`), unless `--tolerance-mm` is given.
//! - Work offset and tool length must be declared: the path of the tip depends on them.
//! - A control looks ahead over a limited number of blocks: many short ones may slow it down (`short-block-time`).
//! - Under tool centre point control the control itself keeps the tip on the segment: such lines are left alone. So are arcs, incremental
//!   coordinates, inverse time and exact stop.
//!
//! # Sources
//! docs/kinematics.md#between-the-ends-of-a-block.
use super::Body;
use crate::line_points::{Line, Writer, programmed, refused, undeclared_path};
use crate::slots::{Scheme, Slots, insert_word, slots, styles};
use crate::style::newline;
use crate::{Change, Known, Options, Place, Proposal, Proposed, Refusal};
use trunnion_certify::Claim;
use trunnion_check::{Assume, Settings};
use trunnion_interp::{Fault, Feed, ModalState, Motion, MotionKind, Orientation, Sink, run};
use trunnion_machine::{Follower, Machine, tip_deviation};
use trunnion_syntax::{Program, TextEdit, TextRange};

pub(super) const REWRITE: Body = Body {
    cures: &["path-deviation"],
    writes: Some("blocks of G1"),
    propose,
};

struct Collector<'m> {
    machine: &'m Machine,
    follower: Follower<'m>,
    assume: Assume,
    tolerance_mm: f64,
    rotary: [Option<usize>; 2],
    lines: Vec<Line>,
}

impl Sink for Collector<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let plain = motion.kind == MotionKind::Linear && !motion.tcp && motion.orientation == Orientation::Words;
        if !(plain && motion.is_feed()) {
            return;
        }
        let strays = tip_deviation(self.machine, &leg, self.tolerance_mm);
        if strays.is_none_or(|found| found.bound_mm <= self.tolerance_mm) {
            return;
        }
        let left = self.assume.leaves(motion.undeclared);
        self.lines.push(Line {
            words: programmed(&motion.end, self.rotary),
            unit_mm: state.coordinates.unit_mm(),
            incremental: state.coordinates.incremental(),
            undeclared: left.zero & 0b111 != 0 || left.length,
            leg,
        });
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, _: &Known) -> Proposed {
    let Some(machine) = settings.machine else {
        return Err("no machine is named, and the path of the tip depends on it (--machine)".into());
    };
    if machine.rotary.is_empty() || machine.rotary.len() > 2 {
        return Ok(None);
    }
    let tolerance_mm = options.given_mm.unwrap_or(machine.tolerances.tip_mm);
    let letters = [0, 1].map(|index| machine.rotary.get(index).map(|&joint| machine.axes[joint].letter));
    let axis = |letter: Option<u8>| Some(usize::from(trunnion_interp::AxisLetter::new(letter?)?.0));
    let mut collector = Collector {
        machine,
        follower: Follower::new(machine),
        assume: settings.assume,
        tolerance_mm,
        rotary: letters.map(axis),
        lines: Vec::new(),
    };
    run(program, settings.dialect, &settings.setup, &mut collector);
    let scheme = Scheme::Rotaries(letters.map(Option::unwrap_or_default));
    let writer = Writer {
        program,
        machine,
        scheme,
        styles: styles(program, scheme),
        tolerance_mm,
        newline: newline(program.source()),
    };
    let mut places = Vec::new();
    let mut points = 0;
    for line in &collector.lines {
        let change = match writer.line(line) {
            Ok((edits, count)) => {
                points += count;
                Change::Edits(edits)
            }
            Err(change) => change,
        };
        places.push(Place {
            first: line.leg.motion.block,
            last: line.leg.motion.block,
            change,
        });
    }
    if places.is_empty() {
        return Ok(None);
    }
    if points == 0 {
        return Err(Refusal::Places(places));
    }
    Ok(Some(Proposal {
        claim: Claim::InsertedPoints {
            tolerance_mm,
            tolerance_deg: options.tolerance_deg,
        },
        summary: format!(
            "{points} points in {} lines keep the tip within {tolerance_mm} mm of the programmed segments",
            places
                .iter()
                .filter(|place| matches!(place.change, Change::Edits(_)))
                .count()
        ),
        places,
    }))
}

impl Writer<'_> {
    /// The edits that cut a line in pieces, and the number of points.
    fn line(&self, line: &Line) -> Result<(Vec<TextEdit>, usize), Change> {
        if line.undeclared {
            return Err(undeclared_path());
        }
        if line.incremental {
            return Err(refused("coordinates are incremental (G91)"));
        }
        if matches!(line.leg.motion.feed, Feed::InverseTime(_)) {
            return Err(refused(
                "the feed is inverse time (G93): each piece would need an F of its own",
            ));
        }
        let view = self.program.block(line.leg.motion.block);
        let slots: Slots<'_> = slots(self.program, &view, self.scheme).map_err(refused)?;
        let ends = self.even_ends(line)?;
        let Some((first, others)) = ends.split_first() else {
            return Err(refused("no point is needed"));
        };
        let mut edits = Vec::new();
        for (index, slot) in slots.iter().enumerate().take(5) {
            let Some(text) = &first.texts[index] else { continue };
            edits.push(if let Some(slot) = slot {
                TextEdit {
                    range: slot.number,
                    new_text: text.clone(),
                }
            } else {
                let letter = self.scheme.letter(index);
                let word = letter.and_then(|letter| insert_word(self.program, &view, letter, text));
                word.ok_or_else(|| refused("there is no place for the words of an axis"))?
            });
        }
        edits.sort_by_key(|edit| (edit.range.start, edit.range.end));
        let mut lines = String::new();
        for end in others {
            self.add_line(&mut lines, &end.texts);
        }
        // the last piece says what the block said
        let last: [Option<String>; 5] = core::array::from_fn(|index| {
            let slot = slots[index].as_ref().map(|slot| slot.text.to_string());
            slot.or_else(|| {
                first.texts[index]
                    .as_ref()
                    .and_then(|_| self.text(index, line.words[index]?, line.unit_mm))
            })
        });
        self.add_line(&mut lines, &last);
        let at = view.range().end;
        edits.push(TextEdit {
            range: TextRange::new(at, at),
            new_text: lines,
        });
        Ok((edits, ends.len()))
    }

    /// A new line with these words, after the line end of the program.
    fn add_line(&self, lines: &mut String, texts: &[Option<String>; 5]) {
        lines.push_str(self.newline);
        let words = texts.iter().enumerate();
        let words = words.filter_map(|(index, text)| Some((self.scheme.letter(index)?, text.as_ref()?)));
        let mut words: Vec<String> = words
            .map(|(letter, text)| format!("{}{text}", char::from(letter)))
            .collect();
        // X Y Z, then the rotary axes by letter
        let linear = words.len().min(3);
        words[linear..].sort();
        lines.push_str(&words.join(" "));
    }
}
