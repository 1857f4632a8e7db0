//! `sample`: test pieces with known answers, as cutter locations or as programs for a machine and a dialect, good or with a planted fault.
mod answers;
mod faulty_machine;
mod joints;
mod make;
mod post;
mod required;

use super::{Done, args::Global, failure::Failure, load};
use std::path::{Path, PathBuf};
use trunnion_files::Outputs;
use trunnion_geometry::Vec3;
use trunnion_machine::Machine;
use trunnion_pieces::Piece;
use trunnion_workspace::find_machine;

/// `sample`
#[derive(clap::Args)]
pub(crate) struct Sample {
    /// The piece.
    #[arg(value_enum)]
    piece: Kind,
    /// Angle between the wall of the cone and its axis, in deg (cone; default 15).
    #[arg(long, value_name = "DEG")]
    half_angle: Option<f64>,
    /// Tilt in deg: of the cone axis (default 10), of the whole S-wall (0), of the tool on circles and fixed-tip (20).
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    tilt: Option<f64>,
    /// Radius in mm: of the cone wall at the tip (default 80), of circles (60), of the fixed tip from the zero point (40).
    #[arg(long, value_name = "MM")]
    radius: Option<f64>,
    /// Number of blocks (cone, circles, fixed-tip: default 360; staircase: 1000).
    #[arg(long, value_name = "N")]
    segments: Option<usize>,
    /// Points per line of the saddle's zigzag (default 20).
    #[arg(long, value_name = "N")]
    columns: Option<usize>,
    /// Lines of the saddle's zigzag (default 20).
    #[arg(long, value_name = "N")]
    rows: Option<usize>,
    /// Leg of the corner-set (default 30), step of the staircase (0.02), side of the circle-diamond-square (100), mm.
    #[arg(long, value_name = "MM")]
    size: Option<f64>,
    /// Largest lean of the S-wall, deg (default 15).
    #[arg(long, value_name = "DEG")]
    lean: Option<f64>,
    /// Swings of the S-wall's lean (default 2).
    #[arg(long, value_name = "K")]
    waves: Option<usize>,
    /// Side of the S-wall (default left); its faces are 3 mm apart.
    #[arg(long, value_enum)]
    side: Option<WallSide>,
    /// Chord error of the points of the S-wall, mm (default 0.01).
    #[arg(long, value_name = "MM")]
    chord: Option<f64>,
    /// Diameter of the tool, mm (cone, s-wall: default 20; circle-diamond-square: 10; 0: the tip runs on the wall itself).
    #[arg(long, value_name = "MM")]
    tool_diameter: Option<f64>,
    /// Feed, mm/min (default 500; corner-set 1000, staircase 5000).
    #[arg(long, value_name = "MM/MIN")]
    feed: Option<f64>,
    /// The position of the part zero, added to every point, in mm.
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
    origin: Option<Vec<f64>>,
    /// What the blocks contain (only with --machine; without one the cutter locations are written in APT).
    #[arg(long, value_enum, default_value = "words")]
    style: Style,
    /// The posture: as the control chooses, or the same one throughout.
    #[arg(long, value_enum, default_value = "control")]
    posture: Posture,
    /// With --posture positive or negative: nearest takes the turn nearest to the previous one, naive the angle in -180..180 deg.
    #[arg(long, value_enum, default_value = "nearest")]
    windings: WindingChoice,
    /// Add a deliberate fault that a check should find; pivot writes the machine file with a rotary axis 0.05 mm off.
    #[arg(long, value_enum)]
    plant: Option<Plant>,
    /// Write the program to this file (default: standard output).
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Also write the required surface (saddle, s-wall), as `trunnion surface --required` reads it.
    #[arg(long, value_name = "FILE.toml")]
    required: Option<PathBuf>,
    /// Print the closed-form answers of the piece (JSON) instead of a program.
    #[arg(long)]
    answers: bool,
}

/// A face of the S-wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum WallSide {
    Left,
    Right,
}

/// The pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Kind {
    /// Frustum whose wall is milled with the flank; the axis is tilted.
    Cone,
    /// Ruled wall along an S whose lean changes sign.
    SWall,
    /// Tip on a circle, turning axis one full turn.
    CircleC,
    /// Tip on an arc, tilting axis through the pole.
    CircleA,
    /// Tip on a circle, both rotary axes.
    CircleAc,
    /// The tip stays still while both rotary axes sweep.
    FixedTip,
    /// Surface of two humps in zigzag.
    Saddle,
    /// Three-axis corners of 135, 90 and 45 deg.
    CornerSet,
    /// Three-axis staircase of short steps.
    Staircase,
    /// Three-axis contour: circle, diamond, square, 3 deg square.
    CircleDiamondSquare,
}

/// What the blocks of a program say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Style {
    /// Tip and rotary words under tool centre point control.
    Words,
    /// Tip and tool vector under tool centre point control.
    Vectors,
    /// Machine coordinates of all axes, without tool centre point control.
    Joints,
}

