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
//! and is reported as such. Of a subprogram that is checked alone, the caller's F is unknown.
//!
//! # Sources
//! * NISTIR 6556 (2000), sections 2.1.2.5 on feed rate and 3.5.19 on inverse time (G93).
use crate::caller::Part;
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::Feed, plain)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::MissingFeed { inverse_time, zero } = fault.kind else {
        return;
    };
    if !zero && !inverse_time && out.part() == Part::Called {
        out.report(
            fault.range,
            "it is not known whether this feed motion has a feed: the subprogram gives no F before it",
        )
        .note("F may be active in the program that calls it")
        .help("check the program that calls this one, with this file in its folder or under `subprogram_path`")
        .unknown()
        .merge(Merge::once(0));
        return;
    }
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
    fn the_caller_of_a_subprogram_may_give_the_feed() {
        for (dialect, text) in [
            (
                "sinumerik-840d",
                "G71 G90 G0 X0\nG1 X5\n;  ^^ missing-feed: it is not known\nG1 X7\nM17\n",
            ),
            (
                "fanuc-30i",
                "O7\nG21 G90 G0 X0.\nG1 X5.\n;  ^^^ missing-feed: it is not known\nG1 X7.\nM99\n;^^ not-modelled: not modelled: M99\n",
            ),
        ] {
            let report = assert_drawn(&format!("gcode {dialect}"), text);
            assert_eq!(report.diagnostics[0].status, crate::Status::Unknown);
        }
        assert_drawn(
            "gcode fanuc-30i",
            "O7\nG21 G0 X0.\nG1 X5.\n;  ^^^ missing-feed: this feed motion has no feed\nM30\n",
        );
    }

    #[test]
    fn inverse_time_wants_its_own_feed() {
        assert_drawn(
            "gcode linuxcnc",
            "G0 X0 Y0 Z0\nG93 G1 X10 F2\nX20\n;^^ missing-feed: F word missing with inverse time\nM2\n",
        );
    }
}
