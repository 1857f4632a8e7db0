//! One program laid out, with the proof that nothing but the layout has changed.
use crate::proof::first_difference;
use crate::same::same_text;
use crate::style::Style;
use crate::text::lay_out;
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_same::Difference;
use trunnion_syntax::{Program, TextRange, parse};

/// The outcome of a layout.
#[derive(Clone, Debug, PartialEq)]
pub enum Layout {
    /// The text has this layout already.
    Unchanged,
    /// The new text, proved to contain the same words and to make the same motions.
    Changed(Vec<u8>),
    /// It could not be proved: the text must stay as it is.
    Refused(Refusal),
}

/// Why a new layout was rejected.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The new text would not contain the same words; the place in it.
    Words(TextRange),
    /// The run of the new text differs.
    Motions(Difference),
    /// The new text would be laid out differently once more; the first such byte.
    NotStable(u32),
}

/// Lays out a program and proves it.
pub fn layout(program: &Program, dialect: &Dialect, setup: &Setup, style: &Style) -> Layout {
    let text = lay_out(program, dialect, style);
    if text == program.source() {
        return Layout::Unchanged;
    }
    let after = parse(text, program.options());
    if let Some(place) = same_text(program, &after) {
        return Layout::Refused(Refusal::Words(place));
    }
    let again = lay_out(&after, dialect, style);
    if again != after.source() {
        let at = again.iter().zip(after.source()).take_while(|(a, b)| a == b).count();
        return Layout::Refused(Refusal::NotStable(at as u32));
    }
    match first_difference(program, &after, dialect, setup, false) {
        Some(difference) => Layout::Refused(Refusal::Motions(difference)),
        None => Layout::Changed(after.source().to_vec()),
    }
}
