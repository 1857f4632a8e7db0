//! Drilling in steps on a Haas, and words of calls in the block of a cycle.
use crate::cycles::pecking;
use crate::support::{fault_line, line, lines, run_bytes};
use trunnion_interp::{ControlData, Setup};

#[test]
fn haas_steps_add_up_to_k() {
    // R 0, Z -10, steps of 2, out of the hole whenever 4 are done: after -4 and -8; otherwise back by 0.5
    let control = ControlData {
        chip_break_retract_mm: Some(0.5),
        peck_clearance_mm: Some(0.25),
        ..ControlData::default()
    };
    let source = "G0 X1. Y2. Z9.\nG99 G73 Z-10. R0. Q2. K4. F100.\nM30\n";
    let want = [
        "R Z9",
        "R Z0",
        "L Z-2 F100",
        "R Z-1.5",
        "L Z-4 F100",
        "R Z0",
        "R Z-3.75",
        "L Z-6 F100",
        "R Z-5.5",
        "L Z-8 F100",
        "R Z0",
        "R Z-7.75",
        "L Z-10 F100",
        "R Z0",
    ];
    assert_eq!(pecking("haas-ngc", source, control), want);
}

#[test]
fn mixtures_of_steps_are_named() {
    for (words, what) in [
        ("G83 Q2. K4.", "G83"),
        ("G83 I2. Q4.", "G83"),
        ("G73 J1. Q4.", "G73"),
        ("G73 I2. J1. K1. Q1.", "G73"),
    ] {
        let source = format!("G0 X1. Y2. Z9.\nG99 {words} Z-10. R0. F100.\n");
        let (program, log) = run_bytes("haas-ngc", source.as_bytes(), &Setup::default());
        let faults: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
        assert!(
            faults[0].contains(&format!("{what} with this combination of I, J, K and Q")),
            "{words}: {faults:?}"
        );
        let motions: Vec<_> = log.motions.iter().map(|m| line(m).replace("X1 Y2 ", "")).collect();
        assert_eq!(motions, ["R Z9", "R Z0", "U Z-10", "R Z0"], "{words}");
    }
}

#[test]
fn words_of_a_call_are_no_data_of_the_cycle() {
    // P1 and L2 belong to M98: the dwell stays 0.25 s, and one hole is drilled at X5
    let source = "G0X0.Y0.Z9.\nG99G82Z-3.R1.P250F100.\nX5.M98P1L2\nM30\nO1\nM99\n";
    assert_eq!(
        lines("fanuc-30i", source)[5..],
        ["R X5 Y0 Z1", "L X5 Y0 Z-3 F100", "D0.25 X5 Y0 Z-3", "R X5 Y0 Z1"]
    );
}
