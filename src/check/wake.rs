//! What wakes a rule: the type that its function reads. This list is complete.
use crate::coverage::Coverage;
use crate::cuts::StillCuts;
use crate::datum::{Open, Overrun};
use crate::facts::{
    Arrival, CableAxis, ClampedTurn, Curved, CutSpindleUnlimited, FarCut, FirstApproach, FirstCut, HeldBackCut,
    IdleTip, LengthLeft, LengthOffZ, LongTurn, LostArc, LostEnd, NearPole, NoTravel, OneSidedCut, OpenPosture,
    OtherLength, OverTravel, Passing, PoleCrossing, PolePass, PostureSwap, SteepHelix, StrayingCut, UncertainCut,
    UnsaidUnits, VectorCut, WindingCut,
};
use crate::finding::Draft;
use crate::look::Look;
use crate::pace::{PaceKind, Place as PacePlace};
use crate::sink::Reporter;
use crate::view::{LegView, MotionView, Overview};
use trunnion_dialect::Foreign;
use trunnion_interp::{Fault, FaultKind, Refusal};
use trunnion_machine::Machine;
use trunnion_syntax::{BlockId, SyntaxError, TextRange};

/// What is known when the run has come to its end.
pub(crate) struct Ending<'s> {
    /// Comments that allow a rule that found nothing: bytes of the comment, the rule's name.
    pub(crate) unused: Vec<(TextRange, &'s str)>,
    /// In a subprogram that is run alone: its first motion, and the codes that act there and that its caller sets.
    pub(crate) of_caller: Option<(BlockId, Vec<String>)>,
}

