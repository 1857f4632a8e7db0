//! What is programmed, block by block: machine-free motions.
use crate::ChainId;
use trunnion_geometry::{Vec3, arc::Arc};
use trunnion_syntax::BlockId;

/// The letters of axes in the order of [`Position`].
pub const AXIS_LETTERS: [u8; 9] = *b"XYZABCUVW";

/// Index of an axis letter in [`AXIS_LETTERS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AxisLetter(pub u8);

impl AxisLetter {
    /// From a letter, either case; `None` when it names no axis.
    #[inline]
    pub fn new(letter: u8) -> Option<Self> {
        match letter.to_ascii_uppercase() {
            upper @ b'X'..=b'Z' => Some(Self(upper - b'X')),
            upper @ b'A'..=b'C' => Some(Self(3 + upper - b'A')),
            upper @ b'U'..=b'W' => Some(Self(6 + upper - b'U')),
            _ => None,
        }
    }
    /// The letter, upper case.
    pub fn letter(self) -> u8 {
        AXIS_LETTERS[usize::from(self.0)]
    }
}

/// Lengths of a tool that differ by no more are the same, mm: rounding from changes of the unit.
const SAME_LENGTH_MM: f64 = 1e-6;

/// Programmed coordinates of all axes: X Y Z U V W in mm, A B C in degrees, each known or unknown.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Position {
    /// Values in the order of [`AXIS_LETTERS`]; meaningless where unknown.
    pub values: [f64; 9],
    /// Bit i: axis i is known.
    pub known: u16,
}

impl Position {
    /// Value of an axis, if known.
    #[inline]
    pub fn get(&self, axis: usize) -> Option<f64> {
        (self.known & (1 << axis) != 0).then(|| self.values[axis])
    }
    /// Sets an axis to a known value.
    #[inline]
    pub fn set(&mut self, axis: usize, value: f64) {
        self.values[axis] = value;
        self.known |= 1 << axis;
    }
    /// Makes an axis unknown.
    pub fn forget(&mut self, axis: usize) {
        self.known &= !(1 << axis);
    }
    /// X, Y, Z in mm if all three are known.
    pub fn xyz(&self) -> Option<Vec3> {
        (self.known & 7 == 7).then(|| Vec3::new(self.values[0], self.values[1], self.values[2]))
    }
}

/// The feed of a motion as programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// mm/min (deg/min where only rotary axes move, as the control says).
    PerMinute(f64),
    /// mm per spindle revolution.
    PerRevolution(f64),
    /// G93: the block takes 1/F minutes.
    InverseTime(f64),
    /// No feed was programmed yet.
    Unknown,
    /// Rapid.
    Rapid,
}

/// How the tool's orientation is programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// Rotary words A B C in [`Position`].
    Words,
    /// A unit tool vector tip -> spindle in the workpiece frame, at start (if known) and end.
    Vector(Option<Vec3>, Vec3),
}

/// Which of several postures the program requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Posture {
    /// The control's own rule.
    #[default]
    ByRule,
    /// The lower value of the axis to which the preferred direction refers (CYCLE800 with direction -1).
    Lower,
    /// The higher value of it (CYCLE800 with direction 1).
    Higher,
    /// The solution with this number (G53.1 P1).
    Numbered(u8),
    /// STAT and TU of a Sinumerik, bit by bit, as far as they are programmed.
    Bits {
        /// STAT.
        status: Option<u16>,
        /// TU.
        turn: Option<u16>,
    },
}

impl Posture {
    /// Whether it is that of a preferred direction of one axis.
    pub const fn is_direction(self) -> bool {
        matches!(self, Self::Lower | Self::Higher)
    }
}

/// Whether a motion only turns the rotary axes, so that the tool is parallel to its vector, and what the linear axes do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Swivel {
    /// An ordinary motion.
    #[default]
    No,
    /// The linear axes stay (G53.1).
    AxesStay,
    /// The tip stays (G53.6).
    TipStays,
    /// The linear axes move to a position that the program does not give (CYCLE800 with a retract).
    AxesLost,
    /// No turn: the motion ends where a guided tip would, and until then all axes move linearly (Sinumerik PTP).
    PointToPoint,
}

/// The effect of a tilted working plane on a motion.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Tilt {
    /// Unit normal, workpiece frame, of the tilted plane in which X Y Z are programmed; the tool must be parallel to it. X Y Z of the
    /// motion are then the tip in the workpiece frame, as under TCP. `None`: no such plane, or TCP guides the tip anyway.
    pub normal: Option<Vec3>,
    /// Whether the motion only turns the rotary axes.
    pub swivel: Swivel,
    /// The requested posture.
    pub posture: Posture,
    /// Coordinates of the plane that the program does not know at the end, bits as in [`Position::known`]: there the tool stays where it
    /// is on the machine. All of X Y Z: a block that names none; the linear axes stay, `normal` is `None`. Z, or X and Y (of the plane): X Y Z
    /// of `end` hold, unmarked, the point in the workpiece frame that has zero there.
    pub free: u16,
}

