//! Lines of a motion and nothing else take a short path: they give the same motions as with something beside them.
use crate::support::{position, run_text};
use proptest::prelude::*;

/// Lines to draw from: motions, and what changes how they are meant. Numbers are sums of halves, so that offsets round nothing.
const LINES: [&str; 18] = [
    "G1 X1 Y2.5",
    "X3.5 A10",
    "G0 Z4",
    "Y-1.5 F250",
    "G1 Z0.5 C90 F100",
    "X2",
    "G92 X5",
    "G10 L2 P1 X2.5 Y1 R0",
    "G91",
    "G90",
    "G55",
    "G54",
    "G43.1 Z8",
    "G49",
    "G93 G1 X4 F2",
    "G94 F300",
    "G1 X9 Y9 G77.7",
    "M6 T0",
];

/// The motions of a run, those of lines with `M9` beside them as those without.
fn motions(lines: &[usize], beside: &str) -> Vec<String> {
    let mut text = String::from("G21 G90 G94 F100\nG0 X0 Y0 Z0 A0 C0\n");
    for line in lines {
        let line = LINES[*line];
        let is_motion = line.starts_with(['X', 'Y'])
            || ((line.starts_with("G1 ") || line.starts_with("G0 ")) && !line.contains("G77"));
        text += line;
        text += if is_motion { beside } else { "" };
        text += "\n";
    }
    let told = |motion: &trunnion_interp::Motion| {
        let (from, to) = (position(&motion.start), position(&motion.end));
        let (block, kind, feed, length) = (motion.block.0, motion.kind, motion.feed, motion.tool_length_mm);
        let known = motion.zero.map(|zero| if zero.is_nan() { None } else { Some(zero) });
        format!("{block} {kind:?} {from} to {to} {feed:?} {known:?} {length}")
    };
    run_text("linuxcnc", &text).motions.iter().map(told).collect()
}

proptest! {
    #[test]
    fn what_stands_beside_a_motion_changes_none(lines in proptest::collection::vec(0..LINES.len(), 1..14)) {
        let (alone, beside) = (motions(&lines, ""), motions(&lines, " M9"));
        prop_assert_eq!(alone, beside);
    }
}
