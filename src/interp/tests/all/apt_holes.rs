//! APT: hole cycles as motions, and coordinate systems.
use crate::support::{faults, lines, run_text};
use trunnion_interp::Orientation;

/// The motions after a rapid to X0 Y0 Z50.
fn hole(records: &str) -> Vec<String> {
    let text = format!("RAPID\nGOTO/0,0,50\nFEDRAT/200,MMPM\n{records}\nFINI\n");
    assert_eq!(faults("apt", &text), [] as [String; 0], "{records}");
    lines("apt", &text)[1..].to_vec()
}

/// In from 3 above to 20 below the point, and back to 3 above it.
const PLAIN: [&str; 4] = [
    "R X10 Y0 Z50 tcp <0 0 1>",
    "R X10 Y0 Z8 tcp <0 0 1>",
    "L X10 Y0 Z-15 F80 tcp <0 0 1>",
    "R X10 Y0 Z8 tcp <0 0 1>",
];

#[test]
fn a_drilled_hole_in_every_spelling() {
    for cycle in [
        "CYCLE/DRILL,DEPTH,20,MMPM,80,CLEAR,3",
        "CYCLE / DRILL, DEPTH, 20., $\n MMPM, 80, CLEAR, 3",
        "CYCLE/DRILL,FEDTO,-20,RAPTO,3,RTRCTO,3,MMPM,80",
        "CYCLE/DRILL,RAPTO,3.,FEDTO,-20.,RTRCTO,3.,MANUAL,MMPM,80.",
        "CYCLE/FACE,DEPTH,20,MMPM,80,CLEAR,5,RAPTO,2,RETURN,3",
        "CYCLE/CSINK,FEDTO,20,MMPM,80,RAPTO,3,DWELL,0",
        "CYCLE/DRILL,20,MMPM,80,3",
        "CYCLE/DRILL,20,80,MMPM,3",
        "CYCLE/INIT\nCYCLE/DRILL,FEDTO,20,MMPM,80,RAPTO,3,RTRCTO,3",
    ] {
        let found = hole(&format!("{cycle}\nGOTO/10,0,5\nCYCLE/OFF"));
        assert_eq!(found, PLAIN, "{cycle}");
    }
}

/// The second hole is approached at the level that the tool has; after CYCLE/OFF points are points; CYCLE/ON resumes.
#[test]
fn every_point_is_a_hole_until_the_cycle_ends() {
    let text = "CYCLE/DRILL,FEDTO,5,MMPM,80,RAPTO,2,RTRCTO,10\nGOTO/10,0,0\nGOTO/20,0,0\nCYCLE/OFF\nGOTO/20,0,30\nCYCLE/ON\nGOTO/30,0,0";
    assert_eq!(
        hole(text),
        [
            "R X10 Y0 Z50 tcp <0 0 1>",
            "R X10 Y0 Z2 tcp <0 0 1>",
            "L X10 Y0 Z-5 F80 tcp <0 0 1>",
            "R X10 Y0 Z10 tcp <0 0 1>",
            "R X20 Y0 Z10 tcp <0 0 1>",
            "R X20 Y0 Z2 tcp <0 0 1>",
            "L X20 Y0 Z-5 F80 tcp <0 0 1>",
            "R X20 Y0 Z10 tcp <0 0 1>",
            "L X20 Y0 Z30 F200 tcp <0 0 1>",
            "R X30 Y0 Z30 tcp <0 0 1>",
            "R X30 Y0 Z2 tcp <0 0 1>",
            "L X30 Y0 Z-5 F80 tcp <0 0 1>",
            "R X30 Y0 Z10 tcp <0 0 1>",
        ]
    );
}

