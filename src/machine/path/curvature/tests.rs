//! The terms of the bounds, one by one.
use super::{Carried, JointPath, Machine, Turn};
use core::fmt::Write;
use trunnion_geometry::{Mat3, Vec3};

fn turned(spin: (f64, f64), rate: f64, bend: f64) -> (f64, f64) {
    let still = Turn {
        axis: Vec3::new(0.0, 0.0, 1.0),
        sin: 0.0,
        cos: 1.0,
    };
    let mut point = Carried {
        start: Vec3::new(3.0, 0.0, 0.0),
        end: Vec3::new(0.0, 4.0, 7.0),
        rate,
        bend,
        length: 0.5,
    };
    point.turn(spin, &Vec3::zeros(), &still, &still, |_, arm| *arm);
    (point.rate, point.bend)
}

#[test]
fn turning_adds_what_the_notes_say() {
    // radius 4 at the end, 4.25 above the chord of a piece of half a block with |W''| <= 8
    assert_eq!(turned((2.0, 0.0), 0.0, 0.0), (8.0, 16.0));
    assert_eq!(turned((2.0, 5.0), 0.0, 0.0), (8.0, 36.0));
    assert_eq!(turned((2.0, 5.0), 1.0, 0.0), (9.0, 40.0));
    assert_eq!(turned((2.0, 0.0), 1.0, 8.0), (9.5, 29.0));
    assert_eq!(turned((0.0, 0.0), 1.0, 8.0), (1.0, 8.0));
}

fn load(axes: &[(&str, &str)]) -> Machine {
    let mut text = String::from("schema = \"ncmachine/1\"\naxis = [\n");
    for (letter, more) in axes {
        let rotary = if "AC".contains(letter) {
            "kind = \"rotary\", limits = \"unbounded\","
        } else {
            "limits = [-900, 900],"
        };
        let _ = writeln!(
            text,
            "{{letter = \"{letter}\", {rotary} side = \"table\", sign = 1{more}}},"
        );
    }
    crate::load("test", &(text + "]\n")).unwrap_or_else(|error| panic!("{error}"))
}

/// Led from start to end; X Y Z and U V W in mm, A C in deg.
fn bends(machine: &Machine, tool_length: f64, ends: [&[(u8, f64)]; 2]) -> (Vec3, Vec3) {
    let [start, end] = ends.map(|words| {
        let mut position = trunnion_interp::Position::default();
        for &(letter, value) in words {
            let axis = trunnion_interp::AxisLetter::new(letter).expect("an axis");
            position.set(usize::from(axis.0), value);
        }
        position
    });
    let led = |start, end| trunnion_interp::Motion {
        tcp: true,
        feed: trunnion_interp::Feed::PerMinute(1.0),
        tool_length_mm: tool_length,
        ..trunnion_interp::Motion::line(start, end)
    };
    let mut follower = crate::Follower::new(machine);
    follower.follow(&led(trunnion_interp::Position::default(), start));
    let leg = follower.follow(&led(start, end));
    JointPath::new(machine, &leg).expect("known").bends(0.0, 1.0)
}

fn all(found: &Vec3, wanted: f64) {
    assert!(
        found
            .iter()
            .all(|value| (value - wanted).abs() <= 1e-9 * (1.0 + wanted)),
        "{found:?}, not {wanted}"
    );
}

