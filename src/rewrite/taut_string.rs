//! The taut string: the shortest line through a tube, which is also the one whose steepest part is least steep.
//!
//! It minimises every convex function of the slope at once (docs/kinematics.md#smoothing-at-the-pole), so one pass gives the least
//! total travel and the least peak speed together.

use std::collections::VecDeque;

/// The taut string through the tube `lower[i]..=upper[i]` over the stations `s` (strictly increasing), any units. The ends
/// are where `lower` and `upper` meet; between them either side may be infinite (no wall there).
///
/// The result has one value for each station. Empty input, and one station, are their own answer. Time: linear. From the last bend
/// on, two chains are kept: the tightest line below the upper walls (its slopes rise) and the one above the lower walls (its slopes
/// fall). Where a new wall makes the first of them start less steep than the other, the string bends along the other one.
pub(crate) fn taut_string(s: &[f64], lower: &[f64], upper: &[f64]) -> Vec<f64> {
    let count = s.len().min(lower.len()).min(upper.len());
    let mut bends: Vec<Knot> = Vec::new();
    if count == 0 {
        return Vec::new();
    }
    let apex = Knot {
        at: 0,
        s: s[0],
        height: lower[0],
    };
    bends.push(apex);
    let (mut above, mut below) = (VecDeque::from([apex]), VecDeque::from([apex]));
    for at in 1..count {
        for (walls, side) in [(upper, 1.0), (lower, -1.0)] {
            if walls[at].is_finite() {
                let (near, far) = if side > 0.0 {
                    (&mut above, &mut below)
                } else {
                    (&mut below, &mut above)
                };
                let knot = Knot {
                    at,
                    s: s[at],
                    height: walls[at],
                };
                lean(knot, side, near, far, &mut bends);
            }
        }
    }
    // both chains lead straight to the last station now; where it has no walls the string keeps its height
    bends.extend(below.iter().skip(1).filter(|knot| knot.at == count - 1).take(1));
    between(&s[..count], &bends)
}

/// A place that the string may touch.
#[derive(Clone, Copy)]
struct Knot {
    at: usize,
    s: f64,
    height: f64,
}

/// Slope from one place to another.
fn slope(from: &Knot, to: &Knot) -> f64 {
    (to.height - from.height) / (to.s - from.s)
}

/// Adds a wall to the chain of its side. `side`: 1 for the upper walls, -1 for the lower ones.
fn lean(knot: Knot, side: f64, near: &mut VecDeque<Knot>, far: &mut VecDeque<Knot>, bends: &mut Vec<Knot>) {
    while near.len() > 1
        && side * slope(&near[near.len() - 2], &knot) <= side * slope(&near[near.len() - 2], &near[near.len() - 1])
    {
        near.pop_back();
    }
    if near.len() == 1 {
        // the wall turns the string below the other chain: it bends along that one
        while far.len() > 1 && side * slope(&far[0], &knot) < side * slope(&far[0], &far[1]) {
            far.pop_front();
            bends.push(far[0]);
        }
        near[0] = far[0];
    }
    near.push_back(knot);
}

/// The height at each station on the line through these bends; level after the last one.
fn between(s: &[f64], bends: &[Knot]) -> Vec<f64> {
    let mut string = Vec::with_capacity(s.len());
    for pair in bends.windows(2) {
        let (from, to) = (&pair[0], &pair[1]);
        for &station in &s[from.at..to.at] {
            let share = (station - from.s) / (to.s - from.s);
            string.push(if station <= from.s {
                from.height
            } else {
                from.height + (to.height - from.height) * share
            });
        }
    }
    let last = bends.last().map_or(0.0, |bend| bend.height);
    string.resize(s.len(), last);
    string
}

#[cfg(test)]
mod tests {
    use super::taut_string;
    use proptest::prelude::*;

    #[test]
    fn an_empty_and_a_single_station_are_their_own_answer() {
        assert!(taut_string(&[], &[], &[]).is_empty());
        assert_eq!(taut_string(&[0.0], &[3.0], &[3.0]), [3.0]);
    }

