//! Random expressions, written as text with random blanks and case, are worth what a plain tree walk says.
use crate::support::{Table, whole};
use proptest::prelude::*;
use trunnion_formula::{Cursor, Grammar, value};

#[derive(Clone, Debug)]
enum Tree {
    Number(i32, u8),
    Variable(u8),
    Negate(Box<Tree>),
    Call(u8, Box<Tree>),
    Binary(u8, Box<Tree>, Box<Tree>),
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (0..100_000i32, 0..5u8).prop_map(|(digits, places)| Tree::Number(digits, places)),
        (1..6u8).prop_map(Tree::Variable),
    ];
    leaf.prop_recursive(6, 40, 2, |inner| {
        prop_oneof![
            inner.clone().prop_map(|tree| Tree::Negate(tree.into())),
            (0..4u8, inner.clone()).prop_map(|(call, tree)| Tree::Call(call, tree.into())),
            (0..12u8, inner.clone(), inner).prop_map(|(which, left, right)| Tree::Binary(
                which,
                left.into(),
                right.into()
            )),
        ]
    })
}

const VARIABLES: [f64; 6] = [0.0, 0.0, 1.0, -2.5, 7.25, 1e3];
const CALLS: [&str; 4] = ["abs", "round", "fix", "fup"];
/// Operator, rank in RS274/NGC, rank in Macro B (none: not there).
const OPERATORS: [(&str, u8, Option<u8>); 12] = [
    ("+", 4, Some(4)),
    ("-", 4, Some(4)),
    ("*", 5, Some(5)),
    ("**", 6, None),
    ("lt", 3, Some(3)),
    ("ge", 3, Some(3)),
    ("gt", 3, Some(3)),
    ("le", 3, Some(3)),
    ("and", 2, None),
    ("or", 2, None),
    ("xor", 2, None),
    ("+", 4, Some(4)),
];

fn operator(which: u8, grammar: Grammar) -> (&'static str, u8) {
    let (name, ngc, fanuc) = OPERATORS[usize::from(which)];
    match (grammar, fanuc) {
        (Grammar::Rs274, _) => (name, ngc),
        (Grammar::MacroB, Some(rank)) => (name, rank),
        (Grammar::MacroB, None) => ("*", 5),
    }
}

/// What the tree is worth; `None` where the power of a negative number has no value.
fn walk(tree: &Tree, grammar: Grammar) -> Option<f64> {
    let truth = |holds: bool| Some(f64::from(u8::from(holds)));
    match tree {
        Tree::Number(digits, places) => format!("{digits}e-{places}").parse().ok(),
        Tree::Variable(index) => Some(VARIABLES[usize::from(*index)]),
        Tree::Negate(inner) => Some(-walk(inner, grammar)?),
        Tree::Call(call, inner) => {
            let x = walk(inner, grammar)?;
            Some(match (CALLS[usize::from(*call)], grammar) {
                ("abs", _) => x.abs(),
                // 32 bits
                ("round", Grammar::Rs274) if x.abs() > 2e9 => return None,
                ("round", _) => x.round(),
                ("fix", Grammar::Rs274) => x.floor(),
                ("fix", Grammar::MacroB) => x.trunc(),
                ("fup", Grammar::MacroB) if x < 0.0 => x.floor(),
                _ => x.ceil(),
            })
        }
        Tree::Binary(which, left, right) => {
            let (a, b) = (walk(left, grammar)?, walk(right, grammar)?);
            match operator(*which, grammar).0 {
                "+" => Some(a + b),
                "-" => Some(a - b),
                "*" => Some(a * b),
                "**" => {
                    let power = trunnion_geometry::math::pow(a, b);
                    power.is_finite().then_some(power)
                }
                "lt" => truth(a < b),
                "ge" => truth(a >= b),
                "gt" => truth(a > b),
                "le" => truth(a <= b),
                "and" => truth(a != 0.0 && b != 0.0),
                "or" => truth(a != 0.0 || b != 0.0),
                _ => truth((a != 0.0) != (b != 0.0)),
            }
        }
    }
}

/// Writes the tree with brackets only where the rank of operators asks for them.
fn write(tree: &Tree, grammar: Grammar, outer: u8, out: &mut String) {
    match tree {
        Tree::Number(digits, places) => {
            let places = usize::from(*places);
            let text = format!("{digits:0>width$}", width = places + 1);
            let (before, behind) = text.split_at(text.len() - places);
            out.push_str(before);
            if !behind.is_empty() {
                out.push('.');
                out.push_str(behind);
            }
        }
        Tree::Variable(index) => {
            out.push('#');
            out.push(char::from(b'0' + index));
        }
        Tree::Negate(inner) => {
            out.push('-');
            write(inner, grammar, 9, out);
        }
        Tree::Call(call, inner) => {
            out.push_str(CALLS[usize::from(*call)]);
            out.push('[');
            write(inner, grammar, 0, out);
            out.push(']');
        }
        Tree::Binary(which, left, right) => {
            let (name, rank) = operator(*which, grammar);
            let brackets = rank < outer;
            if brackets {
                out.push('[');
            }
            write(left, grammar, rank, out);
            out.push_str(name);
            write(right, grammar, rank + 1, out);
            if brackets {
                out.push(']');
            }
        }
    }
}

/// Sprinkles blanks and changes case, as `pattern` says.
fn disguise(text: &str, pattern: &[u8]) -> String {
    let mut out = String::new();
    for (letter, how) in text.chars().zip(pattern.iter().cycle()) {
        out.push(if how & 1 == 1 {
            letter.to_ascii_uppercase()
        } else {
            letter
        });
        out.push_str(["", "", " ", "\t "][usize::from(how >> 1 & 3)]);
    }
    out
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn text_is_worth_its_tree(tree in tree(), macro_b: bool, pattern in prop::collection::vec(any::<u8>(), 1..50)) {
        let grammar = if macro_b { Grammar::MacroB } else { Grammar::Rs274 };
        let mut text = String::from("[");
        write(&tree, grammar, 0, &mut text);
        text.push(']');
        let text = disguise(&text, &pattern);
        let table = Table { values: (1..6).map(|index| (i64::from(index), VARIABLES[index as usize])).collect(), ..Table::default() };
        let mut cursor = Cursor::new(text.as_bytes(), whole(&text));
        match value(&mut cursor, grammar) {
            Ok(formula) => {
                prop_assert!(cursor.is_at_end());
                prop_assert_eq!(formula.range(), trunnion_syntax::TextRange::new(0, text.trim_end().len() as u32));
                if let Some(expected) = walk(&tree, grammar).filter(|value| value.is_finite()) {
                    prop_assert_eq!(formula.eval(&table), Ok(expected), "{}", text);
                }
            }
            // more than five levels
            Err(error) => prop_assert!(macro_b, "{}: {}", text, error),
        }
    }
}
