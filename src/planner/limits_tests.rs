//! No limit is broken on random paths: the planned motion is differentiated here, from joint positions at three moments.
use crate::{PathControl, Planned, Planner, Run};
use std::fmt::Write;
use trunnion_dialect::{RotaryFeed, builtin};
use trunnion_interp::{Fault, ModalState, Motion, Setup, Sink};
use trunnion_machine::{BlockPath, Follower, Leg, Machine, load};
use trunnion_syntax::parse;

pub(crate) const MACHINE: &str = r#"schema = "ncmachine/1"
axis = [{letter="C", sign=1, side="table", dyn={vmax=120, amax=600, jmax=9000}},
  {letter="A", sign=1, side="table", limits=[-120, 120], dyn={vmax=90, amax=500, jmax=8000}},
  {letter="X", sign=1, dyn={vmax=300, amax=2000, jmax=30000}}, {letter="Y", sign=1, dyn={vmax=300, amax=1500, jmax=30000}},
  {letter="Z", sign=1, dyn={vmax=200, amax=1000, jmax=20000}}]
[control]
family = "sinumerik-840d"
rapid = "synchronous"
corner = { model = "axis-jump", dv = { X = 5, Y = 4, Z = 3, A = 2, C = 2 } }
"#;

/// Numbers without a crate: xorshift.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn program(random: &mut Random) -> String {
    let tcp = random.between(0.0, 1.0) < 0.6;
    let mut text = format!("{}G17 G90 G0 X0 Y0 Z50 A10 C20\n", if tcp { "TRAORI\n" } else { "" });
    let (mut x, mut y, mut a, mut c) = (0.0, 0.0, 10.0, 20.0);
    let size = [0.1, 1.0, 10.0][random.between(0.0, 3.0) as usize];
    for _ in 0..12 {
        x += random.between(-size, size);
        y += random.between(-size, size);
        let feed = random.between(200.0, 12000.0);
        if random.between(0.0, 1.0) < 0.2 {
            let (to_x, to_y) = (x + random.between(0.1, size + 0.1), y);
            let reach = 0.5 * (to_x - x);
            let _ = writeln!(
                text,
                "G1 X{x:.4} Y{y:.4} F{feed:.1}\nG2 X{to_x:.4} Y{to_y:.4} I{reach:.4} J0"
            );
            x = to_x;
        } else {
            a = (a + random.between(-size, size)).clamp(-60.0, 60.0);
            c += random.between(-2.0 * size, 2.0 * size);
            let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} A{a:.4} C{c:.4} F{feed:.1}");
        }
    }
    text + "M30\n"
}

pub(crate) struct Keep<'m> {
    pub(crate) follower: Follower<'m>,
    pub(crate) legs: Vec<Leg>,
}

impl Sink for Keep<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        self.legs.push(leg);
    }
    fn fault(&mut self, _: Fault) {}
}

fn check(machine: &Machine, text: &str) -> usize {
    let dialect = builtin("sinumerik-840d").expect("there");
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    let mut keep = Keep {
        follower: Follower::new(machine),
        legs: Vec::new(),
    };
    trunnion_interp::run(&program, dialect, &Setup::default(), &mut keep);
    let mut planner = Planner::new(machine, RotaryFeed::Family);
    let mut times = Vec::new();
    for leg in &keep.legs {
        planner.leg(leg, PathControl::ByMachine, &mut |timed| times.push(timed));
    }
    planner.finish(&mut |timed| times.push(timed));
    assert_eq!(times.len(), keep.legs.len());
    for timed in &times {
        if let [Some(optimistic), Some(planned)] = timed.seconds {
            assert!(
                optimistic <= planned * (1.0 + 1e-9) + 1e-12,
                "{optimistic} above {planned}\n{text}"
            );
        }
    }
    planner
        .seen
        .iter()
        .map(|(run, planned)| check_run(machine, &keep.legs, run, planned, text))
        .sum()
}

