//! The formulas of the bounds, term by term: with a tolerance without end a bound is the formula itself (kinematics notes 3), and these
//! blocks make each of its terms count. Expected values are worked out here from lengths and angles alone.
use crate::common::{position, vector, words};
use trunnion_geometry::math::{asin, cos, hypot, sin};
use trunnion_geometry::{Vec3, arc::Arc, rad};
use trunnion_interp::{Motion, MotionKind, Position};
use trunnion_machine::{
    BlockPath, Follower, Leg, Machine, builtin, excursions, linear_travel, load, orientation_deviation,
    pivot_sensitivity_between, swept_deviation, tip_deviation,
};

/// C and A on the table, through the origin unless `a` says otherwise, then X Y Z; Y may be slanted.
fn table(a: &str, y: &str) -> Machine {
    let text = format!(
        "schema = \"ncmachine/1\"\naxis = [\n{{letter = \"C\", kind = \"rotary\", side = \"table\", sign = 1, limits = \"unbounded\", uncertainty = {{ point = 0.01, dir_arcsec = 20 }}}},\n\
         {{letter = \"A\", kind = \"rotary\", side = \"table\", sign = 1, limits = [-120, 120]{a}}},\n{{letter = \"X\", sign = 1, limits = [-900, 900]}},\n\
         {{letter = \"Y\", side = \"head\", sign = 1, dir = {y}, limits = [-900, 900]}},\n{{letter = \"Z\", side = \"head\", sign = 1, limits = [-900, 900]}},\n]\n"
    );
    load("table", &text).unwrap_or_else(|error| panic!("{error}"))
}

fn right_angled() -> Machine {
    table("", "[0, 1, 0]")
}

/// X Y Z in mm, A C in deg.
fn at([x, y, z, a, c]: [f64; 5]) -> Position {
    position(&[(b'X', x), (b'Y', y), (b'Z', z), (b'A', a), (b'C', c)])
}

fn follow(machine: &Machine, second: &Motion) -> Leg {
    let mut follower = Follower::new(machine);
    follower.follow(&Motion {
        start: Position::default(),
        end: second.start,
        kind: MotionKind::Linear,
        ..*second
    });
    follower.follow(second)
}

fn is(found: f64, wanted: f64) {
    assert!(
        (found - wanted).abs() <= 2e-9 * (1.0 + wanted.abs()),
        "{found}, not {wanted}"
    );
}

/// 8 times the bound of the tip's deviation: the bend itself.
fn tip_bend(machine: &Machine, motion: &Motion) -> f64 {
    let leg = follow(machine, motion);
    8.0 * tip_deviation(machine, &leg, 1e12).expect("known").bound_mm
}

/// An arc about Z from `start` by `sweep`, its radius growing, its height too.
fn arc(start: Vec3, radius: [f64; 2], sweep: f64, rise: f64) -> Arc {
    let centre = start - Vec3::x() * radius[0];
    Arc {
        start,
        end: centre + Vec3::new(cos(sweep), sin(sweep), 0.0) * radius[1] + Vec3::z() * rise,
        centre,
        normal: Vec3::z(),
        sweep,
        radius_start: radius[0],
        radius_end: radius[1],
    }
}

/// Joints along an arc while A and C go from `from` to `to`, deg.
fn along(arc: Arc, from: [f64; 2], to: [f64; 2]) -> Motion {
    let ends = [(arc.start, from), (arc.end, to)].map(|(point, [a, c])| at([point.x, point.y, point.z, a, c]));
    Motion {
        kind: MotionKind::Arc(Some(arc)),
        ..words(ends[0], ends[1])
    }
}

/// Largest rate and second derivative along such an arc: radius, widening and height run evenly.
fn rates(arc: &Arc) -> (f64, f64) {
    let (most, widening) = (arc.radius_start.max(arc.radius_end), arc.radius_end - arc.radius_start);
    let rise = arc.end.z - arc.start.z;
    let rate = hypot(most * arc.sweep, hypot(widening, rise));
    (rate, most * arc.sweep * arc.sweep + 2.0 * (widening * arc.sweep).abs())
}

