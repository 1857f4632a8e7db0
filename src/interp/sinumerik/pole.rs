//! Polar coordinates AP, RP about the pole of G110, G111, G112.
use super::path::PathWords;
use crate::arc::plane_axes;
use crate::codes::{BlockCodes, Found, not_modelled};
use crate::core::Report;
use crate::frames::sin_cos_degrees;
use crate::iso::Iso;
use crate::words::{Words, put_absolute};
use trunnion_dialect::{Action, Plane};

/// A pole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pole {
    plane: Plane,
    /// mm, in the coordinates of the words.
    pub(super) centre: [f64; 2],
    /// The frame in which it was given.
    zero: [u64; 9],
    shape: crate::frames::Shape,
}

impl<'d> Iso<'d> {
    /// AP and RP: the end; of an arc the pole is the centre.
    pub(super) fn polar_end(&mut self, path: &PathWords, words: &mut Words) -> Option<()> {
        let plane = self.core.state.coordinates.plane();
        let [a, b, _] = plane_axes(plane);
        let unit = self.core.state.coordinates.unit_mm();
        let arc = self.is_arc().is_some();
        let line = matches!(self.core.state.motion, Some(Action::Rapid | Action::Linear));
        let others = path.opening.is_some() || path.angle.is_some() || self.named_in_plane(words) != 0;
        let bare = arc && !words.centre.any() && !words.radius.is_given();
        if others || !bare && !line {
            return None;
        }
        let incremental = self.core.state.coordinates.incremental();
        let here = self.here();
        let pole = self
            .memory
            .own
            .contour
            .pole
            .filter(|pole| *pole == self.pole_at(pole.centre))?;
        let polar = path.polar;
        let meant = |place: usize, before: Option<f64>| {
            let bit = 1 << place;
            let value = polar.get(place)?;
            match (polar.incremental & bit != 0, polar.absolute & bit != 0) {
                (true, false) => before.map(|before| before + value),
                (false, absolute) => (absolute || !incremental).then_some(value),
                (true, true) => None,
            }
        };
        let contour = self.memory.own.contour;
        let stands = |place: &(f64, [f64; 2])| here.get(a) == Some(place.1[0]) && here.get(b) == Some(place.1[1]);
        let angle = meant(0, contour.angle.filter(stands).map(|angle| angle.0))?;
        let radius = if polar.get(1).is_some() {
            meant(1, contour.radius.map(|radius| radius / unit))? * unit
        } else {
            contour.radius?
        };
        // the manual gives the polar angle from -360 to 360 degrees
        if radius < 0.0 || polar.get(0).is_some_and(|angle| angle.abs() > 360.0) {
            return None;
        }
        let (sin, cos) = sin_cos_degrees(angle);
        let end = [pole.centre[0] + radius * cos, pole.centre[1] + radius * sin];
        for (axis, (end, centre)) in [a, b].into_iter().zip(end.into_iter().zip(pole.centre)) {
            put_absolute(&mut words.axes, axis, end / unit);
            if arc {
                put_absolute(&mut words.centre, axis, centre / unit);
            }
        }
        let contour = &mut self.memory.own.contour;
        (contour.radius, contour.angle) = (Some(radius), Some((angle, end)));
        Some(())
    }

    fn pole_at(&self, centre: [f64; 2]) -> Pole {
        Pole {
            plane: self.core.state.coordinates.plane(),
            centre,
            zero: self.core.state.zero.values().map(f64::to_bits),
            shape: self.memory.frames.shape,
        }
    }

    /// G110: relative to the present point, G111: in the workpiece, G112: relative to the last pole; G90 and G91 change nothing in that
    /// (SINUMERIK 840Di sl, Programming Manual, Fundamentals, 11/2006, p. 118). What a coordinate that is left out means to G110 and G111 is not said there.
    pub(crate) fn pole(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes, report: &mut Report<'_>) {
        block.takes_coordinates = true;
        let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
        let unit = self.core.state.coordinates.unit_mm();
        let here = self.here();
        let contour = self.memory.own.contour;
        let base = match found.code.id.as_str() {
            "G110" => here.get(a).zip(here.get(b)),
            "G111" => Some((0.0, 0.0)),
            _ => contour
                .pole
                .filter(|pole| *pole == self.pole_at(pole.centre))
                .map(|pole| pole.centre.into()),
        };
        let path = self.memory.own.path;
        // relative to the last pole, a coordinate that is left out stays that of it
        let stays = found.code.id == "G112" && (words.axes.get(a).is_some() || words.axes.get(b).is_some());
        let by_word = |axis: usize| words.axes.get(axis).or(stays.then_some(0.0));
        let in_words = by_word(a).zip(by_word(b)).map(|(x, y)| (x * unit, y * unit));
        let in_angles = path.polar.get(0).zip(path.polar.get(1)).map(|(angle, radius)| {
            let (sin, cos) = sin_cos_degrees(angle);
            (radius * unit * cos, radius * unit * sin)
        });
        let by = if path.polar.any() { in_angles } else { in_words };
        let directed = words.axes.absolute | words.axes.incremental | path.polar.absolute | path.polar.incremental;
        let plain = directed == 0
            && !path.unread
            && (!path.polar.any() || !words.axes.any())
            && words.axes.given | words.axes.unread == words.axes.given & ((1 << a) | (1 << b));
        let centre = base
            .zip(by)
            .filter(|_| plain)
            .map(|(base, by)| [base.0 + by.0, base.1 + by.1]);
        let pole = centre.map(|centre| self.pole_at(centre));
        if pole.is_none() {
            not_modelled(found, report);
        }
        let contour = &mut self.memory.own.contour;
        // angle and radius have to be written again behind another pole (SINUMERIK 808D, Programming and Operating Manual, Milling, 01/2014, p. 54)
        (contour.pole, contour.angle, contour.radius) = (pole, None, None);
    }
}
