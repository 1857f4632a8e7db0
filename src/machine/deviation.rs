//! How far the tip strays from the programmed segment inside a block: sampled value and proven bound.
use crate::{Leg, Machine};

/// Deviation of the tip path from the programmed segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Largest distance found at a sample, mm (never above the truth).
    pub sampled_mm: f64,
    /// Proven upper bound, mm (never below the truth).
    pub bound_mm: f64,
    /// Share of the block, 0..=1, where the largest sample lies.
    pub at: f64,
}

/// Set distance of the tip path to the programmed segment. `tolerance_mm`: the bound may be loose where it already proves
/// this; above it, it is at most 1.2 times the truth. `None`: not modelled (arc with moving rotary axes) or unknown stance.
/// Source: kinematics notes 3.
pub fn tip_deviation(machine: &Machine, leg: &Leg, tolerance_mm: f64) -> Option<Deviation> {
    let _ = (machine, leg, tolerance_mm);
    todo!()
}