#[test]
fn a_tip_without_tcp_bends_as_the_terms_say() {
    let machine = right_angled();
    let bend = |from, to| tip_bend(&machine, &words(at(from), at(to)));
    let turn = rad(10.0);
    // A alone: D^2 r
    is(
        bend([7.0, 30.0, 40.0, 0.0, 0.0], [7.0, 30.0, 40.0, 10.0, 0.0]),
        turn * turn * 50.0,
    );
    // a way of 20 mm outward, or inward: 2 D V + D^2 r at the far end
    let far = turn * turn * 50.0 + 2.0 * turn * 30.0;
    is(bend([7.0, 0.0, 20.0, 0.0, 0.0], [7.0, 0.0, 50.0, 10.0, 0.0]), far);
    is(bend([7.0, 0.0, 50.0, 0.0, 0.0], [7.0, 0.0, 20.0, 10.0, 0.0]), far);
    // C behind A: r of the tip from C at the end farther out, and above the chord by A's bend / 8
    let second = rad(25.0);
    for (from, to) in [
        ([0.0, 5.0, 40.0], [0.0, 5.0, 60.0]),
        ([0.0, 5.0, 60.0], [0.0, 5.0, 40.0]),
    ] {
        let [v1, b1] = {
            let r = hypot(5.0, 60.0);
            [20.0 + turn * r, 2.0 * turn * 20.0 + turn * turn * r]
        };
        // A turns by 10 deg from 0: the tip's distance from C is |Y cos A - Z sin A| with a positive word turning the part by -A
        let r = |p: [f64; 3], a: f64| {
            (p[1] * cos(a) + p[2] * sin(a))
                .abs()
                .max((p[1] * cos(a) - p[2] * sin(a)).abs())
        };
        let tip = |p: [f64; 3], a: f64| {
            let pose = trunnion_machine::forward(&machine, &[0.0, a, p[0], p[1], p[2], 0.0, 0.0, 0.0, 0.0], 0.0);
            assert!(pose.tip.y.abs() <= r(p, a) + 1e-9);
            hypot(pose.tip.x, pose.tip.y)
        };
        let r1 = tip(from, 0.0).max(tip(to, turn)) + b1 / 8.0;
        let wanted = b1 + 2.0 * second * v1 + second * second * r1;
        is(
            bend([from[0], from[1], from[2], 0.0, 0.0], [to[0], to[1], to[2], 10.0, 25.0]),
            wanted,
        );
    }
}

#[test]
fn an_arc_without_tcp_adds_its_rate_and_its_bend() {
    // Y slanted in the plane: the longest vector that words of length 1 can make is root(1 + 0.6) (Gershgorin)
    for (machine, gain) in [(right_angled(), 1.0), (table("", "[0.6, 0.8, 0]"), 1.6_f64.sqrt())] {
        let turn = rad(8.0);
        for arc in [
            arc(Vec3::new(10.0, 0.0, 30.0), [10.0, 10.0], 1.1, 0.0),
            arc(Vec3::new(10.0, 0.0, 30.0), [10.0, 25.0], 1.1, 0.0),
            arc(Vec3::new(10.0, 0.0, 30.0), [25.0, 10.0], -2.5, 14.0),
        ] {
            let found = tip_bend(&machine, &along(arc, [0.0, 0.0], [8.0, 0.0]));
            let (rate, bend) = rates(&arc);
            let skew = |p: Vec3| {
                if gain > 1.0 {
                    Vec3::new(p.x + 0.6 * p.y, 0.8 * p.y, p.z)
                } else {
                    p
                }
            };
            let (from, to) = (skew(arc.start), skew(arc.end));
            let rate = (to - from).norm() + gain * (rate + (arc.end - arc.start).norm());
            let own = gain * bend;
            let r = hypot(from.y, from.z).max(hypot(to.y, to.z)) + own / 8.0;
            // the programmed segment bends too
            is(found, own + 2.0 * turn * rate + turn * turn * r + own);
        }
    }
}

/// A tip 100 mm above A that hardly moves while A turns: the way bends by D^2 r and no less, so that nothing may be left out of the bound.
#[test]
fn nothing_of_a_bend_may_be_left_out_beside_an_arc() {
    let machine = right_angled();
    let small = arc(Vec3::new(0.001, 0.0, 100.0), [0.001, 0.001], 0.5, 0.0);
    let leg = follow(&machine, &along(small, [-3.0, 0.0], [3.0, 0.0]));
    let truth = 100.0 * (1.0 - cos(rad(3.0)));
    for share in [0.9, 0.95, 0.99, 1.0] {
        let found = tip_deviation(&machine, &leg, truth * share).expect("known");
        assert!(found.bound_mm >= truth - 0.002, "{found:?}, truth {truth}");
    }
}

