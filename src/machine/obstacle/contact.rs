//! Proof that a tool at one place touches an obstacle, or comes nearer than a distance: a point of the obstacle that is so near.
//!
//! Such points are found by going to and fro between the nearest points of the two bodies, which for convex bodies leads to a common point if there is
//! one (alternating projections; docs/kinematics.md#obstacles). What is found is measured: where the search ends does not matter for the proof.
use super::{Obstacle, SLACK_MM};
use crate::Pose;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::hypot;

/// Steps of one search.
const MOST_STEPS: usize = 12;

/// The searches aim at a body that is smaller by these shares of its radius: a common point on the surface alone would only be reached in the limit.
const SMALLER: [f64; 3] = [0.5, 0.1, 0.01];

/// A cylinder about the axis of the tool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solid {
    radius: f64,
    /// From the tip, mm.
    height: [f64; 2],
}

impl Solid {
    /// Radius and heights above the tip, mm.
    pub(super) fn new(radius: f64, height: [f64; 2]) -> Self {
        Self { radius, height }
    }

    /// Distance of a point from it, mm; inside negative: how deep.
    fn distance(&self, pose: &Pose, point: &Vec3) -> f64 {
        let (along, across) = split(pose, point);
        let aside = across.norm() - self.radius;
        let beyond = (self.height[0] - along).max(along - self.height[1]);
        if aside <= 0.0 && beyond <= 0.0 {
            aside.max(beyond)
        } else {
            hypot(aside.max(0.0), beyond.max(0.0))
        }
    }

    /// Its point nearest to another point, where it is smaller by this length on all sides.
    fn nearest(&self, pose: &Pose, point: &Vec3, by: f64) -> Vec3 {
        let (along, across) = split(pose, point);
        let [low, high] = self.height;
        let middle = f64::midpoint(low, high);
        let along = along.clamp((low + by).min(middle), (high - by).max(middle));
        let radius = (self.radius - by).max(0.0);
        let far = across.norm();
        let across = if far > radius { across * (radius / far) } else { across };
        pose.tip + pose.axis * along + across
    }
}

/// The height of a point above the tip, mm, and the rest of the way to it, at right angles to the axis.
fn split(pose: &Pose, point: &Vec3) -> (f64, Vec3) {
    let arm = point - pose.tip;
    let along = arm.dot(&pose.axis);
    (along, arm - pose.axis * along)
}

/// Whether one of the cylinders is proved to be nearer to the obstacle than `keep` (mm; 0: to enter it). The search begins at this height (mm) of the axis.
pub(super) fn comes_closer(obstacle: &Obstacle, pose: &Pose, solids: &[Solid], height: f64, keep: f64) -> bool {
    solids.iter().any(|solid| {
        SMALLER.iter().any(|share| {
            let by = share * solid.radius;
            let height = height.clamp(solid.height[0], solid.height[1]);
            let mut own = pose.tip + pose.axis * height;
            for _ in 0..MOST_STEPS {
                // a tool without radius that runs inside
                if obstacle_depth(obstacle, &own) > SLACK_MM {
                    return true;
                }
                let other = nearest(obstacle, &own);
                if solid.distance(pose, &other) < keep - SLACK_MM {
                    return true;
                }
                let next = solid.nearest(pose, &other, by);
                if (next - own).norm() <= SLACK_MM {
                    break;
                }
                own = next;
            }
            false
        })
    })
}

/// How deep a point of the tool is inside the obstacle, mm; 0 outside.
fn obstacle_depth(obstacle: &Obstacle, point: &Vec3) -> f64 {
    let upright = (point.z - obstacle.bottom).min(obstacle.top - point.z);
    upright.min(obstacle.footprint.depth(&point.xy())).max(0.0)
}

/// The point of the obstacle nearest to another point, mm; inside that point.
fn nearest(obstacle: &Obstacle, point: &Vec3) -> Vec3 {
    let flat = obstacle.footprint.nearest(&point.xy());
    Vec3::new(flat.x, flat.y, point.z.clamp(obstacle.bottom, obstacle.top))
}

/// Distance of a point from an obstacle, mm; 0 inside.
pub(super) fn distance(obstacle: &Obstacle, point: &Vec3) -> f64 {
    let flat = obstacle.footprint.distance(&point.xy());
    let beyond = (obstacle.bottom - point.z).max(point.z - obstacle.top).max(0.0);
    hypot(flat, beyond)
}
