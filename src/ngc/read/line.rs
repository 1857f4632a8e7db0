//! The line reader: bytes of one line to words, assignments and comments, with all errors of the text.
use super::{comments, problems, recovery};
use crate::Error;
use trunnion_formula::{Cursor, Formula, FormulaError, Grammar, Pool, Target, target};
use trunnion_syntax::TextRange;

/// One word: a letter (or `@`, `^`, `$`) and its value.
#[derive(Clone, Debug)]
pub(crate) struct WordText {
    /// Upper case.
    pub(crate) letter: u8,
    pub(crate) value: Formula,
    /// From the letter to the end of the value.
    pub(crate) range: TextRange,
}

/// `#1=2`, `#<name>=3`.
#[derive(Clone, Debug)]
pub(crate) struct Assignment {
    pub(crate) target: Target,
    /// The left side with its `#`.
    pub(crate) target_range: TextRange,
    pub(crate) value: Formula,
}

/// The contents of the line, in the order in which the control reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Item {
    /// Index of a word.
    Word(u32),
    /// Index of an assignment.
    Assignment(u32),
    /// Index of an error of the text, found here.
    Error(u32),
}

/// A line in its parsed form.
#[derive(Clone, Debug, Default)]
pub(crate) struct Line {
    /// Its bytes without the line end.
    pub(crate) range: TextRange,
    /// The number after N.
    pub(crate) number: Option<f64>,
    /// It begins with `/`.
    pub(crate) delete: bool,
    pub(crate) items: Vec<Item>,
    pub(crate) words: Vec<WordText>,
    pub(crate) assignments: Vec<Assignment>,
    /// The last comment in parentheses, including the parentheses: the active one.
    pub(crate) comment: Option<TextRange>,
    /// The comment after `;`, including that character.
    pub(crate) remark: Option<TextRange>,
    /// All errors of the text. The control reports the first one, unless a value before it has none.
    pub(crate) errors: Vec<Error>,
    /// Storage for formulas.
    pub(crate) pool: Pool,
    /// The words seen so far, to find repeated ones: bit per letter, then `$`.
    seen: u32,
}

/// Bit of `$` in [`Line::seen`].
const SPINDLE: u32 = 1 << 26;

impl Line {
    /// Reads one line. `text` is the line without its end, and without what a NUL cuts off; a line that begins with an O word (after
    /// `/` and N) is handled elsewhere.
    pub(crate) fn read(source: &[u8], text: TextRange, into: &mut Self) {
        into.clear(text);
        if let Some(error) = comments::flaw(source, text) {
            into.fail(error);
        }
        let mut cursor = Cursor::new(source, text);
        into.delete = cursor.eat(b'/');
        if cursor.peek() == Some(b'n') {
            into.sequence_number(&mut cursor);
        }
        while let Some(byte) = cursor.peek() {
            into.item(byte, source, &mut cursor);
        }
    }

    /// Whether it is one assignment and nothing else, not even a comment.
    pub(crate) fn only_sets(&self) -> bool {
        let alone = matches!(self.items[..], [Item::Assignment(_)]);
        alone && self.errors.is_empty() && self.comment.is_none() && self.remark.is_none()
    }

    fn clear(&mut self, range: TextRange) {
        self.range = range;
        self.number = None;
        self.delete = false;
        self.items.clear();
        for word in self.words.drain(..) {
            self.pool.take_back(word.value);
        }
        for assignment in self.assignments.drain(..) {
            self.pool.take_back(assignment.value);
        }
        self.comment = None;
        self.remark = None;
        self.errors.clear();
        self.seen = 0;
    }

    fn fail(&mut self, error: Error) {
        self.items.push(Item::Error(self.errors.len() as u32));
        self.errors.push(error);
    }

    /// N: digits, or digits with one point between them. No value of a formula, no sign.
    fn sequence_number(&mut self, cursor: &mut Cursor<'_>) {
        let start = cursor.at();
        cursor.bump();
        let mut digits = [0u8; 32];
        let (mut length, mut points, mut last) = (0, 0, b'.');
        let mut first = true;
        while let Some(byte) = cursor.peek() {
            let point = byte == b'.';
            if !(byte.is_ascii_digit() || point && points == 0) || first && point {
                break;
            }
            first = false;
            points += usize::from(point);
            if length < digits.len() {
                digits[length] = byte;
                length += 1;
            }
            last = byte;
            cursor.bump();
        }
        let range = cursor.since(start);
        if last == b'.' {
            self.fail(Error::new(&problems::SEQUENCE_NUMBER, range));
            // what is there instead of digits is not read again
            while matches!(cursor.peek(), Some(b'+' | b'-' | b'.' | b'0'..=b'9')) {
                cursor.bump();
            }
            return;
        }
        self.number = core::str::from_utf8(&digits[..length])
            .ok()
            .and_then(|text| text.parse().ok());
    }

    #[inline]
    fn item(&mut self, byte: u8, source: &[u8], cursor: &mut Cursor<'_>) {
        match byte {
            b'n' | b'o' => self.stray(cursor),
            b'a'..=b'z' | b'@' | b'^' | b'$' => self.word(byte, source, cursor),
            b'#' => self.assignment(source, cursor),
            b'(' | b';' => {
                let start = cursor.at();
                let end = comments::end(source, start, self.range.end);
                let range = Some(TextRange::new(start, end));
                if byte == b'(' {
                    self.comment = range;
                } else {
                    self.remark = range;
                }
                cursor.skip_to(end);
            }
            _ => self.stray(cursor),
        }
    }

