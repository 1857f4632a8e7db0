//! The tool axis inside a block: numbers of the guide vanes, what has no deviation, and the body above the tip.
use crate::common::{position, vector, words};
use crate::guide_vane::{STRATEGIES, follow, machine, vectors};
use trunnion_geometry::math::asin;
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::{Motion, Position};
use trunnion_machine::{
    Follower, Leg, Machine, Orientations, Solution, orientation_deviation, orientations, swept_deviation, tool_axis_at,
    windings,
};

fn found(machine: &Machine, leg: &Leg) -> (f64, f64) {
    let found = orientation_deviation(machine, leg, 0.0).expect("known");
    (deg(found.sampled), deg(found.bound))
}

/// Largest angle off the plane of the great circle, deg, by samples.
fn off_plane(leg: &Leg) -> f64 {
    let (start, end) = (leg.start.expect("known"), leg.end.clone().expect("known"));
    let normal = start.axis.cross(&end.axis).normalize();
    let rotary = |joints: &trunnion_machine::Joints| [0, 1].map(|i| joints[machine().rotary[i]]);
    let (from, to) = (rotary(&start.joints), rotary(&end.joints));
    let sine = (0..=1000)
        .map(|i| f64::from(i) / 1000.0)
        .map(|t| tool_axis_at(machine(), [0, 1].map(|i| from[i] + (to[i] - from[i]) * t)))
        .map(|axis| axis.dot(&normal).abs())
        .fold(0.0, f64::max);
    deg(asin(sine))
}

/// The printed rotary words as tool vectors, so that the joints run between the printed angles.
fn printed_words(rows: &[crate::guide_vane::PrintedRow; 5]) -> Vec<Motion> {
    let mut start = Position::default();
    rows.iter()
        .map(|&[x, y, z, _, _, _, a, c]| {
            let motion = vector(start, [x, y, z], tool_axis_at(machine(), [rad(c), rad(a)]));
            start = motion.end;
            motion
        })
        .collect()
}

/// Kinematics notes 1: 0.196, 0.203, 0.134, 0.024 and at most 0.0009 deg off the plane of the great circle, from the printed words. From the
/// printed vectors it is 0.1971 and 0.2028 in strategy 2, whose A0.081 is the arc cosine of a rounded k.
#[test]
fn guide_vanes_leave_the_great_circle_by_the_angles_of_the_notes() {
    let words: [&[f64]; 4] = [&[0.0009], &[0.2033, 0.1961], &[0.134], &[0.024]];
    let from_vectors: [&[f64]; 4] = [&[0.0009], &[0.2028, 0.1971], &[0.134], &[0.024]];
    for (strategy, rows) in STRATEGIES.iter().enumerate() {
        for (motions, expected) in [(printed_words(rows), words), (vectors(rows), from_vectors)] {
            let mut all: Vec<(f64, f64, f64)> = follow(&motions)[1..]
                .iter()
                .map(|leg| (off_plane(leg), found(machine(), leg)))
                .map(|(plane, (sampled, bound))| (plane, sampled, bound))
                .collect();
            all.sort_by(|a, b| b.0.total_cmp(&a.0));
            for (plane, sampled, bound) in &all {
                // the distance from the arc is never smaller than that from its plane
                assert!(bound >= sampled && bound - sampled <= 2e-5 && bound >= plane, "{all:?}");
                assert!(*sampled <= plane * 1.01 + 1e-5, "{all:?}");
            }
            for (wanted, (plane, sampled, _)) in expected[strategy].iter().zip(&all) {
                let near = |value: f64| (value - wanted).abs() <= if *wanted < 0.01 { 0.000_05 } else { 0.0005 };
                assert!(near(*plane) && near(*sampled), "strategy {}: {all:?}", strategy + 1);
            }
        }
    }
}

#[test]
fn what_runs_as_programmed_has_none() {
    let mut great_circle = machine().clone();
    great_circle.control.tcp_great_circle = true;
    let legs = follow(&vectors(&STRATEGIES[1]));
    assert!(found(machine(), &legs[2]).0 > 0.1);
    assert_eq!(found(&great_circle, &legs[2]), (0.0, 0.0));
    let at = |a: f64, c: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 50.0), (b'A', a), (b'C', c)]);
    for tcp in [false, true] {
        let motion = |start: Position, end: Position| Motion {
            tcp,
            ..words(start, end)
        };
        let legs = follow(&[
            motion(Position::default(), at(20.0, 0.0)),
            motion(at(20.0, 0.0), at(30.0, 70.0)),
        ]);
        assert_eq!(found(machine(), &legs[1]), (0.0, 0.0));
        let swept = swept_deviation(machine(), &legs[1], 100.0, 0.05);
        // without TCP the tip itself strays, and with it the tool
        assert_eq!(swept.map(|d| d.bound_mm), tcp.then_some(0.0));
    }
}

