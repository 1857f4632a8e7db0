//! A line in several pieces, each near the segment that the line programs.
use trunnion_geometry::deg;
use trunnion_interp::Orientation;
use trunnion_machine::{Leg, Machine, Stance, tip_deviation};

/// Where two programs are at the same place, joints agree this closely, mm and rad.
const SAME: f64 = 1e-9;

/// The pieces of one line so far: from where the next one starts, and which share of the rotary travel is behind it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Begun {
    share: f64,
}

/// What is found of one piece.
pub(crate) struct Piece {
    /// It ends where the line ends.
    pub(crate) last: bool,
    /// No point of it is farther from the programmed segment, mm.
    pub(crate) bound_mm: f64,
}

/// Why it is no proved piece: `Ok` reasons are certain.
pub(crate) enum Wrong {
    /// It is none.
    Refuted(String),
    /// That is unknown.
    Unknown(&'static str),
}

fn alike(a: &Stance, b: &Stance) -> bool {
    a.joints.iter().zip(&b.joints).all(|(a, b)| (a - b).abs() <= SAME)
}

/// Judges one line of the program after against a line of the program before. `begun`: the pieces before it. `Ok(None)`: they are one pair.
///
/// The joints run linearly in both. A piece whose ends are within r of where the segment is at their shares, and whose tip path is within d of its own chord, is
/// within r + d of the segment, because a segment is convex. Its rotary axes stay within `tolerance_deg` of the positions that the line comes past, because
/// both run linearly in their joints.
pub(crate) fn piece(
    machine: &Machine,
    [line, piece]: [&Leg; 2],
    begun: &mut Option<Begun>,
    (tolerance_mm, tolerance_deg): (f64, f64),
) -> Result<Option<Piece>, Wrong> {
    let (Some(from), Ok(to)) = (&line.start, &line.end) else {
        return Ok(None);
    };
    let (Some(start), Ok(end)) = (&piece.start, &piece.end) else {
        return Ok(None);
    };
    let last = alike(to, end);
    if begun.is_none() && (last || !alike(from, start)) {
        return Ok(None);
    }
    if line.motion.tcp
        || piece.motion.tcp
        || [line, piece]
            .iter()
            .any(|leg| leg.motion.orientation != Orientation::Words)
    {
        return Err(Wrong::Unknown(
            "a line under tool centre point control, or with tool vectors, is not cut in pieces",
        ));
    }
    let was = begun.map_or(0.0, |begun| begun.share);
    let share = if last { 1.0 } else { share(machine, [from, to], end) };
    if !(share > was && share <= 1.0) {
        return Err(Wrong::Refuted("an inserted point is behind the previous one".into()));
    }
    for &joint in &machine.rotary {
        let expected = from.joints[joint] + share * (to.joints[joint] - from.joints[joint]);
        let off = deg((end.joints[joint] - expected).abs());
        if off > tolerance_deg {
            return Err(Wrong::Refuted(format!(
                "a point that was put in turns {} {off:.6} deg away from the original path",
                char::from(machine.axes[joint].letter)
            )));
        }
    }
    // where the line would be at that share, if its tip ran straight
    let off = |stance: &Stance, share: f64| (stance.tip - (from.tip + (to.tip - from.tip) * share)).norm();
    let ends = off(start, was).max(off(end, share));
    let Some(deviation) = tip_deviation(machine, piece, (tolerance_mm - ends).max(0.0)) else {
        return Err(Wrong::Unknown("the path of the tip is not known in a piece"));
    };
    let bound_mm = ends + deviation.bound_mm;
    if bound_mm > tolerance_mm {
        return Err(Wrong::Refuted(format!(
            "a piece keeps the tip within {bound_mm:.6} mm of the programmed segment, and not within {tolerance_mm} mm"
        )));
    }
    *begun = (!last).then_some(Begun { share });
    Ok(Some(Piece { last, bound_mm }))
}

/// The share of the line at which its rotary axes are nearest to those of a stance; where none turns, at which its tip is.
fn share(machine: &Machine, [from, to]: [&Stance; 2], at: &Stance) -> f64 {
    let (mut dot, mut square) = (0.0, 0.0);
    for &joint in &machine.rotary {
        let whole = to.joints[joint] - from.joints[joint];
        dot += whole * (at.joints[joint] - from.joints[joint]);
        square += whole * whole;
    }
    if square > 0.0 {
        return dot / square;
    }
    let whole = to.tip - from.tip;
    whole.dot(&(at.tip - from.tip)) / whole.norm_squared()
}
