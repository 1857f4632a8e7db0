//! Floor 1: the types that all floors above share: motions, modal state, effects, faults, set-up, and their receivers.
//!
//! It knows neither dialects nor machines, and runs nothing.
mod action;
mod action_kind;
mod chain;
mod clamps;
mod effect;
mod fault;
mod library;
mod modal;
mod motion;
mod progress;
mod setup;
mod sink;

pub use action::{Action, Plane};
pub use chain::{ChainId, Frame};
pub use clamps::{AllClampCodes, Clamp, ClampCodes, Clamps};
pub use effect::{Argument, Effect, Placed, Reach, Value, is_left, same_number};
pub use fault::{Fault, FaultKind, Lacks, Refusal, TcpMistake, UnknownName};
pub use library::{Files, Limits, Loaded, Searched, Work};
pub use modal::{
    Beside, Coordinates, FeedMode, FeedWord, LengthOf, ModalState, Spindle, ToolAxis, ToolInUse, ToolLength, Zero,
};
pub use motion::{
    AXIS_LETTERS, AxisLetter, Feed, Motion, MotionKind, Orientation, Position, Posture, Spin, Swivel, Tilt, Undeclared,
    Ways,
};
pub use progress::Progress;
pub use setup::{
    ChamferLength, ControlData, DrillingAxis, FrameAngles, HolePlaces, ImplicitDecimals, LengthUnit, Library,
    NamedVariables, Nose, OuterCorner, RollPitchYaw, RotaryTurn, RoughingEscape, ScaledAxes, Setup, SplineReading,
    TcpCodes, Tool, ToolOffsets, ToolShape, WorkOffset,
};
pub use sink::{ProgramRun, Sink};
