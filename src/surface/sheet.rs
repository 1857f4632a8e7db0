//! A surface over two parameters: a grid of points with bilinear cells, or a Bezier patch.
use crate::patch::Patch;
use trunnion_geometry::Vec3;

/// One sheet of a required surface. u and v run from 0 to 1 along columns and rows.
#[derive(Clone, Debug, PartialEq)]
pub enum Sheet {
    /// Points in rows; between four neighbours the surface is bilinear.
    Grid(Vec<Vec<Vec3>>),
    /// A Bezier patch.
    Patch(Patch),
}

/// A sheet cut into triangles.
pub(crate) struct Cut {
    /// Points with their u, v.
    pub(crate) points: Vec<(Vec3, [f64; 2])>,
    /// Triangles by index.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// How far the triangles may lie from the sheet, mm: proven.
    pub(crate) off: f64,
}

impl Sheet {
    /// Point at u, v (held to 0..=1), mm.
    pub fn point(&self, u: f64, v: f64) -> Vec3 {
        let (u, v) = (u.clamp(0.0, 1.0), v.clamp(0.0, 1.0));
        match self {
            Self::Patch(patch) => patch.point(u, v),
            Self::Grid(rows) => {
                let (column, s) = cell(u, rows[0].len());
                let (row, t) = cell(v, rows.len());
                let along = |row: &[Vec3]| row[column] * (1.0 - s) + row[column + 1] * s;
                along(&rows[row]) * (1.0 - t) + along(&rows[row + 1]) * t
            }
        }
    }

    /// Bounds of the slopes by u and by v, mm.
    pub(crate) fn slopes(&self) -> (f64, f64) {
        match self {
            Self::Patch(patch) => patch.slopes(),
            Self::Grid(rows) => {
                let along = rows
                    .iter()
                    .flat_map(|row| row.windows(2))
                    .map(|two| (two[1] - two[0]).norm());
                let across = rows
                    .windows(2)
                    .flat_map(|two| two[1].iter().zip(&two[0]).map(|(b, a)| (b - a).norm()));
                (
                    along.fold(0.0, f64::max) * (rows[0].len() - 1) as f64,
                    across.fold(0.0, f64::max) * (rows.len() - 1) as f64,
                )
            }
        }
    }

    /// Cuts the sheet into triangles that lie at most `tolerance` mm from it, or as near as `most` triangles allow.
    pub(crate) fn cut(&self, tolerance: f64, most: usize) -> Cut {
        match self {
            Self::Patch(patch) => cut_patch(self, patch, tolerance, most),
            Self::Grid(rows) => cut_grid(self, rows, tolerance, most),
        }
    }
}

/// Cell and share of it for a parameter over `count` points.
fn cell(parameter: f64, count: usize) -> (usize, f64) {
    let place = parameter * (count - 1) as f64;
    let index = (place.floor() as usize).min(count - 2);
    (index, place - index as f64)
}

/// A linear triangle with legs hu, hv is off a surface by at most (hu2 |S_uu| + 2 hu hv |S_uv| + hv2 |S_vv|) / 8 (Filip, Magedson and
/// Markot, 1986).
fn cut_patch(sheet: &Sheet, patch: &Patch, tolerance: f64, most: usize) -> Cut {
    let (uu, uv, vv) = patch.bends();
    let off = |nu: f64, nv: f64| (uu / (nu * nu) + 2.0 * uv / (nu * nv) + vv / (nv * nv)) / 8.0;
    // as many along each parameter as its own curvature requires, then both alike until it is fine enough
    let (wu, wv) = ((uu + uv).sqrt().max(1e-9), (vv + uv).sqrt().max(1e-9));
    let shape = (wu / wv).clamp(1.0 / 64.0, 64.0);
    let along = (most as f64 / 2.0 * shape).sqrt().floor().max(1.0);
    let (mut nu, mut nv) = (1.0_f64, 1.0_f64);
    while off(nu, nv) > tolerance && nu < along {
        nu = (nu * 1.25).ceil().min(along);
        nv = (nu / shape).ceil().max(1.0);
    }
    let mut cut = lattice(sheet, nu as usize, nv as usize);
    cut.off = off(nu, nv);
    cut
}

