//! `fit-splines`: random smooth curves judged by dense samples of both paths, corners and digits.
mod kept;

use super::strategy_2::{certified, run};
use proptest::prelude::*;
use std::fmt::Write;
use trunnion::certify::{Certificate, RefitSource};
use trunnion::check::{Assume, Settings};
use trunnion::dialect::builtin;
use trunnion::geometry::Vec3;
use trunnion::geometry::math::{cos, sin};
use trunnion::interp::Setup;
use trunnion::machine;
use trunnion::rewrite::Options;

fn settings(dialect: &str) -> Settings<'static> {
    Settings {
        assume: Assume::ALL,
        ..Settings::new(
            builtin(dialect).expect("built in"),
            machine::builtin("mill-3axis"),
            Setup::default(),
        )
    }
}

fn options(tolerance_mm: f64, source: RefitSource) -> Options {
    Options {
        tolerance_mm,
        source,
        ..Options::default()
    }
}

/// A program of lines through points, with so many digits.
fn lines(head: &str, points: &[Vec3], digits: usize) -> String {
    let mut text = format!(
        "{head}\nS8000 M3\nG0 X{0:.3$} Y{1:.3$} Z{2:.3$}\nG1 F800\n",
        points[0].x, points[0].y, points[0].z, digits
    );
    for point in &points[1..] {
        writeln!(
            text,
            "G1 X{:.digits$} Y{:.digits$} Z{:.digits$}",
            point.x, point.y, point.z
        )
        .expect("a string");
    }
    text + "G0 Z50\nM30\n"
}

const METRIC: &str = "G17 G90 G94 G71 G54";

/// A curve is so many points of a path.
const SAMPLES: u32 = 1000;

/// The path of a program of G0, G1, POLY and G5, as this test reads them.
fn path(text: &str) -> Vec<Vec3> {
    let (mut at, mut all) = (Vec3::zeros(), Vec::new());
    for line in text.lines().filter(|line| !line.starts_with("G0 Z50")) {
        let (mut end, mut factors) = (at, [[0.0; 2]; 3]);
        let mut names = false;
        let handles = ["I", "J", "P", "Q"].map(|letter| {
            let number = line
                .split(' ')
                .find_map(|word| word.strip_prefix(letter)?.parse::<f64>().ok());
            number.filter(|_| line.contains("G5 ")).unwrap_or(0.0)
        });
        for word in line.split(' ') {
            let named = word.strip_prefix("PO[").map(|rest| {
                (
                    rest.as_bytes()[0],
                    rest[3..].trim_start_matches('(').trim_end_matches(')'),
                )
            });
            let (letter, numbers) = match named {
                Some((letter, numbers)) => (letter, numbers),
                None if word.starts_with(['X', 'Y', 'Z']) => (word.as_bytes()[0], &word[1..]),
                None => continue,
            };
            let axis = usize::from(letter - b'X');
            let numbers: Vec<f64> = numbers
                .split(',')
                .map(|number| number.parse().expect("a number"))
                .collect();
            end[axis] = numbers[0];
            factors[axis] = [
                numbers.get(1).copied().unwrap_or(0.0),
                numbers.get(2).copied().unwrap_or(0.0),
            ];
            names = true;
        }
        if !names {
            continue;
        }
        let steps = if line.contains("POLY") || line.contains("G5 ") {
            SAMPLES
        } else {
            1
        };
        for step in 1..=steps {
            let p = f64::from(step) / f64::from(steps);
            let value = |axis: usize| {
                if line.contains("G5 ") && axis < 2 {
                    // Bezier's definition
                    let (b, c) = (at[axis] + handles[axis], end[axis] + handles[2 + axis]);
                    let s = 1.0 - p;
                    return s * s * s * at[axis] + 3.0 * s * s * p * b + 3.0 * s * p * p * c + p * p * p * end[axis];
                }
                let [a2, a3] = factors[axis];
                let a1 = end[axis] - at[axis] - a2 - a3;
                at[axis] + p * (a1 + p * (a2 + p * a3))
            };
            all.push(if step == steps {
                end
            } else {
                Vec3::new(value(0), value(1), value(2))
            });
        }
        at = end;
    }
    all
}

