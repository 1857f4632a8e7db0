//! Parts against the whole.
use super::Session;
use crate::{Diagnostic, Settings};
use core::fmt::Write;
use core::ops::Range;
use std::collections::BTreeSet;
use trunnion_interp::Setup;
use trunnion_machine::Machine;
use trunnion_syntax::{BlockId, Program, TextRange, parse, parse_after};

fn machine() -> Machine {
    trunnion_machine::builtin("mikron-ucp710").expect("built in").clone()
}

fn settings<'m>(dialect: &str, machine: Option<&'m Machine>) -> Settings<'m> {
    let mut setup = Setup::default();
    Machine::tell(machine, &mut setup.control);
    Settings {
        dialect: trunnion_dialect::builtin(dialect).expect("built in"),
        machine,
        setup,
        rules: Vec::new(),
        port_to: Vec::new(),
        scope: None,
        control_known: true,
        foreign: None,
        assume: crate::Assume::default(),
    }
}

/// Five axes with turns near the pole, posture changes, jumps over limits, unknown codes and missing brackets.
fn program(lines: u32) -> String {
    let mut text = "O1\nG21 G90 G17 G54\nT1 M6\nS12000 M3\nG43.4 H1\nG0 X0. Y0. Z80. A0. C0.\n".to_owned();
    for i in 0..lines {
        let (x, tilt) = (i % 500, i % 97);
        let _ = match i % 211 {
            40 => writeln!(text, "G1 X{x}. G777"),
            90 => writeln!(text, "G1 X[{x}."),
            120 => writeln!(text, "G0 X{x}. A{tilt}.(rapid)"),
            150 => writeln!(text, "G1 X9999. F2000."),
            _ => writeln!(
                text,
                "G1 X{x}. Y{} Z{}. A{tilt}. C{}. F2000.",
                i % 7,
                60 + i % 5,
                i * 37 % 400
            ),
        };
    }
    text.push_str("M30\n");
    text
}

