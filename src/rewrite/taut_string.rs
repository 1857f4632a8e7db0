//! The taut string: the shortest line through a tube, which is also the one whose steepest part is least steep.
//!
//! It minimises every convex function of the slope at once (docs/kinematics.md#smoothing-at-the-pole), so one pass gives the least
//! total travel and the least peak speed together.

/// The taut string through the tube `lower[i]..=upper[i]` over the stations `s` (strictly increasing), any units. The ends
/// are where `lower` and `upper` meet; between them either side may be infinite (no wall there).
///
/// The result has one value for each station. Empty input, and one station, are their own answer. Time: linear unless the
/// string bends at most stations (then quadratic in the length of the longest straight part).
pub(crate) fn taut_string(s: &[f64], lower: &[f64], upper: &[f64]) -> Vec<f64> {
    let count = s.len().min(lower.len()).min(upper.len());
    let mut string = Vec::with_capacity(count);
    if count == 0 {
        return string;
    }
    string.push(lower[0]);
    let mut apex = 0;
    while apex + 1 < count {
        let from = string[apex];
        let (bend, to) = next_bend(&s[..count], lower, upper, apex, from);
        for station in apex + 1..=bend {
            let share = (s[station] - s[apex]) / (s[bend] - s[apex]);
            string.push(if station == bend {
                to
            } else {
                from + (to - from) * share
            });
        }
        apex = bend;
    }
    string
}

/// Where the string that leaves `apex` at height `from` touches the tube next: station and height. The last station if it
/// touches nothing.
fn next_bend(s: &[f64], lower: &[f64], upper: &[f64], apex: usize, from: f64) -> (usize, f64) {
    let (mut steepest, mut flattest) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut at_upper, mut at_lower) = (apex + 1, apex + 1);
    for station in apex + 1..s.len() {
        let run = s[station] - s[apex];
        let over = (upper[station] - from) / run;
        let under = (lower[station] - from) / run;
        if under > steepest {
            return (at_upper, upper[at_upper]);
        }
        if over < flattest {
            return (at_lower, lower[at_lower]);
        }
        if over <= steepest {
            (steepest, at_upper) = (over, station);
        }
        if under >= flattest {
            (flattest, at_lower) = (under, station);
        }
    }
    (s.len() - 1, lower[s.len() - 1])
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
