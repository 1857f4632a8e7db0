//! Rotary axes unwound, and the example in each rewrite's header.

use super::strategy_2::{certified, refused, run, settings, sinumerik};
use trunnion::check::{Assume, Settings};
use trunnion::geometry::plane::{Point, Polygon};
use trunnion::interp::Setup;
use trunnion::machine::{Footprint, Machine, Obstacle};
use trunnion::rewrite::{Attempt, Options, rewrites};

fn near(value: f64, wanted: f64, within: f64) -> bool {
    (value - wanted).abs() <= within
}

fn unwind(text: &str) -> Attempt {
    run(
        "unwind-rotary",
        text,
        &settings("sinumerik-840d", Setup::default()),
        &Options::default(),
    )
}

#[test]
fn a_rotary_jump_is_unwound() {
    let text = sinumerik(
        "G1 X0 Y0 Z50 A10 C350.000\nX1 A10.5 C358.5\nX2 A11 C6.25\nX3 ; comment\nX4 A11.5 C-346.000\nX5 C340\n",
    );
    let (after, certificate) = certified(unwind(&text));
    let expected = text.replace("C6.25", "C366.25").replace("C-346.000", "C374.000");
    assert_eq!(after, expected);
    assert!(near(certificate.rotary[0].step_before_deg, 686.0, 1e-6));
    assert!(near(certificate.rotary[0].step_after_deg, 34.0, 1e-6));
    assert!(
        certificate
            .changes
            .iter()
            .all(|change| near(change.rotary_change_deg[0] % 360.0, 0.0, 1e-9))
    );
    assert!(certificate.worst.axis_change_deg.value < 1e-9);
    assert!(matches!(unwind(&after).outcome(), Ok(None)));
}

#[test]
fn unwinding_refuses_what_is_not_literal() {
    for (rows, why) in [
        ("G1 X0 Y0 Z50 A10 C350\nX2 C=DC(5)\nX3 C4\n", "plain number"),
        ("G1 X0 Y0 Z50 A10 C350\nX2 C5\nG91 X1 C1\nG90\n", "G91"),
    ] {
        let reason = refused(unwind(&sinumerik(rows)));
        assert!(reason.contains(why), "{reason}");
    }
}

#[test]
fn every_rewrites_example_holds() {
    for rewrite in rewrites() {
        let fences = fences(rewrite.docs);
        let [(info, before), (target, after)] = fences.as_slice() else {
            panic!("{}: one before and one after fence expected", rewrite.name);
        };
        let known = |word: &&str| trunnion::dialect::BUILTIN_NAMES.contains(word);
        let dialect = info.split_whitespace().find(known).expect("a dialect");
        let mut settings = settings(dialect, Setup::default());
        settings.assume = Assume::ALL;
        if info.ends_with(" mill-3axis") {
            settings.machine = trunnion::machine::builtin("mill-3axis");
        }
        let walled = walled_mill();
        if info.ends_with(" mill-3axis+wall") {
            settings.machine = Some(&walled);
        }
        let with_part = super::retracting::with_part();
        if info.ends_with(" mikron-ucp710+part") {
            settings.machine = Some(&with_part);
        }
        let is = match target.strip_prefix("gcode after --to ") {
            Some(target) => retargeted(before, target, &settings),
            None => certified(run(rewrite.name, before, &settings, &Options::default())).0,
        };
        assert_eq!(&is, after, "{}", rewrite.name);
        for heading in ["# Why", "# Example", "# Claim", "# Traps", "# Sources"] {
            assert!(
                rewrite.docs.contains(&format!("\n{heading}\n")),
                "{}: {heading} is missing",
                rewrite.name
            );
        }
    }
}

/// A program written for another control by the converter.
fn retargeted(before: &str, target: &str, settings: &Settings<'_>) -> String {
    let source = trunnion::convert::Source {
        text: before.as_bytes(),
        dialect: settings.dialect,
        machine: settings.machine,
        setup: &settings.setup,
        assume: trunnion::certify::conversion::Assume::default(),
    };
    let target = trunnion::convert::Target::Code {
        post: trunnion::convert::builtin_post(target).expect("a post"),
        machine: settings.machine,
    };
    trunnion::convert::convert(&source, &target, &trunnion::convert::Options::default())
        .expect("converted")
        .text
}

/// The mill of the example of reroute-rapid, with its wall.
fn walled_mill() -> Machine {
    let mut machine = trunnion::machine::builtin("mill-3axis").expect("built in").clone();
    let corners = [[40.0, -100.0], [60.0, -100.0], [60.0, 100.0], [40.0, 100.0]].map(Point::from);
    machine.obstacles.0.push(Obstacle {
        name: "wall".to_owned(),
        axis: None,
        footprint: Footprint::Polygon(Polygon::new(&corners).expect("a polygon")),
        bottom: -20.0,
        top: 35.0,
        kind: trunnion::machine::ObstacleKind::Body,
    });
    machine
}

/// Fences of a header: info string and text.
fn fences(docs: &str) -> Vec<(String, String)> {
    let mut fences: Vec<(String, String)> = Vec::new();
    let mut inside = false;
    for line in docs.lines() {
        match line.strip_prefix("```") {
            Some(info) if !inside => {
                inside = true;
                fences.push((info.to_owned(), String::new()));
            }
            Some(_) => inside = false,
            None if inside => {
                let (_, text) = fences.last_mut().expect("a fence is open");
                text.push_str(line);
                text.push('\n');
            }
            None => {}
        }
    }
    fences
}
