//! Programs with blocks that begin with `/`, where the state of the switch for block delete is not declared: a claim holds in both states.
use crate::certificate::{Worst, WorstChanges};
use crate::{Gap, Outcome};
use trunnion_dialect::Dialect;
use trunnion_interp::deleted_levels;
use trunnion_syntax::parse;

/// The switches that the blocks with `/` of both programs belong to, by their numbers.
pub(crate) fn switches(texts: [&[u8]; 2], dialects: [&Dialect; 2]) -> Vec<u8> {
    let mut levels: Vec<u8> = Vec::new();
    for (text, dialect) in texts.into_iter().zip(dialects) {
        if text.contains(&b'/') {
            levels.extend(deleted_levels(&parse(text.to_vec(), dialect.lex), dialect).0);
        }
    }
    levels.sort_unstable();
    levels.dedup();
    levels
}

/// Two states are compared: all blocks with `/` run, or none. Several switches have more.
pub(crate) fn at_most_one(switches: &[u8]) -> Result<(), Outcome> {
    if switches.len() < 2 {
        return Ok(());
    }
    let switches: Vec<String> = switches.iter().map(u8::to_string).collect();
    Err(Outcome::unknown(format!(
        "blocks with / belong to several switches ({}), and not all of their states are compared: declare the state of block delete (--block-delete)",
        switches.join(", ")
    )))
}

/// What does not hold where the blocks are skipped.
pub(crate) fn where_skipped(outcome: Outcome) -> Outcome {
    let place = "where blocks with / are skipped (whether they are is not declared: --block-delete), ";
    match outcome {
        Outcome::Refuted(mut witness) => {
            witness.message.insert_str(0, place);
            Outcome::Refuted(witness)
        }
        Outcome::Unknown(Gap { line, message }) => Outcome::Unknown(Gap {
            line,
            message: format!("{place}{message}"),
        }),
        proved @ Outcome::Proved(_) => proved,
    }
}

impl WorstChanges {
    /// Keeps the larger of each value.
    pub(crate) fn join(&mut self, other: &Self) {
        let Self {
            point_shift_mm,
            tip_shift_mm,
            axis_change_deg,
            path_bound_mm,
            path_axis_bound_deg,
            forward_residual_mm,
            forward_residual_deg,
        } = self;
        let larger = |own: &mut Worst, other: &Worst| {
            if other.value > own.value {
                *own = *other;
            }
        };
        larger(point_shift_mm, &other.point_shift_mm);
        larger(tip_shift_mm, &other.tip_shift_mm);
        larger(axis_change_deg, &other.axis_change_deg);
        larger(path_bound_mm, &other.path_bound_mm);
        larger(path_axis_bound_deg, &other.path_axis_bound_deg);
        larger(forward_residual_mm, &other.forward_residual_mm);
        larger(forward_residual_deg, &other.forward_residual_deg);
    }
}
