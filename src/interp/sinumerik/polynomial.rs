//! POLY: a path whose coordinates are polynomials of a parameter p from 0 to PL (1 where it is left out).
//!
//! `PO[X]=(e,a2,a3,a4,a5)`: f(p) = a0 + a1 p + a2 p^2 + .., a0 is the start, and a1 follows from the end e. `PO[]=(d,d2,..)` is a common
//! denominator of constant 1; ends are those of the quotient. Axes without PO run linear. Source: Sinumerik 840D Programming Guide Advanced
//! (04.00), 5-163 to 5-167; Job Planning (03/2006), 5-17; 840D sl Programming Manual (12/2019), p. 610.
//!
//! The path becomes lines that leave it by at most [`CHORD_MM`], in order; each carries that bound ([`Motion::slack_mm`]). It is proved: between
//! two values of p the curve is inside the hull of its Bernstein points while the weights are positive, and no point is farther from the line.
//! If they come one after the other along the line, so does the curve. What is not computed has a known end.
use crate::codes::BlockCodes;
use crate::core::{LINEAR, ROTARY, Report};
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::{Number, Reading, WordValue, Words, put};
use crate::{AXIS_LETTERS, FaultKind, Feed, FeedMode, Motion, MotionKind};
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;
use trunnion_syntax::{TextRange, Word};

/// How far the lines leave the path at most, mm.
pub(super) const CHORD_MM: f64 = 1e-5;
/// Halvings of a block, and lines of it.
const MOST_HALVINGS: u32 = 24;
pub(super) const MOST_LINES: usize = 20_000;
/// Coefficients of a polynomial of degree 5.
pub(super) const N: usize = 6;

/// A PO word: its first number and the coefficients from a2 on.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Coefficients {
    end: f64,
    rest: [f64; N - 2],
}

/// The words of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PolynomialWords {
    axes: [Option<Coefficients>; 3],
    denominator: Option<Coefficients>,
    /// PL.
    pub(super) length: Option<f64>,
    /// A value is not known, or belongs to another axis.
    pub(super) unread: bool,
}

