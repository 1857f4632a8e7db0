//! Edits: unit, positions, and a path that is moved. Values by hand, properties, refusals.
use trunnion_convert::{Edit, Positions, Shape, edit};
use trunnion_dialect::{Dialect, builtin};
use trunnion_interp::{LengthUnit, Setup};
use trunnion_syntax::parse;

pub(crate) const INCH: Edit = Edit::Unit(LengthUnit::Inch);
pub(crate) const MM: Edit = Edit::Unit(LengthUnit::Millimetre);
const ABSOLUTE: Edit = Edit::Positions(Positions::Absolute);
pub(crate) const INCREMENTAL: Edit = Edit::Positions(Positions::Incremental);

pub(crate) fn shift(x: f64, y: f64, z: f64) -> Edit {
    Edit::Shape(Shape::Shift([x, y, z]))
}

pub(crate) fn dialect(name: &str) -> &'static Dialect {
    builtin(name).unwrap_or_else(|| panic!("{name}"))
}

pub(crate) fn run_with(name: &str, text: &str, asked: Edit, decimals: Option<usize>) -> Result<String, String> {
    let dialect = dialect(name);
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    edit(&program, dialect, &Setup::default(), asked, decimals)
        .map(|edited| String::from_utf8(edited.text).expect("text"))
        .map_err(|refused| refused.to_string())
}

fn run(name: &str, text: &str, asked: Edit) -> Result<String, String> {
    run_with(name, text, asked, None)
}

#[track_caller]
pub(crate) fn becomes(name: &str, before: &str, asked: Edit, after: &str) {
    match run(name, before, asked) {
        Ok(text) => assert_eq!(text, after, "{name} {asked:?}"),
        Err(why) => panic!("{name} {asked:?}: refused: {why}"),
    }
}

#[track_caller]
pub(crate) fn refused(name: &str, before: &str, asked: Edit, part: &str) {
    match run(name, before, asked) {
        Ok(text) => panic!("{name} {asked:?}: not refused:\n{text}"),
        Err(why) => assert!(why.contains(part), "{name} {asked:?}: {why}"),
    }
}

