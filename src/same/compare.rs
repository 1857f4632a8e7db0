//! The comparison: two streams of steps side by side, cut where one program makes in several motions what the other makes in one.
//!
//! What counts is interface section 8.3: geometry, feed, spindle, tool and offsets, coolant, clamps, dwell, stops, path control, outputs,
//! stored data, and the words of everything that is not modelled.
use crate::Claim;
use crate::across::{Counterparts, are_two_controls, is_in_motions, unless_own_words};
use crate::begin::{begin_alike, may_be_part, way_is_open};
use crate::curve::{self, Curve};
use crate::cut::{blocks_count, cut, is_idle, may_be_cut};
use crate::ending::ended;
use crate::exact;
use crate::happens::happens;
use crate::in_effect::{in_effect, unless_undeclared};
use crate::item::{Item, Sort, Step};
use crate::judge::Judge;
use crate::numbers;
use crate::rapids;
use crate::refit::{Followed, Following, Joint, Refit, begin_apart, begin_together, follow, may_begin};
use crate::retracts;
use crate::said;
use crate::sentences::{kind, only_one, undecided};
use crate::steps::Steps;
use crate::twins::Twins;
use crate::verdict::{Difference, Verdict};
use std::collections::VecDeque;
use trunnion_geometry::abreast::Walked;
use trunnion_interp::{Motion, MotionKind, same_number};

/// Runs both programs to their ends, or to the first difference. The runs of two programs with the same text are the same even if values
/// are unknown in them.
pub fn compare(before: &mut Steps<'_>, after: &mut Steps<'_>, claim: &Claim, judge: &mut dyn Judge) -> Verdict {
    if let Err(verdict) = numbers::alike(before, after) {
        return verdict;
    }
    if let Some(exact) = claim.exact {
        return exact::walk(before, after, exact).err().unwrap_or(Verdict::Same);
    }
    let twins = Twins::of(before.input(), after.input());
    let user_names = |steps: &Steps<'_>| steps.input().dialect.quirks.user_names();
    let no_rotary = |steps: &Steps<'_>| steps.input().machine.is_none_or(|machine| machine.rotary.is_empty());
    let straight = |steps: &Steps<'_>| steps.input().dialect.quirks.straight_rapids;
    let claim = &Claim {
        across: claim.across || are_two_controls([before.input().dialect, after.input().dialect]),
        plane_counts: user_names(before) || user_names(after),
        no_rotary: no_rotary(before) && no_rotary(after),
        straight_rapids: straight(before) && straight(after),
        ..*claim
    };
    match walk(before, after, claim, judge, &twins) {
        Ok(()) => Verdict::Same,
        Err(verdict) => verdict,
    }
}

fn walk(
    before: &mut Steps<'_>,
    after: &mut Steps<'_>,
    claim: &Claim,
    judge: &mut dyn Judge,
    twins: &Twins,
) -> Result<(), Verdict> {
    let mut a = next(before, claim);
    let mut b = next(after, claim);
    let mut open = Open::default();
    let mut counterparts = Counterparts::default();
    // motions of the program before that were followed beyond the end of a new one
    let mut again = VecDeque::new();
    // a program that is missing may return to here: the next motion is the same as a whole, wherever it begins
    let whole = Claim {
        cuts: false,
        pieces: false,
        refit: None,
        rapid_runs: false,
        retracts: false,
        ..*claim
    };
    let mut numbered = false;
    while let (Some(was), Some(is)) = (&mut a, &mut b) {
        let judged = if numbered { &whole } else { claim };
        numbered = numbers::is_one(was) || numbered && !matches!(was, Item::Motion(_));
        if judged.rapid_runs && rapids::begins(Some(was)) && rapids::begins(Some(is)) {
            let (left, right) = (was.clone(), is.clone());
            let (Some(Item::Motion(was)), Some(Item::Motion(is))) = (a.take(), b.take()) else {
                break;
            };
            let (old, rest) = rapids::run(*was, before, claim);
            a = rest;
            let (new, rest) = rapids::run(*is, after, claim);
            b = rest;
            let verdict = held(&old[0], &new[0], claim).and_then(|()| judge.rapids(&old, &new));
            twins.judge(&left, &right, verdict)?;
            continue;
        }
        if judged.retracts
            && let (Item::Motion(cut), Item::Motion(away)) = (&*was, &*is)
            && cut.motion.kind == MotionKind::Linear
            && (rapids::begins(Some(is)) || judge.leaves(cut, away))
        {
            let away = away.as_ref().clone();
            b = retracts::excursion(cut, away, after, claim, judge)?;
            continue;
        }
        let otherwise = claim.refit.is_none() && curve::said_otherwise(was, is, [before, after]);
        let names = match (&*was, &*is) {
            (Item::Motion(was), Item::Motion(is)) if claim.across => counterparts.agree(was, is),
            _ => Ok(()),
        };
        let found = names.and_then(|()| pair(was, is, judged, judge, &mut open));
        let found = found.map_err(|verdict| {
            if claim.across {
                unless_own_words(verdict, was, is)
            } else {
                verdict
            }
        });
        let moved_on = match curve::as_said(found, was, is, otherwise) {
            Ok(Paired::Both) => (true, true),
            Ok(Paired::FirstInPart) => (true, false),
            Ok(Paired::SecondInPart) => (false, true),
            Ok(Paired::EndedBefore(joint)) => {
                let rest = joint.rest.into_iter().map(|step| Item::Motion(Box::new(step)));
                let behind = core::mem::take(&mut again);
                again.extend(rest.chain(a.take()).chain(behind));
                (true, true)
            }
            Err(verdict) => {
                let verdict = undecided(was, is, verdict);
                let verdict = parts_or(verdict, (&*was, &*is), judged, (&mut *before, &mut *after), &mut again);
                twins.judge(was, is, Err(verdict))?;
                (true, true)
            }
        };
        if moved_on.0 {
            a = again.pop_front().or_else(|| next(before, claim));
        }
        if moved_on.1 {
            b = next(after, claim);
        }
    }
    ended(before, after, [a.as_ref(), b.as_ref()], claim, twins)
}

