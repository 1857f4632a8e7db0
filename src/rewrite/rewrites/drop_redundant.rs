//! Drops points on straight lines, blocks that move nothing, and words that repeat what is in effect.
//!
//! # Why
//! A post processor that writes every point of a straight line, every coordinate and every G1 makes files longer than they need to be.
//! Each block costs the control time, and hides from the reader what changes.
//!
//! # How
//! In a chain of lines with one feed and nothing between them, points on the straight line between two others are left out: the fewest lines
//! are found. Without `--tolerance-mm` only points that are on the line exactly (to a billionth of their coordinates). Then words of X, Y and Z that
//! repeat the position are deleted, then G1 and F that are already in effect, then blocks of which nothing is left.
//!
//! # Example
//! ```gcode before fanuc-30i mill-3axis
//! G21 G90 G94 G17 G54
//! G0 X0. Y0. Z5. S8000 M3
//! N10 G1 Z0. F500
//! N20 G1 X1. Y0.5 Z0. F500
//! N30 G1 X2. Y1. Z0. F500
//! N40 G1 X3. Y1.5 Z0. F500
//! N50 G1 X3. Y1.5 Z0. F500
//! N60 G1 X3. Y4. Z0. F500 (up)
//! M30
//! ```
//! ```gcode after
//! G21 G90 G94 G17 G54
//! G0 X0. Y0. Z5. S8000 M3
//! N10 G1 Z0. F500
//! N20 X3. Y1.5
//! N60 G1 Y4. F500 (up)
//! M30
//! ```
//!
//! # Claim
//! Feed, spindle, offsets and all else are the same at each point of the path, and the path is the same within the tolerance, or to a millionth of
//! a mm without one.
//!
//! # Traps
//! - A program that is started in the middle relies on repeated words: after this rewrite begin at a block that contains all that it needs.
//! - Blocks with a comment and blocks with other words stay; only X, Y and Z are deleted there where they repeat the position.
//! - Left alone, with the reason: G91, G93, exact stop, G41 and G42, moving rotary axes, frames.
//!
//! # Sources
//! docs/kinematics.md#arcs-through-points: fewest pieces as a shortest path.
use super::Body;
use crate::chain_words::{Hand, lean};
use crate::divide::divide;
use crate::pieces::Limits;
use crate::{Known, Options, Place, Proposal, Proposed};
use trunnion_certify::{Claim, RefitSource};
use trunnion_check::Settings;
use trunnion_geometry::Vec3;
use trunnion_interp::{block_numbers, may_return_to_numbers};
use trunnion_syntax::Program;

pub(super) const REWRITE: Body = Body {
    cures: &[],
    writes: Some("blocks and words of G1"),
    propose,
};

/// Points are on a line exactly if they are no farther from it than this share of the largest coordinate.
const EXACT: f64 = 1e-9;

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, known: &Known) -> Proposed {
    if !program.options().format.has_words() {
        return Err("APT: only G code has words that repeat".into());
    }
    if let Some(missing) = may_return_to_numbers(program, settings.dialect, &settings.setup)
        && block_numbers(program).next().is_some()
    {
        return Err(format!(
            "{missing} is missing, and may return to any block number (M99 P): what repeats there may be new"
        )
        .into());
    }
    let hand = Hand::of(program);
    let (mut places, mut was, mut is, mut bytes) = (Vec::new(), 0, 0, 0);
    for chain in &known.chains(program, settings)?.chains {
        let points = chain.points();
        let largest = points.iter().map(Vec3::amax).fold(1.0, f64::max);
        let limits = Limits {
            tolerance_mm: options.given_mm.unwrap_or(EXACT * largest),
            source: RefitSource::Chords,
            planes: &[],
            styles: None,
            ends: None,
            unit_mm: chain.unit_mm,
            dialect: settings.dialect,
        };
        let divided = divide(&points, &limits);
        was += chain.lines.len();
        is += divided.pieces.len();
        let edits = lean(program, &hand, chain, &divided.pieces);
        if !edits.is_empty() {
            let saved = edits
                .iter()
                .map(|edit| i64::from(edit.range.end - edit.range.start) - edit.new_text.len() as i64);
            bytes += saved.sum::<i64>();
            places.push(Place::around(program, edits));
        }
    }
    if places.is_empty() {
        return Ok(None);
    }
    Ok(Some(Proposal {
        places,
        claim: Claim::RefittedPath {
            tolerance_mm: options.given_mm.unwrap_or(0.0).max(1e-6),
            source: RefitSource::Chords,
        },
        summary: format!("{was} lines become {is}, {bytes} bytes less"),
    }))
}
