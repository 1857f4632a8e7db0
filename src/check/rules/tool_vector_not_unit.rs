//! The length of a tool vector is not 1.
//!
//! # Why
//! A vector of length 1 gives a direction. Another length means that a digit is wrong or missing, and then the
//! direction is wrong too. A vector of length zero has no direction at all.
//!
//! # Example
//! ```gcode apt
//! FEDRAT/500
//! MULTAX/ON
//! GOTO/0,0,10,0,0.6,0.9
//! $$   ^^^^^^^^^^^^^^^^ tool-vector-not-unit: the tool vector has length 1.082
//! FINI
//! ```
//!
//! # Use instead
//! ```gcode apt
//! MULTAX/ON
//! GOTO/0,0,10,0,0.6,0.8
//! FINI
//! ```
//!
//! # Guarantee
//! Sound for APT, LN and G43.5. The length of A3= B3= C3= means nothing, so only a zero vector is reported there.
//! The direction is used as it is, scaled to length 1.
//!
//! # Thresholds
//! A warning above 0.0001, an error above 0.01; a zero vector is an error.
//!
//! # Sources
//! * docs/kinematics.md#tool-vectors
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Fault(check)]);

/// Above this difference from 1 it is a warning.
const WARNING: f64 = 1e-4;
/// Above this difference from 1 it is an error.
const ERROR: f64 = 1e-2;

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::VectorNotUnit { norm } = fault.kind else {
        return;
    };
    let off = (norm - 1.0).abs();
    if norm > 0.0 && off <= WARNING {
        return;
    }
    let message = if norm > 0.0 {
        // near 1 the digits that differ must be seen
        let length = if off > ERROR {
            number(norm)
        } else {
            format!("{norm:.6}")
        };
        format!("the tool vector has length {length}, not 1")
    } else {
        "the tool vector has length 0 and therefore no direction".to_owned()
    };
    let draft = out.report(fault.range, message);
    draft
        .help("correct its components: the sum of their squares must be 1")
        .value("norm", norm)
        .merge(Merge::run(0, off));
    if off > ERROR {
        draft.severity(Error);
    }
}

#[cfg(test)]
mod tests {
    use crate::Severity;

    #[test]
    fn the_digits_that_differ_are_told() {
        let text = "MULTAX/ON\nGOTO/0,0,10,0,0,1.00025\nFINI\n";
        let report = crate::fixture::Fixture::parse("gcode apt", text).check().unwrap();
        let found = report.diagnostics.iter().find(|d| d.rule == "tool-vector-not-unit");
        assert_eq!(found.unwrap().message, "the tool vector has length 1.000250, not 1");
    }

    #[test]
    fn two_thresholds() {
        for (k, severity) in [
            ("0.80009", None),
            ("0.801", Some(Severity::Warning)),
            ("0.82", Some(Severity::Error)),
        ] {
            let text = format!("MULTAX/ON\nGOTO/0,0,10,0,0.6,{k}\nFINI\n");
            let report = crate::fixture::Fixture::parse("gcode apt", &text).check().unwrap();
            let found = report
                .diagnostics
                .iter()
                .find(|d| d.rule == "tool-vector-not-unit")
                .map(|d| d.severity);
            assert_eq!(found, severity, "{k}: {:?}", report.diagnostics);
        }
    }
}
