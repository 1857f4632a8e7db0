//! Commands that draw, list or compare every step end at `[limits] steps`, however many blocks a check may run: counted in blocks and points.
use super::tools::{status, str, text, trunnion_in, write};
use std::fs;
use tempfile::TempDir;

/// The bound of these tests.
const STEPS: u64 = 300;

/// Counts to 50 000 and moves, on a machine with everything declared.
const LOOP: &str = "O1\nG21 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG43 H1\nG0 X0. Y0. Z50. A0. C0.\n#1=0\nWHILE[#1LT50000]DO1\n\
                    G1 X[#1/1000.] Y1. F500.\n#1=#1+1\nEND1\nG1 A30. C90.\nM30\n";

/// A folder with the program, a machine beside it, and bounds: `blocks` is far above `steps`.
fn folder() -> TempDir {
    let folder = TempDir::new().expect("works");
    let settings = format!(
        "machine = \"mikron-ucp710\"\ndialect = \"fanuc-30i\"\n[limits]\nblocks = 1000000\nsteps = {STEPS}\n[work_offsets]\n\
         G54 = {{ X = 0, Y = 0, Z = 0 }}\n[[tool]]\nnumber = 1\nshape = \"ball\"\ndiameter = 10\nlength = 100\n"
    );
    write(&folder, "trunnion.toml", &settings);
    write(&folder, "loop.nc", LOOP);
    folder
}

/// The number after a text.
fn number_after(said: &str, before: &str) -> u64 {
    let rest = said
        .split(before)
        .nth(1)
        .unwrap_or_else(|| panic!("no `{before}` in {said}"));
    let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
    digits
        .parse()
        .unwrap_or_else(|_| panic!("no number after `{before}` in {said}"))
}

/// `steps` and the blocks of the program's own text.
fn most() -> u64 {
    STEPS + LOOP.lines().count() as u64 + 1
}

#[test]
fn a_report_draws_no_more_steps_than_the_bound() {
    let folder = folder();
    let output = trunnion_in(folder.path(), &["report", "loop.nc", "-o", "page.html"]);
    let said = text(&output.stderr);
    assert!(status(&output) < 2, "{said}");
    assert!(said.contains("the picture ends there"), "{said}");
    let run = number_after(&said, "no end within ");
    assert!(run >= STEPS && run <= most(), "{run} blocks: {said}");
    let page = fs::read_to_string(folder.path().join("page.html")).expect("written");
    let lines = page
        .split("\"lines\":[")
        .nth(1)
        .expect("a replay")
        .split(']')
        .next()
        .expect("a list");
    let points = lines.split(',').count() as u64;
    // a line of the loop moves once in three blocks, and has two ends
    assert!(points > STEPS / 3 && points <= most(), "{points} points");
    // the check of the page goes on to the end
    assert!(
        page.contains("50002 motions") || page.contains("50 002 motions"),
        "the verdict covers the whole run"
    );
}

#[test]
fn a_comparison_of_machines_ends_at_the_bound_and_says_so() {
    let folder = folder();
    let source = trunnion::machine::builtin_source("mikron-ucp710").expect("embedded");
    let axes = source.split("[[check]]").next().expect("a part");
    let moved = axes.replacen(
        "dir = [1, 0, 0]\npoint = [0, 0, 0]",
        "dir = [1, 0, 0]\npoint = [0, 0.05, 0]",
        1,
    );
    assert_ne!(moved, axes);
    let truth = write(&folder, "measured.toml", &moved);
    // only the last block, which the run does not reach, shows the difference
    let compare = |more: &[&str]| {
        let arguments = [
            "machine",
            "compare",
            "mikron-ucp710",
            str(&truth),
            "loop.nc",
            "--tolerance-mm",
            "0.01",
        ];
        trunnion_in(folder.path(), &[&arguments[..], more].concat())
    };
    let output = compare(&[]);
    let said = text(&output.stdout);
    assert_eq!(status(&output), 1, "{said}");
    let motions = number_after(&said, "the worst of ");
    assert!(motions > STEPS / 4 && motions <= STEPS, "{motions} motions: {said}");
    assert!(
        said.contains("\nUNKNOWN: ") && said.contains("not followed from line 8 on"),
        "{said}"
    );
    let run = number_after(&said, "no end within ");
    assert!(run >= STEPS && run <= most(), "{run} blocks: {said}");
    let output = compare(&["--max-steps", "1000000"]);
    let said = text(&output.stdout);
    assert!(said.contains("FAIL: ") && !said.contains("not followed"), "{said}");
}

