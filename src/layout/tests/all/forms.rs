//! Form by form: what goes in and what comes out.
use crate::support::{dialect, laid, laid_with, program};
use trunnion_interp::Setup;
use trunnion_layout::{Case, Layout, Refusal, Spacing, Style, Zeros, layout};

#[test]
fn words_stand_one_blank_apart_and_hold_none() {
    for (before, after) in [
        ("n10g1x1.5y-.5", "N10 G1 X1.5 Y-.5\n"),
        ("G1   X 1.5\tY -.5  \n", "G1 X1.5 Y-.5\n"),
        ("G01 X010.500 Y+0. Z-0\n", "G01 X010.500 Y+0. Z-0\n"),
        ("/N10G0X1\n", "/N10 G0 X1\n"),
        ("/2 N10G0X1\n", "/2 N10 G0 X1\n"),
        ("  G1 X1\n", "G1 X1\n"),
        ("X1\n\n\n\nX2\n\n\n", "X1\n\nX2\n"),
        ("\n\n%\nX1\n%", "%\nX1\n%\n"),
        ("", ""),
        ("\n\n", ""),
        ("X1\r\nx2\nx3\r\n", "X1\r\nX2\r\nX3\r\n"),
        ("x1\rx2\r", "X1\rX2\r"),
    ] {
        assert_eq!(laid(before, "iso-6983"), after, "{before:?}");
    }
}

#[test]
fn comments_stay_byte_for_byte_and_keep_the_column_they_are_set_to() {
    for (before, after) in [
        ("g1x1(Cut  It )\n", "G1 X1 (Cut  It )\n"),
        ("g1 x1;  two  \n", "G1 X1 ;  two  \n"),
        ("g1  x1      (set apart)\n", "G1 X1       (set apart)\n"),
        ("G1\tX1\t\t(tabs)\n", "G1 X1                   (tabs)\n"),
        ("g1x1y1z1  (reached)\n", "G1 X1 Y1 Z1 (reached)\n"),
        ("g1(a)x1\n", "G1 (a) X1\n"),
        ("N10(only)\n", "N10 (only)\n"),
        ("  ( alone )\n", "( alone )\n"),
        ("g1 x1 (not closed\ng1 x2\n", "g1 x1 (not closed\nG1 X2\n"),
    ] {
        assert_eq!(laid(before, "iso-6983"), after, "{before:?}");
    }
    let column = Style {
        comment_column: Some(20),
        ..Style::default()
    };
    let text = b"g1x1(a)\n(alone)\ng1x1y1z1a1b1c1f1000(far)\nn5(number)\n";
    assert_eq!(
        String::from_utf8(laid_with(text, "iso-6983", &column)).expect("UTF-8"),
        "G1 X1              (a)\n(alone)\nG1 X1 Y1 Z1 A1 B1 C1 F1000 (far)\nN5 (number)\n"
    );
}

#[test]
fn what_is_broken_or_no_layout_stays() {
    for text in [
        "g1x1..5\n",
        "g1x1,5\n",
        "\u{0}\u{0}%\n",
        "x1 \u{c}\n",
        "%_N_shaft_MPF\n",
        "g1x1e3\u{e9}\n",
    ] {
        assert_eq!(laid(text, "iso-6983"), text, "{text:?}");
    }
    assert_eq!(
        laid("%\ng0x1\n%\nx 1   y2\n\n\n\nend", "iso-6983"),
        "%\nG0 X1\n%\nx 1   y2\n\n\n\nend"
    );
    assert_eq!(
        laid("O1\n#1=2\nDPRNT[ x#1[42] ]\nM30;\n", "fanuc-30i"),
        "O1\n#1=2\nDPRNT[ x#1[42] ]\nM30;\n"
    );
}

#[test]
fn o_words_are_indented_and_keep_their_case() {
    let before = "o<probe> sub\n#<depth>=[ #1+2 ]\no100 while [#1 lt 5]\ng1x#1(cut)f 1 00\n#1=[#1+1]\no101 if[#1 eq 3]\n(three)\n\
                  o101 else\ng4p1\no101 endif\no100 endwhile\no102 do\nx1\no102 while[0]\no<probe>endsub\nm2\n";
    let after = "o<probe> sub\n  #<depth>=[#1+2]\n  o100 while [#1 lt 5]\n    G1 X#1 (cut) F100\n    #1=[#1+1]\n    o101 if[#1 eq 3]\n      \
                 (three)\n    o101 else\n      G4 P1\n    o101 endif\n  o100 endwhile\n  o102 do\n    X1\n  o102 while[0]\n\
                 o<probe> endsub\nM2\n";
    assert_eq!(laid(before, "linuxcnc"), after);
}

