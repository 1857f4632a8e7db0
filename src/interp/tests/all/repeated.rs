//! Turning cycles of many cuts, with lists of motions made by hand. X is a diameter in the programs and a radius in the lists.
use crate::support::{fault_line, faults, line, lines, run_bytes};
use trunnion_interp::{MotionKind, Setup};

const A: &str = "fanuc-30i-lathe-a";
const CONTOUR: &str = "N10 G0 X20.\nG1 Z-10. F.1\nN20 X40.\n";

#[test]
fn finishing_runs_along_the_contour_and_returns() {
    let source = format!("G0 X50. Z2.\nG70 P10 Q20\nG0 X60.\nM30\n{CONTOUR}");
    let want = [
        "R X25 Z2",
        "R X10 Z2",
        "L X10 Z-10 F0.1/rev",
        "L X20 Z-10 F0.1/rev",
        "R X25 Z2",
        "R X30 Z2",
    ];
    assert_eq!(lines(A, &source), want);
    assert_eq!(faults(A, &source), [""; 0]);
    // system C calls it G72; a variable in the contour has the value of the run
    let source = "#1=20.\nG90 G0 X50. Z2.\nG72 P10 Q20\nG0 X60.\nM30\nN10 G0 X#1\nG1 Z-10. F.1\nN20 X[#1*2.]\n";
    assert_eq!(lines("fanuc-30i-lathe-c", source), want);
}

#[test]
fn roughing_in_one_block_ends_where_it_began_behind_its_contour() {
    let source = format!("G90 G0 X50. Z2.\nG73 P10 Q20 U.4 W.1 D2000 F.3\n{CONTOUR}G72 P10 Q20\nG0 X60.\nM30\n");
    let want = [
        "R X25 Z2",
        "U X25 Z2",
        "R X10 Z2",
        "L X10 Z-10 F0.1/rev",
        "L X20 Z-10 F0.1/rev",
        "R X25 Z2",
        "R X30 Z2",
    ];
    assert_eq!(lines("fanuc-30i-lathe-c", &source), want);
    let told = faults("fanuc-30i-lathe-c", &source);
    assert!(
        told.len() == 1 && told[0].contains("cuts of G73: the format in one block"),
        "{told:?}"
    );
}

#[test]
fn the_first_block_of_a_contour_is_straight() {
    let source = "G0 X50. Z2. Y0.\nG71 U2. R1.\nG71 P10 Q20 U.4 W.1 F.3\nN10 G2 X20. Z0. R20.\nN20 G1 Z-5.\nM30\n";
    let told = faults(A, source);
    assert!(told.iter().any(|fault| fault.contains("PS0065")), "{told:?}");
}

#[test]
fn patterns_come_nearer_by_equal_steps() {
    // U1. leaves 0.5 on the radius, W.5 in Z; three runs 4 and 2 mm away, half of that, and none
    let source = "G0 X50. Z2.\nG73 U4. W2. R3\nG73 P10 Q20 U1. W.5 F.3\nN10 G0 X20.\nN20 G1 Z-10. F.1\nG0 X60.\nM30\n";
    assert_eq!(
        lines(A, source),
        [
            "R X25 Z2",
            "R X29.5 Z4.5",
            "R X14.5 Z4.5",
            "L X14.5 Z-7.5 F0.3/rev",
            "R X27.5 Z3.5",
            "R X12.5 Z3.5",
            "L X12.5 Z-8.5 F0.3/rev",
            "R X25.5 Z2.5",
            "R X10.5 Z2.5",
            "L X10.5 Z-9.5 F0.3/rev",
            "R X25 Z2",
            "R X30 Z2",
        ]
    );
    assert_eq!(faults(A, source), [""; 0]);
    // arcs are moved with their centre
    let source = "G0 X50. Z2. Y0.\nG73 U4. W2. R2\nG73 P10 Q20 F.3\nN10 G0 X20.\nN20 G3 X24. Z0. R2.\nM30\n";
    let (_, log) = run_bytes(A, source.as_bytes(), &Setup::default());
    let arcs = log.motions.iter().filter_map(|motion| match motion.kind {
        MotionKind::Arc(Some(arc)) => Some((arc, motion.start, motion.end)),
        _ => None,
    });
    let arcs: Vec<_> = arcs.collect();
    assert_eq!(arcs.len(), 2);
    for (arc, start, end) in arcs {
        assert!((arc.start - start.xyz().unwrap()).norm() < 1e-12 && (arc.end - end.xyz().unwrap()).norm() < 1e-12);
        assert!(((arc.centre - arc.start).norm() - 2.0).abs() < 1e-9);
    }
}

