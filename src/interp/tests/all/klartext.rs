//! HEIDENHAIN Klartext.
use crate::support::{faults, lines, run_bytes, run_text, shared};
use trunnion_geometry::Vec3;
use trunnion_interp::{Fault, FaultKind, Feed, Motion, MotionKind, Orientation, Setup, Swivel};

pub(crate) const NAME: &str = "heidenhain-klartext";

pub(crate) fn program(blocks: &str) -> String {
    format!("BEGIN PGM T MM\nTOOL CALL 1 Z S1000\n{blocks}END PGM T MM\n")
}

fn targets(motions: &[Motion]) -> Vec<Vec3> {
    let known = motions
        .iter()
        .filter(|motion| !matches!(motion.kind, MotionKind::Dwell(_)));
    let mut found: Vec<Vec3> = known.filter_map(|motion| motion.end.xyz()).collect();
    found.dedup();
    found
}

#[test]
fn lines_and_feeds() {
    let text = program("L X+10 Y-5,5 Z+2 R0 FMAX M3\nL IX+1,5 F200\nL Y+0\nL Z-1 FMAX\nL X+20\n");
    assert_eq!(
        lines(NAME, &text),
        [
            "R X10 Y-5.5 Z2",
            "L X11.5 Y-5.5 Z2 F200",
            "L X11.5 Y0 Z2 F200",
            "R X11.5 Y0 Z-1",
            "L X20 Y0 Z-1 F200",
        ]
    );
}

#[test]
fn arcs_in_all_forms() {
    let text = program(
        "L X+10 Y+0 Z+0 FMAX\nCC X+0 Y+0\nC X+0 Y+10 DR+ F100\nCR X+10 Y+0 R+10 DR-\nCP IPA+450 IZ+5 DR+\nL X+0 Y+30\nCT X+10 Y+40\nLP PR+20 PA+90\n",
    );
    let motions = run_text(NAME, &text).motions;
    let sweep = |at: usize| match motions[at].kind {
        MotionKind::Arc(Some(arc)) => arc.sweep.to_degrees(),
        _ => f64::NAN,
    };
    assert!(
        (sweep(1) - 90.0).abs() < 1e-9 && (sweep(2) + 90.0).abs() < 1e-9,
        "{} {}",
        sweep(1),
        sweep(2)
    );
    assert!((sweep(3) - 450.0).abs() < 1e-9, "{}", sweep(3));
    let end = motions[3].end.xyz().expect("known");
    assert!((end - Vec3::new(0.0, 10.0, 5.0)).norm() < 1e-9, "{end}");
    // from (0, 30) straight up: a quarter to the right
    assert!((sweep(5) + 90.0).abs() < 1e-9, "{}", sweep(5));
    let polar = motions[6].end.xyz().expect("known");
    assert!((polar - Vec3::new(0.0, 20.0, 5.0)).norm() < 1e-9, "{polar}");
}

