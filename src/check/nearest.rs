//! The code that a misspelt one most resembles.
use trunnion_dialect::{CodeKind, Dialect, nearest};

/// The code with a name of its own that a text resembles: `TRAORY` is near TRAORI. Codes with numbers are never near each other: CYCLE81 and
/// CYCLE83 are different codes.
pub(crate) fn nearest_code(text: &str, dialect: &Dialect) -> Option<String> {
    let name = text.split(['(', ' ']).next().unwrap_or_default().to_ascii_uppercase();
    if name.len() < 4 || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
        return None;
    }
    let named = dialect.codes().iter().filter(|code| code.kind == CodeKind::Name);
    let near = nearest(&name, named.map(|code| code.id.as_str()))?;
    let number = |text: &str| text.trim_start_matches(|c: char| !c.is_ascii_digit()).to_owned();
    (number(near) == number(&name) && near != name)
        .then(|| near.to_owned() + text.get(name.len()..).unwrap_or_default())
}
