//! Lines that no run has reached, but that something may run which is not modelled: a figure copy, a modal macro, a pocket whose outline is a
//! subprogram, a roughing cycle whose cuts are given up. Its words name the place; what stands there is not among them.
use crate::item::Step;
use crate::process::shown;
use crate::steps::Steps;
use crate::verdict::{Difference, Verdict};
use std::collections::BTreeSet;
use trunnion_interp::{Argument, Interpreter, canonical_text};
use trunnion_syntax::{Address, Block, BlockId, Item, Value};

/// What may run lines that the run has not reached.
#[derive(Default)]
pub(crate) struct Elsewhere {
    /// The first thing that is not modelled and may run other lines: its block, and its words.
    first: Option<(BlockId, String)>,
    /// Blocks of the contours of turning cycles.
    passed: BTreeSet<BlockId>,
}

impl Elsewhere {
    /// Something that is not modelled.
    pub(crate) fn note(&mut self, block: BlockId, words: &[Argument]) {
        if self.first.is_none() && names_place(words) {
            self.first = Some((block, shown(words)));
        }
    }

    /// A motion of which not everything is known.
    pub(crate) fn note_said(&mut self, step: &Step) {
        let Some(said) = &step.said else { return };
        if self.first.is_none() && in_text(said) {
            self.first = Some((step.motion.block, said.lines().next().unwrap_or_default().to_owned()));
        }
    }

    /// A block of the contour of a turning cycle: the cycle has run it, or given it up. G70 moves along the contour, whose blocks are compared
    /// as motions then.
    pub(crate) fn note_passed(&mut self, run: &Interpreter<'_>, block: &Block<'_>) {
        if run.passes_over(block.id()) {
            self.passed.insert(block.id());
        } else if let Some([from, to]) = finished(block).filter(|_| !self.passed.is_empty()) {
            let of = |id: &BlockId| number(&block.program().block(*id));
            let find = |wanted: f64| self.passed.iter().find(|id| of(id) == Some(wanted)).copied();
            if let (Some(first), Some(last)) = (find(from), find(to)) {
                self.passed.retain(|id| !(first..=last).contains(id));
            }
        }
    }
}

/// The number of a block.
fn number(block: &Block<'_>) -> Option<f64> {
    block.words().find_map(|word| match (word.address, word.value) {
        (Address::Letter(b'N'), Value::Number(number)) => Some(number.to_f64()),
        _ => None,
    })
}

/// The first and the last number of the contour along which G70 moves.
fn finished(block: &Block<'_>) -> Option<[f64; 2]> {
    let of = |letter: u8| {
        block.words().find_map(|word| match (word.address, word.value) {
            (Address::Letter(found), Value::Number(number)) if found == letter => Some(number.to_f64()),
            _ => None,
        })
    };
    (of(b'G') == Some(70.0)).then_some([of(b'P')?, of(b'Q')?])
}

/// Whether the words of a statement may name blocks or a program: P and Q, and calls by name.
fn names_place(words: &[Argument]) -> bool {
    words.iter().any(|word| match word.name.as_ref() {
        "P" | "Q" => true,
        // a whole statement in one text
        _ => in_text(&word.to_string()),
    })
}

/// The same of the text of a block.
fn in_text(text: &str) -> bool {
    let words = text.split(|byte: char| !(byte.is_ascii_alphanumeric() || byte == '_' || byte == '#'));
    let of_letter = |word: &str| {
        let rest = word.strip_prefix(['P', 'Q', 'p', 'q']);
        rest.is_some_and(|rest| rest.starts_with(|first: char| first.is_ascii_digit() || first == '#'))
    };
    let is_call = |word: &str| {
        ["CALL", "PCALL", "EXTCALL", "REPEAT"]
            .iter()
            .any(|call| word.eq_ignore_ascii_case(call))
    };
    words.into_iter().any(|word| of_letter(word) || is_call(word))
}

/// The blocks of a program that have not run, in one spelling.
fn not_run(steps: &Steps<'_>) -> Vec<String> {
    let program = steps.input().program;
    let says = |item: &Item| !matches!(item, Item::Comment(_) | Item::Percent(_));
    let blocks = (0..program.block_count() as u32).map(BlockId);
    blocks
        .filter(|block| !steps.has_run(*block) || steps.run.elsewhere.passed.contains(block))
        .filter(|block| program.block(*block).items().any(|item| says(&item)))
        .map(|block| canonical_text(&program.text(program.block(block).range())))
        .collect()
}

/// Undecided, where something that is not modelled may run lines that differ.
pub(crate) fn same_elsewhere(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    let [was, is] = [before, after].map(|steps| steps.run.elsewhere.first.as_ref());
    let Some((_, name)) = was.or(is) else {
        return Ok(());
    };
    if not_run(before) == not_run(after) {
        return Ok(());
    }
    Err(Verdict::Unknown(Difference {
        before: was.map(|(block, _)| *block),
        after: is.map(|(block, _)| *block),
        what: format!(
            "`{name}` is not modelled and may run other lines of the program, and the lines that have not run differ"
        ),
    }))
}
