//! The shortest route round barriers: A* over the graph of points that see each other.
//!
//! A shortest route is straight between points at which it turns, and turns only at corners of the union of the barriers. Whether two points see
//! each other is tested when the search takes the edge between them, not before.
use super::{Cover, Point};
use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// A point this near to the line between its neighbours is no turn, mm.
const STRAIGHT: f64 = 1e-9;

/// A route.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// From the start to the end, both included.
    pub points: Vec<Point>,
    /// mm, or what its legs cost.
    pub length: f64,
}

/// A step to a point that the search may take, cheapest first; ties by the order of the points.
#[derive(PartialEq)]
struct Step {
    /// Length of the route through the point if nothing else is in the way, mm.
    least: f64,
    /// Length to the point, mm.
    length: f64,
    to: usize,
    from: usize,
}

impl Eq for Step {}

impl Ord for Step {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = other
            .least
            .total_cmp(&self.least)
            .then(self.length.total_cmp(&other.length));
        order.then(other.to.cmp(&self.to)).then(other.from.cmp(&self.from))
    }
}

impl PartialOrd for Step {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The shortest route from one point to another that does not enter the interior of the union; it may touch it. `None` where there is none:
/// an end is inside, or enclosed.
pub fn shortest_route(cover: &Cover, from: &Point, to: &Point) -> Option<Route> {
    cheapest_route(cover, (from, to), &[], Point::norm, |_, _| true)
}

/// The cheapest route by a norm of its legs, such as the time of the slower axis. `further`: points at which it may turn as well as at the corners;
/// `admits`: a leg must satisfy it too.
pub fn cheapest_route(
    cover: &Cover,
    (from, to): (&Point, &Point),
    further: &[Point],
    norm: impl Fn(&Point) -> f64,
    admits: impl Fn(&Point, &Point) -> bool,
) -> Option<Route> {
    if cover.encloses(from) || cover.encloses(to) {
        return None;
    }
    let sees = |a: &Point, b: &Point| admits(a, b) && !cover.is_entered(a, b);
    let mut points = vec![*from, *to];
    if !sees(from, to) {
        points.extend(cover.turning_points());
        points.extend(further.iter().filter(|point| !cover.encloses(point)));
    }
    let best = search(&points, &norm, sees)?;
    let mut route: Vec<Point> = best.iter().map(|&index| points[index]).collect();
    straighten(&mut route);
    let cost = route.windows(2).map(|pair| norm(&(pair[1] - pair[0]))).sum();
    Some(Route {
        points: route,
        length: cost,
    })
}

/// The cheapest way from point 0 to point 1, by their indices; `sees` says whether one point sees another.
fn search(
    points: &[Point],
    norm: &impl Fn(&Point) -> f64,
    sees: impl Fn(&Point, &Point) -> bool,
) -> Option<Vec<usize>> {
    let goal = points[1];
    let mut parent: Vec<Option<usize>> = vec![None; points.len()];
    let mut heap = BinaryHeap::from([Step {
        least: 0.0,
        length: 0.0,
        to: 0,
        from: 0,
    }]);
    while let Some(step) = heap.pop() {
        let Step { length, to, from, .. } = step;
        if parent[to].is_some() || to != from && !sees(&points[from], &points[to]) {
            continue;
        }
        parent[to] = Some(from);
        if to == 1 {
            let mut route = vec![1];
            while let Some(&last) = route.last().filter(|&&last| last != 0) {
                route.push(parent[last]?);
            }
            route.reverse();
            return Some(route);
        }
        for (next, point) in points.iter().enumerate() {
            if parent[next].is_none() {
                let length = length + norm(&(point - points[to]));
                heap.push(Step {
                    least: length + norm(&(goal - point)),
                    length,
                    to: next,
                    from: to,
                });
            }
        }
    }
    None
}

/// Leaves out points on the straight line between their neighbours.
fn straighten(route: &mut Vec<Point>) {
    let mut at = 1;
    while at + 1 < route.len() {
        if super::point_distance(&route[at], &route[at - 1], &route[at + 1]) <= STRAIGHT {
            route.remove(at);
        } else {
            at += 1;
        }
    }
}
