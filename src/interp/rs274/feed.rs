//! The feed of a motion, from the rate that the control set for it.
use super::bridge::{Bridge, LINEAR_AXES};
use crate::{Feed, Position, Sink};
use trunnion_ngc::{At, Side, State, Units};

/// F as the control takes it: along X Y Z U V W mm, where only A B C move degrees, per minute or per revolution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rate {
    pub(super) mm: f64,
    pub(super) deg: f64,
}

/// The lowest feed of the control under G93, program units per minute.
const SLOWEST_INVERSE_TIME: f64 = 0.1;

/// Rounding of a coordinate that passes through offsets and units, mm or deg.
const ROUNDING: f64 = 1e-9;

/// What a motion moves.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Moves {
    Linear,
    RotaryOnly,
    /// Not known: a coordinate is not.
    Unknown,
}

impl<S: Sink> Bridge<'_, '_, '_, S> {
    /// Whether one of the axes moves on the path to `end`, machine coordinates.
    fn any_moves(&self, axes: &[usize], end: &Position, state: &State) -> Option<bool> {
        let mut found = Some(false);
        for &axis in axes {
            match (self.calls.machine.get(axis), end.get(axis)) {
                (Some(from), Some(to)) if (from - to).abs() > ROUNDING => return Some(true),
                (Some(_), Some(_)) => {}
                // an axis that was unknown and is not named stays where it is
                (None, None) if state.named_axes & (1 << axis) == 0 => {}
                _ => found = None,
            }
        }
        found
    }

    fn moves(&self, end: &Position, state: &State) -> Moves {
        let linear = self.any_moves(&LINEAR_AXES, end, state);
        match (linear, self.any_moves(&[3, 4, 5], end, state)) {
            (Some(true), _) | (_, Some(false)) => Moves::Linear,
            (Some(false), Some(true)) => Moves::RotaryOnly,
            _ => Moves::Unknown,
        }
    }

    /// The feed of a feed motion to `end` (machine coordinates) as the control set it; `curve`: along an arc or a spline, which runs
    /// on also where it ends in the place where it began.
    pub(super) fn feed(&mut self, end: &Position, curve: bool, at: At, state: &State) -> Feed {
        let rate = match (self.calls.synced, self.calls.rate) {
            (Some(pitch), _) => Some(pitch),
            (None, rate) => rate,
        };
        let Some(rate) = rate else { return Feed::Unknown };
        let per_revolution = self.calls.synced.is_some() || self.calls.per_revolution;
        let inverse_time = state.feed_mode == trunnion_ngc::FeedMode::InverseTime && !per_revolution;
        // the rate is that of the contour: the path of the cutter's centre takes longer or shorter than 1/F
        let slowest = rate.deg <= SLOWEST_INVERSE_TIME;
        if inverse_time && state.side == Side::Off && !slowest && state.inverse_time > 0.0 {
            return Feed::InverseTime(state.inverse_time);
        }
        if rate.deg.is_nan() || rate.deg <= 0.0 {
            return Feed::Unknown;
        }
        let moves = if curve || state.units == Units::Millimetre {
            Moves::Linear
        } else {
            self.moves(end, state)
        };
        match moves {
            Moves::Linear if per_revolution => Feed::PerRevolution(rate.mm),
            Moves::Linear => Feed::PerMinute(rate.mm),
            Moves::RotaryOnly if !per_revolution => Feed::PerMinute(rate.deg),
            Moves::RotaryOnly | Moves::Unknown => {
                let what = "F in inch: it is not known whether it means degrees or inches in this block".to_owned();
                self.not_modelled(at, 0..=0, what);
                Feed::Unknown
            }
        }
    }
}
