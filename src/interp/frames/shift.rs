//! Shifts of the zero point by the program: G52, G92, G92.1.
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;

impl<'d> Iso<'d> {
    /// The active zero point from its parts. The machine stays where it is.
    pub(crate) fn refresh_zero(&mut self) {
        let frames = &self.memory.frames;
        let mut zero = frames.selected;
        for (axis, value) in zero.iter_mut().enumerate() {
            *value += frames.added(axis);
        }
        self.core.state.zero.set_here(frames.shift != [0.0; 9]);
        self.move_zero(zero);
        self.memory.frames.shift_plane(&mut self.core.state.position);
    }

    /// Length of a word of an axis in mm or degrees, radius where the control programs diameters.
    pub(crate) fn axis_value(&self, words: &Words, axis: usize) -> Option<f64> {
        let linear = crate::core::LINEAR & (1 << axis) != 0;
        let unit = if linear {
            self.core.state.coordinates.unit_mm()
        } else {
            1.0
        };
        words.axes.get(axis).map(|value| value * unit)
    }

    /// Shifts can be applied only where words are work coordinates.
    fn shifts_plainly(&self, words: &Words) -> bool {
        let frames = &self.memory.frames;
        frames.shape.is_identity()
            && words.axes.unread == 0
            && !self.core.state.tool_axis.tcp()
            && frames.tilt.is_none()
    }

    /// G52: the work coordinates' zero moves to the given place; 0 ends it.
    pub(crate) fn local_shift(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        block.takes_coordinates = true;
        // the sources do not say whether the distance is relative to the last shift
        let unclear = self.core.state.coordinates.incremental()
            && (0..9).any(|axis| words.axes.get(axis).is_some_and(|value| value != 0.0));
        if unclear || !self.shifts_plainly(words) {
            let frames = &self.memory.frames;
            let why = if frames.tilt.is_some() {
                "in a tilted plane: whether its shift lies in the plane is not taken from a source"
            } else if !frames.shape.is_identity() {
                "in a turned, mirrored or scaled system: whether its shift is turned too is not taken from a source"
            } else if self.core.state.tool_axis.tcp() {
                "while the tip of the tool is guided"
            } else {
                "with increments, or with a value that is not known"
            };
            return self.frame_unknown(why, found, words, block, report);
        }
        for axis in 0..9 {
            if let Some(value) = self.axis_value(words, axis) {
                self.memory.frames.local[axis] = value;
            }
        }
        self.refresh_zero();
    }

    /// G92: the present point gets the given coordinates, in all work offsets; where custom macro B is, it ends G52 of these axes (Haas mill operator's
    /// manual 96-8000, p. 146; Fanuc operator's manual, local coordinate system). With S alone it limits the speed.
    pub(crate) fn position_set(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        if words.speed.is_given() {
            let limit = words.speed.number().map_or(f64::NAN, |number| number.value);
            self.core.state.spindle.limit(Some(limit));
            if !words.axes.any() {
                return;
            }
        }
        block.takes_coordinates = true;
        let known = words.axes.given & !self.core.state.position.known == 0;
        // under a length offset the coordinates are those of the point before it
        let named = |(axis, along): (usize, f64)| along != 0.0 && words.axes.get(axis).is_some();
        let acts = self.core.state.length.is_open() || self.core.state.length.mm().is_some_and(|length| length != 0.0);
        let length = acts && self.core.setup.length_along().into_iter().enumerate().any(named)
            || self.memory.frames.turret != [0.0; 9];
        if !known || length || !self.shifts_plainly(words) || self.core.state.zero.is_lost() {
            self.frame_change(found, words, block, report);
            return;
        }
        self.core.set_from_here(self.core.main_block(report.block), None);
        for axis in 0..9 {
            if let Some(value) = self.axis_value(words, axis) {
                let value = if self.core.dialect.quirks.diameter && words.axes.incremental & (1 << axis) != 0 {
                    self.core.state.position.values[axis] + value
                } else {
                    value
                };
                self.memory.frames.shift[axis] += self.core.state.position.values[axis] - value;
                if self.core.dialect.quirks.macro_b() {
                    self.memory.frames.shift[axis] += std::mem::take(&mut self.memory.frames.local[axis]);
                }
            }
        }
        self.refresh_zero();
    }

    /// G92.1: shifts end for the axes that are named, or for all.
    pub(crate) fn position_preset(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes) {
        block.takes_coordinates = true;
        let named = words.axes.given | words.axes.unread;
        for axis in (0..9).filter(|axis| named == 0 || named & (1 << axis) != 0) {
            self.memory.frames.shift[axis] = 0.0;
            self.memory.frames.local[axis] = 0.0;
        }
        self.refresh_zero();
        if named == 0 || named & super::XYZ == super::XYZ {
            let ended = self.core.unknown.end(found.code);
            self.core.forget_if(ended);
        }
    }
}
