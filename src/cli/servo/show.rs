//! A corner in words and as JSON.
use super::Cornered;
use crate::cli::load::Loaded;
use serde_json::{Value, json};
use std::fmt::Write as _;
use trunnion_geometry::deg;
use trunnion_machine::Machine;
use trunnion_servo::{Plant, Within, closed_form};

/// mm to um; `None` where it is not finite.
fn um(mm: f64) -> Option<f64> {
    mm.is_finite().then_some(mm * 1e3)
}

impl Cornered {
    /// In closed form, um.
    fn closed_um(&self) -> Option<f64> {
        let kv = self.loops.closed_gain()?;
        um(closed_form(
            &self.found.corner,
            &self.profile,
            kv,
            self.loops.feed_forward,
        ))
    }

    /// The same for a continuous loop, um.
    fn closed_continuous_um(&self) -> Option<f64> {
        let gain = self.loops.gain;
        let same = gain.iter().all(|kv| *kv == gain.x);
        same.then(|| {
            um(closed_form(
                &self.found.corner,
                &self.profile,
                gain.x,
                self.loops.feed_forward,
            ))
        })?
    }

    fn interior_deg(&self) -> f64 {
        180.0 - deg(self.found.corner.turn())
    }
}

pub(super) fn json(loaded: &Loaded, machine: &Machine, cornered: &Cornered, keeps: Option<&(f64, Within)>) -> Value {
    let Cornered {
        found,
        profile,
        loops,
        correction,
        response,
        notes,
    } = cornered;
    let (plant, bandwidth) = match loops.plant {
        Plant::First => ("first", None),
        Plant::Third { bandwidth_hz } => ("third", Some(bandwidth_hz)),
    };
    let keeps = keeps.map(|(tolerance, within)| {
        json!({
            "tolerance_mm": tolerance,
            "acceleration_mm_s2": within.acceleration,
            "acceleration_closed_form_mm_s2": within.acceleration_closed,
            "corner_feed_mm_min": within.corner_speed.map(|speed| speed * 60.0),
            "corner_feed_closed_form_mm_min": within.speed_closed.map(|speed| speed * 60.0),
            "kv_1_s": within.position_gain,
            "corner_gain_1_s": within.corner_gain,
        })
    });
    let mut document = json!({
        "schema": "trunnion-servo/1",
        "version": env!("CARGO_PKG_VERSION"),
        "path": loaded.name,
        "machine": machine.id,
        "line": found.lines[1],
        "line_before": found.lines[0],
        "corner_deg": cornered.interior_deg(),
        "turn_deg": deg(found.corner.turn()),
        "feed_mm_min": profile.feeds[1] * 60.0,
        "feed_before_mm_min": profile.feeds[0] * 60.0,
        "corner_feed_mm_min": profile.corner_speed.min(profile.feeds[0]).min(profile.feeds[1]) * 60.0,
        "acceleration_mm_s2": profile.acceleration,
        "kv_1_s": loops.gain.as_slice(),
        "feed_forward": loops.feed_forward,
        "plant": plant,
        "bandwidth_hz": bandwidth,
        "sample_ms": loops.sample.map(|sample| sample * 1e3),
        "corner_gain_1_s": correction.gain,
        "delay": correction.delay,
        "predict": correction.predict,
        "closed_form_um": cornered.closed_um(),
        "closed_form_continuous_um": cornered.closed_continuous_um(),
        "error_exact_um": um(response.exact),
        "error_sampled_um": um(response.sampled),
        "error_radial_um": um(response.radial),
        "unstable": response.unstable,
        "notes": notes,
    });
    if let (Some(keeps), Some(object)) = (keeps, document.as_object_mut()) {
        object.insert("within".to_owned(), keeps);
    }
    document
}

