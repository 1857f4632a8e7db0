//! The text of `trunnion.toml`: every unknown key, unknown name and value out of range is an error with its place.
use super::{Config, ConfigError, RuleLevel, TOLERANCES, tool};
use crate::Severity;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;
use trunnion_interp::{AXIS_LETTERS, AxisLetter, Tool, WorkOffset};

/// More executed blocks than these are not allowed: at some millions a second they take an hour.
const MOST_BLOCKS: u64 = 10_000_000_000;
/// More calls inside calls than these are not allowed.
const MOST_DEPTH: u64 = 10_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    machine: Option<String>,
    dialect: Option<Spanned<String>>,
    #[serde(default)]
    subprogram_path: Vec<Spanned<String>>,
    #[serde(default)]
    port_to: Vec<Spanned<String>>,
    #[serde(default)]
    limits: FileLimits,
    #[serde(default)]
    rules: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    tolerances: BTreeMap<Spanned<String>, Spanned<f64>>,
    #[serde(default)]
    tool: Vec<Spanned<FileTool>>,
    #[serde(default)]
    format: super::FormatSettings,
    #[serde(default)]
    work_offsets: BTreeMap<Spanned<String>, BTreeMap<Spanned<String>, Spanned<f64>>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct FileLimits {
    blocks: Option<Spanned<i64>>,
    depth: Option<Spanned<i64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileTool {
    number: Spanned<u32>,
    shape: Option<Spanned<String>>,
    diameter: Option<Spanned<f64>>,
    corner_radius: Option<Spanned<f64>>,
    length: Option<Spanned<f64>>,
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
        format: file.format,
        ..Config::default()
    };
    if let Some(dialect) = file.dialect {
        config.dialect = Some(known_dialect(dialect)?);
    }
    for dialect in file.port_to {
        config.port_to.push(known_dialect(dialect)?);
    }
    for folder in file.subprogram_path {
        if folder.get_ref().is_empty() {
            return Err(at(&folder, "a folder has a name; `.` is the folder of this file"));
        }
        let span = folder.span();
        config.subprogram_path.push((folder.into_inner(), span));
    }
    if let Some(blocks) = &file.limits.blocks {
        config.setup.limits.blocks = limit("blocks", blocks, MOST_BLOCKS)?;
    }
    if let Some(depth) = &file.limits.depth {
        // within bounds of u32 by `limit`
        config.setup.limits.depth = limit("depth", depth, MOST_DEPTH)? as u32;
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
            return Err(at(
                &entry.get_ref().number,
                format!("tool {} is declared twice", tool.number),
            ));
        }
        config.setup.tools.push(tool);
    }
    for (name, values) in file.work_offsets {
        let axes = values
            .keys()
            .filter_map(|axis| Some((*axis.get_ref().as_bytes().first()?, axis.span())));
        config.offset_axes.extend(axes);
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

fn known_dialect(name: Spanned<String>) -> Result<String, ConfigError> {
    if trunnion_dialect::BUILTIN_NAMES.contains(&name.get_ref().as_str()) {
        return Ok(name.into_inner());
    }
    let names = trunnion_dialect::BUILTIN_NAMES.join(", ");
    Err(at(
        &name,
        format!("no dialect is called `{}`; there are {names}", name.get_ref()),
    ))
}

fn limit(key: &str, value: &Spanned<i64>, most: u64) -> Result<u64, ConfigError> {
    match u64::try_from(*value.get_ref()) {
        Ok(number @ 1..) if number <= most => Ok(number),
        _ => Err(at(
            value,
            format!("`{key}` of [limits] must be from 1 to {most}, not {}", value.get_ref()),
        )),
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
    let value = |number: &Option<Spanned<f64>>| number.as_ref().map(|number| *number.get_ref());
    for (key, number) in [("diameter", &tool.diameter), ("length", &tool.length)] {
        if let Some(number) = number
            && !(number.get_ref().is_finite() && *number.get_ref() >= 0.0)
        {
            return Err(at(number, format!("`{key}` must be 0 mm or more")));
        }
    }
    let (diameter, corner) = (value(&tool.diameter), value(&tool.corner_radius));
    let shape =
        match (&tool.shape, &tool.corner_radius) {
            (Some(name), _) => Some(tool::shape(name.get_ref(), diameter, corner).map_err(
                |(part, message)| match (part, &tool.diameter, &tool.corner_radius) {
                    (tool::Part::Diameter, Some(diameter), _) => at(diameter, message),
                    (tool::Part::CornerRadius, _, Some(corner)) => at(corner, message),
                    _ => at(name, message),
                },
            )?),
            (None, Some(corner)) => {
                return Err(at(corner, "a corner radius needs a shape: shape = \"bull\""));
            }
            (None, None) => None,
        };
    Ok(Tool {
        number: *tool.number.get_ref(),
        shape,
        diameter_mm: diameter,
        length_mm: value(&tool.length),
    })
}

/// Whether some dialect has a settable work offset of this name, as the interpreter spells it.
fn is_work_offset(name: &str) -> bool {
    let name = name.to_ascii_uppercase();
    let number = |text: &str| -> Option<u32> {
        let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()) && !text.starts_with('0');
        if digits { text.parse().ok() } else { None }
    };
    let Some(code) = name.strip_prefix('G') else {
        return false;
    };
    if let Some(further) = code.strip_prefix("54.1 P") {
        return number(further).is_some();
    }
    matches!(code, "59.1" | "59.2" | "59.3") || number(code).is_some_and(|code| matches!(code, 54..=59 | 505..=599))
}

fn work_offset(
    name: &Spanned<String>,
    values: &BTreeMap<Spanned<String>, Spanned<f64>>,
) -> Result<WorkOffset, ConfigError> {
    if !is_work_offset(name.get_ref()) {
        let known = "G54 to G59, G59.1 to G59.3, G54.1 P1 and so on, G505 to G599";
        return Err(at(name, format!("`{}` is no work offset: {known}", name.get_ref())));
    }
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
subprogram_path = ["subs", "/nc/shared"]
port_to = ["linuxcnc"]
[limits]
blocks = 5000
depth = 8
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
        let folders: Vec<&str> = config.subprogram_path.iter().map(|(path, _)| path.as_str()).collect();
        assert_eq!(folders, ["subs", "/nc/shared"]);
        assert_eq!(config.port_to, ["linuxcnc"]);
        let limits = config.setup.limits;
        assert_eq!((limits.blocks, limits.depth), (5000, 8));
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
            ("port_to = [\"linuxcnc\", \"klingon\"]", "\"klingon\""),
            ("subprogram_path = [\"a\", \"\"]", "\"\""),
            ("[limits]\nblocks = 0", "0"),
            ("[limits]\ndepth = 10001", "10001"),
            ("[limits]\ndeep = 3", "deep"),
            ("[work_offsets]\nG54 = { Q = 1 }", "Q"),
            ("[work_offsets]\nG54 = { X = nan }", "nan"),
            ("[work_offsets]\nG643 = { X = 1 }", "G643"),
            ("[work_offsets]\n\"G54.1\" = { X = 1 }", "\"G54.1\""),
            ("[[tool]]\nnumber = 1\ndiametre = 3", "diametre"),
            ("[[tool]]\nnumber = 1\nlength = -3", "-3"),
            ("[[tool]]\nnumber = 1\nshape = \"cone\"", "\"cone\""),
            ("[[tool]]\nnumber = 1\nshape = \"ball\"\ndiameter = 0", "0"),
            (
                "[[tool]]\nnumber = 1\nshape = \"bull\"\ndiameter = 8\ncorner_radius = 5",
                "5",
            ),
            ("[[tool]]\nnumber = 1\n[[tool]]\nlength = 2\nnumber = 1", "1"),
        ] {
            let error = parse(text).unwrap_err();
            let span = error
                .span
                .clone()
                .unwrap_or_else(|| panic!("{text}: {error} has no place"));
            assert_eq!(&text[span], wrong, "{text}: {error}");
        }
        assert!(parse("= 1").unwrap_err().span.is_some());
    }

    #[test]
    fn errors_in_a_tool_are_not_told_at_the_start_of_the_file() {
        for text in [
            "[[tool]]\nlength = 1",
            "x = 1\n[[tool]]\nnumber = -1",
            "[[tool]]\nnumber = \"a\"",
        ] {
            assert!(parse(text).unwrap_err().span.is_some_and(|span| span.end > 0), "{text}");
        }
    }

    #[test]
    fn work_offsets_of_all_dialects_are_known() {
        for name in ["G54", "g59", "G59.3", "G54.1 P12", "G505", "G599"] {
            assert!(is_work_offset(name), "{name}");
        }
        for name in [
            "G53", "G500", "G60", "G643", "G600", "G59.4", "G54.1 P", "G54.1 P0", "54", "G054", "X",
        ] {
            assert!(!is_work_offset(name), "{name}");
        }
    }

    #[test]
    fn an_axis_that_the_machine_lacks_has_its_place() {
        let text = "[work_offsets]\nG54 = { X = 1, A = 2 }";
        let config = parse(text).unwrap();
        let machine = |name| trunnion_machine::builtin(name).unwrap();
        assert_eq!(config.check_axes(machine("mikron-ucp710")), Ok(()));
        let error = config.check_axes(machine("mill-3axis")).unwrap_err();
        assert_eq!(&text[error.span.unwrap()], "A");
    }
}
