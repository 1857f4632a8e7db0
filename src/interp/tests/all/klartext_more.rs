//! HEIDENHAIN Klartext: cycles of old controls, planes, corners, and what the control refuses.
use crate::klartext::{NAME, program};
use crate::support::{faults, lines, run_bytes, run_text, shared};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{atan2, hypot};
use trunnion_interp::{MotionKind, Setup};

/// Clearance 2 and depth 10 from Z 2: 5, 10; t is 0.6 mm.
#[test]
fn pecking_of_old_controls() {
    let cycle = "CYCL DEF 1.0 TIEFBOHREN\nCYCL DEF 1.1 ABST+2\nCYCL DEF 1.2 TIEFE-10\nCYCL DEF 1.3 ZUSTLG+5\nCYCL DEF 1.4 V.ZEIT0\nCYCL DEF 1.5 F150\n";
    let text = program(&format!(
        "{cycle}L X+5 Y+5 Z+2 R0 FMAX M3\nL X+9 FMAX M99\nL Z+50 FMAX\n"
    ));
    assert_eq!(
        lines(NAME, &text),
        [
            "R X5 Y5 Z2",
            "R X9 Y5 Z2",
            "L X9 Y5 Z-5 F150",
            "R X9 Y5 Z2",
            "R X9 Y5 Z-4.4",
            "L X9 Y5 Z-10 F150",
            "R X9 Y5 Z2",
            "R X9 Y5 Z50",
        ]
    );
    // over 30 mm t is a 50th of the depth, and all three may have the sign of the direction
    let deep = cycle
        .replace("ABST+2", "SET UP -2")
        .replace("-10", "-100")
        .replace("ZUSTLG+5", "PECKG-50");
    let text = program(&format!("{deep}L X+5 Y+5 Z+2 R0 FMAX M3\nCYCL CALL\n"));
    assert!(
        lines(NAME, &text).contains(&"R X5 Y5 Z-48".to_owned()),
        "{:?}",
        lines(NAME, &text)
    );
    // the height is not known, so neither is the depth
    let text = program(&format!("{cycle}L X+5 Y+5 R0 FMAX M99\n"));
    assert!(
        run_text(NAME, &text)
            .motions
            .iter()
            .all(|motion| motion.end.get(2).is_none())
    );
}

/// A pocket's path is not followed, but it ends where it begins.
#[test]
fn a_pocket_ends_where_it_begins() {
    let text = program(
        "CYCL DEF 5.0 KREISTASCHE\nCYCL DEF 5.1 ABST+1\nCYCL DEF 5.2 TIEFE-21\nCYCL DEF 5.3 ZUSTLG+3 F1000\nCYCL DEF 5.4 RADIUS10\nCYCL DEF 5.5 F450 DR+\nL X+5 Y+5 Z+1 R0 FMAX M3\nCYCL CALL\nL IX+1 FMAX\n",
    );
    let motions = run_text(NAME, &text).motions;
    assert_eq!(motions[1].kind, MotionKind::Unknown);
    assert_eq!(motions[2].end.xyz(), Some(Vec3::new(6.0, 5.0, 1.0)));
}

/// CC with Z and X: arcs and angles in that plane, the angle from Z.
#[test]
fn arcs_in_other_planes() {
    let text = program(
        "L X+0 Y+7 Z+0 FMAX\nCC Z+5 X+10\nLP PR+10 PA+90 F100\nCP IPA-90 DR-\nCC Y+0 Z+0\nL X+0 Y+10 Z+0\nC Y+0 Z+10 DR+\n",
    );
    let motions = run_text(NAME, &text).motions;
    let end = |at: usize| motions[at].end.xyz().expect("known");
    assert!((end(1) - Vec3::new(20.0, 7.0, 5.0)).norm() < 1e-9, "{}", end(1));
    assert!((end(2) - Vec3::new(10.0, 7.0, 15.0)).norm() < 1e-9, "{}", end(2));
    let MotionKind::Arc(Some(arc)) = motions[4].kind else {
        panic!("an arc")
    };
    assert!((arc.centre - Vec3::zeros()).norm() < 1e-9 && (arc.normal - Vec3::x()).norm() < 1e-9);
    assert!((arc.sweep.to_degrees() - 90.0).abs() < 1e-9, "{}", arc.sweep);
}

