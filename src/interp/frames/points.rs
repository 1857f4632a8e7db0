//! Tilted planes by three points (G68.2 P2) and by two vectors (G68.2 P3), which several blocks give one after another.
//!
//! The axes: three implementations and HEIDENHAIN's PLANE POINTS and PLANE VECTOR agree. P2: x from the first to the second point, z across
//! the plane of the points, y = z x x. P3: the first vector is x, the second z, within 5 degrees of a right angle. R turns about the new Z.
//! Where the zero lies with a shift in Q0 is not agreed: P2 is followed without Q0, from its first point.
use super::Tilted;
use super::tilt::turn_about;
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{FaultKind, ImplicitDecimals};
use trunnion_geometry::{Mat3, Vec3};

/// Sine of the 5 degrees by which two vectors may miss the right angle.
const SQUARE: f64 = 0.087_155_742_747_658_17;

/// What the blocks have given so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pending {
    by_vectors: bool,
    /// Points in mm, or vectors of any length.
    given: [Option<Vec3>; 3],
    origin: Vec3,
    /// R, degrees.
    turn: f64,
}

impl Pending {
    /// Whether all points or vectors are there.
    fn is_complete(&self) -> bool {
        let needed = if self.by_vectors { 2 } else { 3 };
        self.given.iter().take(needed).all(Option::is_some)
    }

    /// `None`: something is missing, or they make no plane.
    fn plane(&self) -> Option<Tilted> {
        let (x, z) = if self.by_vectors {
            (self.given[0]?, self.given[1]?)
        } else {
            let [first, second, third] = [self.given[0]?, self.given[1]?, self.given[2]?];
            let x = second - first;
            (x, x.cross(&(third - first)))
        };
        let turn = axes(x, z)? * turn_about(2, self.turn);
        Some(Tilted {
            origin: self.origin,
            turn,
            programmed: false,
        })
    }
}

#[cfg(test)]
impl Pending {
    /// The axes of the plane through three points.
    pub(super) fn points(points: [Vec3; 3]) -> Mat3 {
        let pending = Self {
            given: points.map(Some),
            ..Self::default()
        };
        pending.plane().expect("a plane").turn
    }
    /// The axes of the plane of two vectors.
    pub(super) fn vectors(x: Vec3, z: Vec3) -> Mat3 {
        let pending = Self {
            by_vectors: true,
            given: [Some(x), Some(z), None],
            ..Self::default()
        };
        pending.plane().expect("a plane").turn
    }
}

/// Columns from an x that is turned square to z.
fn axes(x: Vec3, z: Vec3) -> Option<Mat3> {
    let unit = |vector: Vec3| {
        let length = vector.norm();
        (length > 1e-9).then(|| vector / length)
    };
    let (x, z) = (unit(x)?, unit(z)?);
    if x.dot(&z).abs() > SQUARE {
        return None;
    }
    let x = unit(x - z * x.dot(&z))?;
    Some(Mat3::from_columns(&[x, z.cross(&x), z]))
}

