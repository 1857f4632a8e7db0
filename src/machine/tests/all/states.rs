//! What the follower knows and forgets: unknown positions, foreign axes, TCP switching, tool length, great circle, posture swaps.
use crate::common::{motion, position, vector, words};
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Feed, Motion, MotionKind, Position};
use trunnion_machine::{Follower, Leg, Machine, NoStance, block_duration_s, builtin, feed_limit, row, tip_deviation};

fn machine(name: &str) -> &'static Machine {
    builtin(name).expect("built in")
}

fn mikron() -> &'static Machine {
    machine("mikron-ucp710")
}

fn place(x: f64, y: f64, z: f64, a: f64, c: f64) -> Position {
    position(&[(b'X', x), (b'Y', y), (b'Z', z), (b'A', a), (b'C', c)])
}

fn joint(leg: &Leg, letter: u8) -> f64 {
    leg.end.as_ref().expect("known").joints[mikron().joint(letter).expect("axis")]
}

#[test]
fn an_axis_that_was_never_positioned_is_unknown() {
    let mut follower = Follower::new(mikron());
    let to = position(&[(b'X', 1.0), (b'Y', 2.0), (b'Z', 3.0), (b'C', 90.0)]);
    let leg = follower.follow(&words(Position::default(), to));
    assert_eq!(leg.end, Err(NoStance::PositionUnknown("A".into())));
    let trace = row(mikron(), &leg);
    assert_eq!(trace.joints, [Some(90.0), None, Some(1.0), Some(2.0), Some(3.0)]);
    assert_eq!(
        (trace.tip_mm, trace.branch, trace.feed_limit_mm_min),
        (None, None, None)
    );
    let mut tcp = words(to, to);
    tcp.tcp = true;
    let leg = follower.follow(&tcp);
    assert_eq!(leg.end, Err(NoStance::PositionUnknown("A".into())));
    // under TCP X Y Z are no joints
    assert_eq!(row(mikron(), &leg).joints, [Some(90.0), None, None, None, None]);
}

#[test]
fn a_three_axis_machine_needs_no_rotary_words() {
    let mill = machine("mill-3axis");
    let mut follower = Follower::new(mill);
    let from = position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0)]);
    let to = position(&[(b'X', 3.0), (b'Y', 4.0), (b'Z', 0.0)]);
    assert!(follower.follow(&words(Position::default(), from)).end.is_ok());
    let leg = follower.follow(&words(from, to));
    assert_eq!(leg.length, 5.0);
    assert_eq!(tip_deviation(mill, &leg, 0.01).expect("known").bound_mm, 0.0);
    let trace = row(mill, &leg);
    assert_eq!(
        (trace.branch, trace.pole_angle_deg, trace.tip_mm),
        (None, None, Some([3.0, 4.0, 0.0]))
    );
    assert!((trace.duration_s.expect("known") - 5.0 / 2000.0 * 60.0).abs() < 1e-12);
    // the tool cannot lean
    let leg = follower.follow(&vector(to, [0.0; 3], Vec3::new(0.0, 0.1, 1.0)));
    assert!(matches!(leg.end, Err(NoStance::Unreachable(angle)) if (angle - 0.0997).abs() < 1e-4));
}

#[test]
fn a_foreign_axis_is_reported_where_it_is_programmed() {
    let mut follower = Follower::new(mikron());
    let start = place(0.0, 0.0, 100.0, 0.0, 0.0);
    let mut foreign = start;
    foreign.set(4, 10.0);
    assert!(follower.follow(&words(Position::default(), start)).end.is_ok());
    let leg = follower.follow(&words(start, foreign));
    assert_eq!(leg.end, Err(NoStance::NoSuchAxis(b'B')));
    let mut next = foreign;
    next.set(0, 5.0);
    let leg = follower.follow(&words(foreign, next));
    assert!(
        leg.start.is_none() && leg.end.is_ok(),
        "the word stands, but it is no news"
    );
}

#[test]
fn after_a_failure_the_position_is_unknown_until_it_is_given() {
    let mut follower = Follower::new(mikron());
    let up = vector(Position::default(), [0.0, 0.0, 50.0], Vec3::new(0.0, -0.1, 1.0));
    assert!(follower.follow(&up).end.is_ok());
    let down = vector(up.end, [0.0, 0.0, 50.0], Vec3::new(0.0, -0.1, -1.0));
    assert!(matches!(
        follower.follow(&down).end,
        Err(NoStance::OutsideLimits { axis: b'A', .. })
    ));
    let leg = follower.follow(&vector(up.end, [1.0, 0.0, 50.0], Vec3::new(0.0, -0.1, 1.0)));
    assert!(leg.start.is_none() && leg.end.is_ok());
    assert_eq!((leg.rotary_change, leg.rotary_excess), ([0.0; 2], 0.0));
    let unknown = Motion {
        kind: MotionKind::Unknown,
        ..words(up.end, Position::default())
    };
    assert_eq!(follower.follow(&unknown).end, Err(NoStance::NotModelled));
    let dwell = Motion {
        kind: MotionKind::Dwell(Some(1.0)),
        ..motion()
    };
    assert_eq!(
        follower.follow(&dwell).end,
        Err(NoStance::PositionUnknown("CAXYZ".into()))
    );
}

