//! Splines as cubic Bezier pieces in homogeneous coordinates (x w, y w, z w, w).
//!
//! Sources: B-splines by their blossoms: L. Ramshaw, Blossoms are polar forms, CAGD 6 (1989) 323; natural cubic splines: C. de Boor, A
//! Practical Guide to Splines (1978), ch. IV; H. Akima, A new method of interpolation, J. ACM 17 (1970) 589.
use crate::Vec3;

/// The four points of a cubic piece.
pub type Cubic = [[f64; 4]; 4];

/// Shorter distances between neighbouring points are none, mm.
const NO_LENGTH: f64 = 1e-12;

fn mix(a: [f64; 4], b: [f64; 4], share: f64) -> [f64; 4] {
    core::array::from_fn(|at| (1.0 - share) * a[at] + share * b[at])
}

/// The B-spline of degree 2 or 3 with evenly spaced knots that begins at the first pole and ends at the last. A pole is x, y, z (mm) and its weight.
/// `None`: another degree, or fewer poles than the degree needs.
pub fn b_spline(poles: &[(Vec3, f64)], degree: usize) -> Option<Vec<Cubic>> {
    if !(2..=3).contains(&degree) || poles.len() <= degree {
        return None;
    }
    let pieces = poles.len() - degree;
    let knot = |at: usize| at.saturating_sub(degree).min(pieces) as f64;
    let pole = |at: usize| {
        let (place, weight) = poles[at];
        [place.x * weight, place.y * weight, place.z * weight, weight]
    };
    // the blossom of a piece: what its polynomial becomes with a parameter of its own for each degree
    let blossom = |piece: usize, at: [f64; 3]| {
        let last = piece + degree;
        let mut row: [[f64; 4]; 4] = core::array::from_fn(|j| if j <= degree { pole(piece + j) } else { [0.0; 4] });
        for (round, value) in at.iter().enumerate().take(degree) {
            for j in (round + 1..=degree).rev() {
                let (low, high) = (knot(j + last - degree), knot(j + last - round));
                row[j] = mix(row[j - 1], row[j], (value - low) / (high - low));
            }
        }
        row[degree]
    };
    let cubic = |piece: usize| {
        let (from, to) = (piece as f64, piece as f64 + 1.0);
        let point = |uppers: usize| blossom(piece, core::array::from_fn(|at| if at < uppers { to } else { from }));
        if degree == 3 {
            [point(0), point(1), point(2), point(3)]
        } else {
            let [a, b, c] = [point(0), point(1), point(2)];
            [a, mix(a, b, 2.0 / 3.0), mix(c, b, 2.0 / 3.0), c]
        }
    };
    Some((0..pieces).map(cubic).collect())
}

/// The cubic spline through points whose curvature is continuous, and zero at both ends; its parameter is the length of the chords. `None`: fewer
/// than two points, or two neighbours at one place.
pub fn natural(points: &[Vec3]) -> Option<Vec<Cubic>> {
    let chords = chords(points)?;
    let slopes = slopes(points, &chords);
    let n = points.len();
    // slopes m at the points: a tridiagonal system, solved by elimination
    let mut diagonal = vec![2.0; n];
    let mut right = vec![slopes[0] * 3.0; n];
    right[n - 1] = slopes[n - 2] * 3.0;
    let (mut above, mut below) = (vec![1.0; n], vec![1.0; n]);
    for at in 1..n - 1 {
        let (before, after) = (1.0 / chords[at - 1], 1.0 / chords[at]);
        (below[at], above[at], diagonal[at]) = (before, after, 2.0 * (before + after));
        right[at] = (slopes[at - 1] * before + slopes[at] * after) * 3.0;
    }
    for at in 1..n {
        let share = below[at] / diagonal[at - 1];
        diagonal[at] -= share * above[at - 1];
        let carried = right[at - 1] * share;
        right[at] -= carried;
    }
    right[n - 1] /= diagonal[n - 1];
    for at in (0..n - 1).rev() {
        right[at] = (right[at] - right[at + 1] * above[at]) / diagonal[at];
    }
    Some(hermite(points, &chords, &right))
}

