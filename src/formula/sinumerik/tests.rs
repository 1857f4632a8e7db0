//! Expected values: the manual's table of priorities, and a run of the open interpreter of CEAD where the manual gives no number.
use super::sinumerik;
use crate::{FormulaErrorKind, ValueError, Variables};
use trunnion_syntax::TextRange;

struct Some5;

impl Variables for Some5 {
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        match index {
            1..=5 => Ok(index as f64),
            0.. => Ok(f64::NAN),
            _ => Err(ValueError::OutOfRange),
        }
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        Ok(if name == "_depth" { 2.5 } else { f64::NAN })
    }
    fn exists(&self, _: &str) -> bool {
        false
    }
}

/// One past its last byte.
fn compiled(text: &str) -> Result<u32, FormulaErrorKind> {
    let range = TextRange::new(0, text.len() as u32);
    sinumerik(text.as_bytes(), range)
        .map(|found| found.1)
        .map_err(|error| error.kind)
}

fn value(text: &str) -> Result<(f64, String), FormulaErrorKind> {
    let range = TextRange::new(0, text.len() as u32);
    let (formula, end) = sinumerik(text.as_bytes(), range).map_err(|error| error.kind)?;
    let value = formula.eval(&Some5).map_err(|error| error.kind)?;
    Ok((value, text[end as usize..].to_owned()))
}

#[test]
fn priorities_are_the_control_s() {
    for (text, expected) in [
        ("2+3*4", 14.0),
        ("(2+3)*4", 20.0),
        ("10-2*3-1", 3.0),
        ("2+6 DIV 4", 3.0),
        ("1+7 MOD 4", 4.0),
        ("7 DIV 2*2", 6.0),
        ("2*-3", -6.0),
        ("-R2+3", 1.0),
        // a comparison binds weaker than AND
        ("5 > 3 AND 2 > 1", 0.0),
        ("(5 > 3) AND (2 > 1)", 1.0),
        ("1 OR 0 AND 0", 1.0),
        ("1 OR 1 XOR 1", 1.0),
        ("6 B_OR 1 B_AND 0", 6.0),
        ("6 B_AND 3 B_XOR 1", 3.0),
        ("NOT 0 AND 0", 0.0),
        ("NOT 1 == 0", 1.0),
        ("NOT NOT 5", 1.0),
        ("B_NOT 5", -6.0),
        ("1 < 2 < 3", 1.0),
        ("R1+1 >= R2", 1.0),
        ("R3<>3", 0.0),
        ("TRUE AND NOT FALSE", 1.0),
        ("-7 DIV 2", -3.0),
        ("-7 MOD 4", -3.0),
        ("R[R1+1]*10", 20.0),
        ("r[ 3 ]", 3.0),
        ("_DEPTH*2", 5.0),
        (".5+1.EX-1", 0.6),
        ("2EX2", 200.0),
        ("'H1F'+'B101'", 36.0),
        ("POT(3)+ABS(-1)", 10.0),
        ("TRUNC(-2.7)", -2.0),
        ("ROUND(2.5)", 3.0),
        ("ROUND(-2.5)", -3.0),
        ("ROUND(-2.4)", -2.0),
        ("BOUND(1, R2+1, 7)*10+BOUND(1,3,-7)", 31.0),
        ("BOUND(1, MINVAL(9,3), BOUND(0,5,2))", 2.0),
        ("ROUNDUP(2.1)", 3.0),
        ("MINVAL(3, R2)+MAXVAL(3,R2)", 5.0),
        ("SIN(30)", 0.5),
        ("ATAN2(1,-1)", 135.0),
        ("SQRT(16)/8", 0.5),
        ("7MOD 4", 3.0),
    ] {
        let (got, rest) = value(text).expect(text);
        assert!(
            (got - expected).abs() < 1e-12 && rest.is_empty(),
            "{text}: {got} {rest}"
        );
    }
}

#[test]
fn an_expression_ends_where_its_language_does() {
    for (text, rest) in [
        ("R1>0 GOTOF END", " GOTOF END"),
        ("R1+1)", ")"),
        ("5 TO 7", " TO 7"),
        ("(R1) OF 1 GOTOF A", " OF 1 GOTOF A"),
        ("R1, 2", ", 2"),
        ("1=2", "=2"),
    ] {
        assert_eq!(value(text).map(|found| found.1).as_deref(), Ok(rest), "{text}");
    }
    for text in [
        "",
        "R1+",
        "(R1",
        "R1+)",
        "ATAN2(1)",
        "BOUND(1,2)",
        "BOUND(1,2,3,4)",
        "'X12'",
        "* 2",
        "R[1",
        "NAME[1",
    ] {
        assert!(value(text).is_err(), "{text}");
    }
    assert_eq!(value("1/0"), Err(FormulaErrorKind::DivisionByZero));
    assert_eq!(value("R[-1]"), Err(FormulaErrorKind::ParameterOutOfRange(-1)));
}

#[test]
fn what_is_not_documented_is_not_known() {
    for text in [
        "R9",
        "NAME",
        "$AA_IM[X]",
        "FELD[1,2]+1",
        "OWN(1,(2),\")\")",
        "\"N\"<<10",
        "1<<2",
        "BOUND(3, 1, 2)",
        "BOUND(1, R9, 2)",
        "0.1+0.2 == 0.3",
        "0.1+0.2 > 0.3",
        "1.5 DIV 1",
        "1.5 B_AND 1",
        "TRUNC(2.9999999999999)",
        "ROUNDUP(-2.5)",
    ] {
        assert!(value(text).expect(text).0.is_nan(), "{text}");
    }
    // one operand may settle it all the same
    assert_eq!(value("R9 AND 0").expect("a value").0, 0.0);
    assert_eq!(value("1 OR R9").expect("a value").0, 1.0);
}

#[test]
fn a_hundred_thousand_brackets_need_no_stack() {
    let deep = format!("{}1{}", "(".repeat(100_000), ")".repeat(100_000));
    assert_eq!(value(&deep).expect("a value").0, 1.0);
    // each bracket of a field is looked through once: with a look at each, 500 000 inside each other take minutes
    let deep = format!("{}1{}", "A[".repeat(500_000), "]".repeat(500_000));
    assert_eq!(compiled(&deep), Ok(deep.len() as u32));
    let two = format!("{}1,2{}", "A[".repeat(500_000), "]".repeat(500_000));
    assert_eq!(compiled(&two), Ok(two.len() as u32));
    assert!(value(&"(".repeat(100_000)).is_err());
}
