//! Bounds against dense sampling on random blocks of all built-in machines and of random chains: never below the truth, and at most 1.2
//! times it. `TRUNNION_BLOCKS=1000000 cargo test --release -p trunnion-machine --test all soundness` judges that many.
use crate::common::{vector, words};
use crate::led::{travel, with_spiral};
use crate::random::{Random, random_machine};
use trunnion_geometry::math::{angle_between, cos, sin};
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::{Motion, MotionKind, Position};
use trunnion_machine::{
    AxisKind, BUILTIN_MACHINES, Follower, Joints, Leg, Machine, builtin, forward, inverse, orientation_deviation,
    swept_deviation, tip_deviation, tool_axis_at,
};

pub(crate) const SAMPLES: usize = 160;

pub(crate) fn blocks() -> usize {
    let wanted = std::env::var("TRUNNION_BLOCKS").ok();
    wanted.map_or(1500, |text| text.parse().expect("TRUNNION_BLOCKS is a number"))
}

/// Tolerances of the rules, so that the early answers are judged too.
const TIP_MM: f64 = 0.01;
const AXIS: f64 = 0.1;
const SWEPT_MM: f64 = 0.05;

/// Machines with rotary axes: built in, or random.
pub(crate) struct Machines {
    known: Vec<Machine>,
    random: Machine,
}

impl Machines {
    pub(crate) fn new(random: &mut Random) -> Self {
        let known = BUILTIN_MACHINES
            .iter()
            .map(|name| builtin(name).expect("built in").clone())
            .filter(|machine| !machine.rotary.is_empty())
            .collect();
        Self {
            known,
            random: random_machine(random, false, "joint"),
        }
    }

    pub(crate) fn pick(&mut self, random: &mut Random) -> &Machine {
        let which = random.below(self.known.len() * 2);
        if which < self.known.len() {
            return &self.known[which];
        }
        if random.below(20) == 0 {
            let straight = random.below(2) == 0;
            self.random = random_machine(random, straight, "joint");
        }
        &self.random
    }
}

/// Axis words, mm and deg; `turn` scales the rotary move, `way` the linear one.
pub(crate) fn ends(random: &mut Random, machine: &Machine, turn: f64, way: f64) -> (Position, Position) {
    let (mut from, mut to) = (Position::default(), Position::default());
    for axis in &machine.axes {
        let Some(letter) = trunnion_interp::AxisLetter::new(axis.letter) else {
            continue;
        };
        let (range, step) = match axis.kind {
            AxisKind::Linear => (300.0, way),
            AxisKind::Rotary => (170.0, turn),
        };
        let value = random.range(-range, range);
        // a held axis that moves is not followed
        let (value, step) = axis.extra.hold.map_or((value, step), |hold| (deg(hold), 0.0));
        from.set(usize::from(letter.0), value);
        to.set(usize::from(letter.0), value + random.range(-step, step));
    }
    (from, to)
}

pub(crate) fn follow(machine: &Machine, first: &Motion, second: &Motion) -> Option<Leg> {
    let mut follower = Follower::new(machine);
    follower.follow(first).end.ok()?;
    let leg = follower.follow(second);
    leg.end.is_ok().then_some(leg)
}

pub(crate) fn joints(leg: &Leg, t: f64) -> Joints {
    let mut joints = leg.start.expect("known").joints;
    for (value, end) in joints.iter_mut().zip(leg.end.as_ref().expect("known").joints) {
        *value += (end - *value) * t;
    }
    joints
}

/// Smallest over s of the distance from a point to a curve: a grid, then each of its valleys by thirds.
fn nearest(curve: &dyn Fn(f64) -> f64) -> f64 {
    let share = |i: usize| i as f64 / SAMPLES as f64;
    let grid: Vec<f64> = (0..=SAMPLES).map(|i| curve(share(i))).collect();
    let mut least = f64::INFINITY;
    for i in 0..=SAMPLES {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(SAMPLES));
        if grid[i] > grid[before] || grid[i] > grid[after] {
            continue;
        }
        let (mut low, mut high) = (share(before), share(after));
        for _ in 0..40 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if curve(a) < curve(b) {
                high = b;
            } else {
                low = a;
            }
        }
        least = least.min(grid[i]).min(curve(0.5 * (low + high)));
    }
    least
}

