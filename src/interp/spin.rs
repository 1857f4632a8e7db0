//! Spindle speed under constant cutting speed (G96): n = v / (2 pi r), no higher than the limit of the program (G50 S, G92 S).
//!
//! r is the programmed X as a radius. Without a limit the speed near the axis of rotation is that of the machine, which is not known.
use crate::{ModalState, MotionKind, Position, Spin};
use core::f64::consts::TAU;

const X: usize = 0;

/// Pieces of an arc.
const PIECES: u32 = 64;

/// The spindle speed of a motion with what is in effect; `None`: no such speed, or not known. `radii`: X is a radius here.
pub(crate) fn spin(state: &ModalState, radii: bool, kind: MotionKind, [start, end]: [&Position; 2]) -> Option<Spin> {
    if !state.spindle.surface_speed() || !radii {
        return None;
    }
    let speed = state.spindle.cutting_speed_m_min().filter(|speed| *speed > 0.0)? * 1000.0;
    let limit = state.spindle.limit_rpm().filter(|limit| *limit > 0.0)?;
    let (from, to) = (start.get(X)?, end.get(X)?);
    // time of a turn, minutes, at this radius: 1 / n
    let turn = |radius: f64| (TAU * radius.abs() / speed).max(1.0 / limit);
    let (mean, nearest) = match kind {
        MotionKind::Linear | MotionKind::Rapid => (
            mean_turn(from, to, speed, limit),
            if from * to <= 0.0 {
                0.0
            } else {
                from.abs().min(to.abs())
            },
        ),
        MotionKind::Arc(Some(arc)) => {
            let radius = |i: u32| arc.point_at(f64::from(i) / f64::from(2 * PIECES)).x;
            // Simpson's rule
            let sum: f64 = (0..PIECES)
                .map(|i| turn(radius(2 * i)) + 4.0 * turn(radius(2 * i + 1)) + turn(radius(2 * i + 2)))
                .sum();
            let (low, high) = arc.extent(&trunnion_geometry::Vec3::x());
            let nearest = if low * high <= 0.0 {
                0.0
            } else {
                low.abs().min(high.abs())
            };
            (sum / f64::from(6 * PIECES), nearest)
        }
        MotionKind::Arc(None) | MotionKind::Dwell(_) | MotionKind::Unknown => return None,
    };
    Some(Spin {
        mean_rpm: 1.0 / mean,
        most_rpm: 1.0 / turn(nearest),
    })
}

/// The mean time of a turn along a line, exactly: it is a polygon over the radius, with corners where the limit begins and at the axis.
fn mean_turn(from: f64, to: f64, speed: f64, limit: f64) -> f64 {
    let turn = |radius: f64| (TAU * radius.abs() / speed).max(1.0 / limit);
    let way = to - from;
    if way == 0.0 {
        return turn(from);
    }
    let reached = speed / (TAU * limit);
    let mut places: Vec<f64> = [-reached, reached]
        .into_iter()
        .map(|radius| (radius - from) / way)
        .filter(|place| (0.0..1.0).contains(place))
        .collect();
    places.extend([0.0, 1.0]);
    places.sort_by(f64::total_cmp);
    places
        .windows(2)
        .map(|pair| (pair[1] - pair[0]) * (turn(from + way * pair[0]) + turn(from + way * pair[1])) / 2.0)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 / n = 2 pi r / v, integrated by hand from r = 10 to r = 30 at v = 60 m/min: 2 pi 20 / 60000.
    #[test]
    fn a_face_takes_the_time_of_its_mean_radius() {
        let mean = mean_turn(30.0, 10.0, 60_000.0, 5000.0);
        assert!((mean - TAU * 20.0 / 60_000.0).abs() < 1e-15);
    }

    /// Down to the axis the limit of 1000/min holds below r = 9.549: half of the way from 19.099 at 1 / 1000, the rest at the mean of
    /// 1 / 1000 and 1 / 500.
    #[test]
    fn near_the_axis_the_limit_counts() {
        let reached = 60_000.0 / (TAU * 1000.0);
        let mean = mean_turn(2.0 * reached, 0.0, 60_000.0, 1000.0);
        assert!((mean - f64::midpoint(0.001, 0.0015)).abs() < 1e-12);
        // past the axis the same again
        let through = mean_turn(2.0 * reached, -2.0 * reached, 60_000.0, 1000.0);
        assert!((through - mean).abs() < 1e-12);
    }
}
