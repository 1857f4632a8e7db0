//! The dialect knows no such code.
//!
//! # Why
//! The control stops, or, worse, has a code of that number that does something else: what follows cannot be judged.
//! M codes that a control leaves to the machine builder are no error, but what they do is not known.
//!
//! # Example
//! ```gcode
//! N10 G0 G198 X10
//! ;      ^^^^ unknown-code: iso-6983 knows no code G198
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10
//! ```
//!
//! # Guarantee
//! Sound for the dialect's table; the table says where each code comes from.
//!
//! # Sources
//! The dialect tables in `grammar/dialects`.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let text = out.text(fault.range);
    let dialect = out.dialect().to_owned();
    let FaultKind::UnknownCode { machine_builder } = fault.kind else {
        let message = format!("{dialect} knows no code {text}");
        if let Some(draft) = refused(fault, out, &[Refusal::UnknownCode]) {
            draft
                .reword(message)
                .help("correct the code, or name the dialect the program is written in: --dialect NAME")
                .merge(hash(&text), 0.0);
        }
        return;
    };
    if machine_builder {
        out.report(
            fault.range,
            format!("{dialect} leaves {text} to the machine builder: what it does is not known"),
        )
        .note("it is taken to move nothing and to change nothing that is checked")
        .help(format!(
            "if it is harmless, say so: (trunnion: allow unknown-code because {text} only ...)"
        ))
        .unknown()
        .merge_everywhere(hash(&text));
    } else {
        out.report(fault.range, format!("{dialect} knows no code {text}"))
            .note("it is not run; what follows is checked as if it were not there")
            .help("correct the code, or name the dialect the program is written in: --dialect NAME")
            .merge(hash(&text), 0.0);
    }
}
