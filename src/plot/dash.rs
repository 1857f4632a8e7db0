//! Dashed lines that stay dashed where they lie over each other: the path of a tool goes to and fro along the same line.
use crate::canvas::dashes;
use std::collections::HashSet;
use trunnion_geometry::math::hypot;

type Point = (f64, f64);
type Whole = (i32, i32);

/// From this length on the dashes of a segment stand at fixed places of the line on which it lies, tenths of a pixel.
const LONG: f64 = 300.0;
/// A piece of a dash that is shorter is left out, tenths of a pixel.
const SPECK: f64 = 5.0;

/// The polylines without segments that were there before, in either direction.
pub(crate) fn distinct(runs: Vec<Vec<Point>>) -> Vec<Vec<Point>> {
    let mut seen: HashSet<[Whole; 2]> = HashSet::new();
    let mut kept = Vec::new();
    for run in runs {
        let mut open: Vec<Point> = Vec::new();
        for two in run.windows(2) {
            let mut ends = [two[0], two[1]].map(whole);
            ends.sort_unstable();
            if seen.insert(ends) {
                if open.is_empty() {
                    open.push(two[0]);
                }
                open.push(two[1]);
            } else {
                kept.push(std::mem::take(&mut open));
            }
        }
        kept.push(open);
    }
    kept.retain(|run| run.len() > 1);
    kept
}

/// The dashes of polylines, in tenths of a pixel, each once. `dash` and `gap` in pixels.
pub(crate) fn dashed(runs: &[Vec<Point>], dash: f64, gap: f64) -> Vec<Vec<Whole>> {
    let mut all = Vec::new();
    for run in runs {
        let mut open: Vec<Point> = Vec::new();
        for two in run.windows(2) {
            if hypot(two[1].0 - two[0].0, two[1].1 - two[0].1) < LONG {
                if open.is_empty() {
                    open.push(two[0]);
                }
                open.push(two[1]);
            } else {
                all.extend(dashes(&std::mem::take(&mut open), dash, gap));
                all.extend(anchored(two[0], two[1], 10.0 * dash, 10.0 * gap));
            }
        }
        all.extend(dashes(&open, dash, gap));
    }
    let mut seen: HashSet<Vec<Whole>> = HashSet::new();
    all.retain(|dash| seen.insert(dash.clone()));
    all
}

/// The dashes of a segment. Their middles are a whole number of periods from the foot of the perpendicular from the corner of the field, whatever the
/// ends of the segment and its direction.
fn anchored(from: Point, to: Point, dash: f64, gap: f64) -> impl Iterator<Item = Vec<Whole>> {
    // in one direction, so that the ends are rounded alike
    let (from, to) = if to < from { (to, from) } else { (from, to) };
    let length = hypot(to.0 - from.0, to.1 - from.1);
    let along = ((to.0 - from.0) / length, (to.1 - from.1) / length);
    let start = from.0 * along.0 + from.1 * along.1;
    let period = dash + gap;
    let first = ((start - 0.5 * dash) / period).ceil() as i64;
    let last = ((start + length + 0.5 * dash) / period).floor() as i64;
    let at = move |way: f64| whole((from.0 + along.0 * (way - start), from.1 + along.1 * (way - start)));
    (first..=last).filter_map(move |number| {
        let middle = number as f64 * period;
        let ends = [middle - 0.5 * dash, middle + 0.5 * dash].map(|way| way.clamp(start, start + length));
        (ends[1] - ends[0] >= SPECK).then(|| ends.map(at).to_vec())
    })
}

fn whole(p: Point) -> Whole {
    (p.0.round() as i32, p.1.round() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How much of a vertical line is covered.
    fn covered(all: &[Vec<Whole>]) -> usize {
        let mut tenths: HashSet<i32> = HashSet::new();
        for dash in all {
            tenths.extend(dash[0].1.min(dash[1].1)..dash[0].1.max(dash[1].1));
        }
        tenths.len()
    }

    #[test]
    fn a_line_that_is_run_often_stays_dashed() {
        // pecks: down to deeper and deeper holes and up again, in one go and in pieces
        let mut run = vec![(500.0, 100.0)];
        for depth in 0..9 {
            run.extend([(500.0, 1000.0 + 37.0 * f64::from(depth)), (500.0, 100.0)]);
        }
        let runs = distinct(vec![run.clone(), run, vec![(500.0, 1400.0), (500.0, 313.0)]]);
        let dashes = dashed(&runs, 7.0, 5.0);
        let share = covered(&dashes) as f64 / 1300.0;
        assert!((0.5..0.65).contains(&share), "{share}");
    }

    #[test]
    fn dashes_do_not_depend_on_the_direction() {
        let (a, b) = ((17.0, 900.0), (1233.0, 211.0));
        let there: Vec<_> = anchored(a, b, 70.0, 50.0).collect();
        let back: Vec<_> = anchored(b, a, 70.0, 50.0).collect();
        assert_eq!(there, back);
        assert_eq!(there.len(), 12);
        let gaps = there.windows(2).map(|two| {
            let (end, next) = (two[0][1], two[1][0]);
            hypot(f64::from(next.0 - end.0), f64::from(next.1 - end.1))
        });
        assert!(gaps.into_iter().all(|gap| (gap - 50.0).abs() < 2.0));
    }

    #[test]
    fn what_was_there_before_is_left_out_and_the_rest_stays_in_one() {
        let runs = vec![
            vec![(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (100.0, 0.0), (200.0, 0.0)],
            vec![(100.0, 0.0), (0.0, 0.0)],
        ];
        let kept = distinct(runs);
        let first = vec![(0.0, 0.0), (100.0, 0.0), (100.0, 50.0)];
        assert_eq!(kept, [first, vec![(100.0, 0.0), (200.0, 0.0)]]);
    }
}
