//! Blocks whose truth was worked out by hand or by another program: travel, speed, length and start of single blocks.
use crate::common::{motion, position, words};
use trunnion_geometry::arc::{Arc, Turning};
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Feed, Motion, MotionKind, Orientation, Position};
use trunnion_machine::{
    Excess, Follower, Leg, Machine, NoStance, block_duration_s, builtin, feed_limit, feed_limit_tight, limit_excess,
    row,
};

fn mikron() -> &'static Machine {
    builtin("mikron-ucp710").expect("built in")
}

fn at(x: f64, y: f64, z: f64, a: f64, c: f64) -> Position {
    position(&[(b'X', x), (b'Y', y), (b'Z', z), (b'A', a), (b'C', c)])
}

fn tcp(start: Position, end: Position) -> Motion {
    Motion {
        tcp: true,
        ..words(start, end)
    }
}

fn excess(leg: &Leg) -> Vec<Excess> {
    let mut found = Vec::new();
    limit_excess(mikron(), leg, &mut found);
    found
}

#[test]
fn an_arc_from_outside_the_travel_is_judged_in_between() {
    let mut follower = Follower::new(mikron());
    let (home, outside) = (at(0.0, 0.0, 0.0, 0.0, 0.0), at(355.5, 0.0, 0.0, 0.0, 0.0));
    let back = at(350.5, 0.0, 0.0, 0.0, 0.0);
    follower.follow(&words(Position::default(), home));
    let leg = follower.follow(&words(home, outside));
    assert_eq!(excess(&leg).len(), 1);
    // about (353, 100): the far side is at 353 + sqrt(100^2 + 2.5^2) = 453.03
    let (from, to) = (Vec3::new(355.5, 0.0, 0.0), Vec3::new(350.5, 0.0, 0.0));
    let arc = Arc::from_centre(
        from,
        to,
        Vec3::new(353.0, 100.0, 0.0),
        Vec3::z(),
        Turning::CounterClockwise,
        0,
    );
    let leg = follower.follow(&Motion {
        kind: MotionKind::Arc(arc),
        ..words(outside, back)
    });
    let found = excess(&leg);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0].value - 453.031).abs() < 2e-3, "{found:?}");
    assert!(!found[0].inside, "the start is not legal");
    // and if the start is legal it is reported as inside
    let mut follower = Follower::new(mikron());
    follower.follow(&words(Position::default(), home));
    follower.follow(&words(home, back));
    let arc = Arc::from_centre(
        to,
        to,
        Vec3::new(350.5, 100.0, 0.0),
        Vec3::z(),
        Turning::CounterClockwise,
        0,
    );
    let leg = follower.follow(&Motion {
        kind: MotionKind::Arc(arc),
        ..words(back, back)
    });
    let found = excess(&leg);
    assert!(
        found.len() == 1 && found[0].inside && (found[0].value - 450.5).abs() < 2e-3,
        "{found:?}"
    );
}

#[test]
fn both_limits_are_named() {
    let mut follower = Follower::new(mikron());
    let home = at(0.0, 0.0, 0.0, 0.0, 0.0);
    follower.follow(&words(Position::default(), home));
    let far = at(360.0, 0.0, 0.0, 0.0, 0.0);
    follower.follow(&words(home, far));
    // a full turn about X-200: to X-760, and back to 360
    let start = Vec3::new(360.0, 0.0, 0.0);
    let arc = Arc::from_centre(
        start,
        start,
        Vec3::new(-200.0, 0.0, 0.0),
        Vec3::z(),
        Turning::Clockwise,
        0,
    );
    let leg = follower.follow(&Motion {
        kind: MotionKind::Arc(arc),
        ..words(far, far)
    });
    let x: Vec<_> = excess(&leg)
        .into_iter()
        .filter(|e| mikron().axes[e.axis].letter == b'X')
        .collect();
    assert_eq!(x.len(), 2, "{x:?}");
    assert!(x[0].value == 360.0 && x[0].limit > 0.0, "{x:?}");
    assert!((x[1].value + 760.0).abs() < 2e-3 && x[1].limit < 0.0, "{x:?}");
}

