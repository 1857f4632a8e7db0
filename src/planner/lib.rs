//! Floor 5: how long the machine takes. Limits of the axes along each motion, a look-ahead planner over them, and times as an interval from optimistic
//! to planned. Units: mm, rad, s. Formulas: docs/kinematics.md#time.
//!
//! It knows no rules and no sentences.
#[cfg(test)]
mod chunks_tests;
mod clock;
mod corner;
#[cfg(test)]
mod limits_tests;
mod linuxcnc;
mod one_move;
mod passes;
mod path;
mod piece;
mod pieces;
mod planner;
mod run;
mod sampled;
mod section;
mod timed;

pub use clock::{Listener, Modes, time};
pub use corner::PathControl;
pub use path::{Ramp, s_curve, trapezoid};
pub use piece::{Bounds, Limit, Piece};
pub use pieces::bend_limit;
pub use planner::Planner;
pub use run::{Begun, Long, Planned, Run, Smooth};
pub use timed::Timed;
