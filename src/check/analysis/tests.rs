//! Levels, verdicts, threads, and what a check that looks for objections leaves out.
use super::*;
use crate::fixture::Fixture;
use crate::{RuleLevel, Scope, Session, Severity, Verdict};
use trunnion_interp::Setup;
use trunnion_syntax::parse;

fn settings(rules: &[(&str, RuleLevel)]) -> Settings<'static> {
    Settings {
        dialect: trunnion_dialect::builtin("iso-6983").expect("the core dialect is built in"),
        machine: trunnion_machine::builtin("mill-3axis"),
        setup: Setup::default(),
        rules: rules.iter().map(|(name, level)| ((*name).to_owned(), *level)).collect(),
        port_to: Vec::new(),
        scope: None,
        control_known: true,
        foreign: None,
        assume: crate::Assume::ALL,
    }
}

fn report(text: &str, rules: &[(&str, RuleLevel)]) -> Report {
    let settings = settings(rules);
    check(&parse(text.as_bytes().to_vec(), settings.dialect.lex), &settings)
}

#[test]
fn settings_change_levels_and_the_last_wins() {
    let text = "G21 G0 X0 X1\nM30\n";
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
fn without_a_machine_the_motions_are_judged() {
    let found = Fixture::parse("gcode", "G0 X0\n;^ machine-unset: \nM30\n")
        .check()
        .unwrap();
    assert_eq!(found.verdict(Severity::Error), Verdict::Pass);
    assert_eq!(found.cycle_time_s, None);
    let text = "G21 M3 S100\nG0 X0 Y0 Z0\nG1 X5 F100\nM30\n";
    let cut = "G21\nM3 S100\nM5\nG0 X0 Y0 Z0\nG1 X5 F100\nM30\n";
    let judged = |text: &str, scope, machine| {
        let settings = Settings {
            machine,
            scope,
            ..settings(&[])
        };
        let report = check(&parse(text.as_bytes().to_vec(), settings.dialect.lex), &settings);
        let rules: Vec<_> = report.diagnostics.iter().map(|found| found.rule).collect();
        (rules.join(" "), report.verdict(Severity::Error))
    };
    insta::assert_debug_snapshot!([
        judged(cut, Some(Scope::Language), None),
        judged(cut, Some(Scope::Motion), None),
        judged(text, Some(Scope::Language), None),
        judged(text, Some(Scope::Motion), None),
        judged(text, None, None),
        judged(text, Some(Scope::Machine), None),
        judged(text, Some(Scope::Motion), trunnion_machine::builtin("mill-3axis")),
        judged(text, None, trunnion_machine::builtin("mill-3axis")),
    ]);
}

#[test]
fn blocks_with_content_and_motions_are_counted() {
    let summary = report("%\n(comment)\n\nG0 X0 Y0 Z0\nG1 X1 F100\nM30\n", &[]).summary;
    assert_eq!((summary.blocks, summary.motions), (3, 2));
}

#[test]
fn cycle_time_counts_from_the_first_known_position() {
    let text = "G0 X0 Y0 Z0\nG1 X100 F600\nM30\n";
    let mut machine = trunnion_machine::builtin("mill-3axis").expect("embedded").clone();
    let mut time = |acceleration, jerk| {
        for axis in &mut machine.axes {
            (axis.max_acceleration, axis.extra.max_jerk) = (acceleration, jerk);
        }
        let settings = Settings {
            machine: Some(&machine),
            ..settings(&[])
        };
        check(&parse(text.as_bytes().to_vec(), settings.dialect.lex), &settings).cycle_time_s
    };
    assert_eq!(time(None, None), None);
    let [low, high] = time(Some(1000.0), Some(10_000.0)).expect("known");
    // at 10 mm/s; half of 10 ms is lost at each end, or with the jerk half of 2 sqrt(v/j)
    assert!((low - 10.01).abs() < 1e-9, "{low}");
    assert!((high - 10.0 - 2.0 * 0.001_f64.sqrt()).abs() < 1e-9, "{high}");
}

#[test]
fn two_threads_find_what_one_finds() {
    use core::fmt::Write;
    let machine = trunnion_machine::builtin("mikron-ucp710");
    let mut long = String::from("G21 G90 G17\nT1 M6\nG0 X0 Y0 Z50 A0 C0\nG1 Z10 F2000\n");
    for i in 0..3000 {
        let _ = writeln!(
            long,
            "{} X{} Y{} A{}.{} C{}{}",
            ["G1", "G1", "G1 F900", "G0", "G1 F6000"][i % 5],
            i % 900,
            i % 7,
            i % 40,
            i % 9,
            (i * 37) % 720,
            match i {
                _ if i % 311 == 0 => " G77.7",
                _ if i % 97 == 0 => " M9",
                _ => "",
            }
        );
    }
    let looped = "#<i> = 0\no1 while [#<i> LT 900]\nG1 X[#<i> * 2] A[#<i>] F100\nS-1\n#<i> = [#<i> + 1]\no1 endwhile\nX#<none>\n";
    let skipped = "G0 X0 Y0 Z0\n/G1 X9999 F100\nG1 X0 Y1 F100\n/T2 M6\nX5\nM2\n";
    for (dialect, text) in [
        ("linuxcnc", long.as_str()),
        ("linuxcnc", looped),
        ("linuxcnc", skipped),
        ("linuxcnc", ""),
        ("fanuc-30i", long.as_str()),
        (
            "fanuc-30i",
            "#1=0\nWHILE[#1LT700]DO1\nG1X[#1*3]A#1F100\n#1=#1+1\nEND1\nM98P7\nM30\n",
        ),
    ] {
        let settings = Settings {
            dialect: trunnion_dialect::builtin(dialect).expect("built in"),
            machine,
            ..settings(&[])
        };
        let program = parse(text.as_bytes().to_vec(), settings.dialect.lex);
        let one = check_on(&program, &settings, 1);
        let two = check_apart(&program, &settings, Depth::Whole);
        assert!(text.is_empty() || !one.diagnostics.is_empty(), "{dialect}: {text:.80}");
        assert_eq!(format!("{one:?}"), format!("{two:?}"), "{dialect}: {text:.80}");
    }
}

/// Errors and what is undecided, by rule: how often, and how many findings.
fn objections(report: &Report) -> std::collections::BTreeMap<(&'static str, bool), (u64, usize)> {
    let mut all = std::collections::BTreeMap::new();
    for found in report.findings() {
        let unknown = found.status == crate::Status::Unknown;
        if unknown || found.own_severity() == Severity::Error {
            let (count, findings) = all.entry((found.rule, unknown)).or_insert((0, 0));
            *count += u64::from(found.count);
            *findings += 1;
        }
    }
    all
}

#[test]
fn what_speaks_against_a_change_is_what_the_whole_report_says() {
    use core::fmt::Write;
    let mut poles = String::from("TRAORI\nG0 X0 Y0 Z50 A1 C0\nG1 F2000 S8000 M3\n");
    for i in 0..400_u32 {
        let (a, c) = ([2, 1, 3, 5, 0][i as usize % 5], (i * 77) % 540);
        let _ = writeln!(
            poles,
            "X{} A{a}.{} C{c}{}",
            i % 90,
            i % 9,
            if i % 50 == 7 { " M77" } else { "" }
        );
    }
    poles.push_str("TRAFOOF\nG1 X5000 A90 C400 F200\nX=R1\nG1 X10 Y10\nM30\n");
    let open = "G0 X10 C[#1]\n#500=#501\nG1 X20 Y5 A30 C200\nX40 Y0 A-30 C20\nG43 H7 Z5\nG1 X9000\nM30\n";
    for (dialect, machine, text) in [
        ("sinumerik-840d", "mikron-ucp710", poles.as_str()),
        ("fanuc-30i", "mikron-ucp710", open),
        (
            "linuxcnc",
            "mill-3axis",
            "G21 G0 X0 X1\nG1 X900 (no feed)\nG2 X5 Y5\nG77\nM2\n",
        ),
    ] {
        let levels = ["feed-drop", "feed-oscillation", "axis-acceleration"];
        for level in [None, Some(Severity::Error), Some(Severity::Info)] {
            let settings = Settings {
                dialect: trunnion_dialect::builtin(dialect).expect("built in"),
                machine: trunnion_machine::builtin(machine),
                rules: levels
                    .iter()
                    .filter_map(|name| Some(((*name).to_owned(), RuleLevel::At(level?))))
                    .collect(),
                ..settings(&[])
            };
            let program = parse(text.as_bytes().to_vec(), settings.dialect.lex);
            let whole = objections(&check(&program, &settings));
            assert_eq!(
                objections(&check_objections(&program, &settings)),
                whole,
                "{dialect} {level:?}"
            );
            assert!(!whole.is_empty(), "{dialect}");
        }
    }
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
fn a_session_describes_motions_that_are_told_late() {
    let settings = Settings {
        dialect: trunnion_dialect::builtin("linuxcnc").expect("built in"),
        ..settings(&[])
    };
    let text = "G21 G17 G90 F100\nG0 X0 Y0 Z0\nG41.1 D2\nG1 X20\nG1 X40\n(there)\nG1 Y40\nG40\nM2\n";
    let program = parse(text.as_bytes().to_vec(), settings.dialect.lex);
    let session = Session::new(&program, &settings, &|| false).expect("nobody cancels");
    // 1 mm beside the contour, and around the inside corner
    for (block, place) in [(3, [20.0, 1.0]), (4, [39.0, 1.0]), (6, [39.0, 40.0])] {
        let info = session.describe(&program, &settings, BlockId(block));
        let tips: Vec<_> = info
            .rows
            .iter()
            .map(|row| row.tip_mm.map(|tip| [tip[0], tip[1]]))
            .collect();
        assert_eq!(tips, [Some(place)], "{block}");
        assert_eq!(
            info.after.position.get(0),
            Some(if block == 3 { 20.0 } else { 40.0 }),
            "{block}"
        );
    }
    assert!(session.describe(&program, &settings, BlockId(5)).rows.is_empty());
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
            assert_eq!(info.before.feed.value(), Some(500.0), "{block}");
        }
    }
    assert!(Session::new(&program, &settings, &|| true).is_none());
}
