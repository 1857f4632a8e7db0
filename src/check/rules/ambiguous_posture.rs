//! Several postures give the programmed tool vector, and it is unclear which one the control takes.
//!
//! # Why
//! Two positions of the rotary axes give the same tool direction. Each control picks one by its own rule. Where
//! that rule is not documented, depends on a parameter that the machine file does not give, or rates two postures
//! as equal, a verdict for one of them would be a guess. The other posture needs different axis travel, and the
//! axes sweep through different space on the way to it.
//!
//! # Example
//! No rule is documented for this control family, and the machine file declares none.
//!
//! ```gcode sinumerik-840d mikron-ucp710+undeclared
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G0 X10 A3=0.1 B3=-0.3 C3=0.95
//! ;          ^^^^^^^^^^^^^^^^^^^^^^ ambiguous-posture: for this tool vector the control may take C 18.435 deg and A 18.411 deg or C -161.6 deg and A -18.411 deg
//! N40 M30
//! ```
//!
//! # Use instead
//! Program the rotary axes themselves, or declare the rule of the control (`[control] branch = { rule = ... }`):
//! ```gcode sinumerik-840d mikron-ucp710+undeclared
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G0 X10 A18.411 C18.435
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound: wherever the documentation and the machine file leave more than one posture within the travel of the
//! axes, this is reported, once per cause. The run continues with the first of the two postures that the message
//! names.
//!
//! # Thresholds
//! Postures that differ by 5 deg or less in every rotary axis are treated as one.
//!
//! # Sources
//! * docs/kinematics.md#which-posture-a-control-takes
//! * FANUC Series 30i B-64484EN-2 (machining centre): tool centre point control type 2.
//! * Mitsubishi M700V IB-1500922: tool center point control, G43.4 and G43.5.
use crate::prelude::*;
use trunnion_machine::{Open, OpenCause};

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::OpenPosture(check)]);

fn check(posture: &facts::OpenPosture<'_>, out: &mut Reporter<'_>) {
    let open = &posture.open;
    let words = |q: [f64; 2]| {
        let axes = posture.machine.rotary.iter().zip(q);
        let words: Vec<String> = axes
            .map(|(axis, value)| format!("{} {}", letter(posture.machine.axes[*axis].letter), degrees(value)))
            .collect();
        words.join(" and ")
    };
    let by_words = matches!(open.cause, OpenCause::HalfTurn | OpenCause::TurnsCarried);
    let subject = if by_words { "these words" } else { "this tool vector" };
    out.unknown(posture, Merge::once(open.cause as u64), |draft| {
        let (why, help) = cause(open, &posture.machine.control.family);
        draft
            .at_orientation()
            .say(format!(
                "for {subject} the control may take {} or {}",
                words(open.taken),
                words(open.other)
            ))
            .note(why)
            .note("everything after this block is checked for the first of the two")
            .help(help)
            .value("taken_first_deg", deg(open.taken[0]))
            .value("taken_second_deg", deg(open.taken[1]))
            .value("other_first_deg", deg(open.other[0]))
            .value("other_second_deg", deg(open.other[1]));
    });
}

