//! `machine compare`: what a wrong machine file does to the tip.
use crate::cli::{
    Done,
    args::Global,
    failure::{Failure, remark},
    load,
};
use std::io::Write;
use std::path::Path;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, Sink};
use trunnion_machine::{AxisKind, Comparison, Follower, Machine, TipDifference};
use trunnion_syntax::{BlockId, LineIndex};
use trunnion_workspace::find_machine;

/// Places per block at which a program is compared.
const SAMPLES: usize = 16;
/// Steps of a sweep.
const STEPS: usize = 720;
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
        find_machine(options.believed, None)?,
        find_machine(options.truth, None)?,
    );
    let comparison = Comparison::new(&believed, &truth).map_err(Failure::new)?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "believed {}, truth {}", believed.id, truth.id)?;
    let entries = comparison.entries();
    if entries.is_empty() {
        writeln!(out, "  axes, points, signs, travels and speeds are the same")?;
    }
    for entry in &entries {
        writeln!(out, "  {entry}")?;
    }
    let found = if let Some(path) = options.program {
        program(global, path, &comparison, &believed, &mut out)?
    } else {
        sweep(&comparison, &believed, options, &mut out)?
    };
    let far = found.is_some_and(|found| found.tip_mm.is_nan() || found.tip_mm > options.tolerance_mm);
    let verdict = match found {
        None => "UNKNOWN: no pose could be compared".to_owned(),
        Some(_) if far => format!("FAIL: the tip is off by more than {} mm", options.tolerance_mm),
        Some(_) => format!(
            "PASS: the tip is off by at most {} mm where it was compared",
            options.tolerance_mm
        ),
    };
    writeln!(out, "{verdict}")?;
    Ok(if far || found.is_none() {
        Done::Found
    } else {
        Done::Clean
    })
}

/// The tip held still, and random poses.
fn sweep(
    comparison: &Comparison<'_>,
    machine: &Machine,
    options: &Options<'_>,
    out: &mut impl Write,
) -> Result<Option<TipDifference>, Failure> {
    let numbers: Vec<f64> = options
        .tip
        .split(',')
        .filter_map(|text| text.trim().parse().ok())
        .collect();
    let [x, y, z] = numbers[..] else {
        return Err(Failure::new(format!(
            "--tip {}: three numbers are needed, as 0,0,50",
            options.tip
        )));
    };
    let swept = comparison.fixed_tip_sweep(&Vec3::new(x, y, z), options.tool_length, STEPS);
    if let Some(found) = &swept {
        tell(out, "tip held still, rotary axes swept", machine, found)?;
    }
    let random = comparison.random_poses(POSES, 20_261_121);
    if let Some(found) = &random {
        tell(out, &format!("{POSES} random poses inside the travels"), machine, found)?;
    }
    Ok([swept, random]
        .into_iter()
        .flatten()
        .reduce(|a, b| if b.tip_mm > a.tip_mm { b } else { a }))
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
        "{what}: tip off by up to {:.6} mm, tool axis there by {:.6} deg, at {}",
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
    out: &mut impl Write,
) -> Result<Option<TipDifference>, Failure> {
    let loaded = load::load(global, path)?;
    let mut both = Both {
        comparison,
        follower: Follower::new(machine),
        worst: None,
        unknown: 0,
        compared: 0,
    };
    trunnion_interp::run(
        &loaded.program,
        loaded.resolved.dialect,
        &loaded.resolved.setup,
        &mut both,
    );
    if both.unknown > 0 {
        let text = format!(
            "{}: {} motions could not be compared: the position is not known there",
            loaded.name, both.unknown
        );
        remark(global.quiet, &text);
    }
    let Some((block, found)) = both.worst else {
        return Ok(None);
    };
    let lines = LineIndex::new(loaded.program.source());
    let start = loaded.program.block(block).range().start;
    let (line, _) = lines.line_column(loaded.program.source(), start);
    tell(
        out,
        &format!("{}:{line}, the worst of {} motions", loaded.name, both.compared),
        machine,
        &found,
    )?;
    Ok(Some(found))
}

struct Both<'a> {
    comparison: &'a Comparison<'a>,
    follower: Follower<'a>,
    worst: Option<(BlockId, TipDifference)>,
    unknown: usize,
    compared: usize,
}

impl Sink for Both<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        let leg = self.follower.follow(motion);
        let Some(found) = self.comparison.on(&leg, SAMPLES) else {
            self.unknown += 1;
            return;
        };
        self.compared += 1;
        // the first of equal ones, rounding aside
        if self.worst.is_none_or(|(_, known)| found.tip_mm > known.tip_mm + 1e-9) {
            self.worst = Some((motion.block, found));
        }
    }
    fn fault(&mut self, _fault: Fault) {}
    fn block_done(&mut self, _block: BlockId, _interpreter: &Interpreter<'_>) {}
}
