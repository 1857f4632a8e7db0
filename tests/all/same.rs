//! Pairs of programs that are the same, differ, or cannot be decided: what `certify` and `diff` must say of each.
//!
//! README.md in this folder says how the tables read. `TRUNNION_BIN=PATH cargo test --test all same` tries another build.
mod mutants;
mod reading;
mod running;
mod samples;
mod words;

use self::mutants::Base;
use self::reading::{Expected, Pair};
use self::running::{Answer, ask_all};
use crate::random::Random;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Mutants tried in one run, all bases together.
const MUTANTS: usize = 3000;

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/same").join(folder);
    let entries = std::fs::read_dir(folder).expect("a folder of tables");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

fn all_pairs() -> Vec<Pair> {
    files("pairs").iter().flat_map(|file| reading::read(file)).collect()
}

fn bases() -> Vec<Base> {
    files("bases").iter().map(|file| Base::read(file)).collect()
}

/// Why an answer is wrong, or nothing.
fn wrong(pair: &Pair, answer: &Answer) -> Option<String> {
    let right = |says: &str, same: &str, different: &str| match pair.expected {
        Expected::Same => says == same,
        Expected::PerhapsSame => says == same || says == "UNKNOWN",
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
        let alike = matches!(pair.expected, Expected::Same | Expected::PerhapsSame);
        false_same += usize::from(proved && !alike);
        refused += usize::from(alike);
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
    assert!(
        late.is_empty(),
        "a headline comes before the verdict:\n{}",
        late.join("\n")
    );
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
        assert!(
            of(true) > 0 && of(false) > 0,
            "{dialect}: {} same, {} not",
            of(true),
            of(false)
        );
    }
    assert!(dialects.len() >= 8, "{dialects:?}");
}

/// A setting of the run from the environment.
fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{name}={text} is no number")))
}

/// One changed word that matters is never PROVED and never SAME. `TRUNNION_MUTANTS=N` tries N (0: all of them), `TRUNNION_SEED=N` others.
#[test]
fn no_mutant_is_called_the_same() {
    let wanted = number("TRUNNION_MUTANTS").map_or(MUTANTS, |n| n as usize);
    let mut random = Random(number("TRUNNION_SEED").unwrap_or(17));
    let bases = bases();
    // the same share of each base; a base with fewer mutants leaves the rest to the others
    let mut all: Vec<Vec<Pair>> = bases.iter().map(Base::mutants).collect();
    all.sort_by_key(Vec::len);
    let total: usize = all.iter().map(Vec::len).sum();
    let (mut chosen, mut left) = (Vec::new(), if wanted == 0 { total } else { wanted.min(total) });
    for (i, mut mutants) in all.into_iter().enumerate() {
        for _ in 0..(left / (bases.len() - i)).min(mutants.len()) {
            chosen.push(mutants.swap_remove(random.below(mutants.len())));
            left -= 1;
        }
    }
    let answers = ask_all(&chosen);
    let missed: Vec<String> = chosen
        .iter()
        .zip(&answers)
        .filter_map(|(pair, answer)| alike(pair, answer))
        .collect();
    assert!(
        missed.is_empty(),
        "{}\n{} of {} mutants ({total} exist) were called the same",
        missed.join("\n"),
        missed.len(),
        chosen.len()
    );
}

/// What is wrong with the answer to a mutant: it was called the same, or the command broke down.
fn alike(pair: &Pair, answer: &Answer) -> Option<String> {
    let bad =
        |said: &running::Said| !matches!(said.status, Some(1 | 2)) || ["PROVED", "SAME"].contains(&said.word.as_str());
    (bad(&answer.certify) || bad(&answer.diff)).then(|| {
        format!(
            "{}: certify said {}, diff said {}",
            pair.name, answer.certify, answer.diff
        )
    })
}

/// Numbers of blocks, comments, zeros, blanks, order of words: the same program.
#[test]
fn spelling_and_layout_change_nothing() {
    let pairs: Vec<Pair> = bases().iter().flat_map(Base::spellings).collect();
    let answers = ask_all(&pairs);
    let list: Vec<String> = pairs
        .iter()
        .zip(&answers)
        .filter_map(|(pair, answer)| {
            let why = wrong(pair, answer)?;
            Some(format!(
                "{why}\n    {}\n    {}",
                answer.certify.first_line, answer.diff.first_line
            ))
        })
        .collect();
    assert!(
        list.is_empty(),
        "{}\n{} of {} were refused",
        list.join("\n"),
        list.len(),
        pairs.len()
    );
}

/// The sample programs with one number changed: each of their numbers outside comments matters.
#[test]
fn no_number_of_a_sample_is_free() {
    let programs = [
        ("fanuc/drill-plate.nc", "fanuc-30i", "mill-3axis"),
        ("fanuc/pocket-frames.nc", "fanuc-30i", "mill-3axis"),
        ("fanuc/turn-shaft.nc", "fanuc-30i-lathe-a", "mill-turn-bc"),
        ("haas/flange.nc", "haas-ngc", "mill-3axis"),
        ("haas/slot-scaled.nc", "haas-ngc", "mill-3axis"),
        ("guide-vane/strategy-2.mpf", "sinumerik-840d", "mikron-ucp710"),
        ("calibration/fixed-tip-sweep.mpf", "sinumerik-840d", "mikron-ucp710"),
        ("apt/plate.apt", "apt", "mill-3axis"),
    ];
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/programs");
    let mut pairs = Vec::new();
    for (name, dialect, machine) in programs {
        let text = std::fs::read_to_string(samples.join(name)).expect("a sample");
        pairs.extend(samples::numbers_changed(name, &text, dialect, machine));
    }
    assert!(pairs.len() > 250, "only {} numbers were found", pairs.len());
    let answers = ask_all(&pairs);
    let missed: Vec<String> = pairs
        .iter()
        .zip(&answers)
        .filter_map(|(pair, answer)| alike(pair, answer))
        .collect();
    assert!(
        missed.is_empty(),
        "{}\n{} of {} were called the same",
        missed.join("\n"),
        missed.len(),
        pairs.len()
    );
}