/// Largest value at even shares of the block and at one more.
fn farthest(count: usize, also: f64, distance: impl Fn(f64) -> f64) -> f64 {
    (0..=count)
        .map(|i| distance(i as f64 / count as f64))
        .fold(distance(also), f64::max)
}

/// Holds a sample and a bound against the truth found by sampling.
fn hold(what: &str, (sampled, bound): (f64, f64), truth: f64, tolerance: f64) {
    assert!(
        bound >= truth * (1.0 - 1e-9) - 1e-9,
        "{what}: bound {bound} truth {truth}"
    );
    assert!(
        sampled <= bound && sampled <= truth * (1.0 + 1e-9) + 1e-9,
        "{what}: sampled {sampled} truth {truth}"
    );
    if bound > tolerance {
        assert!(
            bound <= 1.2 * truth + 1e-4 * tolerance,
            "{what}: bound {bound} truth {truth}"
        );
    }
}

/// A line or an arc without TCP.
fn without_tcp(random: &mut Random, machine: &Machine, seen: &mut [usize; 4]) {
    let turn = [0.05, 1.0, 20.0, 170.0][random.below(4)];
    let way = [0.1, 5.0, 200.0][random.below(3)];
    let (start, end) = ends(random, machine, turn, way);
    let mut second = Motion {
        tool_length_mm: random.range(0.0, 120.0),
        ..words(start, end)
    };
    // arcs in diameters are not followed
    let is_arc = random.below(4) == 0 && machine.axes.iter().all(|axis| !axis.extra.diameter);
    if is_arc {
        second = with_spiral(random, &second);
    }
    let first = Motion {
        start: Position::default(),
        end: start,
        kind: MotionKind::Linear,
        ..second
    };
    let leg = follow(machine, &first, &second).expect("words name all axes");
    let found = tip_deviation(machine, &leg, TIP_MM).expect("known");
    let length = second.tool_length_mm;
    let tip = |joints: &Joints| forward(machine, joints, length).tip;
    let (from, chord) = {
        let (a, b) = (tip(&joints(&leg, 0.0)), tip(&joints(&leg, 1.0)));
        (a, b - a)
    };
    let truth = if let MotionKind::Arc(Some(arc)) = second.kind {
        // the distance of the arc from its chord, per word of X Y Z, in the workpiece at the start
        let bulge = |t: f64| arc.point_at(t) - arc.start - (arc.end - arc.start) * t;
        let slots = [b'X', b'Y', b'Z'].map(|letter| machine.joint(letter).expect("an axis"));
        let unit = slots.map(|slot| {
            let mut moved = joints(&leg, 0.0);
            moved[slot] += 1.0;
            tip(&moved) - from
        });
        let segment = |s: f64| {
            let off = bulge(s);
            from + chord * s + unit[0] * off.x + unit[1] * off.y + unit[2] * off.z
        };
        farthest(40, found.at, |t| {
            let (mut at, off) = (joints(&leg, t), bulge(t));
            for (slot, value) in slots.into_iter().zip(off.iter()) {
                at[slot] += value;
            }
            let point = tip(&at);
            nearest(&|s| (point - segment(s)).norm())
        })
    } else {
        farthest(SAMPLES, found.at, |t| {
            let off = tip(&joints(&leg, t)) - from;
            let share = (off.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (off - chord * share).norm()
        })
    };
    seen[usize::from(is_arc)] += 1;
    hold("tip", (found.sampled_mm, found.bound_mm), truth, TIP_MM);
}

/// Two tool axes, near each other or not.
pub(crate) fn axes(random: &mut Random) -> [Vec3; 2] {
    let from = random.direction();
    let to = (from + random.direction() * [0.002, 0.05, 0.8][random.below(3)]).normalize();
    [from, to]
}

/// The great circle between two tool axes, by the share of its angle.
pub(crate) fn circle(from: Vec3, to: Vec3) -> impl Fn(f64) -> Vec3 {
    let angle = angle_between(&from, &to);
    let side = (to - from * from.dot(&to)).normalize();
    move |s| from * cos(angle * s) + side * sin(angle * s)
}

/// How far tool axis and body stray where a control runs joint-linear what is meant along `circle`, while the tip runs along `tip`; false
/// where nothing is known.
pub(crate) fn strays(
    machine: &Machine,
    leg: &Leg,
    circle: &dyn Fn(f64) -> Vec3,
    tip: &dyn Fn(f64) -> Vec3,
    above: f64,
) -> bool {
    let Some(found) = orientation_deviation(machine, leg, rad(AXIS)) else {
        return false;
    };
    let axis = |t: f64| {
        let q = joints(leg, t);
        tool_axis_at(
            machine,
            [0, 1].map(|i| machine.rotary.get(i).map_or(0.0, |&joint| q[joint])),
        )
    };
    let truth = farthest(40, found.at, |t| {
        let axis = axis(t);
        nearest(&|s| angle_between(&axis, &circle(s)))
    });
    hold("axis", (found.sampled, found.bound), truth, rad(AXIS));
    let swept = swept_deviation(machine, leg, above, SWEPT_MM).expect("as the axis");
    let truth = farthest(40, swept.at, |t| {
        let point = tip(t) + axis(t) * above;
        nearest(&|s| (point - tip(s) - circle(s) * above).norm())
    });
    hold("body", (swept.sampled_mm, swept.bound_mm), truth, SWEPT_MM);
    true
}

/// Tool vectors that a control runs joint-linear: axis and body; and the length that the linear joints run.
fn with_vectors(random: &mut Random, machine: &Machine, seen: &mut [usize; 4]) {
    let [from, to] = axes(random);
    let tip = random.direction() * 80.0;
    let way = random.direction() * [0.1, 2.0, 40.0][random.below(3)];
    let above = random.range(5.0, 150.0);
    let first = Motion {
        tool_length_mm: above,
        ..vector(Position::default(), tip.into(), from)
    };
    let second = Motion {
        tool_length_mm: above,
        ..vector(first.end, (tip + way).into(), to)
    };
    let Some(leg) = follow(machine, &first, &second) else {
        return;
    };
    // words may be diameters
    let (tip, end) = (leg.start.expect("known").tip, leg.end.as_ref().expect("known").tip);
    let way = end - tip;
    if !strays(machine, &leg, &circle(from, to), &|t| tip + way * t, above) {
        return;
    }
    seen[2] += 1;
    let along = |t: f64| {
        let mut q = joints(&leg, t);
        inverse(machine, &mut q, &(tip + way * t), above).expect("spans space");
        q
    };
    seen[3] += usize::from(travel(machine, &leg, &along, true));
}

#[test]
fn bounds_hold_on_random_blocks_of_all_machines() {
    let mut random = Random(11);
    let mut machines = Machines::new(&mut random);
    let mut seen = [0; 4];
    let wanted = blocks();
    for _ in 0..wanted {
        let machine = machines.pick(&mut random).clone();
        if random.below(3) == 0 {
            with_vectors(&mut random, &machine, &mut seen);
        } else {
            without_tcp(&mut random, &machine, &mut seen);
        }
    }
    let share = |count: usize| count as f64 / wanted as f64;
    assert!(
        share(seen[0]) > 0.45 && share(seen[1]) > 0.05 && share(seen[2]) > 0.1 && share(seen[3]) > 0.1,
        "{seen:?}"
    );
}
