//! `fit-arcs`, `drop-redundant` and `renumber`: counts of the pocket program, complaints about other arc fitters, dialects.
use super::strategy_2::{certified, run};
use std::path::Path;
use trunnion::certify::RefitSource;
use trunnion::check::Settings;
use trunnion::dialect::builtin;
use trunnion::geometry::math::sin_cos;
use trunnion::interp::Setup;
use trunnion::machine;
use trunnion::rewrite::{Attempt, Options};

fn settings(dialect: &str) -> Settings<'static> {
    Settings::new(
        builtin(dialect).expect("built in"),
        machine::builtin("mill-3axis"),
        Setup::default(),
    )
}

fn options(tolerance_mm: f64, source: RefitSource) -> Options {
    Options {
        tolerance_mm,
        source,
        ..Options::default()
    }
}

/// The text after `fit-arcs`, which must be proved and must not change again.
fn fitted(dialect: &str, text: &str, options: &Options) -> String {
    let settings = settings(dialect);
    let (after, _) = certified(run("fit-arcs", text, &settings, options));
    let again = run("fit-arcs", &after, &settings, options);
    assert!(again.proved.is_none(), "it changes again:\n{after}");
    after
}

/// Points of a circle about the origin, `step` deg apart, from 0 to `to` deg, as the words after G1.
fn circle(radius: f64, to: i32, step: i32, mut word: impl FnMut(f64, f64) -> String) -> String {
    let count = to / step;
    let at = |index: i32| sin_cos(f64::from(index * step).to_radians());
    (1..=count.abs())
        .map(|index| at(index * count.signum()))
        .map(|(sin, cos)| word(radius * cos, radius * sin) + "\n")
        .collect()
}

const HEAD: &str = "G21 G90 G94 G17 G54\nM3 S1000\nG0 X20. Y0. Z5.\nG1 Z0. F500\n";

fn count(text: &str, word: &str) -> usize {
    text.lines()
        .filter(|line| line.split(' ').any(|part| part == word))
        .count()
}

/// The interior path of the pocket of 1999, in inches: the fewest blocks as a separate exact search counts them, for its points and for its lines
/// within the tolerance both ways; at 0.0002 and 0.0005 in, arcs that meet beside the points are 1 and 2 fewer. One line goes down to the first point.
#[test]
#[expect(clippy::print_stdout, reason = "a test that is skipped says so")]
fn the_pocket_of_1999() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/pocket-1999/pocket.nc");
    let Ok(program) = std::fs::read_to_string(&path) else {
        return println!("skipped: {} is not there", path.display());
    };
    let wanted = |line: &&str| {
        let number = line
            .strip_prefix('N')
            .and_then(|rest| rest.split(|c: char| !c.is_ascii_digit()).next());
        number
            .and_then(|digits| digits.parse::<u32>().ok())
            .is_some_and(|number| (1..=253).contains(&number))
    };
    let lines: Vec<&str> = program.lines().filter(wanted).collect();
    // without a decimal point a parameter of the control decides what F means in inch
    let lines = lines.join("\n").replace("F3", "F3.").replace("F2", "F2.");
    let text = format!("G20 G90 G94 G17 G54\nM3 S1000\n{lines}\nM30\n");
    for (inches, points, chords) in [
        (0.0001, 91, 224),
        (0.0002, 85, 121),
        (0.0003, 82, 89),
        (0.0005, 79, 82),
        (0.001, 71, 72),
        (0.002, 68, 68),
    ] {
        for (source, most) in [(RefitSource::Points, points), (RefitSource::Chords, chords)] {
            let after = fitted("fanuc-30i", &text, &options(inches * 25.4, source));
            let blocks = after.lines().filter(|line| line.starts_with('N')).count();
            // N1, N2 and the line down
            assert_eq!(blocks - 3, most, "{inches} in, {source:?}");
        }
    }
}

