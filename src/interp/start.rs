//! The modal state before the first block.
use crate::{FeedMode, ModalState, Orientation, Position};
use trunnion_dialect::{Dialect, Plane};
use trunnion_syntax::Format;
use trunnion_vocabulary::{Coordinates, FeedWord, Spindle, ToolAxis, ToolInUse, ToolLength, Zero};

/// The modal state before the first block: the position is unknown, lengths are mm, F is per minute, on a lathe per revolution.
pub(crate) fn at_start(dialect: &Dialect) -> ModalState {
    let mut tool_axis = ToolAxis::default();
    // CL data say where the tool's tip is
    tool_axis.set_tcp(dialect.lex.format == Format::Apt);
    ModalState {
        motion: dialect.quirks.motion_at_start,
        // a lathe's plane at power-on is G18 (Fanuc Series 30i operator's manual, lathe system, G code list)
        coordinates: Coordinates::new(if dialect.quirks.diameter { Plane::Zx } else { Plane::Xy }),
        // of a lathe, parameter 3402.4 (FPM) as delivered: per turn
        feed: FeedWord::new(if dialect.quirks.diameter {
            FeedMode::PerRevolution
        } else {
            FeedMode::PerMinute
        }),
        spindle: Spindle::default(),
        zero: Zero::default(),
        tool: ToolInUse::default(),
        length: ToolLength::default(),
        tool_axis,
        compensation: 0,
        clamps: crate::Clamps::default(),
        position: Position::default(),
        orientation: Orientation::Words,
        ended: false,
    }
}
