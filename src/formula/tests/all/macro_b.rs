//! Macro B: what is documented in Fanuc's and Haas' manuals, by hand.
use crate::support::{Table, eval, read, refused};
use trunnion_formula::{Grammar, Variable};

fn value(text: &str) -> f64 {
    eval(
        text,
        Grammar::MacroB,
        &Table {
            values: vec![(1, 3.0), (2, 4.0), (3, 1.5), (5, 9.0)],
            principal_angles: false,
            open_angles: false,
        },
    )
    .expect(text)
}

#[test]
fn precedence() {
    for (text, expected) in [
        ("[1+2*3]", 7.0),
        ("[6 OR 1 AND 0]", 6.0),
        ("[1 OR 6 AND 4]", 5.0),
        ("[12 XOR 10]", 6.0),
        ("[7 MOD 4*2]", 6.0),
        ("[1+1EQ2]", 1.0),
        ("[[1 LT 2] AND [3 GT 4]]", 0.0),
        ("[[1 LT 2] OR [3 GT 4]]", 1.0),
        ("[1.EQ1.]", 1.0),
        ("[#1LT#2]", 1.0),
        ("-[#1+#2]", -7.0),
        ("[-2+3]", 1.0),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn functions() {
    for (text, expected) in [
        ("FIX[-2.8]", -2.0),
        ("FIX[2.8]", 2.0),
        ("FUP[-2.2]", -3.0),
        ("FUP[2.2]", 3.0),
        ("ROUND[-2.5]", -3.0),
        ("RND[2.4]", 2.0),
        ("SQRT[16]", 4.0),
        ("SQR[16]", 4.0),
        ("POW[2,10]", 1024.0),
        ("POW[2, 1+2]", 8.0),
        ("BCD[12]", 18.0),
        ("BIN[18]", 12.0),
        ("ADP[#1]", 3.0),
        ("ATAN[1]", 45.0),
        ("ATAN[-1]", -45.0),
        ("ATAN[1]/[-1]", 135.0),
        ("ATAN[-1]/[-1]", 225.0),
        ("ATAN[-1,-1]", 225.0),
        ("[ATAN[1]/2]", 22.5),
        ("ASIN[-1]", 270.0),
        ("ACOS[-1]", 180.0),
        ("[8 MOD 3.4]", 2.0),
        ("[-8 MOD 3]", -2.0),
        ("[#_ABSIO[1+1]]", 20.0),
        ("#[#1+2]", 9.0),
        ("#[#3]", 4.0),
    ] {
        assert!((value(text) - expected).abs() < 1e-12, "{text}: {}", value(text));
    }
    let principal = Table {
        principal_angles: true,
        ..Table::default()
    };
    assert_eq!(eval("ATAN[-1]/[-1]", Grammar::MacroB, &principal), Ok(-135.0));
    assert_eq!(eval("ASIN[-1]", Grammar::MacroB, &principal), Ok(-90.0));
    let open = Table {
        open_angles: true,
        ..Table::default()
    };
    for text in ["ASIN[-1]", "ATAN[-1]/[-1]", "[ATAN[-1]/[2]+5]"] {
        assert!(eval(text, Grammar::MacroB, &open).is_ok_and(f64::is_nan), "{text}");
    }
    for (text, angle) in [
        ("ASIN[1]", 90.0),
        ("ATAN[1]/[-1]", 135.0),
        ("ATAN[-1]", -45.0),
        ("ACOS[-1]", 180.0),
    ] {
        assert_eq!(eval(text, Grammar::MacroB, &open), Ok(angle), "{text}");
    }
}

#[test]
fn vacant_is_not_zero() {
    // #101 is vacant, #1 is zero here
    for (text, expected) in [
        ("[#101 EQ #0]", 1.0),
        ("[#101 NE 0]", 1.0),
        ("[#101 EQ 0]", 0.0),
        ("[#101 GE #0]", 1.0),
        ("[#101 GT 0]", 0.0),
        ("[#101 LE #0]", 1.0),
        ("[#101 LT 0]", 0.0),
        ("[#1 EQ #0]", 0.0),
        ("[#1 NE 0]", 0.0),
        ("[#1 NE #0]", 1.0),
        ("[#101*5]", 0.0),
        ("[#101+#101]", 0.0),
        ("[#101+1]", 1.0),
        ("#101", 0.0),
    ] {
        assert_eq!(eval(text, Grammar::MacroB, &Table::default()), Ok(expected), "{text}");
    }
    for (text, expected) in [
        ("#101", None),
        ("#0", None),
        ("#1", Some(0.0)),
        ("[#101]", None),
        ("-#101", Some(-0.0)),
        ("[#0*1]", Some(0.0)),
    ] {
        let formula = read(text, Grammar::MacroB).expect(text);
        assert_eq!(formula.eval_nullable(&Table::default()), Ok(expected), "{text}");
    }
    let unknown = eval("[#200 EQ #0]", Grammar::MacroB, &Table::default()).expect("a value");
    assert!(unknown.is_nan(), "an unknown variable may be vacant");
}

#[test]
fn mistakes() {
    for (text, part, sentence) in [
        ("[[[[[[1]]]]]]", "[", "brackets are nested deeper than 5 levels"),
        ("SIN[[[[[[#1]]]]]]", "[", "brackets are nested deeper than 5 levels"),
        ("[2**3]", "*", "expected a number, `#`, `[` or a function here"),
        ("[1/#0]", "1/#0", "division by zero"),
        ("[8 MOD .2]", "8 MOD .2", "division by zero"),
        ("POW[2]", "POW[2]", "POW needs two arguments: `POW[base,exponent]`"),
        ("[1,2]", ",", "expected an operator or `]` here"),
        (
            "BIN[26]",
            "BIN[26]",
            "not a binary coded decimal: write at most eight decimal digits and no sign",
        ),
        ("LN[0]", "LN[0]", "LN of zero or of a negative number"),
        ("#_NOTHERE", "#_NOTHERE", "#<_nothere> has no value here"),
    ] {
        assert_eq!(
            refused(text, Grammar::MacroB),
            (sentence.to_owned(), part.to_owned()),
            "{text}"
        );
    }
    assert_eq!(value("[[[[[1]]]]]"), 1.0);
}

#[test]
fn reads_name_system_variables() {
    let formula = read("[#5061+#_ABSIO[2]]", Grammar::MacroB).expect("a formula");
    assert_eq!(
        formula.reads().collect::<Vec<_>>(),
        [Variable::Numbered(5061), Variable::Named("_absio")]
    );
}
