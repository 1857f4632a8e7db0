//! A chain of lines divided into cubic curves: from corner to corner, each curve as long as it serves, with one tangent where two of them meet.
use crate::cubic::{Cubic, Data};
use crate::pieces::parsed;
use crate::style::NumberStyle;
use trunnion_certify::RefitSource;
use trunnion_geometry::Vec3;
use trunnion_geometry::abreast::{Abreast, Walked};

/// A curve takes the place of so many lines at least: it is a longer block than a line.
pub(crate) const LEAST: usize = 4;
/// Sharper turns are corners, cos of 30 deg: no curve goes through them.
const CORNER_COS: f64 = 0.866;
/// Where a line is so many times longer than its neighbour, points are no samples of one curve.
const UNEVEN: f64 = 6.0;
/// The tangent at a point follows from so many points on each side.
const NEIGHBOURS: usize = 3;
/// The share of the tolerance that the lines standing for a curve may take.
const FLAT: f64 = 0.02;
/// Nearer than this the interpreter's lines are to their curve, mm, and as near is the comparison.
const ROUNDING: f64 = 2e-5;

/// How a curve is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `POLY PO[X]=(end,a2,a3)`.
    Powers,
    /// `G5 X Y I J P Q`: in the plane of X and Y.
    Handles,
}

/// What a curve must keep to, and how numbers are written.
pub(crate) struct Terms {
    pub tolerance_mm: f64,
    pub source: RefitSource,
    pub form: Form,
    /// How X, Y and Z are written.
    pub style: NumberStyle,
    /// mm per programmed length unit.
    pub unit_mm: f64,
    /// How far the control may be from the curve that is written, mm.
    pub control_mm: f64,
}

/// A curve as it is written, in the place of the lines between two points of a chain.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spline {
    /// Index of its first point.
    pub from: usize,
    /// Index of its last point.
    pub to: usize,
    /// Numbers after the end of each axis: [`Form::Powers`]: factors of the second and third power of X, Y and Z, none where the axis runs
    /// evenly; [`Form::Handles`]: of X and of Y, the distances of the inner Bézier points from start and end.
    pub numbers: [Vec<String>; 3],
    /// No point of the lines or the curve is farther from the other than this, mm.
    pub off_mm: f64,
}

/// The curves for a chain of lines through `points`, in order. `takes(from, to)`: whether the text of these lines can be changed to one block.
/// Doing the same to what is left between the curves finds no more.
pub(crate) fn splines(points: &[Vec3], terms: &Terms, takes: &impl Fn(usize, usize) -> bool) -> Vec<Spline> {
    let mut found: Vec<Spline> = Vec::new();
    let mut open = vec![(0, points.len() - 1)];
    while let Some((first, last)) = open.pop() {
        if last < first + LEAST {
            continue;
        }
        let before = found.len();
        for (from, to) in runs(&points[first..=last], terms.form) {
            let run = Run {
                points: &points[first + from..=first + to],
                start: first + from,
                terms,
                takes,
            };
            run.divide(&mut found);
        }
        if found.len() == before {
            continue;
        }
        // what is left is a chain of its own, in which tangents may be others
        let mut at = first;
        for spline in &found[before..] {
            open.push((at, spline.from));
            at = spline.to;
        }
        open.push((at, last));
    }
    found.sort_by_key(|spline| spline.from);
    found
}

/// Parts of a chain that one smooth curve may follow: first and last point. Corners, and long lines beside short ones, divide them.
fn runs(points: &[Vec3], form: Form) -> Vec<(usize, usize)> {
    let usable = |index: usize| {
        let way = points[index + 1] - points[index];
        form == Form::Powers || way.z == 0.0
    };
    let divides = |index: usize| {
        let (was, is) = (points[index] - points[index - 1], points[index + 1] - points[index]);
        let (short, long) = (was.norm().min(is.norm()), was.norm().max(is.norm()));
        long > UNEVEN * short || was.dot(&is) < CORNER_COS * short * long
    };
    let mut all = Vec::new();
    let mut from = 0;
    for index in 1..points.len() {
        let ends = index + 1 == points.len() || divides(index) || !usable(index) || !usable(index - 1);
        if ends {
            if index >= from + LEAST && usable(index - 1) {
                all.push((from, index));
            }
            from = index;
        }
    }
    all
}

/// A smooth part of a chain.
struct Run<'a, T> {
    points: &'a [Vec3],
    /// Index of its first point in the chain.
    start: usize,
    terms: &'a Terms,
    takes: &'a T,
}

