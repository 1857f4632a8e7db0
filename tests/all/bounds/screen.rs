//! The screen of the long form: each run is first made on two small programs, its time and memory on the large one are estimated, and the large
//! one is run where the estimate is above half of a bound. Of the other runs a fixed share is made too: it says how good the estimates are.
//!
//! A run takes a power of the size: the power that both small runs show, at least 1, with a margin. Work that is partly linear and partly
//! quadratic is then estimated at more than half of what it takes, wherever the small runs stand between the two: that is why half a
//! bound is near. What grows more steeply is found only once it can be seen at an eighth of the size, or by the share. The bounds of a run
//! and the sizes that commands read end growth early, so most estimates are too high.
use super::commands::COMMANDS;
use super::inputs::Input;
use super::{Cell, Form, MOST_BYTES, MOST_SECONDS, Outcome, name, sweep};
use std::{cmp::Reverse, collections::BTreeMap, path::Path, time::Instant};

/// The small runs have this part of the elements.
const SMALL: usize = 32;
const MIDDLE: usize = 8;

/// How much higher than the power law an estimate is.
const MARGIN: f64 = 1.25;

/// An estimate above this part of a bound is near it.
const NEAR: f64 = 0.5;

/// Of the runs that are not near, one in so many is made. It shares no factor with the number of commands, so that each of them comes up.
const CONTROL: usize = 37;

/// Time that the system does not show, and what a run takes before it reads the program. It would hide growth.
const START_SECONDS: f64 = 0.01;
const START_BYTES: f64 = 8e6;

/// What a run on the large program may take.
#[derive(Clone, Copy)]
struct Estimate {
    seconds: f64,
    bytes: f64,
}

impl Estimate {
    /// The part of the nearest bound.
    fn share(self) -> f64 {
        (self.seconds / MOST_SECONDS).max(self.bytes / MOST_BYTES as f64)
    }
}

/// What is taken of a program that is `factor` times as large as the middle one, if `small` and `middle` are taken of the small programs.
fn grown(small: f64, middle: f64, start: f64, factor: f64) -> f64 {
    let ratio = (middle - start).max(start) / (small - start).max(start);
    let power = (ratio.ln() / (SMALL as f64 / MIDDLE as f64).ln()).max(1.0);
    (middle.max(start)) * factor.powf(power) * MARGIN
}

/// How much larger the large program is than the middle one, as far as a command reads it.
fn factor(command: usize, (bytes, lines): (usize, usize)) -> f64 {
    let most = COMMANDS[command].reads();
    let part = |most: usize, own: usize| most as f64 / own.max(1) as f64;
    part(most.0, bytes).min(part(most.1, lines)).clamp(1.0, MIDDLE as f64)
}

/// Bytes and lines of the middle program.
fn extent(form: &Form, input: &Input) -> (usize, usize) {
    let program = input.bytes(form.size / MIDDLE);
    let ends = program.iter().filter(|byte| matches!(byte, b'\n' | b'\r'));
    (program.len(), ends.count())
}

/// Runs the cells through the screen. Large runs come worst estimate first. What is wrong with a small run counts as well.
pub(super) fn run(folder: &Path, form: &Form, inputs: &[Input], cells: &[Cell]) -> Vec<Outcome> {
    let begun = Instant::now();
    let phase = |what: &str, runs: &[Outcome]| {
        let seconds: f64 = runs.iter().map(|run| run.seconds).sum();
        let passed = begun.elapsed().as_secs();
        println!(
            "{what}: {} runs, {seconds:.0} s of processor time; {passed} s passed",
            runs.len()
        );
    };
    let small = sweep(folder, form, inputs, form.size / SMALL, cells);
    phase("small", &small);
    let middle = sweep(folder, form, inputs, form.size / MIDDLE, cells);
    phase("middle", &middle);
    let small: BTreeMap<Cell, Outcome> = small.into_iter().map(|run| (run.cell, run)).collect();
    let middle: BTreeMap<Cell, Outcome> = middle.into_iter().map(|run| (run.cell, run)).collect();
    let extents: Vec<(usize, usize)> = inputs.iter().map(|input| extent(form, input)).collect();
    let estimates: BTreeMap<Cell, Estimate> = cells
        .iter()
        .map(|cell| {
            let (small, middle) = (&small[cell], &middle[cell]);
            let factor = factor(cell.1, extents[cell.0]);
            let seconds = grown(small.seconds, middle.seconds, START_SECONDS, factor);
            let bytes = grown(small.bytes as f64, middle.bytes as f64, START_BYTES, factor);
            (*cell, Estimate { seconds, bytes })
        })
        .collect();
    let mut chosen = chosen(cells, &estimates);
    let near = chosen.iter().filter(|cell| estimates[cell].share() > NEAR).count();
    println!(
        "{} large runs: {near} near a bound, {} to see how good the estimates are",
        chosen.len(),
        chosen.len() - near
    );
    chosen.sort_by(|a, b| estimates[b].share().total_cmp(&estimates[a].share()));
    for cell in &chosen[..near] {
        say(inputs, *cell, estimates[cell], None);
    }
    let mut large = sweep(folder, form, inputs, form.size, &chosen);
    phase("large", &large);
    judge(inputs, &estimates, &large);
    large.extend(
        small
            .into_values()
            .chain(middle.into_values())
            .filter(|run| run.wrong.is_some()),
    );
    large
}

