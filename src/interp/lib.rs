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
mod codes;
mod compensation;
mod core;
mod corner;
mod cycle_motions;
mod cycles;
mod deleted;
mod diameter;
mod directive;
mod drawing;
mod dwell;
mod effects;
mod emit;
mod engine;
mod feed_speed;
mod flow;
mod frames;
mod iso;
mod klartext;
mod leader;
mod length_change;
mod machine_words;
mod macro_b;
mod memory;
mod named_words;
mod offsets;
mod orientation;
mod osp;
mod own;
mod program_bounds;
mod reader;
mod reported;
mod returns;
mod rotary_way;
mod rs274;
mod run;
mod sinumerik;
mod spin;
mod standing;
mod start;
mod system;
mod tcp;
mod tools;
mod travel;

mod unknown;
mod unmodelled;
mod unused;
mod values;
mod words;
mod written;

pub use apt::{IgnoredRecords, ignored_records};
pub use deleted::{deleted_levels, slash};
pub use directive::{Directive, directives, may_declare_obstacles, turned_deg};
/// The name under which the zero point is declared that is in effect where no work offset or preset is chosen.
pub const UNNAMED_ZERO: &str = "G500";

pub use effects::Situation;
pub use klartext::{SentenceWord, sentence_words};
pub use leader::leader;
pub use program_bounds::{is_program_end, program_bound};
pub use returns::{block_numbers, is_block_number, may_return_to_numbers};
pub use run::{Interpreter, run};
pub use start::{declared_at_power_on, power_on_state};
pub use trunnion_ngc::is_stored_global;
pub use trunnion_vocabulary::{
    AXIS_LETTERS, AllClampCodes, Argument, AxisLetter, Beside, ChainId, ChamferLength, Clamp, ClampCodes, Clamps,
    ControlData, DrillingAxis, Effect, Fault, FaultKind, Feed, FeedMode, Files, Frame, FrameAngles, HolePlaces,
    ImplicitDecimals, Lacks, LengthOf, LengthUnit, Library, Limits, Loaded, ModalState, Motion, MotionKind,
    NamedVariables, Nose, Orientation, OuterCorner, Placed, Position, Posture, ProgramRun, Progress, Reach, Refusal,
    RollPitchYaw, RotaryTurn, RoughingEscape, ScaledAxes, Searched, Setup, Sink, Spin, SplineReading, Swivel, TcpCodes,
    TcpMistake, Tilt, Tool, ToolLength, ToolOffsets, ToolShape, Undeclared, UnknownName, Value, Ways, WorkOffset,
    is_left, same_number,
};
pub use written::canonical_text;
