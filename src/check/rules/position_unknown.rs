//! A feed motion ends, an arc starts, or a rapid from a known position ends, at an unknown position.
//!
//! # Why
//! Some axis was never positioned, or its position was lost where something is not modelled. The positions of the
//! axes are unknown, so limits, postures, speeds and the tip's path were not checked there. An axis that is not
//! programmed is not assumed to be at zero. A work offset in a rotary axis under tool centre point control is
//! reported in the same way: controls differ in what it does to X Y Z. So is a position of the rotary axes at which
//! the linear axes do not span space. Motions under tool centre point control that turn a rotary axis by more than
//! 8 deg are computed up to a number of them; the paths of those after them are unknown.
//!
//! # Example
//! ```gcode mikron-ucp710
//! N10 G0 X0 Y0 Z50
//! N20 G1 X10 F500
//! ;   ^^^^^^^^^^^ position-unknown: the position of A and C is unknown
//! ```
//!
//! # Use instead
//! ```gcode mikron-ucp710
//! N10 G0 X0 Y0 Z50 A0 C0
//! N20 G1 X10 F500
//! ```
//!
//! # Guarantee
//! Sound; reported once for each set of axes, and once for a subprogram that is run alone and relies on codes of its caller. Rapid moves before every axis has been positioned are normal and are
//! not reported.
//!
//! # Sources
//! * docs/contract.md#unknown-positions
use crate::place::code_range;
use crate::prelude::*;
use trunnion_interp::{AXIS_LETTERS, MotionKind, Swivel};
use trunnion_machine::NoStance;

pub(super) const RULE: Body = Body::sound(
    Info,
    &[Wake::LostEnd(check), Wake::LostArc(lost_arc), Wake::End(of_caller)],
);

fn check(lost: &facts::LostEnd<'_>, out: &mut Reporter<'_>) {
    let motion = lost.motion();
    if *lost.why == NoStance::Singular {
        return singular(lost, out);
    }
    // programs begin with rapids before every axis is positioned
    let nowhere = || {
        let retracts = motion.tilt.swivel == Swivel::AxesLost;
        lost.leg.start.is_some() || lost.leg.taken_away || motion.says_way & !motion.end.known != 0 || retracts
    };
    if !(motion.is_feed() || motion.kind == MotionKind::Rapid && nowhere()) {
        return;
    }
    match lost.why {
        NoStance::PositionUnknown(letters) => not_positioned(letters, lost, out),
        NoStance::RotaryOffset(axis) => rotary_offset(*axis, lost, out),
        NoStance::TurnsSpent(most) => turns_spent(*most, lost, out),
        NoStance::HeldElsewhere { axis, value, held } => held_elsewhere(*axis, [*value, *held], lost, out),
        // a feed motion is `tilted-plane-misaligned`
        NoStance::PlaneMisaligned(_) if !motion.is_feed() => misaligned(lost, out),
        _ => {}
    }
}

/// A subprogram that is run alone moves as its caller has set it.
fn of_caller(ending: &Ending<'_>, out: &mut Reporter<'_>) {
    let Some((block, codes)) = &ending.of_caller else {
        return;
    };
    out.report(code_range(out.program(), *block), format!("this subprogram does not say {}: its caller does", codes.join(" ")))
        .note("it was checked as if they were in effect")
        .help("check the program that calls it, write the codes into the subprogram, or assume the usual state: --assume power-on")
        .unknown();
}

/// The run has no more work for motions in which rotary axes turn far.
fn turns_spent(most: u64, lost: &LegView<'_>, out: &mut Reporter<'_>) {
    out.unknown(lost, Merge::once(hash("turns")), |draft| {
        draft
            .say("the path of this motion is not computed: the rotary axes turn by more than 8 deg in too many motions")
            .note(format!(
                "together these turns take more than {most} pieces of 2 deg, half of `[limits] steps`; posture, speeds and deviation are not checked here"
            ))
            .help("divide the program, or raise `[limits] steps` in trunnion.toml (--max-steps)");
    });
}

/// A rapid in a tilted plane before the tool is perpendicular to it.
fn misaligned(lost: &LegView<'_>, out: &mut Reporter<'_>) {
    out.unknown(lost, Merge::once(hash("misaligned")), |draft| {
        draft
            .say("end position of this rapid is unknown: the tool is not perpendicular to the tilted plane")
            .note("X Y Z are coordinates of the tilted plane; while the tool is not perpendicular to it, the axes are not followed")
            .help("turn the tool perpendicular to the plane first (G53.1, PLANE ... TURN or MOVE, or CYCLE800 with a direction)");
    });
}

