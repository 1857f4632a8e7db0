//! What the control's description changes: ways of rotary words, meaning of F, rapids, tilted planes, and programs as a whole.
use crate::common::{motion, position, words};
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::{
    Fault, Feed, ModalState, Motion, MotionKind, Orientation, Posture, Setup, Sink, Swivel, Tilt, run,
};
use trunnion_machine::{
    Follower, Leg, Machine, NoStance, OpenCause, block_duration_s, feed_limit_tight, limit_excess, load, tip_deviation,
};
use trunnion_syntax::{Program, parse};

/// C and A on the table as on the Mikron, with the given keys of C, of A, and of the control.
fn machine(c: &str, a: &str, control: &str) -> Machine {
    let text = format!(
        r#"schema = "ncmachine/1"
[[axis]]
letter = "C"
kind = "rotary"
side = "table"
sign = 1
limits = "unbounded"
{c}
[[axis]]
letter = "A"
kind = "rotary"
side = "table"
sign = 1
{a}
[[axis]]
letter = "X"
sign = 1
limits = [-400, 400]
[[axis]]
letter = "Y"
side = "head"
sign = 1
limits = [-400, 400]
[[axis]]
letter = "Z"
side = "head"
sign = 1
limits = [-400, 400]
[control]
{control}
"#
    );
    load("test", &text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn plain(c: &str, control: &str) -> Machine {
    machine(c, "limits = [-120, 120]", control)
}

/// C after two motions without TCP.
fn turned(machine: &Machine, from: f64, to: f64) -> (f64, Option<OpenCause>) {
    let at = |c: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', c)]);
    let mut follower = Follower::new(machine);
    follower.follow(&words(position(&[]), at(from)));
    let leg = follower.follow(&words(at(from), at(to)));
    let end = leg.end.expect("known");
    (deg(end.joints[0]) - from, leg.open.map(|open| open.cause))
}

/// TNC user's manual, M126: 350 to 10 is -340 without it and +20 with it, 10 to 340 is +330 and -30.
#[test]
fn rotary_words_take_the_way_that_the_axis_says() {
    let literal = plain("", "");
    let shortest = plain("wrap = \"shortest\"", "");
    for (from, to, long, short) in [(350.0, 10.0, -340.0, 20.0), (10.0, 340.0, 330.0, -30.0)] {
        assert!((turned(&literal, from, to).0 - long).abs() < 1e-9);
        assert!((turned(&shortest, from, to).0 - short).abs() < 1e-9);
        assert_eq!(turned(&shortest, from, to).1, None);
    }
    // half a turn is as near either way
    let (turn, open) = turned(&shortest, 0.0, 180.0);
    assert!((turn.abs() - 180.0).abs() < 1e-9);
    assert_eq!(open, Some(OpenCause::HalfTurn));
    assert_eq!(turned(&literal, 0.0, 180.0), (180.0, None));
}

#[test]
fn f_counts_along_what_the_control_says() {
    let start = position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', 0.0)]);
    let end = position(&[(b'X', 30.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', 40.0)]);
    for (control, length) in [("feed = \"xyz\"", 30.0), ("feed = \"combined\"", 50.0), ("", 30.0)] {
        let machine = plain("dyn = { vmax = 80 }", control);
        let mut follower = Follower::new(&machine);
        follower.follow(&words(start, start));
        let leg = follower.follow(&Motion {
            feed: Feed::PerMinute(600.0),
            ..words(start, end)
        });
        assert!((leg.length - length).abs() < 1e-9, "{control}: {}", leg.length);
        let seconds = block_duration_s(&machine, &leg).expect("known");
        assert!((seconds - length / 10.0).abs() < 1e-9, "{control}: {seconds}");
        // C may turn at 80 deg/s: half a second for the block
        let limit = feed_limit_tight(&machine, &leg).expect("limited");
        assert!(
            (limit.feed_mm_min - length * 120.0).abs() < 1e-6,
            "{control}: {limit:?}"
        );
        // a block's time is its time whatever F counts
        let timed = follower.follow(&Motion {
            feed: Feed::InverseTime(2.0),
            ..words(end, start)
        });
        assert!((block_duration_s(&machine, &timed).expect("known") - 30.0).abs() < 1e-9);
    }
}

/// Under TCP a linear axis runs out of its travel between two legal ends; where each axis runs at its own speed it cannot.
#[test]
fn rapids_of_single_axes_are_judged_at_their_ends() {
    let start = position(&[(b'X', 390.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', -40.0)]);
    let end = position(&[(b'X', 390.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', 40.0)]);
    for (control, inside) in [("rapid = \"synchronous\"", true), ("rapid = \"dogleg\"", false)] {
        let narrow = plain("", control);
        let mut narrow = narrow;
        narrow.axes[2].limits = trunnion_machine::Limits::Range(-350.0, 350.0);
        let rapid = |start, end| Motion {
            kind: MotionKind::Rapid,
            feed: Feed::Rapid,
            tcp: true,
            ..words(start, end)
        };
        let mut follower = Follower::new(&narrow);
        follower.follow(&rapid(position(&[]), start));
        let leg = follower.follow(&rapid(start, end));
        let mut found = Vec::new();
        assert!(limit_excess(&narrow, &leg, &mut found));
        assert_eq!(!found.is_empty(), inside, "{control}: {found:?}");
        assert_eq!(tip_deviation(&narrow, &leg, 0.01).is_some(), inside, "{control}");
    }
}

/// A motion in a tilted plane with the normal of the posture given in degrees.
fn normal_of(machine: &Machine, c: f64, a: f64) -> Vec3 {
    trunnion_machine::tool_axis_at(machine, [rad(c), rad(a)])
}

#[test]
fn a_turn_onto_a_plane_keeps_the_linear_axes_and_the_plane_leads_the_tip() {
    let machine = plain("", "family = \"sinumerik-840d\"");
    let start = position(&[(b'X', 10.0), (b'Y', 20.0), (b'Z', 30.0), (b'A', 0.0), (b'C', 0.0)]);
    let normal = normal_of(&machine, 90.0, -15.0);
    let mut follower = Follower::new(&machine);
    follower.follow(&words(position(&[]), start));
    let turn = Motion {
        kind: MotionKind::Rapid,
        orientation: Orientation::Vector(None, normal),
        tilt: Tilt {
            swivel: Swivel::AxesStay,
            posture: Posture::Lower,
            ..Tilt::default()
        },
        ..motion()
    };
    let stance = follower.follow(&turn).end.expect("turned");
    let joints = stance.joints;
    assert!(
        (deg(joints[0]) - 90.0).abs() < 1e-9 && (deg(joints[1]) + 15.0).abs() < 1e-9,
        "{joints:?}"
    );
    assert_eq!([joints[2], joints[3], joints[4]], [10.0, 20.0, 30.0]);
    // in the plane the words are the tip's
    let inside = Motion {
        tilt: Tilt {
            normal: Some(normal),
            ..Tilt::default()
        },
        ..words(position(&[]), position(&[(b'X', 1.0), (b'Y', 2.0), (b'Z', 3.0)]))
    };
    let stance = follower.follow(&inside).end.expect("on the plane");
    assert!((stance.tip - Vec3::new(1.0, 2.0, 3.0)).norm() < 1e-9);
    let pose = trunnion_machine::forward(&machine, &stance.joints, 0.0);
    assert!((pose.tip - stance.tip).norm() < 1e-9 && (pose.axis - normal).norm() < 1e-9);
    // another plane, without a turn onto it
    let off = Motion {
        tilt: Tilt {
            normal: Some(normal_of(&machine, 90.0, -20.0)),
            ..Tilt::default()
        },
        ..inside
    };
    let Err(NoStance::PlaneMisaligned(angle)) = follower.follow(&off).end else {
        panic!("followed off the plane")
    };
    assert!((deg(angle) - 5.0).abs() < 1e-9);
    // a retract leaves the linear axes where nobody knows
    let lost = Motion {
        tilt: Tilt {
            swivel: Swivel::AxesLost,
            ..turn.tilt
        },
        ..turn
    };
    let leg = follower.follow(&lost);
    assert_eq!(leg.end, Err(NoStance::PositionUnknown("XYZ".to_owned())));
    assert!((deg(leg.known_joints.0[1]) + 15.0).abs() < 1e-9 && leg.known_joints.1 == 0b11);
}

#[test]
fn a_control_that_holds_the_axis_near_the_pole_leaves_it_open() {
    for (action, cause) in [
        ("through", None),
        ("hold", Some(OpenCause::PoleHeld)),
        ("alarm", Some(OpenCause::PoleAlarm)),
    ] {
        let machine = plain("", &format!("pole = {{ cone = 2, action = \"{action}\" }}"));
        let start = position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0)]);
        let to = |c: f64, a: f64| crate::common::vector(start, [1.0, 0.0, 0.0], normal_of(&machine, c, a));
        let mut follower = Follower::new(&machine);
        follower.follow(&to(0.0, 5.0));
        assert_eq!(follower.follow(&to(10.0, 4.0)).open, None);
        let leg = follower.follow(&to(30.0, 1.0));
        assert_eq!(leg.open.map(|open| open.cause), cause, "{action}");
    }
}

/// Follows a program.
struct Followed<'m> {
    follower: Follower<'m>,
    legs: Vec<(u32, Leg)>,
}

impl Sink for Followed<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        self.legs.push((motion.block.0 + 1, leg));
    }
    fn fault(&mut self, _: Fault) {}
}

/// Legs with the line of each; `None`, said aloud, where the file is not there.
fn followed<'m>(machine: &'m Machine, dialect: &str, file: &str) -> Option<Followed<'m>> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(file);
    let Ok(source) = std::fs::read(&path) else {
        crate::guide_vane::skipped(file);
        return None;
    };
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let program: Program = parse(source, dialect.lex);
    let mut followed = Followed {
        follower: Follower::new(machine),
        legs: Vec::new(),
    };
    let mut setup = Setup::default();
    setup.control.tcp_codes.clone_from(&machine.control.tcp_codes);
    run(&program, dialect, &setup, &mut followed);
    Some(followed)
}

/// The same 3+2 part for a Fanuc (rotary words, then G53.1) and an 840D (CYCLE800 with direction -1): the same joints.
#[test]
fn a_part_for_two_controls_has_the_same_joints() {
    let fanuc = plain("", "family = \"fanuc-30i\"");
    let sinumerik = plain("", "family = \"sinumerik-840d\"");
    let (Some(a), Some(b)) = (
        followed(&fanuc, "fanuc-30i", "five-axis-pairs/smpl_sim08_5ax_fanuc_mm.nc"),
        followed(
            &sinumerik,
            "sinumerik-840d",
            "five-axis-pairs/smpl_sim08_5ax_sinumerik_mm.mpf",
        ),
    ) else {
        return;
    };
    // the profile of the first tool
    let joints = |followed: &Followed<'_>, tool: Option<u32>| -> Vec<[f64; 5]> {
        let feeds = followed
            .legs
            .iter()
            .filter(|(_, leg)| leg.motion.is_feed() && leg.motion.tilt.normal.is_some());
        let first = feeds.clone().next().map(|(_, leg)| leg.motion.tool);
        let own =
            feeds.filter(|(_, leg)| leg.motion.tool == tool || (tool.is_none() && Some(leg.motion.tool) == first));
        own.filter_map(|(_, leg)| {
            leg.end
                .as_ref()
                .ok()
                .map(|end| std::array::from_fn(|axis| end.joints[axis]))
        })
        .collect()
    };
    let (a, b) = (joints(&a, Some(4)), joints(&b, None));
    assert!(a.len() > 20 && b.len() >= a.len(), "{} {}", a.len(), b.len());
    for (index, (a, b)) in a.iter().zip(&b).enumerate() {
        for axis in 0..5 {
            assert!((a[axis] - b[axis]).abs() < 2e-3, "{index}: {a:?} {b:?}");
        }
    }
    assert!(
        (deg(a[0][0]) - 90.0).abs() < 1e-6 && (deg(a[0][1]) + 15.0).abs() < 1e-6,
        "{:?}",
        a[0]
    );
}

/// Kinematics notes 10: 4 306 feed moves in inverse time, 1 078.7 s; C over-speeds in 6 blocks, worst 17.91 times at line 494; three jumps
/// of C over 90 deg, all rapids; ranges of A and C.
#[test]
fn the_impeller_has_its_numbers() {
    let machine = trunnion_machine::builtin("linuxcnc-xyzac-trt").expect("built in");
    let Some(run) = followed(machine, "linuxcnc", "linuxcnc-5axis/impeller-7bl-xyzac.ngc") else {
        return;
    };
    let feeds: Vec<_> = run.legs.iter().filter(|(_, leg)| leg.motion.is_feed()).collect();
    assert_eq!(feeds.len(), 4306);
    let seconds: f64 = feeds
        .iter()
        .map(|(_, leg)| match leg.motion.feed {
            Feed::InverseTime(per_minute) => 60.0 / per_minute,
            _ => panic!("not in inverse time"),
        })
        .sum();
    assert!((seconds - 1078.7).abs() < 0.05, "{seconds}");
    let mut over = Vec::new();
    for (line, leg) in &feeds {
        let (Some(start), Ok(end), Feed::InverseTime(per_minute)) = (&leg.start, &leg.end, leg.motion.feed) else {
            panic!("not followed: line {line}")
        };
        let speed = deg((end.joints[0] - start.joints[0]).abs()) * per_minute / 60.0;
        if speed > 30.0 {
            over.push((speed / 30.0, *line));
        }
    }
    let worst = over
        .iter()
        .copied()
        .fold((0.0, 0), |a: (f64, u32), b| if b.0 > a.0 + 1e-9 { b } else { a });
    assert_eq!((over.len(), worst.1), (6, 494), "{over:?}");
    assert!((worst.0 - 17.91).abs() < 0.01, "{}", worst.0);
    let jumps: Vec<u32> = run
        .legs
        .iter()
        .filter(|(_, leg)| deg(leg.rotary_change[0]) > 90.0)
        .map(|(line, leg)| {
            assert_eq!(leg.motion.kind, MotionKind::Rapid);
            *line
        })
        .collect();
    assert_eq!(jumps, [3401, 4146, 4504]);
    let range = |axis: usize| {
        let values = run
            .legs
            .iter()
            .filter_map(|(_, leg)| leg.end.as_ref().ok().map(|end| deg(end.joints[axis])));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    };
    let close = |found: (f64, f64), wanted: (f64, f64)| {
        (found.0 - wanted.0).abs() < 0.006 && (found.1 - wanted.1).abs() < 0.006
    };
    assert!(close(range(1), (-74.49, 0.0)), "{:?}", range(1));
    assert!(close(range(0), (-399.805, 0.0)), "{:?}", range(0));
}

/// A stands at -30 deg and goes to 30 deg while the tip is to end where it began, 100 mm above the axes. Led, it never leaves the point;
/// point to point the axes run straight, and half way, with A at zero, the tip is at 100 cos 30 deg = 86.60 mm: 13.40 mm off.
#[test]
fn point_to_point_the_axes_run_straight_to_where_the_tip_ends() {
    let machine = plain("", "family = \"sinumerik-840d\"");
    let at = |a: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 100.0), (b'A', a), (b'C', 0.0)]);
    let go = |start, end, swivel| Motion {
        tcp: true,
        tilt: Tilt {
            swivel,
            ..Tilt::default()
        },
        ..words(start, end)
    };
    let mut ends = Vec::new();
    for (swivel, off) in [
        (Swivel::No, 0.0),
        (Swivel::PointToPoint, 100.0 * (1.0 - 0.75_f64.sqrt())),
    ] {
        let mut follower = Follower::new(&machine);
        follower.follow(&go(position(&[]), at(-30.0), Swivel::No));
        let leg = follower.follow(&go(at(-30.0), at(30.0), swivel));
        let found = tip_deviation(&machine, &leg, 1e-3).expect("known");
        assert!(
            (found.sampled_mm - off).abs() < 1e-4 && found.bound_mm >= off,
            "{found:?}"
        );
        assert!(found.bound_mm <= off * 1.2 + 1e-3, "{found:?}");
        ends.push(leg.end.as_ref().expect("known").joints);
        let travel = trunnion_machine::linear_travel(&machine, &leg, 0.0).expect("known");
        // an arc of 60 deg, or its chord
        let way = if swivel == Swivel::No { 100.0 * rad(60.0) } else { 100.0 };
        assert!((travel.least_mm - way).abs() < 0.1, "{travel:?}");
    }
    assert_eq!(ends[0], ends[1]);
}

