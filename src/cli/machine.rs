//! `machine`: list, show in words and numbers, self-test, compare, import.
mod compare;
mod import;

use super::{
    Done,
    args::{Global, Machine, MachineCommand, ShowFormat},
    failure::Failure,
    load,
};
use crate::cli::out::Out;
use std::io::Write;
use trunnion_machine::{BUILTIN_MACHINES, builtin, builtin_source, describe, self_test};
use trunnion_workspace::{FoundMachine, find_machine};

/// Residuals of `machine check` must stay below this: mm and rad.
const TOLERANCE: f64 = 1e-9;

/// Runs `machine`.
pub(super) fn run(global: &Global, command: &Machine) -> Result<Done, Failure> {
    match &command.command {
        MachineCommand::List => list(),
        MachineCommand::Show { name, format } => show(name, *format),
        MachineCommand::Check { name, poses } => check(name, *poses),
        MachineCommand::Compare {
            believed,
            truth,
            program,
            tolerance_mm,
            tool_length,
            tip,
        } => compare::run(
            global,
            &compare::Options {
                believed,
                truth,
                program: program.as_deref(),
                tolerance_mm: *tolerance_mm,
                tool_length: *tool_length,
                tip,
            },
        ),
        MachineCommand::Import {
            file,
            format,
            output,
            set,
        } => import::run(global, file, *format, output.as_deref(), set),
    }
}

fn list() -> Result<Done, Failure> {
    let mut out = Out::standard();
    for name in BUILTIN_MACHINES {
        let title = builtin(name).map_or("", |machine| machine.name.as_str());
        writeln!(out, "{name:34} {title}")?;
    }
    Ok(Done::Clean)
}

fn show(name: &str, format: ShowFormat) -> Result<Done, Failure> {
    let FoundMachine { machine, file } = find_machine(name, None)?;
    let mut out = Out::standard();
    if format == ShowFormat::Toml {
        let text = match &file {
            Some(file) => load::read(file)?,
            None => builtin_source(name).unwrap_or_default().as_bytes().to_vec(),
        };
        out.write_all(&text)?;
        return Ok(Done::Clean);
    }
    for line in describe(&machine).lines() {
        out.text(&format!("{line}\n"));
    }
    Ok(Done::Clean)
}

fn check(name: &str, poses: usize) -> Result<Done, Failure> {
    let machine = find_machine(name, None)?.machine;
    let mut out = Out::standard();
    let result = self_test(&machine, poses, 20_261_121);
    writeln!(
        out,
        "{}: forward(inverse(pose)) on {} random poses",
        machine.id, result.poses
    )?;
    writeln!(out, "  worst tool tip residual   {:.3e} mm", result.worst_tip_mm)?;
    writeln!(out, "  worst tool axis residual  {:.3e} rad", result.worst_axis)?;
    writeln!(out, "  true posture not found    {} times", result.posture_missing)?;
    match machine.checks {
        0 => writeln!(
            out,
            "  check rows                none: a wrong sign, point or order would not be noticed"
        )?,
        count => writeln!(out, "  check rows                {count}, all hold")?,
    }
    for warning in &machine.warnings {
        writeln!(out, "  warning: {warning}")?;
    }
    let good = result.poses > 0
        && result.posture_missing == 0
        && result.worst_tip_mm < TOLERANCE
        && result.worst_axis < TOLERANCE;
    writeln!(out, "{}", if good { "PASS" } else { "FAIL" })?;
    Ok(if good { Done::Clean } else { Done::Found })
}
