//! `cargo bench --bench fitting`: `fit-arcs` with its proof, in lines per second, beside a plain pass (parse, run, follow the machine) over the
//! same lines, at four tolerances; with the arcs found. Times are processor time, the least of some runs; nothing is asserted.
//!
//! The program has a thousand arcs of 2 to 50 mm radius and a thousand ellipses as lines of at most 0.004 mm sag and 200 to an ellipse, numbers in
//! 4 digits. `cargo bench --bench fitting -- FILE` takes a program of LinuxCNC instead.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]
use std::fmt::Write;
use trunnion::check::Settings;
use trunnion::dialect::builtin;
use trunnion::geometry::math::{acos, sin_cos};
use trunnion::interp::Setup;
use trunnion::machine;
use trunnion::rewrite::{Options, attempt, rewrite};
use trunnion::syntax::parse;

#[path = "support/cpu.rs"]
#[allow(dead_code, reason = "it also times other programs")]
mod cpu;
#[path = "support/plain_pass.rs"]
mod plain_pass;

const RUNS: usize = 3;

fn main() {
    let dialect = builtin("linuxcnc").expect("built in");
    let machine = machine::builtin("mill-3axis").expect("built in");
    let settings = Settings::new(dialect, Some(machine), Setup::default());
    let file = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let text = file.map_or_else(curves, |file| std::fs::read(file).expect("a file"));
    let lines = parse(text.clone(), dialect.lex).block_count();
    let plain = cpu::best(RUNS, || {
        plain_pass::follow(&parse(text.clone(), dialect.lex), &settings, machine);
    });
    println!(
        "{lines} lines; a plain pass takes {:.2} us a line",
        plain / lines as f64 * 1e6
    );
    println!(
        "{:>9} {:>8} {:>8} {:>10} {:>8} {:>8}  outcome",
        "mm", "arcs", "blocks", "lines/s", "us/line", "x plain"
    );
    let one = rewrite("fit-arcs").expect("a rewrite of that name");
    for tolerance_mm in [0.05, 0.025, 0.01, 0.005] {
        let program = parse(text.clone(), dialect.lex);
        let options = Options {
            tolerance_mm,
            ..Options::default()
        };
        let (mut outcome, mut after) = (String::new(), Vec::new());
        let seconds = cpu::best(RUNS, || match attempt(one, &program, &settings, &options).outcome() {
            Ok(Some(proved)) => (outcome, after) = (proved.summary, proved.after),
            Ok(None) => outcome = "nothing to do".into(),
            Err(reason) => outcome = reason,
        });
        let per_line = seconds / lines as f64;
        let text = String::from_utf8_lossy(&after);
        println!(
            "{tolerance_mm:>9} {:>8} {:>8} {:>10.0} {:>8.2} {:>8.1}  {}",
            text.lines()
                .filter(|line| line.contains("G2 ") || line.contains("G3 "))
                .count(),
            text.lines()
                .filter(|line| line.contains('X') && !line.starts_with("G0"))
                .count(),
            1.0 / per_line,
            per_line * 1e6,
            seconds / plain,
            outcome
        );
    }
}

/// Numbers between 0 and 1, always the same (a linear congruence).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn curves() -> Vec<u8> {
    let mut random = Random(7);
    let mut out = String::from("G21 G90 G17 G54\nG1 Z0.2 F1200\n");
    let turn = core::f64::consts::TAU;
    for _ in 0..1000 {
        let radius = 2.0 + 48.0 * random.next();
        let (x, y) = (200.0 * random.next(), 200.0 * random.next());
        let begin = turn * random.next();
        let sweep = (0.5 + 5.5 * random.next()) * if random.next() < 0.5 { 1.0 } else { -1.0 };
        let count = (sweep.abs() / (2.0 * acos(1.0 - 0.004 / radius))) as usize + 1;
        curve(&mut out, count.max(8), |share| {
            let (sin, cos) = sin_cos(begin + sweep * share);
            [x + radius * cos, y + radius * sin]
        });
        let (long, short) = (3.0 + 20.0 * random.next(), 2.0 + 10.0 * random.next());
        curve(&mut out, 200, |share| {
            let (sin, cos) = sin_cos(turn * share);
            [x + long * cos, y + short * sin]
        });
    }
    out.push_str("M2\n");
    out.into_bytes()
}

fn curve(out: &mut String, count: usize, point: impl Fn(f64) -> [f64; 2]) {
    for index in 0..=count {
        let [x, y] = point(index as f64 / count as f64);
        let _ = match index {
            0 => writeln!(out, "G0 X{x:.4} Y{y:.4}\nG1 F1800"),
            _ => writeln!(out, "G1 X{x:.4} Y{y:.4}"),
        };
    }
}
