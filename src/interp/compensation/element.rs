//! One motion seen in the plane.
use crate::arc::plane_axes;
use crate::{Motion, MotionKind, Position};
use core::f64::consts::TAU;
use trunnion_dialect::Plane;
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::{atan2, hypot};

/// A point or direction in the plane.
pub(super) type Point = [f64; 2];

/// Points closer than this are the same, mm.
pub(super) const SAME: f64 = 1e-6;

pub(super) fn add(a: Point, b: Point, by: f64) -> Point {
    [a[0] + b[0] * by, a[1] + b[1] * by]
}

pub(super) fn sub(a: Point, b: Point) -> Point {
    add(a, b, -1.0)
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// A quarter turn counter-clockwise.
pub(super) fn left(a: Point) -> Point {
    [-a[1], a[0]]
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    hypot(b[0] - a[0], b[1] - a[1])
}

/// Angle from one arm to another about a centre, turning as `sign` says, rad.
pub(super) fn sweep(centre: Point, from: Point, to: Point, sign: f64) -> f64 {
    let (a, b) = (sub(from, centre), sub(to, centre));
    let turn = atan2(cross(a, b), dot(a, b));
    if turn * sign < 0.0 { turn + sign * TAU } else { turn }
}

/// The circle of an arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    pub(super) centre: Point,
    pub(super) radius: f64,
    /// Counter-clockwise positive, rad.
    pub(super) sweep: f64,
}

/// The path of a motion in the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    axes: [usize; 3],
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) circle: Option<Circle>,
}

