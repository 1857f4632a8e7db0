//! The machine as a chain of axes from workpiece to tool. Internal units: mm, rad, s.
use crate::{Branch, Constants};
use trunnion_geometry::Vec3;

/// The most axes a machine may have.
pub const MAX_AXES: usize = 9;

/// Joint values in chain order, mm or rad.
pub type Joints = [f64; MAX_AXES];

/// Linear or rotary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKind {
    /// mm.
    Linear,
    /// rad.
    Rotary,
}

/// Which side of the cut the axis carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Moves the workpiece.
    Table,
    /// Moves the tool.
    Head,
}

/// Travel of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limits {
    /// Endless.
    Unbounded,
    /// Lowest and highest joint value, mm or rad.
    Range(f64, f64),
}

/// One axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Upper case letter.
    pub letter: u8,
    /// Kind.
    pub kind: AxisKind,
    /// Side.
    pub side: Side,
    /// Unit direction at home, machine frame.
    pub direction: Vec3,
    /// Any point of a rotary axis at home, machine frame, mm.
    pub point: Vec3,
    /// +1: ISO 841 (positive = tool relative to workpiece); -1: reversed.
    pub sign: f64,
    /// Travel.
    pub limits: Limits,
    /// Highest speed, mm/s or rad/s; `None`: not declared.
    pub max_speed: Option<f64>,
    /// Highest acceleration, mm/s^2 or rad/s^2; `None`: not declared.
    pub max_acceleration: Option<f64>,
    /// A note on where speed or limits come from ("assumed"), for people.
    pub note: Option<String>,
    /// Where the numbers of this axis come from.
    pub source: Option<String>,
    /// Properties that no formula of this crate needs.
    pub extra: AxisExtra,
}

/// How a control reads a rotary word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Wrap {
    /// The value as written, with its turns.
    #[default]
    Literal,
    /// The shortest turn to the angle (M126).
    Shortest,
    /// The angle modulo 360 deg; the sign of the word is the direction of turning.
    ModuloSign,
}

/// Properties of an axis beyond kinematics.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct AxisExtra {
    /// How the control reads a rotary word.
    pub wrap: Wrap,
    /// The axis must not move while cutting (3+2, indexed).
    pub clamp: bool,
    /// M codes by which a program clamps the axis and releases it; `None`: the file names none.
    pub clamp_codes: Option<trunnion_interp::ClampCodes>,
    /// The turns of the axis wind up a cable or a hose.
    pub cable: bool,
    /// The axis is also a spindle (mill-turn).
    pub spindle: bool,
    /// Words of a linear axis are diameters, joint values are radii.
    pub diameter: bool,
    /// Whether the file states limits (or that there are none).
    pub limits_declared: bool,
    /// Warn when nearer than this to a limit, mm or rad; `None`: only outside.
    pub limit_margin: Option<f64>,
    /// Smallest step, mm or rad; `None`: not declared.
    pub resolution: Option<f64>,
    /// Highest jerk, mm/s^3 or rad/s^3; `None`: not declared.
    pub max_jerk: Option<f64>,
    /// Position loop gain, 1/s; `None`: not declared.
    pub position_gain: Option<f64>,
    /// Share of velocity feed-forward, 0..=1; `None`: not declared.
    pub feed_forward: Option<f64>,
    /// Uncertainty of the axis' point, mm; `None`: not declared.
    pub point_uncertainty: Option<f64>,
    /// Uncertainty of the axis' direction, rad; `None`: not declared.
    pub direction_uncertainty: Option<f64>,
    /// A rotary axis beyond the two that inverse kinematics solves for is held at this value, rad; `None`: it moves.
    pub hold: Option<f64>,
}

/// An axis that only mirrors another one (gantry); it is not a joint of the chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gantry {
    /// Letter of the mirroring axis.
    pub letter: u8,
    /// Letter of the axis it follows.
    pub leader: u8,
}

