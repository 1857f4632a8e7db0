//! `--baseline` and `--write-baseline`: findings that are known and accepted, by their fingerprints.
use super::one::Checked;
use crate::cli::{
    failure::{Failure, remark},
    load, short,
};
use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeMap,
    io::{self, Write},
    path::{Path, PathBuf},
};
use trunnion_check::{Diagnostic, ValueKey};

const SCHEMA: &str = "trunnion-baseline/1";

/// Values that say how bad a finding is: more of them is worse. Keys begin with these words.
const BADNESS: [&str; 4] = ["excess_", "deviation_", "rotary_change", "rotary_excess"];

/// How much more of a value is still the accepted finding.
const SLACK: f64 = 1.1;

/// A known finding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    fingerprint: String,
    rule: String,
    /// `error`, `warning`, `info` or `unknown`; for people.
    severity: String,
    message: String,
    /// How bad it is.
    #[serde(default)]
    values: BTreeMap<String, f64>,
}

impl Entry {
    /// The entry for a finding.
    pub(super) fn of(d: &Diagnostic, fingerprint: &str) -> Self {
        Self {
            fingerprint: fingerprint.to_owned(),
            rule: d.rule.to_owned(),
            severity: short::weight(d).to_owned(),
            message: d.message.clone(),
            values: badness(d).collect(),
        }
    }
    /// Whether the finding is the accepted one and not clearly worse.
    pub(super) fn covers(&self, d: &Diagnostic) -> bool {
        badness(d).all(|(key, now)| {
            let then = self.values.get(&key);
            then.is_some_and(|then| now.abs() <= then.abs() * SLACK + 1e-6)
        })
    }
}

/// The numbers of a finding that say how bad it is.
fn badness(d: &Diagnostic) -> impl Iterator<Item = (String, f64)> {
    // more blocks with it are more of it
    let count = core::iter::once(("count".to_owned(), f64::from(d.count)));
    count.chain(d.values.iter().filter_map(|(key, value)| match value {
        ValueKey::Number(number) if number.is_finite() && BADNESS.iter().any(|word| key.starts_with(word)) => {
            Some(((*key).to_owned(), *number))
        }
        _ => None,
    }))
}

/// The file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document<Files> {
    schema: String,
    /// Findings of each program; its path is relative to the folder of the baseline, with `/`.
    files: Files,
}

/// A baseline that was read.
pub(super) struct Baseline {
    path: PathBuf,
    files: BTreeMap<String, BTreeMap<String, Entry>>,
}

impl Baseline {
    /// Reads it.
    pub(super) fn read(path: &Path) -> Result<Self, Failure> {
        if !path.exists() {
            return Err(Failure::file(
                path,
                "does not exist; `trunnion check PATH... --write-baseline FILE` writes a baseline",
            ));
        }
        let bytes = load::read(path)?;
        let document: Document<BTreeMap<String, Vec<Entry>>> = serde_json::from_slice(&bytes).map_err(|error| {
            Failure::new(format!(
                "{}:{}:{}: this is not a baseline: {error}; write it anew with --write-baseline",
                path.display(),
                error.line(),
                error.column()
            ))
        })?;
        if document.schema != SCHEMA {
            return Err(Failure::file(
                path,
                format!(
                    "has the schema {:?}, not {SCHEMA:?}; write it anew with --write-baseline",
                    document.schema
                ),
            ));
        }
        let by_mark = |list: Vec<Entry>| {
            list.into_iter()
                .map(|entry| (entry.fingerprint.clone(), entry))
                .collect()
        };
        let files = document.files.into_iter().map(|(key, list)| (key, by_mark(list)));
        Ok(Self {
            path: path.to_owned(),
            files: files.collect(),
        })
    }
    /// The key of a program.
    pub(super) fn key(&self, program: &Path) -> String {
        key(&self.path, program)
    }
    /// The known findings of a program.
    pub(super) fn of(&self, key: &str) -> Option<&BTreeMap<String, Entry>> {
        self.files.get(key)
    }
    /// Says how many of its findings are not found any more.
    pub(super) fn remark_gone(&self, quiet: bool, gone: u64) {
        if gone > 0 {
            let noun = if gone == 1 { "finding" } else { "findings" };
            let text = format!(
                "{}: {gone} accepted {noun} changed or did not occur again; when no new ones are left, --write-baseline replaces it",
                self.path.display()
            );
            remark(quiet, &text);
        }
    }
}

/// The path of a program relative to the folder of a baseline, with `/`.
pub(super) fn key(baseline: &Path, program: &Path) -> String {
    let folder = baseline.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = std::fs::canonicalize(folder.unwrap_or(Path::new("."))).unwrap_or_default();
    // the file itself may be a link: its name counts, in its real folder
    let home = program.parent().filter(|folder| !folder.as_os_str().is_empty());
    let home = std::fs::canonicalize(home.unwrap_or(Path::new(".")));
    let Some((home, name)) = home.ok().zip(program.file_name()) else {
        return program.display().to_string();
    };
    let full = home.join(name);
    let mut up = String::new();
    for above in folder.ancestors() {
        if let Ok(rest) = full.strip_prefix(above) {
            let parts: Vec<_> = rest.iter().map(|part| part.to_string_lossy()).collect();
            return format!("{up}{}", parts.join("/"));
        }
        up.push_str("../");
    }
    full.display().to_string()
}

/// The findings that are written to a baseline.
pub(super) struct Accepted {
    wanted: bool,
    files: BTreeMap<String, Vec<Entry>>,
}

impl Accepted {
    /// None yet; they are kept only if they are written.
    pub(super) fn new(file: Option<&Path>) -> Self {
        Self {
            wanted: file.is_some(),
            files: BTreeMap::new(),
        }
    }
    /// Takes those of a file.
    pub(super) fn take(&mut self, file: &Checked) {
        let (key, entries) = &file.entries;
        if self.wanted && !entries.is_empty() {
            self.files.insert(key.clone(), entries.clone());
        }
    }
    /// Writes the file.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let document = Document {
            schema: SCHEMA.to_owned(),
            files: &self.files,
        };
        serde_json::to_writer_pretty(&mut *out, &document)?;
        writeln!(out)
    }
    /// What was written.
    pub(super) fn remark(&self, path: &str) -> String {
        let count: usize = self.files.values().map(Vec::len).sum();
        let noun = if count == 1 { "finding" } else { "findings" };
        format!("{path}: {count} {noun} accepted; check with --baseline {path}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative_to_the_baseline() {
        let folder = std::env::temp_dir();
        let baseline = folder.join("baseline.json");
        assert_eq!(key(&baseline, &folder.join("x.nc")), "x.nc");
        assert!(key(&baseline, &folder.join("../y.nc")).ends_with("../y.nc"));
    }
}
