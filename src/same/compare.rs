//! The comparison: two streams of steps side by side, cut where one program makes in several motions what the other makes in one.
//!
//! What counts is interface section 8.3: geometry, feed, spindle, tool and offsets, coolant, clamps, dwell, stops, path control, outputs,
//! stored data, and the words of everything that is not modelled.
use crate::cut::{cut, is_idle};
use crate::exact::{self, Exact};
use crate::process::{Process, motion_difference, shown};
use crate::since::is_after_loss;
use crate::steps::{Item, Sort, Step, Steps};
use crate::twins::Twins;
use crate::verdict::{Difference, Verdict};
use trunnion_interp::{MotionKind, same_number};

/// What is claimed to be the same.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Tolerance of the path, mm.
    pub mm: f64,
    /// Tolerance of the tool axis and of rotary axes, deg.
    pub deg: f64,
    /// Feeds may differ.
    pub frees_feed: bool,
    /// Everything but the geometry may differ: the claim is the path alone.
    pub path_only: bool,
    /// The programs are in two languages (APT and G code): what one of them cannot say does not count. Set by [`compare`].
    pub across: bool,
    /// Motions may be cut: a line in two is the line. Off, both programs must have the same motions one by one.
    pub cuts: bool,
    /// Nothing may differ but the layout of the text, or its block numbers: to the last bit, and no tolerance counts.
    pub exact: Option<Exact>,
}

/// Decides whether two motions lead the same way.
pub trait Judge {
    /// A pair of motions; `Err` ends the comparison with that verdict.
    fn pair(&mut self, before: &Step, after: &Step) -> Result<(), Verdict>;
    /// A motion whose other program makes it in pieces: the point at which it is cut lies so far from it, mm or deg.
    fn cut(&mut self, off: f64) {
        let _ = off;
    }
}

