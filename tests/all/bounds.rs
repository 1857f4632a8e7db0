//! Every command ends on every hostile program, in every dialect: with status 0, 1 or 2, with a message where it has no answer, and in the long
//! form within 10 s of processor time and 1 GB; of a session with the server, each request. Promise: SECURITY.md.
//!
//! CI runs small files and a sample: each program with one command of each group, in one dialect after the other. `TRUNNION_BOUNDS=full` takes
//! large files: each program with each command, each program in each dialect, each command in each dialect. `TRUNNION_BOUNDS=matrix` takes every
//! combination. Both run each combination on two small files first and estimate the large one; only what may come near the bound, and a fixed
//! share of the rest, runs on the large file (`screen`). `TRUNNION_BOUNDS_UNSCREENED=1` runs all on the large file. Both print the worst runs (CONTRIBUTING.md). A program that is written for one control meets the others in the matrix only. `TRUNNION_BOUNDS_ONLY=TEXT,TEXT` takes only runs with one of the texts in `COMMAND PROGRAM DIALECT`.
//! `TRUNNION_BOUNDS_KEEP=FOLDER` works in that folder and leaves the programs there, to run a command on one of them by hand.
#![cfg(unix)]
#![expect(clippy::print_stdout, reason = "the long form prints a table")]
mod beside;
pub(crate) mod commands;
mod copied;
mod inputs;
mod journal;
pub(crate) mod measure;
mod screen;

use commands::COMMANDS;
use inputs::Input;
use journal::Journal;
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::atomic::{AtomicUsize, Ordering},
    time::Duration,
};
use tempfile::TempDir;
use trunnion::dialect::BUILTIN_NAMES;

/// What the long form allows a run at default limits.
const MOST_SECONDS: f64 = 10.0;
const MOST_BYTES: u64 = 1_000_000_000;

/// Settings of the folder: a machine, offsets and a tool, so that positions are known and everything is computed.
const SETTINGS: &str = "\
machine = \"mikron-ucp710\"

[work_offsets]
G54 = { X = 0, Y = 0, Z = 0 }

[[tool]]
number = 1
shape = \"ball\"
diameter = 10
length = 100
";

/// The bounds of the short form: it counts what they stop, not seconds.
const SMALL_LIMITS: &str = "\n[limits]\nblocks = 2000\nsteps = 2000\nheld = 2000\n";

/// One run of the matrix: places in the lists of programs, commands and dialects.
type Cell = (usize, usize, usize);

/// How much is run.
struct Form {
    /// Elements of each program.
    size: usize,
    /// Every combination, not a sample.
    all: bool,
    /// Default limits; time and memory are asserted.
    long: bool,
    /// The full size only where an estimate asks for it.
    screened: bool,
    /// What was measured before.
    journal: Journal,
    /// Part of the names.
    only: Option<String>,
}

impl Form {
    fn asked() -> Self {
        let form = std::env::var("TRUNNION_BOUNDS").unwrap_or_default();
        let long = form == "full" || form == "matrix";
        Self {
            size: if long { 480_000 } else { 200 },
            all: form == "matrix",
            long,
            journal: Journal::asked(),
            screened: long && std::env::var_os("TRUNNION_BOUNDS_UNSCREENED").is_none(),
            only: std::env::var("TRUNNION_BOUNDS_ONLY").ok(),
        }
    }

    /// The runs, program by program.
    fn cells(&self, inputs: &[Input]) -> Vec<Cell> {
        let dialects = BUILTIN_NAMES.len();
        let mut cells = Vec::new();
        for (input, program) in inputs.iter().enumerate() {
            let own = program.dialect.map(dialect);
            let mut taken = 0;
            let mut groups: BTreeMap<&str, usize> = BTreeMap::new();
            for (command, named) in COMMANDS.iter().enumerate() {
                let place = groups.entry(named.group).or_default();
                *place += 1;
                if self.all {
                    cells.extend((0..dialects).map(|dialect| (input, command, dialect)));
                    continue;
                }
                // of the commands of a group the short form takes one for each program
                let members = COMMANDS.iter().filter(|other| other.group == named.group).count();
                if !self.long && !(input + *place).is_multiple_of(members) {
                    continue;
                }
                // one after the other: a program meets every dialect, and so does a command
                cells.push((input, command, own.unwrap_or((input + taken) % dialects)));
                taken += 1;
            }
        }
        cells.retain(|&cell| self.asks_for(&name(inputs, cell)));
        cells
    }

    fn asks_for(&self, name: &str) -> bool {
        let Some(only) = &self.only else { return true };
        only.split(',').any(|part| name.contains(part))
    }
}

/// The place of a dialect in their list.
fn dialect(name: &str) -> usize {
    let place = BUILTIN_NAMES.iter().position(|own| *own == name);
    place.unwrap_or_else(|| panic!("no dialect {name}"))
}

/// How the table names a run: command, program, dialect.
fn name(inputs: &[Input], (input, command, dialect): Cell) -> String {
    let dialect = BUILTIN_NAMES[dialect];
    format!("{} {} {dialect}", COMMANDS[command].name, inputs[input].name)
}

/// What a run took, and what is wrong with it.
struct Outcome {
    cell: Cell,
    /// Processor time.
    seconds: f64,
    /// The most memory at once.
    bytes: u64,
    wrong: Option<String>,
}

