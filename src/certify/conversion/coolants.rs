//! Which coolant flows: what was requested, and what a tool change or a stop leaves of it.
use super::Reading;
use super::ask::Coolant;
use core::fmt;
use trunnion_dialect::Dialect;
use trunnion_syntax::Format;

/// One kind of coolant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Off,
    On,
    /// It was on before a tool change or a stop, and the machine decides whether it still is.
    Left,
}

/// What becomes of the coolant in a tool change or a stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AtStop {
    Stays,
    Stops,
    /// The machine builder, or the postprocessor, decides.
    Left,
}

impl AtStop {
    /// The same where the stop depends on a switch.
    pub(super) fn perhaps(self) -> Self {
        match self {
            Self::Stays => Self::Stays,
            Self::Stops | Self::Left => Self::Left,
        }
    }
}

/// Neither a tool change nor a stop of these languages ends the coolant; a conversion restates it after them.
fn keeps(dialect: &Dialect) -> bool {
    dialect.lex.format == Format::Apt || dialect.quirks.rs274()
}

/// In a tool change: as the interpreter has it for the control.
pub(super) fn after_tool_change(reading: &Reading) -> AtStop {
    let Some(dialect) = trunnion_dialect::builtin(&reading.dialect) else {
        return AtStop::Left;
    };
    let quirks = &dialect.quirks;
    if keeps(dialect) || quirks.tool_word.changes() {
        AtStop::Stays
    } else if quirks.tool_change_stops_spindle {
        AtStop::Stops
    } else {
        AtStop::Left
    }
}

/// In a stop for the operator (M0).
pub(super) fn after_stop(reading: &Reading) -> AtStop {
    let Some(dialect) = trunnion_dialect::builtin(&reading.dialect) else {
        return AtStop::Left;
    };
    let quirks = &dialect.quirks;
    if keeps(dialect) {
        AtStop::Stays
    } else if dialect.lex.format == Format::Klartext || quirks.program_stop_stops_spindle {
        AtStop::Stops
    } else {
        AtStop::Left
    }
}

/// Flood, mist, through the spindle and air.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Coolants([State; 4]);

const NAMES: [&str; 4] = ["flood", "mist", "through the spindle", "air"];

impl Coolants {
    pub(super) fn set(&mut self, coolant: Coolant) {
        match coolant {
            Coolant::Flood => self.0[0] = State::On,
            Coolant::Mist => self.0[1] = State::On,
            Coolant::Thru => self.0[2] = State::On,
            Coolant::Air => self.0[3] = State::On,
            Coolant::ThruOff => self.0[2] = State::Off,
            Coolant::Off => *self = Self::default(),
        }
    }

    /// A tool change or a stop has come.
    pub(super) fn stopped(&mut self, at: AtStop) {
        for state in self.0.iter_mut().filter(|state| **state != State::Off) {
            match at {
                AtStop::Stays => {}
                AtStop::Stops => *state = State::Off,
                AtStop::Left => *state = State::Left,
            }
        }
    }
}

impl fmt::Display for Coolants {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named = |wanted: State| {
            let all = self.0.iter().zip(NAMES).filter(|(state, _)| **state == wanted);
            all.map(|(_, name)| name).collect::<Vec<_>>().join(" and ")
        };
        let (on, left) = (named(State::On), named(State::Left));
        match (on.is_empty(), left.is_empty()) {
            (true, true) => f.write_str("off"),
            (false, true) => f.write_str(&on),
            (true, false) => write!(f, "{left} as the tool change or stop before leaves it"),
            (false, false) => write!(f, "{on}, and {left} as the tool change or stop before leaves it"),
        }
    }
}
