//! Programs with loops and calls: a finding is reported once, at its first pass, with its count and the calls that led to it.
use std::sync::Arc;
use trunnion_check::{Diagnostic, Report, Session, Settings, Severity, check};
use trunnion_interp::{Files, Library, Loaded, Searched, Setup};
use trunnion_syntax::{BlockId, Program, parse};

/// Holds one program.
struct One(&'static str, &'static str);

impl Files for One {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        if name.trim_start_matches(['O', 'o', '0']) == self.0 {
            let bytes = Arc::from(self.1.as_bytes());
            let path = format!("subs/{name}.nc");
            Ok(Loaded { path, bytes })
        } else {
            Err(vec!["subs".into()])
        }
    }
}

fn settings() -> Settings<'static> {
    let sub = One("7", "G1 X5000. F500.\nX0.\nM99\n");
    Settings {
        assume: trunnion_check::Assume::ALL,
        ..Settings::new(
            trunnion_dialect::builtin("fanuc-30i").expect("built in"),
            trunnion_machine::builtin("mill-3axis"),
            Setup {
                library: Library(Some(Arc::new(sub))),
                ..Setup::default()
            },
        )
    }
}

fn program(text: &str) -> Program {
    parse(text.as_bytes().to_vec(), settings().dialect.lex)
}

fn found<'r>(report: &'r Report, rule: &str) -> Vec<&'r Diagnostic> {
    report.diagnostics.iter().filter(|d| d.rule == rule).collect()
}

const LOOP: &str = "G90 G0 X0. Y0. Z0.\n#1=0\nWHILE[#1 LT 20]DO1\nG1 X[5000.+#1] F500.\nG0 X0.\n#1=#1+1\nEND1\nM30\n";

#[test]
fn a_finding_in_a_loop_is_told_once_with_its_count() {
    let report = check(&program(LOOP), &settings());
    let limits = found(&report, "axis-limit");
    assert_eq!(limits.len(), 1, "{limits:#?}");
    assert_eq!(limits[0].count, 20);
    assert!(LOOP[limits[0].range.as_usize()].starts_with("X[5000"));
    assert!(
        limits[0].message.contains("5000 mm"),
        "the first pass: {}",
        limits[0].message
    );
    assert!(
        limits[0].notes.iter().any(|note| note.contains("20 times in all")),
        "{:?}",
        limits[0].notes
    );
    assert_eq!(report.summary.motions, 41);
    assert_eq!(report.summary.blocks, 8);
}

/// The first pass is within the limits, a later one is not: the first one that is found is reported.
#[test]
fn what_only_a_later_pass_finds_is_told_too() {
    let text = LOOP.replace("[5000.+#1]", "[#1*1000.]");
    let report = check(&program(&text), &settings());
    let limits = found(&report, "axis-limit");
    assert_eq!(limits.len(), 1);
    assert!((15..20).contains(&limits[0].count), "{}", limits[0].count);
    assert_eq!(limits[0].severity, Severity::Error);
}

#[test]
fn a_finding_in_another_file_lies_at_the_call_and_names_the_calls() {
    let text = "G90 G0 X0. Y0. Z0.\nM98 P7 L3\nM98 P7\nM30\n";
    let report = check(&program(text), &settings());
    let limits = found(&report, "axis-limit");
    let places: Vec<&str> = limits.iter().map(|d| &text[d.range.as_usize()]).collect();
    assert_eq!(places, ["M98 P7 L3", "M98 P7"], "{limits:#?}");
    assert_eq!((limits[0].count, limits[1].count), (3, 1));
    assert!(
        limits[0].notes.contains(&"called from line 2: M98 P7 L3".to_owned()),
        "{:?}",
        limits[0].notes
    );
}

#[test]
fn blocks_of_loops_are_described_as_they_run_first() {
    let program = program(LOOP);
    let session = Session::new(&program, &settings(), &|| false).expect("nobody cancels");
    let info = session.describe(&program, &settings(), BlockId(3));
    assert!(info.runs);
    assert_eq!(info.rows.len(), 1);
    assert_eq!(info.rows[0].tip_mm.map(|tip| tip[0]), Some(5000.0));
    let end = session.describe(&program, &settings(), BlockId(7));
    assert!(end.runs && end.before.position.get(0) == Some(0.0));
}

#[test]
fn a_block_that_is_jumped_over_is_said_not_to_run() {
    let text = "G0 X0.\nGOTO 9\nG0 X5.\nN9 G0 X1.\nM30\nG0 X2.\n";
    let program = program(text);
    let session = Session::new(&program, &settings(), &|| false).expect("nobody cancels");
    for (block, runs) in [(0, true), (2, false), (3, true), (4, true), (5, false)] {
        assert_eq!(
            session.describe(&program, &settings(), BlockId(block)).runs,
            runs,
            "{block}"
        );
    }
}

/// Thousands of passes: check-points and findings stay few.
#[test]
fn a_long_loop_is_described_at_its_end() {
    let text = "G90 G0 X0. Y0. Z0.\n#1=0\nWHILE[#1 LT 3000]DO1\nG1 X[#1] F500.\n#1=#1+1\nEND1\nG0 X7.\nM30\n";
    let program = program(text);
    let session = Session::new(&program, &settings(), &|| false).expect("nobody cancels");
    let info = session.describe(&program, &settings(), BlockId(6));
    assert!(info.runs);
    assert_eq!(info.rows[0].tip_mm.map(|tip| tip[0]), Some(7.0));
    assert!(
        session.report.diagnostics.len() < 10,
        "{:#?}",
        session.report.diagnostics
    );
}
