//! Puts short lines together into arcs, helices and longer lines: the fewest blocks within a tolerance.
//!
//! # Why
//! A curve made of a thousand short lines makes a long file, lets the control run out of blocks, and leaves facets on the part. G2 and G3 say the same in a
//! few blocks, and the control keeps its feed.
//!
//! # How
//! A chain of lines with one feed and nothing between them is divided into the fewest arcs and lines: the shortest path over its points.
//! A part may become an arc if a circle through its two ends comes near all its points (`--source points`), and also near the lines
//! between them (`--source chords`, the default). All suitable centres are found, and then one that is still suitable when its numbers are rounded to the digits of the
//! program. A part that cannot be written in this form is divided again. Where that saves blocks, arcs meet beside the points of the program,
//! within the tolerance. Lines that come back to where they began become one full circle.
//!
//! # Example
//! ```gcode before fanuc-30i mill-3axis
//! G21 G90 G94 G17 G54
//! G0 X2. Y0. Z5. S8000 M3
//! N10 G1 Z0. F500
//! N20 X1.9973 Y0.1047
//! N30 X1.9890 Y0.2091
//! N40 X1.9754 Y0.3129
//! N50 X1.9563 Y0.4158
//! N60 X1.9319 Y0.5176
//! N70 X1.9021 Y0.6180
//! N80 Y5. (to the side)
//! M30
//! ```
//! ```gcode after
//! G21 G90 G94 G17 G54
//! G0 X2. Y0. Z5. S8000 M3
//! N10 G1 Z0. F500
//! N20 G3 X1.9021 Y0.6180 I-1.9986 J0.0001
//! N80 G1 Y5. (to the side)
//! M30
//! ```
//!
//! # Claim
//! The new path and the old one are nowhere farther apart than the tolerance, both walked from start to end; with `--source points` this is
//! claimed of the programmed points only. Feed, spindle, offsets and all else are the same.
//!
//! # Traps
//! - The tolerance is measured from the program that is read. A second run measures from the output of the first and cannot know the original: it may
//!   find more, and the deviations add up, at most one tolerance for each run. Start again from the original instead.
//! - A control slows down in arcs where it does not on lines; the programmed feed stays as it is.
//! - Arcs are at most 350 degrees and 10 m in radius, or full circles.
//! - A block with a comment begins a new piece, so comments stay. Words other than a number, G1, X, Y, Z and F end a chain.
//! - On a Sinumerik arcs are only written in the active plane, because another plane changes the axis along which the tool length acts.
//! - Left alone, with the reason: G41 and G42, G91, G93, exact stop, tool centre point control, moving rotary axes, frames, G90.1.
//! - With `--source points` no arc passes a corner of more than 30 degrees.
//!
//! # Sources
//! Vickers and Bradley, curved surface machining through circular arc interpolation (1992), for arcs through points; docs/kinematics.md#arcs-through-points.
use super::Body;
use crate::chain_words::{Hand, write};
use crate::divide::divide;
use crate::pieces::Limits;
use crate::polyline::Chain;
use crate::style::{NumberStyle, of_letters};
use crate::{Known, Options, Place, Proposed};
use trunnion_check::Settings;
use trunnion_dialect::Plane;
use trunnion_syntax::Program;

pub(super) const REWRITE: Body = Body {
    cures: &[],
    writes: Some("G2 and G3 with I, J and K"),
    propose,
};

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, known: &Known) -> Proposed {
    if !program.options().format.has_words() {
        return Err("APT: arcs are not written there".into());
    }
    let found = known.chains(program, settings)?.of_at_least(2);
    let (hand, (ends, styles)) = (Hand::of(program), styles(program));
    let (mut places, mut was, mut is, mut unrounded, mut arcs) = (Vec::new(), 0, 0, 0, 0);
    // chains that follow each other directly are one place: the first may end with an arc, and then the next begins with G1
    for group in found
        .chains
        .chunk_by(|a, b| a.next_line == b.lines.first().map(|line| line.block))
    {
        let mut written = Vec::new();
        for &chain in group {
            let planes = planes(settings, chain);
            let limits = Limits {
                tolerance_mm: options.tolerance_mm,
                source: options.source,
                planes: &planes,
                styles: Some(styles),
                ends: Some(ends),
                unit_mm: chain.unit_mm,
                dialect: settings.dialect,
            };
            let divided = divide(&chain.points(), &limits);
            was += chain.lines.len();
            is += divided.pieces.len();
            unrounded += divided.unrounded;
            arcs += divided.pieces.iter().filter(|piece| piece.arc.is_some()).count();
            written.push((chain, divided.pieces));
        }
        let edits = write(program, &hand, &written);
        if !edits.is_empty() {
            places.push(Place::around(program, edits));
        }
    }
    let blocks = if is == 1 { "block" } else { "blocks" };
    let lines = if was == 1 { "line becomes" } else { "lines become" };
    let of_arcs = match (arcs, is) {
        (0, _) => "no arc".to_owned(),
        (1, 1) => "an arc".to_owned(),
        (arcs, is) if arcs == is => "all arcs".to_owned(),
        (arcs, _) => format!("{arcs} of them arcs"),
    };
    let summary = format!("{was} {lines} {is} {blocks}, {of_arcs} ({unrounded} before rounding)");
    found.proposal(places, summary, options)
}

/// Planes in which arcs may be written: first the one that is active.
fn planes(settings: &Settings<'_>, chain: &Chain) -> Vec<Plane> {
    let mut planes = vec![chain.plane];
    if !settings.dialect.quirks.user_names() {
        let others = [Plane::Xy, Plane::Zx, Plane::Yz].into_iter();
        planes.extend(others.filter(|plane| *plane != chain.plane));
    }
    planes
}

/// How X, Y and Z are written, all together, and I, J and K: like those that are there, else like the others.
fn styles(program: &Program) -> (NumberStyle, [NumberStyle; 3]) {
    let all = of_letters(program, b'X'..=b'Z').unwrap_or(NumberStyle::USUAL);
    // fewer digits than those of the coordinates would only make worse arcs
    let centres = of_letters(program, b'I'..=b'K')
        .filter(|style| style.decimals >= all.decimals)
        .unwrap_or(all);
    (all, [centres; 3])
}
