//! A tool moves along Z or cuts before its length is compensated, or with the length of another tool.
//!
//! # Why
//! Without G43 the control moves the spindle nose, not the tip, to the programmed point: the tool goes too deep by
//! its whole length, or does not reach the part. What counts is the compensation that is active at the tool's first
//! rapid to another Z and at its first feed motion, in whichever block it was switched on.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 T5 M6
//! N20 M3 S5000
//! N30 G0 X0. Y0. Z50.
//! ;   ^^^^^^^^^^^^^^^ missing-tool-length: T5 goes to Z 50 mm without its length
//! N40 G1 Z-5. F200.
//! N50 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 T5 M6
//! N20 M3 S5000
//! N30 G0 X0. Y0.
//! N35 G43 H5 Z50.
//! N40 G1 Z-5. F200.
//! N50 M30
//! ```
//!
//! # Guarantee
//! Heuristic: a program without G43 is right where all lengths are included in the work offset, or where the
//! builder's tool change switches the length on; an offset with a number other than that of the tool is right in shops that
//! number them like that. Reported once for each tool, and once more
//! where a tool cuts without the length, or with another tool's, after it has cut with one. The first cut counts only for controls that switch the length on by G43, and for tools
//! that the program changes to.
//!
//! # Sources
//! * Haas 96-8210 (mill operator's manual): setting 15, H and T code agreement.
//! * docs/contract.md#offsets-and-tool-lengths
use crate::prelude::*;
use crate::view::InForce;
use trunnion_dialect::ToolWord;
use trunnion_interp::LengthOf;

pub(super) const RULE: Body = Body::heuristic(
    Warning,
    &[
        Wake::FirstCut(check),
        Wake::FirstApproach(approach),
        Wake::LengthLeft(left),
    ],
);

fn check(cut: &facts::FirstCut<'_>, out: &mut Reporter<'_>) {
    let (motion, in_force) = (cut.motion, cut.in_force);
    let Some(tool @ 1..) = motion.tool else { return };
    if cut.dialect.quirks.tool_word == ToolWord::ChangesWithOffset {
        return offset(tool, cut, out);
    }
    // where a tool change selects its first edge, no length at all means that the program switched it off (D0)
    let by_edge = cut.dialect.quirks.edge_at_tool_change;
    if !(cut.dialect.length_by_code() || by_edge && in_force.tool_length_mm.is_none()) || !out.once(u64::from(tool)) {
        return;
    }
    if motion.tcp || motion.machine_coordinates || in_force.frame_unknown {
        return;
    }
    let help = if by_edge {
        "write D1, or the edge that is meant, before the first Z move".to_owned()
    } else {
        format!("write G43 H{tool} with the first Z move after the tool change")
    };
    match (in_force.tool_length_mm, motion.other_length(in_force.own_length_mm)) {
        // G43 H0: the length of nothing
        (Some(_), None) if by_nothing(in_force) => {
            out.report_block(format!(
                "T{tool} cuts without its length: the compensation that is active has length zero (H0)"
            ))
            .help(help);
        }
        (Some(active), Some(own)) if !motion.undeclared.length => {
            out.report_block(format!(
                "T{tool} is {} long, but cuts with an active length compensation of {}",
                mm(own),
                mm(active)
            ))
            .help(help)
            .value("tool_length_mm", own)
            .value("length_in_force_mm", active);
        }
        (Some(_), _) => {
            // where both lengths are declared they are the same
            let known = in_force.own_length_mm.is_some() && !motion.undeclared.length;
            if let LengthOf::Tool(Some(number)) = in_force.length_of
                && number != tool
                && !known
            {
                out.report_block(format!(
                    "T{tool} cuts with the length offset H{number}, which is that of another tool"
                ))
                .help(format!(
                    "write H{tool}; if the offset is the tool's own, declare both lengths, or allow the rule and give that reason"
                ));
            }
        }
        (None, _) => {
            out.report_block(format!(
                "T{tool} cuts without its length: no tool length compensation is active"
            ))
            .help(help);
        }
    }
}

/// A length compensation is on, with the length zero that H0 gives.
fn by_nothing(in_force: &InForce) -> bool {
    in_force.length_of == LengthOf::Nothing && in_force.tool_length_mm == Some(0.0)
}

/// A cut of a lathe: the last two digits of T are the offset of its tool.
fn offset(tool: u32, cut: &facts::FirstCut<'_>, out: &mut Reporter<'_>) {
    let what = match cut.in_force.length_of {
        LengthOf::Offset(Some(number)) if number == tool => return,
        LengthOf::Offset(Some(number)) => format!("with the offset {number}, which is that of another tool"),
        LengthOf::Offset(None) => "with an offset that is not known: T has no two digits for it".to_owned(),
        _ => "without an offset".to_owned(),
    };
    if !cut.motion.machine_coordinates && out.once(u64::from(tool)) {
        out.report_block(format!("T{tool} cuts {what}")).help(format!(
            "write T{tool:02}{tool:02}; if the offset is the tool's own, allow the rule and give that reason"
        ));
    }
}

