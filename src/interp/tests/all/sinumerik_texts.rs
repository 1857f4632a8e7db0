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

/// Programming Manual, Job Planning, string operations: the first character has the index 0, and a character of a variable can be replaced.
#[test]
fn functions_and_parts_of_texts_have_values() {
    let at = |declared: &str, value: &str| places(&format!("{declared}\nG0\nX={value}\nM30\n"));
    let name = "DEF STRING[30] NN=\"Axis 12.5 ax\", FF[2,2]=SET(\"a\",,\"cd\")";
    for (value, wanted) in [
        ("STRLEN(NN)", "12"),
        ("STRLEN(\"\")", "0"),
        ("2*STRLEN(NN)+1", "25"),
        ("INDEX(NN,\"1\")", "5"),
        ("RINDEX(NN,\" \")", "9"),
        ("MINDEX(NN,\".2\")", "6"),
        ("MATCH(NN,\"12\")", "5"),
        ("NUMBER(SUBSTR(NN,5,4))", "12.5"),
        ("ISNUMBER(\"-3\")", "1"),
        ("STRLEN(SUBSTR(NN,10))", "2"),
        ("STRLEN(FF[1,0])", "2"),
        ("STRLEN(FF[0,1])", "0"),
        ("NUMBER(<<7)", "7"),
        ("STRLEN(SPRINT(\"%D-%.3S-%5S.%X\",R1+4,NN,\"ab\",255))", "14"),
    ] {
        assert_eq!(at(&format!("R1=1\n{name}"), value), [wanted], "{value}");
    }
    for value in [
        // letters of another size, nothing found, a part behind the end
        "INDEX(NN,\"a\")",
        "INDEX(NN,\"z\")",
        "STRLEN(SUBSTR(NN,10,3))",
        "NUMBER(NN)",
        "NUMBER(\"1EX2\")",
        "STRLEN(SPRINT(\"%F\",1.5))",
    ] {
        let got = said(&format!("{name}\nG0\nX={value}\nM30\n"));
        assert!(
            got.len() == 1 && got[0].contains("its value is unknown here"),
            "{value}: {got:?}"
        );
    }
    let jump = |lines: &str| places(&format!("G0\n{lines}\nX1\nLA1: X2\nM30\n"));
    for lines in [
        "DEF STRING[8] NN=\"LB1\"\nNN[1]=\"A\"\nGOTOF NN",
        "DEF STRING[8] NN=\"xla1\"\nGOTOF TOUPPER(SUBSTR(NN,1))",
        "DEF STRING[8] NN[3]\nNN[2]=\"LA1\"\nGOTOF NN[2]",
        "DEF STRING[8] NN[3]=REP(\"LA1\")\nGOTOF NN[1]",
        "DEF STRING[8] NN[2]\nNN[0]=SET(\"X\",\"LA\")\nGOTOF NN[1]<<1",
        "DEF STRING[8] NN=\"LA1\"\nDEF CHAR CC\nCC=NN[1]\nIF CC==\"A\" GOTOF LA1",
        "DEF STRING[8] NN=\"xA1\"\nIF NN[1]==\"A\" GOTOF LA1",
    ] {
        assert_eq!(jump(lines), ["2"], "{lines}");
    }
    // the whole text is lost with an index that is not known, or a character behind the end
    for lines in [
        "NN[R9]=\"A\"\nGOTOF NN",
        "NN[3]=\"A\"\nGOTOF NN",
        "NN[1]=\"AA\"\nGOTOF NN",
        "NN[1]=65\nGOTOF NN",
    ] {
        let got = said(&format!("DEF STRING[8] NN=\"LA1\"\n{lines}\nX1\nLA1: X2\nM30\n"));
        assert!(got.iter().any(|one| one.contains("not decided")), "{lines}: {got:?}");
    }
}

/// Thousands of brackets inside brackets: a text with more than a few is not followed, and the run ends.
#[test]
fn brackets_inside_texts_end() {
    for (before, inside, after) in [
        ("IF ", "NN<<(", "==\"A\" GOTOF LA1"),
        ("X=", "STRLEN(<<", ""),
        ("X=STRLEN(", "SUBSTR(", ")"),
        ("X=STRLEN(", "NN[", ")"),
    ] {
        for count in [4, 20_000] {
            let close = if inside.ends_with('[') { "]" } else { ")" };
            let line = format!("{before}{}1{}{after}", inside.repeat(count), close.repeat(count));
            let got = said(&format!("DEF STRING[8] NN=\"A\"\nG0\n{line}\nX1\nLA1: X2\nM30\n"));
            assert!(count < 9 || !got.is_empty(), "{before}{inside}: {got:?}");
        }
    }
}

#[test]
fn texts_are_handed_to_subprograms_and_back() {
    let end =
        "X9\nM30\n%_N_PD_SPF\nPROC PD(STRING[9] AA, INT NN=3, STRING[9] BB=\"12\")\nX=STRLEN(AA)+NN+NUMBER(BB)\nM17\n";
    let call = |call: &str| places(&format!("DEF STRING[9] NN=\"abc\"\nG0\n{call}\n{end}"));
    assert_eq!(call("PD(\"ab\")"), ["17", "9"]);
    assert_eq!(call("PD(NN<<1,1,\"2\")"), ["7", "9"]);
    assert_eq!(call("PD(,1,\"2\")"), ["3", "9"]);
    let long = said(&format!("G0\nPD(\"abc\"<<1234567)\n{end}"));
    assert!(long[0].contains("STRLEN(AA): its value is unknown here"), "{long:?}");
    let back = "DEF STRING[9] NN=\"abc\"\nG0\nPD(NN)\nX=STRLEN(NN)\nM30\n%_N_PD_SPF\nPROC PD(VAR STRING[9] AA)\nAA=AA<<\"de\"\nM17\n";
    assert_eq!(places(back), ["5"]);
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
        "CALL /_N_WKS_DIR/PD",
        "CALL",
        "PCALL /DIR/(1)",
        "EXTCALL (\"PD\"",
        "EXTCALL",
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
