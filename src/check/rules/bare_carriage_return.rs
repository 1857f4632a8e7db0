//! Lines end with a carriage return alone.
//!
//! # Why
//! Old programs and some transfer programs end a line with CR in place of LF or CR LF. Here the file is read line by line;
//! many controls take it for one long line, and refuse it or read only its first words.
//!
//! # Example
//! ```gcode line-ends=cr
//! N10 G0 X0 Y0
//! ;^^^^^^^^^^^ bare-carriage-return: lines end with a carriage return alone
//! N20 M30
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X0 Y0
//! N20 M30
//! ```
//!
//! # Guarantee
//! Sound; reported once per file, at its first line.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let source = overview.program.source();
    let Some(at) = memchr::memchr(b'\r', source) else {
        return;
    };
    if memchr::memchr(b'\n', source).is_none() {
        out.report(TextRange::new(0, at as u32), "lines end with a carriage return alone")
            .note("the program is read line by line here; a control may take it for one long line")
            .help("save the file with the line ends LF or CR LF");
    }
}

#[cfg(test)]
mod tests {
    use crate::{Assume, Settings, Severity, Verdict, check};
    use trunnion_interp::Setup;

    #[test]
    fn the_program_is_still_read() {
        let dialect = trunnion_dialect::builtin("iso-6983").expect("built in");
        let settings = Settings {
            assume: Assume::ALL,
            ..Settings::new(dialect, trunnion_machine::builtin("mill-3axis"), Setup::default())
        };
        let found = |text: &str| {
            let report = check(
                &trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex),
                &settings,
            );
            let rules: Vec<_> = report.diagnostics.iter().map(|d| d.rule).collect();
            (rules, report.summary.motions, report.verdict(Severity::Error))
        };
        let text = "G21 M3 S100\rG0 X0 Y0 Z0\rG1 X5 F100\rM30\r";
        assert_eq!(found(text), (vec!["bare-carriage-return"], 2, Verdict::Pass));
        assert_eq!(found(&text.replace('\r', "\r\n")), (vec![], 2, Verdict::Pass));
    }
}