#[test]
fn the_unit_changes_lengths_and_feeds_and_nothing_else() {
    // 25.4 mm are an inch: 254 mm/min are 10 in/min
    becomes(
        "fanuc-30i",
        "%\nO1 (PLATE X25.4)\nN1 G21 G90 G17 G40\nN2 G54 M3 S1000\nN3 G0 X25.4 Y50.8\nN4 G43 Z12.7 H1\nN5 G1 Z-2.54 F254.\nN6 X38.1\nN7 G2 X63.5 Y50.8 I12.7 J0.\nN8 G3 X76.2 Y63.5 R12.7\n\
         N9 G0 Z12.7\nN10 G83 X0. Y0. R2.54 Z-25.4 Q5.08 F127.\nN11 G80\nN12 M30\n%\n",
        INCH,
        "%\nO1 (PLATE X25.4)\nN1 G20 G90 G17 G40\nN2 G54 M3 S1000\nN3 G0 X1. Y2.\nN4 G43 Z0.5 H1\nN5 G1 Z-0.1 F10.\nN6 X1.5\nN7 G2 X2.5 Y2. I0.5 J0.\nN8 G3 X3. Y2.5 R0.5\n\
         N9 G0 Z0.5\nN10 G83 X0. Y0. R0.1 Z-1. Q0.2 F5.\nN11 G80\nN12 M30\n%\n",
    );
    // per revolution: 0.254 mm are 0.01 in; G93 says 1/min, which has no unit
    becomes(
        "haas-ngc",
        "%\nO1\nG21 G90 G17\nG54 M3 S500\nG0 X0. Y0. Z5.08\nG95 G1 Z-2.54 F0.254\nG93 X25.4 F2.\nG94 Y25.4 F254.\nM30\n%\n",
        INCH,
        "%\nO1\nG20 G90 G17\nG54 M3 S500\nG0 X0. Y0. Z0.2\nG95 G1 Z-0.1 F0.01\nG93 X1. F2.\nG94 Y1. F10.\nM30\n%\n",
    );
    becomes(
        "linuxcnc",
        "g20 g90 g17\ng54 m3 s1000\ng0 x1 y2 z.5\ng1 z-.1 f10\nx1.5\nm2\n",
        MM,
        "g21 g90 g17\ng54 m3 s1000\ng0 x25.4 y50.8 z12.7\ng1 z-2.54 f254\nx38.1\nm2\n",
    );
    // G70 of a Sinumerik leaves F in mm/min, G700 does not
    becomes(
        "sinumerik-840d",
        "G71 G90 G17\nG54 S1000 M3\nG0 X25.4 Y0 Z5.08\nG1 Z=-2.54 F254\nG2 X50.8 Y0 CR=12.7\nG1 X=IC(25.4)\nM30\n",
        INCH,
        "G70 G90 G17\nG54 S1000 M3\nG0 X1 Y0 Z0.2\nG1 Z=-0.1 F254\nG2 X2 Y0 CR=0.5\nG1 X=IC(1)\nM30\n",
    );
    becomes(
        "sinumerik-840d",
        "G710 G90 G17\nG54 S1000 M3\nG0 X25.4 Y0 Z5.08\nG1 Z-2.54 F254\nM30\n",
        INCH,
        "G700 G90 G17\nG54 S1000 M3\nG0 X1 Y0 Z0.2\nG1 Z-0.1 F10\nM30\n",
    );
    becomes(
        "grbl",
        "G21 G90 G17\nM3 S1000\nG0 X25.4 Y25.4\nG1 Z-2.54 F254\nM5\nM2\n",
        INCH,
        "G20 G90 G17\nM3 S1000\nG0 X1 Y1\nG1 Z-0.1 F10\nM5\nM2\n",
    );
    // the unit of an Okuma is a parameter
    refused(
        "okuma-osp",
        "G90 G17\nG15 H1\nS1000 M3\nG0 X25.4 Y50.8 Z5.08\nG1 Z-2.54 F254\nM2\n",
        INCH,
        "no code says in which unit",
    );
    // a lathe: X is a diameter, and U a step of it
    becomes(
        "fanuc-30i-lathe-a",
        "%\nO1\nG21 G99 G97 S800 M3\nT0101\nG0 X50.8 Z2.54\nG1 X25.4 F0.254\nW-25.4\nU5.08\nM30\n%\n",
        INCH,
        "%\nO1\nG20 G99 G97 S800 M3\nT0101\nG0 X2. Z0.1\nG1 X1. F0.01\nW-1.\nU0.2\nM30\n%\n",
    );
}

#[test]
fn steps_in_another_unit_do_not_pile_up() {
    let steps = "X1.\n".repeat(100);
    let before = format!("%\nO1\nG21 G90 G17\nG54 M3 S100\nG0 X0. Y0. Z0.\nG91 G1 F100.\n{steps}G90 X100.\nM30\n%\n");
    let after = run("fanuc-30i", &before, INCH).expect("proved");
    let sum: f64 = after
        .lines()
        .filter(|line| line.starts_with("X0.0"))
        .map(|line| line[1..].parse::<f64>().expect("a number"))
        .sum();
    // 100 steps of 0.0394 would be 3.94
    assert!((sum - 100.0 / 25.4).abs() < 0.000_06, "{sum}");
}

#[test]
fn a_unit_that_is_changed_back_gives_the_program_again() {
    let before = "%\nO1\nG20 G90 G17\nG54 M3 S1000\nG0 X1.2345 Y-2.0001\nG43 Z.5 H1\nG1 Z-.125 F12.5\nG2 X2.2345 Y-2.0001 I.5 J0.\nG0 Z1.\nM30\n%\n";
    let there = run_with("fanuc-30i", before, MM, Some(4)).expect("proved");
    assert!(there.contains("G21") && there.contains("X31.3563"), "{there}");
    let back = run("fanuc-30i", &there, INCH).expect("proved");
    let plain = |text: &str| text.replace("0.5", ".5").replace("0.125", ".125");
    assert_eq!(plain(&back), plain(before));
}

