//! A feed motion while the spindle does not turn.
//!
//! # Why
//! The tool is pushed through the material without turning: it breaks, or tears the part out of its fixture.
//! Typical causes are M5 instead of M3, a spindle that is not switched on again after a tool change and `S0 M3`.
//!
//! # Example
//! ```gcode
//! N10 M3 S8000
//! N20 G1 X0 Y0 Z2 F200
//! N30 M5
//! N40 G1 Z-5
//! ;   ^^^^^^ spindle-off-cut: this feed motion runs with the spindle off
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 M3 S8000
//! N20 G1 X0 Y0 Z2 F200
//! N30 G1 Z-5
//! N40 M5
//! ```
//!
//! # Guarantee
//! Sound for programs that switch the spindle by codes that are modelled; one finding for each stretch of feed motions
//! between two changes of the spindle. Where nothing in the program starts a spindle, `spindle-unset` reports that once
//! instead: the tool may be one that does not turn. M6 stops the spindle on some controls (Haas, LinuxCNC), M0 on some
//! (Haas, Klartext). On the others the machine builder decides that, as a parameter does after a tap: feed motions after
//! them without a new M3 or M4 are unknown.
//! S0 is not reported where the dialect says that S may be the power of a laser (grbl), and is a warning where other
//! motions of the same tool have a speed. Where the same tool probes (G38.2 to G38.5, G31) without a cut with a turning
//! spindle between, it is unknown whether the motion cuts, and in a subprogram that starts no spindle it is not reported: the tool is a
//! probe, or is measured. Where a code opens or closes the chuck of a lathe among the feed motions, it is unknown whether
//! they cut or a bar puller moves the bar. Before the first code of the spindle its state is unknown, as it is in a subprogram and after
//! a code of the machine builder. Feed motions in machine coordinates, and probing, are not judged. Whether there is
//! material is not known.
//!
//! # Sources
//! * docs/contract.md#what-counts-as-a-cut
use crate::cuts::{Still, StillCuts};
use crate::prelude::*;
use trunnion_dialect::Code;
use trunnion_syntax::{Address, BlockId, Value, Word};

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Still(check)]);

fn check(still: &StillCuts, out: &mut Reporter<'_>) {
    let laser = out.dialect().advice.s_may_be_power;
    if still.why == Still::NoSpeed && (laser || still.other_speed && !out.once(0)) {
        return;
    }
    match still.why {
        Still::Off if still.probes => out
            .report_block("this feed motion runs with the spindle off: whether it cuts, or moves a probe or a tool that is measured, is not known")
            .severity(Info)
            .unknown()
            .note("the same tool probes near it")
            .help("switch the spindle on (M3, M4) before the first cut, or allow the rule and give that reason"),
        Still::Off if moves_chuck(out, still) => out
            .report_block("this feed motion runs with the spindle off: whether it cuts, or a bar puller moves the bar, is not known")
            .severity(Info)
            .unknown()
            .note("the chuck opens or closes among these feed motions")
            .help("switch the spindle on (M3, M4) before the first cut, or allow the rule and give that reason"),
        Still::Off => out
            .report_block("this feed motion runs with the spindle off")
            .note("the program switched the spindle off earlier, by M5 or by a tool change")
            .help("switch the spindle on (M3, M4), or use a rapid; if the tool does not turn (probe, drag knife), allow the rule and give that reason"),
        Still::Left => out
            .report_block("whether the spindle turns in this feed motion is not known: the tool change, the program stop or the tap before it may have stopped the spindle")
            .severity(Info)
            .unknown()
            .note("the machine builder, or a parameter of the control, decides whether the spindle goes on")
            .help("write M3 or M4 before this cut"),
        Still::NoSpeed => {
            let draft = out.report_block("this feed motion runs with S0: the spindle is on and does not turn");
            if still.other_speed {
                draft
                    .severity(Warning)
                    .note("other feed motions of the same tool have a speed: if S is the power of a laser, this is intended")
                    .help("program S above zero; for a laser, allow the rule and give that reason")
            } else {
                draft.help("program S above zero, for example S8000 M3")
            }
        }
        Still::SpeedUnsaid | Still::NeverStarted | Still::StartedLater => return,
    }
    .spans(still.count, still.last);
}

