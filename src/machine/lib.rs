//! Floor 4: joints. A chain of linear and rotary axes of any order: forward and inverse kinematics, postures, limits, and
//! what happens between two blocks. Formulas: docs/kinematics.md; each function names its source.
//!
//! It does not know rules or severities; its only texts for people are the description of a machine and the errors of its file.
mod compare;
mod file;
mod follow;
mod import;
mod kinematics;
mod obstacle;
mod path;

pub use compare::{AlongBlock, Comparison, Effort, TipDifference};
pub use file::builtin::{BUILTIN_MACHINES, builtin, builtin_source};
pub use file::describe::{AxisDescription, Description, describe};
pub use file::obstacle::{MOST_OBSTACLES, RawObstacle};
pub use file::spec::{MachineError, load};
pub use follow::checkpoint::Memory;
pub use follow::choice::direction_letter;
pub use follow::follower::Follower;
pub use follow::lookahead::{Lookahead, Sine};
pub use follow::posture_rule::{Branch, Criterion, PostureRule};
pub use follow::requests::{AxisSign, PostureWords};
pub use follow::row::{Row, row};
pub use follow::stance::{Leg, NoStance, Open, OpenCause, Stance};
pub use import::{Imported, import_freecad, import_linuxcnc};
pub use kinematics::chain::{
    Axis, AxisExtra, AxisKind, Body, Control, FeedMeaning, Gantry, Home, Joints, Limits, MAX_AXES, Machine, Planning,
    PoleAction, RapidPath, Side, Tolerances, Wrap,
};
pub use kinematics::constants::{Constants, LinearAxis, RotaryAxis};
pub use kinematics::forward::{Pose, forward, tool_axis, tool_axis_at};
pub use kinematics::inverse::{Orientations, POLE_TOLERANCE, Postures, Solution, inverse, orientations};
pub use kinematics::selftest::{SelfTest, self_test};
pub use kinematics::uncertainty::{AxisUncertainty, pivot_sensitivity_between};
pub use kinematics::windings::{Windings, pole_angle, solution_s, windings};
pub use obstacle::{
    Across, Footprint, Near, Nearness, NoRoute, Obstacle, ObstacleKind, Obstacles, SLACK_MM, Space, ToolBody,
    TravelLevel, column_distance, corridor_distance, linear_steps, nearness, nearness_with_part, tool_in_frame,
};
pub use path::block_path::{BlockPath, Moment};
pub use path::deviation::{Deviation, joint_line_deviation, tip_deviation};
pub use path::feed_meaning::{feed_is_ambiguous, leads_tip, turns, turns_by_diameter};
pub use path::limits::{Excess, LIMIT_SLACK, limit_excess};
pub use path::orientation::{OrientationDeviation, orientation_deviation};
pub use path::quick_bounds::{Allowances, QuickBounds, quick_bounds};
pub use path::rotary_path::{NO_TURN, rotary_turns};
pub use path::rotary_radii::RotaryRadii;
pub use path::singular::passes_singular;
pub use path::speed::{FeedLimit, ShortestTime, block_duration_s, feed_limit, feed_limit_tight, shortest_time};
pub use path::swept::swept_deviation;
pub use path::travel::{Excursion, LinearTravel, excursions, linear_travel};

pub(crate) use kinematics::constants::PairConstants;
