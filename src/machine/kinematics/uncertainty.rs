//! The effect of the declared uncertainty of an axis on the tip (docs/kinematics.md#uncertainty-of-the-rotary-axes): first order, worst direction.
//!
//! A control that believes a rotary axis to pass through c while it passes through c + dc, and that was zeroed with the axis at zero,
//! misses the tip by (I - R) dc, whose length is at most 2 |sin(q/2)| |dc|. An axis that is tilted by a small angle e about a line
//! across it misses by (I - R)(w) x (R v), at most 2 |sin(q/2)| e r for a tip at the distance r from the axis' point. Turns of the axes
//! nearer to the workpiece keep both lengths. The errors of several axes add up at worst.
use crate::{AxisKind, Joints, Limits, Machine};
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{rotate, sin};

/// Above this the uncertainty is reported, mm (kinematics notes 5, PIVOT-SENS).
pub(crate) const PIVOT_SENSITIVITY: f64 = 0.02;

/// The effect of the uncertainty of one rotary axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisUncertainty {
    /// Letter.
    pub letter: u8,
    /// How far the tip may be off, mm.
    pub tip_mm: f64,
    /// The part of it that comes from the axis' point, mm; the rest grows with the distance of the tip.
    pub of_point_mm: f64,
}

/// How far the tip may be off in a block that runs from `start` to `end`, for each rotary axis with a declared uncertainty; the errors add up
/// at worst. For each axis the turn between the two that moves the tip most is used, and the larger of its distances from the tip at both ends.
/// Empty where no uncertainty is declared. mm and rad; `tool_length` in mm.
pub fn pivot_sensitivity_between(
    machine: &Machine,
    start: &Joints,
    end: &Joints,
    tool_length: f64,
) -> Vec<AxisUncertainty> {
    let tool = machine.home.gauge_point - machine.home.tool_axis * tool_length;
    let mut points = [tool; 2];
    let mut found = Vec::new();
    for (joint, axis) in machine.axes.iter().enumerate().rev() {
        let values = [start[joint], end[joint]];
        if axis.kind == AxisKind::Linear {
            for (point, value) in points.iter_mut().zip(values) {
                *point += axis.direction * (axis.sign * value);
            }
            continue;
        }
        let arms = points.map(|point| Vec3::from(point - axis.point));
        if axis.extra.point_uncertainty.is_some() || axis.extra.direction_uncertainty.is_some() {
            let turn = 2.0 * largest_half_sine(values);
            let of_point_mm = turn * axis.extra.point_uncertainty.unwrap_or(0.0);
            let arm = arms[0].norm().max(arms[1].norm());
            found.push(AxisUncertainty {
                letter: axis.letter,
                tip_mm: of_point_mm + turn * axis.extra.direction_uncertainty.unwrap_or(0.0) * arm,
                of_point_mm,
            });
        }
        for ((point, value), arm) in points.iter_mut().zip(values).zip(&arms) {
            *point = rotate(&axis.direction, axis.sign * value, arm) + axis.point;
        }
    }
    found.reverse();
    found
}

/// Largest |sin(q / 2)| for q between two angles: 1 where half a turn (plus any full turns) is between them.
fn largest_half_sine([a, b]: [f64; 2]) -> f64 {
    let (low, high) = (a.min(b), a.max(b));
    // the first odd multiple of pi that is not below `low`
    let crest = PI * (2.0 * ((low / PI - 1.0) * 0.5).ceil() + 1.0);
    if crest <= high {
        1.0
    } else {
        sin(low * 0.5).abs().max(sin(high * 0.5).abs())
    }
}

/// The worst of one rotary axis inside its travel, for a tip at the distance `arm` from the axis' point, mm; `None` where no uncertainty
/// is declared.
pub(crate) fn worst_pivot_error(machine: &Machine, joint: usize, arm: f64) -> Option<f64> {
    let axis = machine.axes.get(joint)?;
    let extra = &axis.extra;
    if axis.kind == AxisKind::Linear || (extra.point_uncertainty.is_none() && extra.direction_uncertainty.is_none()) {
        return None;
    }
    let farthest = match axis.limits {
        Limits::Range(min, max) => min.abs().max(max.abs()).min(PI),
        Limits::Unbounded => PI,
    };
    let turn = 2.0 * sin(farthest * 0.5);
    Some(turn * (extra.point_uncertainty.unwrap_or(0.0) + extra.direction_uncertainty.unwrap_or(0.0) * arm))
}
