//! `machine compare`: what a wrong machine file does to the tip.
use crate::cli::out::Out;
use crate::cli::{
    Done,
    args::Global,
    failure::{Failure, remark, shown},
    load, waiting,
};
use std::io::Write;
use std::path::Path;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Fault, FaultKind, ModalState, Motion, MotionKind, Sink};
use trunnion_machine::{AxisKind, Comparison, Effort, Follower, Machine, TipDifference};
use trunnion_syntax::{BlockId, LineIndex};
use trunnion_workspace::find_machine;

/// Steps of a sweep.
const STEPS: usize = 720;
/// Pieces of blocks that a run may bound, for each of its `steps`.
const PIECES: u64 = 2;
/// Random poses.
const POSES: usize = 10_000;

/// What was asked.
pub(super) struct Options<'a> {
    pub(super) believed: &'a str,
    pub(super) truth: &'a str,
    pub(super) program: Option<&'a Path>,
    pub(super) tolerance_mm: f64,
    pub(super) tool_length: f64,
    pub(super) tip: &'a str,
}

/// Runs `machine compare`.
pub(super) fn run(global: &Global, options: &Options<'_>) -> Result<Done, Failure> {
    if !(options.tolerance_mm >= 0.0 && options.tool_length.is_finite()) {
        return Err(Failure::new(
            "--tolerance-mm must be zero or above, --tool-length a number",
        ));
    }
    let (believed, truth) = (
        find_machine(options.believed, None)?.machine,
        find_machine(options.truth, None)?.machine,
    );
    let comparison = Comparison::new(&believed, &truth).map_err(Failure::new)?;
    let mut out = Out::standard();
    writeln!(out, "assumed {}, true {}", believed.id, truth.id)?;
    let entries = comparison.entries();
    if entries.is_empty() {
        writeln!(out, "  axes, points, signs, travels and speeds are the same")?;
    }
    for entry in &entries {
        writeln!(out, "  {entry}")?;
    }
    let longest = options.tool_length.max(RANDOM_TOOLS_MM);
    let everywhere = comparison.everywhere(longest);
    if everywhere.is_finite() {
        writeln!(
            out,
            "at every pose within the travel, with tools up to {longest} mm long: tip off by at most {:.6} mm (proven)",
            round_up(everywhere)
        )?;
    }
    let found = if let Some(path) = options.program {
        waiting::during(global, "comparing along", path, || {
            program(global, path, &comparison, &believed, options.tolerance_mm, &mut out)
        })?
    } else {
        sweep(&comparison, &believed, options, &mut out)?
    };
    let everywhere = if found.longest_mm > longest {
        comparison.everywhere(found.longest_mm)
    } else {
        everywhere
    };
    let verdict = found.verdict(options.tolerance_mm, everywhere);
    out.text(&format!("{verdict}\n"));
    Ok(if verdict.starts_with("PASS") {
        Done::Clean
    } else {
        Done::Found
    })
}

/// Random poses have tools of up to this length, mm.
const RANDOM_TOOLS_MM: f64 = 200.0;

/// Digits that are printed of a bound.
fn round_up(bound: f64) -> f64 {
    (bound * 1e6 * (1.0 - 1e-12)).ceil() / 1e6
}

/// What was found, and what it proves.
struct Found {
    worst_mm: Option<f64>,
    /// Proven for all that was compared.
    bound_mm: f64,
    /// The longest tool of the program, mm.
    longest_mm: f64,
    /// What is not covered by the bound, in words.
    open: Vec<String>,
}

