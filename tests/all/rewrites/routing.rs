//! reroute-rapid: lengths of the paper and of another program through the whole chain, over the top, independent axes, and proofs that were tampered with.
#![allow(clippy::print_stdout, reason = "a skipped test says so")]
use super::strategy_2::{certified, refused, run};
use trunnion::certify::postures::PostureCost;
use trunnion::certify::{Certificate, Outcome, certify, recheck};
use trunnion::check::{Assume, Settings};
use trunnion::geometry::plane::{Point, Polygon};
use trunnion::interp::{Setup, Tool};
use trunnion::machine::{self, Footprint, Machine, Obstacle, RapidPath};
use trunnion::rewrite::{Attempt, Options};

const EXAMPLE: &[[f64; 2]] = &[
    [4.0, 6.0],
    [9.0, 6.0],
    [9.0, 7.0],
    [11.0, 7.0],
    [11.0, 9.0],
    [9.0, 9.0],
    [9.0, 10.0],
    [4.0, 10.0],
];

/// A mill with prisms, and the clearance.
fn mill(prisms: &[(&[[f64; 2]], f64)], clearance: f64) -> Machine {
    let mut machine = machine::builtin("mill-3axis").expect("built in").clone();
    machine.tolerances.clearance_mm = Some(clearance);
    for (index, (corners, top)) in prisms.iter().enumerate() {
        let corners: Vec<Point> = corners.iter().map(|&corner| Point::from(corner)).collect();
        machine.obstacles.0.push(Obstacle {
            name: format!("clamp {index}"),
            axis: None,
            footprint: Footprint::Polygon(Polygon::new(&corners).expect("a polygon")),
            bottom: -10.0,
            top: *top,
            kind: trunnion::machine::ObstacleKind::Body,
        });
    }
    machine
}

fn setup(diameter: f64) -> Setup {
    Setup {
        tools: vec![Tool {
            number: 0,
            shape: None,
            diameter_mm: Some(diameter),
            length_mm: None,
            holder_mm: None,
        }],
        ..Setup::default()
    }
}

fn on(machine: &Machine, diameter: f64) -> Settings<'_> {
    let mut settings = Settings::new(
        trunnion::dialect::builtin("iso-6983").expect("built in"),
        Some(machine),
        setup(diameter),
    );
    settings.assume = Assume::ALL;
    settings
}

fn reroute(text: &str, settings: &Settings<'_>, cost: PostureCost) -> Attempt {
    let options = Options {
        cost,
        ..Options::default()
    };
    run("reroute-rapid", text, settings, &options)
}

fn after(text: &str, settings: &Settings<'_>) -> (String, Certificate) {
    certified(reroute(text, settings, PostureCost::Travel))
}

/// A cut that ends at one point, and one that begins at the other.
fn program(from: [f64; 2], to: [f64; 2], between: &str) -> String {
    format!(
        "G0 X{0} Y{1} Z1\nG1 Z0 F500\n{between}G0 X{2} Y{3}\nG1 Z-1\nM30\n",
        from[0], from[1], to[0], to[1]
    )
}

fn lengths(certificate: &Certificate) -> (f64, f64) {
    let rapids = certificate.rapids.expect("a proof about rapids");
    (rapids.length_before_mm, rapids.length_after_mm)
}

#[test]
fn the_example_of_the_paper() {
    let (from, to) = ([6.0, 5.0], [6.0, 11.0]);
    for (diameter, clearance, expected) in [
        (0.0, 0.0, 8.472_136),
        (0.0, 0.1, 8.769_464),
        (0.3, 0.1, 9.243_416),
        (0.6, 0.2, 10.099_020),
        (0.8, 0.5, 11.603_447),
    ] {
        let machine = mill(&[(EXAMPLE, 400.0)], clearance);
        let settings = on(&machine, diameter);
        let (text, certificate) = after(&program(from, to, ""), &settings);
        let (was, is) = lengths(&certificate);
        assert!(
            (was - 6.0).abs() < 1e-9 && (is - expected).abs() < 5e-7,
            "{is} {expected}"
        );
        assert!(matches!(
            reroute(&text, &settings, PostureCost::Travel).outcome(),
            Ok(None)
        ));
    }
    // the other side is left for the shorter one, and the comment of a block that goes stays
    let machine = mill(&[(EXAMPLE, 400.0)], 0.0);
    let settings = on(&machine, 0.0);
    let long = program(from, to, "G0 X9 Y6 (past the clamp)\nX11 Y7\nY9\nX9 Y10\n");
    let (text, certificate) = after(&long, &settings);
    let (was, is) = lengths(&certificate);
    assert!(
        (was - 12.796_691).abs() < 5e-7 && (is - 8.472_136).abs() < 5e-7,
        "{was} {is}"
    );
    assert_eq!(text, program(from, to, "(past the clamp)\nG0 X4 Y6\nG0 Y10\n"));
}

