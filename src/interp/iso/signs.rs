//! Numbers that may not be negative, or have no decimal point.
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_dialect::Macros;

/// The fact that a number must be 0 or more.
pub(crate) fn below_zero(name: &str) -> FaultKind {
    FaultKind::Rejected {
        refusal: Refusal::Number,
        message: format!("{name} is negative: it must be 0 or more"),
        alarm: None,
    }
}

impl Iso<'_> {
    /// How much a block of a Sinumerik takes.
    pub(super) fn block_rules(&self, codes: &[Found<'_>], words: &Words, report: &mut Report<'_>) {
        if self.core.dialect.quirks.declares_names() {
            crate::sinumerik::one_block(codes, words, report);
        }
    }

    /// S, T, H, D, and the time of a dwell: a Fanuc refuses a minus there (alarm PS0006, illegal use of the minus sign). P of a dwell takes no
    /// decimal point on a Fanuc (FANUC Series 30i operator's manual B-63944EN, Dwell (G04): X takes one).
    pub(super) fn signs(&self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) {
        let said = [
            ("S", words.speed),
            ("T", words.tool),
            ("H", words.length_offset),
            ("D", words.letter(b'D')),
            ("P", words.p),
        ];
        let has_point = words.p.number().is_some_and(|number| number.has_point);
        if block.dwell && has_point && self.core.dialect.quirks.macros == Macros::Fanuc {
            let message =
                "P of a dwell takes no decimal point: it is in milliseconds; X takes one, in seconds".to_owned();
            self.refuse(words, Refusal::Number, message, None, report);
        }
        let axes = &words.axes;
        for (axis, name) in [(0, "X"), (6, "U")] {
            if block.dwell && axes.get(axis).is_some() && axes.values[axis] < 0.0 {
                let message = format!("{name} is negative: the time of a dwell must be 0 or more");
                self.refuse(words, Refusal::Number, message, None, report);
            }
        }
        for (name, value) in said {
            let negative = value.number().is_some_and(|number| number.value < 0.0);
            if negative && (name != "P" || block.dwell) {
                let message = format!("{name} is negative: it must be 0 or more");
                self.refuse(words, Refusal::Number, message, None, report);
            }
        }
    }

    /// S, T and D of a Sinumerik have no values below 0; neither has the time of a dwell.
    pub(super) fn numbers_from_zero(&self, words: &Words, is_dwell: bool, report: &mut Report<'_>) {
        if is_dwell {
            self.dwell_sign(words, report);
        }
        let speed = Some(("S", words.speed)).filter(|_| !is_dwell);
        for (name, value) in speed.into_iter().chain([("T", words.tool), ("D", words.edge)]) {
            if let Some(number) = value.number().filter(|number| number.value < 0.0) {
                report.fault(number.range, below_zero(name));
            }
        }
    }

    /// The time of a dwell, on controls without the alarm of [`Self::signs`].
    pub(super) fn dwell_sign(&self, words: &Words, report: &mut Report<'_>) {
        for (name, value) in [("F", words.feed), ("P", words.p), ("S", words.speed)] {
            if value.number().is_some_and(|number| number.value < 0.0) {
                let message = format!("{name} is negative: the time of a dwell must be 0 or more");
                self.refuse(words, Refusal::Number, message, None, report);
            }
        }
    }
}
