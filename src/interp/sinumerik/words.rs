//! Blocks with a statement of the flow or a call: what the reader records, and what is done with it once the block is read.
use super::call::With;
use super::names::{files, is_statement, program_key};
use super::statement::Statement;
use super::text::Text;
use crate::codes::Found;
use crate::core::Report;
use crate::flow::{Back, Calling, Transfer, With as Handed, index_of};
use crate::iso::Iso;
use crate::reader::{Reader, without_index};
use crate::words::Words;
use crate::{FaultKind, Refusal};
use std::sync::Arc;
use trunnion_dialect::Action;
use trunnion_flow::Key;
use trunnion_syntax::{Block, Call, TextRange, Word};

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// A flow statement, or a name that is not a code, where jumps and calls are followed; false for other names.
    pub(crate) fn sinumerik_name(&mut self, call: &Call) -> bool {
        let Some(own) = self.own.as_mut().filter(|own| own.follows && !own.is_task) else {
            return false;
        };
        let Some(name) = self.program.source().get(call.name.as_usize()) else {
            return false;
        };
        if is_statement(name) {
            own.statement = Some(call.range);
            // its text has its own reader
            self.words.declares = true;
            return true;
        }
        let is_code = std::str::from_utf8(name).is_ok_and(|name| self.dialect.name(without_index(name)).is_some());
        if is_code || self.words.forgets_all || own.called.is_some() {
            return false;
        }
        own.called = Some(*call);
        true
    }

    /// `L20` calls a subprogram, where calls are followed.
    pub(crate) fn sinumerik_number(&mut self, letter: u8, word: &Word) -> bool {
        match self
            .own
            .as_mut()
            .filter(|own| own.follows && !own.is_task && letter == b'L')
        {
            Some(own) => {
                own.called_by_number = Some(word.range);
                true
            }
            None => false,
        }
    }
}

/// Words of a call and next to it: the block's number, L and P.
const BESIDE_CALL: u32 = 1 << (b'N' - b'A') | 1 << (b'L' - b'A') | 1 << (b'P' - b'A');

