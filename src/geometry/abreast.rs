//! How far two chains of straight pieces lie apart, in order: both are walked from start to end, and neither goes back.
use crate::Vec3;

/// Two chains, walked side by side.
///
/// The bound is one of the Fréchet distance: each end of a piece is matched with a point of the other chain, these matches are in order, and between
/// two of them both chains are straight, so that their distance is largest at one of the two.
#[derive(Clone, Copy, Debug)]
pub struct Abreast {
    /// Where each chain was left.
    here: [Vec3; 2],
    points: f64,
    apart: f64,
}

/// Which piece was walked to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walked {
    /// That of the first chain; the second remains in part.
    First,
    /// That of the second chain; the first remains in part.
    Second,
    /// Both.
    Both,
}

impl Abreast {
    /// Begins at the starts of both chains.
    pub fn new(first: Vec3, second: Vec3) -> Self {
        let off = (first - second).norm();
        Self {
            here: [first, second],
            points: off,
            apart: off,
        }
    }

    /// Walks on straight to `ends`, a point of the first chain and one of the second, until one is reached. Ends no farther apart than `together`
    /// are reached at once.
    pub fn to(&mut self, ends: [Vec3; 2], together: f64) -> Walked {
        let share = |chain: usize, point: &Vec3| {
            let way = ends[chain] - self.here[chain];
            let square = way.norm_squared();
            if square > 0.0 {
                ((point - self.here[chain]).dot(&way) / square).clamp(0.0, 1.0)
            } else {
                1.0
            }
        };
        let at = |chain: usize, share: f64| self.here[chain] + (ends[chain] - self.here[chain]) * share;
        let shares = [share(0, &ends[1]), share(1, &ends[0])];
        let first_ends = [ends[0], at(1, shares[1])];
        let second_ends = [at(0, shares[0]), ends[1]];
        let off = |pair: &[Vec3; 2]| (pair[0] - pair[1]).norm();
        let (walked, pair) = if off(&ends) <= together || shares[0] >= 1.0 && shares[1] >= 1.0 {
            (Walked::Both, ends)
        } else if shares[0] >= 1.0 || shares[1] < 1.0 && off(&first_ends) <= off(&second_ends) {
            (Walked::First, first_ends)
        } else {
            (Walked::Second, second_ends)
        };
        self.here = pair;
        self.apart = self.apart.max(off(&pair));
        if walked != Walked::Second {
            self.points = self.points.max(off(&pair));
        }
        walked
    }

    /// No end of a piece of the first chain was farther from its match, mm.
    pub fn points_apart(&self) -> f64 {
        self.points
    }

    /// No point of either chain was farther from its match, mm.
    pub fn apart(&self) -> f64 {
        self.apart
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk(first: &[Vec3], second: &[Vec3]) -> Abreast {
        let mut abreast = Abreast::new(first[0], second[0]);
        let (mut i, mut j) = (1, 1);
        while i < first.len() && j < second.len() {
            let walked = abreast.to([first[i], second[j]], 1e-9);
            i += usize::from(walked != Walked::Second);
            j += usize::from(walked != Walked::First);
        }
        assert!(i >= first.len() && j >= second.len(), "{i} {j}");
        abreast
    }

    fn wave(count: u32, off: f64) -> Vec<Vec3> {
        (0..=count)
            .map(|step| {
                let x = 10.0 * f64::from(step) / f64::from(count);
                let bump = if step == 0 || step == count { 0.0 } else { off };
                Vec3::new(x, 0.5 * crate::math::sin(x) + bump, 0.2 * x)
            })
            .collect()
    }

    /// The Fréchet distance of the points of two chains, by its definition (Eiter and Mannila): with many points between it is that of the chains.
    fn discrete(first: &[Vec3], second: &[Vec3]) -> f64 {
        let mut row: Vec<f64> = Vec::new();
        for (i, a) in first.iter().enumerate() {
            let before = row.clone();
            row.clear();
            for (j, b) in second.iter().enumerate() {
                let off = (a - b).norm();
                let reach = match (i, j) {
                    (0, 0) => 0.0,
                    (0, _) => row[j - 1],
                    (_, 0) => before[0],
                    _ => before[j].min(before[j - 1]).min(row[j - 1]),
                };
                row.push(off.max(reach));
            }
        }
        row.last().copied().unwrap_or(0.0)
    }

    fn dense(chain: &[Vec3]) -> Vec<Vec3> {
        let steps = 1200 / chain.len() as u32;
        let mut all = vec![chain[0]];
        for pair in chain.windows(2) {
            all.extend((1..=steps).map(|step| pair[0] + (pair[1] - pair[0]) * (f64::from(step) / f64::from(steps))));
        }
        all
    }

    #[test]
    fn the_bound_is_that_of_the_definition() {
        for (counts, off) in [((40, 300), 0.0), ((300, 40), 0.02), ((37, 53), 0.1), ((9, 100), 0.0)] {
            let (first, second) = (wave(counts.0, 0.0), wave(counts.1, off));
            let found = walk(&first, &second).apart();
            let exact = discrete(&dense(&first), &dense(&second));
            // the points of both are up to 0.01 mm from their neighbours
            assert!(found >= exact - 0.011, "{counts:?}: {found} {exact}");
            assert!(found <= 1.05 * exact + 0.005, "{counts:?}: {found} {exact}");
        }
    }

    #[test]
    fn order_counts() {
        let line = [0.0, 10.0].map(|x| Vec3::new(x, 0.0, 0.0));
        let back = [0.0, 6.0, 4.0, 10.0].map(|x| Vec3::new(x, 0.0, 0.0));
        // the best is 1 mm: 5 is matched with the whole way back
        assert!(walk(&back, &line).apart() >= 1.0);
        assert!(walk(&line, &back).apart() >= 1.0);
        let same = walk(&back, &back);
        assert!(same.apart() == 0.0 && same.points_apart() == 0.0);
    }

    #[test]
    fn points_alone_do_not_see_the_sag() {
        let arc: Vec<Vec3> = (0..=90)
            .map(|step| {
                let (sin, cos) = crate::math::sin_cos(f64::from(step).to_radians());
                Vec3::new(20.0 * cos, 20.0 * sin, 0.0)
            })
            .collect();
        let few: Vec<Vec3> = arc.iter().step_by(10).copied().collect();
        let found = walk(&few, &arc);
        let sag = 20.0 * (1.0 - crate::math::cos(5f64.to_radians()));
        assert!(found.points_apart() < 1e-9, "{found:?}");
        assert!((found.apart() - sag).abs() < 1e-6, "{found:?} {sag}");
    }
}