impl Element {
    /// `None` for motions that do not move in the plane or whose path is unknown.
    pub(super) fn of(motion: &Motion, plane: Plane) -> Option<Self> {
        let axes = plane_axes(plane);
        let at = |position: &Position| Some([position.get(axes[0])?, position.get(axes[1])?]);
        let (start, end) = (at(&motion.start)?, at(&motion.end)?);
        if !super::known(motion) || motion.machine_coordinates {
            return None;
        }
        let circle = match motion.kind {
            MotionKind::Rapid | MotionKind::Linear if distance(start, end) > SAME => None,
            MotionKind::Arc(Some(arc)) if arc.normal[axes[2]] > 0.5 => Some(Circle {
                centre: [arc.centre[axes[0]], arc.centre[axes[1]]],
                radius: arc.radius_start,
                sweep: arc.sweep,
            }),
            _ => return None,
        };
        Some(Self {
            axes,
            start,
            end,
            circle,
        })
    }
    /// Whether a motion leaves the plane's coordinates as they are, for certain.
    pub(super) fn rests(motion: &Motion, plane: Plane) -> bool {
        let axes = plane_axes(plane);
        let straight = matches!(
            motion.kind,
            MotionKind::Rapid | MotionKind::Linear | MotionKind::Dwell(_)
        );
        straight
            && !motion.machine_coordinates
            && axes[..2]
                .iter()
                .all(|&axis| motion.start.get(axis).is_some() && motion.start.get(axis) == motion.end.get(axis))
    }
    pub(super) fn is_arc(&self) -> bool {
        self.circle.is_some()
    }
    /// Whether the next motion begins where this one ends, with the same zero point.
    pub(super) fn meets(&self, next: &Self, own: &Motion, other: &Motion) -> bool {
        distance(self.end, next.start) <= SAME && own.zero == other.zero
    }
    /// Puts a point into a position.
    pub(super) fn put(&self, position: &mut Position, point: Point) {
        position.set(self.axes[0], point[0]);
        position.set(self.axes[1], point[1]);
    }
    /// Moves the start, the end or both of a motion that runs in the plane; an arc moves as a whole.
    pub(super) fn shift(&self, motion: &mut Motion, by: Point, [start, end]: [bool; 2]) {
        if by == [0.0; 2] {
            return;
        }
        for (position, moves) in [(&mut motion.start, start), (&mut motion.end, end)] {
            if moves
                && let Some(point) = self.axes[..2]
                    .iter()
                    .map(|&axis| position.get(axis))
                    .collect::<Option<Vec<_>>>()
            {
                self.put(position, add([point[0], point[1]], by, 1.0));
            }
        }
        if let MotionKind::Arc(Some(arc)) = &mut motion.kind {
            for place in [&mut arc.start, &mut arc.end, &mut arc.centre] {
                place[self.axes[0]] += by[0];
                place[self.axes[1]] += by[1];
            }
        }
    }
    pub(super) fn forget(&self, position: &mut Position) {
        position.forget(self.axes[0]);
        position.forget(self.axes[1]);
    }
    fn tangent(&self, at: Point) -> Point {
        match &self.circle {
            None => {
                let way = sub(self.end, self.start);
                let length = hypot(way[0], way[1]);
                [way[0] / length, way[1] / length]
            }
            Some(circle) => {
                let arm = sub(at, circle.centre);
                let length = hypot(arm[0], arm[1]);
                let sign = circle.sweep.signum();
                left([sign * arm[0] / length, sign * arm[1] / length])
            }
        }
    }
    /// Unit direction at the start.
    pub(super) fn departs(&self) -> Point {
        self.tangent(self.start)
    }
    /// Unit direction at the end.
    pub(super) fn arrives(&self) -> Point {
        self.tangent(self.end)
    }
    /// The point beside the start, `offset` to the left.
    pub(super) fn beside_start(&self, offset: f64) -> Point {
        add(self.start, left(self.departs()), offset)
    }
    /// The point beside the end.
    pub(super) fn beside_end(&self, offset: f64) -> Point {
        add(self.end, left(self.arrives()), offset)
    }
    /// Radius of the compensated arc; not above 0 where the tool does not fit inside.
    pub(super) fn radius(&self, offset: f64) -> Option<f64> {
        self.circle.map(|circle| circle.radius - offset * circle.sweep.signum())
    }
    /// How much farther the compensated arc turns than the programmed one, seen from its centre.
    fn turned(&self, from: Point, to: Point) -> Option<f64> {
        let circle = self.circle?;
        let between = |a: Point, b: Point| {
            let (a, b) = (sub(a, circle.centre), sub(b, circle.centre));
            atan2(cross(a, b), dot(a, b))
        };
        Some(circle.sweep - between(self.start, from) + between(self.end, to))
    }
    /// An arc in the element's plane from a position, about a corner.
    pub(super) fn corner_arc(&self, at: &Position, corner: Point, from: Point, to: Point, sign: f64) -> Arc {
        // Y of a lathe may be unknown, and does not move
        let mut place = Vec3::from_fn(|axis, _| at.get(axis).unwrap_or(0.0));
        let mut put = |point: Point| {
            place[self.axes[0]] = point[0];
            place[self.axes[1]] = point[1];
            place
        };
        let mut normal = Vec3::zeros();
        normal[self.axes[2]] = 1.0;
        Arc {
            start: put(from),
            end: put(to),
            centre: put(corner),
            normal,
            sweep: sweep(corner, from, to, sign),
            radius_start: distance(corner, from),
            radius_end: distance(corner, to),
        }
    }
    /// Whether the compensated motion runs in the programmed direction.
    pub(super) fn keeps_direction(&self, offset: f64, from: Point, to: Point) -> bool {
        match &self.circle {
            None => dot(sub(to, from), self.departs()) > -SAME,
            Some(circle) => {
                self.radius(offset).is_some_and(|radius| radius > SAME)
                    && self
                        .turned(from, to)
                        .is_some_and(|sweep| sweep * circle.sweep.signum() > -1e-9)
            }
        }
    }
    /// The arc between two points beside the programmed one.
    pub(super) fn arc_between(&self, arc: &Arc, from: Point, to: Point) -> Option<Arc> {
        let circle = self.circle?;
        let place = |old: Vec3, point: Point| {
            let mut new = old;
            new[self.axes[0]] = point[0];
            new[self.axes[1]] = point[1];
            new
        };
        Some(Arc {
            start: place(arc.start, from),
            end: place(arc.end, to),
            centre: arc.centre,
            normal: arc.normal,
            sweep: self.turned(from, to)?,
            radius_start: distance(circle.centre, from),
            radius_end: distance(circle.centre, to),
        })
    }
}
