//! Motions that a change leaves alone: of other blocks than the chosen ones, and in machine coordinates.
use super::{Stands, Walk, goes, letter, place, rest};
use crate::Claim;
use crate::change::is_motion;
use crate::compare::held;
use crate::item::Step;
use crate::verdict::Verdict;
use trunnion_interp::Motion;

impl Walk<'_> {
    /// A motion of a block that the change leaves alone goes where it went. A rapid may begin where the change has put the tool, and an axis that
    /// it does not move stays there; a cut may not.
    pub(super) fn left_alone(&mut self, before: &Step, after: &Step, claim: &Claim) -> Result<(), Verdict> {
        let (was, is) = (&before.motion, &after.motion);
        self.new_zero(before);
        held(before, after, claim)?;
        self.feeds(was, is)?;
        self.last = Some(before.clone());
        let mut before = before.clone();
        for axis in 0..3 {
            let bit = 1 << axis;
            let displaced = (was.start.known ^ is.start.known) & bit != 0
                || was.start.known & bit != 0
                    && (was.start.values[axis] - is.start.values[axis]).abs() > self.change.end_mm;
            if displaced && was.is_feed() {
                let what = format!(
                    "this cut is not among the blocks that are moved, and begins in {} where they leave the tool: choose them from a rapid before the first cut \
                     to the last block before a rapid",
                    letter(axis)
                );
                return Err(Verdict::Unknown(place(was, is, what)));
            }
            let says = (was.says_way | is.says_way) & bit != 0;
            if !displaced || says || goes(was, axis) || goes(is, axis) {
                self.ends(was, was, is, bit)?;
                self.stands[axis] = Stands::Open;
            } else {
                before.motion.start.values[axis] = is.start.values[axis];
                before.motion.end.values[axis] = is.end.values[axis];
            }
        }
        rest(was, is)?;
        self.near(&before, after)
    }

    /// A motion in machine coordinates, and a dwell: the axes that move go to the same place in both programs.
    pub(super) fn not_moved(&mut self, was: &Motion, is: &Motion) -> Result<(), Verdict> {
        if !is_motion(was) {
            return Ok(());
        }
        for axis in 0..3 {
            if !(goes(was, axis) || goes(is, axis)) {
                continue;
            }
            if (was.end.known ^ is.end.known) & (1 << axis) != 0 {
                let what = format!("the end of {} is known in only one of the programs", letter(axis));
                return Err(Verdict::Unknown(place(was, is, what)));
            }
            let known = was.end.known & (1 << axis) != 0;
            if known && (was.end.values[axis] - is.end.values[axis]).abs() > self.change.end_mm {
                let what = format!("{} ends at another place in machine coordinates", letter(axis));
                return Err(Verdict::Differs(place(was, is, what)));
            }
            self.stands[axis] = Stands::Open;
        }
        Ok(())
    }
}
