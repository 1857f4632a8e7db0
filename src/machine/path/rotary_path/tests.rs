//! The course of the rotary axes, against the joints themselves and numbers of another program.
use super::{GreatCircle, RotaryPath};
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
        [(0.2, 0.9), (0.6, 0.9), (1.0, 0.9), (0.2, 0.1), (0.5, 0.1), (1.26, 0.5)].map(|(tilt, to)| (name, tilt, to))
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
        let Some(RotaryPath::GreatCircle(circle)) = RotaryPath::new(&machine, &leg, start, stop) else {
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
        let found = circle.by_reach(&circle.piece(piece.0, piece.1));
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
        let tilted = |azimuth: f64, tilt: f64| rotate(&e1, azimuth, &rotate(&e1.cross(&across).normalize(), tilt, &e1));
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

/// Along the edge of a head's reach both axes turn evenly, although S is small: the bounds see it.
#[test]
fn bounds_at_the_edge_of_reach_are_near_the_truth() {
    let machine = builtin("nutating-head-b45").expect("built in");
    let pair = machine.constants.pair.as_ref().expect("two rotary axes");
    let from = Vec3::new(-0.176_277_7, -0.984_334_9, 0.003_304).normalize();
    let to = Vec3::new(0.153_847_7, -0.988_088, 0.003_613_8).normalize();
    let side = (to - from * from.dot(&to)).normalize();
    let circle = GreatCircle::new(machine, pair, [from, side], angle_between(&from, &to), 1);
    let Orientations::Postures(postures) = orientations(machine, &from) else {
        panic!("in reach");
    };
    let start = postures.iter().find(|posture| posture.branch == 1).expect("both").q;
    let bounds = circle.bounds(0.5, 0.5005);
    let (now, h) = (rates(machine, &circle, 0.5, start), 1e-4);
    let [before, after] = [0.5 - h, 0.5 + h].map(|t| rates(machine, &circle, t, start));
    for i in 0..2 {
        let bend = (after[i] - before[i]).abs() / (2.0 * h);
        assert!(bounds.rate[i] <= now[i].abs() * 1.03, "{now:?} {bounds:?}");
        assert!(bounds.bend[i] <= bend.max(0.01) * 2.0, "{bend} {bounds:?}");
    }
}
