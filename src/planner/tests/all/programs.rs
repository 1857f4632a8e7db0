//! Whole programs: intervals, stops, doglegs, look-ahead, block time.
use std::fmt::Write;
use trunnion_dialect::{RotaryFeed, builtin};
use trunnion_interp::{Fault, ModalState, Motion, Setup, Sink};
use trunnion_machine::{Follower, Leg, Machine, load};
use trunnion_planner::{Limit, Listener, PathControl, Planner, Timed, time};
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

/// What an arc asks of its axes is what they need on it, and not on a whole circle: 20 deg about the X axis take sin 10 deg of the acceleration from Y.
#[test]
fn a_short_arc_asks_of_each_axis_what_it_needs_there() {
    let axes = "schema = \"ncmachine/1\"\naxis = [{letter=\"X\", sign=1, dyn={vmax=1000, amax=1000}}, {letter=\"Y\", sign=1, dyn={vmax=1000, amax=100}}, {letter=\"Z\", sign=1, dyn={vmax=1000, amax=1000}}]\n";
    let machine = load(
        "m",
        &format!("{axes}[control]\ncorner = {{ model = \"axis-jump\", dv = {{ X = 8, Y = 8, Z = 8 }} }}\n"),
    )
    .expect("valid");
    let limit = |text: &str| {
        let dialect = builtin("linuxcnc").expect("there");
        let program: Program = parse(text.as_bytes().to_vec(), dialect.lex);
        let mut legs = Legs {
            follower: Follower::new(&machine),
            limits: Vec::new(),
        };
        trunnion_interp::run(&program, dialect, &Setup::default(), &mut legs);
        legs.limits.pop().flatten()
    };
    let (x, y) = (9.84808, 1.73648);
    let arc = |from: [f64; 2], to: [f64; 2]| {
        limit(&format!(
            "G21 G90 G17\nG0 X{} Y{} Z0\nG3 X{} Y{} I{} J{} F100\nM2\n",
            from[0], from[1], to[0], to[1], -from[0], -from[1]
        ))
    };
    // v^2/10 sin 10 deg = 100
    let (feed, joint) = arc([x, -y], [x, y]).expect("bends");
    assert!(
        (feed - 60.0 * (1000.0 / 0.173_648_f64).sqrt()).abs() < 0.1 && joint == 1,
        "{feed}"
    );
    // across the Y axis it takes all of it there, both ways round
    for (from, to) in [([y, x], [-y, x]), ([x, y], [-x, -y])] {
        let (feed, joint) = arc(from, to).expect("bends");
        assert!((feed - 60.0 * 1000.0_f64.sqrt()).abs() < 0.1 && joint == 1, "{feed}");
    }
}

struct Legs<'m> {
    follower: Follower<'m>,
    limits: Vec<Option<(f64, usize)>>,
}

impl Sink for Legs<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        self.limits
            .push(trunnion_planner::bend_limit(self.follower.machine(), &leg));
    }
    fn fault(&mut self, _: Fault) {}
}

/// amax over jmax may be many times the filter that suits a run.
#[test]
fn an_enormous_acceleration_does_not_slow_a_bend_down() {
    let time = |amax: f64| {
        let axes = format!(
            "schema = \"ncmachine/1\"\naxis = [{{letter=\"X\", sign=1, dyn={{vmax=250, amax={amax}, jmax=30000}}}}, {{letter=\"Y\", sign=1, dyn={{vmax=250, amax=2000, jmax=30000}}}}, {{letter=\"Z\", sign=1, dyn={{vmax=250, amax=2000, jmax=30000}}}}]\n"
        );
        let machine = load(
            "m",
            &format!("{axes}[control]\ncorner = {{ model = \"axis-jump\", dv = {{ X = 8, Y = 8, Z = 8 }} }}\n"),
        )
        .expect("valid");
        let out = plan(
            &machine,
            "G21 G90 G17\nG0 X0 Y0 Z0\nG2 X0.2 Y0 I0.1 J0 F600\nM2\n",
            PathControl::ByMachine,
        );
        total(&out)[1]
    };
    let least = time(2000.0);
    for amax in [1e4, 1e6, 3e6, 1e7] {
        assert!(time(amax) <= least + 0.001, "{amax}: {} {least}", time(amax));
    }
}

struct Clocked([f64; 2]);

impl Listener for Clocked {
    fn leg(&mut self, _: &Leg, _: &ModalState, _: u32) {}
    fn timed(&mut self, timed: &Timed, _: bool) {
        for (all, own) in self.0.iter_mut().zip(timed.seconds) {
            *all += own.expect("known");
        }
    }
}

fn clock(machine: &Machine, dialect: &str, text: &str) -> [f64; 2] {
    let dialect = builtin(dialect).expect("there");
    let program: Program = parse(text.as_bytes().to_vec(), dialect.lex);
    let mut clocked = Clocked([0.0; 2]);
    time(&program, dialect, &Setup::default(), machine, &mut clocked);
    clocked.0
}

