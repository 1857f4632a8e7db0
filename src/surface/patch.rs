//! A Bezier patch of any degree: points by de Casteljau, and bounds of its derivatives from the differences of its control points.
use trunnion_geometry::Vec3;

/// A tensor-product Bezier patch; rows of control points run along u, the rows follow each other along v. u and v in 0..=1.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    rows: Vec<Vec<Vec3>>,
}

/// The highest degree: beyond it the differences that bound the derivatives say little.
pub(crate) const HIGHEST_DEGREE: usize = 20;

impl Patch {
    /// Control points: at least two in each of at least two rows of equal length.
    pub(crate) fn new(rows: Vec<Vec<Vec3>>) -> Self {
        Self { rows }
    }

    /// Point at u, v in 0..=1.
    pub(crate) fn point(&self, u: f64, v: f64) -> Vec3 {
        let column: Vec<Vec3> = self.rows.iter().map(|row| casteljau(row, u)).collect();
        casteljau(&column, v)
    }

    fn degrees(&self) -> (f64, f64) {
        ((self.rows[0].len() - 1) as f64, (self.rows.len() - 1) as f64)
    }

    /// Bounds of |S_u| and |S_v|, mm.
    pub(crate) fn slopes(&self) -> (f64, f64) {
        let (m, n) = self.degrees();
        (m * largest(&along_u(&self.rows)), n * largest(&along_v(&self.rows)))
    }

    /// Bounds of |S_uu|, |S_uv| and |S_vv|, mm.
    pub(crate) fn bends(&self) -> (f64, f64, f64) {
        let (m, n) = self.degrees();
        let (by_u, by_v) = (along_u(&self.rows), along_v(&self.rows));
        (
            m * (m - 1.0) * largest(&along_u(&by_u)),
            m * n * largest(&along_v(&by_u)),
            n * (n - 1.0) * largest(&along_v(&by_v)),
        )
    }
}

fn casteljau(points: &[Vec3], t: f64) -> Vec3 {
    let mut work = points.to_vec();
    for length in (1..work.len()).rev() {
        for i in 0..length {
            work[i] = work[i] * (1.0 - t) + work[i + 1] * t;
        }
    }
    work[0]
}

fn along_u(rows: &[Vec<Vec3>]) -> Vec<Vec<Vec3>> {
    rows.iter()
        .map(|row| row.windows(2).map(|two| two[1] - two[0]).collect())
        .collect()
}

fn along_v(rows: &[Vec<Vec3>]) -> Vec<Vec<Vec3>> {
    rows.windows(2)
        .map(|two| two[1].iter().zip(&two[0]).map(|(b, a)| b - a).collect())
        .collect()
}

fn largest(rows: &[Vec<Vec3>]) -> f64 {
    rows.iter().flatten().map(Vec3::norm).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_pieces::{saddle_net, saddle_point};

    #[test]
    fn a_patch_is_its_polynomial_and_keeps_its_bounds() {
        let patch = Patch::new(saddle_net());
        let ((su, sv), (uu, uv, vv)) = (patch.slopes(), patch.bends());
        let h = 1e-3;
        for i in 0..=10 {
            for j in 0..=10 {
                let (u, v) = (0.05 + 0.09 * f64::from(i), 0.05 + 0.09 * f64::from(j));
                let at = |du: f64, dv: f64| patch.point(u + du * h, v + dv * h);
                assert!((at(0.0, 0.0) - saddle_point(u, v).0).norm() < 1e-10);
                assert!((at(1.0, 0.0) - at(-1.0, 0.0)).norm() / (2.0 * h) <= su + 1e-6);
                assert!((at(0.0, 1.0) - at(0.0, -1.0)).norm() / (2.0 * h) <= sv + 1e-6);
                let second = |a: Vec3, b: Vec3, c: Vec3| (a - b * 2.0 + c).norm() / (h * h);
                assert!(second(at(1.0, 0.0), at(0.0, 0.0), at(-1.0, 0.0)) <= uu + 1e-3);
                assert!(second(at(0.0, 1.0), at(0.0, 0.0), at(0.0, -1.0)) <= vv + 1e-3);
                let mixed = (at(1.0, 1.0) - at(1.0, -1.0) - at(-1.0, 1.0) + at(-1.0, -1.0)).norm() / (4.0 * h * h);
                assert!(mixed <= uv + 1e-3);
            }
        }
        assert_eq!(patch.point(1.0, 0.0), saddle_net()[0][4]);
    }
}
