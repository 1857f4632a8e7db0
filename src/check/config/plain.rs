//! What is wrong with a settings file, for people: the reader of TOML speaks of fields and types.
use crate::or_known;

/// Keys whose numbers are lengths.
const LENGTHS: [&str; 5] = ["tip", "diameter", "corner_radius", "length", "clearance"];

/// The message of the reader, with the key that it is about. `span`: the bytes of the text where it is.
pub(super) fn plain(text: &str, message: &str, span: Option<core::ops::Range<usize>>) -> String {
    if let Some(rest) = message.strip_prefix("unknown field `")
        && let Some((key, known)) = rest.split_once('`')
    {
        let known: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
        return format!("unknown key `{key}`{}", or_known(key, &known, "keys"));
    }
    let told = || {
        let (given, wanted) = message.strip_prefix("invalid type: ")?.split_once(", expected ")?;
        let start = span?.start;
        let line = text.get(..start)?.rsplit('\n').next()?;
        let key = line.split('=').next()?.trim();
        let is_key = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-');
        if key.is_empty() || !key.bytes().all(is_key) {
            return None;
        }
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
            _ => return None,
        };
        let inside = given.strip_prefix("string \"").and_then(|rest| rest.strip_suffix('"'));
        let meant = inside.filter(|inside| !number.is_empty() && inside.parse::<f64>().is_ok());
        let example = meant.map_or_else(String::new, |meant| format!(": `{key} = {meant}`"));
        Some(format!("`{key}` must be {what}{example}"))
    };
    told().unwrap_or_else(|| message.to_owned())
}

#[cfg(test)]
mod tests {
    #[test]
    fn what_is_wrong_is_said_with_its_key() {
        for (text, wanted) in [
            (
                "[tolerances]\ntip = \"0.02\"\n",
                "`tip` must be a number in mm: `tip = 0.02`",
            ),
            ("[tolerances]\ntip = \"small\"\n", "`tip` must be a number in mm"),
            ("machine = 3\n", "`machine` must be a text in quotes"),
            ("[limits]\nblocks = 0.5\n", "`blocks` must be a whole number"),
            ("[limits]\nblock = 5\n", "unknown key `block`; did you mean `blocks`?"),
            (
                "machin = \"mill-3axis\"\n",
                "unknown key `machin`; did you mean `machine`?",
            ),
        ] {
            let error = crate::config::Config::parse(text).expect_err(text);
            assert_eq!(error.message, wanted, "{text}");
        }
    }
}
