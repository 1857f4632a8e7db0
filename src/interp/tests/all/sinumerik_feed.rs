//! FGROUP and FGREF: the time of blocks whose F is not that of X, Y and Z.
use crate::support::run_text;
use trunnion_geometry::math::hypot;
use trunnion_interp::{FaultKind, Feed, Motion};

/// The feed motions of a program.
fn cuts(text: &str) -> Vec<Motion> {
    let log = run_text("sinumerik-840d", text);
    log.motions
        .into_iter()
        .filter(|motion| motion.feed != Feed::Rapid)
        .collect()
}

/// Seconds of a motion along one axis or a diagonal of X and Y, or of degrees where only A turns.
fn seconds(motion: &Motion) -> f64 {
    let ways: Vec<f64> = (0..9)
        .map(|axis| motion.end.get(axis).unwrap_or(0.0) - motion.start.get(axis).unwrap_or(0.0))
        .collect();
    let linear = ways[..3].iter().map(|way| way * way).sum::<f64>().sqrt();
    let way = if linear > 0.0 { linear } else { ways[3].abs() };
    match motion.feed {
        Feed::PerMinute(feed) => way / feed * 60.0,
        Feed::InverseTime(rate) => 60.0 / rate,
        feed => panic!("{feed:?}"),
    }
}

fn unknown(text: &str) -> Vec<String> {
    let log = run_text("sinumerik-840d", text);
    let kinds = log.faults.into_iter().map(|fault| fault.kind);
    kinds
        .filter_map(|kind| match kind {
            FaultKind::NotModelled { what } => Some(what),
            _ => None,
        })
        .collect()
}

/// Programming Manual, Fundamentals, 11/2006, p. 271: the times stand in its comments.
#[test]
fn the_times_of_the_manual() {
    let text = "N100 G0 X0 A0\nN110 FGROUP(X,A)\nN120 G91 G1 G710 F100\nN140 X10\nN160 X10 A10\nN180 A10\nN200 X0.001 A10\n\
                N210 G700 F100\nN230 X10\nN250 X10 A10\nN270 A10\nN290 X0.001 A10\nN300 FGREF[A]=360/(2*$PI)\nN320 X0.001 A10\nN330 M30\n";
    assert_eq!(unknown(text), [""; 0]);
    let found: Vec<f64> = cuts(text).iter().map(seconds).collect();
    // path 14.142 mm, then 254.2 mm
    let expected = [6.0, 8.485, 6.0, 6.0, 6.0, 6.005, 6.0, 0.236, 6.0];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-3, "{found} {expected}");
    }
}

/// Function Manual, Basic Machine, 08/2005, K2 2.1.10: 707 mm/min along both axes, then X with 1000 and Y with 500 mm/min.
#[test]
fn axes_outside_the_group_follow() {
    let text = "N05 G0 G94 G90 X0 Y0 Z0\nN10 FGROUP(X,Y)\nN20 G1 X100 Y100 F1000\nN30 FGROUP (X)\nN40 X200 Y150\n\
                N50 FGROUP()\nN60 X300 Y250\n";
    let cuts = cuts(text);
    let speeds: Vec<[f64; 2]> = cuts
        .iter()
        .map(|cut| [0, 1].map(|axis| (cut.end.values[axis] - cut.start.values[axis]) / seconds(cut) * 60.0))
        .collect();
    for (found, expected) in speeds
        .iter()
        .zip([[707.107, 707.107], [1000.0, 500.0], [707.107, 707.107]])
    {
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3),
            "{found:?}"
        );
    }
    assert_eq!((speeds.len(), unknown(text)), (3, vec![]));
    assert_eq!(cuts[0].feed, Feed::PerMinute(1000.0));
}

#[test]
fn arcs_count_in_their_plane() {
    // a half turn of radius 10 that sinks by 5, while A turns by 90 deg
    let head = "G17 G90 G94 G710\nG0 X0 Y0 Z0 A0\n";
    let arc = "G2 X20 Y0 Z-5 I10 J0 A90 F1000\n";
    let half = core::f64::consts::PI * 10.0;
    let helix = hypot(half, 5.0);
    for (group, path) in [
        ("FGROUP(X,Y)", half),
        ("FGROUP(X,Y,Z)", helix),
        ("FGROUP(X,Y,A)", hypot(half, 90.0)),
        ("FGREF[A]=20 FGROUP(X,Y,Z,A)", hypot(helix, half)),
        ("FGROUP(A)", 90.0),
    ] {
        let text = format!("{head}{group}\n{arc}");
        let text = text.replace(" FGROUP", "\nFGROUP");
        let [cut] = cuts(&text)[..] else { panic!("{text}") };
        let rate = match cut.feed {
            Feed::PerMinute(feed) => feed / helix,
            Feed::InverseTime(rate) => rate,
            feed => panic!("{feed:?}"),
        };
        assert!((rate - 1000.0 / path).abs() < 1e-9, "{text}: {rate} {path}");
    }
}

