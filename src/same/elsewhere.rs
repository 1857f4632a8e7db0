//! Lines that no run has reached, but that something may run which is not modelled: a figure copy, a modal macro, a pocket whose outline is a
//! subprogram, a roughing cycle whose cuts are given up. Its words name the place; what stands there is not among them.
use crate::item::Step;
use crate::process::shown;
use crate::steps::Steps;
use crate::verdict::{Difference, Verdict};
use std::collections::BTreeSet;
use trunnion_interp::{Argument, Interpreter, canonical_text};
use trunnion_syntax::{BlockId, Item};

/// What depends on lines that no run has reached, or on values that nobody knows.
#[derive(Default)]
pub(crate) struct Elsewhere {
    /// The first thing that is not modelled and may run other lines: its block, and its words.
    first: Option<(BlockId, String)>,
    /// Blocks of the contours of turning cycles.
    passed: BTreeSet<BlockId>,
    /// Not everything is known of some motion, whose words are compared instead.
    open: bool,
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
        self.open = true;
        if self.first.is_none() && in_text(said) {
            self.first = Some((step.motion.block, said.lines().next().unwrap_or_default().to_owned()));
        }
    }

    /// A block of the contour of a turning cycle: the cycle has run it, or given it up.
    pub(crate) fn note_passed(&mut self, run: &Interpreter<'_>, block: BlockId) {
        if run.passes_over(block) {
            self.passed.insert(block);
        }
    }
}

impl Steps<'_> {
    /// Whether not everything is known of some motion, so that the words of its block were compared.
    pub fn has_open_motion(&self) -> bool {
        self.run.elsewhere.open
    }
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
