//! The lines behind the curve of a tool axis: circles of equal tilt and rays of equal turn.
use plotters::style::text_anchor::HPos;
use trunnion_geometry::deg;

/// The lines behind a curve: as many as the ranges show.
pub(crate) struct Net {
    pub(crate) x: [f64; 2],
    pub(crate) y: [f64; 2],
    /// Largest angle from the pole, rad.
    pub(crate) widest: f64,
    /// Between two circles, deg.
    pub(crate) step: f64,
    pub(crate) circles: u32,
    /// The pole is in the picture.
    pub(crate) near: bool,
}

impl Net {
    pub(crate) fn new(x: [f64; 2], y: [f64; 2]) -> Self {
        let corners = [(x[0], y[0]), (x[0], y[1]), (x[1], y[0]), (x[1], y[1])];
        let farthest = corners.iter().map(|(a, b)| (a * a + b * b).sqrt()).fold(0.0, f64::max);
        let widest = trunnion_geometry::math::asin(farthest.min(1.0));
        let step = nice(deg(widest) / 7.0);
        Self {
            x,
            y,
            widest,
            step,
            circles: (deg(widest) / step).floor().min(60.0) as u32,
            near: x[0] < 0.0 && x[1] > 0.0 && y[0] < 0.0 && y[1] > 0.0,
        }
    }
}

/// Where the label of a ray that ends in a place stands: outside of the circle that the picture ends with, where it shows it, and else on the ray.
pub(crate) fn beside_rim((x, y): (f64, f64)) -> ((f64, f64), HPos) {
    if trunnion_geometry::math::hypot(x, y) < 0.999 {
        return ((x, y), HPos::Center);
    }
    let side = match x {
        _ if x > 0.1 => HPos::Left,
        _ if x < -0.1 => HPos::Right,
        _ => HPos::Center,
    };
    ((1.03 * x, 1.03 * y), side)
}

/// A round number near a value.
fn nice(value: f64) -> f64 {
    const NICE: [f64; 13] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0];
    NICE.into_iter().find(|nice| *nice >= value).unwrap_or(30.0)
}