    #[test]
    fn without_walls_the_string_is_straight() {
        let wide = f64::INFINITY;
        let string = taut_string(
            &[0.0, 1.0, 3.0, 4.0],
            &[0.0, -wide, -wide, 8.0],
            &[0.0, wide, wide, 8.0],
        );
        assert_eq!(string, [0.0, 2.0, 6.0, 8.0]);
    }

    #[test]
    fn it_bends_at_the_wall_that_is_in_the_way() {
        let string = taut_string(&[0.0, 1.0, 2.0], &[0.0, 5.0, 0.0], &[0.0, 9.0, 0.0]);
        assert_eq!(string, [0.0, 5.0, 0.0]);
        let string = taut_string(&[0.0, 1.0, 2.0], &[0.0, -9.0, 0.0], &[0.0, -5.0, 0.0]);
        assert_eq!(string, [0.0, -5.0, 0.0]);
    }

    /// Random tubes: step lengths, centres, half-widths (some without walls).
    fn tubes() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
        prop::collection::vec(
            (
                0.001..2.0,
                -180.0..180.0,
                prop_oneof![4 => 0.0..60.0, 1 => Just(f64::INFINITY)],
            ),
            2..40,
        )
    }

    /// Stations, lower and upper walls of a random tube, with closed ends.
    fn walls(tube: &[(f64, f64, f64)]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let mut s = Vec::new();
        let mut length = 0.0;
        for (step, _, _) in tube {
            length += step;
            s.push(length);
        }
        let last = tube.len() - 1;
        let half = |i: usize| if i == 0 || i == last { 0.0 } else { tube[i].2 };
        let lower = (0..tube.len()).map(|i| tube[i].1 - half(i)).collect();
        let upper = (0..tube.len()).map(|i| tube[i].1 + half(i)).collect();
        (s, lower, upper)
    }

    fn travel(values: &[f64]) -> f64 {
        values.windows(2).map(|w| (w[1] - w[0]).abs()).sum()
    }

    fn peak(s: &[f64], values: &[f64]) -> f64 {
        (1..s.len())
            .map(|i| ((values[i] - values[i - 1]) / (s[i] - s[i - 1])).abs())
            .fold(0.0, f64::max)
    }

    proptest! {
        #[test]
        fn it_stays_in_the_tube_and_bends_only_at_walls(tube in tubes()) {
            let (s, lower, upper) = walls(&tube);
            let string = taut_string(&s, &lower, &upper);
            prop_assert_eq!(string.len(), s.len());
            for i in 0..s.len() {
                prop_assert!(string[i] >= lower[i] - 1e-9 && string[i] <= upper[i] + 1e-9, "station {} leaves the tube", i);
            }
            for i in 1..s.len() - 1 {
                let before = (string[i] - string[i - 1]) / (s[i] - s[i - 1]);
                let after = (string[i + 1] - string[i]) / (s[i + 1] - s[i]);
                let slack = 1e-6 * (1.0 + before.abs() + after.abs());
                // A taut string leans on the lower wall where it turns down, on the upper one where it turns up.
                if after < before - slack {
                    prop_assert!((string[i] - lower[i]).abs() < 1e-6, "turns down at {} off the lower wall", i);
                }
                if after > before + slack {
                    prop_assert!((string[i] - upper[i]).abs() < 1e-6, "turns up at {} off the upper wall", i);
                }
            }
        }

        #[test]
        fn nothing_in_the_tube_is_shorter_or_less_steep(tube in tubes(), shares in prop::collection::vec(-1.0..1.0f64, 40)) {
            let (s, lower, upper) = walls(&tube);
            let string = taut_string(&s, &lower, &upper);
            let rival: Vec<f64> = (0..s.len())
                .map(|i| if upper[i].is_infinite() { string[i] + 10.0 * shares[i] } else { tube[i].1 + shares[i] * (upper[i] - tube[i].1) })
                .collect();
            let centre: Vec<f64> = tube.iter().map(|t| t.1).collect();
            for other in [rival, centre] {
                prop_assert!(travel(&string) <= travel(&other) + 1e-6);
                prop_assert!(peak(&s, &string) <= peak(&s, &other) * (1.0 + 1e-9) + 1e-9);
            }
        }
    }
}