/// Runs both programs to their ends, or to the first difference. The runs of two programs with the same text are the same whatever is
/// unknown in them.
pub fn compare(before: &mut Steps<'_>, after: &mut Steps<'_>, claim: &Claim, judge: &mut dyn Judge) -> Verdict {
    if let Some(exact) = claim.exact {
        return exact::walk(before, after, exact).err().unwrap_or(Verdict::Same);
    }
    let twins = Twins::of(before.input(), after.input());
    let format = |steps: &Steps<'_>| steps.input().dialect.lex.format;
    let claim = &Claim {
        across: claim.across || format(before) != format(after),
        ..*claim
    };
    match walk(before, after, claim, judge, &twins) {
        Ok(()) => Verdict::Same,
        Err(Verdict::Unknown(_)) if matches!(twins, Twins::All) => Verdict::Same,
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
    while let (Some(was), Some(is)) = (&mut a, &mut b) {
        let found = pair(was, is, claim, judge);
        let moved_on = match found {
            Ok(Paired::Both) => (true, true),
            Ok(Paired::FirstInPart) => (true, false),
            Ok(Paired::SecondInPart) => (false, true),
            Err(verdict) => {
                twins.judge(was, is, Err(verdict))?;
                (true, true)
            }
        };
        if moved_on.0 {
            a = next(before, claim);
        }
        if moved_on.1 {
            b = next(after, claim);
        }
    }
    if a.is_some() || b.is_some() {
        return Err(only_one(a.as_ref(), b.as_ref()));
    }
    if twins.stopped(before, after)? {
        return Ok(());
    }
    stopped(before, after)?;
    if !claim.path_only && !claim.across {
        at_end(before, after)?;
    }
    Ok(())
}

/// How far a comparison of two things got.
enum Paired {
    /// Both are done.
    Both,
    /// The first is the beginning of the second, of which the rest remains.
    FirstInPart,
    /// The second is the beginning of the first.
    SecondInPart,
}

fn pair(was: &mut Item, is: &mut Item, claim: &Claim, judge: &mut dyn Judge) -> Result<Paired, Verdict> {
    match (&mut *was, &mut *is) {
        (Item::Motion(was), Item::Motion(is)) => {
            held(was, is, claim)?;
            if claim.cuts && !ends_together(was, is, claim) {
                if let Some(off) = cut(is, was, (claim.mm, claim.deg)) {
                    judge.cut(off);
                    return Ok(Paired::FirstInPart);
                }
                if let Some(off) = cut(was, is, (claim.mm, claim.deg)) {
                    judge.cut(off);
                    return Ok(Paired::SecondInPart);
                }
            }
            judge.pair(was, is)?;
        }
        (Item::Happens { .. }, Item::Happens { .. }) => happens(was, is, claim)?,
        _ => return Err(only_one(Some(was), Some(is))),
    }
    Ok(Paired::Both)
}

/// The next item that counts.
fn next(steps: &mut Steps<'_>, claim: &Claim) -> Option<Item> {
    steps.find(|item| match item {
        Item::Motion(step) => !(claim.cuts && is_idle(step)),
        Item::Happens { sort, .. } => !claim.path_only || *sort == Sort::Unmodelled,
    })
}

fn at(was: Option<&Item>, is: Option<&Item>, what: String) -> Difference {
    Difference {
        before: was.map(Item::block),
        after: is.map(Item::block),
        what,
    }
}

/// What must be the same at two motions before their paths are looked at.
fn held(was: &Step, is: &Step, claim: &Claim) -> Result<(), Verdict> {
    let (a, b) = (&was.motion, &is.motion);
    let differs = |what: String| {
        Err(Verdict::Differs(Difference {
            before: Some(a.block),
            after: Some(b.block),
            what,
        }))
    };
    if core::mem::discriminant(&a.kind) != core::mem::discriminant(&b.kind) {
        let lost = [a, b].iter().any(|motion| motion.kind == MotionKind::Unknown);
        let verdict = if lost { Verdict::Unknown } else { Verdict::Differs };
        return Err(verdict(Difference {
            before: Some(a.block),
            after: Some(b.block),
            what: format!("one is {}, the other {}", kind(&a.kind), kind(&b.kind)),
        }));
    }
    if let (MotionKind::Dwell(from), MotionKind::Dwell(to)) = (&a.kind, &b.kind) {
        let same = match (from, to) {
            (Some(from), Some(to)) => same_number(*from, *to),
            (None, None) => true,
            _ => false,
        };
        if !same && !claim.path_only {
            let seconds = |time: &Option<f64>| time.map_or("an unknown time".to_owned(), |time| format!("{time} s"));
            return differs(format!("a dwell of {} and one of {}", seconds(from), seconds(to)));
        }
    }
    if claim.path_only {
        return Ok(());
    }
    let held = was.held.difference(&is.held).filter(|_| !claim.across);
    if let Some((name, from, to)) = held.or_else(|| motion_difference(a, b, !claim.frees_feed)) {
        return differs(format!("{name} differs: {from} and {to}"));
    }
    match setting(&was.process, &is.process, claim) {
        Some((key, from, to)) if is_after_loss(&key) => Err(Verdict::Unknown(Difference {
            before: Some(a.block),
            after: Some(b.block),
            what: format!("{key}: {from} and {to}"),
        })),
        Some((key, from, to)) => differs(format!("{key} differs: {from} and {to}")),
        None => Ok(()),
    }
}

/// The first setting that differs and counts.
fn setting(was: &Process, is: &Process, claim: &Claim) -> Option<(String, String, String)> {
    let found = if claim.across {
        was.shared_differences(is)
    } else {
        was.differences(is)
    };
    found
        .into_iter()
        .next()
        .map(|(key, from, to)| (key.to_owned(), from, to))
}

/// A kind of motion in words.
fn kind(kind: &MotionKind) -> &'static str {
    match kind {
        MotionKind::Rapid => "a rapid",
        MotionKind::Linear => "a line at feed",
        MotionKind::Arc(_) => "an arc",
        MotionKind::Dwell(_) => "a dwell",
        MotionKind::Unknown => "a motion that is not modelled",
    }
}

/// Whether two motions end at one place, so that neither need be cut.
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

