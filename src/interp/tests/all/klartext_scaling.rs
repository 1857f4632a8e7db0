//! Cycle 11 of Klartext, and what is not known while it or cycle 26 scales. Ends are worked out by hand.
use crate::support::{Log, fault_line, run_bytes};
use trunnion_geometry::arc::Arc;
use trunnion_interp::{Motion, MotionKind, ScaledAxes, Setup};

pub(crate) const BY_AXIS: &str = "CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X 1.4 Y 0.6 CCX+15 CCY+20\n";
pub(crate) const HALF: &str = "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.5\n";
pub(crate) const WHOLE: &str = "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1\n";
pub(crate) const SHIFT: &str = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+100\nCYCL DEF 7.2 Y+200\n";
pub(crate) const BACK: &str = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\n";

pub(crate) fn run(axes: Option<ScaledAxes>, blocks: &str) -> (Log, Vec<String>) {
    let text = format!("0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+50 R0\n{blocks}\n9 END PGM A MM\n");
    let mut setup = Setup::default();
    setup.control.scaled_axes = axes;
    let (program, log) = run_bytes("heidenhain-klartext", text.as_bytes(), &setup);
    let told = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    (log, told)
}

/// The X, Y and Z in which a run ends, and the faults that say a reason for what is not known.
#[track_caller]
pub(crate) fn ends(axes: Option<ScaledAxes>, blocks: &str) -> Option<[f64; 3]> {
    let (log, told) = run(axes, blocks);
    let last = log.motions.last().expect("a motion").end.xyz();
    let silent = !told
        .iter()
        .any(|told| told.contains("NotModelled") || told.contains("Rejected"));
    assert_eq!(last.is_some(), silent, "{blocks}: {told:?}");
    last.map(Into::into)
}

/// Where the last motion ends.
pub(crate) fn last(log: &Log) -> Option<[f64; 3]> {
    log.motions.last()?.end.xyz().map(Into::into)
}

#[track_caller]
pub(crate) fn near(found: Option<[f64; 3]>, wanted: [f64; 3]) {
    let found = found.expect("known");
    let off = found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{found:?} {wanted:?}");
}

/// The last place is not known, and one of the faults says why.
#[track_caller]
pub(crate) fn unknown(axes: Option<ScaledAxes>, blocks: &str, reason: &str) {
    let (log, told) = run(axes, blocks);
    assert_eq!(
        log.motions.last().and_then(|motion| motion.end.xyz()),
        None,
        "{blocks}: {told:?}"
    );
    assert!(told.iter().any(|told| told.contains(reason)), "{blocks}: {told:?}");
}

pub(crate) fn arc(motion: &Motion) -> Option<Arc> {
    match motion.kind {
        MotionKind::Arc(arc) => arc,
        _ => None,
    }
}

/// The shift moves the zero point, so that coordinates of motions stay those of the block.
#[test]
fn a_shift_before_a_scaling_is_that_of_the_zero_point() {
    for (axes, cycle) in [(None, BY_AXIS), (Some(ScaledAxes::Plane), HALF)] {
        let (log, told) = run(axes, &format!("{SHIFT}{cycle}L X+10 Y+30 Z+5"));
        let zero = log.state.expect("a block").zero.values();
        assert_eq!(zero[..3], [100.0, 200.0, 0.0], "{told:?}");
    }
}

#[test]
fn cycle_11_scales_the_axes_that_are_declared() {
    let line = "L X+10 Y+30 Z+5";
    near(
        ends(Some(ScaledAxes::Plane), &format!("{HALF}{line}")),
        [5.0, 15.0, 5.0],
    );
    near(ends(Some(ScaledAxes::All), &format!("{HALF}{line}")), [5.0, 15.0, 2.5]);
    unknown(None, &format!("{HALF}{line}"), "declare [control] scaled_axes");
    near(ends(None, &format!("{WHOLE}{line}")), [10.0, 30.0, 5.0]);
    for axes in [ScaledAxes::Plane, ScaledAxes::All] {
        near(
            ends(Some(axes), &format!("{HALF}L X+1 Y+1 Z+1\n{WHOLE}{line}")),
            [10.0, 30.0, 5.0],
        );
    }
    // the plane of the tool axis Y is that of Z and X
    near(
        ends(Some(ScaledAxes::Plane), &format!("TOOL CALL 2 Y S1000\n{HALF}{line}")),
        [5.0, 30.0, 2.5],
    );
    unknown(
        Some(ScaledAxes::Plane),
        &format!("{HALF}TOOL CALL 2 Y S1000\n{line}"),
        "with another tool axis",
    );
    near(
        ends(Some(ScaledAxes::All), &format!("{HALF}TOOL CALL 2 Y S1000\n{line}")),
        [5.0, 15.0, 2.5],
    );
    for factor in ["0", "-2", "100", "0.0000001"] {
        let blocks = format!("CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL {factor}\n{line}");
        unknown(Some(ScaledAxes::Plane), &blocks, "0.000001 to 99.999999");
    }
    unknown(
        Some(ScaledAxes::Plane),
        &format!("CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL\n{line}"),
        "without a factor",
    );
}

