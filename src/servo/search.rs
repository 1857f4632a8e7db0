//! Which feed, acceleration or controller keeps a corner within a tolerance: by closed form and by simulation.
use crate::{Corner, Correction, Profile, Servo, ServoError, simulate, slowest_corner_speed, stop_acceleration};

/// Values of one parameter each, the others as they are, that keep the exact distance within a tolerance. `None`: no value does, or the loop
/// gives no closed form.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Within {
    /// Highest acceleration along the path with a stop in the corner, in closed form, mm/s^2.
    pub acceleration_closed: Option<f64>,
    /// Highest constant speed through the corner, in closed form, mm/s.
    pub speed_closed: Option<f64>,
    /// Highest acceleration along the path, by simulation, mm/s^2.
    pub acceleration: Option<f64>,
    /// Highest speed at the corner, by simulation, mm/s; never above the feeds.
    pub corner_speed: Option<f64>,
    /// Smallest position gain of all axes, by simulation, 1/s.
    pub position_gain: Option<f64>,
    /// Smallest gain of the corner controller, by simulation, 1/s.
    pub corner_gain: Option<f64>,
}

/// Relative width at which a search ends.
const CLOSE: f64 = 1e-4;

/// What keeps the corner within `tolerance` mm. The values found by simulation hold the tolerance themselves; they lie within 0.01 % of the
/// border that the search found.
///
/// # Errors
/// The loop as it stands cannot be simulated.
pub fn within(
    corner: &Corner,
    profile: &Profile,
    servo: &Servo,
    correction: &Correction,
    tolerance: f64,
) -> Result<Within, ServoError> {
    let holds = |profile: &Profile, servo: &Servo, correction: &Correction| {
        simulate(corner, profile, servo, correction)
            .is_ok_and(|response| !response.unstable && response.exact <= tolerance)
    };
    simulate(corner, profile, servo, correction)?;
    let closed = servo.closed_gain().filter(|_| correction.gain == 0.0);
    let finite = |value: f64| value.is_finite().then_some(value);
    let with_acceleration = |acceleration: f64| {
        holds(
            &Profile {
                acceleration,
                ..*profile
            },
            servo,
            correction,
        )
    };
    let with_speed = |corner_speed: f64| {
        holds(
            &Profile {
                corner_speed,
                ..*profile
            },
            servo,
            correction,
        )
    };
    let with_gain = |gain: f64| {
        let gain = trunnion_geometry::Vec3::repeat(gain);
        holds(profile, &Servo { gain, ..*servo }, correction)
    };
    let with_correction = |gain: f64| holds(profile, servo, &Correction { gain, ..*correction });
    let feed = profile.feeds[0].min(profile.feeds[1]);
    let corner_speed = if with_speed(feed) {
        Some(feed)
    } else if with_speed(0.0) {
        Some(border(0.0, feed, &with_speed))
    } else {
        None
    };
    Ok(Within {
        acceleration_closed: closed.and_then(|kv| finite(stop_acceleration(corner, kv, servo.feed_forward, tolerance))),
        speed_closed: closed.and_then(|kv| finite(slowest_corner_speed(corner, kv, servo.feed_forward, tolerance))),
        acceleration: largest(profile.acceleration, &with_acceleration),
        corner_speed,
        position_gain: smallest(servo.gain.min(), &with_gain),
        corner_gain: servo.sample.and_then(|sample| {
            if with_correction(0.0) {
                return Some(0.0);
            }
            // above 1/T no sampled loop is stable
            (1..=60)
                .map(|step| (1.0 / sample) * f64::from(step) / 60.0)
                .find(|&gain| with_correction(gain))
                .map(|held| {
                    let below = held - 1.0 / (60.0 * sample);
                    border(held, below.max(0.0), &with_correction)
                })
        }),
    })
}

/// From the present value upwards, doubling.
fn smallest(from: f64, holds: &impl Fn(f64) -> bool) -> Option<f64> {
    if holds(from) {
        return Some(from);
    }
    (1..8)
        .map(|doublings| from * 2.0_f64.powi(doublings))
        .find(|&value| holds(value))
        .map(|held| border(held, 0.5 * held, holds))
}

/// From the present value upwards, doubling, as long as it holds; or downwards, halving, until it does.
fn largest(from: f64, holds: &impl Fn(f64) -> bool) -> Option<f64> {
    let up = holds(from);
    let mut value = from;
    for _ in 0..24 {
        let next = if up { 2.0 * value } else { 0.5 * value };
        if holds(next) != up {
            let (held, broken) = if up { (value, next) } else { (next, value) };
            return Some(border(held, broken, holds));
        }
        value = next;
    }
    None
}

/// Between a value that holds and one that does not: the border, on the side that holds.
fn border(mut held: f64, mut broken: f64, holds: &impl Fn(f64) -> bool) -> f64 {
    while (held - broken).abs() > CLOSE * held.abs().max(broken.abs()) {
        let middle = 0.5 * (held + broken);
        if holds(middle) {
            held = middle;
        } else {
            broken = middle;
        }
    }
    held
}
