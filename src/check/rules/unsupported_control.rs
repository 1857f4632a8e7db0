//! The program is for a control that is recognised and not supported.
//!
//! # Why
//! Each control reads the same letters differently. A program that is read as if it were for another control gives findings
//! that mean nothing, or none where there should be some. So it is not read at all, and the verdict is unknown.
//!
//! # Example
//! ```gcode detected
//! %PLATE G71 *
//! ;^^^^^^^^^^^ unsupported-control: the program is for HEIDENHAIN DIN/ISO, which is not supported
//! N10 T1 G17 S2000 *
//! N20 G00 G40 G90 X+0 Y+0 Z+50 M3 *
//! N99999999 %PLATE G71 *
//! ```
//!
//! # Use instead
//! ```gcode detected
//! %
//! O1000
//! T1 M6
//! G0 G90 G54 X0. Y0.
//! M30
//! %
//! ```
//!
//! # Guarantee
//! Sound: a program that is recognised as being for one of these controls gets this finding and no other. Which control a program is
//! for is a guess from its text; `dialect` in a comment, in trunnion.toml or on the command line overrides it.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::prelude::*;
use trunnion_dialect::Foreign;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Foreign(check)]);

fn check(foreign: &Foreign, out: &mut Reporter<'_>) {
    let Foreign::Control(control) = foreign else { return };
    let line = first_line(out.program().source());
    out.report(
        line,
        format!("the program is for {}, which is not supported", control.title),
    )
    .note("nothing in it was read or checked")
    .help("if it is for another control, name that: --dialect NAME, or `(trunnion: dialect NAME)` in the program")
    .value_text("control", control.name)
    .unknown();
}

/// The first line with something in it, without blanks around it.
pub(super) fn first_line(source: &[u8]) -> TextRange {
    let start = source.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(0);
    let rest = &source[start..];
    let length = rest
        .iter()
        .position(|byte| matches!(byte, b'\n' | b'\r'))
        .unwrap_or(rest.len());
    let length = rest[..length].trim_ascii_end().len();
    TextRange::new(start as u32, (start + length) as u32)
}
