//! Rapids that a conversion must not lose, and a tool axis that it must not turn the other way.
use crate::support::{machine, refusal, text, to};
use trunnion_certify::conversion::{Assume, Run, read};
use trunnion_convert::Options;
use trunnion_interp::{Setup, WorkOffset};

fn message(program: &str, dialect: &str, machines: (&str, &str), target: &str) -> String {
    refusal(to(
        (program, dialect, machines.0),
        target,
        machines.1,
        &Options::default(),
    ))
    .to_string()
}

/// M91 after a cut: where machine coordinates are in the part depends on the preset, which is not declared.
#[test]
fn a_retract_in_machine_coordinates_is_no_coordinate_of_the_part() {
    let program = "BEGIN PGM R MM\nTOOL CALL 3 Z S8000 F500\nL X+0 Y+0 Z+50 FMAX M3\nL Z-1 F100\nL Z-10 FMAX M91\nM30\nEND PGM R MM\n";
    for target in ["fanuc-30i", "sinumerik-840d", "heidenhain-klartext", "apt"] {
        let machines = ("mill-3axis", "mill-3axis");
        let why = message(program, "heidenhain-klartext", machines, target);
        assert!(why.contains("leaves a cut") && why.contains("G500"), "{target}: {why}");
    }
}

/// Without the retract the tool would change in the cut. After a rapid to a known height it may be left out.
#[test]
fn a_retract_after_a_cut_is_not_left_out() {
    let program = |retract: &str| {
        format!(
            "%\nO1\n(trunnion: tool 3 length 100)\n(trunnion: tool 4 length 90)\nG90 G21 G94 G17 G40 G49 G80 G54\nT3 M6\nS1000 M3\nG0 X0. Y0.\n\
             G43 H3 Z50.\nG1 Z-1. F200.\n{retract}G53 G0 Z-10.\nT4 M6\nS900 M3\nG0 X0. Y0.\nG43 H4 Z50.\nG1 Z-1.\nG0 Z50.\nM30\n%\n"
        )
    };
    for target in ["heidenhain-klartext", "haas-ngc", "apt"] {
        let machines = ("mill-3axis", "mill-3axis");
        let why = message(&program(""), "fanuc-30i", machines, target);
        assert!(why.contains("leaves a cut"), "{target}: {why}");
        let safe = program("G0 Z60.\n");
        text(to(
            (&safe, "fanuc-30i", machines.0),
            target,
            machines.1,
            &Options::default(),
        ));
    }
}

/// LinuxCNC: G53 and G28 end at a place of the machine, which is no coordinate of the part as long as G54 is not declared.
#[test]
fn a_return_of_a_linuxcnc_is_no_coordinate_of_the_part() {
    let program = |retract: &str| {
        format!(
            "(trunnion: tool 1 length 100)\nG17 G90 G54 G21 G94 G40 G49 G80\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z50\nG1 Z-5 F100\n{retract}\nM2\n"
        )
    };
    let machines = ("mill-3axis", "mill-3axis");
    for target in ["fanuc-30i", "haas-ngc", "sinumerik-840d", "heidenhain-klartext", "apt"] {
        for back in ["G53 G0 Z0", "G28 Z60"] {
            let why = message(&program(back), "linuxcnc", machines, target);
            assert!(why.contains("G54"), "{target} {back}: {why}");
        }
        // after a rapid to a known height it is left out
        let safe = program("G0 Z50\nG53 G0 Z0");
        let made = text(to(
            (&safe, "linuxcnc", machines.0),
            target,
            machines.1,
            &Options::default(),
        ));
        assert!(!made.contains("Z0") && !made.contains("Z+0"), "{target}: {made}");
    }
}

