//! The saddle of the tool-path optimisation paper as the docs/kinematics.md#test-pieces define it: zigzag lines without tool centre point control.
use crate::common::{position, words};
use std::f64::consts::TAU;
use trunnion_geometry::math::{acos, atan2, rotate};
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::Position;
use trunnion_machine::{Follower, Leg, Machine, builtin, forward, tip_deviation};

/// Part origin above the point where C and A meet, mm.
const ABOVE: f64 = 50.0;

fn machine() -> &'static Machine {
    builtin("mikron-ucp710").expect("built in")
}

/// Point of z = -100 ((u-.3)^2+(v-.3)^2) ((u-.7)^2+(v-.7)^2), x = 100u-50, y = 100v-50, and its unit normal.
fn surface(u: f64, v: f64) -> (Vec3, Vec3) {
    let square = |c: f64| (u - c) * (u - c) + (v - c) * (v - c);
    let (a, b) = (square(0.3), square(0.7));
    let slope = |w: f64| 2.0 * (w - 0.3) * b + 2.0 * (w - 0.7) * a;
    let point = Vec3::new(100.0 * u - 50.0, 100.0 * v - 50.0, -100.0 * a * b);
    // dz/dx = -100 slope(u) / 100
    (point, Vec3::new(slope(u), slope(v), 1.0).normalize())
}

/// Legs of the zigzag with `along` points in each of `across` lines; angles straight from the arc functions, or unwound.
fn legs(along: u32, across: u32, unwound: bool) -> Vec<Leg> {
    let mut follower = Follower::new(machine());
    let mut start = Position::default();
    let mut last_c = None;
    let mut legs = Vec::new();
    for line in 0..across {
        for step in 0..along {
            let step = if line % 2 == 0 { step } else { along - 1 - step };
            let share = |i: u32, n: u32| f64::from(i) / f64::from(n - 1);
            let (point, axis) = surface(share(step, along), share(line, across));
            let tilt = acos(axis.z.clamp(-1.0, 1.0));
            let mut turn = atan2(axis.x, -axis.y);
            if let (true, Some(last)) = (unwound, last_c) {
                turn += TAU * f64::round((last - turn) / TAU);
            }
            last_c = Some(turn);
            let lifted = point + Vec3::z() * ABOVE;
            let joints = rotate(&Vec3::x(), -tilt, &rotate(&Vec3::z(), -turn, &lifted));
            let end = position(&[
                (b'X', joints.x),
                (b'Y', joints.y),
                (b'Z', joints.z),
                (b'A', deg(tilt)),
                (b'C', deg(turn)),
            ]);
            let leg = follower.follow(&words(start, end));
            assert!((leg.end.as_ref().expect("known").tip - lifted).norm() < 1e-9);
            legs.push(leg);
            start = end;
        }
    }
    legs
}

/// Largest distance from the chord at the eighths of the blocks: what the notes printed.
fn at_eighths(legs: &[Leg]) -> f64 {
    let mut worst = 0.0_f64;
    for leg in &legs[1..] {
        let (start, end) = (leg.start.expect("known"), leg.end.clone().expect("known"));
        let chord = end.tip - start.tip;
        for eighth in 1..8 {
            let t = f64::from(eighth) / 8.0;
            let mut joints = start.joints;
            for (value, to) in joints.iter_mut().zip(end.joints) {
                *value += (to - *value) * t;
            }
            let off = forward(machine(), &joints, 0.0).tip - start.tip;
            let share = (off.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            worst = worst.max((off - chord * share).norm());
        }
    }
    worst
}

/// Largest sample and largest bound.
fn worst(legs: &[Leg]) -> (f64, f64) {
    let found = legs[1..]
        .iter()
        .map(|leg| tip_deviation(machine(), leg, 0.01).expect("known"));
    found.fold((0.0, 0.0), |(sampled, bound): (f64, f64), d| {
        (sampled.max(d.sampled_mm), bound.max(d.bound_mm))
    })
}

/// The notes sampled the eighths: 104.155, 12.937, 104.269 and 5.666. The farthest moments lie between them.
#[test]
fn deviations_of_the_notes() {
    for (along, unwound, printed, farthest) in [
        (20, false, 104.155, 104.198),
        (20, true, 12.937, 12.938),
        (40, false, 104.269, 104.279),
        (40, true, 5.666, 5.667),
    ] {
        let legs = legs(along, 20, unwound);
        let eighths = at_eighths(&legs);
        assert!((eighths - printed).abs() <= 0.0005, "{along} {unwound}: {eighths}");
        let (sampled, bound) = worst(&legs);
        assert!(
            bound >= eighths && (bound - farthest).abs() <= 0.001 && (sampled - farthest).abs() <= 0.001,
            "{along} {unwound}: {sampled} {bound}"
        );
    }
}
