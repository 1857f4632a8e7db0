//! The space in which the tip of an upright tool moves while the rotary axes stand still, with the obstacles in it, and the cheapest way through it.
//!
//! At one height only the obstacles count whose top, with the clearance, is above it: each becomes its control barrier in the plane. The higher, the
//! fewer. So the cheapest way rises at once to the best height, goes round what is still in the way there, and comes down at its end.
use super::column::column_distance;
use super::{Footprint, Obstacle, SLACK_MM, ToolBody, tool_in_frame};
use crate::{Joints, Machine, RapidPath};
use trunnion_geometry::plane::{Cover, Point, Polygon, barrier, cheapest_route};
use trunnion_geometry::{Mat3, Vec3};

/// Directions that differ by no more are parallel.
const PARALLEL: f64 = 1e-9;

/// A circle is replaced by a polygon about it that is at most this much larger, mm.
const SAG_MM: f64 = 0.005;

/// Beyond this many points, routes for axes that do not arrive together turn at corners only.
const MOST_CROSSINGS: usize = 48;

/// See the module. Coordinates are those of the frame of the machine's first obstacle.
#[derive(Clone, Debug)]
pub struct Space {
    frame: usize,
    tool_length: f64,
    /// In this frame.
    obstacles: Vec<Obstacle>,
    body: ToolBody,
    keep: f64,
    independent: bool,
}

/// Why there is no route.
#[derive(Clone, Debug, PartialEq)]
pub enum NoRoute {
    /// The tool is inside the clearance of this obstacle (its index) at an end: the start (0) or the end (1).
    EndInside(usize, usize),
    /// What is in the way reaches round an end, or higher than the axes do.
    Enclosed,
}

impl Space {
    /// At a position of the machine, without the part; `Err`: the tool is not upright among the obstacles, or they move against each other (why, for
    /// people).
    ///
    /// # Errors
    /// Why no space is known.
    pub fn new(
        machine: &Machine,
        joints: &Joints,
        tool_length: f64,
        body: &ToolBody,
        keep: f64,
    ) -> Result<Self, String> {
        Self::of(machine, joints, (tool_length, body, keep), |obstacle| {
            !obstacle.is_part()
        })
    }

    /// [`Self::new`] with the part: nothing goes sideways through it, and the tool may rise and come down in it.
    ///
    /// # Errors
    /// Why no space is known.
    pub fn with_part(
        machine: &Machine,
        joints: &Joints,
        tool_length: f64,
        body: &ToolBody,
        keep: f64,
    ) -> Result<Self, String> {
        Self::of(machine, joints, (tool_length, body, keep), |_| true)
    }

    fn of(
        machine: &Machine,
        joints: &Joints,
        (tool_length, body, keep): (f64, &ToolBody, f64),
        counts: impl Fn(&Obstacle) -> bool,
    ) -> Result<Self, String> {
        let first = machine
            .obstacles
            .iter()
            .find(|obstacle| !obstacle.is_part())
            .ok_or("no obstacle is declared: [[obstacle]] in trunnion.toml or in the machine file")?;
        let frame_of = |obstacle: &Obstacle| {
            let missing = || format!("the machine lacks the axis that {} moves with", obstacle.name);
            obstacle.frame(machine).ok_or_else(missing)
        };
        let frame = frame_of(first)?;
        let length = body.length_mm.unwrap_or(tool_length);
        let (own, place) = axes_in(machine, joints, length, frame);
        let inverse = own
            .try_inverse()
            .ok_or_else(|| format!("{} moves with a linear axis", first.name))?;
        let mut obstacles = Vec::new();
        for obstacle in machine.obstacles.iter().filter(|obstacle| counts(obstacle)) {
            let other = frame_of(obstacle)?;
            let axis = tool_in_frame(machine, joints, length, other).axis;
            if (axis - Vec3::z()).norm() > PARALLEL {
                return Err(format!("the tool is tilted against {}", obstacle.name));
            }
            let (theirs, there) = axes_in(machine, joints, length, other);
            // from this frame to that of the obstacle, while the linear axes move
            let turn = theirs * inverse;
            let rigid = (turn.transpose() * turn - Mat3::identity()).norm() <= PARALLEL;
            let upright = (turn * Vec3::z() - Vec3::z()).norm() <= PARALLEL;
            if !rigid || !upright {
                return Err(format!("{} moves against {}", obstacle.name, first.name));
            }
            obstacles.push(carried(obstacle, &turn.transpose(), &place, &there));
        }
        Ok(Self {
            frame,
            tool_length: length,
            obstacles,
            body: *body,
            keep,
            independent: machine.control.rapid != RapidPath::Synchronous,
        })
    }

