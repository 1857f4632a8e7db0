//! Whole turns that bring each value of a rotary axis next to the one before it.

/// How many whole turns to add to each of `values` (deg) so that consecutive ones differ by at most half a turn, as far as
/// the joint range `limits` (lowest and highest, deg) lets them: docs/kinematics.md#unwinding.
///
/// A value keeps the turns of its predecessor where that already holds, so exact half turns stay as they are written. A value
/// that no winding brings inside the limits stays as it is.
pub(crate) fn unwrap(values: &[f64], limits: Option<(f64, f64)>) -> Vec<i64> {
    let mut turns: Vec<i64> = Vec::with_capacity(values.len());
    for (i, &value) in values.iter().enumerate() {
        let Some(&kept) = turns.last() else {
            turns.push(0);
            continue;
        };
        let before = values[i - 1] + 360.0 * kept as f64;
        let jump = value + 360.0 * kept as f64 - before;
        let wish = if jump.abs() <= 180.0 + 1e-9 {
            kept
        } else {
            ((before - value) / 360.0).round() as i64
        };
        turns.push(inside(value, wish, limits));
    }
    turns
}

/// The number of turns nearest to `wish` that keeps `value` inside `limits`, deg; 0 if none does.
fn inside(value: f64, wish: i64, limits: Option<(f64, f64)>) -> i64 {
    let Some((low, high)) = limits else { return wish };
    let fewest = ((low - 1e-9 - value) / 360.0).ceil() as i64;
    let most = ((high + 1e-9 - value) / 360.0).floor() as i64;
    if fewest > most { 0 } else { wish.clamp(fewest, most) }
}

/// Number of steps of more than half a turn in `values` (deg) with `turns` added.
pub(crate) fn long_way_steps(values: &[f64], turns: &[i64]) -> usize {
    let wound: Vec<f64> = values.iter().zip(turns).map(|(v, &k)| v + 360.0 * k as f64).collect();
    wound
        .windows(2)
        .filter(|pair| (pair[1] - pair[0]).abs() > 180.0 + 1e-9)
        .count()
}

#[cfg(test)]
mod tests {
    use super::{long_way_steps, unwrap};
    use proptest::prelude::*;

    #[test]
    fn a_wrap_is_unwound() {
        assert_eq!(unwrap(&[350.0, 355.0, 0.5, 5.0, 359.0], None), [0, 0, 1, 1, 0]);
        assert_eq!(unwrap(&[-179.0, 179.0], None), [0, -1]);
    }

    #[test]
    fn half_turns_stay_as_written() {
        assert_eq!(unwrap(&[0.0, 180.0, 0.0, -180.0], None), [0, 0, 0, 0]);
    }

    #[test]
    fn limits_are_kept() {
        assert_eq!(
            unwrap(&[350.0, 5.0], Some((-360.0, 360.0))),
            [0, 0],
            "365 would be outside"
        );
        assert_eq!(unwrap(&[350.0, 5.0], Some((-360.0, 400.0))), [0, 1]);
        assert_eq!(
            unwrap(&[350.0, 500.0], Some((-30.0, 120.0))),
            [0, 0],
            "no winding is inside"
        );
    }

    proptest! {
        #[test]
        fn steps_are_at_most_half_a_turn_without_limits(values in prop::collection::vec(-2000.0..2000.0f64, 1..50)) {
            let turns = unwrap(&values, None);
            prop_assert_eq!(long_way_steps(&values, &turns), 0);
            prop_assert_eq!(turns[0], 0);
        }

        #[test]
        fn values_inside_the_limits_stay_inside(values in prop::collection::vec(-720.0..720.0f64, 1..50)) {
            for (value, turns) in values.iter().zip(unwrap(&values, Some((-720.0, 720.0)))) {
                prop_assert!((value + 360.0 * turns as f64).abs() <= 720.0 + 1e-6);
            }
        }
    }
}
