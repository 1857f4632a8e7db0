//! What must be in effect in both programs at two motions.
use crate::Claim;
use crate::across::{are_taps, length_counts, unlike_across};
use crate::cut::feed_is_a_pitch;
use crate::item::Step;
use crate::motions::{Which, motion_difference};
use crate::process::{unlike, unlike_in_motions};
use crate::verdict::{Difference, Verdict};
use trunnion_interp::{Feed, MotionKind, Orientation, same_number};

/// What must be in effect in both programs, whatever the kinds of the two motions.
pub(crate) fn in_effect(was: &Step, is: &Step, claim: &Claim) -> Result<(), Verdict> {
    if claim.across {
        all_modelled(was, is)?;
    }
    if claim.path_only {
        return same_tip(was, is, claim);
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
    let feed_counts = !claim.frees_feed || feed_is_a_pitch(was) || feed_is_a_pitch(is);
    if let Some((name, from, to)) = held {
        return differs(format!("{name} differs: {from} and {to}"));
    }
    // where the machine's positions are known, they are compared, whatever was asked for
    let posed = |step: &Step| {
        step.leg
            .as_ref()
            .is_some_and(|leg| leg.end.is_ok() && leg.open.is_none())
    };
    let which = Which {
        // of taps on two controls the pitch is compared
        feed: feed_counts && !(claim.across && are_taps(was, is)),
        tool_length: !claim.across || length_counts(a, b),
        posture: !(claim.across && posed(was) && posed(is)),
    };
    let moving = motion_difference(a, b, which);
    let is_certain = moving.as_ref().is_some_and(|found| !found.is_unknown);
    let modal = if is_certain {
        None
    } else if claim.across {
        unlike_across(was, is)
    } else {
        unlike(&was.process, &is.process, false)
    };
    let modal = modal.or_else(|| {
        let open = is_open(was) || is_open(is);
        unlike_in_motions(&was.process, &is.process).filter(|_| open && !claim.across)
    });
    let found = match (moving, modal) {
        (Some(moving), Some(modal)) if modal.is_unknown => Some(moving),
        (moving, modal) => modal.or(moving),
    };
    if let Some(found) = found {
        return if found.is_unknown {
            unknown(found.what())
        } else {
            differs(found.what())
        };
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

/// Two controls may do different things with the same words.
fn all_modelled(was: &Step, is: &Step) -> Result<(), Verdict> {
    let lost = |step: &&Step| matches!(step.motion.kind, MotionKind::Unknown | MotionKind::Arc(None));
    let found = [was, is].iter().any(lost).then(|| Difference {
        before: Some(was.motion.block),
        after: Some(is.motion.block),
        what: "a motion that is not modelled, and two controls may do different things with the same words".to_owned(),
    });
    found.map_or(Ok(()), |found| Err(Verdict::Unknown(found)))
}

/// Whether where a motion ends or how fast it is depends on more than is known.
fn is_open(step: &Step) -> bool {
    let motion = &step.motion;
    let lost = matches!(motion.kind, MotionKind::Unknown | MotionKind::Arc(None));
    lost || step.said.is_some() || motion.is_feed() && motion.feed == Feed::Unknown
}

/// With another length in effect the tip of the tool is elsewhere, whatever is programmed. APT programs the tip itself.
fn same_tip(was: &Step, is: &Step, claim: &Claim) -> Result<(), Verdict> {
    let (a, b) = (&was.motion, &is.motion);
    let open = a.undeclared.length || b.undeclared.length;
    if claim.across
        || same_number(a.tool_length_mm, b.tool_length_mm) && !(open && was.held.length_of != is.held.length_of)
    {
        return Ok(());
    }
    let said = |step: &Step| {
        let length = step.motion.tool_length_mm;
        if length.is_nan() || step.motion.undeclared.length {
            format!("an undeclared one ({})", step.held.length_of)
        } else {
            format!("{length} mm")
        }
    };
    let found = Difference {
        before: Some(a.block),
        after: Some(b.block),
        what: format!("the active tool length differs: {} and {}", said(was), said(is)),
    };
    Err(if open || a.tool_length_mm.is_nan() || b.tool_length_mm.is_nan() {
        Verdict::Unknown(found)
    } else {
        Verdict::Differs(found)
    })
}

/// A difference of two paths that an undeclared zero point decides: with the right value there may be none.
pub(crate) fn unless_undeclared(found: Verdict, was: &Step, is: &Step, claim: &Claim) -> Verdict {
    let undeclared = (was.motion.undeclared.zero | is.motion.undeclared.zero) != 0;
    match found {
        Verdict::Differs(mut place) if claim.path_only && undeclared && was.held.work_offset != is.held.work_offset => {
            let name = |step: &Step| step.held.work_offset.as_deref().unwrap_or("no work offset").to_owned();
            place.what = format!(
                "{}; but a zero point is not declared ({} and {}), and its value decides",
                place.what,
                name(was),
                name(is)
            );
            Verdict::Unknown(place)
        }
        found => found,
    }
}