impl Style {
    /// As on the command line.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Words => "words",
            Self::Vectors => "vectors",
            Self::Joints => "joints",
        }
    }
}

/// Which posture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Posture {
    Control,
    /// The one with the larger second rotary joint.
    Positive,
    /// The one with the smaller.
    Negative,
}

/// Which turn of a rotary axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum WindingChoice {
    Nearest,
    Naive,
}

/// Faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Plant {
    /// The second half is in the other posture.
    Swap,
    /// The axis nearest the workpiece turns in the wrong direction.
    WrongSign,
    /// A rotary axis is 0.1 deg beyond its limit in one block.
    Limit,
    /// Tool centre point control is never switched on.
    NoTcp,
    /// H2 (75 mm) instead of H1 for the 80 mm tool.
    WrongH,
    /// G55 instead of G54: declare `G55 = { X = 5 }` as well.
    ShiftG54,
    /// The feed number of an inch program.
    FeedUnit,
    /// A machine file whose last rotary axis is 0.05 mm off.
    Pivot,
}

/// Runs `sample`.
pub(super) fn run(global: &Global, command: &Sample) -> Result<Done, Failure> {
    if command.answers {
        return answers::print(command);
    }
    let machine = match &global.machine {
        Some(name) => Some(find_machine(name, None)?.machine),
        None => None,
    };
    let mut outputs = Outputs::new();
    if let Some(file) = &global.machine {
        outputs.input(Path::new(file));
    }
    let output = command
        .output
        .as_ref()
        .map(|path| outputs.output("-o", path))
        .transpose()?;
    let required = command
        .required
        .as_ref()
        .map(|path| outputs.output("--required", path))
        .transpose()?;
    if command.plant == Some(Plant::Pivot) {
        let name = global.machine.as_deref();
        let text = faulty_machine::pivot_off(name.ok_or_else(|| needs_machine("--plant pivot"))?)?;
        load::put(output.as_ref(), text.as_bytes())?;
        return Ok(Done::Clean);
    }
    let piece = make::piece(command)?.shifted(origin(command)?);
    if let Some(path) = &required {
        let text = required::surface(command, origin(command)?)?;
        path.write(text.as_bytes(), None)?;
    }
    let text = match &machine {
        Some(machine) => posted(global, command, &piece, machine)?,
        None if command.plant.is_some() => return Err(needs_machine("--plant")),
        None if global.dialect.as_deref().is_some_and(|name| name != "apt") => {
            return Err(needs_machine("a program in this dialect"));
        }
        None => post::apt(&piece),
    };
    load::put(output.as_ref(), text.as_bytes())?;
    Ok(Done::Clean)
}

fn needs_machine(what: &str) -> Failure {
    Failure::new(format!(
        "{what} needs a machine: add --machine NAME (`trunnion machine list` lists the built-in ones)"
    ))
}

fn origin(command: &Sample) -> Result<Vec3, Failure> {
    match command.origin.as_deref() {
        None => Ok(Vec3::zeros()),
        Some(&[x, y, z]) if x.is_finite() && y.is_finite() && z.is_finite() => Ok(Vec3::new(x, y, z)),
        Some(_) => Err(Failure::new(
            "--origin X,Y,Z takes three numbers in mm, for example --origin 0,0,50",
        )),
    }
}

fn posted(global: &Global, command: &Sample, piece: &Piece, machine: &Machine) -> Result<String, Failure> {
    let family = machine.control.family.as_str();
    let dialect = match global.dialect.as_deref() {
        Some(name) => name,
        None if trunnion_dialect::builtin(family).is_some() => family,
        None => "fanuc-30i",
    };
    if dialect == "apt" {
        return Ok(post::apt(piece));
    }
    if machine.rotary.len() < 2 && !piece.is_three_axis() {
        return Err(Failure::new(format!(
            "{} turns the tool; {} has {} rotary axes",
            piece.name,
            machine.id,
            machine.rotary.len()
        )));
    }
    let turned = matches!(command.plant, Some(Plant::Swap | Plant::WrongSign | Plant::Limit));
    if turned && command.style == Style::Vectors {
        return Err(Failure::new(
            "tool vectors name no rotary axis: swap, wrong-sign and limit need --style words or joints",
        ));
    }
    let mut places = joints::places(piece, machine, command.posture, command.windings)?;
    match command.plant {
        Some(Plant::Swap) => joints::swap_from_the_middle(piece, machine, &mut places)?,
        Some(Plant::WrongSign) => joints::turn_the_wrong_way(machine, &mut places)?,
        Some(Plant::Limit) => joints::break_a_limit(machine, &mut places)?,
        _ => {}
    }
    let form = post::Form {
        dialect,
        style: command.style,
        plant: command.plant,
    };
    post::program(piece, machine, &places, &form)
}