    /// The tip at a position of the machine, mm.
    pub fn tip(&self, machine: &Machine, joints: &Joints) -> Vec3 {
        tool_in_frame(machine, joints, self.tool_length, self.frame).tip
    }

    /// The obstacles in this space; in the order of the machine's.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// The barriers at a height: obstacle, distance to be kept from it by the axis of the tool, mm.
    fn barriers(&self, height: f64) -> impl Iterator<Item = (&Obstacle, f64)> {
        let columns = self.obstacles.iter().flat_map(move |obstacle| {
            let columns = self.body.columns();
            columns.map(move |(radius, above)| (obstacle, radius + self.keep, obstacle.top + self.keep - above))
        });
        columns
            .filter(move |(_, _, limit)| height < limit - SLACK_MM)
            .map(|(obstacle, by, _)| (obstacle, by))
    }

    /// What is in the way at a height: rings whose union the axis of the tool must not enter.
    pub fn rings(&self, height: f64) -> Vec<Vec<Point>> {
        self.barriers(height).flat_map(ring).collect()
    }

    /// The heights at which a way may run, not below this one: it, and just above each obstacle that is higher.
    pub fn heights(&self, lowest: f64) -> Vec<f64> {
        let tops = self.obstacles.iter().flat_map(|obstacle| {
            let columns = self.body.columns();
            columns.map(|(_, above)| obstacle.top + self.keep - above)
        });
        let mut heights: Vec<f64> = tops.filter(|top| *top > lowest + SLACK_MM).chain([lowest]).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup_by(|a, b| (*a - *b).abs() <= SLACK_MM);
        heights
    }

    /// The route at one height, and what it costs by the norm of its legs.
    ///
    /// # Errors
    /// Why there is none.
    pub fn route_at(
        &self,
        height: f64,
        (from, to): (&Point, &Point),
        norm: impl Fn(&Point) -> f64,
    ) -> Result<(Vec<Point>, f64), NoRoute> {
        let cover = Cover::new(self.rings(height));
        let further = if self.independent {
            crossings(&cover, from, to)
        } else {
            Vec::new()
        };
        let admits = |a: &Point, b: &Point| !self.independent || self.keeps_corridor(height, a, b);
        if let Some(route) = cheapest_route(&cover, (from, to), &further, norm, admits) {
            return Ok((route.points, route.length));
        }
        for (end, point) in [from, to].into_iter().enumerate() {
            if cover.encloses(point) {
                let inside = |obstacle: &Obstacle| {
                    self.barriers(height)
                        .any(|(other, by)| core::ptr::eq(other, obstacle) && other.footprint.distance(point) < by)
                };
                let which = self.obstacles.iter().position(inside);
                return Err(which.map_or(NoRoute::Enclosed, |which| NoRoute::EndInside(which, end)));
            }
        }
        Err(NoRoute::Enclosed)
    }

