//! A long run is planned piece by piece as it is planned at once.
use crate::limits_tests::{Keep, MACHINE, Random};
use crate::{PathControl, Planner, Timed};
use std::fmt::Write;
use trunnion_dialect::{RotaryFeed, builtin};
use trunnion_interp::Setup;
use trunnion_machine::{Follower, Leg, Machine, load};
use trunnion_syntax::parse;

/// A long way without a stop: short and long blocks, sharp and flat corners, slow and fast ones.
fn program(random: &mut Random, tcp: bool) -> String {
    let mut text = format!("{}G17 G90 G0 X0 Y0 Z50 A10 C20\n", if tcp { "TRAORI\n" } else { "" });
    let (mut x, mut y, mut a, mut c) = (0.0, 0.0, 10.0, 20.0);
    let mut size = 0.1;
    for _ in 0..1500 {
        if random.between(0.0, 1.0) < 0.03 {
            size = [0.02, 0.3, 3.0][random.between(0.0, 3.0) as usize];
        }
        x += random.between(-0.2 * size, size);
        y += random.between(-size, size);
        if random.between(0.0, 1.0) < 0.3 {
            a = f64::clamp(a + random.between(-size, size), -60.0, 60.0);
            c += random.between(-2.0 * size, 2.0 * size);
        }
        let feed = random.between(200.0, 12000.0);
        let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} A{a:.4} C{c:.4} F{feed:.1}");
    }
    text + "M30\n"
}

fn legs<'m>(machine: &'m Machine, text: &str) -> Vec<Leg> {
    let dialect = builtin("sinumerik-840d").expect("there");
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    let mut keep = Keep {
        follower: Follower::<'m>::new(machine),
        legs: Vec::new(),
    };
    trunnion_interp::run(&program, dialect, &Setup::default(), &mut keep);
    keep.legs
}

fn times(machine: &Machine, legs: &[Leg], chunk: usize) -> (Vec<Timed>, usize) {
    let mut planner = Planner::new(machine, RotaryFeed::Family);
    let mut times = Vec::new();
    planner.plan_in_chunks(chunk, 280);
    for leg in legs {
        planner.leg(leg, PathControl::ByMachine, &mut |timed| times.push(timed));
    }
    // what came out before the end
    let early = times.len();
    planner.finish(&mut |timed| times.push(timed));
    assert_eq!(times.len(), legs.len());
    (times, early)
}

fn same(whole: &[Timed], parts: &[Timed], what: &str) {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(1.0);
    let each = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => near(a, b),
        (a, b) => a == b,
    };
    for (a, b) in whole.iter().zip(parts) {
        let seconds = a.seconds.iter().zip(b.seconds).all(|(a, b)| each(*a, b));
        let speeds = each(a.reached, b.reached) && each(a.lowest, b.lowest) && each(a.leaves, b.leaves);
        let slow =
            near(a.below, b.below) && near(a.crawl.enters, b.crawl.enters) && near(a.crawl.leaves, b.crawl.leaves);
        assert!(
            seconds && speeds && slow && a.limit == b.limit && a.block == b.block,
            "{what}\n{a:?}\n{b:?}"
        );
    }
}

#[test]
fn a_long_run_is_planned_in_parts_as_at_once() {
    let mut random = Random(0x0123_4567_89AB_CDEF);
    let free = without_jerk_limits(MACHINE);
    for text_of_machine in [free.as_str(), MACHINE] {
        for lookahead in ["", "planner = { lookahead = 1 }\n", "planner = { lookahead = 40 }\n"] {
            let machine = load("m", &format!("{text_of_machine}{lookahead}")).expect("valid");
            for tcp in [false, true] {
                let legs = legs(&machine, &program(&mut random, tcp));
                let (whole, none) = times(&machine, &legs, usize::MAX);
                assert!(none < 100, "nothing comes out before a stop: {none}");
                for chunk in [280, 500] {
                    let (parts, early) = times(&machine, &legs, chunk);
                    assert!(early > 900, "{early} of {} motions came out before the end", legs.len());
                    same(&whole, &parts, &format!("{lookahead}{chunk} {tcp}"));
                }
            }
        }
    }
}

/// The machine without limits of jerk.
fn without_jerk_limits(machine: &str) -> String {
    let mut text = machine.to_owned();
    while let Some(at) = text.find(", jmax=") {
        let end = at + text[at..].find('}').expect("closed");
        text.replace_range(at..end, "");
    }
    text
}
