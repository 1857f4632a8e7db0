//! Blocks of expressions that show by the kinds of their tokens that nothing is wrong with them: most of every macro.
//!
//! A block that passes here has no problem by the grammar of the items, which need not read it then (a test compares both); any
//! other is read. The fast path of the lexer takes one step per token, by a table.
use crate::expression::{is_function, is_one_of};
use crate::names::{CONDITIONS, NUMBERED};

/// The class of a token in the table: its kind, refined where the grammar does so.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Sign {
    Blank,
    Newline,
    Comment,
    Word,
    LongWord,
    Letter,
    /// A number that certainly has no more digits than a decimal holds.
    Number,
    LongNumber,
    /// `#` alone.
    Hash,
    /// `#<name>`
    Parameter,
    /// The `<name>` of `o<name>`.
    Called,
    Open,
    Close,
    PlusMinus,
    StarSlash,
    Equals,
    Comma,
    /// `IF`, `WHILE`
    Condition,
    /// `DO`, `END`
    Numbered,
    Call,
    Function,
    OtherName,
}

/// How many signs there are.
const SIGNS: usize = Sign::OtherName as usize + 1;
/// The largest number of states.
const STATES: usize = 256;

/// How far a block is read: a state of the table.
#[derive(Clone, Copy, Default)]
pub(crate) struct Course(u8);

/// Between two items, where a block begins and may end.
const BETWEEN: u8 = 0;
/// After the letter of a value in brackets or a parameter.
const LETTER: u8 = 1;
/// After the sign of such a value.
const SIGNED: u8 = 2;
/// After the `#` of such a value.
const LETTER_HASH: u8 = 3;
/// After the `#` of a parameter that is assigned to.
const TARGET_HASH: u8 = 4;
/// After a parameter that is assigned to.
const TARGET: u8 = 5;
/// After its `=`.
const EQUALS: u8 = 6;
/// After the sign of the value that is assigned.
const EQUALS_SIGNED: u8 = 7;
/// After the `#` of the value that is assigned.
const EQUALS_HASH: u8 = 8;
/// After the function of the value that is assigned.
const FUNCTION: u8 = 9;
/// After a value: no operator may follow.
const VALUE: u8 = 10;
/// After `IF` and its like.
const CONDITION: u8 = 11;
/// After `DO` and its like, which may own a number.
const NUMBERED_NAME: u8 = 12;
/// After `call`.
const CALL: u8 = 13;
/// After the brackets of a call.
const CALLED: u8 = 14;
/// After another name.
const NAME: u8 = 15;
/// Inside brackets, where a value is wanted (even) and where none is (odd), by what the brackets are: the value of a letter, ..
const LETTER_GROUP: u8 = 16;
/// .. the number of a parameter that is assigned to, ..
const TARGET_GROUP: u8 = 18;
/// .. the value that is assigned or the brackets of a name, ..
const VALUE_GROUP: u8 = 20;
/// .. an argument of a call.
const CALL_GROUP: u8 = 22;
/// The same with one bracket more around it is so much further on; blocks with more brackets than there is room for are odd.
const DEEPER: u8 = 8;
/// After the last of them.
const TOO_DEEP: u8 = 248;
/// Something that the grammar must check.
const ODD: u8 = 255;

/// The state after a token, by its class and the state before.
static NEXT: [[u8; STATES]; SIGNS] = table();

const fn table() -> [[u8; STATES]; SIGNS] {
    let mut next = [[ODD; STATES]; SIGNS];
    let mut state = 0;
    while state < STATES {
        let mut sign = 0;
        while sign < SIGNS {
            next[sign][state] = behind(state as u8, sign);
            sign += 1;
        }
        state += 1;
    }
    next
}

/// The state after the sign number `sign`.
const fn behind(state: u8, sign: usize) -> u8 {
    const fn is(sign: usize, other: Sign) -> bool {
        sign == other as usize
    }
    if is(sign, Sign::LongWord) {
        return ODD;
    }
    if state >= LETTER_GROUP {
        return inside(state, sign);
    }
    if is(sign, Sign::Blank) {
        // directly after a sign or a function there must be its operand
        return match state {
            EQUALS_SIGNED | FUNCTION => ODD,
            _ => state,
        };
    }
    match state {
        LETTER if is(sign, Sign::PlusMinus) => SIGNED,
        LETTER if is(sign, Sign::Called) => BETWEEN,
        LETTER | SIGNED => operand(sign, LETTER_HASH, LETTER_GROUP, BETWEEN),
        LETTER_HASH | TARGET_HASH | EQUALS_HASH => {
            let (group, end) = match state {
                LETTER_HASH => (LETTER_GROUP, BETWEEN),
                TARGET_HASH => (TARGET_GROUP, TARGET),
                _ => (VALUE_GROUP, VALUE),
            };
            if is(sign, Sign::Number) || is(sign, Sign::LongNumber) {
                end
            } else {
                operand(sign, state, group, end)
            }
        }
        TARGET if is(sign, Sign::Equals) => EQUALS,
        EQUALS if is(sign, Sign::PlusMinus) => EQUALS_SIGNED,
        EQUALS | EQUALS_SIGNED if is(sign, Sign::Number) => VALUE,
        EQUALS | EQUALS_SIGNED if is(sign, Sign::Function) => FUNCTION,
        EQUALS | EQUALS_SIGNED => operand(sign, EQUALS_HASH, VALUE_GROUP, VALUE),
        CALLED if is(sign, Sign::Open) => CALL_GROUP,
        VALUE | CALLED if names(sign) => ODD,
        BETWEEN | VALUE | CALLED => item(sign),
        NAME | CALL | NUMBERED_NAME if is(sign, Sign::Newline) || is(sign, Sign::Comment) => BETWEEN,
        FUNCTION | CONDITION | NAME if is(sign, Sign::Open) => VALUE_GROUP,
        CALL if is(sign, Sign::Open) => CALL_GROUP,
        _ => ODD,
    }
}

