//! Variables of the type STRING that are declared one by one, and texts that `<<` joins (Sinumerik 840D sl Programming Manual, Job Planning,
//! string operations). Fields of strings, single characters and functions of strings are not followed.
use super::Own;
use std::collections::BTreeMap;

/// A variable of DEF STRING[n].
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// How many characters it holds at most; `None`: not known.
    most: Option<usize>,
    /// `None`: not known.
    text: Option<Box<str>>,
}

/// The variables of one program, by name in lower case.
pub(super) type Strings = BTreeMap<Box<str>, Held>;

/// A text that is read, or the place of its part that is not known.
pub(crate) type Joined = Result<String, (usize, usize)>;

fn after_blanks(bytes: &[u8], at: usize) -> usize {
    let blank = |byte: &&u8| matches!(byte, b' ' | b'\t' | b'&');
    at + bytes[at..].iter().take_while(blank).count()
}

fn name_at(bytes: &[u8], at: usize) -> String {
    let of_name = |byte: &&u8| byte.is_ascii_alphanumeric() || **byte == b'_';
    let end = at + bytes[at..].iter().take_while(of_name).count();
    String::from_utf8_lossy(&bytes[at..end]).to_ascii_lowercase()
}

impl Own {
    /// A text in quotation marks or a variable of the type STRING at `at`, and where it ends; `None`: there is neither.
    fn text_operand(&self, bytes: &[u8], at: usize) -> Option<(Joined, usize)> {
        if bytes.get(at) == Some(&b'"') {
            let length = bytes[at + 1..].iter().position(|&byte| byte == b'"')?;
            let text = String::from_utf8_lossy(&bytes[at + 1..at + 1 + length]).into_owned();
            return Some((Ok(text), at + length + 2));
        }
        let name = name_at(bytes, at);
        let end = at + name.len();
        if matches!(bytes.get(after_blanks(bytes, end)), Some(b'[' | b'(')) {
            return None;
        }
        let held = self.scope.strings.get(name.as_str())?;
        let text = held.text.as_deref().filter(|_| !self.is_fresh(&name));
        Some((text.map(str::to_owned).ok_or((at, end)), end))
    }

    /// The text that begins at `at`: texts and whole numbers that `<<` joins, and where it ends; `None`: no text begins there.
    pub(crate) fn joined(&self, bytes: &[u8], at: usize) -> Option<(Joined, usize)> {
        let (mut text, mut end) = self.text_operand(bytes, after_blanks(bytes, at))?;
        loop {
            let sign = after_blanks(bytes, end);
            if !bytes[sign..].starts_with(b"<<") {
                return Some((text, end));
            }
            let from = after_blanks(bytes, sign + 2);
            let (part, after) = self
                .text_operand(bytes, from)
                .unwrap_or_else(|| self.number_operand(bytes, from));
            end = after;
            text = text.and_then(|text| part.map(|part| text + &part));
        }
    }

    /// A number as a text: how a fraction is written is not documented.
    fn number_operand(&self, bytes: &[u8], from: usize) -> (Joined, usize) {
        let mut deep = 0;
        let inside = |byte: &&u8| {
            deep += i32::from(matches!(byte, b'[' | b'(')) - i32::from(matches!(byte, b']' | b')'));
            deep > 0 || (deep == 0 && !(byte.is_ascii_whitespace() || matches!(byte, b'<' | b'=' | b'>')))
        };
        let end = from + bytes[from..].iter().take_while(inside).count();
        let number = self
            .value(&String::from_utf8_lossy(&bytes[from..end]))
            .filter(|value| value.fract() == 0.0 && value.abs() < 1e9);
        (number.map(|number| format!("{number:.0}")).ok_or((from, end)), end)
    }

    /// Whether the program declares a variable of the type STRING.
    pub(super) fn has_strings(&self) -> bool {
        !self.scope.strings.is_empty()
    }

    /// `NAME == "A1"`, `NAME <> OTHER` as a whole condition or all of a bracket: where it ends, and whether it holds. Texts that differ in
    /// capital letters or in blanks at their ends alone have no outcome that is documented.
    pub(super) fn compared(&self, bytes: &[u8], at: usize) -> Option<(usize, Option<bool>)> {
        let (first, end) = self.joined(bytes, at)?;
        let sign = after_blanks(bytes, end);
        let equal = match bytes.get(sign..sign + 2)? {
            b"==" => true,
            b"<>" => false,
            _ => return None,
        };
        let (second, end) = self.joined(bytes, sign + 2)?;
        let next = bytes.get(after_blanks(bytes, end));
        let word = name_at(bytes, after_blanks(bytes, end)).to_ascii_uppercase();
        let binds_stronger = matches!(
            word.as_str(),
            "AND" | "OR" | "XOR" | "DIV" | "MOD" | "B_AND" | "B_OR" | "B_XOR"
        );
        if binds_stronger || matches!(next, Some(b'+' | b'-' | b'*' | b'/' | b'=' | b'<' | b'>')) {
            return None;
        }
        let holds = match (first, second) {
            (Ok(first), Ok(second)) if first == second => Some(equal),
            (Ok(first), Ok(second)) if !first.trim_end().eq_ignore_ascii_case(second.trim_end()) => Some(!equal),
            _ => None,
        };
        Some((end, holds))
    }

    /// A variable of `DEF STRING[n]`, with the text that DEF gives it.
    pub(super) fn declare_string(&mut self, kind: &str, name: &str, text: Option<&str>) {
        let size = kind
            .split_once('[')
            .and_then(|(_, size)| size.trim_end().strip_suffix(']'));
        let size = size.and_then(|size| self.value(size));
        let most = size.filter(|size| size.fract() == 0.0 && (1.0..=10_000.0).contains(size));
        let held = Held {
            most: most.map(|most| most as usize),
            text: Some("".into()),
        };
        let name = name.trim().to_ascii_lowercase();
        self.scope.strings.insert(name.as_str().into(), held);
        if let Some(text) = text {
            let joined = self.text_for(&name, text);
            self.put_text(&name, joined);
        }
    }

    /// What a variable of the type STRING holds when `text` is written to it; `None`: not known, or it is no such variable.
    pub(super) fn text_for(&self, name: &str, text: &str) -> Option<Box<str>> {
        let most = self
            .scope
            .strings
            .get(name.trim().to_ascii_lowercase().as_str())?
            .most?;
        let bytes = text.as_bytes();
        let (joined, end) = self.joined(bytes, 0)?;
        let whole = after_blanks(bytes, end) == bytes.len();
        // what the control does with a longer text is not documented
        joined
            .ok()
            .filter(|text| whole && text.chars().count() <= most)
            .map(Into::into)
    }

    /// A variable of the type STRING gets a text.
    pub(super) fn put_text(&mut self, name: &str, text: Option<Box<str>>) {
        if let Some(held) = self.scope.strings.get_mut(name.trim().to_ascii_lowercase().as_str()) {
            held.text = text;
        }
    }

    /// What a variable of the type STRING holds is not known any more.
    pub(super) fn forget_text(&mut self, name: &str) {
        if let Some(held) = self.scope.strings.get_mut(name) {
            held.text = None;
        }
    }

    pub(super) fn lose_texts(&mut self) {
        self.scope.strings.values_mut().for_each(|held| held.text = None);
    }
}
