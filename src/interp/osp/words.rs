//! Blocks with a statement of the user task, and names at the start of blocks.
use super::is_statement;
use super::statement::{Statement, is_name};
use crate::codes::Found;
use crate::core::Report;
use crate::flow::{Text, Transfer, index_of};
use crate::iso::Iso;
use crate::reader::Reader;

use crate::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_syntax::{Block, Call, TextRange};

/// The N word of a block.
const NUMBER: u32 = 1 << (b'N' - b'A');

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// A statement of the flow, where jumps and calls are followed; false for other names.
    pub(crate) fn task_name(&mut self, call: &Call) -> bool {
        let Some(own) = self.own.as_mut().filter(|own| own.is_task && own.follows) else {
            return false;
        };
        let name = self.program.source().get(call.name.as_usize()).unwrap_or_default();
        if !is_statement(name) {
            return false;
        }
        own.statement = Some(call.range);
        // its text has its own reader
        self.words.declares = true;
        true
    }

    /// A name at the start of a block: `OPART` begins a program.
    pub(crate) fn task_label(&mut self, range: TextRange) {
        let begins = |letters: &[u8]| {
            self.program
                .bytes(range)
                .first()
                .is_some_and(|first| letters.contains(first))
        };
        let quirks = &self.dialect.quirks;
        // `:50` is O50 on a control with Macro B
        if quirks.user_task() && begins(b"Oo") || quirks.macro_b() && begins(b":") {
            self.words.program_number = Some(range);
        }
    }
}

impl<'d> Iso<'d> {
    /// Does what the reader has recorded in a block.
    pub(crate) fn task_words(
        &mut self,
        block: &Block<'_>,
        codes: &mut Vec<Found<'d>>,
        words: &mut Words,
        report: &mut Report<'_>,
    ) {
        if let Some((range, message)) = wrong_head(block) {
            let kind = FaultKind::Rejected {
                refusal: Refusal::Number,
                message,
                alarm: None,
            };
            report.fault(range, kind);
        }
        if words.program_number.is_some() && self.flow.follows && self.begins_another(block) {
            // the program before it ends here, without M02 or RTS
            codes.clear();
            *words = Words::default();
            self.core.state.ended = true;
            return;
        }
        if let Some(range) = self.memory.own.statement.take() {
            let alone = codes.is_empty() && words.letters & !NUMBER == 0 && !words.axes.any() && !words.forgets_all;
            self.task_statement(block, range, alone, report);
        }
    }

    #[cold]
    fn task_statement(&mut self, block: &Block<'_>, range: TextRange, alone: bool, report: &mut Report<'_>) {
        let (dialect, program, file) = (self.core.dialect, block.program(), self.flow.file());
        let (flow, memory) = (&mut self.flow, &mut self.memory);
        let mut index = || flow.trail().index(file, || index_of(dialect, program));
        let mut statement = Statement {
            text: Text::of(block, range.start),
            own: &mut memory.own,
            block: block.id().0,
            index: &mut index,
        };
        let asked = if alone {
            statement.read()
        } else {
            let what = "other words in the block of a flow statement".to_owned();
            Err((range, FaultKind::NotDecided { what }))
        };
        let pending = asked.unwrap_or_else(|(range, kind)| {
            report.fault(range, kind);
            Transfer::End
        });
        self.memory.own.pending = Some(pending);
    }
}

/// What is wrong with the name at the start of a block.
fn wrong_head(block: &Block<'_>) -> Option<(TextRange, String)> {
    let range = block.range();
    let bytes = block.program().bytes(range);
    let start = bytes.iter().position(|byte| !matches!(byte, b' ' | b'\t' | b'/'))?;
    let letter = bytes[start].to_ascii_uppercase();
    let rest = &bytes[start + 1..];
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let plain = letter == b'N' && (1..=4).contains(&digits);
    if plain && matches!(rest.get(digits), None | Some(b' ' | b'\t')) || !matches!(letter, b'N' | b'O') {
        return None;
    }
    let head = super::index::head(block)?;
    let from = range.start + start as u32;
    // a text that is no UTF-8 is longer when it is read
    let place = TextRange::new(from, (from + head.len() as u32).min(range.end));
    let letter = char::from(letter);
    if letter == 'N' && head.len() == digits + 1 && digits > 4 {
        // numbers of more digits are in programs that posts write
        return None;
    }
    if !is_name(&head, letter) && head.len() > 1 && !head[1..].trim().bytes().all(|byte| byte.is_ascii_digit()) {
        return Some((
            place,
            format!("`{head}`: a name after {letter} has at most 4 letters or digits; shorten it"),
        ));
    }
    let behind = bytes.get(start + head.len());
    let ends = matches!(behind, None | Some(b' ' | b'\t' | b'(' | b'\r' | b'\n'));
    (letter == 'N' && !ends).then(|| (place, format!("`{head}` must be followed by a blank: write `{head} `")))
}
