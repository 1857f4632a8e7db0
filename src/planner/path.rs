//! Times and speeds of one straight piece of path in closed form.

/// One piece: accelerate from the first speed, run at a constant one, brake to the second. mm, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// Speed at the start and at the end, mm/s.
    pub ends: [f64; 2],
    /// Highest speed, mm/s.
    pub top: f64,
    /// Acceleration, mm/s^2; infinite: at once.
    pub acceleration: f64,
    /// mm.
    pub length: f64,
}

impl Ramp {
    /// The fastest way over a piece with constant acceleration and no limit of jerk. The speeds at the ends must be reachable from each other.
    pub fn fastest(length: f64, cap: f64, acceleration: f64, ends: [f64; 2]) -> Self {
        let [a, b] = ends;
        let top = if acceleration.is_finite() {
            cap.min((0.5 * (a * a + b * b) + acceleration * length).sqrt())
                .max(a.max(b))
        } else {
            cap
        };
        Self {
            ends,
            top,
            acceleration,
            length,
        }
    }

    /// Duration of a change of speed, s.
    fn change(&self, from: f64, to: f64) -> f64 {
        if self.acceleration.is_finite() {
            (to - from).abs() / self.acceleration
        } else {
            0.0
        }
    }

    /// Way of a change of speed, mm.
    fn way(&self, from: f64, to: f64) -> f64 {
        if self.acceleration.is_finite() {
            (to * to - from * from).abs() / (2.0 * self.acceleration)
        } else {
            0.0
        }
    }

    /// s.
    pub fn seconds(&self) -> f64 {
        let [a, b] = self.ends;
        let even = (self.length - self.way(a, self.top) - self.way(self.top, b)).max(0.0);
        let even = if even > 0.0 { even / self.top } else { 0.0 };
        self.change(a, self.top) + self.change(self.top, b) + even
    }

    /// How long the speed is below `speed` at the start and at the end, where the highest is not below it, s. At rest the acceleration begins and ends
    /// gently, as `smooth` says: durations of the even acceleration, and of the change of acceleration.
    pub fn seconds_below(&self, speed: f64, smooth: [f64; 2]) -> [f64; 2] {
        self.ends.map(|end| {
            if end <= 0.0 {
                from_rest(speed, self.top, smooth)
            } else {
                self.change(end.min(speed), speed)
            }
        })
    }

    /// Speed and acceleration at the way `s` from the start.
    pub fn at(&self, s: f64) -> (f64, f64) {
        let [a, b] = self.ends;
        let up = self.way(a, self.top);
        let down = self.way(self.top, b);
        if !self.acceleration.is_finite() {
            return (self.top, 0.0);
        }
        if s < up {
            ((a * a + 2.0 * self.acceleration * s).sqrt(), self.acceleration)
        } else if s > self.length - down {
            (
                (b * b + 2.0 * self.acceleration * (self.length - s).max(0.0)).sqrt(),
                -self.acceleration,
            )
        } else {
            (self.top, 0.0)
        }
    }
}

/// When a change of speed from rest to `top` reaches `speed`, s. Its acceleration is an even one of this duration, smoothed by a mean over another duration:
/// a trapezoid, whatever of both is longer.
fn from_rest(speed: f64, top: f64, [even, change]: [f64; 2]) -> f64 {
    let (long, short) = (even.max(change), even.min(change));
    if long <= 0.0 {
        return 0.0;
    }
    if speed > 0.5 * top {
        return long + short - from_rest((top - speed).max(0.0), top, [even, change]);
    }
    let acceleration = top / long;
    if speed <= 0.5 * acceleration * short {
        (2.0 * speed * short / acceleration).sqrt()
    } else {
        speed / acceleration + 0.5 * short
    }
}

/// Time from rest to rest over `length` with constant acceleration, s.
pub fn trapezoid(length: f64, cap: f64, acceleration: f64) -> f64 {
    Ramp::fastest(length, cap, acceleration, [0.0; 2]).seconds()
}

/// Time and highest speed from rest to rest over `length` within speed, acceleration and jerk: the fastest profile, of seven phases at most.
/// Source: docs/kinematics.md#time.
pub fn s_curve(length: f64, cap: f64, acceleration: f64, jerk: f64) -> (f64, f64) {
    if !jerk.is_finite() {
        let ramp = Ramp::fastest(length, cap, acceleration, [0.0; 2]);
        return (ramp.seconds(), ramp.top);
    }
    // time of a change from rest to v, and the way of it is half of v times that
    let change = |v: f64| {
        if acceleration.is_finite() && v >= acceleration * acceleration / jerk {
            v / acceleration + acceleration / jerk
        } else {
            2.0 * (v / jerk).sqrt()
        }
    };
    if cap * change(cap) <= length {
        return (2.0 * change(cap) + (length - cap * change(cap)) / cap, cap);
    }
    let pause = acceleration / jerk;
    let mut top = trunnion_geometry::math::pow(length * length * jerk / 4.0, 1.0 / 3.0);
    if acceleration.is_finite() && top > acceleration * pause {
        top = 0.5 * acceleration * ((pause * pause + 4.0 * length / acceleration).sqrt() - pause);
    }
    (2.0 * change(top), top)
}
