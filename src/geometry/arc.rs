//! Circular and helical arcs in space.
use crate::Vec3;
use crate::math::{asinh, atan2, rotate, sin_cos};
use core::f64::consts::{PI, TAU};

/// A circular, spiral or helical arc from `start` to `end` about `centre`, seen with `normal` pointing to the viewer. The angle, the
/// radius and the height along the normal all change evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Start point, mm.
    pub start: Vec3,
    /// End point, mm.
    pub end: Vec3,
    /// Centre at the height of the start, mm.
    pub centre: Vec3,
    /// Unit normal of the arc's plane.
    pub normal: Vec3,
    /// Signed sweep about `normal`, rad (counter-clockwise positive; more than one turn possible).
    pub sweep: f64,
    /// Distance of the start from the centre in the plane, mm.
    pub radius_start: f64,
    /// Distance of the end from the centre in the plane, mm.
    pub radius_end: f64,
}

/// Which way an arc turns, seen with the normal pointing to the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turning {
    /// G2.
    Clockwise,
    /// G3.
    CounterClockwise,
}

impl Turning {
    /// Sign of the sweep.
    fn sign(self) -> f64 {
        if self == Self::Clockwise { -1.0 } else { 1.0 }
    }
}

/// Why a radius gives no arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RadiusFault {
    /// Start and end coincide in the plane: a radius says nothing about the centre.
    SamePoint,
    /// The ends are farther apart than the diameter; half their distance in the plane, mm.
    TooSmall(f64),
}

impl Arc {
    /// The arc about a centre (its height along `normal` is irrelevant). `extra_turns` full turns are added. Start and end in the same
    /// direction from the centre give a full circle. The two radii may differ: then it is a spiral, and the caller judges it. `None`
    /// when start or end lies on the centre, or when a number is not finite. `normal` must have length 1.
    pub fn from_centre(
        start: Vec3,
        end: Vec3,
        centre: Vec3,
        normal: Vec3,
        turning: Turning,
        extra_turns: u32,
    ) -> Option<Self> {
        let centre = centre + normal * normal.dot(&(start - centre));
        let (from, to) = (in_plane(&(start - centre), &normal), in_plane(&(end - centre), &normal));
        let (radius_start, radius_end) = (from.norm(), to.norm());
        if radius_start.is_nan() || radius_end.is_nan() || radius_start.min(radius_end) <= 0.0 {
            return None;
        }
        let turn = turning.sign() * atan2(normal.dot(&from.cross(&to)), from.dot(&to));
        // equal directions within rounding are a full circle, not an arc of nothing
        let partial = if turn <= 1e-12 { turn + TAU } else { turn };
        let sweep = turning.sign() * (partial + TAU * f64::from(extra_turns));
        let finite = sweep.is_finite() && radius_start.is_finite() && radius_end.is_finite();
        finite.then_some(Self { start, end, centre, normal, sweep, radius_start, radius_end })
    }

    /// The arc of a given radius: of the two possible ones the minor arc (up to 180 deg) for a positive radius, the major arc for a
    /// negative one. A radius too small by at most `tolerance` mm is taken as the half circle.
    pub fn from_radius(
        start: Vec3,
        end: Vec3,
        radius: f64,
        normal: Vec3,
        turning: Turning,
        tolerance: f64,
    ) -> Result<Self, RadiusFault> {
        let chord = in_plane(&(end - start), &normal);
        let half = 0.5 * chord.norm();
        if half.is_nan() || half <= 1e-12 {
            return Err(RadiusFault::SamePoint);
        }
        let size = radius.abs();
        if !size.is_finite() || size + tolerance < half {
            return Err(RadiusFault::TooSmall(half));
        }
        // (size - half)(size + half) keeps the digits that size^2 - half^2 loses near the half circle
        let height = ((size - half).max(0.0) * (size + half)).sqrt();
        let minor = radius >= 0.0;
        // a minor counter-clockwise arc has its centre to the left of the chord
        let side = if minor { turning.sign() } else { -turning.sign() };
        let centre = start + chord * 0.5 + normal.cross(&chord) * (side * height / (2.0 * half));
        Self::from_centre(start, end, centre, normal, turning, 0).ok_or(RadiusFault::SamePoint)
    }

    /// Point at share `t` of the arc, 0..=1, mm.
    pub fn point_at(&self, t: f64) -> Vec3 {
        if t <= 0.0 {
            return self.start;
        }
        if t >= 1.0 {
            return self.end;
        }
        let radius = self.radius_start + (self.radius_end - self.radius_start) * t;
        let arm = rotate(&self.normal, self.sweep * t, &(self.start - self.centre)) * (radius / self.radius_start);
        self.centre + arm + self.normal * (self.height() * t)
    }

