//! Floor 2: what a LinuxCNC program does, exactly: bytes to canonical calls, or to the error the control gives.
//!
//! It knows neither dialect tables nor machines. A value that is unknown (the start position in a check, a probed point)
//! is NaN and stays so through all arithmetic.
mod block;
mod canon;
mod comment;
mod comp;
mod cycles;
mod engine;
mod error;
mod exec;
mod flow;
mod parameters;
mod print;
mod read;
mod setup;
mod source;
mod state;
mod tool_rows;

pub use block::{Block, G_GROUPS, M_GROUPS, OwnCode};
pub use canon::{Canon, Coolant, MotionMode, Pose, Side, SpindleTurn, Stop, Switch, SyncedFeed};
pub use engine::{At, ChainId, Engine, Frame, Sink, Step};
pub use error::{Error, Missing, Problem};
pub use flow::Refused;
pub use parameters::is_stored_global;
pub use print::Listing;
pub use setup::{BadLine, Ini, Parameters, Setup, Start, ToolEntry, ToolTable};
pub use source::{FileId, Source};
pub use state::{CycleWords, DistanceMode, Plane, RetractMode, SpindleMode, State, Units};
pub use tool_rows::ToolRows;
pub use trunnion_vocabulary::{FeedMode, Files, Limits, Loaded, Refusal as Class, Searched};
