//! Under tool centre point control, along lines, helices and spirals, on all built-in machines and random chains: way of the linear axes,
//! highest feed, excursions, strays of tool axis and body, against dense sampling. `TRUNNION_BLOCKS` as in `soundness`.
use crate::blocks::with_arc;
use crate::common::{vector, words};
use crate::random::Random;
use crate::soundness::{Machines, SAMPLES, axes, blocks, circle, ends, follow, joints, strays};
use trunnion_geometry::math::{cos, sin};
use trunnion_interp::{Motion, MotionKind, Position};
use trunnion_machine::{
    Joints, Leg, Machine, excursions, feed_limit_tight, inverse, linear_travel, passes_singular, tip_deviation,
};

/// A helix of up to three turns from the start of a motion, every third one with a radius that changes.
pub(crate) fn with_spiral(random: &mut Random, motion: &Motion) -> Motion {
    let mut motion = with_arc(random, motion);
    let MotionKind::Arc(Some(mut arc)) = motion.kind else {
        return motion;
    };
    if random.below(4) == 0 {
        arc.sweep *= 3.0;
    }
    if random.below(3) == 0 {
        arc.radius_end *= random.range(0.6, 1.6);
    }
    let radial = (arc.start - arc.centre) / arc.radius_start;
    let turned = radial * cos(arc.sweep) + arc.normal.cross(&radial) * sin(arc.sweep);
    let rise = arc.normal * arc.normal.dot(&(arc.end - arc.start));
    arc.end = arc.centre + turned * arc.radius_end + rise;
    for axis in 0..3 {
        motion.end.set(axis, arc.end[axis]);
    }
    motion.kind = MotionKind::Arc(Some(arc));
    motion
}

/// Whether all joints are somewhere, and nowhere near where the linear axes do not span space.
pub(crate) fn stays_near(along: &dyn Fn(f64) -> Joints) -> bool {
    (0..=SAMPLES).all(|i| along(i as f64 / SAMPLES as f64).iter().all(|q| q.abs() <= 1e5))
}

