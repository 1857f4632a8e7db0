//! Names the control sets itself: its state and position (values and names observed from `rs274`).
use super::Values;
use crate::exec;
use crate::state::said;
use crate::{DistanceMode, FeedMode, Plane, RetractMode, Side, SpindleMode, Units};

/// How a value is found.
type Read = fn(&Values<'_>) -> f64;

/// All names, in order.
pub(super) const NAMES: &[(&str, Read)] = &[
    ("_a", |v| v.state.position()[3]),
    ("_abs_a", |v| machine(v, 3)),
    ("_abs_b", |v| machine(v, 4)),
    ("_abs_c", |v| machine(v, 5)),
    ("_abs_x", |v| machine(v, 0)),
    ("_abs_y", |v| machine(v, 1)),
    ("_abs_z", |v| machine(v, 2)),
    ("_absolute", |v| truth(v.state.distance == DistanceMode::Absolute)),
    ("_adaptive_feed", |v| truth(v.state.adaptive_feed)),
    ("_b", |v| v.state.position()[4]),
    ("_c", |v| v.state.position()[5]),
    ("_call_level", |v| v.store.aside.len() as f64),
    ("_ccomp", compensation),
    ("_coord_system", |v| {
        v.set(said::SYSTEM, coordinate_system(v.state.origin_index))
    }),
    ("_current_pocket", |v| v.set(said::TOOL, pocket(v, v.state.current_row))),
    ("_current_tool", |v| v.set(said::TOOL, f64::from(v.state.tool))),
    ("_feed", |v| v.state.feed_rate),
    ("_feed_hold", |v| truth(v.state.feed_hold)),
    ("_feed_override", |v| truth(v.state.feed_override)),
    ("_flood", |v| v.set(said::COOLANT, truth(v.state.flood))),
    ("_ijk_absolute_mode", |v| {
        truth(v.state.arc_distance == DistanceMode::Absolute)
    }),
    ("_imperial", |v| truth(v.state.units == Units::Inch)),
    ("_incremental", |v| truth(v.state.distance == DistanceMode::Incremental)),
    ("_inverse_time", |v| truth(v.state.feed_mode == FeedMode::InverseTime)),
    ("_lathe_diameter_mode", |v| truth(v.state.lathe_diameter)),
    ("_lathe_radius_mode", |v| truth(!v.state.lathe_diameter)),
    ("_line", |v| f64::from(v.line)),
    ("_metric", |v| truth(v.state.units == Units::Millimetre)),
    ("_mist", |v| v.set(said::COOLANT, truth(v.state.mist))),
    ("_motion_mode", |v| f64::from(v.state.motion)),
    ("_plane", |v| plane(v.state.plane)),
    ("_remap_level", |_| 0.0),
    ("_retract_old_z", |v| truth(v.state.retract == RetractMode::OldZ)),
    ("_retract_r_plane", |v| truth(v.state.retract == RetractMode::RPlane)),
    ("_rpm", |v| v.set(said::SPEED, v.state.speed[0])),
    ("_selected_pocket", |v| {
        v.set(said::SELECTED, pocket(v, v.state.selected_row))
    }),
    ("_selected_tool", |v| {
        v.set(said::SELECTED, f64::from(v.state.selected_tool.max(0)))
    }),
    ("_speed_override", |v| truth(v.state.speed_override)),
    ("_spindle_css_mode", |v| truth(surface_speed(v))),
    ("_spindle_cw", |v| v.set(said::SPINDLE, truth(v.state.turning[0] == 1))),
    ("_spindle_on", |v| v.set(said::SPINDLE, truth(v.state.turning[0] != 0))),
    ("_spindle_rpm_mode", |v| truth(!surface_speed(v))),
    // 1 where motion is carried out: a check simulates the machine
    ("_task", |v| truth(v.is_check())),
    ("_tool_offset", |v| {
        v.set(
            said::LENGTH,
            truth(v.state.tool_offset.iter().any(|offset| *offset != 0.0)),
        )
    }),
    ("_u", |v| v.state.position()[6]),
    ("_units_per_minute", |v| truth(v.state.feed_mode == FeedMode::PerMinute)),
    ("_units_per_rev", |v| {
        truth(v.state.feed_mode == FeedMode::PerRevolution)
    }),
    ("_v", |v| v.state.position()[7]),
    ("_value", |v| v.store.value),
    ("_value_returned", |v| truth(v.store.returned)),
    ("_vmajor", |_| 2.9),
    ("_vminor", |_| 0.0),
    ("_w", |v| v.state.position()[8]),
    ("_x", |v| v.state.position()[0]),
    ("_y", |v| v.state.position()[1]),
    ("_z", |v| v.state.position()[2]),
];

impl Values<'_> {
    /// What the program has set; before that a check does not know it.
    fn set(&self, bit: u8, value: f64) -> f64 {
        let known = !self.is_check() || self.state.said & bit != 0;
        if known { value } else { f64::NAN }
    }
}

fn truth(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

/// A coordinate of the machine, in program units.
fn machine(values: &Values<'_>, axis: usize) -> f64 {
    exec::to_machine(values.state, &values.state.position())[axis]
}

fn surface_speed(values: &Values<'_>) -> bool {
    let mode = values.state.spindle_mode[0];
    matches!(mode, SpindleMode::ConstantSurface(_))
}

/// 400, 410 or 420; G41.1 and G42.1 are G41 and G42.
fn compensation(values: &Values<'_>) -> f64 {
    match values.state.side {
        Side::Off => 400.0,
        Side::Left => 410.0,
        Side::Right => 420.0,
    }
}

/// 540 for G54 to 593 for G59.3.
fn coordinate_system(index: i32) -> f64 {
    let index = f64::from(index);
    if index <= 6.0 {
        530.0 + 10.0 * index
    } else {
        584.0 + index
    }
}

fn plane(plane: Plane) -> f64 {
    match plane {
        Plane::Xy => 170.0,
        Plane::Xz => 180.0,
        Plane::Yz => 190.0,
        Plane::Uv => 171.0,
        Plane::Uw => 181.0,
        Plane::Vw => 191.0,
    }
}

/// The pocket of a row of the table as it is now; with a random tool changer it is the row itself.
fn pocket(values: &Values<'_>, row: i32) -> f64 {
    if values.setup.random_tool_changer() {
        return f64::from(row);
    }
    let entry = usize::try_from(row).ok().and_then(|row| values.state.tools.get(row));
    entry.map_or(-1.0, |entry| f64::from(entry.pocket))
}

#[cfg(test)]
mod tests {
    use super::NAMES;

    #[test]
    fn names_are_in_order() {
        assert!(NAMES.is_sorted_by(|a, b| a.0 < b.0));
    }
}
