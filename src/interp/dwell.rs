//! Dwells: G4 with the words that its code reads.
use crate::codes::{Found, dwell_reads};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, Motion, MotionKind};
use trunnion_dialect::Action;
use trunnion_syntax::TextRange;

impl Iso<'_> {
    pub(crate) fn dwell(&self, codes: &[Found<'_>], words: &Words, report: &mut Report<'_>) -> Motion {
        if let Some(range) = self.whole_dwell(codes, words) {
            report.fault(range, FaultKind::AmbiguousDecimal);
        }
        let several =
            dwell_reads(codes, "F") && words.feed.is_given() && dwell_reads(codes, "S") && words.speed.is_given();
        if several {
            let what = "a dwell with F and S: which of both times counts".to_owned();
            report.fault(report.whole(), FaultKind::NotModelled { what });
        }
        let said = self.dwell_seconds(codes, words).filter(|_| !several);
        let seconds = said.filter(|seconds| *seconds >= 0.0);
        let given = words.p.is_given() || words.feed.is_given() || words.speed.is_given() || words.axes.any();
        if said.is_none() && !given {
            let what = "a dwell without its time: write the word that gives it".to_owned();
            report.fault(report.whole(), FaultKind::NotModelled { what });
        }
        let position = self.core.state.position;
        let feed = Feed::Unknown;
        let kind = MotionKind::Dwell(seconds);
        self.core
            .motion_in_frame(kind, [position, position], self.core.held_orientation(), feed, report)
    }

    /// Axes in the block of a dwell that are not its time.
    pub(crate) fn axes_beside_dwell(codes: &[Found<'_>], words: &Words) -> u16 {
        let named = words.axes.given | words.axes.unread;
        if named == 0 {
            return 0;
        }
        let code = codes.iter().find(|found| found.code.action == Action::Dwell);
        let reads = |word: &str| code.is_some_and(|found| found.code.words.iter().any(|known| known == word));
        let mut time = 0;
        if !words.p.is_given() || !reads("P") {
            time |= u16::from(reads("X"));
            time |= u16::from(reads("U")) << 6;
        }
        named & !time
    }

    /// No manual says whether axes move in the block of a dwell: they are unknown after it.
    pub(crate) fn moved_with_dwell(&mut self, axes: u16, words: &Words, report: &mut Report<'_>) -> Motion {
        let what = "axes in the block of a dwell".to_owned();
        report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        let start = self.core.state.position;
        self.core.state.position.known &= !axes;
        let end = self.core.state.position;
        self.core.new_motion(
            MotionKind::Unknown,
            start,
            end,
            self.core.held_orientation(),
            Feed::Unknown,
            report,
        )
    }

    /// Seconds of a dwell: from P, X, U or F as the code reads them, or from S turns of the spindle.
    fn dwell_seconds(&self, codes: &[Found<'_>], words: &Words) -> Option<f64> {
        let code = codes.iter().find(|found| found.code.action == Action::Dwell)?.code;
        let reads = |word: &str| code.words.iter().any(|known| known == word);
        let in_ms = |has_point: bool| {
            if self.core.dialect.quirks.dwell_in_ms && !has_point {
                1e-3
            } else {
                1.0
            }
        };
        if let Some(p) = words.p.number().filter(|_| reads("P")) {
            return Some(p.value * in_ms(p.has_point));
        }
        if let Some(f) = words.feed.number().filter(|_| reads("F")) {
            return Some(f.value);
        }
        if let Some(turns) = words.speed.number().filter(|_| reads("S")) {
            let rpm = self.core.state.spindle.rpm().filter(|&rpm| rpm > 0.0)?;
            return Some(turns.value / rpm * 60.0);
        }
        let axis = Self::dwell_axis(code, words).filter(|axis| !self.is_whole_dwell(words, *axis))?;
        Some(words.axes.values[axis] * in_ms(words.axes.point & (1 << axis) != 0))
    }
    /// The axis whose word is the time.
    fn dwell_axis(code: &trunnion_dialect::Code, words: &Words) -> Option<usize> {
        let reads = |word: &str| code.words.iter().any(|known| known == word);
        let mut axes = [(0, "X"), (6, "U")].into_iter();
        Some(
            axes.find(|&(axis, word)| reads(word) && words.axes.get(axis).is_some())?
                .0,
        )
    }

    /// The time of a dwell that a parameter decides, where the block gives no other.
    fn whole_dwell(&self, codes: &[Found<'_>], words: &Words) -> Option<TextRange> {
        let code = codes.iter().find(|found| found.code.action == Action::Dwell)?.code;
        let reads = |word: &str| code.words.iter().any(|known| known == word);
        let other = words.p.is_given() && reads("P") || words.feed.is_given() && reads("F");
        let axis = Self::dwell_axis(code, words).filter(|_| !other)?;
        words.first.filter(|_| self.is_whole_dwell(words, axis))
    }
}
