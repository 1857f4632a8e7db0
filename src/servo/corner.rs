//! A corner of two straight legs, and the two measures of how far a position is off it.
use trunnion_geometry::Vec3;
use trunnion_geometry::math::angle_between;

/// Two legs that meet in the origin: in along `before`, out along `after`. Unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Direction of travel into the corner.
    pub before: Vec3,
    /// Direction of travel out of it.
    pub after: Vec3,
    /// Points into the corner: (after - before), of length 1; zero where the path runs straight on.
    inward: Vec3,
    /// Second direction of the plane of both legs, at right angles to `before`; zero where they lie on one line.
    across: Vec3,
}

impl Corner {
    /// `None` where one of the directions has no length.
    pub fn new(before: &Vec3, after: &Vec3) -> Option<Self> {
        let unit = |v: &Vec3| v.try_normalize(1e-12).filter(|v| v.iter().all(|x| x.is_finite()));
        let (before, after) = (unit(before)?, unit(after)?);
        let some = |v: Vec3| v.try_normalize(1e-9).unwrap_or_else(Vec3::zeros);
        Some(Self {
            before,
            after,
            inward: some(after - before),
            across: some(after - before * after.dot(&before)),
        })
    }

    /// A corner in the plane that turns by this angle, rad.
    pub fn turning(turn: f64) -> Option<Self> {
        let (sin, cos) = trunnion_geometry::math::sin_cos(turn);
        Self::new(&Vec3::x(), &Vec3::new(cos, sin, 0.0))
    }

    /// Two unit vectors of the plane of both legs: along the leg in, and across it (zero where the legs lie on one line).
    pub fn plane(&self) -> (Vec3, Vec3) {
        (self.before, self.across)
    }

    /// By how much the direction turns, rad: 0 straight on, pi back.
    pub fn turn(&self) -> f64 {
        angle_between(&self.before, &self.after)
    }

    /// The reference position at the path length `s`, counted from the corner, mm.
    pub(crate) fn at(&self, s: f64) -> Vec3 {
        (if s < 0.0 { self.before } else { self.after }) * s
    }

    /// Direction of travel at `s`.
    pub(crate) fn direction(&self, s: f64) -> Vec3 {
        if s < 0.0 { self.before } else { self.after }
    }

    /// Exact distance of a position from the path: from the nearer of the two half lines, mm.
    pub fn distance(&self, p: &Vec3) -> f64 {
        let from = |direction: &Vec3| (p - direction * p.dot(direction).max(0.0)).norm();
        from(&-self.before).min(from(&self.after))
    }

    /// The corner vector of paper 002 (eq. 3 and 7): from the position to the path, along the ray from the centre point through the position; mm.
    /// `s`: path length of the reference, counted from the corner. Zero where the ray meets no leg.
    ///
    /// The centre point lies on the bisector, twice as far inside as the following error reaches along it.
    pub fn vector(&self, position: &Vec3, reference: &Vec3, s: f64) -> Vec3 {
        let lag = self.direction(s) * (reference - position).norm();
        let centre = self.inward * (2.0 * self.inward.dot(&lag).abs());
        let plane = |v: &Vec3| (v.dot(&self.before), v.dot(&self.across));
        let (cx, cy) = plane(&centre);
        let (px, py) = plane(position);
        let (dx, dy) = (px - cx, py - cy);
        let (bx, by) = plane(&self.after);
        // where the ray meets the line of the leg in before: y = 0, x <= 0
        let on_before = Some(-cy / dy).filter(|m| m.is_finite() && *m > 0.0 && cx + m * dx <= 0.0);
        // and that of the leg out: at right angles to its normal, in front of the corner
        let on_after = Some(-(bx * cy - by * cx) / (bx * dy - by * dx))
            .filter(|m| m.is_finite() && *m > 0.0 && bx * (cx + m * dx) + by * (cy + m * dy) >= 0.0);
        let nearest = match (on_before, on_after) {
            (Some(a), Some(b)) => a.min(b),
            (Some(m), None) | (None, Some(m)) => m,
            (None, None) => return Vec3::zeros(),
        };
        self.before * (cx + nearest * dx) + self.across * (cy + nearest * dy) - position
    }
}
