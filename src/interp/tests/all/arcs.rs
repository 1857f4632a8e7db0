//! Arcs in all planes, both forms, helices, full circles, turns, and what can be wrong with them.
use crate::support::{faults, lines};

/// The line of an arc that starts at X10 Y20 Z30.
fn arc(block: &str) -> String {
    let got = lines("linuxcnc", &format!("G0 X10 Y20 Z30\nF100\n{block}\n"));
    got[1].clone()
}

#[test]
fn planes_and_directions() {
    assert_eq!(arc("G17 G2 X20 Y10 I0 J-10"), "A(10 10 30; -90) X20 Y10 Z30 F100");
    assert_eq!(arc("G17 G3 X20 Y10 I0 J-10"), "A(10 10 30; 270) X20 Y10 Z30 F100");
    // in Z X the first axis is Z: from +Z to +X is counter-clockwise
    assert_eq!(arc("G18 G3 X20 Z20 I0 K-10"), "A(10 20 20; 90) X20 Y20 Z20 F100");
    assert_eq!(arc("G18 G2 X20 Z20 I0 K-10"), "A(10 20 20; -270) X20 Y20 Z20 F100");
    assert_eq!(arc("G19 G3 Y10 Z40 J-10 K0"), "A(10 10 30; 90) X10 Y10 Z40 F100");
    assert_eq!(arc("G19 G2 Y10 Z40 J-10 K0"), "A(10 10 30; -270) X10 Y10 Z40 F100");
}

#[test]
fn helices_and_full_circles() {
    assert_eq!(arc("G2 X20 Y10 Z25 J-10"), "A(10 10 30; -90) X20 Y10 Z25 F100");
    assert_eq!(arc("G2 I5"), "A(15 20 30; -360) X10 Y20 Z30 F100");
    assert_eq!(arc("G3 X10 Y20 Z0 I5"), "A(15 20 30; 360) X10 Y20 Z0 F100");
    assert_eq!(
        arc("G3 X10 Y20 Z0 I5 P3"),
        "A(15 20 30; 1080) X10 Y20 Z0 F100",
        "P counts the turns begun"
    );
}

#[test]
fn a_full_circle_needs_no_motion_code_of_its_own() {
    for dialect in ["fanuc-30i", "haas-ngc", "sinumerik-840d", "iso-6983"] {
        let text = "G17 G90 G0 X15. Y0. Z0.\nG2 X15. Y0. I-15. J0. F100.\nI-15. J0.\nJ-15.\n";
        let circle = "A(0 0 0; -360) X15 Y0 Z0 F100";
        let got = lines(dialect, text);
        assert_eq!(got[1..3], [circle, circle], "{dialect}");
        assert_eq!(got[3], "A(15 -15 0; -360) X15 Y0 Z0 F100", "{dialect}");
        assert_eq!(faults(dialect, text), [""; 0], "{dialect}");
        // K lies outside the plane, and G1 reads no centre
        for other in ["G2 X15. Y0. I-15. F100.\nK5.\n", "G1 X14. F100.\nI-15. J0.\n"] {
            let text = format!("G17 G90 G0 X15. Y0. Z0.\n{other}");
            assert_eq!(lines(dialect, &text).len(), 2, "{dialect}: {other}");
        }
    }
    // grbl refuses the words
    assert_eq!(
        lines("grbl", "G17 G90 G0 X15 Y0 Z0\nG2 X15 Y0 I-15 F100\nI-15 J0\n").len(),
        2
    );
}

#[test]
fn turns_are_further_full_turns() {
    let got = lines("sinumerik-840d", "G0 X10 Y0 Z0\nG3 X0 Y10 Z-5 I-10 J0 TURN=2 F100\n");
    assert_eq!(got[1], "A(0 0 0; 810) X0 Y10 Z-5 F100");
}

