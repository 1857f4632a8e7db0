//! How the rotary axes turn inside a block: evenly, or so that the tool axis runs on a great circle.
//!
//! Turns are sign times joint, rad; rates are per block.
use crate::course::on_great_circle;
use crate::{Leg, Machine, Orientations, PairConstants, Stance, orientations};
use core::f64::consts::{PI, TAU};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, atan2, cos, sin_cos};

/// Tool axes nearer than this are one: nothing runs on a great circle, rad.
const SAME_AXIS: f64 = 1e-12;

/// A turn of a rotary axis up to this is rounding, rad.
pub const NO_TURN: f64 = 1e-9;

/// How near the great circle's end must come to the block's end, rad.
const ARRIVAL: f64 = 1e-6;

/// Bounds over a piece of a block for the two rotary axes: rates and second derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpinBounds {
    pub(crate) rate: [f64; 2],
    pub(crate) bend: [f64; 2],
}

/// The course of the rotary axes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Spin<'a> {
    /// At constant rates.
    Even,
    /// The tool axis runs on a great circle at a constant rate, in the start's posture.
    GreatCircle(GreatCircle<'a>),
}

/// A great circle from the start's to the end's tool axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GreatCircle<'a> {
    machine: &'a Machine,
    pair: &'a PairConstants,
    start: Vec3,
    /// Unit vector at right angles to `start` in the circle's plane.
    side: Vec3,
    /// Angle of the whole block, rad.
    angle: f64,
    branch: i8,
    /// [`GreatCircle::lead`] at the start, rad.
    lead: f64,
}

impl<'a> Spin<'a> {
    /// `None` where the tool axis should run on a great circle but the joints cannot follow it from start to end (the posture sign
    /// changes, a joint arrives on another turn, the tool axis turns right round).
    pub(crate) fn new(machine: &'a Machine, leg: &Leg, start: &Stance, end: &Stance) -> Option<Self> {
        let Some(pair) = machine
            .constants
            .pair
            .as_ref()
            .filter(|_| on_great_circle(machine, &leg.motion))
        else {
            return Some(Self::Even);
        };
        let angle = angle_between(&start.axis, &end.axis);
        if angle < SAME_AXIS {
            return Some(Self::Even);
        }
        let side = end.axis - start.axis * start.axis.dot(&end.axis);
        if angle > PI - ARRIVAL || start.branch != end.branch {
            return None;
        }
        let circle = GreatCircle::new(machine, pair, [start.axis, side.normalize()], angle, start.branch);
        if circle.azimuth_turned(&end.axis).abs() > PI - ARRIVAL {
            // over the pole: to which side the first axis turns is not known
            return None;
        }
        let (from, to) = (start.rotary(machine), end.rotary(machine));
        let arrives = circle.joints(1.0, from)?;
        let off = (arrives[0] - to[0]).abs().max((arrives[1] - to[1]).abs());
        (off < ARRIVAL).then_some(Self::GreatCircle(circle))
    }
}

/// How far the rotary axes get from where they start in a block, rad, workpiece side first: at its end, or half-way on a great circle,
/// where an axis may leave a value that it comes back to. Never above the truth; zero only for an axis that stands still. `None` where a
/// stance or the way between them is not known.
pub fn rotary_turns(machine: &Machine, leg: &Leg) -> Option<[f64; 2]> {
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let mut turns = leg.rotary_change;
    if let Spin::GreatCircle(circle) = Spin::new(machine, leg, start, end)? {
        let from = start.rotary(machine);
        let middle = circle.joints(0.5, from)?;
        for (turn, (from, middle)) in turns.iter_mut().zip(from.iter().zip(middle)) {
            *turn = turn.max((middle - from).abs());
        }
    }
    Some(turns)
}

impl<'a> GreatCircle<'a> {
    /// `axes`: tool axis at the start and the unit vector at right angles to it in the circle's plane.
    fn new(machine: &'a Machine, pair: &'a PairConstants, axes: [Vec3; 2], angle: f64, branch: i8) -> Self {
        let [start, side] = axes;
        let mut circle = Self {
            machine,
            pair,
            start,
            side,
            angle,
            branch,
            lead: 0.0,
        };
        circle.lead = circle.lead(&start);
        circle
    }

