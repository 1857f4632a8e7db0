//! Straight and round pieces of a contour in the ZX plane.
use trunnion_geometry::math;

/// A point: two coordinates, program units. As programmed: Z, X.
pub(super) type Point = [f64; 2];

/// The control takes points nearer than this as the same (program units).
pub(super) const NEAR: f64 = 1e-3;

pub(super) fn distance(a: Point, b: Point) -> f64 {
    math::hypot(a[0] - b[0], a[1] - b[1])
}

/// The cross product of two directions.
pub(super) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn unit(direction: Point) -> Point {
    let length = math::hypot(direction[0], direction[1]);
    [direction[0] / length, direction[1] / length]
}

/// Centre of an arc and its sense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Round {
    pub(super) centre: Point,
    /// From the first coordinate's axis to the second's.
    pub(super) positive: bool,
}

/// A piece of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) from: Point,
    pub(super) to: Point,
    /// `None`: a straight line.
    pub(super) round: Option<Round>,
}

impl Segment {
    pub(super) fn line(from: Point, to: Point) -> Self {
        Self { from, to, round: None }
    }
    pub(super) fn with_ends(self, from: Point, to: Point) -> Self {
        Self { from, to, ..self }
    }
    /// Radius at the start of an arc.
    pub(super) fn radius(&self) -> f64 {
        self.round.map_or(0.0, |round| distance(self.from, round.centre))
    }
    /// Its size: its chord, or the radius where that is less.
    pub(super) fn size(&self) -> f64 {
        let chord = distance(self.from, self.to);
        self.round.map_or(chord, |_| chord.min(self.radius()))
    }
    /// Direction of travel at a point of it, length 1.
    pub(super) fn direction(&self, at: Point) -> Point {
        match self.round {
            None => unit([self.to[0] - self.from[0], self.to[1] - self.from[1]]),
            Some(Round { centre, positive }) => {
                let out = unit([at[0] - centre[0], at[1] - centre[1]]);
                if positive { [-out[1], out[0]] } else { [out[1], -out[0]] }
            }
        }
    }
    /// How far along a point is: 0 at the start, 1 at the end; beyond for points outside. For arcs a share of the swept angle.
    pub(super) fn share(&self, point: Point) -> f64 {
        if self.round.is_none() {
            let way = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
            let gone = [point[0] - self.from[0], point[1] - self.from[1]];
            return (gone[0] * way[0] + gone[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
        }
        let sweep = self.swept(self.to);
        let mut gone = self.swept(point);
        // after the end, or before the start: what is nearer
        if gone > sweep && gone - sweep > std::f64::consts::PI - sweep / 2.0 {
            gone -= 2.0 * std::f64::consts::PI;
        }
        gone / sweep
    }
    /// Angle from the start to a point in the sense of the arc, rad, 0 to a full turn.
    fn swept(&self, point: Point) -> f64 {
        let Some(Round { centre, positive }) = self.round else {
            return 0.0;
        };
        let angle = |p: Point| math::atan2(p[1] - centre[1], p[0] - centre[0]);
        let turn = if positive {
            angle(point) - angle(self.from)
        } else {
            angle(self.from) - angle(point)
        };
        if turn < 0.0 {
            turn + 2.0 * std::f64::consts::PI
        } else {
            turn
        }
    }
    /// Shifted sideways by `offset` to the left of its direction; `None`: an arc that vanishes.
    pub(super) fn shifted(&self, offset: f64) -> Option<Self> {
        let move_out = |at: Point| {
            let way = self.direction(at);
            [at[0] - offset * way[1], at[1] + offset * way[0]]
        };
        if let Some(round) = self.round {
            let radius = if round.positive {
                self.radius() - offset
            } else {
                self.radius() + offset
            };
            if radius <= NEAR {
                return None;
            }
        }
        Some(self.with_ends(move_out(self.from), move_out(self.to)))
    }
    /// Where the whole lines or circles of two pieces meet: none, one or two points.
    pub(super) fn meets(&self, other: &Self) -> [Option<Point>; 2] {
        match (self.round, other.round) {
            (None, None) => {
                let (a, b) = (self.direction(self.from), other.direction(other.from));
                let turn = cross(a, b);
                if turn.abs() < 1e-9 {
                    return [None; 2];
                }
                let between = [other.from[0] - self.from[0], other.from[1] - self.from[1]];
                let way = cross(between, b) / turn;
                [Some([self.from[0] + way * a[0], self.from[1] + way * a[1]]), None]
            }
            (None, Some(round)) => line_circle(self, round.centre, other.radius()),
            (Some(round), None) => line_circle(other, round.centre, self.radius()),
            (Some(one), Some(two)) => circles(one.centre, self.radius(), two.centre, other.radius()),
        }
    }
    /// Whether it is an arc that goes there and back along a coordinate, to where it began.
    pub(super) fn turns_back(&self, place: usize) -> bool {
        let back = (self.to[place] - self.from[place]).abs() < NEAR;
        back && self.is_arc() && self.direction(self.from)[place] * self.direction(self.to)[place] < 0.0
    }
    /// Whether it is an arc.
    pub(super) fn is_arc(&self) -> bool {
        self.round.is_some()
    }
    /// An arc whose radii differ, or that has its lowest point (second coordinate) inside.
    pub(super) fn is_unclear(&self) -> bool {
        let Some(round) = self.round else { return false };
        let low = [round.centre[0], round.centre[1] - self.radius()];
        let at = self.swept(low);
        let inside = at > 1e-6 && at < self.swept(self.to) - 1e-6;
        inside || (self.radius() - distance(self.to, round.centre)).abs() > 2.0 * NEAR
    }
    /// Cut where its second coordinate turns from rising to falling or back; an arc that begins at its top begins with an empty piece.
    pub(super) fn split(&self, into: &mut Vec<Self>) {
        let Some(round) = self.round else {
            into.push(*self);
            return;
        };
        let radius = self.radius();
        let sweep = self.swept(self.to);
        let mut cuts: Vec<(f64, Point)> = [radius, -radius]
            .into_iter()
            .map(|out| {
                let point = [round.centre[0], round.centre[1] + out];
                (self.swept(point), point)
            })
            .filter(|&(at, _)| at > 1e-9 && at < sweep - 1e-9)
            .collect();
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut from = self.from;
        if distance(self.from, [round.centre[0], round.centre[1] + radius]) < 1e-9 {
            into.push(self.with_ends(from, from));
        }
        for (_, point) in cuts {
            into.push(self.with_ends(from, point));
            from = point;
        }
        into.push(self.with_ends(from, self.to));
    }
    /// The point at a level of the second coordinate; the piece rises or falls throughout and passes the level.
    pub(super) fn at_level(&self, level: f64) -> Point {
        if level == self.from[1] {
            return self.from;
        }
        if level == self.to[1] {
            return self.to;
        }
        let Some(round) = self.round else {
            let share = (level - self.from[1]) / (self.to[1] - self.from[1]);
            return [self.from[0] + share * (self.to[0] - self.from[0]), level];
        };
        let up = level - round.centre[1];
        let half = (self.radius().powi(2) - up * up).max(0.0).sqrt();
        let middle = f64::midpoint(self.from[0], self.to[0]);
        let beyond = if middle < round.centre[0] { -half } else { half };
        [round.centre[0] + beyond, level]
    }
}

fn line_circle(line: &Segment, centre: Point, radius: f64) -> [Option<Point>; 2] {
    let way = line.direction(line.from);
    let to = [centre[0] - line.from[0], centre[1] - line.from[1]];
    let along = to[0] * way[0] + to[1] * way[1];
    let aside = cross(way, to);
    let square = radius * radius - aside * aside;
    if square < -NEAR * NEAR {
        return [None; 2];
    }
    let half = square.max(0.0).sqrt();
    let at = |way_to: f64| Some([line.from[0] + way_to * way[0], line.from[1] + way_to * way[1]]);
    [at(along - half), at(along + half)]
}

fn circles(one: Point, one_radius: f64, two: Point, two_radius: f64) -> [Option<Point>; 2] {
    let apart = distance(one, two);
    if apart < 1e-9 {
        return [None; 2];
    }
    let along = (apart * apart + one_radius * one_radius - two_radius * two_radius) / (2.0 * apart);
    let square = one_radius * one_radius - along * along;
    if square < -NEAR * NEAR {
        return [None; 2];
    }
    let half = square.max(0.0).sqrt();
    let way = [(two[0] - one[0]) / apart, (two[1] - one[1]) / apart];
    let at = |side: f64| {
        Some([
            one[0] + along * way[0] - side * way[1],
            one[1] + along * way[1] + side * way[0],
        ])
    };
    [at(half), at(-half)]
}
