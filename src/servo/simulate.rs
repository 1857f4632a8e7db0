//! The position loop, run through a corner: largest errors, with and without the corner controller.
use crate::plant::State;
use crate::{Corner, Plant, Profile};
use core::fmt;
use std::collections::VecDeque;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::exp;

/// The position loops of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// Kv of each axis, 1/s.
    pub gain: Vec3,
    /// Share of velocity feed forward, 0..=1.
    pub feed_forward: f64,
    /// What answers the commanded speed.
    pub plant: Plant,
    /// Time between two samples, s, in which the commanded speed is held; `None`: continuous (only [`Plant::First`] without correction).
    pub sample: Option<f64>,
}

/// The corner controller of paper 002: a proportional gain on the corner vector.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Correction {
    /// Sp, 1/s; 0: off.
    pub gain: f64,
    /// Samples by which the correction comes late (communication).
    pub delay: u32,
    /// The corner vector is formed where the model of the plant will be after the delay.
    pub predict: bool,
}

/// Where reference and axes are at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// s; the reference passes the corner at 0.
    pub time: f64,
    /// Reference, mm from the corner.
    pub reference: Vec3,
    /// Axes, mm from the corner.
    pub position: Vec3,
    /// Exact distance from the path, mm.
    pub distance: f64,
    /// Length of the corner vector, mm.
    pub radial: f64,
}

/// What the loop makes of the corner. mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Largest exact distance from the path at any moment.
    pub exact: f64,
    /// Largest exact distance at the samples; of a continuous loop at any moment.
    pub sampled: f64,
    /// Largest corner vector at the samples: the error of paper 002.
    pub radial: f64,
    /// The error grows after the corner, or is not finite.
    pub unstable: bool,
    /// The course about the corner.
    pub spots: Vec<Spot>,
}

/// Why a loop is not simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ServoError {
    /// A value is not positive, or not finite: its name.
    Value(&'static str),
    /// A loop with a controller or a velocity loop needs the time between two samples.
    NeedsSample,
    /// It would take too many steps: the acceleration is too small for this gain or sample.
    TooLong,
}

impl fmt::Display for ServoError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(name) => write!(f, "{name} must be a number above 0 (feed forward: 0 to 1)"),
            Self::NeedsSample => f.write_str("this loop is sampled: the time between two samples is missing"),
            Self::TooLong => f.write_str(
                "the corner takes too many samples: the acceleration is too small or the samples are too short",
            ),
        }
    }
}

impl std::error::Error for ServoError {}

/// Errors are looked for up to this path length from the corner, mm, or up to three lags where these are longer.
const WINDOW: f64 = 4.0;
/// The controller works this much farther, mm.
const ENGAGED: f64 = 2.0;
/// The reference starts at least this long before the braking, s.
const LEAD: f64 = 0.35;
/// The sample before the corner comes this share of a sample before it.
const PHASE: f64 = 0.05;
/// Places between two samples at which the path is measured.
const BETWEEN: u32 = 32;
/// Steps of a continuous loop per 1/Kv.
const STEPS_PER_LAG: f64 = 6000.0;
/// A continuous loop is followed from this many lags before the corner.
const LAGS: f64 = 30.0;
const MOST_STEPS: f64 = 3e6;
/// A corrected error above this is called unstable where it is also above what the loop has without correction, mm.
const RUNAWAY: f64 = 0.1;

/// Runs the loop through the corner, from steady state.
///
/// # Errors
/// A value is out of range, or the corner takes more than three million steps.
pub fn simulate(
    corner: &Corner,
    profile: &Profile,
    servo: &Servo,
    correction: &Correction,
) -> Result<Response, ServoError> {
    let positive = |name, value: f64| {
        (value > 0.0 && value.is_finite())
            .then_some(())
            .ok_or(ServoError::Value(name))
    };
    servo
        .gain
        .iter()
        .try_for_each(|&gain| positive("the position gain", gain))?;
    profile.feeds.iter().try_for_each(|&feed| positive("the feed", feed))?;
    positive("the acceleration", profile.acceleration)?;
    if let Plant::Third { bandwidth_hz } = servo.plant {
        positive("the bandwidth", bandwidth_hz)?;
    }
    if let Some(sample) = servo.sample {
        positive("the time between two samples", sample)?;
    }
    let forward = (0.0..=1.0).contains(&servo.feed_forward);
    if !(forward && correction.gain >= 0.0 && correction.gain.is_finite()) {
        return Err(ServoError::Value("the feed forward or the gain of the correction"));
    }
    match (servo.sample, servo.plant) {
        (None, Plant::First) if correction.gain == 0.0 => continuous(corner, profile, servo),
        (None, _) => Err(ServoError::NeedsSample),
        (Some(sample), _) => sampled(corner, profile, servo, correction, sample),
    }
}

