//! The smoothest way through a tube: no steeper than a limit at each step, with the least sum of squares of the changes of slope.
//!
//! A convex quadratic programme, solved by Mehrotra's predictor-corrector interior point method (SIAM J. Optim. 2, 1992). Each
//! station is joined with its two neighbours on either side only, so that every linear system is pentadiagonal and the work is
//! linear in the stations.

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
        self.plus + self.linear(x)
    }

    /// The same without the constant.
    fn linear(&self, x: &[f64]) -> f64 {
        let [a, b, c] = self.by;
        let x = &x[self.at..self.at + 3];
        a * x[0] + b * x[1] + c * x[2]
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
    bounds: Vec<Row>,
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
            bounds: Vec::with_capacity(4 * last),
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
        for at in 1..last {
            for (wall, side) in [(stretch.upper[at], 1.0), (stretch.lower[at], -1.0)] {
                if wall.is_finite() {
                    let row = problem.row([(at, side), (at, 0.0), (at, 0.0)], -side * wall / height);
                    problem.bounds.push(row);
                }
            }
        }
        for (at, (d, limit)) in d.iter().zip(stretch.limits).enumerate() {
            for side in [1.0, -1.0] {
                let row = problem.row([(at, -side / d), (at + 1, side / d), (at + 1, 0.0)], -limit / steepest);
                problem.bounds.push(row);
            }
        }
        problem
    }

    fn bend(&mut self, at: usize, [a, b, c]: [f64; 3]) {
        let row = self.row([(at - 1, a), (at, b), (at + 1, c)], 0.0);
        self.bends.push(row);
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
    fn solve(&self) -> Option<Vec<f64>> {
        let count = self.bounds.len();
        // two more unknowns without meaning, so that every row has three
        let mut x: Vec<f64> = self.start[1..=self.unknowns]
            .iter()
            .map(|height| height / self.height)
            .collect();
        x.extend([0.0; 2]);
        let mut slack: Vec<f64> = self.bounds.iter().map(|row| (-row.value(&x)).max(1e-2)).collect();
        let mut price = vec![1e-2; count];
        let (mut system, mut step, mut d_slack, mut d_price) = (
            Pentadiagonal::new(x.len()),
            vec![0.0; x.len()],
            vec![0.0; count],
            vec![0.0; count],
        );
        let mut rest = vec![0.0; count];
        // by how much each bound and its slack do not fit together
        let mut off = vec![0.0; count];
        for _ in 0..ROUNDS {
            let gap = slack.iter().zip(&price).map(|(s, z)| s * z).sum::<f64>() / count.max(1) as f64;
            for (off, (row, s)) in off.iter_mut().zip(self.bounds.iter().zip(&slack)) {
                *off = row.value(&x) + s;
            }
            if gap < EXACT * 0.1 && off.iter().all(|off| off.abs() < EXACT) {
                return Some(self.heights(&x));
            }
            if !gap.is_finite() {
                return None;
            }
            self.matrix(&slack, &price, &mut system);
            if !system.factor() {
                return None;
            }
            // predictor: straight for the solution
            for (rest, (s, z)) in rest.iter_mut().zip(slack.iter().zip(&price)) {
                *rest = s * z;
            }
            self.direction(
                &x,
                (&slack, &price, &rest, &off),
                &system,
                (&mut step, &mut d_slack, &mut d_price),
            );
            let ahead = longest(&slack, &d_slack).min(longest(&price, &d_price));
            let then = slack.iter().zip(&d_slack).zip(price.iter().zip(&d_price));
            let then = then
                .map(|((s, ds), (z, dz))| (s + ahead * ds) * (z + ahead * dz))
                .sum::<f64>()
                / count.max(1) as f64;
            let centre = gap * (then / gap).powi(3);
            // corrector: back towards the middle, and with the curvature that the predictor saw
            for (at, rest) in rest.iter_mut().enumerate() {
                *rest += d_slack[at] * d_price[at] - centre;
            }
            self.direction(
                &x,
                (&slack, &price, &rest, &off),
                &system,
                (&mut step, &mut d_slack, &mut d_price),
            );
            let (by, price_by) = (0.995 * longest(&slack, &d_slack), 0.995 * longest(&price, &d_price));
            let by = by.min(price_by);
            advance(&mut x, &step, by);
            advance(&mut slack, &d_slack, by);
            advance(&mut price, &d_price, by);
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
    fn matrix(&self, slack: &[f64], price: &[f64], system: &mut Pentadiagonal) {
        system.clear();
        for row in &self.bends {
            system.add(row, 1.0);
        }
        for (row, (s, z)) in self.bounds.iter().zip(slack.iter().zip(price)) {
            system.add(row, z / s);
        }
    }

    /// One Newton step for what is left of each product of slack and price.
    fn direction(
        &self,
        x: &[f64],
        (slack, price, rest, off): (&[f64], &[f64], &[f64], &[f64]),
        system: &Pentadiagonal,
        (step, d_slack, d_price): (&mut Vec<f64>, &mut [f64], &mut [f64]),
    ) {
        step.fill(0.0);
        let mut subtract = |row: &Row, by: f64| {
            let step = &mut step[row.at..row.at + 3];
            for (step, coefficient) in step.iter_mut().zip(row.by) {
                *step -= coefficient * by;
            }
        };
        for row in &self.bends {
            subtract(row, row.value(x));
        }
        let known = slack.iter().zip(price).zip(rest.iter().zip(off));
        for (row, ((slack, price), (rest, off))) in self.bounds.iter().zip(known.clone()) {
            subtract(row, price + (price * off - rest) / slack);
        }
        system.solve(step);
        let found = d_slack.iter_mut().zip(d_price.iter_mut());
        for ((row, ((slack, price), (rest, off))), (d_slack, d_price)) in self.bounds.iter().zip(known).zip(found) {
            *d_slack = -off - row.linear(step);
            *d_price = (-rest - price * *d_slack) / slack;
        }
    }
}

/// The longest step, at most 1, that keeps all values positive.
fn longest(values: &[f64], steps: &[f64]) -> f64 {
    let pairs = values.iter().zip(steps).filter(|(_, step)| **step < 0.0);
    pairs.map(|(value, step)| -value / step).fold(1.0, f64::min)
}

fn advance(values: &mut [f64], steps: &[f64], by: f64) {
    for (value, step) in values.iter_mut().zip(steps) {
        *value += by * step;
    }
}

/// A symmetric matrix with two diagonals on either side of the middle one, and its factors L D L'.
struct Pentadiagonal {
    /// For each row: the middle, and what joins it with the next and the one after.
    rows: Vec<[f64; 3]>,
}

impl Pentadiagonal {
    fn new(count: usize) -> Self {
        Self {
            rows: vec![[0.0; 3]; count],
        }
    }

    /// Zero, with a trace of the unit matrix for the unknowns without meaning.
    fn clear(&mut self) {
        self.rows.fill([1e-12, 0.0, 0.0]);
    }

    /// Adds `weight` times the square of a row.
    fn add(&mut self, row: &Row, weight: f64) {
        let [a, b, c] = row.by;
        let rows = &mut self.rows[row.at..];
        rows[0][0] += weight * a * a;
        rows[0][1] += weight * a * b;
        rows[0][2] += weight * a * c;
        if let Some(next) = rows.get_mut(1) {
            next[0] += weight * b * b;
            next[1] += weight * b * c;
        }
        if let Some(next) = rows.get_mut(2) {
            next[0] += weight * c * c;
        }
    }

    /// Replaces the matrix by its factors; false where it is not positive.
    fn factor(&mut self) -> bool {
        for at in 0..self.rows.len() {
            let [middle, next, after] = self.rows[at];
            if middle <= 0.0 || !middle.is_finite() {
                return false;
            }
            let (l1, l2) = (next / middle, after / middle);
            if let Some(row) = self.rows.get_mut(at + 1) {
                row[0] -= l1 * next;
                row[1] -= l1 * after;
            }
            if let Some(row) = self.rows.get_mut(at + 2) {
                row[0] -= l2 * after;
            }
            self.rows[at] = [middle, l1, l2];
        }
        true
    }

    /// Solves for a right side, in place.
    fn solve(&self, x: &mut [f64]) {
        let count = self.rows.len();
        for at in 0..count {
            let value = x[at];
            if at + 1 < count {
                x[at + 1] -= self.rows[at][1] * value;
            }
            if at + 2 < count {
                x[at + 2] -= self.rows[at][2] * value;
            }
        }
        for at in (0..count).rev() {
            let mut value = x[at] / self.rows[at][0];
            if at + 1 < count {
                value -= self.rows[at][1] * x[at + 1];
            }
            if at + 2 < count {
                value -= self.rows[at][2] * x[at + 2];
            }
            x[at] = value;
        }
    }
}
