//! Obstacles: the frame that they stand in, exact distances of an upright tool, and proofs for any other motion against dense samples.
use crate::common::{motion, position};
use proptest::prelude::*;
use trunnion_geometry::Vec3;
use trunnion_geometry::plane::{Point, Polygon};
use trunnion_interp::{Motion, MotionKind};
use trunnion_machine::{
    BUILTIN_MACHINES, BlockPath, Follower, Footprint, Leg, Machine, Nearness, Obstacle, Obstacles, RapidPath, ToolBody,
    builtin, forward, nearness, nearness_with_part, tool_in_frame,
};

pub(crate) fn prism(corners: &[[f64; 2]], bottom: f64, top: f64) -> Obstacle {
    let corners: Vec<Point> = corners.iter().map(|&corner| Point::from(corner)).collect();
    Obstacle {
        name: "clamp".into(),
        axis: None,
        footprint: Footprint::Polygon(Polygon::new(&corners).expect("a polygon")),
        bottom,
        top,
        kind: trunnion_machine::ObstacleKind::Body,
    }
}

/// A plain cylinder of this radius.
pub(crate) fn body(radius_mm: f64, length_mm: Option<f64>) -> ToolBody {
    ToolBody {
        radius_mm,
        holder_mm: None,
        length_mm,
    }
}

pub(crate) fn with(name: &str, obstacle: Obstacle) -> Machine {
    let mut machine = builtin(name).expect("built in").clone();
    machine.obstacles = Obstacles(vec![obstacle]);
    machine
}

/// The leg of a motion between two positions.
pub(crate) fn leg(machine: &Machine, kind: MotionKind, tcp: bool, [from, to]: [&[(u8, f64)]; 2]) -> Leg {
    let mut follower = Follower::new(machine);
    let (start, end) = (position(from), position(to));
    let at = Motion {
        end: start,
        tcp,
        kind: MotionKind::Rapid,
        ..motion()
    };
    follower.follow(&at);
    follower.follow(&Motion {
        start,
        end,
        tcp,
        kind,
        ..motion()
    })
}

#[test]
fn the_frame_of_the_workpiece_is_that_of_forward_kinematics() {
    for name in BUILTIN_MACHINES {
        let machine = builtin(name).expect("built in");
        let mut joints = [0.0; trunnion_machine::MAX_AXES];
        for (index, value) in joints.iter_mut().enumerate().take(machine.axes.len()) {
            *value = 0.3 + 0.21 * index as f64;
        }
        for (joint, value) in machine.held() {
            joints[joint] = value;
        }
        let (own, known) = (
            tool_in_frame(machine, &joints, 70.0, 0),
            forward(machine, &joints, 70.0),
        );
        assert!(
            (own.tip - known.tip).norm() < 1e-9 && (own.axis - known.axis).norm() < 1e-12,
            "{name}"
        );
    }
}

/// A body that turns with C is where the part is; one without an axis stays where it is when the table turns.
#[test]
fn an_obstacle_turns_with_its_axis_only() {
    let square = [[40.0, -5.0], [50.0, -5.0], [50.0, 5.0], [40.0, 5.0]];
    let gap = |axis: Option<u8>, c: f64, x: f64, y: f64| {
        let machine = with(
            "mikron-ucp710",
            Obstacle {
                axis,
                ..prism(&square, 0.0, 20.0)
            },
        );
        let down = |z: f64| vec![(b'X', x), (b'Y', y), (b'Z', z), (b'A', 0.0), (b'C', c)];
        let (from, to) = (down(100.0), down(10.0));
        let leg = leg(&machine, MotionKind::Linear, false, [&from, &to]);
        nearness(&machine, &leg, &body(2.0, None), 0.0)[0].nearness
    };
    assert_eq!(gap(Some(b'C'), 0.0, 45.0, 0.0), Nearness::Through);
    assert_eq!(gap(None, 0.0, 45.0, 0.0), Nearness::Through);
    assert_eq!(gap(None, 90.0, 45.0, 0.0), Nearness::Through);
    assert!(matches!(gap(Some(b'C'), 90.0, 45.0, 0.0), Nearness::Clear(mm) if mm > 10.0));
    // C turns the part clockwise against the tool or the other way round: it is on one of the two sides
    let sides = [gap(Some(b'C'), 90.0, 0.0, 45.0), gap(Some(b'C'), 90.0, 0.0, -45.0)];
    assert_eq!(
        sides.iter().filter(|side| **side == Nearness::Through).count(),
        1,
        "{sides:?}"
    );
}

