//! The saddle of two humps: a surface whose normals make the turning axis spin near its stationary points.
use crate::piece::{Piece, PieceError, Tool, count, within};
use trunnion_geometry::Vec3;

/// Length and width of the saddle, mm.
pub const SADDLE_SIZE: f64 = 100.0;

/// Height, mm, and its derivatives by u and v: z = -100 ((u - .3)^2 + (v - .3)^2) ((u - .7)^2 + (v - .7)^2).
fn height(u: f64, v: f64) -> (f64, f64, f64) {
    let near = (u - 0.3) * (u - 0.3) + (v - 0.3) * (v - 0.3);
    let far = (u - 0.7) * (u - 0.7) + (v - 0.7) * (v - 0.7);
    (
        -100.0 * near * far,
        -200.0 * ((u - 0.3) * far + (u - 0.7) * near),
        -200.0 * ((v - 0.3) * far + (v - 0.7) * near),
    )
}

/// Point of the saddle and its unit normal (upwards) at u, v in 0..=1: x = 100 u - 50, y = 100 v - 50. Source: docs/kinematics.md#test-pieces,
/// after a published case study on a telephone's surface.
pub fn saddle_point(u: f64, v: f64) -> (Vec3, Vec3) {
    let (z, by_u, by_v) = height(u, v);
    let normal = Vec3::new(-by_u / SADDLE_SIZE, -by_v / SADDLE_SIZE, 1.0);
    let half = 0.5 * SADDLE_SIZE;
    (
        Vec3::new(SADDLE_SIZE * u - half, SADDLE_SIZE * v - half, z),
        normal.normalize(),
    )
}

/// The saddle as a Bezier patch of degree 4 by 4: 5 x 5 control points, rows along v. Exact: the height is a polynomial.
pub fn saddle_net() -> Vec<Vec<Vec3>> {
    // monomials u^i v^j of the height
    let square = |a: f64| [a * a, -2.0 * a, 1.0];
    let mut monomials = [[0.0; 5]; 5];
    let mut add = |p: [f64; 3], q: [f64; 3], in_u: bool, second_in_u: bool| {
        for (i, a) in p.iter().enumerate() {
            for (j, b) in q.iter().enumerate() {
                let (m, n) = match (in_u, second_in_u) {
                    (true, true) => (i + j, 0),
                    (true, false) => (i, j),
                    (false, true) => (j, i),
                    (false, false) => (0, i + j),
                };
                monomials[m][n] -= 100.0 * a * b;
            }
        }
    };
    for (first, second) in [(true, true), (true, false), (false, true), (false, false)] {
        add(square(0.3), square(0.7), first, second);
    }
    // u^i in Bernstein form of degree 4: coefficient at k is C(k, i) / C(4, i)
    let choose = |n: usize, k: usize| (1..=k).fold(1.0, |product, m| product * (n + 1 - m) as f64 / m as f64);
    let share = |k: usize, i: usize| if i <= k { choose(k, i) / choose(4, i) } else { 0.0 };
    let point = |row: usize, column: usize| {
        let mut z = 0.0;
        for (i, by_v) in monomials.iter().enumerate() {
            for (j, value) in by_v.iter().enumerate() {
                z += value * share(column, i) * share(row, j);
            }
        }
        let at = |k: usize| SADDLE_SIZE * k as f64 / 4.0 - 0.5 * SADDLE_SIZE;
        Vec3::new(at(column), at(row), z)
    };
    (0..5)
        .map(|row| (0..5).map(|column| point(row, column)).collect())
        .collect()
}

/// The saddle in zigzag lines along x, `columns` points in each of `rows` lines; the tool axis is the surface's normal.
///
/// # Errors
/// Counts out of range.
pub fn saddle(columns: usize, rows: usize, feed: f64) -> Result<Piece, PieceError> {
    count("columns", columns, 2, 5_000)?;
    count("rows", rows, 2, 5_000)?;
    within("feed", feed, 0.001, 1e6, "mm/min")?;
    let mut points = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        let v = row as f64 / (rows - 1) as f64;
        for step in 0..columns {
            let column = if row % 2 == 0 { step } else { columns - 1 - step };
            points.push(saddle_point(column as f64 / (columns - 1) as f64, v));
        }
    }
    let title = format!("saddle {SADDLE_SIZE} x {SADDLE_SIZE} mm, zigzag {columns} x {rows}");
    let tool = Tool {
        diameter: 6.0,
        ball: true,
    };
    Ok(Piece::along("saddle", title, feed, tool, &points))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_is_at_right_angles_to_the_surface() {
        let h = 1e-6;
        for (u, v) in [(0.1, 0.2), (0.3, 0.3), (0.5, 0.5), (0.9, 0.05)] {
            let (_, normal) = saddle_point(u, v);
            for (du, dv) in [(h, 0.0), (0.0, h)] {
                let along = (saddle_point(u + du, v + dv).0 - saddle_point(u - du, v - dv).0) / (2.0 * h);
                assert!(normal.dot(&along).abs() < 1e-6, "{u} {v}");
            }
        }
        // the two humps touch z = 0 at their stationary points
        assert_eq!(saddle_point(0.3, 0.3), (Vec3::new(-20.0, -20.0, 0.0), Vec3::z()));
    }

    #[test]
    fn the_net_is_the_surface() {
        let net = saddle_net();
        let bernstein = |k: usize, t: f64| {
            let choose = [1.0, 4.0, 6.0, 4.0, 1.0][k];
            choose * t.powi(k as i32) * (1.0 - t).powi(4 - k as i32)
        };
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.37, 0.81), (0.5, 0.5)] {
            let mut point = Vec3::zeros();
            for (row, points) in net.iter().enumerate() {
                for (column, control) in points.iter().enumerate() {
                    point += control * (bernstein(column, u) * bernstein(row, v));
                }
            }
            assert!((point - saddle_point(u, v).0).norm() < 1e-10, "{u} {v}: {point}");
        }
    }

    #[test]
    fn a_zigzag_turns_back_on_each_line() {
        let piece = saddle(20, 20, 1000.0).expect("a piece");
        assert_eq!(piece.moves.len(), 402);
        let tips: Vec<Vec3> = piece.moves.iter().map(|step| step.tip).collect();
        assert_eq!((tips[20].x, tips[21].x), (50.0, 50.0));
        assert!(tips[21].y > tips[20].y);
    }
}
