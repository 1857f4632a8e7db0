//! Random programs near the pole on four kinds of machines in four dialects, against an optimum that shares nothing with the rewrite:
//! every sequence of postures and turns is tried, and the least slope through given tubes is the largest gap between two of them over
//! the length between them (the dual of the linear programme).
use crate::survey::{Point, survey};
use crate::{Options, attempt, rewrite};
use core::f64::consts::{PI, TAU};
use core::fmt::Write;
use trunnion_check::Settings;
use trunnion_geometry::math::{angle_between, asin, sin, sin_cos};
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::{Setup, Tool, ToolShape};
use trunnion_machine::{Limits, Machine, Orientations, orientations, windings};
use trunnion_syntax::parse;

const RADIUS: f64 = 5.0;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// A chain as the optimum sees it: a point.
struct Spot {
    s: f64,
    /// First rotary joint in both postures, rad; none where the axes do not reach it.
    q: [Option<f64>; 2],
    /// Half the width of the tube; none where azimuth and posture are free.
    half: Option<f64>,
}

/// The least slope over all sequences of postures and turns, rad per mm.
fn optimum(spots: &[Spot], travel: (f64, f64), freedom: bool) -> f64 {
    /// Tries all choices from a spot on. `taken`: tubes so far, as (s, low, high).
    fn search(
        at: usize,
        spots: &[Spot],
        (travel, freedom): ((f64, f64), bool),
        state: (usize, bool, f64),
        taken: &mut Vec<(f64, f64, f64)>,
        worst: f64,
        best: &mut f64,
    ) {
        if worst >= *best {
            return;
        }
        let Some(spot) = spots.get(at) else {
            *best = worst;
            return;
        };
        let (posture, changes, near) = state;
        let Some(half) = spot.half else {
            return search(
                at + 1,
                spots,
                (travel, freedom),
                (posture, freedom, near),
                taken,
                worst,
                best,
            );
        };
        let end = at == 0 || at == spots.len() - 1;
        for to in 0..2 {
            let open = to == posture || changes || at == 0;
            let Some(q) = spot.q[to].filter(|_| open && (freedom || to == 0)) else {
                continue;
            };
            let middle = ((near - q) / TAU).round();
            for turn in -2..=2 {
                let centre = q + TAU * (middle + f64::from(turn));
                if end && !freedom && (centre - q).abs() > 1.0 {
                    continue;
                }
                let tube = ((centre - half).max(travel.0), (centre + half).min(travel.1));
                if tube.0 > tube.1 + 1e-12 {
                    continue;
                }
                let slope =
                    |known: &(f64, f64, f64)| (tube.0 - known.2).max(known.1 - tube.1).max(0.0) / (spot.s - known.0);
                let steepest = taken.iter().map(slope).fold(worst, f64::max);
                taken.push((spot.s, tube.0, tube.1));
                search(
                    at + 1,
                    spots,
                    (travel, freedom),
                    (to, false, centre),
                    taken,
                    steepest,
                    best,
                );
                taken.pop();
            }
        }
    }
    let mut best = f64::INFINITY;
    let near = spots[0].q[0].unwrap_or(0.0);
    search(
        0,
        spots,
        (travel, freedom),
        (0, true, near),
        &mut Vec::new(),
        0.0,
        &mut best,
    );
    best
}

/// How a dialect says a pose.
#[derive(Clone, Copy, PartialEq)]
enum Said {
    Words,
    Vectors,
    Goto,
}