/// Whether a code of the stretch opens or closes the chuck of a lathe.
fn moves_chuck(out: &Reporter<'_>, still: &StillCuts) -> bool {
    let of_chuck = |code: &&Code| code.group.as_deref() == Some("chuck");
    let codes: Vec<&Code> = out.dialect().codes().iter().filter(of_chuck).collect();
    let moves = |word: Word| match (word.address, word.value) {
        (Address::Letter(b'M'), Value::Number(number)) => {
            let id = format!("M{}", number.to_f64());
            codes.iter().any(|code| code.id == id)
        }
        _ => false,
    };
    let program = out.program();
    !codes.is_empty() && (still.first.0..=still.last.0).any(|block| program.block(BlockId(block)).words().any(moves))
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;
    use crate::{Settings, Severity, Status, check};
    use trunnion_interp::Setup;

    #[test]
    fn an_unknown_spindle_is_no_finding() {
        assert_drawn("gcode", "G0 X0\nG1 X10 F100\nM3 S100\nX20\nM5\nG0 X30\n");
    }

    /// The change program of the machine builder decides it; Haas documents that the spindle stops.
    #[test]
    fn a_spindle_after_a_tool_change_is_unknown_until_it_is_started() {
        let body = "G21 G90\nT1 M6\nM3 S100\nG1 X10. F100.\nT2 M6\nX20.\nX30.\nM3\nX40.\nM5\nT3 M6\nX50.\nM30\n";
        for (dialect, wanted) in [
            ("fanuc-30i", vec![(Status::Unknown, 2), (Status::Fail, 1)]),
            ("sinumerik-840d", vec![(Status::Unknown, 2), (Status::Fail, 1)]),
            ("haas-ngc", vec![(Status::Fail, 2), (Status::Fail, 1)]),
            // T turns the turret
            ("fanuc-30i-lathe-a", vec![(Status::Fail, 1)]),
        ] {
            let dialect = trunnion_dialect::builtin(dialect).expect("built in");
            let settings = Settings::new(dialect, None, Setup::default());
            let report = check(
                &trunnion_syntax::parse(body.as_bytes().to_vec(), dialect.lex),
                &settings,
            );
            let own = report.diagnostics.iter().filter(|d| d.rule == "spindle-off-cut");
            assert_eq!(
                own.map(|d| (d.status, d.count)).collect::<Vec<_>>(),
                wanted,
                "{}",
                dialect.name
            );
        }
    }

    #[test]
    fn consecutive_blocks_are_told_once() {
        let report = assert_drawn(
            "gcode",
            "M3 S100\nG1 X10 F100\nM5\nX20\n;^^ spindle-off-cut: \nX30\nX40\nM3\nX50\n",
        );
        assert_eq!(report.diagnostics[0].count, 3);
    }

    #[test]
    fn each_stretch_between_two_changes_is_one_finding() {
        let report = assert_drawn(
            "gcode",
            "M3 S100\nG1 X10 F100\nM5\nX20\n;^^ spindle-off-cut: \nG0 X0\nG1 X40\nM3\nX50\nM5\nX60\n;^^ spindle-off-cut: \nG0 X0\nX61\n",
        );
        assert_eq!(report.diagnostics.iter().map(|d| d.count).collect::<Vec<_>>(), [2, 1]);
    }

    /// A bar puller moves the bar while the chuck is open and the spindle stands.
    #[test]
    fn a_bar_is_pulled_with_the_spindle_off() {
        let status = |body: &str| {
            let dialect = trunnion_dialect::builtin("haas-lathe").expect("built in");
            let text =
                format!("O1\nG21 G18 G99 G40\nT0101\nM3 S500\nG1 X40. Z2. F.2\nM5\nT0202\nG1 Z-20. F5.\n{body}\nM30\n");
            let program = trunnion_syntax::parse(text.into_bytes(), dialect.lex);
            let report = check(&program, &Settings::new(dialect, None, Setup::default()));
            let own = report.diagnostics.iter().filter(|d| d.rule == "spindle-off-cut");
            own.map(|d| (d.status, d.count)).collect::<Vec<_>>()
        };
        assert_eq!(status("M11\nG1 Z5. F5.\nM10\nG1 Z9."), [(Status::Unknown, 3)]);
        assert_eq!(status("G1 Z5. F5.\nG1 Z9."), [(Status::Fail, 3)]);
    }

    #[test]
    fn a_spindle_without_a_speed_does_not_turn() {
        let report = assert_drawn(
            "gcode",
            "S0 M3\nG1 X10 F100\n;^^^^^^^^^^ spindle-off-cut: this feed motion runs with S0\nX20\n",
        );
        assert_eq!(report.diagnostics[0].severity, Severity::Error);
    }

    #[test]
    fn s0_of_a_laser_is_a_warning_at_most() {
        let text = "G21 M3 S0\nG1 X10 F100\n;^^^^^^^^^^ spindle-off-cut: this feed motion runs with S0\nX20 S90\nX30 S0\nX40 S90\nX50 S0\n";
        let report = assert_drawn("gcode", text);
        assert_eq!(report.diagnostics[0].severity, Severity::Warning);
        assert_drawn("gcode grbl", "G21 M3 S0\nG1 X10 F100\nX20 S90\n");
    }

    #[test]
    fn a_tool_that_probes_need_not_turn() {
        let found = |text: &str| {
            let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
            let settings = Settings::new(dialect, None, Setup::default());
            let report = check(
                &trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex),
                &settings,
            );
            let own = report.diagnostics.iter().filter(|d| d.rule == "spindle-off-cut");
            own.map(|d| (d.severity, d.status == Status::Unknown, d.count))
                .collect::<Vec<_>>()
        };
        let main = "G21 G90 G54\nM3 S100\nG1 X10 F100\nT2 M6\nG1 Z5 F100\nG38.2 Z-10 F50\nG1 Z5\n";
        assert_eq!(found(&format!("{main}M2\n")), [(Severity::Info, true, 2)]);
        // another tool, or a cut between, is not that of the probe
        assert_eq!(
            found(&format!("{main}T3 M6\nG1 Z1\nM2\n")),
            [(Severity::Info, true, 2), (Severity::Error, false, 1)]
        );
        assert_eq!(
            found(&format!("{main}M3\nG1 Z1\nM5\nG1 Z0\nM2\n")),
            [(Severity::Info, true, 2), (Severity::Error, false, 1)]
        );
        let measures =
            |probe: &str| format!("o<setter> sub\nT1 M6\nG1 Z5 F100\n{probe}\nG1 Z5\no<setter> endsub\nM2\n");
        assert_eq!(found(&measures("G38.2 Z-10 F50")), []);
        assert_eq!(found(&measures("G1 Z-10 F50")), [(Severity::Error, false, 3)]);
    }

    #[test]
    fn an_own_table_keeps_what_s_means() {
        let table = "name = \"mine\"\nextends = \"grbl\"\n";
        let dialect = trunnion_dialect::Dialect::from_table(table, "mine.toml").expect("a table");
        let dialect: &'static _ = Box::leak(Box::new(dialect));
        let settings = Settings::new(dialect, None, Setup::default());
        let text = "$H\nG21 M3 S0\nG1 X10 F100\nX20 S90\nM5\nM2\n";
        let report = check(
            &trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex),
            &settings,
        );
        let errors = report.diagnostics.iter().filter(|d| d.severity == Severity::Error);
        assert_eq!(errors.map(|d| d.rule).collect::<Vec<_>>(), [] as [&str; 0]);
        let homing = report
            .diagnostics
            .iter()
            .find(|d| d.rule == "not-modelled")
            .expect("$H");
        assert!(homing.message.contains("homing"), "{}", homing.message);
    }

    #[test]
    fn a_spindle_that_stops_before_the_first_cut_is_off() {
        assert_drawn(
            "gcode",
            "M3 S100\nM5\nG1 X10 F100\n;^^^^^^^^^^ spindle-off-cut: \nM30\n",
        );
    }

    #[test]
    fn a_code_of_the_builder_may_start_the_spindle() {
        let text = "O1\nG21 M5\nM13\n;^^ unknown-code: fanuc-30i leaves M13\nG1 X10. F100.\nM133\n;^^^ unknown-code: fanuc-30i leaves M133\nX20.\nM30\n";
        assert_drawn("gcode fanuc-30i", text);
    }
}
