//! What a program is run with: tools, offsets, bounds, other programs. All lengths mm, angles deg.
use crate::{Files, Limits, Progress};
use std::sync::Arc;

/// Shape of a tool's cutting part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolShape {
    /// Ball end: radius = diameter / 2.
    Ball,
    /// Flat end.
    Flat,
    /// Corner radius in mm.
    Bull(f64),
    /// A tool of a lathe: its nose.
    Turning(Nose),
}

/// The nose of a turning tool. Programs move the corner of the square around it (the imaginary tip) where no compensation is active.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nose {
    /// mm.
    pub radius_mm: f64,
    /// Where that corner is, seen from the centre of the nose, 0 to 9: 1 at +Z +X, 2 at -Z +X, 3 at -Z -X, 4 at +Z -X, 5 at +Z, 6 at +X,
    /// 7 at -Z, 8 at -X, 0 and 9 at the centre (Fanuc Series 30i operator's manual, direction of the imaginary tool nose).
    pub tip: u8,
}

/// A tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Number, 0 = the tool in use whatever its number (from `--tool`).
    pub number: u32,
    /// Shape, if declared.
    pub shape: Option<ToolShape>,
    /// mm, if declared.
    pub diameter_mm: Option<f64>,
    /// mm, if declared.
    pub length_mm: Option<f64>,
    /// Diameter of the holder above the tool, mm, if declared.
    pub holder_mm: Option<f64>,
}

/// A work offset: the position of the part zero in machine coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkOffset {
    /// `G54`.
    pub name: String,
    /// mm / deg in the order of `AXIS_LETTERS`.
    pub values: [f64; 9],
}

/// The source of called programs; without it there are no other files.
#[derive(Clone, Default)]
pub struct Library(pub Option<Arc<dyn Files>>);

impl core::fmt::Debug for Library {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(if self.0.is_some() {
            "Library(files)"
        } else {
            "Library(none)"
        })
    }
}

impl PartialEq for Library {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

/// What a number without a decimal point means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImplicitDecimals {
    /// Least increments: X10 is 0.010 mm (0.0010 inch), as a Fanuc with parameter 3401.0 = 0 and a Haas without setting 162 read it.
    LeastIncrement,
    /// As a pocket calculator: X10 is 10 mm (Fanuc parameter 3401.0 = 1, Haas setting 162).
    Calculator,
}

/// The unit of lengths at the start of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// mm, mm/min.
    Millimetre,
    /// inch, inch/min.
    Inch,
}

impl LengthUnit {
    /// mm per unit.
    pub fn mm(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Inch => 25.4,
        }
    }
}

/// How a turning tool leaves the cuts of a roughing cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoughingEscape {
    /// At the feed of the cuts.
    Feed,
    /// In rapid.
    Rapid,
}

/// The axis along which drilling cycles of a Fanuc drill in another plane than G17 (parameter FXY).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrillingAxis {
    /// Always Z.
    Z,
    /// That across the plane: Y under G18, X under G19.
    AcrossPlane,
}

/// How cutter compensation goes around an outer corner (Fanuc parameter 19607.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OuterCorner {
    /// By lines.
    #[default]
    Lines,
    /// By an arc about the corner.
    Arc,
}

/// Codes of the machine's builder for tool centre point control, as `M428`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TcpCodes {
    /// On: X Y Z are the tip in the workpiece frame.
    pub on: Vec<String>,
    /// Off: X Y Z are the joints.
    pub off: Vec<String>,
    /// It is on when a program begins.
    pub at_start: bool,
}

impl TcpCodes {
    /// Whether a code switches it on or off; `None`: it is not among them.
    pub fn meaning(&self, code: &str) -> Option<bool> {
        let has = |list: &[String]| list.iter().any(|known| known.eq_ignore_ascii_case(code));
        if has(&self.on) {
            Some(true)
        } else {
            has(&self.off).then_some(false)
        }
    }
}

/// What the angles of a tilted plane given by roll, pitch and yaw turn about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RollPitchYaw {
    /// The axes of the workpiece, which stay (as PLANE SPATIAL of a Heidenhain: A, then B, then C about fixed axes).
    Fixed,
    /// The axes as they come out of the turns before.
    Turned,
}

/// In which order several angles of a frame turn (Sinumerik machine data 10600 FRAME_ANGLE_INPUT_MODE).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameAngles {
    /// 1: about Z, the new Y, the new X.
    RollPitchYaw,
    /// 2: Euler angles about Z, the new X, the new Z; which word is which turn is not followed.
    Euler,
}

/// Over which parameter the splines of a Sinumerik run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplineReading {
    /// ASPLINE and CSPLINE over the lengths of their chords, CSPLINE without curvature at its ends; BSPLINE with evenly spaced knots.
    ChordLength,
}

/// Which axes cycle 11 of a HEIDENHAIN control scales (machine parameter 7410).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScaledAxes {
    /// 1: those of the working plane.
    Plane,
    /// 0: all three principal axes.
    All,
}