#[test]
fn positions_become_steps_and_steps_positions() {
    let absolute = "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X10. Y20. Z5.\nG1 Z-1. F100.\nX30.\nY45.5\nG2 X40. Y55.5 I10. J0.\nG0 Z5.\nM30\n%\n";
    let steps = "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X10. Y20. Z5.\nG1 G91 Z-6. F100.\nX20.\nY25.5\nG2 X10. Y10.0 I10. J0.\nG0 Z6.\nM30\n%\n";
    for name in ["fanuc-30i", "haas-ngc", "linuxcnc"] {
        becomes(name, absolute, INCREMENTAL, steps);
    }
    // back again: the code and the words, each for itself
    becomes(
        "fanuc-30i",
        "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X10. Y20. Z5.\nG91 G1 Z-6. F100.\nX20.\nY25.5\nG0 Z6.\nG28 Z0.\nM30\n%\n",
        ABSOLUTE,
        "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X10. Y20. Z5.\nG90 G1 Z-1. F100.\nX30.\nY45.5\nG0 Z5.\nG28 G91 Z0.\nM30\n%\n",
    );
    refused(
        "fanuc-30i",
        "%\nO1\nG21 G91 G17\nG54 M3 S1000\nG0 X10.\nG1 Z-1. F100.\nM30\n%\n",
        ABSOLUTE,
        "where this step begins is unknown",
    );
    refused(
        "fanuc-30i-lathe-a",
        "%\nO1\nG0 X10. Z1.\nM30\n%\n",
        INCREMENTAL,
        "letters of their own",
    );
}

#[test]
fn a_step_across_another_work_offset_is_not_taken_for_known() {
    // G54 and G55 are not declared: X20 of one is not ten from X10 of the other
    let before = "%\nO1\nG21 G90 G17\nG54 M3 S100\nG0 X10. Y5. Z50.\nG55\nG0 X20. Y6.\nG1 Z-1. F100.\nM30\n%\n";
    let after = run("fanuc-30i", before, INCREMENTAL);
    assert!(after.is_err_and(|why| why.contains("nothing to do")));
}

#[test]
fn a_path_is_shifted() {
    becomes(
        "fanuc-30i",
        "%\nO1\nG21 G90 G17 (X10.)\nG54 M3 S1000\nG0 X10. Y20.\nG43 Z5. H1\nG1 Z-1. F100.\nX30.25\nG2 X40. Y30. I10. J0.\nG91 X1. Y1. R5.\nG90 G0 Z5.\nG81 X0. Y0. R2. Z-3. F50.\nG80\nG91 G28 Z0.\nG53 G90 G0 X0. Y0.\nM30\n%\n",
        shift(10.5, -3.0, 2.0),
        "%\nO1\nG21 G90 G17 (X10.)\nG54 M3 S1000\nG0 X20.5 Y17.\nG43 Z7. H1\nG1 Z1. F100.\nX40.75\nG2 X50.5 Y27. I10. J0.\nG91 X1. Y1. R5.\nG90 G0 Z7.\nG81 X10.5 Y-3. R4. Z-1. F50.\nG80\nG91 G28 Z0.\nG53 G90 G0 X0. Y0.\nM30\n%\n",
    );
    becomes(
        "sinumerik-840d",
        "G71 G90 G17\nG54 S1000 M3\nG0 X10 Y0 Z5\nG1 Z=AC(-2) F200\nX=IC(5)\nG2 X20 Y5 I=AC(15) J=AC(5)\nM30\n",
        shift(1.5, 0.0, 0.0),
        "G71 G90 G17\nG54 S1000 M3\nG0 X11.5 Y0 Z5\nG1 Z=AC(-2) F200\nX=IC(5)\nG2 X21.5 Y5 I=AC(16.5) J=AC(5)\nM30\n",
    );
    becomes(
        "fanuc-30i-lathe-a",
        "%\nO1\nG21 G99 G97 S800 M3\nT0101\nG0 X50. Z2.\nG1 X25. F0.2\nW-25.\nZ-40.\nM30\n%\n",
        shift(0.0, 0.0, -1.5),
        "%\nO1\nG21 G99 G97 S800 M3\nT0101\nG0 X50. Z0.5\nG1 X25. F0.2\nW-25.\nZ-41.5\nM30\n%\n",
    );
    refused(
        "fanuc-30i-lathe-a",
        "%\nO1\nG0 X10. Z1.\nM30\n%\n",
        shift(1.0, 0.0, 0.0),
        "diameters",
    );
}

