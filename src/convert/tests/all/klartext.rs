//! Klartext as source and as target, Okuma OSP as source.
use crate::support::{machine, refusal, text, to};
use trunnion_certify::conversion::{Assume, Posed, Run, read};
use trunnion_convert::Options;
use trunnion_interp::Setup;

/// A program of every shape of path: lines, arcs in three planes, a helix, a full circle, a dwell and a stop.
const SHAPES: &str = "%
O7 (ARCS AND HELIX)
(trunnion: tool 1 flat diameter 10 length 100)
G90 G21 G94 G17 G40 G49 G80
G54
T1 M6
S1000 M3 M8
G0 X0. Y0.
G43 H1 Z50.
G1 Z-1. F100.
G2 X20. Y0. I10. J0. F200.
G3 X20. Y0. Z-3. I5. J0.
G18 G2 X30. Z-3. R5.
G19 G3 Y10. Z-3. J5. K0.
G17 G1 X0.
G4 P1500
M9
M5
M0
M3 M8
G3 I-5. J0.
M9
G0 Z50.
M5
M30
%
";

fn poses(text: &str, dialect: &str, name: &str) -> Vec<Posed> {
    let setup = Setup::default();
    read(&Run {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin(dialect).expect("built in"),
        machine: machine(name),
        setup: &setup,
        assume: Assume::default(),
    })
    .motions
}

#[test]
fn every_shape_of_path_is_written_in_klartext() {
    let made = text(to(
        (SHAPES, "fanuc-30i", "mill-3axis"),
        "heidenhain-klartext",
        "mill-3axis",
        &Options::default(),
    ));
    insta::assert_snapshot!("shapes_in_klartext", made);
}

/// There and back: the tip ends where it did, and arcs stay arcs.
#[test]
fn klartext_comes_back_as_it_was() {
    let there = text(to(
        (SHAPES, "fanuc-30i", "mill-3axis"),
        "heidenhain-klartext",
        "mill-3axis",
        &Options::default(),
    ));
    for dialect in ["fanuc-30i", "sinumerik-840d", "haas-ngc", "linuxcnc"] {
        let back = text(to(
            (&there, "heidenhain-klartext", "mill-3axis"),
            dialect,
            "mill-3axis",
            &Options::default(),
        ));
        let (first, last) = (
            poses(SHAPES, "fanuc-30i", "mill-3axis"),
            poses(&back, dialect, "mill-3axis"),
        );
        let ends = |all: &[Posed]| -> Vec<_> {
            let known = all
                .iter()
                .filter_map(|posed| posed.end.as_ref().ok().map(|pose| (pose.tip, posed.motion.is_feed())));
            known.collect()
        };
        let (first, last) = (ends(&first), ends(&last));
        assert_eq!(first.len(), last.len(), "{back}");
        for ((was, cuts), (now, still)) in first.iter().zip(&last) {
            assert!((was - now).norm() < 1e-4 && cuts == still, "{was} {now} in {back}");
        }
    }
}

/// Five axes under M128, to the control that the pair was posted for and back.
#[test]
fn the_tip_is_led_by_m128() {
    let program = "N10 G90 G17 G40 G71 G94\nN20 G54\nN30 T1 M6\nN40 D1\nN50 S8000 M3\nN60 G0 A0 C0\nN70 TRAORI\nN80 G0 X0 Y0 Z50 A0 C0\n\
                   N90 G1 X10 Y2 Z40 A10 C20 F500\nN100 X20 A15 C25\nN110 G0 Z100\nN120 TRAFOOF\nN130 M30\n";
    let program = format!("; trunnion: tool 1 ball diameter 10 length 100\n{program}");
    let made = text(to(
        (&program, "sinumerik-840d", "mikron-ucp710"),
        "heidenhain-klartext",
        "mikron-ucp710",
        &Options::default(),
    ));
    let at = |what: &str| made.find(what).unwrap_or_else(|| panic!("no {what} in {made}"));
    assert!(at("M128") < at("L X+10 Y+2 Z+40 A+10 C+20 F500"), "{made}");
    assert!(at("L Z+100 FMAX") < at("M129"), "{made}");
    text(to(
        (&made, "heidenhain-klartext", "mikron-ucp710"),
        "fanuc-30i",
        "mikron-ucp710",
        &Options::default(),
    ));
}

fn klartext(blocks: &str) -> String {
    format!("BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+50 FMAX M3\n{blocks}\nL Z+50 FMAX\nM30\nEND PGM T MM\n")
}

