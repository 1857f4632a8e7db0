//! Shifts by cycle 7 inside a tilted plane.
//!
//! A shift before PLANE moves the datum about which the plane turns, one after it acts along the axes of the plane (TNC 620 user's manual,
//! Klartext, 10/2017, p. 145; TNC 640, 10/2017, p. 153). Which of both a later cycle 7 replaces, and where a shift acts whose plane has ended, is
//! not taken from a source.
use super::Klartext;
use super::reason::Reason;
use crate::core::Report;

impl Klartext<'_> {
    /// Whether a shift acts along the axes of the active plane: no shift was in effect when the plane began.
    pub(super) fn shifts_in_plane(&mut self) -> bool {
        let frames = &mut self.memory.frames;
        let plain = frames.swivel.is_some() || frames.local[..3] == [0.0; 3];
        if plain && frames.swivel.is_none() {
            frames.swivel = frames.tilt;
        }
        plain
    }

    /// The active plane ends, or another one follows, which `turns` or has zero angles.
    pub(super) fn leave_plane(&mut self, turns: bool, report: &mut Report<'_>) {
        if self.memory.frames.inside_plane() || turns && self.memory.level_shift {
            let what = "a shift by cycle 7 in a tilted plane, once the plane ends (shift back before it)";
            self.not_modelled_once(what, report);
            self.lose(Reason::Inside);
        }
        self.memory.frames.swivel = None;
    }

    /// PLANE RESET after the shift was taken back: nothing is left of both.
    pub(super) fn nothing_is_shifted(&mut self) {
        self.memory.level_shift = false;
        if self.memory.lost.has(Reason::Inside) && self.memory.frames.local[..3] == [0.0; 3] {
            self.found(Reason::Inside);
            self.refresh_zero();
        }
    }

    /// The datum of the plane moves, and the machine stays where it is.
    pub(super) fn shift_plane(&mut self) {
        let before = self.memory.frames.tilt;
        let mut position = self.core.state.position;
        self.memory.frames.shift_plane(&mut position);
        if self.memory.frames.tilt != before {
            self.core.state.position = position;
            self.memory.frames.refresh(&position);
            self.memory.pole = [None; 3];
        }
    }
}
