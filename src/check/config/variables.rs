//! `[variables]` of `trunnion.toml`: what numbered variables hold before a program runs.
use super::ConfigError;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// A number, or the word `vacant`.
#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum FileValue {
    Number(f64),
    Text(String),
}

/// The section as written: `"#500" = 12.5`, `501 = "vacant"`.
pub(super) type FileVariables = BTreeMap<Spanned<String>, Spanned<FileValue>>;

/// The largest number of a variable (Fanuc Series 30i operator's manual, custom macro: system variables of five and six digits).
const LARGEST: u32 = 999_999;

/// Numbers and values, sorted by number.
pub(super) fn variables(section: &FileVariables) -> Result<Vec<(u32, Option<f64>)>, ConfigError> {
    let mut found: Vec<(u32, Option<f64>)> = Vec::new();
    for (name, value) in section {
        let number = number(name)?;
        let held = match value.get_ref() {
            FileValue::Number(number) if number.is_finite() => Some(*number),
            FileValue::Text(text) if text == "vacant" => None,
            _ => return Err(at(value, "the value of a variable must be a number or \"vacant\"")),
        };
        if found.iter().any(|(known, _)| *known == number) {
            return Err(at(name, format!("#{number} is declared twice")));
        }
        found.push((number, held));
    }
    found.sort_unstable_by_key(|(number, _)| *number);
    Ok(found)
}

fn at<T>(place: &Spanned<T>, message: impl Into<String>) -> ConfigError {
    ConfigError {
        message: message.into(),
        span: Some(place.span()),
    }
}

/// The number of a variable that can have a value before the program runs and keeps it until the program writes it.
fn number(name: &Spanned<String>) -> Result<u32, ConfigError> {
    let text = name.get_ref().trim();
    let digits = text.strip_prefix('#').unwrap_or(text);
    let number = digits.parse::<u32>().ok().filter(|number| *number <= LARGEST);
    let why = match number {
        None => "is not a numbered variable: write `\"#500\" = 12.5`",
        Some(0..=33) => "is local to a program and has no value when a program starts",
        Some(3000..=3012) => "is an alarm, a message or a clock, not a stored value",
        Some(4000..=4199) => "is modal information, which changes while the program runs",
        Some(5001..=5160) => "is a position, which changes while the program runs",
        Some(5201..=5390) => "is a work offset: declare it in [work_offsets]",
        Some(number) => return Ok(number),
    };
    Err(at(name, format!("`{text}` {why}")))
}

#[cfg(test)]
mod tests {
    use crate::Config;

    #[test]
    fn a_section_is_read_in_order() {
        let config = Config::parse("[variables]\n\"#1005\" = 1\n500 = -2.5\n\"#101\" = \"vacant\"\n").expect("read");
        assert_eq!(
            config.setup.variables,
            [(101, None), (500, Some(-2.5)), (1005, Some(1.0))]
        );
    }

    #[test]
    fn what_cannot_be_declared_is_refused_at_its_place() {
        for (text, wrong) in [
            ("[variables]\n\"#5\" = 1", "\"#5\""),
            ("[variables]\n\"#<a>\" = 1", "\"#<a>\""),
            ("[variables]\n\"#4001\" = 1", "\"#4001\""),
            ("[variables]\n\"#5061\" = 1", "\"#5061\""),
            ("[variables]\n\"#5221\" = 1", "\"#5221\""),
            ("[variables]\n\"#500\" = nan", "nan"),
            ("[variables]\n\"#500\" = \"empty\"", "\"empty\""),
        ] {
            let error = Config::parse(text).expect_err(text);
            let span = error
                .span
                .clone()
                .unwrap_or_else(|| panic!("{text}: {error} has no place"));
            assert_eq!(text[span].trim_matches('"'), wrong.trim_matches('"'), "{error}");
        }
        assert!(Config::parse("[variables]\n500 = 1\n\"#500\" = 2\n").is_err(), "twice");
    }
}
