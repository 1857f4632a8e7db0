//! Rapid motions one after the other: where only their ends matter, two programs may make different ones between them.
use crate::Claim;
use crate::item::{Item, Step};
use crate::motions::{Which, motion_difference};
use crate::process::unlike;
use crate::steps::Steps;
use trunnion_interp::{MotionKind, Swivel};

/// Whether an item is a rapid motion that may begin a run.
pub(crate) fn begins(item: Option<&Item>) -> bool {
    matches!(item, Some(Item::Motion(step)) if is_rapid(step))
}

pub(crate) fn is_rapid(step: &Step) -> bool {
    step.motion.kind == MotionKind::Rapid && step.motion.tilt.swivel == Swivel::No
}

/// The run that begins with a step, and the item after it: rapid motions with the same in effect, and nothing that happens between them.
pub(crate) fn run(first: Step, steps: &mut Steps<'_>, claim: &Claim) -> (Vec<Step>, Option<Item>) {
    let mut run = vec![first];
    loop {
        match crate::compare::next(steps, claim) {
            Some(Item::Motion(step)) if continues(&run[0], &step) => run.push(*step),
            rest => return (run, rest),
        }
    }
}

/// Whether a rapid motion belongs to the run of another one.
fn continues(first: &Step, step: &Step) -> bool {
    let (a, b) = (&first.motion, &step.motion);
    let zeros = a.zero.iter().zip(&b.zero).all(|(a, b)| a.to_bits() == b.to_bits());
    is_rapid(step)
        && first.held == step.held
        && unlike(&first.process, &step.process, false).is_none()
        && motion_difference(a, b, Which::ALL).is_none()
        && zeros
        && a.undeclared == b.undeclared
        && a.tilt.normal == b.tilt.normal
        && a.machine_coordinates == b.machine_coordinates
}
