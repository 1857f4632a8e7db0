//! The machine moves without a motion of the program (a tool change): the next motion begins where its start says, or nowhere known.
use crate::common::{position, vector, words};
use trunnion_geometry::Vec3;
use trunnion_interp::{Motion, Position};
use trunnion_machine::{Follower, Leg, Machine, builtin};

fn mill() -> &'static Machine {
    builtin("mill-3axis").expect("built in")
}

fn at(x: f64, y: f64, z: f64) -> Position {
    position(&[(b'X', x), (b'Y', y), (b'Z', z)])
}

fn moved(motion: &Motion, relocations: u32) -> Motion {
    Motion { relocations, ..*motion }
}

fn z(machine: &Machine, stance: Option<&trunnion_machine::Stance>) -> Option<f64> {
    Some(stance?.joints[machine.joint(b'Z').expect("an axis")])
}

#[test]
fn a_motion_begins_where_the_tool_change_left_the_axes() {
    let mut follower = Follower::new(mill());
    let mut short: Option<Box<Leg>> = None;
    let mut both = |motion: Motion| {
        let mut other = follower.clone();
        other.follow_into(&motion, &mut short);
        let leg = follower.follow(&motion);
        assert_eq!(format!("{:?}", short.as_deref()), format!("{:?}", Some(&leg)));
        leg
    };
    both(words(Position::default(), at(0.0, 0.0, 50.0)));
    let leg = both(moved(&words(at(0.0, 0.0, 300.0), at(1.0, 0.0, 300.0)), 1));
    assert_eq!(z(mill(), leg.start.as_ref()), Some(300.0));
    assert_eq!(z(mill(), leg.end.as_ref().ok()), Some(300.0));
    let leg = both(moved(&words(at(1.0, 0.0, 300.0), at(2.0, 0.0, 300.0)), 1));
    assert_eq!(z(mill(), leg.start.as_ref()), Some(300.0));
    // where it went to is not known
    let leg = both(moved(&words(Position::default(), at(2.0, 0.0, 100.0)), 2));
    assert!(leg.start.is_none() && leg.end.is_ok());
    let lost = position(&[(b'X', 2.0)]);
    let leg = both(moved(&words(lost, position(&[(b'X', 3.0)])), 3));
    assert!(leg.start.is_none() && leg.end.is_err());
}

/// Rotary axes stay; the tip of a guided tool is not where it was.
#[test]
fn rotary_axes_stay_where_they_are() {
    let mikron = builtin("mikron-ucp710").expect("built in");
    let place = |z: f64| position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', z), (b'A', -20.0), (b'C', 30.0)]);
    let mut follower = Follower::new(mikron);
    follower.follow(&words(Position::default(), place(50.0)));
    let leg = follower.clone().follow(&moved(&words(place(200.0), place(200.0)), 1));
    let start = leg.start.expect("known");
    assert_eq!(z(mikron, Some(&start)), Some(200.0));
    assert!((start.joints[mikron.joint(b'A').expect("an axis")].to_degrees() + 20.0).abs() < 1e-9);
    let mut guided = vector(Position::default(), [0.0, 0.0, 10.0], Vec3::new(0.0, 0.3, 1.0));
    guided.relocations = 1;
    let leg = follower.follow(&guided);
    assert!(leg.start.is_none() && leg.end.is_ok());
}
