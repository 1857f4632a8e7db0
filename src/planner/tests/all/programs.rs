//! Whole programs: intervals, stops, doglegs, look-ahead, block time.
use std::fmt::Write;
use trunnion_dialect::{RotaryFeed, builtin};
use trunnion_interp::{Fault, ModalState, Motion, Setup, Sink};
use trunnion_machine::{Follower, Machine, load};
use trunnion_planner::{Limit, PathControl, Planner, Timed};
use trunnion_syntax::{Program, parse};

const AXES: &str = r#"schema = "ncmachine/1"
axis = [{letter="X", sign=1, dyn={vmax=200, amax=1000, jmax=20000}}, {letter="Y", sign=1, dyn={vmax=200, amax=1000, jmax=20000}}, {letter="Z", sign=1, dyn={vmax=100, amax=500, jmax=20000}}]
"#;

fn machine(control: &str) -> Machine {
    load("m", &format!("{AXES}[control]\nfamily = \"linuxcnc\"\n{control}\n")).expect("valid")
}

struct Feeder<'m, 'p> {
    follower: Follower<'m>,
    planner: &'p mut Planner<'m>,
    control: PathControl,
    out: Vec<Timed>,
}

impl Sink for Feeder<'_, '_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        let out = &mut self.out;
        self.planner.leg(&leg, self.control, &mut |timed| out.push(timed));
    }
    fn fault(&mut self, _: Fault) {}
}

pub(crate) fn plan(machine: &Machine, text: &str, control: PathControl) -> Vec<Timed> {
    let dialect = builtin("linuxcnc").expect("there");
    let program: Program = parse(text.as_bytes().to_vec(), dialect.lex);
    let mut planner = Planner::new(machine, RotaryFeed::Language);
    let mut feeder = Feeder {
        follower: Follower::new(machine),
        planner: &mut planner,
        control,
        out: Vec::new(),
    };
    trunnion_interp::run(&program, dialect, &Setup::default(), &mut feeder);
    let mut out = feeder.out;
    planner.finish(&mut |timed| out.push(timed));
    out
}

pub(crate) fn total(out: &[Timed]) -> [f64; 2] {
    [0, 1].map(|side| out.iter().map(|timed| timed.seconds[side].expect("known")).sum())
}

#[test]
fn one_move_is_its_closed_form() {
    let m = machine("");
    let out = plan(&m, "G21 G90\nG0 X0 Y0 Z0\nG1 X100 F6000\nM2\n", PathControl::ByMachine);
    // v 100, a 1000, j 20000: L/v + v/a + a/j
    let [optimistic, planned] = total(&out);
    assert!((optimistic - 1.1).abs() < 1e-9, "{optimistic}");
    assert!((planned - 1.15).abs() < 1e-9, "{planned}");
    assert_eq!(out[1].limit, Limit::Feed);
    // too short for its acceleration: 4 cbrt(L/(2 j))
    let out = plan(&m, "G21 G90\nG0 X0 Y0 Z0\nG1 X0.01 F6000\nM2\n", PathControl::ByMachine);
    let wanted = (32.0_f64 * 0.01 / 20000.0).cbrt();
    assert!((total(&out)[1] - wanted).abs() < 1e-9, "{} {wanted}", total(&out)[1]);
    assert_eq!(out[1].limit, Limit::Jerk);
}

#[test]
fn a_straight_line_in_many_pieces_takes_as_long_as_in_one() {
    let m = machine("corner = { model = \"grbl\", deviation = 0.01 }");
    let mut text = "G21 G90\nG0 X0 Y0 Z0\nG1 F6000\n".to_owned();
    for k in 1..=100 {
        let _ = writeln!(text, "X{k}");
    }
    let out = plan(&m, &(text + "M2\n"), PathControl::ByMachine);
    assert!((total(&out)[1] - 1.15).abs() < 1e-9, "{}", total(&out)[1]);
    assert!(out.iter().all(|timed| timed.seconds[0] <= timed.seconds[1]));
}

#[test]
fn an_undeclared_corner_is_anything_between_full_speed_and_a_stop() {
    let m = machine("");
    let text = "G21 G90\nG0 X0 Y0 Z0\nG1 X100 F6000\nY100\nM2\n";
    let [optimistic, planned] = total(&plan(&m, text, PathControl::ByMachine));
    assert!((optimistic - 2.1).abs() < 1e-9, "{optimistic}");
    assert!(planned > 2.2 && planned < 2.5, "{planned}");
    let stop = total(&plan(&m, text, PathControl::ExactStop));
    assert!((stop[1] - 2.3).abs() < 1e-9, "{}", stop[1]);
    let exact = total(&plan(&m, text, PathControl::ExactPath));
    assert!((exact[1] - 2.3).abs() < 1e-9, "{}", exact[1]);
}

