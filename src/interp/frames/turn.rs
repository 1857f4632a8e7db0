//! G68, G51, G51.1, G16 and their ends.
use super::{Polar, Rotation, Scaling};
use crate::FaultKind;
use crate::arc::plane_axes;
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::macro_b::is_fanuc;
use crate::words::Words;
use trunnion_dialect::Action;

impl<'d> Iso<'d> {
    /// Whether nothing is active that would make the position of a new frame unclear.
    fn frames_are_plain(&self) -> bool {
        !self.core.state.zero.is_lost()
            && !self.core.state.tool_axis.tcp()
            && self.memory.frames.polar.is_none()
            && self.memory.frames.tilt.is_none()
    }

    fn reshaped(&mut self) {
        let position = self.core.state.position;
        self.memory.frames.refresh(&position);
    }

    /// G68 about a point of the plane, or about the present point; R is the angle in degrees.
    pub(crate) fn rotation_on(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let plane = self.core.state.coordinates.plane();
        let [a, b, _] = plane_axes(plane);
        let angle = words.radius.number().map(|number| number.value);
        let position = self.core.state.position;
        let here = self.memory.frames.programmed(&position);
        let unit = self.core.state.coordinates.unit_mm();
        let centre = [a, b].map(|axis| match words.axes.get(axis) {
            Some(value) => Some(value * unit),
            None if words.axes.unread & (1 << axis) != 0 => None,
            None => here.get(axis),
        });
        // I J K: about an axis in space; a rotation in a rotation adds to it or not, as a parameter says
        let plain = self.frames_are_plain() && !words.centre.any() && self.memory.frames.shape.rotation.is_none();
        let (Some(angle), [Some(x), Some(y)], true) = (angle, centre, plain && !self.scales_unevenly()) else {
            self.frame_change(found, words, block, report);
            return;
        };
        block.takes_coordinates = true;
        self.memory.frames.shape.rotation = Some(Rotation::new(plane, [x, y], angle));
        self.memory.frames.fresh = (1 << a) | (1 << b);
        self.reshaped();
    }

    /// The axes are scaled by unlike factors, or mirrored by negative ones: whether these turn the angle about is not in the manual.
    fn scales_unevenly(&self) -> bool {
        let scaling = self.memory.frames.shape.scaling;
        scaling.is_some_and(|scaling| scaling.uniform().is_none() || scaling.factors.iter().any(|factor| *factor < 0.0))
    }

