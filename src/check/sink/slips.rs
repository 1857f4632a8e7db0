//! The letter O in place of a zero.
use super::Reporter;
use crate::Severity;
use crate::slip::letter_o;
use trunnion_syntax::TextRange;

impl Reporter<'_> {
    /// Whether a place is in a word that has the letter O for a zero; that is reported once for each such word, in place of what else
    /// is wrong with it.
    pub(crate) fn is_slip(&mut self, range: TextRange) -> bool {
        let Some(slip) = letter_o(self.program, range.start) else {
            return false;
        };
        if self.slips.insert(slip.range.start) {
            let text = self.text(slip.range);
            let meant = slip.meant;
            self.report(
                slip.range,
                format!("`{text}` contains the letter O; did you mean `{meant}`?"),
            )
            .severity(Severity::Error)
            .help(format!("write {meant}, with the digit 0"))
            .replace_with(meant);
        }
        true
    }

    /// The same where names are words, too: the word has a digit or a point besides the letter O, before it or right after it.
    pub(crate) fn is_slip_of_digits(&mut self, range: TextRange) -> bool {
        let Some(slip) = letter_o(self.program, range.start) else {
            return false;
        };
        let text = self.program.text(slip.range);
        let is_name = text.as_bytes().get(1).is_some_and(u8::is_ascii_alphabetic) && !text.contains(['.', '=']);
        !is_name && self.is_slip(range)
    }

    /// Whether a place is in a word that has the letter O for a zero.
    pub(crate) fn has_letter_o(&self, range: TextRange) -> bool {
        letter_o(self.program, range.start).is_some()
    }
}
