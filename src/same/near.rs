//! Two motions along the same path within tolerances, by what is programmed and, with a machine, by what the machine does.
use crate::item::Step;
use crate::judge::Judge;
use crate::verdict::{Difference, Verdict};
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{AXIS_LETTERS, Motion, MotionKind, Orientation};

/// Tolerances of a comparison by ends and shape.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    /// mm.
    pub mm: f64,
    /// deg.
    pub deg: f64,
}

/// Two arcs are compared at so many points at least and at most; between them a bound holds.
const SAMPLES: [f64; 2] = [16.0, 256.0];

/// The bound between two points may add this part of a tolerance.
const ADDS: f64 = 0.01;

impl Judge for Near {
    fn pair(&mut self, before: &Step, after: &Step) -> Result<(), Verdict> {
        let (a, b) = (&before.motion, &after.motion);
        let at = |what: String| Difference {
            before: Some(a.block),
            after: Some(b.block),
            what,
        };
        let differs = |what: String| Err(Verdict::Differs(at(what)));
        let unknown = |what: String| Err(Verdict::Unknown(at(what)));
        if a.tcp == b.tcp && same_sort(a, b) {
            if a.end.known != b.end.known {
                let letters: String = (0..9)
                    .filter(|axis| (a.end.known ^ b.end.known) & (1 << axis) != 0)
                    .map(|axis| char::from(AXIS_LETTERS[axis]))
                    .collect();
                return unknown(format!("the end of {letters} is known in only one of the programs"));
            }
            for axis in (0..9).filter(|axis| a.end.known & (1 << axis) != 0) {
                let (from, to) = (placed(a, axis, a.end.values[axis]), placed(b, axis, b.end.values[axis]));
                let rotary = (3..6).contains(&axis);
                let limit = if rotary { self.deg } else { self.mm };
                let off = (from - to).abs();
                if off.is_nan() {
                    // the zero point of the axis is unknown; both add the same coordinate to it only if these are equal
                    if (a.end.values[axis] - b.end.values[axis]).abs() <= limit && from.is_nan() && to.is_nan() {
                        continue;
                    }
                    return unknown(format!(
                        "the zero point of {} is unknown in one of the programs",
                        char::from(AXIS_LETTERS[axis])
                    ));
                }
                if off > limit {
                    let unit = if rotary { "deg" } else { "mm" };
                    let letter = char::from(AXIS_LETTERS[axis]);
                    return differs(format!(
                        "{letter} ends at {} {unit} and at {} {unit}",
                        a.end.values[axis], b.end.values[axis]
                    ));
                }
            }
            if let (Orientation::Vector(_, from), Orientation::Vector(_, to)) = (a.orientation, b.orientation) {
                let angle = deg(angle_between(&from, &to));
                if angle > self.deg {
                    return differs(format!("the tool axis differs by {angle:.6} deg"));
                }
            }
            if let (MotionKind::Arc(Some(from)), MotionKind::Arc(Some(to))) = (&a.kind, &b.kind) {
                let off = arcs_apart(from, to, [a, b], ADDS * self.mm);
                if off > self.mm {
                    return differs(format!("the arcs are up to {off:.6} mm apart"));
                }
            }
            return self.joints(before, after).map_or(Ok(()), differs);
        }
        let ends = before.leg.as_ref().zip(after.leg.as_ref());
        let Some((Ok(was), Ok(is))) = ends.map(|(a, b)| (a.end.as_ref(), b.end.as_ref())) else {
            return unknown(
                "the tool axes are programmed in different ways, and without a machine these cannot be compared".into(),
            );
        };
        let off = (was.tip + zero(a) - is.tip - zero(b)).norm();
        let angle = deg(angle_between(&was.axis, &is.axis));
        if off > self.mm || angle > self.deg {
            return differs(format!(
                "the tip ends {off:.6} mm and the tool axis {angle:.6} deg apart"
            ));
        }
        unknown("both end in the same pose, but their tool axes are programmed in different ways: the paths in between are not compared".into())
    }
}

impl Near {
    /// What differs in the joints, where both are known.
    fn joints(&self, before: &Step, after: &Step) -> Option<String> {
        let (a, b) = (before.leg.as_ref()?, after.leg.as_ref()?);
        let (was, is) = (a.end.as_ref().ok()?, b.end.as_ref().ok()?);
        let off = (was.tip + zero(&before.motion) - is.tip - zero(&after.motion)).norm();
        if off > self.mm {
            return Some(format!("the tip ends {off:.6} mm away"));
        }
        let angle = deg(angle_between(&was.axis, &is.axis));
        if angle > self.deg {
            return Some(format!("the tool axis ends {angle:.6} deg off"));
        }
        (was.branch != is.branch && was.branch * is.branch == -1)
            .then(|| "the machine reaches the same pose in another posture".to_owned())
    }
}

/// Programmed with the same kind of words.
pub(crate) fn same_sort(a: &Motion, b: &Motion) -> bool {
    core::mem::discriminant(&a.orientation) == core::mem::discriminant(&b.orientation) && a.tilt == b.tilt
}

/// A coordinate with the zero point in effect.
fn placed(motion: &Motion, axis: usize, value: f64) -> f64 {
    if motion.machine_coordinates {
        value
    } else {
        value + motion.zero[axis]
    }
}

/// X Y Z of the zero point, mm.
fn zero(motion: &Motion) -> Vec3 {
    Vec3::new(motion.zero[0], motion.zero[1], motion.zero[2])
}

