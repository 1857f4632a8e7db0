//! `retarget`, the last rewrite: what the others leave is written for another control or machine by the converter.
use super::report::Step;
use crate::cli::{
    args::Fix,
    convert::{Chosen, certified, summary},
    failure::Failure,
    load::Loaded,
};
use trunnion_certify::conversion::Assume;
use trunnion_convert::{Options, Source, convert};
use trunnion_rewrite::{Attempt, Judged, State};
use trunnion_syntax::{BlockId, LineIndex};

/// The name of the rewrite.
pub(super) const NAME: &str = "retarget";

/// A program for another control or machine.
pub(super) struct Retargeted {
    /// Its text.
    pub(super) text: String,
    /// What is proved, for people, as `convert` says it; the first line is about the whole.
    pub(super) summary: Vec<String>,
    /// The certificate of the conversion, if it was asked for.
    pub(super) certificate: Option<String>,
}

/// Whether the command asks for it and names a target.
pub(super) fn wanted(command: &Fix) -> bool {
    command.target.is_named() && command.rewrite.iter().any(|name| name == NAME)
}

/// What cannot be asked for together.
pub(super) fn fits(command: &Fix) -> Result<(), Failure> {
    if command.target.is_named() && !command.rewrite.iter().any(|name| name == NAME) {
        return Err(Failure::new(
            "--to, --to-machine and --post are for the rewrite retarget: add --rewrite retarget",
        ));
    }
    if !wanted(command) {
        return Ok(());
    }
    if command.write {
        return Err(Failure::new(
            "retarget writes a program for another control or machine: keep the original and use -o FILE instead of --write",
        ));
    }
    if command.lines.is_some() {
        return Err(Failure::new("retarget writes the whole program: leave out --lines"));
    }
    if command.certificate.is_some() && command.rewrite.len() > 1 {
        return Err(Failure::new(
            "a certificate covers either the other rewrites or retarget: apply the others first (-o FILE --certificate FILE.json), then retarget that file",
        ));
    }
    Ok(())
}

/// Converts the text that the other rewrites leave.
pub(super) fn apply(command: &Fix, loaded: &Loaded, chosen: &Chosen, before: &[u8]) -> Result<Step, Failure> {
    let (resolved, machine) = (&loaded.resolved, chosen.machine.as_ref());
    let source = Source {
        text: before,
        dialect: resolved.dialect,
        machine: resolved.machine.as_ref(),
        setup: &resolved.setup,
        assume: Assume::default(),
    };
    let options = Options {
        tolerance_mm: command.tolerance_mm,
        tolerance_deg: command.tolerance_deg,
        ..Options::default()
    };
    Ok(match convert(&source, &chosen.target(), &options) {
        Ok(converted) => {
            let wanted = command.certificate.is_some();
            let certificate = wanted
                .then(|| certified(loaded, before, machine, &converted))
                .transpose()?;
            let summary = summary(&loaded.name, &converted);
            let text = converted.text;
            let retargeted = Retargeted {
                text,
                summary,
                certificate,
            };
            step(loaded, before, State::Proved, Some(retargeted))
        }
        Err(refused) => {
            let place = refused
                .place
                .map_or_else(String::new, |(line, column)| format!("line {line}, column {column}: "));
            step(
                loaded,
                before,
                State::Refused(format!("{place}{}", refused.message)),
                None,
            )
        }
    })
}

/// One place: the whole program.
fn step(loaded: &Loaded, before: &[u8], state: State, retargeted: Option<Retargeted>) -> Step {
    let last = loaded.program.block_count().saturating_sub(1) as u32;
    let last_line = LineIndex::new(before).line_column(before, before.len() as u32).0;
    Step {
        rewrite: NAME,
        attempt: Attempt {
            places: vec![Judged {
                first: BlockId(0),
                last: BlockId(last),
                lines: (1, last_line),
                state,
            }],
            proved: None,
        },
        gains: Vec::new(),
        retargeted,
    }
}
