//! The lines that someone looks at, of a file that is too long to be read again at every key: read and judged alone.
//!
//! The lines before the part are empty in it, so that lines and blocks have the numbers of the file, and all that answers requests
//! can work on it. It continues from a check-point of the last whole run that is before every edit since. The whole follows after a pause, and
//! what it finds replaces what a part found.
use crate::{
    analysis::{Analysed, Parsed, Source, Version, settings_of},
    position::Lines,
    text::Text,
};
use core::ops::Range;
use std::{sync::Arc, time::Duration};
use tower_lsp::lsp_types::Url;
use trunnion_check::Session;
use trunnion_syntax::{BlockId, Program, parse_after};
use trunnion_workspace::{Overrides, Resolved};

/// Documents with more bytes are read in parts.
pub(crate) const LARGE: usize = 1 << 20;

/// So many lines are run at most to judge a part.
const FARTHEST: usize = 20_000;

/// A part goes on for so many lines behind what is wanted: compensation and merged findings look ahead.
const BEHIND: usize = 64;

/// The first part of a file that opens: so many lines, and at least as many bytes as decide about the dialect.
const FIRST: usize = 4000;
const FIRST_BYTES: usize = 1 << 17;

/// What is known of a document from its last whole run, or from its beginning.
#[derive(Clone)]
pub(crate) struct Base {
    pub(crate) resolved: Arc<Resolved>,
    /// The last whole run, and whether its lines were blocks.
    pub(crate) whole: Option<(Arc<Session>, bool)>,
}

/// A part of one version of a document.
pub(crate) struct Part {
    pub(crate) analysed: Analysed,
    /// The lines whose findings it has.
    pub(crate) lines: Range<usize>,
    /// The settings it was judged with.
    pub(crate) base: Base,
}

impl Part {
    /// Whether it ran as far as these lines, so that it can describe them.
    pub(crate) fn reaches(&self, lines: &Range<usize>) -> bool {
        let session = self.analysed.session.as_ref();
        session.is_some_and(|session| lines.clone().all(|line| session.reaches(BlockId(line as u32))))
    }
}

/// What a part is made of.
pub(crate) struct Plan {
    pub(crate) uri: Url,
    pub(crate) version: Version,
    pub(crate) text: Text,
    pub(crate) base: Base,
    /// The first line that differs from the text of the whole run.
    pub(crate) edited: usize,
    pub(crate) lines: Range<usize>,
}

/// What a directive begins with, before its colon.
const NAME: &[u8] = b"trunnion";

/// Whether a text addresses Trunnion: such comments count for the whole program.
pub(crate) fn has_directive(text: &[u8]) -> bool {
    memchr::memchr_iter(b':', text).any(|at| {
        let before = &text[at.saturating_sub(NAME.len())..at];
        before.eq_ignore_ascii_case(NAME)
    })
}

/// [`has_directive`] of a text that comes in pieces, which may end inside a line.
fn piece_has_directive<'t>(mut pieces: impl Iterator<Item = &'t str>) -> bool {
    let mut seam: Vec<u8> = Vec::new();
    pieces.any(|piece| {
        let piece = piece.as_bytes();
        seam.extend(&piece[..piece.len().min(NAME.len() + 1)]);
        let found = has_directive(&seam) || has_directive(piece);
        if piece.len() > NAME.len() {
            seam = piece[piece.len() - NAME.len()..].to_vec();
        }
        seam.drain(..seam.len().saturating_sub(NAME.len()));
        found
    })
}

impl Plan {
    /// The lines as a text, for what needs no run.
    pub(crate) fn read(&self) -> Parsed {
        self.parsed(self.lines.start, self.lines.clone())
    }

    /// The part, judged. `None` where its lines are too far from a check-point, or something before them decides what runs.
    pub(crate) fn judge(&self) -> Option<Part> {
        let wanted = self.lines.start as u32..self.lines.end as u32;
        let (first, from) = match &self.base.whole {
            Some((session, true)) => {
                let from = session.restart(BlockId(self.edited as u32), BlockId(wanted.start))?;
                (from.0 as usize, (from.0 > 0).then_some((&**session, from)))
            }
            Some((_, false)) => return None,
            None => (0, None),
        };
        if self.lines.end > first + FARTHEST {
            return None;
        }
        let parsed = self.parsed(first, first..self.lines.end + BEHIND);
        let source = parsed.outcome.as_ref().ok()?;
        let session = Session::of_part(&source.program, &source.resolved.settings(), from, wanted);
        Some(Part {
            analysed: Analysed {
                session: Some(Arc::new(session)),
                parsed: Arc::new(parsed),
                lines_are_blocks: false,
                took: Duration::ZERO,
            },
            lines: self.lines.clone(),
            base: self.base.clone(),
        })
    }

    /// Lines with as many empty ones before them as the file has.
    fn parsed(&self, before: usize, lines: Range<usize>) -> Parsed {
        let text = self.text.of_lines(lines);
        let resolved = Arc::clone(&self.base.resolved);
        let program: Program = parse_after(before as u32, text.as_bytes(), resolved.dialect.lex);
        Parsed {
            uri: self.uri.clone(),
            version: self.version,
            starts: Lines::after(before as u32, text.as_bytes()),
            text: program.shared_source(),
            outcome: Ok(Source::new(program, resolved)),
            toml: None,
        }
    }
}

/// The beginning of a document that opens. `None` where its settings cannot be used, or where the rest says how it is to be judged.
pub(crate) fn first(uri: &Url, version: Version, text: &Text, overrides: &Overrides) -> Option<Part> {
    let mut decide = FIRST.min(text.lines());
    while text.start_of(decide) < FIRST_BYTES.min(text.len()) {
        decide *= 2;
    }
    if piece_has_directive(text.behind(decide)) {
        return None;
    }
    let head = text.of_lines(0..decide);
    let resolved = settings_of(uri, head.as_bytes(), overrides).ok()?;
    let plan = Plan {
        uri: uri.clone(),
        version,
        text: text.clone(),
        base: Base {
            resolved: Arc::new(resolved),
            whole: None,
        },
        edited: 0,
        lines: 0..FIRST.min(decide),
    };
    plan.judge()
}

#[cfg(test)]
mod tests {
    use super::piece_has_directive;

    #[test]
    fn a_directive_is_found_wherever_a_text_is_cut() {
        let text = "G1 X1 (Trunnion: machine a)\nX2";
        for first in 0..text.len() {
            for second in first..text.len() {
                let pieces = [&text[..first], &text[first..second], &text[second..]];
                assert!(piece_has_directive(pieces.into_iter()), "{pieces:?}");
            }
        }
        let bytes = (0..text.len()).map(|at| &text[at..=at]);
        assert!(piece_has_directive(bytes));
        assert!(!piece_has_directive(
            ["(trunnion", " :", "trun", "n", "ion ", ":"].into_iter()
        ));
    }
}
