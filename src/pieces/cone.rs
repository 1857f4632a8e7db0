//! The cone frustum: the tool axis sweeps a cone about a tilted axis. Every number of its machine motion is known in closed form.
use crate::piece::{Piece, PieceError, Tool, count, within};
use core::f64::consts::TAU;
use trunnion_geometry::math::{asin, cos, rotate, sin, sin_cos};
use trunnion_geometry::{Vec3, deg, rad};

/// Sizes of a cone frustum whose wall is milled with the flank of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Angle between wall and cone axis, deg.
    pub half_angle_deg: f64,
    /// Angle between cone axis and +Z, deg.
    pub tilt_deg: f64,
    /// Radius of the wall at the height of the tool tip, mm.
    pub radius: f64,
    /// Diameter of the tool, mm.
    pub tool_diameter: f64,
    /// Blocks of one turn.
    pub segments: usize,
    /// mm/min.
    pub feed_mm_min: f64,
}

/// The motion of a machine with one rotary axis along Z and one that tilts at right angles to it (tilt A or B, turn C) on a cone frustum.
/// th = half angle, ph = tilt, psi = angle along the tip circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConeAnswers {
    /// Smallest and largest tilt, deg: |th - ph| and th + ph.
    pub tilt_deg: [f64; 2],
    /// What C travels from its lowest to its highest value, deg: 360 for th > ph, else 2 asin(sin th / sin ph); 180 for th = ph, where
    /// the jump at the pole makes up the other half.
    pub travel_deg: f64,
    /// Largest |dC/dpsi|: sin th / |sin(th - ph)|; infinite for th = ph.
    pub rate_max: f64,
    /// Smallest |dC/dpsi|: 0 for th < ph, where C turns back twice; else where cos A = (cos ph - sqrt(cos2 ph - cos2 th)) / cos th, if the
    /// tilt reaches it, else at the largest tilt.
    pub rate_min: f64,
    /// |dC/dpsi| where the tilt is largest: sin th / sin(th + ph).
    pub rate_far: f64,
    /// Whether C turns one full turn with each turn of the path.
    pub winds: bool,
    /// Radius of the tip circle, mm.
    pub tip_radius: f64,
}

impl ConeAnswers {
    /// The highest feed of the tip, mm/min, at which C stays below `speed` rad/s everywhere: w R / (dC/dpsi).
    pub fn feed_limit_mm_min(&self, speed: f64) -> f64 {
        60.0 * speed * self.tip_radius / self.rate_max
    }
}

/// The smallest |dC/dpsi| for th >= ph where it is inside the range of the tilt: with A the tilt, dC/dpsi = (cos ph - cos th cos A) / sin2 A,
/// whose derivative by cos A is zero for cos th cos2 A - 2 cos ph cos A + cos th = 0; there it is cos th / (2 cos A).
fn slowest(th: f64, ph: f64) -> Option<f64> {
    let (p, t) = (cos(ph), cos(th));
    let c = (p - ((p - t).max(0.0) * (p + t)).sqrt()) / t;
    (c > cos(th + ph)).then(|| t / (2.0 * c))
}

impl Cone {
    /// The answers. Source: the tool axis makes the angle th with the cone axis, which makes ph with Z; spherical trigonometry.
    pub fn answers(&self) -> ConeAnswers {
        let (th, ph) = (rad(self.half_angle_deg), rad(self.tilt_deg));
        let near = sin(th - ph).abs();
        let far = sin(th) / sin(th + ph);
        let (winds, through) = (th > ph, th == ph);
        ConeAnswers {
            tilt_deg: [
                (self.half_angle_deg - self.tilt_deg).abs(),
                self.half_angle_deg + self.tilt_deg,
            ],
            travel_deg: if winds {
                360.0
            } else if through {
                180.0
            } else {
                2.0 * deg(asin(sin(th) / sin(ph)))
            },
            rate_max: if through { f64::INFINITY } else { sin(th) / near },
            rate_min: if th >= ph { slowest(th, ph).unwrap_or(far) } else { 0.0 },
            rate_far: far,
            winds,
            tip_radius: self.tip_radius(),
        }
    }

    /// The tool's flank touches the wall: the tip is off the wall by the tool's radius along the wall's normal.
    fn tip_radius(&self) -> f64 {
        self.radius + 0.5 * self.tool_diameter * sin_cos(rad(self.half_angle_deg)).1
    }

    /// Tip and tool axis at the angle `psi`, rad; at 0 the tilt is largest.
    pub fn at(&self, psi: f64) -> (Vec3, Vec3) {
        let (sin_half, cos_half) = sin_cos(rad(self.half_angle_deg));
        let cone_axis = rotate(&Vec3::x(), rad(self.tilt_deg), &Vec3::z());
        // the wall leans to the cone's axis; at psi = 0 it leans in the direction of the axis
        let out = rotate(&cone_axis, psi, &rotate(&Vec3::x(), rad(self.tilt_deg), &Vec3::y()));
        let axis = cone_axis * cos_half - out * sin_half;
        let lift = 0.5 * self.tool_diameter * sin_half;
        (out * self.tip_radius() + cone_axis * lift, axis.normalize())
    }
}

