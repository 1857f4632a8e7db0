//! Random programs through `trunnion canon` and through LinuxCNC's own interpreter `rs274 -g`: both must say the same, call for call.
//!
//! `TRUNNION_DIFFERENTIAL=10000 cargo test --test all differential` runs that many programs (default 300);
//! `TRUNNION_DIFFERENTIAL_SEED=N` starts at another seed. Skipped where `rs274` (Debian: linuxcnc-uspace) is not installed.
#![expect(
    clippy::disallowed_methods,
    reason = "random programs need no reproducible last digit"
)]
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
mod calls;
mod codes;
mod explained;
mod fill;
mod flow;
mod generate;
mod mistakes;
mod motions;
mod settings;
mod topics;
mod turning;

use settings::{Case, PARAMETERS};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// What an interpreter says: the calls and the parameter file, the error if there is one, whether it ended well, or not at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Answer {
    calls: Vec<String>,
    error: String,
    good: bool,
    hangs: bool,
    crashed: bool,
}

/// What `timeout` exits with.
const STOPPED: i32 = 124;

fn answer(output: &Output, parameters: Option<&str>) -> Answer {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let mut errors = text(&output.stderr).lines().map(str::to_owned).collect::<Vec<_>>();
    errors.retain(|line| line != "executing");
    let mut calls: Vec<String> = text(&output.stdout).lines().map(str::to_owned).collect();
    // a word to its authors that rs274 prints between the calls of some turning contours
    calls.retain(|line| !line.starts_with("Oops ("));
    calls.extend(parameters.into_iter().flat_map(str::lines).map(str::to_owned));
    Answer {
        calls,
        error: errors.join("\n"),
        good: output.status.success(),
        hangs: output.status.code() == Some(STOPPED),
        crashed: !matches!(output.status.code(), Some(0 | 1 | STOPPED)),
    }
}

/// Who answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    Control,
    Ours,
    /// With eight decimals more.
    OursExactly,
}

fn ask(folder: &Path, case: &Case, who: Asked) -> Option<Answer> {
    let oracle = who == Asked::Control;
    // rs274 keeps parameters in the folder that it runs in
    for entry in std::fs::read_dir(folder).ok()?.flatten() {
        std::fs::remove_file(entry.path()).ok();
    }
    std::fs::write(folder.join("p.ngc"), &case.text).ok()?;
    for (name, text) in &case.files {
        std::fs::write(folder.join(name), text).ok()?;
    }
    let mut command = Command::new("timeout");
    if oracle {
        command.args(["10", "rs274", "-g"]);
    } else {
        command.args(["60", env!("CARGO_BIN_EXE_trunnion"), "canon"]);
        if who == Asked::OursExactly {
            command.arg("--more-decimals=8");
        }
    }
    // rs274 shares its tool table between all runs of a user
    command
        .args(case.arguments(oracle))
        .arg("p.ngc")
        .current_dir(folder)
        .env("HOME", folder);
    let output = command.output().ok()?;
    // a stopped process has not written its parameters
    let ended = output.status.code() != Some(STOPPED);
    let parameters = (ended && case.has(PARAMETERS)).then(|| std::fs::read_to_string(folder.join(PARAMETERS)));
    let parameters = parameters.and_then(Result::ok);
    Some(answer(&output, parameters.as_deref()))
}

/// How two answers compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Same,
    Explained(&'static str),
    Different,
}

fn verdict(folder: &Path, case: &Case, [control, ours]: [Answer; 2]) -> Verdict {
    if control == ours {
        return Verdict::Same;
    }
    let exact = ask(folder, case, Asked::OursExactly).expect("it ran before");
    let ours = explained::Ours { answer: ours, exact };
    explained::EXPLAINED
        .iter()
        .find(|explanation| (explanation.holds)(&control, &ours))
        .map_or(Verdict::Different, |explanation| Verdict::Explained(explanation.why))
}

/// The answers of `rs274` and of `trunnion canon`.
fn both(folder: &Path, case: &Case) -> [Answer; 2] {
    [Asked::Control, Asked::Ours].map(|who| ask(folder, case, who).expect("both interpreters run"))
}

