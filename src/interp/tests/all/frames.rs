//! Shifted, turned, scaled, mirrored and polar coordinates; returns to reference points; offsets written by the program.
use crate::support::{faults, line, lines, run_bytes, run_text};
use trunnion_interp::{ControlData, ImplicitDecimals, Position, Setup, Tool};

fn zeros(source: &str) -> Vec<(String, [f64; 3])> {
    let log = run_text("fanuc-30i", source);
    let zero = |m: &trunnion_interp::Motion| [m.zero[0], m.zero[1], m.zero[2]];
    log.motions.iter().map(|m| (line(m), zero(m))).collect()
}

#[test]
fn a_local_shift_moves_the_zero_point() {
    // the machine is at 10, 20: with G52 X5 that is programmed X5
    let got = zeros("G0 X10. Y20. Z1.\nG52 X5.\nG0 Y0.\nX0.\nG52 X0.\nX0.\n");
    let want = [
        ("R X10 Y20 Z1", [0.0; 3]),
        ("R X5 Y0 Z1", [5.0, 0.0, 0.0]),
        ("R X0 Y0 Z1", [5.0, 0.0, 0.0]),
        ("R X0 Y0 Z1", [0.0; 3]),
    ];
    let want: Vec<_> = want.iter().map(|(line, zero)| ((*line).to_owned(), *zero)).collect();
    assert_eq!(got, want);
}

