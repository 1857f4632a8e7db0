//! One check of one program: run, follow, judge. Streams: what is kept beside the program is findings and one modal state.
use crate::rule::{FaultRule, LegRule, ProgramRule, TextRule};
use crate::sink::{Active, Reporter, active};
use crate::suppress::{Suppressions, has_code};
use crate::time::CycleTime;
use crate::view::{LegView, Overview};
use crate::{Diagnostic, Level, Settings, Severity, Status};
use core::ops::ControlFlow;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, Sink, directives};
use trunnion_machine::{Follower, Leg};
use trunnion_syntax::{BlockId, Program};

/// Blocks between two check-points, and between two questions whether to go on.
pub(crate) const CHECK_POINT_BLOCKS: u32 = 1024;

/// The verdict on a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing at or above the level that is denied, nothing unknown.
    Pass,
    /// Some finding at or above the level that is denied.
    Fail,
    /// No such finding, but something could not be decided.
    Unknown,
}

impl Verdict {
    /// `pass`, `fail` or `unknown`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Unknown => "unknown",
        }
    }
}

/// Counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Blocks with content (not empty lines, not lines of comments only).
    pub blocks: u64,
    /// Motions.
    pub motions: u64,
    /// Errors.
    pub errors: u64,
    /// Warnings.
    pub warnings: u64,
    /// Infos with status fail.
    pub infos: u64,
    /// Diagnostics with status unknown.
    pub unknown: u64,
}

/// What a check found.
#[derive(Clone, Debug)]
pub struct Report {
    /// Sorted by place.
    pub diagnostics: Vec<Diagnostic>,
    /// Counts.
    pub summary: Summary,
    /// Lowest and highest time the program takes from its first known position on, s. Lowest: no axis needs time to
    /// accelerate. Highest: the machine stops after every block and accelerates no faster than its machine file declares.
    /// `None`: some time is not known (no machine, no feed, a dwell in turns, an acceleration that is not declared).
    pub cycle_time_s: Option<[f64; 2]>,
}

impl Report {
    /// The verdict when findings at or above `deny` count as failures.
    pub fn verdict(&self, deny: Severity) -> Verdict {
        let denied = |d: &Diagnostic| d.status == Status::Fail && d.severity >= deny;
        if self.diagnostics.iter().any(denied) {
            Verdict::Fail
        } else if self.summary.unknown > 0 {
            Verdict::Unknown
        } else {
            Verdict::Pass
        }
    }
}

/// Checks a parsed program.
pub fn check(program: &Program, settings: &Settings<'_>) -> Report {
    let never = &mut |_: &Interpreter<'static>, _: Option<&Follower<'_>>| ControlFlow::Continue(());
    analyse(program, settings, never).unwrap_or_else(|| Report {
        diagnostics: Vec::new(),
        summary: Summary::default(),
        cycle_time_s: None,
    })
}

/// Asked before each 1024th block with what is in force there; `Break` ends the check.
pub(crate) type AtCheckPoint<'f> = &'f mut dyn FnMut(&Interpreter<'static>, Option<&Follower<'_>>) -> ControlFlow<()>;

/// Checks a parsed program; `None` when `at_check_point` broke off.
pub(crate) fn analyse(program: &Program, settings: &Settings<'_>, at_check_point: AtCheckPoint<'_>) -> Option<Report> {
    let directives = directives(program);
    let suppressions = Suppressions::new(program, &directives);
    let mut pass = Pass::new(program, settings, &suppressions);
    let unreadable = crate::rules::is_utf16(program.source());
    let told = unreadable && pass.tell_utf16();
    if !unreadable {
        pass.read_text(program);
    }
    if !told {
        pass.read_whole(&Overview {
            program,
            settings,
            directives: &directives,
        });
    }
    if unreadable {
        return Some(pass.finish());
    }

    let mut interpreter = Interpreter::new(settings.dialect, &settings.setup);
    for id in (0..program.block_count() as u32).map(BlockId) {
        if id.0.is_multiple_of(CHECK_POINT_BLOCKS) && at_check_point(&interpreter, pass.follower.as_ref()).is_break() {
            return None;
        }
        pass.summary.blocks += u64::from(has_code(program, id));
        interpreter.step(program, id, &mut pass);
    }
    Some(pass.finish())
}