#[test]
fn cycle_11_scales_arcs_and_radii() {
    for (axes, z) in [(ScaledAxes::Plane, 6.0), (ScaledAxes::All, 3.0)] {
        for path in [
            "CR X+20 Y+10 R+10 DR-",
            "CC X+20 Y+0\nC X+20 Y+10 DR-",
            "CC X+20 Y+0\nCP PA+90 DR-",
        ] {
            let (log, told) = run(Some(axes), &format!("{HALF}L X+10 Y+0 Z+6\n{path}"));
            let found = arc(log.motions.last().expect("a motion")).unwrap_or_else(|| panic!("{path}: {told:?}"));
            near(Some(found.centre.into()), [10.0, 0.0, z]);
            near(Some(found.end.into()), [10.0, 5.0, z]);
            assert!((found.radius_end - 5.0).abs() < 1e-9, "{path}");
        }
        // RND R4 between X+20 and Y+20 is a radius of 2
        let (log, told) = run(Some(axes), &format!("{HALF}L X+0 Y+0 Z+6\nL X+20\nRND R4\nL Y+20"));
        let round = log.motions.iter().find_map(arc).unwrap_or_else(|| panic!("{told:?}"));
        near(Some(round.centre.into()), [8.0, 2.0, z]);
        assert!((round.radius_start - 2.0).abs() < 1e-12);
    }
    // an arc across the plane
    let across = format!("{HALF}L X+10 Y+0 Z+6\nCC X+20 Z+6\nC X+20 Z+16 DR-");
    let (log, told) = run(Some(ScaledAxes::Plane), &across);
    assert!(matches!(
        log.motions.last().expect("a motion").kind,
        MotionKind::Arc(None)
    ));
    assert!(
        told.iter().any(|told| told.contains("the same factor for both")),
        "{told:?}"
    );
    let (log, _) = run(Some(ScaledAxes::All), &across);
    assert!((arc(log.motions.last().expect("a motion")).expect("an arc").radius_end - 5.0).abs() < 1e-9);
    // cycle 26 says nothing of radii
    let equal = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X0.5 Y0.5 CCX+0 CCY+0\n";
    let (log, told) = run(None, &format!("{equal}L X+0 Y+0 Z+6\nL X+20\nRND R4\nL Y+20"));
    assert!(log.motions.iter().all(|motion| arc(motion).is_none()));
    assert!(
        told.iter().any(|told| told.contains("RND while cycle 26 scales")),
        "{told:?}"
    );
}

/// A scaling of the plane about the datum, and a rotation or a mirror image about it: either order is the same.
#[test]
fn cycle_11_with_a_rotation_or_a_mirror_image() {
    let line = "L X+10 Y+30 Z+5";
    for (with, wanted) in [
        ("CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\n", [-15.0, 5.0]),
        ("CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n", [-5.0, 15.0]),
    ] {
        for both in [format!("{HALF}{with}"), format!("{with}{HALF}")] {
            near(
                ends(Some(ScaledAxes::Plane), &format!("{both}{line}")),
                [wanted[0], wanted[1], 5.0],
            );
            near(
                ends(Some(ScaledAxes::All), &format!("{both}{line}")),
                [wanted[0], wanted[1], 2.5],
            );
        }
    }
    // all three: the order of cycles 8 and 10 stays unknown, whatever cycle 11 says
    let all = "CYCL DEF 8.0 M\nCYCL DEF 8.1 X\nCYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\n";
    unknown(
        Some(ScaledAxes::Plane),
        &format!("{all}{WHOLE}{line}"),
        "together with cycle 8",
    );
}

#[test]
fn cycle_11_and_shifts() {
    let line = "L X+10 Y+30 Z+5";
    near(
        ends(Some(ScaledAxes::Plane), &format!("{SHIFT}{HALF}{line}")),
        [5.0, 15.0, 5.0],
    );
    // whether the shift is scaled
    unknown(
        Some(ScaledAxes::Plane),
        &format!("{HALF}{SHIFT}{line}"),
        "in a turned, mirrored or scaled system",
    );
    unknown(
        Some(ScaledAxes::Plane),
        &format!("{HALF}{SHIFT}{WHOLE}{line}"),
        "in a turned, mirrored or scaled system",
    );
    // also where the scaling itself is not known
    unknown(
        None,
        &format!("{HALF}{SHIFT}{WHOLE}{line}"),
        "in a turned, mirrored or scaled system",
    );
    // no shift is none in either case
    near(
        ends(
            Some(ScaledAxes::Plane),
            &format!("{SHIFT}{HALF}CYCL DEF 7.0 D\nCYCL DEF 7.1 X+0 Y+0\n{line}"),
        ),
        [5.0, 15.0, 5.0],
    );
    unknown(
        Some(ScaledAxes::Plane),
        &format!("{HALF}CALL PGM GONE\n{BACK}CYCL DEF 7.3 Z+0\nPLANE RESET STAY\n{line}"),
        "GONE",
    );
}