    /// By how much the azimuth of `u` about e1 is greater than the start's, rad: between -pi and pi, what a great circle that keeps off the
    /// pole turns by.
    fn azimuth_turned(&self, u: &Vec3) -> f64 {
        let e1 = self.machine.constants.rotary[0].direction;
        let from = self.start - e1 * e1.dot(&self.start);
        atan2(e1.dot(&from.cross(u)), from.dot(u))
    }

    /// By how much the azimuth of `u` about e1 leads that of the second axis in this posture, rad. S keeps its sign in a posture, so that it
    /// stays between 0 and pi, or between -pi and 0: gamma of kinematics notes 2.3 with the posture's sign.
    fn lead(&self, u: &Vec3) -> f64 {
        let pair = self.pair;
        let x = self.machine.constants.rotary[0].direction.dot(u);
        let off = x - pair.c * pair.y;
        let s = (pair.d * (1.0 - pair.y * pair.y) - off * off).max(0.0).sqrt();
        f64::from(self.branch) * atan2(s, pair.y - pair.c * x)
    }

    /// Tool axis and its rate.
    fn axis(&self, t: f64) -> (Vec3, Vec3) {
        let (sin, cos) = sin_cos(self.angle * t);
        (
            self.start * cos + self.side * sin,
            (self.side * cos - self.start * sin) * self.angle,
        )
    }

    /// Rotary joints at t for a block that starts at `from`, without jumps of whole turns; `None` where there are none in this posture. The
    /// first axis turns by what the azimuth of the tool axis turns, less what it gains on the second axis: more than half a turn, at times.
    pub(crate) fn joints(&self, t: f64, from: [f64; 2]) -> Option<[f64; 2]> {
        let u = self.axis(t).0;
        let Orientations::Postures(postures) = orientations(self.machine, &u) else {
            return None;
        };
        let found = postures.iter().find(|solution| solution.branch == self.branch)?;
        let turned = self.azimuth_turned(&u) - (self.lead(&u) - self.lead);
        let near = [from[0] + self.machine.constants.rotary[0].sign * turned, from[1]];
        let turn = |i: usize| found.q[i] + TAU * ((near[i] - found.q[i]) / TAU).round();
        Some([turn(0), turn(1)])
    }

    /// Rates of the turns at t: with f = R1 e2, t1' = -(u'.f) / S and t2' = (u'.e1) / S. `f` is the second axis turned by the first.
    pub(crate) fn rates(&self, t: f64, f: &Vec3) -> [f64; 2] {
        let (u, rate) = self.axis(t);
        let e1 = self.machine.constants.rotary[0].direction;
        let s = e1.dot(&f.cross(&u));
        [-rate.dot(f) / s, rate.dot(&e1) / s]
    }

