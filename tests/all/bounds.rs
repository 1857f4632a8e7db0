//! Every command ends on every hostile program, in every dialect: with status 0, 1 or 2, with a message where it has no answer, and in the long
//! form within 10 s of processor time and 1 GB. Promise: SECURITY.md.
//!
//! CI runs small files and a sample: each program with one command of each group, in one dialect after the other. `TRUNNION_BOUNDS=full` runs
//! large files: each program with each command, each program in each dialect, each command in each dialect. `TRUNNION_BOUNDS=matrix` runs every
//! combination. Both print the worst runs (CONTRIBUTING.md). A program that is written for one control meets the others in the matrix only. `TRUNNION_BOUNDS_ONLY=TEXT,TEXT` takes only runs with one of the texts in `COMMAND PROGRAM DIALECT`.
//! `TRUNNION_BOUNDS_KEEP=FOLDER` works in that folder and leaves the programs there, to run a command on one of them by hand.
#![cfg(unix)]
#![expect(clippy::print_stdout, reason = "the long form prints a table")]
mod beside;
pub(crate) mod commands;
mod inputs;
pub(crate) mod measure;

use commands::COMMANDS;
use inputs::Input;
use measure::Measured;
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

/// Runs one cell; what is wrong with it, and what it took.
fn run(folder: &Path, form: &Form, inputs: &[Input], cell: Cell) -> (String, Measured, Option<String>) {
    let name = name(inputs, cell);
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
    let wrong = wrong(form, command, &measured);
    (name, measured, wrong)
}

/// What a run may not do.
fn wrong(form: &Form, command: &commands::Command, measured: &Measured) -> Option<String> {
    let broken = command.broken(measured);
    if broken.is_some() {
        return broken;
    }
    if form.long && measured.seconds > MOST_SECONDS {
        return Some(format!("took {:.1} s", measured.seconds));
    }
    if form.long && measured.bytes > MOST_BYTES {
        return Some(format!("took {} MB", measured.bytes / 1_000_000));
    }
    None
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
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    // a worker takes all runs of one program, so that large files exist one at a time
    let mut results: Vec<_> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..workers)
            .map(|_| {
                scope.spawn(|| {
                    let mut results = Vec::new();
                    loop {
                        let input = next.fetch_add(1, Ordering::Relaxed);
                        if input >= inputs.len() {
                            return results;
                        }
                        let own: Vec<Cell> = cells.iter().copied().filter(|cell| cell.0 == input).collect();
                        if own.is_empty() {
                            continue;
                        }
                        let file = format!("{}.nc", inputs[input].name);
                        commands::write_program(folder, &file, &inputs[input].bytes(form.size));
                        for cell in own {
                            let result = run(folder, &form, &inputs, cell);
                            if let (true, Some(wrong)) = (form.long, &result.2) {
                                println!("{}: {wrong}", result.0);
                            }
                            results.push(result);
                        }
                        if kept.is_none() {
                            commands::remove_program(folder, &file);
                        }
                    }
                })
            })
            .collect();
        workers
            .into_iter()
            .flat_map(|worker| worker.join().expect("no panic"))
            .collect()
    });
    if form.long {
        table(&mut results);
    }
    assert_eq!(results.len(), cells.len());
    let wrong: Vec<String> = results
        .iter()
        .filter_map(|(name, _, wrong)| wrong.as_ref().map(|wrong| format!("{name}: {wrong}")))
        .collect();
    assert!(
        wrong.is_empty(),
        "{} of {} runs:\n{}",
        wrong.len(),
        cells.len(),
        wrong.join("\n")
    );
}

/// Prints the runs that took most time and most memory.
fn table(results: &mut [(String, Measured, Option<String>)]) {
    println!("{} runs", results.len());
    let print = |results: &[(String, Measured, Option<String>)]| {
        for (name, measured, _) in results.iter().take(25) {
            let memory = measured.bytes / 1_000_000;
            println!("{:8.1} s {memory:8} MB   {name}", measured.seconds);
        }
    };
    results.sort_by(|a, b| b.1.seconds.total_cmp(&a.1.seconds));
    println!("most processor time:");
    print(results);
    results.sort_by_key(|result| std::cmp::Reverse(result.1.bytes));
    println!("most memory:");
    print(results);
}
