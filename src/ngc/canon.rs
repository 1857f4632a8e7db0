//! Canonical calls: the interpreter's commands to the machine. Lengths are in the active units (see [`Canon::Units`]), in
//! the coordinates of the program: G5x, G92, tool offset and XY rotation are set by separate calls and not added.
use crate::{Plane, Units};
use std::sync::Arc;

/// X Y Z A B C U V W.
pub type Pose = [f64; 9];

/// Direction of the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleTurn {
    /// M3.
    Clockwise,
    /// M4.
    CounterClockwise,
    /// M5.
    Stop,
}

/// Coolant switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coolant {
    /// M7.
    MistOn,
    /// M9.
    MistOff,
    /// M8.
    FloodOn,
    /// M9.
    FloodOff,
}

/// Stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// M0, M60.
    Program,
    /// M1.
    Optional,
    /// M2, M30.
    End,
}

/// Cutter compensation side, shown by comments of the interpreter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// G40.
    #[default]
    Off,
    /// G41.
    Left,
    /// G42.
    Right,
}

/// Override switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Switch {
    /// M50 (and M48, M49).
    FeedOverride,
    /// M51 (and M48, M49), of a spindle.
    SpeedOverride(i32),
    /// M52.
    AdaptiveFeed,
    /// M53.
    FeedHold,
}

/// Path control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionMode {
    /// G61.
    ExactPath,
    /// G61.1.
    ExactStop,
    /// G64 with tolerance P, program units.
    Continuous(f64),
}

/// Feed coupled to the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SyncedFeed {
    /// Units per revolution.
    pub per_revolution: f64,
    /// Whether it couples position or velocity (G95).
    pub velocity: bool,
}

/// One canonical call.
#[derive(Clone, Debug, PartialEq)]
pub enum Canon {
    /// Units of lengths from here on.
    Units(Units),
    /// Coordinate system 1-9 and its offset.
    G5xOffset(i32, Pose),
    /// G92 / G52 offset.
    G92Offset(Pose),
    /// Rotation of the coordinate system about Z, deg.
    XyRotation(f64),
    /// What F is measured along.
    FeedReference,
    /// The interpreter was reset.
    Reset,
    /// Working plane.
    Plane(Plane),
    /// A comment of the program, or the interpreter's own remark on a modal change (text begins `interpreter: `).
    Comment(Arc<[u8]>),
    /// Text for the operator: `(MSG,...)`, `(DEBUG,...)`.
    Message(Arc<[u8]>),
    /// Text printed by `(PRINT,...)`: goes to standard output or error of the control, not to the operator.
    Print(Arc<[u8]>),
    /// `(LOG,...)`, `(LOGOPEN,...)`, `(LOGAPPEND,...)`, `(LOGCLOSE)`, `(PROBEOPEN ...)`, `(PROBECLOSE)`: the text as written.
    Log(Arc<[u8]>),
    /// F in units/min; 0 where feed is inverse time before its first motion.
    FeedRate(f64),
    /// Mode of a spindle's feed: spindle, mode (0: per minute or inverse time, 1: per revolution).
    FeedMode(i32, i32),
    /// Path control.
    MotionMode(MotionMode),
    /// Tolerance of merging collinear moves, units.
    NaiveCamTolerance(f64),
    /// Rapid to a pose.
    Traverse(Pose),
    /// Feed to a pose.
    Feed(Pose),
    /// An arc or helix in the working plane.
    Arc {
        /// First and second coordinate of the plane at the end (XY: X, Y; ZX: Z, X; YZ: Y, Z).
        end: [f64; 2],
        /// Centre, the same coordinates.
        centre: [f64; 2],
        /// Full turns plus one, positive counter-clockwise; never 0.
        turns: i32,
        /// Coordinate along the plane's axis at the end.
        axis_end: f64,
        /// A B C U V W at the end.
        others: [f64; 6],
    },
    /// A NURBS curve in the working plane (G5, G5.1, G5.2): degree plus one, control points (x, y, weight), and knots where the program
    /// gives them.
    Nurbs {
        /// Order: degree + 1.
        order: u32,
        /// First and second coordinate of the plane, weight.
        points: Arc<[[f64; 3]]>,
        /// Empty: the control's own clamped uniform knots.
        knots: Arc<[f64]>,
        /// Pose at the end.
        end: Pose,
    },
    /// Straight probing toward a pose: kind 2-5 of G38.n.
    Probe(u8, Pose),
    /// The probe is to be read: only the machine knows the point where it touched.
    ProbeResult,
    /// Rigid tapping to X Y Z and back, with the speed ratio of the retract.
    RigidTap([f64; 3], f64),
    /// Feed couples to the spindle.
    StartSync(SyncedFeed),
    /// Coupling ends.
    StopSync,
    /// Dwell, s.
    Dwell(f64),
    /// Spindle number, 1/min or surface speed (see [`Canon::SpindleMode`]).
    SpindleSpeed(i32, f64),
    /// Spindle number, css maximum (0: plain turns per minute; otherwise G96 with this ceiling in 1/min).
    SpindleMode(i32, f64),
    /// Spindle number, direction.
    Spindle(i32, SpindleTurn),
    /// Spindle number, angle deg, direction 0-2.
    OrientSpindle(i32, f64, i32),
    /// Waits for the orientation, at most this many seconds.
    WaitOrient(i32, f64),
    /// Coolant.
    Coolant(Coolant),
    /// T.
    SelectTool(i32),
    /// M6 begins: the spindle may be off from here on.
    StartChange,
    /// M6: the tool that is loaded, and its row of the tool table (0: no tool, -1: none was selected).
    ChangeTool {
        /// T.
        tool: i32,
        /// From 1; what `rs274` prints.
        row: i32,
    },
    /// M61: the tool that is in the spindle, and its row of the tool table.
    ChangeToolNumber {
        /// Q.
        tool: i32,
        /// From 1; what `rs274` prints.
        row: i32,
    },
    /// Tool offset in effect.
    ToolOffset(Pose),
    /// A row of the tool table is written (G10 L1, L10, L11): row (0: the spindle) and what it holds now.
    SetToolEntry(i32, crate::ToolEntry),
    /// G10 L0: the table is read from its file again.
    ReloadTools,
    /// M48-M53.
    Switch(Switch, bool),
    /// M62-M65: output number, on or off, with the next motion (M62, M63) or at once.
    DigitalOutput {
        /// P.
        index: i32,
        /// M62, M64 switch on.
        on: bool,
        /// With the next motion.
        with_motion: bool,
    },
    /// M67, M68: output number and value, with the next motion (M67) or at once.
    AnalogOutput {
        /// E.
        index: i32,
        /// Q.
        value: f64,
        /// With the next motion.
        with_motion: bool,
    },
    /// M66: waits for an input; only the machine knows what it reads.
    WaitInput {
        /// P or E.
        index: i32,
        /// E: a voltage, not a switch.
        analog: bool,
        /// L 0-4: at once, rise, fall, high, low.
        until: i32,
        /// Q, s.
        timeout: f64,
    },
    /// The machine's own codes of one block were run in an unknown order; what they do is unknown here.
    OwnCodes(Vec<crate::OwnCode>),
    /// M100-M199 with P and Q.
    UserCode(i32, f64, f64),
    /// Stops and end.
    Stop(Stop),
    /// Pallet shuttle.
    PalletShuttle,
    /// The program ends with `%` instead of M2: nothing is reset.
    Finish,
}
