//! Points of a way in the digits of the program, none of them nearer to an obstacle.
use crate::rapid_route::{Frame, Grid, SAME_MM};
use trunnion_geometry::Vec3;
use trunnion_geometry::plane::Cover;
use trunnion_machine::Space;

/// Points in the digits of the program, none of them nearer to an obstacle: of the values around each point those that make the way cheapest.
pub(crate) fn rounded(
    space: &Space,
    frame: &Frame,
    points: &[Vec3],
    grid: Grid,
    cost: &impl Fn(&Vec3) -> f64,
) -> Option<Vec<Vec3>> {
    (1..=3).find_map(|reach| rounded_within(space, frame, points, (grid, reach), cost))
}

fn rounded_within(
    space: &Space,
    frame: &Frame,
    points: &[Vec3],
    (grid, reach): (Grid, i32),
    cost: &impl Fn(&Vec3) -> f64,
) -> Option<Vec<Vec3>> {
    let step = grid.step_mm;
    // a digit as it will be written, so that no residue of the multiplication counts
    let digit = |count: f64| count * step;
    let (first, last) = (points.first()?, points.last()?);
    // a height between the ends is rounded up; all points but the ends are at one height, or above an end
    let up = |z: f64| {
        let words = frame.to_words(&Vec3::new(first.x, first.y, z)).z;
        frame
            .to_space(&Vec3::new(0.0, 0.0, digit((words / step - 1e-6).ceil())))
            .z
    };
    let height = |point: &Vec3| {
        let of_an_end = (point.z - first.z).abs() <= SAME_MM || (point.z - last.z).abs() <= SAME_MM;
        if of_an_end { point.z } else { up(point.z) }
    };
    let candidates = |point: &Vec3| -> Vec<Vec3> {
        let z = height(point);
        if (point.xy() - first.xy()).norm() <= SAME_MM {
            return vec![first.xy().push(z)];
        }
        if (point.xy() - last.xy()).norm() <= SAME_MM {
            return vec![last.xy().push(z)];
        }
        let words = frame.to_words(point);
        let middle = [(words.x / step).round(), (words.y / step).round()];
        let around = -reach..=reach;
        around
            .clone()
            .flat_map(|i| around.clone().map(move |j| [f64::from(i), f64::from(j)]))
            .map(|[i, j]| {
                let place = frame.to_space(&Vec3::new(digit(middle[0] + i), digit(middle[1] + j), words.z));
                place.xy().push(z)
            })
            .collect()
    };
    // the barriers with their mitred corners, not only the distance
    let mut covers: Vec<(f64, Cover)> = Vec::new();
    for z in points.iter().map(height) {
        if covers.iter().all(|(known, _)| (known - z).abs() > SAME_MM) {
            covers.push((z, space.cover(z)));
        }
    }
    let clear = |a: &Vec3, b: &Vec3| {
        if (a.z - b.z).abs() > SAME_MM {
            return (a.xy() - b.xy()).norm() <= SAME_MM && space.may_descend(&a.xy(), a.z.min(b.z));
        }
        let cover = covers.iter().find(|(z, _)| (z - a.z).abs() <= SAME_MM);
        let entered = cover.is_none_or(|(_, cover)| cover.is_entered(&a.xy(), &b.xy()));
        !entered && space.is_clear(a.z, &a.xy(), &b.xy())
    };
    let count = points.len();
    let further = (1..count).map(|index| {
        if index + 1 == count {
            vec![*last]
        } else {
            candidates(&points[index])
        }
    });
    through(*first, further, clear, cost)
}

/// The cheapest way from a place through one of the places of each layer, where each leg is clear.
fn through(
    first: Vec3,
    further: impl Iterator<Item = Vec<Vec3>>,
    clear: impl Fn(&Vec3, &Vec3) -> bool,
    cost: &impl Fn(&Vec3) -> f64,
) -> Option<Vec<Vec3>> {
    // layer by layer: place, cost, the place before it
    let mut layers: Vec<Vec<(Vec3, f64, usize)>> = vec![vec![(first, 0.0, 0)]];
    for ends in further {
        let before = layers.last()?;
        let reached: Vec<(Vec3, f64, usize)> = ends
            .into_iter()
            .filter_map(|place| {
                let steps = before
                    .iter()
                    .enumerate()
                    .filter(|(_, (from, _, _))| clear(from, &place));
                let costs = steps.map(|(at, (from, sum, _))| (sum + cost(&(place - from)), at));
                let (sum, at) = costs.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
                Some((place, sum, at))
            })
            .collect();
        if reached.is_empty() {
            return None;
        }
        layers.push(reached);
    }
    let best = layers
        .last()?
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.1.total_cmp(&b.1.1))?;
    let (mut at, mut way) = (best.0, Vec::new());
    for layer in layers.iter().rev() {
        let (place, _, from) = layer[at];
        way.push(place);
        at = from;
    }
    way.reverse();
    way.dedup_by(|a, b| (*a - *b).norm() <= SAME_MM);
    Some(way)
}
