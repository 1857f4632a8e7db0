//! What is written keeps its place: spindle, coolant, stops, approaches, zero points, and the path of the tool axis.
use crate::kept::around;
use crate::support::{refusal, text, to};
use trunnion_convert::Options;

/// M99 at the end starts the main program again.
#[test]
fn a_program_that_starts_again_is_refused() {
    let source = around("fanuc-30i", "").replace("M30", "M99");
    let refused = refusal(to(
        (&source, "fanuc-30i", ""),
        "sinumerik-840d",
        "",
        &Options::default(),
    ));
    assert!(refused.message.contains("M99"), "{refused}");
}

/// Direction of the spindle, coolant and stops are written where they stood.
#[test]
fn spindle_coolant_and_stops_keep_their_places() {
    let source = around("fanuc-30i", "M4\nM8\nG1 X8. F100.\nM5\nM0\nM3\nG1 X7. M9\nM1");
    let written = text(to(
        (&source, "fanuc-30i", ""),
        "sinumerik-840d",
        "",
        &Options::default(),
    ));
    let lines: Vec<&str> = written
        .lines()
        .map(|line| line.split_once(' ').map_or(line, |(_, rest)| rest))
        .collect();
    let wanted = [
        "S500 M4",
        "M8",
        "G1 X8 F100",
        "M5",
        "M0",
        "S500 M3",
        "X7",
        "M9",
        "M1",
        "X5",
        "M5",
        "M30",
    ];
    assert!(lines.ends_with(&wanted), "{written}");
}

/// G0 X Y, then G43 H Z: the tool comes down where it has arrived, not along a slope.
#[test]
fn an_approach_stays_two_moves() {
    let approach = "G21 G17 G90 G94 G54\nT1 M6\nS500 M3\nG0 X10. Y20.\nG43 H1 Z5.\nG1 Z-1. F100.\nM5\nM30\n";
    for machine in ["", "mill-3axis"] {
        let from = (approach, "fanuc-30i", machine);
        for (target, first, second) in [
            ("sinumerik-840d", "G0 X10 Y20", "X10 Y20 Z5"),
            ("haas-ngc", "G0 X10. Y20.", "X10. Y20. Z5."),
            ("linuxcnc", "G0 X10 Y20", "X10 Y20 Z5"),
        ] {
            let made = to(from, target, machine, &Options::default()).unwrap_or_else(|refused| panic!("{refused}"));
            let lines: Vec<&str> = made.text.lines().collect();
            let at = lines.iter().position(|line| line.ends_with(first));
            let at = at.unwrap_or_else(|| panic!("{target}\n{}", made.text));
            assert!(
                lines[at + 1..].iter().take(2).any(|line| line.ends_with(second)),
                "{target}\n{}",
                made.text
            );
            assert_eq!(made.proof.left_out, 0);
        }
    }
}

/// The same with rotary axes: turned and positioned before the tip is led, as it was.
#[test]
fn an_approach_on_five_axes_stays_as_it_was() {
    let approach = "G21 G17 G90 G94 G54\nT1 M6\nS500 M3\nG0 A10. C20.\nX10. Y20.\nG43.4 H1 Z50.\nX10. Y20. Z5. A10. C20.\n\
        G1 Z-1. F100.\nG49\nM5\nM30\n";
    let name = "mikron-ucp710";
    let made = to(
        (approach, "fanuc-30i", name),
        "sinumerik-840d",
        name,
        &Options::default(),
    );
    let written = text(made);
    let place = |text: &str| written.find(text).unwrap_or_else(|| panic!("no {text} in\n{written}"));
    assert!(
        place("G0 A10 C20\n") < place("X10 Y20\n") && place("X10 Y20\n") < place("TRAORI\n"),
        "{written}"
    );
    // on another machine X and Y lie elsewhere: it would run in all axes at once
    let refused = refusal(to(
        (approach, "fanuc-30i", name),
        "sinumerik-840d",
        "ferrari-bc",
        &Options::default(),
    ));
    assert!(
        refused.message.contains("in all axes at once") && refused.place.is_some_and(|(line, _)| line == 5),
        "{refused}"
    );
}

