//! Tool centre point control is in the wrong state for what the block does.
//!
//! # Why
//! With tool centre point control X Y Z position the tip, and the control compensates for the rotary axes. Without
//! it X Y Z position the axes. Rotary words after it was switched off; a tool without an active length, a
//! tool change or machine coordinates while it is on: each is correct syntax and sends the tip to another place.
//!
//! # Example
//! ```gcode fanuc-30i mikron-ucp710
//! N10 G43.4 H1
//! N20 G0 X0. Y0. Z50. A20. C0.
//! N30 G1 X10. F500.
//! N40 G49
//! N50 G0 X0. Y0. Z80. A20. C0.
//! N60 G1 Z79. A20.01 F500.
//! ;      ^^^^ tcp-state: a rotary axis turns in a feed motion without tool centre point control
//! N70 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i mikron-ucp710
//! N10 G43.4 H1
//! N20 G0 X0. Y0. Z50. A20. C0.
//! N30 G1 X10. A20.01 F500.
//! N40 G49
//! N70 M30
//! ```
//!
//! # Guarantee
//! Sound for what it names: rotary words in a feed motion after tool centre point control was on with the same
//! tool; a feed motion under it with a tool whose length is not active; a tool change or machine coordinates under
//! it; a machine without a rotary axis; a code that needs H and has none, where no H of this tool was programmed
//! before. `path-deviation` judges the resulting path. Everything is a warning except tool centre point control on a
//! machine without a rotary axis, which is an error.
//!
//! # Sources
//! * docs/contract.md#tool-centre-point-control
use crate::prelude::*;
use trunnion_interp::TcpMistake;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Fault(check), Wake::IdleTip(idle)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::TcpState(mistake) = &fault.kind else {
        return;
    };
    let (message, note, help) = match mistake {
        TcpMistake::RotaryWithout => (
            "a rotary axis turns in a feed motion without tool centre point control, which was on earlier with this tool",
            "here X Y Z position the axes, not the tip: the tip does not stay on the programmed line",
            "switch tool centre point control on again, or position the rotary axis in a rapid motion",
        ),
        TcpMistake::NoLength => (
            "the tool cuts under tool centre point control while no tool length is active",
            "the control guides the spindle nose as if it were the tip",
            "activate the tool length (H or D) first",
        ),
        TcpMistake::ToolChange => (
            "the tool is changed under tool centre point control",
            "the tool length changes while the axes follow the tip",
            "switch tool centre point control off before the tool change",
        ),
        TcpMistake::MachineCoordinates => (
            "machine coordinates are programmed under tool centre point control",
            "it depends on the control whether this block suspends tool centre point control",
            "switch tool centre point control off first",
        ),
        TcpMistake::NoLengthNumber => (
            "tool centre point control is switched on without H: the program gives no length for this tool",
            "the control takes the H that was last in effect, maybe H0: then it guides the spindle nose as if it were the tip",
            "write H with the number of the tool, for example G43.4 H1",
        ),
    };
    out.report(fault.range, message)
        .note(note)
        .help(help)
        .merge(Merge::run(*mistake as u64, 0.0));
}

/// Nothing turns that the control could compensate for.
fn idle(view: &facts::IdleTip<'_>, out: &mut Reporter<'_>) {
    out.finding_as(Error, view, Merge::once(0), |draft| {
        draft
            .say(format!(
                "tool centre point control is on, but {} has no rotary axis",
                view.machine.id
            ))
            .note("a control without this option stops with an alarm")
            .help("name the machine that the program was written for, or remove the code of tool centre point control");
    });
}

#[cfg(test)]
mod tests {
    use crate::Severity::Error;
    use crate::fixture::Fixture;

    fn found(dialect: &str, text: &str) -> Vec<String> {
        let report = Fixture::parse(&format!("gcode {dialect} mikron-ucp710"), text)
            .check()
            .unwrap();
        let told = report.diagnostics.iter().filter(|d| d.rule == "tcp-state");
        told.map(|d| {
            format!(
                "{} x{}",
                d.message.split_whitespace().take(4).collect::<Vec<_>>().join(" "),
                d.count
            )
        })
        .collect()
    }

