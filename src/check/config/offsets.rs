//! `[work_offsets]` and `[tool_offsets]` of `trunnion.toml`.
use super::ConfigError;
use super::file::at;
use std::collections::BTreeMap;
use toml::Spanned;
use trunnion_interp::{AXIS_LETTERS, AxisLetter, ToolOffsets, WorkOffset};

/// Values by the letters of the axes.
pub(super) type ByAxis = BTreeMap<Spanned<String>, Spanned<f64>>;

/// Whether some dialect has a settable work offset of this name, as the interpreter spells it.
pub(super) fn is_work_offset(name: &str) -> bool {
    let name = name.to_ascii_uppercase();
    let number = |text: &str| -> Option<u32> {
        let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()) && !text.starts_with('0');
        if digits { text.parse().ok() } else { None }
    };
    if let Some(preset) = name.strip_prefix("PRESET ") {
        return preset == "0" || number(preset).is_some();
    }
    let Some(code) = name.strip_prefix('G') else {
        return false;
    };
    if let Some(system) = code.strip_prefix("15 H") {
        return number(system).is_some();
    }
    if let Some(further) = code.strip_prefix("54.1 P").or_else(|| code.strip_prefix("154 P")) {
        return number(further).is_some();
    }
    matches!(code, "59.1" | "59.2" | "59.3")
        || number(code).is_some_and(|code| matches!(code, 54..=59 | 110..=129 | 500 | 505..=599))
}

/// An entry of `[work_offsets]`.
pub(super) fn work_offset(name: &Spanned<String>, values: &ByAxis) -> Result<WorkOffset, ConfigError> {
    if !is_work_offset(name.get_ref()) {
        let known = "G54 to G59, G59.1 to G59.3, G54.1 P1 and so on, G505 to G599, G500, of a Haas G110 to G129 and G154 P1 and so on, of a HEIDENHAIN \
                     \"preset 1\" and so on, of an Okuma \"G15 H1\" and so on";
        return Err(at(
            name,
            format!("`{}` is not a work offset; known are {known}", name.get_ref()),
        ));
    }
    Ok(WorkOffset {
        name: name.get_ref().clone(),
        values: by_axis(values, "a work offset")?,
    })
}

fn by_axis(values: &ByAxis, what: &str) -> Result<[f64; 9], ConfigError> {
    let mut offset = [0.0; AXIS_LETTERS.len()];
    for (letter, value) in values {
        let axis = match letter.get_ref().as_bytes() {
            [letter] => AxisLetter::new(*letter),
            _ => None,
        };
        let Some(axis) = axis else {
            return Err(at(
                letter,
                format!("`{}` is not an axis; the axes are X Y Z A B C U V W", letter.get_ref()),
            ));
        };
        if !value.get_ref().is_finite() {
            return Err(at(
                value,
                format!("{what} must be a number in mm or degrees: `X = 0.0`"),
            ));
        }
        if value.get_ref().abs() > MOST_OFFSET {
            return Err(at(
                value,
                format!("{what} must be at most 1000000 mm or degrees: no machine is larger"),
            ));
        }
        offset[usize::from(axis.0)] = *value.get_ref();
    }
    Ok(offset)
}

/// `[tool_offsets]`: those of a lathe's tools, by the number that the last two digits of T name.
pub(super) fn tool_offsets(file: &BTreeMap<Spanned<String>, ByAxis>) -> Result<ToolOffsets, ConfigError> {
    let mut offsets: Vec<(u32, [f64; 9])> = Vec::new();
    for (name, values) in file {
        let number = name.get_ref().parse().ok().filter(|number| (1..=999).contains(number));
        let Some(number) = number else {
            let message = format!(
                "`{}` is no number of a tool offset: write 2 = {{ X = 0, Z = 0 }}",
                name.get_ref()
            );
            return Err(at(name, message));
        };
        if offsets.iter().any(|(known, _)| *known == number) {
            return Err(at(name, format!("tool offset {number} is declared twice")));
        }
        let has = |axis: &str| values.keys().any(|letter| letter.get_ref() == axis);
        if let Some(other) = values
            .keys()
            .find(|letter| !["X", "Y", "Z"].contains(&letter.get_ref().as_str()))
        {
            return Err(at(other, "a tool offset shifts X, Y and Z: `2 = { X = 0, Z = 0 }`"));
        }
        if !has("X") || !has("Z") {
            return Err(at(
                name,
                "a tool offset needs X, as a radius, and Z: `2 = { X = 0, Z = 0 }`",
            ));
        }
        offsets.push((number, by_axis(values, "a tool offset")?));
    }
    offsets.sort_unstable_by_key(|(number, _)| *number);
    Ok(ToolOffsets(offsets))
}

/// More is a slip of the keyboard, mm or degrees.
const MOST_OFFSET: f64 = 1e6;
