//! The compensated plane: points as (first, second) coordinate, XY or ZX, and the shift of a turning tool's edge.
use crate::{Plane, Pose, State};
use trunnion_geometry::math;

/// First and second coordinate in the plane.
pub(super) type Point = [f64; 2];

/// Places of the plane's first and second coordinate and of its axis in a pose. G17 and G18 are the only planes.
pub(super) fn places(plane: Plane) -> [usize; 3] {
    if plane == Plane::Xz { [2, 0, 1] } else { [0, 1, 2] }
}

/// The plane's point of a pose.
pub(super) fn point(plane: Plane, pose: &Pose) -> Point {
    let [first, second, _] = places(plane);
    [pose[first], pose[second]]
}

/// The pose with another point.
pub(super) fn with_point(plane: Plane, mut pose: Pose, point: Point) -> Pose {
    let [first, second, _] = places(plane);
    [pose[first], pose[second]] = point;
    pose
}

/// From the centre of a turning tool's edge to its tip as it is programmed, in radii: orientations 1-8 as LinuxCNC draws them, Z then X.
const EDGES: [Point; 10] = [
    [0.0, 0.0],
    [1.0, -1.0],
    [-1.0, -1.0],
    [-1.0, 1.0],
    [1.0, 1.0],
    [1.0, 0.0],
    [0.0, -1.0],
    [-1.0, 0.0],
    [0.0, 1.0],
    [0.0, 0.0],
];

/// What is added to the centre's path before it is sent to the machine.
pub(super) fn shift(state: &State) -> Point {
    let edge = usize::try_from(state.orientation)
        .ok()
        .and_then(|edge| EDGES.get(edge))
        .unwrap_or(&EDGES[0]);
    [edge[0] * state.radius, edge[1] * state.radius]
}

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn scaled(a: Point, factor: f64) -> Point {
    [a[0] * factor, a[1] * factor]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn length(a: Point) -> f64 {
    math::hypot(a[0], a[1])
}

/// Turned by a right angle counter-clockwise.
pub(super) fn left_of(a: Point) -> Point {
    [-a[1], a[0]]
}

pub(super) fn unit(a: Point) -> Point {
    scaled(a, 1.0 / length(a))
}

/// Angle from `from` to `to`, rad, counter-clockwise, from 0 to below a full turn.
pub(super) fn turn(from: Point, to: Point) -> f64 {
    let angle = math::atan2(from[0] * to[1] - from[1] * to[0], dot(from, to));
    if angle < 0.0 {
        angle + std::f64::consts::TAU
    } else {
        angle
    }
}
