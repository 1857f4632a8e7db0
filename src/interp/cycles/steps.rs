//! Drilling in steps: G73, which breaks the chip, and G83, which leaves the hole.
//!
//! Fanuc: steps of Q. Haas: steps of Q; or of I, each J less than the one before, none below K; and G73 with Q and K leaves the hole
//! whenever its steps add up to K (Haas Mill Operator's Manual, G73, G83). Any other combination has no meaning in the manual.
use super::hole::Plan;
use crate::core::Report;
use crate::iso::Iso;
use crate::{FaultKind, MotionKind};
use trunnion_dialect::Action;

/// More steps than this are refused.
const MOST_STEPS: f64 = 10_000.0;

/// Depths of the steps, mm.
#[derive(Clone, Copy, Debug)]
struct Steps {
    first: f64,
    less: f64,
    least: f64,
    /// After how much the tool leaves the hole.
    leaves: Option<f64>,
}

impl Steps {
    /// The step after one, where some of the depth is left.
    fn next(&self, step: f64, depth: f64) -> f64 {
        let next = (step - self.less).max(self.least);
        if next > 0.0 { next } else { depth }
    }
}

impl Iso<'_> {
    /// Steps as the words give them; `None` where the words have no documented meaning.
    fn step_words(&self, action: Action, depth: f64) -> Option<Steps> {
        let hole = &self.memory.cycle.hole;
        let [i, j, k] = hole.ijk.map(|length| length.map(f64::abs));
        let q = hole.q.map(f64::abs).filter(|q| *q > 0.0);
        match (i, q) {
            (Some(first), None) => Some(Steps {
                first,
                less: j.unwrap_or(0.0),
                least: k.unwrap_or(0.0).max(depth / MOST_STEPS),
                leaves: None,
            }),
            (None, q) if j.is_none() && (k.is_none() || action == Action::ChipBreakCycle && q.is_some()) => {
                Some(Steps {
                    first: q.unwrap_or(depth),
                    less: 0.0,
                    least: 0.0,
                    leaves: k,
                })
            }
            _ => None,
        }
    }

    /// Down to the bottom in steps, from R.
    pub(super) fn steps(&mut self, plan: &Plan, action: Action, report: &mut Report<'_>) {
        let Some(r) = plan.r else {
            self.down(plan, MotionKind::Linear, Some(plan.bottom), report);
            return;
        };
        let (depth, way) = ((plan.bottom - r).abs(), (plan.bottom - r).signum());
        let steps = self.step_words(action, depth);
        let Some(steps) = steps.filter(|steps| steps.first * MOST_STEPS >= depth) else {
            let why = if steps.is_none() {
                "this combination of I, J, K and Q"
            } else {
                "more than 10000 steps"
            };
            let what = format!("{} with {why}", self.memory.cycle.id);
            report.fault(report.whole(), FaultKind::NotModelled { what });
            self.down(plan, MotionKind::Unknown, Some(plan.bottom), report);
            return;
        };
        let (back, clear) = (
            self.core.setup.control.chip_break_retract_mm,
            self.core.setup.control.peck_clearance_mm,
        );
        let (mut done, mut inside, mut step) = (0.0, 0.0, steps.first);
        loop {
            done += step;
            inside += step;
            // the last step is what is left
            if done >= depth - 1e-9 {
                self.down(plan, MotionKind::Linear, Some(plan.bottom), report);
                return;
            }
            self.down(plan, MotionKind::Linear, Some(r + way * done), report);
            let above = |by: Option<f64>| by.map(|by| r + way * (done - by));
            if action == Action::PeckCycle || steps.leaves.is_some_and(|most| inside >= most - 1e-9) {
                inside = 0.0;
                self.down(plan, MotionKind::Rapid, Some(r), report);
                self.down(plan, MotionKind::Rapid, above(clear), report);
            } else {
                self.down(plan, MotionKind::Rapid, above(back), report);
            }
            step = steps.next(step, depth);
        }
    }
}
