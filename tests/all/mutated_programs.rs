//! Real programs, changed at random places, through the command line: every command ends with status 0, 1 or 2, what is asked for as JSON is
//! JSON, and the tokens hold every byte of the file. CI runs some; `TRUNNION_MUTATIONS=10000` is the long form, `TRUNNION_MUTATIONS=2000..4000`
//! a part of it (CONTRIBUTING.md).
use crate::cli::tools::{json, status, text, trunnion_in};
use crate::mutations::{mutate, samples};
use crate::random::Random;
use std::{
    fs,
    ops::Range,
    path::{Path, PathBuf},
};
use tempfile::TempDir;

/// Programs in a folder that one `check` judges.
const AT_ONCE: usize = 100;

/// The numbers of the mutations: each is made from its own number, so that the long form can be run in parts.
fn mutations() -> Range<usize> {
    let asked = std::env::var("TRUNNION_MUTATIONS").unwrap_or_default();
    let (from, to) = asked.split_once("..").unwrap_or(("0", &asked));
    let number = |text: &str| text.parse().ok();
    number(from).zip(number(to)).map_or(0..150, |(from, to)| from..to)
}

/// The samples, and programs of real controls beside the repository where they are.
#[expect(clippy::print_stdout, reason = "a test that is skipped says so")]
pub(crate) fn programs() -> Vec<(PathBuf, Vec<u8>)> {
    let mut programs = samples();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    if folder.is_dir() {
        collect(&folder, &mut programs);
    } else {
        println!("skipped: no real programs in {}", folder.display());
    }
    programs
}

fn collect(folder: &Path, programs: &mut Vec<(PathBuf, Vec<u8>)>) {
    let mut entries: Vec<_> = fs::read_dir(folder)
        .expect("a folder")
        .flatten()
        .map(|entry| entry.path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            collect(&path, programs);
        } else if trunnion::dialect::is_program_file_name(&path.to_string_lossy())
            && fs::metadata(&path).is_ok_and(|metadata| metadata.len() < 200_000)
        {
            programs.push((path.clone(), fs::read(&path).expect("readable")));
        }
    }
}

/// What is run on one program; the last word says whether the output is JSON.
const COMMANDS: [(&[&str], bool); 8] = [
    (&["trace", "--format", "json"], true),
    (&["stats", "--format", "json"], true),
    (&["parse", "--format", "json"], true),
    (&["fmt", "--diff"], false),
    (&["fix"], false),
    (&["convert", "--to", "apt", "--format", "json"], false),
    (&["plot", "--kind", "joints"], false),
    (&["canon"], false),
];

#[test]
fn mutated_real_programs_end_with_a_status_and_valid_json() {
    let programs = programs();
    let asked = mutations();
    for first in asked.clone().step_by(AT_ONCE) {
        let folder = TempDir::new().expect("a folder");
        let settings =
            "machine = \"mikron-ucp710\"\n[limits]\nblocks = 5000\n[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\n";
        fs::write(folder.path().join("trunnion.toml"), settings).expect("written");
        let number = AT_ONCE.min(asked.end - first);
        for mutation in first..first + number {
            let mut random = Random(20_261_124 + (mutation as u64) * 0x9e37_79b9);
            let (path, source) = &programs[random.below(programs.len())];
            let bytes = mutate(&mut random, source);
            // with its whole name: `part.ncl.8` is a version of a program
            let own = path.file_name().unwrap_or_default().to_string_lossy();
            let name = format!("m{mutation}-{own}");
            fs::write(folder.path().join(&name), &bytes).expect("written");
            one(folder.path(), &name, &bytes, mutation);
        }
        let output = trunnion_in(folder.path(), &["check", "--format", "json", "."]);
        let said = text(&output.stderr);
        assert!(matches!(status(&output), 0..=2), "from mutation {first}: {said}");
        let document = json(&output);
        let files = document["files"].as_array().expect("files").len();
        let left = document["not_checked"].as_array().expect("a list").len();
        assert_eq!(files + left, number, "from mutation {first}: {said}");
        assert_eq!(left > 0, status(&output) == 2, "from mutation {first}: {said}");
    }
}

fn one(folder: &Path, name: &str, bytes: &[u8], mutation: usize) {
    let parse = ["parse", "--tokens", "--format", "json", name];
    let mut tokens = trunnion_in(folder, &parse);
    if status(&tokens) == 2 {
        // a mutated comment of the program names a machine or a dialect that does not exist, and either decides how it is read
        let said = text(&tokens.stderr);
        let names = ["unknown machine", "unknown dialect"];
        assert!(names.iter().any(|what| said.contains(what)), "{name}: {said}");
        let named = ["--machine", "mikron-ucp710", "--dialect", "iso-6983"];
        tokens = trunnion_in(folder, &[&parse[..], &named[..]].concat());
    }
    assert!(matches!(status(&tokens), 0..=1), "{name}: {}", text(&tokens.stderr));
    let document = json(&tokens);
    let mut at = 0;
    for token in document["tokens"].as_array().expect("a list") {
        let range = [&token["start"], &token["end"]].map(|value| value.as_u64().expect("a number") as usize);
        assert_eq!(range[0], at, "{name}: tokens tile the file");
        let own = String::from_utf8_lossy(&bytes[range[0]..range[1]]);
        assert_eq!(token["text"].as_str(), Some(own.as_ref()), "{name}");
        at = range[1];
    }
    assert_eq!(at, bytes.len(), "{name}: tokens tile the file");
    let (arguments, is_json) = COMMANDS[mutation % COMMANDS.len()];
    let output = trunnion_in(folder, &[arguments, &[name]].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        matches!(status(&output), 0..=2) && !said.contains("panicked"),
        "{arguments:?} {name}: {said}"
    );
    assert!(
        status(&output) < 2 || !said.is_empty(),
        "{arguments:?} {name}: no message"
    );
    if is_json && status(&output) < 2 {
        json(&output);
    }
}