    /// A character that begins nothing. Multi-byte letters and the rest of a word are reported once.
    fn stray(&mut self, cursor: &mut Cursor<'_>) {
        let start = cursor.at();
        let Some(first) = cursor.bump() else {
            return;
        };
        if first >= 0x80 {
            while cursor.peek().is_some_and(|byte| (0x80..0xc0).contains(&byte)) {
                cursor.bump();
            }
        }
        let range = cursor.since(start);
        let problem = if first.is_ascii_alphabetic() {
            &problems::UNKNOWN_LETTER
        } else {
            &problems::BAD_CHARACTER
        };
        self.fail(Error::with(problem, range, bad_character(first)));
        // its own value is lost with it
        while cursor
            .peek()
            .is_some_and(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'+' | b'-' | b']' | b')'))
        {
            cursor.bump();
        }
    }

    fn word(&mut self, byte: u8, source: &[u8], cursor: &mut Cursor<'_>) {
        let start = cursor.at();
        cursor.bump();
        let (value, error) = self.pool.value_or_error(cursor, Grammar::Rs274);
        let letter = byte.to_ascii_uppercase();
        let range = cursor.since(start);
        if let Some(error) = self.repeated(letter, range) {
            self.fail(error);
        }
        if matches!(letter, b'P' | b'Q') && !value.number().is_some_and(|number| number > -1.0) {
            // the control takes a P or Q of -1 or less as absent; where it is not written as a number, the value decides
            self.seen &= !(1 << (letter - b'A'));
        }
        self.items.push(Item::Word(self.words.len() as u32));
        self.words.push(WordText { letter, value, range });
        self.recover(error, start, source, cursor);
    }

    /// A word that may occur once and occurs twice. G and M are checked by groups; of `@` and `^` the last one is used.
    #[inline]
    fn repeated(&mut self, letter: u8, range: TextRange) -> Option<Error> {
        let bit = match letter {
            b'G' | b'M' | b'@' | b'^' => return None,
            b'$' => SPINDLE,
            _ => 1 << (letter - b'A'),
        };
        let twice = self.seen & bit != 0;
        self.seen |= bit;
        if !twice {
            return None;
        }
        if letter == b'$' {
            return Some(Error::new(&problems::REPEATED_SPINDLE, range));
        }
        Some(twice_there(letter, range))
    }

    fn assignment(&mut self, source: &[u8], cursor: &mut Cursor<'_>) {
        let start = cursor.at();
        cursor.bump();
        let left = match target(cursor, Grammar::Rs274) {
            Ok(left) => left,
            Err(error) => {
                // an error of a name begins at its `#`
                let range = TextRange::new(error.range.start.min(cursor.at()), error.range.end);
                self.fail(problems::formula(&FormulaError { range, ..error }));
                return self.skip(start, source, cursor);
            }
        };
        let target_range = cursor.since(start);
        if !cursor.eat(b'=') {
            // the number is looked at first
            self.push_assignment(left, target_range, Formula::constant(0.0));
            self.fail(Error::new(&problems::EQUAL_SIGN, target_range));
            return self.skip(start, source, cursor);
        }
        let (value, error) = self.pool.value_or_error(cursor, Grammar::Rs274);
        self.push_assignment(left, target_range, value);
        self.recover(error, start, source, cursor);
    }

    fn push_assignment(&mut self, target: Target, target_range: TextRange, value: Formula) {
        self.items.push(Item::Assignment(self.assignments.len() as u32));
        self.assignments.push(Assignment {
            target,
            target_range,
            value,
        });
    }

    /// After a value: if it has an error, that is kept and reading continues where the next word may begin.
    #[inline]
    fn recover(&mut self, error: Option<FormulaError>, start: u32, source: &[u8], cursor: &mut Cursor<'_>) {
        if let Some(error) = error {
            // it is in its place already: the value fails when it is evaluated
            self.errors.push(problems::formula(&error));
            self.skip(start, source, cursor);
        }
    }

    /// Continues where the next word may begin. `start` is where the wrong value begins. Blanks do not matter.
    fn skip(&mut self, start: u32, source: &[u8], cursor: &mut Cursor<'_>) {
        cursor.skip_to(recovery::next_item(source, start, cursor.at(), self.range.end));
    }
}

/// A word that may occur once occurs a second time.
pub(super) fn twice_there(letter: u8, range: TextRange) -> Error {
    let lower = letter.to_ascii_lowercase();
    // as the control writes them
    let letter = char::from(if matches!(lower, b'u'..=b'w') {
        lower.to_ascii_uppercase()
    } else {
        lower
    });
    Error::with(
        &problems::REPEATED,
        range,
        format!("Multiple {letter} words on one line"),
    )
}

/// The letter of a word is an axis that the machine does not have.
pub(super) fn no_word(word: &WordText) -> Error {
    let range = TextRange::new(word.range.start, word.range.start + 1);
    Error::with(
        &problems::UNKNOWN_LETTER,
        range,
        bad_character(word.letter.to_ascii_lowercase()),
    )
}

/// The control's message about a character: as it is, or in octal.
fn bad_character(byte: u8) -> String {
    if (b'!'..=b'z').contains(&byte) {
        format!("Bad character '{}' used", char::from(byte))
    } else {
        format!("Bad character '\\{byte:03o}' used")
    }
}
