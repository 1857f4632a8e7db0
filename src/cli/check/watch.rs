//! `check --watch`: checks again whenever a program, its settings or its machine file changes.
//!
//! It looks at sizes and times of files instead of waiting for events: events of shared folders do not reach other computers.
use super::once;
use crate::cli::{
    Done,
    args::{Check, Global},
    failure::{Failure, remark},
    load, walk,
};
use std::{
    collections::{BTreeMap, BTreeSet},
    path::PathBuf,
    thread,
    time::{Duration, Instant, SystemTime},
};

/// How often files are looked at.
const PAUSE: Duration = Duration::from_millis(500);

/// A look at many files is followed by a rest of so many times its own duration.
const REST: u32 = 20;

/// Size and time of the last change.
type State = BTreeMap<PathBuf, Option<(u64, SystemTime)>>;

/// Runs until it is interrupted.
pub(super) fn run(global: &Global, command: &Check) -> Result<Done, Failure> {
    if command.paths.iter().any(|path| load::is_stdin(path)) {
        return Err(Failure::new(
            "--watch needs files or folders; standard input cannot be watched",
        ));
    }
    loop {
        let before = state(global, command);
        // what cannot be checked now can be mended while it is watched
        match once(global, command) {
            Ok(_) => {}
            Err(failure) if failure.is_broken_pipe() => return Err(failure),
            Err(failure) => failure.print(),
        }
        remark(global.quiet, "watching for changes; end with Ctrl-C");
        loop {
            let begun = Instant::now();
            if state(global, command) != before {
                break;
            }
            thread::sleep(PAUSE.max(begun.elapsed() * REST));
        }
    }
}

/// The files that the verdicts depend on, with those beside them that may be called.
fn state(global: &Global, command: &Check) -> State {
    let mut state = State::new();
    let mut add = |path: PathBuf| {
        let seen = std::fs::metadata(&path).ok();
        let seen = seen.and_then(|metadata| Some((metadata.len(), metadata.modified().ok()?)));
        state.insert(path, seen);
    };
    let (found, _) = walk::search(&command.paths);
    let mut folders = BTreeSet::new();
    for file in &found.files {
        let folder = std::fs::canonicalize(file).unwrap_or_else(|_| file.clone());
        if let Some(folder) = folder.parent() {
            folders.insert(folder.to_owned());
        }
        add(file.clone());
    }
    for folder in &folders {
        for above in folder.ancestors() {
            add(above.join("trunnion.toml"));
        }
        // a called program, a machine file
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = entry.file_name();
            let kind = path.extension();
            // not a log that this very command writes
            if kind.is_none_or(|kind| kind == "toml") || trunnion_dialect::is_program_file_name(&name.to_string_lossy())
            {
                add(path);
            }
        }
    }
    let named = global.machine.iter().map(PathBuf::from).chain(global.config.clone());
    named.chain(command.baseline.clone()).for_each(&mut add);
    // the cache and the outputs change by themselves
    for own in command
        .output
        .iter()
        .chain(&command.write_baseline)
        .chain(&command.cache)
    {
        let real = std::fs::canonicalize(own).unwrap_or_else(|_| own.clone());
        state.retain(|path, _| std::fs::canonicalize(path).unwrap_or_else(|_| path.clone()) != real);
    }
    state
}