    /// Bounds over a piece. The angle between u and e1 changes by at most `angle` per block, S^2 = D (1 - y^2) - (x - c y)^2 with x = e1.u, so
    /// that S S' = -(x - c y) x'. From u'' = -angle^2 u, multiplied by f and by e1:
    /// S t1'' = angle^2 y - 2 t1' S' - t1'^2 (y - c x) and S t2'' = -angle^2 x - t2' S'. Where the pole can be reached y - c x vanishes there.
    pub(crate) fn bounds(&self, from: f64, to: f64) -> SpinBounds {
        let pair = self.pair;
        let e1 = self.machine.constants.rotary[0].direction;
        let u = self.axis(0.5 * (from + to)).0;
        let middle = atan2(e1.cross(&u).norm(), e1.dot(&u));
        let half = 0.5 * self.angle * (to - from) * (1.0 + 1e-9);
        let (low, high) = ((middle - half).max(0.0), (middle + half).min(PI));
        let rho2 = pair.d * (1.0 - pair.y * pair.y);
        let s2 = |x: f64| rho2 - (x - pair.c * pair.y) * (x - pair.c * pair.y);
        let s = s2(cos(low)).min(s2(cos(high))).max(0.0).sqrt() * (1.0 - 1e-9);
        let w = self.angle;
        let sine = if low < 0.5 * PI && high > 0.5 * PI {
            1.0
        } else {
            let (l, h) = (sin_cos(low).0, sin_cos(high).0);
            l.max(h)
        };
        let first = w / s;
        let second = w * sine / s;
        // both are linear in x
        let most = |at: &dyn Fn(f64) -> f64| at(cos(low)).abs().max(at(cos(high)).abs()) * (1.0 + 1e-9) + 1e-15;
        let (gap, off) = (
            most(&|x| {
                if x > 0.0 {
                    pair.y_minus_c + pair.c * (1.0 - x)
                } else {
                    pair.y_plus_c - pair.c * (1.0 + x)
                }
            }),
            most(&|x| x - pair.c * pair.y),
        );
        let bend1 = (w * w * pair.y.abs() + first * first * gap + 2.0 * first * second * off) / s;
        let bend2 = (w * w * most(&|x| x) + second * second * off) / s;
        SpinBounds {
            rate: [first, second],
            bend: [bend1, bend2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{GreatCircle, Spin};
    use crate::{BUILTIN_MACHINES, Follower, Machine, Orientations, builtin, orientations};
    use core::f64::consts::PI;
    use trunnion_geometry::Vec3;
    use trunnion_geometry::math::{angle_between, rotate};
    use trunnion_interp::{Feed, Motion, Orientation, Position};

    fn rates(machine: &Machine, circle: &GreatCircle<'_>, t: f64, from: [f64; 2]) -> [f64; 2] {
        let [first, second] = &machine.constants.rotary;
        let q = circle.joints(t, from).expect("in reach");
        circle.rates(t, &rotate(&first.direction, first.sign * q[0], &second.direction))
    }

    /// Rates and their changes at many moments against the bounds of pieces of the block.
    #[test]
    fn rates_on_a_great_circle_stay_below_their_bounds() {
        let mut judged = 0;
        for (name, tilt, to) in BUILTIN_MACHINES.iter().flat_map(|name| {
            [(0.2, 0.9), (0.6, 0.9), (1.0, 0.9), (0.2, 0.1), (0.5, 0.1)].map(|(tilt, to)| (name, tilt, to))
        }) {
            let mut machine = builtin(name).expect("built in").clone();
            machine.control.tcp_great_circle = true;
            let Some(_) = machine.constants.pair else { continue };
            let e1 = machine.constants.rotary[0].direction;
            let side = if e1.x.abs() < 0.5 { Vec3::x() } else { Vec3::y() };
            let vector = |azimuth: f64, tilt: f64| rotate(&e1, azimuth, &rotate(&side, tilt, &e1));
            let mut follower = Follower::new(&machine);
            let mut end = Position::default();
            (0..3).for_each(|axis| end.set(axis, 0.0));
            let mut go = |axis: Vec3| {
                follower.follow(&Motion {
                    orientation: Orientation::Vector(None, axis),
                    tcp: true,
                    great_circle: Some(true),
                    feed: Feed::PerMinute(1.0),
                    ..Motion::line(end, end)
                })
            };
            go(vector(0.1, tilt));
            // the last two run straight away from the pole
            let leg = go(vector(to, tilt + 0.3));
            let (Some(start), Ok(stop)) = (&leg.start, &leg.end) else {
                continue;
            };
            let Some(Spin::GreatCircle(circle)) = Spin::new(&machine, &leg, start, stop) else {
                continue;
            };
            let from = start.rotary(&machine);
            for piece in 0..8 {
                let (low, high) = (f64::from(piece) / 8.0, f64::from(piece + 1) / 8.0);
                let bounds = circle.bounds(low, high);
                for step in 0..=20 {
                    let t = low + (high - low) * f64::from(step) / 20.0;
                    let (now, h) = (rates(&machine, &circle, t, from), 1e-5);
                    let [before, after] = [t - h, t + h].map(|t| rates(&machine, &circle, t, from));
                    for i in 0..2 {
                        let bend = (after[i] - before[i]).abs() / (2.0 * h);
                        assert!(
                            now[i].abs() <= bounds.rate[i] * (1.0 + 1e-9),
                            "{name} {t}: {now:?} {bounds:?}"
                        );
                        assert!(bend <= bounds.bend[i] * 1.001 + 1e-6, "{name} {t}: {bend} {bounds:?}");
                        judged += 1;
                    }
                }
            }
        }
        assert!(judged > 500, "{judged}");
    }

    /// On a meridian from `tilt` on, by `turn` deg: the bounds on a piece of it, as another program works them out from
    /// S^2 = D (1 - y^2) - (e1.u - c y)^2 with c = y = cos 50 deg (head) or 0.
    #[test]
    fn the_terms_of_the_bounds() {
        let b50 = "nutating-head-b50";
        for (name, tilt, turn, piece, rate, bend) in [
            (
                b50,
                30.0,
                30.0,
                (0.25, 0.5),
                [1.171_307_298_968_873_5, 0.828_239_333_954_189_1],
                [2.622_154_993_650_175, 1.069_964_842_856_605],
            ),
            (
                b50,
                85.0,
                12.0,
                (0.0, 1.0),
                [0.868_983_117_466_426_4, 0.868_983_117_466_426_4],
                [5.729_055_062_071_052, 1.698_534_861_815_903_3],
            ),
            (
                "ferrari-bc",
                30.0,
                10.0,
                (0.0, 1.0),
                [0.349_065_850_398_865_95, 0.224_375_203_601_086_18],
                [0.271_314_401_094_382_3, 0.139_960_052_470_608_14],
            ),
        ] {
            let machine = builtin(name).expect("built in");
            let pole = machine.constants.rotary[0].direction;
            let across = if pole.x.abs() < 0.5 { Vec3::x() } else { Vec3::y() };
            let at = |tilt: f64| {
                let (sin, cos) = trunnion_geometry::math::sin_cos(trunnion_geometry::rad(tilt));
                pole * cos + across * sin
            };
            let pair = machine.constants.pair.as_ref().expect("two rotary axes");
            let circle = GreatCircle::new(
                machine,
                pair,
                [at(tilt), at(tilt + 90.0)],
                trunnion_geometry::rad(turn),
                1,
            );
            let found = circle.bounds(piece.0, piece.1);
            for i in 0..2 {
                let near = |found: f64, wanted: f64| (found - wanted).abs() <= 1e-7 * wanted;
                assert!(
                    near(found.rate[i], rate[i]) && near(found.bend[i], bend[i]),
                    "{name}: {found:?}, not {rate:?} {bend:?}"
                );
            }
        }
    }

    /// Circles that pass close by the pole, in both postures: the joints run without jumps, by more than half a turn too.
    #[test]
    fn the_first_axis_turns_without_jumps_hard_by_the_pole() {
        const STEPS: usize = 4000;
        let mut more_than_half_a_turn = 0;
        for name in BUILTIN_MACHINES {
            let machine = builtin(name).expect("built in");
            let Some(pair) = &machine.constants.pair else { continue };
            let e1 = machine.constants.rotary[0].direction;
            let across = if e1.x.abs() < 0.5 { Vec3::x() } else { Vec3::y() };
            let tilted =
                |azimuth: f64, tilt: f64| rotate(&e1, azimuth, &rotate(&e1.cross(&across).normalize(), tilt, &e1));
            for (tilts, turn, branch) in [0.98, 0.995, -0.98, -0.995].iter().flat_map(|share| {
                [(0.1, 0.5), (0.5, 0.1), (0.4, 0.4)]
                    .into_iter()
                    .flat_map(move |tilts| [1, -1].map(|branch| (tilts, share * PI, branch)))
            }) {
                let (from, to) = (tilted(0.3, tilts.0), tilted(0.3 + turn, tilts.1));
                let side = (to - from * from.dot(&to)).normalize();
                let circle = GreatCircle::new(machine, pair, [from, side], angle_between(&from, &to), branch);
                let Orientations::Postures(postures) = orientations(machine, &from) else {
                    continue;
                };
                let Some(posture) = postures.iter().find(|posture| posture.branch == branch) else {
                    continue;
                };
                let mut last = posture.q;
                for step in 1..=STEPS {
                    let t = step as f64 / STEPS as f64;
                    let Some(next) = circle.joints(t, posture.q) else {
                        // out of reach
                        break;
                    };
                    let moved = (next[0] - last[0]).abs().max((next[1] - last[1]).abs());
                    assert!(
                        moved < 0.3,
                        "{name} {tilts:?} {turn} {branch} at {t}: {last:?} to {next:?}"
                    );
                    last = next;
                }
                more_than_half_a_turn += usize::from((last[0] - posture.q[0]).abs() > PI);
            }
        }
        assert!(more_than_half_a_turn > 4, "{more_than_half_a_turn}");
    }
}