    #[test]
    fn each_mistake_is_told() {
        let change = "TRAORI\nG0 X0 Y0 Z50 A20 C0\nT2\nM6\nTRAFOOF\nM30\n";
        assert_eq!(found("sinumerik-840d", change), ["the tool is changed x1"]);
        let machine = "TRAORI\nG0 X0 Y0 Z50 A20 C0\nG0 SUPA Z0\nTRAFOOF\nM30\n";
        assert_eq!(
            found("sinumerik-840d", machine),
            ["machine coordinates are programmed x1"]
        );
        let length = "T1 M6\nG43.4 H1\nG49\nG43.5 H0\nG0 X0. Y0. Z50. A20. C0.\nG1 X10. F500.\nM30\n";
        assert!(found("fanuc-30i", length).is_empty());
        let without = "T1 M6\nG43.4\nG0 X0. Y0. Z50. A20. C0.\nG1 X10. F500.\nM30\n";
        assert_eq!(found("fanuc-30i", without), ["tool centre point control x1"]);
        // H of the tool before
        let before = "T1 M6\nG43.4 H1\nG49\nT2 M6\nG43.5\nG49\nG43.4 H2\nG49\nG43.4\nG49\nM30\n";
        assert_eq!(found("fanuc-30i", before), ["tool centre point control x1"]);
        let none = "T1 M6 D0\nTRAORI\nG0 X0 Y0 Z50 A20 C0 D0\nG1 X10 F500\nX20\nM30\n";
        assert_eq!(found("sinumerik-840d", none), ["the tool cuts under x1"]);
    }

    #[test]
    fn a_machine_without_a_rotary_axis_leads_no_tip() {
        for (dialect, text) in [
            (
                "fanuc-30i",
                "T1 M6\nG43.4 H1\nG0 X0. Y0. Z50.\nG1 X10. F500.\nX20.\nM30\n",
            ),
            (
                "sinumerik-840d",
                "T1 M6\nD1\nTRAORI\nG0 X0 Y0 Z50\nG1 X10 F500\nX20\nM30\n",
            ),
        ] {
            let report = Fixture::parse(&format!("gcode {dialect} mill-3axis"), text)
                .check()
                .unwrap();
            let told: Vec<_> = report.diagnostics.iter().filter(|d| d.rule == "tcp-state").collect();
            assert_eq!(told.len(), 1, "{dialect}");
            assert!(told[0].message.contains("mill-3axis has no rotary axis"));
        }
    }

    #[test]
    fn apt_needs_no_code_to_lead_the_tip() {
        for axis in ["", "MULTAX\n", "MULTAX/OFF\n"] {
            let end = if axis == "MULTAX\n" { ",0,0,1" } else { "" };
            let text = format!(
                "PARTNO P\nUNITS/MM\nCUTTER/6\n{axis}LOADTL/1\nSPINDL/1000,RPM,CLW\nFEDRAT/500\nGOTO/0,0,5{end}\nGOTO/9,0,5{end}\nFINI\n"
            );
            let report = Fixture::parse("gcode apt mill-3axis", &text).check().unwrap();
            let told: Vec<_> = report.diagnostics.iter().filter(|d| d.severity == Error).collect();
            assert!(told.is_empty(), "{axis}: {told:?}");
        }
        // what a tool needs that is not along Z is said as before
        let tilted = "PARTNO P\nUNITS/MM\nCUTTER/6\nMULTAX\nLOADTL/1\nFEDRAT/500\nGOTO/0,0,5,0,0,1\nGOTO/9,0,5,0,0.5,0.866025\nFINI\n";
        let report = Fixture::parse("gcode apt mill-3axis", tilted).check().unwrap();
        assert!(
            report
                .diagnostics
                .iter()
                .any(|d| d.severity == Error && d.rule != "tcp-state"),
            "{:?}",
            report.diagnostics
        );
    }

    #[test]
    fn rotary_words_are_free_before_and_with_the_next_tool() {
        let text = "T1 M6\nG0 X0 Y0 Z50 A0 C0\nG1 A5 F100\nTRAORI\nG1 X5 A6\nTRAFOOF\nG0 X0 Y0 Z50 A0\nG1 A1 F100\nA2\nT2 M6\nG0 X0 Y0 Z50\nG1 A3\nM30\n";
        assert_eq!(found("sinumerik-840d", text), ["a rotary axis turns x2"]);
    }
}