    /// Direction of motion at share `t`, not of unit length: derivative of the point by `t`, mm.
    pub fn derivative_at(&self, t: f64) -> Vec3 {
        let slope = self.radius_end - self.radius_start;
        let radius = self.radius_start + slope * t;
        let unit = rotate(&self.normal, self.sweep * t, &(self.start - self.centre)) / self.radius_start;
        self.normal.cross(&unit) * (self.sweep * radius) + unit * slope + self.normal * self.height()
    }

    /// Rise along the normal from start to end, mm.
    pub fn height(&self) -> f64 {
        self.normal.dot(&(self.end - self.start))
    }

    /// Length, mm: exact for circle and helix, closed form for spirals.
    pub fn length(&self) -> f64 {
        let slope = self.radius_end - self.radius_start;
        let rest = (slope * slope + self.height() * self.height()).sqrt();
        let turn = self.sweep.abs();
        let speed = |radius: f64| ((turn * radius) * (turn * radius) + rest * rest).sqrt();
        if slope.abs() <= 1e-2 * self.radius_start.min(self.radius_end) {
            // nearly constant: Gauss-Legendre with three points errs below 1e-12 of the length here
            let middle = 0.5 * (self.radius_start + self.radius_end);
            let reach = 0.5 * slope * 0.774_596_669_241_483_4;
            return (5.0 * speed(middle - reach) + 8.0 * speed(middle) + 5.0 * speed(middle + reach)) / 18.0;
        }
        // integral of sqrt((turn r)^2 + rest^2) dr / slope
        let part = |radius: f64| 0.5 * radius * speed(radius) + 0.5 * rest * rest / turn * asinh(turn * radius / rest);
        (part(self.radius_end) - part(self.radius_start)) / slope
    }

    /// Lowest and highest value of the coordinate along a unit `direction` over the whole arc, mm. Exact for circles and helices,
    /// within 1e-9 of the radius for spirals.
    pub fn extent(&self, direction: &Vec3) -> (f64, f64) {
        let ends = [direction.dot(&self.start), direction.dot(&self.end)];
        let (mut low, mut high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let arm = self.start - self.centre;
        let (cosine, sine) = (direction.dot(&arm), direction.dot(&self.normal.cross(&arm)));
        if cosine == 0.0 && sine == 0.0 {
            return (low, high);
        }
        // the coordinate of the plain circle is stationary where the swept angle is `peak` + k pi
        let peak = atan2(sine, cosine);
        let (from, to) = if self.sweep >= 0.0 { (0.0, self.sweep) } else { (self.sweep, 0.0) };
        let (first, last) = (((from - peak) / PI).ceil(), ((to - peak) / PI).floor());
        // radius and height change evenly, so the extremes of a long spiral or helix lie near its first or last stationary points
        for k in [first - 1.0, first, first + 1.0, last - 1.0, last, last + 1.0] {
            let t = self.stationary(direction, (peak + k * PI) / self.sweep);
            let value = direction.dot(&self.point_at(t));
            (low, high) = (low.min(value), high.max(value));
        }
        (low, high)
    }

    /// A share near `guess` where the coordinate along `direction` is stationary; clamped to the arc, so its point always lies on it.
    fn stationary(&self, direction: &Vec3, guess: f64) -> f64 {
        let slope = self.radius_end - self.radius_start;
        let arm = (self.start - self.centre) / self.radius_start;
        let (cosine, sine) = (direction.dot(&arm), direction.dot(&self.normal.cross(&arm)));
        let drift = direction.dot(&self.normal) * self.height();
        let mut t = guess;
        for _ in 0..8 {
            let (sin, cos) = sin_cos(self.sweep * t);
            let radius = self.radius_start + slope * t;
            let (value, rate) = (cosine * cos + sine * sin, sine * cos - cosine * sin);
            let first = slope * value + radius * self.sweep * rate + drift;
            let second = 2.0 * slope * self.sweep * rate - radius * self.sweep * self.sweep * value;
            let step = first / second;
            if !step.is_finite() {
                break;
            }
            t -= step;
        }
        if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) }
    }
}

/// The part of a vector orthogonal to a unit normal.
fn in_plane(v: &Vec3, normal: &Vec3) -> Vec3 {
    v - normal * normal.dot(v)
}

#[cfg(test)]
mod tests;
