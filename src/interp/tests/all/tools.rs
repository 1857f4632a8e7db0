//! Tools: T and M6, lengths by H and D, and what is declared about the tool in use.
use crate::length_change::{SHIFTS, run_with};
use crate::support::{faults, line, run_bytes, run_text};
use trunnion_interp::{LengthUnit, Position, Setup, Tool, ToolShape};

pub(crate) fn tool(number: u32, shape: Option<ToolShape>, diameter_mm: Option<f64>, length_mm: Option<f64>) -> Tool {
    Tool {
        number,
        shape,
        diameter_mm,
        length_mm,
        holder_mm: None,
    }
}

fn setup() -> Setup {
    let tools = vec![
        tool(1, Some(ToolShape::Flat), Some(6.0), Some(100.0)),
        tool(2, Some(ToolShape::Bull(1.0)), Some(8.0), Some(120.0)),
    ];
    Setup {
        tools,
        ..Setup::default()
    }
}

/// Number and length of the tool of each motion.
fn lengths(dialect: &str, source: &str) -> Vec<(Option<u32>, f64)> {
    let (_, log) = run_bytes(dialect, source.as_bytes(), &setup());
    log.motions
        .iter()
        .map(|motion| (motion.tool, motion.tool_length_mm))
        .collect()
}

#[test]
fn t_waits_for_m6() {
    let got = lengths("iso-6983", "T1\nG0 X1\nM6\nX2\nT2\nX3\nM6\nX4\n");
    assert_eq!(got, [(None, 0.0), (Some(1), 0.0), (Some(1), 0.0), (Some(2), 0.0)]);
}

#[test]
fn h_gives_the_length() {
    let got = lengths(
        "fanuc-30i",
        "T1 M6\nG0 G43 H1 Z5\nG43 H2 Z6\nG49 Z7\nG43.4 H1 X1\nG43 H0 Z1\n",
    );
    assert_eq!(
        got.iter().map(|pair| pair.1).collect::<Vec<_>>(),
        [100.0, 120.0, 0.0, 100.0, 0.0]
    );
    assert_eq!(
        lengths("linuxcnc", "T2 M6\nG43 G0 Z5\n"),
        [(Some(2), 120.0)],
        "without H: the tool in the spindle"
    );
}

#[test]
fn a_change_of_length_moves_the_programmed_z() {
    let log = run_with("fanuc-30i", SHIFTS, "G0 X1 Y1 Z300\nG43 H1\nX2\nM30\n", &setup());
    let got: Vec<_> = log.motions.iter().map(line).collect();
    assert_eq!(got, ["R X1 Y1 Z300", "R X2 Y1 Z200"]);
}

/// What is declared is declared in mm, also of a LinuxCNC that keeps its tables in inches; G28 and G30 go to the declared points.
#[test]
fn declared_lengths_are_mm_on_a_machine_that_keeps_inches() {
    for units in [LengthUnit::Millimetre, LengthUnit::Inch] {
        let mut setup = setup();
        setup.control.units = Some(units);
        setup.work_offsets.push(trunnion_interp::WorkOffset {
            name: "G54".into(),
            values: [50.8, 0.0, 25.4, 0.0, 0.0, 30.0, 0.0, 0.0, 0.0],
        });
        let mut points = [Position::default(), Position::default()];
        points[0].set(0, 254.0);
        points[0].set(2, 508.0);
        points[1].set(2, 127.0);
        setup.control.reference_points = points.to_vec();
        for unit in ["G21", "G20"] {
            let program = format!("{unit} T1 M6 G43\nG0 X0 Y0 Z0 C0\nG28 X0 Z0\nG30 Z0\nM2\n");
            let (_, log) = run_bytes("linuxcnc", program.as_bytes(), &setup);
            let got: Vec<_> = log.motions.iter().map(line).collect();
            let (zero, length) = (log.motions[0].zero, log.motions[0].tool_length_mm);
            assert!(
                (zero[0] - 50.8).abs() < 1e-9 && (zero[5] - 30.0).abs() < 1e-9,
                "{zero:?}"
            );
            assert!((length - 100.0).abs() < 1e-9, "{units:?} {unit}: {length}");
            let home = log
                .motions
                .iter()
                .rfind(|motion| motion.end.get(2).is_some_and(|z| z > 300.0));
            let home = home.unwrap_or_else(|| panic!("{got:?}")).end;
            // 254 - 50.8, 508 - 25.4 - 100
            assert!((home.get(0).expect("declared") - 203.2).abs() < 1e-9, "{got:?}");
            assert!((home.get(2).expect("declared") - 382.6).abs() < 1e-9, "{got:?}");
            let second = log.motions.last().expect("some").end.get(2).expect("declared");
            assert!((second - 1.6).abs() < 1e-9, "{got:?}");
        }
    }
}

