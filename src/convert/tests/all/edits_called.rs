//! Edits of programs whose motions are somewhere else: in called files, in blocks of a dwell, in machine coordinates; and of lathes without Y.
use crate::edits::{INCH, INCREMENTAL, MM, becomes, dialect, refused, run_with, shift};
use std::sync::Arc;
use trunnion_convert::{Edit, Shape, edit};
use trunnion_interp::{Files, Library, Loaded, Searched, Setup};
use trunnion_syntax::parse;

struct Folder;

impl Files for Folder {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let text: &[u8] = match name.to_ascii_uppercase().trim_start_matches('O').split('.').next() {
            Some("1000") => b"%\nO1000\nG0 X5. Y5. Z5.\nG1 X9. F100.\nM99\n%\n",
            Some("2000") => b"%\nO2000\nM8\nG4 P1000\nM99\n%\n",
            Some("SUB1") => b"G0 X5 Y5 Z5\nG1 X9 F100\nM17\n",
            Some("SUB") => b"OSUB\nG0 X5. Y5. Z5.\nG1 X9. F100.\nRTS\n",
            Some("LSUB") => b"o<lsub> sub\nG0 X5 Y5 Z5\nG1 X9 F100\no<lsub> endsub\n",
            _ => return Err(vec!["subs".into()]),
        };
        Ok(Loaded {
            path: format!("subs/{name}"),
            bytes: text.into(),
        })
    }
}

const SCALE: Edit = Edit::Shape(Shape::Scale(2.0));
const MIRROR: Edit = Edit::Shape(Shape::Mirror(0));

fn with_files(name: &str, text: &str, asked: Edit) -> Result<String, (bool, String)> {
    let setup = Setup {
        library: Library(Some(Arc::new(Folder))),
        ..Setup::default()
    };
    let dialect = dialect(name);
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    edit(&program, dialect, &setup, asked, None)
        .map(|edited| String::from_utf8(edited.text).expect("text"))
        .map_err(|refused| (refused.is_nothing, refused.to_string()))
}

#[test]
fn a_called_file_that_moves_is_named_for_every_edit() {
    let turn = Edit::Shape(Shape::Rotate(2, 90.0));
    for (name, text) in [
        ("fanuc-30i", "%\nO1\nG21 G90 G17 G54\nS100 M3\nM98 P1000\nM30\n%\n"),
        (
            "fanuc-30i",
            "%\nO1\nG21 G90 G17 G54\nS100 M3\nG0 X1. Y1. Z1.\nM98 P1000\nM30\n%\n",
        ),
        ("sinumerik-840d", "G71 G90 G17 G54\nS100 M3\nSUB1\nM30\n"),
        ("okuma-osp", "G15 H1\nG90 G17\nS100 M3\nCALL OSUB\nM2\n"),
        ("linuxcnc", "G21 G90 G17 G54\nS100 M3\no<lsub> call\nM2\n"),
    ] {
        for asked in [INCH, MM, INCREMENTAL, shift(1.0, 0.0, 0.0), SCALE, MIRROR, turn] {
            match with_files(name, text, asked) {
                Err((false, why)) => assert!(why.contains("a called file is not edited"), "{name} {asked:?}: {why}"),
                other => panic!("{name} {asked:?}: {other:?}"),
            }
        }
    }
    // a file that does not move is no reason
    let text = "%\nO1\nG21 G90 G17 G54\nS100 M3\nG0 X1. Y1. Z1.\nM98 P2000\nM30\n%\n";
    let moved = with_files("fanuc-30i", text, shift(1.0, 0.0, 0.0)).expect("proved");
    assert!(moved.contains("G0 X2. Y1. Z1."), "{moved}");
}

#[test]
fn axes_in_the_block_of_a_dwell_of_linuxcnc_move() {
    // where the dwell is, is unknown, and its words differ
    refused(
        "linuxcnc",
        "G21 G90 G17 G54\nS100 M3\nG4 P1 G0 X5 Y5 Z5\nG4 P1 G1 X9 F100\nM2\n",
        MIRROR,
        "the blocks say different things",
    );
    let text = "G21 G90 G17 G54\nS100 M3\nG0 X1 Y1 Z1\nG4 P1 G1 X9 F100\nM2\n";
    match with_files("linuxcnc", text, MIRROR) {
        Ok(after) => assert!(after.contains("G4 P1 G1 X-9 F100"), "{after}"),
        Err((is_nothing, why)) => assert!(!is_nothing, "{why}"),
    }
}