/// Under TCP along an arc the way bends as the arc; joints on it as the chain says.
#[test]
fn a_way_bends_as_the_terms_say() {
    let machine = right_angled();
    let spiral = arc(Vec3::new(10.0, 0.0, 30.0), [10.0, 25.0], 1.1, 14.0);
    let led = Motion {
        tcp: true,
        ..along(spiral, [0.0, 0.0], [8.0, 0.0])
    };
    let leg = follow(&machine, &led);
    let (_, bend) = rates(&spiral);
    is(BlockPath::new(&machine, &leg).expect("known").tip_bend(), bend);
    let leg = follow(&machine, &along(spiral, [0.0, 0.0], [8.0, 0.0]));
    let way = BlockPath::new(&machine, &leg).expect("known");
    // X Y Z each no faster than the arc, each bent as it: their sums in the segment behind A
    let (rate, _) = rates(&spiral);
    let straight = (spiral.end - spiral.start).abs();
    let (rate, own) = (straight.iter().map(|way| way.max(rate)).sum::<f64>(), 3.0 * bend);
    let r = hypot(spiral.start.y, spiral.start.z).max(hypot(spiral.end.y, spiral.end.z)) + own / 8.0;
    let turn = rad(8.0);
    is(way.tip_bend(), own + 2.0 * turn * rate + turn * turn * r);
}

/// Vectors that run joint-linear from A10 C0 to A40 C50: Q of the tool axis, and of the body.
#[test]
fn a_tool_axis_bends_as_the_terms_say() {
    let machine = right_angled();
    let axis = |a: f64, c: f64| trunnion_machine::tool_axis_at(&machine, [rad(c), rad(a)]);
    for [from, to] in [[[10.0, 0.0], [40.0, 50.0]], [[40.0, 0.0], [10.0, 50.0]]] {
        let [from, to]: [[f64; 2]; 2] = [from, to];
        let first = vector(Position::default(), [0.0, 0.0, 50.0], axis(from[0], from[1]));
        let second = vector(first.end, [3.0, 0.0, 50.0], axis(to[0], to[1]));
        let mut follower = Follower::new(&machine);
        follower.follow(&first);
        let leg = follower.follow(&second);
        let [da, dc] = [rad(30.0), rad(50.0)];
        is(leg.rotary_change[0], dc);
        // the farthest of the axis from C at an end, or above the chord
        let far = sin(rad(40.0)) + da * da / 8.0;
        let bend = da * da + 2.0 * dc * da + dc * dc * far;
        let found = orientation_deviation(&machine, &leg, 10.0).expect("known").bound;
        is(found, asin(bend / 8.0));
        let angle = trunnion_geometry::math::angle_between(&axis(from[0], from[1]), &axis(to[0], to[1]));
        let body = swept_deviation(&machine, &leg, 70.0, 1e12).expect("known").bound_mm;
        is(body, 70.0 * (bend + angle * angle) / 8.0);
    }
}

/// C alone, near the pole: the axis runs round a small circle, which leaves the great circle by nearly the whole Q / 8.
#[test]
fn nothing_of_the_bend_of_a_tool_axis_may_be_left_out() {
    let machine = right_angled();
    let axis = |a: f64, c: f64| trunnion_machine::tool_axis_at(&machine, [rad(c), rad(a)]);
    let first = vector(Position::default(), [0.0, 0.0, 50.0], axis(8.0, -5.0));
    let second = vector(first.end, [3.0, 0.0, 50.0], axis(8.0, 5.0));
    let mut follower = Follower::new(&machine);
    follower.follow(&first);
    let leg = follower.follow(&second);
    let whole = rad(10.0) * rad(10.0) * sin(rad(8.0)) / 8.0;
    // half way the axis stands at A8, the great circle at the angle whose tangent is tan 8 cos 5
    let truth = rad(8.0) - trunnion_geometry::math::atan2(sin(rad(8.0)) * cos(rad(5.0)), cos(rad(8.0)));
    assert!(truth > 0.98 * whole, "{truth} {whole}");
    for share in [0.91, 0.94, 0.97, 1.0] {
        let found = orientation_deviation(&machine, &leg, whole * share).expect("known");
        assert!(found.bound >= truth * (1.0 - 1e-12), "{found:?}, truth {truth}");
        let body = swept_deviation(&machine, &leg, 100.0, 100.0 * truth * share).expect("known");
        assert!(body.bound_mm >= 99.0 * truth, "{body:?}, truth {truth}");
    }
    // half round a cone, where A has no other posture: a sine above 1 bounds nothing
    let machine = builtin("mikron-ucp710").expect("built in");
    let axis = |a: f64, c: f64| trunnion_machine::tool_axis_at(machine, [rad(c), rad(a)]);
    let first = vector(Position::default(), [0.0, 0.0, 50.0], axis(60.0, -89.5));
    let second = vector(first.end, [3.0, 0.0, 50.0], axis(60.0, 89.5));
    let mut follower = Follower::new(machine);
    follower.follow(&first);
    let leg = follower.follow(&second);
    is(
        orientation_deviation(machine, &leg, 10.0).expect("known").bound,
        core::f64::consts::PI,
    );
}

