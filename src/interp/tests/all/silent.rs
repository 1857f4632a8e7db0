//! What a block says and a run could pass over: words that nothing reads, codes that give coordinates another meaning, words that are modal.
use crate::support::{faults, line, lines, run_bytes};
use trunnion_interp::{ControlData, LengthUnit, Setup, Tool};

fn unused(dialect: &str, source: &str) -> Vec<String> {
    let found = faults(dialect, source);
    let found = found.into_iter().filter(|fault| fault.contains("Unused"));
    found
        .map(|fault| fault.split(':').nth(1).unwrap_or_default().trim().to_owned())
        .collect()
}

#[test]
fn words_that_nothing_reads() {
    for (dialect, source, want) in [
        ("fanuc-30i", "G1 X1. R5. F9.\n", &["R5."][..]),
        ("fanuc-30i", "G4 P100 Q1 L2\n", &["Q1", "L2"]),
        ("fanuc-30i", "G0 X1. E2.\n", &["E2."]),
        ("fanuc-30i", "G18 G2 X5. Z0. I2.5 J1. F9.\n", &["J1."]),
        ("haas-ngc", "G2 X5. Y0. I2.5 L2 F9.\n", &["L2"]),
        ("fanuc-30i", "G0 X#1 R#2\n", &[]),
        ("fanuc-30i", "G31 Z-5. P2 F9.\n", &[]),
        ("fanuc-30i", "M777 P5 Q3\n", &[]),
        ("fanuc-30i", "M98 P100 Q5\nM30\nO100\nM99\n", &["Q5"]),
        ("fanuc-30i-lathe-a", "G0 X9. Z1.\nG90 X8. Z-5. R-1. F.1\nR-2.\n", &[]),
        ("fanuc-30i-lathe-a", "G1 Z-5. R1. F.1\nX9.\n", &[]),
        ("fanuc-30i-lathe-a", "G0 Z-5. R1.\n", &["R1."]),
        ("grbl", "G1 X5 P1 F9\n", &["P1"]),
        ("grbl", "G2 X5 Y0 I2.5 K1 F9\n", &["K1"]),
        ("grbl", "G10 L20 P1 X0\nG4 P1\n", &[]),
        ("iso-6983", "G0 X1 D4\n", &["D4"]),
        // an output of a plasma torch
        ("iso-6983", "M11 P1\n", &[]),
        ("grbl", "M8 P1\n", &["P1"]),
    ] {
        assert_eq!(unused(dialect, source), want, "{dialect}: {source}");
    }
}

#[test]
fn commands_and_arcs_of_grbl() {
    for (source, want) in [
        ("$X\n$$\nG0 X1 Y2 Z3\n", &[][..]),
        (
            "G0 X1 Y2 Z3\n$H\n",
            &["$H: homing, which leaves the axes at their switches"],
        ),
        ("$J=G91 X5 F500\n", &["$J=G91 X5 F500: jogging"]),
        ("$32=1\n", &["$32=1: a setting of the control"]),
        ("$C\n", &["$C: the check mode, in which grbl moves nothing"]),
    ] {
        let found = faults("grbl", source);
        let found: Vec<&str> = found.iter().filter_map(|fault| fault.split('"').nth(1)).collect();
        assert_eq!(found, want, "{source}");
    }
    assert_eq!(lines("grbl", "G0 X1 Y2 Z3\n$H\nG0 X5\n"), ["R X1 Y2 Z3", "R X5"]);
    assert_eq!(lines("grbl", "G0 X1 Y2 Z3\n \t$H\nG0 X5\n"), ["R X1 Y2 Z3", "R X5"]);
    // an arc needs a word of its plane there; Fanuc runs a full circle
    let circle = "G90 G21 G94 G17\nG0 X10 Y0 Z0\nG2 I-5 J0 F100\nG18 G2 Y1 I-5 K0\nG17 G2 X10 I-5 J0\nM2\n";
    let found = faults("grbl", circle);
    let refused: Vec<&str> = found.iter().filter_map(|fault| fault.split('"').nth(1)).collect();
    assert_eq!(
        refused,
        [
            "the arc has no end point: name X or Y, for a full circle with the coordinates of its start",
            "the arc has no end point: name Z or X, for a full circle with the coordinates of its start",
        ]
    );
    assert!(found[0].contains("error:26"), "{found:?}");
    let fanuc = circle
        .replace("G18 G2 Y1 I-5 K0\n", "")
        .replace("I-5", "I-5.")
        .replace("X10", "X10.");
    assert_eq!(
        faults("fanuc-30i", &fanuc).len(),
        0,
        "{:?}",
        faults("fanuc-30i", &fanuc)
    );
}

