//! Tilted working planes: PLANE and cycle 19.
//!
//! SPATIAL: Rz(SPC) Ry(SPB) Rx(SPA), about fixed axes A, B, C. EULER: Rz(EULPR) Rx(EULNU) Rz(EULROT). VECTOR: x from the base vector, z along
//! the normal. POINTS: x from the first point to the second, the third on the side of y; the datum stays. Sources: TNC guide, PLANE SPATIAL;
//! TNC 640 DIN/ISO 34059x p. 420 and 424. RELATIV: one angle, about an axis of the plane that is active (iTNC 530 340 422 user's manual, p. 456:
//! it acts incrementally; TNC7 81762x-17: it is a transformation in the system of the working plane). Where the swivel leaves a rotary axis free,
//! COORD ROT (the default) keeps it and turns the coordinates. PROJECTED is not followed; AXIAL is in `axial`, shifts inside a plane are in `plane_shift`.
use super::Klartext;
use super::positioning::Positioning;
use super::reason::Reason;
use super::values::Value;
use super::words::Words;
use crate::core::{LINEAR, ROTARY, Report};
use crate::frames::Tilted;
use crate::{Feed, MotionKind, Orientation, Posture, Refusal, Swivel};
use trunnion_geometry::{Mat3, Vec3};

impl Klartext<'_> {
    pub(crate) fn plane(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        self.flush(report);
        let Some(form) = words.next() else {
            return Self::rejected(
                Refusal::MissingWord,
                "PLANE needs its form: SPATIAL, VECTOR, RESET, ...",
                report,
            );
        };
        let name = String::from_utf8_lossy(form.name()).into_owned();
        let (numbers, positioning) = self.plane_words(&name, words, report);
        self.set_angles([None; 3]);
        match name.as_str() {
            "RESET" => return self.reset_plane(positioning, report),
            "AXIAL" => return self.plane_by_axes(&numbers, positioning, report),
            _ => {}
        }
        let number = |wanted: &str| numbers.iter().find(|(found, _)| found == wanted).map(|found| found.1);
        let turn = match name.as_str() {
            // an angle that is left out is 0 for RELATIV only
            "SPATIAL" => spatial([number("SPA"), number("SPB"), number("SPC")].map(Option::flatten)),
            "EULER" => euler([number("EULPR"), number("EULNU"), number("EULROT")].map(Option::flatten)),
            "VECTOR" => {
                let of = |letters: [&str; 3]| letters.map(|letter| number(letter).flatten());
                vectors(of(["BX", "BY", "BZ"]), of(["NX", "NY", "NZ"]))
            }
            "POINTS" => {
                // P1X and the like are read as P, then 1, then X
                self.points(words.text, report)
            }
            "RELATIV" | "RELATIVE" => self.relative([number("SPA"), number("SPB"), number("SPC")]),
            _ => None,
        };
        let Some(turn) = turn else {
            Self::not_modelled(format!("PLANE {name}: its values, or the form itself"), report);
            self.memory.angles_wait = None;
            self.unknown_plane(report);
            return self.unknown_turn(positioning, report);
        };
        self.set_plane(turn, Some(positioning), report);
        if positioning.turns_table && positioning.swivel.is_some() && turn[(2, 2)] == 1.0 {
            self.turn_table(report);
        }
    }

    /// The plane of one angle about an axis of the active one. The order of several is not stated, and nothing is relative to an unknown plane.
    fn relative(&self, said: [Option<Value>; 3]) -> Option<Mat3> {
        let active = self.memory.frames.tilt.map_or_else(Mat3::identity, |tilt| tilt.turn);
        let mut given = said
            .iter()
            .enumerate()
            .filter_map(|(axis, said)| Some((axis, (*said)?)));
        let (axis, angle) = given.next()?;
        let alone = given.next().is_none() && !self.memory.lost.has(Reason::Plane);
        let turn = Tilted::new(Vec3::zeros(), &[(axis, angle.filter(|_| alone)?)]).turn;
        Some(active * turn)
    }

    /// TABLE ROT makes a difference where the swivel leaves an axis free: parallel to the tool, as a vertical tool does on most machines.
    fn turn_table(&mut self, report: &mut Report<'_>) {
        let what = "TABLE ROT where the plane leaves a rotary axis free: to which angle it turns";
        self.not_modelled_once(what, report);
        self.core.state.position.known &= !ROTARY;
        self.unknown_motion(report);
    }

    pub(super) fn unknown_plane(&mut self, report: &mut Report<'_>) {
        self.tilt_to(None, report);
        self.lose(Reason::Plane);
    }

    /// MOVE and TURN onto a plane that is not known turn the rotary axes to positions that are not known.
    pub(super) fn unknown_turn(&mut self, positioning: Positioning, report: &mut Report<'_>) {
        if positioning.swivel.is_some() {
            self.core.state.position.known &= !ROTARY;
            self.unknown_motion(report);
        }
    }

    fn reset_plane(&mut self, positioning: Positioning, report: &mut Report<'_>) {
        self.found(Reason::Plane);
        self.tilt_to(None, report);
        self.nothing_is_shifted();
        self.memory.angles_wait = None;
        if let Some(swivel) = positioning.swivel {
            self.turn_back(swivel, positioning.feed, report);
        }
    }

    /// PLANE RESET with MOVE or TURN: the rotary axes go to their basic setting, 0, whatever angle a plane left them at. X Y Z are in the
    /// machine's directions after it. With MOVE the tip stays on the part, with TURN the linear axes stay.
    fn turn_back(&mut self, swivel: Swivel, feed: Feed, report: &mut Report<'_>) {
        let zero = self.core.state.zero.values();
        if self.core.state.zero.is_lost() || zero[3..6].iter().any(|shift| *shift != 0.0) {
            let what = "PLANE RESET where the zero of a rotary axis is shifted: to which of both zeros it turns";
            self.not_modelled_once(what, report);
            self.core.forget_linear();
            self.core.state.position.known &= !ROTARY;
            return self.unknown_motion(report);
        }
        self.turn_axes((swivel, feed), [Some(0.0); 3], report);
    }

    /// Turns A, B and C to positions.
    pub(super) fn turn_axes(
        &mut self,
        (swivel, feed): (Swivel, Feed),
        stands: [Option<f64>; 3],
        report: &mut Report<'_>,
    ) {
        self.core.forget_linear();
        let start = self.core.state.position;
        let mut end = start;
        for (axis, stand) in (3..6).zip(stands) {
            if let Some(stand) = stand {
                end.set(axis, stand);
            }
        }
        self.core.state.position = end;
        self.core.state.orientation = Orientation::Words;
        let mut motion = self
            .core
            .new_motion(MotionKind::Rapid, start, end, Orientation::Words, feed, report);
        motion.tilt.swivel = swivel;
        motion.tcp = swivel == Swivel::TipStays;
        self.finish_motion(&super::Made { motion, tilt: None });
    }

    /// `positioning`: `None` where the block turns the axes otherwise.
    pub(super) fn set_plane(&mut self, turn: Mat3, positioning: Option<Positioning>, report: &mut Report<'_>) {
        self.found(Reason::Plane);
        if !self.memory.frames.shape.is_identity() {
            Self::not_modelled("a tilted plane in a turned, mirrored or scaled system", report);
            self.lose(Reason::Plane);
            if let Some(positioning) = positioning {
                self.unknown_turn(positioning, report);
            }
            return;
        }
        // zero angles are a plane too: they do not reset, and the plane follows the part on an axis that stays turned
        self.tilt_to(Some(Tilted::turned(turn)), report);
        let posture = positioning.map_or(Posture::ByRule, |positioning| positioning.posture);
        self.memory.angles_wait = Some(posture);
        if let Some(Positioning {
            swivel: Some(swivel),
            feed,
            ..
        }) = positioning
        {
            self.swivel((swivel, feed), posture, report);
            self.memory.angles_wait = None;
        }
    }

    /// Whether the plane is turned against the part: one of zero angles is not.
    pub(crate) fn is_tilted(&self) -> bool {
        self.memory
            .frames
            .tilt
            .is_some_and(|tilt| tilt.turn != Mat3::identity())
    }

    /// Positions are in the coordinates of another plane from here on; the machine stays where it is.
    fn tilt_to(&mut self, tilt: Option<Tilted>, report: &mut Report<'_>) {
        self.leave_plane(tilt.is_some_and(|tilt| tilt.turn != Mat3::identity()), report);
        if self.memory.frames.tilt == tilt {
            return;
        }
        let mut position = self.core.state.position;
        if let Some(old) = self.memory.frames.tilt {
            position = old.to_work(&position);
        }
        if let Some(new) = tilt {
            position = new.to_plane(&position);
        }
        self.memory.frames.tilt = tilt;
        if !self.core.state.tool_axis.tcp() {
            position.known &= !LINEAR;
        }
        self.core.state.position = position;
        self.core.state.orientation = Orientation::Words;
        self.memory.frames.refresh(&position);
        (self.memory.pole, self.memory.heading) = ([None; 3], None);
    }

    /// Turns the rotary axes onto the plane's normal.
    pub(crate) fn swivel(&mut self, (swivel, feed): (Swivel, Feed), posture: Posture, report: &mut Report<'_>) {
        let start = self.core.state.position;
        self.core.forget_linear();
        self.core.state.position.known &= !ROTARY;
        let mut end = self.core.state.position;
        end.known &= !LINEAR;
        let orientation = Orientation::Vector(None, Vec3::z());
        let mut motion = self
            .core
            .new_motion(MotionKind::Rapid, start, end, orientation, feed, report);
        (motion.tilt.swivel, motion.tilt.posture, motion.tcp) = (swivel, posture, false);
        let tilt = self
            .memory
            .frames
            .tilt
            .or_else(|| Some(Tilted::new(Vec3::zeros(), &[])));
        self.finish_motion(&super::Made { motion, tilt });
    }

    /// P1X P1Y P1Z P2X ... P3Z.
    fn points(&mut self, text: &[u8], report: &mut Report<'_>) -> Option<Mat3> {
        let mut values = [[None; 3]; 3];
        let upper = text.to_ascii_uppercase();
        for point in 0..3u8 {
            for axis in 0..3u8 {
                let name = [b'P', b'1' + point, b'X' + axis];
                let at = upper.windows(3).position(|found| found == name)?;
                let mut words = Words::new(text);
                words.at = at + 3;
                words.blanks();
                let said = words.value();
                values[usize::from(point)][usize::from(axis)] = Some(self.said(said, report)?);
            }
        }
        let [first, second, third] = values.map(|point| Vec3::from(point.map(Option::unwrap_or_default)));
        let x = (second - first).try_normalize(1e-9)?;
        let z = x.cross(&(third - first)).try_normalize(1e-9)?;
        Some(Mat3::from_columns(&[x, z.cross(&x), z]))
    }

    /// Cycle 19: whether its angles are those of space or of the axes is a machine parameter; all zero is no plane either way.
    pub(crate) fn working_plane(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line != 1 {
            return;
        }
        self.set_angles([None; 3]);
        let found = self.path_words(words, report);
        let zero = (3..6).all(|axis| found.given & (1 << axis) == 0 || found.values[axis] == Some(0.0));
        self.found(Reason::Plane);
        self.tilt_to(None, report);
        if !zero {
            Self::not_modelled("cycle 19: a machine parameter decides what its angles are", report);
            self.lose(Reason::Plane);
        }
    }
}

