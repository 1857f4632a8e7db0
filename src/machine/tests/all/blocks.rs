//! Inside a block: bounds against dense sampling on random blocks of random machines with all orders of the chain.
use crate::common::{motion, position, words};
use crate::random::{Random, random_machine};
use trunnion_geometry::math::{cos, sin};
use trunnion_geometry::{Vec3, arc::Arc, deg};
use trunnion_interp::{Feed, Motion, MotionKind, Orientation, Position};
use trunnion_machine::{
    AxisKind, Excess, Follower, Joints, Leg, Limits, Machine, feed_limit, forward, inverse, limit_excess, tip_deviation,
};

const SAMPLES: usize = 800;

/// A random start and end: X Y Z in mm, C A in degrees; `turn` scales the rotary move.
fn ends(random: &mut Random, reach: f64, turn: f64) -> (Position, Position) {
    let mut place = |scale: f64, angle: f64, from: &[f64; 5]| {
        let mut values = [0.0; 5];
        for (i, value) in values.iter_mut().enumerate() {
            *value = from[i] + random.range(-1.0, 1.0) * if i < 3 { scale } else { angle };
        }
        values
    };
    let from = place(reach, 170.0, &[0.0; 5]);
    let to = place(reach * turn / 60.0, turn, &from);
    let as_position = |v: &[f64; 5]| position(&[(b'X', v[0]), (b'Y', v[1]), (b'Z', v[2]), (b'C', v[3]), (b'A', v[4])]);
    (as_position(&from), as_position(&to))
}

/// Follows from the start to the end of a motion.
pub(crate) fn leg(machine: &Machine, motion: &Motion) -> Option<Leg> {
    let mut follower = Follower::new(machine);
    let at_start = Motion {
        end: motion.start,
        start: Position::default(),
        kind: MotionKind::Linear,
        ..*motion
    };
    follower.follow(&at_start).end.ok()?;
    let leg = follower.follow(motion);
    leg.end.is_ok().then_some(leg)
}

fn between(from: &Joints, to: &Joints, t: f64) -> Joints {
    let mut joints = *from;
    for (value, end) in joints.iter_mut().zip(to) {
        *value += (end - *value) * t;
    }
    joints
}

fn joints_of(leg: &Leg) -> (Joints, Joints) {
    (
        leg.start.expect("known").joints,
        leg.end.as_ref().expect("known").joints,
    )
}

