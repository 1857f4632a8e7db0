//! Length of the linear joints' path, and how far an axis runs beyond its ends.
use crate::common::{motion, position};
use trunnion_geometry::math::sin;
use trunnion_geometry::rad;
use trunnion_interp::{Motion, Position};
use trunnion_machine::{Follower, Leg, Machine, builtin, excursions, linear_travel};

fn leg(tcp: bool, from: &[(u8, f64)], to: &[(u8, f64)]) -> (&'static Machine, Leg) {
    let machine = builtin("mikron-ucp710").expect("built in");
    let mut follower = Follower::new(machine);
    let [from, to] = [position(from), position(to)];
    let go = |start: Position, end: Position| Motion {
        tcp,
        start,
        end,
        ..motion()
    };
    follower.follow(&go(Position::default(), from));
    (machine, follower.follow(&go(from, to)))
}

/// The tip stands 100 mm above A while A turns from -30 to 90 deg: Y and Z run along an arc of 100 mm.
#[test]
fn a_standing_tip_asks_for_an_arc_of_the_axes() {
    let at = |a: f64| [(b'X', 0.0), (b'Y', 0.0), (b'Z', 100.0), (b'A', a), (b'C', 0.0)];
    let (machine, leg) = leg(true, &at(-30.0), &at(90.0));
    let found = linear_travel(machine, &leg, 0.0).expect("known");
    let truth = 100.0 * rad(120.0);
    assert!(
        found.least_mm <= truth && found.most_mm >= truth && found.most_mm <= found.least_mm * 1.001,
        "{found:?} for {truth}"
    );
    // Z runs from 86.6 over 100 to 0
    let out = excursions(machine, &leg, 1.0);
    assert_eq!(out.len(), 1, "{out:?}");
    assert!(out[0].upward && machine.axes[out[0].axis].letter == b'Z');
    assert!(
        (out[0].beyond_mm - 100.0 * (1.0 - sin(rad(60.0)))).abs() < 2e-3,
        "{out:?}"
    );
    assert_eq!(excursions(machine, &leg, 14.0), []);
}

#[test]
fn enough_settles_it_early_and_without_tcp_the_way_is_straight() {
    let from = [(b'X', 0.0), (b'Y', 0.0), (b'Z', 100.0), (b'A', 20.0), (b'C', 0.0)];
    let to = [(b'X', 30.0), (b'Y', 40.0), (b'Z', 100.0), (b'A', 21.0), (b'C', 1.0)];
    let (machine, under_tcp) = leg(true, &from, &to);
    let coarse = linear_travel(machine, &under_tcp, 250.0).expect("known");
    assert!(coarse.most_mm <= 250.0 && coarse.most_mm > coarse.least_mm);
    let (machine, straight) = leg(false, &from, &to);
    let found = linear_travel(machine, &straight, 0.0).expect("known");
    assert_eq!((found.least_mm, found.most_mm), (50.0, 50.0));
}
