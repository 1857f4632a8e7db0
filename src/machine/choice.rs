//! Which posture and winding of the rotary axes a control takes for a programmed tool vector.
//!
//! The rule of the generic control: the posture that the slowest rotary axis reaches soonest from the previous one; ties by the
//! smaller first, then the smaller second rotary move, then the value nearer zero. At the pole the first rotary axis stays where it
//! is. Windings are chosen inside the limits; an endless axis takes the winding nearest the previous value. Without a previous
//! posture the rotary axes are taken to stand at zero.
use crate::{Limits, Machine, NoStance, Orientations, Solution, orientations};
use core::f64::consts::{PI, TAU};
use trunnion_geometry::Vec3;

/// Differences below this are ties, rad or s: rounding must not choose a posture.
const TIE: f64 = 1e-9;

/// How far beyond its limit a rotary value may lie and still count as inside, rad.
const SLACK: f64 = 1e-9;

/// Why an angle has no winding inside the limits: the winding nearest to legal and the limit it breaks, rad.
#[derive(Clone, Copy, Debug)]
struct Outside {
    value: f64,
    limit: f64,
}

/// The winding of `q` nearest to `near`, of two equally near the one nearer zero, rad.
fn nearest_winding(q: f64, near: f64) -> f64 {
    let turns = (near - q) / TAU;
    let value = q + TAU * turns.round();
    let off = value - near;
    if off.abs() < PI - TIE {
        return value;
    }
    let other = value - TAU.copysign(off);
    if other.abs() < value.abs() { other } else { value }
}

/// The winding of `q` inside `limits` that is nearest to `near`, rad.
fn legal_winding(q: f64, near: f64, limits: Limits) -> Result<f64, Outside> {
    let value = nearest_winding(q, near);
    let Limits::Range(low, high) = limits else { return Ok(value) };
    if value >= low - SLACK && value <= high + SLACK {
        return Ok(value);
    }
    let highest = q + TAU * ((high + SLACK - q) / TAU).floor();
    if highest < low - SLACK {
        let above = highest + TAU;
        let outside = if low - highest <= above - high {
            Outside { value: highest, limit: low }
        } else {
            Outside { value: above, limit: high }
        };
        return Err(outside);
    }
    // the nearest winding lies outside, so the nearest legal one is the last before that limit
    Ok(if value > high { highest } else { q + TAU * ((low - SLACK - q) / TAU).ceil() })
}

/// A posture with its windings and what it costs to go there.
#[derive(Clone, Copy)]
struct Candidate {
    q: [f64; 2],
    cost: [f64; 5],
}

impl Candidate {
    fn new(machine: &Machine, q: [f64; 2], from: [f64; 2]) -> Self {
        let moves = [(q[0] - from[0]).abs(), (q[1] - from[1]).abs()];
        let slowness = slowness(machine);
        let time = (moves[0] * slowness[0]).max(moves[1] * slowness[1]);
        Self { q, cost: [time, moves[0], moves[1], q[0].abs(), q[1].abs()] }
    }
    /// Whether this one goes before `other`: lexicographic, differences below [`TIE`] are ties; the first named wins a full tie.
    fn before(&self, other: &Self) -> bool {
        for (mine, theirs) in self.cost.iter().zip(&other.cost) {
            if (mine - theirs).abs() > TIE {
                return mine < theirs;
            }
        }
        true
    }
}

/// Seconds per rad of the rotary axes; 1 for all where a speed is not declared.
fn slowness(machine: &Machine) -> [f64; 2] {
    let mut out = [1.0; 2];
    for (slot, rotary) in out.iter_mut().zip(machine.constants.rotary()) {
        match machine.axes[rotary.joint].max_speed {
            Some(speed) if speed > 0.0 => *slot = 1.0 / speed,
            _ => return [1.0; 2],
        }
    }
    out
}