#[test]
fn numbers_with_blanks_are_joined_where_the_control_allows_them() {
    assert_eq!(laid("g0x +0. 12 34y 7\n", "linuxcnc"), "G0 X+0.1234 Y7\n");
    assert_eq!(laid("# <a b>=1\nx# 1\n", "linuxcnc"), "#<a b>=1\nX#1\n");
}

#[test]
fn macro_b_is_indented_by_its_loops() {
    let before = "o0001(part)\n#1=0\nwhile[#1lt10]do1\ng1x#1f100\n#1=#1+1\nif[#1eq5]goto20\nend1\nn20m30\n";
    let after = "O0001 (part)\n#1=0\nWHILE[#1LT10] DO1\n  G1 X#1 F100\n  #1=#1+1\n  IF[#1EQ5] GOTO20\nEND1\nN20 M30\n";
    assert_eq!(laid(before, "fanuc-30i"), after);
    assert_eq!(laid("g1x10,r5y 2\n", "fanuc-30i"), "G1 X10,R5 Y2\n");
}

#[test]
fn what_has_no_meaning_stays_as_near_to_its_number_as_it_is() {
    for (before, after) in [
        ("WHILE\nN10/\nX1", "WHILE\nN10/\n  X1\n"),
        ("WHILE\nN10 /\n", "WHILE\nN10   /\n"),
        (
            "WHILE[#1LT2]DO1\nN10@\nN20X1\nEND1\n",
            "WHILE[#1LT2] DO1\nN10@\nN20   X1\nEND1\n",
        ),
    ] {
        assert_eq!(laid(before, "fanuc-30i"), after, "{before:?}");
    }
    // OSP refuses a number without a blank behind it: with one it would run
    for text in ["N10G1 X5\n", "/N10GOTO\n", "N5E1\n"] {
        assert_eq!(laid(text, "okuma-osp"), text, "{text:?}");
    }
    assert_eq!(laid("N10   g1x5\n", "okuma-osp"), "N10 G1 X5\n");
}

#[test]
fn numbers_of_a_case_are_not_joined_to_its_labels() {
    for case in [
        "CASE R1 OF 1 GOTOF LBL1 2 GOTOF LBL2",
        "CASE R1 OF 1 GOTOF N10 2 GOTOF N20",
    ] {
        let source = format!("R1=2\n  {case}\nLBL1:N10 X1\nLBL2:N20 X2\nM30\n");
        assert!(laid(&source, "sinumerik-840d").contains(case), "{case}");
    }
}

#[test]
fn sinumerik_names_texts_and_arguments_stay() {
    let before = "%_N_Shaft_MPF\n;$PATH=/_N_MPF_DIR\nn10 g0x=R1+2 y=ic( 5 )\nn20 msg(\"a  b\")\nt=\"Drill_8\"m6\n\
                  n30 cycle83(5, 0 ,1,,\"x  y\")\nif r1>5\nx1\nendif\nif r1>5 gotof Ende\nloop\nx2\nendloop\nEnde:m30\n";
    let after = "%_N_Shaft_MPF\n;$PATH=/_N_MPF_DIR\nN10 G0 X=R1+2 Y=ic(5)\nN20 msg(\"a  b\")\nT=\"Drill_8\" M6\n\
                 N30 cycle83(5, 0,1,,\"x  y\")\nif r1>5\n  X1\nendif\nif r1>5 gotof Ende\nloop\n  X2\nendloop\nEnde: M30\n";
    assert_eq!(laid(before, "sinumerik-840d"), after);
}

/// The control reads a name as far as letters and digits go; the words of the block end in it.
#[test]
fn no_blank_parts_what_may_be_one_name() {
    for (before, after) in [
        ("WHILE DO1X1.5e1", "WHILE DO1X1.5 E1\n"),
        ("WHILE  DO1  X1.5e1\n", "WHILE DO1 X1.5 E1\n"),
    ] {
        assert_eq!(laid(before, "sinumerik-840d"), after, "{before:?}");
    }
}

#[test]
fn apt_statements_lose_only_blanks_between() {
    let before = "PARTNO  a  part   \n  GOTO/ 1.5 ,2.,   3.  \nRAPID\n\n\n\nGOTO / 1.,$  go on\n    2.,3.\n$$  a   remark  \nFINI";
    let after =
        "PARTNO  a  part   \n  GOTO/ 1.5,2., 3.\nRAPID\n\nGOTO / 1.,$  go on\n    2.,3.\n$$  a   remark  \nFINI\n";
    assert_eq!(laid(before, "apt"), after);
}