/// Tip path under TCP with standing rotary axes.
fn standing(feed: f64, tilt: f64, turn: f64, to: [f64; 3]) -> Leg {
    let mut follower = Follower::new(mikron());
    let home = at(0.0, 0.0, 0.0, tilt, turn);
    follower.follow(&tcp(Position::default(), home));
    let mut leg = tcp(home, at(to[0], to[1], to[2], tilt, turn));
    leg.feed = Feed::PerMinute(feed);
    follower.follow(&leg)
}

#[test]
fn with_standing_rotary_axes_the_rates_are_exact() {
    let leg = standing(35_000.0, 0.0, 0.0, [100.0, 100.0, 0.0]);
    for limit in [feed_limit(mikron(), &leg), feed_limit_tight(mikron(), &leg)] {
        let limit = limit.expect("known");
        assert!((limit.feed_mm_min - 42_426.4).abs() < 0.1, "{limit:?}");
        assert!(
            (limit.axis_speed.expect("feed known") * 60.0 - 24_748.7).abs() < 0.1,
            "{limit:?}"
        );
    }
    let leg = standing(40_000.0, 30.0, 40.0, [-102.59, 43.65, 150.0]);
    let limit = feed_limit(mikron(), &leg).expect("known");
    assert_eq!(mikron().axes[limit.axis].letter, b'Y');
    // Y: ((102.59 sin 40 + 43.65 cos 40) cos 30 + 150 sin 30) / 186.89 of the feed
    assert!((limit.feed_mm_min - 34_810.8).abs() < 1.0, "{limit:?}");
    assert!(
        (limit.axis_speed.expect("feed known") * 60.0 - 34_472.0).abs() < 1.0,
        "{limit:?}"
    );
    let row = row(mikron(), &leg);
    assert_eq!(row.limiting_axis, Some('Y'));
    assert!((row.feed_limit_mm_min.expect("known") - limit.feed_mm_min).abs() < 1e-6);
}

#[test]
fn coordinates_that_only_the_machine_knows_count_with_their_joints() {
    let mut follower = Follower::new(mikron());
    let home = at(10.0, 10.0, 0.0, 0.0, 0.0);
    follower.follow(&tcp(Position::default(), home));
    // TCP is switched off: the program knows A and C, and X again at the end
    let mut off = words(
        position(&[(b'A', 0.0), (b'C', 0.0)]),
        position(&[(b'X', 0.0), (b'A', 0.0), (b'C', 0.0)]),
    );
    off.feed = Feed::PerMinute(1000.0);
    let leg = follower.follow(&off);
    assert!(leg.end.is_ok(), "{:?}", leg.end);
    assert!((leg.length - 10.0).abs() < 1e-9, "{}", leg.length);
    assert!((block_duration_s(mikron(), &leg).expect("known") - 0.6).abs() < 1e-9);
    assert!((feed_limit(mikron(), &leg).expect("known").feed_mm_min - 30_000.0).abs() < 1.0);
}

