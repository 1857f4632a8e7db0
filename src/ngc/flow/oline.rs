//! O lines as text: label, keyword, condition or arguments; and the `M98` / `M99` that a line may begin with.
use super::label::{Label, label};
use super::problems;
use crate::Problem;
use trunnion_formula::{Cursor, Formula, FormulaError, Grammar, Name, Pool, ValueError, Variables};
use trunnion_syntax::TextRange;

/// The meaning of an O line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Keyword {
    /// Nothing: a program number, or the header of a Fanuc-style subprogram.
    #[default]
    Bare,
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
    /// `M98`.
    CallNumbered,
    /// `M99` inside a call.
    ReturnNumbered,
}

impl Keyword {
    /// Whether it takes part in definitions, calls and returns, whose labels belong to no subprogram.
    #[inline]
    pub(crate) fn is_global(self) -> bool {
        matches!(self, Self::Bare | Self::Sub | Self::EndSub | Self::Call | Self::Return)
    }
}

/// Longer words before their prefixes.
const KEYWORDS: [(&str, Keyword); 15] = [
    ("endrepeat", Keyword::EndRepeat),
    ("endwhile", Keyword::EndWhile),
    ("endsub", Keyword::EndSub),
    ("endif", Keyword::EndIf),
    ("elseif", Keyword::ElseIf),
    ("else", Keyword::Else),
    ("sub", Keyword::Sub),
    ("call", Keyword::Call),
    ("return", Keyword::Return),
    ("if", Keyword::If),
    ("while", Keyword::While),
    ("do", Keyword::Do),
    ("repeat", Keyword::Repeat),
    ("break", Keyword::Break),
    ("continue", Keyword::Continue),
];

/// An error of the line that does not depend on values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flaw {
    pub(crate) problem: &'static Problem,
    pub(crate) range: TextRange,
}

/// One O line. Errors of a value are inside its formula and appear when it is evaluated, as on the control.
#[derive(Clone, Debug, Default)]
pub(crate) struct OLine {
    pub(crate) keyword: Keyword,
    pub(crate) label: Label,
    /// `O` and what belongs to it.
    pub(crate) label_range: TextRange,
    pub(crate) keyword_range: TextRange,
    /// The condition, the count, the arguments or the value that is returned.
    pub(crate) values: Vec<Formula>,
    /// Where a condition should begin, or what makes the keyword unreadable: found before any value is evaluated.
    pub(crate) flaw: Option<Flaw>,
    /// What follows the end of the line's meaning.
    pub(crate) tail: Option<Flaw>,
    /// The text after `M98`.
    pub(crate) rest: TextRange,
    /// The errors in the text of its values.
    pub(crate) errors: Vec<FormulaError>,
}

/// Most arguments of a call: they become #1 to #30.
const ARGUMENTS: usize = 30;

/// Reads an O line; the cursor is before the O. The storage of `line` is reused.
pub(crate) fn read(cursor: &mut Cursor<'_>, pool: &mut Pool, line: &mut OLine) {
    let start = cursor.at();
    cursor.bump();
    line.values.drain(..).for_each(|value| pool.take_back(value));
    line.errors.clear();
    (line.flaw, line.tail) = (None, None);
    line.label = label(cursor, &mut line.errors, pool);
    line.label_range = cursor.since(start);
    (line.keyword, line.keyword_range) = (Keyword::Bare, line.label_range);
    line.rest = TextRange::new(cursor.at(), cursor.at());
    if ends(cursor) {
        line.tail = tail(cursor);
        return;
    }
    let Some((keyword, range)) = keyword(cursor) else {
        line.flaw = Some(Flaw {
            problem: &problems::UNKNOWN_KEYWORD,
            range: unknown(cursor),
        });
        return;
    };
    (line.keyword, line.keyword_range) = (keyword, range);
    values(cursor, line, pool);
}

/// Reads the `M98` or `M99` a line begins with, if it does; the cursor is before the M.
pub(crate) fn numbered(cursor: &mut Cursor<'_>, pool: &mut Pool) -> Option<OLine> {
    let start = cursor.at();
    let mut number = *cursor;
    number.bump();
    // the common M codes end here
    if !matches!(number.peek(), Some(b'9' | b'0' | b'[' | b'+')) {
        return None;
    }
    let formula = pool.value_or_error(&mut number, Grammar::Rs274).0;
    let code = formula.number().or_else(|| formula.eval(&NoVariables).ok())?;
    let keyword = match code {
        98.0 => Keyword::CallNumbered,
        99.0 => Keyword::ReturnNumbered,
        _ => return None,
    };
    // as on the control, any two characters are taken: `M098 P1` continues with `8P1`
    for _ in 0..3 {
        cursor.bump();
    }
    let range = cursor.since(start);
    let mut line = OLine {
        keyword,
        label: Label::Text(Name::new("")),
        label_range: range,
        keyword_range: range,
        values: Vec::new(),
        flaw: None,
        tail: None,
        rest: TextRange::new(cursor.at(), cursor.at()),
        errors: Vec::new(),
    };
    if keyword == Keyword::ReturnNumbered {
        line.tail = tail(cursor);
    } else {
        let mut rest = *cursor;
        while rest.bump().is_some() {}
        line.rest = rest.since(cursor.at());
    }
    Some(line)
}

/// An expression that decides whether a line is `M98` reads no values before the line runs.
struct NoVariables;

impl Variables for NoVariables {
    fn numbered(&self, _: i64) -> Result<f64, ValueError> {
        Err(ValueError::OutOfRange)
    }
    fn named(&self, _: &str) -> Result<f64, ValueError> {
        Err(ValueError::NotDefined)
    }
    fn exists(&self, _: &str) -> bool {
        false
    }
}

