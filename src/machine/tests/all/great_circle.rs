//! Tool vectors on a great circle: feed limit and travel against the joints that reach each tool axis of the circle.
use crate::common::vector;
use crate::random::{Random, random_machine};
use std::f64::consts::TAU;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, cos, sin};
use trunnion_interp::{Feed, Position};
use trunnion_machine::{
    Follower, Joints, Leg, Limits, Machine, Orientations, feed_limit, inverse, limit_excess, orientations,
};

const STEPS: u32 = 2000;

/// Tips and tool axes at both ends of a block.
struct Block {
    tips: [Vec3; 2],
    axes: [Vec3; 2],
}

impl Block {
    fn new(random: &mut Random) -> Self {
        let from = random.direction();
        let turn = [0.02, 0.8, 1.5][random.below(3)];
        let to = (from + random.direction() * turn).normalize();
        Self {
            tips: [random.direction() * 50.0, random.direction() * 50.0],
            axes: [from, to],
        }
    }

    fn leg(&self, machine: &Machine) -> Leg {
        let mut follower = Follower::new(machine);
        let first = follower.follow(&vector(Position::default(), self.tips[0].into(), self.axes[0]));
        follower.follow(&vector(first.motion.end, self.tips[1].into(), self.axes[1]))
    }

    /// The joints on the circle in one posture, followed in small steps; `None` where the circle leaves it.
    fn path(&self, machine: &Machine, start: &Joints, branch: i8) -> Option<Vec<Joints>> {
        let [from, to] = self.axes;
        let angle = angle_between(&from, &to);
        let side = (to - from * from.dot(&to)).normalize();
        let mut last = *start;
        (0..=STEPS)
            .map(|i| {
                let t = f64::from(i) / f64::from(STEPS);
                let axis = from * cos(angle * t) + side * sin(angle * t);
                let Orientations::Postures(postures) = orientations(machine, &axis) else {
                    return None;
                };
                let posture = postures.iter().find(|p| p.branch == branch)?;
                for (q, &joint) in posture.q.iter().zip(&machine.rotary) {
                    last[joint] = q + TAU * ((last[joint] - q) / TAU).round();
                }
                let mut joints = last;
                inverse(
                    machine,
                    &mut joints,
                    &(self.tips[0] + (self.tips[1] - self.tips[0]) * t),
                    0.0,
                )?;
                Some(joints)
            })
            .collect()
    }
}

/// Largest share of an axis' speed at one block per second, by difference quotients, and how much it changes from step to step.
fn worst_share(machine: &Machine, path: &[Joints]) -> (f64, f64) {
    let (mut worst, mut jump) = (0.0_f64, 0.0_f64);
    for three in path.windows(3) {
        for (joint, axis) in machine.axes.iter().enumerate() {
            let speed = axis.max_speed.expect("declared");
            let share = |i: usize| (three[i + 1][joint] - three[i][joint]) * f64::from(STEPS) / speed;
            worst = worst.max(share(0).abs()).max(share(1).abs());
            jump = jump.max((share(1) - share(0)).abs());
        }
    }
    (worst, jump)
}

#[test]
fn great_circles_are_bounded_too() {
    let mut random = Random(5);
    let (mut judged, mut inside) = (0, 0);
    for round in 0..300 {
        let mut machine = random_machine(&mut random, round % 2 == 0, "great-circle");
        let block = Block::new(&mut random);
        let mut leg = block.leg(&machine);
        let (Some(start), Ok(end)) = (leg.start, leg.end.clone()) else {
            continue;
        };
        let Some(coarse) = feed_limit(&machine, &leg) else {
            continue;
        };
        let path = block
            .path(&machine, &start.joints, start.branch)
            .expect("a limit was given: the circle is in reach");
        let (worst, jump) = worst_share(&machine, &path);
        let truth = 60.0 * leg.length / worst;
        for &joint in &machine.rotary {
            assert!((path[path.len() - 1][joint] - end.joints[joint]).abs() < 1e-6);
        }
        // the programmed feed is 2000: a coarse answer is allowed above it
        assert!(
            coarse.feed_mm_min <= truth * (1.0 + 1e-9),
            "limit {} truth {truth}",
            coarse.feed_mm_min
        );
        leg.motion.feed = Feed::PerMinute(1e9);
        let found = feed_limit(&machine, &leg).expect("limited").feed_mm_min;
        judged += 1;
        assert!(found <= truth * (1.0 + 1e-9), "limit {found} truth {truth}");
        // a difference quotient is below the largest rate inside its step; where the linear axes are at different places in the chain
        // the bound is sound but may stay coarse
        if machine.constants.shared_segment.is_some() {
            assert!(found >= truth * (0.995 - jump / worst), "limit {found} truth {truth}");
        }
        for joint in machine.rotary.clone() {
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