/// The linear axes cannot reach the tip.
fn singular(lost: &LegView<'_>, out: &mut Reporter<'_>) {
    out.unknown(lost, Merge::once(hash("singular")), |draft| {
        draft
            .say("the position of the linear axes is unknown: at this position of the rotary axes they do not span space, and no position or many give the tip")
            .note(format!(
                "{} has linear axes on both sides of a rotary axis, and here two of them are parallel, or all in a plane",
                lost.machine.id
            ))
            .note("limits, speeds and the tip's path are not checked here")
            .help("turn the rotary axes to another position");
    });
}

/// Some axes have no position.
fn not_positioned(letters: &str, lost: &LegView<'_>, out: &mut Reporter<'_>) {
    let rapid = !lost.motion().is_feed();
    let cause = hash(letters) ^ u64::from(!rapid);
    out.unknown(lost, Merge::once(cause), |draft| {
        let names: Vec<String> = AXIS_LETTERS
            .iter()
            .map(|axis| letter(*axis))
            .filter(|axis| letters.contains(axis))
            .collect();
        let names = match names.as_slice() {
            [] => "some axis".to_owned(),
            [one] => one.clone(),
            [most @ .., last] => format!("{} and {last}", most.join(", ")),
        };
        let verb = if letters.len() > 1 { "are" } else { "is" };
        let (message, why, help) = if rapid {
            (
                format!("end position of this rapid is unknown: {names} {verb} not determined"),
                "it depends on a value that only the machine knows, on an undeclared reference point, or on a position that was already unknown",
                format!("program {names} as numbers, or declare what is missing ([control] reference_points or fixed_points, [variables])"),
            )
        } else {
            (
                format!("the position of {names} is unknown"),
                "it was never programmed, or it was lost where something is not modelled",
                format!("position {names} before the first feed motion"),
            )
        };
        draft
            .say(message)
            .note(format!(
                "{why}: the axis positions of {} are unknown here",
                lost.machine.id
            ))
            .note("limits, postures, speeds and the tip's path are not checked until every axis has a position")
            .help(help);
    });
}

/// Its end is known, its path is not: reported once.
fn lost_arc(arc: &facts::LostArc<'_>, out: &mut Reporter<'_>) {
    out.unknown(arc, Merge::once(u64::MAX), |draft| {
        draft
            .say("the path of this arc is unknown: X, Y and Z at its start were never programmed, or were lost")
            .note("limits, speeds and the tip's path are not checked in this block")
            .help("program X, Y and Z in a straight motion before the arc: after tool centre point control is switched, they refer to a different point");
    });
}

/// A work offset turns the workpiece frame: reported once for each axis.
fn rotary_offset(axis: u8, lost: &LegView<'_>, out: &mut Reporter<'_>) {
    out.unknown(lost, Merge::once(u64::from(axis)), |draft| {
        let name = letter(axis);
        draft
            .say(format!("the position of X, Y and Z is unknown: the work offset turns {name}"))
            .note(format!(
                "it depends on the control whether X Y Z of the tip turn with an offset in {name}: the axis positions of {} are unknown here",
                lost.machine.id
            ))
            .note("limits, postures, speeds and the tip's path are not checked here")
            .help(format!("program the turn of {name} instead of setting it in the work offset"));
    });
}