/// 840D Job Planning, section 6.9: from C 0, C=270 goes to 270 deg with TU's bit 0 and to -90 deg with 1.
#[test]
fn turn_bits_turn_rotary_words() {
    let c = "limits = [-360, 360]";
    for (bits, turn, wanted, cause) in [
        ("posture_words = { turn = { A = 3, C = 4 } }", 0, 270.0, None),
        ("posture_words = { turn = { A = 3, C = 4 } }", 16, -90.0, None),
        ("", 16, 270.0, Some(OpenCause::WordsNotDeclared)),
    ] {
        let text = format!(
            "schema = \"ncmachine/1\"\n[[axis]]\nletter = \"C\"\nkind = \"rotary\"\nside = \"table\"\nsign = 1\n{c}\n[[axis]]\nletter = \"A\"\nkind = \"rotary\"\nside = \"table\"\nsign = 1\nlimits = [-120, 120]\n[[axis]]\nletter = \"X\"\nsign = 1\nlimits = [-400, 400]\n[[axis]]\nletter = \"Y\"\nside = \"head\"\nsign = 1\nlimits = [-400, 400]\n[[axis]]\nletter = \"Z\"\nside = \"head\"\nsign = 1\nlimits = [-400, 400]\n[control]\n{bits}\n"
        );
        let machine = load("test", &text).expect("valid");
        let at = |c: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 50.0), (b'A', 20.0), (b'C', c)]);
        let go = |start, end, posture| Motion {
            tcp: true,
            tilt: Tilt {
                swivel: Swivel::PointToPoint,
                posture,
                ..Tilt::default()
            },
            ..words(start, end)
        };
        let mut follower = Follower::new(&machine);
        follower.follow(&go(position(&[]), at(0.0), Posture::ByRule));
        let posture = Posture::Bits {
            status: None,
            turn: Some(turn),
        };
        let leg = follower.follow(&go(at(0.0), at(270.0), posture));
        assert_eq!(leg.open.map(|open| open.cause), cause);
        assert!(
            (deg(leg.end.expect("known").joints[0]) - wanted).abs() < 1e-9,
            "{bits} {turn}"
        );
    }
}

