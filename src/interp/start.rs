//! The modal state before the first block.
use crate::{FeedMode, LengthOf, ModalState, Orientation, Position, Undeclared};
use trunnion_dialect::{Dialect, Plane};
use trunnion_syntax::Format;

/// The modal state before the first block: the position is unknown, lengths are mm, F is per minute, on a lathe per revolution.
pub(crate) fn at_start(dialect: &Dialect) -> ModalState {
    ModalState {
        motion: dialect.quirks.motion_at_start,
        // a lathe's plane at power-on is G18 (Fanuc Series 30i operator's manual, lathe system, G code list)
        plane: if dialect.quirks.diameter { Plane::Zx } else { Plane::Xy },
        incremental: false,
        arc_centre_absolute: false,
        units_said: false,
        length_unit_mm: 1.0,
        feed_unit_mm: 1.0,
        // of a lathe, parameter 3402.4 (FPM) as delivered: per turn
        feed_mode: if dialect.quirks.diameter {
            FeedMode::PerRevolution
        } else {
            FeedMode::PerMinute
        },
        feed: None,
        spindle_on: None,
        spindle_rpm: None,
        surface_speed: false,
        spindle_limit_rpm: None,
        work_offset: None,
        zero: [0.0; 9],
        undeclared: Undeclared {
            zero: Undeclared::ALL_ZEROS,
            length: false,
            set_here: false,
        },
        tool: None,
        tool_prepared: None,
        tool_data: None,
        tool_length_mm: None,
        length_of: LengthOf::Nothing,
        // CL data say where the tool's tip is
        tcp: dialect.lex.format == Format::Apt,
        great_circle: None,
        vector_mode: false,
        multax: false,
        compensation: 0,
        frame_unknown: false,
        clamps: crate::Clamps::default(),
        position: Position::default(),
        orientation: Orientation::Words,
        ended: false,
    }
}
