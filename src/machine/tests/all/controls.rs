//! What the control's description changes: direction of rotary words, meaning of F, rapids, tilted planes.
use crate::common::{motion, position, words};
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::{cos, sin};
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::{Feed, Motion, MotionKind, Orientation, Posture, Swivel, Tilt};
use trunnion_machine::{
    Follower, Machine, NoStance, OpenCause, block_duration_s, feed_limit_tight, limit_excess, load, tip_deviation,
};

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

pub(crate) fn plain(c: &str, control: &str) -> Machine {
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

/// An incremental word turns by its full amount, also where the words are full turns away from the axis position: the shorter way is for absolute ones.
#[test]
fn incremental_words_turn_as_far_as_they_say() {
    for wrap in ["shortest", "modulo-sign"] {
        let machine = plain(&format!("wrap = \"{wrap}\""), "");
        let at = |c: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', c)]);
        let mut follower = Follower::new(&machine);
        let mut turn = |from: Option<f64>, to: f64, incremental: bool| {
            let mut motion = words(from.map_or(position(&[]), at), at(to));
            motion.says_way = if incremental { 0b10_1000 } else { 0 };
            deg(follower.follow(&motion).end.expect("known").joints[0])
        };
        assert!((turn(None, 350.0, false) - 350.0).abs() < 1e-9);
        // 20 deg on, not 340 deg back
        assert!((turn(Some(350.0), 10.0, false) - 370.0).abs() < 1e-9, "{wrap}");
        assert!((turn(Some(10.0), -180.0, true) - 180.0).abs() < 1e-9, "{wrap}");
        assert!((turn(Some(-180.0), 40.0, true) - 400.0).abs() < 1e-9, "{wrap}");
    }
}

/// The first word of a wrapped axis, while its position is unknown: its sign is a direction, its amount the position.
#[test]
fn the_first_word_of_a_wrapped_axis_is_a_place() {
    let at = |c: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', c)]);
    for (wrap, word, place) in [
        ("modulo-sign", -12.0, 12.0),
        ("modulo-sign", 12.0, 12.0),
        ("shortest", -12.0, -12.0),
    ] {
        let machine = plain(&format!("wrap = \"{wrap}\""), "");
        let leg = Follower::new(&machine).follow(&words(position(&[]), at(word)));
        assert!(
            (deg(leg.end.expect("known").joints[0]) - place).abs() < 1e-9,
            "{wrap} {word}"
        );
    }
}

/// Sums of increments and inches leave 1e-14 mm: no motion, no length, no speed along it.
#[test]
fn a_way_of_rounding_is_none() {
    let machine = machine("dyn = { vmax = 10 }", "limits = [-120, 120]", "feed = \"xyz\"");
    let at = |z: f64, c: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', z), (b'A', 20.0), (b'C', c)]);
    let (z, again) = (-86.0527 - 0.4317, -86.4844);
    assert!(z != again);
    for tcp in [false, true] {
        let mut follower = Follower::new(&machine);
        let feed = |start, end| Motion {
            feed: Feed::PerMinute(8000.0),
            tcp,
            ..words(start, end)
        };
        follower.follow(&feed(position(&[]), at(z, 5.0)));
        let leg = follower.follow(&feed(at(z, 5.0), at(again, 5.0)));
        assert_eq!((leg.length, feed_limit_tight(&machine, &leg)), (0.0, None));
        let leg = follower.follow(&feed(at(again, 5.0), at(z, 40.0)));
        assert_eq!(
            (leg.length, feed_limit_tight(&machine, &leg)),
            (0.0, None),
            "C alone: tcp {tcp}"
        );
    }
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
    // half a turn is equally near in both directions
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

/// Along an arc of 30 mm the same.
#[test]
fn f_counts_along_arcs_too() {
    let start = position(&[(b'X', 20.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', 0.0)]);
    let end = Vec3::new(20.0 * cos(1.5), 20.0 * sin(1.5), 0.0);
    let arc = Arc {
        start: Vec3::new(20.0, 0.0, 0.0),
        end,
        centre: Vec3::zeros(),
        normal: Vec3::z(),
        sweep: 1.5,
        radius_start: 20.0,
        radius_end: 20.0,
    };
    let stop = position(&[(b'X', end.x), (b'Y', end.y), (b'Z', 0.0), (b'A', 0.0), (b'C', 40.0)]);
    for (control, length) in [("feed = \"xyz\"", 30.0), ("feed = \"combined\"", 50.0)] {
        let machine = plain("dyn = { vmax = 80 }", control);
        let mut follower = Follower::new(&machine);
        follower.follow(&words(start, start));
        let leg = follower.follow(&Motion {
            kind: MotionKind::Arc(Some(arc)),
            feed: Feed::PerMinute(600.0),
            ..words(start, stop)
        });
        assert!((leg.length - length).abs() < 1e-9, "{control}: {}", leg.length);
        let limit = feed_limit_tight(&machine, &leg).expect("limited");
        assert!(
            (limit.feed_mm_min - length * 120.0).abs() < 1e-6,
            "{control}: {limit:?}"
        );
        let speed = limit.axis_speed.expect("a feed");
        assert!((speed - rad(40.0) * 10.0 / length).abs() < 1e-9, "{control}: {limit:?}");
    }
}

/// Under TCP a linear axis runs out of its travel between two legal ends. That each axis runs at its own speed, so that it could not, is
/// declared for rapids; it is not declared that it holds while the control guides the tip.
#[test]
fn rapids_of_single_axes_are_not_proven_while_the_tip_is_led() {
    let start = position(&[(b'X', 390.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', -40.0)]);
    let end = position(&[(b'X', 390.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 0.0), (b'C', 40.0)]);
    for (control, together) in [("rapid = \"synchronous\"", true), ("rapid = \"dogleg\"", false)] {
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
        assert_eq!(found.len(), 1, "{control}: {found:?}");
        assert!(
            found[0].inside && found[0].if_together != together,
            "{control}: {found:?}"
        );
        assert_eq!(tip_deviation(&narrow, &leg, 0.01).is_some(), together, "{control}");
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
    // a retract leaves the linear axes at an unknown position
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
