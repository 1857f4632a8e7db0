//! Holes in a row, on a circle, in a grid and at any places (Sinumerik HOLES1, HOLES2, CYCLE801, CYCLE802): the cycle of MCALL runs at each of
//! them.
//!
//! Sources: the text of the control's own cycles (version 6) and the Sinumerik 840D sl Programming Manual, Cycles. Where a row begins
//! differs between them: at the end nearer the frame's zero, or nearer the present position. It is followed where both are the same end.
//! No source gives the arguments of CYCLE802: it is followed where the settings declare them (`[control] hole_places`, decision 0367).
use super::called::Given;
use crate::arc::plane_axes;
use crate::codes::{Found, not_modelled};
use crate::core::Report;
use crate::frames::sin_cos_degrees;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, HolePlaces, MotionKind, Refusal};
use trunnion_dialect::Action;
use trunnion_geometry::math::hypot;

/// Holes of one block.
const MOST_HOLES: usize = 10_000;
/// Program units, against rounding.
const TINY: f64 = 1e-9;

/// A place in the plane, program units.
type Place = [f64; 2];

/// The numbers of a call that are lengths and angles, and how many holes there are.
#[derive(Clone, Debug, PartialEq)]
enum Row {
    /// HOLES1: first hole, angle, distance between holes, how many.
    Line(Place, f64, f64, usize),
    /// HOLES2: centre, radius, angle of the first hole, angle between holes, how many.
    Circle(Place, f64, f64, f64, usize),
    /// CYCLE801: corner, angle, distances, how many each way.
    Grid(Place, f64, [f64; 2], [usize; 2]),
    /// CYCLE802: the places.
    Listed(Vec<Place>),
}

/// What a call makes.
#[derive(Debug, PartialEq)]
enum Places {
    These(Vec<Place>),
    /// The control refuses it.
    Refused,
    Unknown,
}

/// Whether a cycle of this name is a row of holes.
pub(crate) fn is_row(id: &str) -> bool {
    matches!(id, "HOLES1" | "HOLES2" | "CYCLE801" | "CYCLE802")
}

impl Row {
    fn of(id: &str, numbers: &[Given], listed: Option<HolePlaces>) -> Option<Self> {
        if id == "CYCLE802" {
            return listed.and_then(|HolePlaces::Pairs| pairs(numbers)).map(Self::Listed);
        }
        let number = |place: usize| numbers.get(place).copied().unwrap_or(Given::Nothing).or_zero();
        let count = |place: usize| {
            let count = number(place)?;
            (count.fract() == 0.0 && (1.0..=MOST_HOLES as f64).contains(&count)).then_some(count as usize)
        };
        // the numbers that newer calls have behind these select other meanings
        let known = if id == "CYCLE801" { 7 } else { 6 };
        if (known..numbers.len()).any(|place| number(place) != Some(0.0)) {
            return None;
        }
        let at = [number(0)?, number(1)?];
        Some(match id {
            "HOLES1" => {
                let (angle, first) = (number(2)?, number(3)?);
                let (sin, cos) = sin_cos_degrees(angle);
                let start = [at[0] + first * cos, at[1] + first * sin];
                Self::Line(start, angle, number(4)?, count(5)?)
            }
            "HOLES2" => {
                let count = count(5)?;
                let between = match number(4)? {
                    0.0 => 360.0 / count as f64,
                    between => between,
                };
                Self::Circle(at, number(2)?, number(3)?, between, count)
            }
            _ => {
                let counts = [count(5)?, count(6)?];
                (counts[0] * counts[1] <= MOST_HOLES).then_some(())?;
                Self::Grid(at, number(2)?, [number(3)?, number(4)?], counts)
            }
        })
    }

    /// The holes in their order, seen from a place.
    fn places(&self, here: Option<Place>) -> Places {
        match *self {
            Self::Listed(ref places) => Places::These(places.clone()),
            Self::Circle(.., between, count) if count > 1 && between.abs() * (count - 1) as f64 >= 360.0 => {
                Places::Refused
            }
            Self::Circle(centre, radius, first, between, count) => Places::These(
                (0..count)
                    .map(|hole| along(centre, first + between * hole as f64, radius))
                    .collect(),
            ),
            Self::Line(start, angle, between, count) => {
                let hole = |at: usize| along(start, angle, between * at as f64);
                // the ends first: a row in a loop may have no known first hole in any pass
                match nearest(&[hole(0), hole(count - 1)], here) {
                    Some(0) => Places::These((0..count).map(hole).collect()),
                    Some(_) => Places::These((0..count).rev().map(hole).collect()),
                    None => Places::Unknown,
                }
            }
            Self::Grid(corner, angle, between, counts) => Self::grid((corner, angle), between, counts, here),
        }
    }