/// The verdict on two items, unless one motion may be a part of the other, because it is unknown where they come from.
fn parts_or(
    mut verdict: Verdict,
    (was, is): (&Item, &Item),
    claim: &Claim,
    (before, after): (&mut Steps<'_>, &mut Steps<'_>),
    again: &mut VecDeque<Item>,
) -> Verdict {
    if let (Verdict::Differs(found), Item::Motion(was), Item::Motion(is)) = (&mut verdict, was, is)
        && claim.cuts
        && (way_is_open(was) || way_is_open(is))
        && !ends_together(was, is, claim)
        && held(was, is, claim).is_ok()
        && (may_be_part(is, was, next(after, claim).as_ref(), claim)
            || may_be_part(
                was,
                is,
                again.pop_front().or_else(|| next(before, claim)).as_ref(),
                claim,
            ))
    {
        found.what += "; one motion may be a part of the other, but their path up to here is unknown";
        return Verdict::Unknown(found.clone());
    }
    verdict
}

/// The result of comparing two items.
enum Paired {
    /// Both are done.
    Both,
    /// The first is the beginning of the second, of which the rest remains.
    FirstInPart,
    /// The second is the beginning of the first.
    SecondInPart,
    /// The second ended before the first, beside an earlier point.
    EndedBefore(Box<Joint>),
}

/// What takes the place of several motions and goes on.
#[derive(Default)]
struct Open {
    following: Option<Following>,
    curve: Option<Curve>,
}

fn pair(
    was: &mut Item,
    is: &mut Item,
    claim: &Claim,
    judge: &mut dyn Judge,
    open: &mut Open,
) -> Result<Paired, Verdict> {
    match (&mut *was, &mut *is) {
        (Item::Motion(was), Item::Motion(is)) => {
            if claim.pieces
                && was.motion.kind == MotionKind::Linear
                && is.motion.kind == MotionKind::Linear
                && may_be_cut(was)
            {
                held(was, is, claim)?;
                if let Some(last) = judge.piece(was, is)? {
                    return Ok(if last { Paired::Both } else { Paired::SecondInPart });
                }
            }
            let following = &mut open.following;
            if let (Some(refit), None) = (claim.refit, &following)
                && (open.curve.is_some() || curve::begins(was, is))
            {
                return Ok(match curve::judged(was, is, (refit, claim), judge, &mut open.curve)? {
                    Walked::First => Paired::FirstInPart,
                    Walked::Second => Paired::SecondInPart,
                    Walked::Both => Paired::Both,
                });
            }
            if let Some(refit) = claim.refit {
                let together = following.is_some() || begin_together(was, is);
                if following.is_some() || may_begin(was, is) && !(together && same_line(was, is, claim)) {
                    return match refitted(was, is, (refit, claim), together, judge, following) {
                        Err(verdict) => match Following::joint(following) {
                            Some(joint) => {
                                judge.refitted(&joint.was, is, joint.found)?;
                                Ok(Paired::EndedBefore(joint))
                            }
                            None => Err(verdict),
                        },
                        found => found,
                    };
                }
                if !together {
                    return Err(begin_apart(was, is));
                }
            }
            held(was, is, claim)?;
            if claim.cuts {
                open_blocks(was, is, false)?;
            }
            if claim.cuts && !ends_together(was, is, claim) {
                if let Some(off) = cut(is, was, claim) {
                    open_blocks(was, is, true)?;
                    judge.cut(off);
                    return Ok(Paired::FirstInPart);
                }
                if let Some(off) = cut(was, is, claim) {
                    open_blocks(was, is, true)?;
                    judge.cut(off);
                    return Ok(Paired::SecondInPart);
                }
            }
            if claim.cuts {
                begin_alike(was, is, claim)?;
            }
            judge
                .pair(was, is)
                .map_err(|found| unless_undeclared(found, was, is, claim))?;
            if !curve::same_piece(&was.motion, &is.motion) {
                return Err(curve::unlike(was, is));
            }
        }
        (Item::Happens { .. }, Item::Happens { .. }) => happens(was, is, claim)?,
        _ => return Err(only_one(Some(was), Some(is))),
    }
    Ok(Paired::Both)
}

