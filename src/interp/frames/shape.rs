//! Turned, scaled and mirrored coordinates. The words are in the innermost: G68 inside G51 inside G51.1, in which order Fanuc wants them
//! to be programmed, so the rotation's centre is scaled and mirrored with the rest, and mirroring turns its angle about.
use super::{Linear, XYZ};
use crate::Position;
use crate::arc::plane_axes;
use trunnion_dialect::Plane;
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::sin_cos;

/// Sine and cosine of an angle in degrees; quarter turns are exact.
pub(crate) fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let angle = degrees.rem_euclid(360.0);
    let quarters = [
        (0.0, (0.0, 1.0)),
        (90.0, (1.0, 0.0)),
        (180.0, (0.0, -1.0)),
        (270.0, (-1.0, 0.0)),
    ];
    let exact = quarters.iter().find(|(quarter, _)| *quarter == angle);
    exact.map_or_else(|| sin_cos(angle.to_radians()), |(_, turn)| *turn)
}

/// G68.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rotation {
    pub(crate) plane: Plane,
    /// Centre: coordinates of the plane's first and second axis, mm.
    pub(crate) centre: [f64; 2],
    /// Sine and cosine of the angle.
    pub(crate) turn: (f64, f64),
}

impl Rotation {
    /// By an angle in degrees, counter-clockwise; quarter turns are exact.
    pub(crate) fn new(plane: Plane, centre: [f64; 2], degrees: f64) -> Self {
        let turn = sin_cos_degrees(degrees);
        Self { plane, centre, turn }
    }
    fn apply(&self, point: &mut Position, sign: f64) {
        let [a, b, _] = plane_axes(self.plane);
        let mask = (1 << a) | (1 << b);
        if point.known & mask != mask {
            point.known &= !mask;
            return;
        }
        let (sin, cos) = (self.turn.0 * sign, self.turn.1);
        let (x, y) = (point.values[a] - self.centre[0], point.values[b] - self.centre[1]);
        point.values[a] = self.centre[0] + cos * x - sin * y;
        point.values[b] = self.centre[1] + sin * x + cos * y;
    }
}

/// G51.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scaling {
    /// mm.
    pub(crate) centre: [f64; 3],
    /// By axis, none is zero.
    pub(crate) factors: [f64; 3],
}

impl Scaling {
    /// The common size of all factors, where they have one.
    pub(crate) fn uniform(&self) -> Option<f64> {
        let [x, y, z] = self.factors.map(f64::abs);
        (x == y && y == z).then_some(x)
    }
    /// The common size of the two factors across an axis.
    fn across(&self, normal: usize) -> Option<f64> {
        let [a, b] = [(normal + 1) % 3, (normal + 2) % 3].map(|axis| self.factors[axis].abs());
        (a == b).then_some(a)
    }
}

/// All of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Shape {
    pub(crate) rotation: Option<Rotation>,
    pub(crate) scaling: Option<Scaling>,
    /// Coordinates about which axes are mirrored, mm.
    pub(crate) mirror: [Option<f64>; 3],
    /// Programmable frames of a Sinumerik, which has none of the others.
    pub(crate) linear: Option<Linear>,
}

impl Shape {
    pub(crate) fn is_identity(&self) -> bool {
        *self == Self::default()
    }
    /// From the coordinates of words to work coordinates.
    pub(crate) fn to_work(self, words: &Position) -> Position {
        let mut point = *words;
        if let Some(rotation) = &self.rotation {
            rotation.apply(&mut point, 1.0);
        }
        if let Some(scaling) = &self.scaling {
            for axis in 0..3 {
                let centre = scaling.centre[axis];
                point.values[axis] = centre + (point.values[axis] - centre) * scaling.factors[axis];
            }
        }
        self.mirror(&mut point);
        match &self.linear {
            Some(linear) => linear.to_work(&point),
            None => point,
        }
    }
    /// The way back.
    pub(crate) fn to_words(self, work: &Position) -> Position {
        let mut point = match &self.linear {
            Some(linear) => linear.to_words(work),
            None => *work,
        };
        self.mirror(&mut point);
        if let Some(scaling) = &self.scaling {
            for axis in 0..3 {
                let centre = scaling.centre[axis];
                point.values[axis] = centre + (point.values[axis] - centre) / scaling.factors[axis];
            }
        }
        if let Some(rotation) = &self.rotation {
            rotation.apply(&mut point, -1.0);
        }
        point
    }
    fn mirror(&self, point: &mut Position) {
        for (value, mirror) in point.values.iter_mut().zip(self.mirror) {
            if let Some(line) = mirror {
                *value = 2.0 * line - *value;
            }
        }
    }
    /// An arc of the words in work coordinates; none if different factors distort it, or a rotation turns it out of its plane.
    pub(crate) fn arc_to_work(&self, arc: &Arc) -> Option<Arc> {
        let place = |point: Vec3| {
            let mut position = Position {
                known: XYZ,
                ..Position::default()
            };
            position.values[..3].copy_from_slice(point.as_slice());
            let work = self.to_work(&position);
            Vec3::new(work.values[0], work.values[1], work.values[2])
        };
        let along = |axis: usize| arc.normal[axis].abs() > 0.5;
        let mut sign = 1.0;
        for axis in 0..3 {
            let turned = self.mirror[axis].is_some() != self.scaling.is_some_and(|scaling| scaling.factors[axis] < 0.0);
            if turned && !along(axis) {
                sign = -sign;
            }
        }
        let normal = (0..3).find(|axis| along(*axis))?;
        if self
            .rotation
            .is_some_and(|rotation| plane_axes(rotation.plane)[2] != normal)
        {
            return None;
        }
        let size = self.scaling.map_or(Some(1.0), |scaling| scaling.across(normal))?;
        let size = size * self.linear.map_or(Some(1.0), |linear| linear.size(normal))?;
        if self.linear.is_some_and(|linear| linear.flips(normal)) {
            sign = -sign;
        }
        Some(Arc {
            start: place(arc.start),
            end: place(arc.end),
            centre: place(arc.centre),
            normal: arc.normal,
            sweep: sign * arc.sweep,
            radius_start: size * arc.radius_start,
            radius_end: size * arc.radius_end,
        })
    }
    /// Whether left and right of a path change places in a plane.
    pub(crate) fn flips(&self, plane: Plane) -> bool {
        let [a, b, normal] = plane_axes(plane);
        let turned_over = self.linear.is_some_and(|linear| linear.flips(normal));
        [a, b].iter().fold(turned_over, |flips, &axis| {
            let scaled = self.scaling.is_some_and(|scaling| scaling.factors[axis] < 0.0);
            flips ^ self.mirror[axis].is_some() ^ scaled
        })
    }
}