#[test]
fn a_block_far_below_the_tolerance_is_settled_at_once() {
    let legs = follow(&vectors(&STRATEGIES[0]));
    let found = orientation_deviation(machine(), &legs[1], rad(0.1)).expect("known");
    assert!(found.sampled == 0.0 && found.bound > 0.0 && found.bound <= rad(0.1));
}

/// Half a turn of C at a tilt of 60 deg, by vectors: the tool axis goes around the cone, the great circle over the pole is 60 deg away.
#[test]
fn half_way_round_a_cone_is_as_far_as_its_tilt() {
    let (tilt, half) = (rad(60.0), rad(89.5));
    let axis = |turn: f64| {
        let (s, c) = (trunnion_geometry::math::sin(turn), trunnion_geometry::math::cos(turn));
        let (st, ct) = (trunnion_geometry::math::sin(tilt), trunnion_geometry::math::cos(tilt));
        Vec3::new(st * s, -st * c, ct)
    };
    let first = vector(Position::default(), [0.0, 0.0, 0.0], axis(-half));
    let legs = follow(&[first, vector(first.end, [10.0, 0.0, 0.0], axis(half))]);
    let (sampled, bound) = found(machine(), &legs[1]);
    assert!(
        sampled > 58.0 && sampled < 60.0 && bound >= sampled && bound < sampled + 0.01,
        "{sampled} {bound}"
    );
}

/// The tool 50 mm above the tip strays by about 50 mm times the angle of the notes.
#[test]
fn the_body_strays_with_the_axis() {
    for (strategy, wanted) in [(1, 0.203), (2, 0.134), (3, 0.024)] {
        let legs = follow(&vectors(&STRATEGIES[strategy]));
        let worst = legs[1..]
            .iter()
            .map(|leg| swept_deviation(machine(), leg, 50.0, 0.0).expect("known"))
            .max_by(|a, b| a.sampled_mm.total_cmp(&b.sampled_mm))
            .expect("four");
        let by_angle = 50.0 * rad(wanted);
        assert!(
            worst.sampled_mm > 0.9 * by_angle
                && worst.sampled_mm < 1.1 * by_angle
                && worst.bound_mm < 1.2 * worst.sampled_mm,
            "strategy {}: {worst:?} for {by_angle}",
            strategy + 1
        );
    }
}

#[test]
fn opposite_tool_axes_have_no_great_circle() {
    let mut machine = machine().clone();
    for axis in &mut machine.axes {
        axis.limits = trunnion_machine::Limits::Unbounded;
    }
    let mut follower = Follower::new(&machine);
    let first = vector(Position::default(), [0.0, 0.0, 0.0], Vec3::new(0.0, 1.0, 0.0));
    follower.follow(&first);
    let leg = follower.follow(&vector(first.end, [10.0, 0.0, 0.0], Vec3::new(0.0, -1.0, 0.0)));
    assert_eq!(orientation_deviation(&machine, &leg, 0.001), None);
}

/// Table 2 of the guide-vane paper for a machine whose A runs from -30 to 120 deg: by k there is no posture beyond 120 deg, one between
/// 120 and 30 deg, two below, and at k = 1 any C does.
#[test]
fn how_many_postures_reach_a_direction_depends_on_k() {
    let a_joint = machine().joint(b'A').expect("an axis");
    let reached = |tilt: f64, turn: f64| match orientations(machine(), &tool_axis_at(machine(), [rad(turn), rad(tilt)]))
    {
        Orientations::Postures(postures) => {
            let legal = |posture: &&Solution| !windings(machine(), a_joint, posture.q[1], 0.0).is_empty();
            Some(postures.iter().filter(legal).count())
        }
        Orientations::Pole(_) => None,
        Orientations::Unreachable(_) => Some(0),
    };
    for turn in [0.0, 37.0, -90.0, 171.0] {
        for (tilt, count) in [
            (179.0, 0),
            (120.01, 0),
            (119.99, 1),
            (75.0, 1),
            (30.01, 1),
            (29.99, 2),
            (0.01, 2),
        ] {
            assert_eq!(reached(tilt, turn), Some(count), "A{tilt} C{turn}");
        }
        assert_eq!(reached(0.0, turn), None);
    }
}
