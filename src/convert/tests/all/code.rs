//! One small APT program for every control.
use crate::support::{text, to};
use std::fmt::Write;
use trunnion_convert::{Options, OrientationWords};

const PIECE: &str = include_str!("../../../../samples/programs/apt/small-piece.apt");

const PLATE: &str = include_str!("../../../../samples/programs/apt/plate.apt");

fn options(tcp: bool) -> Options {
    Options {
        tcp,
        ..Options::default()
    }
}

#[test]
fn every_control_has_its_words() {
    let mut all = String::new();
    for dialect in ["sinumerik-840d", "fanuc-30i", "haas-ngc"] {
        let written = text(to((PIECE, "apt", ""), dialect, "mikron-ucp710", &options(true)));
        let _ = write!(all, "--- {dialect}\n{written}");
    }
    let vectors = Options {
        orientation: OrientationWords::Vectors,
        ..Options::default()
    };
    for dialect in ["sinumerik-840d", "fanuc-30i"] {
        let written = text(to((PIECE, "apt", ""), dialect, "mikron-ucp710", &vectors));
        let _ = write!(all, "--- {dialect}, vectors\n{written}");
    }
    insta::assert_snapshot!(all);
}

#[test]
fn three_axes_need_no_tool_centre_point_control() {
    let mut all = String::new();
    for dialect in ["iso-6983", "grbl", "fanuc-30i", "linuxcnc"] {
        let written = text(to((PLATE, "apt", ""), dialect, "mill-3axis", &options(true)));
        let _ = write!(all, "--- {dialect}\n{written}");
    }
    // without a machine the words are the same
    let with = text(to((PLATE, "apt", ""), "iso-6983", "mill-3axis", &options(true)));
    assert_eq!(text(to((PLATE, "apt", ""), "iso-6983", "", &options(true))), with);
    insta::assert_snapshot!(all);
}

#[test]
fn inches_scale_lengths_and_feeds() {
    let inch = Options {
        units: trunnion_convert::Units::Inch,
        ..Options::default()
    };
    let written = text(to((PLATE, "apt", ""), "fanuc-30i", "mill-3axis", &inch));
    assert!(
        written.contains("G20 G94") && written.contains("Y0.3937 I0. J0.19685") && written.contains("F31.4961"),
        "{written}"
    );
    let back = text(to((&written, "fanuc-30i", ""), "apt", "", &Options::default()));
    // 31.4961 inch/min and 0.7874 inch
    assert!(
        back.contains("FEDRAT/800.00094,MMPM") && back.contains("GOTO/19.99996,0,"),
        "{back}"
    );
}

/// Joints of a machine with two rotary axes, cut into pieces that keep the tip within the tolerance, each with the time it takes.
#[test]
fn without_tool_centre_point_control_cuts_are_linearised() {
    let coarse = to((PIECE, "apt", ""), "linuxcnc", "mikron-ucp710", &options(false)).expect("proved");
    let fine = Options {
        tcp: false,
        tolerance_mm: Some(0.001),
        ..Options::default()
    };
    let fine = to((PIECE, "apt", ""), "linuxcnc", "mikron-ucp710", &fine).expect("proved");
    assert!(
        coarse.proof.path_mm <= 0.01 && coarse.proof.path_mm > 0.001,
        "{:?}",
        coarse.proof
    );
    assert!(fine.proof.path_mm <= 0.001, "{:?}", fine.proof);
    // pieces grow with the root of the precision
    let (few, many) = (coarse.proof.motions_after as f64, fine.proof.motions_after as f64);
    assert!((2.0..4.5).contains(&(many / few)), "{few} {many}");
    assert!(coarse.text.contains("G93") && !coarse.text.contains("M428"));
    let back = to(
        (&coarse.text, "linuxcnc", "mikron-ucp710"),
        "apt",
        "",
        &Options::default(),
    )
    .expect("proved");
    assert!(back.proof.path_mm <= 0.01);
}

#[test]
fn a_post_of_ones_own_writes_its_own_codes() {
    let post = trunnion_convert::load_post(
        "extends = \"fanuc-30i\"\n[text]\nnumber-step = 0\n[templates]\nheader = \"\"\"\n%\nO{number} {title}\n(FOR {machine})\n{units} {feed_mode}\n\"\"\"\ncoolant-thru = \"M51\"\n",
    )
    .expect("valid");
    let setup = trunnion_interp::Setup::default();
    let source = trunnion_convert::Source {
        text: PLATE.replace("OPSTOP", "COOLNT/THRU").leak().as_bytes(),
        dialect: trunnion_dialect::builtin("apt").expect("built in"),
        machine: None,
        setup: &setup,
        assume: trunnion_certify::conversion::Assume::default(),
    };
    let machine = trunnion_machine::builtin("mill-3axis");
    let target = trunnion_convert::Target::Code { post: &post, machine };
    let written = text(trunnion_convert::convert(&source, &target, &Options::default()));
    assert!(written.starts_with("%\nO0001 (PLATE)\n(FOR Three-axis mill)\nG21 G94\nG54\n(MADE UP TO BE CONVERTED: SAMPLES/README.MD)\nT2 M6\n"), "{written}");
    assert!(written.contains("\nM51\n"), "{written}");
}
