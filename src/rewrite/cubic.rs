//! A cubic curve by its Bézier points, and the one that comes nearest to some points between given ends.
//!
//! The fit is that of Schneider (An algorithm for automatically fitting digitized curves, Graphics Gems, 1990): least squares for the two inner
//! points, with the parameters of the data from chord lengths and then from their feet on the curve. An inner point is free where the path
//! begins or ends, and on the given tangent elsewhere.
use nalgebra::{SMatrix, SVector};
use trunnion_geometry::Vec3;

/// A cubic curve over 0..1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cubic(pub(crate) [Vec3; 4]);

/// Rounds of moving the parameters to the feet.
const ROUNDS: usize = 5;
/// No leg between two Bézier points is shorter than this share of the chord: the control would have to slow down there.
const SHORTEST_LEG: f64 = 0.05;
/// Halvings of a curve.
const MOST_HALVINGS: u32 = 16;

fn weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

impl Cubic {
    pub(crate) fn at(&self, t: f64) -> Vec3 {
        let [a, b, c, d] = weights(t);
        self.0[0] * a + self.0[1] * b + self.0[2] * c + self.0[3] * d
    }

    /// First and second derivative.
    fn slopes(&self, t: f64) -> [Vec3; 2] {
        let [p, q, r, s] = self.0;
        let (u, v, w) = (q - p, r - q, s - r);
        let first = (u * (1.0 - t) * (1.0 - t) + v * (2.0 * t * (1.0 - t)) + w * (t * t)) * 3.0;
        [first, ((v - u) * (1.0 - t) + (w - v) * t) * 6.0]
    }

    /// Factors of the second and third power of the parameter.
    pub(crate) fn powers(&self) -> [Vec3; 2] {
        let [p, q, r, s] = self.0;
        [(p - q * 2.0 + r) * 3.0, s - r * 3.0 + q * 3.0 - p]
    }

    /// The curve from its ends and these factors.
    pub(crate) fn from_powers([start, end]: [Vec3; 2], [second, third]: [Vec3; 2]) -> Self {
        let first = end - start - second - third;
        let q = start + first / 3.0;
        Self([start, q, start + first * (2.0 / 3.0) + second / 3.0, end])
    }

    fn halves(&self) -> [Self; 2] {
        let [p, q, r, s] = self.0;
        let middle = |a: Vec3, b: Vec3| (a + b) * 0.5;
        let (pq, qr, rs) = (middle(p, q), middle(q, r), middle(r, s));
        let (left, right) = (middle(pq, qr), middle(qr, rs));
        let centre = middle(left, right);
        [Self([p, pq, left, centre]), Self([centre, right, rs, s])]
    }

    /// The ends of lines that leave the curve by no more than `flat`, in order; `None` where that takes too many.
    pub(crate) fn lines(&self, flat: f64) -> Option<Vec<Vec3>> {
        let mut open = vec![(*self, 0)];
        let mut ends = Vec::new();
        while let Some((piece, depth)) = open.pop() {
            if piece.is_flat(flat) {
                ends.push(piece.0[3]);
            } else if depth == MOST_HALVINGS {
                return None;
            } else {
                let [left, right] = piece.halves();
                open.extend([(right, depth + 1), (left, depth + 1)]);
            }
        }
        Some(ends)
    }

    fn is_flat(&self, flat: f64) -> bool {
        let [from, q, r, to] = self.0;
        let way = to - from;
        let square = way.norm_squared();
        if square <= 0.0 {
            return [q, r].iter().all(|inner| (inner - from).norm() <= flat);
        }
        let share = |inner: &Vec3| (inner - from).dot(&way) / square;
        let (first, second) = (share(&q), share(&r));
        let near = |inner: &Vec3, share: f64| (inner - from - way * share).norm() <= flat;
        0.0 <= first && first <= second && second <= 1.0 && near(&q, first) && near(&r, second)
    }

    /// The legs between the Bézier points go on, and none is too short for an even speed.
    fn runs_evenly(&self) -> bool {
        let [p, q, r, s] = self.0;
        let least = SHORTEST_LEG * (s - p).norm();
        let legs = [q - p, r - q, s - r];
        legs.iter().all(|leg| leg.norm() >= least) && legs.windows(2).all(|pair| pair[0].dot(&pair[1]) > 0.0)
    }
}

/// Points that a curve should come near; the first and the last are its ends.
pub(crate) struct Data {
    points: Vec<Vec3>,
    parameters: Vec<f64>,
}

impl Data {
    /// `points`, and with `chords` the middles of the lines between them too. `None`: all at one place.
    pub(crate) fn new(points: &[Vec3], chords: bool) -> Option<Self> {
        let mut data = Self {
            points: vec![*points.first()?],
            parameters: vec![0.0],
        };
        let mut way = 0.0;
        for pair in points.windows(2) {
            let step = (pair[1] - pair[0]).norm();
            if chords {
                data.points.push((pair[0] + pair[1]) * 0.5);
                data.parameters.push(way + 0.5 * step);
            }
            way += step;
            data.points.push(pair[1]);
            data.parameters.push(way);
        }
        data.parameters.iter_mut().for_each(|parameter| *parameter /= way);
        (way > 0.0).then_some(data)
    }