/// F of RND holds for the corner; RND that nothing follows at once makes the corner unknown.
#[test]
fn corners_have_their_own_feed() {
    let text = program("L X+0 Y+0 Z+0 FMAX\nL X+10 F100\nQ1 = 2\nRND RQ1 F50\nL Y+10\n");
    assert_eq!(
        lines(NAME, &text)[1..],
        ["L X8 Y0 Z0 F100", "A(8 2 0; 90) X10 Y2 Z0 F50", "L X10 Y10 Z0 F100"]
    );
    let text = program("L X+0 Y+0 Z+0 FMAX\nL X+10 F100\nRND R2\nTOOL CALL S500\nL Y+10\n");
    let run = run_text(NAME, &text);
    assert!(run.motions[1].end.get(0).is_none());
    assert!(faults(NAME, &text).iter().any(|fault| fault.contains("RND")));
}

/// M140 with the F behind MB; M91 only in a line; END IF ends no program.
#[test]
fn blocks_of_newer_and_older_controls() {
    let text = program("L X+0 Y+0 Z+5 FMAX\nL M140 MB20 F500\nL M140 MB+5 FMAX\n");
    assert_eq!(lines(NAME, &text)[1..], ["L X0 Y0 Z25 F500", "R X0 Y0 Z30"]);
    let text = program("L X+0 Y+0 Z+5 FMAX\nCR X+10 Y+0 R+5 DR+ M91\nL IX+1 F100\n");
    assert!(run_text(NAME, &text).motions[2].end.xyz().is_none());
    let text = program("IF Q1 == 1\nL X+1\nEND IF\nL X+5 Y+0 Z+0\n");
    assert!(
        faults(NAME, &text).iter().any(|fault| fault.contains("NotDecided")),
        "{:?}",
        faults(NAME, &text)
    );
    // `nan` is one mistake, and nothing is known behind it
    let text = program("CYCL DEF 7.0 N\nCYCL DEF 7.1 Xnan\nL Xnan Y nan Z+5 FMAX\nL X+5 Y+5 Z+5\n");
    let found = faults(NAME, &text);
    assert_eq!(
        found.iter().filter(|fault| fault.contains("not a number")).count(),
        1,
        "{found:?}"
    );
    assert!(
        run_text(NAME, &text)
            .motions
            .iter()
            .all(|motion| motion.end.xyz().is_none())
    );
    // a vector is given whole
    let text = program("M128\nLN X+0 Y+0 Z+0 TX+0 TZ+1 F100\n");
    assert!(faults(NAME, &text).iter().any(|fault| fault.contains("TX, TY and TZ")));
}

/// Why a value is unknown names where it comes from.
#[test]
fn an_unknown_value_names_its_source() {
    let text = program(
        "FN 18: SYSREAD Q1 = ID270 NR1 IDX1\nQ2 = Q1 + 5\nFN 1: Q3 = +Q2 + +1\nQ4 = 2 * Q108\nL X+Q3 FMAX\nL Y+Q4\n",
    );
    let found = faults(NAME, &text);
    assert_eq!(
        found
            .iter()
            .filter(|fault| fault.contains("FN 18: SYSREAD Q1 = ID270 NR1 IDX1"))
            .count(),
        1,
        "{found:?}"
    );
    assert!(
        found.iter().any(|fault| fault.contains("Q108: a value of the control")),
        "{found:?}"
    );
    assert!(!found.iter().any(|fault| fault.contains("does not set")), "{found:?}");
}