/// How far the zero point of `b` is from that of `a`, mm; zero where it is unknown.
fn shift(a: &Motion, b: &Motion) -> Vec3 {
    (zero(b) - zero(a)).map(|value| if value.is_nan() { 0.0 } else { value })
}

/// No point of one arc is farther from the point of the other at the same share, mm; up to `adds`, mm, more than is needed, where 256 points are
/// enough for that.
///
/// Between samples a share h apart the distance of two curves exceeds that at the samples by at most Q h^2 / 8, where Q bounds the second derivative
/// of their difference. An arc is c + rho(t) U(t) + n h t, where U turns by s t and rho goes from r0 to r1: its second derivative is
/// -s^2 rho U + 2 s (r1 - r0) n x U.
pub fn arcs_apart(a: &Arc, b: &Arc, [before, after]: [&Motion; 2], adds: f64) -> f64 {
    apart(a, b, shift(before, after), adds)
}

/// The same of arcs whose zero points are a shift apart, mm.
fn apart(a: &Arc, b: &Arc, shift: Vec3, adds: f64) -> f64 {
    if a == b && shift == Vec3::zeros() {
        return 0.0;
    }
    let spread = |arc: &Arc| (arc.radius_end - arc.radius_start).abs();
    let radius = |arc: &Arc| arc.radius_start.max(arc.radius_end);
    let bend = |arc: &Arc| radius(arc) * arc.sweep * arc.sweep + 2.0 * spread(arc) * arc.sweep.abs();
    // two arcs of nearly one shape bend nearly alike: the difference of the second derivatives, factor by factor
    let alike = a.normal.cross(&b.normal).norm() <= 1e-9 && a.normal.dot(&b.normal) > 0.0;
    let bend = if alike {
        let arm = |arc: &Arc| (arc.start - arc.centre) / arc.radius_start;
        let sweep = a.sweep.abs().max(b.sweep.abs());
        let turn = (a.sweep - b.sweep).abs();
        // of the two arms, once they have turned about their own normals
        let arms = (arm(a) - arm(b)).norm() + turn + (a.normal - b.normal).norm() * (1.0 + sweep);
        let [start, end] = [a.radius_start - b.radius_start, a.radius_end - b.radius_end].map(f64::abs);
        let (most, slope) = (radius(a).max(radius(b)), spread(a).max(spread(b)));
        let inwards =
            most * (a.sweep * a.sweep - b.sweep * b.sweep).abs() + sweep * sweep * (start.max(end) + most * arms);
        let along = 2.0 * (turn * slope + sweep * (start + end) + sweep * slope * arms);
        (inwards + along + 1e-12).min(bend(a) + bend(b))
    } else {
        bend(a) + bend(b)
    };
    let samples = (bend / (8.0 * adds.max(f64::MIN_POSITIVE)))
        .sqrt()
        .ceil()
        .clamp(SAMPLES[0], SAMPLES[1]);
    let between = bend / (8.0 * samples * samples);
    // each arc stays within its radius and its height of its centre: of many turns the samples say no more than that
    let reach = |arc: &Arc| radius(arc) + arc.height().abs();
    let most = (b.centre + shift - a.centre).norm() + reach(a) + reach(b);
    if between >= most {
        return most;
    }
    let sampled = (0..=samples as u32)
        .map(|step| f64::from(step) / samples)
        .map(|share| (b.point_at(share) + shift - a.point_at(share)).norm())
        .fold(0.0, f64::max);
    most.min(sampled + between)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::arc::Turning;

    /// No point of two arcs is farther apart than their bound, however many turns they have.
    #[test]
    fn arcs_are_no_farther_apart_than_their_bound() {
        let mut state = 11_u64;
        let mut random = |most: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            most * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
        };
        let mut turns = [0, 0];
        for round in 0..3000 {
            let near = [0.0, 1e-4, 0.1, 30.0][round % 4];
            let point =
                |random: &mut dyn FnMut(f64) -> f64, most: f64| Vec3::new(random(most), random(most), random(most));
            let ends = [(); 3].map(|()| point(&mut random, 20.0));
            let others = ends.map(|end| end + point(&mut random, near));
            let extra = [0, 1, 40, 5000][round / 4 % 4];
            let arc = |[start, end, centre]: [Vec3; 3], extra| {
                Arc::from_centre(start, end, centre, Vec3::z(), Turning::Clockwise, extra)
            };
            let (Some(a), Some(b)) = (arc(ends, extra), arc(others, extra + (round % 3) as u32)) else {
                continue;
            };
            let shift = if round % 5 == 0 {
                point(&mut random, near)
            } else {
                Vec3::zeros()
            };
            let bound = apart(&a, &b, shift, [0.0, 1e-7, 0.1][round % 3]);
            let shares = (0..=3000).map(|step| f64::from(step) / 3000.0);
            let seen = shares
                .map(|share| (b.point_at(share) + shift - a.point_at(share)).norm())
                .fold(0.0, f64::max);
            assert!(seen <= bound + 1e-9, "{seen} mm, bound {bound} mm of {a:?} and {b:?}");
            turns[usize::from(extra > 1)] += 1;
            assert!(near > 0.0 || shift != Vec3::zeros() || a != b || bound == 0.0);
        }
        assert!(turns.iter().all(|count| *count > 1000), "{turns:?}");
    }
}
