//! Sinumerik: variables of the type STRING, comparisons of texts, and programs called by a text.
use crate::sinumerik_flow::{SINUMERIK, places, said};
use crate::support::lines;

#[test]
fn texts_are_joined_compared_and_jumped_to() {
    let jump = |lines: &str| places(&format!("G0\n{lines}\nX1\nLA1: X2\nM30\n"));
    for lines in [
        "DEF STRING[8] GOAL=\"LA1\"\nGOTOF GOAL",
        "DEF STRING[8] GOAL\nGOAL=\"LA\"\nGOTOF GOAL<<1",
        "DEF STRING[8] GOAL, STEM=\"L\"\nR2=1\nGOAL=STEM<<\"A\" << R2\nGOTOF GOAL",
        "DEF STRING[8] NN=\"A1\"\nIF NN==\"A1\" GOTOF LA1",
        "DEF STRING[8] NN=\"A1\", NO=\"A\"\nIF (NN == NO<<1) AND (NO<>\"B\") GOTOF LA1",
        "DEF STRING[8] NN\nIF NN==\"\" GOTOF LA1",
        "IF \"A\"<>\"B\" GOTOF LA1",
    ] {
        assert_eq!(jump(lines), ["2"], "{lines}");
    }
    assert_eq!(jump("DEF STRING[8] NN=\"A1\"\nIF NN<>\"A1\" GOTOF LA1"), ["1", "2"]);
    // a subprogram has its own
    let called = "DEF STRING[8] NN=\"A\"\nG0\nSUB\nIF NN==\"A\" GOTOF LA1\nX1\nLA1: X2\nM30\n%_N_SUB_SPF\nDEF STRING[8] NN=\"B\"\nM17\n";
    assert_eq!(places(called), ["2"]);
    for (lines, what) in [
        // the text does not fit
        ("DEF STRING[2] NN=\"LA1\"\nGOTOF NN", "3 `NN` not decided: `NN`, a part"),
        // letters of another size: what the control says of them is not documented
        (
            "DEF STRING[2] NN=\"a\"\nIF NN==\"A\" GOTOF LA1",
            "3 `NN==\"A\"` not decided: NN==\"A\": its value",
        ),
        ("DEF STRING[9] NN=\"A\"<<0.5\nGOTOF NN", "3 `NN` not decided"),
        (
            "DEF STRING[9] NN=\"A\"\nIF NN==\"A\" AND 1 GOTOF LA1",
            "3 `NN==\"A\" AND 1` not decided",
        ),
    ] {
        let got = said(&format!("{lines}\nX1\nLA1: X2\nM30\n"));
        assert!(
            got.len() == 1 && got[0].starts_with(&what.replacen('3', "2", 1)),
            "{lines}: {got:?}"
        );
    }
}

#[test]
fn a_program_is_called_by_its_name_in_a_text() {
    let end = "X9\nM30\n%_N_PD_SPF\nPROC PD(REAL AA=3)\nX=AA\nM17\n";
    assert_eq!(places(&format!("G0\nCALL \"PD\"\n{end}")), ["3", "9"]);
    assert_eq!(
        places(&format!("DEF STRING[9] NN=\"P\"\nG0\nCALL NN<<\"D\"\n{end}")),
        ["3", "9"]
    );
    assert_eq!(places(&format!("G0\nPCALL PD(5)\n{end}")), ["5", "9"]);
    assert_eq!(said("G0 X1\nCALL \"NO\"\nM30\n"), ["2 `CALL \"NO\"` missing NO"]);
    for call in [
        "CALL BLOCK LA TO LB",
        "CALL \"/_N_WKS_DIR/PD\"",
        "CALL",
        "PCALL /DIR/PD(1)",
    ] {
        let told = said(&format!("G0 X1\n{call}\nX2\nM30\n"));
        assert!(told[0].contains("which program it calls"), "{call}: {told:?}");
        assert_eq!(
            lines(SINUMERIK, &format!("G0 X1\n{call}\nX2\nM30\n")).len(),
            2,
            "{call}"
        );
    }
}
