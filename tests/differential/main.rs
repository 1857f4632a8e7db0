//! Random programs through `trunnion canon` and through LinuxCNC's own interpreter `rs274 -g`: both must say the same, call for call.
//!
//! `TRUNNION_DIFFERENTIAL=10000 cargo test --test differential` runs that many programs (default 300);
//! `TRUNNION_DIFFERENTIAL_SEED=N` starts at another seed. Skipped where `rs274` (Debian: linuxcnc-uspace) is not installed.
#![expect(
    clippy::disallowed_methods,
    reason = "random programs need no reproducible last digit"
)]
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
mod flow;
mod generate;
mod motions;
mod random;

use std::path::Path;
use std::process::{Command, Output};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// What an interpreter says: the calls, the error if there is one, whether it ended well.
#[derive(Debug, PartialEq, Eq)]
struct Answer {
    calls: Vec<String>,
    error: String,
    good: bool,
}

fn answer(output: &Output) -> Answer {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let mut errors = text(&output.stderr).lines().map(str::to_owned).collect::<Vec<_>>();
    errors.retain(|line| line != "executing");
    Answer {
        // a zero has no sign: it depends on the order of sums, which neither promises
        calls: text(&output.stdout)
            .lines()
            .map(|line| line.replace("-0.0000", "0.0000"))
            .collect(),
        error: errors.join("\n"),
        good: output.status.success(),
    }
}

fn ask(program: &Path, oracle: bool) -> Option<Answer> {
    let mut command = if oracle {
        let mut command = Command::new("timeout");
        command.args(["10", "rs274", "-g"]);
        command
    } else {
        let mut command = Command::new("timeout");
        command.args(["60", env!("CARGO_BIN_EXE_trunnion"), "canon"]);
        command
    };
    let folder = program.parent()?;
    // rs274 keeps parameters in the folder that it runs in
    for entry in std::fs::read_dir(folder)
        .ok()?
        .flatten()
        .filter(|entry| entry.path() != program)
    {
        std::fs::remove_file(entry.path()).ok();
    }
    // rs274 shares its tool table between all runs of a user
    command
        .arg(program.file_name()?)
        .current_dir(folder)
        .env("HOME", folder);
    let output = command.output().ok()?;
    Some(answer(&output))
}

/// Whether both say the same of a program.
fn agree(folder: &Path, text: &str) -> bool {
    let path = folder.join("p.ngc");
    std::fs::write(&path, text).expect("the temporary folder is writable");
    ask(&path, true) == ask(&path, false)
}

/// The program without every line that plays no part in the difference.
fn shrink(folder: &Path, text: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let end = lines.pop().unwrap_or_default();
    let mut step = lines.len() / 2;
    while step > 0 {
        let mut at = 0;
        while at < lines.len() {
            let mut fewer = lines.clone();
            fewer.drain(at..(at + step).min(lines.len()));
            let text = format!("{}\n{end}\n", fewer.join("\n"));
            if agree(folder, &text) {
                at += step;
            } else {
                lines = fewer;
            }
        }
        step /= 2;
    }
    format!("{}\n{end}\n", lines.join("\n"))
}

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name)
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(default)
}

#[test]
fn random_programs_do_what_linuxcnc_says() {
    if Command::new("rs274").arg("-?").output().is_err() {
        println!("skipped: rs274 is not installed (Debian: linuxcnc-uspace)");
        return;
    }
    let first = number("TRUNNION_DIFFERENTIAL_SEED", 1);
    let count = number("TRUNNION_DIFFERENTIAL", 300);
    let next = AtomicU64::new(first);
    let differences = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                let folder = tempfile::tempdir().expect("a temporary folder");
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed >= first + count || differences.lock().expect("no thread has failed").len() >= 8 {
                        return;
                    }
                    let text = generate::program(seed);
                    if !agree(folder.path(), &text) {
                        let short = shrink(folder.path(), &text);
                        let path = folder.path().join("p.ngc");
                        std::fs::write(&path, &short).expect("the temporary folder is writable");
                        let report = format!(
                            "seed {seed}:\n{short}--- rs274\n{:#?}\n--- trunnion\n{:#?}",
                            ask(&path, true),
                            ask(&path, false)
                        );
                        differences.lock().expect("no thread has failed").push(report);
                    }
                }
            });
        }
    });
    let differences = differences.into_inner().expect("no thread has failed");
    assert!(
        differences.is_empty(),
        "{} differences\n{}",
        differences.len(),
        differences.join("\n\n")
    );
    println!("{count} programs agree with rs274");
}
