//! Canned cycles as motions, with numbers from their definitions in the manuals.
use crate::support::{faults, line, lines, run_bytes};
use trunnion_interp::{ControlData, Setup};

/// Positions without X and Y for cycles that stay on one hole.
fn heights(dialect: &str, source: &str) -> Vec<String> {
    lines(dialect, source)
        .iter()
        .map(|line| line.replace("X1 Y2 ", ""))
        .collect()
}

#[test]
fn drilling_returns_to_the_initial_level_or_to_r() {
    // initial level 20, R 2, Z -5: XY in rapid, down to R in rapid, feed to Z, up in rapid
    let source = "G90 G0 X0. Y0. Z20.\nG99 G81 X10. Y5. Z-5. R2. F100.\nX20.\nG98 Y15.\nG80\nX0.\n";
    assert_eq!(
        lines("fanuc-30i", source),
        [
            "R X0 Y0 Z20",
            "R X10 Y5 Z20",
            "R X10 Y5 Z2",
            "L X10 Y5 Z-5 F100",
            "R X10 Y5 Z2",
            "R X20 Y5 Z2",
            "L X20 Y5 Z-5 F100",
            "R X20 Y5 Z2",
            "R X20 Y15 Z2",
            "L X20 Y15 Z-5 F100",
            "R X20 Y15 Z20",
            "R X0 Y15 Z20",
        ]
    );
    assert_eq!(faults("fanuc-30i", source), [""; 0]);
}

#[test]
fn incremental_holes_repeat() {
    // G91: R counts from the initial level (20 - 18 = 2), Z from R (2 - 7 = -5), K3 makes holes at X10, 20, 30
    let source = "G90 G0 X0. Y0. Z20.\nG91 G98 G81 X10. Z-7. R-18. K3 F50.\nG80 G90 X0.\n";
    assert_eq!(
        lines("fanuc-30i", source),
        [
            "R X0 Y0 Z20",
            "R X10 Y0 Z20",
            "R X10 Y0 Z2",
            "L X10 Y0 Z-5 F50",
            "R X10 Y0 Z20",
            "R X20 Y0 Z20",
            "R X20 Y0 Z2",
            "L X20 Y0 Z-5 F50",
            "R X20 Y0 Z20",
            "R X30 Y0 Z20",
            "R X30 Y0 Z2",
            "L X30 Y0 Z-5 F50",
            "R X30 Y0 Z20",
            "R X0 Y0 Z20",
        ]
    );
    assert_eq!(faults("fanuc-30i", source), [""; 0]);
}

#[test]
fn no_repeats_only_keep_the_data() {
    // L0 keeps Z and R; the next block drills
    let source = "G0 X1. Y2. Z9.\nG99 G81 Z-3. R1. F100. L0\nX5.\n";
    assert_eq!(
        lines("haas-ngc", source),
        [
            "R X1 Y2 Z9",
            "R X5 Y2 Z9",
            "R X5 Y2 Z1",
            "L X5 Y2 Z-3 F100",
            "R X5 Y2 Z1"
        ]
    );
}

#[test]
fn dwells_at_the_bottom() {
    // P500 is 0.5 s
    let got = heights("fanuc-30i", "G0 X1. Y2. Z9.\nG98 G82 Z-3. R1. P500 F100.\n");
    assert_eq!(got, ["R Z9", "R Z1", "L Z-3 F100", "D0.5 Z-3", "R Z9"]);
    let got = heights("haas-ngc", "G0 X1. Y2. Z9.\nG98 G82 Z-3. R1. P0.25 F100.\n");
    assert_eq!(got[3], "D0.25 Z-3");
}

pub(crate) fn pecking(dialect: &str, source: &str, control: ControlData) -> Vec<String> {
    let setup = Setup {
        control,
        ..Setup::default()
    };
    let (_, log) = run_bytes(dialect, source.as_bytes(), &setup);
    log.motions.iter().map(|m| line(m).replace("X1 Y2 ", "")).collect()
}

#[test]
fn pecking_leaves_the_hole() {
    // R 1, Z -6: depth 7 in steps of 3: -2, -5, then what is left; clearance 0.5 above the last depth
    let control = ControlData {
        peck_clearance_mm: Some(0.5),
        ..ControlData::default()
    };
    let source = "G0 X1. Y2. Z9.\nG99 G83 Z-6. R1. Q3. F100.\nM30\n";
    let want = [
        "R Z9",
        "R Z1",
        "L Z-2 F100",
        "R Z1",
        "R Z-1.5",
        "L Z-5 F100",
        "R Z1",
        "R Z-4.5",
        "L Z-6 F100",
        "R Z1",
    ];
    assert_eq!(pecking("fanuc-30i", source, control), want);
    // where the clearance is not declared, the rapid into the hole ends at an unknown position; the depths are known
    let got = pecking("fanuc-30i", source, ControlData::default());
    assert_eq!(got[3..6], ["R Z1", "R X1 Y2", "L Z-5 F100"]);
}

