//! What is wrong with the meaning of a program.
use crate::support::{faults, run_bytes};
use trunnion_interp::{FaultKind, Setup};

#[test]
fn unknown_codes_and_words() {
    assert_eq!(
        faults("linuxcnc", "G77.7\n"),
        [
            "1: G77.7: Rejected { refusal: UnknownCode, message: \"Unknown g code used: The control has no such code.\", \
             alarm: Some(\"LinuxCNC: Unknown g code used\") }"
        ]
    );
    assert_eq!(
        faults("sinumerik-840d", "M123\n"),
        ["1: M123: UnknownCode { machine_builder: true }"]
    );
    assert_eq!(
        faults("iso-6983", "FROBNICATE\n"),
        ["1: FROBNICATE: UnknownCode { machine_builder: false }"]
    );
    assert_eq!(faults("fanuc-30i", "G0 X1. CR=5\n"), ["1: CR=5: UnknownWord"]);
    // without a decimal point the size of a coordinate depends on a parameter of the control; zero is zero
    assert_eq!(faults("fanuc-30i", "G0 X0 Y5\n"), ["1: Y5: AmbiguousDecimal"]);
    assert_eq!(faults("linuxcnc", "G0 X0 Y5\nM2\n"), Vec::<String>::new());
}

#[test]
fn group_conflicts_name_both_codes() {
    let (program, log) = run_bytes("iso-6983", b"G0 G17 G1 X1 F1\nM3 M5\nM30\n", &Setup::default());
    let got: Vec<_> = log
        .faults
        .iter()
        .map(|fault| match &fault.kind {
            FaultKind::GroupConflict {
                group,
                first,
                second,
                first_range,
            } => {
                format!(
                    "{group}: {first} {} {second} {}",
                    program.text(*first_range),
                    program.text(fault.range)
                )
            }
            other => format!("{other:?}"),
        })
        .collect();
    assert_eq!(got, ["motion: G0 G0 G1 G1", "spindle: M3 M3 M5 M5"]);
    assert_eq!(faults("iso-6983", "G0 G0 X1\n"), [""; 0]);
}

#[test]
fn repeated_words() {
    assert_eq!(faults("iso-6983", "G1 G90 X1 F1 X2 M3 M8\n"), ["1: X2: RepeatedWord"]);
}