/// The bound that needs no turning at all: distances from the origin, twice those of the centres, the tool.
#[test]
fn the_rough_bound_of_the_linear_axes_counts_every_distance() {
    for (machine, row, centre) in [
        (right_angled(), 1.0, 0.0),
        (table(", point = [0, 30, 40]", "[0, 1, 0]"), 1.0, 100.0),
        // the inverse of the columns (1, 0, 0), (0.6, 0.8, 0), (0, 0, 1)
        (
            table("", "[0.6, 0.8, 0]"),
            (1.0 + 0.5625 + 1.5625 + 1.0_f64).sqrt(),
            0.0,
        ),
    ] {
        let led = |from, to| Motion {
            tcp: true,
            tool_length_mm: 60.0,
            ..words(at(from), at(to))
        };
        for (from, to) in [
            ([0.0, 30.0, 40.0, 0.0, 0.0], [0.0, 0.0, 20.0, 5.0, 9.0]),
            ([0.0, 0.0, 20.0, 5.0, 9.0], [0.0, 30.0, 40.0, 0.0, 0.0]),
        ] {
            let leg = follow(&machine, &led(from, to));
            let way = hypot(30.0, 20.0);
            let (turned, radius) = (rad(14.0), 50.0 + 60.0 + centre);
            let (rate, bend) = (
                row * (way + turned * radius),
                row * turned * (2.0 * way + turned * radius),
            );
            let ends = [leg.start.expect("known"), leg.end.clone().expect("known")];
            let chord2: f64 = (2..5)
                .map(|joint| (ends[1].joints[joint] - ends[0].joints[joint]).powi(2))
                .sum();
            let found = linear_travel(&machine, &leg, 1e12).expect("known").most_mm;
            is(found, rate.min((chord2 + bend * bend / 12.0).sqrt()));
        }
    }
}

/// C turns by 6 deg about a tip 300 mm out: X rises by 300 (1 - cos 3 deg) between two equal ends, which is all of D^2 r / 8.
#[test]
fn nothing_of_the_bend_of_a_linear_axis_may_be_left_out() {
    let machine = right_angled();
    let led = Motion {
        tcp: true,
        ..words(at([300.0, 0.0, 0.0, 0.0, -3.0]), at([300.0, 0.0, 0.0, 0.0, 3.0]))
    };
    let leg = follow(&machine, &led);
    let rise = 300.0 * (1.0 - cos(rad(3.0)));
    let x = machine.joint(b'X').expect("an axis");
    for share in [0.91, 0.95, 0.99] {
        let found = excursions(&machine, &leg, rise * share);
        assert!(
            found.iter().any(|one| one.axis == x && one.upward),
            "{share}: {found:?}"
        );
    }
    let mut narrow = machine.clone();
    for share in [0.91, 0.95, 0.99] {
        narrow.axes[x].limits = trunnion_machine::Limits::Range(-900.0, 300.0 * cos(rad(3.0)) + rise * share);
        let mut out = Vec::new();
        trunnion_machine::limit_excess(&narrow, &leg, &mut out);
        assert!(out.iter().any(|one| one.axis == x && one.inside), "{share}: {out:?}");
    }
    // an arc of joints: the height above its chord is all of R s^2 / 8
    let flat = arc(Vec3::new(0.0, 0.0, 0.0), [500.0, 500.0], 0.06, 0.0);
    let flat = Arc {
        start: flat.centre + Vec3::new(cos(0.03), -sin(0.03), 0.0) * 500.0,
        end: flat.centre + Vec3::new(cos(0.03), sin(0.03), 0.0) * 500.0,
        ..flat
    };
    let leg = follow(&machine, &along(flat, [0.0, 0.0], [0.0, 0.0]));
    let height = 500.0 * (1.0 - cos(0.03));
    for share in [0.91, 0.95, 0.99] {
        let found = excursions(&machine, &leg, height * share);
        assert!(
            found.iter().any(|one| one.axis == x && one.upward),
            "{share}: {found:?}"
        );
    }
}

