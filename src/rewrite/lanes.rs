//! Arcs that meet beside the points of a chain: fewer of them serve than where each must end at a point.
use crate::beside::{Gate, fewest_beside};
use crate::circle::{Circle, Flat, circle_between};
use crate::pieces::{Beside, Piece, Points, axes, parsed};
use std::collections::BTreeSet;
use trunnion_certify::RefitSource;
use trunnion_dialect::Plane;
use trunnion_geometry::Vec3;

/// The lanes beside a point, in tolerances to the left. Nearer to 1 the rounding of numbers would leave the tolerance.
const LANES: [f64; 5] = [0.0, 0.95, -0.95, 0.5, -0.5];

/// So often a division is searched again because an arc of it cannot be written.
const MOST_TRIES: usize = 16;

/// The lanes of a chain in one plane.
struct Lanes<'a> {
    plane: Plane,
    points: &'a [Flat],
    /// The places in each lane, on the program's grid of numbers; none at corners and ends.
    gates: Vec<Option<Flat>>,
    tolerance: f64,
    chords: bool,
}

impl Lanes<'_> {
    fn at(&self, (index, lane): Gate) -> Option<&Flat> {
        if lane == 0 {
            return self.points.get(index);
        }
        self.gates.get(index * LANES.len() + lane)?.as_ref()
    }

    fn circle(&self, from: Gate, to: Gate) -> Option<Circle> {
        if to.0 < from.0 + 2 {
            return None;
        }
        let ends = [self.at(from)?, self.at(to)?];
        circle_between(ends, &self.points[from.0..=to.0], self.tolerance, self.chords)
    }
}

impl Points<'_> {
    /// A division into at most `most` pieces whose arcs may meet beside the points, and how many there were before rounding.
    pub(crate) fn fewer(&self, most: usize) -> Option<(Vec<Piece>, usize)> {
        let last = self.all.len() - 1;
        if most < 2 {
            return None;
        }
        let lanes = self.lanes()?;
        let mut refused: BTreeSet<(Gate, Gate)> = BTreeSet::new();
        let mut unrounded = None;
        for _ in 0..MOST_TRIES {
            let gates = fewest_beside(last, LANES.len(), most, &mut |from, to| {
                let on_points = from.1 == 0 && to.1 == 0;
                if on_points && (to.0 == from.0 + 1 || self.is_line(from.0, to.0)) {
                    return true;
                }
                (lanes.chords || self.corners[to.0 - 1] == self.corners[from.0])
                    && (refused.is_empty() || !refused.contains(&(from, to)))
                    && lanes.circle(from, to).is_some()
            })?;
            unrounded.get_or_insert(gates.len() - 1);
            let refusals = refused.len();
            let mut pieces = Vec::with_capacity(gates.len());
            let mut start = self.all[0];
            for pair in gates.windows(2) {
                let (from, to) = (pair[0], pair[1]);
                let beside = self.beside(&lanes, to).filter(|_| from.1 != 0 || to.1 != 0);
                let end = beside.as_ref().map_or(self.all[to.0], |beside| beside.at);
                let is_line = from.1 == 0 && to.1 == 0 && (to.0 == from.0 + 1 || self.is_line(from.0, to.0));
                let arc = if is_line {
                    None
                } else {
                    lanes
                        .circle(from, to)
                        .and_then(|circle| self.written((from.0, to.0), [start, end], lanes.plane, &circle))
                };
                if !is_line && arc.is_none() {
                    refused.insert((from, to));
                }
                pieces.push(Piece {
                    from: from.0,
                    to: to.0,
                    arc,
                    beside,
                });
                start = end;
            }
            if refused.len() == refusals {
                return Some((pieces, unrounded.unwrap_or(most)));
            }
        }
        None
    }

    /// The lanes beside the points of a chain that stays in one plane.
    fn lanes(&self) -> Option<Lanes<'_>> {
        let (last, limits) = (self.all.len() - 1, self.limits);
        let step = limits.unit_mm * 2.0 * limits.ends?.rounding();
        let level = |plane: &Plane| self.level_until[axes(*plane)[2]][0] >= last;
        let index = limits.planes.iter().position(level)?;
        let points = &self.flat[index];
        let mut gates = vec![None; points.len() * LANES.len()];
        let apart = |a: &Flat, b: &Flat| ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt();
        for at in 1..last {
            let (before, after) = (&points[at - 1], &points[at + 1]);
            let length = apart(before, after);
            if self.corners[at] != self.corners[at - 1] || length <= 0.0 {
                continue;
            }
            let left = [(before[1] - after[1]) / length, (after[0] - before[0]) / length];
            for (lane, share) in LANES.iter().enumerate().skip(1) {
                let off = share * limits.tolerance_mm;
                let place: Flat = [0, 1].map(|axis| ((points[at][axis] + left[axis] * off) / step).round() * step);
                let own = apart(&place, &points[at]);
                // of a point that is nearer to its neighbours, the proof would take one of them
                let is_nearest = own < apart(&place, before) && own < apart(&place, after);
                if is_nearest && own > 0.0 && own <= limits.tolerance_mm {
                    gates[at * LANES.len() + lane] = Some(place);
                }
            }
        }
        Some(Lanes {
            plane: limits.planes[index],
            points,
            gates,
            tolerance: limits.tolerance_mm,
            chords: limits.source == RefitSource::Chords,
        })
    }

    /// The end of a piece that begins or ends beside a point, as it is written.
    fn beside(&self, lanes: &Lanes<'_>, gate: Gate) -> Option<Beside> {
        let (style, unit) = (self.limits.ends?, self.limits.unit_mm);
        let place = lanes.at(gate)?;
        let [first, second, _] = axes(lanes.plane);
        let mut words = [(first, place[0]), (second, place[1])].map(|(axis, at)| (axis, style.write(at / unit, false)));
        words.sort();
        let mut at: Vec3 = self.all[gate.0];
        let is_point = gate.1 == 0;
        for (axis, text) in words.iter().filter(|_| !is_point) {
            at[*axis] = parsed(text)? * unit;
        }
        Some(Beside { at, is_point, words })
    }
}

