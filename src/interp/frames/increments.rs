//! Incremental coordinates of a Sinumerik after an offset has changed. Setting data decide whether the first one travels the change too:
//! 42440 FRAME_OFFSET_INCR_PROG for zero points and frames, 42442 TOOL_OFFSET_INCR_PROG for tool lengths (Sinumerik 840D sl List Manual,
//! setting data). What is not declared is unknown. On other controls no source of this project names such a setting.
use super::XYZ;
use crate::core::{ROTARY, Report};
use crate::iso::Iso;
use crate::words::Words;
use crate::{AXIS_LETTERS, FaultKind, LengthOf, Position};

/// How far the coordinates of the axes have moved since the last word of each.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moved {
    /// Axes that it concerns.
    axes: u16,
    /// Axes of which it is not declared how far.
    unclear: u16,
    /// mm or deg, of the others.
    by: [f64; 9],
}

impl Moved {
    fn add(&mut self, before: &Position, now: &Position, unclear: u16) {
        for axis in 0..9 {
            let bit = 1 << axis;
            let by = match (before.get(axis), now.get(axis)) {
                (Some(before), Some(now)) => now - before,
                _ => 0.0,
            };
            if by.abs() > 1e-9 || unclear & bit != 0 {
                self.axes |= bit;
                self.unclear |= unclear & bit;
                self.by[axis] += by;
            }
        }
    }

    /// The coordinates of incremental words; returns those that are not known. `travels`: the setting, where it is declared.
    fn act(&mut self, named: u16, incremental: u16, travels: Option<bool>, end: &mut Position) -> u16 {
        let concerned = self.axes & named & incremental;
        let unknown = match travels {
            None => concerned,
            Some(true) => 0,
            Some(false) => concerned & self.unclear,
        };
        if travels == Some(true) {
            for axis in (0..9).filter(|axis| concerned & (1 << axis) != 0) {
                end.values[axis] -= self.by[axis];
            }
        }
        end.known &= !unknown;
        self.axes &= !named;
        self.unclear &= !named;
        for axis in (0..9).filter(|axis| named & (1 << axis) != 0) {
            self.by[axis] = 0.0;
        }
        unknown
    }
}

impl Iso<'_> {
    /// Runs what may move the zero point or the frames.
    pub(crate) fn frames_move(&mut self, act: impl FnOnce(&mut Self)) {
        if !self.core.dialect.quirks.declares_names() {
            return act(self);
        }
        let zero = |iso: &Self| (iso.core.state.zero.offset_name(), iso.core.state.zero.undeclared());
        let (before, (name, undeclared)) = (self.in_words(), zero(self));
        act(self);
        let (now, (new_name, new_undeclared)) = (self.in_words(), zero(self));
        let unclear = if name == new_name {
            0
        } else {
            (undeclared | new_undeclared) & (XYZ | ROTARY)
        };
        self.memory.frames.frame_moves.add(&before, &now, unclear);
    }

    /// Runs what may change the tool length.
    pub(crate) fn lengths_move(&mut self, act: impl FnOnce(&mut Self)) {
        if !self.core.dialect.quirks.declares_names() {
            return act(self);
        }
        let length = |iso: &Self| (iso.core.state.length.of(), iso.core.state.length.is_undeclared());
        let (before, (of, undeclared)) = (self.in_words(), length(self));
        act(self);
        let (now, (new_of, new_undeclared)) = (self.in_words(), length(self));
        let other = of != new_of || new_of == LengthOf::Other;
        let along = self.core.setup.length_along();
        let unclear = (0..3)
            .filter(|axis| other && (undeclared || new_undeclared) && along[*axis] != 0.0)
            .fold(0, |all, axis| all | 1 << axis);
        self.memory.frames.length_moves.add(&before, &now, unclear);
    }

    /// The position in the coordinates of the words.
    fn in_words(&mut self) -> Position {
        let position = self.core.state.position;
        self.memory.frames.programmed(&position)
    }

    /// The effect on the coordinates of a block, which are those of the words.
    pub(crate) fn after_offsets(&mut self, words: &Words, end: &mut Position, report: &mut Report<'_>) {
        let named = words.axes.given | words.axes.unread;
        let incremental = self.distances(words);
        let frames = &mut self.memory.frames;
        if (frames.frame_moves.axes | frames.length_moves.axes) & named == 0 {
            return;
        }
        let control = &self.core.setup.control;
        let by_frames = frames
            .frame_moves
            .act(named, incremental, control.increment_adds_frame, end);
        let by_lengths = frames
            .length_moves
            .act(named, incremental, control.increment_adds_length, end);
        for (unknown, of, data, key) in [
            (by_frames, "zero point or frame", 42440, "increment_adds_frame"),
            (by_lengths, "tool length", 42442, "increment_adds_length"),
        ] {
            if unknown == 0 {
                continue;
            }
            let letters: Vec<_> = (0..9)
                .filter(|axis| unknown & (1 << axis) != 0)
                .map(|axis| char::from(AXIS_LETTERS[axis]).to_string())
                .collect();
            let what = format!(
                "incremental {} after another {of} (setting data {data}): what it travels (declare [control] {key}; the offsets too)",
                letters.join(" ")
            );
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
    }
}
