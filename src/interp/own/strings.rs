//! Variables of the types STRING and CHAR, fields of them, and texts that `<<` joins (Sinumerik 840D sl Programming Manual, Job Planning,
//! string operations). The first character has the index 0.
use super::text_functions::is_of_text;
use super::{Own, Scope, arguments};
use std::collections::BTreeMap;

/// A longer field is not followed.
const MOST: usize = 1000;

/// Brackets inside brackets: a text with more of them is not followed.
const DEEPEST: i32 = 8;

/// A variable of DEF STRING[n] or DEF CHAR, or a field of them.
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// How many characters a text holds at most; `None`: not known.
    most: Option<usize>,
    /// The number of elements in each dimension; empty: it is no field.
    sizes: Vec<usize>,
    /// The texts, row by row; `None`: not known.
    texts: Vec<Option<Box<str>>>,
}

/// The variables of one program, by name in lower case.
pub(super) type Strings = BTreeMap<Box<str>, Held>;

/// A text that is read, or the place of its part that is not known.
pub(crate) type Joined = Result<String, (usize, usize)>;

pub(super) fn after_blanks(bytes: &[u8], at: usize) -> usize {
    let blank = |byte: &&u8| matches!(byte, b' ' | b'\t' | b'&');
    at + bytes[at..].iter().take_while(blank).count()
}

fn name_at(bytes: &[u8], at: usize) -> String {
    let of_name = |byte: &&u8| byte.is_ascii_alphanumeric() || **byte == b'_';
    let end = at + bytes[at..].iter().take_while(of_name).count();
    String::from_utf8_lossy(&bytes[at..end]).to_ascii_lowercase()
}

/// What the bracket at `open` holds, and the byte after the bracket that closes it; `None` where nothing closes it, or too many are inside.
pub(super) fn inside_of(bytes: &[u8], open: usize) -> Option<(String, usize)> {
    let (mut deep, mut quoted) = (0_i32, false);
    for (at, &byte) in bytes.iter().enumerate().skip(open) {
        match byte {
            b'"' => quoted = !quoted,
            b'(' | b'[' if !quoted && deep == DEEPEST => return None,
            b'(' | b'[' if !quoted => deep += 1,
            b')' | b']' if !quoted => {
                deep -= 1;
                if deep == 0 {
                    return Some((String::from_utf8_lossy(&bytes[open + 1..at]).into_owned(), at + 1));
                }
            }
            _ => {}
        }
    }
    None
}

/// The name in front of an index, in lower case, and the indices.
fn stem_and_indices(name: &str) -> (String, Vec<String>) {
    let (stem, index) = name.split_once('[').unwrap_or((name, ""));
    let index = index.trim_end().strip_suffix(']').unwrap_or(index);
    let indices = arguments(index).into_iter().filter(|index| !index.is_empty());
    (stem.trim().to_ascii_lowercase(), indices.map(str::to_owned).collect())
}

impl Held {
    fn forget(&mut self) {
        self.texts.fill(None);
    }
}

/// A part of a variable: the place of a text in its field, and of a character in the text.
struct Place {
    element: usize,
    character: Option<usize>,
}

impl Own {
    /// Which part of a variable the indices mean; `None`: not known, or it has no such part.
    fn part_of(&self, held: &Held, indices: &[String]) -> Option<Place> {
        let whole = |index: &String| {
            let value = self
                .value(index)
                .filter(|value| value.fract() == 0.0 && *value >= 0.0)?;
            Some(value as usize)
        };
        let indices: Vec<usize> = indices.iter().map(whole).collect::<Option<_>>()?;
        let of_field = held.sizes.len();
        if indices.len() < of_field || indices.len() > of_field + 1 {
            return None;
        }
        let mut element = 0;
        for (size, index) in held.sizes.iter().zip(&indices) {
            element = element * size + Some(*index).filter(|index| index < size)?;
        }
        Some(Place {
            element,
            character: indices.get(of_field).copied(),
        })
    }

    /// A text in quotation marks, a variable of the type STRING or CHAR, a part of one, or a function that gives a text, at `at`, and where
    /// it ends; `None`: there is none.
    fn text_operand(&self, bytes: &[u8], at: usize) -> Option<(Joined, usize)> {
        if bytes.get(at) == Some(&b'"') {
            let length = bytes[at + 1..].iter().position(|&byte| byte == b'"')?;
            let text = String::from_utf8_lossy(&bytes[at + 1..at + 1 + length]).into_owned();
            return Some((Ok(text), at + length + 2));
        }
        let name = name_at(bytes, at);
        let end = at + name.len();
        let open = after_blanks(bytes, end);
        if bytes.get(open) == Some(&b'(') {
            let (inside, end) = is_of_text(&name).then(|| inside_of(bytes, open)).flatten()?;
            return Some((self.text_function(&name, &inside).ok_or((at, end)), end));
        }
        let held = self.scope.strings.get(name.as_str())?;
        let (indices, end) = match bytes.get(open) {
            Some(b'[') => {
                let (inside, end) = inside_of(bytes, open)?;
                (arguments(&inside).into_iter().map(str::to_owned).collect(), end)
            }
            _ => (Vec::new(), end),
        };
        let text = (!self.is_fresh(&name)).then(|| self.text_of(held, &indices)).flatten();
        Some((text.ok_or((at, end)), end))
    }

