//! The modal state: what is in effect between blocks.
use crate::{Action, Orientation, Plane, Position, Tool, ToolShape, Undeclared};
use std::sync::Arc;

/// What F means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// G94.
    PerMinute,
    /// G95.
    PerRevolution,
    /// G93.
    InverseTime,
}

/// Which tool's length is compensated. It distinguishes lengths that are not declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum LengthOf {
    /// None is in effect.
    #[default]
    Nothing,
    /// That of the tool with this number; `None`: of a tool in use whose number is unknown.
    Tool(Option<u32>),
    /// One that belongs to no tool (another edge than the first, a sum of several), or whose number could not be read.
    Other,
}

impl core::fmt::Display for LengthOf {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Nothing => f.write_str("none"),
            Self::Tool(Some(number)) => write!(f, "that of tool {number}"),
            Self::Tool(None) => f.write_str("that of the tool in use"),
            Self::Other => f.write_str("one that belongs to no tool"),
        }
    }
}

/// What is in effect between blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalState {
    /// Motion code in effect (`Rapid`, `Linear`, arcs, `CannedCycle`, `NotModelled`), `None` before the first.
    pub motion: Option<Action>,
    /// Plane.
    pub plane: Plane,
    /// G91.
    pub incremental: bool,
    /// Arc centres absolute.
    pub arc_centre_absolute: bool,
    /// The program or the setup has set whether lengths are mm or inch.
    pub units_said: bool,
    /// mm per programmed length unit: 1 or 25.4.
    pub length_unit_mm: f64,
    /// mm per length unit of F.
    pub feed_unit_mm: f64,
    /// Meaning of F.
    pub feed_mode: FeedMode,
    /// F in mm/min, mm/rev or 1/min; `None` before the first, and where its value could not be read.
    pub feed: Option<f64>,
    /// Spindle running.
    pub spindle_on: Option<bool>,
    /// 1/min; `None` before the first S, and under constant cutting speed.
    pub spindle_rpm: Option<f64>,
    /// G96: S is a cutting speed.
    pub surface_speed: bool,
    /// Highest spindle speed that the program allows (G50 S, G92 S), 1/min; NaN where its value could not be read.
    pub spindle_limit_rpm: Option<f64>,
    /// Active work offset's name.
    pub work_offset: Option<Arc<str>>,
    /// Its values, mm and degrees.
    pub zero: [f64; 9],
    /// Which of zero point and tool length is undeclared.
    pub undeclared: Undeclared,
    /// Tool in the spindle; `None`: unknown, or selected by a name.
    pub tool: Option<u32>,
    /// Tool prepared by T, waiting for M6.
    pub tool_prepared: Option<u32>,
    /// What is declared about the tool in use: merged from the run's setup, the program's comments and CUTTER.
    pub tool_data: Option<Tool>,
    /// Compensated tool length, mm; `None` = off.
    pub tool_length_mm: Option<f64>,
    /// Whose that is.
    pub length_of: LengthOf,
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
    /// Coordinates are in a frame that is not modelled (G68.2, CYCLE800, TRANS): motions have unknown X Y Z.
    pub frame_unknown: bool,
    /// Clamps of rotary axes, where the setup names their codes.
    pub clamps: crate::Clamps,
    /// Programmed position.
    pub position: Position,
    /// Last orientation.
    pub orientation: Orientation,
    /// The program end was seen.
    pub ended: bool,
}

impl ModalState {
    /// The size of a unit of length and of a unit of F, mm.
    pub fn units(&mut self, length_mm: f64, feed_mm: f64) {
        (self.length_unit_mm, self.feed_unit_mm) = (length_mm, feed_mm);
        self.units_said = true;
    }
    /// Declared length of the tool in use, mm.
    pub fn own_length_mm(&self) -> Option<f64> {
        self.tool_data?.length_mm
    }
    /// Declared shape of the tool in use, with its diameter in mm; `None` where either is not declared.
    pub fn tool_shape(&self) -> Option<(ToolShape, f64)> {
        let tool = self.tool_data?;
        Some((tool.shape?, tool.diameter_mm?))
    }
}
