//! Cutter radius compensation: entry, corners, exit and what is impossible.
use crate::support::{fault_line, line, run_bytes};
use trunnion_interp::{ControlData, OuterCorner, Setup, Tool};

fn setup(diameter: f64) -> Setup {
    Setup {
        tools: vec![Tool {
            number: 1,
            shape: None,
            diameter_mm: Some(diameter),
            length_mm: None,
            holder_mm: None,
        }],
        ..Setup::default()
    }
}

fn run(source: &str, setup: &Setup) -> (Vec<String>, Vec<String>) {
    let (program, log) = run_bytes("fanuc-30i", source.as_bytes(), setup);
    let motions = log
        .motions
        .iter()
        .map(|m| line(m).replace(" Z0", "").replace(" F100", ""))
        .collect();
    (
        motions,
        log.faults.iter().map(|fault| fault_line(&program, fault)).collect(),
    )
}

#[test]
fn a_square_from_outside() {
    // tool of diameter 10, left of a clockwise square of 40: the centre runs 5 outside, outer corners of 90 deg meet at the tip
    let source = "G0 X-20. Y-20. Z0.\nG41 D1 G1 X0. Y0. F100.\nY40.\nX40.\nY0.\nX-10.\nG40 X-20. Y-20.\nM30\n";
    let (motions, faults) = run(source, &setup(10.0));
    assert_eq!(
        motions,
        [
            "R X-20 Y-20",
            // entry: beside the start of the next motion
            "L X-5 Y0",
            "L X-5 Y45",
            "L X45 Y45",
            "L X45 Y-5",
            // the last motion of the contour ends beside its own end
            "L X-10 Y-5",
            "L X-20 Y-20",
        ]
    );
    assert_eq!(faults, [""; 0]);
}

#[test]
fn inner_corners_are_cut_short() {
    // right of the same square: the centre runs inside, 5 off each side
    let source = "G0 X20. Y20. Z0.\nG42 D1 G1 X0. Y20. F100.\nY40.\nX40.\nY0.\nX0.\nY20.\nG40 X20.\nM30\n";
    let (motions, _) = run(source, &setup(10.0));
    assert_eq!(
        motions[1..],
        [
            "L X5 Y20",
            "L X5 Y35",
            "L X35 Y35",
            "L X35 Y5",
            "L X5 Y5",
            "L X5 Y20",
            "L X20 Y20"
        ]
    );
}

#[test]
fn sharp_outer_corners_are_gone_around_by_lines() {
    // along X to 20, back to (0, 10) at an angle: turn of more than 90 deg. Direction of the second: (-2, 1)/sqrt 5.
    // right of the path with radius 5: sides extended by 5: (25, -5); then 5 before the start beside the second:
    // (20, 0) + 5 (1, 2)/sqrt 5 - 5 (-2, 1)/sqrt 5 = (20 + 15/2.236068, 5/2.236068) = (26.708204, 2.236068)
    let source = "G0 X-10. Y-10. Z0.\nG42 D1 G1 X0. Y0. F100.\nX20.\nX0. Y10.\nG40 Y20.\nM30\n";
    let (motions, _) = run(source, &setup(10.0));
    assert_eq!(
        motions[1..5],
        [
            "L X0 Y-5",
            "L X25 Y-5",
            "L X26.708204 Y2.236068",
            "L X2.236068 Y14.472136"
        ]
    );
    // or by an arc about the corner
    let setup = Setup {
        control: ControlData {
            outer_corner: OuterCorner::Arc,
            ..ControlData::default()
        },
        ..setup(10.0)
    };
    let (motions, _) = run(source, &setup);
    // (20, 0) + 5 (1, 2)/sqrt 5 = (22.236068, 4.472136); the turn is 180 - 26.565051 deg
    assert_eq!(
        motions[1..4],
        ["L X0 Y-5", "L X20 Y-5", "A(20 0 0; 153.434949) X22.236068 Y4.472136"]
    );
}