/// How axes move in rapid motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum RapidPath {
    /// The file does not say.
    #[default]
    Undeclared,
    /// All axes arrive together.
    Synchronous,
    /// Each axis runs at its own speed.
    Dogleg,
}

/// What a control does inside its cone about the pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum PoleAction {
    /// It continues as anywhere else.
    #[default]
    Through,
    /// It holds the first rotary axis.
    Hold,
    /// It stops with an alarm (Fanuc 30i: parameter 19696, bit NPC; PS5421).
    Alarm,
}

/// What F measures where rotary and linear axes move together without TCP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMeaning {
    /// The path of X Y Z, mm; where these do not move the angle, deg (RS274/NGC).
    Xyz,
    /// The root of the squares of mm and deg of all axes.
    Combined,
}

/// A rigid body that is attached to a part of the machine (for clearance checks).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Body {
    /// Axis letter, `base`, `spindle` or `workpiece`.
    pub carrier: String,
    /// File with the shape, relative to the machine file.
    pub mesh: String,
}

/// How the control interpolates.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// A dialect / family name, or `generic`.
    pub family: String,
    /// With TCP: orientation on the great circle (true) or joint-linear (false).
    pub tcp_great_circle: bool,
    /// Whether the machine file declares it, or it is the default.
    pub tcp_declared: bool,
    /// How axes move in rapid motions.
    pub rapid: RapidPath,
    /// How the control picks postures.
    pub branch: Branch,
    /// Cone about the pole inside which the control acts, rad; `None`: not declared.
    pub pole_cone: Option<f64>,
    /// What it does there.
    pub pole_action: PoleAction,
    /// What F measures where rotary and linear axes move together without TCP; `None`: not declared, X Y Z are taken.
    pub feed: Option<FeedMeaning>,
    /// Corner speed model (axis-jump, grbl, klipper, linuxcnc-g64, exact-stop, servo); `None`: not declared.
    pub corner_model: Option<String>,
    /// Shortest time the control needs per block, s; `None`: not declared.
    pub block_time: Option<f64>,
    /// Codes of the builder that switch tool centre point control (LinuxCNC's M428 ...); `None`: not declared.
    pub tcp_codes: Option<trunnion_interp::TcpCodes>,
    /// The meaning of words that request a posture: STAT, TU, G53.1 P.
    pub posture_words: crate::PostureWords,
    /// Unit of lengths before a program says one; `None`: not declared.
    pub units: Option<trunnion_interp::LengthUnit>,
    /// Reference points of G28, G30 P2, ... in the order of their numbers: machine coordinates, mm and deg; `None`: not declared.
    pub reference_points: Option<Vec<trunnion_interp::Position>>,
    /// Fixed points of G75, G75 FP=2, ... of a Sinumerik, in the same form.
    pub fixed_points: Option<Vec<trunnion_interp::Position>>,
    /// Where the rapid back into a hole ends, above the last depth (G83), mm; `None`: not declared.
    pub peck_clearance_mm: Option<f64>,
    /// How far G73 retracts to break the chip, mm; `None`: not declared.
    pub chip_break_retract_mm: Option<f64>,
    /// Number of the main spindle of a Sinumerik; `None`: not declared.
    pub main_spindle: Option<u32>,
    /// Which axis drilling cycles of a Fanuc drill along in G18 and G19; `None`: not declared.
    pub drilling_axis: Option<trunnion_interp::DrillingAxis>,
    /// How a turning tool leaves the cuts of a roughing cycle; `None`: not declared.
    pub roughing_escape: Option<trunnion_interp::RoughingEscape>,
    /// How many leads before its end the tool leaves a thread of one pass; `None`: not declared.
    pub thread_pull_out: Option<f64>,
    /// How far the tool goes off a cut of a roughing cycle in one block, mm; `None`: not declared.
    pub roughing_retract_mm: Option<f64>,
    /// Least depth of a cut of a threading cycle in one block, mm; `None`: not declared.
    pub thread_least_cut_mm: Option<f64>,
    /// What the last cut of such a cycle is left, mm; `None`: not declared.
    pub thread_finish_mm: Option<f64>,
    /// How far the arcs that the control makes of a spline (G5) are from the curve, mm; `None`: not declared.
    pub spline_arcs_mm: Option<f64>,
    /// Where a tool change leaves the axes that it moves: machine coordinates, mm and deg; `None`: not declared.
    pub tool_change: Option<trunnion_interp::Position>,
    /// G codes in effect at power-on; those of other groups are not declared.
    pub power_on: Option<Vec<String>>,
    /// How the control plans speeds, and what its servo loops are like.
    pub planning: Planning,
}

