//! Words that give a path by something other than its end and centre: polar coordinates about a pole (AP, RP), the opening angle of an arc
//! (AR), the angle of a line (ANG), an intermediate point (I1 J1 K1), corners (CHF, CHR, RND, RNDM), and the angle of a turned frame (RPL).
//! Where their values are known they become coordinates and centres; else the block is not followed.
//!
//! Source: Sinumerik 840D sl Programming Manual, Fundamentals: polar coordinates, circular interpolation, contour definitions, chamfer and
//! rounding. What a pole or a polar angle means under G91, or after a change of the frame, is not taken from there.
use crate::arc::plane_axes;
use crate::codes::{BlockCodes, Found, not_modelled};
use crate::core::Report;
use crate::frames::sin_cos_degrees;
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::{Number, Places, Reading, WordValue, Words, put};
use crate::{FaultKind, MotionKind, Position};
use trunnion_dialect::{Action, Plane};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::{atan2, hypot, tan};
use trunnion_syntax::{TextRange, Word};

/// Lengths below are no length, mm.
const NO_LENGTH: f64 = 1e-9;

/// The words of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PathWords {
    /// The first of them.
    range: Option<TextRange>,
    /// The value of one is not known.
    unread: bool,
    /// I1 J1 K1.
    through: Places<3>,
    /// AP, RP.
    polar: Places<2>,
    /// AR, deg.
    opening: Option<f64>,
    /// ANG, deg.
    angle: Option<f64>,
    /// RPL, deg.
    frame: Option<f64>,
    /// CHF (F), CHR (C) or RND (R).
    corner: Option<(u8, f64)>,
    /// RNDM.
    modal_corner: Option<f64>,
}

impl PathWords {
    pub(crate) fn any(&self) -> bool {
        self.range.is_some()
    }
    /// Whether one of them gives the end of a motion.
    fn gives_end(&self) -> bool {
        self.polar.any() || self.opening.is_some() || self.angle.is_some() || self.unread
    }
    /// CHF (`F`), CHR (`C`) or RND (`R`) and its size.
    pub(crate) fn corner(&self) -> Option<(u8, f64)> {
        self.corner
    }
    /// Whether RNDM is in the block.
    pub(crate) fn sets_rounding(&self) -> bool {
        self.modal_corner.is_some()
    }
    /// RPL, if it is there; NaN: its value is unknown.
    pub(crate) fn frame_angle(&self) -> Option<f64> {
        if self.unread { Some(f64::NAN) } else { self.frame }
    }
}

/// What the words of a block before leave behind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Contour {
    pole: Option<Pole>,
    /// RP, mm.
    radius: Option<f64>,
    /// AP and the place that it gave, in the plane.
    angle: Option<(f64, [f64; 2])>,
    /// RNDM, mm; 0: off.
    pub(crate) rounding: f64,
    /// Where the last motion in the plane ended, and its direction there.
    heading: Option<(Position, Vec3)>,
}

impl Contour {
    /// What a program that is missing could read of it: see [`crate::Interpreter::turned`].
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        let pole = self.pole.map(|pole| pole.centre);
        let rounding = (self.rounding != 0.0).then_some([f64::INFINITY, self.rounding]);
        let angle = self.angle.map_or(f64::NAN, |angle| angle.0);
        let polar = pole.map(|_| [self.radius.unwrap_or(f64::NAN), angle]);
        [pole, polar, rounding].into_iter().flatten().flatten()
    }
}

/// See [`Contour`].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pole {
    plane: Plane,
    /// mm, in the coordinates of the words.
    centre: [f64; 2],
    /// The frame in which it was given.
    zero: [u64; 9],
    shape: crate::frames::Shape,
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// One of these words.
    pub(crate) fn path_word(&mut self, word: &Word) {
        let text = self.text(word.range).to_ascii_uppercase();
        let name = text.split(['=', '[', ' ']).next().unwrap_or_default();
        let (said, reading) = self.said_place(word);
        let Some(own) = self.own.as_mut() else { return };
        let path = &mut own.path;
        path.range = path.range.or(Some(word.range));
        let twice;
        match name {
            "AP" | "RP" | "I1" | "J1" | "K1" => {
                let (places, place) = match name {
                    "AP" => (&mut path.polar.given, 0),
                    "RP" => (&mut path.polar.given, 1),
                    name => (&mut path.through.given, usize::from(name.as_bytes()[0] - b'I')),
                };
                twice = *places & (1 << place) != 0;
                if matches!(name, "AP" | "RP") {
                    put(&mut path.polar, place, (said, reading));
                } else {
                    put(&mut path.through, place, (said, reading));
                }
            }
            _ => {
                let value = said
                    .number()
                    .map(|number| number.value)
                    .filter(|_| reading == Reading::Modal);
                path.unread |= value.is_none();
                let place = match name {
                    "AR" => &mut path.opening,
                    "ANG" => &mut path.angle,
                    "RPL" => &mut path.frame,
                    "RNDM" => &mut path.modal_corner,
                    _ => {
                        let letter = match name {
                            "CHF" => b'F',
                            "CHR" => b'C',
                            _ => b'R',
                        };
                        path.unread |= path.corner.is_some();
                        path.corner = value.map(|value| (letter, value));
                        return;
                    }
                };
                twice = place.is_some();
                *place = value;
            }
        }
        path.unread |= twice || !said.number().is_some_and(|number| number.value.is_finite());
    }
}

