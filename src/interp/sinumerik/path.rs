//! Words that give a path by something other than its end and centre: polar coordinates about a pole (AP, RP), the opening angle of an arc
//! (AR), the angle of a line (ANG), an intermediate point (I1 J1 K1), corners (CHF, CHR, RND, RNDM) and their feed (FRC, FRCM), the angle of a turned frame (RPL), and the
//! tool's orientation by Euler angles (A2, B2, C2 under ORIEULER).
//! Where their values are known they become coordinates and centres; else the block is not followed.
//!
//! Source: Sinumerik 840D sl Programming Manual, Fundamentals: polar coordinates, circular interpolation, contour definitions, chamfer and
//! rounding; Programming Guide Advanced, 04.00, p. 7-225: A2 turns about Z, B2 about the new X, C2 about the new Z, which turns no tool. What a pole or a polar angle means under G91, or after a change of the frame, is not taken from there.
use super::pole::Pole;
use crate::arc::plane_axes;
use crate::codes::BlockCodes;
use crate::core::Report;
use crate::frames::sin_cos_degrees;
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::{Places, Reading, Words, put, put_absolute};
use crate::{FaultKind, Position};
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{hypot, tan};
use trunnion_syntax::{TextRange, Word};

/// Lengths below are no length, mm.
pub(super) const NO_LENGTH: f64 = 1e-9;

/// The words of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PathWords {
    /// The first of them.
    range: Option<TextRange>,
    /// The value of one is not known.
    pub(super) unread: bool,
    /// I1 J1 K1.
    pub(super) through: Places<3>,
    /// AP, RP.
    pub(super) polar: Places<2>,
    /// AR, deg.
    pub(super) opening: Option<f64>,
    /// ANG, deg.
    pub(super) angle: Option<f64>,
    /// A2, B2, C2, deg.
    angles: Places<3>,
    /// RPL, deg.
    frame: Option<f64>,
    /// CHF (F), CHR (C) or RND (R).
    corner: Option<(u8, f64)>,
    /// FRC: the feed of a corner of this block.
    corner_feed: Option<f64>,
    /// FRCM.
    modal_corner_feed: Option<f64>,
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
    /// FRC, if it is there.
    pub(crate) fn corner_feed(&self) -> Option<f64> {
        self.corner_feed
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
    pub(super) pole: Option<Pole>,
    /// RP, mm.
    pub(super) radius: Option<f64>,
    /// AP and the place that it gave, in the plane.
    pub(super) angle: Option<(f64, [f64; 2])>,
    /// RNDM, mm; 0: off.
    pub(crate) rounding: f64,
    /// FRCM in the unit of F; `None`: off, NaN: unknown.
    pub(crate) corner_feed: Option<f64>,
    /// ORIEULER is in effect; false: what A2, B2 and C2 mean is machine data, or not followed.
    pub(crate) euler: bool,
    /// Where the last motion in the plane ended, and its direction there.
    pub(super) heading: Option<(Position, Vec3)>,
}

impl Contour {
    /// The direction in which the last motion ended is not known.
    pub(crate) fn heading_is_lost(&mut self) {
        self.heading = None;
    }
    /// The pole and the last polar coordinates, which a program that is missing could use.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        let pole = self.pole.map(|pole| pole.centre);
        let angle = self.angle.map_or(f64::NAN, |angle| angle.0);
        let polar = pole.map(|_| [self.radius.unwrap_or(f64::NAN), angle]);
        [pole, polar].into_iter().flatten().flatten()
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `A2=`, `B2=`, `C2=`; false: another word.
    pub(crate) fn orientation_angle(&mut self, letter: u8, word: &Word) -> bool {
        let second = self.program.bytes(word.range).get(1).copied();
        if !matches!(letter, b'A'..=b'C') || second != Some(b'2') || self.own.as_ref().is_none_or(|own| own.is_task) {
            return false;
        }
        self.first(word);
        let said = self.said_place(word);
        let Some(own) = self.own.as_mut() else { return false };
        let path = &mut own.path;
        path.range = path.range.or(Some(word.range));
        let place = usize::from(letter - b'A');
        path.unread |= path.angles.given & (1 << place) != 0 || !matches!(said.1, Reading::Modal | Reading::Absolute);
        put(&mut path.angles, place, said);
        path.unread |= path.angles.unread != 0;
        true
    }

    /// One of these words.
    pub(crate) fn path_word(&mut self, word: &Word) {
        self.first(word);
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
                    "FRC" => &mut path.corner_feed,
                    "FRCM" => &mut path.modal_corner_feed,
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

impl Iso<'_> {
    /// The words of a block with coordinates and centres in place of path words, where these are known; a fault else.
    #[cold]
    pub(crate) fn with_path_words(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) -> Words {
        let path = self.memory.own.path;
        let mut out = *words;
        // of a frame or a pole, which has read them
        let of_corner = path.corner.is_some() || path.modal_corner.is_some() || path.modal_corner_feed.is_some();
        if block.takes_coordinates && !path.unread && !of_corner {
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
            if path.modal_corner_feed.is_some() || path.unread {
                contour.corner_feed = Some(f64::NAN);
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
        if let Some(feed) = path.modal_corner_feed {
            (feed >= 0.0).then_some(())?;
            self.memory.own.contour.corner_feed = Some(feed).filter(|feed| *feed != 0.0);
        }
        if path.frame.is_some() {
            return None;
        }
        if path.angles.any() {
            self.vector_of_angles(path, words)?;
        }
        let motion = self.core.state.motion;
        let through = motion == Some(Action::ArcThroughPoint) && words.axes.any();
        let open = path.through.any() && self.program_sets_diameters();
        if path.through.any() && !through || open || block.not_modelled {
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
        if let Some(feed) = path.corner_feed {
            (feed > 0.0).then_some(())?;
        }
        Some(())
    }

    /// The tool vector of A2 and B2 under ORIEULER.
    fn vector_of_angles(&self, path: &PathWords, words: &mut Words) -> Option<()> {
        let known = self.memory.own.contour.euler && path.angles.given & 0b11 == 0b11 && !words.vector.any();
        known.then_some(())?;
        let [(sin_a, cos_a), (sin_b, cos_b)] = [0, 1].map(|at| sin_cos_degrees(path.angles.values[at]));
        for (at, value) in [sin_a * sin_b, -cos_a * sin_b, cos_b].into_iter().enumerate() {
            put_absolute(&mut words.vector, at, value);
        }
        Some(())
    }

    /// The position in the coordinates of the words.
    pub(super) fn here(&mut self) -> Position {
        let position = self.core.state.position;
        self.memory.frames.programmed(&position)
    }

    /// Axis words of the plane in the block.
    pub(super) fn named_in_plane(&self, words: &Words) -> u16 {
        let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
        (words.axes.given | words.axes.unread) & ((1 << a) | (1 << b))
    }

    pub(super) fn is_arc(&self) -> Option<f64> {
        match self.core.state.motion {
            Some(Action::ArcClockwise) => Some(-1.0),
            Some(Action::ArcCounterClockwise) => Some(1.0),
            _ => None,
        }
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
}