#[test]
fn tcp_keeps_the_tip_and_gives_the_joints() {
    let mut follower = Follower::new(mikron());
    let start = place(10.0, 20.0, 50.0, 0.0, 0.0);
    let tilted = place(10.0, 20.0, 50.0, 30.0, 40.0);
    let tcp = |from: Position, to: Position| Motion {
        tcp: true,
        tool_length_mm: 60.0,
        ..words(from, to)
    };
    follower.follow(&tcp(Position::default(), start));
    let leg = follower.follow(&tcp(start, tilted));
    let stance = leg.end.as_ref().expect("reached");
    assert_eq!((stance.tip, leg.length), (Vec3::new(10.0, 20.0, 50.0), 0.0));
    let pose = trunnion_machine::forward(mikron(), &stance.joints, 60.0);
    assert!((pose.tip - stance.tip).norm() < 1e-12);
    // TCP off, only Z programmed after the program forgot X and Y: they stay where the machine is
    let mut lost = tilted;
    lost.forget(0);
    lost.forget(1);
    let mut up = lost;
    up.set(2, 200.0);
    let off = Motion {
        tool_length_mm: 60.0,
        ..words(lost, up)
    };
    let leg = follower.follow(&off);
    assert_eq!(joint(&leg, b'X'), stance.joints[mikron().joint(b'X').expect("axis")]);
    assert_eq!(joint(&leg, b'Z'), 260.0);
    assert!((deg(joint(&leg, b'C')) - 40.0).abs() < 1e-12);
}

#[test]
fn rotary_axes_keep_the_posture_of_the_last_vector() {
    let mut follower = Follower::new(mikron());
    let tilt = vector(Position::default(), [0.0, 0.0, 50.0], Vec3::new(0.0, -0.5, 1.0));
    let before = follower.follow(&tilt);
    // TCP off: A and C were never words of the program, the machine still knows them
    let home = position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 300.0)]);
    let leg = follower.follow(&words(tilt.end, home));
    assert_eq!(joint(&leg, b'A'), joint(&before, b'A'));
    assert_eq!(joint(&leg, b'Z'), 300.0);
    // but what the program itself lost is lost
    let mut named = home;
    named.set(3, 10.0);
    let leg = follower.follow(&words(home, named));
    assert!((deg(joint(&leg, b'A')) - 10.0).abs() < 1e-12);
    let leg = follower.follow(&words(home, home));
    assert_eq!(leg.end, Err(NoStance::PositionUnknown("A".into())));
}

#[test]
fn offsets_and_tool_length_move_the_joints() {
    let mut follower = Follower::new(mikron());
    let to = place(1.0, 2.0, 3.0, 10.0, 20.0);
    let mut offset = words(Position::default(), to);
    offset.zero = [100.0, 0.0, -50.0, 5.0, 0.0, -7.0, 0.0, 0.0, 0.0];
    offset.tool_length_mm = 80.0;
    let leg = follower.follow(&offset);
    assert_eq!(
        [joint(&leg, b'X'), joint(&leg, b'Y'), joint(&leg, b'Z')],
        [101.0, 2.0, 33.0]
    );
    assert!((deg(joint(&leg, b'A')) - 15.0).abs() < 1e-12 && (deg(joint(&leg, b'C')) - 13.0).abs() < 1e-12);
    let stance = leg.end.as_ref().expect("known");
    let pose = trunnion_machine::forward(mikron(), &stance.joints, 80.0);
    assert!((pose.tip - Vec3::new(100.0, 0.0, -50.0) - stance.tip).norm() < 1e-12);
    let mut machine_words = offset;
    machine_words.machine_coordinates = true;
    let leg = follower.follow(&machine_words);
    assert_eq!([joint(&leg, b'X'), joint(&leg, b'Z')], [1.0, 3.0]);
    // at home the tip is what is programmed
    let home = Motion {
        tool_length_mm: 80.0,
        ..words(to, place(1.0, 2.0, 3.0, 0.0, 0.0))
    };
    assert!((follower.follow(&home).end.expect("known").tip - Vec3::new(1.0, 2.0, 3.0)).norm() < 1e-12);
}