impl PolynomialWords {
    pub(crate) fn any(&self) -> bool {
        self.axes.iter().any(Option::is_some) || self.denominator.is_some() || self.length.is_some() || self.unread
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `PO[X]=(10,2,1)`, `PO[]=(2,1)` and `PL=`. False: another word.
    pub(crate) fn polynomial(&mut self, name: &[u8], word: &Word) -> bool {
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        if name == "PL" && self.own.is_some() {
            self.first(word);
            let text = self.text(word.value_range).trim().to_owned();
            if let Some(own) = self.own.as_mut() {
                let value = own.value(&text).filter(|value| *value > 0.0);
                own.polynomial.unread |= value.is_none() || own.polynomial.length.is_some();
                own.polynomial.length = value;
            }
            self.words.has_values = true;
            return true;
        }
        let axis = name.strip_prefix("PO").map(str::trim);
        let axis = axis.and_then(|rest| rest.strip_prefix('[')?.strip_suffix(']').map(str::trim));
        let (Some(axis), true) = (axis, self.own.is_some()) else {
            return false;
        };
        self.first(word);
        self.words.has_values = true;
        self.words.polynomial = true;
        let text = self.text(word.value_range).trim().to_owned();
        let Some(own) = self.own.as_mut() else { return false };
        let read = |text: &str| own.value(text.trim());
        let numbers = text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let said: Option<Vec<Option<f64>>> =
            numbers.map(|numbers| crate::own::arguments(numbers).iter().map(|one| read(one)).collect());
        let end = said.as_ref().and_then(|said| *said.first()?);
        let found = said.and_then(|said| coefficients(&said));
        own.polynomial.unread |= found.is_none();
        if axis.is_empty() {
            own.polynomial.unread |= own.polynomial.denominator.is_some();
            own.polynomial.denominator = found;
            return true;
        }
        let place = AXIS_LETTERS.iter().position(|letter| axis.as_bytes() == [*letter]);
        match place.filter(|place| *place < 3) {
            Some(place) => {
                own.polynomial.unread |= own.polynomial.axes[place].is_some();
                own.polynomial.axes[place] = found;
            }
            // of a rotary axis or an orientation
            None => own.polynomial.unread = true,
        }
        match (place, end) {
            (Some(place), Some(value)) => {
                let number = Number {
                    value,
                    has_point: true,
                    range: word.range,
                };
                put(&mut self.words.axes, place, (WordValue::Number(number), Reading::Modal));
            }
            (Some(place), None) => put(&mut self.words.axes, place, (WordValue::Unread, Reading::Modal)),
            (None, _) => {
                self.words.forgets_all = true;
                self.not_modelled(word.range);
            }
        }
        true
    }
}

/// The end and up to four coefficients, all known.
fn coefficients(said: &[Option<f64>]) -> Option<Coefficients> {
    let (end, rest) = said.split_first()?;
    let mut found = Coefficients {
        end: (*end)?,
        rest: [0.0; N - 2],
    };
    if rest.len() > found.rest.len() {
        return None;
    }
    for (slot, value) in found.rest.iter_mut().zip(rest) {
        *slot = (*value)?;
    }
    Some(found)
}

/// Power coefficients over 0..1 from those over 0..length: a0, the value at the end, a2 and on.
fn powers(start: f64, end: f64, rest: [f64; N - 2], length: f64) -> [f64; N] {
    let mut all = [0.0; N];
    all[0] = start;
    let mut scale = length;
    for (slot, value) in all[2..].iter_mut().zip(rest) {
        scale *= length;
        *slot = value * scale;
    }
    all[1] = end - start - all[2..].iter().sum::<f64>();
    all
}

/// Bernstein coefficients of degree 5 of a polynomial over 0..1.
fn bernstein(powers: [f64; N]) -> [f64; N] {
    const CHOOSE: [[f64; N]; N] = [
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 2.0, 1.0, 0.0, 0.0, 0.0],
        [1.0, 3.0, 3.0, 1.0, 0.0, 0.0],
        [1.0, 4.0, 6.0, 4.0, 1.0, 0.0],
        [1.0, 5.0, 10.0, 10.0, 5.0, 1.0],
    ];
    core::array::from_fn(|j| (0..=j).map(|i| CHOOSE[j][i] / CHOOSE[5][i] * powers[i]).sum())
}

/// A piece of the curve: numerators of X, Y, Z and the denominator at its Bernstein points.
pub(super) type Piece = [[f64; 4]; N];

/// Both halves (de Casteljau).
fn halves(piece: &Piece) -> [Piece; 2] {
    let (mut left, mut right, mut work) = (*piece, *piece, *piece);
    for (level, slot) in left.iter_mut().enumerate() {
        *slot = work[0];
        right[N - 1 - level] = work[N - 1 - level];
        let before = work;
        for (at, pair) in before[..N - level].windows(2).enumerate() {
            work[at] = core::array::from_fn(|axis| 0.5 * (pair[0][axis] + pair[1][axis]));
        }
    }
    [left, right]
}

fn point([x, y, z, weight]: [f64; 4]) -> Vec3 {
    Vec3::new(x, y, z) / weight
}

/// Whether the line from its first to its last point leaves the piece by no more than the bound.
fn is_flat(piece: &Piece) -> bool {
    if piece.iter().any(|point| point[3] <= 0.0) {
        return false;
    }
    let (from, to) = (point(piece[0]), point(piece[N - 1]));
    let way = to - from;
    let square = way.norm_squared();
    let mut reached = 0.0;
    let (mut near, mut in_order, mut extent) = (true, true, way.norm());
    for inner in &piece[1..N - 1] {
        let arm = point(*inner) - from;
        let share = if square > 0.0 { arm.dot(&way) / square } else { 0.0 };
        near &= (arm - way * share.clamp(0.0, 1.0)).norm() <= CHORD_MM;
        in_order &= share >= reached && share <= 1.0;
        reached = share;
        extent = extent.max(arm.norm());
    }
    // where the path turns back, no part of it is in order, but a short one is near any order
    near && in_order || extent <= 0.5 * CHORD_MM
}

