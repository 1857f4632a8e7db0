//! A block contains a word that nothing in it uses.
//!
//! # Why
//! The word had a purpose: a code is missing next to it, or the letter is wrong. LinuxCNC refuses the block (`P word
//! with no G2 G3 G4 ... to use it`), and so does grbl (error 36); other controls skip the word.
//!
//! # Example
//! ```gcode linuxcnc
//! G0 X10 P2
//! ;      ^^ unused-word: P word with no G2 G3 G4
//! M2
//! ```
//!
//! # Use instead
//! ```gcode linuxcnc
//! G0 X10
//! G4 P2
//! M2
//! ```
//!
//! # Guarantee
//! Sound for LinuxCNC and grbl, which refuse such a block: an error there. Elsewhere the control skips the word: a
//! warning where neither a code of the block nor an active code uses the address. Words next to codes of the machine
//! builder, and next to codes that are not modelled, are not judged. On a Sinumerik, where the program defines
//! single letters itself, nothing is judged.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
//! * Grbl 1.1 (2017): error 36.
//! * grammar/README.md, the addresses of each code in the Fanuc and Haas tables.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::UnusedWord, help)]);

fn help(draft: &mut Draft<'_>) {
    draft.help("remove the word, or add the code that it belongs to");
}

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::UnusedWord {
        let text = out.text(fault.range);
        let text = text.trim();
        let draft = out.report(
            fault.range,
            format!("`{text}` is not used by any code of the block or any active code"),
        );
        draft
            .severity(Warning)
            .note("the control ignores it, or uses it in an unknown way")
            .merge(Merge::runs(hash(text), 0.0));
        help(draft);
    }
}

#[cfg(test)]
mod tests {
    use crate::Severity;
    use crate::fixture::assert_drawn;

    #[test]
    fn where_the_control_skips_it_it_is_a_warning() {
        let report = assert_drawn(
            "gcode fanuc-30i",
            "G1 X1. F100. R5.\n;            ^^^ unused-word: `R5.` is not used by any code of the block or any active code\nG4 P100 Q1\n;       ^^ unused-word: \n",
        );
        assert!(
            report
                .diagnostics
                .iter()
                .all(|found| found.severity == Severity::Warning)
        );
    }

    #[test]
    fn what_the_control_refuses_is_an_error() {
        let report = assert_drawn("gcode grbl", "G1 X1 F100 P5\n;          ^^ unused-word: \n");
        assert_eq!(report.diagnostics[0].severity, Severity::Error);
    }

    #[test]
    fn what_codes_read_is_no_finding() {
        for program in [
            "G43 H1 Z5.\nG41 D2 X1. F100.\nG1 X5.\nG40 X0.\n",
            "G17 G2 X10. Y0. I5. J0. F100.\nG18 G3 X0. Z0. R5.\n",
            "G0 Z9.\nG98 G83 X1. Y2. Z-5. R1. Q1. F100. K2\nX5.\nR2. Q0.5\nX7.\nG80\n",
            "G68 X0. Y0. R45.\nG69\nG10 L2 P1 X0.\nM19 R90.\nG4 X1.5\n",
        ] {
            let fixture = crate::fixture::Fixture::parse("gcode fanuc-30i", program);
            let report = fixture.check().unwrap();
            let found: Vec<_> = report
                .diagnostics
                .iter()
                .filter(|found| found.rule == "unused-word")
                .collect();
            assert!(found.is_empty(), "{program}: {found:?}");
        }
    }

    #[test]
    fn the_centre_out_of_the_plane_and_words_in_calls() {
        assert_drawn(
            "gcode haas-ngc",
            "G17 G2 X0. Y0. I5. K1. F100.\n;                  ^^^ unused-word: \n",
        );
    }
}
