//! Functions of texts (Sinumerik 840D sl Programming Manual, Job Planning, string operations). The first character has the index 0. What the
//! manual leaves open stays unknown: the answer where nothing is found, a part behind the end, letters that differ in size alone, and
//! the format of a fraction.
use super::{Own, arguments};
use std::fmt::Write as _;

/// Whether a function gives a text. `name` in lower case.
pub(super) fn is_of_text(name: &str) -> bool {
    matches!(name, "substr" | "toupper" | "tolower" | "sprint")
}

/// Whether a function gives a number, of a text.
pub(super) fn is_of_number(name: &str) -> bool {
    matches!(
        name,
        "strlen" | "index" | "rindex" | "mindex" | "match" | "number" | "isnumber"
    )
}

/// `12`, `-0.5`, `+3.`: how a control reads any other text is not documented here.
fn plain_number(text: &str) -> Option<f64> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let plain = digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let has_digit = digits.bytes().any(|byte| byte.is_ascii_digit());
    (plain && has_digit && digits.matches('.').count() <= 1).then(|| text.parse().ok())?
}

/// Where a search finds something first; `None`: nowhere, or elsewhere if letters of another size count as the same.
fn searched(name: &str, text: &str, wanted: &str) -> Option<f64> {
    let place = |text: &str, wanted: &str| match name {
        "rindex" => text.rfind(wanted),
        "mindex" => text.find(|one| wanted.contains(one)),
        _ => text.find(wanted),
    };
    let exact = place(text, wanted)?;
    let any_size = place(&text.to_ascii_uppercase(), &wanted.to_ascii_uppercase());
    (any_size == Some(exact)).then_some(exact as f64)
}

impl Own {
    fn known_text(&self, text: &str) -> Option<String> {
        self.whole_text(text)?.ok().filter(|text| text.is_ascii())
    }

    fn known_place(&self, text: &str) -> Option<usize> {
        let value = self.value(text)?;
        (value.fract() == 0.0 && (0.0..1e4).contains(&value)).then_some(value as usize)
    }

    /// The text that a function gives; `None`: not known.
    pub(super) fn text_function(&self, name: &str, inside: &str) -> Option<String> {
        let given = arguments(inside);
        match (name, &given[..]) {
            ("toupper", [text]) => Some(self.known_text(text)?.to_ascii_uppercase()),
            ("tolower", [text]) => Some(self.known_text(text)?.to_ascii_lowercase()),
            ("substr", [text, from]) => {
                let (text, from) = (self.known_text(text)?, self.known_place(from)?);
                Some(text.get(from..).filter(|part| !part.is_empty())?.to_owned())
            }
            ("substr", [text, from, count]) => {
                let (text, from) = (self.known_text(text)?, self.known_place(from)?);
                Some(text.get(from..from + self.known_place(count)?)?.to_owned())
            }
            ("sprint", [format, given @ ..]) => self.printed(&self.known_text(format)?, given),
            _ => None,
        }
    }

    /// SPRINT with `%S`, `%.3S`, `%10.5S` for texts, `%D` and `%X` for whole numbers.
    fn printed(&self, format: &str, given: &[&str]) -> Option<String> {
        let mut given = given.iter();
        let mut parts = format.split('%');
        let mut out = parts.next()?.to_owned();
        for part in parts {
            let letter = part.find(|one: char| one.is_ascii_alphabetic())?;
            let (sizes, one) = (&part[..letter], given.next()?);
            let whole = || {
                self.value(one)
                    .filter(|value| value.fract() == 0.0 && value.abs() < 2e9)
            };
            match (part.as_bytes()[letter].to_ascii_uppercase(), sizes) {
                (b'S', sizes) => {
                    let text = self.known_text(one)?;
                    let (width, most) = sizes.split_once('.').unwrap_or((sizes, ""));
                    let size = |text: &str, none: usize| if text.is_empty() { Some(none) } else { text.parse().ok() };
                    let (width, most) = (size(width, 0)?, size(most, usize::MAX)?);
                    if width > 1000 {
                        return None;
                    }
                    let _ = write!(out, "{:>width$}", &text[..text.len().min(most)]);
                }
                (b'D', "") => drop(write!(out, "{:.0}", whole()?)),
                (b'X', "") => drop(write!(out, "{:X}", whole().filter(|value| *value >= 0.0)? as u64)),
                _ => return None,
            }
            out += &part[letter + 1..];
        }
        given.next().is_none().then_some(out)
    }

    /// The number that a function of a text gives; `None`: not known.
    pub(super) fn number_of_text(&self, name: &str, inside: &str) -> Option<f64> {
        let given = arguments(inside);
        match (name, &given[..]) {
            ("strlen", [text]) => Some(self.known_text(text)?.len() as f64),
            ("number", [text]) => plain_number(&self.known_text(text)?),
            ("isnumber", [text]) => plain_number(&self.known_text(text)?).map(|_| 1.0),
            ("index" | "rindex", [text, one]) => {
                let one = self.known_text(one).filter(|one| one.len() == 1)?;
                searched(name, &self.known_text(text)?, &one)
            }
            ("mindex" | "match", [text, wanted]) => {
                let wanted = self.known_text(wanted).filter(|wanted| !wanted.is_empty())?;
                searched(name, &self.known_text(text)?, &wanted)
            }
            _ => None,
        }
    }
}