/// A rapid to another Z with a new tool: its tip is lower by its whole length.
fn approach(rapid: &facts::FirstApproach<'_>, out: &mut Reporter<'_>) {
    let (motion, in_force) = (rapid.motion, rapid.in_force);
    let (Some(tool @ 1..), Some(level)) = (motion.tool, motion.end.get(2)) else {
        return;
    };
    let uncompensated =
        (in_force.tool_length_mm.is_none() || by_nothing(in_force)) && !motion.tcp && !in_force.frame_unknown;
    if uncompensated && rapid.dialect.length_by_code() && out.once(u64::from(tool)) {
        out.report_block(format!(
            "T{tool} goes to Z {} without its length: no tool length compensation is active, and its tip is lower by its length",
            mm(level)
        ))
        .help(format!("write G43 H{tool} in this block"));
    }
}

/// A cut after which the same tool cuts with its length switched off, or with the length of another tool.
fn left(cut: &facts::LengthLeft<'_>, out: &mut Reporter<'_>) {
    const LEFT: u64 = 1 << 40;
    let (motion, in_force) = (cut.motion, cut.in_force);
    let Some(tool @ 1..) = motion.tool else { return };
    if motion.tcp || motion.machine_coordinates || in_force.frame_unknown || cut.dialect.quirks.diameter {
        return;
    }
    // `other-tool-length` reports a turn with a declared length that is not in effect
    let turns = (3..6).any(|axis| motion.start.get(axis) != motion.end.get(axis));
    if turns && out.judges_machine() && in_force.own_length_mm.is_some() {
        return;
    }
    // LinuxCNC's G49 moves nothing: the coordinates change with the length
    let by_zero = in_force.length_of == LengthOf::Nothing && !cut.dialect.quirks.rs274();
    match (in_force.tool_length_mm.filter(|_| !by_zero), in_force.length_of) {
        (None, _) if out.once(LEFT | u64::from(tool)) => out
            .report_block(format!(
                "T{tool} cuts without its length, which was compensated in the cut before: it was switched off between them"
            ))
            .help("switch the length on again before this cut, or retract in rapid"),
        (Some(_), LengthOf::Tool(Some(number)))
            if number != tool && cut.dialect.length_by_code() && out.once(LEFT | u64::from(tool)) =>
        {
            out.report_block(format!(
                "T{tool} cuts with the length offset H{number}, which is that of another tool, and cut with another one before"
            ))
            .help(format!("write H{tool}, or allow the rule and give the reason"))
        }
        _ => return,
    };
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_rapid_to_another_z_counts_before_the_first_cut() {
        let first = "T1 M6\nS100 M3\nG0 X0. Y0.\n";
        assert_drawn(
            "gcode fanuc-30i",
            &format!(
                "{first}Z5.\n;^^ missing-tool-length: T1 goes to Z 5 mm without its length\nG43 H1 Z2.\nG1 Z-1. F100.\nM30\n"
            ),
        );
        for text in [
            "G43 H1 Z5.\nG1 Z-1. F100.\nG0 G49 Z100.\nM30\n",
            "G53 G0 Z0.\nG43 H1 Z5.\nG1 Z-1. F100.\nM30\n",
        ] {
            assert_drawn("gcode fanuc-30i", &format!("{first}{text}"));
        }
        assert_drawn(
            "gcode sinumerik-840d",
            "T1\nM6\nS100 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nM30\n",
        );
    }

    /// H0 is no length.
    #[test]
    fn the_length_zero_is_missing() {
        let text = "T1 M6\nS100 M3\nG0 X0. Y0.\nG43 H0 Z5.\n;^^^^^^^^^ missing-tool-length: T1 goes to Z 5 mm without its length\nG1 Z-1. F100.\nM30\n";
        assert_drawn("gcode fanuc-30i", text);
        let late = "T1 M6\nS100 M3\nG0 X0. Y0.\nG43 H0\nG1 Z-1. F100.\n;^^^^^^^^^^^^ missing-tool-length: T1 cuts without its length: the compensation that is active has length zero (H0)\nM30\n";
        assert_drawn("gcode haas-ngc", late);
    }

    /// Out of the cut a length may be switched off; in the next cut it is missing.
    #[test]
    fn a_length_that_is_switched_off_between_cuts_is_missing() {
        let first = "T1 M6\nS100 M3\nG43 H1 G0 X0. Y0. Z5.\nG1 Z-1. F100.\n";
        for (rest, dialect) in [
            (
                "G49\n;^^ not-modelled: not modelled: a tool length that ends\nG1 X5. Z-1.\n;^^^^^^^^^^ missing-tool-length: T1 cuts without its length, which was compensated in the cut before\nX6.\nM30\n",
                "fanuc-30i",
            ),
            (
                "G43 H2\n;^^^^^ not-modelled: not modelled: a tool length that ends\nG1 X5. Z-1.\n;^^^^^^^^^^ missing-tool-length: T1 cuts with the length offset H2\nX6.\nM30\n",
                "fanuc-30i",
            ),
            (
                "G49\n;^^ not-modelled: not modelled: a tool length that ends\nG0 Z50.\nM30\n",
                "fanuc-30i",
            ),
            (
                "G49\n;^^ not-modelled: not modelled: a tool length that ends\nG43 H1\nG1 X5.\nM30\n",
                "fanuc-30i",
            ),
        ] {
            assert_drawn(&format!("gcode {dialect}"), &format!("{first}{rest}"));
        }
        assert_drawn(
            "gcode sinumerik-840d",
            "G710\nT1 M6\nD0\nS100 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\n;^^^^^^^^^^ missing-tool-length: T1 cuts without its length\nM30\n",
        );
        assert_drawn(
            "gcode sinumerik-840d",
            "T1 M6\nD1 S100 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nD0\nX5\n;^ missing-tool-length: T1 cuts without its length\nM30\n",
        );
    }

    #[test]
    fn the_number_of_another_tool_is_told_where_the_lengths_are_not_declared() {
        let text = |tools: &str, finding: &str| {
            format!("{tools}T5 M6\nS100 M3\nG43 H6 G0 X0. Y0. Z5.\nG1 Z-1. F100.\n{finding}G0 Z5.\nM30\n")
        };
        let finding =
            ";^^^^^^^^^^^^ missing-tool-length: T5 cuts with the length offset H6, which is that of another tool\n";
        assert_drawn("gcode haas-ngc", &text("", finding));
        assert_drawn("gcode haas-ngc", &text("(trunnion: tool 6 length 80)\n", finding));
        // declared alike
        let both = "(trunnion: tool 5 length 80)\n(trunnion: tool 6 length 80)\n";
        assert_drawn("gcode haas-ngc", &text(both, ""));
    }

    #[test]
    fn t_of_a_lathe_names_the_offset_of_its_tool() {
        for (t, finding) in [
            ("T0202", ""),
            ("T202", ""),
            ("T0203", ";^^^^^^^^^^^ missing-tool-length: T2 cuts with the offset 3\n"),
            ("T0200", ";^^^^^^^^^^^ missing-tool-length: T2 cuts without an offset\n"),
            (
                "T2",
                ";^^^^^^^^^^^ missing-tool-length: T2 cuts with an offset that is not known\n",
            ),
        ] {
            assert_drawn(
                "gcode fanuc-30i-lathe-a",
                &format!("G21 G99 {t}\nG97 S500 M3\nG0 X62. Z5.\nG1 Z-4. F0.2\n{finding}G0 X80.\nM30\n"),
            );
        }
    }

    #[test]
    fn only_the_first_feed_motion_of_a_tool_is_judged() {
        assert_drawn(
            "gcode linuxcnc",
            "T1 M6 S100 M3\nG43 H1 G0 X0 Y0 Z0\nG1 X1 F100\nG49 X2\nM2\n",
        );
        let report = assert_drawn(
            "gcode linuxcnc",
            "T1 M6 S1 M3\nG0 X0 Y0\nG1 X1 F100\n;^^^^^^^^^ missing-tool-length: T1 cuts\nX2\nT1 M6 M3\nG1 X3\nM2\n",
        );
        assert_eq!(report.diagnostics[0].count, 1);
    }

    #[test]
    fn nothing_is_said_without_a_tool_change_or_where_the_tool_word_does_it() {
        assert_drawn("gcode", "G0 X0 Y0 Z0\nG1 X1 F100\n");
        assert_drawn("gcode sinumerik-840d", "T1\nM6\nG1 X1 F100\nM30\n");
    }

    #[test]
    fn the_length_of_another_tool_is_told() {
        assert_drawn(
            "gcode fanuc-30i",
            "(trunnion: tool 1 length 120)\n(trunnion: tool 5 length 80.5)\nT1 M6\nS1 M3\nG0 G43 H5 X0. Y0. Z9.\nG1 X1. F100.\n;^^^^^^^^^^^ missing-tool-length: T1 is 120 mm long, but cuts with an active length compensation of 80.5 mm\nX2.\nM30\n",
        );
    }
}