#[test]
fn coordinates_of_another_meaning_are_unknown_until_it_ends() {
    // polar and cylindrical interpolation: C is a length there
    for (on, off) in [("G12.1", "G13.1"), ("G7.1 C50.", "G7.1 C0."), ("G107 C50.", "G107 C0.")] {
        let source = format!("G0 X1. Y2. Z3. C4.\n{on}\nG1 X5. C6. F9.\n{off}\nG0 X7. Z8. C9.\n");
        let got = lines("fanuc-30i", &source);
        assert_eq!(got[1..], ["L - F9".to_owned(), "R X7 Z8 C9".to_owned()], "{on}");
    }
    // mirror image of a double turret
    let got = lines("fanuc-30i-lathe-a", "G0 X2. Z3.\nG68\nG0 X4. Z5.\nG69\nX6. Z7.\n");
    assert_eq!(got, ["R X1 Z3", "R -", "R X3 Z7"]);
}

#[test]
fn what_a_macro_in_each_block_does_is_unknown() {
    let source = "G0 X1. Y2. Z3.\nG66.1 P9000\nX5. Y6.\nG67\nG0 X7. Y8. Z9.\nM30\n";
    assert_eq!(lines("fanuc-30i", source), ["R X1 Y2 Z3", "R -", "R X7 Y8 Z9"]);
}

#[test]
fn diameters_can_be_switched() {
    let got = lines("fanuc-30i-lathe-a", "G0 X10. Z0.\nG10.9 X0\nX10.\nG10.9 X1\nX10.\n");
    assert_eq!(got, ["R X5 Z0", "R X10 Z0", "R X5 Z0"]);
}

#[test]
fn a_lathe_begins_in_its_plane() {
    // centre form in Z X: from radius 10 at Z0 about (Z0, radius 15)
    let got = lines("fanuc-30i-lathe-a", "G0 X20. Z0. Y0.\nG2 X30. Z-5. I5. K0. F.1\n");
    assert_eq!(got[1], "A(15 0 0; -90) X15 Y0 Z-5 F0.1/rev");
}

#[test]
fn corners_of_a_lathe() {
    // R2 rounds the corner at radius 10, Z-20: tangent points 2 mm before and after; K1 cuts the next one off
    let got = lines(
        "fanuc-30i-lathe-a",
        "G0 X20. Y0. Z0.\nG1 Z-20. R2. F.1\nX40. K-1.\nZ-40.\n",
    );
    assert_eq!(
        got[1..],
        [
            "L X10 Y0 Z-18 F0.1/rev",
            "A(12 0 -18; -90) X12 Y0 Z-20 F0.1/rev",
            "L X19 Y0 Z-20 F0.1/rev",
            "L X20 Y0 Z-21 F0.1/rev",
            "L X20 Y0 Z-40 F0.1/rev",
        ]
    );
}

#[test]
fn a_lathe_without_y_has_corners_too() {
    let source = "G0 X20. Z0.\nG1 Z-20. R2. F.1\nX40.\n";
    assert_eq!(
        lines("fanuc-30i-lathe-a", source)[1..],
        [
            "L X10 Z-18 F0.1/rev",
            "A(12 0 -18; -90) X12 Z-20 F0.1/rev",
            "L X20 Z-20 F0.1/rev"
        ]
    );
    assert_eq!(faults("fanuc-30i-lathe-a", source), [""; 0]);
    // what is unknown is no mistake
    let unknown = faults("fanuc-30i-lathe-a", "G1 Z-20. R2. F.1\nX40.\n");
    assert!(unknown.len() == 1 && unknown[0].contains("NotModelled"), "{unknown:?}");
}