#[test]
fn a_tap_and_a_reamer_go_back_at_the_feed() {
    for (cycle, feed) in [
        ("CYCLE/TAP,DEPTH,9,MMPR,1.25,CLEAR,4", "F1.25/rev"),
        ("CYCLE/REAM,DEPTH,9,MMPM,60,CLEAR,4,DWELL,2", "F60"),
    ] {
        let found = hole(&format!("{cycle}\nGOTO/0,0,0"));
        let found: Vec<&str> = found
            .iter()
            .map(String::as_str)
            .filter(|line| !line.starts_with('D'))
            .collect();
        assert_eq!(
            found,
            [
                "R X0 Y0 Z4 tcp <0 0 1>".to_owned(),
                format!("L X0 Y0 Z-9 {feed} tcp <0 0 1>"),
                format!("L X0 Y0 Z4 {feed} tcp <0 0 1>"),
            ],
            "{cycle}"
        );
    }
}

/// First step from the clearance, the rest from step to step. Where the rapid back ends is a setting of the control.
#[test]
fn a_deep_hole_goes_in_steps() {
    let text = "FEDRAT/200\nRAPID\nGOTO/0,0,50\nCYCLE/DEEP2,FEDTO,6,1STPECK,4,SUBPECK,2,MMPM,80,RAPTO,1,RTRCTO,1\nGOTO/0,0,0\nFINI\n";
    assert_eq!(
        lines("apt", text)[1..],
        [
            "R X0 Y0 Z1 tcp <0 0 1>",
            "L X0 Y0 Z-3 F80 tcp <0 0 1>",
            "R X0 Y0 Z1 tcp <0 0 1>",
            "R - tcp <0 0 1>",
            "L X0 Y0 Z-5 F80 tcp <0 0 1>",
            "R X0 Y0 Z1 tcp <0 0 1>",
            "R - tcp <0 0 1>",
            "L X0 Y0 Z-6 F80 tcp <0 0 1>",
            "R X0 Y0 Z1 tcp <0 0 1>",
        ]
    );
    let found = faults("apt", text);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("peck_clearance"), "{found:?}");
}

/// A hole across the part: depth and clearance are along the tool.
#[test]
fn a_hole_along_the_tool() {
    let text = "MULTAX/ON\nRAPID\nGOTO/50,0,0,1,0,0\nCYCLE/DRILL,FEDTO,10,MMPM,80,RAPTO,2\nGOTO/40,5,0,1,0,0\nFINI\n";
    assert_eq!(
        lines("apt", text)[1..],
        [
            "R X50 Y5 Z0 tcp <1 0 0>",
            "R X42 Y5 Z0 tcp <1 0 0>",
            "L X30 Y5 Z0 F80 tcp <1 0 0>",
            "R X42 Y5 Z0 tcp <1 0 0>",
        ]
    );
}

#[test]
fn what_a_cycle_does_not_say_is_unknown() {
    for (cycle, why) in [
        ("CYCLE/MILL,DEPTH,5", "CYCLE/MILL"),
        ("CYCLE/THRU,DEPTH,5,CLEAR,1", "CYCLE/THRU"),
        ("CYCLE/DRILL,DEPTH,5,MMPM,80", "without a clearance"),
        ("CYCLE/DRILL,MMPM,80,CLEAR,1", "without a depth"),
        ("CYCLE/DEEP,DEPTH,5,MMPM,80,CLEAR,1", "without a step"),
        ("CYCLE/DRILL,DEPTH,5,MMPM,80,CLEAR,1,ORIENT,90", "DRILL with ORIENT"),
        ("CYCLE/BORE,DEPTH,5,MMPM,80,CLEAR,1", "at the feed or in rapid"),
        ("CYCLE/DRILL,DEPTH,5,MMPM,80,CLEAR,1,RETURN,0", "goes back to"),
    ] {
        let text = format!("FEDRAT/9\nGOTO/0,0,50\n{cycle}\nGOTO/0,0,0\nGOTO/5,0,0\nFINI\n");
        let found = faults("apt", &text);
        assert_eq!(found.len(), 1, "{cycle}: {found:?}");
        assert!(found[0].contains(why), "{cycle}: {found:?}");
        let log = run_text("apt", &text);
        let is_known = |motion: &trunnion_interp::Motion| {
            motion.kind != trunnion_interp::MotionKind::Unknown && motion.end.xyz().is_some()
        };
        assert!(!log.motions[1..].iter().all(is_known), "{cycle}");
    }
}

