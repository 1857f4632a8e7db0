//! Splines and polynomials: ASPLINE and CSPLINE go through the points, POLY ends at the first number of PO, BSPLINE ends at its last pole. Their
//! path is not followed: a motion of unknown shape between ends that are known where they are.
//!
//! Sources: Sinumerik 840D sl Programming Manual, Job Planning (07/2010, p. 234: spline interpolation; 12/2019, p. 610: polynomials).
use crate::codes::{BlockCodes, Found};
use crate::core::{LINEAR, Report};
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::{Number, Reading, WordValue, Words, put};
use crate::{AXIS_LETTERS, FaultKind, Motion, MotionKind};
use trunnion_dialect::Action;
use trunnion_syntax::{TextRange, Word};

/// What the points of a spline are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spline {
    /// The path goes through them.
    Through,
    /// Poles: the path goes to the first and the last one.
    Poles,
    /// Ends of polynomials.
    Polynomial,
}

impl Spline {
    /// The one that a code begins.
    fn of(id: &str) -> Option<Self> {
        match id {
            "ASPLINE" | "CSPLINE" => Some(Self::Through),
            "BSPLINE" => Some(Self::Poles),
            "POLY" => Some(Self::Polynomial),
            _ => None,
        }
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `PO[X]=(10,2,1)`: the end of X and the coefficients of its polynomial; `PO[]=(..)`: the common denominator. False: another word.
    pub(crate) fn polynomial(&mut self, name: &[u8], word: &Word) -> bool {
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        let Some(inside) = name.strip_prefix("PO").map(str::trim) else {
            return false;
        };
        let Some(axis) = inside
            .strip_prefix('[')
            .and_then(|rest| rest.strip_suffix(']'))
            .map(str::trim)
        else {
            return false;
        };
        if self.own.is_none() {
            return false;
        }
        self.first(word);
        self.words.has_values = true;
        self.words.polynomial = true;
        if axis.is_empty() {
            return true;
        }
        let place = AXIS_LETTERS.iter().position(|letter| axis.as_bytes() == [*letter]);
        let text = self.text(word.value_range);
        let end = text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let end = end.and_then(|numbers| crate::own::arguments(numbers).first().map(|end| (*end).to_owned()));
        let value = end.and_then(|end| self.own.as_ref()?.value(&end));
        match (place, value) {
            (Some(place), Some(value)) => {
                let number = Number {
                    value,
                    has_point: true,
                    range: word.range,
                };
                put(&mut self.words.axes, place, (WordValue::Number(number), Reading::Modal));
            }
            (Some(place), None) => put(&mut self.words.axes, place, (WordValue::Unread, Reading::Modal)),
            (None, _) => {
                self.words.forgets_all = true;
                self.not_modelled(word.range);
            }
        }
        true
    }
}

impl Iso<'_> {
    /// A code of the motion group that is not followed: a spline, or another.
    pub(crate) fn spline_begins(&mut self, id: &str) {
        self.memory.own.spline = Spline::of(id);
    }

    /// The spline to which the motion of a block belongs.
    pub(crate) fn spline(&self, codes: &[Found<'_>], words: &Words, block: &BlockCodes) -> Option<Spline> {
        let spline = self
            .memory
            .own
            .spline
            .filter(|_| self.core.state.motion == Some(Action::NotModelled))?;
        let other = |found: &Found<'_>| {
            found.code.action == Action::NotModelled && found.code.group.as_deref() != self.motion_group()
        };
        let plain = words.axes.any() && !words.unknown_code && !words.forgets_all && !block.takes_coordinates;
        let fits = !words.polynomial || spline == Spline::Polynomial;
        (plain && fits && !block.machine_coordinates && !codes.iter().any(other)).then_some(spline)
    }

    /// Before a block: a B-spline that ended there is at its last pole.
    pub(crate) fn at_last_pole(&mut self) {
        if let Some(pole) = self.memory.own.pole {
            self.core.state.position = pole;
        }
    }

    /// A motion of unknown shape to the programmed end.
    pub(crate) fn spline_motion(
        &mut self,
        spline: Spline,
        words: &Words,
        block: &BlockCodes,
        report: &mut Report<'_>,
    ) -> Motion {
        let goes_on = self.memory.own.pole.take().is_some();
        self.core.state.motion = Some(Action::Linear);
        let mut motion = self.modelled_motion(words, block, report);
        self.core.state.motion = Some(Action::NotModelled);
        motion.kind = MotionKind::Unknown;
        self.memory.own.contour.heading_is_lost();
        if spline == Spline::Poles {
            if goes_on {
                motion.start.known &= !LINEAR;
            }
            self.memory.own.pole = Some(self.core.state.position);
            motion.end.known &= !LINEAR;
            self.core.state.position.known &= !LINEAR;
        }
        motion
    }
}
