//! What a comparison asks about the paths of motions.
use crate::item::Step;
use crate::refit::Refitted;
use crate::verdict::{Difference, Verdict};

/// Decides whether two motions follow the same path.
pub trait Judge {
    /// A pair of motions; `Err` ends the comparison with that verdict.
    fn pair(&mut self, before: &Step, after: &Step) -> Result<(), Verdict>;
    /// A line of the program before, and one of the program after that may be a piece of it, with the same things in effect: whether it is the
    /// last piece. `Ok(None)`: it is no piece, and both are compared as a pair.
    fn piece(&mut self, before: &Step, after: &Step) -> Result<Option<bool>, Verdict> {
        let _ = (before, after);
        Ok(None)
    }
    /// A motion that takes the place of one or several lines, the last of which is `before`; called where [`Claim::refit`](crate::Claim::refit) allows that.
    fn refitted(&mut self, before: &Step, after: &Step, found: Refitted) -> Result<(), Verdict> {
        let _ = (before, after, found);
        Ok(())
    }
    /// Rapid motions one after the other, of both programs, with the same in effect.
    fn rapids(&mut self, before: &[Step], after: &[Step]) -> Result<(), Verdict> {
        let block = |run: &[Step]| run.first().map(|step| step.motion.block);
        Err(Verdict::Unknown(Difference {
            before: block(before),
            after: block(after),
            what: "rapid motions are not judged as a run".to_owned(),
        }))
    }
    /// Whether a line at feed of the program after is no cut but leads away from the part, made before the cut that comes next in both programs.
    fn leaves(&self, before: &Step, after: &Step) -> bool {
        let _ = (before, after);
        false
    }
    /// Rapid motions or one such line of the program after, made before the cut that comes next in both programs.
    fn retract(&mut self, before: &Step, after: &[Step]) -> Result<(), Verdict> {
        Err(Verdict::Unknown(Difference {
            before: Some(before.motion.block),
            after: after.first().map(|step| step.motion.block),
            what: "rapid motions in a cut are not judged".to_owned(),
        }))
    }
    /// A line at feed after [`Self::retract`]: whether the tool is back where it left the part.
    fn returns(&mut self, before: &Step, after: &Step) -> Result<bool, Verdict> {
        let _ = (before, after);
        Ok(false)
    }
    /// A motion that the other program makes in pieces: the distance of the cut point from it, mm or deg.
    fn cut(&mut self, off: f64) {
        let _ = off;
    }
}
