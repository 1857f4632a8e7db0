//! Speed along the path about a corner: constant acceleration, no limit of jerk.

/// Braking into a corner and accelerating out of it. mm, s; the corner is passed at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    /// Feed of the leg in and of the leg out, mm/s.
    pub feeds: [f64; 2],
    /// Acceleration along the path, mm/s^2.
    pub acceleration: f64,
    /// Speed at the corner, mm/s: 0 to stop there. Never above a feed.
    pub corner_speed: f64,
}

impl Profile {
    /// The speed at the corner: what is asked for, but no more than both feeds.
    pub(crate) fn speed_at_corner(&self) -> f64 {
        self.corner_speed.min(self.feeds[0]).min(self.feeds[1])
    }

    /// Feed of the leg on this side, and how long the change of speed takes there, s.
    pub(crate) fn side(&self, t: f64) -> (f64, f64) {
        let feed = self.feeds[usize::from(t >= 0.0)];
        (feed, (feed - self.speed_at_corner()) / self.acceleration)
    }

    /// How long the path takes to brake before the corner and to get faster after it, s.
    pub fn ramps(&self) -> [f64; 2] {
        [-1.0, 1.0].map(|side| self.side(side).1)
    }

    /// Path length from the corner, mm, and speed, mm/s, at the time t.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let (feed, ramp) = self.side(t);
        let (away, slowest) = (t.abs(), self.speed_at_corner());
        let changing = away.min(ramp);
        let length = (slowest + 0.5 * self.acceleration * changing) * changing + feed * (away - changing);
        let speed = if away < ramp {
            slowest + self.acceleration * away
        } else {
            feed
        };
        (if t < 0.0 { -length } else { length }, speed)
    }

    /// How long before (`side` below 0) or after the corner the path length is `length`, s.
    pub(crate) fn time_to(&self, side: f64, length: f64) -> f64 {
        let (feed, ramp) = self.side(side);
        let slowest = self.speed_at_corner();
        let reached = (slowest + 0.5 * self.acceleration * ramp) * ramp;
        if length >= reached {
            return ramp + (length - reached) / feed;
        }
        // slowest t + a t^2 / 2 = length
        2.0 * length / (slowest + (slowest * slowest + 2.0 * self.acceleration * length).sqrt())
    }
}