/// Kinematics notes 10: 1 735 feed moves along lines; at the programmed times Y is over its 20 mm/s in 5 blocks, Z in 13, A over its 30 deg/s in 11;
/// the worst is 1.559 times as fast, at line 1397.
#[test]
fn the_boat_has_its_numbers() {
    let machine = trunnion_machine::builtin("linuxcnc-xyzac-trt").expect("built in");
    let Some(run) = followed(machine, "linuxcnc", "linuxcnc-5axis/boat-xyzac.ngc") else {
        return;
    };
    let feeds: Vec<_> = run.legs.iter().filter(|(_, leg)| leg.motion.is_feed()).collect();
    let lines = feeds
        .iter()
        .filter(|(_, leg)| leg.motion.kind == MotionKind::Linear)
        .count();
    // the notes count lines; there are four arcs beside them
    assert_eq!((lines, feeds.len()), (1735, 1739));
    let letters = [b'X', b'Y', b'Z', b'A', b'C'];
    let mut over = [0; 5];
    let mut worst = (0.0, 0);
    for (line, leg) in &feeds {
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            panic!("not followed: line {line}")
        };
        let seconds = match leg.motion.feed {
            Feed::InverseTime(per_minute) => 60.0 / per_minute,
            Feed::PerMinute(feed) => 60.0 * leg.length / feed,
            _ => panic!("no feed: line {line}"),
        };
        for (slot, letter) in over.iter_mut().zip(letters) {
            let joint = machine.joint(letter).expect("an axis");
            let (limit, change) = (
                machine.axes[joint].max_speed.expect("declared"),
                end.joints[joint] - start.joints[joint],
            );
            let times = change.abs() / (seconds * limit);
            if times > 1.0 + 1e-9 {
                *slot += 1;
            }
            if times.is_finite() && times > worst.0 + 1e-9 {
                worst = (times, *line);
            }
        }
    }
    assert_eq!((over, worst.1), ([0, 5, 13, 11, 0], 1397), "{worst:?}");
    assert!((worst.0 - 1.559).abs() < 0.001, "{worst:?}");
}
