//! A feed motion has no feed.
//!
//! # Why
//! The control stops with an alarm, or uses whatever feed the previous program left active. Under inverse time
//! (G93) each feed motion needs its own F.
//!
//! # Example
//! ```gcode
//! N10 G0 X0 Y0
//! N20 G1 X10
//! ;      ^^^ missing-feed: this feed motion has no feed: no F is active
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X0 Y0
//! N20 G1 X10 F500
//! ```
//!
//! # Guarantee
//! Sound: in a program without this finding each feed motion has a feed above zero, or a feed that is not modelled
//! and is reported as such.
//!
//! # Sources
//! * NISTIR 6556 (2000), sections 2.1.2.5 on feed rate and 3.5.19 on inverse time (G93).
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::Feed, plain)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::MissingFeed { inverse_time, zero } = fault.kind else {
        return;
    };
    let (message, help) = match (zero, inverse_time) {
        (true, _) => (
            "this feed motion has a feed of zero or less",
            "write a feed greater than zero",
        ),
        (false, true) => (
            "this feed motion under G93 has no F of its own",
            "write F in each feed motion, or return to G94",
        ),
        (false, false) => (
            "this feed motion has no feed: no F is active",
            "write F in this block or before it",
        ),
    };
    out.report(fault.range, message)
        .help(help)
        .merge(Merge::run(u64::from(zero), 0.0));
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn consecutive_blocks_are_told_once() {
        let report = assert_drawn(
            "gcode",
            "N10 G0 X0 Y0\nN20 G1 X10\n;      ^^^ missing-feed: this feed motion has no feed\nN30 X20\nN40 X30\nN50 X40 F100\n",
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