/// A bore with a thousand pecks, each of which is several motions of one block.
#[test]
fn a_block_of_many_motions_is_compared_and_converted_up_to_the_bound() {
    let folder = folder();
    let settings = fs::read_to_string(folder.path().join("trunnion.toml")).expect("written");
    let bounded = settings.replace("[limits]\n", "[limits]\nheld = 400\n");
    assert_ne!(bounded, settings);
    write(&folder, "trunnion.toml", &bounded);
    let peck = "O1\nG21 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG43 H1\nG0 X0. Y0. Z50. A0. C0.\n\
                G98 G83 X1. Y1. Z-10. R2. Q.01 F100.\ng80\nM30\n";
    write(&folder, "a.nc", peck);
    write(&folder, "b.nc", &peck.replace("Z-10.", "Z-11."));
    // the first motion of the program, and a quarter of `held`
    for (command, counted) in [
        (["diff", "a.nc", "b.nc"], "101 -> 101 motions"),
        (["certify", "a.nc", "b.nc"], "101 of 101 motions"),
    ] {
        let output = trunnion_in(folder.path(), &command);
        let said = text(&output.stdout) + &text(&output.stderr);
        assert_eq!(status(&output), 1, "{said}");
        assert!(said.starts_with("UNKNOWN ") && said.contains(counted), "{said}");
    }
    let output = trunnion_in(folder.path(), &["convert", "a.nc", "--to", "apt"]);
    let said = text(&output.stderr);
    assert_eq!((status(&output), output.stdout.len()), (1, 0), "{said}");
    assert!(
        said.contains("there are more than 400") && said.contains("`held`"),
        "{said}"
    );
    let output = trunnion_in(folder.path(), &["fmt", "--check", "a.nc"]);
    let said = text(&output.stderr);
    assert_eq!(status(&output), 2, "{said}");
    assert!(said.contains("one block makes more than 100 motions"), "{said}");
}

/// C turns a billion times in each block. With the same machine nothing is off, whatever happens on the way. With a direction that is off
/// a little, the bound between the ends would take billions of pieces: the run has a number of them, and says what is not proven.
#[test]
fn a_comparison_of_machines_does_not_follow_endless_turns() {
    let folder = folder();
    let turns: Vec<String> = (1..40).map(|i| format!("G1 X{i}. C{i}0000000. F500.\n")).collect();
    let program = format!(
        "G21 G90 G17 G94 G54\nT1 M6\nG43 H1\nG0 X0. Y0. Z50. A0. C0.\n{}M30\n",
        turns.concat()
    );
    write(&folder, "turns.nc", &program);
    let source = trunnion::machine::builtin_source("mikron-ucp710").expect("embedded");
    let axes = source.split("[[check]]").next().expect("a part");
    let (head, of_c) = axes.split_once("letter = \"C\"").expect("C");
    let tilted = of_c.replacen("dir = [0, 0, 1]", "dir = [0.0001, 0, 1]", 1);
    assert_ne!(tilted, of_c);
    let same = write(&folder, "same.toml", axes);
    let truth = write(&folder, "tilted.toml", &format!("{head}letter = \"C\"{tilted}"));
    let compare = |other: &std::path::Path, tolerance: &str| {
        let arguments = [
            "machine",
            "compare",
            "mikron-ucp710",
            str(other),
            "turns.nc",
            "--tolerance-mm",
            tolerance,
        ];
        let output = trunnion_in(folder.path(), &arguments);
        (status(&output), text(&output.stdout))
    };
    let (code, said) = compare(&same, "0.001");
    assert!(
        code == 0 && said.contains("PASS: ") && said.contains("40 motions"),
        "{said}"
    );
    let (code, said) = compare(&truth, "0.02");
    assert!(code == 1 && said.contains("UNKNOWN: "), "{said}");
    assert!(
        said.contains("39 motions are proven only at the points that were compared, the first in line 5:")
            && said.contains("--max-steps N or raise `steps`"),
        "{said}"
    );
}
