//! The proof of edits: words that are wrong after an edit are found, opposites give the program again; and edits of Klartext.
use crate::edits::{INCH, INCREMENTAL, MM, becomes, dialect, refused, run_with, shift};
use trunnion_certify::{Change, certify_change};
use trunnion_convert::{Edit, Shape, edit};
use trunnion_interp::Setup;
use trunnion_syntax::{Address, TextEdit, Value, apply_edits, parse};

/// Two programs that hold most of what an edit changes.
const PARTS: [(&str, &str); 2] = [
    (
        "fanuc-30i",
        "%\nO1\nG21 G90 G17 G40 G80\nT1 M6\nG54 S1000 M3\nG0 X12. Y-20.\nG43 Z5. H1\nG1 Z-1. F100.\nX30.\nG2 X40. Y-10. I0. J10.\nG3 X50. Y0. R10.\nG91 G1 X2.5 Y1.\nX-1.\nG90 G0 Z5.\nG83 X3. Y4. R2. Z-10. Q4. \
         F50.\nX8.\nG80\nG91 G28 Z0.\nG90 M30\n%\n",
    ),
    (
        "sinumerik-840d",
        "G710 G90 G17 G40\nG54 S1000 M3\nG0 X12 Y-20 Z5\nG1 Z-1 F100\nX30\nG2 X40 Y-10 I0 J10\nG3 X50 Y0 CR=10\nG1 X=IC(2.5) Y=AC(3)\nG0 Z5\nM30\n",
    ),
];

const MOVES: [Edit; 7] = [
    INCH,
    INCREMENTAL,
    Edit::Shape(Shape::Shift([1.25, -3.0, 0.5])),
    Edit::Shape(Shape::Mirror(0)),
    Edit::Shape(Shape::Mirror(1)),
    Edit::Shape(Shape::Rotate(2, 90.0)),
    Edit::Shape(Shape::Rotate(2, 33.3)),
];

#[test]
fn a_word_that_is_wrong_after_the_edit_is_found() {
    let mut tried = 0;
    for (name, text) in PARTS {
        let dialect = dialect(name);
        let setup = Setup::default();
        let before = parse(text.as_bytes().to_vec(), dialect.lex);
        for asked in MOVES {
            if name == "sinumerik-840d" && asked == MOVES[6] {
                // IC and AC in one block
                continue;
            }
            let edited = match edit(&before, dialect, &setup, asked, None) {
                Ok(edited) => edited,
                Err(why) if asked == MOVES[5] && name == "sinumerik-840d" => {
                    assert!(why.to_string().contains("in one block"), "{why}");
                    continue;
                }
                Err(why) => panic!("{name} {asked:?}: {why}"),
            };
            let after = parse(edited.text.clone(), dialect.lex);
            let words: Vec<_> = after
                .blocks()
                .flat_map(|block| block.words().collect::<Vec<_>>())
                .collect();
            for word in words {
                let Address::Letter(letter @ (b'X'..=b'Z' | b'I'..=b'K' | b'R' | b'F' | b'Q' | b'S' | b'H')) =
                    word.address
                else {
                    continue;
                };
                let Value::Number(number) = word.value else { continue };
                let edit = TextEdit {
                    range: word.value_range,
                    new_text: format!("{:.4}", number.to_f64() + 0.05),
                };
                // numbers of offsets are whole
                let edit = if letter == b'H' {
                    TextEdit {
                        new_text: "2".to_owned(),
                        ..edit
                    }
                } else {
                    edit
                };
                let wrong = apply_edits(&edited.text, &[edit]).expect("one edit");
                let wrong = parse(wrong, dialect.lex);
                let found = certify_change([&before, &wrong], dialect, &setup, &edited.change);
                let place = after.text(word.range);
                assert!(found.is_err(), "{name} {asked:?}: {place} may be wrong");
                tried += 1;
            }
        }
    }
    assert!(tried > 200, "{tried}");
}

#[test]
fn edits_and_their_opposites_give_the_numbers_again() {
    let numbers = |text: &str| -> Vec<f64> {
        let words = text.split(|c: char| c.is_whitespace() || c.is_ascii_alphabetic() || "=()".contains(c));
        words.filter_map(|word| word.parse().ok()).collect()
    };
    for (name, text) in PARTS {
        for (there, back) in [
            (MOVES[2], Edit::Shape(Shape::Shift([-1.25, 3.0, -0.5]))),
            (MOVES[3], MOVES[3]),
            (MOVES[4], MOVES[4]),
            (INCH, MM),
        ] {
            let moved = run_with(name, text, there, Some(6)).unwrap_or_else(|why| panic!("{name} {there:?}: {why}"));
            let again = run_with(name, &moved, back, Some(3)).unwrap_or_else(|why| panic!("{name} {back:?}: {why}"));
            let (was, is) = (numbers(text), numbers(&again));
            assert_eq!(was.len(), is.len(), "{again}");
            assert!(was.iter().zip(&is).all(|(a, b)| (a - b).abs() < 1.1e-3), "{again}");
        }
    }
}

