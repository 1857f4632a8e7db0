//! What a code does, and the working plane. Dialect tables map `G70` or `TRAORI` to these.

/// The working plane of arcs and cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Plane {
    /// G17.
    Xy,
    /// G18.
    Zx,
    /// G19.
    Yz,
}

macro_rules! actions {
    ($($(#[$docs:meta])* $action:ident = $name:literal,)*) => {
        /// What a code does. In tables: its name, `rapid`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Action {
            $($(#[$docs])* $action,)*
        }

        impl Action {
            /// The names of all actions in tables.
            pub const NAMES: &'static [&'static str] = &[$($name),*];

            /// Its name in tables.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$action => $name,)*
                }
            }

            /// The action with this name.
            pub fn named(name: &str) -> Option<Self> {
                match name {
                    $($name => Some(Self::$action),)*
                    _ => None,
                }
            }
        }
    };
}

actions! {
    /// G0.
    Rapid = "rapid",
    /// G1.
    Linear = "linear",
    /// G2.
    ArcClockwise = "arc-clockwise",
    /// G3.
    ArcCounterClockwise = "arc-counter-clockwise",
    /// G4.
    Dwell = "dwell",
    /// G17.
    PlaneXy = "plane-xy",
    /// G18.
    PlaneZx = "plane-zx",
    /// G19.
    PlaneYz = "plane-yz",
    /// G90.
    Absolute = "absolute",
    /// G91.
    Incremental = "incremental",
    /// G90.1: arc centres absolute.
    ArcCentreAbsolute = "arc-centre-absolute",
    /// G91.1: arc centres incremental.
    ArcCentreIncremental = "arc-centre-incremental",
    /// G20 / G70: inch, feeds too (G20), see `InchLengthsOnly`.
    Inch = "inch",
    /// Sinumerik G70: lengths in inch, F stays.
    InchLengthsOnly = "inch-lengths-only",
    /// G21 / G71 / G710.
    Metric = "metric",
    /// G93.
    FeedInverseTime = "feed-inverse-time",
    /// G94.
    FeedPerMinute = "feed-per-minute",
    /// G95.
    FeedPerRevolution = "feed-per-revolution",
    /// G40.
    CompensationOff = "compensation-off",
    /// G41: path not modelled yet, so motions under it are the programmed ones, which is reported.
    CompensationLeft = "compensation-left",
    /// G42.
    CompensationRight = "compensation-right",
    /// G43.
    ToolLengthOn = "tool-length-on",
    /// G49 (also ends tool centre point control).
    ToolLengthOff = "tool-length-off",
    /// G43.4, TRAORI, M428 ...: tip is programmed, rotary axes in words.
    TcpOn = "tcp-on",
    /// G43.5: tip and tool vector are programmed.
    TcpVectorOn = "tcp-vector-on",
    /// TRAFOOF, M129 ...
    TcpOff = "tcp-off",
    /// M428 ...: switches the kinematics. The machine file declares which code means tool centre point control; if undeclared, X Y Z mean nothing
    /// from here on.
    Kinematics = "kinematics",
    /// G53: this block in machine coordinates.
    MachineCoordinates = "machine-coordinates",
    /// G54 ... : select a work offset; the code's own id is the offset's name.
    WorkOffset = "work-offset",
    /// Okuma G15 H: selects the work coordinate system of that number.
    WorkSystem = "work-system",
    /// Okuma G16 H: the same for this block; H0 is the machine's.
    WorkSystemOnce = "work-system-once",
    /// Sinumerik G500: no settable offset.
    WorkOffsetNone = "work-offset-none",
    /// M3.
    SpindleClockwise = "spindle-clockwise",
    /// M4.
    SpindleCounterClockwise = "spindle-counter-clockwise",
    /// M5.
    SpindleStop = "spindle-stop",
    /// M6.
    ToolChange = "tool-change",
    /// M0, M1: stop, continues.
    ProgramStop = "program-stop",
    /// M2, M30, M17.
    ProgramEnd = "program-end",
    /// Coolant and other codes without motion and without effect on what is checked.
    NoMotion = "no-motion",
    /// Exact stop / continuous path modes: no effect on the programmed path.
    PathMode = "path-mode",
    /// Recognised, but its motion or its effect on the position is not modelled: what follows is unknown.
    NotModelled = "not-modelled",
    /// Recognised, moves nothing and changes no position, but its effect (on the meaning of F, on limits) is not modelled: reported
    /// once. A G code of this kind uses up the coordinates of its block.
    NotFollowed = "not-followed",
    /// Moves, turns, mirrors or scales the coordinates in a form that is not modelled (G68.2, G92, CYCLE800, TRANS): machine
    /// positions are unknown from here on, until a [`Action::FrameReset`] of the same group. A name without arguments and
    /// without words in its block (`TRANS`, `CYCLE800()`) resets.
    FrameChange = "frame-change",
    /// Coordinates, rotary ones too, change their meaning in a form that is not modelled (polar and cylindrical interpolation, mirror image of a
    /// double turret): until a [`Action::FrameReset`] of the same group, or the code itself with a rotary coordinate of zero.
    FrameLost = "frame-lost",
    /// G10.9 of a lathe: X1 means that X is a diameter from here on, X0 a radius.
    DiameterSwitch = "diameter-switch",
    /// TRANS, ATRANS of a Sinumerik: shifts the zero point, instead of earlier programmable frames or in addition to them. TRANS alone ends them.
    ProgrammableShift = "programmable-shift",
    /// Ends every [`Action::FrameChange`] of the same group (G69).
    FrameReset = "frame-reset",
    /// G68.2, G68.4: X Y Z are coordinates of a tilted working plane.
    TiltedPlane = "tilted-plane",
    /// G53.1: turns the rotary axes so that the tool is perpendicular to the tilted plane.
    TiltedPlaneTurn = "tilted-plane-turn",
    /// G53.6: the same with the tip held.
    TiltedPlaneTurnTip = "tilted-plane-turn-tip",
    /// CYCLE800: tilted working plane and turn of the rotary axes in one; without arguments it ends them.
    SwivelCycle = "swivel-cycle",
    /// DEF, PROC, EXTERN: declares names; no motion and no positions in the rest of the block.
    Declaration = "declaration",
    /// CYCLE81 ... CYCLE89 of a Sinumerik: a drilling cycle with its numbers between parentheses.
    HoleCall = "hole-call",
    /// G81: drill, rapid out.
    DrillCycle = "drill-cycle",
    /// G82: drill, dwell, rapid out.
    DrillDwellCycle = "drill-dwell-cycle",
    /// G83: drill in steps of Q, out of the hole after each.
    PeckCycle = "peck-cycle",
    /// G73: drill in steps of Q, back a little after each.
    ChipBreakCycle = "chip-break-cycle",
    /// G84: tap in, spindle reversed, feed out.
    TapCycle = "tap-cycle",
    /// G74: as `TapCycle`, left-hand.
    TapLeftCycle = "tap-left-cycle",
    /// G85, G89: feed in, dwell where P is given, feed out.
    BoreCycle = "bore-cycle",
    /// G86: feed in, spindle stop, rapid out.
    BoreStopCycle = "bore-stop-cycle",
    /// G88: feed in, dwell, spindle stop, out by hand.
    BoreManualCycle = "bore-manual-cycle",
    /// G76 of a mill: feed in, dwell, oriented stop, shift off the wall, rapid out.
    FineBoreCycle = "fine-bore-cycle",
    /// G87: rapid to below with the tool shifted, feed up.
    BackBoreCycle = "back-bore-cycle",
    /// G98 of a mill: cycles end at the level before the cycle.
    ReturnInitial = "return-initial",
    /// G99 of a mill: cycles end at the R level.
    ReturnToR = "return-to-r",
    /// G71 of an Okuma: Z is the level to which drilling cycles return under [`Action::ReturnToLevel`].
    ReturnLevel = "return-level",
    /// M53 of an Okuma: cycles end at the level of [`Action::ReturnLevel`].
    ReturnToLevel = "return-to-level",
    /// G52: shifts all work coordinates.
    LocalShift = "local-shift",
    /// G92 (G50 of a lathe): the present point gets the given coordinates; with S alone the highest spindle speed.
    PositionSet = "position-set",
    /// G92.1 of a Fanuc: shifts by G92 and G52 end.
    PositionPreset = "position-preset",
    /// G68: rotates the coordinates in the plane.
    RotationOn = "rotation-on",
    /// G69: ends rotation and tilted planes.
    RotationOff = "rotation-off",
    /// G51: scales the coordinates.
    ScalingOn = "scaling-on",
    /// G50 of a mill.
    ScalingOff = "scaling-off",
    /// G51.1: mirrors axes.
    MirrorOn = "mirror-on",
    /// G50.1: ends mirroring of the axes in the block.
    MirrorOff = "mirror-off",
    /// G16: the plane's coordinates are radius and angle.
    PolarOn = "polar-on",
    /// G15.
    PolarOff = "polar-off",
    /// G10: writes offsets; L says which.
    DataEntry = "data-entry",
    /// G11: ends the writing of parameters.
    DataEntryEnd = "data-entry-end",
    /// G27: rapid to a point that should be the reference point.
    ReferenceCheck = "reference-check",
    /// G28: rapid to the first reference point through the programmed point.
    ReferenceReturn = "reference-return",
    /// G28.1 of grbl: the present point becomes the one to which G28 goes.
    ReferenceStore = "reference-store",
    /// G30.1 of grbl: the same for G30.
    ReferenceStoreOther = "reference-store-other",
    /// G30: rapid to another reference point (P).
    ReferenceReturnOther = "reference-return-other",
    /// G75 of a Sinumerik: rapid of the named axes to a fixed point of the machine (FP).
    FixedPoint = "fixed-point",
    /// G29: rapid back from the reference point through the last intermediate point.
    ReferenceFrom = "reference-from",
    /// G33, G32: line coupled to the spindle, F is the lead.
    Thread = "thread",
    /// G34: as `Thread`, with a lead that changes along the path.
    VariableThread = "variable-thread",
    /// G31: line that ends where a signal comes.
    Skip = "skip",
    /// G12 of a Haas: circular pocket, clockwise; G13.
    CirclePocket = "circle-pocket",
    /// G70 of a Haas: cycle at holes on a circle.
    BoltCircle = "bolt-circle",
    /// G71 of a Haas: cycle at holes on an arc.
    BoltArc = "bolt-arc",
    /// G72 of a Haas: cycle at holes on a line.
    BoltLine = "bolt-line",
    /// Lathe: one cut along Z and back (G90 in system A).
    TurningCycle = "turning-cycle",
    /// Lathe: one cut along X and back (G94 in system A).
    FacingCycle = "facing-cycle",
    /// Lathe: one pass of a thread and back (G92 in system A).
    ThreadingCycle = "threading-cycle",
    /// Lathe: finishing along the contour of the blocks P to Q (G70).
    FinishCycle = "finish-cycle",
    /// Lathe: roughing along Z down to the contour of the blocks P to Q (G71).
    RoughTurnCycle = "rough-turn-cycle",
    /// Lathe: roughing along X (G72).
    RoughFaceCycle = "rough-face-cycle",
    /// Lathe: the contour of the blocks P to Q repeatedly, each time nearer (G73).
    PatternRepeatCycle = "pattern-repeat-cycle",
    /// Lathe: many passes of a thread (G76).
    ThreadRepeatCycle = "thread-repeat-cycle",
    /// Lathe: pecking along Z (G74).
    FacePeckCycle = "face-peck-cycle",
    /// Lathe: pecking along X (G75).
    GroovePeckCycle = "groove-peck-cycle",
    /// A modal cycle that is not modelled yet (MCALL CYCLE81): blocks with coordinates after it run it, until `CycleOff`
    /// or a motion code.
    CannedCycle = "canned-cycle",
    /// G80; MCALL without a cycle.
    CycleOff = "cycle-off",
    /// G96: S is a cutting speed, so the spindle's turns are unknown.
    ConstantSurfaceSpeed = "constant-surface-speed",
    /// G97: S is turns per minute.
    ConstantSpindleSpeed = "constant-spindle-speed",
    /// A call of a subprogram, a jump, a condition or a loop: which blocks run, and what they change, is not followed, so everything
    /// after it is unknown until it is programmed again.
    SubprogramCall = "subprogram-call",
    /// Sinumerik ORIAXES / ORIVECT and the like: orientation interpolated joint-linear.
    OrientationAxes = "orientation-axes",
    /// Orientation interpolated on the great circle.
    OrientationVector = "orientation-vector",
    /// PTP: under a transformation the axes run straight to the programmed position.
    PointToPoint = "point-to-point",
    /// PTPG0: the same in rapid motions only.
    PointToPointRapid = "point-to-point-rapid",
    /// CP: ends both.
    ContinuousPath = "continuous-path",
    /// CIP: arc through the intermediate point I1 J1 K1.
    ArcThroughPoint = "arc-through-point",
    /// CT: arc that continues the direction of the motion before.
    ArcTangent = "arc-tangent",
    /// POLY: coordinates are polynomials.
    Polynomial = "polynomial",
    /// ROT, SCALE, MIRROR and their added forms: turn, scale and mirror the coordinates.
    ProgrammableFrame = "programmable-frame",
    /// G110, G111, G112: pole of the polar coordinates AP, RP.
    Pole = "pole",
    /// FGROUP: the axes along which F is measured.
    FeedGroup = "feed-group",
    /// DIAMON: X is a diameter.
    DiameterOn = "diameter-on",
    /// DIAM90: absolute X words are diameters, distances along X are radii.
    DiameterAbsolute = "diameter-absolute",
    /// DIAMOF: X is a radius.
    DiameterOff = "diameter-off",
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
