//! `fit-splines`: what stays, what is refused, G5, and damaged proofs.
use super::super::strategy_2::{certified, run};
use super::{METRIC, curve, curves, farthest, fitted, lines, options, path, settings};
use std::fmt::Write;
use trunnion::certify::{Certificate, Claim, Outcome, RefitSource, certify, recheck};
use trunnion::check::{Severity, Verdict, check};
use trunnion::geometry::Vec3;
use trunnion::geometry::math::sin_cos;
use trunnion::rewrite::rewrites;
use trunnion::syntax::parse;

/// The program's own words around the lines stay: numbers, comments, feeds, names of axes with `=`, and what follows begins with G1.
#[test]
fn what_is_beside_the_lines_stays() {
    let settings = settings("sinumerik-840d");
    let wave = |from: u32, to: u32| -> String {
        (from..=to).fold(String::new(), |mut text, step| {
            let (sin, _) = sin_cos(f64::from(step) / 12.0);
            writeln!(text, "N{}X={:.3}Y={:.3}", step + 10, f64::from(step) * 0.4, 5.0 * sin).expect("a string");
            text
        })
    };
    let text = format!(
        "{METRIC}\nS8000 M3\nG0 X0 Y0 Z0\nG1 F800\n{}N100 X=19 Y=-3 ; a comment\n{}N200 X=60 Y=1\nN210 G0 Z50\nM30\n",
        wave(1, 40),
        wave(41, 70)
    );
    let (after, _) = fitted(&text, &settings, &options(0.01, RefitSource::Chords));
    assert!(after.contains("N11 POLY PO[X]=("), "{after}");
    assert!(after.contains("X=19 Y=-3 ; a comment"), "{after}");
    assert!(
        after.contains("G1 X=60 Y=1") && after.contains("N210 G0 Z50"),
        "{after}"
    );
    assert!(curves(&after) >= 2);
    // feeds that change end a chain
    let fast = text.replace("N60X=", "N60 F900 X=");
    let (after, _) = fitted(&fast, &settings, &options(0.01, RefitSource::Chords));
    assert!(after.contains("F900"), "{after}");
}

fn wavy(head: &str) -> String {
    lines(
        head,
        &curve(&[(2.0, 5.0, 0.0), (3.0, 4.0, 1.0), (0.0, 1.0, 0.0)], 200),
        3,
    )
}

#[test]
fn where_it_cannot_be_said_it_is_refused_by_name() {
    let tolerance = options(0.01, RefitSource::Chords);
    for (dialect, why) in [
        ("linuxcnc", "[control] spline_arcs"),
        ("fanuc-30i", "fit-arcs"),
        ("haas-ngc", "fit-arcs"),
        ("iso-6983", "fit-arcs"),
        ("okuma-osp", "fit-arcs"),
        ("apt", "fit-arcs"),
    ] {
        let settings = settings(dialect);
        let reason = run("fit-splines", &wavy("G17 G90"), &settings, &tolerance)
            .outcome()
            .expect_err(dialect);
        assert!(
            reason.contains(why) && reason.contains(&settings.dialect.title),
            "{dialect}: {reason}"
        );
    }
    let klartext = settings("heidenhain-klartext");
    let reason = run("fit-splines", &wavy("G17 G90"), &klartext, &tolerance).outcome();
    let reason = reason.expect_err("no words of G code");
    assert!(reason.contains("Klartext"), "{reason}");
    let settings = settings("sinumerik-840d");
    for (head, why) in [
        ("G41 D1", "cutter radius compensation"),
        ("G60", "exact stop"),
        ("G91", "incremental"),
        ("TRAORI", "tool centre point control"),
        ("ROT RPL=30", "frame"),
    ] {
        let text = wavy(METRIC).replace("G1 F800\n", &format!("{head}\nG1 F800\n"));
        match run("fit-splines", &text, &settings, &tolerance).outcome() {
            Err(reason) => assert!(reason.contains(why), "{head}: {reason}"),
            Ok(found) => panic!("{head}: {found:?}"),
        }
    }
    // nothing to do where no curve serves
    let rough: Vec<Vec3> = (0..100)
        .map(|step| Vec3::new(f64::from(step), f64::from(step % 2), 0.0))
        .collect();
    let found = run("fit-splines", &lines(METRIC, &rough, 3), &settings, &tolerance).outcome();
    assert!(matches!(found, Ok(None)), "{found:?}");
}