/// Whether a block contains only words of these letters.
fn only(letters: u32, codes: &[Found<'_>], words: &Words) -> bool {
    codes.is_empty() && words.letters & !letters == 0 && !words.axes.any() && !words.forgets_all
}

impl<'d> Iso<'d> {
    /// Prepares the reader for the next block.
    pub(crate) fn sinumerik_begins(&mut self) {
        let own = &mut self.memory.own;
        own.follows = self.flow.follows;
        let trail = self.flow.trail.as_ref();
        own.is_called = own.follows && trail.is_some_and(|trail| trail.course.is_called());
        (own.statement, own.called, own.called_by_number) = (None, None, None);
    }

    /// Does what the reader has recorded in a block.
    #[inline]
    pub(crate) fn sinumerik_words(
        &mut self,
        block: &Block<'_>,
        codes: &mut Vec<Found<'d>>,
        words: &mut Words,
        report: &mut Report<'_>,
    ) {
        let own = &mut self.memory.own;
        let ends = |found: &Found<'_>| found.code.action == Action::ProgramEnd;
        if own.is_called
            && let Some(at) = codes.iter().position(ends)
        {
            // M17, M2 and M30 of a subprogram return
            let range = codes.remove(at).range;
            codes.retain(|found| !ends(found));
            own.pending = Some(Transfer::Return(Back { label: None, range }));
        }
        if let Some(range) = own.statement.take() {
            let beside = !only(1 << (b'N' - b'A'), codes, words);
            self.sinumerik_statement(block, range, beside, words, report);
        } else if own.called.is_some() || own.called_by_number.is_some() {
            self.sinumerik_call(block, codes, words, report);
        }
    }

    #[cold]
    fn sinumerik_statement(
        &mut self,
        block: &Block<'_>,
        range: TextRange,
        beside: bool,
        words: &mut Words,
        report: &mut Report<'_>,
    ) {
        let (dialect, program, at) = (self.core.dialect, block.program(), block.id().0);
        let file = self.flow.file();
        let again = self.flow.trail.as_ref().is_some_and(|trail| trail.course.is_again(at));
        let (flow, memory) = (&mut self.flow, &mut self.memory);
        let mut index = || flow.trail().index(file, || index_of(dialect, program));
        let mut statement = Statement {
            text: Text::of(block, range.start),
            own: &mut memory.own,
            place: (file, at),
            index: &mut index,
            again,
            remarks: Vec::new(),
        };
        let asked = if beside {
            let what = "other words in the block of a flow statement".to_owned();
            Err((range, FaultKind::NotDecided { what }))
        } else {
            statement.read()
        };
        for (range, kind) in std::mem::take(&mut statement.remarks) {
            report.fault(range, kind);
        }
        let pending = match asked {
            Ok(transfer) => transfer,
            Err((place, kind @ FaultKind::NotModelled { .. })) => {
                // what it calls may do anything, and the program goes on after it
                report.fault(place, kind);
                (words.declares, words.forgets_all) = (false, true);
                if program
                    .bytes(range)
                    .get(..7)
                    .is_some_and(|name| name.eq_ignore_ascii_case(b"ISOCALL"))
                {
                    // which codes of the ISO language stay in effect is not known
                    self.core.unknown.for_good();
                }
                return self.call_is_not_followed();
            }
            Err((range, kind)) => {
                report.fault(range, kind);
                Transfer::End
            }
        };
        let is_path = |transfer: &Transfer| match transfer {
            Transfer::Call(calling) => matches!(&calling.with, Handed::Sinumerik(with) if with.is_elsewhere),
            _ => false,
        };
        if self.core.effects.wanted() && is_path(&pending) {
            // two paths with one last name may lead to two programs
            let said = crate::written::written(block, self, words, crate::written::Keep::All);
            let here = self.core.main_block(block.id());
            self.core.effects.add(here, crate::Effect::Unmodelled(said));
        }
        self.memory.own.pending = Some(pending);
    }

    /// `CR10` as `CR=10`: an address of several letters needs `=` (SINUMERIK Programming Manual, Fundamentals: NC addresses).
    fn with_equals(&self, text: &str) -> Option<String> {
        let at = text.find(|character: char| !character.is_ascii_alphabetic())?;
        let (name, number) = text.split_at_checked(at)?;
        let is_address = name.len() > 1
            && self
                .core
                .dialect
                .named_role(name.to_ascii_uppercase().as_bytes())
                .is_some();
        (is_address && number.parse::<f64>().is_ok()).then(|| format!("{name}={number}"))
    }

    /// A name that is not a code, or `L20`: a subprogram, if there is one.
    #[cold]
    fn sinumerik_call(
        &mut self,
        block: &Block<'_>,
        codes: &mut Vec<Found<'d>>,
        words: &mut Words,
        report: &mut Report<'_>,
    ) {
        let program = block.program();
        let own = &mut self.memory.own;
        let (called, number) = (own.called.take(), own.called_by_number.take());
        let (range, name, arguments) = match (called, number) {
            (Some(call), None) => (call.range, program.text(call.name).into_owned(), call.arguments),
            (_, Some(range)) => (range, program.text(range).replace([' ', '\t'], ""), None),
            (None, None) => return,
        };
        let key = program_key(&name);
        let is_modal =
            matches!(codes.as_slice(), [found] if found.code.action == Action::CannedCycle && !found.with_arguments);
        // `MCALL L10`: L is the name of the program
        let name_letter = if number.is_some() { 1 << (b'L' - b'A') } else { 0 };
        if is_modal && self.modal_call_of(block, &key, (range, arguments, name_letter), words) {
            codes.clear();
            return;
        }
        let own = &self.memory.own;
        let text = arguments.map(|inside| program.text(inside).into_owned());
        for kind in super::call::stops(text.as_deref(), own) {
            report.fault(range, kind);
        }
        let alone = only(BESIDE_CALL, codes, words) && !(called.is_some() && number.is_some());
        let repeats = words.letters & (1 << (b'P' - b'A')) != 0;
        let declared = matches!(&key, Key::Name(name) if own.declared.contains(name));
        let sure = number.is_some() || repeats || declared;
        let is_known = sure || self.is_program(&key, program);
        if !alone || !is_known {
            // as far as is known it may move anything
            words.forgets_all = true;
            self.memory.own.lose();
            let text = program.text(range);
            let kind = if is_known {
                FaultKind::NotModelled {
                    what: text.trim().to_owned(),
                }
            } else if let Some(written) = self.with_equals(text.trim()) {
                FaultKind::Rejected {
                    refusal: Refusal::Syntax,
                    message: format!(
                        "{0} needs `=` between its letters and its number: write {written}",
                        text.trim()
                    ),
                    alarm: None,
                }
            } else {
                FaultKind::name_lacks(text.trim(), true)
            };
            return report.fault(range, kind);
        }
        words.declares = true;
        let times = match words.p.number() {
            Some(p) if p.value >= 1.0 && p.value.fract() == 0.0 && p.value <= 9999.0 => p.value as u32,
            None if !repeats => 1,
            _ => {
                let what = "how often the subprogram runs".to_owned();
                report.fault(range, FaultKind::NotDecided { what });
                self.memory.own.pending = Some(Transfer::End);
                return;
            }
        };
        let with = With::read(text.as_deref(), &self.memory.own);
        self.memory.own.pending = Some(Transfer::Call(Calling {
            program: key,
            times,
            range,
            with: Handed::Sinumerik(with),
        }));
    }

    /// MCALL with a subprogram: it runs after each block that moves. Where its arguments are not plain numbers no source says when they are
    /// evaluated; false: it is not followed.
    fn modal_call_of(
        &mut self,
        block: &Block<'_>,
        key: &Key,
        (range, arguments, name_letter): (TextRange, Option<TextRange>, u32),
        words: &mut Words,
    ) -> bool {
        let program = block.program();
        let text = arguments
            .map(|inside| program.text(inside).into_owned())
            .unwrap_or_default();
        let plain = text
            .bytes()
            .all(|byte| byte.is_ascii_digit() || b".,+- ".contains(&byte));
        let beside = words.letters & !(1 << (b'N' - b'A') | name_letter) != 0 || words.axes.any() || words.forgets_all;
        if beside || !plain || !self.is_program(key, program) {
            return false;
        }
        words.declares = true;
        let mut with = With::read(Some(&text), &self.memory.own);
        with.is_modal = true;
        let calling = Calling {
            program: key.clone(),
            times: 1,
            range,
            with: Handed::Sinumerik(with),
        };
        self.memory.cycle.call = None;
        let own = &mut self.memory.own;
        own.changes += 1;
        own.modal = Some((calling, own.levels));
        // from here on the flow is followed
        own.pending = Some(Transfer::Next);
        true
    }

    /// The call of MCALL after a block that has moved; else why it cannot be followed.
    pub(crate) fn modal_subprogram(&self) -> Option<Result<Calling, String>> {
        let own = &self.memory.own;
        let (calling, levels) = own.modal.as_ref().filter(|_| !own.in_modal)?;
        if *levels != own.levels {
            return Some(Err("whether MCALL of another program acts here".to_owned()));
        }
        Some(Ok(calling.clone()))
    }

    /// A cycle that is called while MCALL is active moves, and no source says whether MCALL acts inside or after it. Rows of holes are the
    /// exception: the drilling cycle of MCALL runs at each hole (Programming Manual, Cycles, HOLES1). Where it is not known the run ends.
    pub(crate) fn modal_call_unclear(&mut self, found: &Found<'_>, report: &mut Report<'_>) -> bool {
        let own = &self.memory.own;
        let id = &found.code.id;
        let drills = self.memory.cycle.call.is_some() && !crate::cycles::is_row(id);
        if !drills && (own.modal.is_none() || own.in_modal) {
            return false;
        }
        let what = format!("whether MCALL acts in {id}, which is called while it is active (end it with MCALL alone)");
        report.fault(found.range, FaultKind::NotDecided { what });
        self.core.forget_position();
        self.memory.own.pending = Some(Transfer::End);
        true
    }

    /// MCALL acts after a block with only F or S too, under G0 and G1 (840D sl Programming Manual, 06/2019, modal calls).
    pub(crate) fn acts_without_motion(&self, codes: &[Found<'_>], words: &Words) -> bool {
        let letter = |letter: u8| 1u32 << (letter - b'A');
        let (speeds, others) = (letter(b'F') | letter(b'S'), letter(b'N'));
        matches!(self.core.state.motion, Some(Action::Rapid | Action::Linear))
            && codes.is_empty()
            && words.letters & speeds != 0
            && words.letters & !(speeds | others) == 0
            && !words.axes.any()
            && !words.declares
            && !words.forgets_all
    }

    /// Whether a program with this name exists: in this file, or in the library.
    fn is_program(&mut self, key: &Key, program: &trunnion_syntax::Program) -> bool {
        let Key::Name(name) = key else { return false };
        // the text is searched once, not at every call
        let look = || memchr::memmem::find(program.source(), b"%_N_").is_some();
        let headed = *self.memory.own.headed.entry(self.flow.file()).or_insert_with(look);
        if headed {
            let (dialect, file) = (self.core.dialect, self.flow.file());
            let index = match &mut self.flow.trail {
                Some(trail) => trail.index(file, || index_of(dialect, program)),
                None => Arc::new(index_of(dialect, program)),
            };
            if index.program(key).is_some() {
                return true;
            }
        }
        let Some(library) = &self.core.setup.library.0 else {
            return false;
        };
        if self.memory.own.missing.contains(name) {
            return false;
        }
        // a file that is there and is not taken is reported where it is called
        let is_there = |file: &String| match library.load(file) {
            Ok(_) => true,
            Err(searched) => searched.iter().any(|place| place.refused.is_some()),
        };
        let found = files(key).iter().any(is_there);
        if !found {
            self.memory.own.missing.insert(name.clone());
        }
        found
    }
}