fn happens(was: &Item, is: &Item, claim: &Claim) -> Result<(), Verdict> {
    let (
        Item::Happens {
            sort,
            words,
            process,
            situation,
            ..
        },
        Item::Happens {
            sort: other_sort,
            words: other_words,
            process: other_process,
            situation: other_situation,
            ..
        },
    ) = (was, is)
    else {
        return Ok(());
    };
    let place = |what: String| at(Some(was), Some(is), what);
    if sort != other_sort || words != other_words {
        // two languages end their programs each in its own words
        if *sort == Sort::End && *other_sort == Sort::End && claim.across {
            return Ok(());
        }
        let what = format!("one does `{}`, the other `{}`", shown(words), shown(other_words));
        return Err(if *sort == Sort::Unmodelled || *other_sort == Sort::Unmodelled {
            Verdict::Unknown(place(format!(
                "{what}: their effect is not modelled, and the words differ"
            )))
        } else {
            Verdict::Differs(place(what))
        });
    }
    if claim.path_only {
        return Ok(());
    }
    if let (Some(was), Some(is), false) = (situation, other_situation, claim.across) {
        let found = was.iter().zip(is.iter());
        let mut found = found;
        let found = found.find_map(|(was, is)| was.difference(is, !claim.frees_feed));
        if let Some((name, from, to)) = found {
            return Err(Verdict::Unknown(place(format!(
                "{name} differs at `{}`, whose effect is not modelled: {from} and {to}",
                shown(words)
            ))));
        }
    }
    match setting(process, other_process, claim) {
        Some((key, from, to)) if is_after_loss(&key) => Err(Verdict::Unknown(place(format!("{key}: {from} and {to}")))),
        Some((key, from, to)) => Err(Verdict::Differs(place(format!(
            "{key} differs at `{}`: {from} and {to}",
            shown(words)
        )))),
        None => Ok(()),
    }
}

/// One program does something where the other does something else, or nothing more.
fn only_one(was: Option<&Item>, is: Option<&Item>) -> Verdict {
    let name = |item: Option<&Item>| match item {
        None => "ends".to_owned(),
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
    let what = format!("the program before {}, the one after {}", name(was), name(is));
    let place = at(was, is, what);
    if unmodelled(was) || unmodelled(is) {
        Verdict::Unknown(place)
    } else {
        Verdict::Differs(place)
    }
}

/// Both were followed to their ends.
fn stopped(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    for (which, steps) in [("before", before), ("after", after)] {
        if let Some(stop) = steps.stop() {
            let block = Some(stop.block);
            return Err(Verdict::Unknown(Difference {
                before: block.filter(|_| which == "before"),
                after: block.filter(|_| which == "after"),
                what: format!("the program {which} was not followed to its end: {}", stop.why),
            }));
        }
    }
    Ok(())
}

/// What both leave behind.
fn at_end(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    let nowhere = |what: String| {
        Err(Verdict::Differs(Difference {
            before: None,
            after: None,
            what,
        }))
    };
    let (a, b) = (before.stored(), after.stored());
    for name in a.keys().chain(b.keys().filter(|name| !a.contains_key(*name))) {
        if a.get(name) != b.get(name) {
            let value = |value: Option<&trunnion_interp::Value>| match value {
                None | Some(trunnion_interp::Value::Nothing) => "nothing".to_owned(),
                Some(trunnion_interp::Value::Number(value)) => value.to_string(),
                Some(trunnion_interp::Value::Text(text)) => text.to_string(),
            };
            return nowhere(format!(
                "{name} outlives the program and holds {} and {}",
                value(a.get(name)),
                value(b.get(name))
            ));
        }
    }
    if before.leads_tip() != after.leads_tip() {
        return nowhere("tool centre point control is on at the end of only one of the programs".into());
    }
    if let Some((name, from, to)) = before.held().difference(&after.held()) {
        return nowhere(format!("{name} at the end differs: {from} and {to}"));
    }
    match before.process().differences(after.process()).first() {
        Some((key, from, to)) if is_after_loss(key) => Err(Verdict::Unknown(Difference {
            before: None,
            after: None,
            what: format!("{key}: {from} and {to}"),
        })),
        Some((key, from, to)) => nowhere(format!("{key} at the end differs: {from} and {to}")),
        None => Ok(()),
    }
}
