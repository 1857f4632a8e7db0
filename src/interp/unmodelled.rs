//! Codes that are not modelled: what they make unknown, and until when.
use crate::FaultKind;
use crate::codes::{BlockCodes, Found, not_modelled};
use crate::core::ROTARY;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use trunnion_dialect::{Action, CodeKind};

impl<'d> Iso<'d> {
    /// A code whose effect is not modelled. In the motion group it is modal; in a group whose other codes give the coordinates
    /// their meaning, positions are unknown until one of those comes; else everything is forgotten.
    pub(crate) fn unmodelled_code(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        match Self::undeclared_spline(found) {
            Some(_) if self.follows_splines() => {}
            Some(what) => report.fault(found.range, FaultKind::NotModelled { what }),
            None => not_modelled(found, report),
        }
        block.not_modelled = true;
        if found.code.kind == CodeKind::Name && found.with_arguments {
            // a cycle is a program of the control: it may leave other settings behind
            self.core.losses += 1;
        }
        let group = found.code.group.as_deref();
        if group.is_some() && group == self.motion_group() {
            self.core.state.motion = Some(Action::NotModelled);
            self.spline_begins(&found.code.id);
        } else if group.is_some() && self.gives_meaning(group) {
            self.core.unknown.begin(found.code, true);
            self.core.forget_position();
        } else if !words.axes.any() {
            self.core.forget_position();
        }
    }

    /// Whether codes of the group decide where a coordinate is.
    fn gives_meaning(&self, group: Option<&str>) -> bool {
        let meaning = |action| {
            matches!(
                action,
                Action::ToolLengthOn
                    | Action::ToolLengthOff
                    | Action::TcpOn
                    | Action::TcpOff
                    | Action::WorkOffset
                    | Action::WorkSystem
                    | Action::FrameReset
                    | Action::Metric
                    | Action::Absolute
            )
        };
        self.core
            .dialect
            .codes()
            .iter()
            .any(|code| code.group.as_deref() == group && meaning(code.action))
    }

    pub(crate) fn motion_group(&self) -> Option<&'d str> {
        self.core.dialect.g(0)?.group.as_deref()
    }

    /// A code that ends a frame of its group.
    pub(crate) fn frame_reset(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let group = found.code.group.as_deref();
        let counts = self.core.setup.control.x_diameter || self.program_sets_diameters();
        if group == Some("diameter") && counts {
            // DIAMCYCOF where X words are diameters
            return self.unmodelled_code(found, words, block, report);
        }
        if group == Some("dynamic-offset") && self.memory.frames.dynamic.take().is_some() {
            self.end_tilt(report);
        }
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
    }

    pub(crate) fn frame_change(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let with_values = found.with_arguments || words.has_values;
        if found.code.kind == CodeKind::Name && !with_values {
            let ended = self.core.unknown.end(found.code);
            self.core.forget_if(ended);
            return;
        }
        if !words.axes.any() && words.speed.is_given() && found.code.words.iter().any(|word| word == "S") {
            return;
        }
        not_modelled(found, report);
        self.frame_begins(found, words, block);
    }

    /// A frame that begins here is not modelled, for a reason.
    pub(crate) fn frame_unknown(
        &mut self,
        why: &str,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let what = format!("{} {why}", found.code.id);
        report.fault(found.range, FaultKind::NotModelled { what });
        self.frame_begins(found, words, block);
    }

    /// Coordinates, rotary ones too, mean something else from here on: until a reset of the group, or the code itself with a rotary
    /// coordinate of zero (G7.1 C0), or without any word where it reads that coordinate as the start of the cylinder (Haas G107 A0. R10.;
    /// Haas mill operator's manual, G107).
    pub(crate) fn frame_lost(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        block.takes_coordinates = true;
        let reads_angle = found.code.words.iter().any(|word| word == "A");
        let ends = if reads_angle {
            !words.axes.any() && words.letters & crate::unused::letters(found.code) == 0
        } else {
            (3..6).any(|axis| words.axes.get(axis) == Some(0.0))
        };
        if ends {
            let ended = self.core.unknown.end(found.code);
            self.core.forget_if(ended);
            return;
        }
        not_modelled(found, report);
        self.core.unknown.begin(found.code, false);
        self.core.unknown.turns_axes(found.code);
        self.core.forget_position();
    }

    /// From here on positions are unknown.
    pub(crate) fn frame_begins(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes) {
        block.takes_coordinates = true;
        self.core.unknown.begin(found.code, false);
        // a frame by TRANS or ROT may end with it, or lie inside it
        let shift = self
            .core
            .dialect
            .name("TRANS")
            .filter(|_| self.memory.frames.local != [0.0; 9] || self.memory.frames.shape.linear.is_some());
        if let Some(shift) = shift {
            self.core.unknown.begin(shift, false);
        }
        if (words.axes.given | words.axes.unread) & ROTARY != 0 {
            self.core.unknown.turns_axes(found.code);
        }
        self.core.forget_position();
    }
}

/// Axis words that are data of a code which moves nothing: limits of a protected area, the axes of a smoothing, largest increments. Where a motion
/// code stands beside it, what the control does is not documented.
pub(crate) fn data_codes(codes: &[Found<'_>], words: &Words, block: &mut BlockCodes, report: &mut Report<'_>) {
    let axes_of = |found: &Found<'_>| {
        let listed = crate::unused::letters(found.code);
        let bits = crate::AXIS_LETTERS.iter().enumerate();
        bits.fold(0_u16, |all, (axis, letter)| {
            all | u16::from(listed & crate::unused::letter_bit(*letter) != 0) << axis
        })
    };
    let given = words.axes.given | words.axes.unread;
    let reads = |found: &&Found<'_>| {
        let still = matches!(found.code.action, Action::NoMotion | Action::PathMode);
        still && found.code.kind == CodeKind::G && axes_of(found) & given != 0
    };
    if let Some(found) = codes.iter().find(reads) {
        block.takes_coordinates = true;
        if block.motion.is_some() || given & !axes_of(found) != 0 {
            not_modelled(found, report);
            block.not_modelled = true;
        }
    }
}
