//! Floor 0: space without G-code. Lengths are mm, angles rad, unless a name says otherwise (`_deg`).
//!
//! It does not know programs, dialects or machines.
pub mod abreast;
pub mod along;
pub mod arc;
pub mod math;
pub mod plane;
pub mod spline;

/// A vector or point in three dimensions, mm where it is a length.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A rotation matrix or the linear part of a rigid motion.
pub type Mat3 = nalgebra::Matrix3<f64>;

/// Degrees to radians.
pub fn rad(deg: f64) -> f64 {
    deg * (core::f64::consts::PI / 180.0)
}

/// Radians to degrees.
pub fn deg(rad: f64) -> f64 {
    rad * (180.0 / core::f64::consts::PI)
}
