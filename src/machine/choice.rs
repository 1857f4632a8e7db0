//! Which posture and winding of the rotary axes a control takes for a programmed tool vector.
//!
//! The rule of the generic control: the posture that the slowest rotary axis reaches soonest from the previous one; ties by the
//! smaller first, then the smaller second rotary move, then the value nearer zero. At the pole the first rotary axis stays where it
//! is. Windings are chosen inside the limits; an endless axis takes the winding nearest the previous value. Without a previous
//! posture the rotary axes are taken to stand at zero.
use crate::{Limits, Machine, NoStance, Orientations, Solution, orientations, windings};
use core::f64::consts::TAU;
use trunnion_geometry::Vec3;

/// Differences below this are ties, rad or s: rounding must not choose a posture.
const TIE: f64 = 1e-9;

/// Why an angle has no winding inside the limits: the winding nearest to legal and the limit it breaks, rad.
#[derive(Clone, Copy, Debug)]
struct Outside {
    value: f64,
    limit: f64,
}

/// The winding of `q` inside the limits of joint `axis` that is nearest to `near`, rad; of two equally near the one nearer zero, of two
/// equally near zero the positive one.
fn legal_winding(machine: &Machine, axis: usize, q: f64, near: f64) -> Result<f64, Outside> {
    match *windings(machine, axis, q, near) {
        [] => Err(least_bad(machine.axes[axis].limits, q)),
        [first, second, ..] => {
            let tie = (second - near).abs() < (first - near).abs() + TIE;
            let nearer_zero = first.abs() - second.abs();
            let takes_second = nearer_zero > TIE || (nearer_zero > -TIE && second > first);
            Ok(if tie && takes_second { second } else { first })
        }
        [first] => Ok(first),
    }
}

/// The winding of `q` nearest to the limits, none of which is inside them.
fn least_bad(limits: Limits, q: f64) -> Outside {
    let Limits::Range(low, high) = limits else {
        return Outside { value: q, limit: q };
    };
    let below = q + TAU * ((high - q) / TAU).floor();
    let above = below + TAU;
    if low - below <= above - high {
        Outside {
            value: below,
            limit: low,
        }
    } else {
        Outside {
            value: above,
            limit: high,
        }
    }
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
        Self {
            q,
            cost: [time, moves[0], moves[1], q[0].abs(), q[1].abs()],
        }
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
        Orientations::Pole(q2) => legal(machine, [from[0], q2], from)
            .map(|candidate| candidate.q)
            .map_err(no_winding),
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
        let letter = machine.axes[rotary.joint].letter;
        q[index] = legal_winding(machine, rotary.joint, q[index], from[index]).map_err(|outside| (letter, outside))?;
    }
    Ok(Candidate::new(machine, q, from))
}

