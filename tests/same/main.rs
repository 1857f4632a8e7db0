//! Pairs of programs that are the same, differ, or cannot be decided: what `certify` and `diff` must say of each.
//!
//! README.md in this folder says how the tables read. `TRUNNION_BIN=PATH cargo test --test same` tries another build.
mod reading;
mod running;

use reading::{Expected, Pair};
use running::{Answer, ask_all};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/same/pairs")
}

fn all_pairs() -> Vec<Pair> {
    let entries = std::fs::read_dir(folder()).expect("the folder of tables");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files.iter().flat_map(|file| reading::read(file)).collect()
}

/// Why an answer is wrong, or nothing.
fn wrong(pair: &Pair, answer: &Answer) -> Option<String> {
    let right = |says: &str, same: &str, different: &str| match pair.expected {
        Expected::Same => says == same,
        Expected::Different => says == different || says == "UNKNOWN",
        Expected::CertainlyDifferent => says == different,
        Expected::Unknown => says == "UNKNOWN",
    };
    let status = |says: &str, same: &str, code: Option<i32>| code == Some(i32::from(says != same));
    let good = right(&answer.certify.word, "PROVED", "REFUTED")
        && right(&answer.diff.word, "SAME", "DIFFERENT")
        && status(&answer.certify.word, "PROVED", answer.certify.status)
        && status(&answer.diff.word, "SAME", answer.diff.status);
    (!good).then(|| {
        format!(
            "{}: certify said {}, diff said {}, expected {}",
            pair.name, answer.certify, answer.diff, pair.expected
        )
    })
}

#[test]
fn every_pair_gets_the_answer_that_its_table_demands() {
    let pairs = all_pairs();
    assert!(pairs.len() >= 330, "only {} pairs were read", pairs.len());
    let answers = ask_all(&pairs);
    let (mut list, mut count, mut false_same, mut refused) = (String::new(), 0, 0, 0);
    for (pair, answer) in pairs.iter().zip(&answers) {
        let Some(line) = wrong(pair, answer) else { continue };
        count += 1;
        let proved = answer.certify.word == "PROVED" || answer.diff.word == "SAME";
        false_same += usize::from(proved && pair.expected != Expected::Same);
        refused += usize::from(pair.expected == Expected::Same);
        writeln!(list, "{line}").expect("text");
        for said in [&answer.certify, &answer.diff] {
            if pair.expected == Expected::Same && !["PROVED", "SAME"].contains(&said.word.as_str()) {
                writeln!(list, "    {}", said.first_line).expect("text");
            }
        }
    }
    assert!(
        count == 0,
        "{list}\n{count} of {} pairs got a wrong answer: {false_same} differ and were called the same, {refused} are \
         the same and were refused",
        pairs.len()
    );
}

/// Scripts read the first word (section "exit status" of the help): no headline may come before it.
#[test]
fn the_verdict_is_the_first_word_on_standard_output() {
    let pairs = all_pairs();
    let few: Vec<Pair> = pairs.into_iter().step_by(40).collect();
    let answers = ask_all(&few);
    let late: Vec<String> = few
        .iter()
        .zip(&answers)
        .filter(|(_, answer)| !(answer.certify.comes_first && answer.diff.comes_first))
        .map(|(pair, answer)| format!("{}: {} / {}", pair.name, answer.certify, answer.diff))
        .collect();
    assert!(late.is_empty(), "a headline comes before the verdict:\n{}", late.join("\n"));
}

#[test]
fn names_are_unique_and_every_dialect_has_pairs_of_both_kinds() {
    let pairs = all_pairs();
    let mut names: Vec<&str> = pairs.iter().map(|pair| pair.name.as_str()).collect();
    names.sort_unstable();
    let twice: Vec<&[&str]> = names.windows(2).filter(|two| two[0] == two[1]).collect();
    assert!(twice.is_empty(), "names that two pairs share: {twice:?}");
    let mut dialects: Vec<&str> = pairs.iter().map(|pair| pair.dialect.as_str()).collect();
    dialects.sort_unstable();
    dialects.dedup();
    for dialect in &dialects {
        let of = |same: bool| {
            let all = pairs.iter().filter(|pair| pair.dialect == *dialect);
            all.filter(|pair| (pair.expected == Expected::Same) == same).count()
        };
        assert!(of(true) > 0 && of(false) > 0, "{dialect}: {} same, {} not", of(true), of(false));
    }
    assert!(dialects.len() >= 8, "{dialects:?}");
}
