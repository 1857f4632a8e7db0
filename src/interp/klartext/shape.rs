//! Cycles that mirror and turn the system of coordinates: 8 and 10. Those that scale it are in `scaling`.
use super::Klartext;
use super::reason::Reason;
use super::words::Words;
use crate::core::Report;
use crate::frames::Rotation;
use crate::{AxisLetter, Refusal};

impl Klartext<'_> {
    /// 8.1 X Y: mirrors the named axes; none: ends.
    pub(super) fn mirror(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            return;
        }
        let mut mirror = [None; 3];
        for word in words.by_ref() {
            if let [letter] = word.name()
                && let Some(AxisLetter(axis @ 0..=2)) = AxisLetter::new(*letter)
            {
                mirror[usize::from(axis)] = Some(0.0);
            }
        }
        self.found(Reason::Mirror);
        let mut shape = self.memory.frames.shape;
        shape.mirror = mirror;
        self.reshape(shape, report);
        if mirror != [None; 3] && shape.rotation.is_some() {
            Self::not_modelled("cycle 8 together with cycle 10: their order", report);
        }
    }

    /// 10.1 ROT+35, IROT+5.
    pub(super) fn rotation(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            return;
        }
        let Some(word) = words.find(|word| word.is("ROT") || word.is("IROT")) else {
            return Self::rejected(Refusal::MissingWord, "cycle 10 needs ROT", report);
        };
        let added = if word.is("IROT") { self.memory.rotation } else { 0.0 };
        // what is added to an unknown angle is unknown
        let from = !word.is("IROT") || !self.memory.lost.has(Reason::Rotation);
        let Some(angle) = self
            .said(word.value, report)
            .filter(|_| from)
            .map(|angle| angle + added)
        else {
            return self.lose(Reason::Rotation);
        };
        self.found(Reason::Rotation);
        let mut shape = self.memory.frames.shape;
        self.memory.rotation = angle;
        let plane = self.core.state.coordinates.plane();
        shape.rotation = (angle != 0.0).then(|| Rotation::new(plane, [0.0, 0.0], angle));
        self.reshape(shape, report);
        if angle != 0.0 && shape.mirror != [None; 3] {
            Self::not_modelled("cycle 10 together with cycle 8: their order", report);
        }
    }

    /// The system has another shape; the machine stays where it is.
    pub(super) fn reshape(&mut self, shape: crate::frames::Shape, report: &mut Report<'_>) {
        self.memory.frames.shape = shape;
        let position = self.core.state.position;
        self.memory.frames.refresh(&position);
        (self.memory.pole, self.memory.heading) = ([None; 3], None);
        if shape.rotation.is_some() && shape.mirror != [None; 3] {
            self.lose(Reason::Order);
        } else {
            self.found(Reason::Order);
        }
        self.review_scaling(report);
    }
}
