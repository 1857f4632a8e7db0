//! Tool centre point control, vectors, and where the position is lost by them.
use crate::support::{fault_line, faults, line, lines, run_bytes, run_text};
use trunnion_interp::{Orientation, Setup, Tool};

#[test]
fn traori_changes_the_meaning_of_the_linear_axes() {
    let source = "G0 X1 Y2 Z3 A4 C5\nTRAORI\nA6\nX1 Y1 Z1\nTRAFOOF\nX2\n";
    assert_eq!(
        lines("sinumerik-840d", source),
        ["R X1 Y2 Z3 A4 C5", "R A6 C5 tcp", "R X1 Y1 Z1 A6 C5 tcp", "R X2 A6 C5"]
    );
}

#[test]
fn vectors_by_a3() {
    let source = "TRAORI\nG1 X0 Y0 Z0 A3=0 B3=3 C3=4 F100\nX1\nX2 A3=1\nX3 A10 C20\nTRAFOOF\n";
    assert_eq!(
        lines("sinumerik-840d", source),
        [
            "L X0 Y0 Z0 F100 tcp <0 0.6 0.8>",
            "L X1 Y0 Z0 F100 tcp <0 0.6 0.8>",
            "L X2 Y0 Z0 F100 tcp <1 0 0>",
            "L X3 Y0 Z0 A10 C20 F100 tcp",
        ]
    );
    assert_eq!(
        faults("sinumerik-840d", source),
        [""; 0],
        "the length of A3 B3 C3 is irrelevant"
    );
    let log = run_text("sinumerik-840d", source);
    let starts: Vec<bool> = log
        .motions
        .iter()
        .map(|motion| matches!(motion.orientation, Orientation::Vector(Some(_), _)))
        .collect();
    assert_eq!(starts, [false, true, true, false]);
}

#[test]
fn zero_vectors_are_faults_and_unknown() {
    let source = "TRAORI\nG1 X0 Y0 Z0 A3=0 B3=0 C3=0 F100\n";
    assert_eq!(faults("sinumerik-840d", source), ["2: X0: VectorNotUnit { norm: 0.0 }"]);
    assert_eq!(lines("sinumerik-840d", source), ["L X0 Y0 Z0 F100 tcp"]);
}

#[test]
fn vectors_need_tool_centre_point_control() {
    let got = faults("sinumerik-840d", "G1 X0 Y0 Z0 A3=0 B3=0 C3=1 F100\n");
    assert_eq!(
        got,
        [r#"1: X0: NotModelled { what: "tool vector without tool centre point control" }"#]
    );
}

#[test]
fn vectors_by_ijk_under_g43_5() {
    let source = "G43.5 H0\nG1 X0 Y0 Z0 I0 J0 K1 F100\nX1. I0.6 J0 K0.81\nG49\nG0 X5.\n";
    assert_eq!(
        lines("fanuc-30i", source)[..1],
        ["L X0 Y0 Z0 F100 tcp <0 0 1>".to_owned()],
    );
    let got = faults("fanuc-30i", source);
    assert_eq!(got.len(), 1);
    assert!(got[0].starts_with("3: X1.: VectorNotUnit { norm: 1.008"), "{got:?}");
    assert_eq!(
        lines("fanuc-30i", source)[2],
        "R X5",
        "G49 ends it; the rotary axes are where the vector took them"
    );
}

#[test]
fn g49_ends_the_tcp_of_its_group_only() {
    assert_eq!(
        lines("fanuc-30i", "G43.4 H0\nG0 X1 A1\nG49\nG0 X2\n"),
        ["R X1 A1 tcp", "R X2 A1"]
    );
    let mut setup = Setup::default();
    setup.control.tcp_codes = Some(trunnion_interp::TcpCodes {
        on: vec!["M428".to_owned()],
        off: vec!["M429".to_owned()],
        ..Default::default()
    });
    let log = run_bytes("linuxcnc", b"M428\nG0 X1 A1\nG49\nG0 X2\nM429\nX3\n", &setup).1;
    let got: Vec<_> = log.motions.iter().map(line).collect();
    assert_eq!(got, ["R X1 A1 tcp", "R X2 A1 tcp", "R X3 A1"]);
}

#[test]
fn great_circle_codes() {
    let log = run_text("sinumerik-840d", "TRAORI\nG0 X1\nORIAXES\nX2\nORIVECT\nX3\n");
    let got: Vec<_> = log.motions.iter().map(|motion| motion.great_circle).collect();
    assert_eq!(got, [None, Some(false), Some(true)]);
}

#[test]
fn machine_coordinates_under_tcp_are_unknown() {
    let tool = Tool {
        number: 1,
        shape: None,
        diameter_mm: None,
        length_mm: Some(80.0),
        holder_mm: None,
    };
    let setup = Setup {
        tools: vec![tool],
        ..Setup::default()
    };
    let run = |block: &str| {
        let source = format!("T1 M6\nTRAORI\nG0 X1 Y1 Z1 A0 C0\n{block}\nX2\nM30\n");
        let (program, log) = run_bytes("sinumerik-840d", source.as_bytes(), &setup);
        let lines: Vec<_> = log.motions.iter().map(line).collect();
        let faults: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
        (lines, faults)
    };
    let (lines, faults) = run("SUPA G0 Z500 D0");
    assert_eq!(lines, ["R X1 Y1 Z1 A0 C0 tcp", "U A0 C0 machine", "R X2 A0 C0 tcp"]);
    let unknown =
        r#"4: Z500: NotModelled { what: "machine coordinates under tool centre point control: where the axes go" }"#;
    assert_eq!(faults, [unknown, "4: Z500: TcpState(MachineCoordinates)"]);
    // machine data decide whether the length is suppressed too
    let (lines, faults) = run("SUPA G0 Z500");
    assert_eq!(lines, ["R X1 Y1 Z1 A0 C0 tcp", "U A0 C0 machine", "R X2 A0 C0 tcp"]);
    assert_eq!(
        faults,
        [
            r#"4: Z500: NotModelled { what: "SUPA with tool length (MN_G53_TOOLCORR)" }"#,
            unknown,
            "4: Z500: TcpState(MachineCoordinates)"
        ]
    );
    let (lines, faults) = run("SUPA G0 A10");
    assert_eq!(lines[1], "R A10 C0 machine", "no length along a rotary axis");
    assert_eq!(faults, ["4: A10: TcpState(MachineCoordinates)"]);
}
