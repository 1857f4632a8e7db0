//! Shortest routes round barriers: the example of paper 001, clearances, scenes with lengths that another program computed.
#![allow(clippy::print_stdout, reason = "a skipped test says so")]
use proptest::prelude::*;
use trunnion_geometry::plane::{Cover, Point, Polygon, barrier, shortest_route};

fn points(list: &[[f64; 2]]) -> Vec<Point> {
    list.iter().map(|&[x, y]| Point::new(x, y)).collect()
}

/// Length of the shortest route past barriers with this clearance.
fn length(barriers: &[&[[f64; 2]]], by: f64, from: [f64; 2], to: [f64; 2]) -> Option<f64> {
    let rings = barriers
        .iter()
        .flat_map(|ring| barrier(&Polygon::new(&points(ring)).expect("a polygon"), by))
        .collect();
    let (from, to) = (Point::from(from), Point::from(to));
    Some(shortest_route(&Cover::new(rings), &from, &to)?.length)
}

fn close(found: Option<f64>, expected: f64) {
    let found = found.expect("a route");
    assert!((found - expected).abs() < 5e-7, "{found} {expected}");
}

const EXAMPLE: &[[f64; 2]] = &[
    [4.0, 6.0],
    [9.0, 6.0],
    [9.0, 7.0],
    [11.0, 7.0],
    [11.0, 9.0],
    [9.0, 9.0],
    [9.0, 10.0],
    [4.0, 10.0],
];

#[test]
fn the_example_of_the_paper() {
    let (from, to) = ([6.0, 5.0], [6.0, 11.0]);
    close(length(&[EXAMPLE], 0.0, from, to), 8.472_136);
    for (by, expected) in [
        (0.1, 8.769_464),
        (0.25, 9.243_416),
        (0.5, 10.099_020),
        (0.9, 11.603_447),
    ] {
        close(length(&[EXAMPLE], by, from, to), expected);
    }
    // a wall to the left leaves only the other side
    let wall = &[[-100.0, 7.0], [5.0, 7.0], [5.0, 8.0], [-100.0, 8.0]];
    close(length(&[EXAMPLE, wall], 0.0, from, to), 12.796_691);
}

#[test]
fn out_of_a_concavity() {
    let u = &[
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 8.0],
        [7.0, 8.0],
        [7.0, 3.0],
        [3.0, 3.0],
        [3.0, 8.0],
        [0.0, 8.0],
    ];
    close(length(&[u], 0.0, [5.0, 4.0], [5.0, -2.0]), 20.857_301);
}

/// A route leaks neither along the side that two barriers share nor through a corner that lies in another side; a point at which two corners touch
/// lets it pass.
#[test]
fn barriers_that_touch_are_one() {
    let left: &[[f64; 2]] = &[[-10.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-10.0, 1.0]];
    let right: &[[f64; 2]] = &[[0.0, 0.0], [10.0, 0.0], [10.0, 1.0], [0.0, 1.0]];
    let (from, to) = ([0.0, -1.0], [0.0, 2.0]);
    let round = 2.0 * 101f64.sqrt() + 1.0;
    close(length(&[left, right], 0.0, from, to), round);
    // overlapping, and with a corner inside the other's side
    let over: &[[f64; 2]] = &[[-0.5, 0.0], [10.0, 0.0], [10.0, 1.0], [-0.5, 1.0]];
    close(length(&[left, over], 0.0, from, to), round);
    let wedge: &[[f64; 2]] = &[[0.0, 0.5], [10.0, 0.0], [10.0, 1.0]];
    // its tip is in the side of the left one: through that point, and no other
    close(length(&[left, wedge], 0.0, from, to), 3.0);
    let into: &[[f64; 2]] = &[[-0.1, 0.5], [10.0, 0.0], [10.0, 1.0]];
    let found = length(&[left, into], 0.0, from, to).expect("a route");
    assert!(found > 20.0, "{found}");
    let above: &[[f64; 2]] = &[[0.0, 1.0], [10.0, 1.0], [10.0, 2.0], [0.0, 2.0]];
    close(length(&[left, above], 0.0, [1.0, 0.0], [-1.0, 2.0]), 2.0 * 2f64.sqrt());
}