impl Found {
    /// One sentence that begins with PASS, FAIL or UNKNOWN. PASS only where all is proven.
    fn verdict(&self, tolerance: f64, everywhere: f64) -> String {
        if self.worst_mm.is_some_and(|worst| worst > tolerance || worst.is_nan()) {
            return format!("FAIL: the tip is off by more than {tolerance} mm");
        }
        let inside = everywhere <= tolerance && self.worst_mm.is_some();
        if inside || (self.open.is_empty() && self.bound_mm <= tolerance && self.worst_mm.is_some()) {
            let bound = if self.open.is_empty() {
                self.bound_mm.min(everywhere)
            } else {
                everywhere
            };
            let bound = round_up(bound);
            return format!("PASS: the tip is off by at most {bound} mm (proven); the tolerance is {tolerance} mm");
        }
        let mut why = self.open.clone();
        if self.worst_mm.is_none() {
            why.push("no pose could be compared".to_owned());
        } else if self.bound_mm > tolerance && self.bound_mm.is_finite() && self.open.is_empty() {
            why.push(format!("only {} mm is proven", round_up(self.bound_mm)));
        } else if self.bound_mm.is_infinite() && self.open.is_empty() {
            why.push("no bound is known".to_owned());
        }
        format!(
            "UNKNOWN: it is not proven that the tip is off by at most {tolerance} mm: {}",
            why.join("; ")
        )
    }
}

/// The tip held still, and random poses.
fn sweep(
    comparison: &Comparison<'_>,
    machine: &Machine,
    options: &Options<'_>,
    out: &mut impl Write,
) -> Result<Found, Failure> {
    let numbers: Vec<f64> = options
        .tip
        .split(',')
        .filter_map(|text| text.trim().parse().ok())
        .collect();
    let [x, y, z] = numbers[..] else {
        return Err(Failure::new(format!(
            "--tip {}: write three numbers, for example 0,0,50",
            options.tip
        )));
    };
    let swept = comparison.fixed_tip_sweep(&Vec3::new(x, y, z), options.tool_length, STEPS);
    if let Some(found) = &swept {
        tell(out, "tip held still, rotary axes swept", machine, found)?;
    }
    let random = comparison.random_poses(POSES, 20_261_121);
    if let Some(found) = &random {
        tell(out, &format!("{POSES} random poses within the travel"), machine, found)?;
    }
    let worst = [swept, random].into_iter().flatten().map(|found| found.tip_mm);
    Ok(Found {
        worst_mm: worst.reduce(f64::max),
        bound_mm: f64::INFINITY,
        longest_mm: 0.0,
        open: vec![format!(
            "it holds at {STEPS} steps of each sweep and at {POSES} poses, but poses between them were not compared; with a program the whole path is judged"
        )],
    })
}

/// The worst, and the joints where it is.
fn tell(out: &mut impl Write, what: &str, machine: &Machine, found: &TipDifference) -> Result<(), Failure> {
    let joints: Vec<String> = machine
        .axes
        .iter()
        .zip(found.joints)
        .map(|(axis, value)| {
            let plain = if axis.kind == AxisKind::Rotary {
                deg(value)
            } else {
                value
            };
            format!("{}{plain:.4}", char::from(axis.letter))
        })
        .collect();
    writeln!(
        out,
        "{what}: tip off by up to {:.6} mm, tool axis off by {:.6} deg there, at {}",
        found.tip_mm,
        deg(found.axis),
        joints.join(" ")
    )?;
    Ok(())
}

