//! The words of both grammars: operators, functions, names, numbers.
use crate::code::{Binary, Unary};
use crate::{Cursor, Grammar, Name};

/// What a function name means; those with more than one argument have their own shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    /// One argument in brackets.
    One(Unary),
    /// `ATAN[y]/[x]`; in Macro B `ATAN[y]` and `ATAN[y,x]`, too.
    Atan,
    /// `POW[base,exponent]`.
    Pow,
    /// `EXISTS[#<name>]`.
    Exists,
}

/// An operator with its rank: the higher one binds first, equal ones from left to right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Operator {
    pub(crate) binary: Binary,
    pub(crate) rank: u8,
}

pub(crate) const fn operator(binary: Binary, rank: u8) -> Operator {
    Operator { binary, rank }
}

/// All but the signs `+ - * /`. RS274/NGC: power, then products, then sums, then comparisons, then logic; `AND OR XOR` are equals.
const RS274_OPERATORS: [(&str, Operator); 11] = [
    ("**", operator(Binary::Power, 6)),
    ("mod", operator(Binary::Modulo, 5)),
    ("eq", operator(Binary::NearlyEqual, 3)),
    ("ne", operator(Binary::NotNearlyEqual, 3)),
    ("gt", operator(Binary::Greater, 3)),
    ("ge", operator(Binary::GreaterOrEqual, 3)),
    ("lt", operator(Binary::Less, 3)),
    ("le", operator(Binary::LessOrEqual, 3)),
    ("and", operator(Binary::LogicalAnd, 2)),
    ("xor", operator(Binary::LogicalXor, 2)),
    ("or", operator(Binary::LogicalOr, 2)),
];

/// All but the signs `+ - * /`. Macro B: products and AND, then sums, OR and XOR, then comparisons.
const MACRO_OPERATORS: [(&str, Operator); 10] = [
    ("mod", operator(Binary::Remainder, 5)),
    ("and", operator(Binary::BitAnd, 5)),
    ("xor", operator(Binary::BitXor, 4)),
    ("or", operator(Binary::BitOr, 4)),
    ("eq", operator(Binary::Equal, 3)),
    ("ne", operator(Binary::NotEqual, 3)),
    ("gt", operator(Binary::Greater, 3)),
    ("ge", operator(Binary::GreaterOrEqual, 3)),
    ("lt", operator(Binary::Less, 3)),
    ("le", operator(Binary::LessOrEqual, 3)),
];

/// Functions of RS274/NGC.
const RS274_FUNCTIONS: [(&str, Function); 14] = [
    ("abs", Function::One(Unary::Abs)),
    ("acos", Function::One(Unary::Acos)),
    ("asin", Function::One(Unary::Asin)),
    ("atan", Function::Atan),
    ("cos", Function::One(Unary::Cos)),
    ("exp", Function::One(Unary::Exp)),
    ("exists", Function::Exists),
    ("fix", Function::One(Unary::Floor)),
    ("fup", Function::One(Unary::Ceiling)),
    ("ln", Function::One(Unary::Ln)),
    ("round", Function::One(Unary::RoundToInt)),
    ("sin", Function::One(Unary::Sin)),
    ("sqrt", Function::One(Unary::Sqrt)),
    ("tan", Function::One(Unary::Tan)),
];

/// Functions of Macro B; a word before those that it begins with.
const MACRO_FUNCTIONS: [(&str, Function); 19] = [
    ("abs", Function::One(Unary::Abs)),
    ("acos", Function::One(Unary::Acos)),
    ("adp", Function::One(Unary::AddPoint)),
    ("asin", Function::One(Unary::MacroAsin)),
    ("atan", Function::Atan),
    ("bcd", Function::One(Unary::ToBcd)),
    ("bin", Function::One(Unary::FromBcd)),
    ("cos", Function::One(Unary::Cos)),
    ("exp", Function::One(Unary::Exp)),
    ("fix", Function::One(Unary::Truncate)),
    ("fup", Function::One(Unary::AwayFromZero)),
    ("ln", Function::One(Unary::Ln)),
    ("pow", Function::Pow),
    ("round", Function::One(Unary::Round)),
    ("rnd", Function::One(Unary::Round)),
    ("sin", Function::One(Unary::Sin)),
    ("sqrt", Function::One(Unary::Sqrt)),
    ("sqr", Function::One(Unary::Sqrt)),
    ("tan", Function::One(Unary::CheckedTan)),
];

