//! Several lines of one program that are a curve of the other, within a tolerance. An interpreter gives a curve as short lines that it leaves by a
//! known amount ([`Motion::slack_mm`]): both chains of lines are walked side by side, and that amount is added.
//!
//! What else must be the same, and when the path in the part has the shape of the programmed one, is as in [`crate::refit`].
use crate::Claim;
use crate::in_effect::in_effect;
use crate::item::{Item, Step};
use crate::judge::Judge;
use crate::refit::{JOINT, Refit, Refitted, begin_apart, begin_together, not_comparable};
use crate::sentences::kind;
use crate::steps::Steps;
use crate::verdict::{Difference, Verdict};
use trunnion_geometry::abreast::{Abreast, Walked};
use trunnion_interp::{Motion, MotionKind};
use trunnion_syntax::BlockId;

/// A curve that is being walked, beside the lines of the other program.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    abreast: Abreast,
    /// Lines of the program before that were walked to their ends.
    motions: u32,
    /// The largest of the lines of each program.
    slack: [f64; 2],
}

/// Whether two motions must be walked as curves: one of them is a piece of a curve, and they are not the same line of the same one.
pub(crate) fn begins(was: &Step, is: &Step) -> bool {
    let (a, b) = (&was.motion, &is.motion);
    (a.slack_mm > 0.0 || b.slack_mm > 0.0) && !same_piece(a, b)
}

/// The same line that stands for a piece of a curve in the same way, or two lines that stand for none.
pub(crate) fn same_piece(a: &Motion, b: &Motion) -> bool {
    let near = |from: f64, to: f64| from.to_bits() == to.to_bits() || (from - to).abs() <= 1e-9;
    let ends =
        |axis: usize| near(a.start.values[axis], b.start.values[axis]) && near(a.end.values[axis], b.end.values[axis]);
    a.slack_mm.to_bits() == b.slack_mm.to_bits() && (a.slack_mm == 0.0 || (0..3).all(ends))
}

/// Two motions near each other that are pieces of different curves.
pub(crate) fn unlike(was: &Step, is: &Step) -> Verdict {
    Verdict::Unknown(Difference {
        before: Some(was.motion.block),
        after: Some(is.motion.block),
        what: "they are near each other, but are pieces of curves that are not the same".to_owned(),
    })
}

/// Whether two motions stand for pieces of curves whose blocks say different things. Their lines may be the same all the same, and only a claim about
/// paths that are near each other has room for that.
pub(crate) fn said_otherwise(was: &Item, is: &Item, [before, after]: [&Steps<'_>; 2]) -> bool {
    let (Item::Motion(was), Item::Motion(is)) = (was, is) else {
        return false;
    };
    (was.motion.slack_mm > 0.0 || is.motion.slack_mm > 0.0)
        && words(before, was.motion.block) != words(after, is.motion.block)
}

/// What was found, unless two motions pass that are said `otherwise`.
pub(crate) fn as_said<T>(found: Result<T, Verdict>, was: &Item, is: &Item, otherwise: bool) -> Result<T, Verdict> {
    match (found, was, is) {
        (Ok(_), Item::Motion(was), Item::Motion(is)) if otherwise => Err(unlike(was, is)),
        (found, ..) => found,
    }
}

/// What a block says about its curve: all from its first word of a curve on.
fn words<'s>(steps: &'s Steps<'_>, block: BlockId) -> &'s [u8] {
    let program = steps.input().program;
    let text = program.bytes(program.block(block).range());
    let starts = |name: &[u8]| {
        text.windows(name.len())
            .position(|part| part.eq_ignore_ascii_case(name))
    };
    let start = starts(b"PO[").or_else(|| starts(b"G5")).unwrap_or(0);
    text[start..].trim_ascii()
}

/// Lines of one program and a curve of the other, or two curves: walks on along both motions until one of them ends, and tells the judge when both
/// programs are at one point again.
pub(crate) fn judged(
    was: &Step,
    is: &Step,
    (refit, claim): (Refit, &Claim),
    judge: &mut dyn Judge,
    open: &mut Option<Curve>,
) -> Result<Walked, Verdict> {
    if open.is_none() && !begin_together(was, is) {
        return Err(begin_apart(was, is));
    }
    in_effect(was, is, claim)?;
    let (walked, through) = walk(open, was, is, refit, claim)?;
    if let Some(found) = through {
        judge.refitted(was, is, found)?;
    }
    Ok(walked)
}

fn walk(
    open: &mut Option<Curve>,
    was: &Step,
    is: &Step,
    refit: Refit,
    claim: &Claim,
) -> Result<(Walked, Option<Refitted>), Verdict> {
    let (a, b) = (&was.motion, &is.motion);
    let place = |what: String| Difference {
        before: Some(a.block),
        after: Some(b.block),
        what,
    };
    if a.kind != MotionKind::Linear || b.kind != MotionKind::Linear {
        let what = format!("one is {}, the other {}", kind(&a.kind), kind(&b.kind));
        return Err(Verdict::Differs(place(what)));
    }
    if let Some(why) = not_comparable(was, is, claim) {
        return Err(Verdict::Unknown(place(why)));
    }
    let (Some(from), Some(to), Some(start), Some(end)) = (a.start.xyz(), a.end.xyz(), b.start.xyz(), b.end.xyz())
    else {
        let what = "the position of X, Y or Z is unknown".to_owned();
        return Err(Verdict::Unknown(place(what)));
    };
    let now = open.get_or_insert_with(|| Curve {
        abreast: Abreast::new(from, start),
        motions: 0,
        slack: [0.0; 2],
    });
    for (most, motion) in now.slack.iter_mut().zip([a, b]) {
        *most = most.max(motion.slack_mm);
    }
    let walked = now.abreast.to([to, end], JOINT);
    if walked != Walked::Second {
        now.motions += 1;
    }
    let slack: f64 = now.slack.iter().sum();
    let (points_mm, paths_mm) = (now.abreast.points_apart() + slack, now.abreast.apart() + slack);
    let off = if refit.points_only { points_mm } else { paths_mm };
    // not a number is above every limit
    if off.is_nan() || off > refit.mm {
        let what = if refit.points_only { "a point" } else { "the path" };
        let what = format!(
            "{what} is up to {off:.6} mm from the new path; {} mm is allowed",
            refit.mm
        );
        return Err(Verdict::Differs(place(what)));
    }
    if walked != Walked::Both || (to - end).norm() > JOINT {
        return Ok((walked, None));
    }
    let found = Refitted {
        points_mm,
        paths_mm,
        motions: now.motions,
    };
    *open = None;
    Ok((walked, Some(found)))
}
