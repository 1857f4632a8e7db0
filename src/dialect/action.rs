//! What a code does, in words the interpreter understands. Dialect tables map `G70` or `TRAORI` to these.
use serde::Deserialize;

/// The working plane of arcs and cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Plane {
    /// G17.
    Xy,
    /// G18.
    Zx,
    /// G19.
    Yz,
}

/// What a code does. In TOML: `action = "rapid"`, kebab-case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Action {
    /// G0.
    Rapid,
    /// G1.
    Linear,
    /// G2.
    ArcClockwise,
    /// G3.
    ArcCounterClockwise,
    /// G4.
    Dwell,
    /// G17.
    PlaneXy,
    /// G18.
    PlaneZx,
    /// G19.
    PlaneYz,
    /// G90.
    Absolute,
    /// G91.
    Incremental,
    /// G90.1: arc centres absolute.
    ArcCentreAbsolute,
    /// G91.1: arc centres incremental.
    ArcCentreIncremental,
    /// G20 / G70: inch, feeds too (G20), see `InchLengthsOnly`.
    Inch,
    /// Sinumerik G70: lengths in inch, F stays.
    InchLengthsOnly,
    /// G21 / G71 / G710.
    Metric,
    /// G93.
    FeedInverseTime,
    /// G94.
    FeedPerMinute,
    /// G95.
    FeedPerRevolution,
    /// G40.
    CompensationOff,
    /// G41: path not modelled yet, so motions under it are the programmed ones and the run says so.
    CompensationLeft,
    /// G42.
    CompensationRight,
    /// G43.
    ToolLengthOn,
    /// G49 (also ends tool centre point control).
    ToolLengthOff,
    /// G43.4, TRAORI, M428 ...: tip is programmed, rotary axes in words.
    TcpOn,
    /// G43.5: tip and tool vector are programmed.
    TcpVectorOn,
    /// TRAFOOF, M129 ...
    TcpOff,
    /// G53: this block in machine coordinates.
    MachineCoordinates,
    /// G54 ... : select a work offset; the code's own id is the offset's name.
    WorkOffset,
    /// Sinumerik G500: no settable offset.
    WorkOffsetNone,
    /// M3.
    SpindleClockwise,
    /// M4.
    SpindleCounterClockwise,
    /// M5.
    SpindleStop,
    /// M6.
    ToolChange,
    /// M0, M1: stop, goes on.
    ProgramStop,
    /// M2, M30, M17.
    ProgramEnd,
    /// Coolant and other codes without motion and without effect on what is checked.
    NoMotion,
    /// Exact stop / continuous path modes: no effect on the programmed path.
    PathMode,
    /// Recognised, but its motion or its effect on the position is not modelled: what follows is unknown.
    NotModelled,
    /// Recognised, moves nothing and changes no position, but what it does change (what F counts for, limits) is not modelled: said
    /// once. A G code of this kind uses up the coordinates of its block.
    NotFollowed,
    /// Moves, turns, mirrors or scales the coordinates in a way that is not modelled (G68.2, G92, CYCLE800, TRANS): machine
    /// positions are unknown from here on, until a [`Action::FrameReset`] of the same group. A name without arguments and
    /// without words in its block (`TRANS`, `CYCLE800()`) resets.
    FrameChange,
    /// Ends every [`Action::FrameChange`] of the same group (G69).
    FrameReset,
    /// DEF, PROC, EXTERN: declares names; no motion and no positions in the rest of the block.
    Declaration,
    /// A modal cycle that is not modelled yet (G81; MCALL CYCLE81): blocks with coordinates after it run it, until `CycleOff`
    /// or a motion code.
    CannedCycle,
    /// G80; MCALL without a cycle.
    CycleOff,
    /// G96: S is a cutting speed, so the spindle's turns are unknown.
    ConstantSurfaceSpeed,
    /// G97: S is turns per minute.
    ConstantSpindleSpeed,
    /// A call of a subprogram, a jump, a condition or a loop: which blocks run, and what they change, is not followed, so all that
    /// comes after is unknown until it is programmed again.
    SubprogramCall,
    /// Sinumerik ORIAXES / ORIVECT and the like: orientation interpolated joint-linear.
    OrientationAxes,
    /// Orientation interpolated on the great circle.
    OrientationVector,
}

/// The role of a word's letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Block number.
    BlockNumber,
    /// Program or subprogram number.
    ProgramNumber,
    /// Preparatory code.
    G,
    /// Miscellaneous code.
    M,
    /// Coordinate of an axis (the axis letter is the word's letter).
    Axis,
    /// Arc centre I, J, K (also direction vector under `TcpVectorOn`).
    ArcCentre,
    /// Arc radius R, CR=.
    ArcRadius,
    /// Further full turns of an arc, TURN=.
    ArcTurns,
    /// Component of the tool vector A3= B3= C3=.
    ToolVector,
    /// Feed F.
    Feed,
    /// Spindle speed S.
    Speed,
    /// Tool T.
    Tool,
    /// Tool length offset number H.
    LengthOffset,
    /// Cutting edge / offset number D.
    EdgeOffset,
    /// A parameter of the code in the block (P, Q, L, ...).
    Parameter,
    /// A variable of the program (R1=): no motion; its value is not followed.
    Variable,
    /// Recognised; it moves nothing, but what it changes (posture, feed limit) is not modelled: said once.
    NotFollowed,
    /// Recognised, but it changes the path or calls a program in a way that is not modelled (RND=, CHF=, A2=, L20).
    NotModelled,
}
