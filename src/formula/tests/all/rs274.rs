//! RS274/NGC: every line of `rs274.tsv` was put after `G0X` and given to LinuxCNC's `rs274` (2.9.0~pre1); beside it stands what it
//! answered: the X of the move, or the message after `!`.
use crate::support::{Table, eval, read, refused};
use trunnion_formula::{Cursor, Grammar, Target, Variable, target, value};
use trunnion_syntax::{Decimal, TextRange};

#[test]
fn every_answer_of_the_control() {
    let mut wrong = Vec::new();
    for line in include_str!("rs274.tsv").lines() {
        let (text, answer) = line.rsplit_once('\t').expect("two columns");
        let ours = match eval(text, Grammar::Rs274, &Table::default()) {
            Ok(value) => format!("{value:.4}"),
            Err(error) => format!("! {}", error.kind.rs274_message().expect("an error the control has")),
        };
        // the fourth decimal of large results is beyond what a double keeps
        let near = |a: &str, b: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= 2e-14 * b.abs().max(1.0) && a.is_sign_negative() == b.is_sign_negative(),
            _ => a == b,
        };
        if !near(&ours, answer) {
            wrong.push(format!("{text}: {answer} expected, {ours} found"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn ranges_name_the_part_that_is_wrong() {
    let table = [
        ("[1 + #<no> ]", "#<no>", "#<no> has no value here"),
        ("[ 2 + 1 / 0 + 3 ]", "1 / 0", "division by zero"),
        ("[1 + sqrt [ -4 ] ]", "sqrt [ -4 ]", "square root of a negative number"),
        ("[1 foo 2]", "f", "unknown operator, starting with F"),
        ("[1 + foo[2]]", "foo", "unknown function, starting with F"),
        ("[1 + sin 30]", "sin", "the argument of a function must be in `[ ]`"),
        ("[3 * [1 + 2", "[", "missing `]` for this `[`"),
        (
            "1.2.3",
            "1.2.3",
            "`1.2.3` is not a number: it has more than one decimal point",
        ),
        ("[1 + -.]", "-.", "`-.` is not a number: it has no digit"),
        ("[1 + ]", "]", "expected a number, `#`, `[` or a function here"),
        ("#[1 / 4]", "#[1 / 4]", "0.25 is not a whole number"),
        ("#<abc", "#<", "missing `>` for this `#<`"),
        ("[# 7000 + 1]", "# 7000", "parameter #7000 does not exist"),
        ("#<_hal[x]>", "#<_hal[x]>", "no HAL pins here"),
        ("[10**400]", "10**400", "the result is too large"),
        ("atan[1]", "atan[1]", "ATAN needs two arguments: `ATAN[y]/[x]`"),
        (
            "exists[#<a> + 1]",
            "+",
            "EXISTS takes one parameter and nothing else: expected `]` here",
        ),
    ];
    for (text, part, sentence) in table {
        assert_eq!(
            refused(text, Grammar::Rs274),
            (sentence.to_owned(), part.to_owned()),
            "{text}"
        );
    }
}

#[test]
fn a_plain_number_keeps_its_digits() {
    let decimal = |mantissa, scale, has_point| Decimal {
        mantissa,
        scale,
        has_point,
    };
    for (text, expected) in [
        ("10", Some(decimal(10, 0, false))),
        ("-10.50", Some(decimal(-1050, 2, true))),
        ("+ 1 2 . 5", Some(decimal(125, 1, true))),
        ("--1", None),
        ("[1]", None),
        ("#1", None),
    ] {
        assert_eq!(read(text, Grammar::Rs274).expect(text).literal(), expected, "{text}");
    }
    let long = read("1234567890123456789012", Grammar::Rs274).expect("a number");
    assert_eq!(
        (long.literal(), long.number()),
        (None, Some(1_234_567_890_123_456_789_012.0))
    );
}

#[test]
fn unknown_stays_unknown_until_something_settles_it() {
    let table = Table::default();
    for text in [
        "#200",
        "[#200 + 1]",
        "[#200 GT 1]",
        "[1 AND #200]",
        "[0 OR #200]",
        "[1 XOR #200]",
        "##200",
        "sin[#<unknown>]",
    ] {
        assert!(eval(text, Grammar::Rs274, &table).expect(text).is_nan(), "{text}");
    }
    for (text, expected) in [
        ("[0 AND #200]", 0.0),
        ("[#200 AND 0]", 0.0),
        ("[#200 OR 5]", 1.0),
        ("exists[#200]", 1.0),
    ] {
        assert_eq!(eval(text, Grammar::Rs274, &table), Ok(expected), "{text}");
    }
}

#[test]
fn the_variables_a_formula_reads() {
    let formula = read("[#1 + #<Some Name> * #[#5061 + 1] - exists[#<x>]]", Grammar::Rs274).expect("a formula");
    let reads: Vec<_> = formula.reads().collect();
    assert_eq!(
        reads,
        [
            Variable::Numbered(1),
            Variable::Named("somename"),
            Variable::Numbered(5061),
            Variable::Computed(TextRange::new(21, 33)),
        ]
    );
}

#[test]
fn left_sides() {
    let read = |text: &str| {
        let mut cursor = Cursor::new(text.as_bytes(), TextRange::new(0, text.len() as u32));
        let target = target(&mut cursor, Grammar::Rs274).expect(text);
        assert!(cursor.eat(b'='), "{text}");
        target
    };
    assert_eq!(read("<A b>=1"), Target::Named("ab".into()));
    let Target::Numbered(formula) = read("[1+#2]=3") else {
        panic!("a number")
    };
    assert_eq!(
        formula.eval(&Table {
            values: vec![(2, 4.0)],
            ..Table::default()
        }),
        Ok(5.0)
    );
}

#[test]
fn reading_stops_behind_the_value() {
    let text = "  1 2 X3";
    let mut cursor = Cursor::new(text.as_bytes(), TextRange::new(0, 8));
    let formula = value(&mut cursor, Grammar::Rs274).expect("a number");
    assert_eq!((formula.range(), formula.number()), (TextRange::new(2, 5), Some(12.0)));
    assert_eq!((cursor.at(), cursor.behind(), cursor.peek()), (6, 5, Some(b'x')));
}
