//! One move with limited jerk, from rest to rest, in closed form.
use crate::s_curve;

/// The course of one move from rest to rest.
pub(crate) struct Move {
    /// mm.
    pub(crate) length: f64,
    /// s.
    pub(crate) total: f64,
    /// mm/s.
    pub(crate) top: f64,
    /// mm/s^2.
    pub(crate) acceleration: f64,
    /// Duration of the change of jerk, and of the whole change of speed, s.
    pub(crate) bend: f64,
    pub(crate) change: f64,
}

impl Move {
    /// The fastest within these limits.
    pub(crate) fn new(length: f64, cap: f64, acceleration: f64, jerk: f64) -> Self {
        let (total, top) = s_curve(length, cap, acceleration, jerk);
        let reached = acceleration.is_finite() && (!jerk.is_finite() || top >= acceleration * acceleration / jerk);
        let bend = match (jerk.is_finite(), reached) {
            (false, _) => 0.0,
            (true, true) => acceleration / jerk,
            (true, false) => (top / jerk).sqrt(),
        };
        let change = match (reached, acceleration.is_finite()) {
            (true, _) => top / acceleration + bend,
            (false, false) if !jerk.is_finite() => 0.0,
            _ => 2.0 * bend,
        };
        Self {
            length,
            total,
            top,
            acceleration,
            bend,
            change,
        }
    }

    /// Way after a time of the first half, mm.
    fn way(&self, t: f64) -> f64 {
        if t >= self.change {
            return 0.5 * self.top * self.change + self.top * (t - self.change);
        }
        // the speed is a trapezoid of acceleration: rising for `bend`, even, falling for `bend`
        let even = self.change - self.bend;
        let a = if even > 0.0 { self.top / even } else { 0.0 };
        if self.bend == 0.0 {
            return 0.5 * a * t * t;
        }
        let rise = a / self.bend;
        if t < self.bend {
            rise * t * t * t / 6.0
        } else if t < even {
            let u = t - self.bend;
            rise * self.bend.powi(3) / 6.0 + 0.5 * a * self.bend * u + 0.5 * a * u * u
        } else {
            let left = self.change - t;
            0.5 * self.top * self.change - self.top * left + rise * left * left * left / 6.0
        }
    }

    /// When it has gone a way, s.
    pub(crate) fn time_at(&self, way: f64) -> f64 {
        if way > 0.5 * self.length {
            return self.total - self.time_at(self.length - way);
        }
        let (mut low, mut high) = (0.0, 0.5 * self.total);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.way(middle) < way {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}
