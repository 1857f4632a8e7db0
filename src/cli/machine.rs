//! `machine`: list, show in words and numbers, self-test.
use super::{
    Done,
    args::{Global, Machine, MachineCommand},
    failure::Failure,
};
use std::io::Write;
use trunnion_machine::{BUILTIN_MACHINES, builtin, describe, self_test};
use trunnion_workspace::find_machine;

/// Residuals of `machine check` must stay below this: mm and rad.
const TOLERANCE: f64 = 1e-9;

/// Runs `machine`.
pub(super) fn run(_global: &Global, command: &Machine) -> Result<Done, Failure> {
    let mut out = std::io::stdout().lock();
    match &command.command {
        MachineCommand::List => {
            for name in BUILTIN_MACHINES {
                let title = builtin(name).map_or("", |machine| machine.name.as_str());
                writeln!(out, "{name:20} {title}")?;
            }
            Ok(Done::Clean)
        }
        MachineCommand::Show { name } => {
            let machine = find_machine(name, None)?;
            for line in describe(&machine).lines() {
                writeln!(out, "{line}")?;
            }
            Ok(Done::Clean)
        }
        MachineCommand::Check { name, poses } => {
            let machine = find_machine(name, None)?;
            let result = self_test(&machine, *poses, 20_261_121);
            writeln!(
                out,
                "{}: forward(inverse(pose)) on {} random poses",
                machine.id, result.poses
            )?;
            writeln!(out, "  worst tool tip residual   {:.3e} mm", result.worst_tip_mm)?;
            writeln!(out, "  worst tool axis residual  {:.3e} rad", result.worst_axis)?;
            writeln!(out, "  true posture not found    {} times", result.posture_missing)?;
            let good = result.poses > 0
                && result.posture_missing == 0
                && result.worst_tip_mm < TOLERANCE
                && result.worst_axis < TOLERANCE;
            writeln!(out, "{}", if good { "PASS" } else { "FAIL" })?;
            Ok(if good { Done::Clean } else { Done::Found })
        }
    }
}
