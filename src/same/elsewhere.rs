//! Lines that no run has reached, but that something may run which is not modelled: a figure copy, a modal macro, a pocket whose outline is a
//! subprogram, a roughing cycle whose cuts are given up. Its words name the place; what stands there is not among them.
use crate::item::Step;
use crate::process::shown;
use crate::steps::Steps;
use crate::verdict::{Difference, Verdict};
use trunnion_interp::{Argument, canonical_text};
use trunnion_syntax::{BlockId, Item};

/// The first thing that is not modelled and may run other lines: its block, and its words.
#[derive(Default)]
pub(crate) struct Elsewhere(Option<(BlockId, String)>);

impl Elsewhere {
    /// Something that is not modelled.
    pub(crate) fn note(&mut self, block: BlockId, words: &[Argument]) {
        if self.0.is_none() && names_place(words) {
            self.0 = Some((block, shown(words)));
        }
    }

    /// A motion of which not everything is known.
    pub(crate) fn note_said(&mut self, step: &Step) {
        if let (Some(said), None) = (&step.said, &self.0)
            && in_text(said)
        {
            self.0 = Some((step.motion.block, said.lines().next().unwrap_or_default().to_owned()));
        }
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
        .filter(|block| !steps.has_run(*block) && program.block(*block).items().any(|item| says(&item)))
        .map(|block| canonical_text(&program.text(program.block(block).range())))
        .collect()
}

/// Undecided, where something that is not modelled may run lines that differ.
pub(crate) fn same_elsewhere(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    let [was, is] = [before, after].map(|steps| steps.run.elsewhere.0.as_ref());
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