#[test]
fn a_program_that_does_not_move_has_nothing_to_edit() {
    let text = "%\nO1\nG21 G90 G17 G54\nS100 M3\nM98 P2000\nM30\n%\n";
    for asked in [shift(1.0, 0.0, 0.0), SCALE, MIRROR] {
        let (is_nothing, why) = with_files("fanuc-30i", text, asked).expect_err("nothing");
        assert!(is_nothing, "{why}");
    }
    // Z is not mirrored with X, but where it cuts in X is unknown
    let text = "%\nO1\nG21 G90 G17 G54\nS100 M3\nG0 Z5.\nG1 Z-5. F100.\nM30\n%\n";
    let (is_nothing, why) = with_files("fanuc-30i", text, MIRROR).expect_err("refused");
    assert!(!is_nothing && why.contains("where this cut begins in X"), "{why}");
}

#[test]
fn machine_coordinates_of_linuxcnc_stay() {
    becomes(
        "linuxcnc",
        "G21 G90 G17\nS100 M3\nG0 X0 Y0 Z10\nG53 G0 Z0\nG0 X1 Y1 Z5\nG1 X3 F50\nM2\n",
        shift(0.0, 0.0, -2.0),
        "G21 G90 G17\nS100 M3\nG0 X0 Y0 Z8\nG53 G0 Z0\nG0 X1 Y1 Z3\nG1 X3 F50\nM2\n",
    );
    // a cut that begins there would not move with the part
    refused(
        "linuxcnc",
        "G21 G90 G17\nS100 M3\nG0 X0 Y0 Z10\nG53 G0 Z0\nG1 X3 F50\nM2\n",
        shift(0.0, 0.0, -2.0),
        "where this cut begins in Z",
    );
}

#[test]
fn a_lathe_of_two_axes_is_scaled() {
    becomes(
        "fanuc-30i-lathe-a",
        "%\nO1\nG21 G99 G97 S800 M3\nT0101\nG0 X50. Z2.\nG1 X25. F0.2\nZ-25.\nG2 X35. Z-30. R5.\nG0 Z10.\nM30\n%\n",
        SCALE,
        "%\nO1\nG21 G99 G97 S800 M3\nT0101\nG0 X100. Z4.\nG1 X50. F0.2\nZ-50.\nG2 X70. Z-60. R10.\nG0 Z20.\nM30\n%\n",
    );
    // a mill has a Y
    refused(
        "fanuc-30i",
        "%\nO1\nG21 G90 G18 G54\nS100 M3\nG0 X5. Z2.\nG1 X2. F50.\nM30\n%\n",
        SCALE,
        "where this cut begins in Y",
    );
}

#[test]
fn what_is_not_said_about_the_unit_is_not_claimed() {
    for (name, text) in [
        (
            "fanuc-30i",
            "%\nO1\nG90 G17 G54\nS100 M3\nG0 X5. Y5. Z5.\nG1 X6. F100.\nM30\n%\n",
        ),
        (
            "okuma-osp",
            "G15 H1\nG90 G17\nS100 M3\nG0 X5. Y0 Z10.\nG1 X7. F100.\nM2\n",
        ),
    ] {
        for asked in [INCH, MM] {
            refused(name, text, asked, "no code says in which unit");
        }
    }
    for asked in [INCH, MM] {
        let why = run_with("okuma-osp", "G15 H1\nG90 G17\nS100 M3\nM2\n", asked, None).expect_err("nothing");
        assert!(why.contains("no lengths and no feeds"), "{why}");
    }
    // rigid tapping is the same in both units
    let text = "%\nO1\nG21 G90 G17 G54\nS1000 M3\nG0 X25.4 Y0. Z50.8\nM29 S500\nG84 Z-25.4 R2.54 F254.\nG80\nM30\n%\n";
    let inch = run_with("fanuc-30i", text, INCH, None).expect("proved");
    assert!(inch.contains("M29 S500\nG84 Z-1. R0.1 F10."), "{inch}");
}