#[test]
fn what_no_source_says_of_a_scaled_system_is_named() {
    let drill = "CYCL DEF 200 DRILLING Q200=2 Q201=-10 Q206=150 Q202=20 Q210=0 Q203=+0 Q204=50 Q211=0\n";
    for (blocks, reason) in [
        (format!("{drill}{HALF}L X+10 Y+30 M99"), "a machining cycle while"),
        (
            format!(
                "CYCL DEF 1.0 P\nCYCL DEF 1.1 DIST2\nCYCL DEF 1.2 DEPTH-5\nCYCL DEF 1.3 PECKG5\n{HALF}L X+10 Y+30 M99"
            ),
            "a machining cycle while",
        ),
        (
            format!("{drill}{HALF}CYCL CALL POS X+1 Y+2 Z+0"),
            "a machining cycle while",
        ),
        (
            format!("{drill}PATTERN DEF POS1 (X+25 Y+33 Z+0)\n{HALF}CYCL CALL PAT FMAX"),
            "a machining cycle while",
        ),
        (
            format!(
                "{drill}{HALF}CYCL DEF 220 PATTERN Q216=+50 Q217=+50 Q244=80 Q245=+0 Q246=+360 Q247=+0 Q241=8 Q200=2 Q203=+0 Q204=50 Q301=1"
            ),
            "a machining cycle while",
        ),
        (
            format!("{HALF}L X+10 Y+30 Z+5\nL M140 MB5 F100"),
            "whether its lengths are scaled",
        ),
        (format!("{HALF}L X+10 Y+30 Z+5\nDEP LT LEN5 F100"), "DEP while"),
        (format!("{HALF}M128\nL X+10 Y+30 Z+5"), "M128"),
    ] {
        for axes in [ScaledAxes::Plane, ScaledAxes::All] {
            unknown(Some(axes), &blocks, reason);
        }
    }
    let (log, told) = run(Some(ScaledAxes::Plane), &format!("{HALF}L X+10 U+5"));
    assert_eq!(
        log.motions.last().and_then(|motion| motion.end.get(6)),
        None,
        "{told:?}"
    );
    assert!(told.iter().any(|told| told.contains("U, V or W while")), "{told:?}");
    let (log, told) = run(
        Some(ScaledAxes::Plane),
        &format!("{HALF}APPR LT X+10 Y+0 LEN5 R0 F100\nL X+30 Y+0"),
    );
    assert!(
        log.motions
            .iter()
            .any(|motion| matches!(motion.kind, MotionKind::Unknown)),
        "{told:?}"
    );
    assert!(told.iter().any(|told| told.contains("APPR while")), "{told:?}");
}

/// APPR ends where the turned contour begins, and comes from the turned direction.
#[test]
fn an_approach_is_turned_with_its_contour() {
    let turned = "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\n";
    let (log, told) = run(
        None,
        &format!("{turned}L X-20 Y+0 Z+5 FMAX\nAPPR LT X+10 Y+0 LEN5 R0 F100\nL X+30 Y+0"),
    );
    let places: Vec<[f64; 3]> = log
        .motions
        .iter()
        .filter_map(|motion| motion.end.xyz())
        .map(Into::into)
        .collect();
    let wanted = [
        [0.0, 0.0, 50.0],
        [0.0, -20.0, 5.0],
        [0.0, 5.0, 5.0],
        [0.0, 10.0, 5.0],
        [0.0, 30.0, 5.0],
    ];
    assert_eq!(places.len(), wanted.len(), "{places:?} {told:?}");
    for (place, wanted) in places.into_iter().zip(wanted) {
        near(Some(place), wanted);
    }
    // mirrored in X, left of the contour is right of it: the circle lies on the other side
    let mirrored = |mirror: &str| {
        let blocks = format!("{mirror}L X-20 Y+0 Z+5 FMAX\nAPPR CT X+10 Y+0 CCA90 R+5 RL F100\nL X+30 Y+0");
        run(None, &blocks)
            .0
            .motions
            .iter()
            .find_map(arc)
            .expect("an arc")
            .centre
    };
    near(Some(mirrored("").into()), [10.0, 5.0, 5.0]);
    near(
        Some(mirrored("CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n").into()),
        [-10.0, 5.0, 5.0],
    );
}
