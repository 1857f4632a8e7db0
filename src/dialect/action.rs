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
    /// M428 ...: switches the kinematics. The machine file declares which code means tool centre point control; undeclared, X Y Z mean nothing
    /// from here on.
    Kinematics,
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
    /// M0, M1: stop, continues.
    ProgramStop,
    /// M2, M30, M17.
    ProgramEnd,
    /// Coolant and other codes without motion and without effect on what is checked.
    NoMotion,
    /// Exact stop / continuous path modes: no effect on the programmed path.
    PathMode,
    /// Recognised, but its motion or its effect on the position is not modelled: what follows is unknown.
    NotModelled,
    /// Recognised, moves nothing and changes no position, but its effect (on the meaning of F, on limits) is not modelled: reported
    /// once. A G code of this kind uses up the coordinates of its block.
    NotFollowed,
    /// Moves, turns, mirrors or scales the coordinates in a form that is not modelled (G68.2, G92, CYCLE800, TRANS): machine
    /// positions are unknown from here on, until a [`Action::FrameReset`] of the same group. A name without arguments and
    /// without words in its block (`TRANS`, `CYCLE800()`) resets.
    FrameChange,
    /// Coordinates, rotary ones too, change their meaning in a form that is not modelled (polar and cylindrical interpolation, mirror image of a
    /// double turret): until a [`Action::FrameReset`] of the same group, or the code itself with a rotary coordinate of zero.
    FrameLost,
    /// G10.9 of a lathe: X1 means that X is a diameter from here on, X0 a radius.
    DiameterSwitch,
    /// TRANS, ATRANS of a Sinumerik: shifts the zero point, instead of earlier programmable frames or beside them. TRANS alone ends them.
    ProgrammableShift,
    /// Ends every [`Action::FrameChange`] of the same group (G69).
    FrameReset,
    /// G68.2, G68.4: X Y Z are coordinates of a tilted working plane.
    TiltedPlane,
    /// G53.1: turns the rotary axes so that the tool is perpendicular to the tilted plane.
    TiltedPlaneTurn,
    /// G53.6: the same with the tip held.
    TiltedPlaneTurnTip,
    /// CYCLE800: tilted working plane and turn of the rotary axes in one; without arguments it ends them.
    SwivelCycle,
    /// DEF, PROC, EXTERN: declares names; no motion and no positions in the rest of the block.
    Declaration,
    /// CYCLE81 ... CYCLE89 of a Sinumerik: a drilling cycle with its numbers between parentheses.
    HoleCall,
    /// G81: drill, rapid out.
    DrillCycle,
    /// G82: drill, dwell, rapid out.
    DrillDwellCycle,
    /// G83: drill in steps of Q, out of the hole after each.
    PeckCycle,
    /// G73: drill in steps of Q, back a little after each.
    ChipBreakCycle,
    /// G84: tap in, spindle reversed, feed out.
    TapCycle,
    /// G74: as `TapCycle`, left-hand.
    TapLeftCycle,
    /// G85, G89: feed in, dwell where P is given, feed out.
    BoreCycle,
    /// G86: feed in, spindle stop, rapid out.
    BoreStopCycle,
    /// G88: feed in, dwell, spindle stop, out by hand.
    BoreManualCycle,
    /// G76 of a mill: feed in, dwell, oriented stop, shift off the wall, rapid out.
    FineBoreCycle,
    /// G87: rapid to below with the tool shifted, feed up.
    BackBoreCycle,
    /// G98 of a mill: cycles end at the level before the cycle.
    ReturnInitial,
    /// G99 of a mill: cycles end at the R level.
    ReturnToR,
    /// G52: shifts all work coordinates.
    LocalShift,
    /// G92 (G50 of a lathe): the present point gets the given coordinates; with S alone the highest spindle speed.
    PositionSet,
    /// G92.1 of a Fanuc: shifts by G92 and G52 end.
    PositionPreset,
    /// G68: rotates the coordinates in the plane.
    RotationOn,
    /// G69: ends rotation and tilted planes.
    RotationOff,
    /// G51: scales the coordinates.
    ScalingOn,
    /// G50 of a mill.
    ScalingOff,
    /// G51.1: mirrors axes.
    MirrorOn,
    /// G50.1: ends mirroring of the axes in the block.
    MirrorOff,
    /// G16: the plane's coordinates are radius and angle.
    PolarOn,
    /// G15.
    PolarOff,
    /// G10: writes offsets; L says which.
    DataEntry,
    /// G11: ends the writing of parameters.
    DataEntryEnd,
    /// G27: rapid to a point that should be the reference point.
    ReferenceCheck,
    /// G28: rapid to the first reference point through the programmed point.
    ReferenceReturn,
    /// G28.1 of grbl: the present point becomes the one to which G28 goes.
    ReferenceStore,
    /// G30.1 of grbl: the same for G30.
    ReferenceStoreOther,
    /// G30: rapid to another reference point (P).
    ReferenceReturnOther,
    /// G29: rapid back from the reference point through the last intermediate point.
    ReferenceFrom,
    /// G33, G32: line coupled to the spindle, F is the lead.
    Thread,
    /// G34: as `Thread`, with a lead that changes along the path.
    VariableThread,
    /// G31: line that ends where a signal comes.
    Skip,
    /// G12 of a Haas: circular pocket, clockwise; G13.
    CirclePocket,
    /// G70 of a Haas: cycle at holes on a circle.
    BoltCircle,
    /// G71 of a Haas: cycle at holes on an arc.
    BoltArc,
    /// G72 of a Haas: cycle at holes on a line.
    BoltLine,
    /// Lathe: one cut along Z and back (G90 in system A).
    TurningCycle,
    /// Lathe: one cut along X and back (G94 in system A).
    FacingCycle,
    /// Lathe: one pass of a thread and back (G92 in system A).
    ThreadingCycle,
    /// Lathe: finishing along the contour of the blocks P to Q (G70).
    FinishCycle,
    /// Lathe: roughing along Z down to the contour of the blocks P to Q (G71).
    RoughTurnCycle,
    /// Lathe: roughing along X (G72).
    RoughFaceCycle,
    /// Lathe: the contour of the blocks P to Q again and again, ever nearer (G73).
    PatternRepeatCycle,
    /// Lathe: many passes of a thread (G76).
    ThreadRepeatCycle,
    /// Lathe: pecking along Z (G74).
    FacePeckCycle,
    /// Lathe: pecking along X (G75).
    GroovePeckCycle,
    /// A modal cycle that is not modelled yet (MCALL CYCLE81): blocks with coordinates after it run it, until `CycleOff`
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
    /// PTP: under a transformation the axes run straight to the programmed position.
    PointToPoint,
    /// PTPG0: the same in rapid motions only.
    PointToPointRapid,
    /// CP: ends both.
    ContinuousPath,
}

