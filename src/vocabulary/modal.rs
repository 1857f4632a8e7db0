//! The modal state: what is in effect between blocks. Each part changes its own fields only.
mod coordinates;
mod feed;
mod spindle;
mod tool;
mod tool_axis;
mod zero;

pub use coordinates::Coordinates;
pub use feed::{FeedMode, FeedWord};
pub use spindle::Spindle;
pub use tool::{LengthOf, ToolInUse, ToolLength};
pub use tool_axis::ToolAxis;
pub use zero::Zero;

use crate::{Action, Orientation, Plane, Position, Undeclared};

/// What is in effect between blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalState {
    /// Motion code in effect (`Rapid`, `Linear`, arcs, `CannedCycle`, `NotModelled`), `None` before the first.
    pub motion: Option<Action>,
    /// Plane, distance mode, unit of lengths.
    pub coordinates: Coordinates,
    /// F.
    pub feed: FeedWord,
    /// The main spindle.
    pub spindle: Spindle,
    /// The zero point.
    pub zero: Zero,
    /// The tool.
    pub tool: ToolInUse,
    /// The tool length.
    pub length: ToolLength,
    /// The tool axis.
    pub tool_axis: ToolAxis,
    /// Cutter radius compensation side: 0 off, 41, 42.
    pub compensation: u8,
    /// Whether motions have the path beside the contour while it is active.
    pub beside: Beside,
    /// Clamps of rotary axes, where the setup names their codes.
    pub clamps: crate::Clamps,
    /// Programmed position.
    pub position: Position,
    /// Last orientation.
    pub orientation: Orientation,
    /// The program end was seen.
    pub ended: bool,
}

/// What the motions of a program are while cutter radius compensation is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Beside {
    /// The programmed path: how the tool runs beside it is not modelled.
    #[default]
    NotModelled,
    /// The programmed path: the radius is not declared.
    Radius,
    /// The path of the tool.
    Computed,
}

impl ModalState {
    /// The size of a unit of length and of a unit of F, mm.
    pub fn units(&mut self, length_mm: f64, feed_mm: f64) {
        self.coordinates.set_unit(length_mm, true);
        self.feed.set_unit(feed_mm);
    }
    /// The same of the unit that the control has by itself.
    pub fn own_units(&mut self, length_mm: f64, feed_mm: f64) {
        let programmed = self.coordinates.unit_programmed();
        self.coordinates.set_unit(length_mm, programmed);
        self.feed.set_unit(feed_mm);
    }
    /// Which of zero point, tool length and tool radius is undeclared.
    pub fn undeclared(&self) -> Undeclared {
        let beside = match self.coordinates.plane() {
            _ if self.compensation == 0 || self.beside == Beside::Computed => 0,
            Plane::Xy => 0b011,
            Plane::Zx => 0b101,
            Plane::Yz => 0b110,
        };
        Undeclared {
            beside,
            by_radius: beside != 0 && self.beside == Beside::Radius,
            zero: self.zero.undeclared(),
            length: self.length.is_undeclared(),
            by_turret: match self.length.of() {
                LengthOf::Offset(_) if self.length.is_undeclared() => Undeclared::BY_TURRET,
                _ => 0,
            },
            set_here: self.zero.is_set_here(),
        }
    }
    /// Whether two states are the same, where an unknown number equals an unknown number.
    pub fn is_alike(&self, other: &Self) -> bool {
        let places = self.position.values.iter().zip(&other.position.values);
        let without_numbers = |state: &Self| {
            let mut state = state.clone();
            state.position.values = [0.0; 9];
            (state.feed, state.spindle) = (FeedWord::new(FeedMode::PerMinute), Spindle::default());
            (state.length, state.zero) = (ToolLength::default(), Zero::default());
            state
        };
        without_numbers(self) == without_numbers(other)
            && self.feed.is_alike(&other.feed)
            && self.spindle.is_alike(&other.spindle)
            && self.length.is_alike(&other.length)
            && self.zero.is_alike(&other.zero)
            && places.into_iter().all(|(a, b)| alike(Some(*a), Some(*b)))
    }
}

/// Whether two numbers are the same, both unknown (NaN), or both absent.
fn alike(a: Option<f64>, b: Option<f64>) -> bool {
    a == b || a.is_some_and(f64::is_nan) && b.is_some_and(f64::is_nan)
}