/// How a control plans speeds, and its servo loops: how long a path takes and how far corners are cut, not the path of the model. `None`: not declared.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Planning {
    /// axis-jump: speed by which each axis may change at once, by joint, mm/s or rad/s.
    pub corner_jump: [Option<f64>; MAX_AXES],
    /// grbl: junction deviation, mm.
    pub corner_deviation: Option<f64>,
    /// klipper: speed at a square corner, mm/s.
    pub corner_speed: Option<f64>,
    /// servo, linuxcnc-g64: distance by which a corner may be cut, mm.
    pub corner_tolerance: Option<f64>,
    /// Blocks that the control looks ahead.
    pub lookahead: Option<u32>,
    /// Length of the filter after the interpolator, s.
    pub filter_time: Option<f64>,
    /// Time of a tool change, s.
    pub tool_change_time: Option<f64>,
    /// Times of M codes by their numbers, s.
    pub m_times: Vec<(u16, f64)>,
    /// Bandwidth of the velocity loop of the axes, Hz.
    pub servo_bandwidth_hz: Option<f64>,
    /// Time between two samples of the position loop, s.
    pub servo_sample: Option<f64>,
}

/// Thresholds of the rules.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerances {
    /// path-deviation, mm.
    pub tip_mm: f64,
    /// pole-flip: cone about the pole, rad.
    pub pole_cone: f64,
    /// pole-flip: rotary change, rad.
    pub pole_angle: f64,
    /// branch-swap: rotary excess, rad.
    pub swap_excess: f64,
    /// feed-drop: share of the programmed feed below which a warning is given.
    pub feed_drop_warning: f64,
    /// feed-drop: share below which it is an error.
    pub feed_drop_error: f64,
    /// orientation-deviation, rad.
    pub orientation: f64,
    /// swept-deviation, mm.
    pub swept_mm: f64,
    /// excess-rotary-travel: turn of the rotary axes over turn of the tool axis.
    pub rotary_ratio: f64,
    /// excess-linear-travel: travel of the linear axes divided by travel of the tip.
    pub linear_ratio: f64,
    /// excess-rapid-travel: travel of the rapid motions divided by the direct distance.
    pub rapid_ratio: f64,
    /// pivot-uncertainty, mm.
    pub pivot_mm: f64,
    /// near-miss: clearance below which a warning is given, mm.
    pub near_mm: f64,
    /// Distance that rapid motions keep from obstacles, mm; `None`: not declared, see [`Tolerances::clearance_mm`].
    pub clearance_mm: Option<f64>,
}

impl Tolerances {
    /// Distance that rapid motions keep from obstacles, mm: 1 mm where it is not declared.
    pub fn clearance_mm(&self) -> f64 {
        self.clearance_mm.unwrap_or(1.0)
    }
}

impl Default for Tolerances {
    fn default() -> Self {
        let deg = trunnion_geometry::rad;
        Self {
            tip_mm: 0.01,
            pole_cone: deg(2.0),
            pole_angle: deg(10.0),
            swap_excess: deg(5.0),
            feed_drop_warning: 0.8,
            feed_drop_error: 0.3,
            orientation: deg(0.1),
            swept_mm: 0.05,
            rotary_ratio: 20.0,
            linear_ratio: 5.0,
            rapid_ratio: 2.0,
            pivot_mm: crate::kinematics::uncertainty::PIVOT_SENSITIVITY,
            near_mm: 2.0,
            clearance_mm: None,
        }
    }
}

