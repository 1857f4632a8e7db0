//! Splines: ASPLINE and CSPLINE go through the points, BSPLINE ends at its last pole. Their path is not followed: a motion of unknown shape
//! between ends that are known where they are. Where the knots lie, and how the ends are joined, is not taken from a source.
//!
//! Source: Sinumerik 840D sl Programming Manual, Job Planning (07/2010), p. 234: spline interpolation.
use crate::codes::{BlockCodes, Found};
use crate::core::{LINEAR, Report};
use crate::iso::Iso;
use crate::words::Words;
use crate::{Motion, MotionKind};
use trunnion_dialect::Action;

/// What the points of a spline are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spline {
    /// The path goes through them.
    Through,
    /// Poles: the path goes to the first and the last one.
    Poles,
}

impl Spline {
    /// The one that a code begins.
    fn of(id: &str) -> Option<Self> {
        match id {
            "ASPLINE" | "CSPLINE" => Some(Self::Through),
            "BSPLINE" => Some(Self::Poles),
            _ => None,
        }
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
        (plain && !words.polynomial && !block.machine_coordinates && !codes.iter().any(other)).then_some(spline)
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