#[test]
fn grooves_are_pecked() {
    // from radius 15 to 10 in steps of 2 with a lift of 1; from Z-5 to Z-9 aside by 3, then by what is left
    let source = "G0 X30. Z-5.\nG75 R1.\nG75 X20. Z-9. P2000 Q3000 F.1\nM30\n";
    let mut want = vec!["R X15 Z-5".to_owned()];
    for (z, next) in [("-5", "-8"), ("-8", "-9"), ("-9", "-5")] {
        for (kind, x) in [("L", 13), ("R", 14), ("L", 11), ("R", 12), ("L", 10), ("R", 15)] {
            let feed = if kind == "L" { " F0.1/rev" } else { "" };
            want.push(format!("{kind} X{x} Z{z}{feed}"));
        }
        want.push(format!("R X15 Z{next}"));
    }
    assert_eq!(lines(A, source), want);
    assert_eq!(faults(A, source), [""; 0]);
    // system C calls it G77
    let c = source.replace("G75", "G77").replace("G0 X30.", "G90 G0 X30.");
    assert_eq!(lines("fanuc-30i-lathe-c", &c), want);
}

#[test]
fn faces_are_pecked() {
    let source = "G0 X0. Z2.\nG74 R.5\nG74 Z-7. Q4000 F.1\nM30\n";
    let want = [
        "R X0 Z2",
        "L X0 Z-2 F0.1/rev",
        "R X0 Z-1.5",
        "L X0 Z-6 F0.1/rev",
        "R X0 Z-5.5",
        "L X0 Z-7 F0.1/rev",
        "R X0 Z2",
    ];
    assert_eq!(lines(A, source), want);
    // the lift is a parameter's: the depths are known, how far the tool goes back is not
    let got = lines(A, "G0 X0. Z2.\nG74 Z-7. Q4000 F.1\nM30\n");
    assert_eq!(got[1..4], ["L X0 Z-2 F0.1/rev", "R X0", "L X0 Z-6 F0.1/rev"]);
    // a relief at the bottom, and a sideways move without a step
    for block in ["G74 X-4. Z-7. P1000 Q4000 R.2 F.1", "G74 X-4. Z-7. Q4000 F.1"] {
        let source = format!("G0 X0. Z2.\n{block}\nG0 X1.\nM30\n");
        assert_eq!(lines(A, &source), ["R X0 Z2", "U X0 Z2", "R X0.5 Z2"], "{block}");
        assert_eq!(faults(A, &source).len(), 1, "{block}");
    }
}

#[test]
fn threads_whose_lead_changes() {
    let got = lines(A, "G0 X30. Z5.\nG34 Z-20. F2. K.1\nG0 X40.\n");
    assert_eq!(got, ["R X15 Z5", "L X15 Z-20", "R X20 Z-20"]);
}

#[test]
fn a_skip_ends_nobody_knows_where() {
    let source = "G0 X1. Y2. Z3.\nG31 Z-5. F9.\nG0 X4.\n";
    assert_eq!(lines("fanuc-30i", source), ["R X1 Y2 Z3", "U X1 Y2", "R X4 Y2"]);
    assert!(faults("fanuc-30i", source)[0].contains("G31: the position at which the skip signal ends the motion"));
}

#[test]
fn contours_that_cannot_be_known() {
    let missing = faults(A, &format!("G0 X50. Z2.\nG70 P10 Q99\nM30\n{CONTOUR}"));
    assert!(
        missing[0].contains("block N99 does not exist") && missing[0].contains("PS0063"),
        "{missing:?}"
    );
    let none = faults(A, "G0 X50. Z2.\nG70\nM30\n");
    assert!(none[0].contains("G70 without P and Q"), "{none:?}");
    // a condition inside: what runs is not followed; what comes after it is run once
    let source = "G0 X50. Z2.\nG71 U2. R1.\nG71 P10 Q20 F.3\nN10 G0 X20.\nIF[#500GT1.]GOTO20\nG1 Z-10.\nN20 X40.\nG0 X60. Z9.\nM30\n";
    let got = lines(A, source);
    assert_eq!(got, ["R X25 Z2", "U -", "R X30 Z9"]);
    assert!(faults(A, source).iter().any(|fault| fault.contains("contour of G71: ")));
}

