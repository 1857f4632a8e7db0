//! What drilling cycles need before they go down: levels in order, and for taps a spindle.
use super::hole::Plan;
use crate::arc::plane_axes;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{DrillingAxis, Effect, FaultKind, Orientation, Refusal};
use trunnion_dialect::{Action, Macros};
use trunnion_vocabulary::Spindle;

impl Plan {
    /// Both axes across the hole, in the order of a plane.
    pub(super) fn across(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }
}

impl Iso<'_> {
    /// Along which axis cycles drill: that across the plane. On a Fanuc mill it may be Z in each plane (parameter FXY); `None`: that is not declared.
    pub(crate) fn drilling_axis(&self) -> Option<usize> {
        let across = plane_axes(self.core.state.coordinates.plane())[2];
        let quirks = &self.core.dialect.quirks;
        if across == 2 || quirks.macros != Macros::Fanuc || quirks.diameter {
            return Some(across);
        }
        self.core.setup.control.drilling_axis.map(|axis| match axis {
            DrillingAxis::Z => 2,
            DrillingAxis::AcrossPlane => across,
        })
    }

    /// Whether holes go down along Z: on a lathe, in a frame that may mirror, along another axis, and back boring they go in either direction.
    pub(super) fn drills_down(&self, axis: usize) -> bool {
        axis == 2
            && !self.memory.frames.active
            && !self.core.dialect.quirks.diameter
            && self.core.state.motion != Some(Action::BackBoreCycle)
    }

    /// Whether the tip is led and the tool may be out of Z: no source says what a drilling cycle does there. C alone turns around Z.
    pub(super) fn tip_is_led_aslant(&self) -> bool {
        const A_AND_B: u16 = 0b1_1000;
        let state = &self.core.state;
        // in a tilted plane Z is another one, and rules compare the tool with it
        if !state.tool_axis.tcp() || self.memory.frames.tilt.is_some() || self.memory.frames.active {
            return false;
        }
        match state.orientation {
            Orientation::Vector(_, axis) => axis.z < 1.0 - 1e-12,
            Orientation::Words => {
                let position = state.position;
                let upright = |axis: usize| position.get(axis).is_some_and(|value| value == 0.0);
                let none = position.known & A_AND_B == 0;
                none || (3..5).any(|axis| position.known & (1 << axis) != 0 && !upright(axis))
            }
        }
    }

    /// R is below the bottom.
    pub(super) fn upside_down(&self, words: &Words, report: &mut Report<'_>) {
        let message = format!(
            "{}: R is below the bottom of the hole, so that the tool would go there in rapid: R must be the higher level",
            self.memory.cycle.id
        );
        self.refuse(words, Refusal::CannedCycle, message, None, report);
    }

    /// A tap of Fanuc's kind turns the spindle itself where it is rigid, by M29 or by a parameter of the control: it is not known to stand then.
    /// The spindle before it.
    pub(super) fn tap_begins(&mut self, action: Action, report: &mut Report<'_>) -> Option<Spindle> {
        let taps = matches!(action, Action::TapCycle | Action::TapLeftCycle);
        let before = self.core.state.spindle;
        let left = action == Action::TapLeftCycle;
        if taps && before.on() == Some(true) && self.memory.cycle.counter_clockwise == Some(!left) {
            let (hand, code) = if left {
                ("left-hand", "M3")
            } else {
                ("right-hand", "M4")
            };
            let id = &self.memory.cycle.id;
            let what = format!("{id}, a {hand} tap, after {code}: which way the spindle turns on the way in");
            report.fault(report.whole(), FaultKind::NotModelled { what });
        }
        if !taps || !self.core.dialect.quirks.macro_b() {
            return None;
        }
        let fanuc = self.core.dialect.quirks.macros == Macros::Fanuc;
        let cycle = &self.memory.cycle;
        let turns = match before.on() {
            Some(true) => return Some(before),
            // rigid, a tap turns the spindle itself; else it went on turning after the tap before
            _ if fanuc && (cycle.rigid || matches!(cycle.id.as_str(), "G84.2" | "G84.3")) => Some(true),
            None if cycle.tapped => Some(true),
            Some(false) if fanuc => {
                let what = format!(
                    "{} with the spindle off: it turns the spindle itself only where it is a rigid tap, which M29 or a parameter of the control decides \
                     (write M3 or M4 before it, or M29)",
                    cycle.id
                );
                report.fault(report.whole(), FaultKind::NotModelled { what });
                None
            }
            _ => None,
        };
        self.core.state.spindle.turn(turns);
        Some(before)
    }

    /// A spindle that turned before a tap of Fanuc's kind may stand after it: rigid tapping ends with a stop, and the parameter decides.
    pub(super) fn tap_ends(&mut self, before: Spindle, report: &Report<'_>) {
        self.core.state.spindle = before;
        self.memory.cycle.tapped |= before.on() == Some(true);
        self.core.state.spindle.leave_to_machine();
        if self.core.effects.wanted() {
            let block = self.core.main_block(report.block);
            self.core.effects.add(block, Effect::left("spindle"));
        }
    }
}