fn check_run(machine: &Machine, legs: &[Leg], run: &Run, planned: &Planned, text: &str) -> usize {
    let (mut motion, mut way, mut checked) = (u32::MAX, 0.0, 0);
    for (piece, ramp) in run.pieces.iter().zip(&planned.ramps) {
        if piece.motion != motion {
            (motion, way) = (piece.motion, 0.0);
        }
        let leg = &legs[motion as usize];
        let path = BlockPath::new(machine, leg).expect("it was planned");
        let whole: f64 = run
            .pieces
            .iter()
            .filter(|other| other.motion == motion)
            .map(|other| other.length)
            .sum();
        for part in 1..8 {
            let s = piece.length * f64::from(part) / 8.0;
            let (v, a) = ramp.at(s);
            // near a change of acceleration three moments would mix two phases
            let dt = 1e-4_f64.min(0.02 * piece.length / v.max(1e-9));
            if ramp.at(s - v * dt).1 != a || ramp.at(s + v * dt).1 != a {
                continue;
            }
            let at = |t: f64| path.at((way + s + v * t + 0.5 * a * t * t) / whole).joints;
            let (before, now, after) = (at(-dt), at(0.0), at(dt));
            for (joint, axis) in machine.axes.iter().enumerate() {
                let speed = (after[joint] - before[joint]) / (2.0 * dt);
                let bend = (after[joint] - 2.0 * now[joint] + before[joint]) / (dt * dt);
                let noise = 1e-12 * now[joint].abs().max(1.0) / (dt * dt);
                let (most, most_bend) = (
                    axis.max_speed.expect("declared"),
                    axis.max_acceleration.expect("declared"),
                );
                let letter = char::from(axis.letter);
                assert!(
                    speed.abs() <= most * (1.0 + 1e-4),
                    "{letter} runs at {speed}, at most {most}, motion {motion}\n{text}"
                );
                assert!(
                    bend.abs() <= most_bend * (1.0 + 2e-3) + noise,
                    "{letter} accelerates with {bend}, at most {most_bend}, motion {motion}, {piece:?}, {ramp:?}\n{text}"
                );
                checked += 1;
            }
        }
        way += piece.length;
    }
    // between two motions each axis jumps by no more than declared
    for (index, pair) in run.pieces.windows(2).enumerate() {
        if pair[0].motion == pair[1].motion {
            continue;
        }
        let speed = planned.ramps[index].ends[1];
        let tangent = |motion: u32, end: f64| {
            let leg = &legs[motion as usize];
            let length: f64 = run
                .pieces
                .iter()
                .filter(|other| other.motion == motion)
                .map(|other| other.length)
                .sum();
            BlockPath::new(machine, leg)
                .expect("planned")
                .rates(end)
                .map(|rate| rate / length)
        };
        let (before, after) = (tangent(pair[0].motion, 1.0), tangent(pair[1].motion, 0.0));
        for (joint, axis) in machine.axes.iter().enumerate() {
            let jump = (after[joint] - before[joint]).abs() * speed;
            let most = machine.control.planning.corner_jump[joint].expect("declared");
            assert!(
                jump <= most * (1.0 + 1e-3) + 1e-6,
                "{} jumps by {jump}, at most {most}\n{text}",
                char::from(axis.letter)
            );
        }
    }
    checked
}

#[test]
fn no_limit_is_broken_on_random_paths() {
    let machine = load("m", MACHINE).expect("valid");
    let count: u64 = std::env::var("TRUNNION_PATHS")
        .ok()
        .and_then(|count| count.parse().ok())
        .unwrap_or(400);
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut checked = 0;
    for _ in 0..count {
        let text = program(&mut random);
        checked += check(&machine, &text);
    }
    assert!(checked as u64 > 100 * count, "only {checked} values were looked at");
}

/// The filter that limits the jerk: a moving average of the planned speed, differentiated twice.
#[test]
fn the_filter_keeps_the_jerk() {
    let (acceleration, jerk) = (1000.0, 20000.0);
    let mut random = Random(88_172_645_463_325_252);
    for _ in 0..50 {
        let piece = |motion: u32, length: f64, cap: f64| crate::Piece {
            length,
            optimistic: crate::Bounds {
                cap,
                by: crate::Limit::Feed,
                acceleration,
            },
            planned: crate::Bounds {
                cap,
                by: crate::Limit::Feed,
                acceleration,
            },
            jerk,
            slowest: 0,
            bend_jerk: f64::INFINITY,
            bends: false,
            jerk_time: acceleration / jerk,
            entry: [f64::INFINITY; 2],
            feed: cap,
            motion,
        };
        let pieces = (0..6)
            .map(|k| piece(k, random.between(0.5, 40.0), random.between(5.0, 200.0)))
            .collect();
        let run = Run {
            pieces,
            lookahead: None,
            filter: 0.0,
            long: None,
            begun: None,
        };
        let planned = run.plan();
        let dt = 1e-4;
        let mut speeds = Vec::new();
        for (piece, ramp) in run.pieces.iter().zip(&planned.ramps) {
            let (mut s, mut v) = (0.0, ramp.ends[0].max(1e-3));
            while s < piece.length {
                v = ramp.at(s).0.max(0.05);
                speeds.push(v);
                s += v * dt;
            }
            let _ = v;
        }
        let crate::Smooth::Filter(filter) = planned.smooth[0] else {
            panic!("{:?}", planned.smooth)
        };
        let window = (filter / dt).round() as usize;
        let padded: Vec<f64> = vec![0.0; window]
            .into_iter()
            .chain(speeds)
            .chain(vec![0.0; window])
            .collect();
        let smooth: Vec<f64> = padded
            .windows(window)
            .map(|w| w.iter().sum::<f64>() / window as f64)
            .collect();
        // differences over 2 ms: steps of one sample are rounding
        let h = 20;
        for k in h..smooth.len() - h {
            let found = (smooth[k + h] - 2.0 * smooth[k] + smooth[k - h]) / (h as f64 * dt).powi(2);
            assert!(found.abs() <= jerk * 1.05, "{found}");
        }
    }
}
