//! Text of Okuma's OSP.
use crate::lossless::check;
use crate::show::{FANUC, items, program};
use proptest::prelude::*;
use trunnion_syntax::{Format, LexOptions};

const OSP: LexOptions = LexOptions {
    format: Format::Osp,
    ..FANUC
};

#[test]
fn names_continued_lines_and_numbers() {
    for (text, wanted) in [
        ("$PART-1.MIN%\nO1001", "percent[$PART-1.MIN%] | O=1001"),
        ("NLAP1 G1 X1", "label[NLAP1] G=1 X=1"),
        ("OPUL (A)", "label[OPUL] comment[A]"),
        ("N10 /X1", "N=10 skip1[/] X=1"),
        ("NA /X1", "label[NA] skip1[/] X=1"),
        ("NCYL G81 X1", "call:NCYL G=81 X=1"),
        ("G1 X1\n$ Y2\nZ3", "G=1 X=1 Y=2 | Z=3"),
        ("X=V1\n$+2 Y=PX1", "X={V1\n$+2} Y={PX1}"),
        ("VF=#81H+#0fh X1", "<VF>={#81H+#0fh} X=1"),
        ("V1=V2 EOR V3", "V[1]={V2 EOR V3}"),
    ] {
        let parsed = program(text, OSP);
        assert_eq!(items(&parsed), wanted, "{text}");
        assert!(parsed.errors().is_empty(), "{text}: {:?}", parsed.errors());
    }
    // elsewhere a `$` is what it was
    assert_eq!(program("G1 X1\n$ Y2", FANUC).block_count(), 2);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn tokens_cover_every_text(pieces in proptest::collection::vec(proptest::sample::select(vec![
        "$A.MIN%", "$", "\n$", "\n", "\r\n", "\r", "NLAP1", "OAB", "NCYL", "N10", " ", "/", "G1", "X=", "V1", "#81H", "#", "FH", "[", "]",
        "EOR", "\u{2018}A\u{2019}", "\u{2019}", "(a)", "(", "=", "+", "'A'", "IF", "GOTO", "CALL OA Q2", "AB=1", "%",
    ]), 0..30)) {
        check(&program(&pieces.concat(), OSP));
    }
}
