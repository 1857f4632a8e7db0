//! A NURBS curve as chords: what the rest of Trunnion, which knows lines and arcs, can follow.

/// Points on the curve, the start left out and the end exact, so that chords stay within `tolerance` of it (units of the points).
///
/// Rational B-spline by de Boor's recurrence in homogeneous coordinates (Piegl, Tiller: The NURBS Book, 2nd ed., A4.1). Where a half
/// of a span strays from its chord by more than the tolerance at its quarters, it is halved. `None` where the knots are no knots.
pub(super) fn chords(order: usize, points: &[[f64; 3]], knots: &[f64], tolerance: f64) -> Option<Vec<[f64; 2]>> {
    if order < 2 || points.len() < order {
        return None;
    }
    let clamped;
    let knots = if knots.is_empty() {
        clamped = clamped_uniform(order, points.len());
        &clamped
    } else {
        knots
    };
    let sorted = knots.windows(2).all(|pair| pair[0] <= pair[1]);
    let finite = points.iter().flatten().chain(knots).all(|value| value.is_finite());
    if knots.len() != points.len() + order || !sorted || !finite {
        return None;
    }
    let curve = Curve { order, points, knots };
    let mut out = Vec::new();
    for span in order - 1..points.len() {
        let (from, to) = (knots[span], knots[span + 1]);
        if to > from {
            let (a, b) = (curve.at(span, from)?, curve.at(span, to)?);
            curve.divide(span, (from, a), (to, b), tolerance, 0, &mut out)?;
        }
    }
    Some(out)
}

/// Knots 0 0 0 1 2 3 3 3 for order 3 and five points.
fn clamped_uniform(order: usize, count: usize) -> Vec<f64> {
    let inner = count - order + 1;
    (0..count + order)
        .map(|index| (index as f64 - (order - 1) as f64).clamp(0.0, inner as f64))
        .collect()
}

struct Curve<'a> {
    order: usize,
    points: &'a [[f64; 3]],
    knots: &'a [f64],
}

/// No chord is halved more often.
const DEEPEST: u32 = 12;

impl Curve<'_> {
    /// The point at `u` in a span.
    fn at(&self, span: usize, u: f64) -> Option<[f64; 2]> {
        let degree = self.order - 1;
        let mut d: Vec<[f64; 3]> = (span - degree..=span)
            .map(|index| {
                let [x, y, weight] = self.points[index];
                [x * weight, y * weight, weight]
            })
            .collect();
        for level in 1..=degree {
            for j in (level..=degree).rev() {
                let low = self.knots[span - degree + j];
                let high = self.knots[span + 1 + j - level];
                let part = if high > low { (u - low) / (high - low) } else { 0.0 };
                let before = d[j - 1];
                for (value, before) in d[j].iter_mut().zip(before) {
                    *value = (1.0 - part) * before + part * *value;
                }
            }
        }
        let [x, y, weight] = d[degree];
        (weight != 0.0).then(|| [x / weight, y / weight])
    }

    fn divide(
        &self,
        span: usize,
        (from, a): (f64, [f64; 2]),
        (to, b): (f64, [f64; 2]),
        tolerance: f64,
        depth: u32,
        out: &mut Vec<[f64; 2]>,
    ) -> Option<()> {
        let mut straight = depth >= 2;
        for part in [0.25, 0.5, 0.75] {
            let point = self.at(span, from + part * (to - from))?;
            straight &= distance(point, a, b) <= tolerance;
        }
        if straight || depth == DEEPEST {
            out.push(b);
            return Some(());
        }
        let middle = 0.5 * (from + to);
        let point = self.at(span, middle)?;
        self.divide(span, (from, a), (middle, point), tolerance, depth + 1, out)?;
        self.divide(span, (middle, point), (to, b), tolerance, depth + 1, out)
    }
}

/// Of a point from the segment `a` `b`.
fn distance(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx * dx + dy * dy;
    let (px, py) = (point[0] - a[0], point[1] - a[1]);
    let part = if length > 0.0 {
        ((px * dx + py * dy) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (x, y) = (px - part * dx, py - part * dy);
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_circle_as_rational_quadratic_stays_on_the_circle() {
        let weight = 0.5_f64.sqrt();
        let points = [[1.0, 0.0, 1.0], [1.0, 1.0, weight], [0.0, 1.0, 1.0]];
        let chords = chords(3, &points, &[], 1e-4).expect("a curve");
        assert!(chords.len() > 8, "{}", chords.len());
        for [x, y] in &chords {
            assert!((x * x + y * y - 1.0).abs() < 1e-12);
        }
        assert_eq!(chords.last(), Some(&[0.0, 1.0]));
    }

    #[test]
    fn a_line_of_control_points_is_a_line() {
        let points = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0], [3.0, 0.0, 1.0]];
        let chords = chords(4, &points, &[], 1e-6).expect("a curve");
        assert!(chords.iter().all(|[_, y]| *y == 0.0));
        assert_eq!(chords.last(), Some(&[3.0, 0.0]));
    }

    #[test]
    fn what_is_no_curve_is_none() {
        assert_eq!(chords(3, &[[0.0; 3]; 2], &[], 1.0), None);
        assert_eq!(chords(3, &[[0.0, 0.0, 1.0]; 3], &[0.0; 3], 1.0), None);
        assert_eq!(chords(3, &[[f64::NAN, 0.0, 1.0]; 3], &[], 1.0), None);
    }
}