fn keyword(cursor: &mut Cursor<'_>) -> Option<(Keyword, TextRange)> {
    let start = cursor.at();
    if let Some((keyword, length)) = written(cursor.rest()) {
        cursor.skip_to(start + length as u32);
        return Some((keyword, cursor.since(start)));
    }
    KEYWORDS.iter().find_map(|(word, keyword)| {
        let mut ahead = *cursor;
        if !word.bytes().all(|byte| ahead.eat(byte)) {
            return None;
        }
        *cursor = ahead;
        Some((*keyword, cursor.since(start)))
    })
}

/// The keyword of a word without blanks, in any case.
fn keyword_of(word: &[u8]) -> Option<Keyword> {
    let mut lower = [0u8; 9];
    let letters = lower.get_mut(..word.len())?;
    letters.copy_from_slice(word);
    letters.make_ascii_lowercase();
    Some(match &*letters {
        b"sub" => Keyword::Sub,
        b"endsub" => Keyword::EndSub,
        b"call" => Keyword::Call,
        b"return" => Keyword::Return,
        b"if" => Keyword::If,
        b"elseif" => Keyword::ElseIf,
        b"else" => Keyword::Else,
        b"endif" => Keyword::EndIf,
        b"while" => Keyword::While,
        b"endwhile" => Keyword::EndWhile,
        b"do" => Keyword::Do,
        b"repeat" => Keyword::Repeat,
        b"endrepeat" => Keyword::EndRepeat,
        b"break" => Keyword::Break,
        b"continue" => Keyword::Continue,
        _ => return None,
    })
}

/// The keyword that a word without blanks is, after which no letter can follow that would make it longer, and its length.
pub(super) fn written(rest: &[u8]) -> Option<(Keyword, usize)> {
    let length = rest
        .iter()
        .position(|byte| !byte.is_ascii_alphabetic())
        .unwrap_or(rest.len());
    let keyword = keyword_of(&rest[..length])?;
    // `else if` is `elseif`
    if keyword == Keyword::Else && matches!(rest.get(length), Some(b' ' | b'\t' | b'\r')) {
        return None;
    }
    Some((keyword, length))
}

/// Letters that should have been a keyword.
fn unknown(cursor: &Cursor<'_>) -> TextRange {
    let mut ahead = *cursor;
    let start = ahead.at();
    while ahead.peek().is_some_and(|byte| byte.is_ascii_alphabetic()) {
        ahead.bump();
    }
    if ahead.at() == start {
        ahead.bump();
    }
    ahead.since(start)
}

fn values(cursor: &mut Cursor<'_>, line: &mut OLine, pool: &mut Pool) {
    let needed = match line.keyword {
        Keyword::If => Some(&problems::NO_CONDITION_IF),
        Keyword::ElseIf => Some(&problems::NO_CONDITION_ELSEIF),
        Keyword::While => Some(&problems::NO_CONDITION_WHILE),
        Keyword::Repeat => Some(&problems::NO_COUNT),
        _ => None,
    };
    if let Some(problem) = needed {
        if cursor.peek() == Some(b'[') {
            push(cursor, line, pool);
        } else {
            line.flaw = Some(Flaw {
                problem,
                range: cursor.here(),
            });
            return;
        }
    }
    match line.keyword {
        Keyword::EndSub | Keyword::Return if cursor.peek() == Some(b'[') => {
            push(cursor, line, pool);
        }
        Keyword::Call => arguments(cursor, line, pool),
        _ => {}
    }
    line.tail = line.tail.or_else(|| tail(cursor));
}

fn arguments(cursor: &mut Cursor<'_>, line: &mut OLine, pool: &mut Pool) {
    loop {
        if cursor.rest().first() != Some(&b'[') {
            skip_comments(cursor);
        }
        if cursor.rest().first() != Some(&b'[') {
            return;
        }
        let start = cursor.at();
        if line.values.len() == ARGUMENTS {
            cursor.bump();
            line.tail = Some(Flaw {
                problem: &problems::TOO_MANY_ARGUMENTS,
                range: cursor.since(start),
            });
            return;
        }
        push(cursor, line, pool);
    }
}

fn push(cursor: &mut Cursor<'_>, line: &mut OLine, pool: &mut Pool) {
    let (value, error) = pool.value_or_error(cursor, Grammar::Rs274);
    line.values.push(value);
    line.errors.extend(error);
}

/// Whether only comments, carriage returns and the line end are left.
fn ends(cursor: &Cursor<'_>) -> bool {
    matches!(cursor.peek(), None | Some(b'(' | b';' | b'\r' | b'\n' | 0))
}

#[inline]
fn skip_comments(cursor: &mut Cursor<'_>) {
    if matches!(cursor.peek(), Some(b'(' | b'\r' | b'\n')) {
        skip_some_comments(cursor);
    }
}

#[inline(never)]
fn skip_some_comments(cursor: &mut Cursor<'_>) {
    while let Some(byte) = cursor.peek() {
        match byte {
            b'(' => {
                let rest = cursor.rest();
                let length = memchr::memchr(b')', rest).map_or(rest.len(), |close| close + 1);
                cursor.skip_to(cursor.at() + length as u32);
            }
            b'\r' | b'\n' => {
                cursor.bump();
            }
            _ => return,
        }
    }
}

fn tail(cursor: &mut Cursor<'_>) -> Option<Flaw> {
    skip_comments(cursor);
    (!ends(cursor)).then(|| Flaw {
        problem: &problems::TAIL,
        range: cursor.here(),
    })
}
