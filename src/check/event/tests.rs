//! Findings at the pole, put together.
use crate::{Diagnostic, Report, RuleLevel, Settings, Severity, Status, Verdict, check};
use trunnion_interp::Setup;

/// C turns 48 deg next to the pole: the feed drops, the linear axes run a loop and C is too fast.
const FLIP: &str = "TRAORI
G1 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 F1000
N20 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822
N30 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
M30
";

fn report(text: &str, rules: &[(&str, RuleLevel)]) -> Report {
    let dialect = trunnion_dialect::builtin("sinumerik-840d").expect("built in");
    let mut settings = Settings::new(dialect, trunnion_machine::builtin("mikron-ucp710"), Setup::default());
    settings.assume = crate::Assume::ALL;
    settings.rules = rules.iter().map(|(name, level)| ((*name).to_owned(), *level)).collect();
    settings.rules.extend(
        crate::fixture::QUIET
            .iter()
            .map(|name| ((*name).to_owned(), RuleLevel::Allow)),
    );
    check(
        &trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex),
        &settings,
    )
}

fn rules(found: &[Diagnostic]) -> Vec<&str> {
    found.iter().map(|found| found.rule).collect()
}

#[test]
fn one_flip_is_one_finding() {
    let report = report(FLIP, &[]);
    assert_eq!(rules(&report.diagnostics), ["pole-flip"], "{:#?}", report.diagnostics);
    insta::assert_debug_snapshot!((
        report.summary,
        &report.diagnostics[0].notes,
        rules(&report.diagnostics[0].also)
    ));
    assert_eq!(report.findings().count(), 1 + report.diagnostics[0].also.len());
}

/// Whatever level a rule has, the verdict is that of the findings one by one.
#[test]
fn the_one_that_leads_takes_the_worst_level() {
    let free = report(FLIP, &[("pole-flip", RuleLevel::At(Severity::Info))]);
    let worst = free.findings().map(Diagnostic::own_severity).max();
    let lead = &free.diagnostics[0];
    assert_eq!(Some(lead.severity), worst);
    for rule in ["axis-overspeed", "feed-drop", "excess-linear-travel"] {
        let one = report(FLIP, &[(rule, RuleLevel::At(Severity::Error))]);
        assert_eq!(one.verdict(Severity::Error), Verdict::Fail, "{rule}");
        assert_eq!(one.summary.errors, 1, "{rule}");
        assert!(
            one.diagnostics[0]
                .notes
                .iter()
                .any(|note| note.starts_with(&format!("error[{rule}]: ")))
        );
    }
}

#[test]
fn a_rule_that_is_allowed_is_no_note() {
    let report = report(
        FLIP,
        &[("axis-overspeed", RuleLevel::Allow), ("feed-drop", RuleLevel::Allow)],
    );
    let silent = |found: &Diagnostic| !matches!(found.rule, "axis-overspeed" | "feed-drop");
    assert!(report.findings().all(silent));
    let notes = report.diagnostics.iter().flat_map(|found| &found.notes);
    assert!(
        !notes
            .clone()
            .any(|note| note.contains("axis-overspeed") || note.contains("feed-drop"))
    );
}

#[test]
fn without_a_cause_each_finding_stays() {
    let report = report(
        FLIP,
        &["pole-flip", "branch-swap", "fast-pole"].map(|rule| (rule, RuleLevel::Allow)),
    );
    assert!(report.diagnostics.len() > 1, "{:?}", rules(&report.diagnostics));
    let also = |found: &Diagnostic| !found.also.is_empty();
    assert!(
        !report
            .diagnostics
            .iter()
            .any(|found| also(found) && found.rule != "axis-overspeed")
    );
}

/// C turns 9 deg in each mm at 120 deg/s, which is 800 mm/min.
const FAST: &str = "TRAORI
G0 X0 Y0 Z50 A30 C0
G1 X1 C9 F2000
X2 C18 F900
X3 C27 F2000
M30
";

#[test]
fn a_feed_that_drops_is_part_of_the_axis_that_is_too_fast() {
    let found = report(FAST, &[]);
    let shown = found.diagnostics.iter().map(|found| (found.rule, rules(&found.also)));
    let (both, one) = (("axis-overspeed", vec!["feed-drop"]), ("axis-overspeed", vec![]));
    assert_eq!(
        shown.collect::<Vec<_>>(),
        [both.clone(), one, both],
        "{:#?}",
        found.diagnostics
    );
    assert_eq!(found.summary.warnings + found.summary.errors, 3);
    // without the finding of the axis it stays
    let alone = report(FAST, &[("axis-overspeed", RuleLevel::Allow)]);
    assert_eq!(rules(&alone.diagnostics), ["feed-drop"; 2]);
}