/// The largest distance of a path's points, and of points between them, from another path.
fn farthest(from: &[Vec3], to: &[Vec3]) -> f64 {
    let nearest = |at: &Vec3| {
        let off = to.windows(2).map(|pair| {
            let way = pair[1] - pair[0];
            let square = way.norm_squared();
            let share = if square > 0.0 {
                ((at - pair[0]).dot(&way) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (at - pair[0] - way * share).norm()
        });
        off.fold(f64::INFINITY, f64::min)
    };
    let between = |pair: &[Vec3]| {
        (0..4)
            .map(|step| nearest(&(pair[0] + (pair[1] - pair[0]) * (f64::from(step) / 4.0))))
            .fold(0.0, f64::max)
    };
    from.windows(2).map(between).fold(0.0, f64::max)
}

/// The text after `fit-splines`, proved, and the same when it is asked for again.
fn fitted(text: &str, settings: &Settings<'_>, options: &Options) -> (String, Certificate) {
    let (after, certificate) = certified(run("fit-splines", text, settings, options));
    let again = run("fit-splines", &after, settings, options);
    assert!(again.proved.is_none(), "it changes again:\n{after}");
    (after, certificate)
}

fn curves(text: &str) -> usize {
    text.lines()
        .filter(|line| line.contains("POLY") || line.contains("G5 "))
        .count()
}

/// A smooth curve in space.
fn curve(waves: &[(f64, f64, f64)], count: u32) -> Vec<Vec3> {
    let at = |t: f64, axis: usize| {
        let own = waves.iter().skip(axis).step_by(3);
        own.map(|(size, turns, phase)| size * sin(turns * t + phase))
            .sum::<f64>()
    };
    (0..=count)
        .map(|step| {
            let t = f64::from(step) / f64::from(count);
            Vec3::new(60.0 * t + at(t, 0), at(t, 1), at(t, 2))
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    /// No point of either path is farther from the other than the tolerance, whatever the curve, the digits and the tolerance; the curves meet
    /// with one tangent, and far fewer blocks are left.
    #[test]
    fn random_curves_keep_the_tolerance(
        waves in prop::collection::vec((0.3..5.0f64, 0.5..9.0f64, 0.0..6.0f64), 6),
        count in 300..600u32,
        digits in 3..5usize,
        tolerance in 0.006..0.05f64,
        points_only in any::<bool>(),
    ) {
        let settings = settings("sinumerik-840d");
        let source = if points_only { RefitSource::Points } else { RefitSource::Chords };
        let points = curve(&waves, count);
        let text = lines(METRIC, &points, digits);
        let (after, certificate) = fitted(&text, &settings, &options(tolerance, source));
        let (was, is) = (path(&text), path(&after));
        if points_only {
            let off = was.iter().map(|point| farthest(&[*point, *point], &is)).fold(0.0, f64::max);
            prop_assert!(off <= tolerance + 2e-5, "{off}");
        } else {
            let off = farthest(&was, &is).max(farthest(&is, &was));
            prop_assert!(off <= certificate.worst.path_bound_mm.value + 2e-5, "{off}");
            prop_assert!(certificate.worst.path_bound_mm.value <= tolerance);
        }
        prop_assert!(after.lines().count() * 2 < text.lines().count(), "{}", after.lines().count());
        prop_assert!(curves(&after) > 0);
        // tangents: where two curves meet, the path turns no more than beside that point
        let rows: Vec<&str> = after.lines().collect();
        for pair in rows.windows(2).filter(|pair| pair.iter().all(|row| row.contains("POLY"))) {
            let before = rows.iter().position(|row| std::ptr::eq(*row, pair[0])).expect("a row");
            let start = path(&rows[..before].join("\n"));
            let both = path(&rows[..before + 2].join("\n"));
            let joint = start.len() + SAMPLES as usize - 1;
            let turn = |at: usize| {
                let directions = [both[at] - both[at - 1], both[at + 1] - both[at]].map(|way| way.normalize());
                directions[0].cross(&directions[1]).norm()
            };
            let beside = turn(joint - 1).max(turn(joint + 1));
            prop_assert!(turn(joint) < 1.5 * beside + 0.005, "{} {beside} at {}", turn(joint), pair[0]);
        }
    }
}

/// A wavy triangle: its corners stay where they are, and no curve passes them.
#[test]
fn corners_are_kept() {
    let corners = [
        Vec3::zeros(),
        Vec3::new(40.0, 0.0, 0.0),
        Vec3::new(10.0, 30.0, 0.0),
        Vec3::zeros(),
    ];
    let mut points = vec![corners[0]];
    for pair in corners.windows(2) {
        let way = pair[1] - pair[0];
        let side = Vec3::new(-way.y, way.x, 0.0).normalize();
        points.extend((1..=60).map(|step| {
            let t = f64::from(step) / 60.0;
            pair[0] + way * t + side * (0.8 * sin(core::f64::consts::PI * t) * cos(3.0 * t))
        }));
    }
    let text = lines(METRIC, &points, 3);
    let (after, _) = fitted(&text, &settings("sinumerik-840d"), &options(0.01, RefitSource::Chords));
    let ends = path(
        &after
            .lines()
            .map(|line| line.replace("POLY ", ""))
            .collect::<Vec<_>>()
            .join("\n"),
    );
    for corner in &corners[1..] {
        assert!(
            ends.iter().any(|end| (end - corner).norm() < 1e-9),
            "{corner}:\n{after}"
        );
    }
    assert!((3..20).contains(&curves(&after)), "{after}");
}

/// A curve that is a cubic is one block with its own numbers; in inches too.
#[test]
fn a_cubic_is_found_again_and_numbers_have_one_digit_more() {
    let cubic: Vec<Vec3> = (0..=80)
        .map(|step| {
            let p = f64::from(step) / 80.0;
            Vec3::new(20.0 * p, 12.0 * p * p - 8.0 * p * p * p, 0.0)
        })
        .collect();
    let text = lines(METRIC, &cubic, 4);
    let (after, _) = fitted(&text, &settings("sinumerik-840d"), &options(0.01, RefitSource::Chords));
    assert_eq!((curves(&after), after.lines().count()), (1, 7), "{after}");
    let digits = |text: &str| {
        let fraction = |number: &str| number.split_once('.').map_or(0, |(_, fraction)| fraction.len());
        let numbers = text
            .split(['(', ',', ')', ' ', '\n', '='])
            .filter(|part| part.parse::<f64>().is_ok());
        numbers.map(fraction).max()
    };
    assert!(digits(&after).is_some_and(|most| most <= 5), "{after}");
    let inches: Vec<Vec3> = cubic.iter().map(|point| point / 25.4).collect();
    let text = lines("G17 G90 G94 G70 G54", &inches, 4);
    let (after, certificate) = fitted(&text, &settings("sinumerik-840d"), &options(0.02, RefitSource::Chords));
    let off = farthest(&path(&text), &path(&after)) * 25.4;
    assert!(
        off <= certificate.worst.path_bound_mm.value + 2e-5 && curves(&after) == 1,
        "{off}\n{after}"
    );
}