/// The ends of the lines; `None`: the denominator has a zero, or there are too many. `looked_at` counts the pieces.
pub(super) fn lines(whole: &Piece, looked_at: &mut u64) -> Option<Vec<Vec3>> {
    let mut open = vec![(*whole, 0)];
    let mut ends = Vec::new();
    while let Some((piece, depth)) = open.pop() {
        *looked_at += 1;
        if is_flat(&piece) {
            ends.push(point(piece[N - 1]));
            if ends.len() > MOST_LINES {
                return None;
            }
        } else if depth == MOST_HALVINGS {
            return None;
        } else {
            let [left, right] = halves(&piece);
            open.extend([(right, depth + 1), (left, depth + 1)]);
        }
    }
    Some(ends)
}

impl Iso<'_> {
    /// The motion of a block under POLY.
    pub(crate) fn polynomial_motion(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) -> Motion {
        let said = self.memory.own.polynomial;
        let start = self.here();
        self.core.state.motion = Some(Action::Linear);
        let from = self.core.state.position;
        let straight = !words.polynomial;
        let mut motion = self.modelled_motion(words, block, report);
        self.core.state.motion = Some(Action::Polynomial);
        if straight && !said.unread {
            return motion;
        }
        let end = self.here();
        let plain = !said.unread
            && !block.not_modelled
            && !block.machine_coordinates
            && !words.unknown_code
            && !words.forgets_all
            && (words.axes.given | words.axes.unread) & !LINEAR == 0
            && !self.program_sets_diameters()
            && self.core.state.compensation == 0
            && !self.core.state.coordinates.incremental()
            && !self.core.state.tool_axis.tcp()
            && self.core.state.feed.mode() != FeedMode::InverseTime;
        let unit = self.core.state.coordinates.unit_mm();
        let mut looked_at = 0;
        let full = self.is_full();
        let known = start.xyz().zip(end.xyz()).filter(|_| plain && !full);
        let ends = known.and_then(|(start, end)| lines(&whole(&said, start, end, unit)?, &mut looked_at));
        self.memory.own.contour.heading_is_lost();
        let Some(ends) = ends else {
            self.cycle_motions.add_in_vain(looked_at);
            let what = if full {
                format!("POLY: {}", self.full())
            } else {
                "POLY: the path of this block: its values, or with other axes, radius compensation, TRAORI, G91 or G93"
                    .to_owned()
            };
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            motion.kind = MotionKind::Unknown;
            return motion;
        };
        let feed = match motion.feed {
            Feed::InverseTime(_) => Feed::Unknown,
            feed => feed,
        };
        let last = self.core.state.position;
        self.core.state.position = from;
        let slack_mm = CHORD_MM * self.memory.frames.most_growth();
        let first = self.memory.out.len();
        for place in ends.iter().take(ends.len() - 1) {
            let mut to = end;
            for axis in 0..3 {
                to.set(axis, place[axis]);
            }
            self.goes(MotionKind::Linear, to, feed, report);
        }
        for line in &mut self.memory.out[first..] {
            line.slack_mm = slack_mm;
        }
        motion.slack_mm = slack_mm;
        motion.start = self.memory.out.last().map_or(motion.start, |before| before.end);
        self.core.state.position = last;
        debug_assert!(motion.end.known & ROTARY == last.known & ROTARY, "POLY turns nothing");
        motion
    }
}

