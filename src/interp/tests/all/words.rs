//! What single words and codes do to the position that other tests do not show.
use crate::support::{line, lines, run_bytes, run_text};
use trunnion_interp::{Feed, Setup, Tool, WorkOffset};

#[test]
fn incremental_holds_for_rotary_axes_too() {
    assert_eq!(
        lines("iso-6983", "G0 X1 C10\nG91 X1 C5\nC-20\n"),
        ["R X1 C10", "R X2 C15", "R X2 C-5"]
    );
}

#[test]
fn machine_coordinates_under_incremental_words_are_unknown() {
    assert_eq!(
        lines("fanuc-30i", "G0 X1. Y1. Z1.\nG91\nG53 G0 X300.\n"),
        ["R X1 Y1 Z1", "U Y1 Z1 machine"]
    );
}

#[test]
fn machine_coordinates_know_every_zero_and_the_tool_length() {
    let mut values = [0.0; 9];
    (values[1], values[2], values[5]) = (20.0, 30.0, 40.0);
    let setup = Setup {
        work_offsets: vec![WorkOffset {
            name: "G54".to_owned(),
            values,
        }],
        tools: vec![Tool {
            number: 1,
            shape: None,
            diameter_mm: None,
            length_mm: Some(7.0),
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let source = b"G54 G0 X1. Y2. Z3. C4.\nG43 H1 Z3.\nG53 G0 X300.\nX5.\nM30\n";
    let got: Vec<_> = run_bytes("fanuc-30i", source, &setup)
        .1
        .motions
        .iter()
        .map(line)
        .collect();
    assert_eq!(got[2..], ["R X300 Y22 Z40 C44 machine", "R X5 Y2 Z3 C4"]);
}

#[test]
fn the_shorter_way_is_shorter_beyond_half_a_turn() {
    assert_eq!(
        lines("sinumerik-840d", "G0 C0\nC=DC(200)\nC=DC(20)\nC=DC(310)\n"),
        ["R C0", "R C-160", "R C20", "R C-50"]
    );
}

#[test]
fn a_subprogram_may_have_changed_the_feed() {
    let log = run_text("fanuc-30i", "G1 X1. F100.\nM98 P1\nG1 X2.\n");
    assert_eq!(
        [log.motions[0].feed, log.motions[1].feed],
        [Feed::PerMinute(100.0), Feed::Unknown]
    );
}
