//! Zero points that nobody declares, comments that are long, and the speed of a spindle of which it is not known whether it turns.
use crate::support::{refusal, text, to};
use trunnion_convert::Options;

fn fanuc(body: &str) -> String {
    format!("G21 G17 G90 G94 G54\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z5.\n{body}\nM30\n")
}

fn written(body: &str, target: &str, machine: &str) -> String {
    text(to(
        (&fanuc(body), "fanuc-30i", machine),
        target,
        machine,
        &Options::default(),
    ))
}

/// An axis that does not move after a change of the work offset is not written: where it is in the new system, only the machine knows.
#[test]
fn an_axis_that_stays_after_a_change_of_work_offset_is_not_written() {
    let body = "G1 Z-1. F100.\nX5.\nG0 Z5.\nG55\nG0 X10.\nG1 Z-1.\nX20.\nG0 Z50.\nM5";
    for machine in ["", "mill-3axis"] {
        for target in ["haas-ngc", "linuxcnc"] {
            let written = written(body, target, machine);
            let block = written.lines().skip_while(|line| !line.contains("G55")).nth(1);
            let block = block.and_then(|line| line.split(' ').next_back());
            let block = block.map(|word| word.trim_end_matches('.'));
            assert_eq!(block, Some("X10"), "{target} {machine}: {written}");
        }
    }
    // all axes are given, or the zero points are the same place by their numbers
    let body = "G1 Z-1. F100.\nG0 Z5.\nG55\nG0 X10. Y1. Z7.\nG1 Z-1.\nG54\nG0 Z8.\nX1. Y1.\nM5";
    written_ok(body);
}

fn written_ok(body: &str) {
    for target in ["haas-ngc", "linuxcnc", "sinumerik-840d"] {
        written(body, target, "mill-3axis");
    }
}

/// The same block does not tell which axis moves: the coordinate is that of the other system by chance.
#[test]
fn a_conversion_that_holds_for_certain_zero_points_only_is_refused() {
    for body in [
        "G1 X5. F100.\nG55\nG91 Y1.\nG90 X20.\nM5",
        "G1 X5. F100.\nG55\nG2 X5. Y0 I-5. J0\nM5",
    ] {
        let refused = refusal(to(
            (&fanuc(body), "fanuc-30i", "mill-3axis"),
            "haas-ngc",
            "mill-3axis",
            &Options::default(),
        ));
        assert!(refused.message.contains("zero point"), "{body}: {refused}");
        assert!(refused.message.contains("[work_offsets]"), "{body}: {refused}");
    }
}

#[test]
fn a_speed_after_a_stop_or_without_m3_is_written() {
    for (body, wanted) in [
        ("M1\nS2500\nG95 G1 Z-1. F0.1\nX10.\nM5", "S2500"),
        ("M1\nS2500\nG1 Z-1. F100.\nM5", "S2500"),
    ] {
        for target in ["haas-ngc", "sinumerik-840d", "okuma-osp", "grbl", "heidenhain-klartext"] {
            let written = written(body, target, "mill-3axis");
            assert!(written.contains(wanted), "{target}: {written}");
        }
    }
    let source = "G21 G17 G90 G94 G54\nT1 M6\nG43 H1\nG0 X0 Y0 Z5.\nS700\nG1 Z-1. F100.\nM30\n";
    let written = text(to((source, "fanuc-30i", ""), "sinumerik-840d", "", &Options::default()));
    assert!(written.contains("S700"), "{written}");
    let refused = refusal(to((source, "fanuc-30i", ""), "apt", "", &Options::default()));
    assert!(!refused.message.is_empty());
}

/// No control reads a block of any length.
#[test]
fn a_long_comment_is_written_in_pieces() {
    let long = "WORD ".repeat(130);
    let body = format!("({long})\n({})\nG1 Z-1. F100.\nM5", "X".repeat(300));
    for target in [
        "sinumerik-840d",
        "okuma-osp",
        "linuxcnc",
        "haas-ngc",
        "heidenhain-klartext",
    ] {
        let written = written(&body, target, "");
        assert!(written.lines().all(|line| line.len() <= 150), "{target}: {written}");
        assert_eq!(written.matches("WORD").count(), 130, "{target}: {written}");
    }
}
