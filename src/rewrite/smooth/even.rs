//! The smoothest way through a tube: no steeper than a limit at each step, with the least sum of squares of the changes of slope.
//!
//! A convex quadratic programme, solved by Mehrotra's predictor-corrector interior point method (SIAM J. Optim. 2, 1992). Each
//! station is joined with its two neighbours on either side only, so that every linear system is pentadiagonal and the work is
//! linear in the stations.
use super::pentadiagonal::Pentadiagonal;

/// A stretch of a chain with fixed ends. All heights in one unit, all lengths in one unit.
pub(super) struct Stretch<'a> {
    /// Path length at each station, strictly increasing.
    pub s: &'a [f64],
    /// Walls at each station; infinite where there is none. At the ends they are not looked at.
    pub lower: &'a [f64],
    /// The upper ones.
    pub upper: &'a [f64],
    /// Largest size of the slope of each step (one fewer than stations).
    pub limits: &'a [f64],
    /// Slopes of the steps before the first and after the last station; none where nothing is joined there.
    pub outside: [Option<f64>; 2],
}

/// Most iterations: the method needs ten to twenty.
const ROUNDS: usize = 40;

/// Relative size of what is taken as zero.
const EXACT: f64 = 1e-7;

/// The smoothest heights, from `start`, which keeps walls and limits. `start` itself where the method does not converge or gains nothing.
pub(super) fn even_out(stretch: &Stretch<'_>, start: Vec<f64>) -> Vec<f64> {
    if start.len() < 3 {
        return start;
    }
    match Problem::new(stretch, &start).solve() {
        Some(found) if stretch.keeps(&found) && stretch.unevenness(&found) < stretch.unevenness(&start) => found,
        _ => start,
    }
}

impl Stretch<'_> {
    fn slopes<'h>(&'h self, heights: &'h [f64]) -> impl Iterator<Item = f64> + 'h {
        let steps = heights.windows(2).zip(self.s.windows(2));
        steps.map(|(height, s)| (height[1] - height[0]) / (s[1] - s[0]))
    }

    /// Sum of squares of the changes of slope.
    fn unevenness(&self, heights: &[f64]) -> f64 {
        let mut before = self.outside[0];
        let mut sum = 0.0;
        for slope in self.slopes(heights).map(Some).chain([self.outside[1]]) {
            if let (Some(before), Some(slope)) = (before, slope) {
                sum += (slope - before) * (slope - before);
            }
            before = slope;
        }
        sum
    }

    /// Whether heights keep the limits (the walls they are clamped to), but for rounding.
    fn keeps(&self, heights: &[f64]) -> bool {
        let mut steps = self.slopes(heights).zip(self.limits);
        steps.all(|(slope, limit)| slope.abs() <= limit * (1.0 + 1e-4))
    }
}

/// A linear form of the unknowns: first unknown, coefficients of it and the two after it, and a constant.
#[derive(Clone, Copy)]
struct Row {
    at: usize,
    by: [f64; 3],
    plus: f64,
}

impl Row {
    fn value(&self, x: &[f64]) -> f64 {
        let [a, b, c] = self.by;
        let x = &x[self.at..self.at + 3];
        self.plus + (a * x[0] + b * x[1] + c * x[2])
    }
}

/// A height or a slope between its two bounds, with all that the method keeps of them side by side: the upper bound first. What is kept has one
/// memory for all of it, because the work is done in few passes over long chains.
#[derive(Clone, Copy)]
struct Pair {
    /// The height or slope: the first unknown, and the coefficients of it and the next one.
    at: usize,
    by: [f64; 2],
    /// Constants of both sides: `side * linear + plus` is to be at most zero.
    plus: [f64; 2],
    /// 1 where there is a bound on this side, 0 where there is none.
    counts: [f64; 2],
    slack: [f64; 2],
    price: [f64; 2],
    d_slack: [f64; 2],
    d_price: [f64; 2],
}

/// The signs of both sides.
const SIDES: [f64; 2] = [1.0, -1.0];

impl Pair {
    fn linear(&self, x: &[f64]) -> f64 {
        let [a, b] = self.by;
        let x = &x[self.at..self.at + 2];
        a * x[0] + b * x[1]
    }

    /// A number for each side.
    fn sides(&self, number: impl Fn(usize) -> f64) -> [f64; 2] {
        [0, 1].map(|side| self.counts[side] * number(side))
    }

    /// By how much each bound and its slack do not fit together.
    fn off(&self, x: &[f64]) -> [f64; 2] {
        let value = self.linear(x);
        self.sides(|side| SIDES[side] * value + self.plus[side] + self.slack[side])
    }