/// What the length of CHF of a HEIDENHAIN control measures: its manuals call it both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChamferLength {
    /// How much the chamfer takes off each of its two lines.
    Side,
    /// The chamfer itself, from line to line.
    Face,
}

/// How the arguments of CYCLE802 of a Sinumerik are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HolePlaces {
    /// Nine digits for X and nine for Y, the last one of the first place: 1 absolute, 2 from the place before; then X and Y of up to nine
    /// places in pairs.
    Pairs,
}

/// How a rotary axis of the machine turns the tool against the workpiece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryTurn {
    /// Index of its letter in [`crate::AXIS_LETTERS`].
    pub letter: usize,
    /// Unit vector: a word of +1 deg turns the tool in the workpiece by 1 deg about it, right-handed.
    pub direction: [f64; 3],
    /// It turns the workpiece, not the tool.
    pub on_table: bool,
}

impl RotaryTurn {
    /// Which of X, Y and Z it turns about, and 1 or -1 for its sense; `None` where it is not parallel to one of them.
    pub fn along(&self) -> Option<(usize, f64)> {
        let along = (0..3).find(|along| (self.direction[*along].abs() - 1.0).abs() < 1e-12)?;
        Some((along, self.direction[along].signum()))
    }
}

/// Parameters of the control that programs depend on; what is not declared is unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ControlData {
    /// Unit in effect before the program says one (G20, G21); `None`: unknown, mm is taken.
    pub units: Option<LengthUnit>,
    /// What X10 means; `None`: it is read as 10 mm and each such word is reported.
    pub implicit_decimals: Option<ImplicitDecimals>,
    /// G73: how far the tool goes back after each step, mm (Fanuc parameter 5114, Haas setting 22).
    pub chip_break_retract_mm: Option<f64>,
    /// G83: how far above the last depth the rapid back into the hole ends, mm (Fanuc parameter 5115).
    pub peck_clearance_mm: Option<f64>,
    /// G76, G87: along which axis of the plane (0 to 2: X Y Z), and in which direction (1 or -1), Q moves the stopped tool off the wall (Fanuc
    /// parameter 5148, Haas setting 27); `None`: not declared, X Y are unknown while it is off the wall.
    pub bore_shift: Option<(usize, f64)>,
    /// The number of the main spindle of a Sinumerik (machine data 20090): S1= and M1=3 are then its S and M3; `None`: not declared.
    pub main_spindle: Option<u32>,
    /// Which axis drills in G18 and G19 on a Fanuc mill; `None`: not declared, such cycles are unknown.
    pub drilling_axis: Option<DrillingAxis>,
    /// G71 and G72 of a lathe: how the tool leaves its cuts; `None`: not declared, that short motion is unknown.
    pub roughing_escape: Option<RoughingEscape>,
    /// How many leads before its end the tool leaves a thread of one pass (Fanuc parameter 5130); 0: at its end. `None`: unknown.
    pub thread_pull_out: Option<f64>,
    /// G71 and G72 in one block: how far the tool goes off a cut, mm (Fanuc parameter 5133, Haas setting 73).
    pub roughing_retract_mm: Option<f64>,
    /// G76 in one block: the least depth of a cut, mm (Fanuc parameter 5140, Haas setting 99).
    pub thread_least_cut_mm: Option<f64>,
    /// G76 in one block: what the last cut is left, mm (Fanuc parameter 5141, Haas setting 86).
    pub thread_finish_mm: Option<f64>,
    /// LinuxCNC: how far the arcs that it makes of G5, G5.1 and G5.2 are at most from the curve, mm. `None`: unknown.
    pub spline_arcs_mm: Option<f64>,
    /// Path of cutter compensation around outer corners.
    pub outer_corner: OuterCorner,
    /// Whether the switch for block delete (`/`) is on, so that such blocks are skipped; `None`: unknown, they are run.
    pub block_delete: Option<bool>,
    /// What the angles of G68.2 P1 turn about; `None`: not declared, planes with two or three of them are unknown.
    pub roll_pitch_yaw: Option<RollPitchYaw>,
    /// In which order ROT and CROT of a Sinumerik turn about several axes; `None`: not declared, such frames are unknown.
    pub frame_angles: Option<FrameAngles>,
    /// Over which parameter ASPLINE, BSPLINE and CSPLINE run; `None`: not declared, their paths are unknown.
    pub splines: Option<SplineReading>,
    /// Which axes cycle 11 of Klartext scales; `None`: not declared, positions after it are unknown.
    pub scaled_axes: Option<ScaledAxes>,
    /// What the length of CHF of Klartext measures; `None`: not declared, the path at such a corner is unknown.
    pub chamfer_length: Option<ChamferLength>,
    /// How the arguments of CYCLE802 are read; `None`: not declared, positions after it are unknown.
    pub hole_places: Option<HolePlaces>,
    /// Whether the first incremental coordinate after another zero point or frame travels the change too (Sinumerik setting data 42440
    /// FRAME_OFFSET_INCR_PROG); `None`: not declared, where such a coordinate leads is unknown.
    pub increment_adds_frame: Option<bool>,
    /// The same after another tool length (Sinumerik setting data 42442 TOOL_OFFSET_INCR_PROG).
    pub increment_adds_length: Option<bool>,
    /// Whether ASIN and ATAN of Macro B give angles from 0 to 360 degrees (Fanuc parameter 6004 bit 0, NAT, is 0), else negative ones; `None`:
    /// not declared, such an angle is unknown.
    pub positive_angles: Option<bool>,
    /// Codes that switch the kinematics between tool centre point control and joints (`M428`); `None`: the machine does not say.
    pub tcp_codes: Option<TcpCodes>,
    /// Codes by which a program closes and opens the clamps of rotary axes, as the machine names them.
    pub clamp_codes: crate::AllClampCodes,
    /// Letters of axes that the machine has in addition to X Y Z A B C: on a LinuxCNC only they are words (`[TRAJ] COORDINATES`).
    pub further_axes: Vec<u8>,
    /// The axis that a machine with two linear axes lacks, an index into [`crate::AXIS_LETTERS`]: it is always at 0.
    pub absent_axis: Option<u8>,
    /// A machine is known, and with it the letters of its axes.
    pub axes_declared: bool,
    /// The machine has rotary axes; `false` also where no machine is known.
    pub has_rotary: bool,
    /// By how much 1 mm of tool length shifts the words of X, Y and Z without tool centre point control: the tool axis at home, as the
    /// machine says; `None`: Z by 1 mm. LinuxCNC always takes it along Z.
    pub length_along: Option<[f64; 3]>,
    /// X words of the machine are diameters.
    pub x_diameter: bool,
    /// The rotary axes of the machine, workpiece side first; `None`: no machine is known, or its home is not that of the formulas (a tool
    /// axis other than Z, a rotary axis that is held in place).
    pub rotary_turns: Option<Vec<RotaryTurn>>,
    /// Reference points in machine coordinates, mm and degrees: G28 goes to the first, G30 P2 to the second.
    pub reference_points: Vec<crate::Position>,
    /// Fixed points of a Sinumerik in machine coordinates, mm and degrees: G75 goes to the first, G75 FP=2 to the second;
    /// `None`: not declared.
    pub fixed_points: Option<Vec<crate::Position>>,
    /// Where the axes are after a tool change (M6), in machine coordinates, mm and degrees; those without a value stay where they are.
    /// `None`: not declared, X Y Z are unknown after it.
    pub tool_change: Option<crate::Position>,
    /// G codes in effect at power-on, as the machine declares them: `G17`. Of other groups the dialect says it, as where there are none.
    pub power_on: Option<Vec<String>>,
}

