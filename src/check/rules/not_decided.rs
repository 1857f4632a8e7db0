//! Where the program continues depends on something that is unknown here.
//!
//! # Why
//! A condition on a probed value, a machine input or the time of day is decided at the machine. What runs after it
//! was not checked, and a verdict must not rest on a guess.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 IF [#1000 EQ 1] GOTO 30
//! ;      ^^^^^^^^^^^^ not-decided: where the program continues depends on #1000
//! N20 G0 X10.
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 #1 = 1
//! N15 IF [#1 EQ 1] GOTO 30
//! N20 G0 X10.
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound: a program without this finding was followed to its end, on the only path that it can take.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::config::declaration;
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::NotDecided { what } = &fault.kind {
        // a reason may be a whole sentence: `whether this branch runs depends on #1`
        let message = if what.contains(" depends on ") {
            what.clone()
        } else {
            format!("where the program continues depends on {what}")
        };
        let declaration = declaration(what, out.dialect());
        out.report(fault.range, message)
            .note("what runs after it was not checked")
            .help(match declaration {
                Some(line) => format!(
                    "declare the value if it is known ([variables] in trunnion.toml: {line}), or check the program that sets it or calls this one"
                ),
                None => "check the program that sets the value or calls this one, or check this part with the value written into it"
                    .to_owned(),
            })
            .unknown();
    }
}