    /// The cubic that comes nearest, with these unit tangents where they are given. `None` where all of them are farther than `hopeless` from a point.
    pub(crate) fn fit(mut self, tangents: [Option<Vec3>; 2], hopeless: f64) -> Option<Cubic> {
        let mut best = None;
        for round in 0..ROUNDS {
            let cubic = self.solve(tangents)?;
            let worst = self.move_to_feet(&cubic);
            if best.is_none_or(|(_, off)| worst < off) {
                best = Some((cubic, worst));
            }
            if worst > hopeless * if round == 0 { 20.0 } else { 4.0 } {
                return None;
            }
        }
        let (cubic, worst) = best?;
        (worst <= hopeless && cubic.runs_evenly()).then_some(cubic)
    }

    /// Moves each parameter one step of Newton's method nearer to the foot of its point; the largest distance of a point.
    fn move_to_feet(&mut self, cubic: &Cubic) -> f64 {
        let mut worst: f64 = 0.0;
        let last = self.points.len() - 1;
        for (point, parameter) in self.points[1..last].iter().zip(&mut self.parameters[1..last]) {
            let off = cubic.at(*parameter) - point;
            let [first, second] = cubic.slopes(*parameter);
            let (value, slope) = (off.dot(&first), first.norm_squared() + off.dot(&second));
            if slope > 0.0 {
                *parameter = (*parameter - value / slope).clamp(0.0, 1.0);
            }
            worst = worst.max((cubic.at(*parameter) - point).norm());
        }
        worst
    }

    /// Least squares for the inner Bézier points: one unknown on a tangent, three where the point is free.
    fn solve(&self, tangents: [Option<Vec3>; 2]) -> Option<Cubic> {
        let last = self.points.len() - 1;
        let (start, end) = (self.points[0], self.points[last]);
        let directions: Vec<(usize, Vec3)> = [(0, tangents[0]), (1, tangents[1].map(|tangent| -tangent))]
            .into_iter()
            .flat_map(|(inner, tangent)| match tangent {
                Some(tangent) => vec![(inner, tangent)],
                None => [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| (inner, axis)).to_vec(),
            })
            .collect();
        // unknowns that are not there are 0
        let mut matrix = SMatrix::<f64, 6, 6>::identity();
        let mut right = SVector::<f64, 6>::zeros();
        for index in 0..directions.len() {
            matrix[(index, index)] = 0.0;
        }
        for (point, &t) in self.points[1..last].iter().zip(&self.parameters[1..last]) {
            let [a, b, c, d] = weights(t);
            let share = [b, c];
            let rest = point - start * (a + b) - end * (c + d);
            for (row, (inner, direction)) in directions.iter().enumerate() {
                right[row] += share[*inner] * direction.dot(&rest);
                for (column, (other, along)) in directions.iter().enumerate() {
                    matrix[(row, column)] += share[*inner] * share[*other] * direction.dot(along);
                }
            }
        }
        let found = matrix.cholesky()?.solve(&right);
        let mut inner = [start, end];
        for ((index, direction), length) in directions.iter().zip(found.iter()) {
            inner[*index] += direction * *length;
        }
        let along = |index: usize| {
            tangents[index].is_none_or(|_| found[if index == 0 { 0 } else { directions.len() - 1 }] > 0.0)
        };
        (along(0) && along(1)).then_some(Cubic([start, inner[0], inner[1], end]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> Cubic {
        Cubic([
            Vec3::zeros(),
            Vec3::new(3.0, 4.0, 0.5),
            Vec3::new(8.0, 5.0, -1.0),
            Vec3::new(12.0, 0.0, 2.0),
        ])
    }

    fn points(count: u32) -> Vec<Vec3> {
        (0..=count)
            .map(|step| curve().at(f64::from(step) / f64::from(count)))
            .collect()
    }

    /// Parameters by lengths are far from those of this curve, whose legs differ much: five rounds bring the fit to 1 % of its length.
    #[test]
    fn a_cubic_is_approached() {
        let [p, q, r, s] = curve().0;
        let tangents = [(q - p).normalize(), (s - r).normalize()];
        for given in [
            [Some(tangents[0]), Some(tangents[1])],
            [None, Some(tangents[1])],
            [Some(tangents[0]), None],
            [None, None],
        ] {
            let found = Data::new(&points(40), false)
                .and_then(|data| data.fit(given, 0.15))
                .expect("a fit");
            for step in 0..=20 {
                let t = f64::from(step) / 20.0;
                let nearest = (0..=4000).map(|i| (found.at(f64::from(i) / 4000.0) - curve().at(t)).norm());
                assert!(nearest.fold(f64::INFINITY, f64::min) < 0.15, "{given:?} {t}");
            }
        }
        let back = [Some(-tangents[0]), Some(tangents[1])];
        assert!(
            Data::new(&points(40), false)
                .and_then(|data| data.fit(back, 0.15))
                .is_none()
        );
    }

    #[test]
    fn powers_are_the_curve() {
        let cubic = curve();
        let again = Cubic::from_powers([cubic.0[0], cubic.0[3]], cubic.powers());
        for (a, b) in cubic.0.iter().zip(&again.0) {
            assert!((a - b).norm() < 1e-12);
        }
    }

    #[test]
    fn lines_keep_to_the_curve() {
        let ends = curve().lines(1e-3).expect("lines");
        let mut all = vec![curve().0[0]];
        all.extend(&ends);
        for step in 0..=1000 {
            let at = curve().at(f64::from(step) / 1000.0);
            let off = all.windows(2).map(|pair| {
                let way = pair[1] - pair[0];
                let share = ((at - pair[0]).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
                (at - pair[0] - way * share).norm()
            });
            assert!(off.fold(f64::INFINITY, f64::min) <= 1e-3);
        }
        assert!(ends.len() > 20 && ends.len() < 200, "{}", ends.len());
    }
}
