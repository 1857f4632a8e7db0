//! A main program cuts, and nothing in it starts the spindle or says how fast it turns.
//!
//! # Why
//! The spindle stands still unless the operator or the previous program has started it, and the tool is pushed through the
//! material without turning. Without any S the control uses the last S of another program, or none.
//!
//! # Example
//! ```gcode
//! N10 G21 G0 X0 Y0 Z2
//! N20 G1 Z-5 F200
//! ;   ^^^^^^^^^^^ spindle-unset: nothing in the program starts a spindle
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G21 G0 X0 Y0 Z2 S8000 M3
//! N20 G1 Z-5 F200
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound; one finding per program, at the first feed motion. Only programs with a program end (M2, M30; FINI of APT) are judged: the
//! caller of a subprogram may start the spindle. After a code of the machine builder, and after a program that was not found,
//! the spindle may turn, and feed motions there are not reported. Where the program starts a spindle later, the feed motions
//! before that are one finding. Feed motions in machine coordinates, and probing, are not judged.
//!
//! # Sources
//! * docs/contract.md#what-counts-as-a-cut
use crate::cuts::{Still, StillCuts};
use crate::prelude::*;
use trunnion_syntax::Format;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Still(check)]);

fn check(still: &StillCuts, out: &mut Reporter<'_>) {
    let start = match out.dialect().lex.format {
        Format::Apt => "SPINDL",
        _ => "S and M3",
    };
    match still.why {
        Still::NeverStarted => out
            .report_block("nothing in the program starts a spindle, and this feed motion needs one unless its tool does not turn")
            .help(format!("write {start} before the first cut; for a pen, a laser or a drag knife, allow the rule and give that reason")),
        Still::StartedLater => out
            .report_block("no spindle is started before this feed motion; the program starts one later")
            .note("the spindle stands still here, unless the operator or the previous program has started it")
            .help(format!("write {start} before the first cut; if the tool does not turn, allow the rule and give that reason")),
        Still::SpeedUnsaid if out.once(0) => out
            .report_block("the spindle was started without a speed: the program gives no S before this feed motion")
            .note("the control uses the S of the previous program, or none")
            .help("write S with M3 or M4, for example S8000 M3"),
        Still::SpeedUnsaid | Still::Off | Still::Left | Still::NoSpeed => return,
    }
    .spans(still.count, still.last);
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;
    use crate::{Settings, Severity, check};
    use trunnion_interp::Setup;

    #[test]
    fn a_program_that_starts_no_spindle_gets_one_warning() {
        for text in [
            "G21 G0 X0\nG1 X10 F100\n;^^^^^^^^^^ spindle-unset: nothing in the program starts a spindle\nG0 X0\nG1 X20\nM30\n",
            "G21 G0 X0\nM5\nG1 X10 F100\n;^^^^^^^^^^ spindle-unset: nothing in the program starts a spindle\nG0 X0\nG1 X20\nM5\nG1 X30\nM30\n",
        ] {
            let report = assert_drawn("gcode", text);
            assert_eq!(report.diagnostics[0].severity, Severity::Warning);
            assert!(report.diagnostics[0].count >= 2);
        }
    }

    #[test]
    fn cuts_before_the_first_start_are_reported() {
        let text = "G21 G17 G90 G94\nG0 X0 S3000\nG1 X10 F100\n;^^^^^^^^^^ spindle-unset: no spindle is started before this feed motion\nX20\nM3 S100\nG1 X30\nM5\nM30\n";
        let report = assert_drawn("gcode", text);
        assert_eq!(report.diagnostics[0].count, 2);
    }

    #[test]
    fn what_may_start_the_spindle_is_believed() {
        for (dialect, text, wanted) in [
            ("fanuc-30i", "O1\nG21 G0 X0.\nG1 X10. F100.\nM30\n", true),
            ("fanuc-30i", "O1\nG21 G0 X0.\nG1 X10. F100.\nM99\n", false),
            ("fanuc-30i", "O1\nG21 G0 X0.\nM13\nG1 X10. F100.\nM30\n", false),
            ("fanuc-30i", "O1\nG21 G0 X0.\nM98 P777\nG1 X10. F100.\nM30\n", false),
            ("fanuc-30i", "O1\nG21 G0 X0.\nG1 X10. F100.\nM98 P777\nM30\n", true),
            ("fanuc-30i", "O1\nG21 G0 X0.\nG1 X10. F100.\nM13\nM30\n", true),
            (
                "fanuc-30i",
                "O1\nG21 G0 X0.\nG1 X10. F100.\nM98 P777\nM3 S100\nM30\n",
                true,
            ),
            ("iso-6983", "G21 G0 X0\nG1 X10 F100\n", false),
            ("apt", "UNITS/MM\nFEDRAT/100\nGOTO/0,0,9\nGOTO/0,0,0\nFINI\n", true),
            ("apt", "UNITS/MM\nFEDRAT/100\nGOTO/0,0,9\nGOTO/0,0,0\n", false),
            (
                "apt",
                "UNITS/MM\nSPINDL/900,CLW\nFEDRAT/100\nGOTO/0,0,9\nGOTO/0,0,0\nFINI\n",
                false,
            ),
            ("linuxcnc", "G21 G0 X0 Y0 Z0\nG1 X10 F100\nM2\n", true),
            ("linuxcnc", "G21 G0 X0 Y0 Z0\nM101\nG1 X10 F100\nM2\n", false),
            ("sinumerik-840d", "G71 G0 X0\nG1 X10 F100\nM30\n", true),
            ("sinumerik-840d", "G71 G0 X0\nS2=500 M2=3\nG1 X10 F100\nM30\n", false),
            ("sinumerik-840d", "PROC SLOT\nG71 G0 X0\nG1 X10 F100\nRET\n", false),
            ("fanuc-30i", "O1\nG21 G0 X0.\nG1 X10. F100.\nM3 S100\nM30\n", true),
            ("fanuc-30i", "O1\nG21 G0 X0.\nM13\nG1 X10. F100.\nM3 S100\nM30\n", false),
            ("fanuc-30i", "O1\nG21 M3\nG1 X10. F100.\nM30\n", true),
            ("fanuc-30i", "O1\nG21 M3\nG1 X10. F100.\nM99\n", false),
        ] {
            let dialect = trunnion_dialect::builtin(dialect).expect("built in");
            let settings = Settings::new(dialect, None, Setup::default());
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
            let report = check(&program, &settings);
            let found = report.diagnostics.iter().any(|d| d.rule == "spindle-unset");
            assert_eq!(found, wanted, "{text}: {:?}", report.diagnostics);
        }
    }

    #[test]
    fn a_spindle_without_a_speed_is_a_warning() {
        for dialect in ["gcode", "gcode linuxcnc", "gcode fanuc-30i", "gcode sinumerik-840d"] {
            let text = "M3\nG1 X10. F100.\n;^^^^^^^^^^^^ spindle-unset: the spindle was started without a speed\nX20.\nS500\nX30.\nM30\n";
            let report = assert_drawn(dialect, text);
            assert_eq!(report.diagnostics[0].severity, Severity::Warning);
        }
    }
}
