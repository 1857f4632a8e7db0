//! Length of the linear joints' path, and how far an axis runs beyond its ends.
use crate::common::{motion, position, words};
use trunnion_geometry::math::sin;
use trunnion_geometry::{Vec3, rad};
use trunnion_interp::{Motion, MotionKind, Position};
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

/// The tip is 100 mm above A while A turns from -30 to 90 deg: Y and Z move along an arc of 100 mm.
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

/// Halving finds the threshold that is not decided; on either side of it every other is, down to a hundred millionth of the length.
#[test]
fn a_threshold_is_decided_or_lies_between_the_bounds() {
    let at = |x: f64, a: f64, c: f64| [(b'X', x), (b'Y', 20.0), (b'Z', 100.0), (b'A', a), (b'C', c)];
    let (machine, leg) = leg(true, &at(0.0, 10.0, 0.0), &at(3.0, 70.0, 50.0));
    let asked = |enough: f64| linear_travel(machine, &leg, enough).expect("known");
    let coarse = asked(0.0);
    let (mut low, mut high) = (coarse.least_mm, coarse.most_mm);
    let open = loop {
        let middle = 0.5 * (low + high);
        let found = asked(middle);
        if found.most_mm <= middle {
            high = middle;
        } else if found.least_mm > middle {
            low = middle;
        } else {
            break middle;
        }
        assert!(high - low > 1e-12, "nothing is left open: {low} {high}");
    };
    let found = asked(open);
    assert!(found.most_mm - found.least_mm < 1e-5, "{found:?}");
    let (less, more) = (open * (1.0 - 2e-7), open * (1.0 + 2e-7));
    assert!(asked(less).least_mm > less && asked(more).most_mm <= more, "{found:?}");
    // an arc of 100 mm * 120 deg = 209.4395 mm about A, known at once
    let at = |a: f64| [(b'X', 0.0), (b'Y', 0.0), (b'Z', 100.0), (b'A', a), (b'C', 0.0)];
    let (machine, arc) = self::leg(true, &at(-30.0), &at(90.0));
    let truth = 100.0 * rad(120.0);
    assert!(
        linear_travel(machine, &arc, truth * (1.0 + 1e-12))
            .expect("known")
            .most_mm
            <= truth * (1.0 + 1e-12)
    );
}

/// A rapid whose axes run each for itself has no path between its ends.
#[test]
fn a_dogleg_has_no_length_and_no_deviation() {
    let mut machine = builtin("mikron-ucp710").expect("built in").clone();
    machine.control.rapid = trunnion_machine::RapidPath::Dogleg;
    let mut follower = Follower::new(&machine);
    let from = position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 100.0), (b'A', 0.0), (b'C', 0.0)]);
    let to = position(&[(b'X', 30.0), (b'Y', 0.0), (b'Z', 100.0), (b'A', 20.0), (b'C', 30.0)]);
    let rapid = |start: Position, end: Position| Motion {
        kind: trunnion_interp::MotionKind::Rapid,
        tcp: true,
        start,
        end,
        ..motion()
    };
    follower.follow(&rapid(Position::default(), from));
    let leg = follower.follow(&rapid(from, to));
    assert!(leg.end.is_ok());
    assert_eq!(linear_travel(&machine, &leg, 1.0), None);
    assert_eq!(trunnion_machine::tip_deviation(&machine, &leg, 1.0), None);
    assert_eq!(trunnion_machine::swept_deviation(&machine, &leg, 50.0, 1.0), None);
    assert_eq!(trunnion_machine::orientation_deviation(&machine, &leg, 1.0), None);
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

/// A quarter of a circle under tool centre point control, in four pieces: root(chord^2 + Q^2 h^4 / 12) each, where each of three axes may
/// bend by r sweep^2.
#[test]
fn an_arc_in_four_pieces_is_as_long_as_the_formula_says() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let at = |x: f64, y: f64| position(&[(b'X', x), (b'Y', y), (b'Z', 50.0), (b'A', 0.0), (b'C', 0.0)]);
    let (radius, sweep) = (10.0, std::f64::consts::FRAC_PI_2);
    let arc = trunnion_geometry::arc::Arc {
        start: Vec3::new(radius, 0.0, 50.0),
        end: Vec3::new(0.0, radius, 50.0),
        centre: Vec3::new(0.0, 0.0, 50.0),
        normal: Vec3::z(),
        sweep,
        radius_start: radius,
        radius_end: radius,
    };
    let led = |motion: Motion| Motion { tcp: true, ..motion };
    let first = led(words(Position::default(), at(radius, 0.0)));
    let second = Motion {
        kind: MotionKind::Arc(Some(arc)),
        ..led(words(at(radius, 0.0), at(0.0, radius)))
    };
    let mut follower = Follower::new(machine);
    follower.follow(&first);
    let leg = follower.follow(&second);
    let found = linear_travel(machine, &leg, 1e9).expect("known");
    let chord = 2.0 * radius * sin(sweep / 8.0);
    let bend = 3f64.sqrt() * radius * sweep * sweep / 16.0;
    let most = 4.0 * (chord * chord + bend * bend / 12.0).sqrt();
    assert!((found.least_mm - 4.0 * chord).abs() < 1e-9, "{found:?}");
    assert!((found.most_mm - most).abs() < 1e-9, "{found:?}, not {most}");
}
