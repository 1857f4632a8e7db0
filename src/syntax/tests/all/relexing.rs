//! Parsing after an edit gives what parsing the edited text gives.
use crate::lossless::pieces;
use crate::show::{APT, CORE, SINUMERIK};
use proptest::prelude::*;
use proptest::sample::Index;
use trunnion_syntax::{TextEdit, TextRange, apply_edits, parse};

fn edit(start: u32, end: u32, text: &str) -> TextEdit {
    TextEdit {
        range: TextRange::new(start, end),
        new_text: text.to_owned(),
    }
}

#[test]
fn edits_that_join_and_split_blocks() {
    let rows = [
        ("G1\nX1\nX2\n", edit(3, 5, "Y5")),
        ("G1\nX1\nX2\n", edit(2, 3, "")),
        ("G1\rX1\n", edit(3, 3, "\n")),
        ("G1\r\nX1\n", edit(2, 3, "")),
        ("G1\nX1 */\nX2\n", edit(0, 0, "/*")),
        ("/*G1\nX1 */\nX2\n", edit(0, 2, "")),
        ("/*G1\nX1 */\nX2\n", edit(8, 10, "")),
        ("G1", edit(2, 2, "\nX5")),
        ("", edit(0, 0, "G1")),
        ("G1\n", edit(0, 3, "")),
        ("G1\n", edit(3, 3, "X5")),
        ("X1\n(a\nX[\nY1", edit(0, 2, "\nX\n")),
        ("\nG1", edit(0, 0, "\u{feff}")),
    ];
    for (source, change) in rows {
        for options in [CORE, SINUMERIK, APT] {
            let before = parse(source.as_bytes().to_vec(), options);
            let edited = apply_edits(source.as_bytes(), std::slice::from_ref(&change)).expect("inside the text");
            let after = before.relex(std::slice::from_ref(&change)).expect("inside the text");
            assert_eq!(after, parse(edited, options), "{source:?} {change:?}");
        }
    }
}

#[test]
fn edits_that_do_not_fit_are_refused() {
    let program = parse(b"G1 X1".to_vec(), CORE);
    assert_eq!(program.relex(&[edit(4, 9, "")]), None);
    assert_eq!(program.relex(&[edit(3, 4, ""), edit(0, 1, "")]), None);
    assert_eq!(program.relex(&[]), Some(program.clone()));
}

/// Two places, and what comes between them.
fn change() -> impl Strategy<Value = (Index, Index, String)> {
    (any::<Index>(), any::<Index>(), "[GX1.;(*/$\\n\\r \\[]{0,4}")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn relex_equals_parse(source in pieces(), changes in proptest::collection::vec(change(), 1..4)) {
        let places = changes.iter().flat_map(|(from, to, _)| [from, to]);
        let mut cuts: Vec<u32> = places.map(|place| place.index(source.len() + 1) as u32).collect();
        cuts.sort_unstable();
        let pairs = changes.iter().zip(cuts.chunks(2));
        let edits: Vec<TextEdit> = pairs.map(|((_, _, text), cut)| edit(cut[0], cut[1], text)).collect();
        let edited = apply_edits(&source, &edits).expect("sorted and inside");
        for options in [CORE, SINUMERIK, APT] {
            let after = parse(source.clone(), options).relex(&edits).expect("sorted and inside");
            prop_assert_eq!(after, parse(edited.clone(), options));
        }
    }
}
