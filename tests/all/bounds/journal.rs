//! What a long form has measured, so that one that was ended goes on where it was: `TRUNNION_BOUNDS_JOURNAL=FILE`.
use super::Outcome;
use std::{
    collections::BTreeMap,
    fs::File,
    io::Write,
    sync::{Mutex, PoisonError},
};

/// Elements and name of a run.
type Key = (usize, String);

/// Seconds, bytes, what was wrong.
type Taken = (f64, u64, Option<String>);

/// A line for each run: elements, seconds, bytes, name, what is wrong. A run with a line is not made again; whoever changes what is measured
/// removes the lines.
pub(super) struct Journal {
    known: BTreeMap<Key, Taken>,
    file: Option<Mutex<File>>,
}

impl Journal {
    /// The one that is asked for; an empty one that is not kept otherwise.
    pub(super) fn asked() -> Self {
        let Some(path) = std::env::var_os("TRUNNION_BOUNDS_JOURNAL") else {
            return Self {
                known: BTreeMap::new(),
                file: None,
            };
        };
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let file = File::options().create(true).append(true).open(path).expect("a journal");
        Self {
            known: text.lines().filter_map(entry).collect(),
            file: Some(Mutex::new(file)),
        }
    }

    /// What a run took: time, memory, what was wrong.
    pub(super) fn of(&self, size: usize, name: &str) -> Option<Taken> {
        self.known.get(&(size, name.to_owned())).cloned()
    }

    /// Writes down a run.
    pub(super) fn write(&self, size: usize, name: &str, run: &Outcome) {
        let Some(file) = &self.file else { return };
        let wrong = run.wrong.as_deref().unwrap_or_default().replace(['\n', '\t'], " ");
        let line = format!("{size}\t{}\t{}\t{name}\t{wrong}\n", run.seconds, run.bytes);
        let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(line.as_bytes()).expect("written");
    }
}

fn entry(line: &str) -> Option<(Key, Taken)> {
    let fields: Vec<&str> = line.split('\t').collect();
    let &[size, seconds, bytes, name, wrong] = fields.as_slice() else {
        return None;
    };
    let wrong = (!wrong.is_empty()).then(|| wrong.to_owned());
    let taken = (seconds.parse().ok()?, bytes.parse().ok()?, wrong);
    Some(((size.parse().ok()?, name.to_owned()), taken))
}
