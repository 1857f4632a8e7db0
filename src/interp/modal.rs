//! The modal state: what is in force between blocks.
use crate::{Orientation, Position};
use trunnion_dialect::{Action, Plane};

/// How F is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// G94.
    PerMinute,
    /// G95.
    PerRevolution,
    /// G93.
    InverseTime,
}

/// What is in force between blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalState {
    /// Motion code in force (`Rapid`, `Linear`, arcs), `None` before the first.
    pub motion: Option<Action>,
    /// Plane.
    pub plane: Plane,
    /// G91.
    pub incremental: bool,
    /// Arc centres absolute.
    pub arc_centre_absolute: bool,
    /// mm per programmed length unit: 1 or 25.4.
    pub length_unit_mm: f64,
    /// mm per length unit of F.
    pub feed_unit_mm: f64,
    /// Meaning of F.
    pub feed_mode: FeedMode,
    /// F in mm/min, mm/rev or 1/min.
    pub feed: Option<f64>,
    /// Spindle running.
    pub spindle_on: Option<bool>,
    /// 1/min.
    pub spindle_rpm: Option<f64>,
    /// Active work offset's name.
    pub work_offset: Option<String>,
    /// Its values.
    pub zero: [f64; 9],
    /// Tool in the spindle.
    pub tool: Option<u32>,
    /// Tool prepared by T, waiting for M6.
    pub tool_prepared: Option<u32>,
    /// Compensated tool length, mm; `None` = off.
    pub tool_length_mm: Option<f64>,
    /// TCP on.
    pub tcp: bool,
    /// Orientation on great circle.
    pub great_circle: Option<bool>,
    /// G43.5 / APT: vectors are programmed.
    pub vector_mode: bool,
    /// APT MULTAX.
    pub multax: bool,
    /// Cutter radius compensation side: 0 off, 41, 42.
    pub compensation: u8,
    /// Programmed position.
    pub position: Position,
    /// Last orientation.
    pub orientation: Orientation,
    /// The program end was seen.
    pub ended: bool,
}
