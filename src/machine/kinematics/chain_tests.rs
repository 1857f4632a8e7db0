//! Random chains: two rotary and three or four linear axes in any order, at any angles, against a naive chain product.
use crate::kinematics::selftest::{SelfTest, SplitMix, try_pose};
use crate::{
    Axis, AxisExtra, AxisKind, Constants, Joints, Limits, MAX_AXES, Machine, Orientations, Side, builtin, forward,
    orientations, solution_s,
};
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::rotate;

/// An axis of a random chain.
fn axis(letter: u8, kind: AxisKind, side: Side, direction: Vec3, point: Vec3, sign: f64) -> Axis {
    Axis {
        letter,
        kind,
        side,
        direction,
        point,
        sign,
        limits: Limits::Unbounded,
        max_speed: None,
        max_acceleration: None,
        note: None,
        source: None,
        extra: AxisExtra::default(),
    }
}

fn random_unit(random: &mut SplitMix) -> Vec3 {
    loop {
        let v = Vec3::new(
            random.between(-1.0, 1.0),
            random.between(-1.0, 1.0),
            random.between(-1.0, 1.0),
        );
        if v.norm() > 0.1 && v.norm() < 1.0 {
            return v.normalize();
        }
    }
}

/// Two rotary and three or four linear axes in any order, at any angles, with any offsets and signs, both sides.
fn random_machine(random: &mut SplitMix) -> Machine {
    loop {
        let mut kinds = vec![
            AxisKind::Rotary,
            AxisKind::Rotary,
            AxisKind::Linear,
            AxisKind::Linear,
            AxisKind::Linear,
        ];
        if random.between(0.0, 1.0) < 0.3 {
            kinds.push(AxisKind::Linear);
        }
        for i in (1..kinds.len()).rev() {
            kinds.swap(i, random.between(0.0, i as f64 + 1.0) as usize);
        }
        let head_from = random.between(0.0, 7.0) as usize;
        let mut letters = (b"ABC".iter(), b"XYZW".iter());
        let axes: Vec<Axis> = kinds
            .iter()
            .enumerate()
            .map(|(i, &kind)| {
                let next = if kind == AxisKind::Rotary {
                    letters.0.next()
                } else {
                    letters.1.next()
                };
                let point = random_unit(random) * random.between(0.0, 300.0);
                let sign = if random.between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
                let side = if i < head_from { Side::Table } else { Side::Head };
                axis(
                    *next.expect("enough letters"),
                    kind,
                    side,
                    random_unit(random),
                    point,
                    sign,
                )
            })
            .collect();
        let tool_axis = random_unit(random);
        let Some(constants) = Constants::new(&axes, &tool_axis) else {
            continue;
        };
        // directions that a machine file may have: well away from parallel axes and from a flat triple of linear axes
        let Some(pair) = &constants.pair else { continue };
        if pair.d < 0.01 || pair.y.abs() > 0.995 || constants.inverse_motion.norm() > 20.0 {
            continue;
        }
        let mut machine = builtin("mill-3axis").expect("embedded").clone();
        machine.rotary = constants.rotary().iter().map(|rotary| rotary.joint).collect();
        machine.linear = constants.linear().iter().map(|linear| linear.joint).collect();
        machine.gauge_point = random_unit(random) * random.between(0.0, 300.0);
        machine.home.tool_axis = tool_axis;
        (machine.axes, machine.tool_axis, machine.constants) = (axes, tool_axis, constants);
        return machine;
    }
}

/// The chain product as kinematics notes 2.1 write it, one axis after the other.
fn naive_forward(machine: &Machine, joints: &Joints, length: f64) -> (Vec3, Vec3) {
    let (mut tip, mut direction) = (machine.gauge_point - machine.tool_axis * length, machine.tool_axis);
    for (axis, q) in machine.axes.iter().zip(joints).rev() {
        match axis.kind {
            AxisKind::Linear => tip += axis.direction * (axis.sign * q),
            AxisKind::Rotary => {
                tip = rotate(&axis.direction, axis.sign * q, &(tip - axis.point)) + axis.point;
                direction = rotate(&axis.direction, axis.sign * q, &direction);
            }
        }
    }
    (tip, direction)
}

/// 100 000 random chains and poses: residual below 1e-11, and the true posture among the answers.
#[test]
#[expect(clippy::print_stderr, reason = "the measured residual is worth reading")]
fn random_chains_and_poses() {
    let mut random = SplitMix(2006);
    let mut result = SelfTest {
        poses: 100_000,
        worst_tip_mm: 0.0,
        worst_axis: 0.0,
        posture_missing: 0,
    };
    let (mut solved, mut flat) = (0, 0);
    while solved < result.poses {
        let mut machine = random_machine(&mut random);
        machine.gauge_point = random_unit(&mut random) * random.between(0.0, 300.0);
        let mut joints = [0.0; MAX_AXES];
        for (joint, axis) in joints.iter_mut().zip(&machine.axes) {
            let reach = if axis.kind == AxisKind::Rotary { PI } else { 300.0 };
            *joint = random.between(-reach, reach);
        }
        let length = random.between(0.0, 200.0);
        let pose = forward(&machine, &joints, length);
        let (tip, direction) = naive_forward(&machine, &joints, length);
        assert!((pose.tip - tip).norm() < 1e-12 * 1000.0 && (pose.axis - direction).norm() < 1e-14);
        if !well_posed(&machine, &pose.axis, &joints) {
            flat += 1;
            continue;
        }
        try_pose(&machine, &joints, length, &mut result);
        assert_s_sign(&machine, &pose.axis);
        solved += 1;
    }
    eprintln!(
        "worst residual {:.2e} mm, {:.2e} rad; {flat} poses left out (linear axes nearly flat)",
        result.worst_tip_mm, result.worst_axis
    );
    assert_eq!(result.posture_missing, 0);
    // unit of the tip residual: 100 mm
    assert!(
        result.worst_axis < 1e-11 && result.worst_tip_mm / 100.0 < 1e-11,
        "{result:?}"
    );
    assert!(flat < 40_000);
}

/// Linear axes with a rotary one between them can fall into a plane for some rotary positions; those poses have no sharp answer.
fn well_posed(machine: &Machine, axis: &Vec3, joints: &Joints) -> bool {
    let Orientations::Postures(found) = orientations(machine, axis) else {
        return false;
    };
    let own = machine.constants.rotary.map(|rotary| joints[rotary.joint]);
    found.iter().map(|posture| posture.q).chain([own]).all(|q| {
        let mut unit = [0.0; MAX_AXES];
        for (&joint, value) in machine.rotary.iter().zip(q) {
            unit[joint] = value;
        }
        let base = forward(machine, &unit, 0.0).tip;
        let columns = machine.constants.solved.map(|index| {
            let mut moved = unit;
            moved[machine.constants.linear[index].joint] = 1.0;
            forward(machine, &moved, 0.0).tip - base
        });
        columns[0].cross(&columns[1]).dot(&columns[2]).abs() > 0.05
    })
}

fn assert_s_sign(machine: &Machine, axis: &Vec3) {
    let Orientations::Postures(found) = orientations(machine, axis) else {
        return;
    };
    for posture in &found {
        let s = solution_s(machine, posture.q[1]);
        assert!(
            posture.branch == 0 || s * f64::from(posture.branch) > 0.0,
            "{posture:?} {s}"
        );
    }
    assert!(found.len() == 1 || found[0].branch == -found[1].branch);
}