/// On a mill-turn centre the tool is parallel to X at home, and X words are diameters: 100 mm of length are 200 mm of X word.
#[test]
fn a_change_of_length_moves_the_words_along_the_tool() {
    let mut setup = setup();
    setup.control.length_along = Some([2.0, 0.0, 0.0]);
    let program = "G0 X300 Y1 Z5\nG43 H1\nG0 Z2\nG53 G0 Y2\nG91 X1\nG90 G49\nZ1\nM30\n";
    let log = run_with("fanuc-30i", SHIFTS, program, &setup);
    let got: Vec<_> = log.motions.iter().map(line).collect();
    let want = [
        "R X300 Y1 Z5",
        "R X100 Y1 Z2",
        "R X300 Y2 Z2 machine",
        "R X101 Y2 Z2",
        "R X301 Y2 Z1",
    ];
    assert_eq!(got, want);
}

/// Whether T alone changes tools is machine data of a Sinumerik; where M6 does, its length is not in effect.
#[test]
fn a_tool_that_nothing_brings_is_said() {
    let said = |source: &str| {
        faults("sinumerik-840d", source)
            .concat()
            .contains("that T selects and no M6 loads")
    };
    assert!(said("T1 D1\nG0 X1 Y1 Z1\nG1 X2 F100\n"));
    assert!(said("T1\nG1 X2 F100\n"));
    assert_eq!(faults("sinumerik-840d", "T1 D1\nG1 X2 F100\nX3\nX4\n").len(), 1, "once");
    for settled in [
        "G1 X2 F100\n",
        "T1 D1\nG0 X1\n",
        "T=\"MILL\"\nM6\nG1 X2 F100\n",
        "T1 D0\nG1 X2 F100\n",
        "T1 M6\nT2\nG1 X2 F100\n",
    ] {
        assert!(!said(settled), "{settled}");
    }
    assert!(!faults("iso-6983", "T1\nG1 X2 F100\n").concat().contains("no M6"));
}

#[test]
fn d_gives_the_length_of_the_tool_in_use() {
    let got = lengths(
        "sinumerik-840d",
        "T1 M6\nG0 X1\nD0\nX2\nT2 D1\nX3\nM6\nX4\nSUPA Z0 D0\nX5\n",
    );
    let want = [
        (Some(1), 100.0),
        (Some(1), 0.0),
        (Some(1), 0.0),
        (Some(2), 120.0),
        (Some(2), 0.0),
        (Some(2), 0.0),
    ];
    assert_eq!(got, want);
}

#[test]
fn missing_lengths_are_said_once() {
    let got = faults("fanuc-30i", "G43 H9 G0 Z1.\nG43 H9 Z2.\nG43 H8 Z3.\n");
    assert_eq!(
        got,
        [
            r#"1: G43: ToolLengthUnset { tool: "H9" }"#,
            r#"3: G43: ToolLengthUnset { tool: "H8" }"#
        ]
    );
    let got = faults("sinumerik-840d", "T=\"MILL\" M6\nG0 X1\nT=\"MILL\" M6\n");
    assert_eq!(got, [r#"1: T="MILL" M6: ToolLengthUnset { tool: "MILL" }"#]);
}

/// Shape and diameter of the tool in use at the program's end.
fn shape(dialect: &str, source: &str, setup: &Setup) -> Option<(ToolShape, f64)> {
    run_bytes(dialect, source.as_bytes(), setup)
        .1
        .state
        .expect("a block ran")
        .tool
        .shape()
}

#[test]
fn what_is_declared_about_the_tool_in_use() {
    let none = Setup::default();
    assert_eq!(shape("iso-6983", "T1 M6\n", &none), None, "undeclared is unknown");
    assert_eq!(shape("iso-6983", "T1 M6\n", &setup()), Some((ToolShape::Flat, 6.0)));
    assert_eq!(
        shape("iso-6983", "T1 M6\nT2 M6\n", &setup()),
        Some((ToolShape::Bull(1.0), 8.0))
    );
    let comment = "T1 M6\n(trunnion: tool 1 ball diameter 10)\n";
    assert_eq!(shape("iso-6983", comment, &none), Some((ToolShape::Ball, 10.0)));
    assert_eq!(
        shape("iso-6983", comment, &setup()),
        Some((ToolShape::Ball, 10.0)),
        "the program knows better"
    );
    let mut given = setup();
    given.tools.push(tool(0, Some(ToolShape::Ball), Some(4.0), None));
    assert_eq!(
        shape("iso-6983", comment, &given),
        Some((ToolShape::Ball, 4.0)),
        "number 0 is whatever is in use"
    );
    assert_eq!(shape("iso-6983", "G0 X1\n", &given), Some((ToolShape::Ball, 4.0)));
    assert_eq!(
        shape("iso-6983", "(trunnion: tool 1 ball diameter 10)\nG0 X1\n", &none),
        Some((ToolShape::Ball, 10.0))
    );
    let two = "(trunnion: tool 1 ball diameter 10)\n(trunnion: tool 2 flat diameter 5)\nG0 X1\n";
    assert_eq!(shape("iso-6983", two, &none), None, "which of the two is not known");
}

#[test]
fn a_declaration_counts_for_blocks_before_it() {
    let log = run_text(
        "fanuc-30i",
        "G43 H3 G0 Z1.\n(trunnion: tool 3 ball diameter 10 length 80)\n",
    );
    assert_eq!(log.motions[0].tool_length_mm, 80.0);
    assert_eq!(log.faults, []);
}
