//! The modal state before the first block.
use crate::{Beside, FeedMode, ModalState, Orientation, Position};
use trunnion_dialect::{Action, Code, Dialect, Plane};
use trunnion_syntax::Format;
use trunnion_vocabulary::{ControlData, Coordinates, FeedWord, Spindle, ToolAxis, ToolInUse, ToolLength, Zero};

/// Puts what the machine declares of its control's state at power-on into effect. Codes that the dialect does not have, and those that set
/// nothing here, are left out: only what was put into effect is an assumption that is declared ([`declared_at_power_on`]).
fn power_on(state: &mut ModalState, dialect: &Dialect, control: &ControlData) {
    if dialect.quirks.rs274() {
        // LinuxCNC's own interpreter begins as it does
        return;
    }
    for code in control
        .power_on
        .iter()
        .flatten()
        .filter_map(|name| found(dialect, name))
    {
        match code.action {
            Action::PlaneXy => state.coordinates.set_plane(Plane::Xy),
            Action::PlaneZx => state.coordinates.set_plane(Plane::Zx),
            Action::PlaneYz => state.coordinates.set_plane(Plane::Yz),
            Action::Absolute => state.coordinates.set_incremental(false),
            Action::Incremental => state.coordinates.set_incremental(true),
            Action::Inch if control.units.is_none() => state.units(25.4, 25.4),
            Action::Metric if control.units.is_none() => state.units(1.0, 1.0),
            Action::FeedPerMinute => state.feed.set_mode(FeedMode::PerMinute),
            Action::FeedPerRevolution => state.feed.set_mode(FeedMode::PerRevolution),
            Action::Rapid | Action::Linear => state.motion = Some(code.action),
            _ => {}
        }
    }
}

/// The modal state at power-on: as the machine declares it, else as the dialect says.
pub fn power_on_state(dialect: &Dialect, control: &ControlData) -> ModalState {
    let mut state = at_start(dialect);
    if let Some(unit) = control.units {
        state.units(unit.mm(), unit.mm());
    }
    power_on(&mut state, dialect, control);
    state
}

/// The code of a name in a dialect, as `G17`.
fn found<'d>(dialect: &'d Dialect, name: &str) -> Option<&'d Code> {
    dialect.codes().iter().find(|code| code.id == name)
}

/// Whether the machine declares what is in effect at power-on in the group of these actions, in a code that the dialect has.
pub fn declared_at_power_on(dialect: &Dialect, control: &ControlData, group: &[Action]) -> bool {
    let mut codes = control
        .power_on
        .iter()
        .flatten()
        .filter_map(|name| found(dialect, name));
    !dialect.quirks.rs274() && codes.any(|code| group.contains(&code.action))
}

/// The modal state before the first block: the position is unknown, lengths are mm, F is per minute, on a lathe per revolution.
fn at_start(dialect: &Dialect) -> ModalState {
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
        beside: Beside::default(),
        clamps: crate::Clamps::default(),
        position: Position::default(),
        orientation: Orientation::Words,
        ended: false,
    }
}