/// Akima's spline through points: each slope depends on the two chords before and after; its parameter is the length of the chords. `None`:
/// as in [`natural`].
pub fn akima(points: &[Vec3]) -> Option<Vec<Cubic>> {
    let chords = chords(points)?;
    let slopes = slopes(points, &chords);
    let n = points.len();
    if n == 2 {
        return Some(hermite(points, &chords, &[slopes[0]; 2]));
    }
    // two further chords at each end
    let mut all = vec![Vec3::zeros(); 2];
    all.extend(&slopes);
    all[1] = all[2] * 2.0 - all[3];
    all[0] = all[1] * 2.0 - all[2];
    all.push(all[n] * 2.0 - all[n - 1]);
    all.push(all[n + 1] * 2.0 - all[n]);
    let slope = |at: usize, axis: usize| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|by| all[at + by][axis]);
        let (before, after) = ((b - a).abs(), (d - c).abs());
        if before + after > NO_LENGTH {
            (after * b + before * c) / (before + after)
        } else {
            0.5 * (b + c)
        }
    };
    let tangents: Vec<Vec3> = (0..n)
        .map(|at| Vec3::new(slope(at, 0), slope(at, 1), slope(at, 2)))
        .collect();
    Some(hermite(points, &chords, &tangents))
}

/// The distances between neighbours.
fn chords(points: &[Vec3]) -> Option<Vec<f64>> {
    let chords: Vec<f64> = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    let usable = |chord: &f64| *chord > NO_LENGTH && chord.is_finite();
    (!chords.is_empty() && chords.iter().all(usable)).then_some(chords)
}

fn slopes(points: &[Vec3], chords: &[f64]) -> Vec<Vec3> {
    points
        .windows(2)
        .zip(chords)
        .map(|(pair, chord)| (pair[1] - pair[0]) / *chord)
        .collect()
}