#[test]
fn a_needless_change_of_posture_has_an_excess() {
    let mut follower = Follower::new(mikron());
    let tcp = |from: Position, to: Position| Motion {
        tcp: true,
        ..words(from, to)
    };
    let (start, swapped) = (place(0.0, 0.0, 50.0, 20.0, 10.0), place(5.0, 0.0, 50.0, -21.0, 190.0));
    follower.follow(&tcp(Position::default(), start));
    let leg = follower.follow(&tcp(start, swapped));
    // D = 180 + 41, cheapest in the old posture: A 21 C 10
    assert!(
        (deg(leg.rotary_excess) - (221.0 - 1.0)).abs() < 1e-9,
        "{}",
        deg(leg.rotary_excess)
    );
    assert_eq!(leg.pole_angle_min, 0.0);
    // straight through the pole: no excess
    let leg = follower.follow(&tcp(swapped, place(10.0, 0.0, 50.0, 5.0, 190.0)));
    assert_eq!(leg.rotary_excess, 0.0);
    // through the pole: the sign before it counts
    let on_pole = place(11.0, 0.0, 50.0, 0.0, 190.0);
    follower.follow(&tcp(place(10.0, 0.0, 50.0, 5.0, 190.0), on_pole));
    let leg = follower.follow(&tcp(on_pole, place(12.0, 0.0, 50.0, -5.0, 10.0)));
    assert!(
        (deg(leg.rotary_excess) - (185.0 - 5.0)).abs() < 1e-9,
        "{}",
        deg(leg.rotary_excess)
    );
}

#[test]
fn durations_follow_the_feed_and_the_slowest_axis() {
    let mut follower = Follower::new(mikron());
    let start = place(0.0, 0.0, 50.0, 0.0, 0.0);
    follower.follow(&words(Position::default(), start));
    let turn = Motion {
        feed: Feed::PerMinute(600.0),
        ..words(start, place(0.0, 0.0, 50.0, 0.0, 90.0))
    };
    let leg = follower.follow(&turn);
    // rotary only: F is degrees per minute
    assert!((block_duration_s(mikron(), &leg).expect("known") - 9.0).abs() < 1e-9);
    assert_eq!(feed_limit(mikron(), &leg), None);
    let fast = Motion {
        feed: Feed::PerMinute(60_000.0),
        ..words(turn.end, start)
    };
    // 90 degrees at 120 deg/s
    assert!((block_duration_s(mikron(), &follower.follow(&fast)).expect("known") - 0.75).abs() < 1e-9);
    let rapid = Motion {
        kind: MotionKind::Rapid,
        feed: Feed::Rapid,
        ..words(start, place(100.0, 0.0, 50.0, 0.0, 240.0))
    };
    assert!((block_duration_s(mikron(), &follower.follow(&rapid)).expect("known") - 2.0).abs() < 1e-9);
    let inverse_time = Motion {
        feed: Feed::InverseTime(2.0),
        ..words(rapid.end, place(110.0, 0.0, 50.0, 0.0, 240.0))
    };
    let leg = follower.follow(&inverse_time);
    assert!((block_duration_s(mikron(), &leg).expect("known") - 30.0).abs() < 1e-9);
    assert_eq!(row(mikron(), &leg).feed_mm_min, Some(20.0));
    let no_feed = Motion {
        feed: Feed::Unknown,
        ..words(inverse_time.end, start)
    };
    let leg = follower.follow(&no_feed);
    assert_eq!(block_duration_s(mikron(), &leg), None);
    assert_eq!(feed_limit(mikron(), &leg).expect("limited").axis_speed, None);
}

/// The positions of C, degrees, for a sequence of C words on a machine whose control reads them in the given way.
fn wrapped(wrap: &str, words_c: &[f64]) -> Vec<f64> {
    let source = trunnion_machine::builtin_source("mikron-ucp710").expect("built in");
    // without the rows that say a second time how words are read
    let source = source.split("[[check]]").next().expect("a machine");
    let text = source.replacen("wrap = \"literal\"", &format!("wrap = \"{wrap}\""), 1);
    assert!(wrap == "literal" || text != source);
    let machine = trunnion_machine::load("wrapped", &text).expect("valid");
    let mut follower = Follower::new(&machine);
    let mut start = Position::default();
    let mut found = Vec::new();
    for &c in words_c {
        let end = place(0.0, 0.0, 50.0, 10.0, c);
        found.push(joint(&follower.follow(&words(start, end)), b'C'));
        start = end;
    }
    found.into_iter().map(|c| (deg(c) * 1e6).round() / 1e6).collect()
}

