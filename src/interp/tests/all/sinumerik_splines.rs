//! ASPLINE, BSPLINE and CSPLINE where the settings declare how they run.
use crate::support::{Log, fault_line, run_bytes, shared};
use trunnion_interp::{FaultKind, Feed, Motion, MotionKind, Setup, SplineReading};

const HEAD: &str = "G17 G90 G94 G710\nG0 X0 Y0 Z0\nG1 F100\n";

fn run(text: &str) -> (Log, Vec<String>) {
    let mut setup = Setup::default();
    setup.control.splines = Some(SplineReading::ChordLength);
    let (program, mut log) = run_bytes("sinumerik-840d", format!("{HEAD}{text}").as_bytes(), &setup);
    let told = log
        .faults
        .iter()
        .filter(|fault| matches!(fault.kind, FaultKind::NotModelled { .. }));
    let told = told.map(|fault| fault_line(&program, fault)).collect();
    log.motions.retain(|motion| !matches!(motion.kind, MotionKind::Rapid));
    (log, told)
}

fn end(motion: &Motion) -> Option<[f64; 3]> {
    motion.end.xyz().map(Into::into)
}

/// Distance of a place from the lines of motions.
fn distance(motions: &[Motion], place: [f64; 3]) -> f64 {
    let place = trunnion_geometry::Vec3::from(place);
    let lines = motions
        .iter()
        .filter_map(|motion| Some((motion.start.xyz()?, motion.end.xyz()?)));
    lines
        .map(|(from, to)| {
            let way = to - from;
            let share = if way.norm() > 0.0 {
                (place - from).dot(&way) / way.norm_squared()
            } else {
                0.0
            };
            (place - from - way * share.clamp(0.0, 1.0)).norm()
        })
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn each_ends_where_the_program_says() {
    for (code, through) in [("ASPLINE", true), ("CSPLINE", true), ("BSPLINE", false)] {
        let (log, told) = run(&format!("{code} X10 Y5\nX20 Y-3 Z2\nM8\nX30\nX40 Y8\nG1 X50\nM30\n"));
        assert_eq!(told, [""; 0], "{code}");
        let places = [[10.0, 5.0, 0.0], [20.0, -3.0, 2.0], [30.0, -3.0, 2.0], [40.0, 8.0, 2.0]];
        let lines = &log.motions[..log.motions.len() - 1];
        assert!(lines.len() > 20, "{code}: {}", lines.len());
        for (at, place) in places.into_iter().enumerate() {
            assert_eq!(distance(lines, place) < 1e-9, through || at == 3, "{code} {place:?}");
        }
        // without a gap, and on to the last motion
        for pair in log.motions.windows(2) {
            assert_eq!(pair[0].end.xyz(), pair[1].start.xyz(), "{code}");
        }
        assert_eq!(end(&lines[lines.len() - 1]), Some(places[3]), "{code}");
        assert!(
            lines
                .iter()
                .all(|line| line.slack_mm > 0.0 && line.slack_mm < 1e-4 && line.feed == Feed::PerMinute(100.0))
        );
        // each line belongs to a block of the spline, in order
        let blocks: Vec<u32> = lines.iter().map(|line| line.block.0).collect();
        assert!(
            blocks.is_sorted() && blocks[0] >= 3 && blocks.last() == Some(&7),
            "{code} {blocks:?}"
        );
    }
}

/// The lines of CEAD's interpreter, whose tolerance is 0.1 mm: their ends are on the curve.
#[test]
fn the_b_spline_of_another_interpreter() {
    let (Some(program), Some(trace)) = (
        shared("controls/sinumerik/cead/flatten_demo.mpf"),
        shared("controls/sinumerik/cead/flatten_demo_flattened.csv"),
    ) else {
        return;
    };
    let (log, told) = run(&String::from_utf8_lossy(&program));
    assert_eq!(told, [""; 0]);
    let lines: Vec<Motion> = log
        .motions
        .iter()
        .filter(|motion| motion.kind == MotionKind::Linear)
        .copied()
        .collect();
    let arc = log.motions.iter().find_map(|motion| match motion.kind {
        MotionKind::Arc(Some(arc)) => Some(arc),
        _ => None,
    });
    let arc = arc.expect("an arc");
    let (mut on_arc, mut on_spline) = (0, 0);
    for row in String::from_utf8_lossy(&trace).lines() {
        let cells: Vec<&str> = row.split(',').collect();
        let generated = cells.get(6).is_some_and(|cell| *cell == "1.000");
        let place: Vec<f64> = cells
            .iter()
            .skip(2)
            .take(3)
            .filter_map(|cell| cell.parse().ok())
            .collect();
        let ([x, y, z], true) = (place[..].try_into().unwrap_or([f64::NAN; 3]), generated) else {
            continue;
        };
        if x <= 100.0 && (x < 100.0 || y < 50.0) {
            on_arc += 1;
            let radius = (trunnion_geometry::Vec3::new(x, y, z) - arc.centre).norm();
            assert!((radius - arc.radius_start).abs() <= 1e-3, "{row}");
        } else {
            on_spline += 1;
            assert!(
                distance(&lines, [x, y, z]) <= 1e-3,
                "{row}: {}",
                distance(&lines, [x, y, z])
            );
        }
    }
    assert!(on_arc >= 24 && on_spline >= 18, "{on_arc} {on_spline}");
}

#[test]
fn what_is_not_followed_has_a_name_and_known_ends() {
    for (text, why) in [
        ("BSPLINE X10 Y5\nX20\nX30 A5\nX40\n", "rotary axes"),
        ("BSPLINE X10 Y5\nX20\nTRANS X5\nX30\n", "TRANS between its points"),
        ("BSPLINE X10 Y5\nX20\nG4 F1\nX30\n", "G4 between its points"),
        ("BSPLINE X10 Y5 PL=2\nX20\nX30\n", "PL"),
        ("BSPLINE X10 Y5 PW=5\nX20\nX30\n", "PW outside"),
        ("BSPLINE X10 Y5 PW=R99\nX20\nX30\n", "not known"),
        ("BSPLINE SD=4 X10 Y5\nX20\nX30\nX40\n", "SD other than"),
        ("BSPLINE X10 Y5\n", "fewer points than"),
        ("BSPLINE X10 Y5\nPW=2\nX20\nX30\n", "between its points"),
        ("BSPLINE X10 Y5\nX20 D2\nX30\n", "T or D"),
        ("CSPLINE X10 Y5\nX10 Y5\nX30\n", "two points at one place"),
        ("BTAN ETAN CSPLINE X10 Y5\nX20\nX30\n", "BTAN"),
        ("CSPLINE X10 Y5\nX=R99\nX30\n", "not known"),
        ("G41 D1 BSPLINE X10 Y5\nX20 Y9\nX30\n", "radius compensation"),
    ] {
        let text = format!("{text}G40 G1 X50 Y60 Z7 F200\n");
        let (log, told) = run(&text);
        assert!(told.iter().any(|told| told.contains(why)), "{text}: {told:?}");
        let (last, rest) = log.motions.split_last().expect("motions");
        assert!(
            rest.iter()
                .all(|motion| matches!(motion.kind, MotionKind::Unknown | MotionKind::Dwell(_))),
            "{text}: {rest:?}"
        );
        assert!(
            last.kind == MotionKind::Linear && last.end.get(1) == Some(60.0),
            "{text}"
        );
    }
    // the ends of what was lost are known again with the next motion code
    let (log, _) = run("BSPLINE X10 Y5\nX20\nX30 A5\nX40\nG1 Y9\n");
    assert_eq!(end(log.motions.last().expect("a motion")), Some([40.0, 9.0, 0.0]));
    // and a later spline is followed
    let (log, told) = run("BSPLINE X10 Y5 PL=3\nX20\nG1 X30\nBSPLINE X40 Y5\nX50 Y9\nX60 Y-5\nG1 X70\n");
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(log.motions.len() > 20);
}

/// SD stands alone in the block of BSPLINE, and holds for this spline only.
#[test]
fn the_degree_holds_up_to_the_end_of_the_spline() {
    let lines = |text: &str| -> Vec<[f64; 3]> {
        let (log, told) = run(text);
        assert_eq!(told, [""; 0], "{text}");
        log.motions.iter().filter_map(end).collect()
    };
    let points = "X10 Y5\nX20 Y-3\nX30 Y8\nX40\nG1 X50\n";
    let by_itself = lines(&format!("BSPLINE SD=2\n{points}"));
    let [inside, without] = ["SD=2 ", ""].map(|degree| lines(&format!("BSPLINE {degree}{points}")));
    assert_eq!(by_itself, inside);
    assert_ne!(inside, without);
    let twice = lines(&format!("BSPLINE SD=2\n{points}G1 X0 Y0\nBSPLINE {points}"));
    assert_eq!(twice[twice.len() - without.len()..], without);
}

#[test]
fn feeds_of_a_spline() {
    let feeds = |text: &str| -> Vec<Feed> {
        let mut feeds: Vec<Feed> = run(text).0.motions.iter().map(|motion| motion.feed).collect();
        feeds.dedup();
        feeds
    };
    let text = "X10 Y5\nX20 F200\nX30 Y9\nX40\nM30\n";
    assert_eq!(
        feeds(&format!("CSPLINE {text}")),
        [Feed::PerMinute(100.0), Feed::PerMinute(200.0)]
    );
    assert_eq!(feeds(&format!("BSPLINE {text}")), [Feed::Unknown]);
}

#[test]
fn a_spline_at_the_end_of_the_text_and_in_a_subprogram_is_complete() {
    let (log, told) = run("CSPLINE X10 Y5\nX20\nX30 Y5");
    assert_eq!(
        (end(log.motions.last().expect("a motion")), told),
        (Some([30.0, 5.0, 0.0]), vec![])
    );
    let (log, told) =
        run("REPEAT CURVE ENDE P=2\nGOTOF LAST\nCURVE:\nBSPLINE X10 Y5\nX20\nX30 Y5\nG1 X0 Y0\nENDE:\nLAST:\nM30\n");
    assert_eq!(told, [""; 0]);
    assert!(log.motions.len() > 60, "{}", log.motions.len());
}
