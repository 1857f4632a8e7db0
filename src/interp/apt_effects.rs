//! The effects of an APT record, in the words that G-code programs use for the same, so that both can be compared.
//!
//! Source of the records: ISO 4343 (NC processor output, post processor commands): SPINDL, COOLNT, LOADTL, STOP, OPSTOP, END, FINI.
use crate::apt::Apt;
use crate::apt::Args;
use crate::feed_speed::METRES_PER_FOOT;
use crate::written::{call_argument, packed};
use crate::{Argument, Effect};
use crate::{Motion, MotionKind};
use trunnion_syntax::{Block, Record};

/// Records that have no effect on the machine.
const NEUTRAL: [&str; 7] = ["PARTNO", "PPRINT", "REMARK", "PAINT", "DISPLY", "CUTTER", "MULTAX"];

impl Apt<'_> {
    /// What a record sets, before its motion.
    #[cold]
    pub(crate) fn record_effects(&mut self, record: &Record<'_>, view: &Block<'_>) {
        let args = Args::new(record);
        let program = view.program();
        let block = self.core.main_block(view.id());
        let effects = &mut self.core.effects;
        if let Some(effect) = unmodelled_words(record, &args, view) {
            effects.add(block, effect);
        }
        if record.is("COOLNT") {
            self.coolant_effects(record, &args, view);
        } else if record.is("SPINDL") {
            let still = args.has(program, "OFF") || args.numbers().first() == Some(&0.0);
            // without a direction it is the post-processor that chooses between the last one and clockwise
            let counter = args.has(program, "CCLW");
            let says = counter || args.has(program, "CLW");
            if !says && !still && self.kept.counter_clockwise {
                let words = vec![Argument::text("SPINDL", &written_record(record, view))];
                effects.add(block, Effect::Unmodelled(words));
            }
            self.kept.counter_clockwise = counter || self.kept.counter_clockwise && !says;
            let to = if args.has(program, "LOCK") || args.has(program, "ORIENT") {
                vec![Argument::text("M19", &written_record(record, view))]
            } else if still {
                vec![Argument::code("M5")]
            } else if args.has(program, "CCLW") {
                vec![Argument::code("M4")]
            } else {
                vec![Argument::code("M3")]
            };
            if let Some(&speed) = args.numbers().first().filter(|_| !still) {
                // m/min of feet per minute
                let unit = if args.has(program, "SFM") { METRES_PER_FOOT } else { 1.0 };
                effects.add(block, Effect::set("speed", [Argument::number("S", speed * unit)]));
            }
            effects.add(block, Effect::set("spindle", to));
            let plain = ["RPM", "CLW", "CCLW", "ON", "OFF", "LOCK", "ORIENT", "SFM", "SMM"];
            let other = args
                .words()
                .iter()
                .any(|&word| !plain.iter().any(|known| crate::apt::is(program, word, known)));
            let more =
                (other || args.numbers().len() > 1).then(|| Argument::text("SPINDL", &written_record(record, view)));
            effects.add(
                block,
                Effect::set("spindle words", more.into_iter().collect::<Vec<_>>()),
            );
            let surface = args.has(program, "SFM") || args.has(program, "SMM");
            let mode: Vec<Argument> = surface.then(|| Argument::code("G96")).into_iter().collect();
            effects.add(block, Effect::set("speed mode", mode));
        } else if record.is("LOADTL") || record.is("TOOLNO") || record.is("LOAD") && args.has(program, "TOOL") {
            if let Some(&number) = args.numbers().first() {
                effects.add(block, Effect::set("tool prepared", [Argument::number("T", number)]));
                effects.add(block, Effect::set("tool in use", [Argument::number("T", number)]));
                effects.add(block, Effect::Event(vec![Argument::code("tool change")]));
                let other = args.words().iter().any(|&word| {
                    !["LENGTH", "TOOL"]
                        .iter()
                        .any(|known| crate::apt::is(program, word, known))
                });
                let more = other.then(|| Argument::text("LOADTL", &written_record(record, view)));
                effects.add(block, Effect::set("tool words", more.into_iter().collect::<Vec<_>>()));
            }
        } else if record.is("CUTTER") || record.is("CIRCLE") {
            let to = match self.circle_as_read(&args).filter(|_| record.is("CIRCLE")) {
                Some(circle) => circle.map(|(name, value)| Argument::number(name, value)).into(),
                None => vec![Argument::text("", &written_record(record, view))],
            };
            let key = if record.is("CUTTER") { "cutter" } else { "circle" };
            self.core.effects.add(block, Effect::set(key, to));
        } else if record.is("STOP") {
            let mut words = vec![Argument::code("M0")];
            if !args.words().is_empty() || !args.numbers().is_empty() {
                words.push(Argument::text("STOP", &written_record(record, view)));
            }
            effects.add(block, Effect::Event(words));
        } else if record.is("OPSTOP") {
            effects.add(block, Effect::Event(vec![Argument::code("M1")]));
        } else if record.is("FINI") || record.is("END") {
            effects.add(block, Effect::End(vec![Argument::code("FINI")]));
        }
    }

    /// COOLNT.
    fn coolant_effects(&mut self, record: &Record<'_>, args: &Args, view: &Block<'_>) {
        let program = view.program();
        let block = self.core.main_block(view.id());
        let effects = &mut self.core.effects;
        let off = args.has(program, "OFF");
        let mist = args.has(program, "MIST") && !off;
        let flood = !off && (args.has(program, "FLOOD") || args.has(program, "ON") || args.words().is_empty());
        for (key, is_on) in [("mist coolant", mist), ("flood coolant", flood)] {
            let to: Vec<Argument> = is_on.then(|| Argument::code("on")).into_iter().collect();
            effects.add(block, Effect::set(key, to));
        }
        // which coolant comes back is the post-processor's choice
        let again = args.has(program, "ON") && self.kept.mist;
        self.kept.mist = (self.kept.mist || mist) && !args.has(program, "FLOOD");
        if !(off || mist || flood) || again {
            let words = vec![Argument::text("COOLNT", &written_record(record, view))];
            effects.add(block, Effect::Unmodelled(words));
        }
    }

    /// The words of a record that does more than is modelled.
    #[cold]
    pub(crate) fn late_record_effects(
        &mut self,
        record: &Record<'_>,
        view: &Block<'_>,
        motion: Option<&Motion>,
        has_other_effects: bool,
    ) {
        if record.is("GOTO") {
            let block = self.core.main_block(view.id());
            self.core.effects.add(block, Effect::set("circle", []));
        }
        let held = [
            "GOTO", "FROM", "RAPID", "FEDRAT", "SPINDL", "COOLNT", "LOADTL", "TOOLNO", "STOP", "OPSTOP", "FINI", "END",
        ];
        let unknown = motion.is_some_and(|motion| {
            matches!(
                motion.kind,
                MotionKind::Arc(None) | MotionKind::Unknown | MotionKind::Dwell(None)
            ) || motion.end.xyz().is_none()
        });
        let modelled = [
            "GODLTA", "CIRCLE", "DELAY", "UNITS", "UNIT", "TLAXIS", "CUTCOM", "CYCLE", "CSYS", "LOAD", "INDIRV", "TLON",
        ];
        let known = held.iter().chain(&modelled).chain(&NEUTRAL).any(|name| record.is(name));
        let cutcom = record.is("CUTCOM") || record.is("CYCLE");
        // what is neither a number nor a word is not read
        let odd = known && !NEUTRAL.iter().any(|name| record.is(name)) && Args::new(record).odd;
        if has_other_effects || unknown || !known || cutcom || odd {
            let block = self.core.main_block(view.id());
            let words = vec![Argument::text("", &written_record(record, view))];
            self.core.effects.add(block, Effect::Unmodelled(words));
        }
    }
}

