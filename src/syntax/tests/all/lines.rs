//! Lines and columns.
use proptest::prelude::*;
use trunnion_syntax::LineIndex;

#[test]
fn all_line_ends_count() {
    let text = b"a\nbc\r\nd\re\n\r\n";
    let index = LineIndex::new(text);
    assert_eq!(index.starts, [0, 2, 6, 8, 10, 12]);
    assert_eq!(index.line_column(text, 3), (2, 2));
    assert_eq!(index.line_column(text, 8), (4, 1));
    assert_eq!(index.line_column(text, 12), (6, 1));
    assert_eq!(index.line_column(text, 999), (6, 1));
    assert_eq!(LineIndex::new(b"").line_column(b"", 0), (1, 1));
}

#[test]
fn columns_count_characters() {
    let text = "aä€😀b".as_bytes();
    let index = LineIndex::new(text);
    let columns: Vec<u32> = (0..=text.len() as u32)
        .map(|at| index.line_column(text, at).1)
        .collect();
    assert_eq!(columns, [1, 2, 2, 3, 3, 3, 4, 4, 4, 4, 5, 6]);
    let broken = b"\xE4\xF6x\xE2\x82";
    let index = LineIndex::new(broken);
    let columns: Vec<u32> = (0..=5).map(|at| index.line_column(broken, at).1).collect();
    assert_eq!(columns, [1, 2, 3, 4, 5, 6]);
}

proptest! {
    #[test]
    fn columns_follow_std_on_text(text in "[a-c\\nä€😀\\r]{0,40}") {
        let index = LineIndex::new(text.as_bytes());
        for (at, _) in text.char_indices() {
            let (line, column) = index.line_column(text.as_bytes(), at as u32);
            let start = index.starts[line as usize - 1] as usize;
            prop_assert_eq!(column as usize, text[start..at].chars().count() + 1);
        }
    }

    #[test]
    fn positions_come_back(bytes in proptest::collection::vec(prop_oneof![Just(b'\n'), Just(b'\r'), any::<u8>()], 0..60)) {
        let index = LineIndex::new(&bytes);
        let mut last = (1, 0);
        for at in 0..=bytes.len() as u32 {
            let here = index.line_column(&bytes, at);
            prop_assert!(here >= last, "positions rise: {:?} after {:?}", here, last);
            last = here;
            let back = index.offset(&bytes, here.0, here.1).expect("the line is there");
            prop_assert!(back <= at);
            prop_assert_eq!(index.line_column(&bytes, back).0, here.0);
        }
        prop_assert_eq!(index.offset(&bytes, 0, 1), None);
        prop_assert_eq!(index.offset(&bytes, index.starts.len() as u32 + 1, 1), None);
    }
}
