//! Forward and inverse kinematics against the rows of the kinematics notes and the papers' formulas.
use crate::kinematics::inverse::REACH_TOLERANCE;
use crate::kinematics::selftest::SplitMix;
use crate::{
    BUILTIN_MACHINES, MAX_AXES, Machine, Orientations, builtin, forward, inverse, load, orientations, self_test,
    windings,
};
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI, TAU};
use trunnion_geometry::math::rotate;
use trunnion_geometry::{Vec3, deg, rad};

/// A table-table machine of two given rotary axes below X Y Z.
fn pair(first: &str, second: &str) -> Machine {
    let text = format!(
        "schema = \"ncmachine/1\"\naxis = [{first}, {second}, {{letter=\"X\", sign=1}}, {{letter=\"Y\", sign=1}}, {{letter=\"Z\", sign=1}}]"
    );
    load("pair", &text).expect("a machine")
}

fn postures(machine: &Machine, axis: [f64; 3]) -> Vec<[f64; 2]> {
    match orientations(machine, &Vec3::from(axis).normalize()) {
        Orientations::Postures(found) => found.iter().map(|posture| posture.q.map(deg)).collect(),
        other => panic!("{other:?}"),
    }
}

/// Whether some posture agrees with the row to 1e-4 deg, modulo 360.
fn assert_row(machine: &Machine, axis: [f64; 3], rows: &[[f64; 2]]) {
    let found = postures(machine, axis);
    assert_eq!(found.len(), rows.len(), "{found:?}");
    for row in rows {
        let near = |q: &[f64; 2]| {
            q.iter().zip(row).all(|(a, b)| {
                let off = (a - b).rem_euclid(360.0);
                off.min(360.0 - off) <= 1e-4
            })
        };
        assert!(found.iter().any(near), "{row:?} not among {found:?}");
    }
}

const C: &str = "{letter=\"C\", sign=1, side=\"table\"}";

#[test]
fn rows_of_the_notes() {
    let ac = pair(C, "{letter=\"A\", sign=1, side=\"table\"}");
    assert_row(
        &ac,
        [2.087e-3, -35.573e-3, 0.999_365],
        &[[3.3576, 2.0421], [-176.6424, -2.0421]],
    );
    let u = [0.3, 0.4, 0.866_025];
    assert_row(&ac, u, &[[143.1301, 30.0], [-36.8699, -30.0]]);
    let bc = pair(C, "{letter=\"B\", sign=1, side=\"table\"}");
    assert_row(&bc, u, &[[53.1301, 30.0], [-126.8699, -30.0]]);
    let ab = pair(
        "{letter=\"A\", sign=1, side=\"table\"}",
        "{letter=\"B\", sign=1, side=\"table\"}",
    );
    assert_row(&ab, u, &[[-24.7913, 17.4576], [155.2087, 162.5424]]);
    let nutating = pair(
        C,
        "{letter=\"B\", sign=1, side=\"table\", dir=[0, 0.70710678, 0.70710678]}",
    );
    // printed as (.5, .5, .70711): the exact vector is meant, the rounded one gives 65.5300
    assert_row(
        &nutating,
        [0.5, 0.5, FRAC_1_SQRT_2],
        &[[20.5302, 65.5302], [-110.5302, -65.5302]],
    );
    assert_row(&nutating, [1.0, 0.0, 0.0], &[[-90.0, 180.0]]);
    match orientations(&nutating, &Vec3::new(0.986_394, 0.0, -0.164_399)) {
        Orientations::Unreachable(off) => assert!((deg(off) - 9.4623).abs() < 1e-3, "{}", deg(off)),
        other => panic!("{other:?}"),
    }
}

#[test]
fn paper_machines_have_their_papers_formulas() {
    let mikron = builtin("mikron-ucp710").expect("embedded");
    let maho = builtin("maho-600e").expect("embedded");
    let ferrari = builtin("ferrari-bc").expect("embedded");
    let mut random = SplitMix(7);
    for _ in 0..100 {
        let q = [random.between(-3.0, 3.0), random.between(-3.0, 3.0)];
        let (s, c) = (q.map(f64_sin), q.map(f64_cos));
        let off = |machine: &Machine, u: [f64; 3]| (crate::tool_axis_at(machine, q) - Vec3::from(u)).norm();
        // u = (sA sC, -sA cC, cA)
        assert!(off(mikron, [s[1] * s[0], -s[1] * c[0], c[1]]) < 1e-15);
        // A = atan2(j, i), B = -asin(k)
        assert!(off(maho, [c[1] * c[0], c[1] * s[0], -s[1]]) < 1e-15);
        assert!(off(ferrari, [c[0] * s[1], s[0] * s[1], c[1]]) < 1e-15);
    }
    // the second posture of the Maho is (A + 180, -180 - B)
    let q = postures(maho, [0.5, 0.5, FRAC_1_SQRT_2]);
    assert!(
        q.iter()
            .any(|q| (q[0] - 45.0).abs() < 1e-9 && (q[1] + 45.0).abs() < 1e-9),
        "{q:?}"
    );
    assert!(
        q.iter()
            .any(|q| (q[0] + 135.0).abs() < 1e-9 && (q[1] + 135.0).abs() < 1e-9),
        "{q:?}"
    );
}

fn f64_sin(x: f64) -> f64 {
    trunnion_geometry::math::sin(x)
}
fn f64_cos(x: f64) -> f64 {
    trunnion_geometry::math::cos(x)
}

