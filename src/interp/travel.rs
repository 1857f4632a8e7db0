//! Point-to-point travel of a Sinumerik under TRAORI (PTP, PTPG0, CP) and its words STAT and TU: the position is programmed as usual, the
//! axes move there synchronously and linearly (840D sl Programming Manual, Job Planning, 03/2013, section 6.9). STAT is modal, TU applies
//! to its block; with continuous-path travel the posture does not change, and
//! neither acts (SINUMERIK ONE Programming Manual, 12/2019, p. 708; Function Manual Transformations, 06/2019, p. 104).
use crate::core::Report;
use crate::iso::Iso;
use crate::reader::Reader;
use crate::values::number;
use crate::words::{WordValue, Words};
use crate::{FaultKind, Motion, MotionKind, Posture, Swivel};
use trunnion_dialect::Action;
use trunnion_syntax::{TextRange, Value, Word};

/// How the axes run between two positions under a transformation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Travel {
    /// CP: the tip is guided.
    #[default]
    Continuous,
    /// PTP.
    PointToPoint,
    /// PTPG0: point to point in rapid motions, else the tip is guided.
    PointToPointRapid,
}

impl Travel {
    /// The code in effect, if it is not the usual one.
    pub(crate) fn word(self) -> Option<crate::Argument> {
        match self {
            Self::Continuous => None,
            Self::PointToPoint => Some(crate::Argument::code("PTP")),
            Self::PointToPointRapid => Some(crate::Argument::code("PTPG0")),
        }
    }
    pub(crate) fn of(action: Action) -> Option<Self> {
        match action {
            Action::ContinuousPath => Some(Self::Continuous),
            Action::PointToPoint => Some(Self::PointToPoint),
            Action::PointToPointRapid => Some(Self::PointToPointRapid),
            _ => None,
        }
    }
}

/// STAT and TU of a block, with their places.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PostureWords {
    pub(crate) status: Option<(Option<u16>, TextRange)>,
    pub(crate) turn: Option<(Option<u16>, TextRange)>,
}

impl PostureWords {
    pub(crate) fn any(&self) -> bool {
        self.status.is_some() || self.turn.is_some()
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// The bits of STAT or TU: a number, `'B101'` or `'H1F'`.
    pub(crate) fn bits(&mut self, word: &Word) -> Option<u16> {
        if let Value::Number(decimal) = word.value
            && let WordValue::Number(number) = number(decimal, word.range)
        {
            let whole = number.value.fract() == 0.0 && (0.0..=f64::from(u16::MAX)).contains(&number.value);
            return whole.then_some(number.value as u16);
        }
        let text = self.text(word.value_range);
        let inside = text.strip_prefix('\'')?.strip_suffix('\'')?;
        let (kind, digits) = inside.split_at_checked(1)?;
        match kind {
            "B" | "b" => u16::from_str_radix(digits, 2).ok(),
            "H" | "h" => u16::from_str_radix(digits, 16).ok(),
            _ => None,
        }
    }
}

impl Iso<'_> {
    /// Makes a motion point to point if that is active, and reports STAT and TU where they are followed or not.
    pub(crate) fn travel(&mut self, motion: &mut Motion, words: &Words, report: &mut Report<'_>) {
        let said = words.posture;
        let straight = matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear);
        let mode = self.memory.travel;
        let under = motion.tcp && !motion.machine_coordinates;
        let applies = under
            && match mode {
                Travel::Continuous => false,
                Travel::PointToPoint => straight,
                Travel::PointToPointRapid => motion.kind == MotionKind::Rapid,
            };
        if under && mode == Travel::PointToPoint && !straight {
            let what = "an arc in point-to-point travel (PTP)".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
        if let Some((status, _)) = said.status {
            self.memory.status = status;
        }
        // with continuous-path travel the control does not read them
        let unread = under && mode == Travel::Continuous;
        let lost =
            |value: Option<(Option<u16>, TextRange)>| value.filter(|(bits, _)| !unread && (!applies || bits.is_none()));
        for (name, word) in [("STAT", lost(said.status)), ("TU", lost(said.turn))] {
            if let Some((_, range)) = word {
                let what = name.to_owned();
                report.fault(range, FaultKind::NotModelled { what });
            }
        }
        if !applies {
            return;
        }
        motion.tilt.swivel = Swivel::PointToPoint;
        let (status, turn) = (self.memory.status, said.turn.and_then(|(bits, _)| bits));
        if status.is_some() || turn.is_some() {
            motion.tilt.posture = Posture::Bits { status, turn };
        }
    }
}