/// Where it is declared how far LinuxCNC's own arcs are from the curve, it gets G5 in the plane of X and Y, and that much less tolerance.
#[test]
fn linuxcnc_gets_g5_where_its_arcs_are_declared() {
    let mut settings = settings("linuxcnc");
    settings.setup.control.spline_arcs_mm = Some(0.002);
    let mut points = curve(&[(2.0, 5.0, 0.0), (3.0, 4.0, 1.0)], 200);
    for point in &mut points {
        point.z = 0.0;
    }
    let head = "G21 G17 G90 G94 G54 G40 G80 G64";
    let text = lines(head, &points, 4).replace("M30", "M2");
    let (after, certificate) = fitted(&text, &settings, &options(0.01, RefitSource::Chords));
    assert!((3..30).contains(&curves(&after)), "{after}");
    let off = farthest(&path(&text), &path(&after)).max(farthest(&path(&after), &path(&text)));
    let bound = certificate.worst.path_bound_mm.value;
    assert!(off + 0.002 <= bound + 2e-5 && bound <= 0.01, "{off} {bound}");
    let verdict =
        |text: &str| check(&parse(text.as_bytes().to_vec(), settings.dialect.lex), &settings).verdict(Severity::Error);
    assert_eq!(
        (verdict(&text), verdict(&after)),
        (Verdict::Pass, Verdict::Pass),
        "{after}"
    );
    asked_of_the_control(&after);
    // other controls get no lines for a curve
    let source = trunnion::convert::Source {
        text: after.as_bytes(),
        dialect: settings.dialect,
        machine: settings.machine,
        setup: &settings.setup,
        assume: trunnion::certify::conversion::Assume::default(),
    };
    let target = trunnion::convert::Target::Code {
        post: trunnion::convert::builtin_post("fanuc-30i").expect("a post"),
        machine: settings.machine,
    };
    assert!(trunnion::convert::convert(&source, &target, &trunnion::convert::Options::default()).is_err());
    // it cannot be nearer than its arcs, and Z does not move in G5
    assert!(
        run("fit-splines", &text, &settings, &options(0.002, RefitSource::Chords))
            .proved
            .is_none()
    );
    let climbs = lines(
        head,
        &curve(&[(2.0, 5.0, 0.0), (3.0, 4.0, 1.0), (1.0, 4.0, 1.0)], 200),
        4,
    )
    .replace("M30", "M2");
    assert!(
        run("fit-splines", &climbs, &settings, &options(0.01, RefitSource::Chords))
            .proved
            .is_none()
    );
}

/// LinuxCNC's own interpreter accepts the program and sees as many curves.
#[expect(clippy::print_stdout, reason = "a test that is skipped says so")]
fn asked_of_the_control(text: &str) {
    let folder = tempfile::TempDir::new().expect("a folder");
    let file = folder.path().join("part.ngc");
    std::fs::write(&file, text).expect("a file");
    // rs274 keeps parameters in the folder that it runs in
    let asked = std::process::Command::new("rs274")
        .arg("-g")
        .arg(&file)
        .current_dir(folder.path())
        .env("HOME", folder.path())
        .output();
    let Ok(answer) = asked else {
        return println!("skipped: rs274 is not installed (Debian: linuxcnc-uspace)");
    };
    let calls = String::from_utf8_lossy(&answer.stdout);
    let count = |call: &str| calls.lines().filter(|line| line.contains(call)).count();
    assert_eq!(count("NURBS_FEED(4"), curves(text), "{calls}");
    assert_eq!(count("PROGRAM_END"), 1, "{calls}");
}

/// The verdict on the program stays, and a limit nearer than the lines are to the curve is unknown.
#[test]
fn the_verdict_is_no_worse() {
    let settings = settings("sinumerik-840d");
    let (after, _) = fitted(&wavy(METRIC), &settings, &options(0.01, RefitSource::Chords));
    let verdict =
        |text: &str| check(&parse(text.as_bytes().to_vec(), settings.dialect.lex), &settings).verdict(Severity::Error);
    assert_eq!(
        (verdict(&wavy(METRIC)), verdict(&after)),
        (Verdict::Pass, Verdict::Pass),
        "{after}"
    );
}