/// Rotary joints (rad, workpiece side first) for the unit tool axis `axis` in the workpiece frame, coming `from` the previous ones.
///
/// # Errors
/// [`NoStance::Unreachable`], or [`NoStance::OutsideLimits`] where every posture breaks a limit (the least bad one is named).
pub(crate) fn choose(machine: &Machine, axis: &Vec3, from: [f64; 2]) -> Result<[f64; 2], NoStance> {
    match orientations(machine, axis) {
        Orientations::Unreachable(off) => Err(NoStance::Unreachable(off)),
        Orientations::Pole(q2) => legal(machine, [from[0], q2], from).map(|candidate| candidate.q).map_err(no_winding),
        Orientations::Postures(postures) => {
            let mut best: Option<Candidate> = None;
            let mut worst: Option<(u8, Outside)> = None;
            for solution in &postures {
                match legal(machine, solution.q, from) {
                    Ok(candidate) => {
                        if best.as_ref().is_none_or(|b| !b.before(&candidate)) {
                            best = Some(candidate);
                        }
                    }
                    Err(failed) => {
                        if worst.as_ref().is_none_or(|w| excess(&failed.1) < excess(&w.1)) {
                            worst = Some(failed);
                        }
                    }
                }
            }
            match (best, worst) {
                (Some(candidate), _) => Ok(candidate.q),
                (None, Some(failed)) => Err(no_winding(failed)),
                (None, None) => Err(NoStance::NotModelled),
            }
        }
    }
}

fn excess(outside: &Outside) -> f64 {
    (outside.value - outside.limit).abs()
}

fn no_winding((axis, Outside { value, limit }): (u8, Outside)) -> NoStance {
    NoStance::OutsideLimits { axis, value, limit }
}

/// The posture `q` with its best legal windings, or the letter of the axis that has none.
fn legal(machine: &Machine, mut q: [f64; 2], from: [f64; 2]) -> Result<Candidate, (u8, Outside)> {
    for (index, rotary) in machine.constants.rotary().iter().enumerate() {
        let axis = &machine.axes[rotary.joint];
        q[index] = legal_winding(q[index], from[index], axis.limits).map_err(|outside| (axis.letter, outside))?;
    }
    Ok(Candidate::new(machine, q, from))
}

/// Sum of the rotary moves, rad, of the cheapest way from `from` to the tool axis `axis` in the posture with the sign `branch`, limits
/// aside: Dmin of branch-swap, kinematics notes 5. A swap that a limit enforces is a swap all the same. `None`: no such posture.
pub(crate) fn cheapest_in_posture(machine: &Machine, axis: &Vec3, branch: i8, from: [f64; 2]) -> Option<f64> {
    let Orientations::Postures(postures) = orientations(machine, axis) else { return None };
    let same: &Solution = postures.iter().find(|solution| solution.branch == branch)?;
    let moves = |index: usize| (nearest_winding(same.q[index], from[index]) - from[index]).abs();
    Some(moves(0) + moves(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::rad;

    fn close(a: f64, b_deg: f64) -> bool {
        (a - rad(b_deg)).abs() < 1e-12
    }

    #[test]
    fn endless_axis_takes_the_nearest_winding() {
        let q = legal_winding(rad(-170.0), rad(1000.0), Limits::Unbounded).expect("endless");
        assert!(close(q, 910.0) || close(q, 1270.0 - 360.0), "{q}");
        // 180 degrees away on both sides: nearer zero
        assert!(close(nearest_winding(rad(180.0), rad(0.0)).abs(), 180.0));
        assert!(close(nearest_winding(rad(0.0), rad(180.0)), 0.0));
        assert!(close(nearest_winding(rad(0.0), rad(-180.0)), 0.0));
    }

    #[test]
    fn limits_choose_the_last_legal_winding() {
        let range = Limits::Range(rad(-30.0), rad(400.0));
        assert!(close(legal_winding(rad(10.0), rad(700.0), range).expect("legal"), 370.0));
        assert!(close(legal_winding(rad(10.0), rad(-700.0), range).expect("legal"), 10.0));
        let outside = legal_winding(rad(-60.0), 0.0, Limits::Range(rad(-30.0), rad(120.0))).expect_err("outside");
        assert!(close(outside.value, -60.0) && close(outside.limit, -30.0));
        let outside = legal_winding(rad(130.0), 0.0, Limits::Range(rad(-30.0), rad(120.0))).expect_err("outside");
        assert!(close(outside.value, 130.0) && close(outside.limit, 120.0));
    }
}
