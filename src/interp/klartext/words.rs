//! The words of a block: a name with its value, as `X+10,5`, `IX-Q5`, `FMAX`, `DR-`, `FQ50`, `"text"`.
use trunnion_syntax::Decimal;

/// Letters of the longest name that is distinguished.
const LONGEST: usize = 12;
/// Bytes of the longest number with a comma.
const LONGEST_NUMBER: usize = 40;

/// A Q parameter by its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// Q.
    Global,
    /// QL: of the program that runs.
    Local,
    /// QR: kept when the control is off.
    Kept,
    /// QS.
    Text,
}

/// A Q parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Parameter {
    pub(crate) kind: Kind,
    pub(crate) number: u32,
}

impl core::fmt::Display for Parameter {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let letters = match self.kind {
            Kind::Global => "Q",
            Kind::Local => "QL",
            Kind::Kept => "QR",
            Kind::Text => "QS",
        };
        write!(f, "{letters}{}", self.number)
    }
}

/// The value of a word as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Said<'t> {
    Nothing,
    Number(f64),
    /// With its sign.
    Parameter(bool, Parameter),
    /// A sign alone: whether it is a minus.
    Sign(bool),
    Text(&'t [u8]),
    /// Not a number.
    Bad,
}

/// One word.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Word<'t> {
    name: [u8; LONGEST],
    length: usize,
    pub(crate) value: Said<'t>,
    /// Bytes in the text of the block.
    pub(crate) start: usize,
    pub(crate) end: usize,
}

impl Word<'_> {
    /// What [`Words::read`] fills.
    pub(crate) const NONE: Self = Self {
        name: [0; LONGEST],
        length: 0,
        value: Said::Nothing,
        start: 0,
        end: 0,
    };
    /// Upper case; of a longer name its beginning.
    pub(crate) fn name(&self) -> &[u8] {
        &self.name[..self.length]
    }
    pub(crate) fn is(&self, name: &str) -> bool {
        self.name() == name.as_bytes()
    }
}

/// A word of a Klartext block, for readers that need to know what a block contains.
#[derive(Clone, Debug, PartialEq)]
pub struct SentenceWord {
    /// Upper case; empty for a number or parameter alone.
    pub name: String,
    /// Its value, where that is a number, in the program's unit.
    pub number: Option<f64>,
    /// It has a value: a number, a parameter, a sign or a text.
    pub has_value: bool,
}

/// The words of a Klartext block (`Sentence::text`).
pub fn sentence_words(text: &[u8]) -> impl Iterator<Item = SentenceWord> + '_ {
    Words::new(text).map(|word| SentenceWord {
        name: String::from_utf8_lossy(word.name()).into_owned(),
        number: match word.value {
            Said::Number(value) => Some(value),
            _ => None,
        },
        has_value: word.value != Said::Nothing,
    })
}

/// A number that is written with a comma.
fn with_point(written: &[u8]) -> Option<f64> {
    let mut buffer = [0u8; LONGEST_NUMBER];
    let number = buffer.get_mut(..written.len())?;
    for (to, from) in number.iter_mut().zip(written) {
        *to = if *from == b',' { b'.' } else { *from };
    }
    Decimal::parse_f64(number)
}

/// The words of a text, in order.
#[derive(Clone)]
pub(crate) struct Words<'t> {
    pub(crate) text: &'t [u8],
    pub(crate) at: usize,
}