#[test]
fn inside_there_is_no_route_and_on_a_side_there_is() {
    let square: &[[f64; 2]] = &[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    assert_eq!(length(&[square], 0.0, [1.0, 1.0], [9.0, 1.0]), None);
    assert_eq!(length(&[square], 0.0, [9.0, 1.0], [3.999, 1.0]), None);
    close(length(&[square], 0.0, [0.0, 2.0], [4.0, 2.0]), 8.0);
    close(length(&[square], 0.0, [0.0, 0.0], [4.0, 0.0]), 4.0);
    close(length(&[square], 0.0, [0.0, 0.0], [4.0, 4.0]), 8.0);
    // a ring of four bars has a hole
    let bars: [&[[f64; 2]]; 4] = [
        &[[0.0, 0.0], [10.0, 0.0], [10.0, 1.0], [0.0, 1.0]],
        &[[9.0, 0.0], [10.0, 0.0], [10.0, 10.0], [9.0, 10.0]],
        &[[0.0, 9.0], [10.0, 9.0], [10.0, 10.0], [0.0, 10.0]],
        &[[0.0, 0.0], [1.0, 0.0], [1.0, 10.0], [0.0, 10.0]],
    ];
    assert_eq!(length(&bars, 0.0, [5.0, 5.0], [20.0, 5.0]), None);
    close(length(&bars, 0.0, [2.0, 2.0], [8.0, 8.0]), 72f64.sqrt());
    assert!(length(&bars[..3], 0.0, [5.0, 5.0], [20.0, 5.0]).is_some());
}

/// A needle: its mitre would reach 100 times the clearance.
#[test]
fn a_sharp_corner_is_cut_off() {
    let needle: &[[f64; 2]] = &[[0.0, 0.0], [100.0, 0.5], [0.0, 1.0]];
    let (from, to) = ([50.0, -5.0], [50.0, 6.0]);
    let polygon = Polygon::new(&points(needle)).expect("a polygon");
    let rings = barrier(&polygon, 1.0);
    let far = rings.iter().flatten().map(|point| point.x).fold(0.0, f64::max);
    assert!(far > 101.0 - 1e-9 && far < 101.1, "{far}");
    let route = shortest_route(&Cover::new(rings), &Point::from(from), &Point::from(to)).expect("a route");
    for pair in route.points.windows(2) {
        assert!(polygon.segment_distance(&pair[0], &pair[1]) > 1.0 - 1e-9);
    }
}

#[test]
fn scenes_of_another_program() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../shared/data/reference/barrier_scenes.json"
    );
    let Ok(text) = std::fs::read_to_string(path) else {
        println!("skipped: {path} is absent");
        return;
    };
    let scenes: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let pair = |value: &serde_json::Value| [0, 1].map(|i| value[i].as_f64().expect("a number"));
    let mut wrong = Vec::new();
    let scenes = scenes.as_array().expect("a list");
    for (index, scene) in scenes.iter().enumerate() {
        let barriers: Vec<Vec<[f64; 2]>> = scene["barriers"]
            .as_array()
            .expect("barriers")
            .iter()
            .map(|ring| ring.as_array().expect("a ring").iter().map(pair).collect())
            .collect();
        let barriers: Vec<&[[f64; 2]]> = barriers.iter().map(Vec::as_slice).collect();
        let found = length(&barriers, 0.0, pair(&scene["origin"]), pair(&scene["destination"]));
        let expected = scene["length"].as_f64();
        let same = match (found, expected) {
            (Some(found), Some(expected)) => (found - expected).abs() < 1e-6,
            (None, None) => true,
            _ => false,
        };
        if !same {
            wrong.push((index, found, expected));
        }
    }
    assert_eq!(wrong, [], "of {}", scenes.len());
}

/// A star about a centre: convex or not, sides of any length.
fn star() -> impl Strategy<Value = Vec<Point>> {
    let radii = proptest::collection::vec(0.3..4.0, 3..9);
    (proptest::array::uniform2(-6.0..6.0), radii).prop_map(|(centre, radii)| {
        let count = radii.len() as f64;
        let corner = |(index, radius): (usize, &f64)| {
            let (sin, cos) = trunnion_geometry::math::sin_cos(core::f64::consts::TAU * index as f64 / count);
            Point::from(centre) + Point::new(cos, sin) * *radius
        };
        radii.iter().enumerate().map(corner).collect()
    })
}

proptest! {
    /// The clearance is kept along the whole route, the route back is as long, and so is that through the scene turned by a quarter turn.
    #[test]
    fn a_route_keeps_its_clearance(stars in proptest::collection::vec(star(), 1..5), by in prop_oneof![Just(0.0), 0.01..1.0]) {
        let polygons: Vec<Polygon> = stars.iter().filter_map(|star| Polygon::new(star).ok()).collect();
        let cover = |turn: fn(&Point) -> Point| {
            let rings = polygons.iter().flat_map(|polygon| barrier(polygon, by));
            Cover::new(rings.map(|ring| ring.iter().map(turn).collect()).collect())
        };
        let (plain, turned) = (cover(|point| *point), cover(|point| Point::new(-point.y, point.x)));
        let (from, to) = (Point::new(-12.0, 0.3), Point::new(12.0, -0.7));
        let there = shortest_route(&plain, &from, &to).expect("the ends are free");
        let back = shortest_route(&plain, &to, &from).expect("the ends are free");
        let other = shortest_route(&turned, &Point::new(-0.3, -12.0), &Point::new(0.7, 12.0)).expect("the ends are free");
        prop_assert!((there.length - back.length).abs() < 1e-9 && (there.length - other.length).abs() < 1e-9);
        for pair in there.points.windows(2) {
            for polygon in &polygons {
                prop_assert!(polygon.segment_distance(&pair[0], &pair[1]) >= by - 1e-8);
            }
            // nothing enters a polygon either: points along the leg are outside, or on a side
            for share in [0.1, 0.5, 0.9] {
                let at = pair[0] + (pair[1] - pair[0]) * share;
                let depth = |polygon: &Polygon| {
                    let beside = |(a, b): (Point, Point)| trunnion_geometry::plane::point_distance(&at, &a, &b);
                    if polygon.contains(&at) { polygon.sides().map(beside).fold(f64::INFINITY, f64::min) } else { 0.0 }
                };
                prop_assert!(polygons.iter().all(|polygon| depth(polygon) < 1e-8));
            }
        }
    }
}
