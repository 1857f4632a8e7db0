//! Runs `certify` and `diff` on pairs, all cores at once.
use super::reading::Pair;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use tempfile::TempDir;

/// What one command said.
pub(crate) struct Said {
    /// PROVED, REFUTED, SAME, DIFFERENT or UNKNOWN; `nothing` when none of them was printed.
    pub(crate) word: String,
    /// Whether that was the first word on standard output.
    pub(crate) comes_first: bool,
    /// The line of the verdict, or the first line of the failure.
    pub(crate) first_line: String,
    pub(crate) status: Option<i32>,
}

impl fmt::Display for Said {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.word)?;
        match (self.word.as_str(), self.status) {
            ("nothing", _) => write!(f, " ({})", self.first_line),
            ("PROVED" | "SAME", Some(0)) | (_, Some(1)) => Ok(()),
            (_, status) => write!(f, " (exit status {status:?})"),
        }
    }
}

/// What both commands said of a pair.
pub(crate) struct Answer {
    pub(crate) certify: Said,
    pub(crate) diff: Said,
}

/// The binary under test: `TRUNNION_BIN`, else the one that Cargo built.
pub(crate) fn binary() -> PathBuf {
    std::env::var_os("TRUNNION_BIN").map_or_else(|| PathBuf::from(env!("CARGO_BIN_EXE_trunnion")), PathBuf::from)
}

/// The answers to all pairs, in their order.
pub(crate) fn ask_all(pairs: &[Pair]) -> Vec<Answer> {
    let (next, answers) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(pair) = pairs.get(i) else { break };
                    let answer = ask(pair);
                    answers.lock().expect("no thread panics here").push((i, answer));
                }
            });
        }
    });
    let mut answers = answers.into_inner().expect("no thread panics here");
    answers.sort_by_key(|(i, _)| *i);
    answers.into_iter().map(|(_, answer)| answer).collect()
}

/// The file extension that fits the dialect; the dialect itself is named on the command line, or in a comment.
fn extension(dialect: &str) -> &'static str {
    match dialect {
        "sinumerik-840d" => "mpf",
        "heidenhain-klartext" => "h",
        "okuma-osp" => "min",
        "linuxcnc" => "ngc",
        "apt" => "apt",
        _ => "nc",
    }
}

/// A program that says for which control it is.
fn with_its_dialect(dialect: &str, text: &str) -> String {
    match extension(dialect) {
        "nc" | "ngc" => format!("(trunnion: dialect {dialect})\n{text}"),
        _ => text.to_owned(),
    }
}

fn ask(pair: &Pair) -> Answer {
    let folder = TempDir::new().expect("a temporary folder");
    let place = |name: String, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("writable");
        path
    };
    let dialects = [&pair.dialect, pair.dialect_after.as_ref().unwrap_or(&pair.dialect)];
    let name = |which: &str, dialect: &str| format!("{which}.{}", extension(dialect));
    let texts = [&pair.before, &pair.after];
    let texts: [String; 2] = core::array::from_fn(|at| match pair.dialect_after {
        Some(_) => with_its_dialect(dialects[at], texts[at]),
        None => texts[at].clone(),
    });
    let before = place(name("before", dialects[0]), &texts[0]);
    let after = place(name("after", dialects[1]), &texts[1]);
    for (name, text) in &pair.files {
        place(name.clone(), text);
    }
    let run = |command: &str, words: &[&str]| -> Said {
        let mut job = Command::new(binary());
        job.arg(command).args(["--machine", &pair.machine]);
        if pair.dialect_after.is_none() {
            job.args(["--dialect", &pair.dialect]);
        }
        if let (Some(claim), "certify") = (&pair.claim, command) {
            job.args(["--claim", claim]);
        }
        said(job.args([&before, &after]), folder.path(), words)
    };
    Answer {
        certify: run("certify", &["PROVED", "REFUTED", "UNKNOWN"]),
        diff: run("diff", &["SAME", "DIFFERENT", "UNKNOWN"]),
    }
}

fn said(job: &mut Command, folder: &Path, words: &[&str]) -> Said {
    let output = job.current_dir(folder).output().expect("the binary runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let verdict = |line: &str| -> Option<String> {
        let word = line.split_whitespace().next().unwrap_or_default();
        words.contains(&word).then(|| word.to_owned())
    };
    let found = text
        .lines()
        .enumerate()
        .find_map(|(i, line)| Some((i, verdict(line)?, line)));
    let failure = String::from_utf8_lossy(&output.stderr)
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned();
    Said {
        comes_first: found.as_ref().is_some_and(|(i, ..)| *i == 0),
        word: found.as_ref().map_or("nothing".to_owned(), |(_, word, _)| word.clone()),
        first_line: found.map_or(failure, |(_, _, line)| line.to_owned()),
        status: output.status.code(),
    }
}
