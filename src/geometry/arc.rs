//! Circular and helical arcs in space.
use crate::Vec3;

/// A circular, spiral or helical arc from `start` to `end` about `centre`, seen with `normal` pointing to the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Start point, mm.
    pub start: Vec3,
    /// End point, mm.
    pub end: Vec3,
    /// Centre at the height of the start, mm.
    pub centre: Vec3,
    /// Unit normal of the arc's plane.
    pub normal: Vec3,
    /// Signed sweep about `normal`, rad (counter-clockwise positive; more than one turn possible).
    pub sweep: f64,
    /// Distance of the start from the centre in the plane, mm.
    pub radius_start: f64,
    /// Distance of the end from the centre in the plane, mm.
    pub radius_end: f64,
}
