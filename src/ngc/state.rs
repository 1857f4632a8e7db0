//! What is in effect between lines.
use crate::{Canon, FeedMode, MotionMode, Pose, Side};

/// Length units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// G20.
    Inch,
    /// G21.
    Millimetre,
}

impl Units {
    /// mm per unit.
    pub fn mm(self) -> f64 {
        match self {
            Self::Inch => 25.4,
            Self::Millimetre => 1.0,
        }
    }
}

/// Working plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// G17.
    Xy,
    /// G18.
    Xz,
    /// G19.
    Yz,
    /// G17.1.
    Uv,
    /// G18.1.
    Uw,
    /// G19.1.
    Vw,
}

/// The meaning of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistanceMode {
    /// G90, G90.1.
    Absolute,
    /// G91, G91.1.
    Incremental,
}

/// Where canned cycles retract to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RetractMode {
    /// G98.
    OldZ,
    /// G99.
    RPlane,
}

/// The meaning of S.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpindleMode {
    /// G97.
    ConstantRpm,
    /// G96 with the highest 1/min.
    ConstantSurface(f64),
}

/// What is active between lines. Lengths are in the active units unless stated otherwise.
#[derive(Clone, Debug)]
pub struct State {
    /// Units.
    pub units: Units,
    /// Plane.
    pub plane: Plane,
    /// G90 / G91.
    pub distance: DistanceMode,
    /// G90.1 / G91.1.
    pub arc_distance: DistanceMode,
    /// G93-G95.
    pub feed_mode: FeedMode,
    /// F, units/min (or units/rev under G95).
    pub feed_rate: f64,
    /// F of the last motion under G93, 1/min.
    pub inverse_time: f64,
    /// Motion code in effect, ten times its number; -1 before the first, 800 for G80.
    pub motion: i16,
    /// Ten times the number of a G code that is not modelled (`u32::MAX`: one that was refused) and may be the motion
    /// code in effect; never set while only canonical calls are listed, since the run ends there.
    pub unmodelled: Option<u32>,
    /// Last motion code, for canned cycles that depend on it.
    pub last_motion: i16,
    /// The position of the program: program coordinates X Y Z A B C U V W, without compensation of the cutter radius.
    pub current: Pose,
    /// The position of the tool under cutter compensation: program coordinates of the centre (only first and second of the plane matter).
    pub compensated: Pose,
    /// G92 / G52 offset.
    pub axis_offset: Pose,
    /// Offset of the coordinate system in effect.
    pub origin_offset: Pose,
    /// Of each coordinate system, from 1: the axes whose offset `G10 L20` took from the position of the machine, bit by bit.
    pub set_from_position: [u16; 10],
    /// 1-9.
    pub origin_index: i32,
    /// Rotation of the coordinate system in effect, deg.
    pub rotation_xy: f64,
    /// Tool offset in effect.
    pub tool_offset: Pose,
    /// Its tool: H of G43, 0 for the tool in the spindle; -1: not that of one tool (G43.1, G43.2); `None`: G49.
    pub length_of: Option<i32>,
    /// H of G43.2, whose offset was added last.
    pub length_added: Option<i32>,
    /// What the program has set, bit by bit: before that a check knows nothing of it.
    pub said: u8,
    /// G98 / G99.
    pub retract: RetractMode,
    /// Modal words of canned cycles.
    pub cycle: CycleWords,
    /// Compensation side.
    pub side: Side,
    /// Compensation radius, units.
    pub radius: f64,
    /// The tool's edge orientation under lathe compensation, 0-9.
    pub orientation: i32,
    /// The program itself gives the radius (G41.1, G42.1): it does not come from the tool table.
    pub radius_given: bool,
    /// No compensated move was made yet since G41/G42.
    pub first_compensated: bool,
    /// Compensation has ended and the tool is still on its path: the next motion must be straight.
    pub exit_pending: bool,
    /// G7: X words are diameters.
    pub lathe_diameter: bool,
    /// G96 / G97 per spindle.
    pub spindle_mode: [SpindleMode; 8],
    /// S per spindle.
    pub speed: [f64; 8],
    /// 0: stopped, 1: clockwise, -1: counter-clockwise; per spindle.
    pub turning: [i8; 8],
    /// The spindle that threads and feed per revolution follow: the last `$` of a thread, or that of G93 to G97 (without: the first).
    pub chosen_spindle: usize,
    /// Coolant.
    pub mist: bool,
    /// Coolant.
    pub flood: bool,
    /// G61, G61.1, G64.
    pub motion_mode: MotionMode,
    /// Q of G64.
    pub naive_tolerance: f64,
    /// In which P and Q of G64 are.
    pub(crate) tolerance_units: Units,
    /// T: tool number that was selected, -1 for none.
    pub selected_tool: i32,
    /// Tool in the spindle, 0 for none.
    pub tool: i32,
    /// Rows of the tool table as they are now; row 0 is the spindle.
    pub tools: std::sync::Arc<crate::ToolRows>,
    /// Pocket of the row that was loaded last, which each change writes into row 0; -1 before the first.
    pub(crate) spindle_pocket: i32,
    /// Row of the selected tool, 0 for none.
    pub selected_row: i32,
    /// Row of the tool in the spindle.
    pub current_row: i32,
    /// Whether A, B, C are wrapped rotary axes: absolute words are 0 to below 360 deg, their sign gives the direction.
    pub wrapped: [bool; 3],
    /// The position assumed by the receiver of the calls.
    pub told: ReceiverPosition,
    /// Override switches (M48-M53).
    pub feed_override: bool,
    /// See above.
    pub speed_override: bool,
    /// See above.
    pub adaptive_feed: bool,
    /// See above.
    pub feed_hold: bool,
    /// Axes with words in the current block: bit i is axis i of a [`Pose`].
    pub named_axes: u16,
    /// The line that runs while compensation emits what it has held back: the listing uses its number for calls.
    pub emitting_line: Option<crate::At>,
    /// The spindle's row of the tool table before the last change.
    pub(crate) spindle_row_before: Option<crate::ToolEntry>,
    /// The motions of the current block end at points given in machine coordinates (G53, G28, G30).
    pub machine_frame: bool,
    /// The current block is only one straight motion, compensation is off: nothing changes after its motion's call.
    pub motion_only: bool,
    /// The last probing has touched.
    pub probed: bool,
    /// Length of a line for G93, program end etc. was reached.
    pub ended: bool,
}