/// CYCL DEF 247 activates a row of the preset table: none of its words is a length.
#[test]
fn klartext_with_a_preset_is_edited() {
    let part = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nCYCL DEF 247 DATUM SETTING ~\n Q339=+1 ;DATUM NUMBER\nL X+0 Y+0 Z+50 R0 FMAX M3\nL Z-2 F300\nL X+29 Y-49\nL Z+50 FMAX M2\nEND PGM A MM\n";
    becomes(
        "heidenhain-klartext",
        part,
        shift(1.0, 0.0, 0.0),
        &part.replace("X+0 ", "X+1 ").replace("X+29", "X+30"),
    );
    becomes(
        "heidenhain-klartext",
        part,
        Edit::Shape(Shape::Mirror(1)),
        &part.replace("Y-49", "Y+49"),
    );
}

#[test]
fn klartext_is_edited_as_far_as_its_words_are_known() {
    let part = "0 BEGIN PGM A MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-25.4\n2 BLK FORM 0.2 X+127 Y+127 Z+0\n3 TOOL CALL 1 Z S1000\n4 L X+25.4 Y-50.8 R0 FMAX M3\n5 L Z+5.08 FMAX\n6 L Z-2.54 R0 F254\n7 CC X+50.8 \
                Y-50.8\n8 C X+76.2 Y-50.8 DR-\n9 CR X+101.6 Y-25.4 R+25.4 DR+\n10 L IX-12.7\n11 L Z+5.08 FMAX M30\n12 END PGM A MM\n";
    // F is in tenths of an inch
    becomes(
        "heidenhain-klartext",
        part,
        INCH,
        "0 BEGIN PGM A INCH\n1 BLK FORM 0.1 Z X+0 Y+0 Z-1\n2 BLK FORM 0.2 X+5 Y+5 Z+0\n3 TOOL CALL 1 Z S1000\n4 L X+1 Y-2 R0 FMAX M3\n5 L Z+0.2 FMAX\n6 L Z-0.1 R0 F100\n7 CC X+2 Y-2\n8 C X+3 \
         Y-2 DR-\n9 CR X+4 Y-1 R+1 DR+\n10 L IX-0.5\n11 L Z+0.2 FMAX M30\n12 END PGM A INCH\n",
    );
    becomes(
        "heidenhain-klartext",
        part,
        shift(1.0, 0.0, -0.5),
        &part
            .replace("X+25.4", "X+26.4")
            .replace("X+50.8", "X+51.8")
            .replace("X+76.2", "X+77.2")
            .replace("X+101.6", "X+102.6")
            .replace("Z+5.08", "Z+4.58")
            .replace("Z-2.54", "Z-3.04"),
    );
    becomes(
        "heidenhain-klartext",
        part,
        Edit::Shape(Shape::Mirror(0)),
        &part
            .replace("L X+25.4", "L X-25.4")
            .replace("X+50.8", "X-50.8")
            .replace("X+76.2", "X-76.2")
            .replace("X+101.6", "X-101.6")
            .replace("IX-12.7", "IX+12.7")
            .replace("DR-", "DR#")
            .replace("DR+", "DR-")
            .replace("DR#", "DR+"),
    );
    refused("heidenhain-klartext", part, INCREMENTAL, "IX");
    refused(
        "heidenhain-klartext",
        &part.replace("IX-12.7", "X+Q5"),
        shift(1.0, 0.0, 0.0),
        "computed",
    );
    refused(
        "heidenhain-klartext",
        &part.replace("10 L IX-12.7", "10 CYCL CALL"),
        shift(1.0, 0.0, 0.0),
        "CYCL",
    );
}

#[test]
fn what_nobody_declares_proves_nothing() {
    // X20 of G55 is ten from X10 of G54 only if both are at one place
    let head = "%\nO1\nG21 G90 G17\nG54 M3 S100\nG0 X10. Y5. Z50.\nG55\n";
    let absolute = format!("{head}G0 X20. Y5.\nG1 Z-1. F100.\nM30\n%\n");
    let steps = format!("{head}G91 G0 X10. Y0.\nG90 G1 Z-1. F100.\nM30\n%\n");
    let dialect = dialect("fanuc-30i");
    let [absolute, steps] = [absolute, steps].map(|text| parse(text.into_bytes(), dialect.lex));
    let same = Change::nothing(1e-6, 1e-6, 1e-9);
    let setup = Setup::default();
    assert!(certify_change([&absolute, &absolute], dialect, &setup, &same).is_ok());
    assert!(certify_change([&absolute, &steps], dialect, &setup, &same).is_err());
}