/// The runs that are made on the large program.
fn chosen(cells: &[Cell], estimates: &BTreeMap<Cell, Estimate>) -> Vec<Cell> {
    let all = cells.iter().copied().enumerate();
    let chosen = all.filter(|(place, cell)| estimates[cell].share() > NEAR || place.is_multiple_of(CONTROL));
    chosen.map(|(_, cell)| cell).collect()
}

/// Prints an estimate, and what was measured beside it.
fn say(inputs: &[Input], cell: Cell, estimate: Estimate, measured: Option<&Outcome>) {
    let (seconds, memory) = (estimate.seconds, estimate.bytes / 1e6);
    let measured = measured.map_or_else(String::new, |run| {
        format!(", measured {:6.1} s {:6} MB", run.seconds, run.bytes / 1_000_000)
    });
    println!(
        "estimated {seconds:8.1} s {memory:8.0} MB{measured}   {}",
        name(inputs, cell)
    );
}

/// Prints how the estimates compare with what was measured.
fn judge(inputs: &[Input], estimates: &BTreeMap<Cell, Estimate>, large: &[Outcome]) {
    let share = |run: &Outcome| (run.seconds / MOST_SECONDS).max(run.bytes as f64 / MOST_BYTES as f64);
    let mut sorted: Vec<&Outcome> = large.iter().collect();
    sorted.sort_by(|a, b| share(b).total_cmp(&share(a)));
    println!("estimates and what was measured, worst first:");
    for run in sorted {
        say(inputs, run.cell, estimates[&run.cell], Some(run));
    }
    let mut low: Vec<&Outcome> = large
        .iter()
        .filter(|run| share(run) > estimates[&run.cell].share())
        .collect();
    low.sort_by_key(|run| Reverse((share(run) / estimates[&run.cell].share() * 1000.0) as u64));
    println!("{} of {} estimates were too low:", low.len(), large.len());
    for run in low {
        say(inputs, run.cell, estimates[&run.cell], Some(run));
    }
}

#[test]
fn an_estimate_of_linear_and_quadratic_work_is_more_than_half_of_it() {
    for hundredths in 0..=100 {
        let quadratic = f64::from(hundredths) / 100.0;
        let work = |size: f64| (1.0 - quadratic) * size + quadratic * size * size;
        let estimate = grown(work(0.25), work(1.0), 1e-9, 8.0);
        assert!(estimate > NEAR * work(8.0), "{estimate} of {}", work(8.0));
    }
}

#[test]
fn growth_ends_with_what_a_command_reads() {
    let of = |name: &str| {
        COMMANDS
            .iter()
            .position(|command| command.name == name)
            .expect("a command")
    };
    assert_eq!(factor(of("check"), (1_000_000, 60_000)), 8.0);
    assert_eq!(factor(of("fmt"), (1_000_000, 100_000)), 4.0);
    assert_eq!(factor(of("diff-other"), (16_000_000, 10)), 2.0);
    assert_eq!(factor(of("fix"), (60_000_000, 10)), 1.0);
    assert_eq!(grown(1.0, 4.0, 0.0, 8.0), 32.0 * MARGIN);
    assert_eq!(grown(3.0, 3.0, 0.0, 1.0), 3.0 * MARGIN);
}
