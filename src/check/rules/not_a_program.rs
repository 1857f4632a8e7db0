//! The file is not an NC program: it is a picture, a binary, prose or source code.
//!
//! # Why
//! A folder of programs holds other files too, and a wrong file may be sent to a machine. Nothing in it can be checked, and
//! a list of a thousand strange characters would not help.
//!
//! # Example
//! ```gcode detected
//! Dear colleague,
//! ;^^^^^^^^^^^^^^ not-a-program: this is text that is not a program
//! here is the program that you asked for.
//! Please run it slowly the first time.
//! ```
//!
//! # Use instead
//! ```gcode detected
//! (here is the program that you asked for)
//! G21 G90
//! G0 X0 Y0
//! M30
//! ```
//!
//! # Guarantee
//! Sound: a file that is recognised as not being a program gets this finding and no other. A text is taken as prose if hardly any line is
//! a block and no sign of a control is in it. If the settings or the command line name a dialect, only a text of plain sentences, a document of another
//! kind or data is taken as no program.
//!
//! # Sources
//! * docs/contract.md#verdicts
use super::unsupported_control::first_line;
use crate::prelude::*;
use trunnion_dialect::Foreign;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Foreign(check)]);

fn check(foreign: &Foreign, out: &mut Reporter<'_>) {
    let Foreign::NotAProgram(what) = foreign else { return };
    let source = out.program().source();
    let is_text = core::str::from_utf8(&source[..source.len().min(64)]).is_ok();
    let range = if is_text {
        first_line(source)
    } else {
        TextRange::new(0, u32::from(!source.is_empty()))
    };
    let (what, help) = if crate::unreadable::is_utf16(source) {
        (
            "this file is UTF-16, which no control reads".to_owned(),
            "save it as UTF-8 or ASCII",
        )
    } else {
        (format!("this is {what}"), "name the program, or leave this file out")
    };
    out.report(range, what)
        .note("nothing in it was checked")
        .help(help)
        .unknown();
}