#[test]
fn the_style_has_a_say() {
    let styled = |text: &str, style| String::from_utf8(laid_with(text.as_bytes(), "iso-6983", &style)).expect("UTF-8");
    let base = Style::default();
    let packed = Style {
        spacing: Spacing::Packed,
        ..base
    };
    assert_eq!(styled("N10 G1 X1 (a) Y2 E1\n", packed), "N10G1X1 (a) Y2 E1\n");
    let lower = Style {
        case: Case::Lower,
        ..base
    };
    assert_eq!(styled("G1 X1(A)\n", lower), "g1 x1 (A)\n");
    let two = Style {
        zeros: Zeros::Two,
        ..base
    };
    assert_eq!(styled("g1x1m3\n", two), "G01 X1 M03\n");
    let drop = Style {
        zeros: Zeros::Drop,
        ..base
    };
    assert_eq!(styled("G01 X01 M03 G00\n", drop), "G1 X01 M3 G0\n");
    let flat = Style {
        indent: 0,
        blank_lines: 0,
        ..base
    };
    assert_eq!(
        styled("o1 while [1]\n\n  x1\no1 endwhile\n", flat),
        "o1 while [1]\nX1\no1 endwhile\n"
    );
}

#[test]
fn lines_are_not_made_longer_than_the_control_reads() {
    let packed = format!("g1{}\n", "x1".repeat(124));
    assert_eq!(
        laid(&packed, "linuxcnc"),
        packed,
        "371 characters would be refused by RS274/NGC"
    );
}

/// A comma in Klartext is the decimal point: a blank before it stays.
#[test]
fn a_comma_in_klartext_gets_no_nearer_to_its_number() {
    for text in ["L X+1 ,5 FMAX\n", "L X+1,5 FMAX\n"] {
        assert_eq!(laid(text, "heidenhain-klartext"), text);
    }
}

#[test]
fn a_text_of_which_most_is_not_modelled_is_compared_as_far_as_the_bound() {
    let dialect = dialect("fanuc-30i");
    let laid = |text: &str, steps| {
        let mut setup = Setup::default();
        setup.limits.steps = steps;
        layout(&program(text.as_bytes(), dialect), dialect, &setup, &Style::default())
    };
    let text = "G999X1.\n".repeat(60);
    match laid(&text, 20) {
        Layout::Refused(Refusal::Motions(why)) => {
            assert!(
                why.what.contains("more than 60 actions") && why.what.contains("--max-steps"),
                "{}",
                why.what
            );
            assert!(why.before.is_some_and(|block| block.0 < 59), "{:?}", why.before);
        }
        other => panic!("{other:?}"),
    }
    assert!(matches!(laid(&text, 1000), Layout::Changed(_)));
    // a loop is compared as far as it is followed
    let text = "#1=0\nWHILE[#1LT900]DO1\nG999X1.\n#1=#1+1\nEND1\nM30\n";
    assert!(matches!(laid(text, 20), Layout::Changed(_)));
}

#[test]
fn an_apt_text_that_ends_with_a_continuation_gets_no_line_end_in_it() {
    assert_eq!(laid("GOTO/1,2,3\n$ Y1\r ", "apt"), "GOTO/1,2,3\n$ Y1\r");
    for line in ["$ Y1\r \n", "GOTO/1,2,3$\r \n"] {
        assert_eq!(laid(&format!("\n{line}"), "apt"), line);
    }
    assert_eq!(laid("$\r\r\n\n", "apt"), "$\r\r\n");
}

/// What comes after such a block would not be compared.
#[test]
fn a_text_with_a_block_of_too_many_motions_stays() {
    let dialect = dialect("fanuc-30i");
    let laid = |held| {
        let mut setup = Setup::default();
        setup.limits.held = held;
        let text = b"G90 G0 X0 Y0 Z50.\nG98 G83 X1. Y1. Z-10. R2. Q.1 F100.\ng80\nG1X5.\nM30\n";
        layout(&program(text, dialect), dialect, &setup, &Style::default())
    };
    match laid(100) {
        Layout::Refused(Refusal::Motions(why)) => assert!(
            why.what.contains("more than 25 motions") && why.what.contains("`held`"),
            "{}",
            why.what
        ),
        other => panic!("{other:?}"),
    }
    assert!(matches!(laid(10_000), Layout::Changed(_)));
}

/// The blanks before a line do not grow with the loops around it: together they would be as many as the square of the lines.
#[test]
fn a_line_in_many_loops_is_indented_as_one_in_twelve() {
    for (name, line) in [
        ("fanuc-30i", "WHILE[#1LT2] DO1\n"),
        ("linuxcnc", "o1 while [#1 lt 2]\n"),
        ("sinumerik-840d", "WHILE R1<2\n"),
    ] {
        let after = laid(&line.repeat(3000), name);
        let most = after.lines().map(|line| line.len() - line.trim_start().len()).max();
        assert_eq!(most, Some(24), "{name}");
        assert!(after.len() <= 3000 * (line.len() + 24), "{name}: {} bytes", after.len());
    }
}