/// What another control cannot do is refused by name.
#[test]
fn what_cannot_be_carried_over_is_named() {
    let cases = [
        (
            "CYCL DEF 206 TAPPING Q200=2 Q201=-5 Q206=800 Q211=0 Q203=0 Q204=10\nCYCL CALL",
            "CYCL DEF 206",
            "spindle",
        ),
        (
            "CYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE 90",
            "CYCL DEF 13",
            "angle",
        ),
        (
            "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.01",
            "CYCL DEF 32",
            "how exactly",
        ),
        ("Q5 = 2\nL X+Q5 F100", "Q5", "after the program ends"),
        ("FN 0: Q6 = +3\nL X+Q6 F100", "Q6", "after the program ends"),
        ("L M19", "M19", "angle"),
        ("L X+5 F100 M77", "M77", "depends on the machine"),
        ("/L X+5 F100", "block delete", "switch"),
        ("FN 14: ERROR = 1000", "FN 14", "alarm"),
        (
            "CYCL DEF 247 DATUM SETTING ~\nQ339=1 ;NUMBER\nL X+0 Y+0 Z+50 FMAX\nCYCL DEF 247 DATUM SETTING ~\nQ339=2 ;NUMBER\nL X+0 Y+0 Z+50 FMAX",
            "preset 2",
            "--work-offset",
        ),
    ];
    for (blocks, name, why) in cases {
        let refused = refusal(to(
            (&klartext(blocks), "heidenhain-klartext", "mill-3axis"),
            "fanuc-30i",
            "mill-3axis",
            &Options::default(),
        ));
        let message = refused.to_string();
        assert!(message.contains(name) && message.contains(why), "{blocks}: {message}");
    }
    let inch = Options {
        units: trunnion_convert::Units::Inch,
        ..Options::default()
    };
    let refused = refusal(to(
        (SHAPES, "fanuc-30i", "mill-3axis"),
        "heidenhain-klartext",
        "mill-3axis",
        &inch,
    ));
    assert!(refused.to_string().contains("inch"), "{refused}");
}

/// What only this control needs, and what the user drops, is left out; local parameters and holes are motions.
#[test]
fn blocks_that_move_nothing_are_left_out() {
    let program = klartext(
        "BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+100 Y+100 Z+0\nQL1 = 7\nL X+QL1 F100 M8\nCYCL DEF 200 DRILLING ~\nQ200=2 ~\nQ201=-5 ~\n\
         Q206=150 ~\nQ202=5 ~\nQ210=0 ~\nQ203=0 ~\nQ204=20 ~\nQ211=0\nL X+10 Y+10 FMAX M99\nL X+20 F200 M109 M9",
    );
    let options = Options {
        drop: vec!["M109".to_owned()],
        ..Options::default()
    };
    let from = (program.as_str(), "heidenhain-klartext", "mill-3axis");
    assert!(
        refusal(to(from, "fanuc-30i", "mill-3axis", &options))
            .to_string()
            .contains("M109")
    );
    let program = program.replace(" M109", "");
    let from = (program.as_str(), "heidenhain-klartext", "mill-3axis");
    let converted =
        to(from, "fanuc-30i", "mill-3axis", &Options::default()).unwrap_or_else(|refused| panic!("{refused}"));
    assert!(
        converted.left_out.iter().any(|(what, _)| what == "BLK FORM"),
        "{:?}",
        converted.left_out
    );
    for line in ["G1 X7. F100.", "Z-5. F150.", "M8", "M9"] {
        assert!(
            converted.text.lines().any(|found| found.ends_with(line)),
            "{line} in {}",
            converted.text
        );
    }
}

/// A preset and a work coordinate system of an OSP become the one work offset that the user names.
#[test]
fn a_zero_point_with_a_foreign_name_becomes_the_work_offset() {
    let preset = klartext("CYCL DEF 247 DATUM SETTING ~\nQ339=3 ;NUMBER\nL X+0 Y+0 Z+50 FMAX\nL Z-1 F100\nL X+20");
    let okuma = "(trunnion: tool 1 flat diameter 10 length 100)\nG15 H2\nG90 G17\nT1 M6\nS1000 M3\nG0 X0 Y0\nG56 Z50 H1\nG1 Z-1 F100\nX20\nG2 X40 I10 J0\nG0 Z50\nM5\nM2\n";
    for (program, dialect, name) in [
        (preset.as_str(), "heidenhain-klartext", "preset 3"),
        (okuma, "okuma-osp", "G15 H2"),
    ] {
        let options = Options {
            work_offset: Some("G56".to_owned()),
            ..Options::default()
        };
        let converted = to((program, dialect, "mill-3axis"), "fanuc-30i", "mill-3axis", &options);
        let converted = converted.unwrap_or_else(|refused| panic!("{refused}"));
        assert_eq!(converted.renamed_offset, Some((name.to_owned(), "G56".to_owned())));
        assert!(converted.text.contains("G56"), "{}", converted.text);
    }
}
