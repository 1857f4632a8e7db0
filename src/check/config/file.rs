//! The text of `trunnion.toml`: every unknown key, unknown name and value out of range is an error with its place.
use super::control::KnownDialect;
use super::{Config, ConfigError, RuleLevel, TOLERANCES, nose, offsets, tool};
use crate::{Severity, did_you_mean, or_known};
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;
use trunnion_interp::Tool;

/// More executed blocks than these are not allowed: at some millions a second they take an hour.
const MOST_BLOCKS: u64 = 10_000_000_000;
/// More calls inside calls than these are not allowed.
const MOST_DEPTH: u64 = 10_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    machine: Option<String>,
    dialect: Option<Spanned<String>>,
    dialect_table: Option<Spanned<String>>,
    #[serde(default)]
    subprogram_path: Vec<Spanned<String>>,
    #[serde(default)]
    machine_path: Vec<Spanned<String>>,
    #[serde(default)]
    port_to: Vec<Spanned<String>>,
    #[serde(default)]
    assume: Vec<Spanned<String>>,
    #[serde(default)]
    limits: FileLimits,
    #[serde(default)]
    control: super::control::FileControl,
    #[serde(default)]
    variables: super::variables::FileVariables,
    #[serde(default)]
    rules: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    tolerances: BTreeMap<Spanned<String>, Spanned<f64>>,
    #[serde(default)]
    tool: Vec<Spanned<FileTool>>,
    #[serde(default)]
    obstacle: Vec<Spanned<trunnion_machine::RawObstacle>>,
    #[serde(default)]
    format: super::FormatSettings,
    #[serde(default)]
    fix: super::fix::FileFix,
    #[serde(default)]
    work_offsets: BTreeMap<Spanned<String>, offsets::ByAxis>,
    #[serde(default)]
    tool_offsets: BTreeMap<Spanned<String>, offsets::ByAxis>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct FileLimits {
    blocks: Option<Spanned<i64>>,
    steps: Option<Spanned<i64>>,
    held: Option<Spanned<i64>>,
    depth: Option<Spanned<i64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileTool {
    number: Spanned<u32>,
    pub(super) shape: Option<Spanned<String>>,
    diameter: Option<Spanned<f64>>,
    pub(super) corner_radius: Option<Spanned<f64>>,
    length: Option<Spanned<f64>>,
    holder: Option<Spanned<toml::Value>>,
    pub(super) nose_radius: Option<Spanned<f64>>,
    pub(super) tip_direction: Option<Spanned<u8>>,
}

pub(super) fn parse(text: &str) -> Result<Config, ConfigError> {
    let file: File = toml::from_str(text).map_err(|error| ConfigError {
        message: trunnion_dialect::plain_toml(
            Some(trunnion_dialect::KeyFile::Settings),
            text,
            error.message(),
            error.span(),
        ),
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
    if let Some(table) = file.dialect_table {
        if config.dialect.is_some() {
            return Err(at(
                &table,
                "use either `dialect` or `dialect_table`, not both: the table itself names the dialect that it `extends`",
            ));
        }
        let span = table.span();
        config.dialect_table = Some((table.into_inner(), span));
    }
    for name in file.assume {
        if !config.assume.add(name.get_ref()) {
            let hint = crate::or_known(name.get_ref(), &crate::Assume::NAMES, "names");
            return Err(at(&name, format!("`{}` cannot be assumed{hint}", name.get_ref())));
        }
    }
    for dialect in file.port_to {
        config.port_to.push(known_dialect(dialect)?);
    }
    config.subprogram_path = folders(file.subprogram_path)?;
    config.machine_path = folders(file.machine_path)?;
    config.fix = file.fix.settings()?;
    let dialect = KnownDialect::of(&config);
    config.setup.control = file.control.data(dialect)?;
    let declared = super::variables::variables(&file.variables, dialect.named())?;
    (config.setup.variables, config.setup.named_variables) = (declared.numbered, declared.named);
    bounds(&file.limits, &mut config.setup.limits)?;
    for (name, level) in file.rules {
        config.rules.push(rule_level(&name, &level)?);
    }
    for (name, value) in file.tolerances {
        config.tolerances.push(tolerance(&name, &value)?);
    }
    let mut numbers = std::collections::HashSet::new();
    for entry in file.tool {
        let tool = declared_tool(&entry)?;
        if !numbers.insert(tool.number) {
            return Err(at(
                &entry.get_ref().number,
                format!("tool {} is declared twice", tool.number),
            ));
        }
        config.setup.tools.push(tool);
    }
    config.obstacles = trunnion_machine::RawObstacle::check_all(&file.obstacle).map_err(|fault| ConfigError {
        message: fault.message,
        span: fault.span,
    })?;
    for (name, values) in file.work_offsets {
        let axes = values
            .keys()
            .filter_map(|axis| Some((*axis.get_ref().as_bytes().first()?, axis.span())));
        config.offset_axes.extend(axes);
        let given = values.keys().filter_map(|axis| axis.get_ref().bytes().next()).collect();
        config.offsets.push((name.span(), name.get_ref().clone(), given));
        config.setup.work_offsets.push(offsets::work_offset(&name, &values)?);
    }
    config.setup.tool_offsets = offsets::tool_offsets(&file.tool_offsets)?;
    Ok(config)
}

/// `[limits]`.
fn bounds(file: &FileLimits, limits: &mut trunnion_interp::Limits) -> Result<(), ConfigError> {
    if let Some(blocks) = &file.blocks {
        limits.blocks = limit("blocks", blocks, MOST_BLOCKS)?;
    }
    if let Some(steps) = &file.steps {
        limits.steps = limit("steps", steps, MOST_BLOCKS)?;
    }
    if let Some(held) = &file.held {
        limits.held = limit("held", held, MOST_BLOCKS)?;
    }
    if let Some(depth) = &file.depth {
        // within bounds of u32 by `limit`
        limits.depth = limit("depth", depth, MOST_DEPTH)? as u32;
    }
    Ok(())
}

/// Names of folders with their places in the file.
fn folders(named: Vec<Spanned<String>>) -> Result<Vec<(String, core::ops::Range<usize>)>, ConfigError> {
    let place = |folder: Spanned<String>| {
        if folder.get_ref().is_empty() {
            return Err(at(
                &folder,
                "the folder name is empty; write `.` for the folder of this file",
            ));
        }
        let span = folder.span();
        Ok((folder.into_inner(), span))
    };
    named.into_iter().map(place).collect()
}

pub(super) fn at<T>(place: &Spanned<T>, message: impl Into<String>) -> ConfigError {
    ConfigError {
        message: message.into(),
        span: Some(place.span()),
    }
}

fn known_dialect(name: Spanned<String>) -> Result<String, ConfigError> {
    if trunnion_dialect::BUILTIN_NAMES.contains(&name.get_ref().as_str()) {
        return Ok(name.into_inner());
    }
    let known = trunnion_dialect::BUILTIN_NAMES;
    let list = format!(
        "; known dialects: {}; to use your own table, set `dialect_table`",
        known.join(", ")
    );
    let hint = did_you_mean(name.get_ref(), known, &list);
    Err(at(&name, format!("unknown dialect `{}`{hint}", name.get_ref())))
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
        let hint = did_you_mean(
            name.get_ref(),
            &crate::rule_names(),
            "; `trunnion rules` lists all rules",
        );
        return Err(at(name, format!("unknown rule `{}`{hint}", name.get_ref())));
    }
    let value = match level.get_ref().as_str() {
        "allow" => RuleLevel::Allow,
        "info" => RuleLevel::At(Severity::Info),
        "warning" => RuleLevel::At(Severity::Warning),
        "error" => RuleLevel::At(Severity::Error),
        other => {
            return Err(at(
                level,
                format!("unknown level `{other}`; write allow, info, warning or error"),
            ));
        }
    };
    Ok((name.get_ref().clone(), value))
}

fn tolerance(name: &Spanned<String>, value: &Spanned<f64>) -> Result<(String, f64), ConfigError> {
    let key = name.get_ref().as_str();
    if TOLERANCES.iter().all(|(known, _)| *known != key) {
        let names: Vec<&str> = TOLERANCES.iter().map(|(known, _)| *known).collect();
        let hint = or_known(key, &names, "tolerances");
        return Err(at(name, format!("unknown tolerance `{key}`{hint}")));
    }
    let number = *value.get_ref();
    let (least, most, range) = if key.starts_with("feed_drop") {
        (0.0, 1.0, "from 0 to 1, a part of the programmed feed")
    } else if key.ends_with("_ratio") {
        (1.0, f64::MAX, "1 or more, a ratio to the direct distance")
    } else {
        (0.0, f64::MAX, "0 or more")
    };
    if !(least..=most).contains(&number) {
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
    let nose = nose::nose(tool)?;
    let shape =
        match (&tool.shape, &tool.corner_radius) {
            _ if nose.is_some() => nose,
            (Some(name), _) => Some(tool::shape(name.get_ref(), diameter, corner).map_err(
                |(part, message)| match (part, &tool.diameter, &tool.corner_radius) {
                    (tool::Part::Diameter, Some(diameter), _) => at(diameter, message),
                    (tool::Part::CornerRadius, _, Some(corner)) => at(corner, message),
                    _ => at(name, message),
                },
            )?),
            (None, Some(corner)) => {
                return Err(at(corner, "`corner_radius` needs a tool shape: add `shape = \"bull\"`"));
            }
            (None, None) => None,
        };
    Ok(Tool {
        number: *tool.number.get_ref(),
        shape,
        diameter_mm: diameter,
        length_mm: value(&tool.length),
        holder_mm: holder(tool.holder.as_ref())?,
    })
}

/// The diameter of a holder, mm: `holder = { diameter = 50 }`. Of one that only has a name it is not declared.
fn holder(written: Option<&Spanned<toml::Value>>) -> Result<Option<f64>, ConfigError> {
    let Some(written) = written else { return Ok(None) };
    let table = match written.get_ref() {
        toml::Value::String(_) => return Ok(None),
        toml::Value::Table(table) => table,
        _ => return Err(at(written, "`holder` must be a name in quotes or `{ diameter = MM }`")),
    };
    if let Some(key) = table.keys().find(|key| *key != "diameter") {
        let hint = or_known(key, &["diameter"], "keys");
        return Err(at(written, format!("unknown key `{key}` of `holder`{hint}")));
    }
    let diameter = table.get("diameter").and_then(|value| match value {
        toml::Value::Integer(whole) => Some(*whole as f64),
        toml::Value::Float(number) => Some(*number),
        _ => None,
    });
    match diameter {
        Some(mm) if mm > 0.0 && mm.is_finite() => Ok(Some(mm)),
        _ => Err(at(
            written,
            "`diameter` of `holder` must be a number in mm, greater than 0",
        )),
    }
}

#[cfg(test)]
mod tests;
