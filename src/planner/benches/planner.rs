//! `cargo bench -p trunnion-planner --bench planner`: motions per second through the planner on one core, for straight blocks on three axes and for five-axis blocks with a
//! guided tip. The legs are computed before and stay in the cache, as a leg does that was just computed; times are processor time, the least of some runs. Target: one million blocks per second.
//! Memory: the peak of the process for a quarter of a run and for the whole, without a stop in it.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]
use std::{fmt::Write, hint::black_box};
use trunnion_dialect::builtin;
use trunnion_geometry::math::{cos, sin};
use trunnion_interp::{Fault, ModalState, Motion, Setup, Sink, run};
use trunnion_machine::{self as machine, Follower, Leg};
use trunnion_planner::{PathControl, Planner};
use trunnion_syntax::parse;

#[path = "../../../benches/support/cpu.rs"]
mod cpu;

const LEGS: usize = 1_000;
const ROUNDS: usize = 1_000;
const RUNS: usize = 3;
/// Blocks per second.
const TARGET: f64 = 1e6;

struct Keep<'m> {
    follower: Follower<'m>,
    legs: Vec<Leg>,
}

impl Sink for Keep<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        self.legs.push(leg);
    }
    fn fault(&mut self, _: Fault) {}
}

/// Peak memory of the process, bytes; 0 where the system does not tell.
fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let row = status.lines().find_map(|row| row.strip_prefix("VmHWM:"));
    row.and_then(|row| row.split_whitespace().next()?.parse::<f64>().ok())
        .map_or(0.0, |kilobytes| kilobytes * 1024.0)
}

/// What a run of legs without a stop takes: a quarter, then all. The peak never falls, so it is printed once per program, and grows.
fn memory(machine: &machine::Machine, rotary_feed: trunnion_dialect::RotaryFeed, legs: &[Leg]) -> String {
    let peaks = [ROUNDS / 4, ROUNDS].map(|rounds| {
        // straight on: nothing stops between two rounds
        let mut planner = Planner::new(machine, rotary_feed);
        let before = peak();
        for leg in legs.iter().skip(1).cycle().take(rounds * legs.len()) {
            planner.leg(black_box(leg), PathControl::ByMachine, &mut |timed| {
                _ = black_box(timed);
            });
        }
        planner.finish(&mut |timed| {
            _ = black_box(timed);
        });
        (peak() - before) / (rounds * legs.len()) as f64
    });
    format!(
        "peak {:.0} and {:.0} bytes for each block of a quarter and of all",
        peaks[0], peaks[1]
    )
}

fn main() {
    println!("{LEGS} legs, {ROUNDS} times, best of {RUNS} runs, one core\n");
    println!(
        "{:34} {:>12} {:>14} {:>10} {:>16}",
        "program", "us/block", "blocks/s", "of target", "planned, s"
    );
    let mut lines = "G21 G90 G17\nG0 X0 Y0 Z0\nG1 F3000\n".to_owned();
    let mut turning = "TRAORI\nG0 X0 Y0 Z50 A10 C0\nG1 F3000\n".to_owned();
    for k in 0..LEGS {
        let t = k as f64 * 0.01;
        let _ = writeln!(
            lines,
            "G1 X{:.4} Y{:.4} Z{:.4}",
            50.0 * sin(t),
            50.0 * cos(t),
            0.001 * t
        );
        let _ = writeln!(
            turning,
            "G1 X{:.4} Y{:.4} Z50 A{:.4} C{:.4}",
            50.0 * sin(t),
            50.0 * cos(t),
            20.0 + sin(t),
            10.0 * t
        );
    }
    measure("lines, three axes", "linuxcnc", "mill-3axis", &lines);
    measure("guided tip, five axes", "sinumerik-840d", "mikron-ucp710", &turning);
}

fn measure(name: &str, dialect: &str, machine: &str, text: &str) {
    let dialect = builtin(dialect).expect("there");
    let machine = machine::builtin(machine).expect("there");
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    let mut keep = Keep {
        follower: Follower::new(machine),
        legs: Vec::new(),
    };
    run(&program, dialect, &Setup::default(), &mut keep);
    let legs = keep.legs;
    // before the peak of the other runs hides it
    let memory = memory(machine, dialect.advice.rotary_feed, &legs);
    let mut total = 0.0;
    let best = cpu::best(RUNS, || {
        let mut planner = Planner::new(machine, dialect.advice.rotary_feed);
        total = 0.0;
        let mut add = |timed: trunnion_planner::Timed| total += timed.seconds[1].unwrap_or(0.0);
        for _ in 0..ROUNDS {
            for leg in &legs {
                planner.leg(black_box(leg), PathControl::ByMachine, &mut add);
            }
        }
        planner.finish(&mut add);
    });
    let count = (legs.len() * ROUNDS) as f64;
    println!(
        "{name:34} {:>12.3} {:>14.0} {:>10.2} {total:>16.1}",
        best / count * 1e6,
        count / best,
        count / best / TARGET
    );
    println!("{:34} {memory}", "");
}
