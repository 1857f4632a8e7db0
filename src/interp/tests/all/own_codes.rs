//! Codes of the machine's own on a LinuxCNC control: switches of the kinematics, clamps, and several of them in one block.
use crate::support::{faults, line, run_bytes};
use trunnion_interp::{MotionKind, Setup};

#[test]
fn machine_coordinates_under_tcp_are_unknown() {
    for words in ["G53 G0 Z0", "G28 Z5", "G30 Z5"] {
        let source = format!("M428\nG0 X1 Y2 Z3 A4\n{words}\nG0 X5\nM429\nM2\n");
        let log = run_bytes("linuxcnc", source.as_bytes(), &trt()).1;
        assert_eq!(log.motions[1].kind, MotionKind::Unknown, "{words}");
        assert_eq!(log.motions[1].end.xyz(), None, "{words}");
        let last = log.motions.last().expect("a motion");
        assert_eq!(
            crate::support::position(&last.end).split(' ').next(),
            Some("X5"),
            "{words}"
        );
        assert!(last.end.xyz().is_none(), "{words}");
        let told = log
            .faults
            .iter()
            .any(|fault| format!("{fault:?}").contains("while tool centre point control is on"));
        assert!(told, "{words}: {:?}", log.faults);
    }
}

/// A machine on which M428 is tool centre point control.
fn trt() -> Setup {
    let mut setup = Setup::default();
    setup.control.tcp_codes = Some(trunnion_interp::TcpCodes {
        on: vec!["M428".to_owned()],
        off: vec!["M429".to_owned()],
        ..Default::default()
    });
    setup
}

#[test]
fn what_m428_means_is_said_by_the_machine() {
    let source = "G21 F100\nM428\nG0 X1 Y2 Z3 A4\nM429\nG0 X1\nM2\n";
    let lines = |setup: &Setup| -> Vec<String> {
        let log = run_bytes("linuxcnc", source.as_bytes(), setup).1;
        log.motions.iter().map(line).collect()
    };
    assert_eq!(lines(&trt()), ["R X1 Y2 Z3 A4 tcp", "R X1 A4"]);
    let mut nutating = trt();
    nutating.control.tcp_codes = Some(trunnion_interp::TcpCodes {
        on: vec!["M429".to_owned()],
        off: vec!["M428".to_owned()],
        ..Default::default()
    });
    assert_eq!(lines(&nutating), ["R X1 Y2 Z3 A4", "R X1 A4 tcp"]);
    // not declared: what coordinates mean is not known until the end
    assert_eq!(lines(&Setup::default()), ["R A4", "R A4"]);
    let told = faults("linuxcnc", source);
    assert!(
        told[0].contains("M428: the machine file does not declare which kinematics it selects"),
        "{told:?}"
    );
}

#[test]
fn several_codes_of_the_machine_in_one_block_are_all_run() {
    let run = |codes: &str| {
        let source = format!("G21 F100\nM429\nG0 X1 Y2 Z3 A4\n{codes}\nG0 X5\nM429\nG0 X1 Y1 Z1 A1\nM2\n");
        let mut setup = trt();
        setup.control.clamp_codes[2] = Some(trunnion_interp::ClampCodes { on: 10, off: 11 });
        let log = run_bytes("linuxcnc", source.as_bytes(), &setup).1;
        let faults: Vec<String> = log.faults.iter().map(|fault| format!("{fault:?}")).collect();
        (log.motions.iter().map(line).collect::<Vec<_>>(), faults)
    };
    // one that switches a clamp hides no other
    for codes in ["M428 M10", "M10 M428"] {
        let (lines, faults) = run(codes);
        assert_eq!(lines, ["R X1 Y2 Z3 A4", "R X5 A4 tcp", "R X1 Y1 Z1 A1"], "{codes}");
        assert_eq!(faults, [""; 0], "{codes}");
    }
    // it is unknown which of two switches of the kinematics comes last
    for codes in ["M428 M430", "M429 M428"] {
        let (lines, faults) = run(codes);
        assert!(
            lines[1].starts_with('?') || !lines[1].contains('X'),
            "{codes}: {lines:?}"
        );
        assert_eq!(lines[2], "R X1 Y1 Z1 A1", "{codes}");
        assert!(
            faults
                .iter()
                .any(|fault| fault.contains("in one block: the machine decides their order")),
            "{faults:?}"
        );
    }
}

#[test]
fn a_code_of_the_machine_under_compensation_is_unknown() {
    let source = "G21 F100\nG0 X0 Y0 Z0\nG41.1 D2\nG1 X20\nG1 X40\nM428\nG1 Y40\nG40\nM2\n";
    let log = run_bytes("linuxcnc", source.as_bytes(), &trt()).1;
    assert!(log.motions.iter().all(|motion| !motion.tcp || motion.block.0 > 5));
    let told = log
        .faults
        .iter()
        .any(|fault| format!("{fault:?}").contains("M428 under cutter radius compensation"));
    assert!(told, "{:?}", log.faults);
}
