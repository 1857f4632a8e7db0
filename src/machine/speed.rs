//! How fast a block can run, and how long it takes.
use crate::{Leg, Machine};

/// The highest feed of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedLimit {
    /// Highest tip feed at which no axis exceeds its speed at any moment of the block, mm/min; infinite if nothing moves.
    pub feed_mm_min: f64,
    /// Index of the limiting axis.
    pub axis: usize,
    /// Speed that axis has at the programmed feed at its worst moment, mm/s or rad/s; `None` without a known feed.
    pub axis_speed: Option<f64>,
    /// Its limit.
    pub axis_limit: f64,
}

/// The worst moment inside the block. `None`: stance unknown, no length, or no axis that moves has a declared speed.
pub fn feed_limit(machine: &Machine, leg: &Leg) -> Option<FeedLimit> {
    let _ = (machine, leg);
    todo!()
}

/// How long the block takes at the programmed feed, without acceleration, s: lowest and highest (rapid: by the slowest axis;
/// feed: not faster than the axes allow). `None`: unknown.
pub fn block_duration_s(machine: &Machine, leg: &Leg) -> Option<f64> {
    let _ = (machine, leg);
    todo!()
}