/// The planes of the shared part against G68.2 with the Euler angles of the same turns about the fixed X, then Y, then Z.
#[test]
fn planes_of_the_shared_part() {
    let Some(bytes) = shared("four-controls/heidenhain/Demo_1.H") else {
        return;
    };
    let source = String::from_utf8_lossy(&bytes);
    let value = |line: &str, name: &str| -> f64 {
        let at = line.rfind(name).expect("the angle") + name.len();
        let number: String = line[at..].chars().take_while(|c| !c.is_whitespace()).collect();
        number.parse().expect("a number")
    };
    let planes: Vec<[f64; 3]> = source
        .lines()
        .filter(|line| line.contains("PLANE SPATIAL"))
        .map(|line| ["SPA", "SPB", "SPC"].map(|name| value(line, name)))
        .collect();
    assert_eq!(planes.len(), 5);
    let points = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [3.0, -4.0, 25.0]];
    for [a, b, c] in planes.into_iter().chain([[10.0, 20.0, 30.0], [-75.5, 40.25, -123.0]]) {
        let about = |axis: Vec3, degrees: f64| {
            trunnion_geometry::Mat3::from_columns(
                &[Vec3::x(), Vec3::y(), Vec3::z()]
                    .map(|point| trunnion_geometry::math::rotate(&axis, degrees.to_radians(), &point)),
            )
        };
        let turn = about(Vec3::z(), c) * about(Vec3::y(), b) * about(Vec3::x(), a);
        let z = turn * Vec3::z();
        let tilt = atan2(hypot(z.x, z.y), z.z).to_degrees();
        let (precession, rotation) = if tilt < 1e-9 {
            (0.0, c)
        } else {
            (
                atan2(z.x, -z.y).to_degrees(),
                atan2(turn[(2, 0)], turn[(2, 1)]).to_degrees(),
            )
        };
        let mut own = format!("PLANE SPATIAL SPA{a} SPB{b} SPC{c} TURN FMAX SEQ-\n");
        let mut fanuc =
            format!("G17 G21 G90 G54\nG0 X0 Y0 Z0\nG68.2 X0 Y0 Z0 I{precession:.9} J{tilt:.9} K{rotation:.9}\nG53.1\n");
        for [x, y, z] in points {
            own += &format!("L X{x} Y{y} Z{z} F100\n");
            fanuc += &format!("G1 X{x:.1} Y{y:.1} Z{z:.1} F100\n");
        }
        let ends = |name: &str, text: &str| -> Vec<Vec3> {
            let motions = run_text(name, text).motions;
            motions
                .iter()
                .filter(|motion| motion.is_feed())
                .filter_map(|motion| motion.end.xyz())
                .collect()
        };
        let (own, fanuc) = (ends(NAME, &program(&own)), ends("fanuc-30i", &fanuc));
        assert_eq!((own.len(), fanuc.len()), (points.len(), points.len()), "{a} {b} {c}");
        for ((one, other), [x, y, z]) in own.iter().zip(&fanuc).zip(points) {
            let wanted = turn * Vec3::new(x, y, z);
            assert!((one - wanted).norm() < 1e-9, "{a} {b} {c}: {one} {wanted}");
            assert!((one - other).norm() < 1e-6, "{a} {b} {c}: {one} {other}");
        }
    }
}

/// An approach and a corner go on where a label is called.
#[test]
fn an_approach_to_a_contour_in_a_label() {
    let text = program(
        "L X+40 Y+10 Z+0 R0 FMAX\nAPPR LT X+10 Y+20 LEN5 RL F100\nCALL LBL 1\nM30\nLBL 1\nL X+20\nRND R2\nCALL LBL 2\nLBL 0\nLBL 2\nL Y+35\nLBL 0\n",
    );
    let ends: Vec<Vec3> = run_text(NAME, &text)
        .motions
        .iter()
        .filter_map(|motion| motion.end.xyz())
        .collect();
    assert_eq!(ends[1..3], [Vec3::new(5.0, 20.0, 0.0), Vec3::new(10.0, 20.0, 0.0)]);
    assert!(
        (ends[3] - Vec3::new(18.0, 20.0, 0.0)).norm() < 1e-9 && (ends[4] - Vec3::new(20.0, 22.0, 0.0)).norm() < 1e-9,
        "{ends:?}"
    );
}

