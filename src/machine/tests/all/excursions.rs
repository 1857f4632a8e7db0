//! Blocks whose excursion only one term of a bound shows.
use crate::common::{motion, position, words};
use trunnion_geometry::rad;
use trunnion_interp::{Motion, Position};
use trunnion_machine::{Excess, Follower, Leg, Limits, Machine, builtin, limit_excess, load, tip_deviation};

fn machine(name: &str) -> Machine {
    builtin(name).expect("built in").clone()
}

/// The last of some lines under tool centre point control with a tool of the given length.
fn tcp_leg(machine: &Machine, length: f64, ends: [&[(u8, f64)]; 2]) -> Leg {
    let mut follower = Follower::new(machine);
    let [from, to] = ends.map(position);
    let under_tcp = |start: Position, end: Position| Motion {
        tcp: true,
        tool_length_mm: length,
        start,
        end,
        ..motion()
    };
    follower.follow(&under_tcp(Position::default(), from));
    follower.follow(&under_tcp(from, to))
}

/// What is found of one axis when its travel is `low` to `high` beyond its values at the ends.
fn found(machine: &Machine, leg: &Leg, letter: u8, low: f64, high: f64) -> Vec<Excess> {
    let joint = machine.joint(letter).expect("an axis");
    let ends = [leg.start.expect("known"), leg.end.clone().expect("known")].map(|stance| stance.joints[joint]);
    let mut narrow = machine.clone();
    // no other axis may call for the finer bounds
    narrow.axes.iter_mut().for_each(|axis| axis.limits = Limits::Unbounded);
    narrow.axes[joint].limits = Limits::Range(ends[0].min(ends[1]) - low, ends[0].max(ends[1]) + high);
    let mut out = Vec::new();
    limit_excess(&narrow, leg, &mut out);
    out.retain(|excess| excess.axis == joint);
    out
}

#[test]
fn an_excursion_to_the_low_side_is_found() {
    let machine = machine("mikron-ucp710");
    let ends: [&[(u8, f64)]; 2] = [
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', -200.0), (b'A', -25.0), (b'C', 0.0)],
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', -200.0), (b'A', 60.0), (b'C', 0.0)],
    ];
    let leg = tcp_leg(&machine, 0.0, ends);
    // Z runs from -181 over -200 to -100
    let out = found(&machine, &leg, b'Z', 10.0, 1e6);
    assert!(
        out.len() == 1 && out[0].inside && (out[0].value + 200.0).abs() < 2e-3,
        "{out:?}"
    );
}

#[test]
fn a_tilting_head_lifts_by_the_length_of_its_tool() {
    let machine = machine("ferrari-bc");
    let ends: [&[(u8, f64)]; 2] = [
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'B', -30.0), (b'C', 0.0)],
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'B', 30.0), (b'C', 0.0)],
    ];
    let leg = tcp_leg(&machine, 300.0, ends);
    // Z rises by 300 (1 - cos 30 deg) = 40.2 mm
    let out = found(&machine, &leg, b'Z', 1e6, 20.0);
    assert!(out.len() == 1 && out[0].inside, "{out:?}");
}

#[test]
fn an_axis_far_from_the_origin_carries_the_part_far() {
    // without the rows that would contradict the change
    let source = include_str!("../../../../samples/machines/mikron-ucp710.toml");
    let text = source.split("[[check]]").next().expect("a part").replacen(
        "dir = [1, 0, 0]\npoint = [0, 0, 0]",
        "dir = [1, 0, 0]\npoint = [0, 300, 0]",
        1,
    );
    let machine = load("far", &text).expect("a machine");
    let ends: [&[(u8, f64)]; 2] = [
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', -30.0), (b'C', 0.0)],
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 30.0), (b'C', 0.0)],
    ];
    let leg = tcp_leg(&machine, 0.0, ends);
    // Y leaves 300 - 300 cos 30 deg = 40.2 mm for 0
    let out = found(&machine, &leg, b'Y', 20.0, 1e6);
    assert!(out.len() == 1 && out[0].inside, "{out:?}");
}

#[test]
fn a_point_that_runs_outward_while_it_turns_is_followed() {
    let machine = machine("mikron-ucp710");
    let ends: [&[(u8, f64)]; 2] = [
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', -100.0), (b'A', -5.0), (b'C', 0.0)],
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 100.0), (b'A', 5.0), (b'C', 0.0)],
    ];
    let leg = tcp_leg(&machine, 0.0, ends);
    // |Y| is 8.7 mm at both ends and 0 between them
    let out = [
        found(&machine, &leg, b'Y', 6.5, 1e6),
        found(&machine, &leg, b'Y', 1e6, 6.5),
    ]
    .concat();
    assert!(out.len() == 1 && out[0].inside, "{out:?}");
}

/// The great circle between two tool axes at A60 passes the pole at 16.7 deg: A must dip although it ends where it began.
#[test]
fn a_rotary_axis_that_ends_where_it_began_may_move_on_a_great_circle() {
    let mut machine = machine("mikron-ucp710");
    machine.control.tcp_great_circle = true;
    let ends: [&[(u8, f64)]; 2] = [
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 200.0), (b'A', 60.0), (b'C', -80.0)],
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 200.0), (b'A', 60.0), (b'C', 80.0)],
    ];
    let leg = tcp_leg(&machine, 0.0, ends);
    // Z runs from 100 over 191.5 to 100
    let out = found(&machine, &leg, b'Z', 1e6, 50.0);
    assert!(
        out.len() == 1 && out[0].inside && (out[0].value - 191.5).abs() < 0.1,
        "{out:?}"
    );
}

#[test]
fn the_far_end_of_the_first_axis_is_a_pole_too() {
    let machine = machine("mikron-ucp710");
    let ends: [&[(u8, f64)]; 2] = [
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 170.0), (b'C', 0.0)],
        &[(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0), (b'A', 190.0), (b'C', 0.0)],
    ];
    let leg = tcp_leg(&machine, 0.0, ends);
    assert!(leg.pole_angle_min.abs() < 1e-12 && leg.end.expect("known").pole_angle > rad(9.0));
}

/// A length offset that comes into force in the block itself: the tip is that of the new length from the start on.
#[test]
fn a_new_tool_length_counts_from_the_start_of_the_block() {
    let machine = machine("mikron-ucp710");
    let at = |z: f64, a: f64| position(&[(b'X', 10.0), (b'Y', 20.0), (b'Z', z), (b'A', a), (b'C', 0.0)]);
    let bound = |first: f64| {
        let mut follower = Follower::new(&machine);
        // the joint Z is 150 whatever the length
        follower.follow(&Motion {
            tool_length_mm: first,
            ..words(Position::default(), at(150.0 - first, 0.0))
        });
        let leg = follower.follow(&Motion {
            tool_length_mm: 100.0,
            ..words(at(50.0, 0.0), at(50.0, 30.0))
        });
        tip_deviation(&machine, &leg, 0.01).expect("known")
    };
    assert_eq!(bound(0.0), bound(100.0));
}