/// C is known to 0.01 mm and 20 seconds of arc. Half sines of the turn: at an end, or at half a turn between them.
#[test]
fn uncertainty_counts_the_worst_turn_and_the_longer_arm() {
    let machine = table(", point = [0, 50, 0]", "[0, 1, 0]");
    let off = |from: [f64; 5], to: [f64; 5]| {
        let joints = |[x, y, z, a, c]: [f64; 5]| [rad(c), rad(a), x, y, z, 0.0, 0.0, 0.0, 0.0];
        let found = pivot_sensitivity_between(&machine, &joints(from), &joints(to), 30.0);
        assert_eq!((found.len(), found[0].letter), (1, b'C'));
        (found[0].of_point_mm, found[0].tip_mm)
    };
    for (from, to, half) in [
        (-30.0, 20.0, sin(rad(15.0))),
        (20.0, -30.0, sin(rad(15.0))),
        (170.0, 190.0, 1.0),
        (-190.0, -170.0, 1.0),
        (-200.0, -181.0, sin(rad(90.5))),
        (181.0, 300.0, sin(rad(90.5))),
        (539.0, 541.0, 1.0),
        (370.0, 400.0, sin(rad(20.0))),
        (-539.0, -400.0, sin(rad(90.5))),
        (0.0, 720.0, 1.0),
    ] {
        let (point, _) = off([0.0, 0.0, 0.0, 0.0, from], [0.0, 0.0, 0.0, 0.0, to]);
        is(point, 0.02 * half);
    }
    // the tip stands 30 mm below the nose; A turns it about Y50 by 90 deg: (0, 0, 70) goes to (0, -20, -50) or (0, 120, 50)
    let arm = |from: [f64; 5], to: [f64; 5]| {
        let (point, tip) = off(from, to);
        (tip - point) / (2.0 * sin(rad(30.0)) * rad(20.0 / 3600.0))
    };
    let near = [0.0, 0.0, 100.0, 0.0, 60.0];
    let far = [40.0, 0.0, 100.0, 0.0, 60.0];
    is(arm(near, far), hypot(40.0, 70.0));
    is(arm(far, near), hypot(40.0, 70.0));
    let turned = arm([0.0, 0.0, 100.0, 90.0, 60.0], [0.0, 0.0, 100.0, 90.0, 60.0]);
    let tip = trunnion_machine::forward(&machine, &[0.0, rad(90.0), 0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 0.0], 30.0).tip;
    is(turned, tip.norm());
}

/// What the chain of a built-in machine does to a bound under TCP is held to by the soundness tests; this one holds a spiral's slowest
/// moment: the feed limit is that of the moment at which the tip runs slowest.
#[test]
fn on_a_spiral_the_slowest_moment_carries_the_feed() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let spiral = arc(Vec3::new(10.0, 0.0, 30.0), [10.0, 30.0], 2.0, 0.0);
    let led = Motion {
        tcp: true,
        ..along(spiral, [20.0, 0.0], [20.0, 300.0])
    };
    let leg = follow(machine, &led);
    let limit = trunnion_machine::feed_limit_tight(machine, &leg).expect("known");
    let c = machine.joint(b'C').expect("an axis");
    assert_eq!(limit.axis, c);
    // C turns evenly, 300 deg a block; at its start the tip runs root(20^2 + 20^2) mm a block
    let speed = machine.axes[c].max_speed.expect("declared");
    is(limit.feed_mm_min, 60.0 * hypot(20.0, 20.0) * speed / rad(300.0));
    is(
        limit.axis_speed.expect("a feed"),
        rad(300.0) * 2000.0 / (60.0 * hypot(20.0, 20.0)),
    );
}
