//! `cargo bench --bench five_axis`: parse and full check of one million five-axis blocks on one core, stage by stage, beside a plain
//! newline count and LinuxCNC's `rs274 -g` (where it is installed) on the same file, then on two threads, with peak memory. Times are
//! processor time, the least of some runs, but those of one and two threads, which are compared by the time that passes; ratios are of
//! this run; nothing is asserted.
//!
//! The program is a serpentine over a bumpy surface with the tool axis on its normal, as rotary words A (tilt about X)
//! and C (about Z): `G1 X Y Z A C` on each line, with a real singularity where the surface is level.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]
use std::{env, fmt::Write, fs, hint::black_box, process::Command};
use trunnion::{
    check::{Settings, check_on},
    dialect::builtin,
    interp::{Fault, ModalState, Motion, Setup, Sink, run},
    machine::{self, Follower, Machine},
    syntax::{Program, parse, parse_on},
};

#[path = "support/cpu.rs"]
mod cpu;

const BLOCKS: usize = 1_000_000;
const RUNS: usize = 5;

fn main() {
    if let Some(path) = env::var_os("TRUNNION_BENCH_MEMORY_OF") {
        return memory_child(&path);
    }
    let path = env::temp_dir().join(format!("trunnion-five-axis-{}.ngc", std::process::id()));
    let text = five_axis(BLOCKS).into_bytes();
    fs::write(&path, &text).expect("the temporary folder is writable");
    let megabytes = text.len() as f64 / 1e6;
    println!("five-axis program: {BLOCKS} blocks, {megabytes:.1} MB; best of {RUNS} runs, one core\n");
    println!(
        "{:34} {:>9} {:>12} {:>9} {:>14}",
        "stage (each with those above)", "us/block", "blocks/s", "MB/s", "x newline count"
    );
    // the clock of processor time ticks: one count alone is too short for it
    let newline = time(|| {
        (0..50)
            .map(|_| memchr::memchr_iter(b'\n', black_box(&text)).count())
            .sum::<usize>()
    }) / 50.0;
    line("newline count (memchr)", newline, newline, megabytes);
    let dialect = builtin("linuxcnc").expect("built in");
    let machine = machine::builtin("mikron-ucp710").expect("built in");
    line(
        "parse into the stored table",
        time(|| parse(text.clone(), dialect.lex)),
        newline,
        megabytes,
    );
    let setup = Setup::default();
    let program = parse(text.clone(), dialect.lex);
    let folded = time(|| run(&program, dialect, &setup, &mut Nothing));
    let parsed = time(|| parse(text.clone(), dialect.lex));
    line("+ fold into motions", parsed + folded, newline, megabytes);
    let followed = time(|| follow(&program, machine));
    line("+ follow the machine", parsed + followed, newline, megabytes);
    let settings = Settings::new(dialect, Some(machine), Setup::default());
    let full = time(|| check_on(&parse(text.clone(), dialect.lex), &settings, 1));
    line("parse and full check", full, newline, megabytes);
    let report = check_on(&program, &settings, 1);
    stages(&[
        ("parse", parsed),
        ("fold", folded),
        ("follow", followed - folded),
        ("bounds and rules", full - parsed - followed),
    ]);
    match cpu::rs274(&path, 2) {
        Some(oracle) => println!(
            "\nrs274 -g, which folds and prints: {:.3} us/block; parse and fold take {:.3} of its time, the full check {:.3}",
            oracle / BLOCKS as f64 * 1e6,
            (parsed + folded) / oracle,
            full / oracle
        ),
        None => println!("\nrs274 is not installed: no ratio to it"),
    }
    threads(&text, &settings, &format!("{report:?}"));
    println!(
        "\nfindings: {} in {} motions",
        report.diagnostics.len(),
        report.summary.motions
    );
    drop((program, text));
    let child = Command::new(env::current_exe().expect("this program"))
        .env("TRUNNION_BENCH_MEMORY_OF", &path)
        .output()
        .expect("this program starts again");
    print!("{}", String::from_utf8_lossy(&child.stdout));
    fs::remove_file(&path).ok();
}