/// A certificate for another tolerance, program or source, and a curve that was changed by hand, are refused.
#[test]
fn damaged_proofs_are_refused() {
    let settings = settings("sinumerik-840d");
    let text = wavy(METRIC);
    let (after, certificate) = fitted(&text, &settings, &options(0.01, RefitSource::Chords));
    let machine = settings.machine.expect("a machine");
    let again = |certificate: &Certificate, before: &str, after: &str| {
        recheck(
            certificate,
            before.as_bytes(),
            after.as_bytes(),
            settings.dialect,
            machine,
            &settings.setup,
        )
    };
    let stored = Certificate::from_json(&certificate.to_json()).expect("JSON");
    assert!(matches!(again(&stored, &text, &after), Outcome::Proved(_)));
    let mut forged = certificate.clone();
    forged.claim = Claim::RefittedPath {
        tolerance_mm: 0.5 * certificate.worst.path_bound_mm.value,
        source: RefitSource::Chords,
    };
    assert!(!matches!(again(&forged, &text, &after), Outcome::Proved(_)));
    let mut better = certificate.clone();
    better.worst.path_bound_mm.value *= 0.9;
    assert!(!matches!(again(&better, &text, &after), Outcome::Proved(_)));
    // one more digit in front of a factor bends the curve
    let claim = &certificate.claim;
    let bent = |from: &str, to: &str| {
        let bent = after.replacen(from, to, 1);
        assert_ne!(bent, after, "{from}");
        certify(
            text.as_bytes(),
            bent.as_bytes(),
            settings.dialect,
            machine,
            &settings.setup,
            claim,
        )
    };
    for (from, to) in [
        (",", ",1"),
        ("POLY ", "POLY PL=2 "),
        ("POLY ", "G1 "),
        ("POLY ", "POLY F700 "),
        ("POLY ", "M8\nPOLY "),
    ] {
        assert!(!matches!(bent(from, to), Outcome::Proved(_)), "{from} {to}");
    }
    assert!(matches!(bent("G1 F800", "G1 F800.0"), Outcome::Proved(_)));
}

/// Arcs first: what is a circle becomes an arc, and curves take the rest.
#[test]
fn arcs_come_before_curves() {
    let place = |name: &str| rewrites().iter().position(|rewrite| rewrite.name == name);
    assert!(place("fit-arcs") < place("fit-splines") && place("fit-splines") < place("drop-redundant"));
    let mut points: Vec<Vec3> = (0..=60)
        .map(|step| {
            let (sin, cos) = sin_cos(f64::from(step).to_radians() * 3.0);
            Vec3::new(20.0 * cos, 20.0 * sin, 0.0)
        })
        .collect();
    // a curve whose bend grows evenly
    let mut at = points[60];
    points.extend((1..=80).map(|step| {
        let t = f64::from(step) / 80.0;
        let (sin, cos) = sin_cos(-core::f64::consts::FRAC_PI_2 + 3.0 * t * t * t);
        at += Vec3::new(cos, sin, 0.0) * 0.6;
        at
    }));
    let (settings, tolerance) = (settings("sinumerik-840d"), options(0.02, RefitSource::Chords));
    let text = lines(METRIC, &points, 3);
    let (arcs, _) = certified(run("fit-arcs", &text, &settings, &tolerance));
    assert!(arcs.contains("G3 "), "{arcs}");
    let both = run("fit-splines", &arcs, &settings, &tolerance);
    let after = both
        .proved
        .map_or(arcs.clone(), |proved| String::from_utf8(proved.after).expect("UTF-8"));
    assert!(
        after.contains("G3 ") && after.lines().count() <= arcs.lines().count(),
        "{after}"
    );
    let (alone, _) = fitted(&text, &settings, &tolerance);
    assert!(!alone.contains("G3 ") && (3..20).contains(&curves(&alone)), "{alone}");
}
