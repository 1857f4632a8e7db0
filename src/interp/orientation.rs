//! The tool's orientation: rotary words or a programmed vector.
use crate::offsets::ROTARY;
use crate::run::{Interpreter, Report};
use crate::words::{Places, Words};
use crate::{FaultKind, Orientation};
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;

/// A norm that differs from 1 by less than this is what six decimals can do.
const UNIT_NORM: f64 = 1e-5;

impl Interpreter<'_> {
    /// The orientation that is in force with nothing programmed.
    pub(crate) fn held_orientation(&self) -> Orientation {
        match self.state.orientation {
            Orientation::Words => Orientation::Words,
            Orientation::Vector(_, vector) => Orientation::Vector(Some(vector), vector),
        }
    }

    /// The orientation of a motion, from the vector or the rotary words of its block; else it stays as it is.
    pub(crate) fn orientation(&mut self, words: &Words, report: &mut Report<'_>) -> Orientation {
        let is_arc = matches!(
            self.state.motion,
            Some(Action::ArcClockwise | Action::ArcCounterClockwise)
        );
        let orientation = if words.vector.any() {
            if self.state.tcp {
                self.vector(&words.vector, false, report, words)
            } else {
                let what = "tool vector without tool centre point control".to_owned();
                report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
                self.unknown_orientation()
            }
        } else if self.state.vector_mode && !is_arc && words.centre.any() {
            self.vector(&words.centre, self.dialect.quirks.unit_vectors, report, words)
        } else if (words.axes.given | words.axes.unread) & ROTARY != 0 {
            Orientation::Words
        } else {
            self.held_orientation()
        };
        self.state.orientation = orientation;
        orientation
    }

    fn unknown_orientation(&mut self) -> Orientation {
        self.state.position.known &= !ROTARY;
        Orientation::Words
    }

    fn vector(&mut self, places: &Places<3>, unit: bool, report: &mut Report<'_>, words: &Words) -> Orientation {
        if places.unread != 0 {
            return self.unknown_orientation();
        }
        // components that are not programmed are 0
        let vector = Vec3::from(places.values);
        self.unit_vector(vector, unit, words.first.unwrap_or_default(), report)
    }

    /// The orientation along a vector of any length; says so where the length should be 1, and where it is 0.
    pub(crate) fn unit_vector(
        &mut self,
        vector: Vec3,
        unit: bool,
        range: trunnion_syntax::TextRange,
        report: &mut Report<'_>,
    ) -> Orientation {
        let norm = vector.norm();
        if norm <= f64::MIN_POSITIVE || !norm.is_finite() {
            report.fault(range, FaultKind::VectorNotUnit { norm: 0.0 });
            return self.unknown_orientation();
        }
        if unit && (norm - 1.0).abs() > UNIT_NORM {
            report.fault(range, FaultKind::VectorNotUnit { norm });
        }
        let before = match self.state.orientation {
            Orientation::Vector(_, before) => Some(before),
            Orientation::Words => None,
        };
        Orientation::Vector(before, vector / norm)
    }
}
