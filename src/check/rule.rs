//! What a rule is: data, and a function that reads one level of the analysis.
use crate::{Severity, needs::Needs, sink::Reporter, view::LegView, view::Overview};
use trunnion_interp::{Clamps, Fault, ModalState, Motion};
use trunnion_syntax::{SyntaxError, TextRange};

/// Reads a problem of the text.
pub type TextRule = fn(&SyntaxError, &mut Reporter<'_>);
/// Reads the program as a whole.
pub type ProgramRule = fn(&Overview<'_>, &mut Reporter<'_>);
/// What is active for a motion without being written in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InForce {
    /// Compensated tool length, mm; `None`: off.
    pub tool_length_mm: Option<f64>,
    /// Declared length of the tool in use, mm.
    pub own_length_mm: Option<f64>,
    /// Coordinates are in a frame that is not modelled.
    pub frame_unknown: bool,
    /// S is a cutting speed (G96).
    pub surface_speed: bool,
    /// Limit of the spindle's speed, 1/min.
    pub spindle_limit_rpm: Option<f64>,
    /// Something says whether lengths are inch or mm.
    pub units_said: bool,
    /// Clamps of rotary axes.
    pub clamps: Clamps,
}

impl InForce {
    /// Of the modal state.
    #[inline]
    pub(crate) fn of(state: &ModalState) -> Self {
        Self {
            tool_length_mm: state.tool_length_mm,
            own_length_mm: state.own_length_mm(),
            frame_unknown: state.frame_unknown,
            surface_speed: state.surface_speed,
            spindle_limit_rpm: state.spindle_limit_rpm,
            units_said: state.units_said,
            clamps: state.clamps,
        }
    }
}

/// Reads a fault of the run.
pub type FaultRule = fn(&Fault, &mut Reporter<'_>);
/// Reads a motion as programmed, without a machine, and what is in force with it.
pub type MotionRule = fn(&Motion, InForce, &mut Reporter<'_>);
/// Reads what is known when the run has come to its end.
pub type EndRule = fn(&Ending<'_>, &mut Reporter<'_>);
/// Reads a leg of the machine.
pub type LegRule = fn(&LegView<'_>, &mut Reporter<'_>);

/// What is known when the run has come to its end.
pub struct Ending<'s> {
    /// Comments that allow a rule of which nothing was found: bytes of the comment, the rule's name.
    pub unused: Vec<(TextRange, &'s str)>,
}

/// What a rule reads, hence what it costs.
#[derive(Clone, Copy)]
pub enum Level {
    /// Each problem of the text.
    Text(TextRule),
    /// Each problem of the text, and each fault of the run: a control may refuse what the text alone does not show.
    TextAndFault(TextRule, FaultRule),
    /// The program as a whole, once.
    Program(ProgramRule),
    /// Each fault of the run.
    Fault(FaultRule),
    /// Each motion as programmed of which this holds.
    Motion(Needs, MotionRule),
    /// Each leg of the machine of which this holds.
    Leg(Needs, LegRule),
    /// What is known at the end, once.
    End(EndRule),
}

impl Level {
    /// One word for lists: `text`, `program`, `motion`, `machine`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Text(_) | Self::TextAndFault(..) | Self::End(_) => "text",
            Self::Program(_) => "program",
            Self::Fault(_) | Self::Motion(..) => "motion",
            Self::Leg(..) => "machine",
        }
    }
}

/// What silence means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guarantee {
    /// Silence is a proof in the stated model; where the rule cannot decide it says unknown.
    Sound,
    /// Silence proves nothing.
    Heuristic,
}

/// What a rule file says about itself; name and documentation come from the file.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    /// Severity unless a finding says otherwise.
    pub(crate) severity: Severity,
    /// What silence means.
    pub(crate) guarantee: Guarantee,
    /// What it reads.
    pub(crate) level: Level,
}

/// One rule. Its name is its file's name with dashes, its documentation its file's header.
#[derive(Clone, Copy)]
pub struct Rule {
    /// `pole-flip`.
    pub name: &'static str,
    /// The header of its file, Markdown, without the comment marks.
    pub docs: &'static str,
    /// Severity unless the message says otherwise.
    pub severity: Severity,
    /// What silence means.
    pub guarantee: Guarantee,
    /// What it reads.
    pub level: Level,
}

impl Rule {
    /// The first sentence of the documentation: the rule in one line.
    pub fn summary(&self) -> &'static str {
        self.docs.lines().next().unwrap_or_default()
    }
}