/// After a token between two items.
const fn item(sign: usize) -> u8 {
    const ENDS: [usize; 3] = [Sign::Newline as usize, Sign::Comment as usize, Sign::Word as usize];
    match sign {
        _ if sign == ENDS[0] || sign == ENDS[1] || sign == ENDS[2] => BETWEEN,
        _ if sign == Sign::Letter as usize => LETTER,
        _ if sign == Sign::Hash as usize => TARGET_HASH,
        _ if sign == Sign::Parameter as usize => TARGET,
        _ if sign == Sign::Condition as usize => CONDITION,
        _ if sign == Sign::Numbered as usize => NUMBERED_NAME,
        _ if sign == Sign::Call as usize => CALL,
        _ if names(sign) => NAME,
        _ => ODD,
    }
}

/// Whether a token is a name.
const fn names(sign: usize) -> bool {
    sign >= Sign::Condition as usize
}

/// After the first token of a parameter or of brackets.
const fn operand(sign: usize, hash: u8, group: u8, end: u8) -> u8 {
    match sign {
        _ if sign == Sign::Hash as usize => hash,
        _ if sign == Sign::Parameter as usize => end,
        _ if sign == Sign::Open as usize => group,
        _ => ODD,
    }
}

/// After a token inside brackets: anything may be there, but there must be a value before each closing one.
const fn inside(state: u8, sign: usize) -> u8 {
    if state >= TOO_DEEP {
        return ODD;
    }
    let (group, lacks) = (state & !1, state & 1 == 0);
    match sign {
        _ if sign == Sign::Blank as usize || sign == Sign::Comment as usize => state,
        _ if sign == Sign::Newline as usize => ODD,
        _ if sign == Sign::Close as usize => match group {
            _ if lacks => ODD,
            LETTER_GROUP => BETWEEN,
            TARGET_GROUP => TARGET,
            VALUE_GROUP => VALUE,
            CALL_GROUP => CALLED,
            _ => group - DEEPER + 1,
        },
        _ if sign == Sign::Open as usize => match group + DEEPER {
            TOO_DEEP.. => ODD,
            deeper => deeper,
        },
        // cut the fast path, a `#` alone has its value after it
        _ if sign == Sign::PlusMinus as usize || sign == Sign::StarSlash as usize || sign == Sign::Equals as usize => {
            group
        }
        _ => group + 1,
    }
}

/// The longest number, including its sign, that certainly has no more digits than a decimal holds.
const SHORT_NUMBER: usize = 18;
/// Words longer than this may have more digits than a decimal holds, and are checked again.
const SHORT_WORD: usize = 19;

impl Sign {
    /// A word of this many bytes.
    #[inline]
    pub(crate) fn word(length: usize) -> Self {
        if length > SHORT_WORD {
            Self::LongWord
        } else {
            Self::Word
        }
    }

    /// A number of this many bytes.
    #[inline]
    pub(crate) fn number(length: usize) -> Self {
        if length < SHORT_NUMBER {
            Self::Number
        } else {
            Self::LongNumber
        }
    }
}

impl Course {
    /// After a token.
    #[inline]
    pub(crate) fn pass(&mut self, sign: Sign) {
        self.0 = NEXT[sign as usize][usize::from(self.0)];
    }

    /// After a name.
    #[inline]
    pub(crate) fn name(&mut self, text: &[u8]) {
        let sign = match self.0 {
            BETWEEN => first_name(text),
            EQUALS | EQUALS_SIGNED if is_function(text) => Sign::Function,
            _ => Sign::OtherName,
        };
        self.pass(sign);
    }

    /// After a token that the grammar must check.
    #[inline]
    pub(crate) fn odd(&mut self) {
        self.0 = ODD;
    }

    /// Ends the block: whether it certainly has no problem.
    #[inline]
    pub(crate) fn end(&mut self) -> bool {
        self.pass(Sign::Newline);
        let sound = self.0 == BETWEEN;
        *self = Self::default();
        sound
    }
}

/// The kind of a name between two items.
fn first_name(text: &[u8]) -> Sign {
    match (text.len(), text[0].to_ascii_lowercase()) {
        (2, b'i') | (4 | 5 | 8, b'w') | (5, b'u') | (5 | 6, b'e') if is_one_of(text, &CONDITIONS) => Sign::Condition,
        (2, b'd') | (3, b'e' | b'l') if is_one_of(text, &NUMBERED) => Sign::Numbered,
        (4, b'c') if text.eq_ignore_ascii_case(b"call") => Sign::Call,
        _ => Sign::OtherName,
    }
}

#[cfg(test)]
mod tests {
    use super::first_name;
    use crate::names::{CONDITIONS, NUMBERED};
    use crate::straight::Sign;

    #[test]
    fn names_are_told_apart_by_length_and_first_letter_without_loss() {
        for name in CONDITIONS {
            assert!(first_name(name.as_bytes()) == Sign::Condition, "{name}");
            assert!(first_name(name.to_lowercase().as_bytes()) == Sign::Condition, "{name}");
        }
        for name in NUMBERED {
            assert!(first_name(name.as_bytes()) == Sign::Numbered, "{name}");
        }
        assert!(first_name(b"Call") == Sign::Call && first_name(b"callsub") == Sign::OtherName);
    }
}