/// Words that canned cycles keep between their lines.
#[derive(Clone, Copy, Debug, Default)]
pub struct CycleWords {
    /// R plane.
    pub r: f64,
    /// Bottom, absolute, along the plane's axis.
    pub cc: f64,
    /// I of G76, G87.
    pub i: f64,
    /// J of G87.
    pub j: f64,
    /// K of G87.
    pub k: f64,
    /// Repeats.
    pub l: i32,
    /// Dwell, s.
    pub p: f64,
    /// Peck.
    pub q: f64,
    /// Coordinate along the plane's axis where the first of a row of cycles began: G98 retracts there.
    pub old: f64,
}

/// The tool position assumed by the receiver of the canonical calls, which knows only the calls. `rs274` queries it after a tool change,
/// and it does not know that rotation and tool offset move the program's coordinates.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReceiverPosition {
    /// Program coordinates.
    pub position: Pose,
    origin: Pose,
    axis_offset: Pose,
    inch: bool,
}

impl ReceiverPosition {
    /// At the start of a program.
    pub(crate) fn at(position: Pose, origin: Pose, axis_offset: Pose) -> Self {
        Self {
            position,
            origin,
            axis_offset,
            inch: false,
        }
    }
    /// Follows one call.
    #[inline]
    pub(crate) fn follow(&mut self, call: &Canon) {
        match call {
            Canon::Traverse(pose) | Canon::Feed(pose) => self.reach(pose),
            Canon::Nurbs { end, .. } => self.reach(end),
            Canon::G5xOffset(_, pose) => self.shift(*pose, false),
            Canon::G92Offset(pose) => self.shift(*pose, true),
            Canon::Units(units) => self.units(*units == Units::Inch),
            _ => {}
        }
    }
    fn shift(&mut self, new: Pose, axis_offset: bool) {
        let old = if axis_offset {
            &mut self.axis_offset
        } else {
            &mut self.origin
        };
        // the listing's machine does not use offsets of U V W
        for axis in 0..6 {
            self.position[axis] += old[axis] - new[axis];
        }
        *old = new;
    }
    fn units(&mut self, inch: bool) {
        if inch == self.inch {
            return;
        }
        self.inch = inch;
        let factor = if inch { 1.0 / 25.4 } else { 25.4 };
        for pose in [&mut self.position, &mut self.origin, &mut self.axis_offset] {
            for axis in [0, 1, 2, 6, 7, 8] {
                pose[axis] *= factor;
            }
        }
    }
    /// A motion whose call does not contain the whole pose has ended.
    #[inline]
    pub(crate) fn reach(&mut self, end: &Pose) {
        // the listing's machine has no U V W
        self.position[..6].copy_from_slice(&end[..6]);
    }
}