    /// The cheapest way between two places: straight up, past the obstacles at one height, straight down. `lowest`: it goes sideways no lower than
    /// this; `reaches`: whether the axes reach a height. With what it costs.
    ///
    /// # Errors
    /// Why there is none.
    pub fn way(
        &self,
        (from, to): (&Vec3, &Vec3),
        lowest: f64,
        cost: impl Fn(&Vec3) -> f64,
        reaches: impl Fn(f64) -> bool,
    ) -> Result<(Vec<Vec3>, f64), NoRoute> {
        let mut best: Option<(Vec<Vec3>, f64)> = None;
        let mut why = None;
        for (point, height, end) in [(from, from.z, 0), (to, to.z, 1)] {
            if !self.may_descend(&point.xy(), height) {
                let which = self.blocked_by(point, point);
                return Err(which.map_or(NoRoute::Enclosed, |which| NoRoute::EndInside(which, end)));
            }
        }
        for height in self.heights(from.z.max(to.z).max(lowest)) {
            let upright = cost(&Vec3::new(0.0, 0.0, height - from.z)) + cost(&Vec3::new(0.0, 0.0, to.z - height));
            let least = upright + cost(&(to - from).xy().push(0.0));
            if best.as_ref().is_some_and(|(_, known)| *known <= least) || !reaches(height) {
                continue;
            }
            match self.route_at(height, (&from.xy(), &to.xy()), |way| cost(&way.push(0.0))) {
                Ok((flat, across)) if best.as_ref().is_none_or(|(_, known)| upright + across < *known) => {
                    let level = flat.iter().map(|point| point.push(height));
                    let mut points: Vec<Vec3> = core::iter::once(*from).chain(level).chain([*to]).collect();
                    points.dedup_by(|a, b| (*a - *b).norm() <= SLACK_MM);
                    best = Some((points, upright + across));
                }
                Ok(_) => {}
                Err(no) => {
                    why.get_or_insert(no);
                }
            }
        }
        best.ok_or(why.unwrap_or(NoRoute::Enclosed))
    }

    /// What is in the way at a height, united.
    pub fn cover(&self, height: f64) -> Cover {
        Cover::new(self.rings(height))
    }

    /// Whether a level leg keeps its distance from everything, to the last digit.
    pub fn is_clear(&self, height: f64, from: &Point, to: &Point) -> bool {
        self.keeps(height, (from, to), |_| true) && (!self.independent || self.keeps_corridor(height, from, to))
    }

    /// Whether a straight level leg keeps its distance from the obstacles that count.
    fn keeps(&self, height: f64, (from, to): (&Point, &Point), counts: impl Fn(&Obstacle) -> bool) -> bool {
        let barriers = || self.barriers(height).filter(|(obstacle, _)| counts(obstacle));
        let straight = barriers()
            .all(|(obstacle, by)| by <= SLACK_MM || obstacle.footprint.segment_distance(from, to) >= by - SLACK_MM);
        // without a radius and a clearance a leg may touch, not enter
        let touches = barriers().any(|(_, by)| by <= SLACK_MM);
        let entered = || Cover::new(barriers().flat_map(ring).collect()).is_entered(from, to);
        straight && !(touches && entered())
    }

    /// Whether the tool may also pass the other corners of the box between two points.
    fn keeps_corridor(&self, height: f64, from: &Point, to: &Point) -> bool {
        let way = to - from;
        if way.x.abs() <= SLACK_MM || way.y.abs() <= SLACK_MM {
            return true;
        }
        let start = Vec3::new(from.x, from.y, height);
        let moves = [Vec3::new(way.x, 0.0, 0.0), Vec3::new(0.0, way.y, 0.0)];
        self.barriers(height).all(|(obstacle, by)| {
            super::corridor_distance(obstacle, &start, &moves, f64::INFINITY)
                .is_none_or(|distance| distance >= by - SLACK_MM)
        })
    }

    /// Whether the tool may move straight up or down at a point to a height, from any greater one. The part does not count.
    pub fn may_descend(&self, point: &Point, height: f64) -> bool {
        self.keeps(height, (point, point), |obstacle| !obstacle.is_part())
    }

    /// What the linear axes travel for a way of the tip in this space, with their joints, mm; `None` where they do not span it.
    pub fn travel(&self, machine: &Machine, joints: &Joints, way: &Vec3) -> Option<[(usize, f64); 3]> {
        let (columns, _) = axes_in(machine, joints, self.tool_length, self.frame);
        let travel = columns.try_inverse()? * way;
        let joint = |slot: usize| machine.constants.linear[machine.constants.solved[slot]].joint;
        Some([0, 1, 2].map(|slot| (joint(slot), travel[slot])))
    }

