//! A loop, or a chain of calls, does not end.
//!
//! # Why
//! The machine runs until someone stops it. A loop that is meant to run forever (a bar feeder, a warm-up) is
//! reported too: allow the rule there and give the reason.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 #1 = 0
//! N20 WHILE [#1 LT 3] DO 1
//! ;^^^^^^^^^^^^^^^^^^^^^^^ endless-loop: this did not end within
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
//! Where the message says that a loop never ends, this is proved: a pass returned to the same values. Other loops
//! are reported because they did not end within the limits of the run (`[limits] blocks` in `trunnion.toml`, by
//! default 1 500 000 executed blocks). A program without this finding ends, if everything in it was decided.
//!
//! # Sources
//! * docs/contract.md#limits-of-a-run
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::EndlessLoop { blocks, proved } = fault.kind else {
        return;
    };
    if proved {
        out.report(
            fault.range,
            "this never ends: one pass leaves all values as they were before",
        )
        .note("this is proved: nothing that the next pass depends on has changed, so every further pass is the same")
        .note("what comes after it was not checked")
        .help("change, inside the loop, a value that its condition tests");
    } else {
        out.report(
            fault.range,
            format!("this did not end within {blocks} executed blocks"),
        )
        .note("what comes after it was not checked")
        .help("change, inside the loop, a value that its condition tests; if the program is only long, raise `blocks` (in an editor also `steps`) of [limits] in trunnion.toml")
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
            "this never ends: one pass leaves all values as they were before"
        );
        assert!(own.notes[0].starts_with("this is proved: "), "{:?}", own.notes);
    }
}
