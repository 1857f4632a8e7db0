//! Floor 3: joints. A chain of linear and rotary axes of any order: forward and inverse kinematics, postures, limits, and
//! what happens between two blocks. Formulas: Trunnion's kinematics notes; each function names its source.
//!
//! It does not know rules, severities or words for people.
mod builtin;
mod chain;
mod deviation;
mod follow;
mod forward;
mod inverse;
mod limits;
mod row;
mod selftest;
mod spec;
mod speed;

pub use builtin::{BUILTIN_MACHINES, builtin};
pub use chain::{Axis, AxisKind, Control, Joints, Limits, Machine, MAX_AXES, Side, Tolerances};
pub use deviation::{Deviation, tip_deviation};
pub use follow::{Follower, Leg, NoStance, Stance};
pub use forward::{Pose, forward};
pub use inverse::{Orientations, Solution, inverse, orientations};
pub use limits::{Excess, limit_excess};
pub use row::{Row, row};
pub use selftest::{SelfTest, self_test};
pub use spec::{MachineError, load};
pub use speed::{FeedLimit, block_duration_s, feed_limit};
