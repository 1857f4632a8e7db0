//! Words that are no coordinates and no plain numbers: axis words of codes that move nothing, F and dwells without a decimal point, P and Q that an
//! earlier cycle left.
use crate::support::{fault_line, run_bytes};
use trunnion_interp::{FaultKind, ImplicitDecimals, MotionKind, Setup};

fn setup(decimals: Option<ImplicitDecimals>) -> Setup {
    let mut setup = Setup::default();
    setup.control.implicit_decimals = decimals;
    setup
}

/// X of the ends of the motions; NaN: unknown.
fn ends(dialect: &str, text: &str) -> (Vec<f64>, Vec<String>) {
    let (program, log) = run_bytes(dialect, text.as_bytes(), &setup(None));
    let ends = log.motions.iter().map(|motion| motion.end.get(0).unwrap_or(f64::NAN));
    (
        ends.collect(),
        log.faults.iter().map(|fault| fault_line(&program, fault)).collect(),
    )
}

#[test]
fn axis_words_of_a_code_that_moves_nothing_are_data() {
    let codes = [
        ("fanuc-30i", "G5.1 Q3 X0. Y0. Z0."),
        ("fanuc-30i", "G5.1 Q2 X0. C0."),
        ("fanuc-30i", "G22 X0. Y0. Z0. I-10. J-10. K-30."),
        ("fanuc-30i", "G91.1 X5. Y5."),
        ("fanuc-30i", "G10.6 Z20."),
        ("fanuc-30i-lathe-a", "G22 X50. Z0. I10. K-30."),
        ("haas-ngc", "G102 X1. Y1."),
    ];
    for (dialect, code) in codes {
        let (ends, faults) = ends(dialect, &format!("G0 X70. Z10.\n{code}\nG1 X20. F0.2\nM30\n"));
        let scale = if dialect.contains("lathe") { 0.5 } else { 1.0 };
        assert_eq!(ends, [70.0 * scale, 20.0 * scale], "{code}: {faults:?}");
    }
}

#[test]
fn a_motion_code_beside_them_is_not_judged() {
    for code in ["G22 G1 X0. Y0. F100.", "G5.1 Q3 G0 X0.", "G22 X0. A5."] {
        let text = format!("G0 X70. Z10.\n{code}\nM30\n");
        let (ends, faults) = ends("fanuc-30i", &text);
        assert!(
            faults.iter().any(|fault| fault.contains("NotModelled")),
            "{code}: {faults:?}"
        );
        assert!(!ends.contains(&0.0), "{code}: {ends:?}");
    }
}

fn ambiguous(decimals: Option<ImplicitDecimals>, text: &str) -> usize {
    let (_, log) = run_bytes("fanuc-30i", text.as_bytes(), &setup(decimals));
    let of = |kind: &FaultKind| *kind == FaultKind::AmbiguousDecimal;
    log.faults.iter().filter(|fault| of(&fault.kind)).count()
}

#[test]
fn a_whole_feed_is_reported_where_a_parameter_decides_it() {
    let open = [
        "G21 G95 G1 X5. F20",
        "G20 G94 G1 X5. F10",
        "G20 G95 G1 X5. F1",
        "G21 G93 G1 X5. F5",
        "G21 G94 G33 Z5. F2",
    ];
    let clear = [
        "G21 G94 G1 X5. F20",
        "G21 G95 G1 X5. F20.",
        "G20 G94 G1 X5. F10.",
        "G21 G95 G1 X5. F0",
    ];
    for text in open {
        assert_eq!(ambiguous(None, text), 1, "{text}");
        for known in [ImplicitDecimals::Calculator, ImplicitDecimals::LeastIncrement] {
            assert_eq!(ambiguous(Some(known), text), 0, "{text}");
        }
    }
    for text in clear {
        assert_eq!(ambiguous(None, text), 0, "{text}");
    }
}

#[test]
fn a_whole_dwell_is_as_long_as_a_parameter_says() {
    let seconds = |decimals, text: &str| {
        let (_, log) = run_bytes("fanuc-30i", text.as_bytes(), &setup(decimals));
        match log.motions[0].kind {
            MotionKind::Dwell(seconds) => seconds,
            _ => panic!("{text}: no dwell"),
        }
    };
    assert_eq!(seconds(None, "G4 X1"), None);
    assert_eq!(ambiguous(None, "G4 X1"), 1);
    assert_eq!(seconds(Some(ImplicitDecimals::Calculator), "G4 X1"), Some(1.0));
    assert_eq!(seconds(Some(ImplicitDecimals::LeastIncrement), "G4 X1"), Some(0.001));
    assert_eq!(seconds(None, "G4 X1."), Some(1.0));
    // P never has a decimal point
    assert_eq!(seconds(None, "G4 P1000"), Some(1.0));
    assert_eq!(ambiguous(None, "G4 P1000"), 0);
}

#[test]
fn a_cycle_that_reads_no_p_does_not_wait() {
    let dwells = |text: &str| {
        let (_, log) = run_bytes("fanuc-30i", text.as_bytes(), &setup(None));
        let dwell = |kind: &MotionKind| matches!(kind, MotionKind::Dwell(_));
        log.motions.iter().filter(|motion| dwell(&motion.kind)).count()
    };
    let start = "G90 G0 X0. Y0. Z50.\nG99 G82 Z-5. R2. P500 F100.\n";
    for (cycle, waits) in [
        ("G83 X5. Z-9. R2. Q3.", 1),
        ("G85 X5. Z-9. R2.", 1),
        ("G89 X5. Z-9. R2.", 2),
        ("G83 X5. Q3. P500", 1),
    ] {
        assert_eq!(dwells(&format!("{start}{cycle}\nG80\n")), waits, "{cycle}");
    }
}

#[test]
fn steps_of_a_tap_are_unknown_by_name() {
    let steps = |text: &str| {
        let (_, faults) = ends("fanuc-30i", text);
        faults.iter().filter(|fault| fault.contains("steps of Q")).count()
    };
    let start = "G90 G0 X0. Y0. Z50. M3 S100\n";
    assert_eq!(steps(&format!("{start}G99 G84 Z-5. R2. Q1. F100.\nG80\n")), 1);
    assert_eq!(steps(&format!("{start}G99 G84 Z-5. R2. F100.\nG80\n")), 0);
    assert_eq!(
        steps(&format!("{start}G99 G83 Z-5. R2. Q1. F100.\nG84 X5.\nG80\n")),
        1,
        "Q stays"
    );
    assert_eq!(
        steps(&format!(
            "{start}G99 G83 Z-5. R2. Q1. F100.\nG80\nG84 Z-5. R2. X5.\nG80\n"
        )),
        0
    );
}