/// The time that passes with one thread and with two, and whether both find the same.
fn threads(text: &[u8], settings: &Settings<'_>, report: &str) {
    let lex = settings.dialect.lex;
    let [one, two] = [1, 2].map(|threads| {
        cpu::passed(RUNS, || {
            check_on(&parse_on(text.to_vec(), lex, threads), settings, threads)
        })
    });
    let same = report == format!("{:?}", check_on(&parse_on(text.to_vec(), lex, 2), settings, 2));
    println!(
        "\ntime that passes: one thread {:.3} us/block, two threads {:.3} ({:.0} blocks/s, {:.2} x); the reports are {}",
        one / BLOCKS as f64 * 1e6,
        two / BLOCKS as f64 * 1e6,
        BLOCKS as f64 / two,
        one / two,
        if same { "the same" } else { "DIFFERENT" }
    );
}

/// Reads, parses and checks the file once, and prints the peak memory of this process (Linux).
fn memory_child(path: &std::ffi::OsStr) {
    let text = fs::read(path).expect("written by the parent");
    let size = text.len() as f64;
    let dialect = builtin("linuxcnc").expect("built in");
    let machine = machine::builtin("mikron-ucp710").expect("built in");
    let settings = Settings::new(dialect, Some(machine), Setup::default());
    black_box(check_on(&parse_on(text, dialect.lex, 2), &settings, 2));
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status
        .lines()
        .find_map(|l| l.strip_prefix("VmHWM:"))
        .and_then(|v| v.trim().strip_suffix(" kB"));
    match peak.and_then(|kb| kb.trim().parse::<f64>().ok()) {
        Some(kb) => {
            let bytes = kb * 1024.0;
            println!(
                "peak memory of reading, parsing and checking: {:.1} MB, {:.2} x the file (limit 8 x)",
                bytes / 1e6,
                bytes / size
            );
        }
        None => println!("peak memory: not known on this system"),
    }
}

fn time<T>(work: impl FnMut() -> T) -> f64 {
    cpu::best(RUNS, work)
}

/// Each stage alone, with its share of the full check.
fn stages(stages: &[(&str, f64)]) {
    let whole: f64 = stages.iter().map(|(_, seconds)| seconds).sum();
    println!();
    for (name, seconds) in stages {
        println!(
            "{name:34} {:>9.3} us/block alone {:>6.1} %",
            seconds / BLOCKS as f64 * 1e6,
            100.0 * seconds / whole
        );
    }
}

fn line(name: &str, seconds: f64, newline: f64, megabytes: f64) {
    let per_block = seconds / BLOCKS as f64;
    println!(
        "{name:34} {:>9.3} {:>12.0} {:>9.0} {:>14.0}",
        per_block * 1e6,
        1.0 / per_block,
        megabytes / seconds,
        seconds / newline
    );
}

struct Nothing;

impl Sink for Nothing {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        black_box(motion);
    }
    fn fault(&mut self, _fault: Fault) {}
}

struct Follow<'m>(Follower<'m>);

impl Sink for Follow<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        black_box(self.0.follow(motion));
    }
    fn fault(&mut self, _fault: Fault) {}
}

fn follow(program: &Program, machine: &Machine) {
    let dialect = builtin("linuxcnc").expect("built in");
    run(program, dialect, &Setup::default(), &mut Follow(Follower::new(machine)));
}

/// The program's text.
fn five_axis(blocks: usize) -> String {
    use trunnion::geometry::math::{atan2, cos, sin};
    let mut out =
        String::from("%\n(5-AXIS)\nG21 G90 G17 G40 G80\nT1 M6\nS12000 M3\nG54\nG0 X0 Y0 Z50 A0 C0\nG1 Z10 F2000\n");
    let (row, step) = (2000, 0.05);
    let mut previous = 0.0_f64;
    for i in 0..blocks {
        let (line, k) = (i / row, i % row);
        let x = if line % 2 == 0 { k } else { row - 1 - k } as f64 * step;
        let y = line as f64 * 0.2;
        let z = 5.0 * sin(x / 17.0) * cos(y / 13.0);
        let zx = 5.0 / 17.0 * cos(x / 17.0) * cos(y / 13.0);
        let zy = -5.0 / 13.0 * sin(x / 17.0) * sin(y / 13.0);
        let a = atan2(zx.mul_add(zx, zy * zy).sqrt(), 1.0).to_degrees();
        let mut c = atan2(-zx, zy).to_degrees();
        c += 360.0 * ((previous - c) / 360.0).round();
        previous = c;
        write!(out, "G1 X{x:.4} Y{y:.4} Z{z:.4} A{a:.4} C{c:.4}").expect("a String takes all");
        if i % 500 == 0 {
            write!(out, " F{}", 2000 + i % 1500).expect("a String takes all");
        }
        out.push('\n');
    }
    out.push_str("G0 Z50\nM5\nM30\n%\n");
    out
}
