//! `cargo bench --bench rewrites`: smooth-pole and switch-angles with their proofs, in points per second, beside a plain pass (parse, run,
//! follow the machine) over the same points, for programs of three lengths and two densities of flips. Times are processor time, the least of
//! some runs; nothing is asserted.
//!
//! The program is a zigzag over a flat dome with the tool axis on its normal, as rotary words A and C under tool centre point control: every
//! line passes the pole at some distance.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]
use std::fmt::Write;
use trunnion::check::Settings;
use trunnion::dialect::builtin;
use trunnion::geometry::math::{atan2, hypot, sin};
use trunnion::interp::{Setup, Tool, ToolShape};
use trunnion::machine;
use trunnion::rewrite::{Options, attempt, rewrite};
use trunnion::syntax::parse;

#[path = "support/cpu.rs"]
mod cpu;
#[path = "support/plain_pass.rs"]
mod plain_pass;

const RUNS: usize = 3;

fn main() {
    let dialect = builtin("sinumerik-840d").expect("built in");
    let machine = machine::builtin("mikron-ucp710").expect("built in");
    let setup = Setup {
        tools: vec![Tool {
            number: 0,
            shape: Some(ToolShape::Ball),
            diameter_mm: Some(10.0),
            length_mm: Some(100.0),
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let settings = Settings::new(dialect, Some(machine), setup);
    println!(
        "{:14} {:>8} {:>8} {:>12} {:>10} {:>9}  outcome",
        "rewrite", "points", "flips", "points/s", "us/point", "x plain"
    );
    for (points, line) in [(20_000, 200), (80_000, 200), (200_000, 200), (80_000, 50)] {
        let text = zigzag(points, line, false).into_bytes();
        let plain = cpu::best(RUNS, || {
            plain_pass::follow(&parse(text.clone(), dialect.lex), &settings, machine);
        });
        print_row("plain pass", (points, points / line), plain, plain, "");
        for (name, text) in [
            ("smooth-pole", text),
            ("switch-angles", zigzag(points, line, true).into_bytes()),
        ] {
            let program = parse(text, dialect.lex);
            let one = rewrite(name).expect("a rewrite of that name");
            let mut outcome = String::new();
            let seconds = cpu::best(RUNS, || {
                outcome = match attempt(one, &program, &settings, &Options::default()).outcome() {
                    Ok(Some(proved)) => proved.summary,
                    Ok(None) => "nothing to do".into(),
                    Err(reason) => reason,
                };
            });
            print_row(name, (points, points / line), seconds, plain, &outcome);
        }
    }
}

fn print_row(name: &str, (points, flips): (usize, usize), seconds: f64, plain: f64, outcome: &str) {
    let per_point = seconds / points as f64;
    println!(
        "{name:14} {points:>8} {flips:>8} {:>12.0} {:>10.3} {:>9.1}  {}",
        1.0 / per_point,
        per_point * 1e6,
        seconds / plain,
        outcome.chars().take(100).collect::<String>()
    );
}

/// The program's text: lines of `line` points. `turned`: each line begins with a rapid, and every other one has C a whole turn on.
fn zigzag(points: usize, line: usize, turned: bool) -> String {
    let mut out = String::from("T1 M6\nD1\nTRAORI\nS8000 M3\nG0 X-20 Y-1 Z60 A6 C0\nG1 Z50 F2000\n");
    let mut last = 0.0f64;
    for at in 0..points {
        let (row, place) = (at / line, at % line);
        let share = place as f64 / (line - 1) as f64 * 2.0 - 1.0;
        let along = if row % 2 == 0 { share } else { -share };
        // normals of a dome, with a ripple; 5.7 deg at the ends of the lines, 0.3 to 1.2 deg at the nearest
        let (i, j) = (
            0.1 * along,
            0.005 + 0.015 * sin(row as f64 * 0.37).abs() + 0.0004 * sin(at as f64 * 1.7),
        );
        let tilt = atan2(hypot(i, j), (1.0 - i * i - j * j).sqrt()).to_degrees();
        let azimuth = atan2(i, -j).to_degrees();
        last = azimuth + 360.0 * ((last - azimuth) / 360.0).round();
        let c = last + if turned && row % 2 == 1 { 360.0 } else { 0.0 };
        let code = match place {
            0 if turned => "G0 ",
            1 if turned => "G1 ",
            _ => "",
        };
        let (x, y) = (20.0 * along, row as f64 * 0.01);
        let _ = writeln!(
            out,
            "{code}X{x:.4} Y{y:.4} Z{:.4} A{tilt:.4} C{c:.4}",
            50.0 - 0.05 * along * along
        );
    }
    out.push_str("TRAFOOF\nM30\n");
    out
}
