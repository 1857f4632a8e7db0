//! The saddle of docs/kinematics.md#test-pieces on a table-table machine without tool centre point control: the error of its trajectory surface.
use core::f64::consts::TAU;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Feed, Motion, MotionKind, Orientation, Position};
use trunnion_machine::{BlockPath, Follower, Leg, MAX_AXES, Machine, Orientations, builtin, inverse, orientations};
use trunnion_pieces::{Piece, SWall, s_wall, saddle, saddle_net};
use trunnion_surface::{Errors, Judge, MOST_LOOKS, Options, Required, Sheet, required};
use trunnion_syntax::BlockId;

/// Part zero above the centre of both rotary axes, mm.
const ORIGIN: Vec3 = Vec3::new(0.0, 0.0, 50.0);

/// Legs of a piece in joints, all with A >= 0; C nearest to the last value, or in -180..180 deg.
fn legs(machine: &Machine, piece: &Piece, naive: bool) -> Vec<Leg> {
    let mut follower = Follower::new(machine);
    let (mut start, mut c, mut legs) = (Position::default(), 0.0, Vec::new());
    for (index, step) in piece.moves.iter().enumerate() {
        let solved = match orientations(machine, &step.axis) {
            Orientations::Pole(a) => [if naive { 0.0 } else { c }, a],
            Orientations::Postures(all) => all.iter().find(|s| s.q[1] >= 0.0).expect("A >= 0").q,
            Orientations::Unreachable(_) => panic!("reachable"),
        };
        c = if naive {
            solved[0]
        } else {
            solved[0] + TAU * ((c - solved[0]) / TAU).round()
        };
        let mut joints = [0.0; MAX_AXES];
        for (&joint, value) in machine.rotary.iter().zip([c, solved[1]]) {
            joints[joint] = value;
        }
        inverse(machine, &mut joints, &(step.tip + ORIGIN), 0.0).expect("solvable");
        let mut end = start;
        for (letter, axis) in [(b'X', 0), (b'Y', 1), (b'Z', 2)] {
            end.set(axis, joints[machine.joint(letter).expect("there")]);
        }
        end.set(3, deg(solved[1]));
        end.set(5, deg(c));
        legs.push(follower.follow(&Motion {
            block: BlockId(index as u32),
            kind: if index == 0 {
                MotionKind::Rapid
            } else {
                MotionKind::Linear
            },
            feed: Feed::PerMinute(500.0),
            spindle_on: Some(true),
            ..Motion::line(start, end)
        }));
        start = end;
    }
    legs
}

fn judge(machine: &Machine, required: &Required, legs: &[Leg], close: f64) -> Errors {
    judge_within(machine, required, legs, (close, MOST_LOOKS))
}

fn judge_within(machine: &Machine, required: &Required, legs: &[Leg], (close, looks): (f64, u64)) -> Errors {
    let options = Options {
        offset: 0.0,
        reach: 1.0,
        close,
        spots: 0,
        looks,
    };
    let mut judge = Judge::new(required, machine, options);
    for leg in legs {
        judge.leg(leg, true);
    }
    judge.finish()
}

fn moved_net() -> String {
    let row = |row: &Vec<Vec3>| {
        let points: Vec<String> = row
            .iter()
            .map(|p| p + ORIGIN)
            .map(|p| format!("[{}, {}, {}]", p.x, p.y, p.z))
            .collect();
        format!("[{}]", points.join(", "))
    };
    let rows: Vec<String> = saddle_net().iter().map(row).collect();
    format!(
        "schema = \"trunnion-surface/1\"\n[[patch]]\nrows = [{}]\n",
        rows.join(", ")
    )
}

/// The published maxima are those at the middle of a block; the largest of the whole block is a little above them.
#[test]
fn the_saddle_strays_as_published() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let surface = required(&moved_net(), false, 0.01).expect("a surface");
    for (columns, naive, middle) in [
        (20, true, 104.155),
        (20, false, 12.937),
        (40, false, 5.666),
        (80, false, 1.763),
    ] {
        let piece = saddle(columns, 20, 500.0).expect("a piece");
        let legs = legs(machine, &piece, naive);
        let errors = judge(machine, &surface, &legs, 0.01);
        let found = errors.from_segment.expect("known");
        // approach and retract belong to no surface
        assert_eq!((errors.apart, errors.farthest_apart.round()), (2, 20.0));
        let at_half = legs[2..legs.len() - 1].iter().map(off_at_half).fold(0.0, f64::max);
        assert!((at_half - middle).abs() < 1e-3, "{columns}: {at_half}");
        assert!(
            found.sampled >= at_half - 1e-9 && found.bound < middle * 1.003,
            "{columns}: {found:?}"
        );
        assert_eq!((errors.not_judged, errors.placed), (0, errors.judged));
        // the same place is farther away than the nearest point of the segment, the nearest point of the surface is nearer
        let (same, surface) = (errors.same_place.expect("known"), errors.from_surface.expect("known"));
        assert!(
            same.sampled > found.sampled && surface.sampled < same.sampled,
            "{errors:?}"
        );
        for one in [same, surface] {
            assert!(one.bound >= one.sampled && one.bound <= one.sampled + 0.03, "{one:?}");
        }
    }
}