/// A true circle has one direction, is one arc, and never has a centre without distance.
#[test]
fn complaints_about_other_fitters() {
    let mm = |x: f64, y: f64| format!("X{x:.3} Y{y:.3}");
    let chords = options(0.005, RefitSource::Chords);
    for (to, arcs) in [(90, 1), (180, 1), (330, 1), (360, 1)] {
        for (sign, code, other) in [(1, "G3", "G2"), (-1, "G2", "G3")] {
            let text = format!("{HEAD}{}G0 Z50.\nM30\n", circle(20.0, sign * to, 2, mm));
            let after = fitted("fanuc-30i", &text, &chords);
            assert_eq!(
                (count(&after, code), count(&after, other)),
                (arcs, 0),
                "{sign} {to}:\n{after}"
            );
            assert!(!after.contains("I0.000 J0.000"));
        }
    }
    // tighter than the sag of the lines: nothing is fitted
    let text = format!("{HEAD}{}M30\n", circle(20.0, 90, 2, mm));
    let tight = run(
        "fit-arcs",
        &text,
        &settings("fanuc-30i"),
        &options(0.001, RefitSource::Chords),
    );
    assert!(tight.proved.is_none());
    // a square is no circle, even where only points count
    let square = format!("{HEAD}X20. Y20.\nX0. Y20.\nX0. Y0.\nX20. Y0.\nM30\n");
    for source in [RefitSource::Points, RefitSource::Chords] {
        assert!(
            run("fit-arcs", &square, &settings("fanuc-30i"), &options(0.01, source))
                .proved
                .is_none()
        );
    }
}

/// A quarter turn down by 3 mm.
fn helix_points() -> String {
    let mut step = 0;
    circle(20.0, 90, 3, |x, y| {
        step += 1;
        format!("X{x:.3} Y{y:.3} Z{:.3}", -0.1 * f64::from(step))
    })
}

#[test]
fn each_dialect_and_plane() {
    let chords = options(0.01, RefitSource::Chords);
    for dialect in ["fanuc-30i", "haas-ngc", "sinumerik-840d", "linuxcnc"] {
        let end = if dialect == "linuxcnc" { "M2\n" } else { "M30\n" };
        let text = format!(
            "{HEAD}{}G1 X-5.\n{end}",
            circle(20.0, 90, 3, |x, y| format!("X{x:.3} Y{y:.3}"))
        );
        let after = fitted(dialect, &text, &chords);
        assert!(
            after.contains("\nG3 X0.000 Y20.000 I-20.000 J0.000\nG1 X-5.\n"),
            "{dialect}:\n{after}"
        );
        let helix = format!("{HEAD}{}{end}", helix_points());
        let after = fitted(dialect, &helix, &chords);
        assert!(after.contains("\nG3 X0.000 Y20.000 Z-3.000 I"), "{dialect}:\n{after}");
        let side = format!(
            "{HEAD}{}G1 X-5.\n{end}",
            circle(20.0, 90, 3, |x, z| format!("X{x:.3} Z{z:.3}"))
        );
        if dialect == "sinumerik-840d" {
            // another plane turns the tool's length
            assert!(run("fit-arcs", &side, &settings(dialect), &chords).proved.is_none());
        } else {
            let after = fitted(dialect, &side, &chords);
            assert!(
                after.contains("\nG18 G2 X0.000 Z20.000 I-20.000 K0.000\nG1 G17 X-5.\n"),
                "{dialect}:\n{after}"
            );
        }
    }
    let equals = format!(
        "{HEAD}{}M30\n",
        circle(20.0, 90, 3, |x, y| format!("X={x:.3} Y={y:.3}"))
    );
    let after = fitted("sinumerik-840d", &equals, &chords);
    assert!(after.contains("G3 X=0.000 Y=20.000 I=-20.000 J=0.000"), "{after}");
    let packed = format!(
        "{}{}M30\n",
        HEAD.replace("G1 ", "g01 "),
        circle(20.0, 90, 3, |x, y| format!("x{x:.3}y{y:.3}"))
    );
    let after = fitted("linuxcnc", &packed, &chords);
    assert!(after.contains("g03x0.000y20.000i-20.000j0.000"), "{after}");
}

