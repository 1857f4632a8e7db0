//! Random programs: no panic, nothing refused, nothing lost, and a second layout changes nothing.
use crate::support::{dialect, laid_with, program};
use proptest::prelude::*;
use trunnion_dialect::BUILTIN_NAMES;
use trunnion_interp::Setup;
use trunnion_layout::{Case, Layout, Spacing, Style, Zeros, layout};

fn styles() -> impl Strategy<Value = Style> {
    let case = prop_oneof![Just(Case::Upper), Just(Case::Lower), Just(Case::Keep)];
    let spacing = prop_oneof![Just(Spacing::One), Just(Spacing::Packed)];
    let zeros = prop_oneof![Just(Zeros::Keep), Just(Zeros::Drop), Just(Zeros::Two)];
    (case, spacing, zeros, proptest::option::of(1u16..60), 0u8..5, 0u8..3).prop_map(
        |(case, spacing, zeros, comment_column, indent, blank_lines)| Style {
            case,
            spacing,
            zeros,
            comment_column,
            indent,
            blank_lines,
        },
    )
}

/// Pieces that mean something together, in any order.
#[expect(clippy::too_many_lines, reason = "it is one list")]
fn pieces() -> impl Strategy<Value = Vec<u8>> {
    let piece = proptest::sample::select(vec![
        "G1",
        "g01",
        "X1.5",
        "y-.5",
        "X 2",
        "Z - 3.",
        " ",
        "   ",
        "\t",
        "\n",
        "\n\n\n",
        "\r\n",
        "\r",
        "(c)",
        "( d )",
        "(",
        ")",
        "[",
        "]",
        "#",
        "#1",
        "#<a b>",
        "=",
        "+",
        "-",
        "*",
        "/",
        "/2",
        "%",
        ":",
        ";e  ",
        "/*",
        "*/",
        "$",
        "$$",
        "\"t\"",
        "'",
        ",",
        ".",
        "1",
        "2 3",
        "R1",
        "IF",
        "GOTO",
        "GOTO/",
        "DO1",
        "END1",
        "WHILE",
        "o1 while",
        "o1 endwhile",
        "o<x> sub",
        "o1",
        "O100",
        "CYCLE800",
        "(1,2)",
        "AND",
        "SIN",
        "N10",
        "n5",
        "M30",
        "T1M6",
        "F100",
        "S1000M3",
        "PARTNO a",
        "\u{feff}",
        "\u{0}",
        "ä",
        "e1",
        "@1^2",
        "DEF REAL A",
        "LABEL:",
        "MSG(\"x\")",
        ";",
        "FROM/1,2,3",
        "$\n",
        "DPRNT[a]",
        "G2X1Y1R1",
        "G4P1",
        "*57",
        "\n$ Y1",
        "$A.MIN%",
        "NLAP1 ",
        "\nOAB\n",
        "X=V1+2",
        "#1FH",
        "CALL OAB Q2 AB=1",
        "IF R1==1",
        "ENDIF",
        "X1",
        "Y1.5E1",
        "LOOP",
        "UNTIL",
        "CASE R1 OF",
        "_A1",
    ]);
    let piece = prop_oneof![
        9 => piece.prop_map(|text| text.as_bytes().to_vec()),
        1 => proptest::collection::vec(any::<u8>(), 1..3),
    ];
    proptest::collection::vec(piece, 0..60).prop_map(|pieces| pieces.concat())
}

/// `PROPTEST_CASES=20000` is the long form.
fn cases() -> ProptestConfig {
    let asked = ProptestConfig::default();
    ProptestConfig {
        cases: asked.cases.max(3000),
        ..asked
    }
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn any_text_in_any_dialect_is_stable_and_never_refused(
        text in pieces(), style in styles(), which in 0..BUILTIN_NAMES.len()
    ) {
        let name = BUILTIN_NAMES[which];
        let once = laid_with(&text, name, &style);
        let twice = laid_with(&once, name, &style);
        prop_assert_eq!(String::from_utf8_lossy(&once), String::from_utf8_lossy(&twice));
        let visible = |text: &[u8]| -> Vec<u8> {
            let kept = text.iter().filter(|byte| !byte.is_ascii_whitespace() && **byte != b'0');
            kept.map(u8::to_ascii_uppercase).collect()
        };
        prop_assert_eq!(visible(&text), visible(&once), "nothing but blanks, zeros and case");
    }

    #[test]
    fn random_bytes_are_survived(text in proptest::collection::vec(any::<u8>(), 0..300), which in 0..BUILTIN_NAMES.len()) {
        let dialect = dialect(BUILTIN_NAMES[which]);
        let outcome = layout(&program(&text, dialect), dialect, &Setup::default(), &Style::default());
        prop_assert!(!matches!(outcome, Layout::Refused(_)), "{:?}", outcome);
    }
}

/// The texts of `proptest-regressions`, whatever the seeds there make of another list of pieces.
#[test]
fn texts_that_were_once_wrong_are_laid_out() {
    let listed = include_str!("../proptest-regressions/random.txt");
    let texts = listed.lines().filter_map(|line| {
        let (_, rest) = line.split_once("shrinks to text = [")?;
        let (numbers, _) = rest.split_once(']')?;
        numbers
            .split(", ")
            .map(|number| number.parse().ok())
            .collect::<Option<Vec<u8>>>()
    });
    let texts: Vec<_> = texts.collect();
    assert!(texts.len() > 10, "{} texts", texts.len());
    for text in texts {
        for name in BUILTIN_NAMES {
            for zeros in [Zeros::Keep, Zeros::Two] {
                let style = Style {
                    zeros,
                    ..Style::default()
                };
                let once = laid_with(&text, name, &style);
                assert_eq!(laid_with(&once, name, &style), once, "{name} {text:?}");
            }
        }
    }
}

/// A name with arguments after a lone carriage return, found by the property above.
#[test]
fn a_message_before_a_jump_is_laid_out() {
    let style = Style {
        case: Case::Upper,
        spacing: Spacing::One,
        zeros: Zeros::Keep,
        comment_column: None,
        ..Style::default()
    };
    let text = b"\r%MSG(\"x\")GOTO/G1\rG1G2X1Y1R1G2X1Y1R1";
    for name in BUILTIN_NAMES {
        let dialect = dialect(name);
        let outcome = layout(&program(text, dialect), dialect, &Setup::default(), &style);
        assert!(!matches!(outcome, Layout::Refused(_)), "{name}: {outcome:?}");
    }
}

/// Found by the test above, in Klartext and grbl.
#[test]
fn blank_lines_and_blanks_before_a_command_are_laid_out() {
    for name in BUILTIN_NAMES {
        for text in [" ", "\n\n\n", " $A.MIN%", "\t$H"] {
            laid_with(text.as_bytes(), name, &Style::default());
        }
    }
}
