//! An upright tool that moves in a straight line past an upright obstacle: exact distances.
//!
//! The tool is taken as a column from its tip upward without end, because the spindle follows it. So only the upper end of an obstacle matters, and
//! the part of the line on which the tip is lower than that.
use super::{Footprint, Obstacle};
use trunnion_geometry::Vec3;
use trunnion_geometry::plane::{Cover, Point, Polygon};
use trunnion_interp::Tool;

/// Rounding of numbers: distances are compared with this much room, mm.
pub const SLACK_MM: f64 = 1e-9;

/// What of a tool may touch something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolBody {
    /// Radius of the tool, mm.
    pub radius_mm: f64,
    /// Radius of the holder, and its height above the tip, mm.
    pub holder_mm: Option<(f64, f64)>,
    /// How far the tool reaches above its tip, mm; `None`: not declared.
    pub length_mm: Option<f64>,
}

impl ToolBody {
    /// Of what is declared about a tool; `None` where its diameter is not. A holder sits on a tool of declared length; on one without, it may begin at
    /// the tip.
    pub fn of(tool: &Tool) -> Option<Self> {
        let above = tool.length_mm.unwrap_or(0.0);
        Some(Self {
            radius_mm: 0.5 * tool.diameter_mm?,
            holder_mm: tool.holder_mm.map(|diameter| (0.5 * diameter, above)),
            length_mm: tool.length_mm,
        })
    }

    /// The columns that it consists of: radius, and height of the lower end above the tip, mm.
    pub fn columns(&self) -> impl Iterator<Item = (f64, f64)> {
        [(self.radius_mm, 0.0)].into_iter().chain(self.holder_mm)
    }

    /// The largest radius, mm.
    pub fn widest(&self) -> f64 {
        self.columns().map(|(radius, _)| radius).fold(0.0, f64::max)
    }
}

/// How near a column comes to an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gap {
    /// Horizontal distance of the column's surface from the obstacle, mm; 0 or less: they touch.
    pub mm: f64,
    /// The column enters the obstacle.
    pub through: bool,
}

/// Horizontal distance between an obstacle and the axis of a tool whose lower end moves in a straight line, on the part of the line that is lower
/// than the obstacle's top plus `keep` (mm); infinite where there is no such part. With the ends of that part.
pub fn column_distance(obstacle: &Obstacle, from: &Vec3, to: &Vec3, keep: f64) -> Option<(f64, [Point; 2])> {
    let (start, end) = low_part(from.z, to.z, obstacle.top + keep - SLACK_MM)?;
    let at = |share: f64| (from + (to - from) * share).xy();
    let ends = [at(start), at(end)];
    Some((obstacle.footprint.segment_distance(&ends[0], &ends[1]), ends))
}

/// The shares of a line between which its height is below a limit.
fn low_part(from: f64, to: f64, limit: f64) -> Option<(f64, f64)> {
    let crossing = || ((limit - from) / (to - from)).clamp(0.0, 1.0);
    match (from < limit, to < limit) {
        (true, true) => Some((0.0, 1.0)),
        (true, false) => Some((0.0, crossing())),
        (false, true) => Some((crossing(), 1.0)),
        (false, false) => None,
    }
}

/// The same for a tool whose axes each run by `moves` (mm, at most three) in any order and at any speeds, none of them back: all positions that it
/// may pass are in the box that the moves span.
pub fn corridor_distance(obstacle: &Obstacle, from: &Vec3, moves: &[Vec3], keep: f64) -> Option<f64> {
    let mut corners = vec![*from];
    for step in moves {
        let moved: Vec<Vec3> = corners.iter().map(|corner| corner + step).collect();
        corners.extend(moved);
    }
    let lowest = corners.iter().map(|corner| corner.z).fold(f64::INFINITY, f64::min);
    if lowest >= obstacle.top + keep - SLACK_MM {
        return None;
    }
    let hull = hull(corners.iter().map(Vec3::xy).collect());
    let sides = (0..hull.len()).map(|index| {
        obstacle
            .footprint
            .segment_distance(&hull[index], &hull[(index + 1) % hull.len()])
    });
    let distance = sides.fold(f64::INFINITY, f64::min);
    // the obstacle may lie inside the box
    let inner = match &obstacle.footprint {
        Footprint::Polygon(polygon) => polygon.corners()[0],
        Footprint::Circle { centre, .. } => *centre,
    };
    let holds = Polygon::new(&hull).is_ok_and(|hull| hull.contains(&inner));
    Some(if holds { 0.0 } else { distance })
}

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain); of points on a line its ends.
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup_by(|a, b| (*a - *b).norm() <= SLACK_MM * 1e-3);
    let half = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., before, last] = chain[..] {
                let (first, second) = (last - before, point - last);
                if first.x * second.y - first.y * second.x > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(*point);
        }
        chain
    };
    let (mut lower, mut upper) = (half(&mut points.iter()), half(&mut points.iter().rev()));
    lower.pop();
    upper.pop();
    lower.extend(upper);
    if lower.is_empty() { points } else { lower }
}

