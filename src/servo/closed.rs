//! Corner errors in closed form: first-order lag, the same gain in all axes.
use crate::{Corner, Plant, Profile, Servo};
use trunnion_geometry::math::{exp, ln, sin};

/// Largest exact distance from the path, mm, for a lag of the first order with the gain `kv` (1/s).
///
/// The position is -p a + q b: p fades as (alpha + beta) e^-x, q grows as alpha (x - 1 + e^-x) + beta (x^2/2 - x + 1 - e^-x), with alpha = v/Kv (speed
/// at the corner), beta = A/Kv^2 and x = Kv t. The distance from the nearer leg is min(p, q) sin(turn), so it is largest where both are equal.
/// At rest in the corner that is x^2/2 - x + 1 = 2 e^-x, x = 1.3000752; at constant speed x = 1. The braking is taken as long against 1/Kv.
/// Feed forward scales the following error, so p shrinks with it, and q grows by its share of the way that the reference has gone: the error falls by
/// less than the following error. Source: docs/kinematics.md#servo.
pub fn closed_form(corner: &Corner, profile: &Profile, kv: f64, feed_forward: f64) -> f64 {
    sin(corner.turn()).max(0.0) * per_sine(profile, kv, feed_forward, [f64::INFINITY; 2])
}

/// The same, with the time that the path takes to brake from its feed before the corner, and to reach the one after it: with t1 = Kv times the first of
/// them p fades from alpha + beta (1 - e^-t1), and q grows at an even speed after the second one. It is [`closed_form`] where both are long against 1/Kv.
pub fn closed_form_with_ramps(corner: &Corner, profile: &Profile, kv: f64, feed_forward: f64) -> f64 {
    sin(corner.turn()).max(0.0) * per_sine(profile, kv, feed_forward, profile.ramps().map(|ramp| kv * ramp))
}

/// The same, for a turn of 90 deg, mm; `ramps` in units of 1/Kv.
fn per_sine(profile: &Profile, kv: f64, feed_forward: f64, ramps: [f64; 2]) -> f64 {
    let speed = profile.speed_at_corner();
    let changes = profile
        .feeds
        .map(|feed| if feed > speed { profile.acceleration } else { 0.0 });
    let alpha = speed / kv;
    let [before, after] = changes.map(|acceleration| acceleration / (kv * kv));
    let rest = 1.0 - feed_forward;
    let fading = |x: f64| rest * (alpha + before * (1.0 - exp(-ramps[0]))) * exp(-x);
    let ramp = ramps[1];
    // the way of the reference and how far the axis is behind it, as long as the path gets faster
    let way = |x: f64| alpha * x + after * 0.5 * x * x;
    let behind = |x: f64| rest * (alpha * (1.0 - exp(-x)) + after * (x - 1.0 + exp(-x)));
    let growing = |x: f64| {
        if x <= ramp {
            return way(x) - behind(x);
        }
        let even = alpha + after * ramp;
        let left = rest * even - (rest * even - behind(ramp)) * exp(ramp - x);
        way(ramp) + even * (x - ramp) - left
    };
    // fading falls, growing rises
    let (mut low, mut high) = (0.0, 64.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if growing(middle) < fading(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    fading(low)
}

/// The gain with which a continuous loop fades as fast as one that is sampled every `sample` s: -ln(1 - Kv T)/T, 1/s; `None` where that overshoots.
pub fn sampled_gain(kv: f64, sample: f64) -> Option<f64> {
    let left = 1.0 - kv * sample;
    (left > 0.0 && sample > 0.0).then(|| -ln(left) / sample)
}

/// The acceleration at which the error of a stop in the corner is `tolerance` mm, mm/s^2; infinite where a stop leaves no error.
pub fn stop_acceleration(corner: &Corner, kv: f64, feed_forward: f64, tolerance: f64) -> f64 {
    let unit = Profile {
        feeds: [1.0; 2],
        acceleration: 1.0,
        corner_speed: 0.0,
    };
    tolerance / closed_form(corner, &unit, kv, feed_forward)
}

/// The speed at which the error of a corner that is passed at constant speed is `tolerance` mm, mm/s; infinite where it leaves no error.
pub fn slowest_corner_speed(corner: &Corner, kv: f64, feed_forward: f64, tolerance: f64) -> f64 {
    let unit = Profile {
        feeds: [1.0; 2],
        acceleration: 1.0,
        corner_speed: 1.0,
    };
    tolerance / closed_form(corner, &unit, kv, feed_forward)
}

impl Servo {
    /// The gain of the closed form for this loop, 1/s: that of the sampled loop where the axis answers at once. `None`: gains differ between the
    /// axes, or a sample is longer than 1/Kv.
    pub fn closed_gain(&self) -> Option<f64> {
        let kv = self.gain.x;
        if self.gain.y != kv || self.gain.z != kv {
            return None;
        }
        match (self.plant, self.sample) {
            (Plant::First, Some(sample)) => sampled_gain(kv, sample),
            _ => Some(kv),
        }
    }
}
