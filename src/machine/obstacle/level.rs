//! How high rapid motions go across the tool. What lies below the level of a program's rapids is not declared, and may be anything.
use super::linear_steps;
use crate::{Leg, Machine, RapidPath, Stance, forward};
use trunnion_geometry::Vec3;

/// Tool axes that differ by no more are the same.
const PARALLEL: f64 = 1e-9;

/// A motion that goes no farther across the tool runs along it, mm.
const ALONG_MM: f64 = 1e-6;

/// Where a motion runs as seen along a tool that does not turn, heights in the workpiece frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across {
    /// Height of the tip at the start and at the end, mm.
    pub heights: [f64; 2],
    /// The lowest height that the tip may pass, where axes do not certainly arrive together, too, mm.
    pub lowest: f64,
    /// It may go sideways.
    pub sideways: bool,
}

impl Across {
    /// Of a motion with this tool length (mm); `None` where an end is not known or the tool turns.
    pub fn of(machine: &Machine, leg: &Leg, tool_length: f64) -> Option<Self> {
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            return None;
        };
        let axis = end.axis;
        if (start.axis - axis).norm() > PARALLEL {
            return None;
        }
        let [from, to] = [start, end].map(|stance| forward(machine, &stance.joints, tool_length).tip);
        let steps: Vec<Vec3> = if machine.control.rapid == RapidPath::Synchronous {
            vec![to - from]
        } else {
            linear_steps(machine, (&start.joints, &end.joints), tool_length, 0).collect()
        };
        let heights = [from, to].map(|tip| axis.dot(&tip));
        let sunk: f64 = steps.iter().map(|step| axis.dot(step).min(0.0)).sum();
        Some(Self {
            heights,
            lowest: (heights[0] + sunk).min(heights[1]),
            sideways: steps
                .iter()
                .any(|step| (step - axis * axis.dot(step)).norm() > ALONG_MM),
        })
    }
}

/// The highest level at which rapid motions one after the other went sideways with one tool in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TravelLevel {
    axis: Vec3,
    tool_length: f64,
    height: Option<f64>,
}

impl TravelLevel {
    /// With one more motion. Motions with another tool length or another tool axis do not count any more. A motion from an unknown place counts for nothing.
    pub fn extended(before: Option<Self>, machine: &Machine, leg: &Leg) -> Option<Self> {
        let Ok(end) = &leg.end else {
            return before;
        };
        let known = before.filter(|known| known.is_of(end));
        let mut level = known.unwrap_or(Self {
            axis: end.axis,
            tool_length: end.tool_length,
            height: None,
        });
        if let Some(across) = Across::of(machine, leg, end.tool_length).filter(|across| across.sideways) {
            let [from, to] = across.heights;
            let high = from.max(to);
            level.height = Some(level.height.map_or(high, |known| known.max(high)));
        }
        Some(level)
    }

    /// Whether the tool is still the same, in the same direction.
    pub fn is_of(&self, stance: &Stance) -> bool {
        (self.axis - stance.axis).norm() <= PARALLEL && self.tool_length.to_bits() == stance.tool_length.to_bits()
    }

    /// The height along the tool, mm, in the workpiece frame; `None`: nothing went sideways.
    pub fn height(&self) -> Option<f64> {
        self.height
    }

    /// The length of the tool with which heights are measured, mm.
    pub fn tool_length(&self) -> f64 {
        self.tool_length
    }
}
