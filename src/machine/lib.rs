//! Floor 4: joints. A chain of linear and rotary axes of any order: forward and inverse kinematics, postures, limits, and
//! what happens between two blocks. Formulas: docs/kinematics.md; each function names its source.
//!
//! It does not know rules or severities; its only words for people are the description of a machine and what is wrong with its file.
mod aim;
mod asked;
mod at;
mod bends;
mod bound;
mod builtin;
mod chain;
mod choice;
mod compare;
mod constants;
mod control;
mod course;
mod describe;
mod deviation;
mod follow;
mod formula;
mod forward;
mod gantry;
mod glance;
mod held;
mod import;
mod inverse;
mod legal;
mod length;
mod limits;
mod lines;
mod memory;
mod nearness;
mod not_used;
mod orientation;
mod pole;
mod posture_rule;
mod raw;
mod reach;
mod row;
mod selftest;
mod sines;
mod spec;
mod speed;
mod spin;
mod stance;
mod straight;
mod stray;
mod swept;
mod text;
mod tip_path;
mod told;
mod travel;
mod uncertainty;
mod unknown;
mod validate;
mod windings;
mod witness;
mod words;

#[cfg(test)]
mod chain_tests;
#[cfg(test)]
mod compare_tests;
#[cfg(test)]
mod fault_tests;
#[cfg(test)]
mod import_tests;
#[cfg(test)]
mod kinematics_tests;
#[cfg(test)]
mod mutant_tests;
#[cfg(test)]
mod oracle_tests;
#[cfg(test)]
mod spec_tests;

pub use asked::{AxisSign, PostureWords};
pub use at::{Moment, Way};
pub use builtin::{BUILTIN_MACHINES, builtin, builtin_source};
pub use chain::{
    Axis, AxisExtra, AxisKind, Body, Control, FeedMeaning, Gantry, Home, Joints, Limits, MAX_AXES, Machine, PoleAction,
    RapidPath, Side, Tolerances, Wrap,
};
pub use compare::{AlongBlock, Comparison, TipDifference};
pub use constants::{Constants, LinearAxis, PairConstants, RotaryAxis};
pub use describe::{AxisDescription, Description, describe};
pub use deviation::{Deviation, tip_deviation};
pub use follow::Follower;
pub use forward::{Pose, forward, tool_axis_at};
pub use glance::{Allowances, Glance, glance};
pub use import::{Imported, import_freecad, import_linuxcnc};
pub use inverse::{Orientations, POLE_TOLERANCE, Postures, REACH_TOLERANCE, Solution, inverse, orientations};
pub use limits::{Excess, limit_excess};
pub use memory::Memory;
pub use nearness::Nearness;
pub use orientation::{OrientationDeviation, orientation_deviation};
pub use posture_rule::{Branch, Criterion, PostureRule};
pub use row::{Row, row};
pub use selftest::{SelfTest, self_test};
pub use sines::{Foresight, Sine};
pub use spec::{MachineError, load};
pub use speed::{FeedLimit, block_duration_s, feed_limit, feed_limit_tight};
pub use spin::{NO_TURN, rotary_turns};
pub use stance::{Leg, NoStance, Open, OpenCause, Stance};
pub use swept::swept_deviation;
pub use travel::{Excursion, LinearTravel, excursions, linear_travel};
pub use uncertainty::{
    AxisUncertainty, PIVOT_SENSITIVITY, pivot_sensitivity, pivot_sensitivity_between, worst_pivot_error,
};
pub use windings::{Windings, pole_angle, rotary_jacobian, solution_s, windings};
