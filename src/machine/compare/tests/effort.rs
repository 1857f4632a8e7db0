//! What a run may spend on blocks that turn endlessly.
use super::{line, planted};
use crate::{Comparison, Effort, builtin};

/// A billion turns of C on a machine whose C is 0.05 mm off: twice the error is proven without halving, whatever happens between the ends.
/// Where C's direction is off the bound for whole blocks is loose. What such blocks take is counted for the run, and a block that turns
/// a little is proven after a thousand of them.
#[test]
fn endless_turns_leave_effort_for_the_other_blocks() {
    let believed = builtin("mikron-ucp710").expect("shipped");
    let turn_of_c = |to: f64| {
        let at = |c: f64| {
            let mut position = trunnion_interp::Position::default();
            for (axis, value) in [(0, 10.0), (1, 5.0), (2, 30.0), (3, 20.0), (5, c)] {
                position.set(axis, value);
            }
            position
        };
        let mut follower = crate::Follower::new(believed);
        follower.follow(&line(true, trunnion_interp::Position::default(), at(0.0)));
        follower.follow(&line(true, at(0.0), at(to)))
    };
    let (many, few) = (turn_of_c(4.321e11), turn_of_c(10.0));
    let moved = planted("mikron-ucp710", 'C', "point = [0, 0, 0]", "point = [0.03, 0.04, 0]");
    let comparison = Comparison::new(believed, &moved).expect("the same axes");
    let mut effort = Effort::new(1000);
    let found = comparison.along(&many, 0.1001, &mut effort).expect("known");
    assert!(found.bound_mm <= 0.1001 && !found.cut_short, "{found:?}");
    // the ends, and what the block itself added
    assert_eq!(effort.left(), 1000 + 4 - 2);

    let tilted = planted("mikron-ucp710", 'C', "dir = [0, 0, 1]", "dir = [0.0001, 0, 1]");
    let comparison = Comparison::new(believed, &tilted).expect("the same axes");
    let (pieces, motions) = (100_000, 1000);
    let mut effort = Effort::new(pieces);
    let tolerance = 0.02;
    let whole = comparison.along(&many, tolerance, &mut effort).expect("known");
    assert!(
        whole.worst.tip_mm < tolerance && whole.bound_mm > tolerance && whole.cut_short,
        "{whole:?}"
    );
    for _ in 1..motions {
        let before = effort.left();
        assert!(
            comparison
                .along(&many, tolerance, &mut effort)
                .expect("known")
                .cut_short
        );
        let taken = before + 4 - effort.left();
        assert!(taken <= (before + 4) / 200 + 4, "{taken} of {before}");
    }
    let found = comparison.along(&few, tolerance, &mut effort).expect("known");
    assert!(found.bound_mm <= tolerance && !found.cut_short, "{found:?}");
}