#[test]
fn radius_form() {
    assert_eq!(arc("G2 X20 Y10 R10"), "A(10 10 30; -90) X20 Y10 Z30 F100");
    assert_eq!(arc("G2 X20 Y10 R-10"), "A(20 20 30; -270) X20 Y10 Z30 F100");
    assert_eq!(arc("G3 X20 Y10 R10"), "A(20 20 30; 90) X20 Y10 Z30 F100");
    assert_eq!(arc("G3 X20 Y10 R-10"), "A(10 10 30; 270) X20 Y10 Z30 F100");
    assert_eq!(arc("G2 X20 Y20 R5"), "A(15 20 30; -180) X20 Y20 Z30 F100");
    let got = lines("sinumerik-840d", "G0 X10 Y20 Z30\nG2 X20 Y10 CR=-10 F100\n");
    assert_eq!(got[1], "A(20 20 30; -270) X20 Y10 Z30 F100");
}

#[test]
fn centres_absolute_and_per_word() {
    assert_eq!(arc("G90.1 G2 X20 Y10 I10 J10"), "A(10 10 30; -90) X20 Y10 Z30 F100");
    let got = lines("sinumerik-840d", "G0 X10 Y20 Z30\nG2 X20 Y10 I=AC(10) J-10 F100\n");
    assert_eq!(got[1], "A(10 10 30; -90) X20 Y10 Z30 F100");
    let inch = lines("iso-6983", "G20 G0 X1 Y0 Z0\nG3 X0 Y1 I-1 J0 F10\n");
    assert_eq!(inch[1], "A(0 0 0; 90) X0 Y25.4 Z0 F254");
}

#[test]
fn unknown_ends_make_unknown_arcs() {
    assert_eq!(lines("iso-6983", "G0 X1\nG2 X2 Y2 I1 J0 F1\n")[1], "A? X2 Y2 F1");
    assert_eq!(
        lines("iso-6983", "G0 X0 Y0\nG2 X2 Y0 I1 J0 F1\n")[1],
        "A? X2 Y0 F1",
        "its height is not known"
    );
    assert_eq!(
        lines("sinumerik-840d", "G0 X0 Y0 Z0\nG2 X2 Y0 I=R1 J0 F1\n")[1],
        "A? X2 Y0 Z0 F1"
    );
}

#[test]
fn arc_faults() {
    let of = |block: &str| faults("iso-6983", &format!("G0 X0 Y0 Z0\nF9\n{block}\n"));
    assert_eq!(
        of("G2 X10 Y0 R4"),
        ["3: X10: ArcRadiusTooSmall { radius: 4.0, half_chord: 5.0 }"]
    );
    assert_eq!(of("G2 X10 Y0"), ["3: X10: ArcCentreMissing"]);
    assert_eq!(of("G2 X0 Y0 R4"), ["3: X0: ArcCentreMissing"]);
    let mismatch = of("G2 X10 Y0 I6 J0");
    assert_eq!(
        mismatch,
        ["3: X10: ArcRadiusMismatch { start: 6.0, end: 4.0, tolerance: 0.005 }"]
    );
    assert_eq!(of("G2 X10 Y0 I5.0009 J0"), [""; 0], "within the dialect's tolerance");
    assert_eq!(
        of("G2 X10 Y0 I5 R5"),
        [r#"3: X10: NotModelled { what: "R together with I, J, K" }"#]
    );
    // the fault is found in the plane, whatever is known of the height
    assert_eq!(
        faults("iso-6983", "G0 X0 Y0\nG2 X10 Y0 I6 J0 F9\n"),
        ["2: X10: ArcRadiusMismatch { start: 6.0, end: 4.0, tolerance: 0.005 }"]
    );
}

#[test]
fn a_mismatched_arc_keeps_both_radii() {
    let got = lines("iso-6983", "G0 X0 Y0 Z0\nG2 X10 Y0 I6 J0 F9\n");
    assert_eq!(got[1], "A(6 0 0; -180) X10 Y0 Z0 F9");
}