#[test]
fn rotary_axes_are_shifted_under_tip_control_only() {
    let part = |on: &str| {
        format!(
            "%\nO1\nG21 G90 G17 G94\nT1 M6\nS1000 M3\n{on}\nG0 X1. Y2. Z60. A10. C20.\nG1 X3. Y2. Z60. A12. C25. F500.\nM30\n%\n"
        )
    };
    let guided = part("G43.4 H1");
    becomes(
        "fanuc-30i",
        &guided,
        shift(1.0, 0.0, 0.5),
        &guided
            .replace("X1. ", "X2. ")
            .replace("X3. ", "X4. ")
            .replace("Z60. ", "Z60.5 "),
    );
    refused(
        "fanuc-30i",
        &part("G43 H1"),
        shift(1.0, 0.0, 0.5),
        "without tool centre point control",
    );
    refused("fanuc-30i", &guided, Edit::Shape(Shape::Mirror(0)), "rotary axes");
}

#[test]
fn an_edit_holds_with_blocks_run_and_skipped() {
    let part =
        |line: &str| format!("%\nO1\nG21 G90 G17\nG54 M3 S100\nG0 X1. Y2. Z5.\n{line}\nG1 Z-1. F100.\nX3.\nM30\n%\n");
    becomes(
        "fanuc-30i",
        &part("/G0 X7."),
        shift(1.0, 0.0, 0.0),
        &part("/G0 X8.").replace("X1.", "X2.").replace("X3.", "X4."),
    );
    // the step begins where the skipped block would have led
    refused(
        "fanuc-30i",
        &part("/G0 X7.").replace("\nX3.", "\nX9."),
        INCREMENTAL,
        "skipped",
    );
    refused(
        "fanuc-30i",
        &part("/G0 X7.\n/2 G0 X8."),
        shift(1.0, 0.0, 0.0),
        "several switches",
    );
}

/// A tool length acts along Z alone: X and Y stay where the rapid before it has put them.
#[test]
fn a_tool_length_after_the_first_rapid_does_not_hinder_a_scale() {
    let (head, tail) = ("G21 G17 G90 G40 G80 G94\nT1 M6\nG54 S3000 M3\n", "G0 Z75.\nM30\n");
    let scale = Edit::Shape(Shape::Scale(1.5));
    becomes(
        "fanuc-30i",
        &format!(
            "{head}G0 X1. Y1.\nG43 H1 Z50.\nZ2.\nG1 Z-1. F200.\nX20.\n{}",
            tail.replace("75.", "50.")
        ),
        scale,
        &format!("{head}G0 X1.5 Y1.5\nG43 H1 Z75.\nZ3.\nG1 Z-1.5 F200.\nX30.\n{tail}"),
    );
    // in G18 the length acts along Y
    refused(
        "fanuc-30i",
        &format!("{head}G18\nG0 X1. Y1.\nG43 H1 Z50.\nG1 Z-1. F200.\nX20.\n{tail}"),
        scale,
        "where this cut begins",
    );
}

#[test]
fn the_drilling_cycles_of_linuxcnc_are_moved() {
    let head = "G90 G17 G40 G49 G80 G21 G94\nT1 M6\nG54\nS3000 M3\nG0 X1 Y1\nG43 H1 Z50\n";
    for cycle in [
        "G98 G81 X5 Y5 Z-5 R2 F100",
        "G98 G83 X5 Y5 Z-5 R2 Q1 F100",
        "G98 G82 X5 Y5 Z-5 R2 P1 F100",
    ] {
        let source = format!("{head}{cycle}\nX9\nG80\nG0 Z50\nM30\n");
        let wanted = source.replace("X1 ", "X2 ").replace("X5", "X6").replace("X9", "X10");
        becomes("linuxcnc", &source, shift(1.0, 0.0, 0.0), &wanted);
        refused("linuxcnc", &source, Edit::Shape(Shape::Scale(2.0)), "clearance");
    }
    let source = format!("{head}G98 G81 X5 Y5 Z-5 R2 F100\nG80\nG0 Z50\nM30\n");
    let wanted = source.replace("Z50", "Z51").replace("Z-5 R2", "Z-4 R3");
    becomes("linuxcnc", &source, shift(0.0, 0.0, 1.0), &wanted);
}