/// V before C, X Y Z and U between C and A, W behind A: every shift and both turns count.
#[test]
fn idle_axes_and_turns_on_both_sides_of_the_solved_ones_count() {
    let machine = load(&[
        ("V", ", dir = [1, 0, 0]"),
        ("C", ""),
        ("X", ""),
        ("Y", ""),
        ("Z", ""),
        ("U", ", dir = [1, 0, 0]"),
        ("A", ", point = [0, 0, 11]"),
        ("W", ", dir = [0, 0, 1]"),
    ]);
    assert_eq!(machine.constants.shared_segment, Some(1));
    let from: &[(u8, f64)] = &[
        (b'X', 10.0),
        (b'Y', 0.0),
        (b'Z', 5.0),
        (b'U', 1.0),
        (b'V', 2.0),
        (b'W', 3.0),
        (b'A', 0.0),
        (b'C', 0.0),
    ];
    let to: &[(u8, f64)] = &[
        (b'X', 40.0),
        (b'Y', 0.0),
        (b'Z', 5.0),
        (b'U', 8.0),
        (b'V', 15.0),
        (b'W', 22.0),
        (b'A', 10.0),
        (b'C', 20.0),
    ];
    let (rates, bends) = bends(&machine, 0.0, [from, to]);
    let (da, dc) = (trunnion_geometry::rad(10.0), trunnion_geometry::rad(20.0));
    // the tip less V: from 8 to 25 mm off C, at most as fast as both together
    let (way, off) = (30.0 + 13.0, 25.0);
    // the tool's point: W from 3 to 22 mm, A at 11 mm
    let (quill, arm) = (19.0, 11.0);
    all(&rates, way + dc * off + quill + da * arm + 7.0);
    all(
        &bends,
        2.0 * dc * way + dc * dc * off + 2.0 * da * quill + da * da * arm,
    );
}

/// X before C, Y and Z behind it: J turns. J^-1 has the norm root 3 at the start, J' root 2 D, J'' root 2 D^2.
#[test]
fn solved_axes_in_different_places_are_bounded_by_the_turn_of_their_directions() {
    let machine = load(&[
        ("X", ""),
        ("C", ", point = [30, 0, 0]"),
        ("A", ""),
        ("Y", ""),
        ("Z", ""),
    ]);
    assert_eq!(machine.constants.shared_segment, None);
    let from: &[(u8, f64)] = &[(b'X', 10.0), (b'Y', 20.0), (b'Z', 5.0), (b'A', 0.0), (b'C', 0.0)];
    let to: &[(u8, f64)] = &[(b'X', 14.0), (b'Y', 23.0), (b'Z', 5.0), (b'A', 0.0), (b'C', 10.0)];
    for (from, to, turned) in [(from, to, false), (to, from, true)] {
        let (rates, bends) = bends(&machine, 0.0, [from, to]);
        let d = trunnion_geometry::rad(10.0);
        let (spin, spin_bend) = (2.0_f64.sqrt() * d, 2.0_f64.sqrt() * d * d);
        // the point of the tool turns about C, 30 mm away
        let (rate, bend) = (5.0 + 30.0 * d, 30.0 * d * d);
        let (sin, cos) = trunnion_geometry::math::sin_cos(d);
        let at = |c: f64, s: f64| Vec3::new(30.0 - 30.0 * c, -30.0 * s, 0.0);
        // which way C turns the part decides its sign, not its distance
        let point = |sign: f64| at(cos, sign * sin);
        let near = Vec3::new(10.0, 20.0, 5.0).norm();
        let far = [1.0, -1.0].map(|sign| (Vec3::new(14.0, 23.0, 5.0) - point(sign)).norm());
        let norm = if turned {
            // J at the start is turned by C: X stays, Y is turned in the plane
            let column = [1.0, -1.0].map(|sign| {
                let inverse = Mat3::from_columns(&[Vec3::x(), Vec3::new(-sign * sin, cos, 0.0), Vec3::z()]);
                inverse.try_inverse().expect("spans").norm()
            });
            assert!((column[0] - column[1]).abs() < 1e-12);
            column[0]
        } else {
            3.0_f64.sqrt()
        };
        let k = norm / (1.0 - norm * spin);
        let wanted = far.map(|far| {
            let size = k * (near.max(far) + bend / 8.0);
            let rate = k * (rate + spin * size);
            (rate, k * (bend + 2.0 * spin * rate + spin_bend * size))
        });
        let hit = wanted
            .iter()
            .any(|(rate, bend)| (rates.x - rate).abs() <= 1e-9 * rate && (bends.x - bend).abs() <= 1e-9 * bend);
        assert!(hit, "{rates:?} {bends:?}, not {wanted:?}");
    }
}