#[test]
fn an_upright_tool_is_judged_exactly() {
    let machine = with(
        "mill-3axis",
        prism(&[[10.0, 10.0], [20.0, 10.0], [20.0, 20.0], [10.0, 20.0]], 0.0, 30.0),
    );
    let near = |from: [f64; 3], to: [f64; 3], radius: f64, keep: f64| {
        let word = |at: [f64; 3]| vec![(b'X', at[0]), (b'Y', at[1]), (b'Z', at[2])];
        let leg = leg(&machine, MotionKind::Rapid, false, [&word(from), &word(to)]);
        nearness_with_part(&machine, &leg, &body(radius, None), keep)[0].nearness
    };
    // beside it, touching it with the clearance, nearer, through
    assert_eq!(near([0.0, 5.0, 0.0], [30.0, 5.0, 0.0], 3.0, 1.0), Nearness::Clear(2.0));
    assert_eq!(near([0.0, 5.0, 0.0], [30.0, 5.0, 0.0], 4.0, 1.0), Nearness::Clear(1.0));
    assert_eq!(
        near([0.0, 5.0, 0.0], [30.0, 5.0, 0.0], 4.5, 1.0),
        Nearness::Near(Some(0.5))
    );
    assert_eq!(near([0.0, 5.0, 0.0], [30.0, 5.0, 0.0], 5.5, 1.0), Nearness::Through);
    // the spindle follows the tool: also below the obstacle
    assert_eq!(
        near([0.0, 15.0, -50.0], [30.0, 15.0, -50.0], 3.0, 1.0),
        Nearness::Through
    );
    // above it, with the clearance in Z
    assert_eq!(
        near([0.0, 15.0, 31.0], [30.0, 15.0, 31.0], 3.0, 1.0),
        Nearness::Clear(f64::INFINITY)
    );
    assert!(matches!(
        near([0.0, 15.0, 30.5], [30.0, 15.0, 30.5], 3.0, 1.0),
        Nearness::Near(_) | Nearness::Through
    ));
    // down onto it from the side: only the low part counts
    assert_eq!(
        near([0.0, 15.0, 0.0], [3.0, 15.0, 40.0], 3.0, 1.0),
        Nearness::Clear(4.675_000_000_075)
    );
    // a tool without radius may run along its side, not through it
    assert_eq!(
        near([0.0, 10.0, 0.0], [30.0, 10.0, 0.0], 0.0, 0.0),
        Nearness::Clear(0.0)
    );
    assert_eq!(near([0.0, 10.1, 0.0], [30.0, 10.1, 0.0], 0.0, 0.0), Nearness::Through);
}