#[test]
fn arcs_change_their_radius() {
    // a counter-clockwise half circle of radius 20, tool of radius 5 left of it: radius 15; tangents at both ends
    let source = "G0 X20. Y-30. Z0.\nG41 D1 G1 X20. Y-10. F100.\nY0.\nG3 X-20. Y0. R20.\nG1 Y-10.\nG40 Y-30.\nM30\n";
    let (motions, faults) = run(source, &setup(10.0));
    assert_eq!(
        motions[1..],
        [
            "L X15 Y-10",
            "L X15 Y0",
            "A(0 0 0; 180) X-15 Y0",
            "L X-15 Y-10",
            "L X-20 Y-30"
        ]
    );
    assert_eq!(faults, [""; 0]);
    // right of it: radius 25
    let right = source.replace("G41", "G42");
    assert_eq!(run(&right, &setup(10.0)).0[3], "A(0 0 0; 180) X-25 Y0");
}

#[test]
fn a_line_that_meets_an_arc_inside() {
    // left of a line along X to 0 that turns left into an arc of radius 20 about (-20, 0), counter-clockwise from (0, 0): an inner
    // corner. Beside the line y = 5; beside the arc radius 15:
    // x = -20 + sqrt(15^2 - 5^2) = -5.857864
    let source =
        "G0 X-60. Y0. Z0.\nG41 D1 G1 X-50. Y0. F100.\nX0.\nG3 X-20. Y20. I-20. J0.\nG1 X-30.\nG40 X-60.\nM30\n";
    let (motions, faults) = run(source, &setup(10.0));
    assert_eq!(motions[2], "L X-5.857864 Y5");
    // the arc begins at asin(5/15) = 19.471221 deg and ends at 90 deg
    assert_eq!(motions[3], "A(-20 0 0; 70.528779) X-20 Y15");
    assert_eq!(faults, [""; 0]);
}

#[test]
fn heights_between_wait_for_the_corner() {
    let source = "G0 X-10. Y-10. Z0.\nG42 D1 G1 X0. Y0. F100.\nX20.\nZ-1.\nY20.\nG40 Y30.\nM30\n";
    let (motions, _) = run(source, &setup(10.0));
    assert_eq!(motions[2..5], ["L X25 Y-5", "L X25 Y-5 Z-1", "L X25 Y20 Z-1"]);
}

/// Blocks that move nothing count as those that move only Z do: with two of them a control may not see the corner.
#[test]
fn blocks_that_move_nothing_make_a_corner_unknown() {
    let corner = |between: &str| {
        let source = format!("G0 X0. Y0. Z0.\nG41 D1 G1 X10. Y0. F100.\nY20.\n{between}X30.\nG40 X50.\nM30\n");
        run(&source, &setup(10.0)).1
    };
    for few in ["", "M8\n", "(A COMMENT)\nM8\n(ANOTHER)\n", "#1=1\n#2=2\n"] {
        assert_eq!(corner(few), [""; 0], "{few}");
    }
    // a line that goes straight on has no corner
    let straight = "G0 X0. Y0. Z0.\nG41 D1 G1 X10. Y0. F100.\nY20.\nM8\nM9\nM8\nY30.\nX50.\nG40 Y60.\nM30\n";
    assert_eq!(run(straight, &setup(10.0)).1, [""; 0]);
    for many in ["M8\nM9\n", "S900\nG4 P100\n", "M8\nZ-1.\n", "T2\nM8\nM3\n"] {
        let said = corner(many);
        assert!(
            said.len() == 1 && said[0].contains("do not move in the plane"),
            "{many}: {said:?}"
        );
    }
}

#[test]
fn tools_that_do_not_fit() {
    // an inner arc of radius 4 for a tool of radius 5
    let source = "G0 X0. Y-30. Z0.\nG41 D1 G1 X4. Y-10. F100.\nY0.\nG3 X-4. Y0. R4.\nG1 Y-10.\nG40 Y-30.\nM30\n";
    let (_, faults) = run(source, &setup(10.0));
    assert!(
        faults[0].contains("Compensation") && faults[0].contains("PS0041"),
        "{faults:?}"
    );
    // a step shorter than the radius between two inner corners runs backwards
    let source = "G0 X-20. Y0. Z0.\nG41 D1 G1 X-10. Y0. F100.\nX0.\nY3.\nX-10.\nG40 X-20.\nM30\n";
    let (_, faults) = run(source, &setup(10.0));
    assert!(faults[0].contains("PS0041"), "{faults:?}");
    // start and end must be straight
    let source = "G0 X0. Y0. Z0.\nG41 D1 G2 X10. Y10. R10. F100.\nG1 X20.\nG40 X30.\nM30\n";
    let (_, faults) = run(source, &setup(10.0));
    assert!(faults[0].contains("PS0034"), "{faults:?}");
}

