//! A feed motion has no feed.
//!
//! # Why
//! The control stops with an alarm, or runs at whatever feed was left in force by the program before.
//! Under inverse time (G93) each feed motion needs an F of its own.
//!
//! # Example
//! ```gcode
//! N10 G0 X0 Y0
//! N20 G1 X10
//! ;      ^^^ missing-feed: a feed motion, but no feed is programmed
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X0 Y0
//! N20 G1 X10 F500
//! ```
//!
//! # Guarantee
//! Sound: in a program that is not reported each feed motion has a feed above zero, or a feed that is not modelled and said
//! to be so.
//!
//! # Sources
//! The NIST RS274/NGC interpreter, version 3, on feed rate and inverse time (G93).
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::MissingFeed { inverse_time, zero } = fault.kind else {
        refused(fault, out, &[Refusal::Feed]);
        return;
    };
    let (message, help) = match (zero, inverse_time) {
        (true, _) => ("a feed motion at a feed of zero or less", "write a feed above zero"),
        (false, true) => (
            "a feed motion under G93 without its own F",
            "write F in each feed motion, or go back to G94",
        ),
        (false, false) => (
            "a feed motion, but no feed is programmed",
            "write F in this block or before it",
        ),
    };
    out.report(fault.range, message).help(help).merge(u64::from(zero), 0.0);
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn consecutive_blocks_are_told_once() {
        let report = assert_drawn(
            "gcode",
            "N10 G0 X0 Y0\nN20 G1 X10\n;      ^^^ missing-feed: a feed motion, but no\nN30 X20\nN40 X30\nN50 X40 F100\n",
        );
        assert_eq!(report.diagnostics[0].count, 3);
    }

    #[test]
    fn inverse_time_wants_its_own_feed() {
        assert_drawn(
            "gcode linuxcnc",
            "G0 X0 Y0 Z0\nG93 G1 X10 F2\nX20\n;^^ missing-feed: F word missing with inverse time\nM2\n",
        );
    }
}
