//! The program would mean something else, or be refused, on a control that it is to be moved to.
//!
//! # Why
//! Controls read the same text differently: a dwell is in seconds on one and in milliseconds on another, `AND`
//! binds before or after a comparison, a repeated word wins or stops the machine. The rule is silent until
//! `trunnion.toml` says `port_to = ["linuxcnc"]`, or the command line says `--port-to linuxcnc`. Then it compares
//! the two controls, place by place.
//!
//! # Example
//! ```gcode fanuc-30i port=linuxcnc
//! N10 G4 P500
//! ;      ^^^^ porting: on linuxcnc P of G4 is in seconds
//! N20 #1 = FIX[#2]
//! ;        ^^^ porting: on linuxcnc FIX rounds down: FIX[-2.8] is -3 there, -2 here
//! N30 #3 = [#4 MOD 3]
//! ;            ^^^ porting: on linuxcnc MOD has another sign for negative numbers
//! N50 M30
//! ```
//! ```gcode linuxcnc port=fanuc-30i
//! G21 G90 G0 X10 Y0.5 ; to the start
//! ;          ^^^ porting: on fanuc-30i a parameter decides whether `X10` means millimetres
//! ;                   ^^^^^^^^^^^^^^ porting: on fanuc-30i `;` does not begin a comment
//! #1 = [2**3]
//! ;      ^^ porting: on fanuc-30i there is no operator `**`
//! #<depth> = 5
//! ;^^^^^^^ porting: on fanuc-30i parameters cannot have names in `< >`
//! M2
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i port=linuxcnc
//! N10 G4 X0.5
//! N20 #1 = ABS[#2]
//! N50 M30
//! ```
//!
//! # Guarantee
//! Heuristic: the differences on the list are reported, but there are more. Check the program in the other dialect
//! too.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
//! * FANUC Series 16i/18i-PB B-63684EN/01: custom macro.
//! * grammar/dialects/fanuc-30i.toml and grammar/dialects/linuxcnc.toml, the two tables.
use crate::prelude::*;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Port(crate::porting::report)]);

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    #[test]
    fn nothing_is_said_unless_asked() {
        assert_drawn("gcode fanuc-30i", "N10 G4 P500\nN50 M30\n");
        assert_drawn("gcode fanuc-30i port=fanuc-30i", "N10 G4 P500\nN50 M30\n");
    }

    fn ported(info: &str, line: &str) -> Vec<String> {
        let report = Fixture::parse(info, line).check().unwrap();
        let found = report.diagnostics.into_iter().filter(|found| found.rule == "porting");
        found.map(|found| line[found.range.as_usize()].to_owned()).collect()
    }

    #[test]
    fn logic_that_is_grouped_otherwise_is_told_and_bracketed_logic_not() {
        for (text, expected) in [
            ("#1=[#2 EQ 1 AND #3 EQ 2]\n", &["AND"][..]),
            ("#1=[[#2 EQ 1] AND [#3 EQ 2]]\n", &[]),
            ("#1=[1 OR 0 AND 0]\n", &["OR"]),
            ("#1=[1 OR 0 XOR 0]\n", &[]),
            ("#1=[1+2 OR -4]\n", &["OR"]),
            ("#1=[#2 AND -4]\n", &[]),
            ("(IF A AND B EQ C [#1 EQ 2 AND 3])\n", &[]),
        ] {
            assert_eq!(ported("gcode linuxcnc port=fanuc-30i", text), expected, "{text}");
            assert_eq!(ported("gcode fanuc-30i port=linuxcnc", text), expected, "{text}");
        }
    }

    #[test]
    fn words_and_marks_that_the_other_control_refuses() {
        for (text, expected) in [
            ("G0 X1. X2.\n", &["X2."][..]),
            ("G0 X1. / Y2.\n", &["/"]),
            ("/G0 X[1/2]\n", &[]),
            ("G65 P9010 A1.\n", &["G65"]),
            ("G0 G1 X1. F100.\n", &["G1"]),
            ("IF [#1 EQ 2] GOTO 10\n", &["GOTO"]),
        ] {
            assert_eq!(ported("gcode fanuc-30i port=linuxcnc", text), expected, "{text}");
        }
        for (text, expected) in [
            ("o100 while [#1 LT 3]\n", &["o100 while [#1 LT 3]"][..]),
            ("o<drill> call [1]\n", &["o<drill> call [1]"]),
            ("G4 P0.5\n", &["P0.5"]),
            ("G0 X1. (a; b)\n", &[]),
        ] {
            assert_eq!(ported("gcode linuxcnc port=fanuc-30i", text), expected, "{text}");
        }
    }

    /// Each lint with a wrong and a right line, in both directions where both controls accept the line: what changes when moving from
    /// Fanuc also changes when moving from LinuxCNC.
    #[test]
    fn wrong_and_right_in_both_directions() {
        const THERE: &str = "gcode fanuc-30i port=linuxcnc";
        const BACK: &str = "gcode linuxcnc port=fanuc-30i";
        for (wrong, what, right) in [
            ("#1=FIX[#2]\n", "FIX", "#1=ROUND[#2]\n"),
            ("#1=FUP[#2]\n", "FUP", "#1=ABS[#2]\n"),
            ("#1=[#2 MOD 3]\n", "MOD", "#1=[#2 / 3]\n"),
            ("#1=[#2 OR #3 AND #4]\n", "OR", "#1=[#2 OR [#3 AND #4]]\n"),
            ("#1=[#2 GT 1 AND #3]\n", "AND", "#1=[[#2 GT 1] AND #3]\n"),
        ] {
            for info in [THERE, BACK] {
                assert_eq!(ported(info, wrong), [what], "{info}: {wrong}");
                assert_eq!(ported(info, right), [""; 0], "{info}: {right}");
            }
        }
        // only one of the two controls lets these pass; the other one's own rules report them
        for (wrong, what, right) in [
            ("G0 G1 X1. F100.\n", "G1", "G1 X1. F100.\n"),
            ("M3 M4 S100\n", "M4", "M4 S100\n"),
            ("G0 X1. Y1. X2.\n", "X2.", "G0 X2. Y1.\n"),
            ("G0 X1. /Y2.\n", "/", "/G0 X1. Y2.\n"),
            ("G4 P500\n", "P500", "G4 X0.5\n"),
        ] {
            assert_eq!(ported(THERE, wrong), [what], "{wrong}");
            let right = ported(THERE, right);
            assert!(right.is_empty(), "{right:?}");
        }
        for (wrong, what, right) in [
            ("G4 P0.5\n", "P0.5", "G1 X1. F1.\n"),
            ("G0 X10\n", "X10", "G0 X10.\n"),
            ("#1=[2**3]\n", "**", "#1=[2*2*2]\n"),
            ("G0 X1. ; there\n", "; there", "G0 X1. (there)\n"),
            ("#<a>=1\n", "#<a>", "#1=1\n"),
        ] {
            assert_eq!(ported(BACK, wrong), [what], "{wrong}");
            assert_eq!(ported(BACK, right), [""; 0], "{right}");
        }
    }
}
