//! Positions of a machine that its control knows, for people.
use crate::Control;
use trunnion_interp::{AXIS_LETTERS, DrillingAxis, Position, RoughingEscape};

/// Reference points, and the retracts of drilling cycles.
pub(crate) fn places(control: &Control) -> Vec<String> {
    let mut lines = Vec::new();
    let place = |point: &Position| {
        let axes = AXIS_LETTERS.iter().enumerate();
        let known = axes.filter_map(|(axis, letter)| Some(format!("{}{}", char::from(*letter), point.get(axis)?)));
        known.collect::<Vec<_>>().join(" ")
    };
    for (kind, points) in [
        ("reference", &control.reference_points),
        ("fixed", &control.fixed_points),
    ] {
        for (index, point) in points.iter().flatten().enumerate() {
            lines.push(format!("{kind} point {} is {} (mm and deg)", index + 1, place(point)));
        }
    }
    if let Some(point) = &control.tool_change {
        let moves = if point.known == 0 {
            "moves no axis".to_owned()
        } else {
            format!("ends at {} (mm and deg) and moves no other axis", place(point))
        };
        lines.push(format!("a tool change (M6) {moves}"));
    }
    if let Some(codes) = &control.power_on {
        lines.push(format!("in effect at power-on: {}", codes.join(" ")));
    }
    let retracts = [
        (
            "a rapid back into a deep hole (G83) ends",
            control.peck_clearance_mm,
            "above its last depth",
        ),
        (
            "a chip is broken (G73) by a retract of",
            control.chip_break_retract_mm,
            "",
        ),
        (
            "a roughing cycle in one block (G71, G72) goes off its cuts by",
            control.roughing_retract_mm,
            "",
        ),
        (
            "a threading cycle in one block (G76) cuts at least",
            control.thread_least_cut_mm,
            "deep",
        ),
        (
            "a threading cycle in one block (G76) leaves its last cut",
            control.thread_finish_mm,
            "",
        ),
        (
            "the arcs that the control makes of a spline (G5) are from the curve at most",
            control.spline_arcs_mm,
            "",
        ),
    ];
    for (what, value, rest) in retracts {
        if let Some(value) = value {
            lines.push(format!("{what} {value} mm {rest}").trim_end().to_owned());
        }
    }
    lines.extend(control.main_spindle.map(main_spindle));
    lines.extend(control.drilling_axis.map(drills));
    if let Some(escape) = control.roughing_escape {
        let how = match escape {
            RoughingEscape::Feed => "at the feed",
            RoughingEscape::Rapid => "in rapid",
        };
        lines.push(format!("a turning tool leaves the cuts of G71 and G72 {how}"));
    }
    if let Some(leads) = control.thread_pull_out {
        lines.push(format!(
            "a thread of one pass (G92) is left {leads} leads before its end"
        ));
    }
    lines
}

/// Which spindle S and M without a number belong to.
fn main_spindle(number: u32) -> String {
    format!("spindle {number} is the main spindle (S{number}=, M{number}=)")
}

/// Along which axis drilling cycles drill.
fn drills(axis: DrillingAxis) -> String {
    let which = match axis {
        DrillingAxis::Z => "Z",
        DrillingAxis::AcrossPlane => "the axis across the plane",
    };
    format!("in G18 and G19 drilling cycles drill along {which}")
}