/// How near the columns of a tool come to an obstacle on a straight line; `None`: it stays above it. `all`: those of its frame, with itself.
pub(super) fn straight_gap<'o>(
    obstacle: &Obstacle,
    all: impl Fn() -> Vec<&'o Obstacle>,
    body: &ToolBody,
    (from, to): (&Vec3, &Vec3),
    keep: f64,
) -> Option<Gap> {
    let mut nearest: Option<Gap> = None;
    for (radius, above) in body.columns() {
        let raise = Vec3::new(0.0, 0.0, above);
        let Some((distance, [start, end])) = column_distance(obstacle, &(from + raise), &(to + raise), keep) else {
            continue;
        };
        let entered = || {
            // obstacles that are at least as high are one body with this one, so that nothing slips between two that touch
            let polygon = |other: &Obstacle| match &other.footprint {
                Footprint::Polygon(polygon) if other.top >= obstacle.top => Some(polygon.corners().to_vec()),
                _ => None,
            };
            match &obstacle.footprint {
                Footprint::Polygon(_) if distance <= SLACK_MM => {
                    Cover::new(all().into_iter().filter_map(polygon).collect()).is_entered(&start, &end)
                }
                Footprint::Polygon(_) => false,
                Footprint::Circle { centre, radius } => {
                    trunnion_geometry::plane::point_distance(centre, &start, &end) < radius - SLACK_MM
                }
            }
        };
        let through = if radius > SLACK_MM {
            distance < radius - SLACK_MM
        } else {
            entered()
        };
        let gap = Gap {
            mm: distance - radius,
            through,
        };
        if nearest.is_none_or(|known| gap.mm < known.mm || gap.through && !known.through) {
            nearest = Some(gap);
        }
    }
    nearest
}

/// The same for axes that run independently.
pub(super) fn corridor_gap(
    obstacle: &Obstacle,
    body: &ToolBody,
    (from, moves): (&Vec3, &[Vec3]),
    keep: f64,
) -> Option<Gap> {
    let gaps = body.columns().filter_map(|(radius, above)| {
        let distance = corridor_distance(obstacle, &(from + Vec3::new(0.0, 0.0, above)), moves, keep)?;
        Some(distance - radius)
    });
    let mm = gaps.fold(f64::INFINITY, f64::min);
    mm.is_finite().then_some(Gap { mm, through: false })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ObstacleKind;
    use core::cell::Cell;

    /// A tool with a width is judged against each obstacle alone, so that its effort does not grow with the square of their number.
    #[test]
    fn the_other_obstacles_are_asked_for_where_a_tool_without_width_touches() {
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(|[x, y]| Point::new(x, y));
        let obstacle = Obstacle {
            name: "clamp".to_owned(),
            axis: None,
            footprint: Footprint::Polygon(Polygon::new(&corners).expect("a square")),
            bottom: 0.0,
            top: 20.0,
            kind: ObstacleKind::Body,
        };
        let asked = Cell::new(0);
        let all = || {
            asked.set(asked.get() + 1);
            vec![&obstacle]
        };
        let gap = |radius_mm: f64, y: f64| {
            let body = ToolBody {
                radius_mm,
                holder_mm: None,
                length_mm: None,
            };
            let ends = (&Vec3::new(-50.0, y, 5.0), &Vec3::new(50.0, y, 5.0));
            let through = straight_gap(&obstacle, all, &body, ends, 1.0).map(|gap| gap.through);
            (through, asked.replace(0))
        };
        assert_eq!(gap(4.0, 5.0), (Some(true), 0));
        assert_eq!(gap(4.0, 15.0), (Some(false), 0));
        assert_eq!(gap(0.0, 15.0), (Some(false), 0));
        assert_eq!(gap(0.0, 5.0), (Some(true), 1));
    }
}