#[test]
fn what_is_not_known_is_said_once() {
    let head = "G17 G90 G94 G710\nG0 X0 Y0 Z0 A0 C0\n";
    for (text, what) in [
        ("FGROUP(X,Y)\nG1 Z5 F100\nZ6\n", "moves none of its axes"),
        ("FGROUP(X1,Y1)\nG1 X5 F100\nX6\n", "without a known letter"),
        ("FGROUP(X)\nG2 X20 Y0 I10 J0 F100\n", "one axis of an arc"),
        ("FGROUP(X)\nG2 X20 Y0 I=R99 J0 F100\n", "an arc that is not known"),
        ("FGROUP(X,Y)\nG95 G1 X5 Z5 F0.1\nX6 Z6\n", "per revolution"),
        ("FGREF[A]=10\nG1 A5 F100\nA6\n", "FGREF without FGROUP"),
        ("FGREF[A]=R99\nFGROUP(X,A)\nG1 X5 A5 F100\n", "of a value"),
        (
            "TRAORI\nFGROUP(X,Y,Z,A,C)\nG1 X5 A5 F100\nX6 A6\n",
            "neither by ORIAXES",
        ),
        ("FGROUP(X,A)\nG1 X5 A=R99 F100\n", "ends are not known"),
    ] {
        let text = format!("{head}{text}");
        let told: Vec<String> = unknown(&text).into_iter().filter(|told| told.contains(what)).collect();
        assert_eq!(told.len(), 1, "{text}: {:?} {:?}", unknown(&text), cuts(&text));
        assert!(cuts(&text).iter().all(|cut| cut.feed == Feed::Unknown), "{text}");
    }
}

#[test]
fn the_tip_and_the_axes_together_under_oriaxes() {
    let head = "G17 G90 G94 G710\nTRAORI\nG0 X0 Y0 Z0 A0 C0\nORIAXES\nFGREF[A]=10\nFGREF[C]=10\n";
    let rate = |text: &str| match cuts(text)[..] {
        [cut] => cut.feed,
        _ => panic!("{text}"),
    };
    let tip = rate(&format!("{head}FGROUP(X,Y,Z)\nG1 X30 Y40 A30 C40 F1000\n"));
    assert_eq!(tip, Feed::PerMinute(1000.0));
    let arm = 50.0_f64.to_radians() * 10.0;
    let Feed::InverseTime(both) = rate(&format!("{head}FGROUP(X,Y,Z,A,C)\nG1 X30 Y40 A30 C40 F1000\n")) else {
        panic!(
            "{:?}",
            cuts(&format!("{head}FGROUP(X,Y,Z,A,C)\nG1 X30 Y40 A30 C40 F1000\n"))
        );
    };
    assert!((both - 1000.0 / hypot(50.0, arm)).abs() < 1e-9);
    // a tool that does not turn
    let still = rate(&format!("{head}ORIVECT\nFGROUP(X,Y,Z,A,C)\nG1 X30 Y40 F1000\n"));
    assert_eq!(still, Feed::PerMinute(1000.0));
}

/// The radii of the two rotary axes give one for the turn of the tool: their geometric mean.
#[test]
fn the_tip_and_the_turn_of_the_tool_under_orivect() {
    let head = "G17 G90 G94 G710\nTRAORI\nG0 X0 Y0 Z0 A3=0 B3=0 C3=1\nORIVECT\nFGREF[A]=10\nFGREF[C]=40\n";
    let rate = |text: &str| match cuts(&format!("{head}{text}"))[..] {
        [cut] => cut.feed,
        _ => panic!("{text}"),
    };
    let turn = 20.0 * core::f64::consts::FRAC_PI_4;
    for (text, path) in [
        (
            "FGROUP(X,Y,Z,A,C)\nG1 X30 Y40 A3=0 B3=1 C3=1 F1000\n",
            hypot(50.0, turn),
        ),
        ("FGROUP(A,C)\nG1 X30 Y40 A3=0 B3=-2 C3=2 F1000\n", turn),
        ("FGROUP(X,Y,Z,A,C)\nG1 A3=1 B3=0 C3=1 F1000\n", turn),
        ("FGREF[C]=0\nFGROUP(X,A,C)\nG1 X30 Y40 A3=1 B3=0 C3=1 F1000\n", 30.0),
        // the same tool vector
        ("FGROUP(X,A,C)\nG1 X30 Y40 A3=0 B3=0 C3=3 F1000\n", 30.0),
    ] {
        let Feed::InverseTime(found) = rate(text) else {
            panic!("{text}: {:?}", rate(text));
        };
        assert!((found * path / 1000.0 - 1.0).abs() < 1e-12, "{text}: {found}");
    }
    for text in [
        "ORIAXES\nFGROUP(X,Y,Z,A,C)\nG1 X30 Y40 A3=0 B3=1 C3=1 F1000\n",
        "ORIPATH\nFGROUP(X,Y,Z,A,C)\nG1 X30 Y40 A3=0 B3=1 C3=1 F1000\n",
        "FGROUP(X,Y,Z,A)\nG1 X30 Y40 A3=0 B3=1 C3=1 F1000\n",
        "FGROUP(X,Y,Z,A,C)\nG1 X=R99 Y40 A3=0 B3=1 C3=1 F1000\n",
        "FGREF[C]=R99\nFGROUP(X,Y,Z,A,C)\nG1 X10 Y40 A3=0 B3=1 C3=1 F1000\n",
        "FGROUP(X,Y,Z,A,C)\nG1 X30 Y40 A30 C40 F1000\n",
    ] {
        assert_eq!(rate(text), Feed::Unknown, "{text}");
    }
}

/// A corner that is cut off has the F of its block, measured along its own path.
#[test]
fn corners_and_dwells_between_them() {
    let text = "G17 G90 G94 G710\nG0 X0 Y0 Z0\nFGROUP(X)\nG1 X10 Y10 F100\nG4 F1\nX20 Y30\n";
    let cuts = cuts(text);
    let rates: Vec<Feed> = cuts
        .iter()
        .map(|cut| cut.feed)
        .filter(|feed| matches!(feed, Feed::InverseTime(_)))
        .collect();
    assert_eq!(rates, [Feed::InverseTime(10.0), Feed::InverseTime(10.0)]);
}