/// What a program is run with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setup {
    /// Declared tools.
    pub tools: Vec<Tool>,
    /// Declared work offsets.
    pub work_offsets: Vec<WorkOffset>,
    /// Declared offsets of the tools of a lathe.
    pub tool_offsets: ToolOffsets,
    /// Bounds of the run. Blocks of the program itself, each once, are always within them.
    pub limits: Limits,
    /// Programs that this one may call.
    pub library: Library,
    /// Parameters of the control.
    pub control: ControlData,
    /// Lets an axis of X, Y, Z that no word of the program names stand at 0: for judging one program, where its place changes nothing. Two
    /// programs that are compared may differ in what they name.
    pub unnamed_stand: bool,
    /// Runs the subprograms of a file that only defines them, with arguments that are unknown: for judging one program. Programs that are
    /// compared do only what their own blocks do.
    pub enter_definitions: bool,
    /// Numbered variables that have a value before the program runs, sorted by number, each once; `None` is vacant. In program units.
    pub variables: Vec<(u32, Option<f64>)>,
    /// The same for variables with names.
    pub named_variables: NamedVariables,
    /// Where whoever waits sees how far the run is.
    pub progress: Progress,
}

/// Variables with names that have a value before the program runs, as their language writes them, sorted, each once: `R1` (Sinumerik), `Q5`, `QR1`
/// (Klartext), `V1`, `VC1` (Okuma), `#<_name>` (LinuxCNC). Each language reads its own. In program units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedVariables(pub Vec<(String, f64)>);

/// Offsets that T of a lathe names with its last two digits, sorted by number, each once: by how much the axes stand further than the
/// coordinates say, mm in the order of `AXIS_LETTERS`, X as a radius as in [`WorkOffset`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolOffsets(pub Vec<(u32, [f64; 9])>);

impl ToolOffsets {
    /// That of a number, where it is declared.
    pub fn get(&self, number: u32) -> Option<[f64; 9]> {
        let found = self.0.iter().find(|(known, _)| *known == number);
        found.map(|(_, values)| *values)
    }
}

impl Setup {
    /// A declared work offset by its name, in either case.
    pub fn work_offset(&self, name: &str) -> Option<&WorkOffset> {
        self.work_offsets
            .iter()
            .find(|offset| offset.name.eq_ignore_ascii_case(name))
    }

    /// By how much 1 mm of tool length shifts the words of X, Y and Z while they are joints.
    pub fn length_along(&self) -> [f64; 3] {
        self.control.length_along.unwrap_or([0.0, 0.0, 1.0])
    }
}
