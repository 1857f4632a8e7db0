//! Texts with values: `#1`, `#<name>`, and the number formats `%d`, `%f`, `%.3f` that apply to the rest of the comment.
use crate::Engine;
use std::io::Write as _;
use trunnion_formula::Variables;

/// Decimals before any format is given.
const DECIMALS: usize = 6;
/// Decimals of `%f`.
const SHORT: usize = 4;
/// The text that replaces a parameter that does not exist.
const MISSING: &[u8] = b"######";

/// The text with the values of its parameters.
pub(super) fn fill(text: &[u8], engine: &Engine) -> Vec<u8> {
    let values = engine.values();
    let mut out = Vec::with_capacity(text.len() + 16);
    let mut decimals = DECIMALS;
    let mut at = 0;
    while let Some(&byte) = text.get(at) {
        let rest = &text[at + 1..];
        match byte {
            b'#' => match parameter(rest) {
                Some((length, name)) => {
                    let value = match name {
                        Name::Text(name) => values.named(&name).ok(),
                        // a number that nothing else reads
                        Name::Number(Some(0)) => Some(0.0),
                        Name::Number(index) => index.and_then(|index| values.told(index)),
                    };
                    at += length;
                    put(value, decimals + engine.setup.more_decimals, &mut out);
                }
                // nothing, or a name without an end: the text ends here
                None if rest.is_empty() || rest[0] == b'<' => return out,
                None => out.push(b'#'),
            },
            b'%' => match format(rest) {
                Format::Decimals(length, count) => {
                    decimals = count;
                    at += length;
                }
                Format::Broken => {}
                Format::None => out.push(b'%'),
            },
            _ => out.push(byte),
        }
        at += 1;
    }
    out
}

enum Name {
    Text(String),
    /// `None`: too large a number.
    Number(Option<i64>),
}

/// The parameter after a `#`, and how long its text is.
fn parameter(rest: &[u8]) -> Option<(usize, Name)> {
    if rest.first() == Some(&b'<') {
        let end = rest.iter().position(|&byte| byte == b'>')?;
        let name = rest[1..end].iter().filter(|byte| !byte.is_ascii_whitespace());
        let name = name.map(|byte| char::from(byte.to_ascii_lowercase())).collect();
        return Some((end + 1, Name::Text(name)));
    }
    let length = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let digits = core::str::from_utf8(&rest[..length]).ok()?;
    (length > 0).then(|| (length, Name::Number(digits.parse().ok())))
}

enum Format {
    /// Length of its text, decimals from here on.
    Decimals(usize, usize),
    /// `%.` followed by f without a digit: only the sign vanishes.
    Broken,
    None,
}

fn format(rest: &[u8]) -> Format {
    match rest {
        [b'd', ..] => Format::Decimals(1, 0),
        [b'f', ..] => Format::Decimals(1, SHORT),
        [b'.', digit @ b'0'..=b'9', b'f', ..] => Format::Decimals(3, usize::from(digit - b'0')),
        [b'.', ..] => Format::Broken,
        _ => Format::None,
    }
}

/// Smaller values are printed as zero (observed from `rs274`).
const NOTHING: f64 = 1e-4;

fn put(value: Option<f64>, decimals: usize, out: &mut Vec<u8>) {
    let value = value.map(|value| if value.abs() < NOTHING { 0.0 } else { value });
    match value {
        Some(value) if value.is_nan() => out.push(b'?'),
        // writing to a vector does not fail
        Some(value) => drop(write!(out, "{value:.decimals$}")),
        None => out.extend_from_slice(MISSING),
    }
}
