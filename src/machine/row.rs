//! One row of a trace: what the machine does in one motion, in the units people read.
use crate::{Leg, Machine};
use trunnion_syntax::BlockId;

/// One row; see the interface's section on `trace`. mm, deg, mm/min, s.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Block.
    pub block: BlockId,
    /// rapid, linear, arc, dwell, unknown.
    pub motion: &'static str,
    /// TCP on.
    pub tcp: bool,
    /// Tip in the workpiece frame.
    pub tip_mm: Option<[f64; 3]>,
    /// Tool axis.
    pub axis: Option<[f64; 3]>,
    /// Programmed feed.
    pub feed_mm_min: Option<f64>,
    /// Duration.
    pub duration_s: Option<f64>,
    /// Posture sign.
    pub branch: Option<i8>,
    /// Angle to the pole at the end of the block.
    pub pole_angle_deg: Option<f64>,
    /// Proven bound.
    pub tip_deviation_mm: Option<f64>,
    /// Highest feed.
    pub feed_limit_mm_min: Option<f64>,
    /// Letter of the limiting axis.
    pub limiting_axis: Option<char>,
    /// Joint values in chain order, mm or deg; `None` where unknown.
    pub joints: Vec<Option<f64>>,
}

/// The row of a leg.
pub fn row(machine: &Machine, leg: &Leg) -> Row {
    let _ = (machine, leg);
    todo!()
}