/// The tool axes of the set-ups as the programs name them that were posted from these records.
#[test]
fn a_system_turns_points_and_the_tool() {
    for (csys, axis) in [
        ("CSYS/0,0,-1.,0,-1.,0,0,0,0,1.,0,0", [-1.0, 0.0, 0.0]),
        ("CSYS/0,0,1.,0,1.,0,0,0,0,1.,0,0", [1.0, 0.0, 0.0]),
        ("CSYS/-1.,0,0,0,0,1.,0,0,0,0,-1.,0", [0.0, 0.0, -1.0]),
        (
            "CSYS/0,.999987,.005061,0,-1.,0,0,0,0,-0.005061,.999987,0",
            [0.005_061, 0.0, 0.999_987],
        ),
    ] {
        let log = run_text("apt", &format!("FEDRAT/9\n{csys}\nGOTO/1,2,3\nFINI\n"));
        let Orientation::Vector(_, found) = log.motions[0].orientation else {
            panic!("{csys}: no vector");
        };
        for (i, wanted) in axis.iter().enumerate() {
            assert!((found[i] - wanted).abs() < 1e-5, "{csys}: {found}");
        }
    }
    // what the shift is, no source says
    let shifted = "FEDRAT/9\nCSYS/-1,0,0,144,0,-1,0,745,0,0,1,0\nGOTO/100,300,5\n";
    assert_eq!(lines("apt", shifted), ["U - F9 tcp"]);
    assert!(faults("apt", shifted)[0].contains("CSYS with a shift"));
    // under TRNTYP/WORLD the records are in the part, and the system only turns a tool without a vector
    let world = "TRNTYP/WORLD,0,0,0\nCSYS/0,0,1.,0,1.,0,0,7,0,1.,0,0\n";
    assert_eq!(
        lines(
            "apt",
            &format!("FEDRAT/9\n{world}GOTO/1,2,3\nGODLTA/4\nGOTO/1,2,3,0,0,1\n")
        ),
        [
            "L X1 Y2 Z3 F9 tcp <1 0 0>",
            "L X5 Y2 Z3 F9 tcp <1 0 0>",
            "L X1 Y2 Z3 F9 tcp <0 0 1>"
        ]
    );
    assert_eq!(
        faults("apt", &format!("FEDRAT/9\n{world}GOTO/1,2,3\n")),
        [] as [String; 0]
    );
    let other = format!("FEDRAT/9\n{}GOTO/1,2,3\n", world.replace("WORLD", "LOCAL"));
    assert!(faults("apt", &other)[0].contains("TRNTYP/LOCAL"));
    assert_eq!(
        lines(
            "apt",
            "FEDRAT/9\nMSYS/10,0,5, 0,1,0, -1,0,0\nGOTO/1,2,3\nGODLTA/1,0,0\n"
        ),
        ["L X1 Y2 Z3 F9 tcp <0 0 1>", "L X2 Y2 Z3 F9 tcp <0 0 1>"]
    );
}