fn with(control: &str) -> Machine {
    let axes = ["X", "Y", "Z"].map(|letter| format!("{{letter=\"{letter}\", sign=1, dyn={{vmax=250, amax=1000}}}}"));
    let text = format!(
        "schema = \"ncmachine/1\"\naxis = [{}]\n[control]\n{control}\n",
        axes.join(", ")
    );
    load("m", &text).expect("valid")
}

/// G61 and G61.1 are those of the language, whatever family the machine is of: G61 passes what is straight on, G61.1 stops.
#[test]
fn exact_stops_are_those_of_the_dialect() {
    let machine = with(
        "family = \"generic\"\nrapid = \"synchronous\"\ncorner = { model = \"axis-jump\", dv = { X = 8, Y = 8, Z = 8 } }",
    );
    let text = |code: &str| format!("G21 G90 G17\nG0 X0 Y0 Z0\n{code}\nG1 X50 F3000\nX100\nM2\n");
    let [through, stops] = ["G61", "G61.1"].map(|code| clock(&machine, "linuxcnc", &text(code))[1]);
    assert!(
        (through - 2.05).abs() < 1e-9 && (stops - 2.1).abs() < 1e-9,
        "{through} {stops}"
    );
    assert!((clock(&machine, "fanuc-30i", &text("G61"))[1] - 2.1).abs() < 1e-9);
}

#[test]
fn stops_and_tool_changes_of_the_program() {
    let corner = "rapid = \"synchronous\"\ncorner = { model = \"axis-jump\", dv = { X = 8, Y = 8, Z = 8 } }\nplanner = { tool_change_time = 7 }\n";
    let machine = with(corner);
    let planned = |text: &str| clock(&machine, "fanuc-30i", text)[1];
    let cut = |between: &str| {
        planned(&format!(
            "G21 G90 G17\nG0 X0 Y0 Z0\nG1 X50. F3000\n{between}X100.\nM30\n"
        ))
    };
    assert!((cut("") - 2.05).abs() < 1e-9);
    assert!((cut("M0\n") - 2.1).abs() < 1e-9, "{}", cut("M0\n"));
    assert!((cut("M8\n") - 2.05).abs() < 1e-9);
    // each change counts, of a tool that does not move too, and the same tool is none
    assert!((planned("T1 M6\nM30\n") - 7.0).abs() < 1e-9);
    assert!((planned("T1 M6\nT2 M6\nM30\n") - 14.0).abs() < 1e-9);
    assert!((planned("T1 M6\nT1 M6\nM30\n") - 7.0).abs() < 1e-9);
    assert!((planned("T1 M6\nT0 M6\nM30\n") - 14.0).abs() < 1e-9);
}

/// A code that changes nothing takes no time; each change takes its own.
#[test]
fn m_codes_take_their_times() {
    let machine = with(
        "family = \"generic\"\nplanner = { m_times = { M3 = 1, M5 = 2, M7 = 4, M8 = 8, M9 = 16, M30 = 32, M2 = 64 } }",
    );
    for (dialect, text, seconds) in [
        ("fanuc-30i", "M30\n", 32.0),
        (
            "fanuc-30i",
            "S1000 M3\nM8\nM8\nM9\nM9\nM5\nM30\n",
            1.0 + 8.0 + 16.0 + 2.0 + 32.0,
        ),
        ("linuxcnc", "M7\nM8\nM9\nM2\n", 4.0 + 8.0 + 16.0 + 64.0),
        ("linuxcnc", "T1 M6\nM2\n", 64.0),
    ] {
        let found = clock(&machine, dialect, text)[1];
        assert!((found - seconds).abs() < 1e-9, "{dialect} {text}: {found}");
    }
}

/// The slower one counts of what a machine may do that does not say how it moves in a rapid.
#[test]
fn an_undeclared_rapid_is_planned_as_the_slower_kind() {
    let axes = "axis = [{letter=\"X\", sign=1, dyn={vmax=200, amax=1000}}, {letter=\"Y\", sign=1, dyn={vmax=50, amax=500}}, {letter=\"Z\", sign=1, dyn={vmax=30, amax=100}}]";
    let planned = |rapid: &str| {
        let machine = load("m", &format!("schema = \"ncmachine/1\"\n{axes}\n[control]\n{rapid}\n")).expect("valid");
        clock(
            &machine,
            "fanuc-30i",
            "G21 G90\nG0 X0. Y0. Z0.\nG0 X100. Y30. Z5.\nM30\n",
        )
    };
    let [dogleg, together, open] = ["rapid = \"dogleg\"", "rapid = \"synchronous\"", ""].map(planned);
    assert!((dogleg[1] - 0.7).abs() < 1e-9, "{dogleg:?}");
    assert!(
        together[1] > dogleg[1] && open == [dogleg[0], together[1]],
        "{together:?} {open:?}"
    );
}
