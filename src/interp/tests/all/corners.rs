//! `,R` and `,C` between straight motions.
use crate::support::{faults, lines};

#[test]
fn rounded_and_cut_off() {
    // along X to 20, then Y: the arc of radius 5 begins at X15 and ends at Y5 about (15, 5); then a chamfer of 3 at (20, 20)
    let source = "G0 X0. Y0. Z0.\nG1 X20. ,R5. F100.\nY20. ,C3.\nX0.\nM30\n";
    assert_eq!(
        lines("fanuc-30i", source),
        [
            "R X0 Y0 Z0",
            "L X15 Y0 Z0 F100",
            "A(15 5 0; 90) X20 Y5 Z0 F100",
            "L X20 Y17 Z0 F100",
            "L X17 Y20 Z0 F100",
            "L X0 Y20 Z0 F100",
        ]
    );
    assert_eq!(faults("fanuc-30i", source), [""; 0]);
}

#[test]
fn corners_that_do_not_fit() {
    let long = faults("fanuc-30i", "G0 X0. Y0. Z0.\nG1 X20. ,R15. F100.\nY10.\nM30\n");
    assert!(long[0].contains("PS0055"), "{long:?}");
    let rapid = faults("fanuc-30i", "G0 X0. Y0. Z0.\nG1 X20. ,R5. F100.\nG0 Y10.\nM30\n");
    assert!(rapid[0].contains("PS0052"), "{rapid:?}");
    let arc = "G0 X0. Y0. Z0.\nG1 X20. ,R5. F100.\nG3 X20. Y10. R5.\nG1 X0.\nM30\n";
    assert_eq!(
        lines("fanuc-30i", arc)[1..],
        ["L Z0 F100", "A(20 5 0; 180) X20 Y10 Z0 F100", "L X0 Y10 Z0 F100"]
    );
    assert_eq!(
        faults("fanuc-30i", arc),
        [r#"3: G3 X20. Y10. R5.: NotModelled { what: "rounded and chamfered corners at an arc" }"#]
    );
    // the corners after it are unknown for the same reason
    let more = "G0 X0. Y0. Z0.\nG1 X20. ,R5. F100.\nG3 X20. Y10. R5.\nG1 X0. ,C2.\nY20. ,R1.\nX9.\nM30\n";
    let of_arc = faults("fanuc-30i", more);
    assert!(of_arc.iter().all(|fault| fault.contains("at an arc")), "{of_arc:?}");
}

#[test]
fn corners_under_compensation() {
    // a clockwise square, radius 5 left of it: an outer corner rounded by 8 becomes an arc of 13 about (8, 32)
    let source = "G10 L12 P1 R5.\nG0 X-20. Y-20. Z0.\nG41 D1 G1 X0. Y0. F100.\nY40. ,R8.\nX40.\nG40 Y60.\nM30\n";
    assert_eq!(
        lines("fanuc-30i", source)[1..],
        [
            "L X-5 Y0 Z0 F100",
            "L X-5 Y32 Z0 F100",
            "A(8 32 0; -90) X8 Y45 Z0 F100",
            "L X40 Y45 Z0 F100",
            "L X40 Y60 Z0 F100",
        ]
    );
}
