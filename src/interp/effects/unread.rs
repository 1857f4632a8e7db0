//! What of a block is unknown.
use super::sort::letter_bit;
use crate::words::{WordValue, Words};
use crate::{Argument, Effect, Motion, MotionKind};
use trunnion_syntax::{Block, SyntaxErrorKind, TextRange};

/// What a block does that has text which belongs to no word: the control refuses it, or takes it in a way that is not known.
pub(crate) fn refused(view: &Block<'_>) -> Option<Effect> {
    let (program, range) = (view.program(), view.range());
    let errors = program.errors();
    let from = errors.partition_point(|error| error.range.end <= range.start);
    let mut here = errors[from..].iter().take_while(|error| error.range.start < range.end);
    // what follows a comment inside a comment has its own error, and nothing follows a statement that the end of the file continues
    let is_harmless = |kind| {
        matches!(
            kind,
            SyntaxErrorKind::NestedComment | SyntaxErrorKind::DanglingContinuation
        )
    };
    let is_wrong = here.any(|error| !is_harmless(error.kind));
    let is_control = |byte: &u8| byte.is_ascii_control() && !matches!(byte, b'\t' | b'\r' | b'\n');
    if !is_wrong && !program.bytes(range).iter().any(is_control) {
        return None;
    }
    let start = view.number().map_or(range.start, |number| number.end.max(range.start));
    let text = program.text(TextRange::new(start, range.end.max(start)));
    Some(Effect::Unmodelled(vec![Argument::text(
        "",
        &crate::canonical_text(&text),
    )]))
}

/// Whether a word of the block has a value that is unknown.
pub(super) fn has_unread(words: &Words) -> bool {
    let values = [
        words.feed,
        words.speed,
        words.tool,
        words.edge,
        words.radius,
        words.p,
        words.length_offset,
    ];
    let mut letters = b"DEHIJKLMPQR"
        .iter()
        .copied()
        .filter(|letter| words.letters & letter_bit(*letter) != 0);
    words.axes.unread | words.centre.unread | words.vector.unread != 0
        || letters.any(|letter| matches!(words.letter(letter), WordValue::Unread))
        || values.iter().any(|said| matches!(said, WordValue::Unread))
}

/// Whether a motion has no known path, or no known end in one of the axes that its block names (bits).
pub(super) fn ends_unknown(motion: &Motion, named: u16) -> bool {
    let no_path = matches!(
        motion.kind,
        MotionKind::Arc(None) | MotionKind::Unknown | MotionKind::Dwell(None)
    );
    no_path || named & !motion.end.known != 0
}
