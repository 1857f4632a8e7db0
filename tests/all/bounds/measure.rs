//! Runs a command and measures it.
use std::{
    io::{Read, Seek, Write},
    path::Path,
    process::{Command, Stdio},
    time::{Duration, Instant},
};

/// Clock ticks of a second in `/proc/PID/stat`: Linux shows a hundred on every architecture.
const TICKS: f64 = 100.0;

/// A run that has not ended after this, on whatever loaded computer, waits for something that never comes.
const ABANDONED: Duration = Duration::from_hours(1);

/// What a run did.
pub(crate) struct Measured {
    /// Its exit status; `None` after a signal.
    pub(crate) status: Option<i32>,
    /// Processor time, as far as the system shows it (Linux), else the time that passed.
    pub(crate) seconds: f64,
    /// The most memory that it held at once, as far as the system shows it (Linux).
    pub(crate) bytes: u64,
    /// What it said on standard error, its last part.
    pub(crate) said: String,
    output: std::fs::File,
}

impl Measured {
    /// How much it printed on standard output, bytes.
    pub(crate) fn printed(&self) -> u64 {
        self.output.metadata().map_or(0, |metadata| metadata.len())
    }

    /// Whether standard output is one JSON document.
    pub(crate) fn is_json(&self) -> bool {
        let mut file = &self.output;
        let whole = std::io::BufReader::new(&mut file);
        serde_json::from_reader::<_, serde::de::IgnoredAny>(whole).is_ok()
    }
}

/// The program under test.
fn program() -> String {
    std::env::var("TRUNNION_BINARY").unwrap_or_else(|_| env!("CARGO_BIN_EXE_trunnion").to_owned())
}

/// Runs in `folder` with `input` on standard input; ended by force after `patience` of processor time, or an hour.
pub(crate) fn run(folder: &Path, arguments: &[String], input: Vec<u8>, patience: Duration) -> Measured {
    let mut output = tempfile::tempfile().expect("a file");
    let mut errors = tempfile::tempfile().expect("a file");
    let begun = Instant::now();
    let mut child = Command::new(program())
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(output.try_clone().expect("a handle"))
        .stderr(errors.try_clone().expect("a handle"))
        .spawn()
        .expect("runs");
    let mut pipe = child.stdin.take().expect("piped");
    // it may end without reading it
    let writer = std::thread::spawn(move || drop(pipe.write_all(&input)));
    let process = format!("/proc/{}", child.id());
    let (mut ticks, mut bytes) = (None, 0);
    let mut pause = Duration::from_millis(1);
    let status = loop {
        // asked before it is waited for: an ended process shows its time until then
        bytes = held(&process).unwrap_or(0).max(bytes);
        ticks = used(&process).or(ticks);
        if let Some(status) = child.try_wait().expect("waited for") {
            break status.code();
        }
        let taken = ticks.map_or_else(|| begun.elapsed().as_secs_f64(), |ticks| ticks as f64 / TICKS);
        if taken > patience.as_secs_f64() || begun.elapsed() > ABANDONED {
            child.kill().expect("killed");
            child.wait().expect("ended");
            break None;
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(10));
    };
    writer.join().expect("no panic");
    let mut said = Vec::new();
    let length = errors.stream_position().unwrap_or(0);
    let _ = errors.seek(std::io::SeekFrom::Start(length.saturating_sub(600)));
    let _ = errors.read_to_end(&mut said);
    let _ = output.rewind();
    Measured {
        status,
        seconds: ticks.map_or_else(|| begun.elapsed().as_secs_f64(), |ticks| ticks as f64 / TICKS),
        bytes,
        said: String::from_utf8_lossy(&said).into_owned(),
        output,
    }
}

/// Peak of the memory in use, bytes.
fn held(process: &str) -> Option<u64> {
    let status = std::fs::read_to_string(format!("{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kilobytes * 1024)
}

/// Processor time so far, ticks.
fn used(process: &str) -> Option<u64> {
    let stat = std::fs::read_to_string(format!("{process}/stat")).ok()?;
    // the name in parentheses may hold spaces; user and system time are the fields 14 and 15
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_ascii_whitespace().collect();
    Some(fields.get(11)?.parse::<u64>().ok()? + fields.get(12)?.parse::<u64>().ok()?)
}