#[test]
fn deviation_bound_is_proven_and_tight() {
    let mut random = Random(1);
    let (mut judged, mut above) = (0, 0);
    for _ in 0..60 {
        let machine = random_machine(&mut random, false, "joint");
        for _ in 0..8 {
            let turn = [0.05, 1.0, 20.0, 170.0][random.below(4)];
            let (start, end) = ends(&mut random, 300.0, turn);
            let motion = Motion {
                tool_length_mm: random.range(0.0, 120.0),
                ..words(start, end)
            };
            let leg = leg(&machine, &motion).expect("all axes known");
            let found = tip_deviation(&machine, &leg, 0.01).expect("known");
            let (from, to) = joints_of(&leg);
            let tip = |t: f64| forward(&machine, &between(&from, &to, t), motion.tool_length_mm).tip;
            let (a, b) = (tip(0.0), tip(1.0));
            let truth = (0..=SAMPLES)
                .map(|i| {
                    let off = tip(i as f64 / SAMPLES as f64) - a;
                    let share = (off.dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
                    (off - (b - a) * share).norm()
                })
                .fold(0.0, f64::max);
            judged += 1;
            assert!(found.bound_mm >= truth, "bound {} truth {truth}", found.bound_mm);
            assert!(found.sampled_mm <= found.bound_mm && (0.0..=1.0).contains(&found.at));
            if found.bound_mm > 0.01 {
                above += 1;
                assert!(
                    found.bound_mm <= 1.2 * truth + 1e-4,
                    "bound {} truth {truth}",
                    found.bound_mm
                );
            }
        }
    }
    assert!(judged == 480 && above > 100, "{judged} {above}");
}

/// Solved joints along a TCP motion whose rotary joints run linearly, by inverse kinematics at each moment.
fn tcp_joints(machine: &Machine, leg: &Leg, tip: &dyn Fn(f64) -> Vec3, t: f64) -> Joints {
    let (from, to) = joints_of(leg);
    let mut joints = between(&from, &to, t);
    inverse(machine, &mut joints, &tip(t), leg.motion.tool_length_mm).expect("spans space");
    joints
}

fn straight_tip(leg: &Leg) -> impl Fn(f64) -> Vec3 + use<> {
    let (a, b) = (leg.start.expect("known").tip, leg.end.as_ref().expect("known").tip);
    move |t| a + (b - a) * t
}

/// A helix from the start of a motion; its end replaces the motion's.
pub(crate) fn with_arc(random: &mut Random, motion: &Motion) -> Motion {
    let start = motion.start.xyz().expect("known");
    let normal = random.direction();
    let spoke = normal.cross(&random.direction());
    let (radius, sweep, rise) = (spoke.norm() * 40.0, random.range(-6.0, 6.0), random.range(-5.0, 5.0));
    let radial = spoke.normalize();
    let turned = radial * cos(sweep) + normal.cross(&radial) * sin(sweep);
    let end = start + (turned - radial) * radius + normal * rise;
    let centre = start - radial * radius;
    let arc = Arc {
        start,
        end,
        centre,
        normal,
        sweep,
        radius_start: radius,
        radius_end: radius,
    };
    let mut motion = Motion {
        kind: MotionKind::Arc(Some(arc)),
        ..*motion
    };
    for axis in 0..3 {
        motion.end.set(axis, end[axis]);
    }
    motion
}

/// Joints along a leg at t.
type Along<'a> = Box<dyn Fn(f64) -> Joints + 'a>;

/// A random leg with TCP or as an arc, and its joints at any moment from inverse kinematics or the words' meaning.
fn curved<'a>(random: &mut Random, machine: &'a Machine, leg_out: &'a mut Option<Leg>, turn: f64) -> Option<Along<'a>> {
    let (start, end) = ends(random, 150.0, turn);
    let mut motion = Motion {
        tcp: true,
        tool_length_mm: random.range(0.0, 80.0),
        ..words(start, end)
    };
    let case = random.below(3);
    if case > 0 {
        motion = with_arc(random, &motion);
        motion.tcp = case == 1;
    }
    *leg_out = leg(machine, &motion);
    let leg = leg_out.as_ref()?;
    let (from, to) = joints_of(leg);
    Some(match (case, motion.kind) {
        (1, MotionKind::Arc(Some(arc))) => Box::new(move |t| tcp_joints(machine, leg, &|t| arc.point_at(t), t)),
        (2, MotionKind::Arc(Some(arc))) => Box::new(move |t| {
            let mut joints = between(&from, &to, t);
            for (letter, value) in [b'X', b'Y', b'Z'].into_iter().zip((arc.point_at(t) - arc.start).iter()) {
                let joint = machine.joint(letter).expect("axis");
                joints[joint] = from[joint] + value;
            }
            joints
        }),
        _ => {
            let tip = straight_tip(leg);
            Box::new(move |t| tcp_joints(machine, leg, &tip, t))
        }
    })
}

#[test]
fn feed_limit_holds_at_every_moment_and_is_tight() {
    let mut random = Random(2);
    let (mut judged, mut linear) = (0, 0);
    for round in 0..80 {
        let machine = random_machine(&mut random, round % 2 == 0, "joint");
        for _ in 0..5 {
            let turn = [0.01, 0.5, 10.0, 60.0][random.below(4)];
            let mut leg = None;
            let Some(along) = curved(&mut random, &machine, &mut leg, turn) else {
                continue;
            };
            let mut worst: f64 = 0.0;
            let step = 1e-5;
            for i in 0..=SAMPLES {
                let t = (i as f64 / SAMPLES as f64).clamp(step, 1.0 - step);
                let (before, after) = (along(t - step), along(t + step));
                for (joint, axis) in machine.axes.iter().enumerate() {
                    let rate = (after[joint] - before[joint]).abs() / (2.0 * step);
                    worst = worst.max(rate / axis.max_speed.expect("declared"));
                }
            }
            drop(along);
            let mut leg = leg.expect("known");
            let truth = 60.0 * leg.length / worst;
            leg.motion.feed = Feed::PerMinute(truth * 2.0);
            let Some(found) = feed_limit(&machine, &leg) else {
                assert!(!random_is_provable(&machine, turn), "no limit for a turn of {turn}");
                continue;
            };
            judged += 1;
            linear += usize::from(machine.axes[found.axis].kind == AxisKind::Linear);
            assert!(
                found.feed_mm_min <= truth * (1.0 + 1e-5),
                "limit {} truth {truth}",
                found.feed_mm_min
            );
            // where the linear axes lie in different places of the chain the bound is sound but may stay coarser
            let share = if machine.constants.shared_segment.is_some() {
                1.0 - 3e-3
            } else {
                0.9
            };
            assert!(
                found.feed_mm_min >= truth * share,
                "limit {} truth {truth}",
                found.feed_mm_min
            );
            let speed = found.axis_speed.expect("feed known");
            assert!(
                speed > found.axis_limit,
                "{speed} at twice the limit of {}",
                found.axis_limit
            );
            leg.motion.feed = Feed::PerMinute(truth * 0.1);
            let coarse = feed_limit(&machine, &leg).expect("limited");
            assert!(coarse.feed_mm_min <= truth * (1.0 + 1e-5) && coarse.feed_mm_min >= truth * 0.1);
        }
    }
    assert!(judged > 300 && linear > 100, "{judged} {linear}");
}

/// Whether the bound must exist: always where all linear axes lie in one place of the chain.
fn random_is_provable(machine: &Machine, turn: f64) -> bool {
    machine.constants.shared_segment.is_some() || turn < 5.0
}

#[test]
fn excursions_inside_a_block_are_found_and_no_others() {
    let mut random = Random(3);
    let (mut inside, mut clean) = (0, 0);
    for round in 0..80 {
        let mut machine = random_machine(&mut random, round % 2 == 0, "joint");
        for _ in 0..5 {
            let turn = [0.5, 10.0, 60.0][random.below(3)];
            let mut leg = None;
            let Some(along) = curved(&mut random, &machine, &mut leg, turn) else {
                continue;
            };
            let extremes: Vec<[f64; 2]> = (0..machine.axes.len())
                .map(|joint| {
                    let values = (0..=SAMPLES).map(|i| along(i as f64 / SAMPLES as f64)[joint]);
                    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)])
                })
                .collect();
            drop(along);
            let leg = leg.expect("known");
            let (from, to) = joints_of(&leg);
            for joint in 0..machine.axes.len() {
                if machine.axes[joint].kind == AxisKind::Rotary {
                    continue;
                }
                let [low, high] = extremes[joint];
                let bulge = high - from[joint].max(to[joint]);
                // through a posture where the linear axes do not span space joints run away without end
                if bulge > 1e4 {
                    continue;
                }
                let saved = machine.axes[joint].limits;
                // a limit between the ends and the peak, and one just above the peak
                machine.axes[joint].limits = Limits::Range(low - 1000.0, high - 0.3 * bulge);
                let mut out: Vec<Excess> = Vec::new();
                limit_excess(&machine, &leg, &mut out);
                out.retain(|e| e.axis == joint);
                if bulge > 1e-3 {
                    inside += 1;
                    assert!(out.len() == 1 && out[0].inside, "{out:?} for a bulge of {bulge}");
                    assert!((out[0].value - high).abs() < 2e-3 + 1e-4 * bulge, "{out:?} peak {high}");
                }
                machine.axes[joint].limits = Limits::Range(low - 1000.0, high + 2e-3 + 1e-4 * bulge);
                out.clear();
                limit_excess(&machine, &leg, &mut out);
                assert!(out.iter().all(|e| e.axis != joint), "{out:?} peak {high}");
                clean += 1;
                machine.axes[joint].limits = saved;
            }
        }
    }
    assert!(inside > 100 && clean > 500, "{inside} {clean}");
}