/// Rule, block, column and message.
type Shown = (&'static str, u32, u32, String);

fn shown(program: &Program, found: &Diagnostic) -> Shown {
    let block = program.block_at(found.range.start).expect("a block");
    let column = found.range.start - program.block(block).range().start;
    (found.rule, block.0, column, found.message.clone())
}

/// What the whole and a part say of the places in `wanted`, and of nothing that reaches beyond.
fn compare(whole: (&Program, &Session), part: (&Program, &Session), wanted: Range<u32>, resumed: bool) -> usize {
    let inside = |program: &Program, range: TextRange| {
        let block = program.block_at(range.start).expect("a block").0;
        wanted.contains(&block)
    };
    let of = |(program, session): (&Program, &Session)| -> BTreeSet<Shown> {
        let list = session.report.diagnostics.iter();
        let ends = |found: &Diagnostic| inside(program, found.range) && inside(program, found.last);
        // an event of the pole takes its level and notes from blocks beside it
        list.filter(|found| ends(found) && (found.is_of_place() || !resumed))
            .filter(|found| {
                found.is_of_place() || crate::rule(found.rule).is_some_and(|rule| rule.level() == "machine")
            })
            .map(|found| shown(program, found))
            .collect()
    };
    let (of_whole, of_part) = (of(whole), of(part));
    assert_eq!(of_part, of_whole, "{wanted:?}");
    of_part.len()
}

#[test]
fn the_beginning_has_the_findings_of_the_whole() {
    let machine = machine();
    let settings = settings("fanuc-30i", Some(&machine));
    let text = program(4000);
    let whole = parse(text.clone().into_bytes(), settings.dialect.lex);
    let session = Session::new(&whole, &settings, &|| false).expect("nobody cancels");
    let cut = text.match_indices('\n').nth(2500).expect("long").0 + 1;
    let begun = parse(text.as_bytes()[..cut].to_vec(), settings.dialect.lex);
    let part = Session::of_part(&begun, &settings, None, 0..2400);
    for found in &part.report.diagnostics {
        let known = |other: &&Diagnostic| other.rule == found.rule && other.range == found.range;
        let of_whole = session.report.findings().find(known);
        assert!(of_whole.is_some(), "{found:?}");
    }
    assert!(part.report.diagnostics.len() > 20, "{}", part.report.diagnostics.len());
    assert!(part.reaches(BlockId(2499)) && !part.reaches(BlockId(2501)));
}

#[test]
fn after_an_edit_a_part_has_the_findings_of_a_new_run() {
    let machine = machine();
    let settings = settings("fanuc-30i", Some(&machine));
    let text = program(6000);
    let old = parse(text.clone().into_bytes(), settings.dialect.lex);
    let session = Session::new(&old, &settings, &|| false).expect("nobody cancels");
    let mut compared = 0;
    for (line, new) in [
        (4000, "G1 X1. C170.\n"),
        (2100, ""),
        (5000, "(a)\nG1 X[\nG1 G778\n"),
        (700, "G49\n"),
        (3333, "G0 Z200.\n"),
    ] {
        let at = text.match_indices('\n').nth(line).expect("long").0 + 1;
        let end = at + text[at..].find('\n').expect("a line") + 1;
        let mut edited = text.clone();
        edited.replace_range(at..end, new);
        let whole = parse(edited.clone().into_bytes(), settings.dialect.lex);
        let again = Session::new(&whole, &settings, &|| false).expect("nobody cancels");
        let block = BlockId(line as u32 + 1);
        let wanted = block.0.saturating_sub(100)..block.0 + 100;
        let from = session
            .restart(block, BlockId(wanted.start))
            .expect("block after block");
        assert!(from.0 <= wanted.start && wanted.start < from.0 + 1024, "{from:?}");
        let start = whole.block(from).range().start as usize;
        let behind = whole.block(BlockId(wanted.end + 64)).range().start as usize;
        let program = parse_after(from.0, &edited.as_bytes()[start..behind], settings.dialect.lex);
        let part = Session::of_part(&program, &settings, Some((&session, from)), wanted.clone());
        compared += compare((&whole, &again), (&program, &part), wanted.clone(), true);
        for block in [wanted.start, block.0, wanted.end - 1].map(BlockId) {
            let [a, b] = [
                part.describe(&program, &settings, block),
                again.describe(&whole, &settings, block),
            ];
            assert!(part.reaches(block));
            assert_eq!(format!("{:?}", a.rows), format!("{:?}", b.rows), "{line} {block:?}");
            assert_eq!(a.after.position, b.after.position);
        }
    }
    assert!(compared > 20, "{compared}");
}

#[test]
fn a_part_ends_where_the_rest_decides() {
    let settings = settings("fanuc-30i", None);
    for (head, reaches) in [
        ("G21 G1 X1. Y1. Z1. F100.\nM98 P2\nX2.\nX3.\n", 2),
        ("G21 G1 X1. Y1. Z1. F100.\nGOTO 7\nX2.\nX3.\n", 2),
        ("G21 G1 X1. Y1. Z1. F100.\nIF[#100 EQ 1] GOTO 7\nX2.\nX3.\n", 2),
        ("G21 G1 X1. Y1. Z1. F100.\n#1=2\nX#1\nX3.\n", 4),
    ] {
        let text = format!("{head}{}", "X4.\n".repeat(99));
        let part = parse(text.into_bytes(), settings.dialect.lex);
        let session = Session::of_part(&part, &settings, None, 0..3);
        let reached = (0..4).take_while(|block| session.reaches(BlockId(*block))).count();
        assert!(reached <= reaches, "{head}: {reached}");
        let rules: Vec<&str> = session.report.diagnostics.iter().map(|found| found.rule).collect();
        assert!(rules.is_empty(), "{head}: {rules:?}");
    }
}

#[test]
fn a_part_says_nothing_that_only_the_end_decides() {
    // neither a program end, nor a spindle, nor a tool length, nor the other axes
    let settings = settings("linuxcnc", None);
    let part = parse("G21 G90 G1 X1 F100\n".repeat(50).into_bytes(), settings.dialect.lex);
    let session = Session::of_part(&part, &settings, None, 0..40);
    assert_eq!(session.report.diagnostics, [], "Y and Z may be named later");
    assert!(!session.reaches(BlockId(0)));
}