/// A coordinate that is absolute whatever is modal.
fn put_absolute<const N: usize>(places: &mut Places<N>, axis: usize, value: f64) {
    let number = Number {
        value,
        has_point: true,
        range: TextRange::default(),
    };
    put(places, axis, (WordValue::Number(number), Reading::Absolute));
    places.incremental &= !(1 << axis);
}

impl<'d> Iso<'d> {
    /// The words of a block with coordinates and centres in place of path words, where these are known; a fault else.
    #[cold]
    pub(crate) fn with_path_words(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) -> Words {
        let path = self.memory.own.path;
        let mut out = *words;
        // of a frame or a pole, which has read them
        if block.takes_coordinates && !path.unread && path.corner.is_none() && path.modal_corner.is_none() {
            return out;
        }
        if block.takes_coordinates || path.unread || self.path_coordinates(&path, &mut out, block).is_none() {
            let range = path.range.unwrap_or_default();
            let what = report.program.text(range).trim().to_owned();
            report.fault(range, FaultKind::NotModelled { what });
            out = *words;
            out.forgets_all = true;
            if path.gives_end() && !block.takes_coordinates {
                // the block moves in the plane, to an unknown place
                let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
                out.axes.unread |= (1 << a) | (1 << b);
            }
            let contour = &mut self.memory.own.contour;
            (contour.radius, contour.angle) = (None, None);
            if path.modal_corner.is_some() || path.unread {
                contour.rounding = f64::NAN;
            }
        }
        out
    }

    /// `None`: something is not known, or the words do not fit together.
    fn path_coordinates(&mut self, path: &PathWords, words: &mut Words, block: &BlockCodes) -> Option<()> {
        let unit = self.core.state.coordinates.unit_mm();
        if let Some(rounding) = path.modal_corner {
            (rounding >= 0.0).then_some(())?;
            self.memory.own.contour.rounding = rounding * unit;
        }
        if path.frame.is_some() {
            return None;
        }
        let motion = self.core.state.motion;
        let through = motion == Some(Action::ArcThroughPoint) && words.axes.any();
        if path.through.any() && !through || block.not_modelled {
            return None;
        }
        if path.polar.any() {
            self.polar_end(path, words)?;
        }
        if let Some(degrees) = path.opening {
            self.opened_arc(degrees, words)?;
        }
        if let Some(degrees) = path.angle {
            self.line_by_angle(degrees, words)?;
        }
        if let Some((_, size)) = path.corner {
            let moves = words.axes.any() && !block.dwell && !block.machine_coordinates;
            (size >= 0.0 && moves).then_some(())?;
        }
        Some(())
    }

    /// The position in the coordinates of the words.
    fn here(&mut self) -> Position {
        let position = self.core.state.position;
        self.memory.frames.programmed(&position)
    }

    /// Axis words of the plane in the block.
    fn named_in_plane(&self, words: &Words) -> u16 {
        let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
        (words.axes.given | words.axes.unread) & ((1 << a) | (1 << b))
    }

    fn is_arc(&self) -> Option<f64> {
        match self.core.state.motion {
            Some(Action::ArcClockwise) => Some(-1.0),
            Some(Action::ArcCounterClockwise) => Some(1.0),
            _ => None,
        }
    }