#[cfg(test)]
mod tests {
    use crate::divide::divide;
    use crate::pieces::Limits;
    use crate::style::NumberStyle;
    use trunnion_certify::RefitSource;
    use trunnion_dialect::Plane;
    use trunnion_geometry::Vec3;
    use trunnion_geometry::math::sin_cos;

    /// Ellipses in 200 lines.
    #[test]
    fn arcs_that_meet_beside_points_are_fewer() {
        let ellipse = |long: i32, short: i32| -> Vec<Vec3> {
            let at = |index: i32| {
                let (sin, cos) = sin_cos(core::f64::consts::PI * f64::from(index) / 100.0);
                let round = |value: f64| (value * 1e4).round() / 1e4;
                Vec3::new(round(f64::from(long) * cos), round(f64::from(short) * sin), 0.0)
            };
            (0..=200).map(at).collect()
        };
        let style = NumberStyle {
            decimals: 4,
            trims: false,
            whole_point: true,
            leading_zero: true,
        };
        let count = |points: &[Vec3], tolerance_mm: f64, ends: Option<NumberStyle>| {
            let limits = Limits {
                tolerance_mm,
                source: RefitSource::Chords,
                planes: &[Plane::Xy],
                styles: Some([style; 3]),
                ends,
                unit_mm: 1.0,
                dialect: trunnion_dialect::builtin("fanuc-30i").expect("built in"),
            };
            divide(points, &limits).pieces.len()
        };
        let mut saved = 0;
        for (long, short) in (5..24)
            .step_by(3)
            .flat_map(|long| (2..12).step_by(3).map(move |short| (long, short)))
        {
            let points = ellipse(long, short);
            for tolerance_mm in [0.05, 0.02, 0.01, 0.005] {
                let at_points = count(&points, tolerance_mm, None);
                let beside = count(&points, tolerance_mm, Some(style));
                assert!(beside <= at_points, "{long} {short} {tolerance_mm}");
                saved += at_points - beside;
            }
        }
        assert!(saved > 15, "{saved} saved");
    }
}
