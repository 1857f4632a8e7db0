//! Three-axis pieces for dynamics: sharp corners, and steps as short as a control's block time allows.
use crate::piece::{Piece, PieceError, Tool, count, within};
use trunnion_geometry::math::sin_cos;
use trunnion_geometry::{Vec3, rad};

const FLAT: Tool = Tool {
    diameter: 10.0,
    ball: false,
};

/// Corners with interior angles of 135, 90 and 45 deg between legs of `leg` mm.
///
/// # Errors
/// Sizes out of range.
pub fn corner_set(leg: f64, feed: f64) -> Result<Piece, PieceError> {
    within("leg", leg, 1.0, 1_000.0, "mm")?;
    within("feed", feed, 0.001, 1e6, "mm/min")?;
    let mut heading = 0.0;
    let mut point = Vec3::zeros();
    let mut points = vec![(point, Vec3::z())];
    for interior in [135.0, 90.0, 45.0, 180.0] {
        let (sin, cos) = sin_cos(rad(heading));
        point += Vec3::new(cos, sin, 0.0) * leg;
        points.push((point, Vec3::z()));
        // alternately left and right, so that the path does not run into itself
        heading += if interior == 90.0 {
            interior - 180.0
        } else {
            180.0 - interior
        };
    }
    let title = format!("corners of 135, 90 and 45 deg, legs {leg} mm");
    Ok(Piece::along("corner-set", title, feed, FLAT, &points))
}

/// A staircase of `segments` steps of `step` mm, along X and Y in turn: each block lasts step / feed.
///
/// # Errors
/// Sizes out of range.
pub fn staircase(step: f64, segments: usize, feed: f64) -> Result<Piece, PieceError> {
    within("step", step, 1e-4, 10.0, "mm")?;
    within("feed", feed, 0.001, 1e6, "mm/min")?;
    let segments = count("segments", segments, 2, 5_000_000)?;
    let points: Vec<(Vec3, Vec3)> = (0..=segments)
        .map(|i| {
            (
                Vec3::new(i.div_ceil(2) as f64 * step, (i / 2) as f64 * step, 0.0),
                Vec3::z(),
            )
        })
        .collect();
    let title = format!("staircase of {segments} steps of {step} mm");
    Ok(Piece::along("staircase", title, feed, FLAT, &points))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::deg;
    use trunnion_geometry::math::angle_between;

    #[test]
    fn corners_have_their_angles() {
        let piece = corner_set(30.0, 1000.0).expect("a piece");
        let tips: Vec<Vec3> = piece.moves[1..6].iter().map(|step| step.tip).collect();
        let interior: Vec<f64> = tips
            .windows(3)
            .map(|t| deg(angle_between(&(t[0] - t[1]), &(t[2] - t[1]))))
            .collect();
        for (found, wanted) in interior.iter().zip([135.0, 90.0, 45.0]) {
            assert!((found - wanted).abs() < 1e-9, "{interior:?}");
        }
        assert!(tips.windows(2).all(|t| ((t[1] - t[0]).norm() - 30.0).abs() < 1e-9));
    }

    #[test]
    fn a_staircase_climbs_one_step_a_block() {
        let piece = staircase(0.02, 1000, 5000.0).expect("a piece");
        let tips: Vec<Vec3> = piece.moves[1..1002].iter().map(|step| step.tip).collect();
        assert!(tips.windows(2).all(|t| ((t[1] - t[0]).norm() - 0.02).abs() < 1e-9));
        assert!((tips[1000] - Vec3::new(10.0, 10.0, 0.0)).norm() < 1e-9);
        assert!(piece.is_three_axis());
    }
}
