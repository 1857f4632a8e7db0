//! What of a block is unknown.
use super::sort::letter_bit;
use crate::words::{WordValue, Words};
use crate::{Motion, MotionKind};

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
