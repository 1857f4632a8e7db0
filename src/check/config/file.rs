//! The text of `trunnion.toml`: every unknown key, unknown name and value out of range is an error with its place.
use super::{Config, ConfigError, RuleLevel, TOLERANCES, tool};
use crate::Severity;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;
use trunnion_interp::{AXIS_LETTERS, AxisLetter, Tool, WorkOffset};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    machine: Option<String>,
    dialect: Option<Spanned<String>>,
    #[serde(default)]
    rules: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    tolerances: BTreeMap<Spanned<String>, Spanned<f64>>,
    #[serde(default)]
    tool: Vec<Spanned<FileTool>>,
    #[serde(default)]
    work_offsets: BTreeMap<Spanned<String>, BTreeMap<Spanned<String>, Spanned<f64>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileTool {
    number: u32,
    shape: Option<String>,
    diameter: Option<f64>,
    corner_radius: Option<f64>,
    length: Option<f64>,
    /// Read, kept for the collision floor to come; no check uses it yet.
    #[serde(rename = "holder")]
    _holder: Option<toml::Value>,
}

pub(super) fn parse(text: &str) -> Result<Config, ConfigError> {
    let file: File = toml::from_str(text).map_err(|error| ConfigError {
        message: error.message().to_owned(),
        span: error.span(),
    })?;
    let mut config = Config {
        machine: file.machine,
        ..Config::default()
    };
    if let Some(dialect) = file.dialect {
        if !trunnion_dialect::BUILTIN_NAMES.contains(&dialect.get_ref().as_str()) {
            let names = trunnion_dialect::BUILTIN_NAMES.join(", ");
            return Err(at(
                &dialect,
                format!("no dialect is called `{}`; there are {names}", dialect.get_ref()),
            ));
        }
        config.dialect = Some(dialect.into_inner());
    }
    for (name, level) in file.rules {
        config.rules.push(rule_level(&name, &level)?);
    }
    for (name, value) in file.tolerances {
        config.tolerances.push(tolerance(&name, &value)?);
    }
    for entry in file.tool {
        let tool = declared_tool(&entry)?;
        if config.setup.tools.iter().any(|known| known.number == tool.number) {
            return Err(at(&entry, format!("tool {} is declared twice", tool.number)));
        }
        config.setup.tools.push(tool);
    }
    for (name, values) in file.work_offsets {
        config.setup.work_offsets.push(work_offset(&name, &values)?);
    }
    Ok(config)
}

fn at<T>(place: &Spanned<T>, message: impl Into<String>) -> ConfigError {
    ConfigError {
        message: message.into(),
        span: Some(place.span()),
    }
}

fn rule_level(name: &Spanned<String>, level: &Spanned<String>) -> Result<(String, RuleLevel), ConfigError> {
    if crate::rule(name.get_ref()).is_none() {
        return Err(at(
            name,
            format!("no rule is called `{}`; `trunnion rules` lists them", name.get_ref()),
        ));
    }
    let value = match level.get_ref().as_str() {
        "allow" => RuleLevel::Allow,
        "info" => RuleLevel::At(Severity::Info),
        "warning" => RuleLevel::At(Severity::Warning),
        "error" => RuleLevel::At(Severity::Error),
        other => {
            return Err(at(
                level,
                format!("no level is called `{other}`: allow, info, warning or error"),
            ));
        }
    };
    Ok((name.get_ref().clone(), value))
}

fn tolerance(name: &Spanned<String>, value: &Spanned<f64>) -> Result<(String, f64), ConfigError> {
    let key = name.get_ref().as_str();
    if TOLERANCES.iter().all(|(known, _)| *known != key) {
        let names: Vec<&str> = TOLERANCES.iter().map(|(known, _)| *known).collect();
        return Err(at(
            name,
            format!("no tolerance is called `{key}`; there are {}", names.join(", ")),
        ));
    }
    let number = *value.get_ref();
    let most = if key.starts_with("feed_drop") { 1.0 } else { f64::MAX };
    if !(0.0..=most).contains(&number) {
        let range = if most == 1.0 {
            "from 0 to 1, a share of the programmed feed"
        } else {
            "0 or more"
        };
        return Err(at(value, format!("`{key}` must be {range}, not {number}")));
    }
    Ok((key.to_owned(), number))
}