/// What sort of difference it is: the errors without their numbers.
fn sort(folder: &Path, case: &Case, left: &mut u32) -> Option<[String; 2]> {
    let [control, ours] = both(folder, case);
    let hangs = control.hangs || ours.hangs;
    *left = left.saturating_sub(if hangs { HANGS_COST } else { 1 });
    if verdict(folder, case, [control.clone(), ours.clone()]) != Verdict::Different {
        return None;
    }
    let first = |answer: &Answer| -> String {
        let line = answer.error.lines().next().unwrap_or_default();
        line.chars().filter(|sign| !sign.is_ascii_digit()).collect()
    };
    Some([first(&control), first(&ours)])
}

/// Programs that are run to make one shorter; one in which an interpreter hangs until it is stopped counts as many.
const ATTEMPTS: u32 = 400;
const HANGS_COST: u32 = 100;

/// The program without every line that plays no part in the difference, as far as so many attempts lead.
fn shrink(folder: &Path, case: &Case) -> Case {
    let mut left = ATTEMPTS;
    let wanted = sort(folder, case, &mut left);
    let mut case = case.clone();
    let mut lines: Vec<String> = case.text.lines().map(str::to_owned).collect();
    let mut step = lines.len() / 2;
    while step > 0 {
        let mut at = 0;
        while at < lines.len() && left > 0 {
            let mut fewer = lines.clone();
            fewer.drain(at..(at + step).min(lines.len()));
            case.text = fewer.join("\n") + "\n";
            if sort(folder, &case, &mut left) == wanted {
                lines = fewer;
            } else {
                at += step;
            }
        }
        step /= 2;
    }
    case.text = lines.join("\n") + "\n";
    case
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
    let most = number("TRUNNION_DIFFERENTIAL_MOST", 8) as usize;
    let next = AtomicU64::new(first);
    let differences = Mutex::new(Vec::new());
    let explained = Mutex::new(BTreeMap::<&str, u64>::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                let folder = tempfile::tempdir().expect("a temporary folder");
                let folder = folder.path();
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed >= first + count || differences.lock().expect("no thread has failed").len() >= most {
                        return;
                    }
                    let case = generate::program(seed);
                    match verdict(folder, &case, both(folder, &case)) {
                        Verdict::Same => {}
                        Verdict::Explained(why) => {
                            *explained.lock().expect("no thread has failed").entry(why).or_default() += 1;
                        }
                        Verdict::Different => {
                            let report = report(folder, seed, &case);
                            println!("{report}\n");
                            differences.lock().expect("no thread has failed").push(report);
                        }
                    }
                }
            });
        }
    });
    for (why, count) in explained.into_inner().expect("no thread has failed") {
        println!("{count} programs: {why}");
    }
    let differences = differences.into_inner().expect("no thread has failed");
    assert!(differences.is_empty(), "{} differences (told above)", differences.len());
    println!("{count} programs agree with rs274");
}

/// The shortest program that differs, what belongs to it, and where the answers part.
fn report(folder: &Path, seed: u64, case: &Case) -> String {
    let short = shrink(folder, case);
    let [control, ours] = both(folder, &short);
    let mut text = format!("seed {seed} {:?}:\n{}", short.arguments(true), short.text);
    for (name, content) in &short.files {
        let shown: Vec<&str> = content.lines().filter(|line| !line.ends_with("\t0.000000")).collect();
        _ = write!(text, "--- {name}\n{}\n", shown.join("\n"));
    }
    let mut pairs = 0;
    let blank = String::new();
    for place in 0..control.calls.len().max(ours.calls.len()) {
        let [a, b] = [&control.calls, &ours.calls].map(|calls| calls.get(place).unwrap_or(&blank));
        if a != b && pairs < 6 {
            pairs += 1;
            _ = write!(text, "rs274    {a}\ntrunnion {b}\n");
        }
    }
    if control.error != ours.error {
        _ = write!(text, "rs274    {}\ntrunnion {}\n", control.error, ours.error);
    }
    text
}