/// All forms, with the way worked out by hand: the contour runs along +X from (10, 0) to (30, 0), tool on the left; PS is at (-10, 40), or right of
/// it. A depth comes after the plane on the way in, and last on the way out.
#[test]
fn approaches_and_departures_in_all_forms() {
    let way = |appr: &str, dep: &str| {
        let text = program(&format!(
            "CC X+10 Y-20\nL X-10 Y+40 Z+5 R0 FMAX\n{appr} F100\nL X+30\n{dep}\nL Z+50 R0 FMAX\n"
        ));
        let motions = run_text(NAME, &text).motions;
        let ends: Vec<String> = motions[1..motions.len() - 1].iter().map(crate::support::line).collect();
        ends
    };
    let contour = "L X30 Y0 Z5 F100";
    assert_eq!(
        way("APPR LT X+10 Y+0 LEN15 RL", "DEP LT LEN12"),
        ["R X-5 Y0 Z5", "L X10 Y0 Z5 F100", contour, "L X42 Y0 Z5 F100"]
    );
    assert_eq!(
        way("APPR PLT PR+20 PA+90 LEN15 RL", "DEP LT LEN12 Z+20"),
        [
            "R X-5 Y0 Z5",
            "L X10 Y0 Z5 F100",
            contour,
            "L X42 Y0 Z5 F100",
            "L X42 Y0 Z20 F100"
        ]
    );
    let quarter = [
        "R X0 Y10 Z5",
        "A(10 10 5; 90) X10 Y0 Z5 F100",
        contour,
        "A(30 5 5; 90) X35 Y5 Z5 F100",
    ];
    assert_eq!(way("APPR CT X+10 Y+0 CCA90 R+10 RL", "DEP CT CCA90 R+5"), quarter);
    assert_eq!(way("APPR PCT PR+20 PA+90 CCA90 R+10 RL", "DEP CT CCA90 R+5"), quarter);
    // to the other side
    assert_eq!(
        way("APPR CT X+10 Y+0 CCA90 R-10 RL", "DEP CT CCA90 R-5")[..2],
        ["R X0 Y-10 Z5", "A(10 -10 5; -90) X10 Y0 Z5 F100"]
    );
    // the tangent from (-10, 40) to the circle about (10, 10), counter-clockwise: it is the line x = 0 for PS (0, 40)
    for [appr, dep] in [
        ["APPR LCT X+10 Y+0", "DEP LCT X+40 Y+40"],
        // the same places from the pole
        ["APPR PLCT PR+20 PA+90", "DEP PLCT PR+67.082039325 PA+63.434948823"],
    ] {
        let text = program(&format!(
            "CC X+10 Y-20\nL X+0 Y+40 Z+5 R0 FMAX\n{appr} Z-3 R10 RL F100\nL X+30\n{dep} Z+9 R10\n"
        ));
        assert_eq!(
            lines(NAME, &text)[1..],
            [
                "L X0 Y10 Z5 F100",
                "L X0 Y10 Z-3 F100",
                "A(10 10 -3; 90) X10 Y0 Z-3 F100",
                "L X30 Y0 Z-3 F100",
                "A(30 10 -3; 90) X40 Y10 Z-3 F100",
                "L X40 Y40 Z-3 F100",
                "L X40 Y40 Z9 F100",
            ],
            "{appr}"
        );
    }
    // the tool radius enters, and in which way no source says
    for (appr, dep) in [
        ("APPR LN X+10 Y+0 LEN15 RL", "DEP LT LEN12"),
        ("APPR PLN PR+20 PA+90 LEN15 RL", "DEP LT LEN12"),
        ("APPR LT X+10 Y+0 LEN15 RL", "DEP LN LEN12"),
    ] {
        let text = program(&format!(
            "CC X+10 Y-20\nL X-10 Y+40 Z+5 R0 FMAX\n{appr} F100\nL X+30\n{dep}\n"
        ));
        assert!(
            faults(NAME, &text)
                .iter()
                .any(|fault| fault.contains("the tool radius")),
            "{appr}"
        );
    }
}

/// The approach of the manual's blocks, with the numbers of the notes.
#[test]
fn approach_on_a_circle() {
    let text = program("L X+40 Y+10 Z+0 R0 FMAX\nAPPR CT X+10 Y+20 CCA180 R+10 RR F100\nL X+20 Y+35\n");
    let motions = run_text(NAME, &text).motions;
    let at = |place: usize| motions[place].end.xyz().expect("known");
    assert!((at(1) - Vec3::new(26.641, 8.906, 0.0)).norm() < 1e-3, "{}", at(1));
    match motions[2].kind {
        MotionKind::Arc(Some(arc)) => {
            assert!(
                (arc.centre - Vec3::new(18.321, 14.453, 0.0)).norm() < 1e-3,
                "{}",
                arc.centre
            );
            assert!(arc.sweep < 0.0, "clockwise");
        }
        _ => panic!("an arc"),
    }
    assert!((at(2) - Vec3::new(10.0, 20.0, 0.0)).norm() < 1e-9);
    assert!((at(3) - Vec3::new(20.0, 35.0, 0.0)).norm() < 1e-9);
}

#[test]
fn corners_are_rounded() {
    let text = program("L X+0 Y+0 Z+0 FMAX\nL X+10 F100\nRND R2\nL Y+10\n");
    let motions = run_text(NAME, &text).motions;
    let ends: Vec<[f64; 2]> = targets(&motions)
        .iter()
        .map(|point| [point.x, point.y].map(|value| (value * 1e9).round() / 1e9))
        .collect();
    assert_eq!(ends, [[0.0, 0.0], [8.0, 0.0], [10.0, 2.0], [10.0, 10.0]]);
}

#[test]
fn labels_repeat_and_jump() {
    let text = program(
        "L X+0 Y+0 Z+0 FMAX\nQ1 = 0\nLBL 1\nQ1 = Q1 + 1\nL IX+1 F100\nFN 12: IF +Q1 LT +3 GOTO LBL 1\nLBL 2\nL IY+1\nCALL LBL 2 REP 2\nCALL LBL \"down\"\nL M30\nLBL \"down\"\nL IZ-1\nLBL 0\n",
    );
    let motions = run_text(NAME, &text).motions;
    let last = motions.last().and_then(|motion| motion.end.xyz()).expect("known");
    assert_eq!(last, Vec3::new(3.0, 3.0, -1.0));
    assert_eq!(motions.len(), 1 + 3 + 3 + 1);
}