/// What kind of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionKind {
    /// Rapid traverse.
    Rapid,
    /// Feed along a line.
    Linear,
    /// Feed along an arc or helix in programmed coordinates; `None` when its centre is not known.
    Arc(Option<Arc>),
    /// Dwell, seconds (`None`: unknown, e.g. in spindle turns).
    Dwell(Option<f64>),
    /// A motion that is recognised but not modelled: the end is unknown.
    Unknown,
}

/// Values that a motion depends on and that neither the settings nor the program declare: they are computed as zero, and are unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Undeclared {
    /// Axes whose zero point is not declared, bits as in [`Position::known`].
    pub zero: u16,
    /// The active tool length is not declared.
    pub length: bool,
    /// Axes that it shifts, where it is the offset of a lathe's tool, bits as in [`Position::known`].
    pub by_turret: u16,
    /// The zero point was set at the position of the machine (G92).
    pub set_here: bool,
    /// Axes in which the tool runs beside the programmed path by an amount that is not computed (cutter radius compensation), bits as in
    /// [`Position::known`].
    pub beside: u16,
    /// That amount is the radius of a tool that nothing declares; else compensation is not modelled.
    pub by_radius: bool,
}

impl Undeclared {
    /// No zero point is declared.
    pub const ALL_ZEROS: u16 = (1 << AXIS_LETTERS.len()) - 1;
    /// The linear axes, which the offset of a lathe's tool shifts.
    pub const BY_TURRET: u16 = 0b1_1100_0111;
    /// Nothing is undeclared.
    pub const NOTHING: Self = Self {
        zero: 0,
        length: false,
        by_turret: 0,
        set_here: false,
        beside: 0,
        by_radius: false,
    };

    /// What of it concerns some axes, bits as in [`Position::known`]; a tool length concerns Z, the offset of a lathe's tool all linear ones.
    pub fn of_axes(self, axes: u16) -> Self {
        const Z: u16 = 1 << 2;
        let zero = self.zero & axes;
        let by_turret = self.by_turret & axes;
        let depends = if self.by_turret == 0 { axes & Z } else { by_turret };
        Self {
            zero,
            length: self.length && depends != 0,
            by_turret,
            set_here: self.set_here && zero != 0,
            beside: self.beside & axes,
            by_radius: self.by_radius,
        }
    }
    /// Whether the zero point or the length is undeclared.
    #[inline]
    pub fn any(self) -> bool {
        self.zero != 0 || self.length
    }
    /// Whether the place of the tool depends on anything undeclared, its radius included.
    #[inline]
    pub fn open(self) -> bool {
        self.any() || self.beside != 0
    }
}

/// Spindle speed during a motion at constant cutting speed (G96): it changes with the radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    /// That with which the motion takes as long as it does at F per turn, 1/min.
    pub mean_rpm: f64,
    /// The highest, 1/min.
    pub most_rpm: f64,
}

/// How absolute words turn rotary axes, as masks with bits as in [`Position::known`]. The coordinates of a motion have the turns that the words
/// take from the coordinate before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Ways {
    /// In the shorter direction: DC(), M126.
    pub shortest: u16,
    /// Forward: ACP().
    pub forward: u16,
    /// Back: ACN().
    pub back: u16,
    /// Plain words of an axis that such a word has carried to a coordinate beyond what it said: 370 for DC(10).
    pub carried: u16,
}

impl Ways {
    /// Letters whose direction is given.
    pub fn directed(self) -> u16 {
        self.shortest | self.forward | self.back
    }
}

