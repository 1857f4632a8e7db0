//! Random programs: optimistic never above planned, and a higher limit never slower, by more than a servo cycle for each block.
use crate::programs::plan;
use std::fmt::Write;
use trunnion_geometry::math::exp;
use trunnion_machine::{Machine, load};
use trunnion_planner::{PathControl, Timed};

/// Numbers without a crate: xorshift.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.between(0.0, of.len() as f64) as usize).min(of.len() - 1)]
    }
}

/// Lines, arcs, rapids and dwells of many sizes.
fn program(random: &mut Random) -> String {
    let mut text = "G21 G90 G17\nG0 X0 Y0 Z0\n".to_owned();
    let size = random.one_of(&[0.02, 0.3, 4.0, 60.0]);
    let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
    let mut feed = 600.0;
    for _ in 0..random.between(1.0, 40.0) as usize {
        if random.between(0.0, 1.0) < 0.3 {
            feed = random.between(30.0, 15000.0);
        }
        x += random.between(-size, size);
        y += random.between(-size, size);
        let _ = match random.between(0.0, 1.0) {
            kind if kind < 0.15 => {
                let from = x;
                x += random.between(0.1 * size, size);
                let reach = 0.5 * (x - from);
                let code = random.one_of(&["G2", "G3"]);
                writeln!(
                    text,
                    "G1 X{from:.4} Y{y:.4} F{feed:.1}\n{code} X{x:.4} Y{y:.4} I{reach:.5} J0"
                )
            }
            kind if kind < 0.25 => {
                z += random.between(-size, size);
                writeln!(text, "G0 X{x:.4} Y{y:.4} Z{z:.4}")
            }
            kind if kind < 0.28 => writeln!(text, "G4 P0.1\nG1 X{x:.4} Y{y:.4} F{feed:.1}"),
            kind if kind < 0.5 => {
                z += random.between(-0.3 * size, 0.3 * size);
                writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.4} F{feed:.1}")
            }
            // straight on: no corner
            kind if kind < 0.65 => {
                x += size;
                writeln!(
                    text,
                    "G1 X{x:.4} F{feed:.1}\nX{:.4}\nX{:.4}",
                    x + 0.3 * size,
                    x + 0.5 * size
                )
                .map(|()| x += 0.5 * size)
            }
            _ => writeln!(text, "G1 X{x:.4} Y{y:.4} F{feed:.1}"),
        };
    }
    text + "M2\n"
}

/// Speed, acceleration and jerk of X, Y, Z.
type Limits = [[f64; 3]; 3];

/// Axes alike but for their size.
fn alike(random: &mut Random) -> Limits {
    let limits = [
        random.between(20.0, 500.0),
        random.between(100.0, 9000.0),
        random.between(3000.0, 200_000.0),
    ];
    [1.0, 0.8, 0.5].map(|share| limits.map(|limit| limit * share))
}

/// Each axis by itself: the best filter of one may be the worst of another.
fn unlike(random: &mut Random) -> Limits {
    [(); 3].map(|()| {
        [
            random.between(20.0, 400.0),
            random.between(50.0, 5000.0),
            exp(random.between(5.8, 12.6)),
        ]
    })
}

fn machine(limits: Limits, control: &str) -> Machine {
    let axes = ["X", "Y", "Z"]
        .iter()
        .zip(limits)
        .map(|(letter, [speed, acceleration, jerk])| {
            format!("{{letter=\"{letter}\", sign=1, dyn={{vmax={speed}, amax={acceleration}, jmax={jerk}}}}}")
        });
    let axes = axes.collect::<Vec<_>>().join(", ");
    load(
        "m",
        &format!("schema = \"ncmachine/1\"\naxis = [{axes}]\n[control]\nfamily = \"linuxcnc\"\n{control}\n"),
    )
    .expect("valid")
}

const CONTROLS: [&str; 7] = [
    "",
    "corner = { model = \"exact-stop\" }",
    "corner = { model = \"linuxcnc-g64\" }",
    "corner = { model = \"grbl\", deviation = 0.02 }",
    "corner = { model = \"klipper\", speed = 5 }\nplanner = { lookahead = 5 }",
    "corner = { model = \"axis-jump\", dv = { X = 5, Y = 4, Z = 3 } }\nplanner = { filter_time = 0.01 }",
    "corner = { model = \"grbl\", deviation = 0.01 }\nplanner = { block_time = 0.003 }",
];

const MODES: [PathControl; 5] = [
    PathControl::ByMachine,
    PathControl::ExactStop,
    PathControl::ExactPath,
    PathControl::Blend(Some(0.05)),
    PathControl::Blend(None),
];

fn count() -> usize {
    std::env::var("TRUNNION_PATHS")
        .ok()
        .and_then(|count| count.parse().ok())
        .unwrap_or(1500)
}

#[test]
fn optimistic_is_never_above_planned() {
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    for index in 0..count() {
        let text = program(&mut random);
        let control = CONTROLS[index % CONTROLS.len()];
        let limits = alike(&mut random);
        let mode = MODES[(index / CONTROLS.len()) % MODES.len()];
        for timed in plan(&machine(limits, control), &text, mode) {
            if let [Some(optimistic), Some(planned)] = timed.seconds {
                assert!(planned.is_finite() && optimistic >= 0.0);
                // no motion is slow for longer than it lasts
                assert!(timed.below <= planned, "{timed:?}\n{text}");
                assert!(
                    optimistic <= planned * (1.0 + 1e-9) + 1e-12,
                    "{optimistic} above {planned}, {control} {mode:?}\n{text}"
                );
            }
        }
    }
}

/// But for LinuxCNC's own corners, whose choice among three ways is no function that only grows.
#[test]
fn a_higher_limit_is_never_slower() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut compared = 0;
    for index in 0..count() {
        let text = program(&mut random);
        let control = CONTROLS[index % CONTROLS.len()];
        if control.contains("g64") {
            continue;
        }
        let mode = MODES[(index / CONTROLS.len()) % MODES.len()];
        let which = index % 3;
        let factor = random.one_of(&[1.05, 1.5, 4.0, 10.0, 30.0, 100.0]);
        let (limits, higher) = if index % 2 == 0 {
            let limits = alike(&mut random);
            let mut higher = limits;
            for axis in &mut higher {
                axis[which] *= factor;
            }
            (limits, higher)
        } else {
            let limits = unlike(&mut random);
            let mut higher = limits;
            higher[random.one_of(&[0, 1, 2])][which] *= factor;
            (limits, higher)
        };
        let before = plan(&machine(limits, control), &text, mode);
        let after = plan(&machine(higher, control), &text, mode);
        // an arc whose rounded ends do not fit its centre is not run
        let time = |out: &[Timed]| out.iter().map(|timed| timed.seconds[1]).sum::<Option<f64>>();
        let (Some(slow), Some(fast)) = (time(&before), time(&after)) else {
            continue;
        };
        compared += 1;
        assert!(
            fast <= slow + 0.001 * before.len() as f64,
            "limit {which} from {limits:?} to {higher:?}: {slow} became {fast}, {control} {mode:?}\n{text}"
        );
    }
    assert!(compared > count() / 3, "only {compared} programs were compared");
}
