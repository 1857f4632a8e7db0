//! What a program asks for beside its words: point-to-point travel, turn bits.
use crate::common::{position, words};
use crate::controls::plain;
use trunnion_geometry::{deg, rad};
use trunnion_interp::{Motion, Posture, Swivel, Tilt};
use trunnion_machine::{Follower, OpenCause, load, tip_deviation};

/// A is at -30 deg and goes to 30 deg while the tip is to end where it began, 100 mm above the axes. Guided, it never leaves the point;
/// point to point the axes move linearly, and half way, with A at zero, the tip is at 100 cos 30 deg = 86.60 mm: 13.40 mm off.
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
