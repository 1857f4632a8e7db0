//! Blocks with `/`: a claim holds in both states of the switch, where it is not declared which.
use super::*;
use crate::RefitSource;

const BEFORE: &str =
    "G21 G90 G94 G17 G40 G54\nG0 X0. Y0. Z5. S8000 M3\nG1 Z0. F500.\nX5.\n/X10.\nX10. Y0.\nY10.\nM30\n";

fn certified(before: &str, after: &str, block_delete: Option<bool>, claim: &Claim) -> Outcome {
    let mut setup = Setup::default();
    setup.control.block_delete = block_delete;
    let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    certify(before.as_bytes(), after.as_bytes(), dialect, machine, &setup, claim)
}

fn claims() -> [Claim; 2] {
    let same = Claim::SameToolPath {
        tolerance_mm: 1e-6,
        tolerance_deg: 1e-6,
    };
    let refitted = Claim::RefittedPath {
        tolerance_mm: 1e-6,
        source: RefitSource::Chords,
    };
    [same, refitted]
}

#[test]
fn a_block_that_repeats_a_place_counts_where_the_one_before_it_is_skipped() {
    let after = BEFORE.replace("X10. Y0.\n", "");
    assert_ne!(after, BEFORE);
    for claim in claims() {
        assert!(matches!(
            certified(BEFORE, &after, Some(false), &claim),
            Outcome::Proved(_)
        ));
        assert!(matches!(
            certified(BEFORE, &after, Some(true), &claim),
            Outcome::Refuted(_)
        ));
        let Outcome::Refuted(why) = certified(BEFORE, &after, None, &claim) else {
            panic!("{claim:?}: it goes from X5 to X5 Y10 where the block is skipped");
        };
        assert!(why.message.contains("where blocks with / are skipped"), "{why}");
    }
}

#[test]
fn what_holds_in_both_states_is_proved() {
    let after = BEFORE.replace("X10. Y0.", "X10.");
    for claim in claims() {
        for state in [None, Some(false), Some(true)] {
            let found = certified(BEFORE, &after, state, &claim);
            assert!(matches!(found, Outcome::Proved(_)), "{state:?}: {found:?}");
        }
    }
}

#[test]
fn several_switches_have_more_states_than_two() {
    let before = BEFORE.replace("/X10.", "/X10.\n/2 Z1.");
    let after = before.replace("X10. Y0.", "X10.");
    for claim in claims() {
        let Outcome::Unknown(why) = certified(&before, &after, None, &claim) else {
            panic!("{claim:?}");
        };
        assert!(why.message.contains("several switches (1, 2)"), "{why}");
        assert!(matches!(
            certified(&before, &after, Some(true), &claim),
            Outcome::Proved(_)
        ));
        // one text is the same whatever is skipped
        assert!(matches!(certified(&before, &before, None, &claim), Outcome::Proved(_)));
    }
}

/// Of the numbers the worst of both states are recorded.
#[test]
fn the_certificate_has_the_worst_of_both_states() {
    // Y is left out where the block before it says it, and 0.002 mm off where that block is skipped
    let start = BEFORE.replace("Z5.", "Z5. A0. C0.");
    let before = start.replace("X5.", "X5. Y0.002").replace("/X10.", "/X10. Y0.");
    let after = before.replace("X10. Y0.\nY10.", "X10.\nY10.");
    assert_ne!(after, before);
    let claim = Claim::SameToolPath {
        tolerance_mm: 0.01,
        tolerance_deg: 1e-6,
    };
    let worst = |state| match certified(&before, &after, state, &claim) {
        Outcome::Proved(found) => found.worst.tip_shift_mm.value,
        other => panic!("{other:?}"),
    };
    assert_eq!(worst(Some(false)), 0.0);
    assert!((worst(Some(true)) - 0.002).abs() < 1e-9, "{}", worst(Some(true)));
    assert_eq!(worst(None), worst(Some(true)));
}