    /// AP and RP: the end; of an arc the pole is the centre.
    fn polar_end(&mut self, path: &PathWords, words: &mut Words) -> Option<()> {
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
        if radius < 0.0 {
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

    /// G110: relative to the present point, G111: in the workpiece, G112: relative to the last pole.
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
        let in_words = words
            .axes
            .get(a)
            .zip(words.axes.get(b))
            .map(|(x, y)| (x * unit, y * unit));
        let in_angles = path.polar.get(0).zip(path.polar.get(1)).map(|(angle, radius)| {
            let (sin, cos) = sin_cos_degrees(angle);
            (radius * unit * cos, radius * unit * sin)
        });
        let by = if path.polar.any() { in_angles } else { in_words };
        let directed = words.axes.absolute | words.axes.incremental | path.polar.absolute | path.polar.incremental;
        let plain = directed == 0
            && !path.unread
            && !self.core.state.coordinates.incremental()
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
        (contour.pole, contour.angle) = (pole, None);
    }

    /// AR with the centre or with the end of an arc: the other one.
    fn opened_arc(&mut self, degrees: f64, words: &mut Words) -> Option<()> {
        let sense = self.is_arc()?;
        let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
        let unit = self.core.state.coordinates.unit_mm();
        let here = self.here();
        let plain = degrees > 0.0 && degrees < 360.0 && !words.radius.is_given() && !words.turns.is_given();
        let from = [here.get(a)?, here.get(b)?];
        plain.then_some(())?;
        match (words.centre.any(), self.named_in_plane(words) != 0) {
            (true, false) => {
                let mut centre = from;
                for (value, axis) in centre.iter_mut().zip([a, b]) {
                    let bit = 1 << axis;
                    (words.centre.unread & bit == 0).then_some(())?;
                    let absolute = self.core.state.coordinates.arc_centre_absolute();
                    let absolute = words.centre.absolute & bit != 0 || absolute && words.centre.incremental & bit == 0;
                    match words.centre.get(axis) {
                        Some(given) if absolute => *value = given * unit,
                        Some(given) => *value += given * unit,
                        None if absolute => return None,
                        None => {}
                    }
                }
                let (sin, cos) = sin_cos_degrees(sense * degrees);
                let arm = [from[0] - centre[0], from[1] - centre[1]];
                put_absolute(&mut words.axes, a, (centre[0] + cos * arm[0] - sin * arm[1]) / unit);
                put_absolute(&mut words.axes, b, (centre[1] + sin * arm[0] + cos * arm[1]) / unit);
            }
            (false, true) => {
                let mut end = here;
                self.targets(&words.axes, false, &mut end);
                let chord = [end.get(a)? - from[0], end.get(b)? - from[1]];
                (hypot(chord[0], chord[1]) > NO_LENGTH).then_some(())?;
                let away = 0.5 * sense / tan(0.5 * degrees.to_radians());
                put_absolute(
                    &mut words.centre,
                    a,
                    (from[0] + 0.5 * chord[0] - away * chord[1]) / unit,
                );
                put_absolute(
                    &mut words.centre,
                    b,
                    (from[1] + 0.5 * chord[1] + away * chord[0]) / unit,
                );
            }
            _ => return None,
        }
        Some(())
    }

    /// ANG, from the plane's first axis, with one coordinate of the end: the other one.
    fn line_by_angle(&mut self, degrees: f64, words: &mut Words) -> Option<()> {
        let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
        let unit = self.core.state.coordinates.unit_mm();
        let named = self.named_in_plane(words);
        let (given, other) = match (named == 1 << a, named == 1 << b) {
            (true, _) => (a, b),
            (_, true) => (b, a),
            _ => return None,
        };
        (self.core.state.motion == Some(Action::Linear)).then_some(())?;
        let here = self.here();
        let mut end = here;
        self.targets(&words.axes, false, &mut end);
        let (sin, cos) = sin_cos_degrees(degrees);
        let (along, across) = if given == a { (cos, sin) } else { (sin, cos) };
        let length = (end.get(given)? - here.get(given)?) / along;
        // the line may not go against its angle, nor across it
        (length.is_finite() && along.abs() > 1e-6 && length > NO_LENGTH).then_some(())?;
        put_absolute(&mut words.axes, other, (here.get(other)? + length * across) / unit);
        Some(())
    }

    /// CIP: the arc from the present point through I1 J1 K1, in the plane.
    pub(crate) fn arc_through(&self, from: Position, end: Position) -> Option<Arc> {
        let plane = self.core.state.coordinates.plane();
        let axes = plane_axes(plane);
        let unit = self.core.state.coordinates.unit_mm();
        let path = &self.memory.own.path;
        let (start, end) = (from.xyz()?, end.xyz()?);
        let mut through = start;
        for axis in 0..3 {
            let bit = 1 << axis;
            let given = path.through.get(axis).map(|value| value * unit);
            let incremental = self.core.state.coordinates.incremental() && path.through.absolute & bit == 0;
            match given {
                Some(value) if !incremental && path.through.incremental & bit == 0 => through[axis] = value,
                // what an incremental point starts from, and one that is left out in the plane, is not followed
                None if axis == axes[2] => {}
                _ => return None,
            }
        }
        let height = |point: &Vec3| point[axes[2]] - start[axes[2]];
        if path.unread || height(&through).abs() > NO_LENGTH || height(&end).abs() > NO_LENGTH {
            return None;
        }
        let flat = |point: &Vec3| (point[axes[0]] - start[axes[0]], point[axes[1]] - start[axes[1]]);
        let ((px, py), (qx, qy)) = (flat(&through), flat(&end));
        let turn = px * qy - py * qx;
        let size = hypot(px, py) * hypot(qx, qy);
        // three points of a line, or two that are one
        if size <= NO_LENGTH || turn.abs() <= 1e-9 * size || hypot(px - qx, py - qy) <= NO_LENGTH {
            return None;
        }
        let (p2, q2) = (px * px + py * py, qx * qx + qy * qy);
        let centre = [(p2 * qy - q2 * py) / (2.0 * turn), (q2 * px - p2 * qx) / (2.0 * turn)];
        Some(self.arc_about(start, end, centre, turn.signum()))
    }

    /// CT: the arc that leaves in the direction in which the motion before ended.
    pub(crate) fn arc_tangent(&self, from: Position, end: Position) -> Option<Arc> {
        let axes = plane_axes(self.core.state.coordinates.plane());
        let (place, direction) = self.memory.own.contour.heading.filter(|_| !self.memory.frames.active)?;
        if place != from || self.core.state.compensation != 0 || self.memory.corners.is_busy() {
            return None;
        }
        let (start, end) = (from.xyz()?, end.xyz()?);
        let way = end - start;
        if way[axes[2]].abs() > NO_LENGTH {
            return None;
        }
        let (dx, dy) = (direction[axes[0]], direction[axes[1]]);
        let (x, y) = (way[axes[0]], way[axes[1]]);
        let left = dx * y - dy * x;
        // straight on it is a line, straight back there is no arc
        if left.abs() <= 1e-9 * hypot(x, y) || hypot(x, y) <= NO_LENGTH {
            return None;
        }
        let radius = (x * x + y * y) / (2.0 * left);
        Some(self.arc_about(start, end, [-dy * radius, dx * radius], left.signum()))
    }

    /// The arc about a centre in the plane, given from its start; `sense` 1: counter-clockwise.
    fn arc_about(&self, start: Vec3, end: Vec3, centre: [f64; 2], sense: f64) -> Arc {
        let axes = plane_axes(self.core.state.coordinates.plane());
        let arm = [-centre[0], -centre[1]];
        let other = [
            end[axes[0]] - start[axes[0]] - centre[0],
            end[axes[1]] - start[axes[1]] - centre[1],
        ];
        let cross = arm[0] * other[1] - arm[1] * other[0];
        let angle = atan2(cross, arm[0] * other[0] + arm[1] * other[1]);
        let turn = if angle * sense > 0.0 {
            angle
        } else {
            angle + sense * core::f64::consts::TAU
        };
        let mut middle = start;
        middle[axes[0]] += centre[0];
        middle[axes[1]] += centre[1];
        let mut normal = Vec3::zeros();
        normal[axes[2]] = 1.0;
        Arc {
            start,
            end,
            centre: middle,
            normal,
            sweep: turn,
            radius_start: hypot(arm[0], arm[1]),
            radius_end: hypot(other[0], other[1]),
        }
    }

    /// Keeps the direction in which a motion ends, for CT.
    pub(crate) fn note_heading(&mut self, kind: &MotionKind, start: &Position, end: &Position) {
        let axes = plane_axes(self.core.state.coordinates.plane());
        let direction = match kind {
            MotionKind::Linear => start.xyz().zip(end.xyz()).map(|(start, end)| end - start),
            MotionKind::Arc(Some(arc)) => {
                let arm = arc.end - arc.centre;
                Some(arc.normal.cross(&arm) * arc.sweep.signum())
            }
            _ => None,
        };
        let direction = direction.filter(|way| way[axes[2]].abs() <= NO_LENGTH && way.norm() > NO_LENGTH);
        self.memory.own.contour.heading = direction.map(|direction| (*end, direction.normalize()));
    }
}