    /// What each product of slack and price is to lose, straight for the solution.
    fn product(&self) -> [f64; 2] {
        self.sides(|side| self.slack[side] * self.price[side])
    }

    /// The same with the curvature that the first step saw, back towards the middle.
    fn corrected(&self, centre: f64) -> [f64; 2] {
        self.sides(|side| self.slack[side] * self.price[side] + (self.d_slack[side] * self.d_price[side] - centre))
    }
}

/// The programme: least sum of squares of `bends`, all `bounds` at most zero. Heights and lengths are scaled so that the largest limit
/// and the mean step are 1.
struct Problem<'a> {
    stretch: &'a Stretch<'a>,
    start: &'a [f64],
    height: f64,
    unknowns: usize,
    bends: Vec<Row>,
    bounds: Vec<Pair>,
}

impl<'a> Problem<'a> {
    fn new(stretch: &'a Stretch<'a>, start: &'a [f64]) -> Self {
        let last = start.len() - 1;
        let length = (stretch.s[last] - stretch.s[0]) / last as f64;
        let steepest = stretch.limits.iter().copied().fold(1e-12, f64::max);
        let height = steepest * length;
        let mut problem = Self {
            stretch,
            start,
            height,
            unknowns: last - 1,
            bends: Vec::with_capacity(last + 1),
            bounds: Vec::with_capacity(2 * last),
        };
        let d: Vec<f64> = stretch.s.windows(2).map(|s| (s[1] - s[0]) / length).collect();
        for at in 1..last {
            problem.bend(at, [1.0 / d[at - 1], -1.0 / d[at - 1] - 1.0 / d[at], 1.0 / d[at]]);
        }
        if let Some(before) = stretch.outside[0] {
            let row = problem.row([(0, -1.0 / d[0]), (1, 1.0 / d[0]), (1, 0.0)], -before / steepest);
            problem.bends.push(row);
        }
        if let Some(after) = stretch.outside[1] {
            let by = 1.0 / d[last - 1];
            let row = problem.row([(last - 1, -by), (last, by), (last, 0.0)], -after / steepest);
            problem.bends.push(row);
        }
        for (at, (d, limit)) in d.iter().zip(stretch.limits).enumerate() {
            if at > 0 {
                let form = problem.row([(at, 1.0), (at, 0.0), (at, 0.0)], 0.0);
                problem.bound(&form, [stretch.upper[at] / height, stretch.lower[at] / height]);
            }
            let form = problem.row([(at, -1.0 / d), (at + 1, 1.0 / d), (at + 1, 0.0)], 0.0);
            problem.bound(&form, [limit / steepest, -limit / steepest]);
        }
        problem
    }

    fn bend(&mut self, at: usize, [a, b, c]: [f64; 3]) {
        let row = self.row([(at - 1, a), (at, b), (at + 1, c)], 0.0);
        self.bends.push(row);
    }

    /// Keeps a form of at most two unknowns between an upper and a lower bound; infinite where there is none.
    fn bound(&mut self, form: &Row, bounds: [f64; 2]) {
        let there = bounds.map(f64::is_finite);
        self.bounds.push(Pair {
            at: form.at,
            by: [form.by[0], form.by[1]],
            plus: [0, 1].map(|side| {
                if there[side] {
                    SIDES[side] * (form.plus - bounds[side])
                } else {
                    0.0
                }
            }),
            counts: there.map(f64::from),
            slack: [1.0; 2],
            price: there.map(|there| if there { 1e-2 } else { 0.0 }),
            d_slack: [0.0; 2],
            d_price: [0.0; 2],
        });
    }

    /// A row of coefficients of stations; the ends are known.
    fn row(&self, terms: [(usize, f64); 3], plus: f64) -> Row {
        let first = terms.iter().map(|(at, _)| at.saturating_sub(1)).min().unwrap_or(0);
        let at = first.min(self.unknowns.saturating_sub(1));
        let mut row = Row { at, by: [0.0; 3], plus };
        for (station, by) in terms {
            if station == 0 || station > self.unknowns {
                row.plus += by * self.start[station] / self.height;
            } else {
                row.by[station - 1 - at] += by;
            }
        }
        row
    }

