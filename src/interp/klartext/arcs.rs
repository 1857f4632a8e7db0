//! CC, and the arcs and polar ends of path blocks.
use super::Klartext;
use super::path::Path;
use super::path_words::PathWords;
use super::values::Value;
use super::words::Words;
use crate::arc::{ONE_PLACE_MM, mismatch, plane_axes};
use crate::core::{LINEAR, Report};
use crate::frames::sin_cos_degrees;
use crate::{FaultKind, MotionKind, Position, Refusal};
use trunnion_dialect::Plane;
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::{Arc, RadiusFault, Turning};
use trunnion_geometry::math::{atan2, rotate};
use trunnion_syntax::TextRange;

/// Vectors that are shorter have no direction.
const SAME: f64 = 1e-12;

impl Klartext<'_> {
    /// CC.
    pub(crate) fn pole(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        let found = self.path_words(words, report);
        let here = self.memory.frames.programmed(&self.core.state.position);
        if found.polar_radius.is_some() || found.polar_angle.is_some() || found.given & !LINEAR != 0 {
            Self::not_modelled("CC in other words than X, Y and Z", report);
            (self.memory.pole, self.memory.pole_plane) = ([None; 3], None);
        } else if found.given == 0 {
            self.memory.pole = [here.get(0), here.get(1), here.get(2)];
            self.memory.pole_plane = None;
        } else {
            match found.given {
                0b011 => self.memory.pole_plane = Some(Plane::Xy),
                0b101 => self.memory.pole_plane = Some(Plane::Zx),
                0b110 => self.memory.pole_plane = Some(Plane::Yz),
                0b111 => Self::rejected(Refusal::Syntax, "CC takes two coordinates, not three", report),
                _ => {}
            }
            let mut place = here;
            for axis in 0..3 {
                match self.memory.pole[axis] {
                    // incremental ones count from the tool
                    Some(value) if found.incremental & (1 << axis) == 0 => place.set(axis, value),
                    _ => {}
                }
            }
            self.place(&found, &mut place);
            for axis in 0..3 {
                if found.given & (1 << axis) != 0 {
                    self.memory.pole[axis] = place.get(axis);
                }
            }
        }
        self.memory.polar_radius = None;
        self.memory.has_pole = true;
    }

    /// CC is missing, or its coordinates are not known.
    fn without_pole(&mut self, report: &mut Report<'_>) {
        if self.memory.has_pole {
            let what = "the pole: coordinates of CC that are not known, or a new coordinate system after it";
            self.not_modelled_once(what, report);
        } else {
            let message = "the arc or polar block has no centre: write CC before it";
            Self::rejected(Refusal::ArcCentre, message, report);
        }
    }

    /// The axes of the plane of arcs and polar coordinates: that of the two coordinates of CC, else that of the tool axis.
    ///
    /// The angle counts from X in XY, from Y in YZ, from Z in ZX. Sources: TNC 310 and TNC 426 pilots p. 8, angle reference axis; TNC 407
    /// user's manual p. 5-19, mathematical direction of rotation.
    fn polar_axes(&self) -> [usize; 3] {
        self.memory.pole_plane.map_or_else(|| self.axes(), plane_axes)
    }

    fn polar_normal(&self) -> Vec3 {
        let mut normal = Vec3::zeros();
        normal[self.polar_axes()[2]] = 1.0;
        normal
    }

    pub(crate) fn turning(words: &PathWords, report: &mut Report<'_>) -> Option<Turning> {
        match words.clockwise {
            Some(true) => Some(Turning::Clockwise),
            Some(false) => Some(Turning::CounterClockwise),
            None => {
                Self::rejected(Refusal::MissingWord, "an arc needs its direction: DR+ or DR-", report);
                None
            }
        }
    }

    pub(crate) fn centre(&mut self, from: Vec3, report: &mut Report<'_>) -> Option<Vec3> {
        let [a, b, _] = self.polar_axes();
        let mut centre = from;
        if let (Some(x), Some(y)) = (self.memory.pole[a], self.memory.pole[b]) {
            (centre[a], centre[b]) = (x, y);
            Some(centre)
        } else {
            self.without_pole(report);
            None
        }
    }

    pub(crate) fn about_pole(
        &mut self,
        from: &Position,
        end: &Position,
        words: &PathWords,
        report: &mut Report<'_>,
    ) -> MotionKind {
        self.memory.was_rapid = false;
        let arc = (|| {
            let turning = Self::turning(words, report)?;
            let (start, end) = (from.xyz()?, end.xyz()?);
            let centre = self.centre(start, report)?;
            self.checked(
                Arc::from_centre(start, end, centre, self.polar_normal(), turning, 0),
                report,
            )
        })();
        MotionKind::Arc(arc)
    }

    fn checked(&self, arc: Option<Arc>, report: &mut Report<'_>) -> Option<Arc> {
        let Some(arc) = arc else {
            let message = "the arc starts or ends at its centre CC: it has no radius";
            Self::rejected(Refusal::ArcRadius, message, report);
            return None;
        };
        let arc = arc.closed_within(ONE_PLACE_MM);
        if let Some(kind) = mismatch(&arc, self.core.dialect, self.core.state.coordinates.unit_mm()) {
            report.fault(TextRange::default(), kind);
        }
        Some(arc)
    }

    pub(crate) fn by_radius(
        &mut self,
        from: &Position,
        end: &Position,
        words: &PathWords,
        report: &mut Report<'_>,
    ) -> MotionKind {
        self.memory.was_rapid = false;
        let Some(radius) = words.radius else {
            Self::rejected(Refusal::MissingWord, "CR needs its radius R", report);
            return MotionKind::Arc(None);
        };
        let unit = self.core.state.coordinates.unit_mm();
        let arc = (|| {
            let turning = Self::turning(words, report)?;
            let (start, end, radius) = (from.xyz()?, end.xyz()?, radius? * unit);
            let tolerance = self.core.dialect.arc_limit_mm(radius.abs(), unit != 1.0);
            match Arc::from_radius(start, end, radius, self.plane_normal(), turning, tolerance) {
                Ok(arc) => Some(arc),
                Err(RadiusFault::TooSmall(half_chord)) => {
                    let radius = radius.abs();
                    report.fault(
                        TextRange::default(),
                        FaultKind::ArcRadiusTooSmall { radius, half_chord },
                    );
                    None
                }
                Err(RadiusFault::SamePoint) => {
                    Self::rejected(
                        Refusal::ArcRadius,
                        "CR ends where it starts: its centre is not known",
                        report,
                    );
                    None
                }
            }
        })();
        MotionKind::Arc(arc)
    }

    /// The arc that begins in the direction of the motion before.
    pub(crate) fn tangent(
        &mut self,
        from: &Position,
        end: &Position,
        polar: bool,
        report: &mut Report<'_>,
    ) -> MotionKind {
        self.memory.was_rapid = false;
        let normal = if polar {
            self.polar_normal()
        } else {
            self.plane_normal()
        };
        let flat = |vector: Vec3| vector - normal * normal.dot(&vector);
        let arc = (|| {
            let heading = flat(self.memory.heading?).try_normalize(1e-9)?;
            let (start, end) = (from.xyz()?, end.xyz()?);
            let chord = flat(end - start);
            let left = normal.cross(&heading);
            let across = chord.dot(&left);
            if across.abs() <= 1e-9 {
                return None;
            }
            let radius = chord.norm_squared() / (2.0 * across);
            let turning = if radius > 0.0 {
                Turning::CounterClockwise
            } else {
                Turning::Clockwise
            };
            Arc::from_centre(start, end, start + left * radius, normal, turning, 0)
        })();
        if arc.is_none() && from.xyz().is_some() && end.xyz().is_some() {
            Self::not_modelled(
                "a tangential arc: the direction before it, or an end straight ahead",
                report,
            );
        }
        MotionKind::Arc(arc)
    }

    /// Puts the end of a polar block into `end`; the turn in degrees where PA is incremental.
    pub(crate) fn polar_end(
        &mut self,
        path: Path,
        words: &PathWords,
        from: &Position,
        end: &mut Position,
        report: &mut Report<'_>,
    ) -> Option<f64> {
        let [a, b, _] = self.polar_axes();
        let unit = self.core.state.coordinates.unit_mm();
        let pole = self.memory.pole[a].zip(self.memory.pole[b]);
        let here = pole.and_then(|(x, y)| {
            let (dx, dy) = (from.get(a)? - x, from.get(b)? - y);
            Some((trunnion_geometry::math::hypot(dx, dy), atan2(dy, dx).to_degrees()))
        });
        let radius: Value = match words.polar_radius {
            Some(value) if words.polar_radius_adds => value.zip(here).map(|(value, here)| here.0 + value * unit),
            Some(value) => value.map(|value| value * unit),
            None if path == Path::PolarArc => here.map(|here| here.0),
            None => self.memory.polar_radius,
        };
        let angle: Value = match words.polar_angle {
            Some((value, true)) => value.zip(here).map(|(value, here)| here.1 + value),
            Some((value, false)) => value,
            None => here.map(|here| here.1),
        };
        self.memory.polar_radius = radius;
        if let (Some((x, y)), Some(radius), Some(angle)) = (pole, radius, angle) {
            let (sin, cos) = sin_cos_degrees(angle);
            end.set(a, x + radius * cos);
            end.set(b, y + radius * sin);
        } else {
            if pole.is_none() {
                self.without_pole(report);
            } else if words.polar_radius.is_none() && radius.is_none() && here.is_some() {
                Self::not_modelled("a polar block without PR after a new pole", report);
            }
            end.forget(a);
            end.forget(b);
        }
        match words.polar_angle {
            Some((value, true)) => value,
            _ => None,
        }
    }

    /// CP: with an incremental angle, which may be more than a turn; the sign must be that of DR.
    pub(crate) fn polar_arc(
        &mut self,
        from: &Position,
        end: &Position,
        turned: Option<f64>,
        words: &PathWords,
        report: &mut Report<'_>,
    ) -> MotionKind {
        self.memory.was_rapid = false;
        let arc = (|| {
            let turning = Self::turning(words, report)?;
            let (start, end) = (from.xyz()?, end.xyz()?);
            let centre = self.centre(start, report)?;
            let arc = self.checked(
                Arc::from_centre(start, end, centre, self.polar_normal(), turning, 0),
                report,
            )?;
            let Some(turned) = turned else { return Some(arc) };
            if turned == 0.0 || (turned < 0.0) != (turning == Turning::Clockwise) {
                Self::rejected(Refusal::Other, "the sign of IPA is not that of DR", report);
                return None;
            }
            Some(Arc {
                sweep: turned.to_radians(),
                ..arc
            })
        })();
        MotionKind::Arc(arc)
    }

    pub(crate) fn note_heading(&mut self, kind: &MotionKind, from: &Position, end: &Position) {
        self.memory.heading = match kind {
            MotionKind::Arc(Some(arc)) => {
                let radius = arc.end - arc.centre;
                let flat = radius - arc.normal * arc.normal.dot(&radius);
                rotate(&arc.normal, arc.sweep.signum() * core::f64::consts::FRAC_PI_2, &flat).try_normalize(SAME)
            }
            MotionKind::Rapid | MotionKind::Linear => {
                let way = from.xyz().zip(end.xyz()).map(|(from, end)| end - from);
                // a block that moves nothing leaves the direction
                match way {
                    Some(way) if way.norm() <= 1e-9 => self.memory.heading,
                    way => way.and_then(|way| way.try_normalize(SAME)),
                }
            }
            _ => None,
        };
    }
}
