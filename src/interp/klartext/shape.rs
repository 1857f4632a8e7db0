//! Cycles that mirror, turn and scale the system of coordinates: 8, 10 and 11.
use super::Klartext;
use super::reason::Reason;
use super::words::Words;
use crate::core::Report;
use crate::frames::{Rotation, Scaling};
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
        let mut shape = self.memory.frames.shape;
        shape.mirror = mirror;
        self.reshape(shape);
        if mirror != [None; 3] && shape.rotation.is_some() {
            Self::not_modelled("cycle 8 together with cycle 10: their order", report);
            self.lose(Reason::Order);
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
        self.reshape(shape);
        if angle != 0.0 && shape.mirror != [None; 3] {
            Self::not_modelled("cycle 10 together with cycle 8: their order", report);
            self.lose(Reason::Order);
        }
    }

    /// 11.1 SCL 0.99.
    pub(super) fn scaling(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            return;
        }
        let said = words.find(|word| word.is("SCL")).map(|word| word.value);
        let factor = said
            .and_then(|said| self.said(said, report))
            .filter(|factor| *factor > 0.0);
        let Some(factor) = factor else {
            Self::not_modelled("cycle 11 without a factor", report);
            return self.lose(Reason::Scale);
        };
        // whether the axis of the tool is scaled too is a parameter of the machine
        if factor != 1.0 {
            Self::not_modelled(
                "cycle 11: a machine parameter decides whether the tool axis is scaled",
                report,
            );
            return self.lose(Reason::Scale);
        }
        self.found(Reason::Scale);
        let mut shape = self.memory.frames.shape;
        shape.scaling = None::<Scaling>;
        self.reshape(shape);
    }

    fn reshape(&mut self, shape: crate::frames::Shape) {
        self.found(Reason::Order);
        self.memory.frames.shape = shape;
        let position = self.core.state.position;
        self.memory.frames.refresh(&position);
        self.memory.pole = [None; 3];
    }
}
