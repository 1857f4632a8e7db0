//! The axis behind the position loop: from a commanded speed that is held to a position, in closed form.
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::exp;

/// How an axis answers a commanded speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plant {
    /// At once: P' = u.
    First,
    /// Through a velocity loop with proportional and integral gain, Kvp = w and Kvi = w^2/4 with w = 2 pi times the bandwidth:
    /// v' = Kvp (u - v) + Kvi z, z' = u - v, P' = v.
    Third {
        /// Bandwidth of the velocity loop, Hz.
        bandwidth_hz: f64,
    },
}

/// Position, and speed and integral of the velocity loop, of three axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) position: Vec3,
    pub(crate) velocity: Vec3,
    pub(crate) integral: Vec3,
}

impl Plant {
    /// The state after `h` s in which the commanded speed `u` is held. Exact: with y = v - u the velocity loop is z' = -y, (D + w/2)^2 z = 0,
    /// so z = (c0 + c1 t) exp(-w t / 2), and the position is the integral of u + y = u - z'.
    pub(crate) fn after(&self, state: &State, u: &Vec3, h: f64) -> State {
        match self {
            Self::First => State {
                position: state.position + u * h,
                velocity: *u,
                integral: Vec3::zeros(),
            },
            Self::Third { bandwidth_hz } => {
                let half = PI * bandwidth_hz;
                let fading = exp(-half * h);
                let c1 = (u - state.velocity) + state.integral * half;
                let integral = (state.integral + c1 * h) * fading;
                let velocity = u + integral * half - c1 * fading;
                State {
                    position: state.position + u * h + state.integral - integral,
                    velocity,
                    integral,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against many small explicit steps of the differential equation.
    #[test]
    fn held_speed_is_integrated_exactly() {
        let plant = Plant::Third { bandwidth_hz: 60.0 };
        let w = 2.0 * PI * 60.0;
        let u = Vec3::new(3.0, -1.0, 0.5);
        let start = State {
            position: Vec3::new(0.1, 0.2, 0.3),
            velocity: Vec3::new(-2.0, 5.0, 0.0),
            integral: Vec3::new(0.01, -0.02, 0.003),
        };
        let exact = plant.after(&start, &u, 1e-3);
        let mut own = start;
        let n = 200_000;
        let h = 1e-3 / f64::from(n);
        for _ in 0..n {
            let z = u - own.velocity;
            let middle = own.velocity + (z * w + own.integral * (w * w / 4.0)) * (h / 2.0);
            let integral = own.integral + z * (h / 2.0);
            own.position += middle * h;
            own.velocity += ((u - middle) * w + integral * (w * w / 4.0)) * h;
            own.integral += (u - middle) * h;
        }
        assert!((own.position - exact.position).norm() < 1e-9);
        assert!((own.velocity - exact.velocity).norm() < 1e-7);
        assert!((own.integral - exact.integral).norm() < 1e-10);
    }
}
