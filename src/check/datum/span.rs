//! The range of a joint while part of its position is not declared.
use super::{Missing, OffsetName};
use trunnion_interp::{ChainId, LengthOf};
use trunnion_syntax::BlockId;

/// The undeclared values that a joint's position depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Basis {
    pub(super) offset: Option<OffsetName>,
    pub(super) length: Option<LengthOf>,
}

impl Basis {
    /// All of it is declared.
    pub(super) fn is_declared(&self) -> bool {
        self.offset.is_none() && self.length.is_none()
    }
    /// The cause under which it is reported: the offset, else the length.
    pub(super) fn missing(&self) -> Missing {
        match (self.offset, self.length) {
            (Some(offset), _) => Missing::Offset(offset),
            (None, length) => Missing::Length(length.unwrap_or_default()),
        }
    }
}

/// Lowest and highest value, mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    low: f64,
    high: f64,
}

impl Range {
    const EMPTY: Self = Self {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
    };
    pub(super) fn includes(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }
    pub(super) fn add(&mut self, low: f64, high: f64) {
        self.low = self.low.min(low);
        self.high = self.high.max(high);
    }
    pub(super) fn width(&self) -> f64 {
        self.high - self.low
    }
    /// What may be added to it so that it stays within `travel`; `None`: nothing.
    pub(super) fn room(&self, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
        let room = [from - self.low, to - self.high];
        (room[0] <= room[1]).then_some(room)
    }
}

/// Where a joint is while it depends on one basis, with that basis taken as zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) joint: usize,
    pub(super) basis: Basis,
    /// Block and calls of the first motion.
    pub(super) place: (BlockId, ChainId),
    /// Where it is certainly.
    pub(super) certain: Range,
    /// The same, and where it may be.
    pub(super) possible: Range,
    /// The widest it has been, mm.
    pub(super) worst: f64,
    /// Some motions run beside the programmed path by an amount that is not computed.
    pub(super) beside: bool,
}

impl Span {
    pub(super) fn new(joint: usize, basis: Basis, place: (BlockId, ChainId)) -> Self {
        Self {
            joint,
            basis,
            place,
            certain: Range::EMPTY,
            possible: Range::EMPTY,
            worst: 0.0,
            beside: false,
        }
    }
}
