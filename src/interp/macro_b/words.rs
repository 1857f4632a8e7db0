//! What a block with macro statements or calls requests, once all its words are read.
use super::alarms::{Mistake, is_fanuc, rejected};
use super::arguments;
use super::name::bracketed;
use super::read::{Macros, Mode};
use super::system::Kept;
use super::variables::Held;
use super::{Deep, FlowCode, Modal, With};
use crate::codes::Found;
use crate::core::Report;
use crate::flow::{Back, Calling, Transfer, With as Handed};
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::{WordValue, Words};
use crate::{FaultKind, Refusal};
use trunnion_dialect::{Action, Dialect};
use trunnion_flow::Key;
use trunnion_syntax::{Block, Item, TextRange};

impl<'d> Iso<'d> {
    /// Reads the words of a block; what macro statements request is done when it has run.
    pub(crate) fn read(
        &mut self,
        block: &Block<'_>,
        codes: &mut Vec<Found<'d>>,
        words: &mut Words,
        report: &mut Report<'_>,
    ) {
        if self.core.dialect.quirks.user_names() {
            self.sinumerik_begins();
            if !self.memory.own.is_task {
                self.note_system(block);
            }
        }
        let mode = if self.flow.follows { Mode::Follow } else { Mode::Step };
        let mut clamps = self.core.state.clamps;
        clamps.begin_block();
        let file = self.flow.file();
        let macros = Macros {
            mode,
            file,
            deep: &mut self.flow.deep,
            state: &self.core.state,
            setup: &self.core.setup,
            frames: &self.memory.frames,
            kept: Kept::of(&self.memory),
        };
        let mut reader = Reader {
            program: block.program(),
            dialect: self.core.dialect,
            block: block.id(),
            words,
            codes,
            delete: self.core.setup.control.block_delete,
            clamps: (&mut clamps, &self.core.setup.control.clamp_codes),
            macros: self.core.dialect.quirks.macro_b().then_some(macros),
            own: self.core.dialect.quirks.user_names().then_some(&mut self.memory.own),
            report: |range: TextRange, kind| report.fault(range, kind),
        };
        if let Some(own) = &mut reader.own {
            own.begin_block();
        }
        for item in block.items() {
            // a jump to this block may bring other values
            if let (Item::Label(_), Some(own)) = (&item, &mut reader.own)
                && !own.follows
            {
                own.lose();
            }
            reader.take(item);
        }
        self.core.state.clamps = clamps;
        if let Some(range) = words.rest_deleted.filter(|_| words.flow) {
            // statements are read as a whole
            let what = "`/` after a macro statement".to_owned();
            report.fault(range, FaultKind::NotModelled { what });
            words.forgets_all = true;
        }
        let calls = |found: &Found<'_>| found.code.action == Action::SubprogramCall;
        if words.forgets_all || self.core.dialect.quirks.user_names() && codes.iter().any(calls) {
            self.memory.own.lose();
        }
        if !self.memory.own.written_frames.is_empty() {
            self.write_frames(words, report);
        }
        if self.core.dialect.quirks.declares_names() {
            self.sinumerik_words(block, codes, words, report);
        } else if self.core.dialect.quirks.user_task() {
            self.task_words(block, codes, words, report);
        }
        if words.flow || words.program_number.is_some() {
            self.flow_words(block, codes, words, report);
        }
    }

    #[cold]
    fn flow_words(
        &mut self,
        block: &Block<'_>,
        codes: &mut Vec<Found<'d>>,
        words: &mut Words,
        report: &mut Report<'_>,
    ) {
        if !self.core.dialect.quirks.macro_b() {
            return;
        }
        let writes = self.flow.deep.as_mut().map(|deep| std::mem::take(&mut deep.writes));
        for (number, value) in writes.into_iter().flatten() {
            self.system_write(number, value, report);
        }
        if !self.flow.follows {
            return;
        }
        if words.program_number.is_some() && self.begins_another(block) {
            // the program before it ends here, without M30 or M99
            codes.clear();
            *words = Words::default();
            self.core.state.ended = true;
            return;
        }
        let Some(mut deep) = self.flow.deep.take() else { return };
        let statement = deep.statement.take();
        if let Some((code, range)) = deep.code.take() {
            self.flow_code(&mut deep, (code, range), block, words, report);
        } else if let Some(range) = statement.filter(|_| is_fanuc(self.core.dialect) && mixes(codes, words)) {
            let message = "a macro statement and ordinary words are in one block".to_owned();
            let kind = rejected(self.core.dialect, Mistake::MixedBlock, Refusal::Structure, message);
            report.fault(range, kind);
        }
        self.flow.deep = Some(deep);
    }

    /// Whether the O word of a block begins a program after the one that runs.
    pub(crate) fn begins_another(&self, block: &Block<'_>) -> bool {
        let inside = self.flow.trail.as_ref().is_some_and(|trail| {
            let section = trail.course.place().section;
            let starts = section.is_some_and(|section| section.0 == block.id().0);
            // a jump has led back to the start of the program that runs
            let again = trail.course.has_run(block.id().0);
            starts || again || trail.course.is_called()
        });
        !inside && self.core.last_content.is_some()
    }

    /// G67: G66.1 has hidden the positions.
    fn macro_per_block_ends(&mut self) {
        if let Some(code) = self.core.dialect.g(670) {
            let ended = self.core.unknown.end(code);
            self.core.forget_if(ended);
        }
    }

