//! `insert-retract`: the tool turns over in the air; and what its claim must refuse.
use super::strategy_2::{certified, refused, run, settings};
use trunnion::certify::{Claim, Outcome, certify};
use trunnion::check::{Assume, Settings};
use trunnion::geometry::plane::{Point, Polygon};
use trunnion::geometry::{Vec3, rad};
use trunnion::interp::{Setup, Tool, ToolShape};
use trunnion::machine::{self, Footprint, Joints, Machine, Obstacle, ObstacleKind, RapidPath, forward};
use trunnion::rewrite::{Attempt, Options};

/// The machine of the guide-vane paper with a part on its table, 60 mm square and up to Z5.
pub(crate) fn with_part() -> Machine {
    let mut machine = machine::builtin("mikron-ucp710").expect("built in").clone();
    let corners = [[-30.0, -30.0], [30.0, -30.0], [30.0, 30.0], [-30.0, 30.0]].map(Point::from);
    machine.obstacles.0.push(Obstacle {
        name: "block".to_owned(),
        axis: Some(b'C'),
        footprint: Footprint::Polygon(Polygon::new(&corners).expect("a polygon")),
        bottom: -20.0,
        top: 5.0,
        kind: ObstacleKind::Part,
    });
    machine
}

fn setup(shape: Option<ToolShape>) -> Setup {
    Setup {
        tools: vec![Tool {
            number: 0,
            shape,
            diameter_mm: Some(6.0),
            length_mm: Some(50.0),
            holder_mm: None,
        }],
        ..Setup::default()
    }
}

fn on(machine: &Machine) -> Settings<'_> {
    let mut settings = settings("sinumerik-840d", setup(Some(ToolShape::Flat)));
    settings.machine = Some(machine);
    settings.assume = Assume::ALL;
    settings
}

const HEAD: &str = "T1 M6\nTRAORI\nG0 X0 Y0 Z20 A20 C10\nG1 X0 Y0 Z5 A20 C10 S8000 M3 F400\n";

/// A cut over the pole: A from 20.2 to -20.5 while C turns by 180.1 deg.
fn program() -> String {
    format!("{HEAD}N30 X4 A20.2 C10.1\nN40 X5 A-20.5 C190.2\nN50 X9 A-20.7 C190.3\nM30\n")
}

fn retract(text: &str, settings: &Settings<'_>) -> Attempt {
    run("insert-retract", text, settings, &Options::default())
}

/// Tip and tool axis at the ends of the lines with words, under tool centre point control.
fn poses(machine: &Machine, text: &str) -> Vec<(Vec3, Vec3)> {
    let mut now = [0.0; 5];
    let mut all = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with(['T', 'M'])) {
        for word in line.split(' ') {
            let (letter, number) = word.split_at(1);
            if let (Some(index), Ok(value)) = ("XYZAC".find(letter), number.parse::<f64>()) {
                now[index] = value;
            }
        }
        let mut joints = Joints::default();
        for (letter, value) in b"AC".iter().zip(&now[3..]) {
            joints[machine.joint(*letter).expect("an axis")] = rad(*value);
        }
        let axis = forward(machine, &joints, 0.0).axis;
        all.push((Vec3::new(now[0], now[1], now[2]), axis));
    }
    all
}

#[test]
fn the_tool_leaves_along_its_axis_turns_in_the_air_and_comes_back() {
    let machine = with_part();
    let settings = on(&machine);
    let (after, certificate) = certified(retract(&program(), &settings));
    assert_eq!(after.lines().count(), program().lines().count() + 4, "{after}");
    let poses = poses(&machine, &after);
    // rapid, cut to the start, N30, out, turned, ramp, back, N40
    let [_, begin, left, out, turned, ramp, back, ..] = poses[..] else {
        panic!("{after}")
    };
    let beside = |from: &(Vec3, Vec3), to: &(Vec3, Vec3)| {
        let way = to.0 - from.0;
        (way.dot(&from.1), (way - from.1 * way.dot(&from.1)).norm())
    };
    let (up, off) = beside(&left, &out);
    assert!(up > 3.0 && off < 1e-3, "{up} {off}");
    // as steeply tilted as before, the other way round: the same axis at the start of N30
    assert!((turned.1 - begin.1).norm() < 1e-9);
    let (up, off) = beside(&begin, &turned);
    assert!(up > 3.0 && off < 1e-3, "{up} {off}");
    let (up, off) = beside(&begin, &ramp);
    assert!(up > 0.01 && off < 1e-3, "{up} {off}");
    assert!((back.0 - left.0).norm() < 1e-9 && (back.1 - left.1).norm() < 1e-9);
    // the lowest point of a tilted flat end is radius times sine below the tip
    let lowest = turned.0.z - 3.0 * trunnion::geometry::math::sin(rad(20.2));
    assert!(lowest >= 5.0 + 1.0 - 1e-6, "{lowest}");
    let changes = certificate.rapids.expect("motions away from the part");
    assert_eq!((changes.runs, changes.motions_after), (1, 4));
    assert!(changes.least_distance_mm.expect("a distance") >= 1.0);
    assert!(
        matches!(retract(&after, &settings).outcome(), Ok(None)),
        "once is enough"
    );
}