/// Path length about the corner in which errors count, mm.
fn window(profile: &Profile, servo: &Servo) -> f64 {
    let lag = profile.feeds[0].max(profile.feeds[1]) * (1.0 - servo.feed_forward) / servo.gain.min();
    WINDOW.max(3.0 * lag)
}

/// How far the axes are behind in steady state at this speed along the leg in, mm.
fn steady_lag(corner: &Corner, speed: f64, servo: &Servo) -> Vec3 {
    (corner.before * (speed * (1.0 - servo.feed_forward))).component_div(&servo.gain)
}

/// Largest errors so far.
#[derive(Default)]
struct Worst {
    exact: f64,
    sampled: f64,
    radial: f64,
    /// Largest distance in the first and in the second half of the way out.
    halves: [f64; 2],
    spots: Vec<Spot>,
}

impl Worst {
    fn spot(&mut self, (corner, within): (&Corner, f64), time: f64, s: f64, position: &Vec3) -> f64 {
        let reference = corner.at(s);
        let (distance, radial) = (corner.distance(position), corner.vector(position, &reference, s).norm());
        if s.abs() < within {
            self.sampled = worse(self.sampled, distance);
            self.radial = worse(self.radial, radial);
            self.spots.push(Spot {
                time,
                reference,
                position: *position,
                distance,
                radial,
            });
        }
        distance
    }

    fn path(&mut self, within: f64, s: f64, distance: f64) {
        if s.abs() < within {
            self.exact = worse(self.exact, distance);
            if s > 0.0 {
                let half = &mut self.halves[usize::from(s > 0.5 * within)];
                *half = worse(*half, distance);
            }
        }
    }
}

/// The larger one; not finite once one was not.
fn worse(a: f64, b: f64) -> f64 {
    if b.is_finite() { a.max(b) } else { f64::INFINITY }
}

/// Without samples: each step follows a ramp of the reference exactly, e' = (1 - kff) R' - Kv e.
fn continuous(corner: &Corner, profile: &Profile, servo: &Servo) -> Result<Response, ServoError> {
    let within = window(profile, servo);
    let lag = 1.0 / servo.gain.min();
    let step = 1.0 / (servo.gain.max() * STEPS_PER_LAG);
    let (ramp, begin) = {
        let ramp = profile.side(-1.0).1;
        (ramp, ramp.min(LAGS * lag) + LEAD.min(LAGS * lag))
    };
    let end = profile.time_to(1.0, within).min(LAGS * lag);
    let steps = ((begin + end) / step).ceil();
    if steps > MOST_STEPS {
        return Err(ServoError::TooLong);
    }
    let start = -begin;
    let (mut s, speed) = profile.at(start);
    // while braking the lag is larger by (1 - kff) A/Kv^2
    let braking = if begin < ramp { profile.acceleration } else { 0.0 };
    let mut behind = steady_lag(corner, speed, servo)
        + (corner.before * (braking * (1.0 - servo.feed_forward)))
            .component_div(&servo.gain.component_mul(&servo.gain));
    let fading = servo.gain.map(|gain| exp(-gain * step));
    let mut worst = Worst::default();
    for k in 1..=steps as u64 {
        let time = start + k as f64 * step;
        let next = profile.at(time).0;
        let slope = (corner.at(next) - corner.at(s)) * ((1.0 - servo.feed_forward) / step);
        let steady = slope.component_div(&servo.gain);
        behind = steady + (behind - steady).component_mul(&fading);
        s = next;
        let position = corner.at(s) - behind;
        let distance = worst.spot((corner, within), time, s, &position);
        worst.path(within, s, distance);
    }
    Ok(Response {
        exact: worst.exact,
        sampled: worst.sampled,
        radial: worst.radial,
        unstable: false,
        spots: thinned(worst.spots),
    })
}

/// At most some thousand of them.
fn thinned(spots: Vec<Spot>) -> Vec<Spot> {
    let every = spots.len().div_ceil(4000).max(1);
    spots.into_iter().step_by(every).collect()
}