/// What the control refuses.
#[test]
fn refused_programs() {
    for (blocks, what) in [
        (
            "CALL LBL 1\nM30\nLBL 1\nL X+1\nLBL 0\nLBL 1\nL X+2\nLBL 0\n",
            "label 1 more than once",
        ),
        ("L X+0 Y+0 Z+0 FMAX\nL X+5 RL F100\nL Y+5 RR\n", "R0 must come"),
        ("L X+0 Y+0 Z+0 FMAX\nCR X+5 Y+5 R+5 DR+ RL F100\n", "begins in an arc"),
        ("L X+0 M3 M8 M13 M97 M90\n", "four M codes"),
        ("L X+0 R5\n", "belongs to CR"),
        ("CC X+0 Y+0 Z+0\n", "two coordinates"),
        ("CYCL DEF 7.1 X+5\n", "needs CYCL DEF 7.0"),
        ("CYCL DEF 8.0 M\nCYCL DEF 1.1 DIST2\n", "needs CYCL DEF 1.0"),
        ("FN 9: IF +1 NE +1 GOTO LBL 1\nLBL 1\n", "EQU"),
        ("FN 12: IF +1 +2 GOTO LBL 1\nLBL 1\n", "LT"),
    ] {
        let found = faults(NAME, &program(blocks));
        assert!(found.iter().any(|fault| fault.contains(what)), "{blocks}: {found:?}");
    }
    // an arc about an unknown pole is not one without a pole
    let arc = |centre: &str, end: &str| {
        let text = format!("L X+0 Y+0 Z+0 FMAX\n{centre}C {end} DR+ F100\n");
        faults(NAME, &program(&text)).join("\n")
    };
    assert!(!arc("CC X+Q5 Y+0\n", "X+10 Y+0").contains("has no centre"));
    assert!(arc("", "X+10 Y+0").contains("has no centre: write CC before it"));
    // the tool cannot go round the point at which it ends
    assert!(arc("CC X+5 Y+0\n", "X+5 Y+0").contains("at its centre CC: it has no radius"));
}

/// The start was computed about a pole, so that it misses the end of the circle by rounding.
#[test]
fn a_circle_that_closes_within_rounding() {
    let text = program(
        "L X+10 Y+0 Z+0 FMAX\nCC X+0 Y+0\nCP IPA+30 DR+ F100\nCC X+1 Y+1\nC X+8.6602540 Y+5.0000000 DR-\nC X+8.66025 Y+5 DR+\nC X+8.6602 Y+5 DR+\n",
    );
    let sweeps: Vec<f64> = run_text(NAME, &text)
        .motions
        .iter()
        .filter_map(|motion| match motion.kind {
            MotionKind::Arc(Some(arc)) => Some(arc.sweep.to_degrees()),
            _ => None,
        })
        .collect();
    assert!(
        (sweeps[1] + 360.0).abs() < 1e-4 && (sweeps[2] - 360.0).abs() < 1e-4,
        "{sweeps:?}"
    );
    // five hundredths of a micrometre are an arc
    assert!(
        (sweeps[3] - 360.0).abs() > 1e-6 && sweeps[3].abs() < 360.0,
        "{sweeps:?}"
    );
}

/// The coordinate of the tool axis in CYCL CALL POS shifts the levels of the cycle; in which order the axes go there is not known.
#[test]
fn a_cycle_at_a_place() {
    let cycle = "CYCL DEF 201 B ~\n Q200=2 ~\n Q201=-10 ~\n Q206=150 ~\n Q211=0 ~\n Q208=500 ~\n Q203=+5 ~\n Q204=20\n";
    let text = program(&format!(
        "{cycle}L X+0 Y+0 Z+100 R0 FMAX M3\nCYCL CALL POS X+10 Y+20 Z+3 FMAX\nL X+1 F300\n"
    ));
    assert_eq!(
        lines(NAME, &text)[1..],
        [
            "U X10 Y20 Z10",
            "L X10 Y20 Z-2 F150",
            "L X10 Y20 Z10 F500",
            "R X10 Y20 Z28",
            "L X1 Y20 Z28 F300",
        ]
    );
    let found = faults(NAME, &text);
    assert!(
        found.iter().any(|fault| fault.contains("the path to its position")),
        "{found:?}"
    );
    let text = program(&format!(
        "{cycle}L X+0 Y+0 Z+100 R0 FMAX M3\nCYCL CALL POS X+10 Y+20 FMAX\n"
    ));
    let found = faults(NAME, &text);
    assert!(found.iter().any(|fault| fault.contains("all three axes")), "{found:?}");
    assert!(
        run_text(NAME, &text).motions[1..]
            .iter()
            .all(|motion| motion.end.get(2).is_none())
    );
}