/// The same pass twice, with a block between them that has nothing to do with a pole.
#[test]
fn two_events_are_two_findings() {
    let pass = FLIP.trim_end_matches("M30\n");
    let text = format!("{pass}G0 Z200\nG0 A20 C0\n{}M30\n", pass.trim_start_matches("TRAORI\n"));
    let report = report(&text, &[]);
    let causes = report.diagnostics.iter().filter(|found| found.rule == "pole-flip");
    assert_eq!(causes.count(), 2, "{:?}", rules(&report.diagnostics));
}

/// Findings of a block that touches the flip are notes with their place.
#[test]
fn what_touches_the_flip_follows_from_it() {
    let report = report(&FLIP.replace("F1000", "F2000"), &[]);
    assert_eq!(rules(&report.diagnostics), ["pole-flip"], "{:#?}", report.diagnostics);
    let before = "warning[axis-overspeed]: C would have to run at 159 deg/s at F2000, but its maximum is 120 deg/s (in block N20)";
    let notes = &report.diagnostics[0].notes;
    assert!(notes.iter().any(|note| note == before), "{notes:#?}");
}

/// Long runs of other rules are not hidden in the first flip of a program that flips in every block.
#[test]
fn long_runs_stay_by_themselves() {
    use core::fmt::Write;
    let mut text = String::from("TRAORI\nG0 X0 Y0 Z50 A1 C0\nG1 F9000\n");
    for i in 1..200 {
        let _ = writeln!(text, "X{i} A1 C{}", i * 25);
    }
    let report = report(&text, &[]);
    let flips = report.diagnostics.iter().filter(|found| found.rule == "pole-flip");
    assert_eq!(flips.count(), 199);
    let runs = report.diagnostics.iter().filter(|found| found.count > 100);
    assert!(runs.count() > 1, "{:?}", rules(&report.diagnostics));
    assert!(report.findings().all(|found| found.notes.len() < 12));
}

/// An undecided finding at the pole is not put into another one, where the verdict would lose it.
#[test]
fn what_is_not_decided_stays_by_itself() {
    let program = trunnion_syntax::parse(
        FLIP.as_bytes().to_vec(),
        trunnion_dialect::builtin("sinumerik-840d").expect("built in").lex,
    );
    let mut parts: Vec<Diagnostic> = report(FLIP, &[]).findings().cloned().collect();
    for part in &mut parts {
        part.also.clear();
        part.notes.clear();
    }
    let last = parts.last_mut().expect("several findings");
    (last.status, last.severity) = (Status::Unknown, Severity::Info);
    let undecided = last.rule;
    let count = parts.len();
    let mut whole = Report {
        diagnostics: parts,
        ..Report::default()
    };
    super::group(&program, &mut whole);
    assert_eq!(rules(&whole.diagnostics), ["pole-flip", undecided]);
    assert_eq!(whole.diagnostics[0].also.len(), count - 2);
    assert_eq!(whole.summary.unknown, 1);
}

/// Three pieces of a line that the dialect cannot read are one mistake; two are two, and so is one in another block.
#[test]
fn a_line_in_another_language_is_one_finding() {
    let dialect = trunnion_dialect::builtin("heidenhain-klartext").expect("built in");
    let text = "BEGIN PGM 1 MM\n($Message(\"Load the tool\"))\nTOOL CALL 1 Z S1000\nL X+1 F100 M3 ? !\nL X+1 FMAX M30\nEND PGM 1 MM\n";
    let settings = Settings::new(dialect, None, Setup::default());
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    let found = check(&program, &settings);
    let errors: Vec<_> = found
        .diagnostics
        .iter()
        .filter(|found| found.severity == Severity::Error)
        .collect();
    assert_eq!(errors.len(), 3, "{errors:#?}");
    let line = program.block_at(errors[0].range.start);
    assert!(errors[0].also.len() >= 3 && errors[1].also.is_empty() && errors[2].also.is_empty());
    assert!(
        errors[0]
            .also
            .iter()
            .all(|also| program.block_at(also.range.start) == line)
    );
    assert!(
        errors[0]
            .notes
            .iter()
            .any(|note| note.contains("`Message` has no meaning")),
        "{:?}",
        errors[0].notes
    );
    assert_eq!(found.summary.errors, 3);
}