macro_rules! wakes {
    (
        motions { $($(#[$motion_doc:meta])* $motion:ident),* $(,)? }
        legs { $($(#[$leg_doc:meta])* $leg:ident),* $(,)? }
    ) => {
        /// What a rule reads, hence when it is asked and what it costs.
        #[derive(Clone, Copy)]
        pub(crate) enum Wake {
            /// The file cannot be read as text.
            Unreadable(fn(&mut Reporter<'_>)),
            /// The file is not read, and why.
            Foreign(fn(&Foreign, &mut Reporter<'_>)),
            /// Each problem of the text.
            Text(fn(&SyntaxError, &mut Reporter<'_>)),
            /// The program as a whole, once.
            Program(fn(&Overview<'_>, &mut Reporter<'_>)),
            /// The program as a whole, where it is meant to run on other controls too.
            Port(fn(&Overview<'_>, &mut Reporter<'_>)),
            /// Each fault of the run.
            Fault(fn(&Fault, &mut Reporter<'_>)),
            /// Each block that the control refuses for this sort of reason. Its message is written already; the function may add to it.
            Refused(Refusal, fn(&mut Draft<'_>)),
            $($(#[$motion_doc])* $motion(fn(&$motion<'_>, &mut Reporter<'_>)),)*
            $($(#[$leg_doc])* $leg(fn(&$leg<'_>, &mut Reporter<'_>)),)*
            /// On a machine: each undeclared zero point or tool length on which something depends, at the end.
            Open(fn(&Open, &mut Reporter<'_>)),
            /// On a machine: each axis that leaves its travel wherever an undeclared zero is, at the end.
            Overrun(fn(&Overrun, &mut Reporter<'_>)),
            /// On a machine: each place of this kind at which the planned speed tells something, at the end.
            Pace(PaceKind, fn(&PacePlace, &Machine, &mut Reporter<'_>)),
            /// Each stretch of feed motions in which the spindle does not turn, at the end.
            Still(fn(&StillCuts, &mut Reporter<'_>)),
            /// What is known at the end, once.
            End(fn(&Ending<'_>, &mut Reporter<'_>)),
            /// What part of the program was checked, once, after everything else.
            Coverage(fn(&Coverage, &mut Reporter<'_>)),
        }

        /// The place of each fact in a mask.
        #[derive(Clone, Copy)]
        enum Place { $($motion,)* $($leg,)* }

        impl Wake {
            /// One word for lists: `text`, `program`, `motion`, `machine`.
            pub(crate) fn level(self) -> &'static str {
                match self {
                    Self::Unreadable(_) | Self::Foreign(_) | Self::Text(_) | Self::End(_) => "text",
                    Self::Program(_) | Self::Port(_) | Self::Coverage(_) => "program",
                    Self::Fault(_) | Self::Refused(..) | Self::Still(_) $(| Self::$motion(_))* => "motion",
                    Self::Open(_) | Self::Overrun(_) | Self::Pace(..) => "machine",
                    $(Self::$leg(_))|* => "machine",
                }
            }

            /// Whether what it reads is known once the run has come to it, wherever the program goes on.
            pub(crate) fn is_of_place(self) -> bool {
                match self {
                    Self::Text(_) | Self::Fault(_) | Self::Refused(..) $(| Self::$motion(_))* $(| Self::$leg(_))* => true,
                    Self::Unreadable(_) | Self::Foreign(_) | Self::End(_) | Self::Program(_) | Self::Port(_) => false,
                    Self::Coverage(_) | Self::Still(_) | Self::Open(_) | Self::Overrun(_) | Self::Pace(..) => false,
                }
            }

            /// Its place in the masks of [`possible_of_motion`] and [`possible_of_leg`].
            fn mask(self) -> u32 {
                match self {
                    $(Self::$motion(_) => 1 << Place::$motion as u32,)*
                    $(Self::$leg(_) => 1 << Place::$leg as u32,)*
                    _ => 0,
                }
            }

            /// Whether the fact is among what a look found possible.
            pub(crate) fn is_in(self, possible: u32) -> bool {
                self.mask() & possible != 0
            }

            /// Whether it reads motions as programmed.
            pub(crate) fn reads_motions(self) -> bool {
                matches!(self, $(Self::$motion(_))|*)
            }

            /// Asks the rule about a fault.
            pub(crate) fn read_fault(self, fault: &Fault, out: &mut Reporter<'_>) {
                match self {
                    Self::Fault(rule) => rule(fault, out),
                    Self::Refused(sort, add) => {
                        let misread = matches!(
                            sort,
                            Refusal::Syntax | Refusal::Number | Refusal::Expression | Refusal::UnknownWord
                        );
                        if misread && is_refusal(fault, sort) && out.is_slip(fault.range) {
                            return;
                        }
                        if let Some(draft) = out.refused(fault, sort) {
                            add(draft);
                        }
                    }
                    _ => {}
                }
            }

            /// Asks the rule about a motion for which its fact holds.
            pub(crate) fn read_motion(self, view: &MotionView<'_>, out: &mut Reporter<'_>) {
                match self {
                    $(Self::$motion(rule) => if let Some(fact) = $motion::of(view) { rule(&fact, out) },)*
                    _ => {}
                }
            }

            /// Asks the rule about a leg for which its fact holds.
            pub(crate) fn read_leg(self, view: &LegView<'_>, out: &mut Reporter<'_>) {
                match self {
                    $(Self::$leg(rule) => if let Some(fact) = $leg::of(view) { rule(&fact, out) },)*
                    _ => {}
                }
            }
        }

        /// The facts that may hold for a motion.
        #[inline]
        pub(crate) fn possible_of_motion(view: &MotionView<'_>) -> u32 {
            0 $(| u32::from($motion::may(view)) << Place::$motion as u32)*
        }

        /// The facts that may hold for a leg.
        #[inline]
        pub(crate) fn possible_of_leg(look: &Look<'_>) -> u32 {
            0 $(| u32::from($leg::may(look)) << Place::$leg as u32)*
        }
    };
}

wakes! {
    motions {
        /// The first feed motion with a tool.
        FirstCut,
        /// A feed motion without the length that the cut before had with the same tool.
        LengthLeft,
        /// The first rapid to another Z with a tool, before its first feed motion.
        FirstApproach,
        /// A helix whose F may be that of its arc alone.
        SteepHelix,
        /// A motion in G18 or G19 with a length, where the plane says along which axis the length acts.
        LengthOffZ,
        /// A feed motion under constant surface speed without a limit of the spindle speed, where the control wants one.
        CutSpindleUnlimited,
        /// A length of which nothing says whether it is inch or mm.
        UnsaidUnits,
    }
    legs {
        /// A cut that may leave the programmed segment by more than the tolerance.
        StrayingCut,
        /// A cut that an axis may have to hold back, or in which one without a declared speed may move.
        HeldBackCut,
        /// A cut in which the linear axes may travel farther than the allowed ratio to the tip's travel.
        FarCut,
        /// A cut after which the rotary axes have turned farther in ten blocks than the allowed ratio to the tool axis.
        WindingCut,
        /// A turning cut between tool vectors.
        VectorCut,
        /// A turning cut with a guided tip, at whose end only one posture is left.
        OneSidedCut,
        /// A turning cut with a tool of a length other than the active compensation.
        OtherLength,
        /// A cut on a machine whose file says how well an axis is known.
        UncertainCut,
        /// A cut past the pole, nearer than the first rotary axis can follow.
        PolePass,
        /// A cut that comes into the pole's cone on a machine with two rotary axes.
        NearPole,
        /// A cut in which the posture changes its sign.
        PoleCrossing,
        /// More rotary travel than the posture before would need.
        PostureSwap,
        /// An undecided posture.
        OpenPosture,
        /// A rotary axis turns by more than half a turn.
        LongTurn,
        /// A joint leaves its travel, or may leave it.
        OverTravel,
        /// An axis that winds up a cable, at a known position.
        CableAxis,
        /// Any leg on a machine with an axis that must not turn while cutting, or that codes clamp.
        ClampedTurn,
        /// The tip is led on a machine without a rotary axis.
        IdleTip,
        /// Linear axes move whose travel the machine file does not declare.
        NoTravel,
        /// A motion on a machine with obstacles.
        Passing,
        /// A feed motion to which rapid motions led.
        Arrival,
        /// A piece of a curve where it matters that it is followed as lines.
        Curved,
        /// An end at which the machine's position is unknown, or that it cannot reach.
        LostEnd,
        /// An arc from a start that is unknown.
        LostArc,
    }
}

/// Whether a fault is a block that the control refuses for this sort of reason.
fn is_refusal(fault: &Fault, sort: Refusal) -> bool {
    matches!(fault.kind, FaultKind::Rejected { refusal, .. } if refusal == sort)
}