#[test]
fn dwells_rapids_and_unknown_motions() {
    let m = machine("");
    let out = plan(
        &m,
        "G21 G90\nG0 X0 Y0 Z0\nG0 X100 Z50\nG4 P0.5\nG1 X110 F600\nM2\n",
        PathControl::ByMachine,
    );
    assert!(out[0].from_nowhere);
    // synchronous: Z sets the acceleration (500 for half the way) and both the speed: 100 mm at 200 mm/s and 1000 mm/s2, 20000 of Z is 40000 along X
    assert!(out[1].seconds[1].expect("known") > 0.7 - 1e-9);
    assert_eq!(out[2].seconds, [Some(0.5); 2]);
    assert_eq!(out[2].limit, Limit::Wait);
    let bare = load("m", "schema = \"ncmachine/1\"\naxis = [{letter=\"X\", sign=1, dyn={vmax=200}}, {letter=\"Y\", sign=1}, {letter=\"Z\", sign=1}]\n").expect("valid");
    let out = plan(
        &bare,
        "G21 G90\nG0 X0 Y0 Z0\nG1 X100 F6000\nM2\n",
        PathControl::ByMachine,
    );
    assert_eq!(
        (out[1].seconds[0].map(|t| (t * 1e9).round()), out[1].seconds[1]),
        (Some(1e9), None),
        "no acceleration, no plan"
    );
}

#[test]
fn block_time_and_look_ahead_slow_short_blocks_down() {
    let mut text = "G21 G90\nG0 X0 Y0 Z0\nG1 F6000\n".to_owned();
    for k in 1..=1000 {
        let _ = writeln!(text, "X{}", f64::from(k) * 0.1);
    }
    text += "M2\n";
    let free = total(&plan(
        &machine("corner = { model = \"grbl\", deviation = 0.01 }"),
        &text,
        PathControl::ByMachine,
    ));
    let slow = machine("corner = { model = \"grbl\", deviation = 0.01 }\nplanner = { block_time = 0.002 }");
    let out = plan(&slow, &text, PathControl::ByMachine);
    // 0.1 mm in 2 ms: 50 mm/s
    assert!((out[500].reached.expect("known") - 3000.0).abs() < 1e-6);
    assert_eq!(out[500].limit, Limit::BlockTime);
    assert!((out[500].share().expect("known") - 0.5).abs() < 1e-6);
    let near = machine("corner = { model = \"grbl\", deviation = 0.01 }\nplanner = { lookahead = 10 }");
    let out = plan(&near, &text, PathControl::ByMachine);
    // it must be able to stop within 10 blocks: sqrt(2 a 1 mm)
    let most = (2.0_f64 * 1000.0).sqrt() * 60.0;
    assert!(out.iter().all(|timed| timed.lowest.is_none_or(|v| v <= most * 1.001)));
    assert!(total(&out)[1] > free[1] && total(&out)[0] == free[0]);
}

/// With a higher limit a program takes no longer, but for a servo cycle per block.
#[test]
fn higher_limits_do_not_slow_down() {
    let texts = [
        "G21 G90\nG0 X0 Y0 Z0\nG1 X20 F6000\nY3\nX18 Y9\nZ-4\nG2 X0 Y9 I-9 J0\nG1 X0 Y0\nM2\n",
        "G21 G90\nG0 X0 Y0 Z0\nG1 X0.3 F9000\nY0.2\nX1 Y1\nG3 X3 Y3 R4\nG1 X90\nG0 Z5\nM2\n",
    ];
    for text in texts {
        for key in ["vmax", "amax", "jmax"] {
            let mut before = f64::INFINITY;
            for factor in [1.0, 1.3, 2.0, 4.0, 10.0] {
                let mut axes = AXES.to_owned();
                for (old, value) in [
                    ("vmax=200", 200.0),
                    ("vmax=100", 100.0),
                    ("amax=1000", 1000.0),
                    ("amax=500", 500.0),
                    ("jmax=20000", 20000.0),
                ] {
                    if old.starts_with(key) {
                        axes = axes.replace(old, &format!("{key}={}", value * factor));
                    }
                }
                let control = "[control]\nfamily = \"linuxcnc\"\ncorner = { model = \"grbl\", deviation = 0.01 }\n";
                let m = load("m", &(axes + control)).expect("valid");
                let out = plan(&m, text, PathControl::ByMachine);
                let now = total(&out)[1];
                assert!(
                    now <= before + 0.001 * out.len() as f64,
                    "{key} x{factor}: {now} after {before}"
                );
                before = now;
            }
        }
    }
}
