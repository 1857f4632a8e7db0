//! The labels of a file, and the files that a called program may be in.
use super::Klartext;
use super::calls::key_of;
use super::words::Words;
use crate::{FaultKind, Refusal};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use trunnion_flow::{Index, Key, Loops};
use trunnion_syntax::{BlockId, Program};

pub(super) fn no_label(key: &Key) -> FaultKind {
    refused_label(|name| format!("the program has no label {name}"), key)
}

/// The lines of the first label and of another; the path of the file, where it is one that is called.
fn doubled_label(key: &Key, [first, other]: [u32; 2], path: Option<&str>) -> FaultKind {
    let of = path.map_or_else(String::new, |path| format!("{path}: "));
    let message =
        |name: &str| format!("{of}the program has label {name} more than once: in line {first} and in line {other}");
    refused_label(message, key)
}

impl Klartext<'_> {
    /// What the control refuses a file for when it is loaded: labels that it has more than once, each with the block of the other one. Only the first
    /// time for each file.
    pub(super) fn doubled_labels(
        &mut self,
        file: u16,
        program: &Program,
        path: Option<&str>,
    ) -> Vec<(BlockId, FaultKind)> {
        if self.flow.doubled.contains_key(&file) {
            return Vec::new();
        }
        let mut first = HashMap::new();
        let (mut doubled, mut found) = (HashMap::new(), Vec::new());
        for (key, block) in labels_of(program) {
            match first.entry(key.clone()) {
                Entry::Vacant(entry) => {
                    entry.insert(block);
                }
                Entry::Occupied(entry) => {
                    let lines = [entry.get() + 1, block + 1];
                    found.push((BlockId(block), doubled_label(&key, lines, path)));
                    doubled.entry(key).or_insert(lines);
                }
            }
        }
        self.flow.doubled.insert(file, doubled);
        found
    }

    /// The same of a file that is called, with its path.
    pub(super) fn doubled_in_called(&mut self, file: u16) -> Vec<FaultKind> {
        let Some(called) = self.flow.library.file(file) else {
            return Vec::new();
        };
        let found = self.doubled_labels(file, &called.program, Some(&*called.path));
        found.into_iter().map(|(_, kind)| kind).collect()
    }

    /// Why a label of the file that runs leads nowhere, where it has it more than once.
    pub(super) fn refused_target(&self, key: &Key) -> Option<FaultKind> {
        let file = self.flow.course.place().file;
        let lines = self.flow.doubled.get(&file)?.get(key)?;
        Some(doubled_label(key, *lines, None))
    }
}

/// As [`named`], without reading a file that has none.
fn labels_of(program: &Program) -> Vec<(Key, u32)> {
    let has = program
        .source()
        .windows(3)
        .any(|word| word.eq_ignore_ascii_case(b"LBL"));
    if has { named(program) } else { Vec::new() }
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
fn named(program: &Program) -> Vec<(Key, u32)> {
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
