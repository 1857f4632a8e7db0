//! Floor 1: test pieces. Cutter locations of parts with answers in closed form, for any machine.
//!
//! It does not know machines, dialects or text: a piece is a list of tool tips and tool axes in the frame of the part, +Z up. The
//! sizes are our own; no piece claims conformity with a standard.
mod arcs;
mod circles;
mod cone;
mod contour;
mod piece;
mod s_wall;
mod saddle;

pub use arcs::{CircleDiamondSquare, circle_diamond_square};
pub use circles::{TurnedAxes, circle, fixed_tip};
pub use cone::{Cone, ConeAnswers, cone};
pub use contour::{corner_set, staircase};
pub use piece::{Kind, Move, Piece, PieceError, Tool};
pub use s_wall::{SWall, s_wall};
pub use saddle::{SADDLE_SIZE, saddle, saddle_net, saddle_point};
