//! The setup of a run for LinuxCNC's interpreter.
use crate::{LengthUnit, Setup, Tool};
use trunnion_dialect::{Code, CodeKind, Dialect};
use trunnion_ngc::{Ini, Parameters, Setup as CallState, Start, ToolEntry, ToolTable, Units};

/// First parameter of the coordinate systems: X of G54; 20 further on that of G55 (LinuxCNC documentation, Parameters).
pub(super) const FIRST_SYSTEM: u32 = 5221;
/// X of the points that G28 and G30 go to.
const FIRST_HOMES: [u32; 2] = [5161, 5181];
/// Names of the coordinate systems in the order of their parameters.
pub(super) const SYSTEMS: [&str; 9] = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];

/// Letter and ten times the number of a G or M code.
fn numbered(code: &Code) -> Option<(u8, u32)> {
    let letter = match code.kind {
        CodeKind::G => b'G',
        CodeKind::M => b'M',
        CodeKind::Name => return None,
    };
    let number: f64 = code.id.get(1..)?.parse().ok()?;
    Some((letter, (number * 10.0).round() as u32))
}

/// mm and degrees as the control keeps them: lengths in its unit.
fn in_units(mut values: [f64; 9], units: Units) -> [f64; 9] {
    for axis in super::bridge::LINEAR_AXES {
        values[axis] /= units.mm();
    }
    values
}

fn row(tool: &Tool, units: Units) -> ToolEntry {
    let mut offset = [0.0; 9];
    offset[2] = tool.length_mm.unwrap_or(0.0) / units.mm();
    let number = i32::try_from(tool.number).unwrap_or(i32::MAX);
    ToolEntry {
        number,
        pocket: number,
        offset,
        diameter: tool.diameter_mm.unwrap_or(0.0) / units.mm(),
        ..ToolEntry::default()
    }
}

/// The setup of the interpreter: declared offsets as parameters, declared tools as its table, further codes of the dialect's table as
/// the machine's own codes. Offsets that are not declared are zero.
pub(super) fn at_start<'t>(setup: &'t Setup, declared: impl Iterator<Item = &'t Tool>, dialect: &Dialect) -> CallState {
    let units = match setup.control.units {
        Some(LengthUnit::Inch) => Units::Inch,
        Some(LengthUnit::Millimetre) | None => Units::Millimetre,
    };
    let mut values = Vec::new();
    for (index, name) in SYSTEMS.iter().enumerate() {
        let offset = setup
            .work_offsets
            .iter()
            .find(|offset| offset.name.eq_ignore_ascii_case(name));
        let offset = offset.map_or([0.0; 9], |offset| in_units(offset.values, units));
        let first = FIRST_SYSTEM + 20 * index as u32;
        values.extend((first..).zip(offset));
        // its rotation about Z
        values.push((first + 9, 0.0));
    }
    // G92 is off
    values.extend((5210..=5219).map(|number| (number, 0.0)));
    // where G28 and G30 go
    for (first, point) in FIRST_HOMES.iter().zip(&setup.control.reference_points) {
        let places = in_units(point.values, units);
        let known = (0..9).filter(|&axis| point.get(axis).is_some());
        values.extend(known.map(|axis| (first + axis as u32, places[axis])));
    }
    // what the settings say of a variable comes before what is made of offsets
    values.retain(|(number, _)| setup.variables.iter().all(|(known, _)| known != number));
    values.extend(
        setup
            .variables
            .iter()
            .filter_map(|(number, value)| Some((*number, (*value)?))),
    );
    values.sort_unstable_by_key(|(number, _)| *number);
    let mut own: Vec<(u8, u32)> = dialect.codes().iter().filter_map(numbered).collect();
    // the machine file has declared the effect of a clamp code; those that the control itself knows are not requested from it
    let clamps = setup.control.clamp_codes.iter().flatten();
    own.extend(clamps.flat_map(|codes| [codes.on, codes.off].map(|code| (b'M', u32::from(code) * 10))));
    own.sort_unstable();
    own.dedup();
    let is_motion = |code: &&Code| code.group.as_deref() == Some("motion");
    let motions = dialect.codes().iter().filter(is_motion).filter_map(numbered);
    let mut motions: Vec<u32> = motions.filter(|code| code.0 == b'G').map(|code| code.1).collect();
    motions.sort_unstable();
    let tools = setup.tools.iter().chain(declared).filter(|tool| tool.number != 0);
    let mut ini = Ini::default();
    let further = setup.control.further_axes.iter().map(|letter| char::from(*letter));
    let coordinates = if setup.control.axes_declared {
        "XYZABC".chars().chain(further).collect()
    } else {
        "XYZABCUVW".to_owned()
    };
    ini.values
        .insert(("TRAJ".to_owned(), "COORDINATES".to_owned()), coordinates);
    CallState {
        start: Start::Unknown,
        enter_definitions: setup.enter_definitions,
        ini,
        machine_units: units,
        own_codes: own.into(),
        own_motions: motions.into(),
        any_tool: true,
        any_ini: true,
        user_codes: true,
        block_delete: setup.control.block_delete == Some(true),
        tools: ToolTable {
            rows: tools.map(|tool| row(tool, units)).collect(),
            spindle: None,
        },
        parameters: Parameters {
            values,
            globals: globals(setup),
        },
        files: setup.library.0.clone(),
        limits: setup.limits,
        ..CallState::default()
    }
}

/// Global names that the settings declare, without `#<` and `>`.
fn globals(setup: &Setup) -> Vec<(String, f64)> {
    let inside = |name: &str| Some(name.strip_prefix("#<")?.strip_suffix('>')?.to_owned());
    let declared = setup.named_variables.0.iter();
    declared
        .filter_map(|(name, value)| Some((inside(name)?, *value)))
        .collect()
}