#[test]
fn an_endless_loop_and_a_missing_label() {
    let text = program("LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1\n");
    assert!(
        faults(NAME, &text).iter().any(|fault| fault.contains("EndlessLoop")),
        "{:?}",
        faults(NAME, &text)
    );
    let text = program("CALL LBL 7\n");
    assert!(
        faults(NAME, &text).iter().any(|fault| fault.contains("no label 7")),
        "{:?}",
        faults(NAME, &text)
    );
}

/// Rapid to the clearance, work, and back; the depth counts from the surface.
#[test]
fn a_hole() {
    let text = program(
        "L X+5 Y+5 Z+50 FMAX M3\nCYCL DEF 200 BOHREN ~\n Q200=2 ;A ~\n Q201=-20 ;B ~\n Q206=150 ;C ~\n Q202=25 ;D ~\n Q210=0 ~\n Q203=+10 ~\n Q204=30 ~\n Q211=0,5\nCYCL CALL\nL X+15 FMAX M99\n",
    );
    assert_eq!(
        lines(NAME, &text),
        [
            "R X5 Y5 Z50",
            "R X5 Y5 Z12",
            "L X5 Y5 Z-10 F150",
            "D0.5 X5 Y5 Z-10",
            "R X5 Y5 Z12",
            "R X5 Y5 Z40",
            "R X15 Y5 Z40",
            "R X15 Y5 Z12",
            "L X15 Y5 Z-10 F150",
            "D0.5 X15 Y5 Z-10",
            "R X15 Y5 Z12",
            "R X15 Y5 Z40",
        ]
    );
}

#[test]
fn what_is_not_sourced_is_unknown_by_name() {
    for (block, name) in [
        ("FL X+10 DR+\n", "FL: free contour programming"),
        ("PLANE PROJECTED PROPR+10 PROMIN+10 ROT+0 STAY\n", "PLANE PROJECTED"),
        ("CHF 5\n", "CHF"),
        ("CYCL DEF 19.0 X\nCYCL DEF 19.1 A+45\n", "cycle 19"),
        ("L Z+0 FMAX M92\n", "M92"),
        ("FUNCTION MODE TURN\n", "FUNCTION MODE TURN"),
    ] {
        let found = faults(NAME, &program(block));
        assert!(found.iter().any(|fault| fault.contains(name)), "{block} {found:?}");
    }
}

/// Under FUNCTION MODE TURN X is a diameter: no position is known until milling is on again.
#[test]
fn turning_hides_positions() {
    for (blocks, lost) in [
        ("FUNCTION MODE TURN\nL X+5 Z+2 F100\n", true),
        ("FUNCTION MODE TURN\nFUNCTION MODE MILL\nL X+5 Z+2 F100\n", false),
        ("FUNCTION MODE MILL\nL X+5 Z+2 F100\n", false),
    ] {
        let state = run_text(NAME, &program(blocks)).state.expect("a state");
        assert_eq!(state.zero.is_lost(), lost, "{blocks}");
    }
}

#[test]
fn the_same_part_for_two_controls() {
    let (Some(own), Some(fanuc)) = (
        shared("four-controls/heidenhain/2.5D_MILLING.H"),
        shared("four-controls/fanuc/2.5D_MILLING.NC"),
    ) else {
        return;
    };
    let own = targets(&run_bytes(NAME, &own, &Setup::default()).1.motions);
    let fanuc = targets(&run_bytes("fanuc-30i", &fanuc, &Setup::default()).1.motions);
    assert!(own.len() > 700, "{}", own.len());
    // its approaches differ: nearly all other targets are the same
    let near = |point: &&Vec3| fanuc.iter().any(|other| (*point - other).norm() < 2e-3);
    let common = own.iter().filter(near).count();
    eprintln!(
        "2.5D: {} targets, {} of them in the Fanuc program's {}",
        own.len(),
        common,
        fanuc.len()
    );
    assert!(common * 100 >= own.len() * 90, "{common} of {}", own.len());
}

#[test]
fn surface_normals_and_tool_vectors() {
    let Some(bytes) = shared("four-controls/heidenhain/5X_MILLING_VECTOR_part1.H") else {
        return;
    };
    let motions = run_bytes(NAME, &bytes, &Setup::default()).1.motions;
    let led: Vec<&Motion> = motions
        .iter()
        .filter(|motion| matches!(motion.orientation, Orientation::Vector(..)))
        .collect();
    assert_eq!(led.len(), 36);
    assert!(led.iter().all(|motion| motion.tcp && motion.end.xyz().is_some()));
}