#[test]
fn limits_at_the_end_are_judged_without_a_stance() {
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let end = position(&[(b'X', 1000.0), (b'A', -31.0)]);
    let leg = Follower::new(machine).follow(&words(Position::default(), end));
    assert!(leg.end.is_err());
    let mut out = Vec::new();
    limit_excess(machine, &leg, &mut out);
    let letters: Vec<char> = out.iter().map(|e| char::from(machine.axes[e.axis].letter)).collect();
    assert_eq!(letters, ['A', 'X']);
    assert!((deg(out[0].value) + 31.0).abs() < 1e-9 && (deg(out[0].limit) + 30.0).abs() < 1e-9);
    assert_eq!((out[1].value, out[1].limit, out[1].inside), (1000.0, 355.0, false));
}

#[test]
fn an_arc_whose_rotary_axes_stand_is_an_arc() {
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let mut random = Random(4);
    let start = position(&[(b'X', 0.0), (b'Y', 0.0), (b'Z', 100.0), (b'C', 0.0), (b'A', 0.0)]);
    let flat = with_arc(&mut random, &words(start, start));
    let still = leg(machine, &flat).expect("known");
    assert_eq!(
        tip_deviation(machine, &still, 0.01).expect("an arc is an arc").bound_mm,
        0.0
    );
    let mut no_centre = motion();
    no_centre.kind = MotionKind::Arc(None);
    (no_centre.start, no_centre.end) = (start, flat.end);
    let no_centre = leg(machine, &no_centre).expect("known");
    assert_eq!(
        (
            tip_deviation(machine, &no_centre, 0.01),
            feed_limit(machine, &no_centre)
        ),
        (None, None)
    );
    assert_eq!(no_centre.motion.orientation, Orientation::Words);
}
