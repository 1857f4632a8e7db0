//! Bounds against dense samples, on every built-in machine.
use super::{Apart, Interpolation, Path, apart, great_circle};
use proptest::prelude::*;
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, rad};
use trunnion_machine::{AxisKind, BUILTIN_MACHINES, Joints, MAX_AXES, Machine, builtin, forward};

fn joints(machine: &Machine, values: &[f64; MAX_AXES]) -> Joints {
    let mut joints: Joints = [0.0; MAX_AXES];
    for ((joint, axis), value) in joints.iter_mut().zip(&machine.axes).zip(values) {
        *joint = if axis.kind == AxisKind::Rotary {
            rad(180.0 * value)
        } else {
            100.0 * value
        };
    }
    joints
}

fn path<'m>(machine: &'m Machine, ends: &[[f64; MAX_AXES]; 2], interpolation: Interpolation, height: f64) -> Path<'m> {
    let joints = ends.map(|values| joints(machine, &values));
    let axes = joints.map(|joints| forward(machine, &joints, 40.0).axis);
    Path {
        machine,
        interpolation,
        joints,
        axes,
        tips: joints.map(|joints| forward(machine, &joints, 40.0).tip),
        tool_length: 40.0,
        height,
    }
}

/// Largest distance and angle at many moments, none of them one that `apart` looks at.
fn dense(before: &Path<'_>, after: &Path<'_>) -> (f64, f64) {
    let mut worst = (0.0f64, 0.0f64);
    for step in 0..1009 {
        let t = (f64::from(step) + 0.37) / 1009.0;
        let ((point, axis), (point_after, axis_after)) = (before.at(t), after.at(t));
        worst.0 = worst.0.max((point_after - point).norm());
        worst.1 = worst.1.max(angle_between(&axis, &axis_after));
    }
    worst
}

fn interpolations() -> impl Strategy<Value = Interpolation> {
    prop_oneof![
        Just(Interpolation::Joints),
        Just(Interpolation::TipStraight),
        Just(Interpolation::GreatCircle)
    ]
}

fn ends() -> impl Strategy<Value = [[f64; MAX_AXES]; 2]> {
    prop::array::uniform2(prop::array::uniform9(-1.0..1.0f64))
}

#[test]
fn the_great_circle_runs_evenly_from_end_to_end() {
    let (a, b) = (Vec3::new(0.0, 0.0, 1.0), Vec3::new(1.0, 0.0, 0.0));
    let middle = great_circle(&a, &b, 0.5);
    assert!((angle_between(&a, &middle) - rad(45.0)).abs() < 1e-12);
    assert!((great_circle(&a, &b, 1.0) - b).norm() < 1e-12);
    assert_eq!(great_circle(&a, &a, 0.3), a);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn no_moment_is_beyond_the_bound(
        name in prop::sample::select(BUILTIN_MACHINES),
        before in ends(),
        after in ends(),
        modes in (interpolations(), interpolations()),
        height in 0.0..20.0f64,
    ) {
        let machine = builtin(name).expect("built in");
        let (before, after) = (path(machine, &before, modes.0, height), path(machine, &after, modes.1, height));
        let Apart { sampled_mm, bound_mm, sampled_axis, bound_axis } = apart(&before, &after);
        let (distance, angle) = dense(&before, &after);
        prop_assert!(distance <= bound_mm + 1e-9, "{distance} mm beyond {bound_mm}");
        prop_assert!(angle <= bound_axis + 1e-7, "{angle} rad beyond {bound_axis}");
        prop_assert!(sampled_mm <= bound_mm && sampled_axis <= bound_axis);
    }

    #[test]
    fn one_chord_is_enough_for_the_bend(name in prop::sample::select(BUILTIN_MACHINES), ends in ends(), mode in interpolations(), t in 0.0..1.0f64) {
        // |W(t) - chord(t)| <= Q/8 for the whole motion at once: the bound without the help of any sample
        let machine = builtin(name).expect("built in");
        let path = path(machine, &ends, mode, 5.0);
        let ((from, _), (to, _), (at, _)) = (path.at(0.0), path.at(1.0), path.at(t));
        prop_assert!((from + (to - from) * t - at).norm() <= path.bend().0 / 8.0 + 1e-9);
    }
}

/// The followed point moves along Z through the axis of A while A turns: only 2 D V bends its path.
#[test]
fn a_point_that_runs_outward_bends_twice() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let (mut from, mut to) = ([0.0; MAX_AXES], [0.0; MAX_AXES]);
    (from[1], from[4], to[1], to[4]) = (-1.0 / 36.0, -1.0, 1.0 / 36.0, 1.0);
    let path = path(machine, &[from, to], Interpolation::Joints, 40.0);
    let ((from, _), (to, _), (middle, _)) = (path.at(0.0), path.at(1.0), path.at(0.5));
    let sag = ((from + to) * 0.5 - middle).norm();
    assert!(
        sag > 8.7 && sag <= path.bend().0 / 8.0,
        "{sag} mm, bound {}",
        path.bend().0 / 8.0
    );
}

/// A point above the tip is nearer to A: 40 mm of tool, 25 of them below the point, A 100 mm below the nose.
#[test]
fn a_point_above_the_tip_bends_by_its_own_distance() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let (mut from, mut to) = ([0.0; MAX_AXES], [0.0; MAX_AXES]);
    // Z at 100 mm, A from 0 to 18 deg
    (from[4], to[4], to[1]) = (1.0, 1.0, 0.1);
    let path = path(machine, &[from, to], Interpolation::Joints, 25.0);
    let turn = rad(18.0);
    let wanted = turn * turn * (100.0 - 40.0 + 25.0);
    assert!((path.bend().0 - wanted).abs() < 1e-9, "{} not {wanted}", path.bend().0);
}

/// Tips that swing to opposite sides of their chords: between two moments the sum of both bends counts.
#[test]
fn two_paths_bend_apart_by_the_sum_of_their_bends() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let swing = |share: f64| {
        let mut to = [0.0; MAX_AXES];
        let a = machine.axes.iter().position(|axis| axis.letter == b'A').expect("an A");
        to[a] = share;
        path(machine, &[[0.0; MAX_AXES], to], Interpolation::Joints, 0.0)
    };
    let (left, right) = (swing(0.3), swing(-0.2));
    let found = apart(&left, &right);
    let bend = left.bend().0 + right.bend().0;
    assert!(left.bend().0 > 1.0 && right.bend().0 > 1.0);
    let steps = (bend.max(left.bend().1 + right.bend().1) / 8e-6)
        .sqrt()
        .ceil()
        .min(512.0);
    let wanted = found.sampled_mm + bend / (8.0 * steps * steps);
    assert!((found.bound_mm - wanted).abs() < 1e-9, "{found:?}, not {wanted}");
}
