//! Shifts of motions whose positions are unknown.
use super::{Claim, prove, proved};

#[test]
fn a_shift_that_no_position_gives_is_not_printed_as_zero() {
    let unmeasured =
        "1 of 4 motions have unknown positions, which both programs program alike: their shift is not measured";
    let path = Claim::SamePath {
        tolerance_mm: 1e-6,
        tolerance_deg: 1e-6,
    };
    // A and C are unknown until the second block
    let known = "TRAORI\nG0 X0 Y0 Z50\nG1 X1 A0 C0 F1000\nX2\nX3\nM30\n";
    let text = proved(prove(known, &known.replace("X2", "X2.0"), &path)).summary();
    assert!(
        text.contains("shift at block ends 0.000000 mm") && text.contains(unmeasured),
        "{text}"
    );
    let unknown = "G1 X1 F1000\nX2\nX3\nM30\n";
    let text = proved(prove(unknown, &unknown.replace("X2", "X2.0"), &path)).summary();
    assert!(
        text.contains("3 of 3 motions have unknown positions") && !text.contains("mm,"),
        "{text}"
    );
}
