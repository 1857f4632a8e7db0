//! Several lines of one program that are one line or arc of the other, within a tolerance.
//!
//! Everything but the path must be the same at each of them: feed, spindle, tool, offsets, plane of the tool. The rotary axes stand still, so
//! that the path in the part has the shape of the programmed one.
use crate::Claim;
use crate::cut::may_be_cut;
use crate::item::Step;
use crate::sentences::kind;
use crate::verdict::{Difference, Verdict};
use trunnion_geometry::Vec3;
use trunnion_geometry::along::{Along, Course};
use trunnion_interp::{Feed, Motion, MotionKind, Orientation, Position, Swivel};

/// How far apart the two paths may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refit {
    /// mm.
    pub mm: f64,
    /// Only the programmed points count, and not the lines drawn between them.
    pub points_only: bool,
}

/// What was found about one motion that takes the place of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refitted {
    /// No programmed point is farther from the new path than this, in order, mm.
    pub points_mm: f64,
    /// No point of either path is farther from the other than this, in order, mm.
    pub paths_mm: f64,
    /// How many motions it takes the place of.
    pub motions: u32,
}

/// Ends that are no farther apart are the same, mm: rounding of sums.
pub(crate) const JOINT: f64 = 1e-6;

/// A motion of the program after that is being followed.
#[derive(Clone, Debug)]
pub(crate) struct Following {
    along: Along,
    motions: u32,
    /// The point of the program before at which it may end, if no better one comes.
    best: Option<Box<Joint>>,
}

/// A point of the program before that is near the end of a new motion.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    /// The motion that ends there.
    pub(crate) was: Step,
    /// What was found up to there.
    pub(crate) found: Refitted,
    /// How far it is from the end, mm.
    off: f64,
    /// The motions that were followed after it.
    pub(crate) rest: Vec<Step>,
}

impl Following {
    /// Where it may end, if it must end before the next motion.
    pub(crate) fn joint(following: &mut Option<Self>) -> Option<Box<Joint>> {
        let joint = following.as_mut()?.best.take();
        if joint.is_some() {
            *following = None;
        }
        joint
    }
}

/// What became of following a motion.
pub(crate) enum Followed {
    /// It goes on.
    InPart,
    /// Both end together.
    Through(Refitted),
}

/// Whether the line `was` may begin what `is` does in one motion.
pub(crate) fn may_begin(was: &Step, is: &Step) -> bool {
    was.motion.kind == MotionKind::Linear && matches!(is.motion.kind, MotionKind::Linear | MotionKind::Arc(Some(_)))
}

/// Follows the line `was` along `is`, until it ends where `is` ends. After an error [`Following::joint`] says whether `is` ended before `was`.
pub(crate) fn follow(
    following: &mut Option<Following>,
    was: &Step,
    is: &Step,
    refit: Refit,
    claim: &Claim,
) -> Result<Followed, Verdict> {
    let (a, b) = (&was.motion, &is.motion);
    let place = |what: String| Difference {
        before: Some(a.block),
        after: Some(b.block),
        what,
    };
    if a.kind != MotionKind::Linear {
        let what = format!("one is {}, the other {}", kind(&a.kind), kind(&b.kind));
        return Err(Verdict::Differs(place(what)));
    }
    if let Some(why) = not_comparable(was, is, claim) {
        return Err(Verdict::Unknown(place(why)));
    }
    let (Some(from), Some(to), Some(start), Some(end)) = (a.start.xyz(), a.end.xyz(), b.start.xyz(), b.end.xyz())
    else {
        return Err(Verdict::Unknown(place(
            "the position of X, Y or Z is unknown".to_owned(),
        )));
    };
    let now = following.get_or_insert_with(|| {
        let course = match &b.kind {
            MotionKind::Arc(Some(arc)) => Course::Arc(*arc),
            _ => Course::Line { start, end },
        };
        Following {
            along: Along::new(course, from),
            motions: 0,
            best: None,
        }
    });
    now.along.to(to);
    now.motions += 1;
    let counts = |along: &Along| {
        if refit.points_only {
            along.points_apart()
        } else {
            along.apart()
        }
    };
    let refitted = |along: &Along, motions: u32| Refitted {
        points_mm: along.points_apart(),
        paths_mm: along.apart(),
        motions,
    };
    let off = counts(&now.along);
    // not a number is above every limit
    if off.is_nan() || off > refit.mm {
        let what = if refit.points_only { "a point" } else { "the path" };
        return Err(Verdict::Differs(place(format!(
            "{what} is up to {off:.6} mm from the new path; {} mm is allowed",
            refit.mm
        ))));
    }
    if (to - end).norm() <= JOINT && now.along.is_through() {
        return Ok(Followed::Through(refitted(&now.along, now.motions)));
    }
    // the new motion may end beside this point: it does so at the nearest one, unless it ends exactly at a later one
    let from_end = now.along.from_end();
    let nearer = from_end <= refit.mm && now.best.as_ref().is_none_or(|best| from_end < best.off);
    let ended = if nearer { now.along.ended() } else { now.along };
    if nearer && counts(&ended) <= refit.mm {
        now.best = Some(Box::new(Joint {
            was: was.clone(),
            found: refitted(&ended, now.motions),
            off: from_end,
            rest: Vec::new(),
        }));
    } else if let Some(best) = &mut now.best {
        best.rest.push(was.clone());
    }
    Ok(Followed::InPart)
}