/// The program moves an axis that the machine file holds: reported once for each axis and position.
fn held_elsewhere(axis: u8, [value, held]: [f64; 2], lost: &LegView<'_>, out: &mut Reporter<'_>) {
    let cause = hash(&format!("{} {value}", char::from(axis)));
    out.unknown(lost, Merge::once(cause), |draft| {
        let name = letter(axis);
        draft
            .say(format!(
                "the position of X, Y and Z is unknown: {name} is at {}, but the machine file holds it at {}",
                degrees(value),
                degrees(held)
            ))
            .note(format!(
                "{} has more rotary axes than the kinematics can solve, so {name} is held at the position in the machine file",
                lost.machine.id
            ))
            .note("limits, postures, speeds and the tip's path are not checked here")
            .help(format!(
                "check this part of the program with a copy of the machine file that says hold = {} for {name}",
                deg(value)
            ));
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_rapid_in_a_plane_on_which_the_tool_does_not_stand() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "G0 X0 Y0 Z50 A0 C0\nCYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,0)\nG0 X0 Y0 Z20\n;^^^^^^^^^^^ position-unknown: end position of this rapid is unknown\nCYCLE800()\nM30\n",
        );
    }

    #[test]
    fn a_turn_that_retracts_before_the_axes_are_positioned() {
        for text in [
            "G0 X0 Y0 Z50\nCYCLE800(1,\"\",0,57,0,0,0,10,0,0,0,0,0,-1,0)\n;^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ position-unknown: end position of this rapid is unknown\nG0 X3 Y2 Z1\nM30\n",
            "G0 X0 Y0 Z50 A0 C0\nCYCLE800(1,\"\",0,57,0,0,0,10,0,0,0,0,0,-1,0)\n;^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ position-unknown: end position of this rapid is unknown\nG0 X3 Y2 Z1\nM30\n",
        ] {
            assert_drawn("gcode sinumerik-840d mikron-ucp710", text);
        }
    }

    #[test]
    fn an_offset_in_a_rotary_axis_is_told_once_under_tcp() {
        let text = "G55\nTRAORI\nG1 X10 Y10 Z0 A0 C0 F1000\nX20\n";
        let dialect = trunnion_dialect::builtin("sinumerik-840d").unwrap();
        let mut setup = trunnion_interp::Setup::default();
        setup.work_offsets.push(trunnion_interp::WorkOffset {
            name: "G55".into(),
            values: [0.0, 0.0, 0.0, 0.0, 0.0, 90.0, 0.0, 0.0, 0.0],
        });
        let report = crate::check(
            &trunnion_syntax::parse(text.into(), dialect.lex),
            &crate::Settings::new(dialect, trunnion_machine::builtin("mikron-ucp710"), setup),
        );
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .filter(|d| d.rule == "position-unknown")
            .collect();
        assert_eq!((found.len(), found[0].count), (1, 2));
        assert!(
            found[0].message.ends_with("the work offset turns C"),
            "{}",
            found[0].message
        );
    }

    #[test]
    fn a_held_axis_that_moves_ends_what_is_known() {
        let report = assert_drawn(
            "gcode linuxcnc-xyzacb-trsrn",
            "N1 G0 X0 Y0 Z50 B0 C0\nN2 G1 X10 A0 F500\nN3 X20\nN4 G1 A30\n;  ^^^^^^ position-unknown: the position of X, Y and Z is unknown: A is at 30 deg, but the machine file holds it at 0 deg\nN5 X5\nN6 A0 X0\n",
        );
        assert_eq!(report.diagnostics[0].status, crate::Status::Unknown);
        assert_eq!(report.diagnostics[0].count, 2);
    }

    #[test]
    fn a_rapid_that_moves_a_held_axis_is_told_too() {
        let report = assert_drawn(
            "gcode linuxcnc-xyzacb-trsrn",
            "N1 G0 X0 Y0 Z50 A0 B0 C0\nN2 G0 A30\n;  ^^^^^^ position-unknown: the position of X, Y and Z is unknown: A is at 30 deg\nN3 M2\n",
        );
        assert_eq!(report.diagnostics[0].status, crate::Status::Unknown);
    }

    #[test]
    fn rapids_at_the_start_are_normal_and_one_cause_is_told_once() {
        let report = assert_drawn(
            "gcode mikron-ucp710",
            "N1 G0 X0 Y0\nN2 G0 Z50\nN3 G1 X10 F500\n;  ^^^^^^^^^^^ position-unknown: the position of A and C\nN4 X20\nN5 G0 X0\nN6 G1 X5\n",
        );
        assert_eq!(report.diagnostics[0].status, crate::Status::Unknown);
        assert_eq!(report.diagnostics[0].count, 3);
    }

    /// After a switch of tool centre point control the start of an increment is unknown, in a rapid as well.
    #[test]
    fn a_rapid_by_an_increment_from_nowhere_is_told() {
        let report = assert_drawn(
            "gcode fanuc-30i mikron-ucp710",
            "N1 G90 G21 G0 X0. Y0. Z50. A0. C0.\nN2 G43.4 H1\nN3 G91 G0 X5000.\n;  ^^^^^^^^^^^^^ position-unknown: end position of this rapid is unknown\nN4 G90 G0 X0. Y0. Z60.\nN5 M30\n",
        );
        assert_eq!(report.diagnostics[0].status, crate::Status::Unknown);
    }

    /// What only the machine knows: where a probe touched, where its reference point is.
    #[test]
    fn a_rapid_to_what_only_the_machine_knows_is_told() {
        for line in ["G0 X#5061", "G0 X[1 + #5161]", "G28 Z60", "#1 = #5063\nG0 Z#1"] {
            let text = format!("G21 G90 G0 X1 Y2 Z50 A0 C0\n{line}\nG0 X1 Y2 Z50 A0 C0\nM2\n");
            let report = crate::fixture::Fixture::parse("gcode linuxcnc mikron-ucp710", &text)
                .check()
                .unwrap();
            let said: Vec<_> = report
                .diagnostics
                .iter()
                .map(|found| (found.rule, found.status))
                .collect();
            // a word says why its value is unknown, with or without a machine
            let reason = ("not-modelled", crate::Status::Unknown);
            let own: Vec<_> = said.iter().copied().filter(|found| *found != reason).collect();
            assert_eq!(own, [("position-unknown", crate::Status::Unknown)], "{line}");
            assert_eq!(
                said.len() - own.len(),
                usize::from(!line.starts_with("G28")),
                "{line}: {said:?}"
            );
        }
    }

    /// An arc centre given relative to its start is unknown after a switch of tool centre point control.
    #[test]
    fn an_arc_behind_a_switch_of_tool_centre_point_control_is_told() {
        for arc in [
            "G2 I-5. J18.",
            "G2 X10. Y10. R20.",
            "G3 Z5. C5. I5.",
            "G2 X0. Y0. Z0. I5.",
        ] {
            for [from, to] in [["G43.4 H1", "G49"], ["G49", "G43.4 H1"]] {
                let text = format!("G21 G90 {from}\nG0 X1. Y2. Z50. A50. C0.\n{to}\n{arc} F500\nM30\n");
                let report = crate::fixture::Fixture::parse("gcode fanuc-30i mikron-ucp710", &text)
                    .check()
                    .unwrap();
                let said = |found: &&crate::Diagnostic| found.rule == "position-unknown";
                assert_eq!(report.diagnostics.iter().filter(said).count(), 1, "{arc} {to}");
            }
        }
    }

    /// Words in a system that is not known move the axes, which are not taken to stand where tool centre point control left them.
    #[test]
    fn words_of_an_unknown_system_after_tool_centre_point_control_are_told() {
        for (head, text) in [
            (
                "okuma-osp",
                "G15 H1\nG90 G94\nG169 H1\nG0 X0 Y0 Z50 A0 C0\nG1 X10 Y0 Z5 A20 C30 F500\nG170\nG0 Z100\nM2\n",
            ),
            (
                "sinumerik-840d",
                "G54\nTRAORI\nG0 X0 Y0 Z50 A0 C0\nG1 X10 Z5 A20 C30 F500\nTRAFOOF\nAROT X30\nG0 Z100\nM30\n",
            ),
            (
                "fanuc-30i",
                "G21 G90 G43.4 H1\nG0 X0. Y0. Z50. A0. C0.\nG1 X10. A20. C30. F500.\nG49\nG68 X0 Y0 R30.\nG0 X90.\nM30\n",
            ),
            (
                "heidenhain-klartext",
                "0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F500\nM128\nL X+0 Y+0 Z+50 A+0 C+0 R0 FMAX\nL X+10 Z+5 A+20 C+30 F500\nM129\nCYCL DEF 7.0 D\nCYCL DEF 7.1 #5\nL Z+100 FMAX\nEND PGM A MM\n",
            ),
        ] {
            let report = crate::fixture::Fixture::parse(&format!("gcode {head} mikron-ucp710"), text)
                .check()
                .unwrap();
            let said =
                |found: &&crate::Diagnostic| found.rule == "position-unknown" && found.status == crate::Status::Unknown;
            assert_eq!(
                report.diagnostics.iter().filter(said).count(),
                1,
                "{head}: {:?}",
                report.diagnostics
            );
        }
    }

    #[test]
    fn a_machine_without_rotary_axes_needs_none() {
        assert_drawn("gcode mill-3axis", "N1 G0 X0 Y0\nN2 G0 Z50\nN3 G1 X10 F500\n");
    }

    #[test]
    fn long_turns_beyond_the_bound_are_unknown_once() {
        let mut machine = trunnion_machine::builtin("mikron-ucp710").expect("built in").clone();
        machine.most_turned = 50;
        let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
        let body = "X10. C90.\nX20. C0.\n".repeat(4);
        let text = format!("G21 G90 G94 G54\nT1 M6\nG43.4 H1\nM3 S1000\nG1 X0. Y0. Z0. A-20. C0. F100.\n{body}M30\n");
        let settings = crate::Settings::new(dialect, Some(&machine), trunnion_interp::Setup::default());
        let report = crate::check(&trunnion_syntax::parse(text.into_bytes(), dialect.lex), &settings);
        let own: Vec<_> = report
            .diagnostics
            .iter()
            .filter(|d| d.message.contains("is not computed: the rotary axes turn"))
            .map(|d| (d.status, d.count))
            .collect();
        assert_eq!(own, [(crate::Status::Unknown, 6)], "{:?}", report.diagnostics);
    }
}