    fn text_of(&self, held: &Held, indices: &[String]) -> Option<String> {
        let place = self.part_of(held, indices)?;
        let text = held.texts.get(place.element)?.as_deref()?;
        match place.character {
            None => Some(text.to_owned()),
            // what stands behind the end of a text is not documented
            Some(at) => text.is_ascii().then(|| text.get(at..=at).map(str::to_owned)).flatten(),
        }
    }

    /// The text that begins at `at`: texts and whole numbers that `<<` joins, and where it ends; `None`: no text begins there.
    pub(crate) fn joined(&self, bytes: &[u8], at: usize) -> Option<(Joined, usize)> {
        let from = after_blanks(bytes, at);
        // `<<R1` makes a text of a number
        let (mut text, mut end) = match bytes.get(from..from + 2) {
            Some(b"<<") => (Ok(String::new()), from),
            _ => self.text_operand(bytes, from)?,
        };
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

    /// The same where nothing follows it.
    pub(super) fn whole_text(&self, text: &str) -> Option<Joined> {
        let bytes = text.as_bytes();
        let (joined, end) = self.joined(bytes, 0)?;
        (after_blanks(bytes, end) == bytes.len()).then_some(joined)
    }

    /// A number as a text: how a fraction is written is not documented.
    fn number_operand(&self, bytes: &[u8], from: usize) -> (Joined, usize) {
        let mut deep = 0;
        let inside = |byte: &&u8| {
            deep += i32::from(matches!(byte, b'[' | b'(')) - i32::from(matches!(byte, b']' | b')'));
            (1..=DEEPEST).contains(&deep)
                || (deep == 0 && !(byte.is_ascii_whitespace() || matches!(byte, b'<' | b'=' | b'>')))
        };
        let end = from + bytes[from..].iter().take_while(inside).count();
        let text = (deep <= DEEPEST).then(|| String::from_utf8_lossy(&bytes[from..end]));
        let number = text
            .and_then(|text| self.value(&text))
            .filter(|value| value.fract() == 0.0 && value.abs() < 1e9);
        (number.map(|number| format!("{number:.0}")).ok_or((from, end)), end)
    }

    /// The number of elements in each dimension of a field of texts; empty: it is no field.
    pub(super) fn sizes_of_texts(&self, stem: &str) -> Option<&[usize]> {
        self.scope.strings.get(stem).map(|held| held.sizes.as_slice())
    }

    /// Whether the program declares a variable of the type STRING or CHAR.
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

    /// A variable of `DEF STRING[n]` or `DEF CHAR`, or a field of them, with what DEF gives it.
    pub(super) fn declare_string(&mut self, kind: &str, name: &str, text: Option<&str>) {
        let whole = |text: &str| {
            let value = self.value(text).filter(|value| value.fract() == 0.0)?;
            (1.0..=10_000.0).contains(&value).then_some(value as usize)
        };
        let length = kind.split_once('[').map(|(_, size)| size.trim_end());
        let most = match length {
            None => Some(1),
            Some(size) => size.strip_suffix(']').and_then(whole),
        };
        let (stem, sizes) = stem_and_indices(name);
        let sizes: Option<Vec<usize>> = sizes.iter().map(|size| whole(size)).collect();
        let Some(sizes) = sizes.filter(|sizes| sizes.len() <= 3 && sizes.iter().product::<usize>() <= MOST) else {
            return;
        };
        let texts = vec![Some("".into()); sizes.iter().product()];
        let is_field = !sizes.is_empty();
        let held = Held { most, sizes, texts };
        self.scope.strings.insert(stem.as_str().into(), held);
        if let (true, Some(text)) = (is_field, text) {
            self.fill_texts(&stem, text);
        } else if let Some(text) = text {
            let joined = self.text_for(&stem, text);
            self.put_text(&stem, joined);
        }
    }

    /// `SET("A","B")` and `REP("A")` from the first element on; anything else is not followed.
    fn fill_texts(&mut self, stem: &str, list: &str) {
        let filled = super::field::list(list).map(|(repeats, inside)| {
            let parts = arguments(inside).into_iter();
            let texts = parts.map(|part| (!part.is_empty(), self.whole_text(part).and_then(Result::ok)));
            (repeats, texts.collect::<Vec<_>>())
        });
        self.fresh.push(stem.into());
        let Some(held) = self.scope.strings.get_mut(stem) else {
            return;
        };
        let most = held.most;
        let fits = |text: Option<String>| text.filter(|text| most.is_some_and(|most| text.chars().count() <= most));
        match filled {
            Some((false, texts)) if texts.len() <= held.texts.len() => {
                for (element, (written, text)) in held.texts.iter_mut().zip(texts) {
                    if written {
                        *element = fits(text).map(Into::into);
                    }
                }
            }
            Some((true, texts)) if texts.len() == 1 => {
                let text = texts.into_iter().next().and_then(|(_, text)| fits(text));
                held.texts.fill(text.map(Into::into));
            }
            _ => held.forget(),
        }
    }

    /// `A[0]=SET("X","Y")` of a field of texts: fills it; false: it is another text.
    pub(super) fn assign_texts(&mut self, name: &str, text: &str) -> bool {
        let (stem, indices) = stem_and_indices(name);
        let is_list = super::field::list(text).is_some() && self.scope.strings.contains_key(stem.as_str());
        if is_list {
            self.changes += 1;
            let from_first = indices
                .iter()
                .all(|index| self.value(index).is_some_and(|value| value.to_bits() == 0));
            self.fill_texts(&stem, if from_first { text } else { "" });
        }
        is_list
    }

    /// What a variable of the type STRING or CHAR, or a part of one, holds when `text` is written to it; `None`: not known, or it is no
    /// such variable.
    pub(super) fn text_for(&self, name: &str, text: &str) -> Option<Box<str>> {
        let stem = stem_and_indices(name).0;
        let most = self.scope.strings.get(stem.as_str())?.most?;
        let joined = self.whole_text(text)?;
        // what the control does with a longer text is not documented
        joined.ok().filter(|text| text.chars().count() <= most).map(Into::into)
    }

    /// A variable of the type STRING or CHAR gets a text, or a part of it does.
    pub(super) fn put_text(&mut self, name: &str, text: Option<Box<str>>) {
        let (stem, indices) = stem_and_indices(name);
        let Some(held) = self.scope.strings.get(stem.as_str()) else {
            return;
        };
        let place = self.part_of(held, &indices);
        if !indices.is_empty() {
            self.fresh.push(stem.as_str().into());
        }
        let Some(held) = self.scope.strings.get_mut(stem.as_str()) else {
            return;
        };
        let Some(place) = place else {
            return held.forget();
        };
        let Some(element) = held.texts.get_mut(place.element) else {
            return held.forget();
        };
        *element = match place.character {
            None => text,
            Some(at) => {
                let known = element.take().filter(|old| old.is_ascii() && at < old.len());
                known.zip(text).and_then(|(old, new)| {
                    let one = new.len() == 1;
                    one.then(|| format!("{}{new}{}", &old[..at], &old[at + 1..]).into())
                })
            }
        };
    }

    /// A parameter of the type STRING or CHAR gets the text of an argument.
    pub(crate) fn hand_text(&mut self, kind: &str, name: &str, text: Option<&str>) {
        self.declare_string(kind, name, None);
        let most = self.scope.strings.get(name).and_then(|held| held.most);
        let fits = text.filter(|text| most.is_some_and(|most| text.chars().count() <= most));
        self.put_text(name, fits.map(Into::into));
    }

    /// The text that an argument of a call hands over.
    pub(crate) fn text_argument(&self, text: &str) -> Option<Box<str>> {
        self.whole_text(text)?.ok().map(Into::into)
    }

    /// A text that was a parameter with VAR goes back to the caller; false: it was none.
    pub(crate) fn copy_text_back(&mut self, used: &Scope, here: &str, there: &str) -> bool {
        let Some(from) = used.strings.get(here) else {
            return false;
        };
        let text = from.texts.first().cloned().flatten();
        let most = self.scope.strings.get(there).and_then(|held| held.most);
        let text = text.filter(|text| most.is_some_and(|most| text.chars().count() <= most));
        self.assign(there, None);
        self.put_text(there, text);
        true
    }

    /// What a variable of the type STRING or CHAR holds is not known any more.
    pub(super) fn forget_text(&mut self, name: &str) {
        if let Some(held) = self.scope.strings.get_mut(name) {
            held.forget();
        }
    }

    pub(super) fn lose_texts(&mut self) {
        self.scope.strings.values_mut().for_each(Held::forget);
    }

    /// How many texts a clone copies.
    pub(super) fn texts_held(&self) -> usize {
        self.scope.strings.values().map(|held| held.texts.len()).sum()
    }
}
