//! What must be in effect in both programs at two motions.
use crate::Claim;
use crate::item::Step;
use crate::process::{motion_difference, unlike};
use crate::verdict::{Difference, Verdict};
use trunnion_interp::{MotionKind, Orientation, same_number};

/// What must be in effect in both programs, whatever the kinds of the two motions.
pub(crate) fn in_effect(was: &Step, is: &Step, claim: &Claim) -> Result<(), Verdict> {
    if claim.path_only {
        return Ok(());
    }
    let (a, b) = (&was.motion, &is.motion);
    let place = |what: String| Difference {
        before: Some(a.block),
        after: Some(b.block),
        what,
    };
    let differs = |what: String| Err(Verdict::Differs(place(what)));
    let unknown = |what: String| Err(Verdict::Unknown(place(what)));
    let straight = |kind: &MotionKind| matches!(kind, MotionKind::Rapid | MotionKind::Linear | MotionKind::Dwell(_));
    // lines that became an arc did not need a plane
    let plane = claim.plane_counts || !straight(&a.kind) || was.held.compensation != 0;
    let other_length = !claim.across || !same_number(a.tool_length_mm, b.tool_length_mm);
    if was.held.length_is_open != is.held.length_is_open && other_length {
        return unknown(
            "in one of them a motion in machine coordinates came after the tool length, and whether it acts again is unknown (declare `length-after-return` in the [quirks] of a dialect table)"
                .to_owned(),
        );
    }
    let held = was.held.difference(&is.held, plane).filter(|_| !claim.across);
    if let Some((name, from, to)) = held.or_else(|| motion_difference(a, b, !claim.frees_feed)) {
        return differs(format!("{name} differs: {from} and {to}"));
    }
    if let Some(found) = unlike(&was.process, &is.process, claim.across) {
        let what = format!("{} differs: {} and {}", found.key, found.from, found.to);
        if !found.is_unknown {
            return differs(what);
        }
        return unknown(what);
    }
    let turns = a.orientation == Orientation::Words && b.orientation == Orientation::Words;
    if was.held.vector_mode != is.held.vector_mode && turns && !claim.across {
        return unknown("only one of them programs the tool's direction by vectors".to_owned());
    }
    if a.tcp != b.tcp && claim.no_rotary && !claim.across {
        return unknown(
            "only one of them is under tool centre point control, and the rotary axes are unknown".to_owned(),
        );
    }
    Ok(())
}
