//! How long a program takes, as an interval.
use crate::view::LegView;
use trunnion_interp::MotionKind;
use trunnion_machine::block_duration_s;

/// Sum of the blocks' times, s, while all of them are known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CycleTime {
    low: f64,
    high: f64,
    known: bool,
}

impl Default for CycleTime {
    fn default() -> Self {
        Self {
            low: 0.0,
            high: 0.0,
            known: true,
        }
    }
}

impl CycleTime {
    /// Adds a block. One from an unknown to a known position adds nothing: its time is unknown.
    pub(crate) fn add(&mut self, view: &LegView<'_>) {
        if !self.known {
            return;
        }
        if view.feed_is_ambiguous() {
            self.known = false;
            return;
        }
        if let MotionKind::Dwell(seconds) = view.motion().kind {
            self.known = seconds.is_some();
            let seconds = seconds.unwrap_or_default();
            self.low += seconds;
            self.high += seconds;
            return;
        }
        if view.leg.start.is_none() && view.leg.end.is_ok() {
            return;
        }
        let duration = block_duration_s(view.machine, view.leg);
        match duration.and_then(|low| Some((low, with_stops(view, low)?))) {
            Some((low, high)) => {
                self.low += low;
                self.high += high;
            }
            None => self.known = false,
        }
    }

    /// Whether the time is known so far.
    pub(crate) fn is_known(&self) -> bool {
        self.known
    }

    /// Lowest and highest time, s.
    pub(crate) fn interval(&self) -> Option<[f64; 2]> {
        (self.known && self.low.is_finite() && self.high.is_finite()).then_some([self.low, self.high])
    }
}

/// Time of a block that starts and ends at rest, s: each axis that moves accelerates no faster than declared, all in
/// proportion. With path parameter s in 0..=1, highest speed v = 1/T and acceleration a = min over axes of amax/|dq|:
/// T + v/a if the speed is reached, else 2 sqrt(1/a). `None` where an axis that moves has no declared acceleration.
fn with_stops(view: &LegView<'_>, duration: f64) -> Option<f64> {
    let (start, end) = view.stances()?;
    let mut slowest = f64::INFINITY;
    for (i, axis) in view.machine.axes.iter().enumerate() {
        let change = (end.joints[i] - start.joints[i]).abs();
        if change > 0.0 {
            slowest = slowest.min(axis.max_acceleration? / change);
        }
    }
    if !(duration > 0.0 && slowest.is_finite()) {
        return Some(duration);
    }
    let speed = 1.0 / duration;
    Some(if speed * speed <= slowest {
        duration + speed / slowest
    } else {
        2.0 * (1.0 / slowest).sqrt()
    })
}
