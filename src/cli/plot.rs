//! `plot`: pictures of what the machine does, as SVG.
mod gather;

use super::legs::each_leg;
use super::{
    Done,
    args::Global,
    failure::{Failure, remark, shown},
    load::{self, Loaded},
    servo::{ServoOptions, corner},
    waiting,
};
use std::path::{Path, PathBuf};
use trunnion_interp::MotionKind;
use trunnion_machine::{Machine, Space, ToolBody};
use trunnion_plot::{
    Along, Header, PlotError, Record, ServoSpot, Shows, Unit, axis_plane, deviation, feed, joints, path, route,
    servo as servo_picture,
};
use trunnion_syntax::LineIndex;

pub(super) use gather::{gather, gather_path, marks, marks_of, plan};

/// `plot`
#[derive(clap::Args)]
pub(crate) struct Plot {
    /// The program; `-` reads standard input.
    file: PathBuf,
    /// What to draw. The error surface is drawn by `trunnion surface --plot`.
    #[arg(long, value_enum)]
    kind: Kind,
    /// Where to write the picture (SVG). Default: standard output.
    #[arg(short, long, value_name = "FILE.svg")]
    output: Option<PathBuf>,
    /// joints: draw over the travel of the tip, or over time.
    #[arg(long, value_enum, default_value = "path")]
    along: Axis,
    /// axis-plane, route: a second program, drawn over the first as "after".
    #[arg(long, value_name = "FILE")]
    after: Option<PathBuf>,
    /// axis-plane: draw only what is within this many degrees of the pole.
    #[arg(long, value_name = "DEG")]
    around_pole: Option<f64>,
    /// Draw only the blocks of these lines, for example 100-250.
    #[arg(long, value_name = "FIRST[-LAST]", value_parser = super::args::lines::lines)]
    lines: Option<(u32, u32)>,
    /// servo: the corner at the start of the motion in this line.
    #[arg(long, value_name = "LINE")]
    at: Option<u32>,
    #[command(flatten, next_help_heading = "With --kind servo")]
    servo: ServoOptions,
}

/// Kinds of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Kind {
    /// The position of each axis with its limits, and the blocks with findings.
    Joints,
    /// The tool axis seen along the pole, over lines of equal rotary positions.
    AxisPlane,
    /// Deviation of the tip from the programmed segments.
    Deviation,
    /// Programmed feed, the highest that the axes reach, and the planned one.
    Feed,
    /// The real path in space.
    Path,
    /// Rapid motions past the declared obstacles, seen from above.
    Route,
    /// A corner as the servo loops run it: reference, path, errors; needs --at LINE.
    Servo,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Axis {
    #[value(name = "path", alias = "way")]
    Way,
    Time,
}

/// Runs `plot`.
pub(super) fn run(global: &Global, command: &Plot) -> Result<Done, Failure> {
    let lines = command.lines;
    if let Some(angle) = command.around_pole
        && !(angle > 0.0 && angle <= 90.0)
    {
        return Err(Failure::new(format!(
            "--around-pole {angle}: must be between 0 and 90 deg"
        )));
    }
    let loaded = load::load_for_steps(global, &command.file)?;
    let machine = loaded.machine_or_fail("plot")?;
    let mut outputs = loaded.outputs();
    if let Some(after) = &command.after {
        outputs.input(after);
    }
    let output = command
        .output
        .as_ref()
        .map(|path| outputs.output("-o", path))
        .transpose()?;
    if command.kind == Kind::Servo {
        let text = waiting::during(global, "drawing", &command.file, || {
            draw_servo(command, &loaded, machine)
        })?;
        load::put(output.as_ref(), text.as_bytes())?;
        return Ok(Done::Clean);
    }
    let record = waiting::during(global, "drawing", &command.file, || {
        let mut record = if command.kind == Kind::Path {
            gather_path(&loaded, machine, lines)
        } else {
            let shows = Shows {
                deviation: command.kind == Kind::Deviation,
                feed: command.kind == Kind::Feed,
            };
            gather(&loaded, machine, lines, shows)
        };
        if command.kind == Kind::Feed {
            plan(&loaded, machine, &mut record);
        }
        record
    });
    if let Some(left_out) = record.not_drawn() {
        remark(global.quiet, &format!("{}: {left_out}", loaded.name));
    }
    if let Some(line) = record.coarse_from {
        remark(
            global.quiet,
            &format!(
                "{}: from line {line} on each motion is drawn by its ends alone; --lines FIRST-LAST draws a part in detail",
                loaded.name
            ),
        );
    }
    let text = waiting::during(global, "drawing", &command.file, || {
        draw(global, command, &loaded, machine, &record, lines)
    })
    .map_err(|error| named(&command.file, error))?;
    load::put(output.as_ref(), text.as_bytes())?;
    Ok(Done::Clean)
}

