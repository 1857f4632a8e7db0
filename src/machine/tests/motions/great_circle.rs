//! Tool vectors on a great circle: feed limit and travel against the joints that reach each tool axis of the circle.
use crate::common::vector;
use crate::random::{Random, random_machine};
use trunnion_geometry::math::{cos, sin};
use trunnion_interp::{Feed, Position};
use trunnion_machine::{Follower, Limits, feed_limit, inverse, limit_excess};

/// Legs with tool vectors on a great circle: rates by difference quotients of the joints that reach the circle's tool axes.
#[test]
fn great_circles_are_bounded_too() {
    let mut random = Random(5);
    let (mut judged, mut inside) = (0, 0);
    for round in 0..300 {
        let mut machine = random_machine(&mut random, round % 2 == 0, "great-circle");
        let from = random.direction();
        let turn = [0.02, 0.8, 1.5][random.below(3)];
        let to = (from + random.direction() * turn).normalize();
        let tips = [random.direction() * 50.0, random.direction() * 50.0];
        let mut follower = Follower::new(&machine);
        let first = follower.follow(&vector(Position::default(), tips[0].into(), from));
        let leg = follower.follow(&vector(first.motion.end, tips[1].into(), to));
        drop(follower);
        let (Some(start), Ok(end)) = (leg.start, leg.end.as_ref()) else {
            continue;
        };
        let Some(mut found) = feed_limit(&machine, &leg) else {
            continue;
        };
        let angle = trunnion_geometry::math::angle_between(&from, &to);
        let side = (to - from * from.dot(&to)).normalize();
        let rotary = [machine.rotary[0], machine.rotary[1]];
        // the joints on the circle, followed in small steps
        let steps = 2000;
        let mut last = start.joints;
        let mut path = Vec::new();
        let mut lost = false;
        for i in 0..=steps {
            let t = f64::from(i) / f64::from(steps);
            let axis = from * cos(angle * t) + side * sin(angle * t);
            let trunnion_machine::Orientations::Postures(postures) = trunnion_machine::orientations(&machine, &axis)
            else {
                lost = true;
                break;
            };
            let Some(posture) = postures.iter().find(|p| p.branch == start.branch) else {
                lost = true;
                break;
            };
            let mut joints = start.joints;
            for (k, &joint) in rotary.iter().enumerate() {
                let turns = ((last[joint] - posture.q[k]) / std::f64::consts::TAU).round();
                joints[joint] = posture.q[k] + std::f64::consts::TAU * turns;
            }
            let tip = tips[0] + (tips[1] - tips[0]) * t;
            inverse(&machine, &mut joints, &tip, 0.0).expect("spans space");
            path.push(joints);
            last = joints;
        }
        assert!(!lost, "a limit was given for a circle out of reach");
        for &joint in &rotary {
            assert!((last[joint] - end.joints[joint]).abs() < 1e-6);
        }
        let (mut worst, mut jump) = (0.0_f64, 0.0_f64);
        for three in path.windows(3) {
            for (joint, axis) in machine.axes.iter().enumerate() {
                let share = |i: usize| {
                    (three[i + 1][joint] - three[i][joint]) * f64::from(steps) / axis.max_speed.expect("declared")
                };
                worst = worst.max(share(0).abs()).max(share(1).abs());
                jump = jump.max((share(1) - share(0)).abs());
            }
        }
        let truth = 60.0 * leg.length / worst;
        // how far a difference quotient can lie below the rate inside its step
        let tight = truth * (0.995 - jump / worst);
        if found.feed_mm_min > truth || found.feed_mm_min < tight {
            // the coarse answer is allowed where the programmed feed is below it
            assert!(
                found.feed_mm_min >= 2000.0 && found.feed_mm_min <= truth * (1.0 + 1e-9),
                "{found:?} {truth}"
            );
            let mut fast = leg.clone();
            fast.motion.feed = Feed::PerMinute(1e9);
            found = feed_limit(&machine, &fast).expect("limited");
        }
        judged += 1;
        assert!(
            found.feed_mm_min <= truth * (1.0 + 1e-9),
            "limit {} truth {truth}",
            found.feed_mm_min
        );
        assert!(found.feed_mm_min >= tight, "limit {} truth {truth}", found.feed_mm_min);
        for &joint in &rotary {
            let high = path.iter().fold(f64::NEG_INFINITY, |h, joints| h.max(joints[joint]));
            let bulge = high - start.joints[joint].max(end.joints[joint]);
            if bulge > 5e-3 {
                inside += 1;
                machine.axes[joint].limits = Limits::Range(-100.0, high - 0.5 * bulge);
                let mut out = Vec::new();
                limit_excess(&machine, &leg, &mut out);
                assert!(
                    out.iter().any(|e| e.axis == joint && e.inside),
                    "{out:?} for a bulge of {bulge}"
                );
            }
        }
    }
    assert!(judged > 50 && inside > 5, "{judged} {inside}");
}