/// A zero point that the program shifts is not in the program after, and CL data have only one.
#[test]
fn a_shifted_zero_point_is_not_lost() {
    for blocks in ["G52 X3.\nG1 X8. F100.", "G52 X3.\nG52 X0.\nG1 X8. F100."] {
        let shifted = blocks.matches("G52").count() == 1;
        let source = format!("G21 G17 G90 G94 G54\nS500 M3\n{blocks}\n").replace("G1", "G0 X1. Y1. Z1.\nG1") + "M30\n";
        let made = to((&source, "fanuc-30i", ""), "sinumerik-840d", "", &Options::default());
        match made {
            Ok(made) => assert!(!shifted, "{}", made.text),
            Err(refused) => assert!(shifted && refused.message.contains("G52"), "{refused}"),
        }
    }
    let two = "G21 G17 G90 G94\nS500 M3\nG54 G0 X1. Y1. Z1.\nG1 X8. F100.\nG55\nG1 X9. Y1. Z1.\nM30\n";
    let refused = refusal(to((two, "fanuc-30i", ""), "apt", "", &Options::default()));
    assert!(refused.message.contains("work offset"), "{refused}");
    text(to((two, "fanuc-30i", ""), "sinumerik-840d", "", &Options::default()));
}

/// The tool axis of a program that is written in the same words is the same at every moment, and is said to be.
#[test]
fn the_bound_of_the_tool_axis_is_tight() {
    let name = "mikron-ucp710";
    let source = "G710 G90 G94 G54\nT1 M6\nD1\nS500 M3\nTRAORI\nG0 X0 Y0 Z50 A10 C0\nG1 X50 A40 C90 F500\nX0 A-20 C180\nTRAFOOF\nM5\nM30\n";
    for (target, limit) in [("sinumerik-840d", 1e-9), ("haas-ngc", 1e-9)] {
        let made = to((source, "sinumerik-840d", name), target, name, &Options::default()).expect("proved");
        assert!(made.proof.path_deg <= limit, "{target}: {}", made.proof.path_deg);
    }
    // vectors of nine digits on the same great circle
    let circle = "UNITS/MM\nMULTAX/ON\nLOADTL/1\nSPINDL/500,RPM,CLW\nRAPID\nGOTO/0,0,50,0,0.1,0.994987437\nFEDRAT/500,MMPM\n\
        GOTO/50,0,0,0,0.8,0.6\nFINI\n";
    let made = to((circle, "apt", ""), "apt", "", &Options::default()).expect("proved");
    assert!(made.proof.path_deg < 1e-6, "{}", made.proof.path_deg);
}

/// How the tool axis runs between the ends is asked for, and the machine file says that the control does otherwise by itself.
#[test]
fn the_way_of_the_tool_axis_is_not_lost() {
    let name = "mikron-ucp710";
    let at = |code: &str| {
        let source = format!(
            "G710 G90 G94 G54\nT1 M6\nD1\nS500 M3\nTRAORI\n{code}\nG0 X0 Y0 Z50 A20 C-15\nG1 X5 C15 F500\nTRAFOOF\nM5\nM30\n"
        );
        to(
            (&source, "sinumerik-840d", name),
            "sinumerik-840d",
            name,
            &Options {
                tolerance_deg: Some(1.0),
                ..Options::default()
            },
        )
    };
    let (one, other) = (at("ORIVECT"), at("ORIAXES"));
    let by_itself = trunnion_machine::builtin(name)
        .expect("built in")
        .control
        .tcp_great_circle;
    let (kept, lost, why) = if by_itself {
        (one, other, "ORIAXES")
    } else {
        (other, one, "ORIVECT")
    };
    text(kept);
    let refused = refusal(lost);
    assert!(refused.message.contains(why), "{refused}");
}