fn draw(
    global: &Global,
    command: &Plot,
    loaded: &Loaded,
    machine: &Machine,
    record: &Record,
    lines: Option<(u32, u32)>,
) -> Result<String, Drawing> {
    let tolerance = machine.tolerances.tip_mm;
    let head = |title: &str| header(title, loaded, machine);
    Ok(match command.kind {
        Kind::Joints => {
            let along = if command.along == Axis::Time {
                Along::Time
            } else {
                Along::Way
            };
            joints(
                &head("Joints of the machine"),
                machine,
                record,
                &marks(loaded, lines),
                along,
            )?
        }
        Kind::AxisPlane => {
            let after = match &command.after {
                Some(file) => {
                    let other = load::load_for_steps(global, file)?;
                    Some(gather(&other, machine, None, Shows::default()))
                }
                None => None,
            };
            let title = "Tool axis seen along the pole";
            let marks = marks(loaded, lines);
            axis_plane(
                &head(title),
                machine,
                record,
                &marks,
                after.as_ref(),
                command.around_pole,
            )?
        }
        Kind::Deviation => deviation(&head("Deviation of the tool tip"), record, tolerance)?,
        Kind::Route => {
            let after = match &command.after {
                Some(file) => {
                    let other = load::load_for_steps(global, file)?;
                    Some(gather(&other, machine, None, Shows::default()))
                }
                None => None,
            };
            let space = space(loaded, machine)?;
            route(
                &head("Rapid motions past obstacles"),
                (machine, &space),
                record,
                after.as_ref(),
            )?
        }
        Kind::Feed => feed(&head("Feed of the tool tip"), record)?,
        Kind::Path | Kind::Servo => path(&head("Path of the tool tip"), record, tolerance)?,
    })
}

/// The corner at the start of a line, as the servo loops run it.
fn draw_servo(command: &Plot, loaded: &Loaded, machine: &Machine) -> Result<String, Failure> {
    let line = command
        .at
        .ok_or_else(|| Failure::new("plot --kind servo needs the line that starts at the corner: add --at LINE"))?;
    let cornered = corner(loaded, machine, line, &command.servo)?;
    let (along, across) = cornered.found.corner.plane();
    let flat = |v: &trunnion_geometry::Vec3| [v.dot(&along), v.dot(&across)];
    let spots: Vec<ServoSpot> = cornered
        .response
        .spots
        .iter()
        .map(|spot| ServoSpot {
            time: spot.time,
            reference: flat(&spot.reference),
            position: flat(&spot.position),
            exact: spot.distance * 1e3,
            radial: spot.radial * 1e3,
        })
        .collect();
    let unit = Unit::of_inch(cornered.found.inch);
    let title = format!("Corner at line {line} as the servo loops run it");
    servo_picture(&header(&title, loaded, machine), &spots, unit).map_err(|error| Failure::file(&command.file, error))
}

/// The space of the obstacles at the first rapid motion of the program from a known position.
fn space(loaded: &Loaded, machine: &Machine) -> Result<Space, PlotError> {
    let index = LineIndex::new(loaded.program.source());
    let mut found: Option<Result<Space, String>> = None;
    each_leg(loaded, machine, &index, None, |leg, line, state| {
        let (MotionKind::Rapid, Some(start), None) = (leg.motion.kind, &leg.start, &found) else {
            return;
        };
        let body = state.tool.data().as_ref().and_then(ToolBody::of);
        let space =
            body.ok_or("the diameter of the tool is not declared: [[tool]] diameter in trunnion.toml".to_owned());
        let keep = machine.tolerances.clearance_mm();
        let space = space.and_then(|body| Space::new(machine, &start.joints, start.tool_length, &body, keep));
        found = Some(space.map_err(|why| format!("line {line}: {why}")));
    });
    let none = || Err("nothing to draw: no rapid motion with a known path".to_owned());
    found.unwrap_or_else(none).map_err(PlotError)
}

/// Why a picture is not drawn.
enum Drawing {
    Failure(Failure),
    Plot(PlotError),
}

impl From<Failure> for Drawing {
    fn from(failure: Failure) -> Self {
        Self::Failure(failure)
    }
}

impl From<PlotError> for Drawing {
    fn from(error: PlotError) -> Self {
        Self::Plot(error)
    }
}

fn named(file: &Path, error: Drawing) -> Failure {
    match error {
        Drawing::Failure(failure) => failure,
        Drawing::Plot(error) => Failure::file(file, error),
    }
}

/// The header of a picture of a program on a machine.
pub(super) fn header(title: &str, loaded: &Loaded, machine: &Machine) -> Header {
    header_assuming(title, loaded, machine, &loaded.assumptions())
}

/// The same of a program that is known to assume these values: they are part of what is drawn.
pub(super) fn header_assuming(title: &str, loaded: &Loaded, machine: &Machine, assumed: &[String]) -> Header {
    let file = Path::new(&loaded.name);
    let name = file
        .file_name()
        .map_or(loaded.name.as_str().into(), |name| name.to_string_lossy());
    let subtitle = format!(
        "machine {} ({}), dialect {}",
        machine.name, machine.id, loaded.resolved.dialect.name
    ) + &assuming(assumed);
    Header {
        title: shown(&format!("{title}: {name}")).into_owned(),
        subtitle: shown(&subtitle).into_owned(),
    }
}

/// `; assuming tool offset 1 = 0, G54 = 0 and 3 more`.
fn assuming(assumed: &[String]) -> String {
    const MOST: usize = 3;
    if assumed.is_empty() {
        return String::new();
    }
    let named: Vec<&str> = assumed
        .iter()
        .take(MOST)
        .map(|text| text.trim_end_matches(" (not declared)"))
        .collect();
    let more = match assumed.len() {
        0..=MOST => String::new(),
        all => format!(" and {} more", all - MOST),
    };
    format!("; assuming {}{more}", named.join(", "))
}
