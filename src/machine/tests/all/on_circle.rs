//! Tool vectors on the great circle while the tip runs along lines, helices and spirals, on all built-in machines and random chains: nothing
//! deviates, and travel of the linear axes, highest feed and excursions are compared with dense sampling. `TRUNNION_BLOCKS` as in `soundness`.
use crate::common::vector;
use crate::led::{beyond, feed, stays_near, travel, with_spiral};
use crate::random::Random;
use crate::soundness::{Machines, axes, blocks, circle, follow};
use std::f64::consts::TAU;
use trunnion_geometry::Vec3;
use trunnion_interp::{Motion, MotionKind, Position};
use trunnion_machine::{
    Joints, Leg, MAX_AXES, Machine, Orientations, excursions, feed_limit_tight, inverse, linear_travel,
    orientation_deviation, orientations, solution_s, swept_deviation, tip_deviation,
};

/// Steps in which a posture is followed along the circle.
const STEPS: usize = 500;

/// The joints that reach the tool axes of a circle, in one posture.
struct Path<'a> {
    machine: &'a Machine,
    branch: i8,
    /// Tool axis along the block.
    axis: &'a dyn Fn(f64) -> Vec3,
    /// Rotary joints after each step, without jumps of whole turns.
    steps: Vec<Joints>,
    /// The largest turn of an axis in a step, rad.
    fastest: f64,
    /// The smallest |S|: how far it keeps from pole and edge of the reach.
    least_s: f64,
}

impl<'a> Path<'a> {
    /// `None` where the circle leaves the posture.
    fn new(machine: &'a Machine, start: &Joints, branch: i8, axis: &'a dyn Fn(f64) -> Vec3) -> Option<Self> {
        let mut path = Self {
            machine,
            branch,
            axis,
            steps: vec![*start],
            fastest: 0.0,
            least_s: f64::INFINITY,
        };
        for i in 1..=STEPS {
            let last = path.steps[i - 1];
            let next = path.rotary(i as f64 / STEPS as f64, &last)?;
            for &joint in &machine.rotary {
                path.fastest = path.fastest.max((next[joint] - last[joint]).abs());
            }
            let second = machine.rotary.get(1).map_or(0.0, |&joint| next[joint]);
            path.least_s = path.least_s.min(solution_s(machine, second).abs());
            path.steps.push(next);
        }
        Some(path)
    }

    /// Rotary joints, nearest to others.
    fn rotary(&self, t: f64, near: &Joints) -> Option<Joints> {
        let Orientations::Postures(postures) = orientations(self.machine, &(self.axis)(t)) else {
            return None;
        };
        let posture = postures.iter().find(|posture| posture.branch == self.branch)?;
        let mut joints = *near;
        for (q, &joint) in posture.q.iter().zip(&self.machine.rotary) {
            joints[joint] = q + TAU * ((near[joint] - q) / TAU).round();
        }
        Some(joints)
    }

    fn at(&self, t: f64, tip: &Vec3, above: f64) -> Option<Joints> {
        let near = &self.steps[(t * STEPS as f64).round() as usize];
        let mut joints = self.rotary(t, near)?;
        inverse(self.machine, &mut joints, tip, above)?;
        Some(joints)
    }
}

fn block(random: &mut Random, machine: &Machine) -> Option<(Leg, Motion, [Vec3; 2])> {
    let [from, to] = axes(random);
    let above = random.range(0.0, 150.0);
    let start = random.direction() * 80.0;
    let way = random.direction() * [0.1, 2.0, 40.0][random.below(3)];
    let on_circle = |motion: Motion| Motion {
        tool_length_mm: above,
        great_circle: Some(true),
        ..motion
    };
    let first = on_circle(vector(Position::default(), start.into(), from));
    let mut second = on_circle(vector(first.end, (start + way).into(), to));
    // arcs in diameters are not followed
    if random.below(2) == 0 && machine.axes.iter().all(|axis| !axis.extra.diameter) {
        second = with_spiral(random, &second);
    }
    let leg = follow(machine, &first, &second)?;
    Some((leg, second, [from, to]))
}

fn judge(random: &mut Random, machine: &Machine, seen: &mut [usize; 5]) {
    let Some((leg, motion, [from, to])) = block(random, machine) else {
        return;
    };
    let is_arc = matches!(motion.kind, MotionKind::Arc(_));
    // words may be diameters
    let ends = [leg.start.expect("known").tip, leg.end.as_ref().expect("known").tip];
    let tip = |t: f64| match &motion.kind {
        MotionKind::Arc(Some(arc)) => arc.point_at(t),
        _ => ends[0] + (ends[1] - ends[0]) * t,
    };
    let speed = |t: f64| match &motion.kind {
        MotionKind::Arc(Some(arc)) => arc.derivative_at(t).norm(),
        _ => (ends[1] - ends[0]).norm(),
    };
    let circle = circle(from, to);
    // the tip is led and the axis runs as programmed
    let above = motion.tool_length_mm;
    assert_eq!(
        tip_deviation(machine, &leg, 0.01).map(|found| found.bound_mm),
        Some(0.0)
    );
    if let Some(found) = orientation_deviation(machine, &leg, 0.0) {
        assert_eq!(found.bound, 0.0);
        let swept = swept_deviation(machine, &leg, above, 0.0).map(|found| found.bound_mm);
        assert_eq!(swept, Some(0.0));
    }
    let (start, end) = (leg.start.expect("known"), leg.end.as_ref().expect("known"));
    let path = Path::new(machine, &start.joints, start.branch, &circle);
    if path.as_ref().is_some_and(|path| path.fastest > 0.5) {
        // half a radian in a step, close to the pole: the number of full turns of the axis is unknown here
        return;
    }
    let reaches = |path: &Path<'_>| {
        let off = |joint: &usize| (path.steps[STEPS][*joint] - end.joints[*joint]).abs() > 1e-6;
        !machine.rotary.iter().any(off)
    };
    let Some(path) = path.filter(reaches) else {
        // over the pole, or to the other posture: how the joints get there is not known
        assert!(feed_limit_tight(machine, &leg).is_none(), "{} {leg:?}", machine.id);
        let most = linear_travel(machine, &leg, 1.0).map(|found| found.most_mm);
        assert!(most.is_none_or(f64::is_infinite), "{} {leg:?}", machine.id);
        assert!(excursions(machine, &leg, 1.0).is_empty(), "{} {leg:?}", machine.id);
        seen[4] += 1;
        return;
    };
    let along = |t: f64| {
        // where the linear axes do not span space they are nowhere
        path.at(t, &tip(t), above).unwrap_or([f64::NAN; MAX_AXES])
    };
    if !stays_near(&along) {
        return;
    }
    seen[usize::from(is_arc)] += usize::from(travel(machine, &leg, &along, path.least_s > 0.3));
    seen[2] += usize::from(feed(machine, &leg, &along, &speed));
    seen[3] += beyond(machine, &leg, &along);
}

#[test]
fn soundness_on_great_circles() {
    let mut random = Random(37);
    let mut machines = Machines::new(&mut random);
    let mut seen = [0; 5];
    let wanted = blocks() / 6;
    for _ in 0..wanted {
        let machine = machines.pick(&mut random).clone();
        judge(&mut random, &machine, &mut seen);
    }
    assert!(
        seen[..4].iter().all(|count| *count > wanted / 10) && seen[4] > 0,
        "{seen:?}"
    );
}