/// Tool axis and gauge point with every joint at zero, machine frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Home {
    /// Unit vector, tip -> spindle.
    pub tool_axis: Vec3,
    /// mm.
    pub gauge_point: Vec3,
}

/// A machine: validated, ready for kinematics. Only `load` makes one; the axes and `constants` belong together: change the file, not the fields.
#[derive(Clone, Debug)]
pub struct Machine {
    /// `mikron-ucp710`.
    pub id: String,
    /// Name for people.
    pub name: String,
    /// Axes from workpiece to tool.
    pub axes: Vec<Axis>,
    /// k0: unit tool axis tip -> spindle at home, carried by the held axes to where they hold it.
    pub tool_axis: Vec3,
    /// Gauge point at home with all moving joints zero, machine frame, carried by the held axes, mm.
    pub gauge_point: Vec3,
    /// The same two with all joints zero, also those of held axes.
    pub home: Home,
    /// Control.
    pub control: Control,
    /// Thresholds.
    pub tolerances: Tolerances,
    /// Where the numbers come from.
    pub sources: Vec<String>,
    /// Indices of the rotary axes that move, in chain order (0, 1 or 2 of them).
    pub rotary: Vec<usize>,
    /// Indices of the linear axes in chain order.
    pub linear: Vec<usize>,
    /// For each of `AXIS_LETTERS`, the joint it drives.
    pub joint_of_letter: [Option<u8>; 9],
    /// Precomputed kinematics of the chain.
    pub constants: Constants,
    /// Axes that mirror another one.
    pub gantries: Vec<Gantry>,
    /// Letter of the axis that a machine with two linear axes lacks (Y of a lathe): it is the last of `axes`, and never moves.
    pub absent: Option<u8>,
    /// Rigid bodies.
    pub bodies: Vec<Body>,
    /// What the tool must not touch.
    pub obstacles: crate::Obstacles,
    /// What the file declares and nothing uses yet, one sentence each: rules that depend on it judge without it.
    pub not_used: Vec<String>,
    /// What is suspicious about the file but usable, one sentence each.
    pub warnings: Vec<String>,
    /// How many `[[check]]` rows the file has: all hold.
    pub checks: usize,
    /// Those of `not_used` that could change a verdict of the rules there are: with them nothing passes.
    pub not_judged: Vec<String>,
    /// The most pieces of 2 deg of the long turns of a run ([`crate::NoStance::TurnsSpent`]): half of `[limits] steps`, not of the file.
    pub most_turned: u64,
}

impl Machine {
    /// The joint that a letter drives (either case); `None` when the machine has no such axis.
    pub fn joint(&self, letter: u8) -> Option<usize> {
        let upper = letter.to_ascii_uppercase();
        self.axes.iter().position(|axis| axis.letter == upper)
    }

    /// The axes that it really has, with their joints.
    pub fn own_axes(&self) -> impl Iterator<Item = (usize, &Axis)> {
        let axes = self.axes.iter().enumerate();
        axes.filter(|(_, axis)| Some(axis.letter) != self.absent)
    }

    /// The codes of its clamps, in the form of the interpreter.
    pub fn clamp_codes(&self) -> trunnion_interp::AllClampCodes {
        let mut codes = trunnion_interp::AllClampCodes::default();
        for axis in &self.axes {
            let letter = trunnion_interp::AxisLetter::new(axis.letter);
            if let Some(slot) = letter.and_then(|letter| codes.get_mut(usize::from(letter.0))) {
                *slot = axis.extra.clamp_codes;
            }
        }
        codes
    }
}
