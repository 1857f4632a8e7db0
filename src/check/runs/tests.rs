//! Runs of findings, put together by hand.
use super::*;
use trunnion_syntax::{LexOptions, parse};

fn empty() -> Program {
    parse(Vec::new(), LexOptions::default())
}

fn finding(at: u32, message: &str) -> Diagnostic {
    let range = TextRange::new(at * 10, at * 10 + 3);
    Diagnostic {
        rule: "axis-limit",
        severity: Severity::Error,
        status: Status::Fail,
        range,
        block: None,
        message: message.to_owned(),
        notes: Vec::new(),
        help: None,
        values: Vec::new(),
        fixes: Vec::new(),
        replacement: None,
        related: Vec::new(),
        count: 1,
        last: range,
        also: Vec::new(),
        own_severity: None,
        origin: crate::diagnostic::Origin::default(),
    }
}

fn merge(key: u64, badness: f64, show: usize) -> Merge {
    Merge {
        key,
        badness,
        show,
        everywhere: false,
    }
}

#[test]
fn consecutive_findings_become_one_with_the_worst() {
    let program = empty();
    let mut log = Log::default();
    log.add(&program, finding(1, "a"), Some(merge(1, 1.0, 1)), 1);
    log.add(&program, finding(2, "b"), Some(merge(1, 3.0, 1)), 2);
    log.add(&program, finding(3, "c"), Some(merge(1, 2.0, 1)), 3);
    let found = log.finish(&program, &|_| Vec::new());
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].count, found[0].range.start, found[0].last.start), (3, 10, 30));
    assert_eq!(found[0].message, "b");
    assert_eq!(found[0].related[0].0.start, 20);
}

#[test]
fn a_gap_or_another_axis_starts_anew() {
    let program = empty();
    let mut log = Log::default();
    log.add(&program, finding(1, "a"), Some(merge(1, 1.0, 1)), 1);
    log.add(&program, finding(2, "b"), Some(merge(2, 1.0, 1)), 2);
    log.add(&program, finding(4, "c"), Some(merge(1, 1.0, 1)), 4);
    assert_eq!(log.finish(&program, &|_| Vec::new()).len(), 3);
}

#[test]
fn short_runs_are_shown_block_by_block() {
    let program = empty();
    let mut log = Log::default();
    for at in 1..=8 {
        log.add(&program, finding(at, "a"), Some(merge(1, 1.0, 8)), u64::from(at));
    }
    assert_eq!(log.finish(&program, &|_| Vec::new()).len(), 8);
    let program = empty();
    let mut log = Log::default();
    for at in 1..=9 {
        log.add(
            &program,
            finding(at, "a"),
            Some(merge(1, f64::from(at), 8)),
            u64::from(at),
        );
    }
    let found = log.finish(&program, &|_| Vec::new());
    assert_eq!((found.len(), found[0].count, found[0].related[0].0.start), (1, 9, 90));
}

#[test]
fn events_are_never_merged() {
    let program = empty();
    let mut log = Log::default();
    log.add(&program, finding(1, "a"), None, 1);
    log.add(&program, finding(2, "b"), None, 2);
    assert_eq!(log.finish(&program, &|_| Vec::new()).len(), 2);
}

#[test]
fn a_file_of_noise_is_not_listed_to_its_end() {
    let program = empty();
    let mut log = Log::default();
    for at in 0..LISTED + 5 {
        log.add(&program, finding(at, "a"), None, u64::from(at));
    }
    let found = log.finish(&program, &|_| Vec::new());
    assert_eq!(found.len(), LISTED as usize + 1);
    let rest = &found[LISTED as usize];
    assert_eq!(rest.count, 5);
    assert!(rest.message.starts_with("5 more findings"), "{}", rest.message);
}

/// A hole that is too deep is one finding, though the tool comes out after each step.
#[test]
fn a_pecking_cycle_is_told_once() {
    let text = "G21 G90 G17 G94\nG0 X0. Y0. Z50.\nG83 X1. Y0. Z-700. R2. Q5. F100.\nG80\nM30\n";
    let report = crate::fixture::Fixture::parse("gcode fanuc-30i mill-3axis", text)
        .check()
        .expect("a report");
    let found: Vec<_> = report
        .diagnostics
        .iter()
        .filter(|found| found.rule == "axis-limit")
        .collect();
    assert_eq!(found.len(), 1, "{:?}", report.diagnostics);
    assert!(
        found[0].count > 50 && found[0].message.contains("-700"),
        "{:?}",
        found[0]
    );
}

/// A cause that is reported once is counted where it comes again, and its last place is kept.
#[test]
fn a_cause_is_counted_where_it_comes_again() {
    let found = |text: &str| {
        let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mill-3axis", text)
            .check()
            .expect("a report");
        let own = |found: &&crate::Diagnostic| found.rule == "not-modelled" && found.message.contains("R1");
        let found: Vec<_> = report.diagnostics.iter().filter(own).collect();
        assert_eq!(found.len(), 1, "{:?}", report.diagnostics);
        (found[0].count, found[0].range.start, found[0].last.start as usize)
    };
    let head = "G71 G90 G17 G94\nG0 X0 Y0 Z50\nF100\n";
    let line = "G1 X=R1+2\n";
    let text = format!("{head}{}M30\n", line.repeat(5));
    let (first, last) = (text.find("R1"), text.rfind("R1"));
    let (first, last) = (first.expect("one") as u32, last.expect("one"));
    assert_eq!(found(&text), (5, first, last));
    let allowed = "G1 X=R1+2 ; trunnion: allow not-modelled because it is known\n";
    assert_eq!(
        found(&format!("{head}{line}{line}{allowed}M30\n")),
        (2, first, last - 3 * line.len())
    );
}
