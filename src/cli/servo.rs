//! `servo`: what the servo loops make of one corner of a program.
mod find;
mod show;

pub(super) use find::Found;

use super::{
    Done,
    args::{Global, ListFormat},
    failure::Failure,
    json::write_json,
    load::{self, Loaded},
    waiting,
};
use crate::cli::out::Out;
use std::{io::Write, path::PathBuf};
use trunnion_geometry::Vec3;
use trunnion_machine::Machine;
use trunnion_servo::{Correction, Plant, Profile, Response, Servo as Loops, Within, simulate, within};

/// `servo`
#[derive(clap::Args)]
pub(crate) struct Servo {
    /// The program; `-` reads standard input.
    file: PathBuf,
    /// The corner at the start of the motion in this line.
    #[arg(long, value_name = "LINE")]
    at: u32,
    #[command(flatten)]
    pub(crate) options: ServoOptions,
    /// Also say which feed, acceleration or gain keeps the corner within this distance, in mm.
    #[arg(long, value_name = "MM")]
    tolerance_mm: Option<f64>,
    #[arg(long, value_enum, default_value = "text")]
    format: ListFormat,
}

/// The loops and the speed at the corner, for `servo` and `plot --kind servo`. What is not given comes from the machine file.
#[derive(clap::Args)]
pub(crate) struct ServoOptions {
    /// Position gain of all axes, in 1/s. Default: `dyn.kv` of the machine file.
    #[arg(long, value_name = "1/S")]
    kv: Option<f64>,
    /// Acceleration along the path, in mm/s^2. Default: that which the axes of the machine allow.
    #[arg(long, value_name = "MM/S^2")]
    acc: Option<f64>,
    /// Speed at the corner, in mm/min. Default: stop there.
    #[arg(long, value_name = "MM/MIN", default_value_t = 0.0)]
    corner_feed: f64,
    /// How an axis answers a commanded speed: at once, or through a velocity loop.
    #[arg(long, value_enum, default_value = "first")]
    plant: PlantKind,
    /// Bandwidth of the velocity loop, in Hz. Default: `servo.bandwidth` of the machine file.
    #[arg(long, value_name = "HZ")]
    bandwidth_hz: Option<f64>,
    /// Time between two samples of the position loop, in ms. Default: `servo.sample_time` of the machine file, else continuous for the
    /// first-order plant without a corner controller, otherwise 1 ms.
    #[arg(long, value_name = "MS")]
    sample_ms: Option<f64>,
    /// Gain of the corner controller, in 1/s.
    #[arg(long, value_name = "1/S", default_value_t = 0.0)]
    corner_gain: f64,
    /// Samples by which the correction comes late.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=1000))]
    delay: u32,
    /// Compute the correction from the position predicted after the delay.
    #[arg(long)]
    predict: bool,
}

/// `--plant`.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum PlantKind {
    First,
    Third,
}

/// A corner of a program, the loops, and what they make of it.
pub(super) struct Cornered {
    pub(super) found: Found,
    pub(super) profile: Profile,
    pub(super) loops: Loops,
    pub(super) correction: Correction,
    pub(super) response: Response,
    /// What was assumed.
    pub(super) notes: Vec<String>,
}

/// Runs `servo`. The exit status is 1 where the loop is unstable.
pub(super) fn run(global: &Global, command: &Servo) -> Result<Done, Failure> {
    if let Some(tolerance) = command.tolerance_mm {
        in_range("--tolerance-mm", tolerance, [1e-6, 1000.0], "mm")?;
    }
    let loaded = load::load_for_steps(global, &command.file)?;
    let machine = loaded.machine_or_fail("servo")?;
    let cornered = waiting::during(global, "following", &command.file, || {
        corner(&loaded, machine, command.at, &command.options)
    })?;
    let keeps = command
        .tolerance_mm
        .map(|tolerance| keeps(&cornered, tolerance))
        .transpose()?;
    let mut out = Out::standard();
    match command.format {
        ListFormat::Text => out.text(&show::text(&loaded, machine, &cornered, keeps.as_ref())),
        ListFormat::Json => write_json(&mut out, &show::json(&loaded, machine, &cornered, keeps.as_ref()))?,
    }
    out.flush()?;
    Ok(if cornered.response.unstable {
        Done::Found
    } else {
        Done::Clean
    })
}

/// What keeps the corner within a tolerance, mm.
fn keeps(cornered: &Cornered, tolerance: f64) -> Result<(f64, Within), Failure> {
    let Cornered {
        found,
        profile,
        loops,
        correction,
        ..
    } = cornered;
    let found = within(&found.corner, profile, loops, correction, tolerance)
        .map_err(|error| Failure::new(error.to_string()))?;
    Ok((tolerance, found))
}

/// Braking that takes as many times 1/Kv changes the closed form by less than 1 %.
const LONG: f64 = 5.0;

