//! Mistakes of cutter radius compensation that do not depend on the radius, where that is zero or not known: then motions are the programmed ones.
use crate::core::Report;
use crate::iso::Iso;
use crate::{Motion, MotionKind};
use trunnion_dialect::Plane;

/// How far compensation without a radius is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Unmeasured {
    /// There is none.
    #[default]
    Off,
    /// G41 or G42 is active, the next motion in the plane moves to the contour.
    Begins(Plane),
    /// Along the contour.
    Follows(Plane),
}

impl Iso<'_> {
    /// G41 or G42 with a radius that is zero or not known.
    pub(super) fn begin_unmeasured(&mut self) {
        self.memory.compensation.unmeasured = Unmeasured::Begins(self.core.state.coordinates.plane());
    }

    /// Looks at the motion of a block.
    pub(crate) fn judge_unmeasured(&mut self, motion: Option<&Motion>, report: &mut Report<'_>) {
        let (plane, begins) = match self.memory.compensation.unmeasured {
            Unmeasured::Off => return,
            Unmeasured::Begins(plane) => (plane, true),
            Unmeasured::Follows(plane) => (plane, false),
        };
        let on = self.core.state.compensation != 0;
        if on && self.core.state.coordinates.plane() != plane {
            self.memory.compensation.unmeasured = Unmeasured::Off;
            return self.reject(super::PLANE_CHANGES, "plane-change", report);
        }
        let [first, second, _] = crate::arc::plane_axes(plane);
        let moves = |motion: &&Motion| {
            let is_path = matches!(motion.kind, MotionKind::Linear | MotionKind::Rapid | MotionKind::Arc(_));
            let goes_on = [first, second]
                .iter()
                .any(|axis| motion.start.get(*axis) != motion.end.get(*axis));
            // a full circle ends where it begins
            is_path && (goes_on || matches!(motion.kind, MotionKind::Arc(_)))
        };
        let Some(motion) = motion.filter(moves) else { return };
        self.memory.compensation.unmeasured = match (begins, on) {
            (_, false) => Unmeasured::Off,
            (_, true) => Unmeasured::Follows(plane),
        };
        if let MotionKind::Arc(_) = motion.kind {
            if begins && on {
                self.reject(super::STARTS_WITH_ARC, "arc-start-or-cancel", report);
            } else if !on {
                self.reject(super::ENDS_WITH_ARC, "arc-start-or-cancel", report);
            }
        }
    }
}
