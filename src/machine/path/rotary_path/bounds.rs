//! Bounds of the rotary axes' rates and of their changes over a piece of a great circle. With x = e1.u, S^2 = D (1 - y^2) - (x - c y)^2
//! (docs/kinematics.md#two-postures) and w the angle per block: u'' = -w^2 u, x'' = -w^2 x, S S' = -(x - c y) x'.
use super::GreatCircle;
use core::f64::consts::PI;
use trunnion_geometry::math::{atan2, cos, sin_cos};

/// Bounds over a piece of a block for the two rotary axes: rates and second derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RotaryPathBounds {
    pub(crate) rate: [f64; 2],
    pub(crate) bend: [f64; 2],
}

/// What is known about a piece, all of them upper bounds of absolute values unless stated otherwise.
pub(super) struct Piece {
    /// Angle of the whole block, rad.
    w: f64,
    /// x and its rate.
    x: f64,
    x_rate: f64,
    /// sin^2 of the angle between u and e1, never above it.
    across: f64,
    /// S, never above it and never below it.
    s: f64,
    s_most: f64,
    /// y - c x, x - c y.
    gap: f64,
    off: f64,
}

/// Room for rounding in a bound.
const UP: f64 = 1.0 + 1e-9;

impl GreatCircle<'_> {
    /// Bounds over a piece: of two derivations, each is the tighter one somewhere.
    pub(crate) fn bounds(&self, from: f64, to: f64) -> RotaryPathBounds {
        let piece = self.piece(from, to);
        let (one, other) = (self.by_reach(&piece), self.by_azimuth(&piece));
        let least = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].min(b[1])];
        RotaryPathBounds {
            rate: least(one.rate, other.rate),
            bend: least(one.bend, other.bend),
        }
    }

    pub(super) fn piece(&self, from: f64, to: f64) -> Piece {
        let pair = self.pair;
        let w = self.angle;
        let e1 = self.machine.constants.rotary[0].direction;
        let (u, rate) = self.axis(0.5 * (from + to));
        let middle = atan2(e1.cross(&u).norm(), e1.dot(&u));
        // the angle to e1 changes by at most w per block
        let half = 0.5 * w * (to - from) * UP;
        let (low, high) = ((middle - half).max(0.0), (middle + half).min(PI));
        let (from_x, to_x) = (cos(high), cos(low));
        let rho2 = pair.d * (1.0 - pair.y * pair.y);
        let top = pair.c * pair.y;
        let s2 = |x: f64| rho2 - (x - top) * (x - top);
        let s_most = if (from_x..=to_x).contains(&top) {
            rho2
        } else {
            s2(from_x).max(s2(to_x))
        };
        // both are linear in x
        let most = |at: &dyn Fn(f64) -> f64| at(from_x).abs().max(at(to_x).abs()) * UP + 1e-15;
        let x = most(&|x| x);
        let sines = [low, high].map(|angle| sin_cos(angle).0);
        let sine = if low < 0.5 * PI && high > 0.5 * PI {
            1.0
        } else {
            sines[0].max(sines[1])
        };
        // x' is the middle's, and changes by at most w^2 x; nor is it above w times the sine
        let x_rate = (e1.dot(&rate).abs() + half * w * x) * UP + 1e-15;
        Piece {
            w,
            x,
            x_rate: x_rate.min(w * sine),
            across: (sines[0].min(sines[1]) * (1.0 - 1e-9)).powi(2),
            s: s2(from_x).min(s2(to_x)).max(0.0).sqrt() * (1.0 - 1e-9),
            s_most: s_most.max(0.0).sqrt() * UP,
            gap: most(&|x| {
                if x > 0.0 {
                    pair.y_minus_c + pair.c * (1.0 - x)
                } else {
                    pair.y_plus_c - pair.c * (1.0 + x)
                }
            }),
            off: most(&|x| x - top),
        }
    }

    /// S t1' = -u'.f with |u'| = w, S t2' = x'. From u'' multiplied by f and by e1: S t1'' = w^2 y - 2 t1' S' - t1'^2 (y - c x) and
    /// S t2'' = -w^2 x - t2' S'. Where the pole can be reached y - c x vanishes there.
    pub(super) fn by_reach(&self, piece: &Piece) -> RotaryPathBounds {
        let &Piece { w, x, s, gap, off, .. } = piece;
        let first = w / s;
        let second = piece.x_rate / s;
        let bend1 = (w * w * self.pair.y.abs() + first * first * gap + 2.0 * first * second * off) / s;
        let bend2 = (w * w * x + second * second * off) / s;
        RotaryPathBounds {
            rate: [first, second],
            bend: [bend1, bend2],
        }
    }

    /// t1 is the azimuth of u less its lead over the second axis ([`GreatCircle::lead`]). The azimuth's rate is w n / (1 - x^2) with n the
    /// part of the circle's axis along e1; the lead changes with x by N / (D (1 - x^2)), N = c S - (x - c y)(y - c x) / S, and N with x by
    /// -(y - c x) D (1 - y^2) / S^3. At the edge of reach, where S is small, most terms of the first formula cancel; here
    /// they are small themselves as long as x changes little.
    fn by_azimuth(&self, piece: &Piece) -> RotaryPathBounds {
        let &Piece {
            w,
            x,
            x_rate,
            across,
            s,
            gap,
            off,
            ..
        } = piece;
        let pair = self.pair;
        let along = self.machine.constants.rotary[0]
            .direction
            .dot(&self.start.cross(&self.side))
            .abs()
            + 1e-15;
        let rho2 = pair.d * (1.0 - pair.y * pair.y);
        let n = (pair.c.abs() * piece.s_most + off * gap / s) * UP;
        let lead = n / (pair.d * across);
        let lead_bend = gap * rho2 / (s * s * s * pair.d * across) + lead * 2.0 * x / across;
        let first = w * along / across + lead * x_rate;
        let bend1 = w * along * 2.0 * x * x_rate / (across * across) + lead_bend * x_rate * x_rate + lead * w * w * x;
        let second = x_rate / s;
        RotaryPathBounds {
            rate: [first * UP, second],
            bend: [bend1 * UP, (w * w * x + second * second * off) / s],
        }
    }
}