/// Undecided, where the number of blocks counts: [`blocks_count`].
fn open_blocks(was: &Step, is: &Step, is_cut: bool) -> Result<(), Verdict> {
    blocks_count(was, is, is_cut).map_or(Ok(()), |what| {
        Err(Verdict::Unknown(Difference {
            before: Some(was.motion.block),
            after: Some(is.motion.block),
            what,
        }))
    })
}

/// A line of the program before and the motion that takes its place, alone or with others.
fn refitted(
    was: &mut Step,
    is: &Step,
    (refit, claim): (Refit, &Claim),
    together: bool,
    judge: &mut dyn Judge,
    following: &mut Option<Following>,
) -> Result<Paired, Verdict> {
    in_effect(was, is, claim)?;
    if following.is_none()
        && together
        && let Some(off) = cut(was, is, claim)
    {
        judge.cut(off);
        return Ok(Paired::SecondInPart);
    }
    let Followed::Through(found) = follow(following, was, is, refit, claim)? else {
        return Ok(Paired::FirstInPart);
    };
    *following = None;
    judge.refitted(was, is, found)?;
    Ok(Paired::Both)
}

/// The next item that matters.
pub(crate) fn next(steps: &mut Steps<'_>, claim: &Claim) -> Option<Item> {
    steps.find(|item| match item {
        Item::Motion(step) => !(claim.cuts && is_idle(step)),
        Item::Happens { sort, words, .. } if claim.across && (*sort == Sort::Switch || is_in_motions(words)) => false,
        Item::Happens { sort, .. } => !claim.path_only || *sort == Sort::Unmodelled,
    })
}

/// What must be the same at two motions before their paths are compared.
pub(crate) fn held(was: &Step, is: &Step, claim: &Claim) -> Result<(), Verdict> {
    let (a, b) = (&was.motion, &is.motion);
    let place = |what: String| Difference {
        before: Some(a.block),
        after: Some(b.block),
        what,
    };
    if core::mem::discriminant(&a.kind) != core::mem::discriminant(&b.kind) {
        let lost = [a, b].iter().any(|motion| motion.kind == MotionKind::Unknown);
        let curve = |motion: &Motion| matches!(motion.kind, MotionKind::Linear | MotionKind::Arc(Some(_)));
        let near = claim.path_only && claim.mm > 0.0 && curve(a) && curve(b);
        let verdict = if lost || near {
            Verdict::Unknown
        } else {
            Verdict::Differs
        };
        let mut what = format!("one is {}, the other {}", kind(&a.kind), kind(&b.kind));
        if near {
            what += ": how far they are apart is not judged";
        }
        return Err(verdict(place(what)));
    }
    if let (MotionKind::Dwell(from), MotionKind::Dwell(to)) = (&a.kind, &b.kind) {
        let same = match (from, to) {
            (Some(from), Some(to)) => same_number(*from, *to),
            (None, None) => true,
            _ => false,
        };
        if !same && !claim.path_only {
            let seconds = |time: &Option<f64>| time.map_or("an unknown time".to_owned(), |time| format!("{time} s"));
            let what = format!("a dwell of {} and one of {}", seconds(from), seconds(to));
            let is_unknown = from.is_none() || to.is_none();
            let verdict = if is_unknown { Verdict::Unknown } else { Verdict::Differs };
            return Err(verdict(place(what)));
        }
    }
    in_effect(was, is, claim)?;
    match said::unlike(was, is) {
        Some(what) => Err(Verdict::Unknown(place(what))),
        None => Ok(()),
    }
}

/// Two lines that end together: they are compared as one pair.
fn same_line(was: &Step, is: &Step, claim: &Claim) -> bool {
    was.motion.kind == is.motion.kind && ends_together(was, is, claim)
}

/// Whether two motions end at the same position, so that neither need be cut.
fn ends_together(was: &Step, is: &Step, claim: &Claim) -> bool {
    let (a, b) = (&was.motion, &is.motion);
    let sweeps = match (&a.kind, &b.kind) {
        (MotionKind::Arc(Some(a)), MotionKind::Arc(Some(b))) => (a.sweep - b.sweep).abs() < 1e-3,
        _ => true,
    };
    sweeps
        && a.end.known == b.end.known
        && (0..9).filter(|axis| a.end.known & (1 << axis) != 0).all(|axis| {
            let off = (a.end.values[axis] + a.zero[axis]) - (b.end.values[axis] + b.zero[axis]);
            off.is_nan() || off.abs() <= if (3..6).contains(&axis) { claim.deg } else { claim.mm }
        })
}