    /// Where 1 mm more in the words X, Y and Z moves the tip: words of the tip in the workpiece frame, or of the linear axes.
    pub fn directions(&self, machine: &Machine, joints: &Joints, of_tip: bool) -> Option<(Vec3, Vec3, Vec3)> {
        let (here, _) = axes_in(machine, joints, self.tool_length, self.frame);
        if of_tip {
            let (workpiece, _) = axes_in(machine, joints, self.tool_length, 0);
            let turn = here * workpiece.try_inverse()?;
            return Some((turn.column(0).into(), turn.column(1).into(), turn.column(2).into()));
        }
        let mut columns = [None; 3];
        for (slot, &index) in machine.constants.solved.iter().enumerate() {
            let axis = &machine.axes[machine.constants.linear[index].joint];
            let letter = b"XYZ".iter().position(|letter| *letter == axis.letter);
            let scale = if axis.extra.diameter { 0.5 } else { 1.0 };
            columns[letter?] = Some(Vec3::from(here.column(slot)) * scale);
        }
        Some((columns[0]?, columns[1]?, columns[2]?))
    }

    /// The first obstacle but the part that a straight line comes too near to, by its index.
    pub fn blocked_by(&self, from: &Vec3, to: &Vec3) -> Option<usize> {
        self.obstacles.iter().position(|obstacle| {
            let counts = !obstacle.is_part();
            counts
                && self.body.columns().any(|(radius, above)| {
                    let raise = Vec3::new(0.0, 0.0, above);
                    column_distance(obstacle, &(from + raise), &(to + raise), self.keep)
                        .is_some_and(|(distance, _)| distance < radius + self.keep - SLACK_MM)
                })
        })
    }
}

/// How the tip moves in a frame by the three solved linear axes, in columns, and where it is.
fn axes_in(machine: &Machine, joints: &Joints, tool_length: f64, frame: usize) -> (Mat3, Vec3) {
    let here = tool_in_frame(machine, joints, tool_length, frame).tip;
    let columns = machine.constants.solved.map(|index| {
        let mut moved = *joints;
        moved[machine.constants.linear[index].joint] += 1.0;
        tool_in_frame(machine, &moved, tool_length, frame).tip - here
    });
    (Mat3::from_columns(&columns), here)
}

/// An obstacle seen from another frame: turned, from where the tip is `there` to where it is `here`.
fn carried(obstacle: &Obstacle, turn: &Mat3, here: &Vec3, there: &Vec3) -> Obstacle {
    if *turn == Mat3::identity() && here == there {
        return obstacle.clone();
    }
    let place = |point: &Point| (turn * (Vec3::new(point.x, point.y, there.z) - there) + here).xy();
    let footprint = match &obstacle.footprint {
        Footprint::Polygon(polygon) => {
            let corners: Vec<Point> = polygon.corners().iter().map(place).collect();
            Polygon::new(&corners).map_or_else(|_| obstacle.footprint.clone(), Footprint::Polygon)
        }
        Footprint::Circle { centre, radius } => Footprint::Circle {
            centre: place(centre),
            radius: *radius,
        },
    };
    let lift = here.z - there.z;
    Obstacle {
        footprint,
        bottom: obstacle.bottom + lift,
        top: obstacle.top + lift,
        ..obstacle.clone()
    }
}

/// The ring that the axis of the tool must not enter, of an obstacle and the distance to be kept from it.
fn ring((obstacle, by): (&Obstacle, f64)) -> Vec<Vec<Point>> {
    match &obstacle.footprint {
        Footprint::Polygon(polygon) => barrier(polygon, by),
        Footprint::Circle { centre, radius } => vec![around(centre, radius + by)],
    }
}

/// A regular polygon about a circle.
fn around(centre: &Point, radius: f64) -> Vec<Point> {
    let mut count = 16_u32;
    let reach = |count: u32| radius / trunnion_geometry::math::cos(core::f64::consts::PI / f64::from(count));
    while count < 256 && reach(count) - radius > SAG_MM {
        count *= 2;
    }
    let corner = |index: u32| {
        let (sin, cos) = trunnion_geometry::math::sin_cos(core::f64::consts::TAU * f64::from(index) / f64::from(count));
        centre + Point::new(cos, sin) * reach(count)
    };
    (0..count).map(corner).collect()
}

/// Points at which axes that run one after the other may turn: every X with every Y of the corners and both ends.
fn crossings(cover: &Cover, from: &Point, to: &Point) -> Vec<Point> {
    let mut points = cover.turning_points();
    if points.len() > MOST_CROSSINGS {
        points.clear();
    }
    points.extend([*from, *to]);
    points
        .iter()
        .flat_map(|a| points.iter().map(|b| Point::new(a.x, b.y)))
        .collect()
}