#[test]
fn rotary_words_are_read_as_the_control_reads_them() {
    // docs/kinematics.md#rotary-words-and-full-turns: with M126 350 to 10 is +20 and 10 to 340 is -30; without, -340 and +330
    assert_eq!(wrapped("literal", &[350.0, 10.0, 340.0]), [350.0, 10.0, 340.0]);
    assert_eq!(wrapped("shortest", &[350.0, 10.0, 340.0]), [350.0, 370.0, 340.0]);
    // the sign is the direction: 10 upwards, 10 downwards, the same word again, 350 downwards
    assert_eq!(
        wrapped("modulo-sign", &[350.0, 10.0, -10.0, -10.0, -350.0]),
        [350.0, 370.0, 370.0, 370.0, 350.0]
    );
}

#[test]
fn no_motion_makes_it_panic_or_hang() {
    let mut random = crate::random::Random(9);
    let odd = [
        0.0,
        -0.0,
        f64::NAN,
        f64::INFINITY,
        1e300,
        -1e18,
        1e-300,
        90.0,
        180.0,
        86_391.963,
    ];
    for name in trunnion_machine::BUILTIN_MACHINES {
        let machine = machine(name);
        let mut follower = Follower::new(machine);
        let mut out = Vec::new();
        for _ in 0..400 {
            let mut value = || {
                if random.below(3) == 0 {
                    odd[random.below(odd.len())]
                } else {
                    random.range(-200.0, 200.0)
                }
            };
            let mut any = Motion { ..motion() };
            for axis in 0..9 {
                any.start.set(axis, value());
                any.end.set(axis, value());
            }
            any.tool_length_mm = value();
            let axis = Vec3::new(value(), value(), value());
            let arc = trunnion_geometry::arc::Arc {
                start: Vec3::new(value(), value(), value()),
                end: Vec3::new(value(), value(), value()),
                centre: Vec3::new(value(), value(), value()),
                normal: Vec3::new(value(), value(), value()),
                sweep: value(),
                radius_start: value(),
                radius_end: value(),
            };
            any.tcp = random.below(2) == 0;
            any.great_circle = [None, Some(true), Some(false)][random.below(3)];
            any.end.known = [0x1ff, 0x2f, 0x1f, 0x7][random.below(4)];
            if random.below(3) == 0 {
                any.orientation = trunnion_interp::Orientation::Vector(None, axis);
            }
            any.kind = match random.below(6) {
                0 => MotionKind::Rapid,
                1 => MotionKind::Arc(Some(arc)),
                2 => MotionKind::Arc(None),
                _ => MotionKind::Linear,
            };
            let leg = follower.follow(&any);
            let trace = row(machine, &leg);
            assert_eq!(trace.joints.len(), machine.own_axes().count());
            trunnion_machine::limit_excess(machine, &leg, &mut out);
            out.clear();
            if let Some(deviation) = tip_deviation(machine, &leg, 0.01) {
                assert!(deviation.bound_mm.is_nan() || deviation.bound_mm >= deviation.sampled_mm);
            }
        }
    }
}

/// Motions that turn far take work in proportion to the turn: a run has so many pieces of 2 deg beyond the first four of each. Then their paths
/// are unknown, short turns are followed as before, and the machine is where the words say.
#[test]
fn long_turns_are_followed_until_they_are_too_many() {
    let mut machine = mikron().clone();
    machine.most_turned = 50;
    let mut follower = Follower::new(&machine);
    let go = |follower: &mut Follower<'_>, from: Position, to: Position| {
        let motion = Motion {
            tcp: true,
            ..words(from, to)
        };
        follower.follow(&motion)
    };
    let at = |c: f64| place(10.0, 0.0, 0.0, -20.0, c);
    assert!(go(&mut follower, Position::default(), at(0.0)).end.is_ok());
    // 45 pieces count as 24: 20 each
    assert!(go(&mut follower, at(0.0), at(90.0)).end.is_ok());
    assert!(go(&mut follower, at(90.0), at(0.0)).end.is_ok());
    let memory = follower.memory();
    for mut follower in [follower, Follower::resume(&machine, &memory)] {
        let lost = go(&mut follower, at(0.0), at(90.0));
        assert_eq!(lost.end, Err(NoStance::TurnsSpent(50)));
        assert_eq!(
            lost.known_joints.0[machine.joint(b'C').expect("axis")],
            90.0_f64.to_radians()
        );
        let short = go(&mut follower, at(90.0), at(97.0));
        assert_eq!(joint(&short, b'C'), 97.0_f64.to_radians());
        assert!(short.start.is_some());
        // axes in their own words are not guided
        let free = words(at(97.0), at(0.0));
        assert!(follower.follow(&free).end.is_ok());
    }
}