impl<'t> Words<'t> {
    pub(crate) fn new(text: &'t [u8]) -> Self {
        Self { text, at: 0 }
    }
    pub(crate) fn blanks(&mut self) {
        while self.text.get(self.at).is_some_and(|byte| *byte <= b' ') {
            self.at += 1;
        }
    }
    pub(crate) fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }
    /// What is not read yet.
    pub(crate) fn rest(&self) -> &'t [u8] {
        self.text.get(self.at..).unwrap_or_default()
    }
    /// All that follows the name of a word, its value among it.
    pub(crate) fn after_name(&self, word: &Word<'t>) -> &'t [u8] {
        self.text.get(word.start + word.length..).unwrap_or_default()
    }
    /// Takes a byte after blanks, if it is there.
    pub(crate) fn takes(&mut self, byte: u8) -> bool {
        let mut ahead = self.clone();
        ahead.blanks();
        if ahead.peek() == Some(byte) {
            self.at = ahead.at + 1;
            return true;
        }
        false
    }
    /// Takes a word with this name, if it is the next one.
    pub(crate) fn takes_word(&mut self, name: &str) -> bool {
        let mut ahead = self.clone();
        if ahead
            .next()
            .is_some_and(|word| word.is(name) && word.value == Said::Nothing)
        {
            *self = ahead;
            return true;
        }
        false
    }

    /// An unsigned or signed number or parameter at this very place.
    #[inline]
    pub(crate) fn value(&mut self) -> Said<'t> {
        let start = self.at;
        let sign = match self.peek() {
            Some(b'-') => Some(true),
            Some(b'+') => Some(false),
            _ => None,
        };
        self.at += usize::from(sign.is_some());
        match self.peek() {
            Some(b'0'..=b'9' | b'.' | b',') => self.number(start),
            Some(b'Q' | b'q') => match self.parameter() {
                Some(found) => Said::Parameter(sign == Some(true), found),
                None => sign.map_or(Said::Nothing, Said::Sign),
            },
            _ => sign.map_or(Said::Nothing, Said::Sign),
        }
    }

    /// A number at `start`, where a sign may be, and digits are at this place.
    fn number(&mut self, start: usize) -> Said<'t> {
        let mut point = None;
        let mut end = self.at;
        while let Some(&byte @ (b'0'..=b'9' | b'.' | b',')) = self.text.get(end) {
            end += 1;
            if !byte.is_ascii_digit() && point.replace(byte).is_some() {
                // a second point, or a comma that separates
                let digits = self.text[end..].iter().take_while(|byte| byte.is_ascii_digit());
                self.at = end + digits.count();
                return Said::Bad;
            }
        }
        self.at = end;
        let written = &self.text[start..end];
        let number = if point == Some(b',') {
            with_point(written)
        } else {
            Decimal::parse_f64(written)
        };
        number.map_or(Said::Bad, Said::Number)
    }

    /// `Q5`, `QL5`, `QR5`, `QS5` at this very place.
    pub(crate) fn parameter(&mut self) -> Option<Parameter> {
        let rest = self.rest();
        if !rest.first()?.eq_ignore_ascii_case(&b'Q') {
            return None;
        }
        let kind = match rest.get(1)?.to_ascii_uppercase() {
            b'L' => Kind::Local,
            b'R' => Kind::Kept,
            b'S' => Kind::Text,
            _ => Kind::Global,
        };
        let letters = if kind == Kind::Global { 1 } else { 2 };
        let digits = rest[letters..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        if digits == 0 || digits > 6 {
            return None;
        }
        let number = rest[letters..letters + digits]
            .iter()
            .fold(0, |all, digit| all * 10 + u32::from(digit - b'0'));
        self.at += letters + digits;
        Some(Parameter { kind, number })
    }
}

impl<'t> Iterator for Words<'t> {
    type Item = Word<'t>;

    fn next(&mut self) -> Option<Word<'t>> {
        let mut word = Word::NONE;
        self.read(&mut word).then_some(word)
    }
}

impl<'t> Words<'t> {
    /// Reads the next word in place, which a loop over words is quicker with; `false` where there is none.
    pub(crate) fn read(&mut self, word: &mut Word<'t>) -> bool {
        self.blanks();
        let start = self.at;
        word.length = 0;
        word.value = Said::Nothing;
        word.start = start;
        let Some(first) = self.peek() else { return false };
        match first {
            b'"' => {
                let rest = &self.text[start + 1..];
                let length = rest.iter().position(|byte| *byte == b'"').unwrap_or(rest.len());
                word.value = Said::Text(&rest[..length]);
                self.at = (start + length + 2).min(self.text.len());
            }
            b'0'..=b'9' | b'+' | b'-' | b'.' | b',' => {
                word.value = self.value();
                self.at = self.at.max(start + 1);
            }
            byte if byte.is_ascii_alphabetic() || byte == b'_' || byte >= 0x80 => self.named(word),
            byte => {
                word.name[0] = byte;
                word.length = 1;
                self.at += 1;
            }
        }
        word.end = self.at;
        true
    }