/// NX writes its axes with three digits. The points are in the system that it names; in which they are after another one is not known.
#[test]
fn a_system_of_nx_is_the_one_of_its_points() {
    let system = "MSYS/0,0,180,.5,0,.866,.866,0,-.5\n";
    let end = |text: &str| {
        let log = run_text("apt", text);
        let last = log.motions.last().expect("a motion").end.xyz();
        (last.map(<[f64; 3]>::from), log.faults.len())
    };
    let known = (Some([1.0, 2.0, 3.0]), 0);
    assert_eq!(end(&format!("FEDRAT/9\n{system}GOTO/1,2,3\n")), known);
    assert_eq!(
        end(&format!("FEDRAT/9\n{system}GOTO/1,2,9\n{system}GOTO/1,2,3\n")),
        known
    );
    let other = system.replace("180", "170");
    assert_eq!(
        end(&format!("FEDRAT/9\n{system}GOTO/1,2,9\n{other}GOTO/1,2,3\n")),
        (None, 1)
    );
    assert_eq!(end(&format!("FEDRAT/9\nGOTO/1,2,9\n{other}GOTO/1,2,3\n")), (None, 1));
    assert_eq!(end("FEDRAT/9\nGOTO/1,2,9\nMSYS/0,0,0,1,0,0,0,1,0\nGOTO/1,2,3\n"), known);
}

/// A text for the machine may have turned the tool; the system that is named after it says where Z is.
#[test]
fn a_system_says_where_the_tool_is_after_an_insert() {
    let text = "FEDRAT/9\nGOTO/1,2,3\nINSERT/TURN IT\nCSYS/1,0,0,0,0,1,0,0,0,0,1,0\nGOTO/1,2,9\n";
    assert_eq!(lines("apt", text)[1], "L X1 Y2 Z9 F9 tcp <0 0 1>");
    assert_eq!(lines("apt", &text.replace("CSYS", "PPRINT"))[1], "L X1 Y2 Z9 F9 tcp");
}

/// From one set-up to the next the tool stays where it is, and turns with the next motion.
#[test]
fn a_change_of_the_system_moves_nothing() {
    let text = "FEDRAT/9\nGOTO/1,2,3\nCSYS/0,0,1,0,1,0,0,0,0,1,0,0\nGOTO/1,2,3\nCIRCLE/1,0,3,0,0,1\nGOTO/3,0,3\nFINI\n";
    let log = run_text("apt", text);
    assert_eq!(log.faults, []);
    let ends: Vec<[f64; 3]> = log
        .motions
        .iter()
        .filter_map(|motion| Some(motion.end.xyz()?.into()))
        .collect();
    assert_eq!(ends, [[1.0, 2.0, 3.0], [3.0, 1.0, 2.0], [3.0, 3.0, 0.0]]);
    assert_eq!(log.motions[1].start.xyz(), log.motions[0].end.xyz());
    let trunnion_interp::MotionKind::Arc(Some(arc)) = log.motions[2].kind else {
        panic!("an arc");
    };
    assert_eq!(<[f64; 3]>::from(arc.normal), [1.0, 0.0, 0.0]);
}

#[test]
fn shifts_of_the_post_processor() {
    assert_eq!(
        lines(
            "apt",
            "FEDRAT/9\nTRANS/10,0,0\nGOTO/1,2,3\nTRANS/0,0,1\nORIGIN/1,1,1\nGOTO/1,2,3\nTRACUT/0,-1,0,5,1,0,0,0,0,0,1,0\nGOTO/1,2,3\nTRACUT/NOMORE\nGOTO/1,2,3\n"
        ),
        [
            "L X11 Y2 Z3 F9 tcp <0 0 1>",
            "L X0 Y1 Z3 F9 tcp <0 0 1>",
            "L X2 Y0 Z3 F9 tcp <0 0 1>",
            "L X0 Y1 Z3 F9 tcp <0 0 1>",
        ]
    );
    for record in [
        "CSYS/1,0,0,0,0,1,0,0,0,0,-1,0",
        "CSYS/1,0,0,0,0,1,0.1,0,0,0,1,0",
        "MSYS/0,0,0,1,0,0",
        "TRANS/XAXIS,3",
        "TRACUT/MATRX1",
    ] {
        let text = format!("FEDRAT/9\n{record}\nGOTO/1,2,3\n");
        let name = record.split('/').next().expect("a major word");
        assert!(
            faults("apt", &text).iter().any(|fault| fault.contains(name)),
            "{record}"
        );
        assert!(run_text("apt", &text).motions[0].end.xyz().is_none(), "{record}");
    }
}
