//! TRANS DATUM: the datum shift of newer controls, in place of cycle 7: AXIS shifts by values, RESET takes a shift back, TABLE reads a datum
//! table (NC-PB/gEdit, docs/planning/syntax/syntax-heidenhain.md, 4.1 and 5).
//!
//! Whether an axis that AXIS leaves out keeps its shift, and what an increment counts from, is not taken from a source.
use super::Klartext;
use super::path_words::PathWords;
use super::words::Words;
use crate::Refusal;
use crate::core::Report;

impl Klartext<'_> {
    /// What follows TRANS DATUM.
    pub(super) fn trans_datum(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        self.flush(report);
        if words.takes_word("RESET") {
            let mut every = PathWords::default();
            (every.given, every.values) = ((1 << 9) - 1, [Some(0.0); 9]);
            return self.shift_datum("TRANS DATUM RESET", &every, report);
        }
        if words.takes_word("AXIS") {
            return self.trans_datum_axis(words, report);
        }
        let what = if words.takes_word("TABLE") {
            "TRANS DATUM TABLE: a datum from a table"
        } else {
            "TRANS DATUM in another form than AXIS, RESET and TABLE"
        };
        self.datum_is_unknown(what, report);
    }

    fn trans_datum_axis(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        let mut found = self.path_words(words, report);
        if found.no_number {
            return self.lose_datum();
        }
        if !found.moves() {
            let message = "TRANS DATUM AXIS needs the shift of an axis";
            Self::rejected(Refusal::MissingWord, message, report);
            return self.lose_datum();
        }
        if found.incremental != 0 {
            return self.datum_is_unknown("TRANS DATUM AXIS with increments: what they count from", report);
        }
        let shifted = |axis: &usize| self.memory.frames.local[*axis] != 0.0 || *axis < 3 && self.memory.shift_unknown;
        let left_out = (0..9)
            .filter(|axis| found.given & 1 << axis == 0)
            .any(|axis| shifted(&axis));
        if left_out {
            let what = "TRANS DATUM AXIS that leaves out a shifted axis: whether that keeps its shift";
            return self.datum_is_unknown(what, report);
        }
        // an axis that is left out has no shift, so it is 0 either way
        for axis in (0..3).filter(|axis| found.given & 1 << axis == 0).collect::<Vec<_>>() {
            found.given |= 1 << axis;
            found.values[axis] = Some(0.0);
        }
        self.shift_datum("TRANS DATUM AXIS", &found, report);
    }

    fn datum_is_unknown(&mut self, what: &str, report: &mut Report<'_>) {
        self.memory.unfollowed = true;
        Self::not_modelled(what, report);
        self.lose_datum();
    }
}
