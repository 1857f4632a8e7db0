//! Consecutive lines that differ only in their end, kind and feed: what they have in common is computed once.
use crate::follow::words::{Added, Words};
use crate::kinematics::forward::Along;
use crate::kinematics::pole;
use crate::{MAX_AXES, Machine, Sine, Stance};
use trunnion_geometry::Vec3;
use trunnion_interp::Motion;

/// What straight motions with the same offsets have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineCache {
    offsets: [f64; 9],
    tool_length: f64,
    pub(crate) added: Added,
    /// The tip at home, machine frame, mm.
    tool: Vec3,
    /// The directions of the two rotary axes; `None` with fewer of them, and where the linear axes are not as in `along`.
    rotary: Option<[Along; 2]>,
    /// Joint and sign of the linear axis along X, Y and Z, all of them in one segment of the chain.
    along: [(usize, f64); 3],
    segment: usize,
}

impl LineCache {
    /// Of a motion.
    pub(crate) fn of(machine: &Machine, words: &Words, motion: &Motion) -> Self {
        let constants = &machine.constants;
        let mut found = [None; 3];
        for linear in constants.linear() {
            for (slot, along) in found.iter_mut().zip(linear.motion.iter()) {
                if along.abs() == 1.0 && linear.motion.abs().sum() == 1.0 {
                    *slot = Some((linear.joint, *along));
                }
            }
        }
        let (along, segment) = match (found, constants.only_segment) {
            ([Some(x), Some(y), Some(z)], Some(segment)) if constants.linear_count == 3 => ([x, y, z], Some(segment)),
            _ => ([(0, 0.0); 3], None),
        };
        let pair = constants.pair.is_some() && segment.is_some();
        Self {
            offsets: motion.zero,
            tool_length: motion.tool_length_mm,
            added: words.added(motion),
            tool: machine.gauge_point - machine.tool_axis * motion.tool_length_mm,
            rotary: pair.then(|| [0, 1].map(|index| Along::of(&constants.rotary[index].direction))),
            along,
            segment: segment.unwrap_or(0),
        }
    }

    /// Whether a motion has the same offsets.
    #[inline]
    pub(crate) fn hold(&self, motion: &Motion) -> bool {
        let same = |a: &f64, b: &f64| a.to_bits() == b.to_bits();
        let offsets = self.offsets.iter().zip(&motion.zero);
        same(&self.tool_length, &motion.tool_length_mm) && offsets.into_iter().all(|(a, b)| same(a, b))
    }

    /// Fills in all of a stance but the axis positions, as the general path does (a test compares both), on a machine with two rotary axes whose linear
    /// ones are along X, Y and Z in one part of the chain; `false` if this is not so, or a joint is absurdly large.
    #[inline]
    pub(crate) fn stand(&self, machine: &Machine, sines: &[Sine; 2], start: &Stance, end: &mut Stance) -> bool {
        let constants = &machine.constants;
        let (Some(along), Some(pair)) = (&self.rotary, &constants.pair) else {
            return false;
        };
        // a sum that begins with zero, as that over the axes does
        let [x, y, z] = self
            .along
            .map(|(joint, sign)| 0.0 + end.joints[joint.min(MAX_AXES - 1)] * sign);
        if !(x + y + z).is_finite() {
            return false;
        }
        let mut shifts = [Vec3::zeros(); 3];
        shifts[self.segment] = Vec3::new(x, y, z);
        let [first, second] = &constants.rotary;
        let turns = end.turns.iter_mut().zip(start.turns.iter().zip([first, second]));
        for ((turn, (before, rotary)), seen) in turns.zip(sines) {
            let q = end.joints[rotary.joint];
            // a rotary axis that does not move needs no sine
            *turn = if q == start.joints[rotary.joint] {
                *before
            } else {
                seen.of(rotary.sign * q)
            };
        }
        let [outer, inner] = end.turns;
        let arm = self.tool + shifts[2] - second.point;
        let (w, arm) = along[1].turn_both(&second.direction, inner, &machine.tool_axis, &arm);
        let arm = arm + second.point + shifts[1] - first.point;
        let (axis, arm) = along[0].turn_both(&first.direction, outer, &w, &arm);
        let point = arm + first.point + shifts[0];
        let (s, branch) = pole::posture(pair, &w);
        end.axis = axis;
        end.s = s;
        end.branch = branch;
        end.pole_angle = pole::pole_angle(constants, pair, &w, end.joints[second.joint]);
        end.tool_length = self.tool_length;
        end.point = point;
        end.tip = point - Vec3::new(self.offsets[0], self.offsets[1], self.offsets[2]);
        true
    }
}