#[test]
fn where_the_axes_of_a_rapid_arrive_together_it_turns_at_rapid() {
    let mut machine = with_part();
    machine.control.rapid = RapidPath::Synchronous;
    let text = program()
        .replace("C190", "C-169")
        .replace("C-169.2", "C-169.8")
        .replace("C-169.3", "C-169.7");
    let (after, _) = certified(retract(&text, &on(&machine)));
    // C turns by exactly half a turn: above the cut before it would be more, so it comes straight down
    let lines: Vec<&str> = after.lines().skip(5).take(3).collect();
    assert!(
        lines[0].starts_with("G0 X") && lines[1].ends_with("A-20.2 C-169.9") && lines[1].starts_with('X'),
        "{after}"
    );
    assert_eq!(lines[2], "G1 X4.000 Y0.000 Z5.000", "{after}");
}

#[test]
fn what_is_missing_is_named() {
    let plain = machine::builtin("mikron-ucp710").expect("built in");
    assert!(refused(retract(&program(), &on(plain))).contains("the part is not declared"));
    let machine = with_part();
    let mut settings = on(&machine);
    settings.setup = setup(None);
    assert!(refused(retract(&program(), &settings)).contains("shape and diameter of the tool"));
    let mut settings = on(&machine);
    settings.assume = Assume::default();
    assert!(refused(retract(&program(), &settings)).contains("are not declared"));
    let vectors = format!("{HEAD}N40 G1 X5 Y0 Z5 A3=0.3 B3=0.2 C3=0.9\nM30\n");
    let outcome = retract(&vectors, &on(&machine)).outcome();
    assert!(!matches!(outcome, Ok(Some(_))));
    // nothing turns over
    let smooth = format!("{HEAD}N30 X4 A20.2 C10.1\nM30\n");
    assert!(matches!(retract(&smooth, &on(&machine)).outcome(), Ok(None)));
}

#[test]
fn other_texts_are_not_proved() {
    let machine = with_part();
    let settings = on(&machine);
    let (after, certificate) = certified(retract(&program(), &settings));
    let proves = |after: &str, machine: &Machine, setup: &Setup, claim: &Claim| {
        certify(
            program().as_bytes(),
            after.as_bytes(),
            settings.dialect,
            machine,
            setup,
            claim,
        )
    };
    let claim = &certificate.claim;
    let own = &settings.setup;
    assert!(matches!(proves(&after, &machine, own, claim), Outcome::Proved(_)));
    let lines: Vec<&str> = after.lines().collect();
    let first = lines
        .iter()
        .position(|line| line.starts_with("G0 X4"))
        .unwrap_or_else(|| panic!("{after}"));
    let with = |changes: &[(usize, &str)]| {
        let mut lines: Vec<String> = lines.iter().map(|&line| line.to_owned()).collect();
        for &(at, text) in changes {
            text.clone_into(&mut lines[first + at]);
        }
        lines.join("\n") + "\n"
    };
    let wrong = [
        ("beside the tool axis", with(&[(0, "G0 X4.400 Y-1.650 Z9.555")])),
        ("into the part", with(&[(0, "G0 X3.706 Y1.650 Z0.445")])),
        (
            "too low to turn",
            with(&[
                (0, "G0 X4.032 Y-0.181 Z5.500"),
                (1, "G1 X0.032 Y-0.185 Z5.500 A-20 C190"),
            ]),
        ),
        ("the ramp below the cut", with(&[(2, "X-0.003 Y0.017 Z4.953")])),
        ("the ramp beside the cut", with(&[(2, "X0.003 Y0.100 Z5.047")])),
        (
            "back somewhere else",
            with(&[(3, "X4.010 Y0.000 Z5.000 A-20.2 C190.1")]),
        ),
        (
            "back with another axis",
            with(&[(3, "X4.000 Y0.000 Z5.000 A-20.4 C190.1")]),
        ),
        (
            "back at another feed",
            with(&[(3, "X4.000 Y0.000 Z5.000 A-20.2 C190.1 F500")]),
        ),
        ("back at rapid", with(&[(2, "G0 X0.003 Y-0.017 Z5.047")])),
        ("the spindle stops", with(&[(0, "M5\nG0 X4.294 Y-1.650 Z9.555")])),
        (
            "in the old posture",
            with(&[
                (1, "G1 X0.296 Y-1.679 Z9.684 A20 C10"),
                (3, "X4.000 Y0.000 Z5.000 A20.2 C10.1"),
            ]),
        ),
        ("not back", with(&[(2, ""), (3, "")])),
        ("another cut after it", after.replace("N40 X5 ", "N40 X5.1 ")),
    ];
    for (what, text) in &wrong {
        let outcome = proves(text, &machine, own, claim);
        assert!(!matches!(outcome, Outcome::Proved(_)), "{what}");
    }
}

