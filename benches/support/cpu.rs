//! Processor time: on a machine that does other work beside, it is what a program took and not what it waited.
use std::{fs, hint::black_box, path::Path, process::Command, sync::OnceLock, thread, time::Instant};

/// Processor seconds that this thread has used; where the system does not tell (other than Linux), seconds that have passed.
fn seconds() -> f64 {
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    // Linux adds to the number at a tick (4 ms) and when a thread gives way: without this, times are multiples of 4 ms
    thread::yield_now();
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(
        || BEGUN.get_or_init(Instant::now).elapsed().as_secs_f64(),
        |nanoseconds| nanoseconds / 1e9,
    )
}

/// The time of one run.
pub(crate) fn once<T>(work: impl FnOnce() -> T) -> f64 {
    let begun = seconds();
    let made = black_box(work());
    let took = seconds() - begun;
    drop(made);
    took
}

/// The least time of some runs.
#[allow(dead_code, reason = "one of the benchmarks takes turns instead")]
pub(crate) fn best<T>(runs: usize, mut work: impl FnMut() -> T) -> f64 {
    (0..runs).map(|_| once(&mut work)).fold(f64::INFINITY, f64::min)
}

/// The least of the times that pass while some runs continue, seconds: what other work takes beside counts, too.
#[allow(dead_code, reason = "one of the benchmarks asks for it")]
pub(crate) fn passed<T>(runs: usize, mut work: impl FnMut() -> T) -> f64 {
    (0..runs)
        .map(|_| {
            let begun = Instant::now();
            let made = black_box(work());
            let took = begun.elapsed().as_secs_f64();
            drop(made);
            took
        })
        .fold(f64::INFINITY, f64::min)
}

/// Processor seconds of `rs274 -g` on a file, the least of some runs, each under a limit of 120 s; `None` where it is not installed or
/// refuses the program.
#[allow(dead_code, reason = "some benchmarks ask for it")]
pub(crate) fn rs274(path: &Path, runs: usize) -> Option<f64> {
    let home = std::env::temp_dir().join(format!("trunnion-rs274-{}", std::process::id()));
    fs::create_dir_all(&home).ok()?;
    let run = || {
        let out = Command::new("sh")
            .args([
                "-c",
                "timeout 120 rs274 -g \"$0\" >/dev/null 2>&1 </dev/null || exit 1; times",
            ])
            .arg(path)
            .env("HOME", &home)
            .current_dir(&home)
            .output()
            .ok()
            .filter(|out| out.status.success())?;
        // the second line gives the children: user and system, `0m4.21s 0m0.10s`
        let text = String::from_utf8(out.stdout).ok()?;
        text.lines().nth(1)?.split_whitespace().map(clock).sum::<Option<f64>>()
    };
    let least = (0..runs)
        .map(|_| run())
        .try_fold(f64::INFINITY, |least, took| Some(least.min(took?)));
    fs::remove_dir_all(&home).ok();
    least
}

/// `1m4.21s` in seconds.
#[allow(dead_code, reason = "some benchmarks ask for it")]
fn clock(text: &str) -> Option<f64> {
    let (minutes, seconds) = text.strip_suffix('s')?.split_once('m')?;
    Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
}
