//! What would be a mistake in a program that the control runs, and is none in text that it does not: notes after the end of a program are one
//! finding, and a file that moves nothing need not have an end, because others call it or contain it.
use crate::{NotRun, NotRunReason, Report, Severity, Status};
use trunnion_syntax::Program;

/// Rules that look at the spelling alone.
const OF_TEXT: [&str; 5] = [
    "syntax-error",
    "bad-number",
    "decimal-comma",
    "unclosed-comment",
    "repeated-word",
];

/// Puts the findings about such text in their place, and counts anew.
pub(crate) fn weigh(program: &Program, report: &mut Report) {
    if join_after_end(program, report) {
        report.summary.recount(&report.diagnostics);
    }
    if excuse_missing_end(report) {
        report.summary.recount(&report.diagnostics);
    }
}

/// The first finding about the spelling of what comes after the end stands for all of them; whether there is one. Spelling before the first `%` is none.
fn join_after_end(program: &Program, report: &mut Report) -> bool {
    let leader = report.coverage.leader().map(|part| part.last);
    if let Some(last) = leader {
        // one finding of `not-run` stands for it
        let is_leader = |at: u32| program.block_at(at).is_some_and(|block| block <= last);
        let found = report.diagnostics.len();
        report
            .diagnostics
            .retain(|found| !OF_TEXT.contains(&found.rule) || !is_leader(found.range.start));
        if report.diagnostics.len() < found {
            report.summary.recount(&report.diagnostics);
        }
    }
    let after = |part: &&NotRun| part.reason == NotRunReason::AfterEnd;
    let unread: Vec<NotRun> = report.coverage.not_run.iter().filter(after).copied().collect();
    if unread.is_empty() {
        return false;
    }
    let is_unread = |at: u32| {
        let block = program.block_at(at);
        block.is_some_and(|block| unread.iter().any(|part| (part.first..=part.last).contains(&block)))
    };
    let mut kept: Option<usize> = None;
    for mut found in std::mem::take(&mut report.diagnostics) {
        if !OF_TEXT.contains(&found.rule) || !is_unread(found.range.start) {
            report.diagnostics.push(found);
        } else if let Some(index) = kept {
            report.diagnostics[index].count += found.count;
        } else {
            (found.status, found.severity) = (Status::Unknown, Severity::Info);
            found.help = Some("delete what comes after the end, or write it as a comment".to_owned());
            let note = "it comes after the end of the program, where the control does not read";
            found.notes.push(note.to_owned());
            kept = Some(report.diagnostics.len());
            report.diagnostics.push(found);
        }
    }
    kept.is_some()
}

/// A file that moves nothing and has no end is a piece of a program; whether this is one.
fn excuse_missing_end(report: &mut Report) -> bool {
    let moves = report.coverage.travels > 0 || report.coverage.not_run.iter().any(|part| part.moves);
    // a file with other errors is no piece that works elsewhere
    if moves || report.coverage.given_up.is_some() || report.summary.errors != 1 {
        return false;
    }
    let ends =
        |found: &&mut crate::Diagnostic| found.rule == "missing-program-end" && found.severity == Severity::Error;
    let Some(found) = report.diagnostics.iter_mut().find(ends) else {
        return false;
    };
    found.severity = Severity::Warning;
    let note = "the file moves nothing: it may be a piece that another program contains or calls";
    found.notes.push(note.to_owned());
    true
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;
    use crate::{Severity, Status};

    #[test]
    fn notes_after_the_end_are_one_finding() {
        for text in [
            "G21 G90 G0 X1\nM2\n\nThese are notes: one, two\n",
            "o<a> sub\n(machine on)\no<a> endsub\nM2\n\nThese are notes: one, two\n",
        ] {
            let report = Fixture::parse("gcode linuxcnc", text).check().expect("a report");
            let found: Vec<_> = report
                .diagnostics
                .iter()
                .filter(|found| found.rule == "syntax-error")
                .collect();
            assert_eq!(found.len(), 1, "{text}: {:?}", report.diagnostics);
            assert_eq!((found[0].status, found[0].count), (Status::Unknown, 2));
            assert_eq!(report.summary.errors, 0, "{text}");
        }
    }

    #[test]
    fn before_the_end_they_are_errors() {
        let text = "G21 G90 G0 X1\nThese are notes: one, two\nM2\n";
        let report = Fixture::parse("gcode linuxcnc", text).check().expect("a report");
        assert!(report.summary.errors > 0, "{:?}", report.diagnostics);
    }

    #[test]
    fn a_piece_that_moves_nothing_needs_no_end() {
        let severity = |text: &str| {
            let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
            let settings = crate::Settings::new(dialect, None, trunnion_interp::Setup::default());
            let report = crate::check(&program, &settings);
            let found = report
                .diagnostics
                .iter()
                .find(|found| found.rule == "missing-program-end");
            found.map(|found| found.severity)
        };
        assert_eq!(severity("G17 G21 G40\nG64 P0.01\n"), Some(Severity::Warning));
        assert_eq!(severity("G17 G21 G40\nG0 X1\n"), Some(Severity::Error));
        assert_eq!(severity("G17 G21 G40\nG38.2 F10\n"), Some(Severity::Error));
    }
}
