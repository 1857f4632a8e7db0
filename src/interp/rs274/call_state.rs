//! State that the calls of the interpreter set for the motions that follow.
use super::feed::Rate;
use super::places::Places;
use super::steady::Steady;
use crate::Position;
use crate::cycle_motions::CycleMotions;
use trunnion_ngc::Pose;

/// What calls have set that a motion needs and [`State`] does not set in step with them: compensation of the cutter radius holds
/// calls back while the state runs ahead.
#[derive(Clone, Debug, Default)]
pub(super) struct CallState {
    /// The control has reported its own unit of lengths.
    pub(super) own_units: bool,
    /// Where the machine is, mm and deg, as far as it is known.
    pub(super) machine: Position,
    /// F.
    pub(super) rate: Option<Rate>,
    /// F counts per revolution (G95).
    pub(super) per_revolution: bool,
    /// The pitch while the feed is coupled to the spindle.
    pub(super) synced: Option<Rate>,
    /// G92 and the tool offset, mm and deg: that of the interpreter keeps its number when the unit changes, that of the machine its length.
    pub(super) g92: Pose,
    /// The zero point in effect was taken from an undeclared position of the machine.
    pub(super) set_here: bool,
    /// It was reported that no G5.3 has ended the spline.
    pub(super) spline_said: bool,
    pub(super) tool_offset: Pose,
    /// The block in which each line begins, where that is not its number.
    pub(super) blocks: Option<std::sync::Arc<[u32]>>,
    /// Where lines are and from where the main program called them.
    pub(super) places: Places,
    /// The files of the run for messages; the main program first.
    pub(super) paths: Vec<std::sync::Arc<str>>,
    /// Compensation of the cutter radius was on after the last line.
    pub(super) compensated: bool,
    /// Something has happened after which X Y Z U V W are not known.
    pub(super) lost: bool,
    /// The same of A B C.
    pub(super) lost_rotary: bool,
    /// A tilted plane that is not modelled is in effect: X Y Z say nothing about the machine.
    pub(super) hidden: bool,
    /// While lines are motions and nothing else, which no offset can change: the offsets, and the last of them.
    pub(super) steady: Option<Box<Steady>>,
    /// Of the current line: it does more than its motions and calls hold; where a motion ends, or how it gets there, is unknown.
    pub(super) has_other_effects: bool,
    pub(super) unknown_end: bool,
    /// The last motion was programmed in machine coordinates (G53).
    pub(super) machine_frame: bool,
    /// It was reported that nothing declares the axes U V W.
    pub(super) further_said: bool,
    /// How far a curve may leave the lines that stand for it, mm; 0: none is being followed.
    pub(super) slack_mm: f64,
    /// Chords of curves so far, and what it took to find them.
    pub(super) curve_work: CycleMotions,
    /// The line that set `#<_value>` to something unknown.
    pub(super) returned: Option<Vec<crate::Argument>>,
    /// The kinematics were switched, and it is not known to which: X Y Z say nothing about the machine.
    pub(super) kinematics_unknown: bool,
}

impl CallState {
    /// X Y Z say nothing about the machine.
    pub(super) fn is_hidden(&self) -> bool {
        self.hidden || self.kinematics_unknown
    }
}