#[test]
fn chip_breaking_stays_in_the_hole() {
    // back by 0.2 after -2 and -5
    let control = ControlData {
        chip_break_retract_mm: Some(0.2),
        ..ControlData::default()
    };
    let got = pecking(
        "fanuc-30i",
        "G0 X1. Y2. Z9.\nG98 G73 Z-6. R1. Q3. F100.\nM30\n",
        control,
    );
    let want = [
        "R Z9",
        "R Z1",
        "L Z-2 F100",
        "R Z-1.8",
        "L Z-5 F100",
        "R Z-4.8",
        "L Z-6 F100",
        "R Z9",
    ];
    assert_eq!(got, want);
}

#[test]
fn haas_steps_become_smaller() {
    // I3 J1 K1.5, R 0, Z -8: steps 3, 2, 1.5, 1.5 = 8
    let control = ControlData {
        peck_clearance_mm: Some(0.0),
        ..ControlData::default()
    };
    let got = pecking(
        "haas-ngc",
        "G0 X1. Y2. Z9.\nG99 G83 Z-8. R0. I3. J1. K1.5 F100.\nM30\n",
        control,
    );
    let feeds: Vec<_> = got.iter().filter(|line| line.starts_with('L')).collect();
    assert_eq!(feeds, ["L Z-3 F100", "L Z-5 F100", "L Z-6.5 F100", "L Z-8 F100"]);
}

#[test]
fn taps_and_bores_feed_out() {
    let head = "G0 X1. Y2. Z9.\n";
    let tap = heights("fanuc-30i", &format!("{head}G98 G84 Z-3. R1. P100 F100.\n"));
    assert_eq!(tap, ["R Z9", "R Z1", "L Z-3 F100", "D0.1 Z-3", "L Z1 F100", "R Z9"]);
    let left = heights("fanuc-30i", &format!("{head}G99 G74 Z-3. R1. F100.\n"));
    assert_eq!(left, ["R Z9", "R Z1", "L Z-3 F100", "L Z1 F100"]);
    // J2: out with twice the feed
    let fast = heights("haas-ngc", &format!("{head}G99 G84 Z-3. R1. J2 F100.\n"));
    assert_eq!(fast, ["R Z9", "R Z1", "L Z-3 F100", "L Z1 F200"]);
    let bore = heights("fanuc-30i", &format!("{head}G98 G85 Z-3. R1. F100.\n"));
    assert_eq!(bore, ["R Z9", "R Z1", "L Z-3 F100", "L Z1 F100", "R Z9"]);
    let dwell = heights("fanuc-30i", &format!("{head}G99 G89 Z-3. R1. P200 F100.\n"));
    assert_eq!(dwell, ["R Z9", "R Z1", "L Z-3 F100", "D0.2 Z-3", "L Z1 F100"]);
}

#[test]
fn bores_that_stop_the_spindle() {
    let source = "S100 M3\nG0 X1. Y2. Z9.\nG98 G86 Z-3. R1. F100.\nX5.\nM30\n";
    let (_, log) = run_bytes("fanuc-30i", source.as_bytes(), &Setup::default());
    let on: Vec<_> = log.motions[..5].iter().map(|m| m.spindle_on == Some(true)).collect();
    assert_eq!(
        on,
        [true, true, true, false, true],
        "off on the way up, on again behind it"
    );
    let manual = heights("fanuc-30i", "G0 X1. Y2. Z9.\nG98 G88 Z-3. R1. P100 F100.\n");
    assert_eq!(manual, ["R Z9", "R Z1", "L Z-3 F100", "D0.1 Z-3", "U Z1", "R Z9"]);
    let said = faults("fanuc-30i", "G0 X1. Y2. Z9.\nG98 G88 Z-3. R1. P100 F100.\n");
    assert!(said.len() == 1 && said[0].contains("manual retract"), "{said:?}");
}