/// Takes the first of some words that the cursor is at, and gives its meaning. Blanks may be between the letters.
fn take_word<T: Copy>(cursor: &mut Cursor<'_>, words: &[(&str, T)]) -> Option<T> {
    let first = cursor.peek()?;
    words.iter().find_map(|(word, meaning)| {
        let (own, rest) = word.as_bytes().split_first()?;
        if *own != first {
            return None;
        }
        let mut ahead = *cursor;
        ahead.bump();
        if !rest.iter().all(|byte| ahead.eat(*byte)) {
            return None;
        }
        *cursor = ahead;
        Some(*meaning)
    })
}

/// The operator at the cursor.
pub(crate) fn take_operator(cursor: &mut Cursor<'_>, grammar: Grammar) -> Option<Operator> {
    let sign = match cursor.peek()? {
        b'+' => operator(Binary::Add, 4),
        b'-' => operator(Binary::Subtract, 4),
        b'/' => operator(Binary::Divide, 5),
        b'*' if grammar == Grammar::MacroB || cursor.peek_second() != Some(b'*') => operator(Binary::Multiply, 5),
        _ => {
            return match grammar {
                Grammar::Rs274 => take_word(cursor, &RS274_OPERATORS),
                Grammar::MacroB => take_word(cursor, &MACRO_OPERATORS),
            };
        }
    };
    cursor.bump();
    Some(sign)
}

/// The function at the cursor.
pub(crate) fn take_function(cursor: &mut Cursor<'_>, grammar: Grammar) -> Option<Function> {
    match grammar {
        Grammar::Rs274 => take_word(cursor, &RS274_FUNCTIONS),
        Grammar::MacroB => take_word(cursor, &MACRO_FUNCTIONS),
    }
}

/// The text after `<` up to `>`, blanks removed, in lower case; `None` if there is no `>` on the line.
pub(crate) fn take_angled(cursor: &mut Cursor<'_>) -> Option<Name> {
    let rest = cursor.rest().strip_prefix(b"<")?;
    if let Some((name, length)) = Name::before(rest, b'>') {
        cursor.skip_to(cursor.at() + length as u32 + 2);
        return Some(name);
    }
    let mut ahead = *cursor;
    ahead.bump();
    let text = take_while(&mut ahead, |byte| byte != b'>');
    if !ahead.eat(b'>') {
        return None;
    }
    *cursor = ahead;
    Some(Name::new(&text))
}

/// A name of letters, digits and `_` (Macro B), in lower case; the cursor is at its first letter.
pub(crate) fn take_name(cursor: &mut Cursor<'_>) -> Name {
    Name::new(&take_while(cursor, |byte| byte.is_ascii_alphanumeric() || byte == b'_'))
}

/// `[+-]` and then digits and points, as many as there are, without blanks; whether it is a number is for the caller to decide.
pub(crate) fn take_numeral(cursor: &mut Cursor<'_>) -> String {
    let mut text = String::new();
    if matches!(cursor.peek(), Some(b'+' | b'-')) {
        text.extend(cursor.bump().map(char::from));
    }
    text + &take_while(cursor, |byte| byte.is_ascii_digit() || byte == b'.')
}

/// The bytes up to the first that does not belong, without blanks, in lower case; bytes above 127 as in Latin-1.
fn take_while(cursor: &mut Cursor<'_>, belongs: impl Fn(u8) -> bool) -> String {
    let mut text = String::new();
    while let Some(byte) = cursor.peek().filter(|byte| belongs(*byte)) {
        text.push(char::from(byte));
        cursor.bump();
    }
    text
}