/// Rigid tapping turns the spindle itself; afterwards it may turn or not. With a compensating chuck (206) the program turns it.
#[test]
fn rigid_tapping_turns_the_spindle() {
    let tap = |cycle: &str, spindle: &str| {
        let words = "Q200=2 ~\n Q201=-10 ~\n Q239=1.5 ~\n Q206=600 ~\n Q203=+0 ~\n Q204=20";
        let text = format!(
            "TOOL CALL 1 Z S400\n{cycle} ~\n {words}\nL X+0 Y+0 Z+20 R0 FMAX {spindle}\nCYCL CALL\nL Z+19 F100\n"
        );
        let motions = run_text(NAME, &program(&text)).motions;
        let feeds = motions.iter().filter(|motion| motion.is_feed());
        feeds.map(|motion| motion.spindle_on).collect::<Vec<_>>()
    };
    assert_eq!(tap("CYCL DEF 207 T", ""), [Some(true), Some(true), None]);
    assert_eq!(tap("CYCL DEF 207 T", "M3"), [Some(true), Some(true), None]);
    assert_eq!(tap("CYCL DEF 206 T", ""), [Some(false); 3]);
}

#[test]
fn a_text_that_doubles_becomes_unknown() {
    let doubled = |times: usize| {
        let text = program(&format!(
            "QS1 = \"down\"\n{}QS2 = QS1\nCALL LBL QS2\nL M30\nLBL \"down\"\nL Z-1\nLBL 0\n",
            "QS1 = QS1 || QS1\n".repeat(times)
        ));
        faults(NAME, &text)
    };
    let bounded = |faults: &[String]| {
        faults
            .iter()
            .any(|fault| fault.contains("a text of more than 4096 bytes"))
    };
    // 4 bytes, doubled ten times, are 4096
    assert!(!bounded(&doubled(10)), "{:?}", doubled(10));
    // and sixty times no computer holds them
    assert!(bounded(&doubled(60)), "{:?}", doubled(60));
}

#[test]
fn motions_of_cycles_count_towards_the_bound_of_blocks() {
    let text = program(&format!(
        "L X+0 Y+0 Z+50 FMAX M3\nCYCL DEF 200 BOHREN ~\n Q200=2 ~\n Q201=-20 ~\n Q206=150 ~\n Q202=0.1 ~\n Q210=0 ~\n Q203=+10 ~\n Q204=30 ~\n Q211=0\n{}",
        "L IX+1 FMAX M99\n".repeat(50)
    ));
    let run = |blocks: u64| {
        let mut setup = Setup::default();
        setup.limits.blocks = blocks;
        setup.control.peck_clearance_mm = Some(1.0);
        run_bytes(NAME, text.as_bytes(), &setup).1
    };
    let whole = run(1_000_000);
    assert!(whole.motions.len() > 50 * 500, "{}", whole.motions.len());
    let bounded = run(3000);
    // the hole in which the bound is reached is made to its end, each hole after it is one unknown motion
    assert!(bounded.motions.len() < 3000 + 700 + 2 * 50, "{}", bounded.motions.len());
    let unknown = bounded
        .motions
        .iter()
        .filter(|motion| motion.kind == MotionKind::Unknown);
    assert!(unknown.count() > 40);
    let told = format!("{:?}", bounded.faults);
    assert!(
        told.contains("more than 3000 motions in the cycles of the program ([limits] blocks)"),
        "{told}"
    );
}

/// Whether a cycle reads its parameters at its definition or at its call is in no source.
#[test]
fn a_parameter_that_changes_after_the_definition_of_a_cycle_makes_it_unknown() {
    let cycle = "CYCL DEF 200 BOHREN Q200=2 Q201=-10 Q206=150 Q202=10 Q210=0 Q203=0 Q204=20 Q211=0\n";
    let run = |between: &str| {
        let text = program(&format!("{cycle}{between}L X+5 Y+5 Z+20 R0 FMAX M3\nCYCL CALL\n"));
        let told = faults(NAME, &text)
            .into_iter()
            .filter(|fault| fault.contains("CYCL DEF"))
            .count();
        (lines(NAME, &text).iter().any(|line| line.contains("Z-10")), told)
    };
    for kept in ["", "Q1 = -20\n", "Q201 = -10\n", "FN 0: Q205 = +3\n"] {
        assert_eq!(run(kept), (true, 0), "{kept}");
    }
    for changed in ["Q201 = -20\n", "FN 0: Q203 = +1\n", "Q206 = 200\n", "Q201 = Q99\n"] {
        assert_eq!(run(changed), (false, 1), "{changed}");
    }
}
