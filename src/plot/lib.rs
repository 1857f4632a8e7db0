//! Floor 6: pictures. What a machine does in a program, as SVG that a machinist can read: axes with units, limits, blocks to look at.
//!
//! It does not know files, rules or terminals: records of legs and marks come in, text goes out.
mod axis_plane;
mod canvas;
mod dash;
mod deviation;
mod feed;
mod grid;
mod height_map;
mod isometric;
mod joints;
mod labels;
mod marks;
mod net;
mod path;
mod record;
mod route;
mod runs;
mod scale;
mod servo;
#[cfg(test)]
mod texts;
mod thin;
mod unit;

pub use axis_plane::axis_plane;
pub use canvas::{Header, PlotError};
pub use deviation::deviation;
pub use feed::feed;
pub use height_map::height_map;
pub use joints::{Along, joints};
pub use path::path;
pub use record::{AxisLetters, Block, Mark, PlannedFeed, Record, Recorder, Sample, Shows};
pub use route::route;
pub use servo::{ServoSpot, servo};
pub use unit::Unit;