#[test]
fn the_radius_comes_from_d() {
    let source =
        "G10 L12 P7 R3.\nG10 L13 P7 R-0.5\nG0 X-10. Y-10. Z0.\nG41 D7 G1 X0. Y0. F100.\nY20.\nG40 X-10.\nM30\n";
    let (motions, faults) = run(source, &Setup::default());
    assert_eq!(motions[1..], ["L X-2.5 Y0", "L X-2.5 Y20", "L X-10 Y20"]);
    assert_eq!(faults, [""; 0]);
    // D0 is no offset; an undeclared radius leaves the programmed path, and that is reported
    let plain = source.replace("D7", "D0");
    assert_eq!(run(&plain, &Setup::default()).0[1], "L X0 Y0");
    let unknown = source.replace("D7", "D8");
    let (motions, faults) = run(&unknown, &Setup::default());
    assert_eq!(motions[1], "L X0 Y0");
    assert!(faults[0].contains("the radius of D8 is not declared"), "{faults:?}");
}

#[test]
fn mirrored_contours_change_the_side() {
    let source = "G0 X0. Y0. Z0.\nG51.1 X0.\nG41 D1 G1 X10. Y0. F100.\nY20.\nG40 X0.\nM30\n";
    let (motions, _) = run(source, &setup(10.0));
    // in the words left of Y+ at X10 is X5: mirrored X-5
    assert_eq!(motions[1..], ["L X-5 Y0", "L X-5 Y20", "L X0 Y20"]);
}

#[test]
fn the_blocks_of_motions_stay_theirs() {
    let source = "G0 X-20. Y-20. Z0.\nG41 D1 G1 X0. Y0. F100.\nY40.\nX40.\nG40 Y60.\nM30\n";
    let (_, log) = run_bytes("fanuc-30i", source.as_bytes(), &setup(10.0));
    let blocks: Vec<_> = log.motions.iter().map(|motion| motion.block.0 + 1).collect();
    assert_eq!(blocks, [1, 2, 3, 4, 5]);
    for pair in log.motions.windows(2) {
        assert_eq!(pair[0].end, pair[1].start, "each begins where the one before ends");
    }
}

/// Mistakes that do not depend on the radius are reported where it is zero or not declared.
#[test]
fn mistakes_without_a_radius() {
    let told = |source: &str, setup: &Setup| {
        let faults = run(source, setup).1;
        faults
            .into_iter()
            .filter(|fault| fault.contains("Compensation"))
            .collect::<Vec<_>>()
    };
    let unknown = Setup::default();
    for setup in [&setup(0.0), &unknown, &setup(4.0)] {
        for (source, what) in [
            (
                "G0 X0. Y0. Z0.\nG41 D1 G2 X10. Y10. R10. F100.\nX20. Y0 R10.\nG40 G1 X0.\nM30\n",
                "starts with an arc",
            ),
            (
                "G0 X0. Y0. Z0.\nG41 D1 G2 I5. F100.\nG1 X20.\nG40 G1 X0.\nM30\n",
                "starts with an arc",
            ),
            (
                "G0 X0. Y0. Z0.\nG41 D1 G1 X10. F100.\nX20.\nG40 G2 X30. Y10. R10.\nM30\n",
                "ends with an arc",
            ),
            (
                "G0 X0. Y0. Z0.\nG41 D1 G1 X10. F100.\nX20.\nG18\nX30.\nG17\nG40 G1 X0. Y-9.\nM30\n",
                "the plane changes",
            ),
        ] {
            let found = told(source, setup);
            assert!(found.len() == 1 && found[0].contains(what), "{source}: {found:?}");
        }
        let good =
            "G0 X0. Y0. Z0.\nG41 D1 G1 X10. F100.\nX20.\nG2 X30. Y10. R10.\nG1 Y20.\nG40 G1 X0.\nG2 X5. Y5. R9.\nM30\n";
        assert_eq!(told(good, setup), [""; 0]);
    }
}
