//! Tags of enums without content: each variant's number in the encoding.
//!
//! A number stays with its meaning forever. A new variant takes the next number, a deleted one leaves a gap.
use super::{CanonicalV1, Encode};
use crate::claim::RefitSource;
use crate::postures::PostureCost;
use trunnion_dialect::{Action, CodeKind, Owner, PathMode, Role};
use trunnion_interp::{
    ChamferLength, DrillingAxis, FrameAngles, HolePlaces, ImplicitDecimals, LengthUnit, OuterCorner, RollPitchYaw,
    RoughingEscape, ScaledAxes, SplineReading,
};
use trunnion_machine::{AxisKind, FeedMeaning, PoleAction, PostureRule, RapidPath, Side, Wrap};
use trunnion_syntax::Format;

/// Stops compilation where two variants have one number: they are listed in ascending order.
const fn ascend(tags: &[u16]) {
    let (mut i, mut last) = (0, 0);
    while i < tags.len() {
        assert!(last < tags[i], "tags ascend from 1");
        last = tags[i];
        i += 1;
    }
}

/// Variants and their numbers. All must be named: the `match` has no other arm.
macro_rules! tags {
    ($enum:ty { $($variant:ident = $tag:literal),+ $(,)? }) => {
        const _: () = ascend(&[$($tag),+]);

        impl Encode for $enum {
            fn encode(&self, out: &mut CanonicalV1) {
                let tag = match self {
                    $(Self::$variant => $tag,)+
                };
                out.variant(tag, |_| {});
            }
        }
    };
}

tags! { Format { Iso = 1, Apt = 2, Klartext = 3, Osp = 4 } }
tags! { CodeKind { G = 1, M = 2, Name = 3 } }
tags! { Owner { Control = 1, MachineBuilder = 2 } }
tags! { PathMode { ExactStop = 1, ExactPath = 2, Continuous = 3 } }
tags! { AxisKind { Linear = 1, Rotary = 2 } }
tags! { Side { Table = 1, Head = 2 } }
tags! { Wrap { Literal = 1, Shortest = 2, ModuloSign = 3 } }
tags! { RapidPath { Undeclared = 1, Synchronous = 2, Dogleg = 3 } }
tags! { PoleAction { Through = 1, Hold = 2, Alarm = 3 } }
tags! { FeedMeaning { Xyz = 1, Combined = 2 } }
tags! { PostureRule { Generic = 1, Shortest = 2, Fanuc = 3, Mitsubishi = 4, Heidenhain = 5 } }
tags! { ImplicitDecimals { LeastIncrement = 1, Calculator = 2 } }
tags! { LengthUnit { Millimetre = 1, Inch = 2 } }
tags! { RoughingEscape { Feed = 1, Rapid = 2 } }
tags! { DrillingAxis { Z = 1, AcrossPlane = 2 } }
tags! { OuterCorner { Lines = 1, Arc = 2 } }
tags! { RollPitchYaw { Fixed = 1, Turned = 2 } }

tags! { FrameAngles { RollPitchYaw = 1, Euler = 2 } }
tags! { SplineReading { ChordLength = 1 } }
tags! { ScaledAxes { Plane = 1, All = 2 } }
tags! { ChamferLength { Side = 1, Face = 2 } }
tags! { HolePlaces { Pairs = 1 } }
tags! { RefitSource { Points = 1, Chords = 2 } }
tags! { PostureCost { Travel = 1, Time = 2, Deviation = 3 } }

tags! {
    Role {
        BlockNumber = 1, ProgramNumber = 2, G = 3, M = 4, Axis = 5, ArcCentre = 6, ArcRadius = 7, ArcTurns = 8, ToolVector = 9,
        PostureStatus = 10, PostureTurn = 11, Feed = 12, Speed = 13, Tool = 14, LengthOffset = 15, EdgeOffset = 16,
        Parameter = 17, Increment = 18, Variable = 19, NotFollowed = 20, NotModelled = 21, PathWord = 22,
        FeedOverride = 23, RapidOverride = 24, FixedPoint = 25, FeedReference = 26,
    }
}

tags! {
    Action {
        Rapid = 1, Linear = 2, ArcClockwise = 3, ArcCounterClockwise = 4, Dwell = 5, PlaneXy = 6, PlaneZx = 7, PlaneYz = 8,
        Absolute = 9, Incremental = 10, ArcCentreAbsolute = 11, ArcCentreIncremental = 12, Inch = 13, InchLengthsOnly = 14,
        Metric = 15, FeedInverseTime = 16, FeedPerMinute = 17, FeedPerRevolution = 18, CompensationOff = 19,
        CompensationLeft = 20, CompensationRight = 21, ToolLengthOn = 22, ToolLengthOff = 23, TcpOn = 24, TcpVectorOn = 25,
        TcpOff = 26, Kinematics = 27, MachineCoordinates = 28, WorkOffset = 29, WorkOffsetNone = 30, SpindleClockwise = 31,
        SpindleCounterClockwise = 32, SpindleStop = 33, ToolChange = 34, ProgramStop = 35, ProgramEnd = 36, NoMotion = 37,
        PathMode = 38, NotModelled = 39, NotFollowed = 40, FrameChange = 41, FrameLost = 42, DiameterSwitch = 43,
        ProgrammableShift = 44, FrameReset = 45, TiltedPlane = 46, TiltedPlaneTurn = 47, TiltedPlaneTurnTip = 48,
        SwivelCycle = 49, Declaration = 50, HoleCall = 51, DrillCycle = 52, DrillDwellCycle = 53, PeckCycle = 54,
        ChipBreakCycle = 55, TapCycle = 56, TapLeftCycle = 57, BoreCycle = 58, BoreStopCycle = 59, BoreManualCycle = 60,
        FineBoreCycle = 61, BackBoreCycle = 62, ReturnInitial = 63, ReturnToR = 64, LocalShift = 65, PositionSet = 66,
        PositionPreset = 67, RotationOn = 68, RotationOff = 69, ScalingOn = 70, ScalingOff = 71, MirrorOn = 72, MirrorOff = 73,
        PolarOn = 74, PolarOff = 75, DataEntry = 76, DataEntryEnd = 77, ReferenceCheck = 78, ReferenceReturn = 79,
        ReferenceStore = 80, ReferenceStoreOther = 81, ReferenceReturnOther = 82, ReferenceFrom = 83, Thread = 84,
        VariableThread = 85, Skip = 86, CirclePocket = 87, BoltCircle = 88, BoltArc = 89, BoltLine = 90, TurningCycle = 91,
        FacingCycle = 92, ThreadingCycle = 93, FinishCycle = 94, RoughTurnCycle = 95, RoughFaceCycle = 96,
        PatternRepeatCycle = 97, ThreadRepeatCycle = 98, FacePeckCycle = 99, GroovePeckCycle = 100, CannedCycle = 101,
        CycleOff = 102, ConstantSurfaceSpeed = 103, ConstantSpindleSpeed = 104, SubprogramCall = 105, OrientationAxes = 106,
        OrientationVector = 107, PointToPoint = 108, PointToPointRapid = 109, ContinuousPath = 110,
        ArcThroughPoint = 111, ArcTangent = 112, ProgrammableFrame = 113, Pole = 114, WorkSystem = 115,
        WorkSystemOnce = 116, Polynomial = 117, ReturnLevel = 118, ReturnToLevel = 119, FixedPoint = 120,
        FeedGroup = 121, DiameterOn = 122, DiameterAbsolute = 123, DiameterOff = 124,
    }
}