#[test]
fn holes_of_the_shared_part() {
    let (Some(own), Some(siemens)) = (
        shared("four-controls/heidenhain/DRILLING.H"),
        shared("four-controls/siemens/DRILLING.mpf"),
    ) else {
        return;
    };
    let bottoms = |name: &str, bytes: Vec<u8>| {
        let motions = run_bytes(name, &bytes, &Setup::default()).1.motions;
        let mut deepest: Vec<(i64, i64, i64)> = Vec::new();
        for motion in motions.iter().filter(|motion| motion.is_feed()) {
            let Some(end) = motion.end.xyz() else { continue };
            let key = |value: f64| (value * 100.0).round() as i64;
            let (x, y, z) = (key(end.x), key(end.y), key(end.z));
            match deepest.iter_mut().find(|hole| (hole.0, hole.1) == (x, y)) {
                Some(hole) => hole.2 = hole.2.min(z),
                None => deepest.push((x, y, z)),
            }
        }
        deepest.sort_unstable();
        deepest
    };
    let (own, siemens) = (bottoms(NAME, own), bottoms("sinumerik-840d", siemens));
    let there = |hole: &&(i64, i64, i64)| {
        own.iter()
            .any(|found| (found.0, found.1) == (hole.0, hole.1) && found.2 <= hole.2)
    };
    assert_eq!(
        siemens.iter().filter(there).count(),
        siemens.len(),
        "{own:?} {siemens:?}"
    );
    let common = own.iter().filter(|hole| siemens.contains(hole)).count();
    assert_eq!((own.len(), siemens.len(), common), (41, 41, 41));
}

/// M140 moves X, Y and Z, which its block does not name: to the limit that is to an unknown place, in a tilted plane too.
#[test]
fn a_retreat_to_the_limit_ends_at_an_unknown_place() {
    let plane = "PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN FMAX\n";
    for (before, back, known) in [
        ("", "M140 MB MAX FMAX", false),
        (plane, "M140 MB MAX F3000", false),
        ("", "M140 MB50 FMAX", true),
        (plane, "L M140 MB50 FMAX", true),
    ] {
        let text = program(&format!("{before}L X+0 Y+0 Z+5 R0 FMAX\n{back}\nL M30\n"));
        let motions = run_text(NAME, &text).motions;
        let last = motions.last().expect("a motion");
        assert_eq!(last.end.xyz().is_some(), known, "{before}{back}");
        // what is left open has moved
        assert_eq!(last.says_way & 0b111 == 0b111, !known, "{before}{back}");
    }
}

/// MB of PLANE leads the tool back before the axes turn; a turn about another point than the tip ends at a place that is not followed.
#[test]
fn a_plane_retracts_before_it_turns() {
    let motions = |how: &str| {
        let text = program(&format!(
            "L X+1 Y+2 Z+5 R0 FMAX\nPLANE SPATIAL SPA+0 SPB+45 SPC+0 {how}\nL M30\n"
        ));
        run_text(NAME, &text).motions
    };
    let [.., back, turn] = &motions("TURN MB30 FMAX")[..] else {
        panic!("a retract and a turn");
    };
    assert_eq!(back.end.xyz(), Some(Vec3::new(1.0, 2.0, 35.0)));
    assert_eq!((turn.tilt.swivel, turn.feed), (Swivel::AxesStay, Feed::Rapid));
    let [.., back, _] = &motions("TURN MB MAX FMAX")[..] else {
        panic!("a retract and a turn");
    };
    assert_eq!((back.end.xyz(), back.says_way & 0b111), (None, 0b111));
    for (how, swivel, feed) in [
        ("MOVE DIST0 F1000", Swivel::TipStays, Feed::Unknown),
        ("MOVE DIST50 FMAX", Swivel::AxesLost, Feed::Rapid),
        ("MOVE ABST50 F1000", Swivel::AxesLost, Feed::Unknown),
        ("TURN DIST50 FMAX", Swivel::AxesStay, Feed::Rapid),
    ] {
        let motions = motions(how);
        let turn = motions.last().expect("a turn");
        assert_eq!((turn.tilt.swivel, turn.feed), (swivel, feed), "{how}");
    }
}

#[test]
fn words_of_m_codes_are_no_words_of_the_path() {
    let body = "L X+10 Y+5 R0 F100 M118 X1 Y1 Z0.5\nL X+20 M124 T0.01\nL M30\n";
    let log = run_text(NAME, &program(body));
    let length = |fault: &Fault| matches!(fault.kind, FaultKind::ToolLengthUnset { .. });
    assert!(log.faults.iter().all(length), "{:?}", log.faults);
    let places: Vec<_> = log
        .motions
        .iter()
        .map(|motion| (motion.end.get(0), motion.end.get(1)))
        .collect();
    assert_eq!(
        places[places.len() - 2..],
        [(Some(10.0), Some(5.0)), (Some(20.0), Some(5.0))]
    );
}