/// A program through tool axes near the pole: start and end far from it.
fn program(random: &mut Random, machine: &Machine, dialect: &str, said: Said) -> String {
    let [first, second] = *machine.rotary.as_slice() else {
        panic!("two rotary axes")
    };
    let letters = [first, second].map(|joint| char::from(machine.axes[joint].letter));
    let mut text = match dialect {
        "sinumerik-840d" => String::from("T1 M6\nD1\nS8000 M3\nTRAORI\n"),
        "fanuc-30i" => String::from("O1\nT1 M6\nS8000 M3\nG43.4 H1\n"),
        "haas-ngc" => String::from("O1\nT1 M6\nS8000 M3\nG234 H1\n"),
        _ => String::from("PARTNO TEST\nMULTAX/ON\nSPINDL/8000,CLW\nFEDRAT/2000,MMPM\n"),
    };
    let count = 4 + (random.unit() * 4.0) as usize;
    let (course, offset) = (random.between(-PI, PI), random.between(-0.6, 0.6));
    let (mut x, mut q) = (0.0, None::<[f64; 2]>);
    for row in 0..=count {
        // along a line that passes the pole at some distance, with noise
        let along = if row == 0 {
            -3.0
        } else if row == count {
            3.0
        } else {
            random.between(-1.8, 1.8)
        };
        let across = if row == 0 || row == count {
            0.2
        } else {
            offset + random.between(-0.5, 0.5)
        };
        let near = random.unit() < 0.15 && row > 0 && row < count;
        let (along, across) = if near {
            (0.02 * along, 0.02 * across)
        } else {
            (along, across)
        };
        let (s, c) = sin_cos(course);
        let (i, j) = (rad(along * c - across * s), rad(along * s + across * c));
        let u = Vec3::new(i, j, (1.0 - i * i - j * j).sqrt());
        x += random.between(0.2, 0.6);
        let (y, z) = (random.between(-0.1, 0.1), 50.0 + random.between(-0.05, 0.05));
        if said == Said::Goto {
            let rapid = if row == 0 { "RAPID\n" } else { "" };
            let _ = writeln!(
                text,
                "{rapid}GOTO/{x:.6},{y:.6},{z:.6},{:.7},{:.7},{:.7}",
                u.x, u.y, u.z
            );
            continue;
        }
        let g = if row == 0 { "G0" } else { "G1" };
        let feed = if row == 1 { " F2000." } else { "" };
        if said == Said::Vectors {
            let _ = writeln!(
                text,
                "{g} X{x:.6} Y{y:.6} Z{z:.6} A3={:.7} B3={:.7} C3={:.7}{feed}",
                u.x, u.y, u.z
            );
            continue;
        }
        let Orientations::Postures(postures) = orientations(machine, &u) else {
            panic!("reachable")
        };
        // a post without look-ahead: the first posture inside the travel, the nearest turn
        let inside = |limits: Limits, q: f64| matches!(limits, Limits::Unbounded) || windings_of(limits, q);
        let one = postures
            .iter()
            .find(|one| inside(machine.axes[second].limits, one.q[1]))
            .expect("a posture");
        let near = q.map_or(0.0, |q: [f64; 2]| q[0]);
        let a = windings(machine, first, one.q[0], near)[0];
        let b = windings(machine, second, one.q[1], 0.0)[0];
        q = Some([a, b]);
        let _ = writeln!(
            text,
            "{g} X{x:.6} Y{y:.6} Z{z:.6} {}{:.4} {}{:.4}{feed}",
            letters[1],
            deg(b),
            letters[0],
            deg(a)
        );
    }
    text.push_str(if said == Said::Goto { "FINI\n" } else { "M30\n" });
    text
}

fn windings_of(limits: Limits, q: f64) -> bool {
    let Limits::Range(low, high) = limits else { return true };
    (-1..=1).any(|turn| (low..=high).contains(&(q + TAU * f64::from(turn))))
}

fn ball() -> Setup {
    Setup {
        tools: vec![Tool {
            number: 0,
            shape: Some(ToolShape::Ball),
            diameter_mm: Some(2.0 * RADIUS),
            length_mm: Some(100.0),
            holder_mm: None,
        }],
        ..Setup::default()
    }
}

/// The points that a program cuts through, with where it comes from.
fn cuts(points: &[Point]) -> &[Point] {
    let first = points.iter().position(|point| point.linear).expect("a cut");
    &points[first - 1..]
}

fn q(machine: &Machine, point: &Point) -> f64 {
    point.end.as_ref().expect("known").joints[machine.rotary[0]]
}

fn spots(machine: &Machine, points: &[Point], room: f64) -> Vec<Spot> {
    let mut s = 0.0;
    let last = points.len() - 1;
    let travel = machine.axes[machine.rotary[1]].limits;
    let mut all = Vec::new();
    for (index, point) in points.iter().enumerate() {
        let stance = point.end.as_ref().expect("known");
        if index > 0 {
            s += point.length;
        }
        let theta = stance.pole_angle;
        let other = match orientations(machine, &stance.axis) {
            Orientations::Postures(postures) => {
                let other = postures.iter().find(|one| one.branch * stance.branch < 0);
                other.filter(|one| windings_of(travel, one.q[1])).map(|one| one.q[0])
            }
            _ => None,
        };
        let half = if index == 0 || index == last {
            Some(0.0)
        } else if theta <= 0.5 * room {
            None
        } else {
            Some(2.0 * asin(sin(0.5 * room) / sin(theta)))
        };
        all.push(Spot {
            s,
            q: [Some(q(machine, point)), other],
            half,
        });
    }
    all
}

fn steepest(machine: &Machine, points: &[Point], spots: &[Spot]) -> f64 {
    let steps = points.windows(2).zip(spots.windows(2));
    let slope = |(p, s): (&[Point], &[Spot])| ((q(machine, &p[1]) - q(machine, &p[0])) / (s[1].s - s[0].s)).abs();
    steps.map(slope).fold(0.0, f64::max)
}