#[test]
fn fine_boring_shifts_off_the_wall() {
    // Fanuc: a parameter decides the direction in which Q shifts, so X and Y are unknown while the tool is off the wall
    let fanuc = lines("fanuc-30i", "G0 X1. Y2. Z9.\nG98 G76 Z-3. R1. Q0.5 F100.\n");
    assert_eq!(
        fanuc,
        [
            "R X1 Y2 Z9",
            "R X1 Y2 Z1",
            "L X1 Y2 Z-3 F100",
            "R Z-3",
            "R Z9",
            "R X1 Y2 Z9"
        ]
    );
    let source = "G0 X1. Y2. Z9.\nG98 G76 Z-3. R1. Q0.5 F100.\nG80\nM30\n";
    let said = faults("fanuc-30i", source);
    assert!(said.len() == 1 && said[0].contains("off the wall"), "{said:?}");
    let declared = |way| ControlData {
        bore_shift: Some(way),
        ..ControlData::default()
    };
    let left = pecking("fanuc-30i", source, declared((0, -1.0)));
    assert_eq!(left[3..5], ["R X0.5 Y2 Z-3", "R X0.5 Y2 Z9"]);
    // along the hole there is no wall
    let along = pecking("fanuc-30i", source, declared((2, 1.0)));
    assert_eq!(along[3], "R Z-3");
    // Haas: I and J say it
    let haas = lines("haas-ngc", "G0 X1. Y2. Z9.\nG99 G76 Z-3. R1. I0.5 J-0.25 F100.\n");
    assert_eq!(haas[3..], ["R X1.5 Y1.75 Z-3", "R X1.5 Y1.75 Z1", "R X1 Y2 Z1"]);
}

#[test]
fn back_boring_cuts_upward() {
    // shifted by I0.5 down to R -10, back, up to Z -6, shifted, up to the initial level, back
    let got = lines("haas-ngc", "G0 X1. Y2. Z9.\nG98 G77 Z-6. R-10. I0.5 F100.\n");
    assert_eq!(
        got,
        [
            "R X1 Y2 Z9",
            "R X1.5 Y2 Z9",
            "R X1.5 Y2 Z-10",
            "R X1 Y2 Z-10",
            "L X1 Y2 Z-6 F100",
            "R X1.5 Y2 Z-6",
            "R X1.5 Y2 Z9",
            "R X1 Y2 Z9",
        ]
    );
}

#[test]
fn the_plane_chooses_the_drilling_axis() {
    // G19: X drills, holes lie in Y Z
    let got = lines("haas-ngc", "G0 X9. Y1. Z2.\nG19 G99 G81 Y4. Z5. X-3. R1. F100.\n");
    assert_eq!(got[1..], ["R X9 Y4 Z5", "R X1 Y4 Z5", "L X-3 Y4 Z5 F100", "R X1 Y4 Z5"]);
}

#[test]
fn patterns_of_holes() {
    // circle of radius 10 about X50 Y0: 4 holes from 90 deg on
    let head = "G0 X50. Y0. Z9.\nG99 G81 Z-3. R1. F100. L0\n";
    let holes = |source: &str| -> Vec<String> {
        let all = lines("haas-ngc", &format!("{head}{source}G80\nM30\n"));
        all.into_iter().filter(|line| line.starts_with('L')).collect()
    };
    assert_eq!(
        holes("G70 I10. J90. L4\n"),
        [
            "L X50 Y10 Z-3 F100",
            "L X40 Y0 Z-3 F100",
            "L X50 Y-10 Z-3 F100",
            "L X60 Y0 Z-3 F100"
        ]
    );
    // arc: 3 holes from 0 deg, 90 deg apart
    assert_eq!(
        holes("G71 I10. J0. K90. L3\n"),
        ["L X60 Y0 Z-3 F100", "L X50 Y10 Z-3 F100", "L X40 Y0 Z-3 F100"]
    );
    // line at 90 deg, 5 apart, from the present point
    assert_eq!(
        holes("G72 I5. J90. L3\n"),
        ["L X50 Y0 Z-3 F100", "L X50 Y5 Z-3 F100", "L X50 Y10 Z-3 F100"]
    );
    let got = faults("haas-ngc", "G0 X0. Y0. Z9.\nG70 I10. J0. L4\n");
    assert!(
        got[0].contains("CannedCycle") && got[0].contains("without a canned cycle"),
        "{got:?}"
    );
}