/// A whole circle between lines to it and from it, in the words of each control; ends that are equal in text.
#[test]
fn a_whole_circle_is_one_arc() {
    let chords = options(0.01, RefitSource::Chords);
    for dialect in ["fanuc-30i", "haas-ngc", "sinumerik-840d", "linuxcnc"] {
        let end = if dialect == "linuxcnc" { "M2\n" } else { "M30\n" };
        for (sign, code) in [(1, "G3"), (-1, "G2")] {
            let text = format!(
                "{HEAD}X10.000 Y0.000\nX20.000 Y0.000\n{}X10.000 Y1.000\nG0 Z5.\n{end}",
                circle(20.0, sign * 360, 3, |x, y| format!("X{x:.3} Y{y:.3}")
                    .replace("-0.000", "0.000"))
            );
            let after = fitted(dialect, &text, &chords);
            assert!(
                after.contains(&format!(
                    "X20.000 Y0.000\n{code} X20.000 Y0.000 I-20.000 J0.000\nG1 X10.000 Y1.000\n"
                )),
                "{dialect}:\n{after}"
            );
        }
    }
    // the same numbers are no circle where the points are a polygon
    let hexagon = format!(
        "{HEAD}{}M30\n",
        circle(20.0, 360, 60, |x, y| format!("X{x:.3} Y{y:.3}"))
    );
    assert!(
        run("fit-arcs", &hexagon, &settings("fanuc-30i"), &chords)
            .proved
            .is_none()
    );
}

/// Ellipses in 200 lines: some arcs meet beside the points, and all are proved.
#[test]
fn arcs_may_meet_beside_the_points() {
    let mut beside = 0;
    for (long, short) in [(8.0, 2.0), (17.0, 8.0), (20.0, 2.0)] {
        let words: Vec<String> = (0..=200)
            .map(|index| {
                let (sin, cos) = sin_cos(core::f64::consts::PI * f64::from(index) / 100.0);
                format!("X{:.4} Y{:.4}", long * cos, short * sin)
            })
            .collect();
        let text = format!(
            "{}{}\nM30\n",
            HEAD.replace("X20. Y0.", &words[0]),
            words[1..].join("\n")
        );
        for tolerance_mm in [0.05, 0.02, 0.01, 0.005] {
            let after = fitted("fanuc-30i", &text, &options(tolerance_mm, RefitSource::Chords));
            let arcs = after.lines().filter(|line| line.contains(" I"));
            beside += arcs
                .filter(|line| !words.iter().any(|word| line.contains(word.as_str())))
                .count();
        }
    }
    assert!(beside > 3, "{beside} arcs end beside points");
}

/// What it does not do is said with the reason.
#[test]
fn what_is_left_alone_is_named() {
    let points = circle(20.0, 90, 3, |x, y| format!("X{x:.3} Y{y:.3}"));
    for (before, reason) in [
        ("G41 D1\n", "cutter radius compensation"),
        ("G61\n", "exact stop"),
        ("G91\n", "incremental"),
        ("G93\n", "inverse time"),
    ] {
        let points = if before == "G93\n" {
            points.replace('\n', " F60\n")
        } else {
            points.clone()
        };
        let text = format!("{HEAD}{before}{points}M30\n");
        let found = run(
            "fit-arcs",
            &text,
            &settings("linuxcnc"),
            &options(0.01, RefitSource::Chords),
        );
        let reasons = found.reasons().unwrap_or_default();
        assert!(
            found.proved.is_none() && reasons.contains(reason),
            "{before}: {reasons}"
        );
    }
    let looped = "O1\nG21 G90\nWHILE[#1LT3]DO1\nG1 X1. F100\n#1=#1+1\nEND1\nM30\n";
    let found = run(
        "fit-arcs",
        looped,
        &settings("fanuc-30i"),
        &options(0.01, RefitSource::Chords),
    );
    assert!(found.reasons().is_some_and(|why| why.contains("loops or calls")));
}