/// The curve of a block between its ends, mm.
fn whole(said: &PolynomialWords, start: Vec3, end: Vec3, unit: f64) -> Option<Piece> {
    let length = said.length.unwrap_or(1.0);
    let weights = match said.denominator {
        Some(said) => powers(1.0, said.end, said.rest, length),
        None => powers(1.0, 1.0, [0.0; N - 2], length),
    };
    let last: f64 = weights.iter().sum();
    let mut piece = [[0.0; 4]; N];
    for axis in 0..3 {
        let rest = match said.axes[axis] {
            Some(said) => said.rest.map(|value| value * unit),
            // linear: that is no polynomial over a denominator
            None if said.denominator.is_some() && start[axis] != end[axis] => return None,
            None if said.denominator.is_some() => weights_rest(weights, start[axis], length),
            None => [0.0; N - 2],
        };
        let values = bernstein(powers(start[axis], end[axis] * last, rest, length));
        for (slot, value) in piece.iter_mut().zip(values) {
            slot[axis] = value;
        }
    }
    for (slot, value) in piece.iter_mut().zip(bernstein(weights)) {
        slot[3] = value;
    }
    let finite = piece.iter().flatten().all(|value| value.is_finite());
    finite.then_some(piece)
}

/// Coefficients from a2 on of a coordinate that stays under a denominator.
fn weights_rest(weights: [f64; N], value: f64, length: f64) -> [f64; N - 2] {
    let mut scale = length;
    core::array::from_fn(|at| {
        scale *= length;
        value * weights[at + 2] / scale
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quarter() -> Piece {
        let axis = |end: f64, a2: f64| {
            Some(Coefficients {
                end,
                rest: [a2, 0.0, 0.0, 0.0],
            })
        };
        let said = PolynomialWords {
            axes: [axis(0.0, -10.0), axis(10.0, 0.0), None],
            denominator: axis(2.0, 1.0),
            ..PolynomialWords::default()
        };
        whole(&said, Vec3::new(10.0, 0.0, 3.0), Vec3::new(0.0, 10.0, 3.0), 1.0).expect("known")
    }

    /// X = 10 (1 - p^2) / (1 + p^2), Y = 20 p / (1 + p^2): a quarter of a circle of radius 10.
    #[test]
    fn a_quarter_of_a_circle() {
        let ends = lines(&quarter(), &mut 0).expect("a path");
        let mut before = Vec3::new(10.0, 0.0, 3.0);
        let mut way = 0.0;
        for end in &ends {
            let radius = |at: &Vec3| trunnion_geometry::math::hypot(at.x, at.y);
            assert!(
                (radius(end) - 10.0).abs() < 1e-12 && (end.z - 3.0).abs() < 1e-12,
                "{end}"
            );
            let middle = (before + end) * 0.5;
            assert!(10.0 - radius(&middle) <= CHORD_MM, "{middle}");
            way += (end - before).norm();
            before = *end;
        }
        assert!((before - Vec3::new(0.0, 10.0, 3.0)).norm() < 1e-12);
        let exact = 5.0 * core::f64::consts::PI;
        assert!(way <= exact && exact - way < 1e-4, "{way}");
    }

    /// Halves meet in the middle of the curve, and end where it does.
    #[test]
    fn halves_are_the_curve() {
        let [left, right] = halves(&quarter());
        let at = |p: f64| Vec3::new(10.0 * (1.0 - p * p), 20.0 * p, 0.0) / (1.0 + p * p) + Vec3::z() * 3.0;
        for (found, wanted) in [
            (left[0], at(0.0)),
            (left[N - 1], at(0.5)),
            (right[0], at(0.5)),
            (right[N - 1], at(1.0)),
        ] {
            assert!((point(found) - wanted).norm() < 1e-12);
        }
    }

    /// PL is the parameter's end: X = 2 p + p^2 over 0..3 ends at 15, and half of the way is 5.25.
    #[test]
    fn the_parameter_ends_at_pl() {
        let all = powers(0.0, 15.0, [1.0, 0.0, 0.0, 0.0], 3.0);
        let value = |u: f64| all.iter().rev().fold(0.0, |sum, factor| sum * u + factor);
        assert!((value(0.5) - 5.25).abs() < 1e-12 && (value(1.0) - 15.0).abs() < 1e-12);
        // a denominator that is zero within the block has no path
        let mut broken = quarter();
        for (slot, weight) in broken.iter_mut().zip([1.0, 0.5, 0.0, -0.5, 0.0, 1.0]) {
            slot[3] = weight;
        }
        assert_eq!(lines(&broken, &mut 0), None);
    }
}
