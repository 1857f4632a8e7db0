//! The words of both grammars: operators, functions, names, numbers. Leaf parsers, read with nom from a cursor.
use crate::code::{Binary, Unary};
use crate::{Cursor, Grammar, Name};
use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while};
use nom::combinator::{opt, recognize, value, verify};
use nom::{IResult, Input, Parser};

type Leaf<'s, T> = IResult<Cursor<'s>, T>;

/// What a function name stands for; those with more than one argument have a shape of their own.
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

fn word<'s, T: Clone>(
    text: &'static str,
    meaning: T,
) -> impl Parser<Cursor<'s>, Output = T, Error = nom::error::Error<Cursor<'s>>> {
    value(meaning, tag(text))
}

/// All but the signs `+ - * /`. RS274/NGC: power, then products, then sums, then comparisons, then logic; `AND OR XOR` are equals.
fn rs274_operator(input: Cursor<'_>) -> Leaf<'_, Operator> {
    alt((
        word("**", operator(Binary::Power, 6)),
        word("mod", operator(Binary::Modulo, 5)),
        word("eq", operator(Binary::NearlyEqual, 3)),
        word("ne", operator(Binary::NotNearlyEqual, 3)),
        word("gt", operator(Binary::Greater, 3)),
        word("ge", operator(Binary::GreaterOrEqual, 3)),
        word("lt", operator(Binary::Less, 3)),
        word("le", operator(Binary::LessOrEqual, 3)),
        word("and", operator(Binary::LogicalAnd, 2)),
        word("xor", operator(Binary::LogicalXor, 2)),
        word("or", operator(Binary::LogicalOr, 2)),
    ))
    .parse(input)
}

/// All but the signs `+ - * /`. Macro B: products and AND, then sums, OR and XOR, then comparisons.
fn macro_operator(input: Cursor<'_>) -> Leaf<'_, Operator> {
    alt((
        word("mod", operator(Binary::Remainder, 5)),
        word("and", operator(Binary::BitAnd, 5)),
        word("xor", operator(Binary::BitXor, 4)),
        word("or", operator(Binary::BitOr, 4)),
        word("eq", operator(Binary::Equal, 3)),
        word("ne", operator(Binary::NotEqual, 3)),
        word("gt", operator(Binary::Greater, 3)),
        word("ge", operator(Binary::GreaterOrEqual, 3)),
        word("lt", operator(Binary::Less, 3)),
        word("le", operator(Binary::LessOrEqual, 3)),
    ))
    .parse(input)
}

fn rs274_function(input: Cursor<'_>) -> Leaf<'_, Function> {
    alt((
        word("abs", Function::One(Unary::Abs)),
        word("acos", Function::One(Unary::Acos)),
        word("asin", Function::One(Unary::Asin)),
        word("atan", Function::Atan),
        word("cos", Function::One(Unary::Cos)),
        word("exp", Function::One(Unary::Exp)),
        word("exists", Function::Exists),
        word("fix", Function::One(Unary::Floor)),
        word("fup", Function::One(Unary::Ceiling)),
        word("ln", Function::One(Unary::Ln)),
        word("round", Function::One(Unary::RoundToInt)),
        word("sin", Function::One(Unary::Sin)),
        word("sqrt", Function::One(Unary::Sqrt)),
        word("tan", Function::One(Unary::Tan)),
    ))
    .parse(input)
}

fn macro_function(input: Cursor<'_>) -> Leaf<'_, Function> {
    alt((
        alt((
            word("abs", Function::One(Unary::Abs)),
            word("acos", Function::One(Unary::Acos)),
            word("adp", Function::One(Unary::AddPoint)),
            word("asin", Function::One(Unary::MacroAsin)),
            word("atan", Function::Atan),
            word("bcd", Function::One(Unary::ToBcd)),
            word("bin", Function::One(Unary::FromBcd)),
            word("cos", Function::One(Unary::Cos)),
            word("exp", Function::One(Unary::Exp)),
            word("fix", Function::One(Unary::Truncate)),
            word("fup", Function::One(Unary::AwayFromZero)),
            word("ln", Function::One(Unary::Ln)),
        )),
        alt((
            word("pow", Function::Pow),
            word("round", Function::One(Unary::Round)),
            word("rnd", Function::One(Unary::Round)),
            word("sin", Function::One(Unary::Sin)),
            word("sqrt", Function::One(Unary::Sqrt)),
            word("sqr", Function::One(Unary::Sqrt)),
            word("tan", Function::One(Unary::Tan)),
        )),
    ))
    .parse(input)
}

/// Runs a leaf parser and moves the cursor after what it read.
fn take<'s, T>(cursor: &mut Cursor<'s>, leaf: impl FnOnce(Cursor<'s>) -> Leaf<'s, T>) -> Option<T> {
    let (rest, found) = leaf(*cursor).ok()?;
    *cursor = rest;
    Some(found)
}

/// A word of RS274/NGC at the cursor without blanks between its letters: no word begins with another, so that it is
/// the one the leaf parsers find.
#[inline]
fn take_written<T>(cursor: &mut Cursor<'_>, grammar: Grammar, find: fn([u8; 4]) -> Option<(T, u32)>) -> Option<T> {
    if grammar != Grammar::Rs274 {
        return None;
    }
    let head = cursor.rest().first_chunk::<4>()?;
    let (meaning, length) = find(head.map(|byte| byte.to_ascii_lowercase()))?;
    cursor.skip_to(cursor.at() + length);
    Some(meaning)
}

/// The operator that four letters begin with, and its length.
#[inline]
pub(crate) fn short_operator(head: [u8; 4]) -> Option<(Operator, u32)> {
    let [a, b, c, _] = head;
    Some(match [a, b] {
        [b'*', b'*'] => (operator(Binary::Power, 6), 2),
        [b'e', b'q'] => (operator(Binary::NearlyEqual, 3), 2),
        [b'n', b'e'] => (operator(Binary::NotNearlyEqual, 3), 2),
        [b'g', b't'] => (operator(Binary::Greater, 3), 2),
        [b'g', b'e'] => (operator(Binary::GreaterOrEqual, 3), 2),
        [b'l', b't'] => (operator(Binary::Less, 3), 2),
        [b'l', b'e'] => (operator(Binary::LessOrEqual, 3), 2),
        [b'o', b'r'] => (operator(Binary::LogicalOr, 2), 2),
        [b'm', b'o'] if c == b'd' => (operator(Binary::Modulo, 5), 3),
        [b'a', b'n'] if c == b'd' => (operator(Binary::LogicalAnd, 2), 3),
        [b'x', b'o'] if c == b'r' => (operator(Binary::LogicalXor, 2), 3),
        _ => return None,
    })
}

/// The function that four letters are or begin with, and its length.
#[inline]
pub(crate) fn short_function(head: [u8; 4]) -> Option<(Function, u32)> {
    let one = |unary, length| Some((Function::One(unary), length));
    match &head {
        b"acos" => one(Unary::Acos, 4),
        b"asin" => one(Unary::Asin, 4),
        b"atan" => Some((Function::Atan, 4)),
        b"sqrt" => one(Unary::Sqrt, 4),
        [b'a', b'b', b's', _] => one(Unary::Abs, 3),
        [b'c', b'o', b's', _] => one(Unary::Cos, 3),
        [b'e', b'x', b'p', _] => one(Unary::Exp, 3),
        [b'f', b'i', b'x', _] => one(Unary::Floor, 3),
        [b'f', b'u', b'p', _] => one(Unary::Ceiling, 3),
        [b'l', b'n', ..] => one(Unary::Ln, 2),
        [b's', b'i', b'n', _] => one(Unary::Sin, 3),
        [b't', b'a', b'n', _] => one(Unary::Tan, 3),
        _ => None,
    }
}

/// The operator at the cursor.
pub(crate) fn take_operator(cursor: &mut Cursor<'_>, grammar: Grammar) -> Option<Operator> {
    // the commonest are one sign and need no search
    let sign = match cursor.peek()? {
        b'+' => operator(Binary::Add, 4),
        b'-' => operator(Binary::Subtract, 4),
        b'/' => operator(Binary::Divide, 5),
        b'*' if grammar == Grammar::MacroB || cursor.peek_second() != Some(b'*') => operator(Binary::Multiply, 5),
        _ => {
            if let Some(operator) = take_written(cursor, grammar, short_operator) {
                return Some(operator);
            }
            return take(cursor, |input| match grammar {
                Grammar::Rs274 => rs274_operator(input),
                Grammar::MacroB => macro_operator(input),
            });
        }
    };
    cursor.bump();
    Some(sign)
}

/// The function at the cursor.
pub(crate) fn take_function(cursor: &mut Cursor<'_>, grammar: Grammar) -> Option<Function> {
    if let Some(function) = take_written(cursor, grammar, short_function) {
        return Some(function);
    }
    take(cursor, |input| match grammar {
        Grammar::Rs274 => rs274_function(input),
        Grammar::MacroB => macro_function(input),
    })
}

/// The text after `<` up to `>`, blanks removed, in lower case; `None` if there is no `>` on the line.
pub(crate) fn take_angled(cursor: &mut Cursor<'_>) -> Option<Name> {
    if let Some(name) = take_short_angled(cursor) {
        return Some(name);
    }
    let name = take(cursor, |input| {
        (tag("<"), take_till(|byte| byte == b'>'), tag(">"))
            .map(|(_, name, _): (Cursor<'_>, Cursor<'_>, Cursor<'_>)| name)
            .parse(input)
    })?;
    Some(Name::new(&text(name)))
}

/// The same for a short name of letters, digits and `_`.
#[inline]
fn take_short_angled(cursor: &mut Cursor<'_>) -> Option<Name> {
    let (&b'<', rest) = cursor.rest().split_first()? else {
        return None;
    };
    let (name, length) = Name::before(rest, b'>')?;
    cursor.skip_to(cursor.at() + length as u32 + 2);
    Some(name)
}

/// A name of letters, digits and `_` that begins with a letter or `_` (Macro B), in lower case.
pub(crate) fn take_name(cursor: &mut Cursor<'_>) -> Option<Name> {
    let name = take(cursor, |input| {
        verify(
            take_while(|byte: u8| byte.is_ascii_alphanumeric() || byte == b'_'),
            |name: &Cursor<'_>| name.peek().is_some_and(|first| !first.is_ascii_digit()),
        )
        .parse(input)
    })?;
    Some(Name::new(&text(name)))
}

/// `[+-]` and then digits and points, as many as there are; whether it is a number is for the caller to decide.
pub(crate) fn take_numeral<'s>(cursor: &mut Cursor<'s>) -> Cursor<'s> {
    take(cursor, |input| {
        recognize((
            opt(alt((tag("+"), tag("-")))),
            take_while(|byte: u8| byte.is_ascii_digit() || byte == b'.'),
        ))
        .parse(input)
    })
    .unwrap_or_else(|| cursor.take(0))
}

/// The bytes of `input` without blanks; bytes above 127 as in Latin-1.
pub(crate) fn text(input: Cursor<'_>) -> Box<str> {
    input.iter_elements().map(char::from).collect::<String>().into()
}