/// Length of the polygon of the linear axes through many moments. Hard by a pole they run far from one to the next: there the polygon
/// cuts the corners of a curve, so that it is made finer.
fn polygon(machine: &Machine, along: &dyn Fn(f64) -> Joints) -> f64 {
    let step = |from: &Joints, to: &Joints| {
        let squares = machine.linear.iter().map(|&joint| (to[joint] - from[joint]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    let all: Vec<Joints> = (0..=SAMPLES).map(|i| along(i as f64 / SAMPLES as f64)).collect();
    let coarse: f64 = all.windows(2).map(|two| step(&two[0], &two[1])).sum();
    let mut length = 0.0;
    for (i, two) in all.windows(2).enumerate() {
        let chord = step(&two[0], &two[1]);
        if chord < coarse * 0.01 {
            length += chord;
            continue;
        }
        let inner: Vec<Joints> = (0..=FINER)
            .map(|j| along((i as f64 + j as f64 / FINER as f64) / SAMPLES as f64))
            .collect();
        length += inner.windows(2).map(|two| step(&two[0], &two[1])).sum::<f64>();
    }
    length
}

/// Way of the linear axes against the polygon through many moments; false where it has no bound. `even`: far from pole and
/// edge of the reach, where the upper bound must be near too; else it is the lower one alone that is closed in.
pub(crate) fn travel(machine: &Machine, leg: &Leg, along: &dyn Fn(f64) -> Joints, even: bool) -> bool {
    let Some(found) = linear_travel(machine, leg, 1.0) else {
        return false;
    };
    let polygon = polygon(machine, along);
    assert!(
        found.most_mm >= polygon * (1.0 - 1e-9) - 1e-9,
        "{found:?} polygon {polygon}"
    );
    if found.most_mm.is_infinite() {
        // through a posture where the linear axes do not span space they run away without end
        return true;
    }
    assert!(found.least_mm <= polygon * 1.02 + 1e-6, "{found:?} polygon {polygon}");
    if even && found.most_mm > 1.0 && machine.constants.shared_segment.is_some() {
        assert!(found.most_mm <= polygon * 1.02 + 1e-6, "{found:?} polygon {polygon}");
    }
    true
}

/// Moments between two moments where it matters.
const FINER: usize = 64;

/// Highest feed against the largest share of any axis' speed at many moments; `speed`: of the tip, mm per block.
pub(crate) fn feed(machine: &Machine, leg: &Leg, along: &dyn Fn(f64) -> Joints, speed: &dyn Fn(f64) -> f64) -> bool {
    let Some(found) = feed_limit_tight(machine, leg) else {
        return false;
    };
    let allowed_over = |t: f64, step: f64| {
        let t = t.clamp(step, 1.0 - step);
        let (before, after) = (along(t - step), along(t + step));
        let mut least = f64::INFINITY;
        for (joint, axis) in machine.axes.iter().enumerate() {
            let rate = (after[joint] - before[joint]).abs() / (2.0 * step);
            if let Some(limit) = axis.max_speed
                && rate > 0.0
            {
                least = least.min(60.0 * speed(t) * limit / rate);
            }
        }
        least
    };
    let allowed = |t: f64| allowed_over(t, 1e-5);
    let moments: Vec<f64> = (0..=SAMPLES).map(|i| allowed(i as f64 / SAMPLES as f64)).collect();
    // close to a pole the peak is narrower than the step between two moments, and need not be beside the worst one
    let mut spans: Vec<usize> = (0..SAMPLES).collect();
    spans.sort_by(|&a, &b| {
        moments[a]
            .min(moments[a + 1])
            .total_cmp(&moments[b].min(moments[b + 1]))
    });
    let between = |i: usize| (0..=FINER).map(move |j| (i as f64 + j as f64 / FINER as f64) / SAMPLES as f64);
    let fine = spans.into_iter().take(4).flat_map(between);
    let (worst, least) = fine
        .map(|t| (t, allowed(t)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .expect("many");
    let width = 1.0 / (SAMPLES * FINER) as f64;
    let (mut low, mut high) = ((worst - width).max(0.0), (worst + width).min(1.0));
    let mut truth = least;
    for _ in 0..25 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let (at_a, at_b) = (allowed(a), allowed(b));
        truth = truth.min(at_a).min(at_b);
        if at_a < at_b {
            high = b;
        } else {
            low = a;
        }
    }
    // a peak narrower than the step of these differences is higher than they say
    let fine = allowed_over(f64::midpoint(low, high), 1e-7);
    let limit = found.feed_mm_min;
    assert!(limit <= truth * (1.0 + 1e-5), "limit {limit} truth {truth}");
    assert!(limit <= fine * (1.0 + 1e-3), "limit {limit} truth {fine}");
    let even = (speed(0.0) - speed(1.0)).abs() < 1e-9 * speed(0.0);
    if machine.constants.shared_segment.is_some() && even {
        // between two moments an axis may be a little faster than at both
        assert!(
            limit >= truth.min(fine) * 0.97,
            "limit {limit} truth {truth} {fine}, {}: {leg:?}",
            machine.id
        );
    }
    true
}

/// Largest value of a joint: the largest of many moments, then by thirds between its neighbours.
fn summit(all: &[Joints], value: impl Fn(&Joints) -> f64, along: &dyn Fn(f64) -> Joints) -> f64 {
    let best = (0..all.len())
        .max_by(|a, b| value(&all[*a]).total_cmp(&value(&all[*b])))
        .expect("many");
    let share = |i: usize| i.min(SAMPLES) as f64 / SAMPLES as f64;
    let (mut low, mut high) = (share(best.saturating_sub(1)), share(best + 1));
    for _ in 0..40 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if value(&along(a)) > value(&along(b)) {
            high = b;
        } else {
            low = a;
        }
    }
    value(&all[best]).max(value(&along(0.5 * (low + high))))
}

/// How far linear axes run beyond both their ends, against many moments.
pub(crate) fn beyond(machine: &Machine, leg: &Leg, along: &dyn Fn(f64) -> Joints) -> usize {
    const LEAST: f64 = 1.0;
    let all: Vec<Joints> = (0..=SAMPLES).map(|i| along(i as f64 / SAMPLES as f64)).collect();
    let found = excursions(machine, leg, LEAST);
    if passes_singular(machine, leg) {
        // the axes have no path there, and rules say that it is unknown
        assert!(found.is_empty(), "{found:?}");
        return 0;
    }
    for solved in machine.constants.solved {
        let joint = machine.constants.linear[solved].joint;
        for (sign, upward) in [(1.0, true), (-1.0, false)] {
            let top = summit(&all, |q| sign * q[joint], along);
            let truth = top - (sign * all[0][joint]).max(sign * all[SAMPLES][joint]);
            let own = found.iter().find(|one| one.axis == joint && one.upward == upward);
            match own {
                // through a posture where the linear axes do not span space they run away without end
                Some(own) if own.beyond_mm > 1e4 => {}
                Some(own) => assert!(
                    own.beyond_mm >= truth - 2e-3 && own.beyond_mm <= truth * 1.02 + 0.1,
                    "{own:?} truth {truth}"
                ),
                None => assert!(truth <= LEAST + 2e-3, "joint {joint} runs {truth} mm beyond"),
            }
        }
    }
    found.len()
}

/// Rotary words while the tip is led.
fn by_words(random: &mut Random, machine: &Machine, seen: &mut [usize; 4]) {
    let turn = [0.05, 1.0, 20.0, 60.0][random.below(4)];
    let way = [0.1, 5.0, 80.0][random.below(3)];
    let (start, end) = ends(random, machine, turn, way);
    let mut second = Motion {
        tcp: true,
        tool_length_mm: random.range(0.0, 120.0),
        ..words(start, end)
    };
    let is_arc = random.below(3) > 0 && machine.axes.iter().all(|axis| !axis.extra.diameter);
    if is_arc {
        second = with_spiral(random, &second);
    }
    let first = Motion {
        start: Position::default(),
        end: start,
        kind: MotionKind::Linear,
        ..second
    };
    let Some(leg) = follow(machine, &first, &second) else {
        return;
    };
    let (from, to) = (leg.start.expect("known").tip, leg.end.as_ref().expect("known").tip);
    let tip = |t: f64| match &second.kind {
        MotionKind::Arc(Some(arc)) => arc.point_at(t),
        _ => from + (to - from) * t,
    };
    let speed = |t: f64| match &second.kind {
        MotionKind::Arc(Some(arc)) => arc.derivative_at(t).norm(),
        _ => (to - from).norm(),
    };
    let along = |t: f64| {
        let mut q = joints(&leg, t);
        // where the linear axes do not span space they are nowhere
        if inverse(machine, &mut q, &tip(t), second.tool_length_mm).is_none() {
            q.fill(f64::NAN);
        }
        q
    };
    if !stays_near(&along) {
        return;
    }
    assert_eq!(tip_deviation(machine, &leg, 0.01).expect("known").bound_mm, 0.0);
    seen[0] += usize::from(travel(machine, &leg, &along, true));
    seen[1] += usize::from(feed(machine, &leg, &along, &speed));
    seen[2] += beyond(machine, &leg, &along);
}

/// Tool vectors that a control runs joint-linear while the tip runs along a helix: axis and body.
fn by_vectors(random: &mut Random, machine: &Machine, seen: &mut [usize; 4]) {
    let [from, to] = axes(random);
    let above = random.range(5.0, 150.0);
    let start = random.direction() * 80.0;
    let first = Motion {
        tool_length_mm: above,
        ..vector(Position::default(), start.into(), from)
    };
    let second = Motion {
        tool_length_mm: above,
        ..vector(first.end, start.into(), to)
    };
    let second = with_spiral(random, &second);
    let (MotionKind::Arc(Some(arc)), Some(leg)) = (second.kind, follow(machine, &first, &second)) else {
        return;
    };
    seen[3] += usize::from(strays(machine, &leg, &circle(from, to), &|t| arc.point_at(t), above));
}

#[test]
fn soundness_while_the_tip_is_led_along_lines_and_helices() {
    let mut random = Random(23);
    let mut machines = Machines::new(&mut random);
    let mut seen = [0; 4];
    let wanted = blocks() / 3;
    for _ in 0..wanted {
        let machine = machines.pick(&mut random).clone();
        if random.below(4) == 0 && machine.axes.iter().all(|axis| !axis.extra.diameter) {
            by_vectors(&mut random, &machine, &mut seen);
        } else {
            by_words(&mut random, &machine, &mut seen);
        }
    }
    assert!(seen.iter().all(|count| *count > wanted / 20), "{seen:?}");
}