    #[inline]
    fn named(&mut self, word: &mut Word<'t>) {
        let whole = self.at;
        if let Some(found) = self.parameter() {
            word.value = Said::Parameter(false, found);
            return;
        }
        let mut at = whole;
        while let Some(&byte @ (b'A'..=b'Z' | b'a'..=b'z' | b'_' | 0x80..)) = self.text.get(at) {
            // `FQ50`, `XQL3`: the value begins
            if matches!(byte, b'Q' | b'q') && word.length > 0 {
                self.at = at;
                if self.parameter().is_some() {
                    at = whole + word.length;
                    break;
                }
            }
            if let Some(place) = word.name.get_mut(word.length) {
                *place = byte.to_ascii_uppercase();
                word.length += 1;
            }
            at += 1;
        }
        self.at = at;
        // `DR2+0,1`, `DR2:+0,1`
        let sign = self.text.get(self.at + 1);
        if word.name() == b"DR" && self.peek() == Some(b'2') && matches!(sign, Some(b'+' | b'-' | b':')) {
            word.name[2] = b'2';
            word.length = 3;
            self.at += 1;
        }
        let corrects = matches!(word.name(), b"DL" | b"DR" | b"DR2");
        if corrects && self.peek() == Some(b':') && self.value_after_colon(word) {
            return;
        }
        let mut ahead = self.clone();
        ahead.blanks();
        let gap = ahead.at > self.at;
        let value = ahead.value();
        // behind a blank a sign alone is no value, and neither is a parameter that is assigned: `DRILLING Q200=2`
        let assigned = matches!(value, Said::Parameter(..)) && ahead.clone().takes(b'=');
        if value != Said::Nothing && !(gap && (assigned || matches!(value, Said::Sign(_)))) {
            word.value = value;
            *self = ahead;
        }
    }

    /// `DR2:+0,5`: a colon between a correction of the tool and its value.
    fn value_after_colon(&mut self, word: &mut Word<'t>) -> bool {
        let mut ahead = self.clone();
        ahead.at += 1;
        ahead.blanks();
        let value = ahead.value();
        let is_value = !matches!(value, Said::Nothing | Said::Sign(_));
        if is_value {
            word.value = value;
            *self = ahead;
        }
        is_value
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, Parameter, Said, Words};

    fn words(text: &str) -> Vec<(String, Said<'_>)> {
        let found = Words::new(text.as_bytes());
        found
            .map(|word| (String::from_utf8_lossy(word.name()).into_owned(), word.value))
            .collect()
    }

    #[test]
    fn words_of_real_blocks() {
        let q = |number| {
            Said::Parameter(
                false,
                Parameter {
                    kind: Kind::Global,
                    number,
                },
            )
        };
        assert_eq!(
            words("L  X+27,975  IY-Q108 Z 25.183 RL FQ50 M3"),
            [
                ("L".into(), Said::Nothing),
                ("X".into(), Said::Number(27.975)),
                (
                    "IY".into(),
                    Said::Parameter(
                        true,
                        Parameter {
                            kind: Kind::Global,
                            number: 108
                        }
                    )
                ),
                ("Z".into(), Said::Number(25.183)),
                ("RL".into(), Said::Nothing),
                ("F".into(), q(50)),
                ("M".into(), Said::Number(3.0)),
            ]
        );
        assert_eq!(words("CR X-32 R284,796 DR-")[3], ("DR".into(), Said::Sign(true)));
        assert_eq!(words("C DR+ F889")[1], ("DR".into(), Said::Sign(false)));
        assert_eq!(words("TOOL CALL \"MH10\" Z DL+0 DR2-0,1")[2].1, Said::Text(b"MH10"));
        assert_eq!(words("DR2-0,1")[0], ("DR2".into(), Said::Number(-0.1)));
        assert_eq!(words("DR2:-0,1 DL:Q5 DR:+1").len(), 3);
        assert_eq!(words("DR2:-0,1")[0], ("DR2".into(), Said::Number(-0.1)));
        assert_eq!(words("DL:Q108 Z")[0], ("DL".into(), q(108)));
        // a colon that parts no value is a word of its own, as in a path
        assert_eq!(words("TNC:\\P")[1].0, ":");
        assert_eq!(words("X1.2.3")[0].1, Said::Bad);
        assert_eq!(
            words("F AUTO"),
            [("F".into(), Said::Nothing), ("AUTO".into(), Said::Nothing)]
        );
    }
}
