//! Gives the blocks new numbers, one after the other, with every jump and return that names one.
//!
//! # Why
//! After other rewrites, or by hand, block numbers have gaps, repeat or run backwards. An operator who searches for a block, and a control that
//! restarts at one, need them in order.
//!
//! # How
//! The first block that has a number gets 10, the next one 20, and so on; blocks without a number stay without. Jumps, returns and contours
//! that name a block follow it. `trunnion fmt --renumber` does the same with other first numbers and steps.
//!
//! # Example
//! ```gcode before fanuc-30i mill-3axis
//! G21 G90 G94 G17 G54
//! N5 G0 X0. Y0. Z5. S8000 M3
//! N7 G1 Z0. F500
//! N7 X10.
//! Y10.
//! N3 G0 Z5.
//! N9 M30
//! ```
//! ```gcode after
//! G21 G90 G94 G17 G54
//! N10 G0 X0. Y0. Z5. S8000 M3
//! N20 G1 Z0. F500
//! N30 X10.
//! Y10.
//! N40 G0 Z5.
//! N50 M30
//! ```
//!
//! # Claim
//! The programs do the same, motion for motion; and each reference to a number means the block that it meant before.
//!
//! # Traps
//! - Another program that jumps to a number of this one is not known here.
//! - A computed target, or a number that occurs twice and is the target of a jump, is refused.
//!
//! # Sources
//! src/layout/renumber.rs, which `trunnion fmt --renumber` uses too.
use super::Body;
use crate::{Known, Options, Place, Proposal, Proposed};
use trunnion_certify::Claim;
use trunnion_check::Settings;
use trunnion_layout::{Numbers, Renumbered};
use trunnion_syntax::{LineIndex, Program, TextEdit, parse};

pub(super) const REWRITE: Body = Body {
    cures: &[],
    writes: None,
    propose,
};

/// First number and step: room for blocks that are added by hand.
const NUMBERS: Numbers = Numbers { start: 10, step: 10 };

fn propose(program: &Program, settings: &Settings<'_>, _: &Options, _: &Known) -> Proposed {
    let line = |offset: u32| LineIndex::new(program.source()).line_column(program.source(), offset).0;
    match trunnion_layout::renumber(program, settings.dialect, &settings.setup, NUMBERS) {
        Renumbered::NoNumbers => Ok(None),
        Renumbered::Refused(obstacle) => Err(format!("line {}: {}", line(obstacle.range.start), obstacle.why).into()),
        Renumbered::Differs(found) => Err(format!("the numbers matter: {}", found.what).into()),
        Renumbered::Changed {
            text,
            blocks,
            references,
            ..
        } => {
            let after = parse(text, program.options());
            let pairs = program.blocks().zip(after.blocks());
            let edits: Vec<TextEdit> = pairs
                .filter(|(old, new)| program.bytes(old.range()) != after.bytes(new.range()))
                .map(|(old, new)| TextEdit {
                    range: old.range(),
                    new_text: after.text(new.range()).into_owned(),
                })
                .collect();
            Ok((!edits.is_empty()).then(|| Proposal {
                places: vec![Place::around(program, edits)],
                claim: Claim::SameToolPath {
                    tolerance_mm: 1e-9,
                    tolerance_deg: 1e-9,
                },
                summary: format!("{blocks} blocks numbered, {references} references followed"),
            }))
        }
    }
}
