//! Obstacles: upright prisms and cylinders that a tool must not touch, and whether it does in a motion.
//!
//! Coordinates are those of the frame that an obstacle moves with, which at home is the machine frame. With `axis` it is the body that this axis
//! moves. Without, it is the body that carries the workpiece, but does not turn: it stands between the rotary axes of the table and the linear axes.
mod column;
mod contact;
mod frame;
mod level;
mod space;
mod sweep;
mod verdict;

pub use column::{SLACK_MM, ToolBody, column_distance, corridor_distance};
pub use frame::{linear_steps, tool_in_frame};
pub use level::{Across, TravelLevel};
pub use space::{NoRoute, Space};
pub use verdict::{Near, Nearness, nearness, nearness_with_part};

use crate::{AxisKind, Machine, Side};
use trunnion_geometry::plane::{Point, Polygon};

/// The outline of an obstacle, seen from above.
#[derive(Clone, Debug, PartialEq)]
pub enum Footprint {
    /// A polygon, convex or not.
    Polygon(Polygon),
    /// A circle.
    Circle {
        /// mm.
        centre: Point,
        /// mm.
        radius: f64,
    },
}

impl Footprint {
    /// Lowest and highest coordinates, mm.
    pub fn extent(&self) -> [Point; 2] {
        match self {
            Self::Polygon(polygon) => polygon.extent(),
            Self::Circle { centre, radius } => [-1.0, 1.0].map(|side| centre + Point::repeat(side * radius)),
        }
    }

    /// Distance of a segment from it, mm; 0 where they touch or cross.
    pub fn segment_distance(&self, from: &Point, to: &Point) -> f64 {
        match self {
            Self::Polygon(polygon) => polygon.segment_distance(from, to),
            Self::Circle { centre, radius } => {
                (trunnion_geometry::plane::point_distance(centre, from, to) - radius).max(0.0)
            }
        }
    }

    /// Distance of a point from it, mm; 0 inside.
    pub fn distance(&self, point: &Point) -> f64 {
        match self {
            Self::Polygon(polygon) => polygon.distance(point),
            Self::Circle { centre, radius } => ((point - centre).norm() - radius).max(0.0),
        }
    }

    /// Its point nearest to another point; inside that point.
    pub fn nearest(&self, point: &Point) -> Point {
        match self {
            Self::Polygon(polygon) if polygon.contains(point) => *point,
            Self::Polygon(polygon) => polygon.nearest_on_rim(point),
            Self::Circle { centre, radius } => {
                let arm = point - centre;
                let far = arm.norm();
                if far > *radius {
                    centre + arm * (radius / far)
                } else {
                    *point
                }
            }
        }
    }

    /// How far a point inside is from the rim, mm; 0 outside.
    pub fn depth(&self, point: &Point) -> f64 {
        match self {
            Self::Polygon(polygon) if polygon.contains(point) => (polygon.nearest_on_rim(point) - point).norm(),
            Self::Polygon(_) => 0.0,
            Self::Circle { centre, radius } => (radius - (point - centre).norm()).max(0.0),
        }
    }
}

/// An obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// For people.
    pub name: String,
    /// Letter of the axis that it moves with; see the module for `None`.
    pub axis: Option<u8>,
    /// From above.
    pub footprint: Footprint,
    /// Lower end, mm.
    pub bottom: f64,
    /// Upper end, mm.
    pub top: f64,
    /// What it is.
    pub kind: ObstacleKind,
}

/// What an obstacle is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ObstacleKind {
    /// A body that the tool must not touch.
    #[default]
    Body,
    /// The part, or what it is made from: the tool cuts it. Only a tool that turns in the air, or takes a new path at rapid, must keep clear
    /// of it ([`nearness_with_part`]).
    Part,
}

/// The obstacles of a machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Obstacles(pub Vec<Obstacle>);

impl core::ops::Deref for Obstacles {
    type Target = Vec<Obstacle>;
    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl Obstacles {
    /// Whether no body is declared that the tool must not touch.
    pub fn only_parts(&self) -> bool {
        self.0.iter().all(Obstacle::is_part)
    }
}

impl Obstacle {
    /// One line for people.
    pub fn in_words(&self) -> String {
        let shape = match &self.footprint {
            Footprint::Polygon(polygon) => format!("a prism with {} sides", polygon.corners().len()),
            Footprint::Circle { centre, radius } => {
                format!("a cylinder of radius {radius} mm about X{} Y{}", centre.x, centre.y)
            }
        };
        let moves = self
            .axis
            .map_or(String::new(), |axis| format!(", moves with {}", char::from(axis)));
        format!(
            "{} {}: {shape}, Z {} to {} mm{moves}",
            if self.is_part() { "part" } else { "obstacle" },
            self.name,
            self.bottom,
            self.top
        )
    }

    /// Whether it is what the tool cuts.
    pub fn is_part(&self) -> bool {
        self.kind == ObstacleKind::Part
    }

    /// The frame that it moves with: how many axes of the chain, counted from the workpiece, lie between the workpiece and it. `None` where the
    /// machine has no such axis.
    pub fn frame(&self, machine: &Machine) -> Option<usize> {
        let turns = |axis: &crate::Axis| axis.kind == AxisKind::Rotary && axis.side == Side::Table;
        match self.axis {
            None => Some(machine.axes.iter().rposition(turns).map_or(0, |last| last + 1)),
            Some(letter) => {
                let joint = machine.joint(letter)?;
                Some(joint + usize::from(machine.axes[joint].side == Side::Head))
            }
        }
    }
}
