//! smooth-pole over the layers of two printed parts (BSD-3 data): steps of C above 45 deg and travel, as a program that shares nothing with
//! this one computed them.
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
use super::strategy_2::ball;
use std::fmt::Write;
use std::path::Path;
use trunnion::check::Settings;
use trunnion::geometry::{deg, math, rad};
use trunnion::machine::{self, Machine};
use trunnion::rewrite::{Options, attempt, rewrite};
use trunnion::{dialect, syntax};

/// How the feed is given.
#[derive(Clone, Copy, PartialEq)]
enum Feed {
    /// Per minute: the slope is per mm.
    PerMinute,
    /// G93 with the same time for every block: the slope is the step.
    SameTimes,
}

/// A program with tool centre point control through the points of one layer: A from 0 to 180 deg, C nearest to the value before.
fn layer(path: &Path, feed: Feed) -> String {
    let mut text = String::from("T1 M6\nTRAORI\nS8000 M3\n");
    let each = if feed == Feed::SameTimes { " F1000" } else { "" };
    text.push_str(if feed == Feed::SameTimes { "G93\n" } else { "F2000\n" });
    let mut c = 0.0f64;
    for row in std::fs::read_to_string(path).expect("readable").lines() {
        let numbers: Vec<f64> = row
            .split_whitespace()
            .map(|number| number.parse().expect("a number"))
            .collect();
        let [x, y, z, i, j, k] = numbers[..] else {
            panic!("{row}")
        };
        let tilt = deg(math::atan2(math::hypot(i, j), k));
        let turn = if i == 0.0 && j == 0.0 {
            c
        } else {
            deg(math::atan2(i, -j))
        };
        c = turn + 360.0 * ((c - turn) / 360.0).round();
        let _ = writeln!(text, "G1 X{x:.5} Y{y:.5} Z{:.5} A{tilt:.6} C{c:.6}{each}", z + 100.0);
    }
    text.push_str("M30\n");
    text
}

/// C of each row, deg.
fn turns(text: &[u8]) -> Vec<f64> {
    let text = String::from_utf8_lossy(text);
    let of = |line: &str| {
        line.split(' ')
            .find_map(|word| word.strip_prefix('C')?.parse::<f64>().ok())
    };
    text.lines().filter_map(of).collect()
}

/// Steps above 45 deg, and travel, deg.
fn counted(text: &[u8]) -> (usize, f64) {
    let c = turns(text);
    let steps = || c.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    (steps().filter(|step| *step > 45.0).count(), steps().sum())
}

fn rewritten(name: &str, text: &[u8], settings: &Settings<'_>, tolerance_deg: f64) -> Vec<u8> {
    let program = syntax::parse(text.to_vec(), settings.dialect.lex);
    let options = Options {
        tolerance_deg,
        ..Options::default()
    };
    let rewrite = rewrite(name).expect("a rewrite of that name");
    match attempt(rewrite, &program, settings, &options).outcome() {
        Ok(Some(proved)) => proved.after,
        Ok(None) => text.to_vec(),
        Err(reason) => panic!("{name} at {tolerance_deg}: {reason}"),
    }
}

fn free_machine() -> Machine {
    let mut machine = machine::builtin("mikron-ucp710").expect("built in").clone();
    let tilt = machine.rotary[1];
    machine.axes[tilt].limits = machine::Limits::Range(rad(-180.0), rad(180.0));
    machine
}

/// Steps above 45 deg and travel in percent of what it was, after switch-angles and after smooth-pole at 0.1, 0.5 and 1.0 deg.
fn of_set(set: &str, feed: Feed) -> Option<[(usize, f64); 4]> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../shared/data/waypoints")
        .join(set);
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("skipped: {} is not there", folder.display());
        return None;
    };
    let machine = free_machine();
    let settings = Settings::new(
        dialect::builtin("sinumerik-840d").expect("built in"),
        Some(&machine),
        ball(),
    );
    let (mut travelled, mut sums) = (0.0, [(0, 0.0); 4]);
    for entry in entries {
        let before = layer(&entry.expect("listed").path(), feed).into_bytes();
        travelled += counted(&before).1;
        let switched = rewritten("switch-angles", &before, &settings, 0.1);
        let smoothed = [0.1, 0.5, 1.0].map(|tolerance| rewritten("smooth-pole", &switched, &settings, tolerance));
        for (sum, text) in sums.iter_mut().zip([&switched].into_iter().chain(&smoothed)) {
            let (steps, travel) = counted(text);
            *sum = (sum.0 + steps, sum.1 + travel);
        }
    }
    Some(sums.map(|(steps, travel)| (steps, 100.0 * (travel / travelled - 1.0))))
}

/// Asserts that there are at most so many steps, and that the travel is at most so much, percent.
fn at_most(found: [(usize, f64); 4], wanted: [(usize, f64); 4]) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(
            found.0 <= wanted.0 && found.1 <= wanted.1 + 0.05,
            "{found:?}, {wanted:?}"
        );
    }
}

/// The independent numbers: 70 steps, then 58, 20, 7.
#[test]
fn a_freeform_part_is_smoothed_as_computed_independently() {
    let Some(found) = of_set("freeform", Feed::PerMinute) else {
        return;
    };
    println!("{found:?}");
    at_most(found, [(70, -2.28), (58, -2.28), (20, -2.28), (7, -2.28)]);
}

/// The independent numbers: 2032 steps, then 675, 60, 8; travel -47.6, -77.1, -84.2 %. They make the largest step small. smooth-pole makes
/// the slope small, with which a long block keeps a large step; so it leaves more of them, at less travel. Where all blocks take the
/// same time, both measures are the same, but for what the evenness of the slopes costs.
#[test]
fn a_curved_part_is_smoothed_as_computed_independently() {
    let Some(found) = of_set("simple_curve", Feed::PerMinute) else {
        return;
    };
    println!("{found:?}");
    at_most(found, [(2033, -23.5), (700, -47.6), (167, -77.1), (70, -84.2)]);
    let found = of_set("simple_curve", Feed::SameTimes).expect("the data is there");
    println!("{found:?}");
    at_most(found, [(2033, -23.5), (704, -47.6), (74, -77.1), (8, -84.2)]);
}