#[test]
fn pockets_end_where_they_begin() {
    let source = "G0 X10. Y20. Z1.\nG12 I10. Z-5. D1 F200.\nG0 Z9.\n";
    assert_eq!(
        lines("haas-ngc", source),
        ["R X10 Y20 Z1", "U X10 Y20 Z-5", "R X10 Y20 Z9"]
    );
    assert_eq!(
        faults("haas-ngc", source),
        [r#"2: G12: NotModelled { what: "G12: the path inside the pocket" }"#]
    );
}

#[test]
fn what_a_cycle_needs() {
    let rejected = |source: &str| -> String {
        let all = faults("fanuc-30i", &format!("G0 X0. Y0. Z9.\n{source}\n"));
        assert_eq!(all.len(), 1, "{all:?}");
        all[0].clone()
    };
    assert!(rejected("G81 X1. Z-3. F100.").contains("G81 without R"));
    // on a Haas R is optional: no mistake, and not known
    let haas = faults("haas-ngc", "G0 X0. Y0. Z9.\nG91 G82 X1. Z-3. P0.5 L3 F100.\n");
    assert!(
        haas.len() == 1 && haas[0].contains("NotModelled") && haas[0].contains("G82 without R"),
        "{haas:?}"
    );
    assert!(rejected("G81 X1. R1. F100.").contains("G81 without the depth"));
    let peck = rejected("G83 X1. Z-3. R1. F100.");
    assert!(
        peck.contains("refusal: CannedCycle") && peck.contains(r#"alarm: Some("PS0045")"#),
        "{peck}"
    );
    assert!(rejected("G83 X1. Z-3. R1. Q0 F100.").contains("G83 without Q"));
    assert!(rejected("G81 X1. Z-3. R1.").contains("MissingFeed"));
    // after a mistake the places are not known
    assert_eq!(
        lines("fanuc-30i", "G0 X0. Y0. Z9.\nG81 X1. Z-3. F100.\n"),
        ["R X0 Y0 Z9", "U Y0"]
    );
}

#[test]
fn whole_numbers_in_cycles() {
    assert_eq!(
        faults("fanuc-30i", "G0 X0. Y0. Z9.\nG83 Z-3. R1. Q2000 K2 F100.\n"),
        ["2: Q2000: AmbiguousDecimal"]
    );
}

#[test]
fn turning_passes() {
    // system A, X is a diameter: from X50 Z2 (radius 25): in to X40 (20), cut to Z-30, out, back; then X36, then the taper R-2
    let source = "G0 X50. Z2.\nG90 X40. Z-30. F0.2\nX36.\nG0 X60.\n";
    assert_eq!(
        lines("fanuc-30i-lathe-a", source),
        [
            "R X25 Z2",
            "R X20 Z2",
            "L X20 Z-30 F0.2/rev",
            "L X25 Z-30 F0.2/rev",
            "R X25 Z2",
            "R X18 Z2",
            "L X18 Z-30 F0.2/rev",
            "L X25 Z-30 F0.2/rev",
            "R X25 Z2",
            "R X30 Z2",
        ]
    );
    let taper = lines("fanuc-30i-lathe-a", "G0 X50. Z2.\nG90 X40. Z-30. R-2. F0.2\n");
    assert_eq!(taper[1..3], ["R X18 Z2", "L X20 Z-30 F0.2/rev"]);
    // system B calls it G77; facing is G79: in along Z, cut along X, back along Z
    let facing = lines("fanuc-30i-lathe-b", "G90 G0 X50. Z2.\nG79 X0. Z-1. F0.2\n");
    assert_eq!(
        facing[1..],
        ["R X25 Z-1", "L X0 Z-1 F0.2/rev", "L X0 Z2 F0.2/rev", "R X25 Z2"]
    );
}

#[test]
fn threads_feed_by_their_lead() {
    // 1.5 mm per turn; out in rapid
    let got = lines(
        "fanuc-30i-lathe-a",
        "G0 X30. Z5.\nG92 X24. Z-20. F1.5\nG0 X30.\nG32 Z-20. F2.\n",
    );
    assert_eq!(
        got,
        [
            "R X15 Z5",
            "R X12 Z5",
            "L X12 Z-20 F1.5/rev",
            "R X15 Z-20",
            "R X15 Z5",
            "R X15 Z5",
            "L X15 Z-20 F2/rev",
        ]
    );
}

#[test]
fn distances_of_a_lathe() {
    // U is a difference of diameters, W of Z
    assert_eq!(
        lines("fanuc-30i-lathe-a", "G0 X20. Z5.\nU4. W-2.\nG1 X30. W-1. F0.1\n"),
        ["R X10 Z5", "R X12 Z3", "L X15 Z2 F0.1/rev"]
    );
}