#[test]
fn what_is_not_declared_is_unknown_to_the_kernel() {
    let machine = with_part();
    let settings = on(&machine);
    let (after, certificate) = certified(retract(&program(), &settings));
    let proves = |after: &str, machine: &Machine, setup: &Setup, claim: &Claim| {
        let texts = [program(), after.to_owned()];
        certify(
            texts[0].as_bytes(),
            texts[1].as_bytes(),
            settings.dialect,
            machine,
            setup,
            claim,
        )
    };
    let (claim, own) = (&certificate.claim, &settings.setup);
    let plain = machine::builtin("mikron-ucp710").expect("built in");
    assert!(matches!(proves(&after, plain, own, claim), Outcome::Unknown(_)));
    assert!(matches!(
        proves(&after, &machine, &setup(None), claim),
        Outcome::Unknown(_)
    ));
    let mut narrow = own.clone();
    narrow.tools[0].holder_mm = Some(5.0);
    assert!(matches!(proves(&after, &machine, &narrow, claim), Outcome::Unknown(_)));
    narrow.tools[0].holder_mm = Some(8.0);
    assert!(matches!(proves(&after, &machine, &narrow, claim), Outcome::Proved(_)));
    let mut clamped = with_part();
    clamped.obstacles.0.push(Obstacle {
        name: "clamp".to_owned(),
        kind: ObstacleKind::Body,
        top: 40.0,
        ..clamped.obstacles.0[0].clone()
    });
    assert!(!matches!(proves(&after, &clamped, own, claim), Outcome::Proved(_)));
}

/// On a tilting head a rapid along the tool axis moves several axes. Where they may arrive at different times, the tool leaves at feed.
#[test]
fn a_tilted_head_leaves_the_part_at_feed() {
    let mut machine = machine::builtin("head-table-bc").expect("built in").clone();
    machine.obstacles = with_part().obstacles;
    let text = "T1 M6\nTRAORI\nG0 X0 Y0 Z20 B15 C5\nG1 X0 Y0 Z5 B15 C5 S8000 M3 F400\nN30 X4 B15.1 C5.1\nN40 X5 B-15.2 C185.2\nN50 X9 B-15.3 C185.3\nM30\n";
    let (after, _) = certified(retract(text, &on(&machine)));
    let line = |at: usize| after.lines().nth(at).unwrap_or_default();
    assert!(line(5).starts_with("G1 X") && !line(5).contains('B'), "{after}");
    assert!(line(6).contains("B-15 ") && line(6).starts_with('X'), "{after}");
    // and at rapid where they arrive together
    machine.control.rapid = RapidPath::Synchronous;
    let (after, _) = certified(retract(text, &on(&machine)));
    assert!(
        after
            .lines()
            .any(|line| line.starts_with("G0 X") && !line.contains('B')),
        "{after}"
    );
    // another line at feed that leaves the tool's axis is not taken for it
    let claim = Claim::InsertedRetracts {
        tolerance_mm: 0.001,
        tolerance_deg: 0.1,
        clearance_mm: 1.0,
        assumed_zeros: true,
    };
    let stray = text.replace("N40", "G1 X4 Y0 Z12 B15.1 C5.1\nG1 X4 Y0 Z5\nN40");
    let settings = on(&machine);
    let outcome = certify(
        text.as_bytes(),
        stray.as_bytes(),
        settings.dialect,
        &machine,
        &settings.setup,
        &claim,
    );
    assert!(!matches!(outcome, Outcome::Proved(_)));
}
