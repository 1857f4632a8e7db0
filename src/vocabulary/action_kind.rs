//! What the actions of codes do not change: used to compare programs, or to write them for another control.
use crate::Action;

impl Action {
    /// Whether the code only says how the motions that follow are made, in which frame, and with which spindle.
    fn is_of_motions(self) -> bool {
        matches!(
            self,
            Self::Rapid
                | Self::Linear
                | Self::ArcClockwise
                | Self::ArcCounterClockwise
                | Self::ArcThroughPoint
                | Self::ArcTangent
                | Self::Polynomial
                | Self::Pole
                | Self::Dwell
                | Self::PlaneXy
                | Self::PlaneZx
                | Self::PlaneYz
                | Self::Absolute
                | Self::Incremental
                | Self::ArcCentreAbsolute
                | Self::ArcCentreIncremental
                | Self::Inch
                | Self::InchLengthsOnly
                | Self::Metric
                | Self::FeedInverseTime
                | Self::FeedPerMinute
                | Self::FeedPerRevolution
                | Self::CompensationOff
                | Self::WorkOffset
                | Self::SpindleClockwise
                | Self::SpindleCounterClockwise
                | Self::ProgramEnd
                | Self::ReturnInitial
                | Self::ReturnToR
                | Self::ReturnLevel
                | Self::ReturnToLevel
                | Self::CycleOff
                | Self::OrientationAxes
                | Self::OrientationVector
        )
    }

    /// Whether the whole effect of the code is in the motions, and in the feeds, tools, offsets and spindle speeds that go with them.
    pub fn is_in_motions(self) -> bool {
        self.is_of_motions()
            || matches!(
                self,
                Self::CompensationLeft
                    | Self::CompensationRight
                    | Self::ToolLengthOn
                    | Self::ToolLengthOff
                    | Self::TcpOn
                    | Self::TcpVectorOn
                    | Self::TcpOff
                    | Self::Kinematics
                    | Self::MachineCoordinates
                    | Self::WorkOffsetNone
                    | Self::ToolChange
                    | Self::FrameChange
                    | Self::FrameLost
                    | Self::DiameterSwitch
                    | Self::DiameterOn
                    | Self::DiameterAbsolute
                    | Self::DiameterOff
                    | Self::FeedGroup
                    | Self::ProgrammableShift
                    | Self::ProgrammableFrame
                    | Self::FrameReset
                    | Self::TiltedPlane
                    | Self::TiltedPlaneTurn
                    | Self::TiltedPlaneTurnTip
                    | Self::SwivelCycle
                    | Self::Declaration
                    | Self::DrillDwellCycle
                    | Self::PeckCycle
                    | Self::ChipBreakCycle
                    | Self::LocalShift
                    | Self::PositionPreset
                    | Self::RotationOn
                    | Self::RotationOff
                    | Self::ScalingOn
                    | Self::ScalingOff
                    | Self::MirrorOn
                    | Self::MirrorOff
                    | Self::PolarOn
                    | Self::PolarOff
                    | Self::ReferenceCheck
                    | Self::ReferenceReturn
                    | Self::ReferenceReturnOther
                    | Self::FixedPoint
                    | Self::ReferenceFrom
                    | Self::CirclePocket
                    | Self::BoltCircle
                    | Self::BoltArc
                    | Self::BoltLine
                    | Self::TurningCycle
                    | Self::FacingCycle
                    | Self::FinishCycle
                    | Self::RoughTurnCycle
                    | Self::RoughFaceCycle
                    | Self::PatternRepeatCycle
                    | Self::FacePeckCycle
                    | Self::GroovePeckCycle
                    | Self::SubprogramCall
                    | Self::PointToPoint
                    | Self::PointToPointRapid
                    | Self::ContinuousPath
            )
    }

    /// Whether the code certainly leaves the machine and its coordinates where they are, apart from what the motion itself does.
    pub fn keeps_place(self) -> bool {
        self.is_of_motions()
            || self.is_hole_cycle()
            || matches!(
                self,
                Self::SpindleStop
                    | Self::ProgramStop
                    | Self::PathMode
                    | Self::ConstantSurfaceSpeed
                    | Self::ConstantSpindleSpeed
            )
    }
}
