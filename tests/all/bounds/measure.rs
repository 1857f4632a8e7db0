//! Runs a command and measures it.
use memchr::memmem;
use std::{
    fs::File,
    io::{Read, Seek, Write},
    os::unix::fs::FileExt,
    path::Path,
    process::{ChildStdin, Command, Stdio},
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    time::{Duration, Instant},
};

/// Clock ticks of a second in `/proc/PID/stat`: Linux shows a hundred on every architecture.
const TICKS: f64 = 100.0;

/// A run that has not ended after this, on whatever loaded computer, waits for something that never comes.
const ABANDONED: Duration = Duration::from_hours(1);

/// A part of what is said to a run on its standard input.
pub(crate) struct Part {
    pub(crate) bytes: Vec<u8>,
    /// The request in it, whose answer must arrive before the next part is sent: a server that has received `exit` answers nothing more.
    pub(crate) request: Option<u64>,
}

/// What a run did.
pub(crate) struct Measured {
    /// Its exit status; `None` after a signal.
    pub(crate) status: Option<i32>,
    /// Processor time, as far as the system shows it (Linux), else the time that passed; of a session with the server, the most that one request
    /// takes with the notifications before it.
    pub(crate) seconds: f64,
    /// The most memory that it held at once, as far as the system shows it (Linux).
    pub(crate) bytes: u64,
    /// What it said on standard error, its last part.
    pub(crate) said: String,
    output: File,
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

/// Says all parts. The run may end without reading them.
fn say(mut pipe: ChildStdin, parts: Vec<Part>, output: &File, ended: &AtomicBool, answered: &AtomicUsize) {
    let mut seen = 0;
    for part in parts {
        if pipe.write_all(&part.bytes).is_err() {
            return;
        }
        let Some(request) = part.request else { continue };
        let answer = format!("\"id\":{request}}}");
        while !ended.load(Ordering::Relaxed) && !answers(output, &mut seen, answer.as_bytes()) {
            std::thread::sleep(Duration::from_millis(2));
        }
        answered.fetch_add(1, Ordering::Relaxed);
    }
}

/// Whether a text was printed behind a place, which moves on.
fn answers(output: &File, seen: &mut u64, text: &[u8]) -> bool {
    let mut buffer = vec![0; 1 << 16];
    loop {
        let length = output.read_at(&mut buffer, *seen).unwrap_or(0);
        let read = &buffer[..length];
        if let Some(at) = memmem::find(read, text) {
            *seen += (at + text.len()) as u64;
            return true;
        }
        if length < buffer.len() {
            // the beginning of the text may be there already
            *seen += length.saturating_sub(text.len()) as u64;
            return false;
        }
        *seen += (length - text.len()) as u64;
    }
}

/// Runs in `folder` with `input` on standard input; ended by force after `patience` of processor time, or an hour.
pub(crate) fn run(folder: &Path, arguments: &[String], input: Vec<Part>, patience: Duration) -> Measured {
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
    let pipe = child.stdin.take().expect("piped");
    let printed = output.try_clone().expect("a handle");
    let ended = Arc::new(AtomicBool::new(false));
    let answered = Arc::new(AtomicUsize::new(0));
    let (over, answers) = (Arc::clone(&ended), Arc::clone(&answered));
    let writer = std::thread::spawn(move || say(pipe, input, &printed, &over, &answers));
    let process = format!("/proc/{}", child.id());
    let (mut ticks, mut bytes) = (None, 0);
    let mut pause = Duration::from_millis(1);
    // of the request that is not answered: its number, when it came, what those before it took at most
    let (mut request, mut since, mut longest) = (0, 0.0, 0.0_f64);
    let status = loop {
        // asked before it is waited for: an ended process shows its time until then
        bytes = held(&process).unwrap_or(0).max(bytes);
        ticks = used(&process).or(ticks);
        let passed = ticks.map_or_else(|| begun.elapsed().as_secs_f64(), |ticks| ticks as f64 / TICKS);
        let taken = passed - since;
        longest = longest.max(taken);
        if let Some(status) = child.try_wait().expect("waited for") {
            break status.code();
        }
        let now = answered.load(Ordering::Relaxed);
        if now != request {
            (request, since) = (now, passed);
            continue;
        }
        if taken > patience.as_secs_f64() || begun.elapsed() > ABANDONED {
            child.kill().expect("killed");
            child.wait().expect("ended");
            break None;
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(10));
    };
    ended.store(true, Ordering::Relaxed);
    writer.join().expect("no panic");
    let mut said = Vec::new();
    let length = errors.stream_position().unwrap_or(0);
    let _ = errors.seek(std::io::SeekFrom::Start(length.saturating_sub(600)));
    let _ = errors.read_to_end(&mut said);
    let _ = output.rewind();
    Measured {
        status,
        seconds: longest,
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
