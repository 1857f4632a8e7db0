//! Arithmetic of the control, and what may have changed.
use super::*;

#[test]
fn arithmetic_is_the_control_s() {
    let mut own = Own::default();
    own.assign("R1", Some(10.0));
    own.assign("r[1+1]", Some(-4.0));
    own.begin_block();
    for (text, value) in [
        ("R1+2*3", Some(16.0)),
        ("(R1+2)*3", Some(36.0)),
        ("-R2", Some(4.0)),
        ("R1-R2-1", Some(13.0)),
        ("R[2]", Some(-4.0)),
        ("7 DIV 2*2", Some(6.0)),
        ("7MOD 4", Some(3.0)),
        ("R1/4", Some(2.5)),
        ("POT(3)+ABS(R2)", Some(13.0)),
        ("TRUNC(-2.7)", Some(-2.0)),
        ("ROUND(2.5)", Some(3.0)),
        (".5*R1", Some(5.0)),
        ("R1/0", None),
        ("R9", None),
        ("R1+", None),
        ("R1)", None),
        ("SQRT(R2)", None),
        ("NAME", None),
        ("$AA_IM[X]", None),
        ("1EX3", Some(1000.0)),
        ("R1>3", Some(1.0)),
        ("R9>3", None),
    ] {
        assert_eq!(own.value(text), value, "{text}");
    }
    for (text, value) in [
        ("SIN(30)", 0.5),
        ("ATAN2(1,-1)", 135.0),
        ("ACOS(0.5)", 60.0),
        ("TAN(45)", 1.0),
    ] {
        assert!((own.value(text).expect(text) - value).abs() < 1e-12, "{text}");
    }
}

#[test]
fn what_may_have_changed_is_not_known() {
    let mut own = Own::default();
    own.define("REAL A, B=2.5");
    own.define("INT COUNT=2.5");
    assert_eq!(own.value("B"), None, "written in the current block");
    own.begin_block();
    assert_eq!(
        (own.value("a"), own.value("B"), own.value("COUNT")),
        (Some(0.0), Some(2.5), Some(3.0))
    );
    own.assign("GLOBAL", Some(0.5));
    own.assign("R5", Some(0.5));
    own.begin_block();
    assert_eq!(
        (own.value("GLOBAL"), own.value("R5")),
        (None, Some(0.5)),
        "the sort of GLOBAL is not known"
    );
    own.assign("R[X]", Some(1.0));
    assert_eq!((own.value("R5"), own.value("B")), (None, Some(2.5)));
    own.lose();
    assert_eq!(own.value("B"), None);
}