#[test]
fn a_shift_there_and_back_gives_the_program_again() {
    let before = "G21 G90 G17\nM3 S1000\nG0 X10.5 Y-20 Z5\nG1 Z-1 F100\nX30.25\nG3 X40 Y-10.25 I0 J9.75\nM5\nM2\n";
    for name in ["grbl", "linuxcnc"] {
        let there = run(name, before, shift(0.125, 7.0, -3.5)).expect("proved");
        assert_ne!(there, before);
        let back = run(name, &there, shift(-0.125, -7.0, 3.5)).expect("proved");
        let number = |text: &str| -> Vec<f64> {
            let words = text.split(|c: char| c.is_whitespace() || c.is_ascii_alphabetic());
            words.filter_map(|word| word.parse().ok()).collect()
        };
        assert_eq!(number(&back), number(before), "{back}");
    }
}

#[test]
fn a_mirror_image_turns_arcs_and_compensation() {
    becomes(
        "linuxcnc",
        "G21 G90 G17 G40\nG54 M3 S1000\nG0 X10. Y20. Z5.\nG1 Z-1. F100.\nG02 X30. Y20. I10. J0.\nG3 X40. Y30. R10.\nG91 G1 X5.\nM2\n",
        Edit::Shape(Shape::Mirror(0)),
        "G21 G90 G17 G40\nG54 M3 S1000\nG0 X-10. Y20. Z5.\nG1 Z-1. F100.\nG03 X-30. Y20. I-10. J0.\nG2 X-40. Y30. R10.\nG91 G1 X-5.\nM2\n",
    );
    becomes(
        "fanuc-30i",
        "%\nO1\n(trunnion: tool 1 flat diameter 10)\nT1 M6\nG21 G90 G17 G40\nG54 M3 S1000\nG0 X-20. Y0. Z5.\nG1 Z-1. F100.\nG41 X0. Y10. D1\nY40.\nX30.\nG40 X60. Y60.\nM30\n%\n",
        Edit::Shape(Shape::Mirror(1)),
        "%\nO1\n(trunnion: tool 1 flat diameter 10)\nT1 M6\nG21 G90 G17 G40\nG54 M3 S1000\nG0 X-20. Y0. Z5.\nG1 Z-1. F100.\nG42 X0. Y-10. D1\nY-40.\nX30.\nG40 X60. Y-60.\nM30\n%\n",
    );
    refused(
        "fanuc-30i",
        "%\nO1\nG21 G90 G17\nG54\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\nM30\n%\n",
        Edit::Shape(Shape::Mirror(2)),
        "along the tool",
    );
}

/// Without the radius it is unknown where the tool is: that is the reason, not what follows from it.
#[test]
fn an_undeclared_radius_is_the_reason_for_a_refusal() {
    let text =
        "G21 G90 G17 G40\nG54 M3 S1000\nG0 X-20. Y0. Z5.\nG1 Z-1. F100.\nG41 X0. Y10. D1\nY40.\nG40 X60. Y60.\nM30\n";
    for shape in [
        Edit::Shape(Shape::Mirror(1)),
        shift(1.0, 0.0, 0.0),
        Edit::Shape(Shape::Scale(2.0)),
    ] {
        refused("fanuc-30i", text, shape, "the radius of D1 is not declared");
    }
}

#[test]
fn a_path_is_scaled_by_one_factor() {
    becomes(
        "haas-ngc",
        "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X10. Y20. Z5.\nG1 Z-1. F100.\nG2 X30. Y20. I10. J0.\nG91 G9 G1 X5.\nG90 G81 X0. Y0. R2. Z-10. F50.\nG80\nM30\n%\n",
        Edit::Shape(Shape::Scale(1.5)),
        "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X15. Y30. Z7.5\nG1 Z-1.5 F100.\nG2 X45. Y30. I15. J0.\nG91 G9 G1 X7.5\nG90 G81 X0. Y0. R3. Z-15. F50.\nG80\nM30\n%\n",
    );
    // the tool does not grow with the part
    refused(
        "fanuc-30i",
        "%\nO1\n(trunnion: tool 1 flat diameter 10)\nT1 M6\nG21 G90 G17 G40\nG54 M3 S1000\nG0 X-20. Y0. Z5.\nG1 Z-1. F100.\nG41 X0. Y10. D1\nY40.\nX30.\nG40 X60. Y60.\nM30\n%\n",
        Edit::Shape(Shape::Scale(2.0)),
        "ends at",
    );
    refused(
        "fanuc-30i",
        "%\nO1\nG0 X1.\nM30\n%\n",
        Edit::Shape(Shape::Scale(-1.0)),
        "positive",
    );
}

