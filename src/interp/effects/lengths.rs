//! Words of stored data that are lengths, in mm.
use crate::codes::Found;
use crate::words::Words;
use crate::{Argument, Value};
use trunnion_dialect::Action;

/// Whether the numbers of a data entry are lengths where they are not angles: work offsets, and offsets of tools.
pub(super) fn in_lengths(codes: &[&&Found<'_>], words: &Words) -> bool {
    let entry = |found: &&&Found<'_>| found.code.action == Action::DataEntry;
    codes.iter().all(entry) && matches!(words.letter(b'L').index(), Some(2 | 20 | 10..=13))
}

/// A length in programmed units becomes one in mm.
pub(super) fn to_mm(argument: &mut Argument, unit_mm: f64) {
    if let (b"X" | b"Y" | b"Z" | b"U" | b"V" | b"W" | b"R", Value::Number(value)) =
        (argument.name.as_bytes(), &mut argument.value)
    {
        *value *= unit_mm;
    }
}

/// Whether the unit may change what codes do: M29 without numbers does the same in both.
pub(super) fn may_read_unit(codes: &[&&Found<'_>], event: &[Argument]) -> bool {
    let plain = codes.iter().all(|found| found.code.action == Action::NoMotion);
    !plain || event.iter().any(|word| !matches!(word.value, Value::Nothing))
}