/// The program on both machines.
fn program(
    global: &Global,
    path: &Path,
    comparison: &Comparison<'_>,
    machine: &Machine,
    tolerance_mm: f64,
    out: &mut impl Write,
) -> Result<Found, Failure> {
    let loaded = load::load_for_steps(global, path)?;
    let mut both = Both {
        comparison,
        follower: Follower::new(machine),
        tolerance_mm,
        effort: Effort::new(PIECES.saturating_mul(loaded.resolved.setup.limits.steps)),
        worst: None,
        bound_mm: 0.0,
        longest_mm: 0.0,
        cut_short: None,
        unknown: 0,
        at_end: 0,
        compared: 0,
        not_run: None,
    };
    trunnion_interp::run(
        &loaded.program,
        loaded.resolved.dialect,
        &loaded.resolved.setup,
        &mut both,
    );
    let mut open = Vec::new();
    let mut count = |many: usize, why: &str| {
        if many > 0 {
            open.push(format!("{many} motion{} {why}", if many == 1 { "" } else { "s" }));
        }
    };
    count(both.unknown, "could not be compared: the end or the path is unknown");
    count(both.at_end, "compared at the end only: the start is unknown");
    let lines = LineIndex::new(loaded.program.source());
    let line = |block| {
        lines
            .line_column(loaded.program.source(), loaded.program.block(block).range().start)
            .0
    };
    if let Some((block, many)) = both.cut_short {
        open.push(format!(
            "{} proven only at the points that were compared, the first in line {}: their axes turn so far that the bound between them takes more \
             pieces than a run may use; write shorter motions, allow more with --tolerance-mm, or use --max-steps N or raise `steps` of [limits] in trunnion.toml",
            match many {
                1 => "1 motion is".to_owned(),
                many => format!("{many} motions are"),
            },
            line(block)
        ));
    }
    if let Some((block, why)) = &both.not_run {
        open.push(format!("not followed from line {} on: {why}", line(*block)));
    }
    for text in &open {
        remark(global.quiet, &format!("{}: {text}", loaded.name));
    }
    let found = Found {
        worst_mm: both.worst.map(|(_, found)| found.tip_mm),
        bound_mm: both.bound_mm,
        longest_mm: both.longest_mm,
        open,
    };
    let Some((block, worst)) = both.worst else {
        return Ok(found);
    };
    let line = line(block);
    tell(
        out,
        &format!(
            "{}:{line}, the worst of {}",
            shown(&loaded.name),
            crate::cli::verdict::counted(both.compared as u64, "motion")
        ),
        machine,
        &worst,
    )?;
    Ok(found)
}

struct Both<'a> {
    comparison: &'a Comparison<'a>,
    follower: Follower<'a>,
    tolerance_mm: f64,
    effort: Effort,
    worst: Option<(BlockId, TipDifference)>,
    bound_mm: f64,
    longest_mm: f64,
    /// The first block that needs more pieces than it may take, and how many such motions there are.
    cut_short: Option<(BlockId, usize)>,
    unknown: usize,
    at_end: usize,
    compared: usize,
    /// The first block after which something was never compared, and why.
    not_run: Option<(BlockId, String)>,
}

impl Sink for Both<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        if matches!(motion.kind, MotionKind::Dwell(_)) {
            return;
        }
        let leg = self.follower.follow(motion);
        if let Ok(end) = &leg.end {
            self.longest_mm = self.longest_mm.max(end.tool_length);
        }
        let along = self.comparison.along(&leg, self.tolerance_mm, &mut self.effort);
        let Some(found) = along.map(|along| along.worst).or_else(|| self.comparison.at_end(&leg)) else {
            self.unknown += 1;
            return;
        };
        self.compared += 1;
        match along {
            Some(along) => {
                self.bound_mm = self.bound_mm.max(along.bound_mm);
                if along.cut_short && found.tip_mm <= self.tolerance_mm {
                    self.cut_short.get_or_insert((motion.block, 0)).1 += 1;
                }
            }
            None if leg.start.is_none() => self.at_end += 1,
            None => self.unknown += 1,
        }
        // the first of equal ones, rounding aside
        if self.worst.is_none_or(|(_, known)| found.tip_mm > known.tip_mm + 1e-9) {
            self.worst = Some((motion.block, found));
        }
    }
    fn fault(&mut self, fault: Fault) {
        let why = match fault.kind {
            FaultKind::EndlessLoop { proved: true, .. } => "a loop that never ends".to_owned(),
            FaultKind::EndlessLoop { blocks, .. } => {
                format!(
                    "no end within {blocks} executed blocks; use --max-steps N or raise `steps` of [limits] in trunnion.toml"
                )
            }
            FaultKind::NotDecided { what } => format!("not decided: {what}"),
            FaultKind::Rejected { message, .. } => format!("the control refuses it: {message}"),
            FaultKind::MissingSubprogram { name, .. } => format!("program {name} not found"),
            FaultKind::ProgramAlarm { message } => format!("the program stops itself: {message}"),
            _ => return,
        };
        self.not_run.get_or_insert((fault.block, why));
    }
}
