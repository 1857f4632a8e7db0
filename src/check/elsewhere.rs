//! Codes that the dialect of a program does not have and that other controls have.
use trunnion_dialect::{BUILTIN_NAMES, builtin};

/// The built-in dialects that have a G or M code, by its text: `G52`, `G28.1`.
pub(crate) fn dialects_with(code: &str) -> Vec<&'static str> {
    let Some((letter, tenths)) = tenths(code) else {
        return Vec::new();
    };
    let has = |name: &&&str| {
        builtin(name).is_some_and(|dialect| match letter {
            b'G' => dialect.g(tenths).is_some(),
            _ => dialect.m(tenths).is_some(),
        })
    };
    BUILTIN_NAMES.iter().filter(has).copied().collect()
}

/// The letter and ten times the number of a code.
fn tenths(code: &str) -> Option<(u8, u32)> {
    let letter = code.bytes().next()?.to_ascii_uppercase();
    let number = code.get(1..).filter(|_| matches!(letter, b'G' | b'M'))?;
    let (whole, part) = number.split_once('.').unwrap_or((number, "0"));
    let digit = part.parse::<u32>().ok().filter(|_| part.len() == 1)?;
    Some((letter, whole.parse::<u32>().ok()?.checked_mul(10)? + digit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_of_other_controls() {
        assert!(dialects_with("G52").contains(&"fanuc-30i"));
        assert!(dialects_with("g28.1").contains(&"grbl"));
        for none in ["G77.7", "G28.15", "G", "X52", "", "G\u{e4}", "G99999999999"] {
            assert!(dialects_with(none).is_empty(), "{none}");
        }
    }
}
