//! No text, however odd or long, does harm.
use crate::support::{Table, eval};
use proptest::prelude::*;
use trunnion_formula::{Cursor, FormulaErrorKind, Grammar, target, value, value_or_error};
use trunnion_syntax::TextRange;

#[test]
fn a_hundred_thousand_brackets() {
    let deep = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    assert_eq!(eval(&deep, Grammar::Rs274, &Table::default()), Ok(1.0));
    let open = "[".repeat(100_000);
    let error = eval(&open, Grammar::Rs274, &Table::default()).expect_err("no value");
    assert_eq!(error.kind, FormulaErrorKind::MissingValue);
    let calls = format!("{}4{}", "sqrt[1+".repeat(100_000), "]".repeat(100_000));
    assert!(eval(&calls, Grammar::Rs274, &Table::default()).is_ok());
    let signs = format!("{}4", "-".repeat(100_001));
    assert_eq!(eval(&signs, Grammar::Rs274, &Table::default()), Ok(-4.0));
    let hashes = format!("{}1", "#".repeat(100_000));
    assert!(eval(&hashes, Grammar::Rs274, &Table::default()).is_err());
}

#[test]
fn values_that_wait_are_kept() {
    let sum = format!("{}1{}", "[1+".repeat(1000), "]".repeat(1000));
    assert_eq!(eval(&sum, Grammar::Rs274, &Table::default()), Ok(1001.0));
}

#[test]
fn ten_megabytes_of_digits_blanks_and_operators() {
    for text in [
        "9".repeat(10_000_000),
        " ".repeat(10_000_000),
        format!("[1{}]", "+1".repeat(5_000_000)),
        format!("1{}2", " ".repeat(10_000_000)),
        "1 ".repeat(5_000_000),
    ] {
        let mut cursor = Cursor::new(text.as_bytes(), TextRange::new(0, text.len() as u32));
        let (formula, _) = value_or_error(&mut cursor, Grammar::Rs274);
        let _ = formula.eval(&Table::default());
    }
}

fn any_text() -> impl Strategy<Value = Vec<u8>> {
    let pieces = prop::sample::select(vec![
        "[", "]", "#", "<", ">", "+", "-", "*", "**", "/", " ", "\t", ".", "1", "0", "200", "sin", "atan", "exists",
        "mod", "eq", "and", "pow", ",", "_absio", "=", "(", ")", "x", "é", "\0", "\r",
    ]);
    prop_oneof![
        prop::collection::vec(any::<u8>(), 0..40),
        prop::collection::vec(pieces, 0..25).prop_map(|pieces| pieces.concat().into_bytes()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_bytes(bytes in any_text(), macro_b: bool, start in 0u32..5, cut in 0u32..5) {
        let grammar = if macro_b { Grammar::MacroB } else { Grammar::Rs274 };
        let end = (bytes.len() as u32).saturating_sub(cut);
        let range = TextRange::new(start.min(end), end);
        let mut cursor = Cursor::new(&bytes, range);
        let (formula, error) = value_or_error(&mut cursor, grammar);
        let inside = |part: TextRange| range.start <= part.start && part.start <= part.end && part.end <= range.end;
        prop_assert!(inside(formula.range()));
        prop_assert!(cursor.at() <= range.end);
        let result = formula.eval(&Table::default());
        if let Some(error) = &error {
            prop_assert!(inside(error.range), "{error:?}");
            prop_assert!(result.is_err(), "what cannot be read has no value");
        }
        if let Err(error) = result {
            prop_assert!(inside(error.range), "{error:?}");
            prop_assert!(!error.to_string().is_empty());
        }
        let again = value(&mut Cursor::new(&bytes, range), grammar);
        prop_assert_eq!(again.err(), error);
        let _ = target(&mut Cursor::new(&bytes, range), grammar);
    }
}