/// Runs one cell on the program that lies in the folder.
fn run(folder: &Path, form: &Form, inputs: &[Input], cell: Cell) -> Outcome {
    let (input, command, dialect) = cell;
    let (command, dialect) = (&COMMANDS[command], BUILTIN_NAMES[dialect]);
    let file = format!("{}.nc", inputs[input].name);
    let patience = Duration::from_secs(if form.long { 30 } else { 300 });
    let measured = measure::run(
        folder,
        &command.arguments(&file, Some(dialect)),
        command.talks(folder, &file),
        patience,
    );
    let (seconds, bytes) = (measured.seconds, measured.bytes);
    let wrong = command.broken(&measured).or_else(|| {
        if form.long && seconds > MOST_SECONDS {
            return Some(format!("took {seconds:.1} s"));
        }
        (form.long && bytes > MOST_BYTES).then(|| format!("took {} MB", bytes / 1_000_000))
    });
    if let (true, Some(wrong)) = (form.long, &wrong) {
        println!("{}: {wrong}", name(inputs, cell));
    }
    Outcome {
        cell,
        seconds,
        bytes,
        wrong,
    }
}

/// What the journal says of a run.
fn known(form: &Form, inputs: &[Input], size: usize, cell: Cell) -> Option<Outcome> {
    let (seconds, bytes, wrong) = form.journal.of(size, &name(inputs, cell))?;
    Some(Outcome {
        cell,
        seconds,
        bytes,
        wrong,
    })
}

/// Runs cells on programs of `size` elements, in the order in which the programs come first in the list. A worker takes all runs of one program, so
/// that each file is written once and few large ones exist at a time.
fn sweep(folder: &Path, form: &Form, inputs: &[Input], size: usize, cells: &[Cell]) -> Vec<Outcome> {
    let mut order: Vec<usize> = Vec::new();
    let mut own: BTreeMap<usize, Vec<Cell>> = BTreeMap::new();
    for cell in cells {
        let runs = own.entry(cell.0).or_default();
        if runs.is_empty() {
            order.push(cell.0);
        }
        runs.push(*cell);
    }
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let kept = std::env::var_os("TRUNNION_BOUNDS_KEEP").is_some();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut outcomes = Vec::new();
        while let Some(&input) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            let file = format!("{}.nc", inputs[input].name);
            let known = own[&input].iter().map(|&cell| known(form, inputs, size, cell));
            let mut left = Vec::new();
            for (known, &cell) in known.zip(&own[&input]) {
                match known {
                    Some(outcome) => outcomes.push(outcome),
                    None => left.push(cell),
                }
            }
            if left.is_empty() {
                continue;
            }
            commands::write_program(folder, &file, &inputs[input].bytes(size));
            for cell in left {
                let outcome = run(folder, form, inputs, cell);
                form.journal.write(size, &name(inputs, cell), &outcome);
                outcomes.push(outcome);
            }
            if !kept {
                commands::remove_program(folder, &file);
            }
        }
        outcomes
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        let ended = workers.into_iter().flat_map(|worker| worker.join().expect("no panic"));
        ended.collect()
    })
}

#[test]
fn every_command_ends_on_every_hostile_program() {
    let form = Form::asked();
    let inputs = inputs::all();
    assert!(inputs.len() >= 100, "{} hostile programs", inputs.len());
    let temporary = TempDir::new().expect("a folder");
    let kept = std::env::var_os("TRUNNION_BOUNDS_KEEP").map(PathBuf::from);
    let folder = kept.as_deref().unwrap_or(temporary.path());
    let settings = format!("{SETTINGS}{}", if form.long { "" } else { SMALL_LIMITS });
    std::fs::write(folder.join("trunnion.toml"), settings).expect("written");
    commands::write_helpers(folder);
    let cells = form.cells(&inputs);
    let outcomes = if form.screened {
        screen::run(folder, &form, &inputs, &cells)
    } else {
        let outcomes = sweep(folder, &form, &inputs, form.size, &cells);
        assert_eq!(outcomes.len(), cells.len());
        outcomes
    };
    if form.long {
        let runs = outcomes.iter();
        table(
            runs.map(|run| (name(&inputs, run.cell), run.seconds, run.bytes))
                .collect(),
        );
    }
    let wrong: Vec<String> = outcomes
        .iter()
        .filter_map(|run| Some(format!("{}: {}", name(&inputs, run.cell), run.wrong.as_ref()?)))
        .collect();
    assert!(
        wrong.is_empty(),
        "{} of {} runs:\n{}",
        wrong.len(),
        cells.len(),
        wrong.join("\n")
    );
}

/// Prints the runs that took most time and most memory: names, seconds, bytes.
fn table(mut runs: Vec<(String, f64, u64)>) {
    println!("{} runs", runs.len());
    let print = |runs: &[(String, f64, u64)]| {
        for (name, seconds, bytes) in runs.iter().take(25) {
            println!("{seconds:8.1} s {:8} MB   {name}", bytes / 1_000_000);
        }
    };
    runs.sort_by(|a, b| b.1.total_cmp(&a.1));
    println!("most processor time:");
    print(&runs);
    runs.sort_by_key(|run| std::cmp::Reverse(run.2));
    println!("most memory:");
    print(&runs);
}
