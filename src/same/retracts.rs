//! Motions that only the program after has: away from the part with rapids or a line at feed, and back with lines at feed, between two cuts.
use crate::Claim;
use crate::compare::next;
use crate::in_effect::in_effect;
use crate::item::{Item, Step};
use crate::judge::Judge;
use crate::rapids;
use crate::sentences::only_one;
use crate::steps::Steps;
use crate::verdict::Verdict;
use trunnion_interp::MotionKind;

/// Most lines at feed that bring the tool back: a turn in the air, down along its axis, and a ramp.
const MOST_RETURNS: usize = 3;

/// Takes the motions away from the part and back, the first of which is `away`; `cut` is the motion that comes next in the program before. The
/// item after them.
pub(crate) fn excursion(
    cut: &Step,
    away: Step,
    after: &mut Steps<'_>,
    claim: &Claim,
    judge: &mut dyn Judge,
) -> Result<Option<Item>, Verdict> {
    let free = Claim {
        frees_feed: true,
        ..*claim
    };
    let (run, mut rest) = if rapids::is_rapid(&away) {
        rapids::run(away, after, claim)
    } else {
        in_effect(cut, &away, claim)?;
        (vec![away], next(after, claim))
    };
    // all rapids of a run have the same in effect
    in_effect(cut, &run[0], &free)?;
    judge.retract(cut, &run)?;
    for _ in 0..MOST_RETURNS {
        let Some(Item::Motion(step)) = &rest else { break };
        if step.motion.kind != MotionKind::Linear {
            break;
        }
        in_effect(cut, step, claim)?;
        let back = judge.returns(cut, step)?;
        rest = next(after, claim);
        if back {
            return Ok(rest);
        }
    }
    Err(only_one(Some(&Item::Motion(Box::new(cut.clone()))), rest.as_ref()))
}