/// One run of a sampled loop.
struct Run<'a> {
    corner: &'a Corner,
    profile: &'a Profile,
    servo: &'a Servo,
    correction: &'a Correction,
    sample: f64,
    engaged: f64,
    /// Corrections under way: the first one acts at the next sample.
    under_way: VecDeque<Vec3>,
}

impl Run<'_> {
    /// Time, path length and reference of a sample.
    fn reference(&self, k: i64) -> (f64, f64, Vec3) {
        let time = (k as f64 - PHASE) * self.sample;
        let s = self.profile.at(time).0;
        (time, s, self.corner.at(s))
    }

    /// The speed that the axes' own loops command.
    fn command(&self, k: i64, position: &Vec3) -> Vec3 {
        let (time, s, reference) = self.reference(k);
        let ahead = self.corner.direction(s) * (self.profile.at(time).1 * self.servo.feed_forward);
        self.servo.gain.component_mul(&(reference - position)) + ahead
    }

    /// The correction formed at a sample.
    fn formed(&self, k: i64, position: &Vec3) -> Vec3 {
        let (_, s, reference) = self.reference(k);
        if s.abs() > self.engaged {
            return Vec3::zeros();
        }
        self.corner.vector(position, &reference, s) * self.correction.gain
    }

    /// The correction that acts at sample k.
    fn correction(&mut self, k: i64, state: &State) -> Vec3 {
        if self.correction.gain == 0.0 {
            return Vec3::zeros();
        }
        let delay = i64::from(self.correction.delay);
        let formed = if self.correction.predict {
            let mut ahead = *state;
            for (later, under_way) in (k..k + delay).zip(&self.under_way) {
                let u = self.command(later, &ahead.position) + under_way;
                ahead = self.servo.plant.after(&ahead, &u, self.sample);
            }
            self.formed(k + delay, &ahead.position)
        } else {
            self.formed(k, &state.position)
        };
        self.under_way.push_back(formed);
        self.under_way.pop_front().unwrap_or_else(Vec3::zeros)
    }
}

fn sampled(
    corner: &Corner,
    profile: &Profile,
    servo: &Servo,
    correction: &Correction,
    sample: f64,
) -> Result<Response, ServoError> {
    let within = window(profile, servo);
    let engaged = within + ENGAGED;
    let begin =
        (profile.side(-1.0).1 + LEAD).max(profile.time_to(-1.0, engaged + 0.1) + f64::from(correction.delay) * sample);
    let end = profile.time_to(1.0, within);
    if (begin + end) / sample > MOST_STEPS {
        return Err(ServoError::TooLong);
    }
    let mut run = Run {
        corner,
        profile,
        servo,
        correction,
        sample,
        engaged,
        under_way: vec![Vec3::zeros(); correction.delay as usize].into(),
    };
    let (first, last) = (-(begin / sample).ceil() as i64, (end / sample).ceil() as i64);
    let (start, _, reference) = run.reference(first);
    let speed = profile.at(start).1;
    let mut state = State {
        position: reference - steady_lag(corner, speed, servo),
        velocity: corner.before * speed,
        integral: Vec3::zeros(),
    };
    let mut worst = Worst::default();
    for k in first..=last {
        let (time, s, _) = run.reference(k);
        let distance = worst.spot((corner, within), time, s, &state.position);
        worst.path(within, s, distance);
        let u = run.command(k, &state.position) + run.correction(k, &state);
        if s.abs() < within + profile.feeds[0].max(profile.feeds[1]) * sample {
            for part in 1..BETWEEN {
                let later = sample * f64::from(part) / f64::from(BETWEEN);
                let between = servo.plant.after(&state, &u, later);
                worst.path(within, profile.at(time + later).0, corner.distance(&between.position));
            }
        }
        state = servo.plant.after(&state, &u, sample);
        if !state.position.iter().all(|x| x.is_finite() && x.abs() < 1e9) {
            worst.exact = f64::INFINITY;
            break;
        }
    }
    let grows = worst.halves[1] > 0.5 * worst.halves[0] && worst.halves[1] > 1e-6;
    let mut unstable = !worst.exact.is_finite() || grows;
    if !unstable && correction.gain > 0.0 && worst.exact > RUNAWAY {
        let plain = sampled(corner, profile, servo, &Correction::default(), sample)?;
        unstable = worst.exact > plain.exact;
    }
    Ok(Response {
        exact: worst.exact,
        sampled: worst.sampled,
        radial: worst.radial,
        unstable,
        spots: thinned(worst.spots),
    })
}
