//! Real programs, changed at random places, through the command line: every command ends with status 0, 1 or 2, what is asked for as JSON is
//! JSON, and the tokens hold every byte of the file. CI runs some; `TRUNNION_MUTATIONS=10000` is the long form, `TRUNNION_MUTATIONS=2000..4000`
//! a part of it (CONTRIBUTING.md).
#![cfg(unix)]
use crate::bounds::{
    commands::{COMMANDS, remove_program, write_helpers, write_program},
    measure,
};
use crate::cli::tools::{json, status, text, trunnion_in};
use crate::mutations::{mutate, programs};
use crate::random::Random;
use std::{fs, ops::Range, path::Path, time::Duration};
use tempfile::TempDir;

/// Processor time after which a run is taken to hang.
const PATIENCE: Duration = Duration::from_mins(5);

/// Programs in a folder that one `check` judges.
const AT_ONCE: usize = 100;

/// The numbers of the mutations: each is made from its own number, so that the long form can be run in parts.
fn mutations() -> Range<usize> {
    let asked = std::env::var("TRUNNION_MUTATIONS").unwrap_or_default();
    let (from, to) = asked.split_once("..").unwrap_or(("0", &asked));
    let number = |text: &str| text.parse().ok();
    number(from).zip(number(to)).map_or(0..150, |(from, to)| from..to)
}

/// So many commands run on one program: one in CI, several in the long form. All of them take turns.
fn turns() -> usize {
    if std::env::var_os("TRUNNION_MUTATIONS").is_some() {
        5
    } else {
        1
    }
}

#[test]
fn mutated_real_programs_end_with_a_status_and_valid_json() {
    let programs = programs();
    let asked = mutations();
    for first in asked.clone().step_by(AT_ONCE) {
        // all mutations, judged by one `check`; and one at a time, with what other commands read beside it
        let [folder, beside] = [(); 2].map(|()| TempDir::new().expect("a folder"));
        let settings =
            "machine = \"mikron-ucp710\"\n[limits]\nblocks = 5000\n[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\n";
        for folder in [&folder, &beside] {
            fs::write(folder.path().join("trunnion.toml"), settings).expect("written");
        }
        write_helpers(beside.path());
        let number = AT_ONCE.min(asked.end - first);
        for mutation in first..first + number {
            let mut random = Random(20_261_124 + (mutation as u64) * 0x9e37_79b9);
            let (path, source) = &programs[random.below(programs.len())];
            let bytes = mutate(&mut random, source);
            // with its whole name: `part.ncl.8` is a version of a program
            let own = path.file_name().unwrap_or_default().to_string_lossy();
            let name = format!("m{mutation}-{own}");
            fs::write(folder.path().join(&name), &bytes).expect("written");
            write_program(beside.path(), &name, &bytes);
            one(beside.path(), &name, &bytes, mutation);
            remove_program(beside.path(), &name);
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
    for turn in 0..turns() {
        let command = &COMMANDS[(mutation * turns() + turn) % COMMANDS.len()];
        let measured = measure::run(
            folder,
            &command.arguments(name, None),
            command.talks(folder, name),
            PATIENCE,
        );
        let wrong = command.broken(&measured);
        assert!(
            wrong.is_none(),
            "{} {name}: {}",
            command.name,
            wrong.unwrap_or_default()
        );
    }
}
