//! A shift of the zero point goes into the coordinates, coolant goes on as on the control before, and programs of lathes say why they stay.
use crate::support::{refusal, text, to};
use trunnion_convert::Options;

const FANUC: &str = "G21 G17 G90 G94 G54\nT1 M6\nS500 M3\nG0 X0. Y0. Z50.\n";

/// The written blocks without their numbers.
fn blocks(written: &str) -> Vec<&str> {
    written
        .lines()
        .map(|line| match line.split_once(' ') {
            Some((number, rest)) if number.starts_with('N') => rest,
            _ => line,
        })
        .collect()
}

#[test]
fn a_shift_that_is_taken_back_is_in_the_coordinates() {
    let source = format!(
        "{FANUC}G52 X5. Y3. Z1.\nG1 Z-1. F100.\nX30. Y0.\nG2 X40. Y10. R10.\nG52 X0 Y0 Z0\nG1 X5.\nG0 Z50.\nM5\nM30\n"
    );
    for machine in ["", "mill-3axis"] {
        let from = (source.as_str(), "fanuc-30i", machine);
        let written = text(to(from, "linuxcnc", machine, &Options::default()));
        let blocks = blocks(&written);
        for wanted in ["X35 Y3", "G1 X5"] {
            assert!(blocks.contains(&wanted), "{wanted} of {machine}: {written}");
        }
        assert!(blocks.iter().any(|block| block.contains("G2 X45 Y13")), "{written}");
        assert!(!written.contains("G52"), "{written}");
    }
    let shifted = "G17 G90 G94 G54 G71\nT1 D1 M6\nS1000 M3 F100\nG0 X0 Y0 Z10\nTRANS X5 Y3\nATRANS X1\nG1 Z5\nX10\nTRANS\nX4\nM5\nM30\n";
    let written = text(to(
        (shifted, "sinumerik-840d", ""),
        "fanuc-30i",
        "",
        &Options::default(),
    ));
    let blocks = blocks(&written);
    assert!(blocks.contains(&"X16.") && blocks.contains(&"X4."), "{written}");
}

#[test]
fn a_shift_that_stays_is_refused() {
    let source = format!("{FANUC}G52 X5.\nG1 X30. F100.\nM5\nM30\n");
    let refused = refusal(to((&source, "fanuc-30i", ""), "linuxcnc", "", &Options::default()));
    assert!(refused.message.contains("does not take that back"), "{refused}");
}

/// M6 of a Haas stops the coolant; on a Fanuc the machine decides.
#[test]
fn coolant_after_a_tool_change_is_not_left_to_another_machine() {
    let cut = "M3\nG0 X1. Y0. Z50.\nG1 X8. F100.\nM9\nM5\nM30\n";
    let goes_on = format!("{FANUC}M8\nG1 X5. F100.\nT2 M6\n{cut}");
    let refused = refusal(to((&goes_on, "haas-ngc", ""), "fanuc-30i", "", &Options::default()));
    assert!(refused.message.contains("coolant"), "{refused}");
    for again in ["M9\nT2 M6", "T2 M6\nM8"] {
        let source = format!("{FANUC}M8\nG1 X5. F100.\n{again}\n{cut}");
        text(to((&source, "haas-ngc", ""), "fanuc-30i", "", &Options::default()));
    }
}

#[test]
fn a_program_of_a_lathe_is_refused_with_the_cause() {
    let source = "G21 G18 G99 G40\nT0101\nG97 S1000 M3\nG0 X40. Z2.\nG1 Z-20. F0.2\nX50.\nG0 X80. Z50.\nM30\n";
    for target in ["sinumerik-840d", "fanuc-30i", "okuma-osp"] {
        let from = (source, "fanuc-30i-lathe-a", "lathe-2axis");
        let refused = refusal(to(from, target, "lathe-2axis", &Options::default()));
        assert!(
            refused.message.contains("lathe") && refused.message.contains("diameters"),
            "{target}: {refused}"
        );
    }
}
