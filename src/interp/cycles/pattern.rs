//! Holes on a circle, an arc or a line (Haas G70, G71, G72): the active cycle runs at each of them.
use crate::arc::plane_axes;
use crate::codes::Found;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_dialect::Action;
use trunnion_geometry::math::sin_cos;

/// Holes of one block.
const MOST_HOLES: u32 = 10_000;

/// A pattern in the current block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pattern {
    /// G70.
    Circle,
    /// G71.
    Arc,
    /// G72.
    Line,
}

impl Pattern {
    pub(crate) fn of(found: &Found<'_>) -> Option<Self> {
        match found.code.action {
            Action::BoltCircle => Some(Self::Circle),
            Action::BoltArc => Some(Self::Arc),
            Action::BoltLine => Some(Self::Line),
            _ => None,
        }
    }
}

impl Iso<'_> {
    /// Runs the active cycle at the holes of the pattern; I is a radius or distance, J an angle, K an angle, L counts.
    pub(crate) fn pattern(&mut self, pattern: Pattern, words: &Words, report: &mut Report<'_>) {
        let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
        if !self.core.state.motion.is_some_and(Action::is_hole_cycle) {
            let message = "a pattern of holes without a canned cycle: program the cycle first, with L0".to_owned();
            self.refuse(words, Refusal::CannedCycle, message, None, report);
            return;
        }
        let angle = |letter: u8| words.letter(letter).number().map(|number| number.value);
        let (size, first, step) = (self.length_word(words, b'I'), angle(b'J').unwrap_or(0.0), angle(b'K'));
        let count = words.letter(b'L').index().filter(|&count| count <= MOST_HOLES);
        let (Some(size), Some(count)) = (size, count) else {
            let message = "a pattern of holes without I (radius or distance) or L (number of holes)".to_owned();
            self.refuse(words, Refusal::CannedCycle, message, None, report);
            return;
        };
        let step = match (pattern, step) {
            (Pattern::Circle, _) => 360.0 / f64::from(count.max(1)),
            (Pattern::Arc, Some(step)) => step,
            (Pattern::Line, _) => 0.0,
            (Pattern::Arc, None) => {
                let message = "G71 without K, the angle between holes".to_owned();
                self.refuse(words, Refusal::CannedCycle, message, None, report);
                return;
            }
        };
        let position = self.core.state.position;
        let mut centre = self.memory.frames.programmed(&position);
        self.place(words, &mut centre);
        let (Some(x), Some(y)) = (centre.get(a), centre.get(b)) else {
            let what = "a pattern of holes around an unknown point".to_owned();
            report.fault(report.whole(), FaultKind::NotModelled { what });
            self.core.forget_linear();
            return;
        };
        let incremental = std::mem::replace(&mut self.core.state.coordinates.incremental(), false);
        for hole in 0..count {
            if self.is_full() {
                self.too_many(words, plane_axes(self.core.state.coordinates.plane())[2], report);
                break;
            }
            let number = f64::from(hole);
            let (along, degrees) = match pattern {
                Pattern::Line => (size * number, first),
                _ => (size, first + step * number),
            };
            let (sin, cos) = sin_cos(degrees.to_radians());
            let unit = self.core.state.coordinates.unit_mm();
            let mut place = Words::default();
            place.axes.values[a] = (x + along * cos) / unit;
            place.axes.values[b] = (y + along * sin) / unit;
            place.axes.given = (1 << a) | (1 << b);
            place.first = words.first;
            place.feed = words.feed;
            self.hole_cycle(&place, report);
        }
        self.core.state.coordinates.set_incremental(incremental);
    }
}