    /// Why a drilling cycle along an axis that is scaled is not followed: the steps and clearances of pecks and the shift off the wall keep their size
    /// (Fanuc Series 30i operator's manual, scaling: limitations), and on a Haas the levels of the cycle may (mill operator's manual, G51).
    pub(crate) fn scaled_steps(&self, axis: usize) -> Option<&'static str> {
        let scaling = self.memory.frames.shape.scaling?;
        let moves_in_steps = matches!(
            self.core.state.motion,
            Some(Action::PeckCycle | Action::ChipBreakCycle | Action::FineBoreCycle | Action::BackBoreCycle)
        );
        let all = self.core.dialect.quirks.plain_scale_factor;
        let scaled = |axis: usize| scaling.factors.get(axis).is_some_and(|factor| *factor != 1.0);
        if scaled(axis) && all {
            Some("in scaled coordinates: which of its levels are scaled is not taken from a source")
        } else if moves_in_steps && (0..3).any(scaled) {
            Some("in scaled coordinates: its steps and its shift keep their size, which is not followed")
        } else {
            None
        }
    }

    /// What must not be programmed while coordinates are turned, scaled or mirrored: returns to reference points, and another system of coordinates
    /// or plane (Fanuc Series 30i operator's manual, coordinate system rotation, scaling and programmable mirror image: limitations).
    #[cold]
    pub(crate) fn not_in_shapes(&self, codes: &[Found<'d>], block: &mut BlockCodes, report: &mut Report<'_>) {
        if !is_fanuc(self.core.dialect) || self.memory.frames.shape.is_identity() {
            return;
        }
        for found in codes {
            let forbidden = match found.code.action {
                Action::WorkOffset
                | Action::MachineCoordinates
                | Action::ReferenceCheck
                | Action::ReferenceReturn
                | Action::ReferenceReturnOther
                | Action::ReferenceFrom => true,
                Action::PlaneXy | Action::PlaneZx | Action::PlaneYz => self.memory.frames.shape.rotation.is_some(),
                _ => false,
            };
            if forbidden {
                let what = format!(
                    "{} while coordinates are turned, scaled or mirrored: the control does not allow it (end G68, G51 or G51.1 first)",
                    found.code.id
                );
                report.fault(found.range, FaultKind::NotModelled { what });
                block.not_modelled = true;
            }
        }
    }

    /// G69.
    pub(crate) fn rotation_off(&mut self, found: &Found<'d>) {
        if let Some(rotation) = self.memory.frames.shape.rotation.take() {
            let [a, b, _] = plane_axes(rotation.plane);
            self.memory.frames.fresh = 0;
            self.memory.frames.must_be_absolute = (1 << a) | (1 << b);
            self.reshaped();
        }
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
    }

    /// G51: factor P for all axes, or I J K for X Y Z.
    pub(crate) fn scaling_on(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let shape = &self.memory.frames.shape;
        let plain = self.frames_are_plain() && shape.rotation.is_none() && shape.scaling.is_none();
        let factors = self.scale_factors(words);
        let position = self.core.state.position;
        let here = self.memory.frames.programmed(&position);
        let unit = self.core.state.coordinates.unit_mm();
        let mut centre = [0.0; 3];
        let mut known = words.axes.unread == 0 && plain;
        if let Some(factors) = factors {
            for axis in 0..3 {
                match words.axes.get(axis).map(|value| value * unit).or(here.get(axis)) {
                    Some(value) => centre[axis] = value,
                    None => known &= factors[axis] == 1.0,
                }
            }
        }
        let (Some(factors), true) = (factors, known) else {
            self.frame_change(found, words, block, report);
            return;
        };
        block.takes_coordinates = true;
        self.memory.frames.shape.scaling = Some(Scaling { centre, factors });
        self.reshaped();
    }

    /// Factors of X Y Z; `None` where the unit of a whole number is a parameter of the control, or one is zero.
    fn scale_factors(&self, words: &Words) -> Option<[f64; 3]> {
        let plain = self.core.dialect.quirks.plain_scale_factor;
        let factor = |letter: u8| match words.letter(letter) {
            crate::words::WordValue::Nothing => Some(None),
            said => {
                let number = said.number().filter(|number| plain || number.has_point)?;
                (number.value != 0.0).then_some(Some(number.value))
            }
        };
        let by_axis = [factor(b'I')?, factor(b'J')?, factor(b'K')?];
        match (factor(b'P')?, by_axis) {
            (Some(all), [None, None, None]) => Some([all; 3]),
            (None, [None, None, None]) | (Some(_), _) => None,
            (None, by_axis) => Some(by_axis.map(|factor| factor.unwrap_or(1.0))),
        }
    }

    /// G50.
    pub(crate) fn scaling_off(&mut self, found: &Found<'d>) {
        self.memory.frames.shape.scaling = None;
        self.reshaped();
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
    }

    /// G51.1: axes are mirrored about the given coordinates.
    pub(crate) fn mirror_on(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let shape = &self.memory.frames.shape;
        let plain = self.frames_are_plain() && shape.rotation.is_none() && shape.scaling.is_none();
        let named = words.axes.given & super::XYZ;
        let others = (words.axes.given & !super::XYZ) | words.axes.unread;
        // mirrored again about another line
        let again = (0..3).any(|axis| named & (1 << axis) != 0 && shape.mirror[axis].is_some());
        if !plain || others != 0 || named == 0 || again {
            self.frame_change(found, words, block, report);
            return;
        }
        block.takes_coordinates = true;
        for axis in 0..3 {
            if let Some(line) = self.axis_value(words, axis) {
                self.memory.frames.shape.mirror[axis] = Some(line);
            }
        }
        self.reshaped();
    }

    /// G50.1: mirroring ends for the named axes, or for all.
    pub(crate) fn mirror_off(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes) {
        block.takes_coordinates = true;
        let named = words.axes.given | words.axes.unread;
        for axis in (0..3).filter(|axis| named == 0 || named & (1 << axis) != 0) {
            self.memory.frames.shape.mirror[axis] = None;
        }
        self.reshaped();
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
    }

    /// G16 and G15.
    pub(crate) fn polar(&mut self, on: bool) {
        self.memory.frames.polar = on.then(Polar::default);
        self.reshaped();
    }

    /// The effect of a turned plane on coordinates of a block: after G68 an axis that no word has named yet has an unknown position
    /// once the other is given; after G69 the first coordinate must be absolute.
    pub(crate) fn after_turn(&mut self, words: &Words, end: &mut crate::Position) {
        let named = words.axes.given | words.axes.unread;
        let frames = &mut self.memory.frames;
        let absolute = !self.core.state.coordinates.incremental();
        if named & frames.fresh != 0 && absolute {
            end.known &= !(frames.fresh & !named);
            frames.fresh &= !named;
        }
        if frames.must_be_absolute & named != 0 {
            let directed = words.axes.shortest | words.axes.positive | words.axes.negative;
            let added = if absolute {
                words.axes.incremental
            } else {
                !(words.axes.absolute | directed)
            };
            end.known &= !(frames.must_be_absolute & named & added);
            frames.must_be_absolute &= !named;
        }
    }
}