fn cause(open: &Open, family: &str) -> (String, &'static str) {
    let text = |why: &str| why.to_owned();
    match open.cause {
        OpenCause::RuleNotDeclared => (
            format!(
                "it is not documented which one a control of the family {family} takes, and the machine file does not say"
            ),
            "program the rotary axes themselves, or declare the rule in the machine file: [control] branch = { rule = ... }",
        ),
        OpenCause::Tie => (
            text("the control's rule rates both as equal"),
            "program the rotary axes themselves, or a slightly different vector",
        ),
        OpenCause::HalfTurn => (
            text("it is half a turn in both directions: it is not documented which way the axis turns"),
            "program an intermediate point",
        ),
        OpenCause::TurnsCarried => (
            text(
                "the shorter way (DC, ACP, ACN, M126) has carried the axis beyond a full turn, and the machine file takes its words literally: the control may count from the angle that it displays",
            ),
            "declare how the control takes words of this axis in the machine file (wrap), or keep the shorter way on",
        ),
        OpenCause::PassingTypeNotDeclared => (
            text(
                "the two settings for passing the pole give different results here, and the machine file does not say which one is set",
            ),
            "declare it in the machine file: [control] pole = { passing_type = 1 } or 2",
        ),
        OpenCause::RangeNotDeclared => (
            text(
                "the second one is nearer but outside the travel: it is not declared whether the control knows the travel (parameters 19741 to 19744)",
            ),
            "declare the ranges in the machine file: [control] branch = { range = { A = [-30, 120] } }",
        ),
        OpenCause::StartUnknown => (
            text("the control starts from the previous posture, which is unknown here"),
            "position the rotary axes before the first vector",
        ),
        OpenCause::Direction => (
            text("both match the preferred direction in the program"),
            "position the rotary axes before this block",
        ),
        OpenCause::WordsNotDeclared => (
            text(
                "the program selects a posture by words (STAT, TU, P) whose meaning the machine file does not declare",
            ),
            "declare it in the machine file: [control] posture_words = { turn = { A = 3, C = 4 }, solutions = { 1 = \"A+\" } }",
        ),
        OpenCause::PoleHeld => (
            text(
                "inside its cone around the pole the control holds the first rotary axis: how it leaves the cone is not modelled",
            ),
            "keep the tool axis out of the cone",
        ),
        OpenCause::PoleAlarm => (
            text("according to the machine file the control stops with an alarm inside its cone around the pole"),
            "keep the tool axis out of the cone",
        ),
        OpenCause::GreatCircle => (
            text(
                "the control's rule takes the first one, but on a great circle away from the pole the posture cannot change: it is not documented which of the two the control ignores",
            ),
            "guide the tool axis farther from the pole, or exactly over it, or program the rotary axes themselves",
        ),
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};
    use crate::{Severity, Status, Verdict};

    #[test]
    fn one_cause_is_told_once_and_makes_the_verdict_unknown() {
        let text = "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 G0 X10 A3=0.1 B3=-0.3 C3=0.95\nN40 G0 X20 A3=0.1 B3=-0.4 C3=0.9\nN50 M30\n";
        let report = Fixture::parse("gcode sinumerik-840d mikron-ucp710+undeclared", text)
            .check()
            .unwrap();
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .filter(|d| d.rule == "ambiguous-posture")
            .collect();
        assert_eq!((found.len(), found[0].count, found[0].status), (1, 2, Status::Unknown));
        assert_eq!(report.verdict(Severity::Error), Verdict::Unknown);
        assert_eq!(found[0].values.len(), 4);
    }

    /// PTP with TU, whose bits are not declared; if the bits of the axes are declared, the program is unambiguous.
    #[test]
    fn words_for_postures_need_their_meaning() {
        let text = "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 PTP\nN40 G0 X10 A3=0.1 B3=-0.3 C3=0.95 TU=16\n";
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710+undeclared",
            &format!(
                "{text};          ^^^^^^^^^^^^^^^^^^^^^^ ambiguous-posture: for this tool vector the control may take\nN50 M30\n"
            ),
        );
        // C turns without end: its bit says nothing, A's bit is not set
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710+control.posture_words={turn={A=3,C=4}}",
            &format!("{text}N50 M30\n"),
        );
    }

    /// C stays where it is, and where that is was never programmed.
    #[test]
    fn a_first_vector_along_the_pole_leaves_the_first_axis_unknown() {
        let text = "N10 TRAORI\nN20 G0 X0 Y0 Z50 A3=0 B3=0 C3=1\n";
        let told = ";                ^^^^^^^^^^^^^^ ambiguous-posture: for this tool vector the control may take C 0 deg and A 0 deg or C 180 deg and A 0 deg\n";
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710+undeclared",
            &format!("{text}{told}N30 M30\n"),
        );
        let known = "N5 G0 X0 Y0 Z50 A0 C0\n";
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710+undeclared",
            &format!("{known}{text}N30 M30\n"),
        );
    }

    #[test]
    fn a_declared_rule_settles_it() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 G0 X10 A3=0.1 B3=-0.3 C3=0.95\nN40 M30\n",
        );
    }

    /// Trunnion's own rule takes the rotary axes at 0 before the first motion, but not where the program has moved them to an unknown position.
    #[test]
    fn a_lost_position_leaves_the_next_posture_open() {
        let vector = "N30 G0 X10 Y0 Z50 A3=0.1 B3=-0.3 C3=0.95\n";
        for (lines, open) in [
            ("N10 TRAORI\n", false),
            ("N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\n", false),
            ("N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C=R1\n", true),
            ("N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN25 G0 A=R1\n", true),
            ("N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C=R1\nN25 G0 C5\n", false),
        ] {
            let text = format!("{lines}{vector}N40 M30\n");
            let report = Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
                .check()
                .unwrap();
            let found = report.diagnostics.iter().filter(|d| d.rule == "ambiguous-posture");
            assert_eq!(found.count(), usize::from(open), "{text}{report:?}");
        }
    }

    /// C turns without end: TU lets it take the nearest turn, and that is known only where C stands at a known turn.
    #[test]
    fn the_nearest_turn_to_a_lost_position_is_open() {
        for (before, open) in [("C0", false), ("C=R1", true)] {
            let text =
                format!("N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 {before}\nN30 PTP\nN40 G0 X10 A20 C30 TU=0\nN50 M30\n");
            let report = Fixture::parse(
                "gcode sinumerik-840d mikron-ucp710+control.posture_words={turn={A=3,C=4}}",
                &text,
            )
            .check()
            .unwrap();
            let found = report.diagnostics.iter().filter(|d| d.rule == "ambiguous-posture");
            assert_eq!(found.count(), usize::from(open), "{text}{report:?}");
        }
    }

    #[test]
    fn on_a_great_circle_clear_of_the_pole_nothing_is_open() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710+undeclared",
            "N10 TRAORI\nN15 ORIVECT\nN20 G0 X0 Y0 Z50 A20 C0\nN30 G0 X10 A3=0.1 B3=-0.3 C3=0.95\nN40 M30\n",
        );
    }
}
