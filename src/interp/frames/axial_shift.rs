//! The two parts of a shift that a Sinumerik program sets: the absolute one of TRANS and G58, and the additive one of ATRANS and G59. G58 and G59
//! replace their part for the axes that they name and leave the other (SINUMERIK ONE, NC programming, 12/2019, p. 315; SINUMERIK 840Di sl,
//! Programming Manual, Fundamentals, 11/2006, p. 238). They are followed where nothing turns, scales or mirrors. Whether the additive part of
//! G59 outlives a code that replaces the frame is stated there in another way than elsewhere: that is not followed.
use super::XYZ;
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;

/// The parts of the programmed shift, of which [`super::Frames`] holds the sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ShiftParts {
    /// mm or degrees.
    additive: [f64; 9],
    /// How the shift is divided is not known.
    is_open: bool,
    /// G58 or G59 has made a difference between them.
    by_axis: bool,
}

impl ShiftParts {
    /// Of a frame that is set as a whole: it has no additive part unless CFINE was in it.
    pub(crate) fn of_frame(fine: bool) -> Self {
        Self {
            is_open: fine,
            ..Self::default()
        }
    }
    /// ATRANS; `plain`: nothing turns or scales it.
    pub(crate) fn add(&mut self, by: &[f64; 9], plain: bool) {
        self.is_open |= !plain;
        for (value, by) in self.additive.iter_mut().zip(by) {
            *value += by;
        }
    }
    /// Whether the shift is more than its absolute part.
    pub(crate) fn has_fine(&self) -> bool {
        self.is_open || self.by_axis && self.additive != [0.0; 9]
    }
}

impl<'d> Iso<'d> {
    /// G58 and G59.
    pub(super) fn axial_shift(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let frames = &self.memory.frames;
        let axes = &words.axes;
        let plain = axes.given != 0
            && axes.given & !XYZ == 0
            && axes.unread | axes.incremental == 0
            && frames.shape.is_identity()
            && frames.tilt.is_none()
            && frames.swivel.is_none()
            && !frames.parts.is_open
            && !self.core.unknown.any();
        if !plain {
            return self.frame_change(found, words, block, report);
        }
        for axis in 0..3 {
            let Some(value) = self.axis_value(words, axis) else {
                continue;
            };
            let frames = &mut self.memory.frames;
            let additive = &mut frames.parts.additive[axis];
            if found.code.id == "G58" {
                frames.local[axis] = value + *additive;
            } else {
                frames.local[axis] += value - *additive;
                *additive = value;
            }
        }
        self.memory.frames.parts.by_axis = true;
        self.refresh_zero();
        let position = self.core.state.position;
        self.memory.frames.refresh(&position);
    }

    /// Whether a code that replaces the programmed frame meets an additive part of G59.
    pub(super) fn replaces_fine_part(&self) -> bool {
        let parts = &self.memory.frames.parts;
        parts.by_axis && parts.additive != [0.0; 9]
    }
}
