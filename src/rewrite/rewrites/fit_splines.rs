//! Puts short lines together into cubic curves that go on smoothly from one to the next: few blocks within a tolerance.
//!
//! # Why
//! A free-form curve as a thousand short lines makes a long file, a control that runs out of blocks, and facets on the part. Arcs need many blocks
//! for it, and their curvature jumps. A cubic curve says in one block what ten to a hundred lines say, with one tangent where two curves meet.
//!
//! # How
//! A chain of lines with one feed and nothing between them is divided at its corners (30 deg). From there each curve is made as long as it serves:
//! the cubic that comes nearest to the points, and to the middles of the lines between them (`--source chords`, the default), by least
//! squares; where two curves meet, both have the tangent of the parabola that comes nearest to seven points around. Its numbers are rounded, with one
//! digit more than those of the program, and what is then written must keep to the tolerance. A curve takes the place of four lines at least;
//! other lines stay. The ends of curves are points of the program.
//!
//! On a Sinumerik a curve is written as POLY: `PO[X]=(end,a2,a3)` is a polynomial of the third degree. On a LinuxCNC it is written as G5, in the plane of X and Y
//! (G17), if `[control] spline_arcs` declares how far the arcs that the control makes of it are from the curve; that is part of the tolerance.
//!
//! # Example
//! ```gcode before sinumerik-840d mill-3axis
//! G17 G90 G94 G71 G54
//! G0 X0 Y0 Z5 S8000 M3
//! N10 G1 Z0 F500
//! N20 X0.5000 Y0.0049
//! N30 X1.0000 Y0.0190
//! N40 X1.5000 Y0.0416
//! N50 X2.0000 Y0.0720
//! N60 X2.5000 Y0.1094
//! N70 X3.0000 Y0.1530
//! N80 X3.5000 Y0.2021
//! N90 X4.0000 Y0.2560
//! N100 G0 Z5 ; done
//! M30
//! ```
//! ```gcode after
//! G17 G90 G94 G71 G54
//! G0 X0 Y0 Z5 S8000 M3
//! N10 G1 Z0 F500
//! N20 POLY PO[X]=(2.0000,-0.00217,-0.00009) PO[Y]=(0.0720,0.07907,-0.00941)
//! N60 POLY PO[X]=(4.0000,-0.00416,0.00022) PO[Y]=(0.2560,0.05118,-0.0062)
//! N100 G0 Z5 ; done
//! M30
//! ```
//!
//! # Claim
//! The new path and the old one are nowhere farther apart than the tolerance, both walked from start to end; with `--source points` this is
//! claimed of the programmed points only. Feed, spindle, offsets and all else are the same.
//!
//! # Traps
//! - LinuxCNC runs G5 as arcs of its own, and no source says how far these are from the curve: without `[control] spline_arcs` nothing can be claimed of it.
//! - Refused by name: controls whose splines are not modelled here (G6.2 of a Fanuc, SPL of Klartext), and those that have none.
//! - A control plans its speed along a curve in another way than along lines; the programmed feed stays as it is.
//! - Left alone, with the reason: G41 and G42, G91, G93, exact stop, tool centre point control, moving rotary axes, frames.
//! - A block with a comment begins a new piece, so comments stay. Words other than a number, G1, X, Y, Z and F end a chain.
//! - After `fit-arcs` there is little left for it: ask for one of the two. In one run `fit-arcs` comes first, and curves take what is no arc.
//! - With `--source points` the lines between the points may be farther from the curve.
//!
//! # Sources
//! Schneider, An algorithm for automatically fitting digitized curves (Graphics Gems, 1990), for the least squares; Sinumerik 840D Programming Guide
//! Advanced (04.00), 5-163 to 5-167, for POLY; docs/kinematics.md#curves-through-points.
use super::Body;
use crate::chain_words::Hand;
use crate::spline::{Form, LEAST, Spline, Terms, splines};
use crate::spline_words::Pen;
use crate::style::{NumberStyle, of_letters};
use crate::{Known, Options, Place, Proposed, Refusal};
use trunnion_check::Settings;
use trunnion_dialect::{Action, Plane};
use trunnion_syntax::Program;

pub(super) const REWRITE: Body = Body {
    cures: &[],
    writes: Some("curves of G code"),
    propose,
};

/// How curves are written for a control, and how far it may be from them, mm; else why they are not.
fn form(settings: &Settings<'_>) -> Result<(Form, f64), Refusal> {
    let dialect = settings.dialect;
    if dialect.codes().iter().any(|code| code.action == Action::Polynomial) {
        return Ok((Form::Powers, 0.0));
    }
    if dialect.quirks.rs274() {
        return settings.setup.control.spline_arcs_mm.map(|mm| (Form::Handles, mm)).ok_or_else(|| {
            Refusal::missing(format!(
                "{} runs G5 as arcs of its own: declare how far they are from the curve, in mm: [control] spline_arcs, in trunnion.toml or in the machine \
                 file; or fit arcs (fit-arcs)",
                dialect.title
            ))
        });
    }
    let why = if dialect
        .codes()
        .iter()
        .any(|code| matches!(code.id.as_str(), "G6.2" | "SPL"))
    {
        "its splines (G6.2, SPL) are not modelled, so nothing could be proved"
    } else {
        "no code of it for a free curve is known here"
    };
    Err(format!("{}: {why}; fit-arcs writes arcs where it has them", dialect.title).into())
}

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, known: &Known) -> Proposed {
    let (form, control_mm) = form(settings)?;
    let found = known.chains(program, settings)?.of_at_least(LEAST);
    let style = of_letters(program, b'X'..=b'Z').unwrap_or(NumberStyle::USUAL);
    let hand = Hand::of(program);
    let pen = Pen {
        program,
        hand: &hand,
        form,
        style,
    };
    let (mut places, mut was, mut is, mut curves, mut worst) = (Vec::new(), 0, 0, 0, 0.0_f64);
    // chains that follow each other directly are one place: after a curve at the end of the first, the next begins with G1
    for group in found
        .chains
        .chunk_by(|a, b| a.next_line == b.lines.first().map(|line| line.block))
    {
        let mut written: Vec<(_, Vec<Spline>)> = Vec::new();
        for &chain in group {
            let terms = Terms {
                tolerance_mm: options.tolerance_mm,
                source: options.source,
                form,
                style,
                unit_mm: chain.unit_mm,
                control_mm,
            };
            // G5 is refused in other planes
            let in_plane = form == Form::Powers || chain.plane == Plane::Xy;
            let splines = splines(&chain.points(), &terms, &|from, to| {
                in_plane && pen.takes(chain, from, to)
            });
            let saved: usize = splines.iter().map(|spline| spline.to - spline.from - 1).sum();
            was += chain.lines.len();
            is += chain.lines.len() - saved;
            curves += splines.len();
            worst = splines.iter().map(|spline| spline.off_mm).fold(worst, f64::max);
            written.push((chain, splines));
        }
        let edits = pen.write(&written);
        if !edits.is_empty() {
            places.push(Place::around(program, edits));
        }
    }
    let summary =
        format!("{was} lines become {is} blocks, {curves} of them curves, at most {worst:.4} mm from the lines");
    found.proposal(places, summary, options)
}
