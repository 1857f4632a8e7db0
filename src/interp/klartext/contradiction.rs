//! Words of one block that say two things.
use super::Klartext;
use super::path_words::PathWords;
use crate::core::Report;

/// M codes that say what the spindle does: M13 and M14 are M3 and M4 with coolant.
fn turns(code: u32) -> Option<u32> {
    match code {
        3 | 13 => Some(3),
        4 | 14 => Some(4),
        5 => Some(5),
        _ => None,
    }
}

/// Whether the coolant is on or off after an M code.
fn cools(code: u32) -> Option<bool> {
    match code {
        7 | 8 | 13 | 14 => Some(true),
        9 => Some(false),
        _ => None,
    }
}

/// The first two codes to which `of` gives different answers.
fn differing<T: PartialEq>(codes: &[u32], of: impl Fn(u32) -> Option<T>) -> Option<(u32, u32)> {
    let mut said = codes.iter().filter_map(|code| Some((*code, of(*code)?)));
    let (first, answer) = said.next()?;
    said.find(|(_, other)| *other != answer)
        .map(|(second, _)| (first, second))
}

impl Klartext<'_> {
    /// Codes for the spindle or the coolant that exclude each other: no source says which one acts.
    pub(super) fn contradicting_codes(&mut self, words: &PathWords, report: &mut Report<'_>) {
        let pairs = [differing(words.codes(), turns), differing(words.codes(), cools)];
        for (first, second) in pairs.into_iter().flatten() {
            self.not_modelled_once(
                &format!("M{first} and M{second} in one block: which of them acts"),
                report,
            );
        }
    }

    /// After such a block it is not known whether the spindle turns.
    pub(super) fn spindle_is_unclear(words: &PathWords) -> bool {
        differing(words.codes(), turns).is_some()
    }
}
