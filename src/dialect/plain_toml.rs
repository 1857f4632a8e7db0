//! What is wrong with a TOML file (settings, machine, dialect), for people: its reader speaks of fields, variants and types.
use crate::nearest::{did_you_mean, or_known};
use core::ops::Range;

/// Keys whose numbers are lengths.
const LENGTHS: [&str; 6] = ["tip", "diameter", "corner_radius", "length", "clearance", "nose_radius"];

/// The message of the reader of TOML, with the key that it is about. `span`: the bytes of the text where it is.
pub fn plain_toml(text: &str, message: &str, span: Option<Range<usize>>) -> String {
    if let Some(rest) = message.strip_prefix("unknown field `")
        && let Some((key, known)) = rest.split_once('`')
    {
        let known: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
        return format!("unknown key `{key}`{}", or_known(key, &known, "keys"));
    }
    if let Some((given, known)) = message
        .strip_prefix("unknown variant `")
        .and_then(|rest| rest.split_once("`, expected "))
    {
        let known: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
        let what = key(text, span).map_or_else(String::new, |key| format!(" of `{key}`"));
        return format!(
            "unknown value `{given}`{what}{}",
            did_you_mean(given, &known, &format!("; write {}", known.join(" or ")))
        );
    }
    let told = || {
        let (given, wanted) = message.strip_prefix("invalid type: ")?.split_once(", expected ")?;
        let key = key(text, span)?;
        let number = match wanted {
            "f64" if LENGTHS.contains(&key) => "a number in mm",
            "f64" => "a number",
            "i64" | "u32" | "u64" | "usize" => "a whole number",
            _ => "",
        };
        let what = match wanted {
            _ if !number.is_empty() => number,
            "a string" => "a text in quotes",
            "a sequence" => "a list in brackets",
            "a boolean" => "true or false",
            "a map" => "a table",
            _ if wanted.starts_with("an array of length 3") => "a list of three numbers, like [0, 0, 1]",
            _ if wanted.starts_with("an array of length 2") => "a list of two numbers, like [-100, 100]",
            _ => return None,
        };
        let inside = given.strip_prefix("string \"").and_then(|rest| rest.strip_suffix('"'));
        let meant = inside.filter(|inside| !number.is_empty() && inside.parse::<f64>().is_ok());
        let example = meant.map_or_else(String::new, |meant| format!(": `{key} = {meant}`"));
        Some(format!("`{key}` must be {what}{example}"))
    };
    told().unwrap_or_else(|| message.to_owned())
}

/// The key before a value.
fn key(text: &str, span: Option<Range<usize>>) -> Option<&str> {
    let before = text.get(..span?.start)?;
    let line = before.rsplit(['\n', '{', ',']).next()?;
    let key = line.split('=').next()?.trim();
    let is_key = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-');
    (!key.is_empty() && key.bytes().all(is_key)).then_some(key)
}