/// One pass over a program.
struct Pass<'a> {
    reporter: Reporter<'a>,
    text: Vec<Active<TextRule>>,
    whole: Vec<Active<ProgramRule>>,
    faults: Vec<Active<FaultRule>>,
    legs: Vec<Active<LegRule>>,
    follower: Option<Follower<'a>>,
    /// Sign of the last posture off the pole.
    posture: i8,
    time: CycleTime,
    summary: Summary,
}

impl<'a> Pass<'a> {
    fn new(program: &'a Program, settings: &Settings<'a>, suppressions: &'a Suppressions) -> Self {
        let levels = &settings.rules;
        Self {
            reporter: Reporter::new(program, &settings.dialect.name, suppressions),
            text: active(
                levels,
                |level| if let Level::Text(run) = level { Some(run) } else { None },
            ),
            whole: active(levels, |level| {
                if let Level::Program(run) = level {
                    Some(run)
                } else {
                    None
                }
            }),
            faults: active(
                levels,
                |level| if let Level::Fault(run) = level { Some(run) } else { None },
            ),
            legs: active(
                levels,
                |level| if let Level::Leg(run) = level { Some(run) } else { None },
            ),
            follower: settings.machine.map(Follower::new),
            posture: 0,
            time: CycleTime::default(),
            summary: Summary::default(),
        }
    }

    fn read_text(&mut self, program: &Program) {
        for error in program.errors() {
            let block = program.block_at(error.range.start).unwrap_or_default();
            for rule in &self.text {
                self.reporter.enter(rule, Some(block), u64::from(block.0));
                (rule.run)(error, &mut self.reporter);
                self.reporter.leave();
            }
        }
    }

    /// Says that the file is UTF-16; false where the rule that says so is allowed.
    fn tell_utf16(&mut self) -> bool {
        let Some(rule) = self.text.iter().find(|rule| rule.name == "syntax-error") else {
            return false;
        };
        self.reporter.enter(rule, None, 0);
        crate::rules::report_utf16(&mut self.reporter);
        self.reporter.leave();
        true
    }

    fn read_whole(&mut self, overview: &Overview<'_>) {
        for rule in &self.whole {
            self.reporter.enter(rule, None, 0);
            (rule.run)(overview, &mut self.reporter);
            self.reporter.leave();
        }
    }

    fn read_leg(&mut self, leg: &Leg) {
        let Some(follower) = &self.follower else { return };
        let view = LegView::new(follower.machine(), leg, self.posture);
        for rule in &self.legs {
            self.reporter.enter(rule, Some(leg.motion.block), self.summary.motions);
            (rule.run)(&view, &mut self.reporter);
            self.reporter.leave();
        }
        self.time.add(&view, self.reporter.dialect());
        match &leg.end {
            Ok(end) if end.branch != 0 => self.posture = end.branch,
            Ok(_) => {}
            Err(_) => self.posture = 0,
        }
    }

    fn finish(self) -> Report {
        let cycle_time_s = if self.follower.is_some() {
            self.time.interval()
        } else {
            None
        };
        let mut reporter = self.reporter;
        if let Some(follower) = &self.follower {
            reporter.word_worst(follower.machine(), &self.legs);
        }
        let diagnostics = reporter.finish();
        let mut summary = self.summary;
        for diagnostic in &diagnostics {
            let count = match (diagnostic.status, diagnostic.severity) {
                (Status::Unknown, _) => &mut summary.unknown,
                (Status::Fail, Severity::Error) => &mut summary.errors,
                (Status::Fail, Severity::Warning) => &mut summary.warnings,
                (Status::Fail, Severity::Info) => &mut summary.infos,
            };
            *count += 1;
        }
        Report {
            diagnostics,
            summary,
            cycle_time_s,
        }
    }
}