#[test]
fn a_spindle_limit_is_no_speed() {
    let (_, log) = run_bytes(
        A,
        b"G97 S500 M3\nG50 S2000\nG0 X10. Z0.\nG96 S200\nG1 Z-5. F.1\nM30\n",
        &Setup::default(),
    );
    assert_eq!(log.motions[0].spindle_rpm, Some(500.0));
    let state = log.state.expect("blocks ran");
    assert_eq!(
        (state.spindle.surface_speed(), state.spindle.limit_rpm()),
        (true, Some(2000.0))
    );
    assert_eq!(line(&log.motions[1]), "L X5 Z-5 F0.1/rev");
}

/// F and S of the contour are those of finishing.
#[test]
fn patterns_and_cuts_run_at_the_speed_of_the_cycle() {
    for cycle in ["G73 U4. W2. R2\nG73", "G71 U2. R0.\nG71"] {
        let source =
            format!("G97 S500 M3\nG0 X50. Z2.\n{cycle} P10 Q20 F.3\nN10 G0 X20. S900\nG1 Z-10. F.1\nN20 X50.\nM30\n");
        let (_, log) = run_bytes(A, source.as_bytes(), &Setup::default());
        assert!(log.motions.len() > 5 && log.motions.iter().all(|motion| motion.spindle_rpm == Some(500.0)));
        assert!(
            log.motions.iter().all(|motion| !line(motion).contains("F0.1")),
            "{cycle}"
        );
    }
}

/// An unknown allowance or relief is not 0.
#[test]
fn patterns_with_unknown_lengths_are_unknown() {
    for (first, second) in [
        ("U#500 W2.", "U1. W.5"),
        ("U4. W2.", "U#500 W.5"),
        ("U4. W2.", "U1. W#500"),
    ] {
        let source = format!("G0 X50. Z2.\nG73 {first} R3\nG73 P10 Q20 {second} F.3\n{CONTOUR}M30\n");
        assert_eq!(lines(A, &source), ["R X25 Z2", "U X25 Z2"], "{first} {second}");
        let told = faults(A, &source);
        assert!(
            told.iter()
                .any(|told| told.contains("NotModelled") && told.contains("G73")),
            "{told:?}"
        );
    }
}

/// An unknown programmed lift is not the one before; R500 is half a millimetre where numbers without a decimal point count increments.
#[test]
fn the_lift_of_a_groove() {
    let control = trunnion_interp::ControlData {
        implicit_decimals: Some(trunnion_interp::ImplicitDecimals::LeastIncrement),
        ..Default::default()
    };
    let setup = Setup {
        control,
        ..Setup::default()
    };
    for (first, want) in [("R500", "R X0 Z-1.5"), ("R.5\nG74 R#500", "R X0")] {
        let source = format!("G0 X0. Z2.\nG74 {first}\nG74 Z-7. Q4000 F.1\nM30\n");
        let (_, log) = run_bytes(A, source.as_bytes(), &setup);
        assert_eq!(line(&log.motions[2]), want);
    }
}

/// U and W are coordinates too.
#[test]
fn increments_without_a_point_are_told() {
    let told = faults(A, "G0 X10. Z0.\nG1 U10 F.1\nM30\n");
    assert!(told.len() == 1 && told[0].contains("AmbiguousDecimal"), "{told:?}");
}

/// No number of steps of 0 reaches the end.
#[test]
fn a_groove_in_steps_of_nothing_is_refused() {
    for source in ["G0 X10. Z2.\nG74 Z-1. Q0.\nM30\n", "G0 X10. Z2.\nG75 X4. P0.\nM30\n"] {
        let (program, log) = run_bytes(A, source.as_bytes(), &Setup::default());
        let said: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
        assert!(said.iter().any(|said| said.contains("a step of 0")), "{said:?}");
        assert!(log.motions.len() < 4, "{}", log.motions.len());
    }
}
