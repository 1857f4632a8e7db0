//! The pieces of a line that are seen. Half a million pieces may lie in the same few columns of pixels: there they are drawn once.
use crate::thin::{COLUMN, thin};
use std::collections::BTreeMap;

type Point = (f64, f64);

/// From so many pieces on, those of a column are drawn as the heights that they cover.
const CROWDED: usize = 8;

/// A gap of a column that is not seen, tenths of a pixel.
const GAP: f64 = COLUMN;

/// Pieces of a line, in tenths of a pixel, as they come.
#[derive(Default)]
pub(crate) struct Runs {
    wide: Vec<Vec<Point>>,
    columns: BTreeMap<i64, Column>,
}

/// The least and the largest of values.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let empty = [f64::INFINITY, f64::NEG_INFINITY];
    values.fold(empty, |[low, high], value| [low.min(value), high.max(value)])
}

/// The pieces that are no wider than a column, by the column of their middle.
#[derive(Default)]
struct Column {
    /// The first few, as they are.
    whole: Vec<Vec<Point>>,
    /// Lowest and highest point of each of the others; joined from time to time.
    heights: Vec<[f64; 2]>,
    /// How many were left when they were joined last.
    joined: usize,
    /// Where the others stand.
    across: f64,
}

impl Runs {
    /// Adds a piece.
    pub(crate) fn add(&mut self, run: Vec<Point>) {
        if run.len() < 2 {
            return;
        }
        let across = run.iter().map(|point| point.0);
        let [left, right] = extent(across);
        if right - left > COLUMN {
            self.wide.push(thin(&run));
        } else {
            let place = (0.5 * (left + right) / COLUMN).floor() as i64;
            self.columns.entry(place).or_default().add(run);
        }
    }

    /// The pieces, thinned.
    pub(crate) fn finish(self) -> Vec<Vec<Point>> {
        let mut all = self.wide;
        for mut column in self.columns.into_values() {
            column.join();
            all.extend(column.whole.iter().map(|run| thin(run)));
            let x = column.across;
            all.extend(column.heights.iter().map(|[low, high]| vec![(x, *low), (x, *high)]));
        }
        all
    }
}

impl Column {
    fn add(&mut self, run: Vec<Point>) {
        if self.whole.len() < CROWDED {
            self.whole.push(run);
            return;
        }
        self.across = run[0].0;
        self.heights.push(extent(run.iter().map(|point| point.1)));
        if self.heights.len() > 2 * self.joined + CROWDED {
            self.join();
        }
    }

    /// Joins heights between which no gap is seen.
    fn join(&mut self) {
        self.heights.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        self.heights.dedup_by(|next, kept| {
            let near = next[0] <= kept[1] + GAP;
            if near {
                kept[1] = kept[1].max(next[1]);
            }
            near
        });
        self.joined = self.heights.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(pieces: impl Iterator<Item = Vec<Point>>) -> Vec<Vec<Point>> {
        let mut runs = Runs::default();
        pieces.for_each(|piece| runs.add(piece));
        runs.finish()
    }

    /// Which tenths of a pixel are covered, upwards.
    fn covered(runs: &[Vec<Point>]) -> Vec<i32> {
        let mut seen = std::collections::BTreeSet::new();
        for two in runs.iter().flat_map(|run| run.windows(2)) {
            seen.extend(two[0].1.min(two[1].1) as i32..=two[0].1.max(two[1].1) as i32);
        }
        seen.into_iter().collect()
    }

    #[test]
    fn pieces_of_a_column_are_drawn_once_and_gaps_stay() {
        // two bands, with nothing between them
        let piece = |at: u32| {
            let low = f64::from(at * 7919 % 400) + if at.is_multiple_of(2) { 0.0 } else { 1000.0 };
            // on both sides of the edge of a column
            vec![(508.0, low), (511.0, low + 60.0)]
        };
        let runs = of((0..100_000).map(piece));
        assert!(runs.len() <= CROWDED + 2, "{} pieces", runs.len());
        let covered = covered(&runs);
        assert!([0, 450, 1001, 1450].iter().all(|at| covered.contains(at)));
        assert!(!covered.iter().any(|at| (470..990).contains(at)));
    }

    #[test]
    fn few_pieces_and_long_ones_stay_as_they_are() {
        let few = [vec![(3.0, 1.0), (4.0, 90.0)], vec![(3.0, 100.0), (4.0, 200.0)]];
        assert_eq!(of(few.clone().into_iter()), few);
        let long: Vec<Vec<Point>> = (0..100).map(|i| vec![(0.0, f64::from(i)), (900.0, 0.0)]).collect();
        assert_eq!(of(long.clone().into_iter()), long);
        assert!(of([vec![], vec![(1.0, 1.0)]].into_iter()).is_empty());
    }
}