#[expect(clippy::too_many_lines, reason = "one row after the other")]
pub(super) fn text(loaded: &Loaded, machine: &Machine, cornered: &Cornered, keeps: Option<&(f64, Within)>) -> String {
    let Cornered {
        found,
        profile,
        loops,
        correction,
        response,
        notes,
    } = cornered;
    let mut text = String::new();
    let feeds = profile.feeds.map(|feed| feed * 60.0);
    let _ = writeln!(
        text,
        "{} line {} on {}: a corner of {:.3} deg between lines {} and {}",
        loaded.name,
        found.lines[1],
        machine.id,
        cornered.interior_deg(),
        found.lines[0],
        found.lines[1]
    );
    let _ = writeln!(
        text,
        "  feed {:.1} mm/min in, {:.1} mm/min out, {:.1} mm/min at the corner; {:.2} mm/s2 along the path",
        feeds[0],
        feeds[1],
        (profile.corner_speed * 60.0).min(feeds[0]).min(feeds[1]),
        profile.acceleration
    );
    let gain = loops.gain;
    let gains = if gain.iter().all(|kv| *kv == gain.x) {
        format!("{:.3} 1/s", gain.x)
    } else {
        format!("{:.3}, {:.3} and {:.3} 1/s", gain.x, gain.y, gain.z)
    };
    let plant = match loops.plant {
        Plant::First => "the axes follow the commanded speed at once".to_owned(),
        Plant::Third { bandwidth_hz } => format!("velocity loop of {bandwidth_hz} Hz"),
    };
    let sample = loops.sample.map_or_else(
        || "continuous".to_owned(),
        |sample| format!("a sample every {} ms", sample * 1e3),
    );
    let _ = writeln!(
        text,
        "  position gain {gains}, {plant}, {sample}, feed forward {}",
        loops.feed_forward
    );
    if correction.gain > 0.0 {
        let delay = match (correction.delay, correction.predict) {
            (0, _) => "no delay".to_owned(),
            (n, true) => format!("{n} samples late, with prediction"),
            (n, false) => format!("{n} samples late, without prediction"),
        };
        let _ = writeln!(text, "  corner controller {} 1/s, {delay}", correction.gain);
    }
    let value = |um: Option<f64>| um.map_or_else(|| "none".to_owned(), |um| format!("{um:.3} um"));
    if response.unstable {
        let _ = writeln!(
            text,
            "  UNSTABLE: the error grows, the figures below say nothing but that"
        );
    }
    let rows = [
        ("closed form, loop of the first order", cornered.closed_um()),
        ("largest distance from the path", um(response.exact)),
        ("the same at the samples only", um(response.sampled)),
        (
            "largest corner vector (the radial error of Lim and Jee)",
            um(response.radial),
        ),
    ];
    for (name, um) in rows {
        let _ = writeln!(text, "  {name:<56} {:>12}", value(um));
    }
    if let Some((tolerance, within)) = keeps {
        let _ = writeln!(text, "  To keep it within {tolerance} mm, one of:");
        let choice = |value: Option<f64>, unit: &str| {
            value.map_or_else(|| "no value does".to_owned(), |value| format!("{value:.3} {unit}"))
        };
        let minute = |speed: Option<f64>| speed.map(|speed| speed * 60.0);
        let rows = [
            (
                "acceleration along the path at most",
                choice(within.acceleration, "mm/s2"),
            ),
            (
                "  in closed form, with a stop",
                choice(within.acceleration_closed, "mm/s2"),
            ),
            (
                "feed at the corner at most",
                choice(minute(within.corner_speed), "mm/min"),
            ),
            (
                "  in closed form, at constant speed",
                choice(minute(within.speed_closed), "mm/min"),
            ),
            ("position gain at least", choice(within.position_gain, "1/s")),
            (
                "gain of the corner controller at least",
                choice(within.corner_gain, "1/s"),
            ),
        ];
        for (name, value) in rows {
            let _ = writeln!(text, "    {name:<40} {value}");
        }
    }
    for note in notes {
        let _ = writeln!(text, "  note: {note}");
    }
    text
}