/// One motion as programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The block where it ends: of the main program. For a motion inside another file the block of the call that led there.
    pub block: BlockId,
    /// How it came about; `Interpreter::chain` of the interp floor returns the calls.
    pub chain: ChainId,
    /// Kind.
    pub kind: MotionKind,
    /// Programmed coordinates before, without work offset.
    pub start: Position,
    /// Programmed coordinates after, without work offset.
    pub end: Position,
    /// Letters whose words are not plain positions. Incremental ones and those with a direction (`ACP`) define the direction themselves: no control turns
    /// such a rotary word in another direction. Where such a letter, or one whose value is unknown, has no known end, the block moved the
    /// axis to an unknown position; other letters without a known end were not named. Bits as in [`Position::known`].
    pub says_way: u16,
    /// Directions of rotary words.
    pub ways: Ways,
    /// Words or vector.
    pub orientation: Orientation,
    /// Tool centre point control is active: X Y Z are the tip in the workpiece frame.
    pub tcp: bool,
    /// While TCP is on: orientation runs on the great circle (else joint-linear); `None`: the machine's control decides.
    pub great_circle: Option<bool>,
    /// Feed.
    pub feed: Feed,
    /// Spindle on; `None` unknown (before any spindle word nothing is assumed).
    pub spindle_on: Option<bool>,
    /// Spindle speed, 1/min.
    pub spindle_rpm: Option<f64>,
    /// The same at constant cutting speed (G96), where it is known.
    pub spin: Option<Spin>,
    /// Work offset in effect, mm / deg, order of [`AXIS_LETTERS`]; to be added unless the words are machine coordinates.
    pub zero: [f64; 9],
    /// Length of the tool that is compensated, mm: G43 H / active D / TCP. Zero when off or undeclared. In effect also where the words are
    /// machine coordinates, which it does not shift.
    pub tool_length_mm: f64,
    /// Which of the two is not declared; neither for machine coordinates.
    pub undeclared: Undeclared,
    /// Programmed under G53: machine coordinates.
    pub machine_coordinates: bool,
    /// The control itself reads X words as diameters, or was set not to (turning dialects, G7 of LinuxCNC): coordinates are radii,
    /// whatever the machine file says about words.
    pub radii: bool,
    /// Number of the tool in use, if known.
    pub tool: Option<u32>,
    /// Tilted working plane.
    pub tilt: Tilt,
    /// How many effects ([`crate::Effect`]) the run had before the motion; 0 if effects are not requested.
    pub effects: u32,
    /// How often the machine had moved before it without a motion of the program, as a tool change moves it. Where this number is not that of the motion
    /// before, the linear axes are where [`Self::start`] says; their position is unknown if it does not say so.
    pub relocations: u32,
    /// The motion stands for a piece of a curve, which leaves it by at most so much, and it leaves the piece by no more, mm. 0: it is the path itself.
    pub slack_mm: f64,
}

impl Motion {
    /// Spindle speed to compute its time with, 1/min.
    pub fn mean_rpm(&self) -> Option<f64> {
        self.spindle_rpm.or(self.spin.map(|spin| spin.mean_rpm))
    }

    /// The highest spindle speed of it, 1/min.
    pub fn most_rpm(&self) -> Option<f64> {
        self.spindle_rpm.or(self.spin.map(|spin| spin.most_rpm))
    }

    /// A feed motion in axis words that no program contains: nothing is active with it (no offset, no tool, no tool centre point control;
    /// feed and spindle are not set).
    pub fn line(start: Position, end: Position) -> Self {
        Self {
            block: BlockId(0),
            chain: ChainId::MAIN,
            kind: MotionKind::Linear,
            start,
            end,
            says_way: 0,
            ways: Ways::default(),
            orientation: Orientation::Words,
            tcp: false,
            great_circle: None,
            feed: Feed::Unknown,
            spindle_on: None,
            spindle_rpm: None,
            spin: None,
            zero: [0.0; 9],
            tool_length_mm: 0.0,
            undeclared: Undeclared::NOTHING,
            machine_coordinates: false,
            radii: false,
            tool: None,
            tilt: Tilt::default(),
            effects: 0,
            relocations: 0,
            slack_mm: 0.0,
        }
    }
    /// Its words are machine coordinates: no offset, no length and no tool centre point control applies. `moved`: the axes that it names, bits
    /// as in [`Position::known`]; the others stand where earlier words have brought them, and still depend on what was undeclared there.
    pub fn in_machine_coordinates(&mut self, moved: u16) {
        (self.machine_coordinates, self.tcp) = (true, false);
        self.undeclared = self.undeclared.of_axes(self.start.known & !moved);
    }
    /// Whether it is a feed motion (line or arc).
    pub fn is_feed(&self) -> bool {
        matches!(self.kind, MotionKind::Linear | MotionKind::Arc(_))
    }
    /// Declared length of the tool in use, mm, where the active compensation is another one: then the tip is not where X Y Z say.
    #[inline]
    pub fn other_length(&self, declared_mm: Option<f64>) -> Option<f64> {
        declared_mm.filter(|own| (own - self.tool_length_mm).abs() > SAME_LENGTH_MM)
    }
    /// Engaged, until stock is known: a feed motion with the spindle on.
    pub fn is_engaged(&self) -> bool {
        self.is_feed() && self.spindle_on == Some(true)
    }
}

#[cfg(test)]
mod tests {
    use super::{AXIS_LETTERS, AxisLetter};

    #[test]
    fn letters_of_axes_are_found_in_either_case() {
        for byte in 0..=u8::MAX {
            let place = AXIS_LETTERS.iter().position(|letter| byte.eq_ignore_ascii_case(letter));
            assert_eq!(AxisLetter::new(byte).map(|axis| usize::from(axis.0)), place, "{byte}");
        }
    }
}