/// Asserts that every contact point stays, no tool axis turns farther than the tolerance (deg), and every axis is inside its travel.
fn keeps(machine: &Machine, before: &[Point], after: &[Point], tolerance: f64, context: &str) {
    assert_eq!(before.len(), after.len(), "{context}");
    for (a, b) in before.iter().zip(after) {
        let (a, b) = (a.end.as_ref().expect("known"), b.end.as_ref().expect("known"));
        let shift = ((a.tip + a.axis * RADIUS) - (b.tip + b.axis * RADIUS)).norm();
        assert!(shift <= 1e-5, "{shift}: {context}");
        assert!(deg(angle_between(&a.axis, &b.axis)) <= tolerance + 1e-9, "{context}");
        for (axis, value) in machine.axes.iter().zip(b.joints) {
            if let Limits::Range(low, high) = axis.limits {
                assert!(value >= low - 1e-9 && value <= high + 1e-9, "limits: {context}");
            }
        }
    }
}

#[test]
fn no_choice_of_postures_turns_and_azimuths_is_less_steep() {
    let mut random = Random(7);
    let kinds = [
        ("mikron-ucp710", "sinumerik-840d", Said::Words),
        ("ferrari-bc", "fanuc-30i", Said::Words),
        ("fork-head-ca", "haas-ngc", Said::Words),
        ("nutating-head-b45", "sinumerik-840d", Said::Words),
        ("head-table-bc", "haas-ngc", Said::Words),
        ("mikron-ucp710", "apt", Said::Goto),
        ("nutating-table-b45", "fanuc-30i", Said::Words),
        ("fork-head-ca", "sinumerik-840d", Said::Vectors),
    ];
    let mut better = [0; 8];
    for case in 0..200 {
        let (name, dialect, said) = kinds[case % kinds.len()];
        let machine = trunnion_machine::builtin(name).expect("built in");
        let settings = Settings::new(
            trunnion_dialect::builtin(dialect).expect("built in"),
            Some(machine),
            ball(),
        );
        let text = program(&mut random, machine, dialect, said);
        let tolerance = [0.05, 0.1, 0.2, 0.4][case / kinds.len() % 4];
        let options = Options {
            tolerance_deg: tolerance,
            ..Options::default()
        };
        let before = parse(text.clone().into_bytes(), settings.dialect.lex);
        let points = survey(&before, &settings, machine);
        assert!(
            points.iter().any(|point| point.linear) && cuts(&points).iter().all(|point| point.end.is_ok()),
            "{name} {dialect}\n{text}"
        );
        let points = cuts(&points);
        let chain = spots(machine, points, rad(tolerance));
        let travel = match machine.axes[machine.rotary[0]].limits {
            Limits::Range(low, high) => (low, high),
            Limits::Unbounded => (f64::NEG_INFINITY, f64::INFINITY),
        };
        let was = steepest(machine, points, &chain);
        let least = optimum(&chain, travel, said == Said::Words);
        match attempt(rewrite("smooth-pole").expect("it exists"), &before, &settings, &options).outcome() {
            Ok(Some(proved)) => {
                let after = proved.after;
                better[case % kinds.len()] += 1;
                let shown = String::from_utf8_lossy(&after).into_owned();
                let after = parse(after, settings.dialect.lex);
                let changed = survey(&after, &settings, machine);
                let changed = cuts(&changed);
                let is = steepest(machine, changed, &chain);
                // the last digits of the words
                let rounding = rad(2e-4) / chain.windows(2).map(|s| s[1].s - s[0].s).fold(f64::INFINITY, f64::min);
                let context = format!(
                    "case {case} {name} {dialect} at {tolerance}: {:.4} -> {:.4}, least {:.4} deg/mm\n{text}\n{shown}",
                    deg(was),
                    deg(is),
                    deg(least)
                );
                // a step of more than half a turn is not taken, whatever its slope
                let half = chain
                    .windows(2)
                    .map(|s| PI / (s[1].s - s[0].s))
                    .fold(f64::INFINITY, f64::min);
                assert!(is <= 1.05 * least + rounding || least >= 0.95 * half, "{context}");
                assert!(is <= was + rounding, "{context}");
                keeps(machine, points, changed, tolerance, &context);
            }
            // nothing is steep, or next to nothing can be gained
            Ok(None) => {}
            Err(reason) => {
                assert!(
                    was <= 1.05 * least,
                    "case {case} {name} {dialect} {tolerance}: {reason}\n{:.3} {:.3}\n{text}",
                    deg(was),
                    deg(least)
                );
            }
        }
    }
    assert!(better.iter().all(|&count| count > 15), "{better:?}");
}