fn declared_tool(entry: &Spanned<FileTool>) -> Result<Tool, ConfigError> {
    let tool = entry.get_ref();
    let shape = match &tool.shape {
        Some(name) => Some(tool::shape(name, tool.diameter, tool.corner_radius).map_err(|message| at(entry, message))?),
        None if tool.corner_radius.is_some() => {
            return Err(at(entry, "a corner radius needs a shape: shape = \"bull\""));
        }
        None => None,
    };
    for (key, value) in [("diameter", tool.diameter), ("length", tool.length)] {
        if value.is_some_and(|value| !value.is_finite() || value < 0.0) {
            return Err(at(entry, format!("`{key}` must be 0 mm or more")));
        }
    }
    Ok(Tool {
        number: tool.number,
        shape,
        diameter_mm: tool.diameter,
        length_mm: tool.length,
    })
}

fn work_offset(
    name: &Spanned<String>,
    values: &BTreeMap<Spanned<String>, Spanned<f64>>,
) -> Result<WorkOffset, ConfigError> {
    let mut offset = WorkOffset {
        name: name.get_ref().clone(),
        values: [0.0; AXIS_LETTERS.len()],
    };
    for (letter, value) in values {
        let axis = match letter.get_ref().as_bytes() {
            [letter] => AxisLetter::new(*letter),
            _ => None,
        };
        let Some(axis) = axis else {
            return Err(at(
                letter,
                format!("`{}` is no axis: X Y Z A B C U V W", letter.get_ref()),
            ));
        };
        if !value.get_ref().is_finite() {
            return Err(at(value, "a work offset is a number of mm or degrees"));
        }
        offset.values[usize::from(axis.0)] = *value.get_ref();
    }
    Ok(offset)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_interp::ToolShape;

    const WHOLE: &str = r#"
machine = "mikron-ucp710"
dialect = "sinumerik-840d"
[rules]
pole-flip = "error"
feed-drop = "allow"
[tolerances]
tip = 0.02
[[tool]]
number = 1
shape = "ball"
diameter = 10
length = 80.5
[work_offsets]
G54 = { X = 1, Y = 0, Z = -2.5 }
"#;

    #[test]
    fn a_whole_file_is_read() {
        let config = parse(WHOLE).unwrap();
        assert_eq!(config.machine.as_deref(), Some("mikron-ucp710"));
        assert_eq!(config.rules[0], ("feed-drop".to_owned(), RuleLevel::Allow));
        assert_eq!(
            config.rules[1],
            ("pole-flip".to_owned(), RuleLevel::At(Severity::Error))
        );
        assert_eq!(config.tolerances, [("tip".to_owned(), 0.02)]);
        assert_eq!(config.setup.tools[0].shape, Some(ToolShape::Ball));
        assert_eq!(config.setup.tools[0].length_mm, Some(80.5));
        assert_eq!(config.setup.work_offsets[0].values[..3], [1.0, 0.0, -2.5]);
    }

    #[test]
    fn errors_point_at_their_place() {
        for (text, wrong) in [
            ("machin = \"x\"", "machin"),
            ("[rules]\npole-flop = \"error\"", "pole-flop"),
            ("[rules]\npole-flip = \"loud\"", "\"loud\""),
            ("[tolerances]\ntipp = 1", "tipp"),
            ("[tolerances]\ntip = -1", "-1"),
            ("[tolerances]\nfeed_drop_error = 30", "30"),
            ("dialect = \"klingon\"", "\"klingon\""),
            ("[work_offsets]\nG54 = { Q = 1 }", "Q"),
            ("[work_offsets]\nG54 = { X = nan }", "nan"),
            ("[[tool]]\nnumber = 1\ndiametre = 3", "diametre"),
        ] {
            let error = parse(text).unwrap_err();
            let span = error
                .span
                .clone()
                .unwrap_or_else(|| panic!("{text}: {error} has no place"));
            assert_eq!(&text[span], wrong, "{text}: {error}");
        }
        for text in [
            "[[tool]]\nnumber = 1\nshape = \"cone\"",
            "[[tool]]\nnumber = 1\n[[tool]]\nnumber = 1",
            "= 1",
        ] {
            assert!(parse(text).unwrap_err().span.is_some(), "{text}");
        }
    }
}