impl Sink for Pass<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        self.summary.motions += 1;
        if let Some(follower) = &mut self.follower {
            let leg = follower.follow(motion);
            self.read_leg(&leg);
        }
    }

    fn fault(&mut self, fault: Fault) {
        for rule in &self.faults {
            self.reporter.enter(rule, Some(fault.block), u64::from(fault.block.0));
            (rule.run)(&fault, &mut self.reporter);
            self.reporter.leave();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::Fixture;
    use crate::{RuleLevel, Session};
    use trunnion_interp::Setup;
    use trunnion_syntax::parse;

    fn settings(rules: &[(&str, RuleLevel)]) -> Settings<'static> {
        Settings {
            dialect: trunnion_dialect::builtin("iso-6983").expect("the core dialect is built in"),
            machine: trunnion_machine::builtin("mill-3axis"),
            setup: Setup::default(),
            rules: rules.iter().map(|(name, level)| ((*name).to_owned(), *level)).collect(),
        }
    }

    fn report(text: &str, rules: &[(&str, RuleLevel)]) -> Report {
        let settings = settings(rules);
        check(&parse(text.as_bytes().to_vec(), settings.dialect.lex), &settings)
    }

    #[test]
    fn settings_change_levels_and_the_last_wins() {
        let text = "G0 X0 X1\nM30\n";
        assert_eq!(report(text, &[]).summary.errors, 1);
        assert_eq!(report(text, &[("repeated-word", RuleLevel::Allow)]).diagnostics, []);
        let levels = [
            ("repeated-word", RuleLevel::Allow),
            ("repeated-word", RuleLevel::At(Severity::Warning)),
        ];
        assert_eq!(report(text, &levels).summary.warnings, 1);
    }

    #[test]
    fn verdicts_depend_on_what_is_denied() {
        let found = report(
            "G0 X0 X1\nM30\n",
            &[("repeated-word", RuleLevel::At(Severity::Warning))],
        );
        assert_eq!(found.verdict(Severity::Error), Verdict::Pass);
        assert_eq!(found.verdict(Severity::Warning), Verdict::Fail);
    }

    #[test]
    fn without_a_machine_the_verdict_is_unknown() {
        let found = Fixture::parse("gcode", "G0 X0\n;^ machine-unset: \nM30\n")
            .check()
            .unwrap();
        assert_eq!(found.verdict(Severity::Error), Verdict::Unknown);
        assert_eq!(found.cycle_time_s, None);
    }

    #[test]
    fn blocks_with_content_and_motions_are_counted() {
        let summary = report("%\n(comment)\n\nG0 X0 Y0 Z0\nG1 X1 F100\nM30\n", &[]).summary;
        assert_eq!((summary.blocks, summary.motions), (3, 2));
    }

    #[test]
    fn cycle_time_counts_from_the_first_known_position() {
        let text = "G0 X0 Y0 Z0\nG1 X100 F600\nM30\n";
        assert_eq!(
            report(text, &[]).cycle_time_s,
            None,
            "mill-3axis declares no accelerations"
        );
        let mut machine = trunnion_machine::builtin("mill-3axis")
            .expect("mill-3axis is built in")
            .clone();
        for axis in &mut machine.axes {
            axis.max_acceleration = Some(1000.0);
        }
        let settings = Settings {
            machine: Some(&machine),
            ..settings(&[])
        };
        let program = parse(text.as_bytes().to_vec(), settings.dialect.lex);
        let [low, high] = check(&program, &settings).cycle_time_s.expect("all is known");
        assert!((low - 10.0).abs() < 1e-9, "{low}");
        // 10 mm/s in 10 ms, twice, half of it lost
        assert!((high - 10.01).abs() < 1e-9, "{high}");
    }

    #[test]
    fn every_sort_of_bytes_has_a_report_with_places_inside() {
        for text in [
            "",
            "\n",
            "\0",
            "(",
            "G1",
            "GOTO",
            "X1,5",
            "%",
            "\u{feff}G0",
            "G0 X1.2.3 Y- ( ) ; \"",
            "/",
        ] {
            for diagnostic in report(text, &[]).diagnostics {
                assert!(
                    diagnostic.range.start <= diagnostic.range.end && diagnostic.range.end as usize <= text.len(),
                    "{text:?}"
                );
            }
        }
    }

    #[test]
    fn a_session_describes_blocks_as_a_run_from_the_start_does() {
        use core::fmt::Write;
        let mut text = String::from("G0 X0 Y0 Z0\nG1 F500\n");
        for i in 0..2500 {
            let _ = writeln!(text, "X{}", i % 100);
        }
        let settings = settings(&[]);
        let program = parse(text.into_bytes(), settings.dialect.lex);
        let session = Session::new(&program, &settings, &|| false).expect("nobody cancels");
        for block in [0, 1, 2, 1023, 1024, 1025, 2047, 2048, 2500, 2501, 9999] {
            let info = session.describe(&program, &settings, BlockId(block));
            if (2..2502).contains(&block) {
                assert_eq!(info.rows.len(), 1, "{block}");
                assert_eq!(
                    info.rows[0].tip_mm.map(|tip| tip[0]),
                    Some(f64::from((block - 2) % 100)),
                    "{block}"
                );
                assert_eq!(info.before.feed, Some(500.0), "{block}");
            }
        }
        assert!(Session::new(&program, &settings, &|| true).is_none());
    }
}
