//! What the declared uncertainty of an axis does to the tip (PIVOT-SENS, kinematics notes 5): first order, worst direction.
//!
//! A control that believes a rotary axis to pass through c while it passes through c + dc, and that was zeroed with the axis at zero,
//! misses the tip by (I - R) dc, whose length is at most 2 |sin(q/2)| |dc|. An axis that is tilted by a small angle e about a line
//! across it misses by (I - R)(w) x (R v), at most 2 |sin(q/2)| e r for a tip at the distance r from the axis' point. Turns of the axes
//! nearer to the workpiece keep both lengths. The errors of several axes add up at worst.
use crate::{AxisKind, Joints, Limits, Machine};
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{rotate, sin};

/// Above this the uncertainty is worth a word, mm (kinematics notes 5, PIVOT-SENS).
pub const PIVOT_SENSITIVITY: f64 = 0.02;

/// What the uncertainty of one rotary axis does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisUncertainty {
    /// Letter.
    pub letter: u8,
    /// How far the tip may be off, mm.
    pub tip_mm: f64,
    /// The part of it that comes from the axis' point, mm; the rest grows with the distance of the tip.
    pub of_point_mm: f64,
}

/// How far the tip may be off at given joints, for each rotary axis with a declared uncertainty; the errors add up at worst. Empty where
/// none is declared. mm and rad; `tool_length` in mm.
pub fn pivot_sensitivity(machine: &Machine, joints: &Joints, tool_length: f64) -> Vec<AxisUncertainty> {
    let mut point = machine.home.gauge_point - machine.home.tool_axis * tool_length;
    let mut found = Vec::new();
    for (axis, value) in machine.axes.iter().zip(joints).rev() {
        match axis.kind {
            AxisKind::Linear => point += axis.direction * (axis.sign * value),
            AxisKind::Rotary => {
                let arm: Vec3 = point - axis.point;
                let turn = 2.0 * sin(value * 0.5).abs();
                let of_point_mm = turn * axis.extra.point_uncertainty.unwrap_or(0.0);
                let of_direction = turn * axis.extra.direction_uncertainty.unwrap_or(0.0) * arm.norm();
                if axis.extra.point_uncertainty.is_some() || axis.extra.direction_uncertainty.is_some() {
                    found.push(AxisUncertainty {
                        letter: axis.letter,
                        tip_mm: of_point_mm + of_direction,
                        of_point_mm,
                    });
                }
                point = rotate(&axis.direction, axis.sign * value, &arm) + axis.point;
            }
        }
    }
    found.reverse();
    found
}

/// The worst of one rotary axis inside its travel, for a tip at the distance `arm` from the axis' point, mm; `None` where no uncertainty
/// is declared.
pub fn worst_pivot_error(machine: &Machine, joint: usize, arm: f64) -> Option<f64> {
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