#[test]
fn setting_the_position_shifts_all_offsets() {
    // at 10 the point is called 2: the zero is at 8, in G55 too, until G92.1
    let got = zeros("G0 X10. Y20. Z1.\nG92 X2. Y20.\nG0 X3.\nG55 X0.\nG92.1\nX1.\n");
    assert_eq!(got[1], ("R X3 Y20 Z1".to_owned(), [8.0, 0.0, 0.0]));
    assert_eq!(got[2], ("R X0 Y20 Z1".to_owned(), [8.0, 0.0, 0.0]));
    assert_eq!(got[3], ("R X1 Y20 Z1".to_owned(), [0.0; 3]));
    // a point that is unknown cannot be named
    assert_eq!(
        faults("fanuc-30i", "G92 X0.\nG0 X1.\n"),
        [r#"1: G92: NotModelled { what: "G92" }"#]
    );
    assert_eq!(lines("fanuc-30i", "G92 X0.\nG0 X1.\n"), ["R -"]);
    // with S alone it limits the speed
    assert_eq!(faults("fanuc-30i", "G92 S2000\n"), [""; 0]);
}

#[test]
fn offsets_written_by_the_program() {
    // G54 becomes 100, then 2 more by G91; P0 moves all of them by 1
    let source = "G90 G10 L2 P1 X100. Y0. Z0.\nG54 G0 X0. Y0. Z0.\nG91 G10 L2 P1 X2.\nG90 G0 X0.\nG10 L2 P0 X1.\nX0.\n";
    let got: Vec<_> = zeros(source).into_iter().map(|(_, zero)| zero[0]).collect();
    assert_eq!(got, [100.0, 102.0, 103.0]);
    assert_eq!(faults("fanuc-30i", source), [""; 0], "a written offset is declared");
    let more = "G10 L20 P3 X7.\nG54.1 P3\nG0 X0.\n";
    assert_eq!(zeros(more)[0].1[0], 7.0);
    assert_eq!(faults("fanuc-30i", more), [""; 0]);
    let wrong = faults("fanuc-30i", "G10 L2 P9 X1.\n");
    assert!(wrong[0].contains("PS0031"), "{wrong:?}");
    // parameters until G11 are no words of motions
    assert_eq!(
        lines("fanuc-30i", "G0 X1.\nG10 L52\nN1410 R5000\nG11\nG0 X2.\n")[0],
        "R X1"
    );
    let entered = run_text("fanuc-30i", "G0 X1.\nG10 L52\nN1410 P1 X5.\nG11\nG0 X2.\n");
    assert_eq!(entered.motions.len(), 2);
}

#[test]
fn tool_lengths_written_by_the_program() {
    // length 50 and wear 0.5: Z of the tip
    let log = run_text(
        "fanuc-30i",
        "G10 L10 P5 R50.\nG10 L11 P5 R0.5\nG0 X0. Y0.\nG43 H5 Z10.\n",
    );
    assert_eq!(log.motions[1].tool_length_mm, 50.5);
}

#[test]
fn a_turned_plane() {
    // 30 deg about X10 Y0: (20, 0) is at 10 + 10 cos 30 = 18.660254, 10 sin 30 = 5
    let source = "G0 X0. Y0. Z1.\nG68 X10. Y0. R30.\nX20. Y0.\nG91 X10.\nG90 G69\nX1. Y2.\n";
    assert_eq!(
        lines("fanuc-30i", source),
        ["R X0 Y0 Z1", "R X18.660254 Y5 Z1", "R X27.320508 Y10 Z1", "R X1 Y2 Z1"]
    );
    // quarter turns are exact, and arcs turn with the plane: about (5, 0) in the words, (0, 5) in the work
    let source = "G0 X0. Y0. Z1.\nG68 X0. Y0. R90.\nG1 X10. Y0. F100.\nG3 X0. Y0. I-5. J0.\n";
    let log = run_text("fanuc-30i", source);
    assert_eq!(log.motions[1].end.values[..2], [0.0, 10.0]);
    assert_eq!(line(&log.motions[2]), "A(0 5 1; 180) X0 Y0 Z1 F100");
    // with one coordinate after G68 a parameter decides about the other
    assert_eq!(
        lines("fanuc-30i", "G0 X5. Y5. Z1.\nG68 X0. Y0. R90.\nX1.\nY1.\n"),
        ["R X5 Y5 Z1", "R Z1", "R X-1 Y1 Z1"]
    );
    // the first motion after G69 must be absolute
    assert_eq!(
        lines("fanuc-30i", "G0 X5. Y5. Z1.\nG68 X0. Y0. R90.\nX1. Y1.\nG69\nG91 X1.\n"),
        ["R X5 Y5 Z1", "R X-1 Y1 Z1", "R Y1 Z1"]
    );
    assert_eq!(
        faults("fanuc-30i", "G0 X5. Y5.\nG68 X0. Y0.\n"),
        [r#"2: G68: NotModelled { what: "G68" }"#],
        "without R a parameter gives the angle"
    );
}

#[test]
fn scaled_coordinates() {
    // factor 2 about X10: 20 is at 30
    let source = "G0 X0. Y0. Z0.\nG51 X10. Y0. Z0. P2.\nX20. Y5.\nG2 X30. R5. F100.\nG50\nG0 X0. Y0.\n";
    assert_eq!(
        lines("fanuc-30i", source),
        [
            "R X0 Y0 Z0",
            "R X30 Y10 Z0",
            "A(40 10 0; -180) X50 Y10 Z0 F100",
            "R X0 Y0 Z0"
        ]
    );
    // the unit of a whole number is a parameter on a Fanuc, and the factor itself on a Haas
    assert_eq!(
        faults("fanuc-30i", "G0 X0. Y0. Z0.\nG51 X0. Y0. Z0. P2000\n"),
        [r#"2: G51: NotModelled { what: "G51" }"#]
    );
    assert_eq!(
        lines("haas-ngc", "G0 X0. Y0. Z0.\nG51 X0. Y0. Z0. P3\nX2.\n")[1],
        "R X6 Y0 Z0"
    );
    // different factors make no arc of an arc; negative ones mirror
    let uneven = "G0 X0. Y0. Z0.\nG51 X0. Y0. Z0. I2. J-1. K1.\nG1 X3. Y4. F100.\nG2 X5. R1.\n";
    assert_eq!(
        lines("fanuc-30i", uneven)[1..],
        ["L X6 Y-4 Z0 F100", "A? X10 Y-4 Z0 F100"]
    );
}

#[test]
fn mirrored_coordinates() {
    // about X50: 60 is at 40; a clockwise arc turns counter-clockwise
    let source = "G0 X50. Y0. Z0.\nG51.1 X50.\nG1 X60. Y0. F100.\nG2 X70. Y10. R10.\nG50.1 X0.\nG1 X1. Y1.\n";
    assert_eq!(
        lines("fanuc-30i", source),
        [
            "R X50 Y0 Z0",
            "L X40 Y0 Z0 F100",
            "A(30 0 0; 90) X30 Y10 Z0 F100",
            "L X1 Y1 Z0 F100"
        ]
    );
    assert_eq!(
        lines("haas-ngc", "G0 X1. Y2. Z0.\nG101 X0.\nX3.\nG100 X0.\nX3.\n")[1..],
        ["R X-3 Y2 Z0", "R X3 Y2 Z0"]
    );
}

#[test]
fn polar_coordinates() {
    // radius 100 at 30, then 150 deg: cos 30 = 0.8660254
    let source =
        "G0 X0. Y0. Z20.\nG90 G17 G16\nG99 G81 X100. Y30. Z-20. R-5. F200.\nY150.\nG91 Y120.\nG90 G15 G80\nX1. Y1.\n";
    let got: Vec<_> = lines("fanuc-30i", source)
        .into_iter()
        .filter(|line| line.contains("Z-20"))
        .collect();
    assert_eq!(
        got,
        [
            "L X86.60254 Y50 Z-20 F200",
            "L X-86.60254 Y50 Z-20 F200",
            "L X0 Y-100 Z-20 F200"
        ]
    );
    // one of the two alone, while the other was never given
    assert_eq!(
        lines("fanuc-30i", "G0 X5. Y5. Z1.\nG16\nX10.\nY90.\n")[1..],
        ["R Z1", "R X0 Y10 Z1"]
    );
}

#[test]
fn frames_hold_for_cycles() {
    // turned by 90 deg: the hole at (10, 0) is at (0, 10)
    let source = "G0 X0. Y0. Z9.\nG68 X0. Y0. R90.\nG99 G81 X10. Y0. Z-3. R1. F100.\n";
    assert_eq!(
        lines("fanuc-30i", source)[1..],
        ["R X0 Y10 Z9", "R X0 Y10 Z1", "L X0 Y10 Z-3 F100", "R X0 Y10 Z1"]
    );
}

#[test]
fn returns_to_reference_points() {
    let mut point = Position::default();
    for (axis, value) in [(0, -500.0), (1, -400.0), (2, 0.0)] {
        point.set(axis, value);
    }
    let setup = Setup {
        control: ControlData {
            reference_points: vec![point],
            ..ControlData::default()
        },
        ..Setup::default()
    };
    let source = b"G0 X1. Y2. Z3.\nG91 G28 Z0.\nG28 X0. Y5.\nG90 G29 X7. Y8.\nM30\n";
    let log = run_bytes("fanuc-30i", source, &setup).1;
    let got: Vec<_> = log.motions.iter().map(line).collect();
    assert_eq!(
        got,
        [
            "R X1 Y2 Z3",
            "R X1 Y2 Z0 machine",
            "R X1 Y7 Z0",
            "R X-500 Y-400 Z0 machine",
            "R X1 Y7 Z0",
            "R X7 Y8 Z0",
        ]
    );
    // not declared: unknown on the named axes only, reported once
    let source = "G0 X1. Y2. Z3.\nG91 G28 Z0.\nG28 X0.\n";
    assert_eq!(lines("fanuc-30i", source), ["R X1 Y2 Z3", "U X1 Y2", "U Y2"]);
    assert_eq!(
        faults("fanuc-30i", source),
        [r#"2: G28: NotModelled { what: "reference point 1: its position is not declared" }"#]
    );
    // without coordinates a Haas returns all axes, a Fanuc none
    assert_eq!(lines("haas-ngc", "G0 X1. Y2. Z3.\nG28\n"), ["R X1 Y2 Z3", "U -"]);
    assert_eq!(lines("fanuc-30i", "G0 X1. Y2. Z3.\nG28\n"), ["R X1 Y2 Z3"]);
}

fn with_decimals(decimals: ImplicitDecimals) -> Setup {
    Setup {
        control: ControlData {
            implicit_decimals: Some(decimals),
            ..ControlData::default()
        },
        ..Setup::default()
    }
}

#[test]
fn numbers_without_a_point() {
    let run = |source: &str, decimals| {
        let log = run_bytes("fanuc-30i", source.as_bytes(), &with_decimals(decimals)).1;
        let lines: Vec<_> = log.motions.iter().map(line).collect();
        assert_eq!(log.faults, [], "the rule is silent where the setting is known");
        lines
    };
    let source =
        "G0 X10 Y1. Z1500\nG1 X20. Y30 C90000 F100\nG2 X30000 Y30 I4990 J0\nG4 P500\nG4 X2500\nG20 G0 X10000\nM30\n";
    assert_eq!(
        run(source, ImplicitDecimals::LeastIncrement)[..2],
        ["R X0.01 Y1 Z1.5", "L X20 Y0.03 Z1.5 C90 F100"]
    );
    let rest = run(source, ImplicitDecimals::LeastIncrement);
    assert_eq!(
        rest[3..],
        [
            "D0.5 X30 Y0.03 Z1.5 C90",
            "D2.5 X30 Y0.03 Z1.5 C90",
            "R X25.4 Y0.03 Z1.5 C90"
        ]
    );
    let drill = "G0 X0 Y0 Z10000\nG99 G83 Z-6000 R1000 Q4000 F50\nM30\n";
    let got = run(drill, ImplicitDecimals::LeastIncrement);
    assert_eq!((got[1].as_str(), got[2].as_str()), ("R X0 Y0 Z1", "L X0 Y0 Z-3 F50"));
    assert_eq!(
        run("G0 X10 Y1. Z1500\nG1 X20 F100\nM30\n", ImplicitDecimals::Calculator),
        ["R X10 Y1 Z1500", "L X20 Y1 Z1500 F100"]
    );
}

#[test]
fn a_tool_word_of_a_lathe_holds_its_offset() {
    let setup = Setup {
        tools: vec![Tool {
            number: 3,
            shape: None,
            diameter_mm: Some(0.8),
            length_mm: None,
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let log = run_bytes("fanuc-30i-lathe-a", b"T0313\nG0 X10. Z1.\nM30\n", &setup).1;
    assert_eq!(log.motions[0].tool, Some(3));
}

fn not_followed(dialect: &str, source: &str) -> bool {
    faults(dialect, source)
        .iter()
        .any(|fault| fault.contains("NotModelled"))
}

/// The steps of pecks keep their size, the levels do not (Fanuc), or may not (Haas).
#[test]
fn drilling_in_scaled_coordinates() {
    let drill = |scale: &str, cycle: &str| {
        format!("G0 X0 Y0 Z50.\nG51 X0 Y0 Z0 {scale}\n{cycle} X10. Y0 Z-5. R2. Q2. F50.\nG80\nG50\n")
    };
    for (dialect, scale, cycle, open) in [
        ("fanuc-30i", "I2. J2. K2.", "G83", true),
        ("fanuc-30i", "I2. J2. K.5", "G73", true),
        ("fanuc-30i", "I2. J2. K2.", "G76", true),
        ("fanuc-30i", "I2. J2. K2.", "G81", false),
        ("fanuc-30i", "I1. J1. K1.", "G83", false),
        ("haas-ngc", "P2.", "G83", true),
        ("haas-ngc", "P2.", "G81", true),
    ] {
        let source = drill(scale, cycle);
        let told = faults(dialect, &source);
        let found = told.iter().any(|fault| fault.contains("in scaled coordinates"));
        assert_eq!(found, open, "{dialect} {scale} {cycle}: {told:?}");
    }
}

/// Whether a negative factor of G51 turns the angle of G68 about is not in the manual.
#[test]
fn an_angle_in_coordinates_that_a_factor_mirrors() {
    let turn =
        |scale: &str| format!("G0 X0 Y0 Z50.\nG51 X0 Y0 Z0 {scale}\nG68 X5. Y0 R90.\nG1 X10. Y5. F100.\nG69\nG50\n");
    assert!(not_followed("fanuc-30i", &turn("I-1. J1. K1.")));
    assert!(not_followed("fanuc-30i", &turn("I-1. J-1. K-1.")));
    assert!(!not_followed("fanuc-30i", &turn("I2. J2. K2.")));
}

/// What a Fanuc does not allow while coordinates are turned, scaled or mirrored is no passing program.
#[test]
fn other_systems_while_coordinates_are_turned() {
    for (begin, end) in [
        ("G68 X0 Y0 R90.", "G69"),
        ("G51 X0 Y0 Z0 I2. J2. K2.", "G50"),
        ("G51.1 X0", "G50.1 X0"),
    ] {
        for code in ["G55", "G53 G0 Z0", "G27 X0", "G28 Z60."] {
            let inside = format!("G0 X1. Y1. Z50.\n{begin}\n{code}\n{end}\n");
            let told = faults("fanuc-30i", &inside);
            assert!(
                told.iter().any(|fault| fault.contains("does not allow")),
                "{inside}: {told:?}"
            );
            for outside in [
                format!("G0 X1. Y1. Z50.\n{code}\n{begin}\n{end}\n"),
                format!("G0 X1. Y1. Z50.\n{begin}\n{end}\n{code}\n"),
            ] {
                let told = faults("fanuc-30i", &outside);
                assert!(
                    !told.iter().any(|fault| fault.contains("does not allow")),
                    "{outside}: {told:?}"
                );
            }
        }
    }
    let plane = |code: &str| faults("fanuc-30i", &format!("G0 X1. Y1. Z50.\nG68 X0 Y0 R90.\n{code}\nG69\n"));
    assert!(plane("G18").iter().any(|fault| fault.contains("does not allow")));
}

/// Without axis words grbl goes straight to the stored position (gcode.c).
#[test]
fn a_return_of_grbl_moves_all_axes() {
    let mut point = Position::default();
    for (axis, value) in [500.0, 300.0, 200.0].into_iter().enumerate() {
        point.set(axis, value);
    }
    let mut setup = Setup::default();
    setup.control.reference_points = vec![point, point];
    setup.work_offsets = vec![trunnion_interp::WorkOffset {
        name: "G54".into(),
        values: [0.0; 9],
    }];
    let run = |source: &str| -> Vec<String> {
        let log = run_bytes("grbl", source.as_bytes(), &setup).1;
        log.motions.iter().map(line).collect()
    };
    let got = run("G21 G90 G94 G17\nG0 X10 Y10 Z5\nG28\nG1 X20 F100\nM2\n");
    assert_eq!(
        got[1..3],
        ["R X500 Y300 Z200 machine", "L X20 Y300 Z200 F100"],
        "{got:?}"
    );
    let got = run("G21 G90 G94 G17\nG0 X10 Y10 Z5\nG28.1\nX20\nG30\nG28\nM2\n");
    assert_eq!(got.last().map(String::as_str), Some("R X10 Y10 Z5 machine"), "{got:?}");
}