/// Whether two motions begin at one place, or where neither is known to.
pub(crate) fn begin_together(was: &Step, is: &Step) -> bool {
    let (a, b) = (&was.motion, &is.motion);
    (0..3).all(|axis| match (a.start.get(axis), b.start.get(axis)) {
        (Some(from), Some(to)) => {
            let moved = a.zero[axis] - b.zero[axis];
            (from - to + if moved.is_nan() { 0.0 } else { moved }).abs() <= JOINT
        }
        (from, to) => from.is_none() && to.is_none(),
    })
}

pub(crate) fn begin_apart(was: &Step, is: &Step) -> Verdict {
    Verdict::Differs(Difference {
        before: Some(was.motion.block),
        after: Some(is.motion.block),
        what: "they begin at different places".to_owned(),
    })
}

/// Why the shape of the path does not follow from the programmed coordinates of X, Y and Z, or why a motion must not be made in another
/// number of pieces.
pub(crate) fn not_comparable(was: &Step, is: &Step, claim: &Claim) -> Option<String> {
    let (a, b) = (&was.motion, &is.motion);
    let why = if !may_be_cut(was) || !may_be_cut(is) {
        "under exact stop, inverse time, cycles or threading the number of blocks matters"
    } else if was.held.compensation != 0 || is.held.compensation != 0 {
        "under cutter radius compensation the control changes the path"
    } else if a.machine_coordinates || b.machine_coordinates {
        "it is programmed in machine coordinates"
    } else if !same_zero(&a.zero, &b.zero) {
        "the zero point differs"
    } else if a.tcp != b.tcp || a.tilt != b.tilt || a.tilt.free != 0 || a.tilt.swivel != Swivel::No {
        "tool centre point control or the tilted plane differs"
    } else if !stands(a) || !stands(b) || !same_rotary(&a.end, &b.end, claim.deg) || !same_vector(a, b) {
        "a rotary axis moves"
    } else if a.feed == Feed::Unknown
        || a.spindle_on != b.spindle_on
        || a.spindle_rpm != b.spindle_rpm
        || a.spin.is_some()
    {
        "the feed is unknown, or the spindle's speed changes"
    } else {
        return None;
    };
    Some(format!("blocks may not be put together here: {why}"))
}

fn same_zero(a: &[f64; 9], b: &[f64; 9]) -> bool {
    a.iter().zip(b).all(|(a, b)| a == b || a.is_nan() && b.is_nan())
}

/// Nothing but X, Y and Z moves.
fn stands(motion: &Motion) -> bool {
    let turned = match motion.orientation {
        Orientation::Words => false,
        Orientation::Vector(start, end) => start != Some(end),
    };
    let others = (3..9).all(|axis| match (motion.start.get(axis), motion.end.get(axis)) {
        (Some(from), Some(to)) => from == to,
        (None, None) => motion.says_way & (1 << axis) == 0,
        _ => false,
    });
    !turned && others
}

fn same_rotary(a: &Position, b: &Position, limit: f64) -> bool {
    a.known == b.known && (3..9).all(|axis| a.get(axis).zip(b.get(axis)).is_none_or(|(a, b)| (a - b).abs() <= limit))
}

fn same_vector(a: &Motion, b: &Motion) -> bool {
    let vector = |motion: &Motion| -> Option<Vec3> {
        match motion.orientation {
            Orientation::Words => None,
            Orientation::Vector(_, end) => Some(end),
        }
    };
    vector(a) == vector(b)
}
