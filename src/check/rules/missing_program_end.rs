//! The program has no end code.
//!
//! # Why
//! A file without M2 or M30 may be cut short, and the control does not stop the spindle and coolant. LinuxCNC
//! refuses such a file unless it is framed by `%`.
//!
//! # Example
//! ```gcode
//! N10 G0 X0 Y0
//! N20 M5
//! ;^^^^^ missing-program-end: the program ends without an end code
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X0 Y0
//! N20 M5
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound for the end codes of the dialect's table. An error on LinuxCNC, a warning elsewhere.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.6.1 on program ending (M2, M30), and on files framed by `%`.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(
    Warning,
    &[Wake::Fault(check), Wake::Refused(Refusal::ProgramEnd, plain)],
);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::MissingProgramEnd {
        let strict = out.dialect().quirks.rs274();
        let draft = out.report(fault.range, "the program ends without an end code");
        draft
            .note("the file may be incomplete")
            .help("end the program with M30, or with the code that your control expects");
        if strict {
            draft.severity(Error);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::Severity;
    use crate::fixture::assert_drawn;

    #[test]
    fn linuxcnc_refuses_it() {
        let report = assert_drawn("gcode linuxcnc", "G0 X0\nM5\n;^ missing-program-end: \n");
        assert_eq!(report.diagnostics[0].severity, Severity::Error);
    }
}