fn all<const N: usize>(values: [Option<f64>; N]) -> Option<[f64; N]> {
    values
        .iter()
        .all(Option::is_some)
        .then(|| values.map(Option::unwrap_or_default))
}

/// About the fixed axes X, Y, Z in that order.
pub(crate) fn spatial(angles: [Option<f64>; 3]) -> Option<Mat3> {
    let [a, b, c] = all(angles)?;
    Some(Tilted::new(Vec3::zeros(), &[(2, c), (1, b), (0, a)]).turn)
}

/// Precession about Z, nutation about the turned X, rotation about the tilted Z.
pub(crate) fn euler(angles: [Option<f64>; 3]) -> Option<Mat3> {
    let [precession, nutation, rotation] = all(angles)?;
    Some(Tilted::new(Vec3::zeros(), &[(2, precession), (0, nutation), (2, rotation)]).turn)
}

/// Z along the normal, X along the part of the base vector that is square to it.
pub(crate) fn vectors(base: [Option<f64>; 3], normal: [Option<f64>; 3]) -> Option<Mat3> {
    let (base, normal) = (Vec3::from(all(base)?), Vec3::from(all(normal)?));
    let z = normal.try_normalize(1e-9)?;
    let x = (base - z * z.dot(&base)).try_normalize(1e-9)?;
    Some(Mat3::from_columns(&[x, z.cross(&x), z]))
}