/// Finds the corner at the start of a line and runs the loops through it.
#[expect(clippy::too_many_lines, reason = "one value after the other")]
pub(super) fn corner(
    loaded: &Loaded,
    machine: &Machine,
    line: u32,
    options: &ServoOptions,
) -> Result<Cornered, Failure> {
    check(options)?;
    let found = find::find(loaded, machine, line)?;
    let mut notes = found.notes.clone();
    let planning = &machine.control.planning;
    let missing = |what: &str, option: &str, key: &str| {
        Failure::new(format!(
            "{what} is not known: add {option}, or declare {key} in the file of machine {}",
            machine.id
        ))
    };
    let own = |axis: usize| options.kv.or(machine.axes[axis].extra.position_gain);
    let [Some(x), Some(y), Some(z)] = found.joints.map(own) else {
        return Err(missing(
            "the position gain Kv",
            "--kv 1/S",
            "dyn = { kv = ... } of each linear axis",
        ));
    };
    let forward = found
        .joints
        .map(|axis| machine.axes[axis].extra.feed_forward.unwrap_or(0.0));
    if forward.iter().any(|share| *share != forward[0]) {
        return Err(Failure::new(
            "the axes have different feed forward (kff): corners of such axes are not simulated",
        ));
    }
    let acceleration = options.acc.or_else(|| found.acceleration(machine));
    let acceleration = acceleration.ok_or_else(|| {
        missing(
            "the acceleration",
            "--acc MM/S^2",
            "dyn = { amax = ... } of each linear axis",
        )
    })?;
    let plant = match options.plant {
        PlantKind::First => Plant::First,
        PlantKind::Third => Plant::Third {
            bandwidth_hz: options.bandwidth_hz.or(planning.servo_bandwidth_hz).ok_or_else(|| {
                missing(
                    "the bandwidth of the velocity loop",
                    "--bandwidth-hz HZ",
                    "[control] servo = { bandwidth = ... }",
                )
            })?,
        },
    };
    let declared = options.sample_ms.map(|ms| ms / 1000.0).or(planning.servo_sample);
    let needed = options.plant == PlantKind::Third || options.corner_gain > 0.0;
    if declared.is_none() && needed {
        notes.push("a sample every 1 ms is assumed".to_owned());
    }
    let loops = Loops {
        gain: Vec3::new(x, y, z),
        feed_forward: forward[0],
        plant,
        sample: declared.or(needed.then_some(1e-3)),
    };
    let correction = Correction {
        gain: options.corner_gain,
        delay: options.delay,
        predict: options.predict,
    };
    let profile = Profile {
        feeds: found.feeds,
        acceleration,
        corner_speed: options.corner_feed / 60.0,
    };
    if profile.ramps()[0] * x < LONG {
        notes.push(format!(
            "the closed form takes the braking as long against 1/Kv, and is too large here: it takes {:.3} s, and 1/Kv is {:.3} s",
            profile.ramps()[0],
            1.0 / x
        ));
    }
    for (length, feed) in found.lengths.iter().zip(profile.feeds) {
        let braking = (feed * feed - profile.corner_speed.min(feed).powi(2)) / (2.0 * acceleration);
        if *length < braking {
            notes.push(format!(
                "a leg of {length:.3} mm is shorter than the {braking:.3} mm that the change of speed takes: legs are taken as long enough"
            ));
        }
    }
    let response = simulate(&found.corner, &profile, &loops, &correction)
        .map_err(|error| Failure::new(format!("line {line}: {error}")))?;
    Ok(Cornered {
        found,
        profile,
        loops,
        correction,
        response,
        notes,
    })
}

fn check(options: &ServoOptions) -> Result<(), Failure> {
    let ranges = [
        ("--kv", options.kv, [1e-2, 1e5], "1/s"),
        ("--acc", options.acc, [1e-3, 1e6], "mm/s^2"),
        ("--corner-feed", Some(options.corner_feed), [0.0, 1e6], "mm/min"),
        ("--bandwidth-hz", options.bandwidth_hz, [0.1, 1e5], "Hz"),
        ("--sample-ms", options.sample_ms, [1e-3, 1000.0], "ms"),
        ("--corner-gain", Some(options.corner_gain), [0.0, 1e6], "1/s"),
    ];
    for (name, value, range, unit) in ranges {
        if let Some(value) = value {
            in_range(name, value, range, unit)?;
        }
    }
    if options.predict && options.delay == 0 {
        return Err(Failure::new("--predict needs a delay to predict over: add --delay N"));
    }
    Ok(())
}

fn in_range(name: &str, value: f64, [least, most]: [f64; 2], unit: &str) -> Result<(), Failure> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(Failure::new(format!(
        "{name} {value}: must be between {least} and {most} {unit}"
    )))
}