/// The turn to the plane and the approach in it would become one rapid in all axes.
#[test]
fn a_turn_before_the_first_known_position_is_not_joined() {
    let program = |before: &str| {
        format!(
            "%\nO1\n(trunnion: tool 3 length 100)\nG90 G21 G94 G17 G40 G49 G80 G54\nT3 M6\nS1000 M3\n{before}G0 X0. Y0.\nG43 H3 Z50.\n\
             G68.2 X0. Y0. Z0. I90. J20. K-90.\nG53.1\nG0 X10. Y0.\nZ5.\nG1 Z-1. F200.\nG0 Z50.\nG69\nM30\n%\n"
        )
    };
    let machines = ("mikron-ucp710", "mikron-ucp710");
    for target in ["heidenhain-klartext", "sinumerik-840d"] {
        let why = message(&program(""), "fanuc-30i", machines, target);
        assert!(why.contains("all axes at once"), "{target}: {why}");
        let known = program("G0 A0. C0.\n");
        let made = text(to(
            (&known, "fanuc-30i", machines.0),
            target,
            machines.1,
            &Options::default(),
        ));
        assert!(made.contains("50"), "{made}");
    }
}

/// 330 degrees of the table are not 30 the other way, though both end in the same pose.
#[test]
fn the_tool_axis_keeps_its_path_inside_a_cut() {
    let program = "BEGIN PGM T MM\n; trunnion: tool 1 ball diameter 10 length 100\nTOOL CALL 1 Z S1000\nL A-25 C+20 FMAX M3\nM128\n\
                   L X+0 Y+0 Z+50 FMAX\nL Z+0 F500\nL X+20 C+END\nL Z+50 FMAX\nM129\nM30\nEND PGM T MM\n";
    let machines = ("mikron-ucp710", "head-table-bc");
    let wide = program.replace("END\nL", "350\nL");
    let why = message(&wide, "heidenhain-klartext", machines, "fanuc-30i");
    assert!(why.contains("another way"), "{why}");
    // a small turn is cut into parts within the tolerance
    let small = program.replace("END\nL", "60\nL");
    let from = (small.as_str(), "heidenhain-klartext", machines.0);
    let converted =
        to(from, "fanuc-30i", machines.1, &Options::default()).unwrap_or_else(|refused| panic!("{refused}"));
    assert!(converted.proof.path_deg <= 0.5, "{:?}", converted.proof);
    assert_eq!(converted.claim.path_deg, Some(0.5));
}

/// What the refusal asks for helps: with the zero point declared, machine coordinates have a place in the part.
#[test]
fn a_declared_zero_point_places_machine_coordinates() {
    let mut values = [0.0; 9];
    values[2] = 20.0;
    for (dialect, name, program) in [
        (
            "heidenhain-klartext",
            "G500",
            "TOOL CALL 3 Z S8000\nL X+0 Y+0 Z+50 FMAX\nL Z-10 FMAX M91\n",
        ),
        (
            "heidenhain-klartext",
            "preset 4",
            "TOOL CALL 3 Z S8000\nCYCL DEF 247 DATUM SETTING Q339=4\nL X+0 Y+0 Z+50 FMAX\nL Z-10 FMAX M91\n",
        ),
        ("sinumerik-840d", "G500", "T3 D1\nG0 X0 Y0 Z50\nSUPA Z-10\n"),
        ("okuma-osp", "G15 H2", "G15 H2\nG0 X0 Y0 Z50\nG16 H0 G0 Z-10\n"),
    ] {
        let mut setup = Setup::default();
        for declared in [false, true] {
            if declared {
                setup.work_offsets = vec![WorkOffset {
                    name: name.to_owned(),
                    values,
                }];
            }
            let reading = read(&Run {
                text: program.as_bytes(),
                dialect: trunnion_dialect::builtin(dialect).expect("built in"),
                machine: machine("mill-3axis"),
                setup: &setup,
                assume: Assume::default(),
            });
            let last = reading.motions.last().expect("a motion");
            let height = last.end.as_ref().ok().map(|pose| pose.tip.z);
            assert_eq!(height, declared.then_some(-30.0), "{dialect} {name}: {:?}", last.end);
        }
    }
}

/// The highest feed of the motions that keep the tip in place is a word of M128 that no other control has.
#[test]
fn the_feed_of_m128_is_named() {
    let program = "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL A-25 C+20 FMAX M3\nL M128 F1000\nL X+0 Y+0 Z+50 FMAX\nL Z+0 F500\nL Z+50 FMAX\nM129\nM30\nEND PGM T MM\n";
    let machines = ("mikron-ucp710", "mikron-ucp710");
    let why = message(program, "heidenhain-klartext", machines, "fanuc-30i");
    assert!(why.contains("M128 F"), "{why}");
}