#[test]
fn the_way_from_a_told_start_is_a_block_like_any_other() {
    let from = Vec3::new(0.0, 0.034_899_5, 0.999_390_8).normalize();
    let to = Vec3::new(0.034_899_5, 0.0, 0.999_390_8).normalize();
    let (start, end) = (
        position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0)]),
        position(&[(b'X', 0.1), (b'Y', 0.0), (b'Z', 0.0)]),
    );
    let go = |start: Position, end: Position, before: Option<Vec3>, axis: Vec3| Motion {
        start,
        end,
        orientation: Orientation::Vector(before, axis),
        tool_length_mm: 100.0,
        feed: Feed::PerMinute(600.0),
        ..motion()
    };
    let told = Follower::new(mikron()).follow(&go(start, end, Some(from), to));
    let mut reached = Follower::new(mikron());
    reached.follow(&go(Position::default(), start, None, from));
    let reached = reached.follow(&go(start, end, Some(from), to));
    assert!(told.start_given && !reached.start_given);
    assert_eq!((&told.start, &told.end), (&reached.start, &reached.end));
    assert!(
        (deg(told.rotary_change[0]) - 90.0).abs() < 1e-3,
        "{:?}",
        told.rotary_change
    );
    assert!(feed_limit(mikron(), &told).expect("known").feed_mm_min < 10.0);
    // a start that is outside is reported with this block; no other block names it
    let far = position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 5000.0)]);
    let leg = Follower::new(mikron()).follow(&go(far, end, Some(Vec3::z()), Vec3::z()));
    assert_eq!(excess(&leg).len(), 1);
    // nothing is known if the program gave no vector
    assert!(
        Follower::new(mikron())
            .follow(&go(start, end, None, to))
            .start
            .is_none()
    );
}

#[test]
fn machine_coordinates_keep_the_tip_in_programmed_coordinates() {
    let mill = builtin("mill-3axis").expect("built in");
    let mut follower = Follower::new(mill);
    let xyz = |x, y, z| position(&[(b'X', x), (b'Y', y), (b'Z', z)]);
    let in_force = Motion {
        zero: [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        tool_length_mm: 100.0,
        ..motion()
    };
    follower.follow(&Motion {
        end: xyz(10.0, 10.0, 0.0),
        ..in_force
    });
    let leg = follower.follow(&Motion {
        start: xyz(11.0, 12.0, 103.0),
        end: xyz(11.0, 12.0, 0.0),
        machine_coordinates: true,
        ..in_force
    });
    assert_eq!(row(mill, &leg).tip_mm, Some([10.0, 10.0, -103.0]));
    assert_eq!(row(mill, &leg).joints, [Some(11.0), Some(12.0), Some(0.0)]);
}

#[test]
fn a_rotary_work_offset_proves_no_position_under_tcp() {
    let home = at(10.0, 0.0, 0.0, 0.0, 0.0);
    let mut offset = words(Position::default(), home);
    offset.zero[5] = 90.0;
    let mut follower = Follower::new(mikron());
    let leg = follower.follow(&offset);
    let stance = leg.end.as_ref().expect("joints are words plus offset");
    let c = mikron().joint(b'C').expect("has C");
    assert!((deg(stance.joints[c]) - 90.0).abs() < 1e-9);
    assert_eq!((row(mikron(), &leg).tip_mm, row(mikron(), &leg).axis), (None, None));
    let leg = follower.follow(&Motion { tcp: true, ..offset });
    assert_eq!(leg.end, Err(NoStance::RotaryOffset(b'C')));
}

#[test]
fn seven_digits_do_not_flip_the_machine() {
    let axis = |tilt: f64| trunnion_machine::tool_axis_at(mikron(), [0.0, trunnion_geometry::rad(tilt)]);
    let mut follower = Follower::new(mikron());
    let go = |tilt: f64| Motion {
        end: position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0)]),
        orientation: Orientation::Vector(None, axis(tilt)),
        ..motion()
    };
    for tilt in [0.0, -20.0, -29.0] {
        follower.follow(&go(tilt));
    }
    let leg = follower.follow(&go(-30.000_000_1));
    let stance = leg.end.as_ref().expect("reachable");
    let a = mikron().joint(b'A').expect("has A");
    assert!(
        (deg(stance.joints[a]) + 30.0).abs() < 1e-12,
        "{}",
        deg(stance.joints[a])
    );
    assert!(excess(&leg).is_empty());
    // but 2e-5 deg is outside
    let leg = follower.follow(&go(-30.000_02));
    assert!(
        leg.end.as_ref().is_ok_and(|stance| deg(stance.joints[a]) > 0.0),
        "{:?}",
        leg.end
    );
}