#[test]
fn a_path_is_turned_about_the_tool() {
    // (x, y) becomes (-y, x)
    becomes(
        "fanuc-30i",
        "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X10. Y20.\nG43 Z5. H1\nG1 Z-1. F100.\nX30.\nG2 X40. Y30. I10.\nG91 G1 Y5.\nG90 G0 Z5.\nM30\n%\n",
        Edit::Shape(Shape::Rotate(2, 90.0)),
        "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X-20. Y10.\nG43 Z5. H1\nG1 Z-1. F100.\nX-20. Y30.\nG2 X-30. Y40. I0. J10.\nG91 G1 X-5. Y0.\nG90 G0 Z5.\nM30\n%\n",
    );
    // cos 60 = 0.5, sin 60 = 0.8660254
    becomes(
        "okuma-osp",
        "G90 G17\nG15 H1\nS1000 M3\nG0 X10 Y0 Z5\nG1 Z-1 F100\nX20\nM2\n",
        Edit::Shape(Shape::Rotate(2, 60.0)),
        "G90 G17\nG15 H1\nS1000 M3\nG0 X5 Y8.66 Z5\nG1 Z-1 F100\nX10 Y17.321\nM2\n",
    );
    refused(
        "fanuc-30i",
        "%\nO1\nG21 G90 G17\nG54\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\nM30\n%\n",
        Edit::Shape(Shape::Rotate(0, 90.0)),
        "about the axis of the tool",
    );
}

#[test]
fn what_is_not_understood_is_refused_by_name() {
    let head = "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X0. Y0. Z5.\n";
    let with = |line: &str| format!("{head}{line}\nG1 X5. F100.\nM30\n%\n");
    let moved = shift(1.0, 1.0, 1.0);
    for (line, asked, part) in [
        ("G52 X1.", moved, "G52"),
        ("G92 X0.", moved, "G92"),
        ("G68 X0. Y0. R30.", moved, "G68"),
        ("G28 X1. Y1.", moved, "intermediate point"),
        ("G1 X#1 F100.", moved, "X#1"),
        ("G10 L2 P1 X1. Y1. Z1.", moved, "G10"),
        ("G1 X[1.+2.] F100.", INCH, "computed"),
        ("G65 P9000 X1.", INCH, "G65"),
        ("G96 S200", INCH, "G96"),
        ("G1 A10. F100.", Edit::Shape(Shape::Scale(2.0)), "rotary axes"),
        ("#500=12.5", INCH, "#500"),
        ("G83 R1. Z-2. Q1. F50.", Edit::Shape(Shape::Scale(2.0)), "peck"),
    ] {
        refused("fanuc-30i", &with(line), asked, part);
    }
    // what never runs is not changed, and so nothing is
    refused(
        "fanuc-30i",
        &format!("{head}GOTO 9\nX7.\nN9 G1 X5. F100.\nM30\n%\n"),
        moved,
        "never runs",
    );
}

#[test]
fn a_subprogram_that_both_calls_use_alike_is_edited_once() {
    let before = "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X0. Y0. Z5.\nM98 P100\nG0 X50. Y0.\nM98 P100\nM30\nO100\nG91 G1 Z-6. F100.\nX10.\nG90 G0 Z5.\nM99\n%\n";
    becomes("fanuc-30i", before, shift(0.0, 0.0, 2.0), &before.replace("Z5.", "Z7."));
    // the steps of the subprogram begin at two places
    refused("fanuc-30i", before, ABSOLUTE, "where this step begins is unknown");
}
