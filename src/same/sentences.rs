//! Differences in sentences.
use crate::cut::repeats_place;
use crate::item::{Item, Sort};
use crate::process::shown;
use crate::since::sets_from_here;
use crate::verdict::{Difference, Verdict};
use trunnion_interp::MotionKind;

/// Why a difference is undecided where [`may_stand`].
const MAY_STAND: &str = "; where one of the motions leads is unknown, so it may not move at all";

pub(crate) fn at(was: Option<&Item>, is: Option<&Item>, what: String) -> Difference {
    Difference {
        before: was.map(Item::block),
        after: is.map(Item::block),
        what,
    }
}

/// A kind of motion in words.
pub(crate) fn kind(kind: &MotionKind) -> &'static str {
    match kind {
        MotionKind::Rapid => "a rapid",
        MotionKind::Linear => "a line at feed",
        MotionKind::Arc(_) => "an arc",
        MotionKind::Dwell(_) => "a dwell",
        MotionKind::Unknown => "a motion that is not modelled",
    }
}

/// Whether a straight motion leads to values of variables that are not known and changes nothing else: they may be those where the axes are.
fn may_stand(item: &Item) -> bool {
    let Item::Motion(step) = item else { return false };
    let motion = &step.motion;
    let (start, end) = (&motion.start, &motion.end);
    let both = start.known & end.known;
    let variables = step
        .with_variables
        .as_deref()
        .is_some_and(|text| text.contains(['=', '#']));
    variables
        && matches!(motion.kind, MotionKind::Linear | MotionKind::Rapid)
        && start.known & !end.known != 0
        && end.known & !start.known == 0
        && (0..start.values.len()).all(|axis| both & (1 << axis) == 0 || start.values[axis] == end.values[axis])
}

/// If one program repeats the position of the motion before, after something that may have moved the machine, it may not move at all: other
/// differences found there are undecided.
pub(crate) fn undecided(was: &Item, is: &Item, verdict: Verdict) -> Verdict {
    let repeats = |item: &Item| matches!(item, Item::Motion(step) if repeats_place(step));
    match verdict {
        Verdict::Differs(mut found) if repeats(was) != repeats(is) => {
            let which = if repeats(was) { "original" } else { "changed" };
            found.what = format!(
                "{}; the {which} program repeats its last position here, and it is unknown whether that moves the machine",
                found.what
            );
            Verdict::Unknown(found)
        }
        Verdict::Differs(mut found) if may_stand(was) != may_stand(is) => {
            found.what += MAY_STAND;
            Verdict::Unknown(found)
        }
        verdict => verdict,
    }
}

/// One program does something where the other does something else, or has ended.
pub(crate) fn only_one(was: Option<&Item>, is: Option<&Item>) -> Verdict {
    let name = |item: Option<&Item>| match item {
        None => "ends".to_owned(),
        Some(Item::Motion(step)) if step.is_part => format!("continues with {}", kind(&step.motion.kind)),
        Some(Item::Motion(step)) => format!("makes {}", kind(&step.motion.kind)),
        Some(Item::Happens { words, .. }) => format!("does `{}`", shown(words)),
    };
    let unmodelled = |item: Option<&Item>| {
        matches!(
            item,
            Some(Item::Happens {
                sort: Sort::Unmodelled,
                ..
            })
        ) || matches!(item, Some(Item::Motion(step)) if step.motion.kind == MotionKind::Unknown)
    };
    let part = |item: Option<&Item>| matches!(item, Some(Item::Motion(step)) if step.is_part);
    let what = match (part(was), part(is)) {
        (true, false) | (false, true) => "a motion ends at another position: ",
        _ => "",
    };
    let what = format!("{what}the original program {}, the changed one {}", name(was), name(is));
    let place = at(was, is, what);
    let from_here = |item: Option<&Item>| matches!(item, Some(Item::Happens { words, .. }) if sets_from_here(words));
    // only where the other program goes on without it
    let switch = |item: Option<&Item>| matches!(item, Some(Item::Happens { sort: Sort::Switch, .. }));
    let may_be_on = switch(was) != switch(is);
    let ends_elsewhere = part(was) != part(is) && (from_here(was) || from_here(is));
    if may_be_on {
        let mut place = place;
        place.what += "; the machine left the spindle in a state that is not known";
        Verdict::Unknown(place)
    } else if !ends_elsewhere && (unmodelled(was) || unmodelled(is)) {
        Verdict::Unknown(place)
    } else if was.is_some_and(may_stand) != is.is_some_and(may_stand) {
        let mut place = place;
        place.what += MAY_STAND;
        Verdict::Unknown(place)
    } else {
        Verdict::Differs(place)
    }
}