    /// There and back, along the direction with the smaller distance.
    fn grid((corner, angle): (Place, f64), between: [f64; 2], counts: [usize; 2], here: Option<Place>) -> Places {
        let hole = |first: usize, second: usize| {
            let place = along(corner, angle, between[0] * first as f64);
            along(place, angle + 90.0, between[1] * second as f64)
        };
        let ends = counts.map(|count| count - 1);
        let same = (between[0].abs() - between[1].abs()).abs() <= TINY;
        let fast = if counts[1] == 1 {
            0
        } else if counts[0] == 1 {
            1
        } else if same {
            return Places::Unknown;
        } else {
            usize::from(between[1].abs() < between[0].abs())
        };
        let corners = [(0, 0), (ends[0], 0), (0, ends[1]), ends.into()];
        let Some(start) = nearest(&corners.map(|(first, second)| hole(first, second)), here) else {
            return Places::Unknown;
        };
        let from_far = [corners[start].0 != 0, corners[start].1 != 0];
        let slow = 1 - fast;
        let mut holes = Vec::new();
        for row in 0..counts[slow] {
            for column in 0..counts[fast] {
                let mut at = [0; 2];
                at[slow] = if from_far[slow] { ends[slow] - row } else { row };
                let backwards = from_far[fast] != (row % 2 == 1);
                at[fast] = if backwards { ends[fast] - column } else { column };
                holes.push(hole(at[0], at[1]));
            }
        }
        Places::These(holes)
    }
}

/// The places of CYCLE802 as [`HolePlaces::Pairs`] reads them.
fn pairs(numbers: &[Given]) -> Option<Vec<Place>> {
    const MOST: usize = 9;
    let number = |place: usize| numbers.get(place).copied().unwrap_or(Given::Nothing);
    if (2 + 2 * MOST..numbers.len()).any(|place| number(place).or_zero() != Some(0.0)) {
        return None;
    }
    let ways = [number(0), number(1)].map(|given| match given {
        Given::Number(digits) if digits.fract() == 0.0 && (1.0..1e9).contains(&digits) => Some(digits as u32),
        _ => None,
    });
    let ways = [ways[0]?, ways[1]?];
    let mut places: Vec<Place> = Vec::new();
    let mut ended = false;
    for hole in 0..MOST {
        let mut place = Place::default();
        match [number(2 + 2 * hole), number(3 + 2 * hole)] {
            [Given::Nothing, Given::Nothing] => {
                ended = true;
                continue;
            }
            [Given::Number(a), Given::Number(b)] if !ended => {
                for (axis, value) in [a, b].into_iter().enumerate() {
                    let way = ways[axis] / 10_u32.pow(hole as u32) % 10;
                    place[axis] = match (way, places.last()) {
                        (1, _) => value,
                        (2, Some(before)) => before[axis] + value,
                        _ => return None,
                    };
                }
            }
            _ => return None,
        }
        places.push(place);
    }
    (!places.is_empty()).then_some(places)
}

fn along(from: Place, degrees: f64, by: f64) -> Place {
    let (sin, cos) = sin_cos_degrees(degrees);
    [from[0] + by * cos, from[1] + by * sin]
}

/// Which of some places is nearest to the zero and to a place; `None`: they differ, or two are as near.
fn nearest(places: &[Place], here: Option<Place>) -> Option<usize> {
    let first = places[0];
    if places.iter().all(|place| distance(*place, first) <= TINY) {
        return Some(0);
    }
    let from = |point: Place| {
        let best =
            (0..places.len()).min_by(|a, b| distance(places[*a], point).total_cmp(&distance(places[*b], point)))?;
        let close = |other: &Place| {
            distance(*other, places[best]) > TINY && distance(*other, point) - distance(places[best], point) <= 1e-6
        };
        (!places.iter().any(close)).then_some(best)
    };
    let (zero, present) = (from([0.0; 2])?, from(here?)?);
    (distance(places[zero], places[present]) <= TINY).then_some(zero)
}

fn distance(a: Place, b: Place) -> f64 {
    hypot(a[0] - b[0], a[1] - b[1])
}

