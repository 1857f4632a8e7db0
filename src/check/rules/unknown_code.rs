//! The dialect has no such code.
//!
//! # Why
//! The control stops or, worse, uses that code number for something else: what follows cannot be judged. M codes
//! that a control leaves to the machine builder are not an error, but their effect is unknown.
//!
//! # Example
//! ```gcode
//! N10 G0 G198 X10
//! ;      ^^^^ unknown-code: iso-6983 has no code G198
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10
//! ```
//!
//! # Guarantee
//! Sound for the dialect's table; the table gives the source of each code.
//!
//! # Sources
//! * grammar/README.md, the dialect tables and their sources.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    const HELP: &str = "correct the code, or name the dialect of the program: --dialect NAME";
    let text = out.text(fault.range);
    let dialect = &out.dialect().name;
    let message = format!("{dialect} has no code {text}");
    let once = hash(&text);
    if let Some(draft) = out.refused(fault, Refusal::UnknownCode) {
        draft.say(message).help(HELP).merge(Merge::run(once, 0.0));
        return;
    }
    match fault.kind {
        FaultKind::UnknownCode { machine_builder: true } => {
            out.report(
                fault.range,
                format!("{dialect} leaves {text} to the machine builder: its effect is unknown"),
            )
            .note("it is assumed to move nothing and to change nothing that is checked")
            .help(format!(
                "if it is harmless, say so: (trunnion: allow unknown-code because {text} only ...)"
            ))
            .unknown()
            .merge(Merge::once(once));
        }
        FaultKind::UnknownCode { machine_builder: false } => {
            out.report(fault.range, message)
                .note("it is ignored: the rest is checked as if it were not there")
                .help(HELP)
                .merge(Merge::run(once, 0.0));
        }
        _ => {}
    }
}
