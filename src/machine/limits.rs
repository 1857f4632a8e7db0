//! Joints outside their travel, at the end of a block or inside it.
use crate::{Leg, Machine};

/// One joint outside its travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// Index of the axis.
    pub axis: usize,
    /// Worst value, mm or rad.
    pub value: f64,
    /// The limit it breaks, mm or rad.
    pub limit: f64,
    /// Whether it happens inside the block while both ends are legal.
    pub inside: bool,
}

/// All joints outside their travel in this leg (arcs and TCP motion: also between the ends, by bound and subdivision).
pub fn limit_excess(machine: &Machine, leg: &Leg, out: &mut Vec<Excess>) {
    let _ = (machine, leg, out);
    todo!()
}