impl Action {
    /// Whether the code begins a drilling, tapping or boring cycle whose motions are modelled.
    pub fn is_hole_cycle(self) -> bool {
        matches!(
            self,
            Self::DrillCycle
                | Self::DrillDwellCycle
                | Self::PeckCycle
                | Self::ChipBreakCycle
                | Self::TapCycle
                | Self::TapLeftCycle
                | Self::BoreCycle
                | Self::BoreStopCycle
                | Self::BoreManualCycle
                | Self::FineBoreCycle
                | Self::BackBoreCycle
        )
    }
    /// Whether the code begins a modal turning cycle of one pass (G90, G92, G94 in system A).
    pub fn is_pass_cycle(self) -> bool {
        matches!(self, Self::TurningCycle | Self::FacingCycle | Self::ThreadingCycle)
    }
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
    /// STAT=: bits that choose the posture of a point-to-point motion.
    PostureStatus,
    /// TU=: bits that choose the turn of each rotary axis in a point-to-point motion.
    PostureTurn,
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
    /// Lathe: a distance along X (U), Z (W), Y (V) or an angle about C (H), whatever is modal.
    Increment,
    /// A variable of the program (R1=): no motion; its value is not followed.
    Variable,
    /// Recognised; it moves nothing, but its effect (posture, feed limit) is not modelled: reported once.
    NotFollowed,
    /// Recognised, but it changes the path or calls a program in a form that is not modelled (RND=, CHF=, A2=, L20).
    NotModelled,
}
