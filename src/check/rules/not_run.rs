//! Blocks that move the machine were not run, or no motion was run at all.
//!
//! # Why
//! What was not run was not checked: a subprogram that nothing calls, lines after the program's end, a branch that is
//! never taken. A verdict holds only for what was looked at, so such a file is never a pass.
//!
//! # Example
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z10
//! N20 M30
//! N30 G1 X10 F100
//! ;^^^^^^^^^^^^^^ not-run: line 3 moves the machine and was not run
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z10
//! N30 G1 X10 F100
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound; one finding per file, at the first such block, with all line ranges. Text before the first `%` of a Fanuc program is a finding of
//! its own, an info: the control skips it. Whether a block moves is judged by its
//! words alone; in doubt, it counts as moving. Blocks that the settings skip (`--block-delete on`) are not reported, nor those after a
//! place where another finding says why the run stopped.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::coverage::{Coverage, NotRun, NotRunReason};
use crate::prelude::*;
use trunnion_syntax::{BlockId, LineIndex, Program};

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Coverage(check)]);

/// Line ranges that are listed; the rest is counted.
const LISTED: usize = 8;

fn check(coverage: &Coverage, out: &mut Reporter<'_>) {
    let program = out.program();
    let lines = LineIndex::new(program.source());
    let span = |part: &NotRun| Span::of(part, program, &lines);
    if let Some(part) = coverage.leader() {
        let (verb, them) = if part.first == part.last {
            ("comes", "it")
        } else {
            ("come", "them")
        };
        out.report(
            program.block(part.first).range(),
            format!(
                "{} {verb} before the first `%`, and the control skips {them}",
                span(part).text()
            ),
        )
        .value_text("reason", part.reason.name().to_owned())
        .help("delete the text, or put it after the `%` as a comment");
    }
    let still = coverage.travels == 0;
    let parts: Vec<&NotRun> = if still {
        let runs = |part: &&NotRun| part.reason != NotRunReason::BeforeStart;
        coverage.not_run.iter().filter(runs).collect()
    } else {
        coverage.gaps().collect()
    };
    let range = parts.first().map_or_else(
        || TextRange::new(0, u32::from(!program.source().is_empty())),
        |part| program.block(part.first).range(),
    );
    let message = match parts.as_slice() {
        _ if still => "no motion was run, so none was checked".to_owned(),
        [] => return,
        [part] if part.first == part.last => format!("{} moves the machine and was not run", span(part).text()),
        [part] => format!("{} move the machine and were not run", span(part).text()),
        [part, rest @ ..] => format!(
            "{} and {} more {} move the machine and were not run",
            span(part).text(),
            rest.len(),
            if rest.len() == 1 { "part" } else { "parts" }
        ),
    };
    let draft = out.report(range, message);
    for part in parts.iter().take(LISTED) {
        draft.note(format!("{}: {}", span(part).text(), part.reason.because()));
    }
    if parts.len() > LISTED {
        draft.note(format!("{} further parts were not run", parts.len() - LISTED));
    }
    if let Some(part) = parts.first() {
        let span = span(part);
        draft
            .value("first_line", f64::from(span.first))
            .value("last_line", f64::from(span.last))
            .value_text("reason", part.reason.name().to_owned());
    }
    let help = if parts
        .iter()
        .any(|part| part.reason == NotRunReason::SubprogramNotCalled)
        || parts.is_empty()
    {
        "check the program that calls this one, with this file in its folder or under `subprogram_path`"
    } else {
        "remove what never runs, or check a program in which it does"
    };
    draft.help(help).unknown();
}

/// Lines of a part.
struct Span {
    first: u32,
    last: u32,
}