/// Comments, other words, blank lines and line ends stay.
#[test]
fn untouched_bytes_stay() {
    let points: Vec<String> = circle(20.0, 90, 3, |x, y| format!("X{x:.3} Y{y:.3}"))
        .lines()
        .map(String::from)
        .collect();
    let text = format!(
        "{HEAD}N10 {}\n\n{}\nN90 {} (half)\n{}\nM8\n{}\nM30\n",
        points[0],
        points[1..14].join("\n"),
        points[14],
        points[15..20].join("\n"),
        points[20..].join("\n")
    )
    .replace('\n', "\r\n");
    let after = fitted("fanuc-30i", &text, &options(0.01, RefitSource::Chords));
    assert!(
        after.contains("(half)\r\n") && after.contains("\r\nM8\r\n") && after.ends_with("M30\r\n"),
        "{after}"
    );
    assert_eq!(after.matches('\n').count(), after.matches("\r\n").count());
    assert!(after.starts_with(&HEAD.replace('\n', "\r\n")));
}

#[test]
fn redundant_points_words_and_blocks() {
    let settings = settings("fanuc-30i");
    let text = format!(
        "{HEAD}N10 G1 X1. Y0. Z0. F500\nN20 G1 X2. Y0. Z0. F500\nN30 G1 X2. Y0. Z0. F500\nN40 G1 X3. Y0.001 Z0. F500\nG1 X4. Y5. F600\nM30\n"
    );
    let exact = Options::default();
    let (after, _) = certified(run("drop-redundant", &text, &settings, &exact));
    assert!(
        after.ends_with("N20 X2.\nN40 X3. Y0.001\nG1 X4. Y5. F600\nM30\n") || after.contains("N40 X3. Y0.001"),
        "{after}"
    );
    assert!(!after.contains("N30"), "{after}");
    let again = run("drop-redundant", &after, &settings, &exact);
    assert!(again.proved.is_none(), "it changes again:\n{after}");
    let loose = Options {
        given_mm: Some(0.01),
        ..exact
    };
    let (after, _) = certified(run("drop-redundant", &text, &settings, &loose));
    assert!(after.contains("N10 X1.\nN20 X3. Y0.001\n"), "{after}");
}

#[test]
fn numbers_in_order_and_only_once() {
    let settings = settings("fanuc-30i");
    let text = "G21 G90\nN5 G0 X1. Y1. Z1. (N5 stays in comments)\nN5 X2.\nX3.\nN2 M30\n";
    let (after, _) = certified(run("renumber", text, &settings, &Options::default()));
    assert_eq!(
        after,
        "G21 G90\nN10 G0 X1. Y1. Z1. (N5 stays in comments)\nN20 X2.\nX3.\nN30 M30\n"
    );
    assert!(run("renumber", &after, &settings, &Options::default()).proved.is_none());
    // calls and jumps follow
    let text = "O1\nN5 G21 G90 G94 G17 G54\nN7 G0 X0 Y0 Z5. S1000 M3\nG65 P2 A7.\nN9 #1=#1+1\nIF[#1LT3]GOTO9\nN11 M30\nO2\nN5 G1 X#1 F100.\nN7 M99\n";
    let (after, _) = certified(run("renumber", text, &settings, &Options::default()));
    assert!(after.contains("N30 #1=#1+1\nIF[#1LT3]GOTO30"), "{after}");
    let bare = run("renumber", "G21 G90\nG0 X1.\nM30\n", &settings, &Options::default());
    assert!(matches!(bare, Attempt { proved: None, .. }));
}