/// The pieces between points with a slope at each.
fn hermite(points: &[Vec3], chords: &[f64], slopes: &[Vec3]) -> Vec<Cubic> {
    let whole = |place: Vec3| [place.x, place.y, place.z, 1.0];
    let piece = |at: usize| {
        let third = chords[at] / 3.0;
        [
            points[at],
            points[at] + slopes[at] * third,
            points[at + 1] - slopes[at + 1] * third,
            points[at + 1],
        ]
        .map(whole)
    };
    (0..chords.len()).map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::{Cubic, akima, b_spline, natural};
    use crate::Vec3;

    /// A place on a piece, and its first and second derivative by the parameter of the piece, where all weights are 1.
    fn at(piece: &Cubic, t: f64) -> [Vec3; 3] {
        let [a, b, c, d] = piece.map(|point| Vec3::new(point[0], point[1], point[2]) / point[3]);
        let s = 1.0 - t;
        [
            a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t),
            ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0,
            ((c - b * 2.0 + a) * s + (d - c * 2.0 + b) * t) * 6.0,
        ]
    }

    fn points() -> Vec<Vec3> {
        [
            (0.0, 0.0, 0.0),
            (3.0, 4.0, 1.0),
            (9.0, 4.0, -2.0),
            (10.0, -3.0, 0.0),
            (14.0, -3.0, 5.0),
            (15.0, 1.0, 5.0),
        ]
        .map(|(x, y, z)| Vec3::new(x, y, z))
        .to_vec()
    }

    #[test]
    fn a_b_spline_is_smooth_and_ends_at_its_poles() {
        for degree in [2, 3] {
            let poles: Vec<(Vec3, f64)> = points().into_iter().map(|place| (place, 1.0)).collect();
            let pieces = b_spline(&poles, degree).expect("a spline");
            assert_eq!(pieces.len(), poles.len() - degree);
            assert!((at(&pieces[0], 0.0)[0] - poles[0].0).norm() < 1e-12);
            assert!((at(&pieces[pieces.len() - 1], 1.0)[0] - poles[5].0).norm() < 1e-12);
            // tangent to its polygon at both ends
            assert!(at(&pieces[0], 0.0)[1].cross(&(poles[1].0 - poles[0].0)).norm() < 1e-9);
            for pair in pieces.windows(2) {
                for derivative in 0..degree {
                    let gap = at(&pair[0], 1.0)[derivative] - at(&pair[1], 0.0)[derivative];
                    assert!(gap.norm() < 1e-9, "{degree} {derivative}: {gap}");
                }
            }
        }
        // a middle piece of degree 2 over even knots: the middles of the polygon's sides
        let poles: Vec<(Vec3, f64)> = points().into_iter().map(|place| (place, 1.0)).collect();
        let pieces = b_spline(&poles, 2).expect("a spline");
        assert!((at(&pieces[1], 0.0)[0] - (poles[1].0 + poles[2].0) * 0.5).norm() < 1e-12);
        assert!(b_spline(&poles[..3], 3).is_none());
        assert!(b_spline(&poles, 4).is_none());
    }

    /// Three poles of degree 2 with the weight cos 45 deg in the middle: a quarter of a circle.
    #[test]
    fn weights_make_a_circle() {
        let poles = [
            (Vec3::new(1.0, 0.0, 0.0), 1.0),
            (Vec3::new(1.0, 1.0, 0.0), core::f64::consts::FRAC_1_SQRT_2),
            (Vec3::new(0.0, 1.0, 0.0), 1.0),
        ];
        let pieces = b_spline(&poles, 2).expect("a spline");
        assert_eq!(pieces.len(), 1);
        for step in 0..=10 {
            let t = f64::from(step) / 10.0;
            let s = 1.0 - t;
            let shares = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
            let sum: [f64; 4] = core::array::from_fn(|axis| (0..4).map(|at| shares[at] * pieces[0][at][axis]).sum());
            let radius = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt() / sum[3];
            assert!((radius - 1.0).abs() < 1e-12, "{t}: {radius}");
        }
    }

    #[test]
    fn a_natural_spline_has_continuous_curvature_and_none_at_its_ends() {
        let points = points();
        let pieces = natural(&points).expect("a spline");
        let length = |at: usize| (points[at + 1] - points[at]).norm();
        for (index, pair) in pieces.windows(2).enumerate() {
            assert!((at(&pair[0], 1.0)[0] - points[index + 1]).norm() < 1e-12);
            let scale = [1.0, 1.0 / length(index), 1.0 / (length(index) * length(index))];
            let next = [
                1.0,
                1.0 / length(index + 1),
                1.0 / (length(index + 1) * length(index + 1)),
            ];
            for derivative in 0..3 {
                let gap = at(&pair[0], 1.0)[derivative] * scale[derivative]
                    - at(&pair[1], 0.0)[derivative] * next[derivative];
                assert!(gap.norm() < 1e-9, "{derivative}: {gap}");
            }
        }
        assert!(at(&pieces[0], 0.0)[2].norm() < 1e-9 && at(&pieces[4], 1.0)[2].norm() < 1e-9);
        assert!(natural(&points[..1]).is_none());
        assert!(natural(&[points[0], points[0]]).is_none());
        assert_eq!(natural(&points[..2]).expect("a line").len(), 1);
    }

    /// Akima's splines keep straight runs straight.
    #[test]
    fn akima_keeps_lines() {
        let row: Vec<Vec3> = [0.0, 1.0, 2.0, 4.0, 5.0, 6.0, 6.0]
            .iter()
            .zip([0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 9.0])
            .map(|(x, y)| Vec3::new(*x, y, 0.0))
            .collect();
        let pieces = akima(&row).expect("a spline");
        for piece in &pieces[..2] {
            for t in [0.2, 0.5, 0.9] {
                assert!(at(piece, t)[0].y.abs() < 1e-12);
            }
        }
        for (index, pair) in pieces.windows(2).enumerate() {
            let scale = [index, index + 1].map(|at| 1.0 / (row[at + 1] - row[at]).norm());
            assert!((at(&pair[0], 1.0)[1] * scale[0] - at(&pair[1], 0.0)[1] * scale[1]).norm() < 1e-9);
        }
        let row: Vec<Vec3> = [0.0, 1.0, 2.0, 3.0]
            .iter()
            .map(|x| Vec3::new(*x, 2.0 * x, 0.0))
            .collect();
        let straight = akima(&row).expect("a spline");
        assert!((at(&straight[1], 0.5)[0] - Vec3::new(1.5, 3.0, 0.0)).norm() < 1e-12);
    }
}