impl<T: Fn(usize, usize) -> bool> Run<'_, T> {
    /// Adds curves, each from where the last one ends as far as it serves.
    fn divide(&self, found: &mut Vec<Spline>) {
        let last = self.points.len() - 1;
        let first = found.len();
        let mut at = 0;
        while at + LEAST <= last {
            match self.longest(at) {
                Some(spline) => {
                    at = spline.to - self.start;
                    found.push(spline);
                }
                None => at += 1,
            }
        }
        // a rest that is too short for a curve takes some lines of the curve before it
        let before = found[first..]
            .last()
            .map(|spline| (spline.from - self.start, spline.to - self.start));
        if let Some((from, to)) = before.filter(|(_, to)| *to + 2 <= last && last < to + LEAST)
            && last >= from + 2 * LEAST
            && let Some(left) = self.spline(from, last - LEAST)
            && let Some(right) = self.spline(last - LEAST, last)
        {
            debug_assert!(to <= last, "it is in the run");
            found.pop();
            found.extend([left, right]);
        }
    }

    /// The curve with the most lines from a point, by doubling and halving their number.
    fn longest(&self, from: usize) -> Option<Spline> {
        let most = self.points.len() - 1 - from;
        let mut best = self.spline(from, from + LEAST)?;
        let (mut good, mut bad) = (LEAST, most + 1);
        while good < most && bad > most {
            let next = (2 * good).min(most);
            match self.spline(from, from + next) {
                Some(spline) => (good, best) = (next, spline),
                None => bad = next,
            }
        }
        while good + 1 < bad.min(most + 1) {
            let middle = usize::midpoint(good, bad);
            match self.spline(from, from + middle) {
                Some(spline) => (good, best) = (middle, spline),
                None => bad = middle,
            }
        }
        Some(best)
    }

    /// The curve for the lines between two points, as it is written, if one serves.
    fn spline(&self, from: usize, to: usize) -> Option<Spline> {
        let terms = self.terms;
        if !(self.takes)(self.start + from, self.start + to) {
            return None;
        }
        let points = &self.points[from..=to];
        let tangents = [from, to].map(|at| self.tangent(at));
        let data = Data::new(points, terms.source == RefitSource::Chords)?;
        let cubic = data.fit(tangents, terms.tolerance_mm)?;
        let (numbers, written) = write(&cubic, terms)?;
        let off_mm = apart(points, &written, terms)?;
        (off_mm <= terms.tolerance_mm).then_some(Spline {
            from: self.start + from,
            to: self.start + to,
            numbers,
            off_mm,
        })
    }

    /// The direction of the path at a point of the run: that of the parabola through it that comes nearest to its neighbours. `None` at the ends
    /// of the run, where no other curve has to go on.
    fn tangent(&self, at: usize) -> Option<Vec3> {
        let last = self.points.len() - 1;
        if at == 0 || at == last {
            return None;
        }
        let middle = self.points[at];
        let mut sums = [0.0; 3];
        let (mut linear, mut square) = (Vec3::zeros(), Vec3::zeros());
        let mut add = |way: f64, point: &Vec3| {
            let off = point - middle;
            let powers = [way * way, way * way * way, way * way * way * way];
            sums.iter_mut().zip(powers).for_each(|(sum, power)| *sum += power);
            linear += off * way;
            square += off * (way * way);
        };
        let mut way = 0.0;
        for index in (at.saturating_sub(NEIGHBOURS)..at).rev() {
            way -= (self.points[index + 1] - self.points[index]).norm();
            add(way, &self.points[index]);
        }
        way = 0.0;
        for index in at + 1..=(at + NEIGHBOURS).min(last) {
            way += (self.points[index] - self.points[index - 1]).norm();
            add(way, &self.points[index]);
        }
        let [s2, s3, s4] = sums;
        let direction = linear * s4 - square * s3;
        (s2 * s4 - s3 * s3 > 0.0)
            .then(|| direction.try_normalize(0.0))
            .flatten()
    }
}

/// The numbers of a curve, and the curve that they are; `None` where it cannot be written.
fn write(cubic: &Cubic, terms: &Terms) -> Option<([Vec<String>; 3], Cubic)> {
    let style = terms.style.with_decimals(terms.style.decimals + 1);
    let ends = [cubic.0[0], cubic.0[3]];
    let number = |value: f64| {
        let text = style.write(value / terms.unit_mm, false);
        let read = parsed(&text)? * terms.unit_mm;
        Some((text, read))
    };
    let mut numbers = [const { Vec::new() }; 3];
    let pairs = match terms.form {
        Form::Powers => cubic.powers(),
        Form::Handles => [cubic.0[1] - ends[0], cubic.0[2] - ends[1]],
    };
    let mut read = [Vec3::zeros(); 2];
    let axes = if terms.form == Form::Powers { 3 } else { 2 };
    for axis in 0..axes {
        let (first, second) = (number(pairs[0][axis])?, number(pairs[1][axis])?);
        (read[0][axis], read[1][axis]) = (first.1, second.1);
        if terms.form == Form::Handles || second.1 != 0.0 {
            numbers[axis] = vec![first.0, second.0];
        } else if first.1 != 0.0 {
            numbers[axis] = vec![first.0];
        }
    }
    if numbers.iter().all(Vec::is_empty)
        || terms.form == Form::Handles && read.iter().any(|handle| handle.norm() == 0.0)
    {
        return None;
    }
    let written = match terms.form {
        Form::Powers => Cubic::from_powers(ends, read),
        Form::Handles => Cubic([ends[0], ends[0] + read[0], ends[1] + read[1], ends[1]]),
    };
    Some((numbers, written))
}

/// How far the lines through points and a curve lie apart, in order, mm: a bound.
fn apart(points: &[Vec3], cubic: &Cubic, terms: &Terms) -> Option<f64> {
    let flat = ROUNDING.max(FLAT * terms.tolerance_mm);
    let lines = cubic.lines(flat)?;
    let mut abreast = Abreast::new(points[0], cubic.0[0]);
    let (mut at, mut on) = (1, 0);
    while at < points.len() && on < lines.len() {
        let walked = abreast.to([points[at], lines[on]], 1e-9);
        at += usize::from(walked != Walked::Second);
        on += usize::from(walked != Walked::First);
        if abreast.points_apart() > terms.tolerance_mm {
            return None;
        }
    }
    let found = if terms.source == RefitSource::Points {
        abreast.points_apart()
    } else {
        abreast.apart()
    };
    (at == points.len() && on == lines.len()).then_some(found + flat + ROUNDING + terms.control_mm)
}
