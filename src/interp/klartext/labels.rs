//! The labels of a file, and the files that a called program may be in.
use super::calls::key_of;
use super::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_flow::{Index, Key, Loops};
use trunnion_syntax::Program;

pub(super) fn no_label(key: &Key) -> FaultKind {
    refused_label(|name| format!("the program has no label {name}"), key)
}

pub(super) fn doubled_label(key: &Key) -> FaultKind {
    refused_label(|name| format!("the program has label {name} more than once"), key)
}

fn refused_label(message: impl Fn(&str) -> String, key: &Key) -> FaultKind {
    let name = match key {
        Key::Number(number) => number.to_string(),
        Key::Name(name) => format!("\"{name}\""),
    };
    FaultKind::Rejected {
        refusal: Refusal::Label,
        message: message(&name),
        alarm: None,
    }
}

/// The labels of a file with their blocks.
pub(super) fn named(program: &Program) -> Vec<(Key, u32)> {
    let mut found = Vec::new();
    for view in program.blocks() {
        let Some(sentence) = view.sentence() else { continue };
        let text = sentence.text();
        let mut words = Words::new(&text);
        let Some(first) = words.next().filter(|word| word.is("LBL")) else {
            continue;
        };
        match key_of(first.value, &mut words) {
            Some(Key::Number(0)) | None => {}
            Some(key) => found.push((key, view.id().0)),
        }
    }
    found
}

pub(super) fn labels(program: &Program) -> Index<()> {
    Index::of(
        named(program),
        Vec::new(),
        Loops::default(),
        Vec::new(),
        program.block_count() as u32,
    )
}

/// File names that a called program may have.
pub(super) fn files(name: &str) -> Vec<String> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let mut files = vec![name.to_owned()];
    for stem in [stem.to_owned(), stem.to_ascii_lowercase(), stem.to_ascii_uppercase()] {
        for ending in ["h", "H"] {
            let file = format!("{stem}.{ending}");
            if !files.contains(&file) {
                files.push(file);
            }
        }
    }
    files
}
