//! Numbers and expressions at which a Fanuc, a Haas or an Okuma stops: each has a finding.
use crate::support::run_bytes;
use trunnion_interp::{FaultKind, Refusal, Setup};

/// What the control refuses in a block, by sort and message.
fn refused(dialect: &str, source: &str) -> Vec<(Refusal, String)> {
    let log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
    let found = log.faults.into_iter().filter_map(|fault| match fault.kind {
        FaultKind::Rejected { refusal, message, .. } => Some((refusal, message)),
        _ => None,
    });
    found.collect()
}

fn of_macro_b(dialect: &str, block: &str) -> Vec<(Refusal, String)> {
    let head = "%\nO1\nG21 G17 G90 G94 G54\nM3 S500\nG0 X1. Y1. Z1.\n";
    refused(dialect, &format!("{head}{block}\nG0 X2.\nM30\n%\n"))
}

#[test]
fn then_needs_its_if() {
    for dialect in ["fanuc-30i", "haas-ngc"] {
        for block in ["THEN #1=5", "WHILE [1 EQ 2] DO1 THEN #1=5\nEND1"] {
            let found = of_macro_b(dialect, block);
            assert!(
                found.iter().any(|(_, message)| message.contains("THEN without IF")),
                "{dialect} {block}: {found:?}"
            );
        }
        for block in ["IF [1 EQ 1] THEN #1=5", "IF [1 EQ 2] THEN #1=5"] {
            assert_eq!(of_macro_b(dialect, block), [], "{dialect} {block}");
        }
    }
}

#[test]
fn numbers_with_a_minus_or_a_point_that_their_word_does_not_take() {
    for dialect in ["fanuc-30i", "haas-ngc"] {
        for (block, what) in [
            ("N-5 G0 X3.", "N is negative"),
            ("F-5.", "F is negative"),
            ("#1=-5\nF#1", "F is negative"),
        ] {
            let found = of_macro_b(dialect, block);
            assert!(
                found.len() == 1 && found[0].0 == Refusal::Number && found[0].1.contains(what),
                "{dialect} {block}: {found:?}"
            );
        }
        for block in ["N5 G0 X3.", "F5.", "F0", "G0 X-5."] {
            assert_eq!(of_macro_b(dialect, block), [], "{dialect} {block}");
        }
    }
    for (block, code) in [("M8.", "write M8"), ("M3.", "write M3"), ("G0 X4. M8.0", "write M8")] {
        let found = of_macro_b("fanuc-30i", block);
        assert!(found.len() == 1 && found[0].1.contains(code), "{block}: {found:?}");
    }
    for block in ["M8", "M08", "G54.1 P1", "G1 X3. F5."] {
        assert_eq!(of_macro_b("fanuc-30i", block), [], "{block}");
    }
}

#[test]
fn a_right_angle_has_no_tangent() {
    for dialect in ["fanuc-30i", "haas-ngc"] {
        for text in ["TAN[90]", "TAN[-270]", "TAN[#2+90]"] {
            let found = of_macro_b(dialect, &format!("#2=0\n#1={text}"));
            assert!(
                found.len() == 1 && found[0].1.contains("TAN of 90"),
                "{text}: {found:?}"
            );
        }
        assert_eq!(of_macro_b(dialect, "#1=TAN[89.9]+TAN[180]"), []);
    }
}

#[test]
fn arithmetic_of_an_okuma_without_a_value() {
    let okuma = |block: &str| format!("G17 G90 G15 H1\nG0 X1 Y1 Z1\nM3 S500\nF100\nV2=0\n{block}\nNA G0 X2\nM2\n");
    for (block, what) in [
        ("V1=1/0", "division by zero"),
        ("V1=1/V2", "division by zero"),
        ("V1=MOD[3,0]", "division by zero"),
        ("V1=SQRT[-1]", "square root"),
        ("X=1/0", "division by zero"),
        ("IF [1/0 EQ 1] NA", "division by zero"),
        ("CALL OSUB AA=1/0", "division by zero"),
    ] {
        let found = refused("okuma-osp", &okuma(block));
        assert!(
            found.len() == 1 && found[0].0 == Refusal::Expression && found[0].1.contains(what),
            "{block}: {found:?}"
        );
    }
    // no source says what the control does
    for block in ["V1=TAN[90]", "X=TAN[V2-90]"] {
        let log = run_bytes("okuma-osp", okuma(block).as_bytes(), &Setup::default()).1;
        let says = |kind: &FaultKind| matches!(kind, FaultKind::NotModelled { what } if what.contains("TAN of 90"));
        assert!(
            log.faults.iter().any(|fault| says(&fault.kind)),
            "{block}: {:?}",
            log.faults
        );
    }
    for block in ["V1=V9/0", "V1=4/2", "X=SQRT[4]", "V1=TAN[45]"] {
        assert_eq!(refused("okuma-osp", &okuma(block)), [], "{block}");
    }
}