/// One turn around the frustum in equal blocks.
///
/// # Errors
/// Angles or counts that give no cone.
pub fn cone(sizes: &Cone) -> Result<Piece, PieceError> {
    let half = within("half angle", sizes.half_angle_deg, 1.0, 80.0, "deg")?;
    let tilt = within("tilt", sizes.tilt_deg, 0.0, 80.0, "deg")?;
    within("half angle + tilt", half + tilt, 1.0, 120.0, "deg")?;
    within("radius", sizes.radius, 0.1, 10_000.0, "mm")?;
    within("tool diameter", sizes.tool_diameter, 0.0, 1_000.0, "mm")?;
    within("feed", sizes.feed_mm_min, 0.001, 1e6, "mm/min")?;
    let segments = count("segments", sizes.segments, 3, 5_000_000)?;
    let points: Vec<(Vec3, Vec3)> = (0..=segments)
        .map(|i| sizes.at(TAU * i as f64 / segments as f64))
        .collect();
    let title = format!(
        "cone {half} deg tilted {tilt} deg, wall radius {} mm, {segments} blocks",
        sizes.radius
    );
    let tool = Tool {
        diameter: sizes.tool_diameter,
        ball: false,
    };
    Ok(Piece::along("cone", title, sizes.feed_mm_min, tool, &points))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;
    use trunnion_geometry::math::{angle_between, atan2};

    fn sizes(half_angle_deg: f64, tilt_deg: f64) -> Cone {
        Cone {
            half_angle_deg,
            tilt_deg,
            radius: 80.0,
            tool_diameter: 20.0,
            segments: 3600,
            feed_mm_min: 500.0,
        }
    }

    /// The published family: tilt range, travel of C, largest and smallest rate.
    #[test]
    fn the_family_has_its_numbers() {
        let rows = [
            (15.0, 10.0, [5.0, 25.0], 360.0, 2.9696, 0.6124),
            (15.0, 30.0, [15.0, 45.0], 62.3479, 1.0, 0.0),
            (45.0, 30.0, [15.0, 75.0], 360.0, 2.7321, 0.6830),
            (15.0, 14.9, [0.1, 29.9], 360.0, 148.29, 0.4979),
            (15.0, 15.1, [0.1, 30.1], 166.958, 148.29, 0.0),
        ];
        for (half, tilt, range, travel, most, least) in rows {
            let found = sizes(half, tilt).answers();
            for (a, b) in found.tilt_deg.iter().zip(range) {
                assert!((a - b).abs() < 1e-9, "{half}/{tilt}: {found:?}");
            }
            assert!((found.travel_deg - travel).abs() < 1e-3, "{half}/{tilt}: {found:?}");
            assert!((found.rate_max / most - 1.0).abs() < 1e-4, "{half}/{tilt}: {found:?}");
            assert!((found.rate_min - least).abs() < 1e-4, "{half}/{tilt}: {found:?}");
        }
        let through = sizes(15.0, 15.0).answers();
        assert_eq!((through.rate_max, through.travel_deg), (f64::INFINITY, 180.0));
        let far = sizes(15.0, 30.0).answers().rate_far;
        assert!((far - 0.3660).abs() < 1e-4, "{far}");
    }

    /// The answers against the points themselves, in fine steps.
    #[test]
    fn the_answers_are_those_of_the_points() {
        for (half, tilt) in [(15.0, 10.0), (15.0, 30.0), (45.0, 30.0), (20.0, 14.0)] {
            let cone = sizes(half, tilt);
            let steps = 20_000;
            let (mut low, mut high, mut tilts) = (0.0_f64, 0.0_f64, [f64::MAX, 0.0_f64]);
            let (mut fastest, mut slowest) = (0.0_f64, f64::MAX);
            let (mut turned, mut before) = (0.0, None);
            for i in 0..=steps {
                let (tip, axis) = cone.at(TAU * f64::from(i) / f64::from(steps));
                assert!((axis.norm() - 1.0).abs() < 1e-14);
                assert!(
                    (tip.norm_squared() - cone.tip_radius().powi(2) - (10.0 * sin(rad(half))).powi(2)).abs() < 1e-9
                );
                let angle = angle_between(&axis, &Vec3::z());
                tilts = [tilts[0].min(deg(angle)), tilts[1].max(deg(angle))];
                let c = atan2(axis.x, -axis.y);
                if let Some(last) = before {
                    let step: f64 = c - last;
                    let step = step - TAU * (step / TAU).round();
                    turned += step;
                    fastest = fastest.max(step.abs() * f64::from(steps) / TAU);
                    slowest = slowest.min(step.abs() * f64::from(steps) / TAU);
                }
                before = Some(c);
                (low, high) = (low.min(turned), high.max(turned));
            }
            let answers = cone.answers();
            assert!((deg(high - low) - answers.travel_deg).abs() < 1e-3, "{half}/{tilt}");
            assert!(
                (fastest / answers.rate_max - 1.0).abs() < 1e-4,
                "{half}/{tilt}: {fastest}"
            );
            assert!((slowest - answers.rate_min).abs() < 2e-3, "{half}/{tilt}: {slowest}");
            assert!((tilts[0] - answers.tilt_deg[0]).abs() < 1e-4 && (tilts[1] - answers.tilt_deg[1]).abs() < 1e-4);
            assert_eq!(answers.winds, (deg(turned).abs() - 360.0).abs() < 1e-6, "{half}/{tilt}");
        }
    }

    #[test]
    fn the_piece_closes_and_refuses_what_is_no_cone() {
        let piece = cone(&sizes(15.0, 10.0)).expect("a piece");
        assert_eq!(piece.moves.len(), 3603);
        let (first, last) = (piece.moves[1], piece.moves[3601]);
        assert!((first.tip - last.tip).norm() < 1e-9 && (first.axis - last.axis).norm() < 1e-12);
        for bad in [
            sizes(0.0, 10.0),
            sizes(15.0, 100.0),
            Cone {
                segments: 2,
                ..sizes(15.0, 10.0)
            },
        ] {
            assert!(cone(&bad).is_err());
        }
        let limit = sizes(15.0, 10.0).answers().feed_limit_mm_min(PI);
        assert!(
            (limit - 60.0 * PI * (80.0 + 10.0 * 0.965_925_826) / 2.969_6).abs() < 0.2,
            "{limit}"
        );
    }
}