impl<'d> Iso<'d> {
    /// One block of G68.2 P2 or P3.
    pub(super) fn plane_part(
        &mut self,
        (by_vectors, found): (bool, &Found<'d>),
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let mut pending = self.memory.frames.pending.take().unwrap_or(Pending {
            by_vectors,
            ..Pending::default()
        });
        let clear = words.axes.unread == 0
            && !self.core.state.coordinates.incremental()
            && self.memory.frames.shape.is_identity()
            && self.memory.frames.tilt.is_none()
            && !self.core.unknown.any()
            && pending.by_vectors == by_vectors;
        let added = clear.then(|| self.add_part(&mut pending, words, report)).flatten();
        if added.is_some() && !pending.is_complete() {
            block.takes_coordinates = true;
            self.memory.frames.pending = Some(pending);
        } else if let Some(plane) = added.and_then(|()| pending.plane()) {
            block.takes_coordinates = true;
            self.core.state.zero.lose(false);
            self.tilt_to(Some(plane), report);
        } else {
            self.end_tilt(report);
            self.frame_change(found, words, block, report);
        }
    }

    /// Adds what a block says; `None`: it is not understood.
    fn add_part(&self, pending: &mut Pending, words: &Words, report: &mut Report<'_>) -> Option<()> {
        let place = usize::try_from(words.letter(b'Q').index()?).ok()?;
        let last = if pending.by_vectors { 2 } else { 3 };
        // in any other order, or twice, the sources do not say what is meant
        let next = pending.given.iter().position(Option::is_none)? + 1;
        if place != next || place > last {
            return None;
        }
        match words.radius {
            WordValue::Nothing => {}
            said => pending.turn = said.number()?.value,
        }
        let point = [0, 1, 2].map(|axis| self.axis_value(words, axis));
        let vector = self.axis_vector(words, report);
        pending.given[place - 1] = Some(if pending.by_vectors {
            if place == 1 {
                pending.origin = Vec3::from(point.map(|value| value.unwrap_or(0.0)));
            } else if words.axes.any() {
                return None;
            }
            vector?
        } else {
            if vector.is_some() {
                return None;
            }
            let point = Vec3::new(point[0]?, point[1]?, point[2]?);
            if place == 1 {
                pending.origin = point;
            }
            point
        });
        Some(())
    }

    /// I J K; `None` where there is none of them, or one is not known.
    fn axis_vector(&self, words: &Words, report: &mut Report<'_>) -> Option<Vec3> {
        let implicit = self.core.setup.control.implicit_decimals;
        let said = [b'I', b'J', b'K'].map(|letter| words.letter(letter));
        if said.iter().all(|said| !said.is_given()) {
            return None;
        }
        let mut vector = Vec3::zeros();
        for (axis, said) in said.into_iter().enumerate() {
            let number = match said {
                WordValue::Nothing => continue,
                said => said.number()?,
            };
            let whole = !number.has_point && number.value != 0.0;
            if whole && implicit.is_none() {
                report.fault(number.range, FaultKind::AmbiguousDecimal);
            }
            vector[axis] = match implicit {
                Some(ImplicitDecimals::LeastIncrement) if whole => number.value / 1000.0,
                _ => number.value,
            };
        }
        Some(vector)
    }

    /// A block that is not part of the plane, before all its points or vectors are there.
    pub(crate) fn plane_broken_off(&mut self, report: &mut Report<'_>) {
        if self.memory.frames.pending.take().is_none() {
            return;
        }
        let what = "G68.2: not all points or vectors of the plane are given".to_owned();
        report.fault(report.whole(), FaultKind::NotModelled { what });
        if let Some(code) = self.core.dialect.g(682) {
            self.core.unknown.begin(code, false);
        }
        self.core.forget_position();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_vectors_make_the_plane_of_the_same_euler_angles() {
        // Rx(30): x stays, z is turned towards -y
        let (sin, cos) = trunnion_geometry::math::sin_cos(30f64.to_radians());
        let points = Pending {
            given: [Vec3::zeros(), Vec3::x() * 10.0, Vec3::new(3.0, cos, sin)].map(Some),
            ..Pending::default()
        };
        let vectors = Pending {
            by_vectors: true,
            given: [Some(Vec3::x()), Some(Vec3::new(0.0, -sin, cos) * 7.0), None],
            ..Pending::default()
        };
        for plane in [points, vectors] {
            let plane = plane.plane().expect("a plane");
            assert!((plane.turn - turn_about(0, 30.0)).norm() < 1e-12, "{plane:?}");
        }
    }

    #[test]
    fn points_on_a_line_and_vectors_that_are_not_square_make_none() {
        let line = Pending {
            given: [Vec3::zeros(), Vec3::x(), Vec3::x() * 2.0].map(Some),
            ..Pending::default()
        };
        assert!(line.is_complete() && line.plane().is_none());
        let skew = |z: Vec3| Pending {
            by_vectors: true,
            given: [Some(Vec3::x()), Some(z), None],
            ..Pending::default()
        };
        assert_eq!(skew(Vec3::new(0.1, 0.0, 1.0)).plane(), None);
        // 4 degrees: x is turned
        let plane = skew(Vec3::new(0.07, 0.0, 1.0)).plane().expect("a plane");
        assert!((plane.turn.column(2) - Vec3::new(0.07, 0.0, 1.0).normalize()).norm() < 1e-12);
        assert!(!Pending::default().is_complete());
    }
}
