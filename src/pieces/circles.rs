//! Circles and sweeps with one or two rotary axes turning: the tip moves on a known circle, or not at all.
use crate::piece::{Piece, PieceError, Tool, count, within};
use core::f64::consts::TAU;
use trunnion_geometry::math::{rotate, sin};
use trunnion_geometry::{Vec3, rad};

/// Which rotary axes turn while the tip moves on its circle (names for a machine that turns about Z and tilts about X).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnedAxes {
    /// The turning axis one full turn, the tilt constant: a circle in XY, the tool leaning outwards.
    Turn,
    /// The tilting axis from minus to plus, through the pole: an arc in YZ, the tool along its radius.
    Tilt,
    /// Both: a circle in XY, the lean swinging once between half and one and a half times the tilt.
    Both,
}

const BALL: Tool = Tool {
    diameter: 10.0,
    ball: true,
};

/// The tool axis that leans by `tilt` rad to the side of the azimuth `around` rad from X.
fn leaning(tilt: f64, around: f64) -> Vec3 {
    rotate(&Vec3::z(), around, &rotate(&Vec3::y(), tilt, &Vec3::z())).normalize()
}

/// A circle (for [`TurnedAxes::Tilt`]: an arc) of the tip of the given radius, mm, with the given tilt, deg.
///
/// # Errors
/// Sizes out of range.
pub fn circle(turned: TurnedAxes, radius: f64, tilt_deg: f64, segments: usize, feed: f64) -> Result<Piece, PieceError> {
    within("radius", radius, 0.1, 10_000.0, "mm")?;
    let tilt = rad(within("tilt", tilt_deg, 0.01, 80.0, "deg")?);
    within("feed", feed, 0.001, 1e6, "mm/min")?;
    let segments = count("segments", segments, 4, 5_000_000)?;
    let (name, what) = match turned {
        TurnedAxes::Turn => ("circle-c", "XY circle, turning axis once round"),
        TurnedAxes::Tilt => ("circle-a", "YZ arc, tilting axis through the pole"),
        TurnedAxes::Both => ("circle-ac", "XY circle, both rotary axes"),
    };
    let place = |i: usize| {
        let share = i as f64 / segments as f64;
        let psi = TAU * share;
        let rim = rotate(&Vec3::z(), psi, &Vec3::new(radius, 0.0, 0.0));
        match turned {
            TurnedAxes::Turn => (rim, leaning(tilt, psi)),
            TurnedAxes::Both => (rim, leaning(tilt * (1.0 + 0.5 * sin(psi)), psi)),
            TurnedAxes::Tilt => {
                let axis = rotate(&Vec3::x(), tilt * (1.0 - 2.0 * share), &Vec3::z()).normalize();
                ((axis - Vec3::z()) * radius, axis)
            }
        }
    };
    let points: Vec<(Vec3, Vec3)> = (0..=segments).map(place).collect();
    let title = format!("{what}, radius {radius} mm, tilt {tilt_deg} deg, {segments} blocks");
    Ok(Piece::along(name, title, feed, BALL, &points))
}

/// The tip is held at one point, `radius` mm along X from the part's zero, while the turning axis turns one full turn at `tilt` deg and
/// then the tilting axis back to half of it. Its true deviation is zero: any deviation is an error of the control or the machine file.
///
/// # Errors
/// Sizes out of range.
pub fn fixed_tip(radius: f64, tilt_deg: f64, segments: usize, feed: f64) -> Result<Piece, PieceError> {
    within("radius", radius, 0.0, 10_000.0, "mm")?;
    let tilt = rad(within("tilt", tilt_deg, 0.01, 80.0, "deg")?);
    within("feed", feed, 0.001, 1e6, "mm/min")?;
    let segments = count("segments", segments, 4, 5_000_000)?;
    let turning = segments - segments / 4;
    let tip = Vec3::new(radius, 0.0, 0.0);
    let points: Vec<(Vec3, Vec3)> = (0..=segments)
        .map(|i| {
            let axis = if i <= turning {
                leaning(tilt, TAU * i as f64 / turning as f64)
            } else {
                leaning(
                    tilt * (1.0 - 0.5 * (i - turning) as f64 / (segments - turning) as f64),
                    0.0,
                )
            };
            (tip, axis)
        })
        .collect();
    let title = format!("fixed tip {radius} mm from the zero point, tilt {tilt_deg} deg, {segments} blocks");
    Ok(Piece::along("fixed-tip", title, feed, BALL, &points))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::math::angle_between;

    #[test]
    fn tips_lie_on_their_circles_and_axes_lean_as_said() {
        for turned in [TurnedAxes::Turn, TurnedAxes::Both, TurnedAxes::Tilt] {
            let piece = circle(turned, 60.0, 20.0, 360, 500.0).expect("a piece");
            let cut = &piece.moves[1..piece.moves.len() - 1];
            assert_eq!(cut.len(), 361);
            for step in cut {
                let tilt = angle_between(&step.axis, &Vec3::z());
                match turned {
                    TurnedAxes::Turn => assert!((tilt - rad(20.0)).abs() < 1e-12),
                    TurnedAxes::Both => assert!(tilt >= rad(10.0) - 1e-9 && tilt <= rad(30.0) + 1e-9),
                    TurnedAxes::Tilt => assert!(tilt <= rad(20.0) + 1e-12),
                }
                let radius = match turned {
                    TurnedAxes::Tilt => (step.tip + Vec3::new(0.0, 0.0, 60.0)).norm(),
                    _ => step.tip.norm(),
                };
                assert!((radius - 60.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_fixed_tip_does_not_move() {
        let piece = fixed_tip(40.0, 20.0, 100, 500.0).expect("a piece");
        assert!(
            piece.moves[1..102]
                .iter()
                .all(|step| step.tip == Vec3::new(40.0, 0.0, 0.0))
        );
        assert!((angle_between(&piece.moves[101].axis, &Vec3::z()) - rad(10.0)).abs() < 1e-12);
        assert!(fixed_tip(40.0, 0.0, 100, 500.0).is_err());
    }
}
