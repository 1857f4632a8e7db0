//! A loop, or a chain of calls, does not come to an end.
//!
//! # Why
//! The machine runs until somebody stops it. A loop that is meant to run for ever (a bar feeder, a warm-up) is told too: allow the
//! rule there with the reason.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 #1 = 0
//! N20 WHILE [#1 LT 3] DO 1
//! ;^^^^^^^^^^^^^^^^^^^^^^^ endless-loop: this did not come to an end
//! N30 #2 = #2 + 1
//! N40 END 1
//! N50 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 #1 = 0
//! N20 WHILE [#1 LT 3] DO 1
//! N30 #1 = #1 + 1
//! N40 END 1
//! N50 M30
//! ```
//!
//! # Guarantee
//! A loop of which it is said that it never ends is proved to: a pass came back to the same values. Of others it is said that they did
//! not end within the bounds of the run (`[limits] blocks` in `trunnion.toml`, else 10 000 000 executed blocks). A program that is not
//! reported ends, where everything in it was decided.
//!
//! # Sources
//! Engineering judgement.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::EndlessLoop { blocks, proved } = fault.kind else {
        return;
    };
    if proved {
        out.report(
            fault.range,
            "this never ends: a pass leaves all values as they were before it",
        )
        .note("proved: nothing that the next pass depends on has changed, so every further pass is the same")
        .note("what comes behind it was not checked")
        .help("change in the loop what its condition asks for");
    } else {
        out.report(
            fault.range,
            format!("this did not come to an end within {blocks} executed blocks"),
        )
        .note("what comes behind it was not checked")
        .help("change in the loop what its condition asks for; where it only runs long, raise `blocks` of [limits] in trunnion.toml")
        .value("executed_blocks", blocks as f64);
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;

    #[test]
    fn a_proof_is_told_as_one() {
        let found = Fixture::parse("gcode linuxcnc", "o1 while [1]\no1 endwhile\nm2\n")
            .check()
            .unwrap();
        let own = found.diagnostics.iter().find(|d| d.rule == "endless-loop").unwrap();
        assert_eq!(
            own.message,
            "this never ends: a pass leaves all values as they were before it"
        );
        assert!(own.notes[0].starts_with("proved: "), "{:?}", own.notes);
    }
}