#[test]
fn h_and_d_are_modal() {
    let tool = |number: u32, length: f64| Tool {
        number,
        shape: None,
        diameter_mm: Some(10.0),
        length_mm: Some(length),
        holder_mm: None,
    };
    let setup = Setup {
        tools: vec![tool(1, 100.0), tool(2, 150.0)],
        ..Setup::default()
    };
    // H2 alone changes the length in effect: the same place is 50 mm lower in the words
    let source = "G43 H1\nG0 Z200.\nH2\nG91 Z0.\nM30\n";
    let log = crate::length_change::run_with("fanuc-30i", crate::length_change::SHIFTS, source, &setup);
    assert_eq!(log.motions.iter().map(line).collect::<Vec<_>>(), ["R Z200", "R Z150"]);
    assert_eq!(log.motions[1].tool_length_mm, 150.0);
    // H before G43, D before G41
    let (_, log) = run_bytes("fanuc-30i", b"H2\nG43\nG0 Z9.\nM30\n", &setup);
    assert_eq!(log.motions[0].tool_length_mm, 150.0);
    let (_, log) = run_bytes(
        "fanuc-30i",
        b"D1\nG0 X0. Y0. Z0.\nG41 G1 X10. F9.\nY10.\nG40 X0.\nM30\n",
        &setup,
    );
    assert!(log.faults.is_empty(), "{:?}", log.faults);
    assert_eq!(line(&log.motions[2]), "L X5 Y10 Z0 F9");
}

#[test]
fn axes_beside_a_dwell() {
    // grbl dwells and then moves; elsewhere it is undocumented
    assert_eq!(lines("grbl", "G1 X1 F9\nG4 P0.5 X5\n")[1..], ["D0.5 X1", "L X5 F9"]);
    assert_eq!(
        lines("fanuc-30i", "G0 X1. Y2.\nG4 P500 X5.\n")[1..],
        ["D0.5 X1 Y2", "U Y2"]
    );
    assert_eq!(lines("fanuc-30i", "G0 X1. Y2.\nG4 X5.\n")[1..], ["D5 X1 Y2"]);
}

#[test]
fn spirals_are_not_arcs() {
    let source = "G0 X0. Y0. Z0.\nG2 X20. Y0. I5. Q2. F9.\n";
    assert_eq!(lines("fanuc-30i", source)[1], "A? X20 Y0 Z0 F9");
    assert!(faults("fanuc-30i", source)[0].contains("spiral"));
}

#[test]
fn reference_points_that_the_program_stores() {
    let got = lines("grbl", "G0 X1 Y2 Z3\nG28.1\nX5 Y6 Z7\nG28 Z9\n");
    assert_eq!(got[2..], ["R X5 Y6 Z9", "R X5 Y6 Z3 machine"]);
}

#[test]
fn units_of_the_setup() {
    let run = |units| {
        let control = ControlData {
            units,
            ..ControlData::default()
        };
        let setup = Setup {
            control,
            ..Setup::default()
        };
        let (_, log) = run_bytes("fanuc-30i", b"G1 X1. F2.\nM30\n", &setup);
        (
            line(&log.motions[0]),
            log.state.is_some_and(|state| state.coordinates.unit_programmed()),
        )
    };
    assert_eq!(run(None), ("L X1 F2".to_owned(), false));
    assert_eq!(run(Some(LengthUnit::Millimetre)), ("L X1 F2".to_owned(), true));
    assert_eq!(run(Some(LengthUnit::Inch)), ("L X25.4 F50.8".to_owned(), true));
}

#[test]
fn variables_of_the_setup() {
    let run = |variables: Vec<(u32, Option<f64>)>, source: &str| {
        let setup = Setup {
            variables,
            ..Setup::default()
        };
        let (program, log) = run_bytes("fanuc-30i", source.as_bytes(), &setup);
        let faults: Vec<_> = log
            .faults
            .iter()
            .map(|fault| crate::support::fault_line(&program, fault))
            .collect();
        (log.motions.iter().map(line).collect::<Vec<_>>(), faults)
    };
    let source = "IF[#500EQ#0]GOTO10\nG0 X#500 Y#1005\nN10 G0 Z#100\n#1005=3\nG0 Y#1005\nM30\n";
    let declared = vec![(100, Some(7.0)), (500, Some(12.5)), (1005, Some(2.0))];
    let (motions, faults) = run(declared, source);
    assert_eq!(motions, ["R X12.5 Y2", "R X12.5 Y2 Z7", "R X12.5 Z7"]);
    assert_eq!(
        faults.len(),
        2,
        "what the program writes to the control is not known: {faults:?}"
    );
    let (motions, _) = run(vec![(100, Some(7.0)), (500, None)], source);
    assert_eq!(motions[0], "R Z7", "vacant: the jump is taken");
    let (motions, faults) = run(Vec::new(), source);
    assert!(motions.is_empty() && faults[0].contains("#500"), "{faults:?}");
}