/// Where the axes may arrive one after the other, everything between the ends counts.
#[test]
fn independent_axes_may_pass_the_corner() {
    let mut machine = with(
        "mill-3axis",
        prism(&[[20.0, 0.0], [30.0, 0.0], [30.0, 10.0], [20.0, 10.0]], 0.0, 30.0),
    );
    let (from, to) = (
        [(b'X', 0.0), (b'Y', 0.0), (b'Z', 0.0)],
        [(b'X', 25.0), (b'Y', 30.0), (b'Z', 0.0)],
    );
    let mut near = |rapid| {
        machine.control.rapid = rapid;
        let leg = leg(&machine, MotionKind::Rapid, false, [&from, &to]);
        nearness(&machine, &leg, &body(1.0, None), 1.0)[0].nearness
    };
    assert!(matches!(near(RapidPath::Synchronous), Nearness::Clear(mm) if mm > 5.0));
    assert!(matches!(near(RapidPath::Dogleg), Nearness::Unknown(_)));
    assert!(matches!(near(RapidPath::Undeclared), Nearness::Unknown(_)));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]
    /// Tilted, turning, with and without tool centre point control, with and without a holder: what is called clear is clear at 60 moments and many
    /// points of the bodies, what is called through comes near at one of them.
    #[test]
    fn what_is_proved_holds_at_every_sample(
        name in prop_oneof![Just("mikron-ucp710"), Just("ferrari-bc"), Just("fork-ca")],
        from in (-60.0..60.0, -60.0..60.0, 0.0..80.0, 0.0..60.0, -90.0..90.0),
        to in (-60.0..60.0, -60.0..60.0, 0.0..80.0, 0.0..60.0, -90.0..90.0),
        turns in prop_oneof![Just(0.0), 0.0..1.0],
        tcp in any::<bool>(),
        rapid in any::<bool>(),
        centre in proptest::array::uniform2(-60.0..60.0),
        size in 3.0..25.0,
        axis in any::<bool>(),
        radius in 1.0..8.0,
        holder in proptest::option::of(8.0..30.0),
    ) {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [0.2, 0.1], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [centre[0] + size * x, centre[1] + size * y]);
        let Some(base) = builtin(name) else { return Ok(()) };
        let letters: Vec<u8> = base.rotary.iter().map(|&joint| base.axes[joint].letter).collect();
        let carrier = axis.then(|| letters[0]);
        let machine = with(name, Obstacle { axis: carrier, ..prism(&corners, -5.0, 25.0) });
        let mut machine = machine;
        machine.control.rapid = RapidPath::Synchronous;
        let words = |at: (f64, f64, f64, f64, f64)| vec![(b'X', at.0), (b'Y', at.1), (b'Z', at.2), (letters[1], at.3), (letters[0], at.4)];
        let end = (to.0, to.1, to.2, from.3 + turns * (to.3 - from.3), from.4 + turns * (to.4 - from.4));
        let kind = if rapid { MotionKind::Rapid } else { MotionKind::Linear };
        let length = 60.0;
        let leg = leg(&machine, kind, tcp, [&words(from), &words(end)]);
        prop_assume!(leg.start.is_some() && leg.end.is_ok());
        let keep = 1.0;
        let tool = ToolBody { holder_mm: holder.map(|wide| (wide, length)), ..body(radius, Some(length)) };
        let found = nearness(&machine, &leg, &tool, keep)[0].nearness;
        let path = BlockPath::new(&machine, &leg).expect("a path");
        let frame = machine.obstacles[0].frame(&machine).expect("a frame");
        let obstacle = &machine.obstacles[0];
        let mut nearest = f64::INFINITY;
        for time in 0..=60 {
            let joints = path.at(f64::from(time) / 60.0).joints;
            let pose = tool_in_frame(&machine, &joints, length, frame);
            let aside = pose.axis.cross(&Vec3::x()).normalize();
            for height in 0..=60 {
                let height = 2.0 * f64::from(height);
                let wide = if height <= length { radius } else { holder.unwrap_or(0.0) };
                for (share, turn) in [(0.0, 0), (0.5, 0), (0.5, 2), (0.5, 4), (0.5, 6), (1.0, 1), (1.0, 3), (1.0, 5), (1.0, 7), (1.0, 8)] {
                    let (sin, cos) = trunnion_geometry::math::sin_cos(f64::from(turn) * std::f64::consts::FRAC_PI_4);
                    let across = aside * cos + pose.axis.cross(&aside) * sin;
                    let point: Vec3 = pose.tip + pose.axis * height + across * (share * wide);
                    let flat = obstacle.footprint.distance(&point.xy());
                    let beyond = (obstacle.bottom - point.z).max(point.z - obstacle.top).max(0.0);
                    nearest = nearest.min(trunnion_geometry::math::hypot(flat, beyond));
                }
            }
        }
        match found {
            Nearness::Clear(_) => prop_assert!(nearest >= keep - 1e-6, "{nearest}"),
            // neighbouring points of the samples are up to this far apart
            Nearness::Through => prop_assert!(nearest < 2.5 + 0.8 * holder.unwrap_or(radius), "{nearest} {radius}"),
            _ => {}
        }
    }
}

/// A tilted tool clears a clamp, but the holder above it is inside; or only the rim of its lower face is.
#[test]
fn a_tilted_holder_that_touches_is_found() {
    let clamp = Obstacle {
        axis: Some(b'C'),
        ..prism(&[[15.0, -60.0], [60.0, -60.0], [60.0, 20.0], [15.0, 20.0]], -30.0, 60.0)
    };
    let machine = with("mikron-ucp710", clamp);
    let near = |tilt: f64, from: f64, to: f64, holder: Option<f64>| {
        let word = |x: f64| vec![(b'X', x), (b'Y', 0.0), (b'Z', 0.0), (b'A', tilt), (b'C', 0.0)];
        let leg = leg(&machine, MotionKind::Linear, true, [&word(from), &word(to)]);
        let tool = ToolBody {
            holder_mm: holder.map(|radius| (radius, 50.0)),
            ..body(3.0, Some(50.0))
        };
        nearness(&machine, &leg, &tool, 0.0)[0].nearness
    };
    for tilt in [0.001, 5.0, 20.0, 25.0] {
        assert_eq!(near(tilt, 0.0, 1.0, Some(25.0)), Nearness::Through, "{tilt}");
        // 12 mm to the tool
        assert_eq!(near(tilt, 0.0, 1.0, Some(10.0)), Nearness::Clear(0.0), "{tilt}");
    }
    assert_eq!(near(-20.0, 0.0, 1.0, Some(25.0)), Nearness::Through);
    // beyond the clamp
    assert!(matches!(near(-89.0, -90.0, -80.0, Some(25.0)), Nearness::Clear(_)));
}

