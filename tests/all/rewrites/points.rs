//! `insert-points`: the deviation of each piece is sampled here with forward kinematics alone; and what its claim must refuse.
use super::strategy_2::{certified, refused, run, settings};
use crate::random::Random;
use std::fmt::Write;
use trunnion::certify::{Claim, Outcome, certify};
use trunnion::check::{Assume, Settings};
use trunnion::geometry::{Vec3, rad};
use trunnion::interp::{Setup, WorkOffset};
use trunnion::machine::{self, Joints, Machine, forward};
use trunnion::rewrite::{Attempt, Options};

fn on(name: &str) -> Settings<'static> {
    let mut settings = settings("fanuc-30i", Setup::default());
    settings.machine = machine::builtin(name);
    settings.assume = Assume::ALL;
    settings
}

fn insert(text: &str, settings: &Settings<'_>, path_mm: f64) -> Attempt {
    let options = Options {
        given_mm: Some(path_mm),
        ..Options::default()
    };
    run("insert-points", text, settings, &options)
}

const HEAD: &str = "G21 G90 G94 G17 G54\nG0 X0.000 Y0.000 Z100.000 A0.000 C0.000\nS8000 M3\n";

/// Joints at the end of each line with axis words, those of the line before where a word is missing.
fn joints(machine: &Machine, text: &str) -> Vec<Joints> {
    let mut all: Vec<Joints> = Vec::new();
    for line in text.lines() {
        let mut joints = all.last().copied().unwrap_or_default();
        let mut moves = false;
        for word in line.split(' ') {
            let (letter, number) = word.split_at(1);
            let Some(joint) = machine.joint(letter.as_bytes()[0]) else {
                continue;
            };
            let Ok(value) = number.parse::<f64>() else { continue };
            moves = true;
            joints[joint] = if machine.rotary.contains(&joint) {
                rad(value)
            } else {
                value
            };
        }
        if moves {
            all.push(joints);
        }
    }
    all
}

/// Part of the way from one pose to another.
fn between(from: &Joints, to: &Joints, share: f64) -> Joints {
    let mut at = *from;
    for (value, to) in at.iter_mut().zip(to) {
        *value += share * (to - *value);
    }
    at
}

/// Distance of a point from a segment.
fn off((a, b): (Vec3, Vec3), point: Vec3) -> f64 {
    let whole = b - a;
    let share = (whole.dot(&(point - a)) / whole.norm_squared()).clamp(0.0, 1.0);
    (point - (a + whole * share)).norm()
}

#[test]
fn random_lines_stay_near_their_segments_with_few_points() {
    let settings = on("mikron-ucp710");
    let machine = settings.machine.expect("built in");
    let mut random = Random(20);
    for _ in 0..40 {
        let mut number = |size: f64| (random.below(20_001) as f64 / 10_000.0 - 1.0) * size;
        let mut text = HEAD.to_owned();
        let (x, y, z) = (30.0 + number(20.0), number(50.0), 100.0 + number(20.0));
        let (a, c) = (10.0 + number(9.0), number(60.0));
        writeln!(text, "N10 G1 X{x:.3} Y{y:.3} Z{z:.3} A{a:.3} C{c:.3} F1000\nM30").expect("a String takes all");
        let ends = joints(machine, &text);
        let tip = |joints: &Joints| forward(machine, joints, 0.0).tip;
        let segment = (tip(&ends[0]), tip(&ends[1]));
        let worst = |poses: &[Joints]| {
            let steps = (0..=20).map(|step| f64::from(step) / 20.0);
            let pairs = poses.windows(2);
            let each = pairs.flat_map(|pair| steps.clone().map(|share| between(&pair[0], &pair[1], share)));
            each.map(|at| off(segment, tip(&at))).fold(0.0, f64::max)
        };
        let whole = worst(&ends);
        let mut before = usize::MAX;
        for tolerance in [0.02, 0.1, 0.5] {
            if whole < 0.9 * tolerance {
                continue;
            }
            let attempt = insert(&text, &settings, tolerance);
            let (after, certificate) = certified(attempt);
            let poses = joints(machine, &after);
            let found = worst(&poses);
            assert!(found <= tolerance, "{found} {tolerance}\n{after}");
            let bound = certificate.worst.path_bound_mm.value;
            assert!(found <= bound + 1e-9 && bound <= tolerance, "{found} {bound}");
            // a piece deviates by about the square of its share of the whole
            let few = (whole / tolerance).sqrt() * 1.5 + 3.0;
            assert!((poses.len() as f64) <= few, "{} points, {few}\n{after}", poses.len());
            assert!(poses.len() <= before, "fewer points for a larger tolerance");
            before = poses.len();
            let again = insert(&after, &settings, tolerance).outcome();
            assert!(matches!(again, Ok(None)), "once is enough: {again:?}");
        }
    }
}

