//! Adds full turns to the words of a rotary axis so that it never turns the long way round.
//!
//! # Why
//! A control that takes rotary words literally turns from `C359` to `C1` through 358 degrees. Under feed the tool dwells and marks
//! the part; in rapid it costs seconds and winds up cables. `C361` is the same pose, two degrees away.
//!
//! # Example
//! ```gcode before sinumerik-840d mikron-ucp710
//! TRAORI
//! G0 X10 Y0 Z50 A10 C350.000 S8000 M3
//! N10 G1 X9 Y1 A10.5 C358.500 F1000
//! N20 X8 Y2 A11 C6.250
//! N30 X7 Y3 A11.5 C14.000
//! M30
//! ```
//! ```gcode after
//! TRAORI
//! G0 X10 Y0 Z50 A10 C350.000 S8000 M3
//! N10 G1 X9 Y1 A10.5 C358.500 F1000
//! N20 X8 Y2 A11 C366.250
//! N30 X7 Y3 A11.5 C374.000
//! M30
//! ```
//!
//! # Claim
//! Every motion ends in the same pose, and rotary positions differ by full turns only. Where the number of turns is the same at
//! both ends of a motion, its path is the same too. Where it changes, the axis now takes the shorter path, and the certificate states
//! by how much the paths differ there.
//!
//! # Traps
//! - Only full turns that keep the axis within its limits are added; a jump that the limits force stays.
//! - Exact half turns stay as they are written: both directions are equally long.
//! - The program may end some full turns away from where it ended before. A program that continues from there, or a control that
//!   shows 0 to 360 degrees, must accept that.
//! - `C=DC(..)`, `IC(..)`, `ACP(..)`, `ACN(..)`, G91, expressions and tool vectors do not take values literally: refused.
//!
//! # Sources
//! docs/kinematics.md#unwinding: q_i += 2 pi round((q_(i-1) - q_i) / 2 pi).
use super::Body;
use crate::style::add_whole;
use crate::survey::{ProgrammedMotion, programmed};
use crate::unwrap::{long_way_steps, unwrap};
use crate::{Known, Options, Place, Proposal, Proposed};
use trunnion_certify::Claim;
use trunnion_check::Settings;
use trunnion_geometry::deg;
use trunnion_machine::{Limits, Machine};
use trunnion_syntax::{Address, BlockId, LineIndex, Program, TextEdit, Value, Word};

pub(super) const REWRITE: Body = Body {
    cures: &[
        "angle-wrap",
        "axis-overspeed",
        "excess-linear-travel",
        "excess-rotary-travel",
        "feed-drop",
        "path-deviation",
    ],
    writes: Some("rotary words of blocks"),
    propose,
};

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, _: &Known) -> Proposed {
    let Some(machine) = settings.machine else {
        return Err("no machine is named, and the limits of rotary axes depend on the machine (--machine)".into());
    };
    let motions = programmed(program, settings.dialect, &settings.setup).motions;
    let (mut edits, mut summaries, mut reasons) = (Vec::new(), Vec::new(), Vec::new());
    for &joint in &machine.rotary {
        match unwind(program, machine, joint, &motions) {
            Ok(Some((found, summary))) => {
                edits.extend(found);
                summaries.push(summary);
            }
            Ok(None) => {}
            Err(reason) => reasons.push(reason),
        }
    }
    if edits.is_empty() {
        return if reasons.is_empty() {
            Ok(None)
        } else {
            Err(reasons.join("; ").into())
        };
    }
    edits.sort_by_key(|edit| edit.range.start);
    summaries.extend(reasons.into_iter().map(|reason| format!("not changed: {reason}")));
    let claim = Claim::SamePoses {
        tolerance_mm: options.tolerance_mm,
        tolerance_deg: options.tolerance_deg,
    };
    Ok(Some(Proposal {
        // one place: the turns of a motion carry over to all that follow
        places: vec![Place::around(program, edits)],
        claim,
        summary: summaries.join("; "),
    }))
}

/// Edits for one rotary axis. `Ok(None)`: it never jumps.
fn unwind(
    program: &Program,
    machine: &Machine,
    joint: usize,
    motions: &[ProgrammedMotion],
) -> Result<Option<(Vec<TextEdit>, String)>, String> {
    let axis = &machine.axes[joint];
    let letter = axis.letter;
    let Some(column) = letter.checked_sub(b'A').map(usize::from).filter(|&column| column < 3) else {
        return Ok(None);
    };
    let known: Vec<(BlockId, f64)> = motions
        .iter()
        .filter_map(|motion| Some((motion.block, motion.rotary[column]?)))
        .collect();
    let values: Vec<f64> = known.iter().map(|&(_, value)| value).collect();
    let as_written = vec![0; values.len()];
    let before = long_way_steps(&values, &as_written);
    if before == 0 {
        return Ok(None);
    }
    let name = char::from(letter);
    refuse_what_is_not_literal(program, letter, motions)?;
    let limits = match axis.limits {
        Limits::Unbounded => None,
        Limits::Range(low, high) => Some((deg(low), deg(high))),
    };
    let turns = unwrap(&values, limits);
    let after = long_way_steps(&values, &turns);
    if after >= before {
        return Err(format!(
            "{name} turns the long way round {before} times, and its limits allow nothing else"
        ));
    }
    let mut edits = Vec::new();
    let mut last_edited = None;
    for (&(block, _), &turns) in known.iter().zip(&turns) {
        let word = words(program, block, letter).next();
        let (Some(word), true) = (word, turns != 0 && last_edited != Some(block)) else {
            continue;
        };
        let text = program.text(word.value_range);
        let new_text = add_whole(&text, 360 * turns).ok_or_else(|| {
            format!(
                "line {}: {name}{text} is not a plain decimal number",
                line(program, block)
            )
        })?;
        edits.push(TextEdit {
            range: word.value_range,
            new_text,
        });
        last_edited = Some(block);
    }
    let summary = format!(
        "{name}: {} of {before} turns of more than 180 deg now take the short way",
        before - after
    );
    Ok(Some((edits, summary)))
}

/// Words, modes and vectors whose value is not simply where the axis goes.
fn refuse_what_is_not_literal(program: &Program, letter: u8, motions: &[ProgrammedMotion]) -> Result<(), String> {
    let name = char::from(letter);
    if let Some(motion) = motions.iter().find(|motion| motion.vector) {
        return Err(format!(
            "line {}: tool vectors are programmed, so the control chooses the turns",
            line(program, motion.block)
        ));
    }
    for motion in motions.iter().filter(|motion| motion.incremental) {
        if words(program, motion.block, letter).next().is_some() {
            return Err(format!(
                "line {}: {name} is incremental (G91)",
                line(program, motion.block)
            ));
        }
    }
    for block in program.blocks() {
        for word in words(program, block.id(), letter) {
            if !matches!(word.value, Value::Number(_)) {
                let text = program.text(word.range);
                return Err(format!(
                    "line {}: {text} is not a plain number",
                    line(program, block.id())
                ));
            }
        }
        if words(program, block.id(), letter).count() > 1 {
            return Err(format!("line {}: {name} is written twice", line(program, block.id())));
        }
    }
    Ok(())
}

/// The words of an axis in a block.
fn words(program: &Program, block: BlockId, letter: u8) -> impl Iterator<Item = Word> {
    program
        .block(block)
        .words()
        .filter(move |word| word.address == Address::Letter(letter))
}

fn line(program: &Program, block: BlockId) -> u32 {
    LineIndex::new(program.source())
        .line_column(program.source(), program.block(block).range().start)
        .0
}
