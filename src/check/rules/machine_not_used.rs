//! The machine file declares something that no check uses.
//!
//! # Why
//! Anyone who declares that an axis must keep a margin to its limits expects that to be checked. A verdict must not
//! ignore it silently.
//!
//! # Example
//! The machine file says `limit_margin = 5` for A.
//!
//! ```gcode mikron-ucp710+A.limit_margin=5
//! N10 G0 X0 Y0 Z0 A0 C0
//! ;^ machine-not-used: the machine file of mikron-ucp710 declares something that is not checked: limit_margin of A
//! N20 M30
//! ```
//!
//! # Use instead
//! The program stays as it is. Without `limit_margin` in the machine file it passes:
//!
//! ```gcode mikron-ucp710
//! N10 G0 X0 Y0 Z0 A0 C0
//! N20 M30
//! ```
//!
//! # Guarantee
//! Sound for what could change a verdict of the present rules: margins to limits. `trunnion machine show` lists
//! everything else that is declared and not used yet. Each item is reported once per file, at its first byte.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let Some(machine) = overview.settings.machine else {
        return;
    };
    let first = u32::from(!overview.program.source().is_empty());
    for fact in &machine.not_judged {
        out.report(
            TextRange::new(0, first),
            format!(
                "the machine file of {} declares something that is not checked: {fact}",
                machine.id
            ),
        )
        .help("remove it from the machine file, or allow this rule if it does not matter")
        .unknown();
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;
    use crate::{Severity, Verdict};

    #[test]
    fn a_declared_margin_is_never_passed_over() {
        let text = "G0 X0 Y0 Z0 A0 C0\nM30\n";
        for (info, verdict) in [
            ("mikron-ucp710", Verdict::Pass),
            ("mikron-ucp710+A.limit_margin=5", Verdict::Unknown),
        ] {
            let report = Fixture::parse(&format!("gcode {info}"), text).check().unwrap();
            assert_eq!(
                report.verdict(Severity::Error),
                verdict,
                "{info}: {:?}",
                report.diagnostics
            );
        }
    }
}
