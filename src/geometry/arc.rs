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
    /// when start or end is on the centre, or when a number is not finite. `normal` must have length 1.
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
        finite.then_some(Self {
            start,
            end,
            centre,
            normal,
            sweep,
            radius_start,
            radius_end,
        })
    }

    /// A full turn more where the ends are one place within `within` mm: else a circle whose end was computed with rounding would be an arc of
    /// nothing.
    #[must_use]
    pub fn closed_within(mut self, within: f64) -> Self {
        if self.sweep.abs() * self.radius_start <= within {
            self.sweep += self.sweep.signum() * TAU;
        }
        self
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

    /// Lowest and highest value of the coordinate along a unit `direction` over the whole arc, mm, within rounding; both are values
    /// that a point of the arc has.
    pub fn extent(&self, direction: &Vec3) -> (f64, f64) {
        let arm = (self.start - self.centre) / self.radius_start;
        let along = Along {
            cosine: direction.dot(&arm),
            sine: direction.dot(&self.normal.cross(&arm)),
            drift: direction.dot(&self.normal) * self.height(),
            slope: self.radius_end - self.radius_start,
            radius: self.radius_start,
            sweep: self.sweep,
        };
        let ends = [direction.dot(&self.start), direction.dot(&self.end)];
        let mut range = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        if along.cosine == 0.0 && along.sine == 0.0 {
            return range;
        }
        along.stationary(|t| {
            let value = direction.dot(&self.point_at(t));
            range = (range.0.min(value), range.1.max(value));
        });
        range
    }
}

/// One coordinate along an arc: (radius + slope t) (cosine cos(sweep t) + sine sin(sweep t)) + drift t, plus a constant.
struct Along {
    cosine: f64,
    sine: f64,
    drift: f64,
    slope: f64,
    radius: f64,
    sweep: f64,
}

impl Along {
    /// Derivative by t.
    fn rate(&self, t: f64) -> f64 {
        let (sin, cos) = sin_cos(self.sweep * t);
        let (value, turned) = (self.cosine * cos + self.sine * sin, self.sine * cos - self.cosine * sin);
        self.slope * value + (self.radius + self.slope * t) * self.sweep * turned + self.drift
    }

    /// Visits the shares where the coordinate may be extreme. Height and radius change evenly, so of many turns only the first and the
    /// last can hold the extremes.
    fn stationary(&self, mut visit: impl FnMut(f64)) {
        if self.slope == 0.0 && self.drift == 0.0 {
            // the plain circle: the swept angle is `peak` + k pi
            let peak = atan2(self.sine, self.cosine);
            let (from, to) = if self.sweep >= 0.0 {
                (0.0, self.sweep)
            } else {
                (self.sweep, 0.0)
            };
            let first = ((from - peak) / PI).ceil();
            for k in [first, first + 1.0] {
                let angle = peak + k * PI;
                if angle <= to {
                    visit(angle / self.sweep);
                }
            }
            return;
        }
        // at most three turns in 36 pieces: no piece sweeps more than 30 deg, so a change of sign shows
        let turns = (self.sweep / TAU).abs();
        if turns <= 3.0 {
            self.roots(0.0, 1.0, &mut visit);
        } else {
            self.roots(0.0, 1.5 / turns, &mut visit);
            self.roots(1.0 - 1.5 / turns, 1.0, &mut visit);
        }
    }

    /// Visits the zeros of the derivative between two shares, found by their change of sign.
    fn roots(&self, from: f64, to: f64, visit: &mut impl FnMut(f64)) {
        const PIECES: u32 = 36;
        let at = |piece: u32| from + (to - from) * f64::from(piece) / f64::from(PIECES);
        let mut low = (from, self.rate(from));
        for piece in 1..=PIECES {
            let high = (at(piece), self.rate(at(piece)));
            if low.1 * high.1 <= 0.0 {
                visit(self.zero(low, high));
            }
            low = high;
        }
    }

    /// The zero of the derivative between two shares, each with the derivative there (false position with halved values: Dowell and Jarratt, 1971). Near
    /// a zero the coordinate hardly changes, so a few steps are as good as all.
    fn zero(&self, mut low: (f64, f64), mut high: (f64, f64)) -> f64 {
        let mut at = f64::NAN;
        let mut side = 0;
        for _ in 0..48 {
            let before = at;
            let between = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            at = if between >= low.0 && between <= high.0 {
                between
            } else {
                0.5 * (low.0 + high.0)
            };
            let rate = self.rate(at);
            if rate == 0.0 || (at - before).abs() <= f64::EPSILON * at.abs() {
                break;
            }
            if (rate > 0.0) == (low.1 > 0.0) {
                low = (at, rate);
                high.1 *= if side == 1 { 0.5 } else { 1.0 };
                side = 1;
            } else {
                high = (at, rate);
                low.1 *= if side == -1 { 0.5 } else { 1.0 };
                side = -1;
            }
        }
        at
    }
}

/// The part of a vector orthogonal to a unit normal.
fn in_plane(v: &Vec3, normal: &Vec3) -> Vec3 {
    v - normal * normal.dot(v)
}

#[cfg(test)]
mod tests;
