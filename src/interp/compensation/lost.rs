//! Cutter compensation that is not followed: from here on the path is not known, and what was pending says so.
use super::{PendingMotion, Stage};
use crate::core::{LINEAR, Report};
use crate::iso::Iso;
use crate::{Beside, FaultKind, MotionKind};

impl Iso<'_> {
    /// Stops compensating until G40: motions are the programmed ones.
    pub(crate) fn lose(&mut self, why: &str, report: &mut Report<'_>) {
        if matches!(self.memory.compensation.stage, Stage::Off | Stage::Lost) {
            return;
        }
        let first = self.memory.compensation.ready.len();
        self.settle(report);
        self.memory.compensation.stage = Stage::Lost;
        self.core.state.beside = Beside::NotModelled;
        self.memory.compensation.plane = None;
        // the corner after the last motion is not known
        let mut last = self.memory.compensation.ready.split_off(first);
        for pending in &mut last {
            self.mark_lost(pending);
        }
        self.memory.compensation.ready.append(&mut last);
        let what = format!("cutter radius compensation: {why}; the programmed path is used instead");
        report.fault(report.whole(), FaultKind::NotModelled { what });
    }

    /// The system of coordinates changes before what is pending is emitted: where it goes is unknown.
    pub(crate) fn forget_pending(&mut self, report: &mut Report<'_>) {
        self.lose("a tilted plane starts or ends", report);
        let waiting = self.memory.corners.pending();
        for (motion, _) in self.memory.compensation.ready.iter_mut().chain(waiting) {
            motion.kind = MotionKind::Unknown;
            motion.start.known &= !LINEAR;
            motion.end.known &= !LINEAR;
        }
    }

    /// Of a motion that came before its compensation was lost: its path is not the programmed one, and not computed.
    pub(super) fn mark_lost(&self, (motion, state): &mut PendingMotion) {
        if self.memory.compensation.stage == Stage::Lost && state.compensation != 0 {
            state.beside = Beside::NotModelled;
            let undeclared = state.undeclared();
            motion.undeclared.beside = undeclared.beside;
            motion.undeclared.by_radius = undeclared.by_radius;
        }
    }
}
