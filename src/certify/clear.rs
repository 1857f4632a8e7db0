//! Whether a tool stays clear of all declared obstacles in a motion.
use crate::Outcome;
use trunnion_machine::{Leg, Machine, Nearness, ToolBody, nearness_with_part};
use trunnion_same::Step;

/// A motion whose distance from the obstacles is asked for.
pub(crate) struct Clearance<'a> {
    pub(crate) machine: &'a Machine,
    /// Index of the motion.
    pub(crate) motion: usize,
    /// Its line in the program after.
    pub(crate) line: u32,
    /// The distance to keep, mm.
    pub(crate) keep: f64,
}

impl Clearance<'_> {
    /// The smallest distance of the tool from those obstacles that count (by index), where all are far enough.
    pub(crate) fn clear(&self, step: &Step, leg: &Leg, counts: impl Fn(usize) -> bool) -> Result<f64, Outcome> {
        let (line, keep) = (self.line, self.keep);
        let here = |message: &str| Outcome::unknown_at(Some(line), format!("line {line}: {message}"));
        let refute = |message: String| Err(Outcome::refuted_at(self.motion, line, message));
        let body = step.held.tool.as_ref().and_then(ToolBody::of);
        let body =
            body.ok_or_else(|| here("the diameter of the tool is not declared: [[tool]] diameter in trunnion.toml"))?;
        let mut least = f64::INFINITY;
        for near in nearness_with_part(self.machine, leg, &body, keep) {
            if !counts(near.obstacle) {
                continue;
            }
            let name = &self.machine.obstacles[near.obstacle].name;
            match near.nearness {
                Nearness::Clear(mm) => least = least.min(mm),
                Nearness::Unknown(why) => {
                    return Err(here(&format!("whether the tool clears {name} is unknown: {why}")));
                }
                Nearness::Through => return refute(format!("the tool goes through {name}")),
                Nearness::Near(mm) => {
                    let by = mm.map_or("less than that".to_owned(), |mm| format!("{mm:.6} mm"));
                    return refute(format!("the tool passes {name} at {by}; {keep} mm is claimed"));
                }
            }
        }
        Ok(least)
    }
}

/// Nothing that the position of the tool depends on is undeclared, or it is taken as zero. `Err`: what is missing.
pub(crate) fn is_declared(step: &Step, assumed_zeros: bool) -> Result<(), String> {
    let undeclared = step.motion.undeclared;
    if !assumed_zeros && undeclared.zero & 0b111 != 0 {
        let offset = step.held.work_offset.as_deref().unwrap_or("the zero point");
        return Err(format!(
            "{offset} is not declared, so it is unknown where the obstacles are: [work_offsets] in trunnion.toml"
        ));
    }
    if !assumed_zeros && undeclared.length {
        return Err("the length of the tool is not declared, so it is unknown how low its tip is".to_owned());
    }
    Ok(())
}