/// A record without blanks, its numbers in one spelling.
fn written_record(record: &Record<'_>, view: &Block<'_>) -> String {
    let text = packed(&view.program().text(record.range));
    match text.split_once('/') {
        Some((major, arguments)) => call_argument(major, &format!("({arguments})")).to_string(),
        None => text,
    }
}

/// Words that change what a record does, in a form that is not modelled.
fn unmodelled_words(record: &Record<'_>, args: &Args, view: &Block<'_>) -> Option<Effect> {
    let program = view.program();
    let plain: Option<(&'static str, &[&str], usize)> = if record.is("COOLNT") {
        Some(("coolant words", &["ON", "OFF", "FLOOD", "MIST"], 0))
    } else if record.is("FEDRAT") {
        let units = &["MMPM", "IPM", "MMPR", "IPR", "PERMIN", "PERREV", "INVERS"];
        Some(("feed words", units, 1))
    } else if record.is("RAPID") {
        Some(("rapid words", &[], 0))
    } else if record.is("DELAY") {
        Some(("dwell words", &["REV", "SEC"], 1))
    } else {
        None
    };
    if let Some((key, known, numbers)) = plain {
        let is_known = |word| known.iter().any(|known| crate::apt::is(program, word, known));
        let more = args.words().iter().any(|&word| !is_known(word)) || args.numbers().len() > numbers;
        let to = more.then(|| Argument::text("", &written_record(record, view)));
        return Some(Effect::set(key, to.into_iter().collect::<Vec<_>>()));
    }
    None
}