/// The scenes of another program: each way proved, as short as it can be in thousandths of a millimetre.
#[test]
fn scenes_of_another_program() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../shared/data/reference/barrier_scenes.json"
    );
    let Ok(text) = std::fs::read_to_string(path) else {
        println!("skipped: {path} is absent");
        return;
    };
    let scenes: Vec<serde_json::Value> = serde_json::from_str(&text).expect("JSON");
    let pair = |value: &serde_json::Value| [0, 1].map(|i| value[i].as_f64().expect("a number"));
    let (mut changed, mut longest) = (0, 0.0_f64);
    for (index, scene) in scenes.iter().enumerate() {
        let rings: Vec<Vec<[f64; 2]>> = scene["barriers"]
            .as_array()
            .expect("barriers")
            .iter()
            .map(|ring| ring.as_array().expect("a ring").iter().map(pair).collect())
            .collect();
        let prisms: Vec<(&[[f64; 2]], f64)> = rings.iter().map(|ring| (ring.as_slice(), 400.0)).collect();
        let machine = mill(&prisms, 0.0);
        let (from, to) = (pair(&scene["origin"]), pair(&scene["destination"]));
        let expected = scene["length"].as_f64().expect("a length");
        let direct = trunnion::geometry::math::hypot(from[0] - to[0], from[1] - to[1]);
        let attempt = reroute(&program(from, to, ""), &on(&machine, 0.0), PostureCost::Travel);
        match attempt.outcome() {
            Ok(None) => assert!((direct - expected).abs() < 1e-6, "scene {index}: {direct} {expected}"),
            Ok(Some(proved)) => {
                changed += 1;
                let (_, is) = lengths(&proved.certificate);
                assert!(is > expected - 1e-6, "scene {index}: {is} {expected}");
                longest = longest.max(is - expected);
            }
            Err(why) => panic!("scene {index}: {why}"),
        }
    }
    // rounding to thousandths adds at most some of them at each corner
    assert!(changed > 20 && longest < 0.02, "{changed} {longest}");
}

/// A wall across the way is passed above where that is shorter, and the retract and the approach stay as they are.
#[test]
fn over_the_top() {
    let wall: &[[f64; 2]] = &[[40.0, -100.0], [60.0, -100.0], [60.0, 100.0], [40.0, 100.0]];
    let machine = mill(&[(wall, 35.0)], 1.0);
    let settings = on(&machine, 8.0);
    let (text, certificate) = after(
        "G0 X0 Y0 Z0\nG1 X5 F500\nG0 Z10\nG0 X90\nG0 Z0\nG1 X91\nM30\n",
        &settings,
    );
    assert_eq!(
        text,
        "G0 X0 Y0 Z0\nG1 X5 F500\nG0 Z10\nG0 Z36\nG0 X90\nG0 X90 Z10\nG0 Z0\nG1 X91\nM30\n"
    );
    // it rises beside the wall
    assert_eq!(certificate.rapids.expect("rapids").least_distance_mm, Some(26.0));
    // a low wall is passed above, a high one beside it
    let short: &[[f64; 2]] = &[[40.0, -20.0], [60.0, -20.0], [60.0, 20.0], [40.0, 20.0]];
    for (top, beside) in [(5.0, false), (60.0, true)] {
        let machine = mill(&[(short, top)], 1.0);
        let (text, _) = after("G0 X0 Y0 Z0\nG1 X5 F500\nG0 X90\nG1 X91\nM30\n", &on(&machine, 8.0));
        assert_eq!(text.contains("Y25") || text.contains("Y-25"), beside, "{text}");
    }
    // the slower axis decides the time: X and Y run at once, so the way beside a wall costs little
    let machine = mill(&[(short, 12.0)], 1.0);
    let text = "G0 X0 Y0 Z0\nG1 X5 F500\nG0 X90\nG1 X91\nM30\n";
    let (by_time, _) = certified(reroute(text, &on(&machine, 8.0), PostureCost::Time));
    let (by_length, _) = after(text, &on(&machine, 8.0));
    assert!(by_time.contains("Y25") || by_time.contains("Y-25"), "{by_time}");
    assert_ne!(by_time, by_length);
}

/// Axes that may arrive one after the other: every leg keeps everything between its ends clear.
#[test]
fn independent_axes() {
    let square: &[[f64; 2]] = &[[18.0, 0.0], [30.0, -12.0], [42.0, 0.0], [30.0, 12.0]];
    let text = "G0 X0 Y-3 Z0\nG1 X1 F500\nG0 X60 Y4\nG1 X61\nM30\n";
    for rapid in [RapidPath::Dogleg, RapidPath::Undeclared] {
        let mut machine = mill(&[(square, 400.0)], 1.0);
        machine.control.rapid = rapid;
        let settings = on(&machine, 8.0);
        let (text, certificate) = after(text, &settings);
        let (_, is) = lengths(&certificate);
        // the legs beside a slanting side run along the axes
        let synchronous = mill(&[(square, 400.0)], 1.0);
        let (_, shortest) = lengths(&after(&program([1.0, -3.0], [60.0, 4.0], ""), &on(&synchronous, 8.0)).1);
        assert!(is > shortest + 1.0 && is < 2.0 * shortest, "{is} {shortest}: {text}");
    }
}

