//! The machine as a chain of axes from workpiece to tool. Internal units: mm, rad, s.
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
    /// +1: ISO 841 (positive = tool relative to workpiece); -1: turned round.
    pub sign: f64,
    /// Travel.
    pub limits: Limits,
    /// Highest speed, mm/s or rad/s; `None`: not declared.
    pub max_speed: Option<f64>,
    /// Highest acceleration, mm/s^2 or rad/s^2; `None`: not declared.
    pub max_acceleration: Option<f64>,
    /// A word on where speed or limits come from ("assumed"), for people.
    pub note: Option<String>,
}

/// How the control interpolates.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// A dialect / family name, or `generic`.
    pub family: String,
    /// With TCP: orientation on the great circle (true) or joint-linear (false).
    pub tcp_great_circle: bool,
    /// Whether the machine file said so, or it is the default.
    pub tcp_declared: bool,
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
    /// pole-crossing: distance to the pole, rad.
    pub pole_touch: f64,
    /// feed-drop: share of the programmed feed below which a warning is given.
    pub feed_drop_warning: f64,
    /// feed-drop: share below which it is an error.
    pub feed_drop_error: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        let deg = trunnion_geometry::rad;
        Self {
            tip_mm: 0.01,
            pole_cone: deg(2.0),
            pole_angle: deg(10.0),
            swap_excess: deg(5.0),
            pole_touch: deg(0.01),
            feed_drop_warning: 0.8,
            feed_drop_error: 0.3,
        }
    }
}

/// A machine: validated, ready for kinematics.
#[derive(Clone, Debug)]
pub struct Machine {
    /// `mikron-ucp710`.
    pub id: String,
    /// Name for people.
    pub name: String,
    /// Axes from workpiece to tool.
    pub axes: Vec<Axis>,
    /// k0: unit tool axis tip -> spindle at home.
    pub tool_axis: Vec3,
    /// Gauge point at home with all joints zero, machine frame, mm.
    pub gauge_point: Vec3,
    /// Control.
    pub control: Control,
    /// Thresholds.
    pub tolerances: Tolerances,
    /// Where the numbers come from.
    pub sources: Vec<String>,
    /// Indices of the rotary axes in chain order (0, 1 or 2 of them).
    pub rotary: Vec<usize>,
    /// Indices of the linear axes in chain order.
    pub linear: Vec<usize>,
    /// For each of `AXIS_LETTERS`, the joint it drives.
    pub joint_of_letter: [Option<u8>; 9],
}
