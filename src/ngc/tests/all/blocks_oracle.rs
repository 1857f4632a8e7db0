//! Modal changes, motions, arcs, offsets, tools, spindles, outputs and their errors: programs with the calls that `rs274 -g` of LinuxCNC
//! 2.9 made of them. The calls of the start are left out of the files.
use crate::listing;
use std::fmt::Write;
use std::path::Path;
use trunnion_ngc::{Setup, ToolTable};

/// The tool table the cases were run with, inches.
const TOOLS: &str = "T1 P1 X1 Y2 Z3 A4 B5 C6 U7 V8 W9 D0.5 I10 J20 Q3 ;tool one\nT2 P5 Z2 D1\n";
/// Calls before the first line.
const START: usize = 5;

fn compare(name: &str, at_least: usize) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/all/oracle")
        .join(name);
    let text = std::fs::read_to_string(&path).expect("there");
    let (tools, bad) = ToolTable::parse(TOOLS.as_bytes());
    assert!(bad.is_empty(), "{bad:?}");
    let setup = Setup {
        tools,
        ..Setup::default()
    };
    let mut failures = String::new();
    let cases: Vec<&str> = text.split("===\n").filter(|case| !case.trim().is_empty()).collect();
    for case in &cases {
        let (program, expected) = case.split_once("---\n").expect("there");
        let expected: Vec<&str> = expected.lines().collect();
        let listed = listing::list_with(program, &setup);
        let mut ours = listed.lines().split_off(START);
        let error = listed.errors.first().and_then(|error| error.lines().next());
        ours.extend(error.map(|error| format!("! {error}")));
        let same = ours.len() == expected.len() && ours.iter().zip(&expected).all(|(a, b)| listing::same(a, b));
        if !same {
            writeln!(
                failures,
                "{program}expected\n  {}\nours\n  {}\n",
                expected.join("\n  "),
                ours.join("\n  ")
            )
            .expect("memory takes all");
        }
    }
    assert!(failures.is_empty(), "{failures}");
    assert!(cases.len() >= at_least, "only {} cases in {name}", cases.len());
}

#[test]
fn blocks_do_what_the_control_does() {
    compare("blocks.txt", 300);
}

#[test]
fn random_blocks_do_what_the_control_does() {
    compare("random_blocks.txt", 80);
}

#[test]
fn words_and_codes_belong_together_as_the_control_says() {
    compare("words.txt", 100);
}