impl State {
    /// Where the tool is, program coordinates: on the contour, or on its compensated path once compensation has moved it there.
    pub fn position(&self) -> Pose {
        *self.place()
    }
    /// The same, mutable.
    #[inline]
    pub(crate) fn place(&self) -> &Pose {
        if self.side == Side::Off || self.first_compensated {
            &self.current
        } else {
            &self.compensated
        }
    }
    /// As `rs274` starts: millimetres, XY plane, everything zero; `unknown`: the position is NaN instead.
    pub fn new(unknown: bool) -> Self {
        let position = [if unknown { f64::NAN } else { 0.0 }; 9];
        Self {
            units: Units::Millimetre,
            plane: Plane::Xy,
            distance: DistanceMode::Absolute,
            arc_distance: DistanceMode::Incremental,
            feed_mode: FeedMode::PerMinute,
            feed_rate: 0.0,
            inverse_time: 0.0,
            motion: 800,
            unmodelled: None,
            last_motion: 0,
            current: position,
            compensated: position,
            axis_offset: [0.0; 9],
            origin_offset: [0.0; 9],
            set_from_position: [0; 10],
            origin_index: 1,
            rotation_xy: 0.0,
            tool_offset: [0.0; 9],
            length_of: None,
            length_added: None,
            said: 0,
            retract: RetractMode::RPlane,
            cycle: CycleWords::default(),
            side: Side::Off,
            radius: 0.0,
            orientation: 0,
            radius_given: false,
            first_compensated: true,
            exit_pending: false,
            lathe_diameter: false,
            spindle_mode: [SpindleMode::ConstantRpm; 8],
            speed: [0.0; 8],
            turning: [0; 8],
            chosen_spindle: 0,
            mist: false,
            flood: false,
            motion_mode: MotionMode::Continuous(0.0),
            naive_tolerance: 0.0,
            tolerance_units: Units::Millimetre,
            selected_tool: -1,
            tool: 0,
            tools: std::sync::Arc::default(),
            spindle_pocket: -1,
            selected_row: 0,
            current_row: 1,
            wrapped: [false; 3],
            told: ReceiverPosition::default(),
            feed_override: true,
            speed_override: true,
            adaptive_feed: false,
            feed_hold: true,
            named_axes: 0,
            emitting_line: None,
            spindle_row_before: None,
            machine_frame: false,
            motion_only: false,
            probed: false,
            ended: false,
        }
    }
}

/// Bits of [`State::said`].
pub(crate) mod said {
    /// T.
    pub(crate) const SELECTED: u8 = 1;
    /// M6, M61.
    pub(crate) const TOOL: u8 = 2;
    /// G43 to G49.
    pub(crate) const LENGTH: u8 = 4;
    /// M3, M4, M5, M19.
    pub(crate) const SPINDLE: u8 = 8;
    /// S.
    pub(crate) const SPEED: u8 = 16;
    /// M7, M8, M9.
    pub(crate) const COOLANT: u8 = 32;
    /// G54 to G59.3.
    pub(crate) const SYSTEM: u8 = 64;
}
