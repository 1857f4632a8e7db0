//! Floor 3: blocks to motions. A pure fold of blocks through a modal state; the result is a stream of [`Motion`]s and
//! [`Fault`]s (facts, not words).
//!
//! It does not know machines: a [`Motion`] says what is programmed, not what joints do.
mod adjust;
mod apt;
mod apt_effects;
mod apt_motion;
mod apt_tool;
mod arc;
mod clamps;
mod codes;
mod compensation;
mod corner;
mod cycles;
mod directive;
mod dwell;
mod effect;
mod effects;
mod emit;
mod fault;
mod flow;
mod frames;
mod iso;
mod macro_b;
mod memory;
mod modal;
mod motion;
mod offsets;
mod orientation;
mod own;
mod reader;
mod rs274;
mod run;
mod setup;
mod sinumerik;
mod system;
mod tcp;
mod tools;
mod travel;
mod unmodelled;
mod unused;
mod values;
mod words;
mod written;

pub use clamps::{AllClampCodes, Clamp, ClampCodes, Clamps};
pub use directive::{Directive, directives};
pub use effect::{Argument, Effect, Placed, Value, same_number};
pub use fault::{Fault, FaultKind, Refusal, TcpMistake};
pub use modal::{FeedMode, LengthOf, ModalState};
pub use motion::{AXIS_LETTERS, AxisLetter, Feed, Motion, MotionKind, Orientation, Position, Posture, Swivel, Tilt};
pub use run::{Interpreter, Sink, run};
pub use setup::{
    ControlData, Files, ImplicitDecimals, LengthUnit, Library, Limits, Loaded, OuterCorner, RollPitchYaw,
    RoughingEscape, Setup, TcpCodes, Tool, ToolShape, WorkOffset,
};
pub use trunnion_flow::{ChainId, Frame};
pub use written::canonical_text;
