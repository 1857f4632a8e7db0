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
        let circle = GreatCircle {
            machine,
            pair,
            start: start.axis,
            side: side.normalize(),
            angle,
            branch: start.branch,
        };
        let (from, to) = (start.rotary(machine), end.rotary(machine));
        let arrives = circle.near(1.0, circle.joints(0.999_999_9, from)?)?;
        let off = (arrives[0] - to[0]).abs().max((arrives[1] - to[1]).abs());
        // coming near the end by the shorter way must be coming to the end
        (off < ARRIVAL && (to[0] - from[0]).abs() < PI).then_some(Self::GreatCircle(circle))
    }
}

impl GreatCircle<'_> {
    /// Tool axis and its rate.
    fn axis(&self, t: f64) -> (Vec3, Vec3) {
        let (sin, cos) = sin_cos(self.angle * t);
        (
            self.start * cos + self.side * sin,
            (self.side * cos - self.start * sin) * self.angle,
        )
    }

    /// Rotary joints at t, on the turns nearest to `near`; `None` where there are none in this posture.
    fn near(&self, t: f64, near: [f64; 2]) -> Option<[f64; 2]> {
        let Orientations::Postures(postures) = orientations(self.machine, &self.axis(t).0) else {
            return None;
        };
        let found = postures.iter().find(|solution| solution.branch == self.branch)?;
        let turn = |i: usize| found.q[i] + TAU * ((near[i] - found.q[i]) / TAU).round();
        Some([turn(0), turn(1)])
    }

    /// Rotary joints at t for a block that starts at `from`. The azimuth of a great circle turns by less than pi.
    pub(crate) fn joints(&self, t: f64, from: [f64; 2]) -> Option<[f64; 2]> {
        self.near(t, from)
    }

    /// Rates of the turns at t: with f = R1 e2, t1' = -(u'.f) / S and t2' = (u'.e1) / S. `f` is the second axis turned by the first.
    pub(crate) fn rates(&self, t: f64, f: &Vec3) -> [f64; 2] {
        let (u, rate) = self.axis(t);
        let e1 = self.machine.constants.rotary[0].direction;
        let s = e1.dot(&f.cross(&u));
        [-rate.dot(f) / s, rate.dot(&e1) / s]
    }

    /// Bounds over a piece. The angle between u and e1 changes by at most `angle` per block, S^2 = D (1 - y^2) - (e1.u - c y)^2; second
    /// derivatives from u'' = -angle^2 u, multiplied by f and by e1.
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
        let bend1 = (w * w * pair.y.abs() + first * first * (pair.c.abs() + pair.y.abs()) + 2.0 * first * second) / s;
        let bend2 = (w * w + second * second * (1.0 + (pair.c * pair.y).abs())) / s;
        SpinBounds {
            rate: [first, second],
            bend: [bend1, bend2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{GreatCircle, Spin};
    use crate::{BUILTIN_MACHINES, Follower, Machine, builtin};
    use trunnion_geometry::Vec3;
    use trunnion_geometry::math::rotate;
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
                [8.680_195_306_606_201, 2.781_898_579_167_786_6],
            ),
            (
                b50,
                85.0,
                12.0,
                (0.0, 1.0),
                [0.868_983_117_466_426_4, 0.868_983_117_466_426_4],
                [10.411_049_866_414_457, 4.609_632_539_885_379],
            ),
            (
                "ferrari-bc",
                30.0,
                10.0,
                (0.0, 1.0),
                [0.349_065_850_398_865_95, 0.224_375_203_601_086_18],
                [0.313_286_885_013_727_4, 0.161_611_947_939_399_48],
            ),
        ] {
            let machine = builtin(name).expect("built in");
            let pole = machine.constants.rotary[0].direction;
            let across = if pole.x.abs() < 0.5 { Vec3::x() } else { Vec3::y() };
            let at = |tilt: f64| {
                let (sin, cos) = trunnion_geometry::math::sin_cos(trunnion_geometry::rad(tilt));
                pole * cos + across * sin
            };
            let circle = GreatCircle {
                machine,
                pair: machine.constants.pair.as_ref().expect("two rotary axes"),
                start: at(tilt),
                side: at(tilt + 90.0),
                angle: trunnion_geometry::rad(turn),
                branch: 1,
            };
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
}