/// The row whose printed A comes from an arc cosine of a rounded k: the solver keeps the digits near the pole.
#[test]
fn near_the_pole_no_digit_is_lost() {
    let mikron = builtin("mikron-ucp710").expect("embedded");
    let row = postures(mikron, [0.001_071, -0.000_819, 0.999_999]);
    assert!(
        row.iter()
            .any(|q| (q[1] - 0.0772).abs() < 1e-4 && (q[0] - 52.595).abs() < 6e-4),
        "{row:?}"
    );
    for size in [1e-3, 1e-5, 1e-7, 2e-9] {
        let u = Vec3::new(size * 0.6, size * 0.8, (1.0 - size * size).sqrt());
        let Orientations::Postures(found) = orientations(mikron, &u) else {
            panic!("{size}")
        };
        for posture in &found {
            let off = crate::tool_axis_at(mikron, posture.q) - u;
            assert!(off.xy().norm() < 1e-15 * size && off.z.abs() < 3e-16, "{size}: {off}");
        }
    }
    assert_eq!(orientations(mikron, &Vec3::z()), Orientations::Pole(0.0));
    assert!(matches!(orientations(mikron, &-Vec3::z()), Orientations::Pole(q2) if (q2.abs() - PI).abs() < 1e-15));
}

#[test]
fn fewer_rotary_axes() {
    let mill = builtin("mill-3axis").expect("embedded");
    assert!(matches!(orientations(mill, &Vec3::z()), Orientations::Postures(p) if p.len() == 1 && p[0].branch == 0));
    let tilted = rotate(&Vec3::x(), 0.01, &Vec3::z());
    assert!(matches!(orientations(mill, &tilted), Orientations::Unreachable(off) if (off - 0.01).abs() < 1e-12));
    let four = load(
        "four",
        "schema = \"ncmachine/1\"\naxis = [{letter=\"A\", sign=1, side=\"table\"}, {letter=\"X\", sign=1}, {letter=\"Y\", sign=1}, {letter=\"Z\", sign=1}]",
    )
    .expect("a machine");
    let u = rotate(&Vec3::x(), 0.7, &Vec3::z());
    assert!(
        matches!(orientations(&four, &u), Orientations::Postures(p) if p.len() == 1 && (p[0].q[0] - 0.7).abs() < 1e-15)
    );
    let off = rotate(&Vec3::y(), 0.2, &Vec3::z());
    assert!(matches!(orientations(&four, &off), Orientations::Unreachable(a) if (a - 0.2).abs() < 1e-12));
    let result = self_test(&four, 500, 1);
    assert!(
        result.posture_missing == 0 && result.worst_tip_mm < 1e-11 && result.worst_axis < 1e-14,
        "{result:?}"
    );
}

#[test]
fn windings_stay_inside_the_limits() {
    let mikron = builtin("mikron-ucp710").expect("embedded");
    let (c, a) = (mikron.joint(b'C').expect("C"), mikron.joint(b'a').expect("A"));
    assert_eq!(&*windings(mikron, a, rad(100.0), 0.0), &[rad(100.0)]);
    assert!(windings(mikron, a, rad(-31.0), 0.0).is_empty());
    assert!(windings(mikron, a, rad(-30.0) - 1e-12, 0.0).len() == 1);
    let near = windings(mikron, c, 0.1, 100.0 * TAU + 0.2);
    assert!((near[0] - (100.0 * TAU + 0.1)).abs() < 1e-9 && near.len() == 3);
    assert!(windings(mikron, c, f64::NAN, 0.0).is_empty() && windings(mikron, 77, 0.0, 0.0).is_empty());
}

#[test]
fn embedded_machines_come_back_to_the_pose() {
    for name in BUILTIN_MACHINES {
        let machine = builtin(name).expect("every embedded machine loads");
        let result = self_test(machine, 2000, 42);
        assert_eq!(result.posture_missing, 0, "{name}");
        assert!(
            result.worst_tip_mm < 1e-9 && result.worst_axis < 1e-12,
            "{name}: {result:?}"
        );
        assert_eq!(result, self_test(machine, 2000, 42));
    }
}

#[test]
fn at_home_the_tip_is_the_gauge_point_less_the_tool() {
    for name in BUILTIN_MACHINES {
        let machine = builtin(name).expect("embedded");
        let pose = forward(machine, &[0.0; MAX_AXES], 80.0);
        assert_eq!(pose.tip, machine.gauge_point - machine.tool_axis * 80.0);
        assert_eq!(pose.axis, machine.tool_axis);
    }
}

#[test]
fn odd_numbers_do_not_panic() {
    for name in BUILTIN_MACHINES {
        let machine = builtin(name).expect("embedded");
        for odd in [f64::NAN, f64::INFINITY, -1e300, 0.0, 1e-300] {
            let axis = Vec3::new(odd, 0.3, 0.0);
            let _ = orientations(machine, &axis);
            let mut joints = [odd; MAX_AXES];
            let _ = inverse(machine, &mut joints, &axis, odd);
            let _ = forward(machine, &joints, odd);
        }
    }
}

#[test]
fn just_outside_the_reach_counts_as_its_edge() {
    let nutating = pair(
        C,
        "{letter=\"B\", sign=1, side=\"table\", dir=[0, 0.70710678, 0.70710678]}",
    );
    let beyond = |by: f64| rotate(&Vec3::y(), FRAC_PI_2 + by, &Vec3::z());
    assert!(
        matches!(orientations(&nutating, &beyond(REACH_TOLERANCE * 0.9)), Orientations::Postures(p) if p.len() == 1)
    );
    assert!(matches!(
        orientations(&nutating, &beyond(REACH_TOLERANCE * 1.1)),
        Orientations::Unreachable(_)
    ));
}
