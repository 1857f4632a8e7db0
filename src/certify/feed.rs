//! Feeds that differ: no higher than asked, lower only where an axis needs it, and no axis too fast or, in a bend, beyond its acceleration.
use crate::Outcome;
use trunnion_dialect::RotaryFeed;
use trunnion_interp::Feed;
use trunnion_machine::{Leg, Machine, feed_is_ambiguous, feed_limit_tight, shortest_time};
use trunnion_planner::bend_limit;

/// Why a feed is not proved.
pub(crate) enum Wrong {
    /// It is not as claimed.
    Refuted(String),
    /// That is unknown.
    Unknown(&'static str),
}

impl Wrong {
    /// As an outcome at one motion.
    pub(crate) fn at(self, motion: usize, line: u32) -> Outcome {
        match self {
            Self::Refuted(message) => Outcome::refuted_at(motion, line, message),
            Self::Unknown(message) => Outcome::unknown_at(Some(line), format!("line {line}: {message}")),
        }
    }
}

/// Feeds are numbers as written: they are compared this closely, relative.
const SAME: f64 = 1e-9;

/// Compares the feeds of two legs of the same path. `asked_mm_min`: see [`crate::Claim::AdaptedFeed`].
pub(crate) fn adapted(
    (machine, rotary_feed): (&Machine, RotaryFeed),
    [was, is]: [&Leg; 2],
    asked_mm_min: f64,
) -> Result<(), Wrong> {
    if was.motion.feed == is.motion.feed {
        return Ok(());
    }
    if [was, is].iter().any(|leg| feed_is_ambiguous(machine, rotary_feed, leg)) {
        return Err(Wrong::Unknown(
            "what F means while rotary axes move is a parameter of the control, so the feed must stay unless the machine file declares it: [control] feed = \"xyz\" or \"combined\"",
        ));
    }
    match (was.motion.feed, is.motion.feed) {
        (Feed::PerMinute(old), Feed::PerMinute(new)) => {
            let Some(limit) = feed_limit_tight(machine, is) else {
                return Err(Wrong::Unknown(
                    "the highest feed of the axes is unknown here, so the feed must stay",
                ));
            };
            let limit = limit.feed_mm_min.min(bends(machine, is));
            judge([old, new], limit, asked_mm_min.max(old), "mm/min")
        }
        (Feed::InverseTime(old), Feed::InverseTime(new)) => {
            // blocks per minute: the same comparison, with the limit as the highest number of them
            let Some(time) = shortest_time(machine, is, 0.0) else {
                return Err(Wrong::Unknown(
                    "the time that the axes need is unknown here, so F must stay",
                ));
            };
            let asked = if is.length > 0.0 { asked_mm_min / is.length } else { 0.0 };
            let bends = if is.length > 0.0 {
                bends(machine, is) / is.length
            } else {
                f64::INFINITY
            };
            judge([old, new], (60.0 / time.seconds).min(bends), asked.max(old), "1/min")
        }
        _ => Err(Wrong::Refuted("the kind of feed differs".to_owned())),
    }
}

/// What the bends of a leg allow in the planner's model, mm/min.
fn bends(machine: &Machine, leg: &Leg) -> f64 {
    bend_limit(machine, leg).map_or(f64::INFINITY, |(feed, _)| feed)
}

fn judge([old, new]: [f64; 2], limit: f64, most: f64, unit: &str) -> Result<(), Wrong> {
    if !(new.is_finite() && new > 0.0) {
        return Err(Wrong::Refuted(format!("a feed of {new} {unit}")));
    }
    if new > limit * (1.0 + SAME) {
        return Err(Wrong::Refuted(format!(
            "a feed of {new:.3} {unit}, and the axes allow {limit:.3} {unit}"
        )));
    }
    if new > most * (1.0 + SAME) {
        return Err(Wrong::Refuted(format!(
            "a feed of {new:.3} {unit}, where at most {most:.3} {unit} is asked for"
        )));
    }
    if new < old && limit >= old {
        return Err(Wrong::Refuted(format!(
            "a feed of {new:.3} {unit} instead of {old:.3} {unit}, which the axes allow"
        )));
    }
    Ok(())
}