/// Sum of the rotary moves, rad, of the cheapest way from `from` to the tool axis `axis` in the posture with the sign `branch`, limits
/// aside: Dmin of branch-swap, kinematics notes 5. A swap that a limit enforces is a swap all the same. `None`: no such posture.
pub(crate) fn cheapest_in_posture(machine: &Machine, axis: &Vec3, branch: i8, from: [f64; 2]) -> Option<f64> {
    let Orientations::Postures(postures) = orientations(machine, axis) else {
        return None;
    };
    let same: &Solution = postures.iter().find(|solution| solution.branch == branch)?;
    let moves = |index: usize| {
        let off = same.q[index] - from[index];
        (off - TAU * (off / TAU).round()).abs()
    };
    Some(moves(0) + moves(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin;
    use trunnion_geometry::{deg, rad};

    fn mikron() -> &'static Machine {
        builtin("mikron-ucp710").expect("built in")
    }

    fn joints(axis: Vec3, from: [f64; 2]) -> [f64; 2] {
        choose(mikron(), &axis.normalize(), from.map(rad))
            .expect("reachable")
            .map(deg)
    }

    fn assert_near(found: [f64; 2], wanted: [f64; 2]) {
        assert!(
            (found[0] - wanted[0]).abs() < 1e-4 && (found[1] - wanted[1]).abs() < 1e-4,
            "{found:?}, not {wanted:?}"
        );
    }

    #[test]
    fn an_endless_axis_takes_the_nearest_winding() {
        // |u| sin 20 deg along (3, 4) / 5: C 143.1301 A 20, or C -36.8699 A -20
        let axis = Vec3::new(0.205_212_086, 0.273_616_115, 0.939_692_621);
        assert_near(joints(axis, [0.0, 20.0]), [-36.8699, -20.0]);
        assert_near(joints(axis, [1200.0, 20.0]), [143.1301 + 1080.0, 20.0]);
        assert_near(joints(axis, [-400.0, -20.0]), [-36.8699 - 360.0, -20.0]);
    }

    #[test]
    fn a_limit_excludes_a_posture() {
        // A -60 is outside -30..120, so the long way it is
        let axis = Vec3::new(0.0, 0.866_025, 0.5);
        assert_near(joints(axis, [0.0, 0.0]), [180.0, 60.0]);
        // pointing down at 150 deg: both postures leave the travel of A, +150 is the nearer
        let down = Vec3::new(0.0, -0.5, -0.866_025).normalize();
        let Err(NoStance::OutsideLimits { axis, value, limit }) = choose(mikron(), &down, [0.0; 2]) else {
            panic!("a posture outside the limits was chosen")
        };
        assert_eq!(axis, b'A');
        assert!((deg(value) - 150.0).abs() < 1e-3 && (deg(limit) - 120.0).abs() < 1e-9);
    }

    #[test]
    fn ties_are_settled_the_same_way_everywhere() {
        // half a turn either way: the winding nearer zero
        let axis = Vec3::new(0.0, -0.5, 0.866_025);
        assert_near(joints(axis, [180.0, 30.0]), [0.0, 30.0]);
        assert_near(joints(axis, [-180.0, 30.0]), [0.0, 30.0]);
        assert_near(joints(axis, [540.0, 30.0]), [360.0, 30.0]);
    }

    #[test]
    fn the_pole_keeps_the_first_axis() {
        assert_near(joints(Vec3::z(), [77.0, 3.0]), [77.0, 0.0]);
        assert_near(joints(Vec3::z(), [-1000.0, 3.0]), [-1000.0, 0.0]);
    }

    #[test]
    fn the_cheapest_move_of_a_posture_ignores_limits() {
        let axis = Vec3::new(0.0, 0.866_025, 0.5).normalize();
        let least = cheapest_in_posture(mikron(), &axis, 1, [0.0, rad(-10.0)]).expect("two postures");
        assert!((deg(least) - 50.0).abs() < 1e-3, "{}", deg(least));
        let least = cheapest_in_posture(mikron(), &axis, -1, [0.0, rad(10.0)]).expect("two postures");
        assert!((deg(least) - 230.0).abs() < 1e-3, "{}", deg(least));
    }

    /// Both postures of one tool axis: C 10 A 20 and C -170 A -20. Coming from A -15 a slow A takes the far way of C.
    #[test]
    fn the_slowest_axis_decides_not_the_longest_way() {
        let axis = trunnion_geometry::math::rotate(
            &Vec3::z(),
            rad(10.0),
            &trunnion_geometry::math::rotate(&Vec3::x(), rad(20.0), &Vec3::z()),
        );
        let mut machine = mikron().clone();
        let q = |machine: &Machine| choose(machine, &axis, [0.0, rad(-15.0)]).expect("reachable").map(deg);
        let [c, a] = [machine.joint(b'C').expect("C"), machine.joint(b'A').expect("A")];
        (machine.axes[c].max_speed, machine.axes[a].max_speed) = (Some(1.0), Some(1.0));
        assert_near(q(&machine), [10.0, 20.0]);
        (machine.axes[c].max_speed, machine.axes[a].max_speed) = (Some(100.0), Some(1.0));
        assert_near(q(&machine), [-170.0, -20.0]);
    }
}
