//! The screen of the long form: each run is first made on a small program and, where linear growth from there stays below half of a bound, on a
//! larger one. Its time and memory on the large one are estimated, and that is run where the estimate is above half of a bound. Of the other runs a
//! fixed share is made too: it says how good the estimates are.
//!
//! A run takes a power of the size: the power that both small runs show, at least 1, with a margin. Work that is partly linear and partly
//! quadratic is then estimated at more than half of what it takes, wherever the small runs stand between the two: that is why half a
//! bound is near. What grows more steeply is found only once it can be seen at an eighth of the size, or by the share. The bounds of a run
//! and the sizes that commands read end growth early, so most estimates are too high.
use super::commands::COMMANDS;
use super::inputs::Input;
use super::{Cell, Form, MOST_BYTES, MOST_SECONDS, Outcome, name, sweep};
use std::{cmp::Reverse, collections::BTreeMap, path::Path, time::Instant};
use trunnion::geometry::math::{ln, pow};

/// The small runs have this part of the elements.
const SMALL: usize = 32;
const MIDDLE: usize = 8;

/// How much higher than the power law an estimate is.
const MARGIN: f64 = 1.25;

/// An estimate above this part of a bound is near it.
const NEAR: f64 = 0.5;

/// Of the runs that are not near, one in so many is made. It shares no factor with the number of commands, so that each of them comes up.
const CONTROL: usize = 37;

/// What a run takes before it reads the program, which does not grow. Less cannot be measured: the clock of the system has ticks of 10 ms.
const SECONDS: Start = Start {
    took: 0.01,
    least: 0.01,
};
const BYTES: Start = Start { took: 12e6, least: 1e6 };

/// See [`SECONDS`].
#[derive(Clone, Copy)]
struct Start {
    took: f64,
    least: f64,
}

/// What a run on the large program may take.
#[derive(Clone, Copy)]
struct Estimate {
    seconds: f64,
    bytes: f64,
    /// How much larger the program is than the one that it comes from.
    factor: f64,
}

impl Estimate {
    /// The part of the nearest bound.
    fn share(self) -> f64 {
        (self.seconds / MOST_SECONDS).max(self.bytes / MOST_BYTES as f64)
    }
}

/// What is taken of a program that is `factor` times as large as the middle one, if `small` and `middle` are taken of the small programs.
fn grown(small: f64, middle: f64, start: Start, factor: f64) -> f64 {
    let [small, middle] = [small, middle].map(|taken| (taken - start.took).max(start.least));
    let power = (ln(middle / small) / ln(SMALL as f64 / MIDDLE as f64)).max(1.0);
    start.took + middle * pow(factor, power) * MARGIN
}

/// How much larger the large program is than one that has `part` of its elements, as far as a command reads it.
fn factor(command: usize, (bytes, lines): (usize, usize), part: usize) -> f64 {
    let most = COMMANDS[command].reads();
    let limit = |most: usize, own: usize| most as f64 / own.max(1) as f64;
    limit(most.0, bytes).min(limit(most.1, lines)).clamp(1.0, part as f64)
}

/// Whether a program is the same whatever its size.
fn does_not_grow(form: &Form, input: &Input) -> bool {
    input.bytes(form.size / SMALL) == input.bytes(form.size / MIDDLE)
}

/// Bytes and lines of the program that has `part` of the elements.
fn extent(form: &Form, input: &Input, part: usize) -> (usize, usize) {
    let program = input.bytes(form.size / part);
    let ends = program.iter().filter(|byte| matches!(byte, b'\n' | b'\r'));
    (program.len(), ends.count())
}

/// What the runs on the program that has `part` of the elements say, if the power is 1.
fn linear(form: &Form, inputs: &[Input], runs: &BTreeMap<Cell, Outcome>, part: usize) -> BTreeMap<Cell, Estimate> {
    let extents: Vec<(usize, usize)> = inputs.iter().map(|input| extent(form, input, part)).collect();
    let one = |run: &Outcome| {
        let factor = factor(run.cell.1, extents[run.cell.0], part);
        let seconds = grown(run.seconds, run.seconds, SECONDS, factor);
        let bytes = grown(run.bytes as f64, run.bytes as f64, BYTES, factor);
        Estimate { seconds, bytes, factor }
    };
    runs.iter().map(|(cell, run)| (*cell, one(run))).collect()
}

