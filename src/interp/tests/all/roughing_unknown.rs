//! Roughing cycles that are not simulated, and say why: they end where they began, and what follows is known.
use crate::support::{fault_line, faults, lines, run_bytes};
use trunnion_interp::{MotionKind, Setup, WorkOffset};

const A: &str = "fanuc-30i-lathe-a";

/// Parts of a program: what comes before it, first and second block, contour.
fn program([before, first, second, contour]: [&str; 4]) -> String {
    format!("{before}G0 X50. Z2.\n{first}\n{second}\n{contour}G0 Z9.\nM30\n")
}

const FIRST: &str = "G71 U2. R1.";
const SECOND: &str = "G71 P1 Q2 U.4 W.1 F.3";
const CONTOUR: &str = "N1 G0 X20.\nG1 Z-10.\nN2 X50.\n";

/// Each of these ends where it began, and says why its cuts are not known.
fn are_unknown(cases: &[([&str; 4], &str)]) {
    for (parts, why) in cases {
        let source = program(*parts);
        assert_eq!(lines(A, &source)[1..], ["U X25 Z2", "R X25 Z9"], "{source}");
        let told = faults(A, &source);
        assert!(
            told.iter()
                .any(|told| told.contains("cuts of G71: ") && told.contains(why)),
            "{source}{told:?}"
        );
    }
}

#[test]
fn words_that_are_missing_or_not_documented() {
    are_unknown(&[
        // no depth, no escape, unknown lengths
        (["", "", SECOND, CONTOUR], "without a depth of cut"),
        (["", "G71 R1.", SECOND, CONTOUR], "without a depth of cut"),
        (["", "G71 U0. R1.", SECOND, CONTOUR], "without a depth of cut"),
        (["", "G71 U-2. R1.", SECOND, CONTOUR], "without a depth of cut"),
        (["", "G71 U#500 R1.", SECOND, CONTOUR], "without a depth of cut"),
        (["", "G71 U2.", SECOND, CONTOUR], "without an escape"),
        (["", "G71 U2. R-1.", SECOND, CONTOUR], "without an escape"),
        (["", FIRST, "G71 P1 Q2 U#500 F.3", CONTOUR], "allowance is unknown"),
        // one block, tool nose, planes
        (["", FIRST, "G71 P1 Q2 D2000 F.3", CONTOUR], "one block"),
        (
            ["", FIRST, SECOND, "N1 G0 G42 X20.\nG1 Z-10.\nN2 G40 X50.\n"],
            "nose radius",
        ),
        (["G17\n", FIRST, SECOND, CONTOUR], "a plane other than"),
    ]);
}