    /// All heights, clamped to the walls; `None` where the method did not converge.
    fn solve(mut self) -> Option<Vec<f64>> {
        // two more unknowns without meaning, so that every row has three
        let mut x: Vec<f64> = self.start[1..=self.unknowns]
            .iter()
            .map(|height| height / self.height)
            .collect();
        x.extend([0.0; 2]);
        for pair in &mut self.bounds {
            let value = pair.linear(&x);
            for side in [0, 1].into_iter().filter(|side| pair.counts[*side] > 0.0) {
                pair.slack[side] = (-(SIDES[side] * value + pair.plus[side])).max(1e-2);
            }
        }
        let count = self.bounds.iter().flat_map(|pair| pair.counts).sum::<f64>().max(1.0);
        let mut system = Pentadiagonal::new(x.len());
        let mut step = vec![0.0; x.len()];
        for _ in 0..ROUNDS {
            let (mut gap, mut off) = (0.0, 0.0f64);
            for pair in &self.bounds {
                let ([upper, lower], [above, below]) = (pair.product(), pair.off(&x));
                gap += upper + lower;
                off = off.max(above.abs()).max(below.abs());
            }
            gap /= count;
            if gap < EXACT * 0.1 && off < EXACT {
                return Some(self.heights(&x));
            }
            if !gap.is_finite() {
                return None;
            }
            self.matrix(&mut system);
            if !system.factor() {
                return None;
            }
            // predictor: straight for the solution
            let ahead = self.direction(&x, &system, &mut step, Pair::product);
            let then = self.bounds.iter().map(|pair| {
                let [upper, lower] = pair.sides(|side| {
                    (pair.slack[side] + ahead * pair.d_slack[side]) * (pair.price[side] + ahead * pair.d_price[side])
                });
                upper + lower
            });
            let centre = gap * (then.sum::<f64>() / count / gap).powi(3);
            // corrector: back towards the middle, and with the curvature that the predictor saw
            let by = 0.995 * self.direction(&x, &system, &mut step, |pair| pair.corrected(centre));
            for (x, step) in x.iter_mut().zip(&step) {
                *x += by * step;
            }
            for pair in &mut self.bounds {
                for side in 0..2 {
                    pair.slack[side] += by * pair.d_slack[side];
                    pair.price[side] += by * pair.d_price[side];
                }
            }
        }
        None
    }

    /// The heights of the unknowns with the ends.
    fn heights(&self, x: &[f64]) -> Vec<f64> {
        let last = self.start.len() - 1;
        let inner = (1..last).map(|at| (x[at - 1] * self.height).clamp(self.stretch.lower[at], self.stretch.upper[at]));
        core::iter::once(self.start[0])
            .chain(inner)
            .chain([self.start[last]])
            .collect()
    }

    /// H + G' (Z / S) G.
    fn matrix(&self, system: &mut Pentadiagonal) {
        system.clear();
        for row in &self.bends {
            system.add(row.at, row.by, 1.0);
        }
        for pair in &self.bounds {
            let [upper, lower] = [0, 1].map(|side| pair.price[side] / pair.slack[side]);
            let [a, b] = pair.by;
            system.add(pair.at, [a, b, 0.0], upper + lower);
        }
    }

    /// One Newton step for what is left of each product of slack and price. Gives the longest step, at most 1, that keeps all slacks and prices positive.
    fn direction(
        &mut self,
        x: &[f64],
        system: &Pentadiagonal,
        step: &mut [f64],
        rest: impl Fn(&Pair) -> [f64; 2],
    ) -> f64 {
        step.fill(0.0);
        for row in &self.bends {
            let by = row.value(x);
            for (step, coefficient) in step[row.at..row.at + 3].iter_mut().zip(row.by) {
                *step -= coefficient * by;
            }
        }
        for pair in &self.bounds {
            let (rest, off) = (rest(pair), pair.off(x));
            let [upper, lower] =
                [0, 1].map(|side| pair.price[side] + (pair.price[side] * off[side] - rest[side]) / pair.slack[side]);
            for (step, coefficient) in step[pair.at..pair.at + 2].iter_mut().zip(pair.by) {
                *step -= coefficient * (upper - lower);
            }
        }
        system.solve(step);
        let mut longest = 1.0f64;
        for pair in &mut self.bounds {
            let (rest, off, turned) = (rest(pair), pair.off(x), pair.linear(step));
            pair.d_slack = pair.sides(|side| -off[side] - SIDES[side] * turned);
            for (side, rest) in rest.into_iter().enumerate() {
                pair.d_price[side] = (-rest - pair.price[side] * pair.d_slack[side]) / pair.slack[side];
                for (value, step) in [
                    (pair.slack[side], pair.d_slack[side]),
                    (pair.price[side], pair.d_price[side]),
                ] {
                    // only then is the step shorter: a division less
                    if value < -step * longest {
                        longest = -value / step;
                    }
                }
            }
        }
        longest
    }
}