#[test]
fn what_is_not_declared_or_not_a_number_is_named() {
    let text = format!("{HEAD}N10 G1 X20.000 Y5.000 Z90.000 A2.000 C4.000 F1000\nM30\n");
    let mut settings = on("mikron-ucp710");
    settings.assume = Assume::default();
    let reason = refused(insert(&text, &settings, 0.01));
    assert!(reason.contains("work offset"), "{reason}");
    let settings = on("mikron-ucp710");
    let by_variable = text.replace("A2.000", "A#1").replace("S8000", "#1=2.\nS8000");
    let reason = refused(insert(&by_variable, &settings, 0.01));
    assert!(reason.contains("not a plain number"), "{reason}");
    let incremental = text.replace("N10 G1", "N10 G91 G1").replace("Z90.000", "Z-10.000");
    let reason = refused(insert(&incremental, &settings, 0.01));
    assert!(reason.contains("G91"), "{reason}");
    let inverse = text.replace("N10 G1", "N10 G93 G1").replace("F1000", "F100.");
    let reason = refused(insert(&inverse, &settings, 0.01));
    assert!(reason.contains("inverse time (G93)"), "{reason}");
    // the stop at the end of the line would come after the first piece
    let stopping = text.replace("F1000", "F1000 M0");
    let reason = refused(insert(&stopping, &settings, 0.01));
    assert!(reason.contains("line 4") && reason.contains("`M0`"), "{reason}");
}

/// Klartext has no words of G code: rewrites that write them say so.
#[test]
fn klartext_is_refused_by_its_name() {
    let settings = settings("heidenhain-klartext", Setup::default());
    let text = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+50 A+5 C+350 R0 FMAX\nL X+1 A+5 C+10 F1500\nM30\nEND PGM A MM\n";
    for name in [
        "switch-angles",
        "unwind-rotary",
        "smooth-pole",
        "adapt-feed",
        "fit-arcs",
        "insert-points",
        "drop-redundant",
    ] {
        let reason = refused(run(name, text, &settings, &Options::default()));
        assert!(reason.contains("Klartext"), "{name}: {reason}");
    }
}

/// A block number to which a missing program may return (M99 P50) stays.
#[test]
fn numbers_that_a_missing_program_may_name_stay() {
    let settings = settings("fanuc-30i", Setup::default());
    let program = |call: &str| {
        format!(
            "G21 G90 G94 G17 G54\nS1000 M3\nG0 X0. Y0. Z5.\nG1 Z0. F100.\nX10.\nN50 X20.\nX30.\n{call}G0 Z50.\nM30\n"
        )
    };
    let lean = |call: &str| {
        let text = program(call);
        let attempt = run("drop-redundant", &text, &settings, &Options::default());
        match attempt.outcome() {
            Ok(Some(change)) => String::from_utf8(change.after).expect("text"),
            other => panic!("{call}: {:?}", other.err()),
        }
    };
    assert!(!lean("").contains("N50"), "nothing names it");
    let text = program("M98 P7777\n");
    let reason = refused(run("drop-redundant", &text, &settings, &Options::default()));
    assert!(reason.contains("O7777 is missing"), "{reason}");
    // without a number nothing can be named
    let text = text.replace("N50 ", "");
    assert!(
        run("drop-redundant", &text, &settings, &Options::default())
            .outcome()
            .is_ok_and(|found| found.is_some())
    );
}

#[test]
fn points_off_the_segment_are_refuted() {
    let text = format!("{HEAD}N10 G1 X20.000 Y5.000 Z90.000 A2.000 C4.000 F1000\nM30\n");
    let mut settings = on("mikron-ucp710");
    // the path between the points depends on where the part is
    settings.setup.work_offsets.push(WorkOffset {
        name: "G54".to_owned(),
        values: [0.0; 9],
    });
    let settings = settings;
    let machine = settings.machine.expect("built in");
    let (after, _) = certified(insert(&text, &settings, 0.01));
    let judge = |after: &str, tolerance_mm: f64| {
        let claim = Claim::InsertedPoints {
            tolerance_mm,
            tolerance_deg: 0.01,
        };
        let (dialect, setup) = (settings.dialect, &settings.setup);
        certify(text.as_bytes(), after.as_bytes(), dialect, machine, setup, &claim)
    };
    assert!(matches!(judge(&after, 0.01), Outcome::Proved(_)));
    let refuted = |after: &str, tolerance: f64| {
        let outcome = judge(after, tolerance);
        assert!(matches!(outcome, Outcome::Refuted(_)), "{outcome:?}\n{after}");
    };
    refuted(&after, 0.005);
    let lines: Vec<&str> = after.lines().collect();
    assert!(lines.len() > 8, "{after}");
    let without = |index: usize| {
        let kept = lines.iter().enumerate().filter(|(at, _)| *at != index);
        kept.map(|(_, line)| *line).collect::<Vec<_>>().join("\n") + "\n"
    };
    refuted(&without(5), 0.01);
    // the last piece, which ends where the line did
    refuted(&without(lines.len() - 2), 0.01);
    let swapped = after.replace(lines[5], "?").replace(lines[6], lines[5]);
    refuted(&swapped.replace('?', lines[6]), 0.01);
    refuted(&after.replacen("\nX", "\nX1", 1), 0.01);
    refuted(&after.replacen("\nX", " M8\nX", 1), 0.01);
}