#[test]
fn missing_feed() {
    let missing = |inverse_time, zero| format!("{:?}", FaultKind::MissingFeed { inverse_time, zero });
    assert_eq!(
        faults("iso-6983", "G1 X1\n"),
        [format!("1: X1: {}", missing(false, false))]
    );
    assert_eq!(
        faults("iso-6983", "G1 X1 F0\n"),
        [format!("1: F0: {}", missing(false, true))]
    );
    assert_eq!(
        faults("iso-6983", "G93 G1 X1 F2\nX2\nG0 X3\n"),
        [format!("2: X2: {}", missing(true, false))]
    );
    assert_eq!(
        faults("iso-6983", "F100\nG93 G94 G1 X1\n").len(),
        2,
        "G94 after G93 in one block, and the feed is lost"
    );
    assert_eq!(faults("iso-6983", "G0 X1\nG4 P1\n"), [""; 0]);
    assert_eq!(
        faults("sinumerik-840d", "G1 X1 F=R1\n"),
        [r#"1: R1: NotModelled { what: "R1: the program does not set its value" }"#],
        "said once, not twice"
    );
}

#[test]
fn compensation_is_said_once() {
    let got = faults("iso-6983", "F1\nG41 D1 G1 X1\nG40\nG42 X2\n");
    assert_eq!(
        got,
        [r#"2: G41: NotModelled { what: "cutter radius compensation: the programmed path is used instead" }"#]
    );
}

#[test]
fn work_offsets_are_said_once() {
    let got = faults("iso-6983", "G54\nG55\nG54\nG0 X1\n");
    assert_eq!(
        got,
        [
            r#"1: G54: WorkOffsetUnset { name: "G54" }"#,
            r#"2: G55: WorkOffsetUnset { name: "G55" }"#
        ]
    );
    assert_eq!(faults("iso-6983", "G0 X1\n"), [""; 0]);
}

/// Block of a missing program end.
fn missing_end(dialect: &str, source: &str) -> Option<u32> {
    let log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
    log.faults
        .iter()
        .find(|fault| fault.kind == FaultKind::MissingProgramEnd)
        .map(|fault| fault.block.0 + 1)
}

#[test]
fn program_ends() {
    assert_eq!(missing_end("iso-6983", "G0 X1\n(nothing)\n\n"), Some(1));
    assert_eq!(missing_end("iso-6983", "G0 X1\nM30\n"), None);
    assert_eq!(missing_end("iso-6983", "G0 X1\nM2"), None);
    assert_eq!(missing_end("iso-6983", ""), None);
    assert_eq!(missing_end("iso-6983", "(only a comment)\n"), None);
    assert_eq!(missing_end("sinumerik-840d", "G0 X1\nM17\n"), None);
    assert_eq!(missing_end("apt", "GOTO/1,2,3\n"), Some(1));
    assert_eq!(missing_end("apt", "GOTO/1,2,3\nFINI\n"), None);
    assert_eq!(missing_end("fanuc-30i", "%\nO1\nG0 X1\n%\nG0 X2\n"), Some(3));
    assert_eq!(
        missing_end("linuxcnc", "%\nG0 X1\n%\nG0 X2\n"),
        None,
        "the second % is an end"
    );
}

#[test]
fn every_fault_lies_in_its_block() {
    let source = "G1 X1\nG0 G1 Y[1]\nG2 X5 Y5\n$ # G41\nT=\"A\" M6 D3\n";
    for dialect in trunnion_dialect::BUILTIN_NAMES {
        let (program, log) = run_bytes(dialect, source.as_bytes(), &Setup::default());
        for fault in log.faults {
            let block = program.block(fault.block).range();
            assert!(
                block.start <= fault.range.start && fault.range.end <= block.end,
                "{dialect}: {fault:?} {block:?}"
            );
        }
    }
}

#[test]
fn what_is_recognised_but_not_followed_is_said() {
    let what = |dialect: &str, source: &str| -> Vec<String> {
        let log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
        let unmodelled = log.faults.into_iter().filter_map(|fault| match fault.kind {
            FaultKind::NotModelled { what } => Some(what),
            _ => None,
        });
        unmodelled.collect()
    };
    assert_eq!(what("sinumerik-840d", "G0 X1 STAT=1 TU=2\n"), ["STAT", "TU"]);
    assert_eq!(
        what("sinumerik-840d", "FGROUP(X,Y,A)\nFGREF[A]=10\nFL[X]=500\n"),
        ["FL"]
    );
    assert_eq!(
        what("sinumerik-840d", "TRAORI\nTRAFOOF\nTRAORI()\nTRAORI(1)\n"),
        [""; 0]
    );
    assert_eq!(
        what("sinumerik-840d", "TRAORI(2)\nTRAORI(1,0,1,0)\n"),
        ["TRAORI(2)", "TRAORI(1,0,1,0)"]
    );
    assert_eq!(what("fanuc-30i", "G43.4 H1 P1\nG43.4 H1\n"), ["G43.4 with P"]);
    assert_eq!(what("fanuc-30i", "G43.5 H1 Q2\n"), ["G43.5 with Q"]);
    let limits = "G0 X1 Y2\nG25 X-100 Y-50\nG26 S3000\nX3\n";
    assert_eq!(what("sinumerik-840d", limits), ["G25"]);
    let log = run_bytes("sinumerik-840d", limits.as_bytes(), &Setup::default()).1;
    let lines: Vec<_> = log.motions.iter().map(crate::support::line).collect();
    assert_eq!(lines, ["R X1 Y2", "R X3 Y2"], "limits are no targets");
    assert_eq!(log.motions[1].spindle_rpm, None, "the limit is no speed");
}

#[test]
fn a_transformation_that_is_not_known_hides_the_position() {
    let got = crate::support::lines("sinumerik-840d", "TRAORI(2)\nG0 X1 Y2 Z3 A4\nTRAFOOF\nX5\n");
    assert_eq!(got, ["R A4 tcp", "R X5 A4"]);
}