/// Runs the cells through the screen. Large runs come worst estimate first. What is wrong with a small run counts as well.
pub(super) fn run(folder: &Path, form: &Form, inputs: &[Input], cells: &[Cell]) -> Vec<Outcome> {
    let begun = Instant::now();
    let phase = |what: &str, cells: &[Cell], part: usize| {
        let runs = sweep(folder, form, inputs, form.size / part, cells);
        let seconds: f64 = runs.iter().map(|run| run.seconds).sum();
        let passed = begun.elapsed().as_secs();
        println!(
            "{what}: {} runs, {seconds:.0} s of processor time; {passed} s passed",
            runs.len()
        );
        runs.into_iter()
            .map(|run| (run.cell, run))
            .collect::<BTreeMap<Cell, Outcome>>()
    };
    let whole: Vec<bool> = inputs.iter().map(|input| does_not_grow(form, input)).collect();
    let (fixed, cells): (Vec<Cell>, Vec<Cell>) = cells.iter().partition(|cell| whole[cell.0]);
    let small = phase("small", &cells, SMALL);
    let mut estimates = linear(form, inputs, &small, SMALL);
    // what the small run finds near needs no second one
    let open: Vec<Cell> = cells
        .iter()
        .copied()
        .filter(|cell| estimates[cell].share() <= NEAR)
        .collect();
    let middle = phase("middle", &open, MIDDLE);
    for (cell, own) in linear(form, inputs, &middle, MIDDLE) {
        let (small, middle) = (&small[&cell], &middle[&cell]);
        let estimate = Estimate {
            seconds: grown(small.seconds, middle.seconds, SECONDS, own.factor),
            bytes: grown(small.bytes as f64, middle.bytes as f64, BYTES, own.factor),
            factor: own.factor,
        };
        estimates.insert(cell, estimate);
    }
    let mut chosen = chosen(&cells, &estimates);
    chosen.sort_by(|a, b| estimates[b].share().total_cmp(&estimates[a].share()));
    let near = chosen.iter().filter(|cell| estimates[cell].share() > NEAR).count();
    let others = chosen.len() - near;
    println!("{near} large runs near a bound, {others} to see how good the estimates are");
    for cell in &chosen[..near] {
        say(inputs, *cell, estimates[cell], None);
    }
    let large: Vec<Outcome> = phase("large", &chosen, 1).into_values().collect();
    judge(inputs, &estimates, &large);
    let measured = phase("programs that do not grow", &fixed, 1);
    let smaller = small.into_values().chain(middle.into_values());
    let wrong = smaller.filter(|run| run.wrong.is_some());
    large.into_iter().chain(measured.into_values()).chain(wrong).collect()
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

#[cfg(test)]
const NO_START: Start = Start { took: 0.0, least: 0.0 };

#[test]
fn an_estimate_of_linear_and_quadratic_work_is_more_than_half_of_it() {
    for hundredths in 0..=100 {
        let quadratic = f64::from(hundredths) / 100.0;
        let work = |size: f64| (1.0 - quadratic) * size + quadratic * size * size;
        let estimate = grown(work(0.25), work(1.0), NO_START, 8.0);
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
    assert_eq!(factor(of("check"), (1_000_000, 60_000), MIDDLE), 8.0);
    assert_eq!(factor(of("fmt"), (1_000_000, 100_000), MIDDLE), 3.0);
    assert_eq!(factor(of("diff-other"), (16_000_000, 10), MIDDLE), 2.0);
    assert_eq!(factor(of("fix"), (60_000_000, 10), MIDDLE), 1.0);
    assert_eq!(grown(1.0, 4.0, NO_START, 8.0), 32.0 * MARGIN);
    assert_eq!(grown(3.0, 3.0, NO_START, 1.0), 3.0 * MARGIN);
}
