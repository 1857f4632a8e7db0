//! Lines that were put together into arcs and lines.
mod curved;

use crate::recheck::{certify, recheck};
use crate::{Certificate, Claim, Outcome, RefitSource};
use std::fmt::Write;
use trunnion_geometry::math::sin_cos;
use trunnion_interp::Setup;

fn claim(tolerance_mm: f64, source: RefitSource) -> Claim {
    Claim::RefittedPath { tolerance_mm, source }
}

fn prove_in(dialect: &str, before: &str, after: &str, claim: &Claim) -> Outcome {
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    certify(
        before.as_bytes(),
        after.as_bytes(),
        dialect,
        machine,
        &Setup::default(),
        claim,
    )
}

fn prove(before: &str, after: &str, tolerance_mm: f64) -> Outcome {
    prove_in("fanuc-30i", before, after, &claim(tolerance_mm, RefitSource::Chords))
}

fn proved(outcome: Outcome) -> Certificate {
    match outcome {
        Outcome::Proved(certificate) => *certificate,
        other => panic!("not proved: {other:?}"),
    }
}

fn refused(outcome: Outcome) -> String {
    match outcome {
        Outcome::Proved(certificate) => panic!("proved: {}", certificate.summary()),
        Outcome::Refuted(witness) => format!("refuted: {witness}"),
        Outcome::Unknown(gap) => format!("unknown: {gap}"),
    }
}

/// A program with points of a quarter circle of radius 20 every 10 deg.
fn chords(head: &str, tail: &str) -> String {
    let mut text = format!("G21 G90 G94 G17 G54\nM3 S1000\n{head}G0 X20. Y0. Z5. A0. C0.\nG1 Z0. F500\n");
    for step in 1..=9 {
        let (sin, cos) = sin_cos((f64::from(step) * 10.0).to_radians());
        writeln!(text, "X{:.3} Y{:.3}", 20.0 * cos, 20.0 * sin).expect("a string");
    }
    text + tail + "G0 Z50.\nM30\n"
}

/// The same as one arc.
fn arc(head: &str, arc: &str, tail: &str) -> String {
    format!("G21 G90 G94 G17 G54\nM3 S1000\n{head}G0 X20. Y0. Z5. A0. C0.\nG1 Z0. F500\n{arc}\n{tail}G0 Z50.\nM30\n")
}

const ARC: &str = "G3 X0. Y20. I-20. J0.";

#[test]
fn lines_become_an_arc_within_their_sag() {
    let (before, after) = (chords("", "G1 X-5.\n"), arc("", ARC, "G1 X-5.\n"));
    // 20 mm (1 - cos 5 deg) = 0.0761 mm, and the rounding of the points
    let certificate = proved(prove(&before, &after, 0.08));
    let found = certificate.worst.point_shift_mm.value;
    assert!((found - 0.0761).abs() < 0.001, "{found}");
    assert_eq!((certificate.motions.total, certificate.motions.changed), (5, 1));
    assert!(refused(prove(&before, &after, 0.075)).contains("the path is up to 0.076"));
    let points = proved(prove_in(
        "fanuc-30i",
        &before,
        &after,
        &claim(0.001, RefitSource::Points),
    ));
    assert!(points.worst.point_shift_mm.value < 0.001);
    assert!(points.worst.path_bound_mm.value > 0.07);
    // stored and read again, and then forged
    let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let again = |certificate: &Certificate| {
        let stored = Certificate::from_json(&certificate.to_json()).expect("JSON");
        recheck(
            &stored,
            before.as_bytes(),
            after.as_bytes(),
            dialect,
            machine,
            &Setup::default(),
        )
    };
    proved(again(&certificate));
    let mut forged = points;
    forged.claim = claim(0.001, RefitSource::Chords);
    assert!(refused(again(&forged.sealed())).contains("0.001 mm is allowed"));
}

#[test]
fn the_other_way_round_and_more_than_once_round_are_refuted() {
    let before = chords("", "");
    for (text, why) in [
        ("G2 X0. Y20. I-20. J0.", "from the new path"),
        ("G3 X0. Y20. R-20.", "from the new path"),
        ("G3 X0.1 Y20. R20.", "from the new path"),
        ("G3 X0. Y20. I-20. J0. F600", "feed"),
        ("G3 X0. Y20. I-20. J0. S900", "speed"),
        ("G3 X0. Y20. I-20. J0. C1.", "rotary"),
        ("G3 X0. Y20. Z.1 I-20. J0.", "from the new path"),
        ("M8\nG3 X0. Y20. I-20. J0.", "coolant differs"),
        ("G1 X0. Y20.", "from the new path"),
    ] {
        let found = refused(prove(&before, &arc("", text, ""), 0.08));
        assert!(found.contains(why), "{text}: {found}");
    }
    // a path that goes there, back and there again is not the arc, although no point of one is far from the other
    let back = before.replace("X12.856 ", "X15.321 Y12.856\nX19.696 Y3.473\nX12.856 ");
    assert!(refused(prove(&back, &arc("", ARC, ""), 0.08)).contains("from the new path"));
}

#[test]
fn where_the_number_of_blocks_matters_nothing_is_put_together() {
    for head in ["G61\n", "G95\nG64\nG61\n", "G41 D1\n"] {
        let found = refused(prove(&chords(head, ""), &arc(head, ARC, ""), 0.08));
        assert!(found.starts_with("unknown"), "{head}: {found}");
    }
    let timed = |text: String| {
        text.replace("G1 Z0. F500\n", "G1 Z0. F500\nG93\n")
            .replace('Y', "F60. Y")
    };
    assert!(refused(prove(&timed(chords("", "")), &timed(arc("", ARC, "")), 0.08)).contains("inverse time"));
}