/// Two triangles of a bilinear cell with the twist w lie at most |w| / 4 from it; k by k parts divide that by k2.
fn cut_grid(sheet: &Sheet, rows: &[Vec<Vec3>], tolerance: f64, most: usize) -> Cut {
    let twist = rows
        .windows(2)
        .flat_map(|two| {
            let below = two[0].windows(2);
            below
                .zip(two[1].windows(2))
                .map(|(a, b)| (a[0] - a[1] - b[0] + b[1]).norm())
        })
        .fold(0.0, f64::max);
    let (columns, lines) = (rows[0].len() - 1, rows.len() - 1);
    let wanted = (twist / (4.0 * tolerance)).sqrt().ceil().max(1.0);
    let allowed = (most as f64 / (2.0 * (columns * lines) as f64)).sqrt().floor().max(1.0);
    let k = wanted.min(allowed);
    let mut cut = lattice(sheet, columns * k as usize, lines * k as usize);
    cut.off = twist / (4.0 * k * k);
    cut
}

/// Points and triangles of an even lattice over the sheet.
fn lattice(sheet: &Sheet, nu: usize, nv: usize) -> Cut {
    let mut points = Vec::with_capacity((nu + 1) * (nv + 1));
    for j in 0..=nv {
        for i in 0..=nu {
            let (u, v) = (i as f64 / nu as f64, j as f64 / nv as f64);
            points.push((sheet.point(u, v), [u, v]));
        }
    }
    let mut triangles = Vec::with_capacity(2 * nu * nv);
    for j in 0..nv {
        for i in 0..nu {
            let corner = |di: usize, dj: usize| ((j + dj) * (nu + 1) + i + di) as u32;
            triangles.push([corner(0, 0), corner(1, 0), corner(1, 1)]);
            triangles.push([corner(0, 0), corner(1, 1), corner(0, 1)]);
        }
    }
    Cut {
        points,
        triangles,
        off: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_pieces::saddle_net;

    fn grid() -> Sheet {
        Sheet::Grid(vec![
            vec![Vec3::zeros(), Vec3::new(10.0, 0.0, 0.0), Vec3::new(20.0, 0.0, 1.0)],
            vec![
                Vec3::new(0.0, 5.0, 0.0),
                Vec3::new(10.0, 5.0, 3.0),
                Vec3::new(20.0, 5.0, 0.0),
            ],
        ])
    }

    #[test]
    fn a_grid_is_bilinear_between_its_points() {
        let sheet = grid();
        assert_eq!(sheet.point(0.5, 1.0), Vec3::new(10.0, 5.0, 3.0));
        assert_eq!(sheet.point(0.25, 0.5), Vec3::new(5.0, 2.5, 0.75));
        assert_eq!(sheet.point(1.0, 1.0), Vec3::new(20.0, 5.0, 0.0));
    }

    /// Every point of a sheet is as near to the triangles as the cut claims, measured along the parameters.
    #[test]
    fn cuts_are_as_near_as_they_say() {
        for sheet in [grid(), Sheet::Patch(Patch::new(saddle_net()))] {
            for (tolerance, most) in [(0.01, 100_000), (0.01, 200)] {
                let cut = sheet.cut(tolerance, most);
                assert!(
                    cut.triangles.len() <= most + most / 4,
                    "{} triangles",
                    cut.triangles.len()
                );
                assert!(cut.off <= tolerance || most == 200, "{}", cut.off);
                let mut worst = 0.0_f64;
                for triangle in &cut.triangles {
                    let corner = triangle.map(|i| &cut.points[i as usize]);
                    for weights in [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.3, 0.3, 0.4]] {
                        let mix = |f: &dyn Fn(usize) -> f64| (0..3).map(|k| weights[k] * f(k)).sum::<f64>();
                        let flat = corner.iter().zip(weights).map(|(c, w)| c.0 * w).sum::<Vec3>();
                        let real = sheet.point(mix(&|k| corner[k].1[0]), mix(&|k| corner[k].1[1]));
                        worst = worst.max((flat - real).norm());
                    }
                }
                assert!(worst <= cut.off + 1e-12, "{worst} above {}", cut.off);
                assert!(worst >= cut.off * 0.1, "{worst} far below {}", cut.off);
            }
        }
    }
}
