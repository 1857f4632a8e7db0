//! Where coordinates count from.
use crate::{AXIS_LETTERS, Undeclared};
use std::sync::Arc;

/// The zero point in effect.
#[derive(Clone, Debug, PartialEq)]
pub struct Zero {
    offset: Option<Arc<str>>,
    values: [f64; 9],
    undeclared: u16,
    set_here: bool,
    is_lost: bool,
}

impl Default for Zero {
    fn default() -> Self {
        Self {
            offset: None,
            values: [0.0; AXIS_LETTERS.len()],
            undeclared: Undeclared::ALL_ZEROS,
            set_here: false,
            is_lost: false,
        }
    }
}

impl Zero {
    /// Name of the active work offset.
    pub fn offset(&self) -> Option<&str> {
        self.offset.as_deref()
    }
    /// The same, shared.
    pub fn offset_name(&self) -> Option<Arc<str>> {
        self.offset.clone()
    }
    /// Where the zero point is, mm and degrees, machine coordinates.
    pub fn values(&self) -> [f64; 9] {
        self.values
    }
    /// Axes whose zero point is not declared, bits as in [`crate::Position::known`].
    pub fn undeclared(&self) -> u16 {
        self.undeclared
    }
    /// It was set from where the machine stood (G92).
    pub fn is_set_here(&self) -> bool {
        self.set_here
    }
    /// Coordinates are in a frame that is not modelled (G68.2, CYCLE800, TRANS): motions have unknown X Y Z.
    pub fn is_lost(&self) -> bool {
        self.is_lost
    }
    /// A work offset comes into force; `undeclared`: see [`Self::undeclared`].
    pub fn choose(&mut self, offset: Option<Arc<str>>, undeclared: u16) {
        (self.offset, self.undeclared) = (offset, undeclared);
    }
    /// It is declared where all axes have their zero point.
    pub fn declare_all(&mut self) {
        self.undeclared = 0;
    }
    /// The values with all shifts, mm and degrees.
    pub fn set(&mut self, values: [f64; 9]) {
        self.values = values;
    }
    /// Whether it was set from where the machine stood.
    pub fn set_here(&mut self, is_set: bool) {
        self.set_here = is_set;
    }
    /// Whether coordinates are in a frame that is not modelled.
    pub fn lose(&mut self, is_lost: bool) {
        self.is_lost = is_lost;
    }
    /// Equal, where an unknown number equals an unknown number.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        let pairs = self.values.iter().zip(&other.values);
        (&self.offset, self.undeclared, self.set_here, self.is_lost)
            == (&other.offset, other.undeclared, other.set_here, other.is_lost)
            && pairs.into_iter().all(|(a, b)| super::alike(Some(*a), Some(*b)))
    }
}
