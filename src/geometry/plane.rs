//! The plane: polygons, barriers around them, and the shortest route between two points that crosses none.
mod barrier;
mod cover;
mod polygon;
mod route;

pub use barrier::{MITRE_LIMIT, barrier};
pub use cover::Cover;
pub use polygon::{Polygon, PolygonFault, point_distance, segment_distance};
pub use route::{Route, cheapest_route, shortest_route};

/// A point or vector of the plane, mm.
pub type Point = nalgebra::Vector2<f64>;

/// Twice the area of the triangle from the origin, positive where `b` is to the left of `a`.
pub(crate) fn cross(a: &Point, b: &Point) -> f64 {
    a.x * b.y - a.y * b.x
}