#[cfg(test)]
mod tests {
    use super::{euler, spatial, vectors};
    use crate::frames::sin_cos_degrees;
    use proptest::prelude::*;
    use trunnion_geometry::Vec3;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10_000))]
        /// One plane in three forms: spatial angles, the vectors of its matrix, and the Euler angles of the same matrix.
        #[test]
        fn forms_of_a_plane_agree(a in -180.0..180.0f64, b in -89.0..89.0f64, c in -180.0..180.0f64) {
            let turn = spatial([Some(a), Some(b), Some(c)]).expect("known");
            let column = |at: usize| [turn[(0, at)], turn[(1, at)], turn[(2, at)]].map(Some);
            let by_vectors = vectors(column(0), column(2)).expect("known");
            prop_assert!((turn - by_vectors).norm() < 1e-12);
            let z: Vec3 = turn.column(2).into();
            let sine = trunnion_geometry::math::hypot(z.x, z.y);
            if sine > 1e-6 {
                let nutation = trunnion_geometry::math::atan2(sine, z.z).to_degrees();
                let precession = trunnion_geometry::math::atan2(z.x, -z.y).to_degrees();
                let rotation = trunnion_geometry::math::atan2(turn[(2, 0)], turn[(2, 1)]).to_degrees();
                let by_euler = euler([Some(precession), Some(nutation), Some(rotation)]).expect("known");
                prop_assert!((turn - by_euler).norm() < 1e-9, "{turn} {by_euler}");
            }
            // a point is turned about the fixed X, then Y, then Z
            let ((sa, ca), (sb, cb), (sc, cc)) = (sin_cos_degrees(a), sin_cos_degrees(b), sin_cos_degrees(c));
            let p = Vec3::new(0.3, -0.7, 1.9);
            let q = Vec3::new(p.x, ca * p.y - sa * p.z, sa * p.y + ca * p.z);
            let q = Vec3::new(cb * q.x + sb * q.z, q.y, -sb * q.x + cb * q.z);
            let q = Vec3::new(cc * q.x - sc * q.y, sc * q.x + cc * q.y, q.z);
            prop_assert!((turn * p - q).norm() < 1e-12);
        }
    }
}