    fn flow_code(
        &mut self,
        deep: &mut Box<Deep>,
        (code, range): (FlowCode, TextRange),
        block: &Block<'_>,
        words: &mut Words,
        report: &mut Report<'_>,
    ) {
        let (program, times, arguments) = match code {
            FlowCode::ModalOff => {
                deep.modal.pop();
                deep.modal_active = deep.modal_active.min(deep.modal.len());
                self.macro_per_block_ends();
                return;
            }
            FlowCode::Branch => {
                return not_decided(deep, range, "the input that M96 reads".to_owned(), report);
            }
            FlowCode::Return => {
                let label = words.p.index().map(Key::Number);
                deep.pending = Some(Transfer::Return(Back { label, range }));
                return;
            }
            FlowCode::Macro | FlowCode::Modal => {
                words.declares = false;
                words.has_values = true;
                let mut slot = Some(std::mem::take(deep));
                let mut macros = Macros {
                    mode: Mode::Follow,
                    file: self.flow.file(),
                    deep: &mut slot,
                    state: &self.core.state,
                    setup: &self.core.setup,
                    frames: &self.memory.frames,
                    kept: Kept::of(&self.memory),
                };
                let mut tell = |range: TextRange, kind| report.fault(range, kind);
                let call = arguments::read(&mut macros, self.core.dialect, block, range, &mut tell);
                *deep = slot.unwrap_or_default();
                if let Some((range, what)) = call.unknown {
                    return not_decided(deep, range, what, report);
                }
                (call.program.flatten(), call.times, Some(call.arguments))
            }
            FlowCode::Call | FlowCode::CallLocal | FlowCode::CallExternal => {
                let l = words.letter(b'L');
                if matches!(words.p, WordValue::Unread) || matches!(l, WordValue::Unread) {
                    return not_decided(deep, range, "the numbers of the call".to_owned(), report);
                }
                let times = l.is_given().then(|| l.number().map(|number| number.value));
                (words.p.number().map(|number| number.value), times, None)
            }
        };
        let name = words.program_name.take();
        let name = name.and_then(|range| bracketed(report.program.bytes(range)));
        let place = report.program.block(report.block).range();
        let place = TextRange::new(range.start, place.end);
        match target(self.core.dialect, code, (name, program), times) {
            Ok((program, times)) => {
                let range = call_range(report, range, place);
                if code == FlowCode::Modal {
                    self.begin_modal((program, times, arguments), range, deep, report);
                } else {
                    deep.pending = Some(Transfer::Call(Calling {
                        program,
                        times,
                        range,
                        with: Handed::MacroB(With {
                            code,
                            arguments,
                            modal: None,
                        }),
                    }));
                }
            }
            Err(kind) => {
                report.fault(range, kind);
                deep.pending = Some(Transfer::End);
            }
        }
    }
}

impl Iso<'_> {
    /// A modal call: after each motion it calls those before it.
    fn begin_modal(
        &self,
        (program, times, arguments): (Key, u32, Option<Box<[Option<f64>; 33]>>),
        range: TextRange,
        deep: &mut Deep,
        report: &mut Report<'_>,
    ) {
        if let Some(kind) = self.too_many_modal(deep.modal.len()) {
            report.fault(range, kind);
            deep.pending = Some(Transfer::End);
            return;
        }
        deep.modal.push(Modal {
            program,
            times,
            arguments: arguments.unwrap_or_else(|| Box::new([None; 33])),
        });
        deep.modal_active = deep.modal.len();
    }
}

/// What runs next is unknown: the run ends.
fn not_decided(deep: &mut Deep, range: TextRange, what: String, report: &mut Report<'_>) {
    report.fault(range, FaultKind::NotDecided { what });
    deep.pending = Some(Transfer::End);
}

/// The text of a call: its code and the word P where that follows.
fn call_range(report: &Report<'_>, code: TextRange, block: TextRange) -> TextRange {
    let words = report.program.block(report.block).words();
    let p = words
        .filter(|word| word.range.start >= code.end && word.range.end <= block.end)
        .find(|word| word.address == trunnion_syntax::Address::Letter(b'P'));
    p.map_or(code, |word| code.cover(word.range))
}

/// Program and repetitions of a call. M98 without L: the digits above the last four of P are the repetitions.
fn target(
    dialect: &Dialect,
    code: FlowCode,
    (name, number): (Option<Key>, Held),
    times: Option<Held>,
) -> Result<(Key, u32), FaultKind> {
    let whole = |value: f64| {
        if value.is_nan() {
            let what = "the numbers of the call".to_owned();
            return Err(FaultKind::NotDecided { what });
        }
        let fits = value >= 0.0 && value.fract() == 0.0 && value <= 99_999_999.0;
        fits.then_some(value as u32).ok_or_else(|| {
            let message = format!("{value} is not a program number or a number of repeats");
            rejected(dialect, Mistake::NumberNotFound, Refusal::Number, message)
        })
    };
    let repeats = times.map(|times| times.map_or(Ok(1), whole)).transpose()?;
    if let Some(name) = name {
        return Ok((name, repeats.unwrap_or(1)));
    }
    let Some(number) = number else {
        let message = "the call has no P with the program number".to_owned();
        let kind = rejected(dialect, Mistake::ProgramWordMissing, Refusal::MissingWord, message);
        return Err(kind);
    };
    let number = whole(number)?;
    let folded = matches!(code, FlowCode::Call | FlowCode::CallExternal) && number > 9999 && is_fanuc(dialect);
    let (number, repeats) = match repeats {
        Some(repeats) => (number, repeats),
        None if folded => (number % 10_000, number / 10_000),
        None => (number, 1),
    };
    Ok((Key::Number(number), repeats))
}

/// Whether a block has words of the control, numbers of blocks and programs apart.
fn mixes(codes: &[Found<'_>], words: &Words) -> bool {
    const NUMBERS: u32 = 1 << (b'N' - b'A') | 1 << (b'O' - b'A');
    !codes.is_empty() || words.letters & !NUMBERS != 0
}