impl Span {
    fn of(part: &NotRun, program: &Program, lines: &LineIndex) -> Self {
        let line = |id: BlockId| lines.line_column(program.source(), program.block(id).range().start).0;
        Self {
            first: line(part.first),
            last: line(part.last),
        }
    }
    fn text(&self) -> String {
        if self.first == self.last {
            format!("line {}", self.first)
        } else {
            format!("lines {} to {}", self.first, self.last)
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{NotRunReason, Report, Settings, Severity, Status, Verdict, check};
    use trunnion_interp::Setup;

    fn report(dialect: &str, text: &str) -> Report {
        let dialect = trunnion_dialect::builtin(dialect).expect("built in");
        let settings = Settings::new(dialect, trunnion_machine::builtin("mill-3axis"), Setup::default());
        let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
        check(&program, &settings)
    }

    fn parts(dialect: &str, text: &str) -> Vec<(u32, u32, &'static str)> {
        let parts = report(dialect, text).coverage.not_run;
        let part = |part: &crate::NotRun| (part.first.0 + 1, part.last.0 + 1, part.reason.name());
        parts.iter().map(part).collect()
    }

    #[test]
    fn what_was_not_run_is_never_a_pass() {
        for (dialect, text) in [
            ("iso-6983", "M30\n"),
            ("iso-6983", "G0 X0 Y0 Z9\nM30\nG1 X1 F9\n"),
            ("linuxcnc", "o<slot> sub\n#1=2\no<slot> endsub\nG21\nM2\n"),
            ("linuxcnc", "#1=1\nM2\n"),
            ("linuxcnc", "o100 sub\nG0 X1\no100 endsub\nG21 G0 X0 Y0 Z0\nM2\n"),
            ("fanuc-30i", "O1\nG0 X0. Y0. Z0.\nM30\nO2\nG1 X5. F10.\nM99\n"),
            ("fanuc-30i", "O1\n#1=2\nG0 X0. Y0. Z0.\nGOTO 9\nG1 X5. F10.\nN9 M30\n"),
            ("sinumerik-840d", "G0 X0 Y0 Z0\nGOTOF LAST\nG1 X5 F10\nLAST: M30\n"),
        ] {
            let found = report(dialect, text);
            assert_eq!(
                found.verdict(Severity::Error),
                Verdict::Unknown,
                "{dialect}: {text} {:?}",
                found.diagnostics
            );
            let count = found.diagnostics.iter().filter(|d| d.rule == "not-run").count();
            assert_eq!(count, 1, "{dialect}: {text}");
        }
        // a file of definitions is entered, with unknown arguments
        let alone = report("linuxcnc", "o<slot> sub\nG0 X#1\no<slot> endsub\nM2\n");
        assert_eq!(alone.verdict(Severity::Error), Verdict::Unknown);
        assert_eq!(alone.coverage.motions, 1);
    }

    #[test]
    fn what_moves_nothing_may_be_left_out() {
        for (dialect, text) in [
            ("iso-6983", "G21\nG0 X0 Y0 Z9\nM30\n(the end)\nM5\n"),
            ("linuxcnc", "G21 G0 X0 Y0 Z0\no1 if [1 GT 2]\n#1=3\no1 endif\nM2\n"),
            (
                "linuxcnc",
                "o100 sub\nG0 X1\no100 endsub\nG21 G0 X0 Y0 Z0\no100 call\nM2\n",
            ),
            (
                "fanuc-30i",
                "O1\nG21\nG0 X0. Y0. Z0.\nM98 P2\nM30\nO2\nG1 X5. F10.\nM99\n",
            ),
        ] {
            let found = report(dialect, text);
            assert!(
                found.diagnostics.iter().all(|d| d.rule != "not-run"),
                "{dialect}: {text}"
            );
        }
    }

    #[test]
    fn the_reason_is_said_part_by_part() {
        assert_eq!(
            parts(
                "fanuc-30i",
                "O1\nG0 X0. Y0. Z0.\nGOTO 9\nG1 X5. F10.\nN9 M30\nM5\nO2\nG1 X5. F10.\nM99\n"
            ),
            [
                (4, 4, "jumped-over"),
                (6, 6, "after-end"),
                (7, 9, "subprogram-not-called")
            ]
        );
        assert_eq!(
            parts(
                "fanuc-30i",
                "O1\nG0 X0. Y0. Z0.\nIF[#1000EQ1]GOTO9\nG1 X5. F10.\nN9 M30\n"
            ),
            [(4, 5, NotRunReason::GivenUp.name())]
        );
        assert_eq!(
            parts(
                "linuxcnc",
                "o1 sub\nG0 X1\no1 endsub\nG21 G0 X0 Y0 Z0\no2 if [1 GT 2]\nG0 X9\no2 endif\nM2\n"
            ),
            [(2, 2, "subprogram-not-called"), (6, 6, "jumped-over")]
        );
    }

    #[test]
    fn text_before_the_first_percent_sign_is_one_finding() {
        let program = "%\nO1\nG21 G90 G54 S100 M3\nG0 X0. Y0. Z9.\nG1 Z1. F100.\nM30\n%\n";
        for text in [
            "LEADER\n",
            "From: me, 2020-01-01\nHere it is (rev. 3): X5,5\n",
            "O9(TITLE)\n",
            "Part 17\nDate 1.2.2020\nPROGRAM 1234.NC\n",
        ] {
            let found = report("fanuc-30i", &format!("{text}{program}"));
            let clean = report("fanuc-30i", program);
            assert_eq!(
                found.diagnostics.len(),
                clean.diagnostics.len() + 1,
                "{text}: {:?}",
                found.diagnostics
            );
            let leader = found
                .diagnostics
                .iter()
                .find(|d| d.rule == "not-run")
                .expect("the leader");
            assert_eq!(
                (leader.severity, leader.status),
                (Severity::Info, Status::Fail),
                "{text}"
            );
            assert_eq!(found.summary.motions, clean.summary.motions, "{text}");
            assert_eq!(found.verdict(Severity::Error), clean.verdict(Severity::Error), "{text}");
            assert_eq!(found.coverage.not_run[0].reason.name(), "before-start", "{text}");
        }
    }

    #[test]
    fn blocks_of_either_state_of_block_delete_count() {
        let found = report("iso-6983", "G21\nG0 X0 Y0 Z0\n/G1 X5 F10\nM30\n");
        assert_eq!((found.coverage.blocks, found.coverage.blocks_run), (4, 4));
        let all_deleted = report("iso-6983", "G21\n/G0 X0 Y0 Z0\nM30\n");
        assert_eq!(all_deleted.verdict(Severity::Error), Verdict::Unknown);
    }
}