/// Distance of the tip from the segment in the middle of a block.
fn off_at_half(leg: &Leg) -> f64 {
    let machine = builtin("mikron-ucp710").expect("built in");
    let way = BlockPath::new(machine, leg).expect("a way");
    let [a, tip, b] = [0.0, 0.5, 1.0].map(|t| way.at(t).tip);
    let share = ((tip - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
    (tip - a - (b - a) * share).norm()
}

/// Many samples of every block: none is above the bounds, and the sampled maxima are nearly reached.
#[test]
fn bounds_hold_against_many_samples() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let surface = required(&moved_net(), false, 0.005).expect("a surface");
    let piece = saddle(12, 9, 500.0).expect("a piece");
    let legs = legs(machine, &piece, false);
    let errors = judge(machine, &surface, &legs, 0.002);
    let found = errors.from_surface.expect("known");
    let mut most = 0.0_f64;
    for leg in &legs[2..legs.len() - 1] {
        let way = BlockPath::new(machine, leg).expect("a way");
        for i in 0..=100 {
            most = most.max(surface.nearest(&way.at(f64::from(i) / 100.0).tip).distance);
        }
    }
    assert!(most <= found.bound && most >= found.sampled - 0.01, "{most} {found:?}");
}

/// Between its points the S-wall's path under tool centre point control keeps its chord error from the exact ruled surface.
#[test]
fn the_s_wall_keeps_its_chord_error_from_the_exact_wall() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let mut before = f64::MAX;
    for chord in [0.5, 0.1, 0.01] {
        let sizes = SWall {
            lean_deg: 15.0,
            waves: 2,
            height: 30.0,
            tool_diameter: 0.0,
            chord,
            tilt_deg: 15.0,
            right: false,
            feed_mm_min: 500.0,
        };
        let piece = s_wall(&sizes).expect("a piece");
        let wall = Required::from_sheets(vec![Sheet::Grid(sizes.grid(1600))], 1e-3).expect("a surface");
        let mut follower = Follower::new(machine);
        let options = Options {
            offset: 0.0,
            reach: 1.0,
            close: 1e-4,
            spots: 0,
            looks: MOST_LOOKS,
        };
        let mut judge = Judge::new(&wall, machine, options);
        let mut start = Position::default();
        let count = piece.moves.len();
        for (index, step) in piece.moves.iter().enumerate() {
            let mut end = start;
            (0..3).for_each(|axis| end.set(axis, step.tip[axis]));
            let leg = follower.follow(&Motion {
                block: BlockId(index as u32),
                kind: if index == 0 || index + 1 == count {
                    MotionKind::Rapid
                } else {
                    MotionKind::Linear
                },
                orientation: Orientation::Vector(None, step.axis),
                tcp: true,
                feed: Feed::PerMinute(500.0),
                spindle_on: Some(true),
                ..Motion::line(start, end)
            });
            start = end;
            judge.leg(&leg, true);
        }
        let found = judge.finish().from_surface.expect("known");
        // the tip runs on chords of the lower edge: beside the wall by at most their error, and by nearly that somewhere
        assert!(
            found.sampled <= chord + 1e-3 && found.sampled > 0.2 * chord,
            "{chord}: {found:?}"
        );
        assert!(found.bound <= found.sampled + wall.off + 2e-4);
        // the exact distance at that place: the wall by its formula, searched in fine steps
        let exact = (0..=16_000)
            .map(|i| (found.point - sizes.wall(160.0 * f64::from(i) / 16_000.0, 0.0)).norm())
            .fold(f64::MAX, f64::min);
        let inner = (0..=100)
            .flat_map(|i| (0..=10).map(move |j| (f64::from(i), f64::from(j))))
            .map(|(i, j)| (found.point - sizes.wall(160.0 * i / 100.0, j / 10.0)).norm())
            .fold(f64::MAX, f64::min);
        assert!(
            (found.sampled - exact.min(inner)).abs() < 6e-3,
            "{chord}: {} and {exact}, {inner}",
            found.sampled
        );
        assert!(found.sampled < before);
        before = found.sampled;
    }
}

/// Blocks for which nothing more may be looked at are counted and not judged; what is said of the others holds.
#[test]
fn blocks_beyond_the_bound_are_not_judged() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let surface = required(&moved_net(), false, 0.005).expect("a surface");
    let legs = legs(machine, &saddle(12, 9, 500.0).expect("a piece"), false);
    let whole = judge(machine, &surface, &legs, 0.002);
    assert_eq!(
        (whole.given_up, whole.first_given_up, whole.first_loose),
        (0, None, None)
    );
    let all = whole.judged + whole.apart;
    let (mut parts, mut loose) = (0, 0);
    let steps = std::iter::successors(Some(1_u64), |looks| Some(looks + looks / 3 + 1));
    for looks in steps.take_while(|looks| *looks < MOST_LOOKS) {
        let errors = judge_within(machine, &surface, &legs, (0.002, looks));
        assert_eq!(errors.judged + errors.apart + errors.given_up, all, "{looks}");
        assert_eq!(errors.first_given_up.is_some(), errors.given_up > 0);
        parts += u32::from(errors.judged > 0 && errors.given_up > 0);
        loose += u32::from(errors.given_up == 0 && errors.first_loose.is_some());
        if let (Some(part), Some(found)) = (errors.from_surface, whole.from_surface) {
            assert!(part.sampled.is_finite() && part.bound.is_finite(), "{part:?}");
            assert!(part.sampled <= found.bound, "{part:?} {found:?}");
            // loose or not, the bound of all blocks is one
            assert!(errors.given_up > 0 || part.bound >= found.sampled, "{part:?} {found:?}");
        } else {
            assert_eq!(errors.judged, 0);
        }
        if errors == whole {
            break;
        }
    }
    assert!(parts > 0 && loose > 0, "{parts} {loose}");
}
