//! Values from the rules; no interpreter of OSP is public.
use super::osp;
use crate::{FormulaErrorKind, ValueError, Variables};
use trunnion_syntax::TextRange;

struct Some3;

impl Variables for Some3 {
    fn numbered(&self, _: i64) -> Result<f64, ValueError> {
        Ok(f64::NAN)
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        Ok(match name {
            "v1" => 1.0,
            "dia1" => 40.0,
            _ => f64::NAN,
        })
    }
    fn named_at(&self, name: &str, index: i64) -> Result<f64, ValueError> {
        Ok(if name == "vzofx" { index as f64 * 10.0 } else { f64::NAN })
    }
    fn exists(&self, _: &str) -> bool {
        false
    }
}

fn value(text: &str) -> Result<(f64, String), FormulaErrorKind> {
    let range = TextRange::new(0, text.len() as u32);
    let (formula, end) = osp(text.as_bytes(), range).map_err(|error| error.kind)?;
    let value = formula.eval(&Some3).map_err(|error| error.kind)?;
    Ok((value, text[end as usize..].to_owned()))
}

#[test]
fn values() {
    for (text, expected) in [
        ("2+3*4", 14.0),
        ("[2+3]*4", 20.0),
        ("10-2*3-1", 3.0),
        ("-V1+3", 2.0),
        ("2*-3", -6.0),
        ("DIA1+2", 42.0),
        ("VZOFX[V1+1]", 20.0),
        ("SIN[30]", 0.5),
        ("SQRT[9]+ABS[-2]", 5.0),
        ("MOD[17,5]", 2.0),
        ("ROUND[2.6]", 3.0),
        ("ROUND[-2.6]", -3.0),
        ("FIX[2.9]", 2.0),
        ("FUP[2.1]", 3.0),
        ("#81H", 129.0),
        ("V1 LT 3", 1.0),
        ("V1\n$ +2", 3.0),
        ("V1+1 GE 3", 0.0),
        ("[V1 EQ 1] AND [DIA1 GT 50]", 0.0),
        ("[V1 EQ 1] OR [DIA1 GT 50] OR 0", 1.0),
        ("[V1 EQ 1] EOR [DIA1 EQ 40]", 0.0),
        ("NOT [V1 EQ 1]", 0.0),
    ] {
        let (got, rest) = value(text).expect(text);
        assert!(
            (got - expected).abs() < 1e-12 && rest.is_empty(),
            "{text}: {got} {rest}"
        );
    }
}

#[test]
fn what_no_source_states_is_unknown() {
    for text in [
        "[V1 EQ 1] AND [V1 EQ 2] OR [V1 EQ 1]",
        "V1 EQ 1 AND DIA1 EQ 40",
        "1 EQ 1 EQ 1",
        "6 AND 3",
        "NOT 5",
        "MOD[-7,4]",
        "ROUND[2.5]",
        "FIX[-2.5]",
        "FUP[-2.5]",
        "ATAN2[1,1]",
        "DROUND[1.5]",
        "0.1+0.2 EQ 0.3",
        "EMPTY",
        "VTOFX[1,2]",
        "V201",
    ] {
        assert!(value(text).expect(text).0.is_nan(), "{text}");
    }
}

#[test]
fn an_expression_ends_where_its_language_does() {
    for (text, rest) in [("V1+2 Z2", " Z2"), ("V1] NLOOP", "] NLOOP"), ("40 ZL1=-20", " ZL1=-20")] {
        assert_eq!(value(text).map(|found| found.1).as_deref(), Ok(rest), "{text}");
    }
    for text in ["", "V1+", "[V1", "MOD[1]", "* 2", "VZOFX[1", "#XH", "'A'"] {
        assert!(value(text).is_err(), "{text}");
    }
    assert_eq!(value("1/0"), Err(FormulaErrorKind::DivisionByZero));
    let deep = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    assert_eq!(value(&deep).expect("a value").0, 1.0);
    let deep = format!("{}1{}", "A1[".repeat(200_000), "]".repeat(200_000));
    assert!(value(&deep).expect("a value").0.is_nan());
}
