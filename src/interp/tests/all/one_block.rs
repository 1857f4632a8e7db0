//! Turning cycles in one block, as Haas lathes (and Fanuc's Series 10/11 format) have them. X is a diameter in the programs and a radius
//! in the lists.
use crate::support::{line, run_bytes};
use trunnion_interp::{ControlData, RoughingEscape, Setup};

const HAAS: &str = "haas-lathe";

fn run(control: ControlData, dialect: &str, source: &str) -> (Vec<String>, Vec<String>) {
    let setup = Setup {
        control,
        ..Setup::default()
    };
    let (_, log) = run_bytes(dialect, source.as_bytes(), &setup);
    let motions = log.motions.iter().map(line).collect();
    let faults = log.faults.iter().map(|fault| format!("{:?}", fault.kind)).collect();
    (motions, faults)
}

fn declared() -> ControlData {
    ControlData {
        roughing_escape: Some(RoughingEscape::Feed),
        roughing_retract_mm: Some(1.0),
        thread_least_cut_mm: Some(0.1),
        thread_finish_mm: Some(0.0),
        thread_pull_out: Some(0.0),
        chip_break_retract_mm: Some(0.5),
        ..ControlData::default()
    }
}

const CONTOUR: &str = "N10 G0 X20.\nG1 Z-10. F.1\nX40. Z-30.\nN20 X52.\nM30\n";

/// D is the U, and the control's setting the R, of the block that other controls have before.
#[test]
fn roughing_is_the_same_as_in_two_blocks() {
    for (one, two) in [
        ("G71 P10 Q20 U1. W0.5 D4. F.3", "G71 U4. R1.\nG71 P10 Q20 U1. W0.5 F.3"),
        ("G71 P10 Q20 U1. W0.5 D4. F.3", "G71 U4.\nG71 P10 Q20 U1. W0.5 F.3"),
    ] {
        let text = |cycle: &str| format!("G21 G0 X50. Z2.\n{cycle}\n{CONTOUR}");
        let (motions, faults) = run(declared(), HAAS, &text(one));
        assert_eq!(faults, [""; 0], "{one}");
        assert_eq!((motions, faults), run(declared(), HAAS, &text(two)), "{one}");
    }
    let facing = "N10 G0 Z-10.\nG1 X40. F.1\nN20 X20. Z2.\nM30\n";
    let text = |cycle: &str| format!("G21 G0 X50. Z2.\n{cycle}\n{facing}");
    let (motions, faults) = run(declared(), HAAS, &text("G72 P10 Q20 U0 W0 D3. F.3"));
    assert_eq!(faults, [""; 0]);
    assert_eq!(
        (motions, faults),
        run(declared(), HAAS, &text("G72 W3. R1.\nG72 P10 Q20 U0 W0 F.3"))
    );
}

#[test]
fn repeating_a_contour_is_the_same_as_in_two_blocks() {
    let text = |cycle: &str| format!("G21 G0 X50. Z2.\n{cycle}\n{CONTOUR}");
    let (motions, faults) = run(declared(), HAAS, &text("G73 P10 Q20 U1. W0.5 I3. K1. D3 F.3"));
    assert_eq!(faults, [""; 0]);
    let two = "G73 U3. W1. R3\nG73 P10 Q20 U1. W0.5 F.3";
    assert_eq!((motions, faults), run(declared(), HAAS, &text(two)));
}

/// I pecks along X by 4 mm, K goes aside by 3.
#[test]
fn grooves() {
    let (motions, faults) = run(declared(), HAAS, "G21 G0 X50. Z-10.\nG75 X38. Z-13. I4. K3. F.1\nM30\n");
    assert_eq!(faults, [""; 0]);
    assert_eq!(
        motions[1..],
        [
            "L X21 Z-10 F0.1/rev",
            "R X21.5 Z-10",
            "L X19 Z-10 F0.1/rev",
            "R X25 Z-10",
            "R X25 Z-13",
            "L X21 Z-13 F0.1/rev",
            "R X21.5 Z-13",
            "L X19 Z-13 F0.1/rev",
            "R X25 Z-13",
            "R X25 Z-10",
        ]
    );
    let (motions, _) = run(declared(), HAAS, "G21 G0 X0. Z2.\nG74 Z-6. K5. F.1\nM30\n");
    assert_eq!(
        motions[1..],
        ["L X0 Z-3 F0.1/rev", "R X0 Z-2.5", "L X0 Z-6 F0.1/rev", "R X0 Z2"]
    );
}

/// Two passes: 0.4 deep, then 0.4 times the root of 2, no deeper than 0.5. M24: out at the end.
#[test]
fn a_thread() {
    let control = ControlData {
        thread_pull_out: None,
        ..declared()
    };
    let (motions, faults) = run(
        control,
        HAAS,
        "G21 G97 S500 M3\nG0 X32. Z5.\nM24\nG76 X29. Z-20. K0.5 D0.4 F1.5\nM30\n",
    );
    assert_eq!(faults, [""; 0]);
    assert_eq!(
        motions[1..],
        [
            "R X14.6 Z5",
            "L X14.6 Z-20 F1.5/rev",
            "R X16 Z-20",
            "R X16 Z5",
            "R X14.5 Z5",
            "L X14.5 Z-20 F1.5/rev",
            "R X16 Z-20",
            "R X16 Z5",
        ]
    );
}

/// What the control has set and nobody declares is named; the cycle is one unknown motion back to its start.
#[test]
fn what_is_not_declared_is_named() {
    for (cycle, key) in [
        ("G71 P10 Q20 U1. D4. F.3", "roughing_retract"),
        ("G72 P10 Q20 U1. D4. F.3", "roughing_retract"),
        ("G75 X38. I4. F.1", "chip_break_retract"),
        ("G76 X29. Z-20. K0.5 D0.4 F1.5", "thread_least_cut"),
        ("G71 P10 Q20 U1. D4. K1. F.3", "(I, K)"),
        ("G71 P10 Q20 U1. D4000 F.3", "no decimal point"),
        ("G75 X38. I4000 F.1", "without a decimal point"),
    ] {
        let (motions, faults) = run(
            ControlData::default(),
            HAAS,
            &format!("G21 G0 X50. Z2.\n{cycle}\n{CONTOUR}"),
        );
        assert!(faults.iter().any(|fault| fault.contains(key)), "{cycle}: {faults:?}");
        assert_eq!(motions[1], "U X25 Z2", "{cycle}");
    }
}