/// What is not declared, or cannot be, is named.
#[test]
fn refusals_name_what_is_missing() {
    let machine = mill(&[(EXAMPLE, 400.0)], 0.5);
    let text = program([6.0, 5.0], [6.0, 11.0], "");
    let mut settings = on(&machine, 0.0);
    settings.setup.tools.clear();
    let why = refused(reroute(&text, &settings, PostureCost::Travel));
    assert!(why.contains("diameter of the tool is not declared"), "{why}");
    let mut settings = on(&machine, 0.0);
    settings.assume = Assume::default();
    let why = refused(reroute(&text, &settings, PostureCost::Travel));
    assert!(why.contains("work offset"), "{why}");
    let why = refused(reroute(
        &program([6.0, 5.8], [6.0, 11.0], ""),
        &on(&machine, 0.0),
        PostureCost::Travel,
    ));
    assert!(why.contains("inside the clearance of clamp 0"), "{why}");
    let bare = mill(&[], 1.0);
    let why = refused(reroute(&text, &on(&bare, 0.0), PostureCost::Travel));
    assert!(why.contains("no obstacle is declared"), "{why}");
    let incremental = program([6.0, 5.0], [6.0, 11.0], "").replace("G0 X6 Y11", "G91\nG0 Y6\nG90");
    let why = refused(reroute(&incremental, &on(&machine, 0.0), PostureCost::Travel));
    assert!(why.contains("incremental"), "{why}");
}

/// The kernel measures again: a point moved into the clearance, a lower way, another end, another clearance or obstacle are refused.
#[test]
fn proofs_that_were_tampered_with_are_refused() {
    let machine = mill(&[(EXAMPLE, 400.0)], 0.5);
    let settings = on(&machine, 0.0);
    let text = program([6.0, 5.0], [6.0, 11.0], "");
    let (fixed, certificate) = after(&text, &settings);
    assert!(fixed.contains("X3.5 Y5.5"), "{fixed}");
    let prove = |changed: &str| {
        let claim = &certificate.claim;
        certify(
            text.as_bytes(),
            changed.as_bytes(),
            settings.dialect,
            &machine,
            &settings.setup,
            claim,
        )
    };
    assert!(matches!(prove(&fixed), Outcome::Proved(_)));
    for (from, to) in [
        ("X3.5 Y5.5", "X3.501 Y5.5"),
        ("G0 X3.5 Y5.5\n", "G0 X3.5 Y5.5 Z-0.001\nG0 Z0\n"),
        ("X6 Y11", "X6 Y11.001"),
        ("G0 Y10.5\n", ""),
        ("G1 Z-1", "G1 Z-1.1"),
        ("F500", "F501"),
    ] {
        let changed = fixed.replace(from, to);
        assert_ne!(changed, fixed);
        assert!(!matches!(prove(&changed), Outcome::Proved(_)), "{from} -> {to}");
    }
    let check = |certificate: &Certificate, machine: &Machine| {
        recheck(
            certificate,
            text.as_bytes(),
            fixed.as_bytes(),
            settings.dialect,
            machine,
            &settings.setup,
        )
    };
    assert!(matches!(check(&certificate, &machine), Outcome::Proved(_)));
    let mut nearer = certificate.clone();
    nearer.rapids.as_mut().expect("rapids").length_after_mm -= 1e-6;
    assert!(!matches!(check(&nearer, &machine), Outcome::Proved(_)));
    let other = mill(&[(&EXAMPLE[..4], 400.0)], 0.5);
    assert!(!matches!(check(&certificate, &other), Outcome::Proved(_)));
}

/// The first positioning begins nowhere in particular; it stays as it is, and so does what follows the rerouted motion in the same run.
#[test]
fn a_positioning_from_an_unknown_place_beside_it_does_not_matter() {
    let machine = mill(
        &[(&[[40.0, -100.0], [60.0, -100.0], [60.0, 100.0], [40.0, 100.0]], 35.0)],
        1.0,
    );
    let settings = on(&machine, 8.0);
    let (text, certificate) = after("G0 X0 Y0 Z10\nG0 X90\nG0 Y5\nG1 X95 F500\nM30\n", &settings);
    assert!(text.starts_with("G0 X0 Y0 Z10\nG0 Z36\n"), "{text}");
    assert_eq!(certificate.rapids.expect("a proof about rapids").runs, 1);
    // and again after a cut
    let (text, certificate) = after("G0 X0 Y0 Z10\nG0 X90\nG1 X95 F500\nG0 X0\nM30\n", &settings);
    assert_eq!(certificate.rapids.expect("a proof about rapids").runs, 2, "{text}");
}