#[test]
fn contours_that_are_not_of_type_one() {
    are_unknown(&[
        // contours that rise and go along not evenly
        (
            ["", FIRST, SECOND, "N1 G0 X20.\nG1 Z-10.\nX16. Z-14.\nN2 X50.\n"],
            "pocket",
        ),
        (
            ["", FIRST, SECOND, "N1 G0 X20.\nG1 Z-10.\nX30. Z-8.\nN2 X50. Z-20.\n"],
            "pocket",
        ),
        (
            [
                "",
                FIRST,
                SECOND,
                "N1 G0 X20.\nG1 Z-10.\nG3 X20. Z-20. R5.\nN2 G1 X50.\n",
            ],
            "turns back",
        ),
        (
            [
                "",
                FIRST,
                SECOND,
                "N1 G0 X20.\nG1 Z-10.\nG2 X40. Z-20. R-10.\nN2 G1 X50.\n",
            ],
            "turns back",
        ),
        // radius 10.83 at Z-10 and 12 at Z-20, but 10 between them
        (
            [
                "",
                FIRST,
                SECOND,
                "N1 G0 X21.669697\nG1 Z-10.\nG2 X24. Z-20. R10.\nN2 G1 X50.\n",
            ],
            "turns back",
        ),
        // their beginning
        (
            ["", FIRST, SECOND, "N1 G40 X20.\nG1 Z-10.\nN2 X50.\n"],
            "does not say G0 or G1",
        ),
        (["", FIRST, SECOND, "N1 G0 X20. Z2.\nG1 Z-10.\nN2 X50.\n"], "type II"),
        (["", FIRST, SECOND, "N1 G0 X20. W0.\nG1 Z-10.\nN2 X50.\n"], "type II"),
        (
            ["", FIRST, SECOND, "N1 X20.\nG1 Z-10.\nN2 X50.\n"],
            "does not say G0 or G1",
        ),
        (
            ["", FIRST, SECOND, "N1 G0\nX20.\nG1 Z-10.\nN2 X50.\n"],
            "does not say G0 or G1",
        ),
        (["", FIRST, "G71 P1 Q1 F.3", "N1 G0 X20.\n"], "one block"),
        (["", FIRST, SECOND, "N1 G0 X20.\nN2 G1 X50.\n"], "start along one axis"),
        // other axes, rapids
        (["", FIRST, SECOND, "N1 G0 X20.\nG1 Z-10. Y5.\nN2 X50.\n"], "other axes"),
        (["", FIRST, SECOND, "N1 G0 X20.\nG1 Z-10. Y5.\nN2 X50.\n"], "other axes"),
        (["", FIRST, SECOND, "N1 G0 X20.\nG1 Z-10. Y0.\nN2 X50.\n"], "other axes"),
        (
            ["", FIRST, SECOND, "N1 G0 X20.\nG1 Z-10.\nN2 G0 X50.\n"],
            "rapid motion inside",
        ),
        // an allowance that would lead into the part
        (["", FIRST, "G71 P1 Q2 U-.4 W.1 F.3", CONTOUR], "beyond the contour"),
        (["", FIRST, "G71 P1 Q2 U.4 W-.1 F.3", CONTOUR], "beyond the contour"),
        // cuts without number
        (["", "G71 U.001 R0.", SECOND, CONTOUR], "more than 10000 cuts"),
    ]);
}

#[test]
fn a_contour_in_two_work_offsets() {
    let offset = |name: &str, z: f64| WorkOffset {
        name: name.to_owned(),
        values: [0.0, 0.0, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    let setup = Setup {
        work_offsets: vec![offset("G54", 0.0), offset("G55", -5.0)],
        ..Setup::default()
    };
    let contour = "N1 G0 X20.\nG55 G1 Z-10.\nN2 X50.\n";
    let source = program(["G54\n", FIRST, SECOND, contour]);
    let (program, log) = run_bytes(A, source.as_bytes(), &setup);
    let told: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    assert!(
        told.iter()
            .any(|told| told.contains("changes the tool or the work offset")),
        "{told:?}"
    );
    assert_eq!(log.motions[1].kind, MotionKind::Unknown);
}

/// Whatever the numbers are, the cycle ends, and where it began; every motion joins on to the one before.
#[test]
fn hostile_numbers_come_to_an_end() {
    let numbers = ["0.", "-3.", ".0011", "7.", "99999.", "-99999.", "1e9", "#500", "#0"];
    for depth in numbers {
        for escape in numbers {
            for allowance in ["0.", "-.4", "99999.", "#500"] {
                let first = format!("G71 U{depth} R{escape}");
                let second = format!("G71 P1 Q2 U{allowance} W{allowance} F.3");
                let source = program(["", &first, &second, CONTOUR]);
                let (_, log) = run_bytes(A, source.as_bytes(), &Setup::default());
                assert!(log.motions.len() < 100_000, "{source}");
                let last = log.motions.last().expect("some");
                assert_eq!((last.end.get(0), last.end.get(2)), (Some(25.0), Some(9.0)), "{source}");
                for pair in log.motions.windows(2) {
                    assert_eq!(pair[0].end, pair[1].start, "{source}");
                }
            }
        }
    }
}