impl Iso<'_> {
    /// Runs the cycle of MCALL at the holes of a call; without one the tool only goes there. Whether the code is such a call.
    pub(super) fn hole_row(
        &mut self,
        found: &Found<'_>,
        numbers: &[Given],
        words: &Words,
        report: &mut Report<'_>,
    ) -> bool {
        if !is_row(&found.code.id) {
            return false;
        }
        if self.is_full() {
            self.row_is_too_long(found, report);
            return true;
        }
        let [a, b, _] = plane_axes(self.core.state.coordinates.plane());
        let unit = self.core.state.coordinates.unit_mm();
        let position = self.core.state.position;
        let place = self.memory.frames.programmed(&position);
        let here = place.get(a).zip(place.get(b)).map(|(a, b)| [a / unit, b / unit]);
        // another call that is modal may run at each hole
        let unknown_call = self.core.state.motion == Some(Action::CannedCycle)
            || words.axes.any()
            || a.min(b) == 0 && self.program_sets_diameters();
        let places =
            match Row::of(&found.code.id, numbers, self.core.setup.control.hole_places).filter(|_| !unknown_call) {
                Some(row) => row.places(here),
                None => Places::Unknown,
            };
        let holes = match places {
            Places::These(holes) => holes,
            Places::Refused => {
                let kind = FaultKind::Rejected {
                    refusal: Refusal::CannedCycle,
                    message: "HOLES2: the angle between the holes makes more than a full circle".to_owned(),
                    alarm: Some("61106".to_owned()),
                };
                report.fault(found.range, kind);
                self.row_lost(report);
                return true;
            }
            Places::Unknown => {
                if found.code.id == "CYCLE802" && self.core.setup.control.hole_places.is_none() {
                    let what = "CYCLE802: what its arguments say (declare [control] hole_places)".to_owned();
                    report.fault(found.range, FaultKind::NotModelled { what });
                } else {
                    not_modelled(found, report);
                }
                self.row_lost(report);
                return true;
            }
        };
        let call = self.memory.cycle.call.clone();
        for hole in holes {
            if self.is_full() {
                self.row_is_too_long(found, report);
                return true;
            }
            let position = self.core.state.position;
            let before = self.memory.frames.programmed(&position);
            let mut place = before;
            place.set(a, hole[0] * unit);
            place.set(b, hole[1] * unit);
            if place != before {
                self.goes(MotionKind::Rapid, place, Feed::Rapid, report);
            }
            if let Some(call) = &call {
                self.run_call(call, &Words::default(), report);
            }
        }
        true
    }

    fn row_is_too_long(&mut self, found: &Found<'_>, report: &mut Report<'_>) {
        let what = format!("{}: {}", found.code.id, self.full());
        report.fault(found.range, FaultKind::NotModelled { what });
        self.row_lost(report);
    }

    /// The tool moves on an unknown way to an unknown place.
    fn row_lost(&mut self, report: &mut Report<'_>) {
        let mut motion = self.unknown_motion(&Words::default(), report);
        self.core.forget_position();
        motion.end = self.core.state.position;
        self.memory.out.push(motion);
    }
}

#[cfg(test)]
mod tests {
    use super::{Places, Row};

    fn holes(row: &Row, here: [f64; 2]) -> Vec<[i64; 2]> {
        let Places::These(holes) = row.places(Some(here)) else {
            panic!("{row:?} is not known")
        };
        holes
            .iter()
            .map(|hole| hole.map(|value| value.round() as i64))
            .collect()
    }

    #[test]
    fn rows_begin_at_the_nearer_end() {
        let row = Row::Line([10.0, 0.0], 0.0, 5.0, 3);
        assert_eq!(holes(&row, [0.0, 0.0]), [[10, 0], [15, 0], [20, 0]]);
        let row = Row::Line([-20.0, 0.0], 0.0, 5.0, 3);
        assert_eq!(holes(&row, [0.0, 0.0]), [[-10, 0], [-15, 0], [-20, 0]]);
        // near the far end: the sources differ
        assert_eq!(
            Row::Line([10.0, 0.0], 0.0, 5.0, 3).places(Some([50.0, 0.0])),
            Places::Unknown
        );
        assert_eq!(Row::Line([10.0, 0.0], 0.0, 5.0, 3).places(None), Places::Unknown);
    }

    #[test]
    fn grids_go_there_and_back_along_the_smaller_distance() {
        let grid = Row::Grid([1.0, 1.0], 0.0, [10.0, 5.0], [2, 3]);
        let found = holes(&grid, [0.0, 0.0]);
        assert_eq!(found, [[1, 1], [1, 6], [1, 11], [11, 11], [11, 6], [11, 1]]);
        let turned = Row::Grid([1.0, 1.0], 90.0, [5.0, 10.0], [2, 1]);
        assert_eq!(holes(&turned, [0.0, 0.0]), [[1, 1], [1, 6]]);
        assert_eq!(
            Row::Grid([1.0, 1.0], 0.0, [5.0, 5.0], [2, 2]).places(Some([0.0; 2])),
            Places::Unknown
        );
    }

    #[test]
    fn a_circle_has_at_most_one_turn() {
        assert_eq!(
            holes(&Row::Circle([0.0, 0.0], 10.0, 0.0, 90.0, 4), [0.0, 0.0]),
            [[10, 0], [0, 10], [-10, 0], [0, -10]]
        );
        assert_eq!(Row::Circle([0.0; 2], 10.0, 0.0, 120.0, 4).places(None), Places::Refused);
    }
}
