//! Numbers that may not be negative, or have no decimal point.
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_dialect::{CodeKind, Macros};
use trunnion_syntax::{TextRange, Value, Word};

/// The fact that a number must be 0 or more.
pub(crate) fn below_zero(name: &str) -> FaultKind {
    FaultKind::Rejected {
        refusal: Refusal::Number,
        message: format!("{name} is negative: it must be 0 or more"),
        alarm: None,
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// N of a Fanuc takes no minus (alarm PS0006), and N of a Sinumerik is a positive whole number (NC-PB/gEdit, syntax of the SINUMERIK, block
    /// numbers).
    pub(crate) fn block_number(&mut self, word: &Word) {
        let quirks = &self.dialect.quirks;
        let is_judged = quirks.macro_b() || quirks.declares_names();
        if is_judged && matches!(word.value, Value::Number(number) if number.to_f64() < 0.0) {
            (self.report)(word.range, below_zero("N"));
        }
    }

    /// M of a Fanuc takes no decimal point (alarm PS0007, illegal use of the decimal point); `M8.5` is another code.
    pub(crate) fn point_of_code(&mut self, kind: CodeKind, word: &Word) {
        let Value::Number(number) = word.value else { return };
        let is_whole = number.to_f64().fract() == 0.0;
        if kind == CodeKind::M && number.has_point && is_whole && self.dialect.quirks.macros == Macros::Fanuc {
            let message = format!("M takes no decimal point: write M{}", number.to_f64());
            let kind = FaultKind::Rejected {
                refusal: Refusal::Number,
                message,
                alarm: None,
            };
            (self.report)(word.range, kind);
        }
    }
}

impl Iso<'_> {
    /// How much a block of a Sinumerik takes.
    pub(super) fn block_rules(&self, codes: &[Found<'_>], words: &Words, report: &mut Report<'_>) {
        if self.core.dialect.quirks.declares_names() {
            crate::sinumerik::one_block(codes, words, report);
        }
    }

    /// S, T, H, D, F, and the time of a dwell: a Fanuc refuses a minus there (alarm PS0006, illegal use of the minus sign). P of a dwell takes no
    /// decimal point on a Fanuc (FANUC Series 30i operator's manual B-63944EN, Dwell (G04): X takes one).
    pub(super) fn signs(&self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) {
        let said = [
            ("S", words.speed),
            ("T", words.tool),
            ("H", words.length_offset),
            ("D", words.letter(b'D')),
            ("P", words.p),
            // beside a motion the feed itself is judged
            ("F", words.feed),
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
            let counts = match name {
                "P" => block.dwell,
                "F" => !block.dwell && !words.axes.any(),
                _ => true,
            };
            if negative && counts {
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
