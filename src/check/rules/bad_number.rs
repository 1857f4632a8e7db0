//! A number cannot be read.
//!
//! # Why
//! The number has two decimal points, a sign without digits, or more digits than can be stored exactly. Controls
//! cut off such a number in different places, and the axis moves to a different position.
//!
//! # Example
//! ```gcode
//! N10 G0 X1.2.3
//! ;       ^^^^^ bad-number: `1.2.3` is not a number
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X1.23
//! ```
//!
//! # Guarantee
//! Sound: a number that is not reported here is stored exactly as written.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.3.2.1 on numbers.
use crate::prelude::*;
use trunnion_dialect::Language;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Text(check), Wake::Refused(Refusal::Number, plain)]);

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    if error.kind == SyntaxErrorKind::BadNumber && out.is_slip(error.range) {
        return;
    }
    let text = out.text(error.range);
    // each sign of a LinuxCNC program turns what follows (rs274: `X--1` is X1)
    let digits = text.trim_start_matches(['+', '-', ' ', '\t']);
    if out.dialect().quirks.language == Language::Linuxcnc && digits.len() < text.len() && digits.parse::<f64>().is_ok()
    {
        return;
    }
    match error.kind {
        SyntaxErrorKind::BadNumber => {
            out.report(error.range, format!("`{text}` is not a number"))
                .help("write at most 18 digits, with at most one decimal point and one leading sign");
        }
        SyntaxErrorKind::BlankInNumber => {
            out.report(error.range, format!("the number `{text}` contains blanks"))
                .note("some controls join the digits, others read two numbers")
                .help("remove the blanks");
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;

    #[test]
    fn linuxcnc_reads_several_signs() {
        let found = |fixture: &str, word: &str| {
            let text = format!("G21 G90 G94\nG0 {word} Y0 Z0\nM2\n");
            let report = Fixture::parse(fixture, &text).check().expect("a report");
            report.diagnostics.iter().any(|found| found.rule == "bad-number")
        };
        assert!(!found("gcode linuxcnc", "X--1") && !found("gcode linuxcnc", "X+-.5"));
        assert!(found("gcode linuxcnc", "X--") && found("gcode linuxcnc", "X--1.2.3"));
        assert!(found("gcode grbl", "X--1") && found("gcode fanuc-30i", "X--1."));
    }
}
