//! Edits of some blocks of a program; all others do what they did.
use crate::edits::{INCH, INCREMENTAL, dialect, shift};
use trunnion_certify::certify_change;
use trunnion_convert::{Edit, Edited, Part, Shape, edit_part};
use trunnion_interp::Setup;
use trunnion_syntax::{Address, BlockId, TextEdit, Value, apply_edits, parse};

/// Two pockets; lines are blocks, from 0. Lines 4 to 7 are the first pocket with its approach.
const POCKETS: &str = "G21 G90 G17 G94 G54\nM3 S1000\nG0 X0. Y0.\nG0 Z50.\nG0 X10. Y10. Z2.\nG1 Z-1. F100.\nG2 X20. Y10. I5. J0.\nG1 X10. Y10.\nG0 Z50.\nG0 X40. Y10. \
                       Z2.\nG1 Z-1. F100.\nX50.\nG0 X40. Y10. Z50.\nM30\n";

fn part(text: &str, asked: Edit, first: u32, last: u32) -> Result<Edited, String> {
    let fanuc = dialect("fanuc-30i");
    let program = parse(text.as_bytes().to_vec(), fanuc.lex);
    let blocks = Part {
        first: BlockId(first),
        last: BlockId(last),
    };
    edit_part(&program, fanuc, &Setup::default(), asked, None, Some(blocks)).map_err(|refused| refused.to_string())
}

#[track_caller]
fn becomes(asked: Edit, (first, last): (u32, u32), lines: &[(usize, &str)]) {
    let edited = part(POCKETS, asked, first, last).unwrap_or_else(|why| panic!("{asked:?}: {why}"));
    let mut expected: Vec<&str> = POCKETS.lines().collect();
    for (at, line) in lines {
        expected[*at] = line;
    }
    let text = String::from_utf8(edited.text).expect("text");
    assert_eq!(text.lines().collect::<Vec<_>>(), expected, "{asked:?}");
}

#[test]
fn the_chosen_blocks_move_and_the_others_stay() {
    becomes(
        shift(3.0, 0.0, -0.5),
        (4, 7),
        &[
            (4, "G0 X13. Y10. Z1.5"),
            (5, "G1 Z-1.5 F100."),
            (6, "G2 X23. Y10. I5. J0."),
            (7, "G1 X13. Y10."),
        ],
    );
    becomes(
        Edit::Shape(Shape::Mirror(0)),
        (4, 7),
        &[
            (4, "G0 X-10. Y10. Z2."),
            (6, "G3 X-20. Y10. I-5. J0."),
            (7, "G1 X-10. Y10."),
        ],
    );
    becomes(
        Edit::Shape(Shape::Rotate(2, 90.0)),
        (4, 7),
        &[
            (4, "G0 X-10. Y10. Z2."),
            (6, "G2 X-10. Y20. I0. J5."),
            (7, "G1 X-10. Y10."),
        ],
    );
    becomes(
        INCREMENTAL,
        (5, 7),
        &[
            (5, "G1 G91 Z-3. F100."),
            (6, "G2 X10. Y0. I5. J0."),
            (7, "G1 X-10. Y0."),
            (8, "G0 G90 Z50."),
        ],
    );
    let said = part(POCKETS, shift(3.0, 0.0, 0.0), 4, 7)
        .expect("it is proved")
        .notes
        .join(" ");
    assert!(said.contains("take another way"), "{said}");
}

#[test]
fn a_part_that_would_bend_a_cut_is_refused() {
    for (asked, first, last, reason) in [
        // the last cut of the pocket stays, and would begin elsewhere
        (shift(3.0, 0.0, 0.0), 4, 6, "not among the blocks that are moved"),
        // the rapid that leads to the pocket stays
        (shift(3.0, 0.0, 0.0), 5, 7, "where this cut begins in X"),
        (shift(0.0, 0.0, 1.0), 9, 10, "not among the blocks that are moved"),
        (INCH, 4, 7, "one unit"),
    ] {
        let why = part(POCKETS, asked, first, last).expect_err(&format!("{first} to {last} {asked:?}"));
        assert!(why.contains(reason), "{first} to {last}: {why}");
    }
    // a step after the part begins where the part ends
    let steps = POCKETS.replace("G0 X40. Y10. Z2.", "G91 G0 X30. Z-48.\nG90");
    let why = part(&steps, shift(3.0, 0.0, 0.0), 4, 7).expect_err("the step would lead elsewhere");
    assert!(why.contains("X ends at"), "{why}");
}

/// No other number of the program after is proved, in the part and outside of it.
#[test]
fn any_other_number_is_found() {
    let fanuc = dialect("fanuc-30i");
    let setup = Setup::default();
    let before = parse(POCKETS.as_bytes().to_vec(), fanuc.lex);
    let mut tried = 0;
    for asked in [shift(3.0, 1.0, -0.5), Edit::Shape(Shape::Mirror(0)), INCREMENTAL] {
        let edited = part(POCKETS, asked, 4, 7).expect("it is proved");
        let after = parse(edited.text.clone(), fanuc.lex);
        for word in after.blocks().flat_map(|block| block.words()) {
            let (Address::Letter(b'X' | b'Y' | b'Z' | b'I' | b'F'), Value::Number(number)) = (word.address, word.value)
            else {
                continue;
            };
            let edit = TextEdit {
                range: word.value_range,
                new_text: format!("{:.4}", number.to_f64() + 0.05),
            };
            let wrong = parse(apply_edits(&edited.text, &[edit]).expect("one edit"), fanuc.lex);
            let found = certify_change([&before, &wrong], fanuc, &setup, &edited.change);
            assert!(found.is_err(), "{asked:?}: {} may be wrong", after.text(word.range));
            tried += 1;
        }
    }
    assert!(tried > 60, "{tried}");
}

/// Blocks whose words do not name the axis cannot be moved along it; blocks that do not move have nothing to do.
#[test]
fn without_words_to_change_the_blocks_must_be_where_the_edit_puts_them() {
    let along_y = shift(0.0, 3.0, 0.0);
    let still = part(POCKETS, along_y, 11, 11).expect_err("X50. is a cut at Y10.");
    assert!(still.contains("cannot be proved"), "{still}");
    let nothing = part(POCKETS, along_y, 0, 1).expect_err("G codes alone");
    assert!(nothing.contains("nothing to do"), "{nothing}");
}