#[test]
fn helices_and_other_planes() {
    let mut before = String::from("G21 G90 G94 G17 G54\nM3 S1000\nG0 X20. Y0. Z5. A0. C0.\nG1 Z0. F500\n");
    let mut sideways = before.clone();
    for step in 1..=18 {
        let (sin, cos) = sin_cos((f64::from(step) * 5.0).to_radians());
        let z = -0.25 * f64::from(step);
        writeln!(before, "X{:.4} Y{:.4} Z{z:.4}", 20.0 * cos, 20.0 * sin).expect("a string");
        writeln!(sideways, "X{:.4} Z{:.4}", 20.0 * cos, 20.0 * sin).expect("a string");
    }
    let after =
        "G21 G90 G94 G17 G54\nM3 S1000\nG0 X20. Y0. Z5. A0. C0.\nG1 Z0. F500\nG3 X0. Y20. Z-4.5 I-20. J0.\nM30\n";
    proved(prove(&(before.clone() + "M30\n"), after, 0.0196));
    refused(prove(&(before + "M30\n"), after, 0.0185));
    let plane = after.replace("G3 X0. Y20. Z-4.5 I-20. J0.", "G18 G2 X0. Z20. I-20. K0.\nG17");
    proved(prove(&(sideways.clone() + "M30\n"), &plane, 0.0196));
    // on a Sinumerik the plane says along which axis the tool's length acts
    let sinumerik = |text: &str| format!("T1 D1\n{}", text.replace(". ", ".0 "));
    let outcome = prove_in(
        "sinumerik-840d",
        &sinumerik(&(sideways + "M30\n")),
        &sinumerik(&plane),
        &claim(0.0196, RefitSource::Chords),
    );
    assert!(refused(outcome).contains("the working plane"));
}

#[test]
fn lines_become_one_line_and_one_line_two() {
    let before = "G21 G90 G94 G17 G54\nM3 S1000\nG0 X0. Y0. Z5. A0. C0.\nG1 Z0. F500\nX1. Y0.0004\nX2. Y-0.0004\nX3.\nY1.\nX9.\nM30\n";
    let after =
        "G21 G90 G94 G17 G54\nM3 S1000\nG0 X0. Y0. Z5. A0. C0.\nG1 Z0. F500\nX3. Y-0.0004\nY1.\nX5.\nX9.\nM30\n";
    let certificate = proved(prove(before, after, 0.001));
    assert!(certificate.worst.point_shift_mm.value > 0.0003);
    assert!(refused(prove(before, after, 0.0001)).contains("0.0001 mm is allowed"));
}

/// While rotary axes turn, the path in the part is another one than the programmed coordinates say.
#[test]
fn rotary_axes_must_stand_still() {
    let turning = |text: String| text.replace("Y3.473", "Y3.473 C5.").replace("Y20.0", "Y20.0 C0.");
    let found = refused(prove(&turning(chords("", "")), &arc("", ARC, ""), 0.08));
    assert!(found.contains("a rotary axis moves"), "{found}");
}

/// Where two new motions meet, they need not meet at a point of the old path: near one is enough, and both parts count from there.
#[test]
fn new_motions_may_meet_beside_the_old_points() {
    let before = chords("", "G1 X-5.\n");
    let two = |x: f64, y: f64| arc("", &format!("G3 X{x:.3} Y{y:.3} R20.\nG3 X0. Y20. R20."), "G1 X-5.\n");
    let at = |degrees: f64, radius: f64| {
        let (sin, cos) = sin_cos(f64::to_radians(degrees));
        (radius * cos, radius * sin)
    };
    let (x, y) = at(40.0, 20.02);
    let certificate = proved(prove(&before, &two(x, y), 0.11));
    assert_eq!((certificate.motions.total, certificate.motions.changed), (6, 2));
    // sag 0.076 mm, and up to 0.02 more
    let found = certificate.worst.point_shift_mm.value;
    assert!((0.085..0.1).contains(&found), "{found}");
    assert!(refused(prove(&before, &two(x, y), 0.085)).contains("0.085 mm is allowed"));
    // beyond the tolerance, or not near any point
    for (degrees, radius) in [(40.0, 20.2), (45.0, 20.0)] {
        let (x, y) = at(degrees, radius);
        assert!(refused(prove(&before, &two(x, y), 0.11)).contains("from the new path"));
    }
    // it must not begin or end beside the points at which something else happens
    for (text, tail, why) in [
        ("G3 X0. Y20.02 R20.", "", "begin at different places"),
        ("G3 X0. Y20.02 R20.\nM8", "M8\n", "begin at different places"),
        ("G3 X0. Y20.02 R20.\nG4 X1.", "G4 X1.\n", "begin at different places"),
    ] {
        let (before, after) = (chords("", tail), arc("", text, ""));
        let found = refused(prove(&before, &after, 0.11));
        assert!(found.contains(why), "{text}: {found}");
    }
    // a line that begins beside the old one and ends with it is not the same line
    let (before, aside) = (
        chords("", "G1 X-5. Y20.\n"),
        arc("", "G3 X0. Y20.02 R20.", "G1 X-5. Y20.\n"),
    );
    let certificate = proved(prove(&before, &aside, 0.11));
    assert!(certificate.motions.changed == 2);
    assert!(refused(prove(&before, &aside.replace("20.02", "20.2"), 0.11)).contains("from the new path"));
}