/// What is above the declared length of a tilted tool counts as above an upright one: a holder is there, and without one it is unknown.
#[test]
fn what_is_above_a_tilted_tool_counts() {
    let clamp = Obstacle {
        axis: Some(b'C'),
        ..prism(
            &[[-20.0, -120.0], [20.0, -120.0], [20.0, -70.0], [-20.0, -70.0]],
            0.0,
            60.0,
        )
    };
    let machine = with("mikron-ucp710", clamp);
    let near = |holder_mm| {
        let word = |x: f64| vec![(b'X', x), (b'Y', 0.0), (b'Z', 0.0), (b'A', 60.0), (b'C', 0.0)];
        let leg = leg(&machine, MotionKind::Linear, true, [&word(0.0), &word(5.0)]);
        let tool = ToolBody {
            holder_mm,
            ..body(3.0, Some(50.0))
        };
        nearness(&machine, &leg, &tool, 0.0)[0].nearness
    };
    assert_eq!(near(Some((25.0, 50.0))), Nearness::Through);
    assert!(
        matches!(near(None), Nearness::Unknown(why) if why.contains("not declared")),
        "{:?}",
        near(None)
    );
}

/// The corner of a flat end would touch, the ball does not: nobody says here which one it is, so contact is not proved.
#[test]
fn a_ball_end_is_not_taken_for_a_flat_one() {
    let step = Obstacle {
        axis: Some(b'C'),
        ..prism(
            &[[-20.0, -30.0], [20.0, -30.0], [20.0, -4.5], [-20.0, -4.5]],
            -10.0,
            0.5,
        )
    };
    let machine = with("mikron-ucp710", step);
    // the tip is at Y0 Z0, 60 mm below the gauge point; the tool leans by 5 deg, and the centre of its ball is at about Y-0.4 Z5: 6 mm from the step
    let (sin, cos) = trunnion_geometry::math::sin_cos(trunnion_geometry::rad(5.0));
    let word = |x: f64| {
        vec![
            (b'X', x),
            (b'Y', -60.0 * sin),
            (b'Z', 60.0 * cos),
            (b'A', 5.0),
            (b'C', 0.0),
        ]
    };
    let leg = leg(&machine, MotionKind::Linear, true, [&word(0.0), &word(1.0)]);
    let found = nearness(&machine, &leg, &body(5.0, Some(60.0)), 0.0)[0].nearness;
    assert!(matches!(found, Nearness::Unknown(_)), "{found:?}");
}

proptest! {
    /// The check of bounding boxes gives the verdict of the exact distance, and never a greater distance.
    #[test]
    fn boxes_change_no_verdict(
        from in proptest::array::uniform3(-60.0..60.0),
        to in proptest::array::uniform3(-60.0..60.0),
        centre in proptest::array::uniform2(-60.0..60.0),
        size in 1.0..25.0,
        top in 0.0..40.0,
        round in any::<bool>(),
        rapid in prop_oneof![Just(RapidPath::Synchronous), Just(RapidPath::Dogleg)],
        radius in 0.0..12.0,
        holder in proptest::option::of(8.0..30.0),
    ) {
        let [x, y] = centre;
        let corners = [[-1.0, -1.0], [1.0, -1.0], [0.2, 0.1], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]| [x + size * a, y + size * b]);
        let mut obstacle = prism(&corners, -50.0, top);
        if round {
            obstacle.footprint = Footprint::Circle { centre: Point::new(x, y), radius: size };
        }
        let mut machine = with("mill-3axis", obstacle);
        machine.control.rapid = rapid;
        let words = |at: [f64; 3]| vec![(b'X', at[0]), (b'Y', at[1]), (b'Z', at[2])];
        let leg = leg(&machine, MotionKind::Rapid, false, [&words(from), &words(to)]);
        let tool = ToolBody { holder_mm: holder.map(|wide| (wide, 30.0)), ..body(radius, Some(30.0)) };
        let by_boxes = nearness(&machine, &leg, &tool, 1.0)[0].nearness;
        let exact = nearness_with_part(&machine, &leg, &tool, 1.0)[0].nearness;
        if let (Nearness::Clear(low), Nearness::Clear(mm)) = (by_boxes, exact) {
            prop_assert!(low <= mm + 1e-9 && low >= 1.0 - 1e-9 && low.is_finite() == mm.is_finite(), "{low} {mm}");
        } else {
            prop_assert_eq!(by_boxes, exact);
        }
    }
}
