//! Forward after inverse is the identity: proved on random poses, with the residual.
use crate::{AxisKind, Joints, Limits, MAX_AXES, Machine, Orientations, forward, inverse, orientations};
use core::f64::consts::{PI, TAU};
use trunnion_geometry::math::angle_between;

/// The result of a self-test.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfTest {
    /// Poses tried.
    pub poses: usize,
    /// Worst tip residual, mm.
    pub worst_tip_mm: f64,
    /// Worst tool axis residual, rad.
    pub worst_axis: f64,
    /// Poses whose true posture was not among the answers.
    pub posture_missing: usize,
}

/// Rotary values that agree to this, weighted by how far they move the tool, are the same posture, rad.
const SAME_POSTURE: f64 = 1e-6;

/// Tries `poses` random poses (deterministic for a `seed`): joints drawn inside the limits (an endless rotary axis: one turn; a linear
/// axis without limits: -300..300 mm), tool lengths 0..200 mm; every posture found must lead back to the pose.
pub fn self_test(machine: &Machine, poses: usize, seed: u64) -> SelfTest {
    let mut result = SelfTest {
        poses,
        worst_tip_mm: 0.0,
        worst_axis: 0.0,
        posture_missing: 0,
    };
    let mut random = SplitMix(seed);
    // held axes are tried at a few other values too: a separate machine each time
    let mut elsewhere = None;
    for pose in 0..poses {
        let mut joints = random_joints(machine, &mut random);
        let length = random.between(0.0, 200.0);
        if pose % HELD_FOR == HELD_FOR / 2 {
            elsewhere = machine.held_elsewhere(&joints);
        } else if pose % HELD_FOR == 0 {
            elsewhere = None;
        }
        let tried = elsewhere.as_ref().unwrap_or(machine);
        for (joint, value) in tried.held() {
            joints[joint] = value;
        }
        try_pose(tried, &joints, length, &mut result);
    }
    result
}

/// This many poses are tried before held axes change between their own value and another.
const HELD_FOR: usize = 64;

/// One pose: joints, pose, all postures, joints again, pose again.
pub(crate) fn try_pose(machine: &Machine, joints: &Joints, length: f64, result: &mut SelfTest) {
    let pose = forward(machine, joints, length);
    let mut found = false;
    let mut try_posture = |q: [f64; 2]| {
        let mut answer = *joints;
        for (&joint, value) in machine.rotary.iter().zip(q) {
            answer[joint] = value;
        }
        if inverse(machine, &mut answer, &pose.tip, length).is_none() {
            return;
        }
        let again = forward(machine, &answer, length);
        result.worst_tip_mm = result.worst_tip_mm.max((again.tip - pose.tip).norm());
        result.worst_axis = result.worst_axis.max(angle_between(&again.axis, &pose.axis));
        found |= same_posture(machine, joints, q);
    };
    match orientations(machine, &pose.axis) {
        Orientations::Postures(postures) => postures.iter().for_each(|posture| try_posture(posture.q)),
        Orientations::Pole(q2) => try_posture([machine.rotary.first().map_or(0.0, |&joint| joints[joint]), q2]),
        Orientations::Unreachable(_) => {}
    }
    result.posture_missing += usize::from(!found);
}

/// Whether the rotary joints agree with `q` up to whole turns. Near the pole, q1 is known only as well as the tool axis fixes it.
fn same_posture(machine: &Machine, joints: &Joints, q: [f64; 2]) -> bool {
    let weight = [
        crate::pole_angle(machine, &crate::tool_axis_at(machine, q)).min(1.0),
        1.0,
    ];
    machine
        .rotary
        .iter()
        .zip(q)
        .zip(weight)
        .all(|((&joint, value), weight)| {
            let off = (joints[joint] - value).rem_euclid(TAU);
            off.min(TAU - off) * weight < SAME_POSTURE
        })
}

/// Joints inside the limits, even over the range.
fn random_joints(machine: &Machine, random: &mut SplitMix) -> Joints {
    let mut joints = [0.0; MAX_AXES];
    for (joint, axis) in joints.iter_mut().zip(&machine.axes) {
        let (low, high) = match (axis.limits, axis.kind) {
            (Limits::Range(low, high), _) => (low, high),
            (Limits::Unbounded, AxisKind::Rotary) => (-PI, PI),
            (Limits::Unbounded, AxisKind::Linear) => (-300.0, 300.0),
        };
        *joint = random.between(low, high);
    }
    joints
}

/// SplitMix64: a small generator whose numbers are the same everywhere.
pub(crate) struct SplitMix(pub(crate) u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// A number in `low..high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }
}
