//! Inside a block: the way starts and ends where the stances are, keeps to the programmed path, and bends no more than its bound says.
use crate::common::{position, vector, words};
use crate::random::{Random, random_machine};
use trunnion_geometry::{Vec3, arc, deg};
use trunnion_interp::{Motion, MotionKind, Position};
use trunnion_machine::{BlockPath, Follower, Leg, Machine, builtin, tip_deviation};

fn two(machine: &Machine, first: &Motion, second: &Motion) -> Leg {
    let mut follower = Follower::new(machine);
    follower.follow(first);
    follower.follow(second)
}

/// Largest distance of the sampled tip path from its chord, and whether second differences stay below the bound.
fn judge(machine: &Machine, leg: &Leg, label: &str) -> f64 {
    let way = BlockPath::new(machine, leg).unwrap_or_else(|| panic!("{label}: a way"));
    let (start, end) = (leg.start.expect("start"), leg.end.clone().expect("end"));
    assert!((way.at(1.0).tip - end.tip).norm() < 1e-9, "{label}");
    assert!((way.at(1.0).axis - end.axis).norm() < 1e-12, "{label}");
    assert!((way.at(0.0).axis - start.axis).norm() < 1e-12, "{label}");
    let tips: Vec<Vec3> = (0..=64).map(|i| way.at(f64::from(i) / 64.0).tip).collect();
    let h = 1.0 / 64.0;
    for triple in tips.windows(3) {
        let second = (triple[0] - triple[1] * 2.0 + triple[2]).norm() / (h * h);
        assert!(
            second <= way.tip_bend() + 1e-6 * (1.0 + second),
            "{label}: {second} above {}",
            way.tip_bend()
        );
    }
    let chord = tips[64] - tips[0];
    let off = |tip: &Vec3| {
        let share = ((tip - tips[0]).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
        (tip - tips[0] - chord * share).norm()
    };
    tips.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn without_tcp_the_way_strays_as_far_as_the_deviation_says() {
    let mut random = Random(7);
    let mut strayed = 0;
    for case in 0..60 {
        let machine = random_machine(&mut random, case % 2 == 0, "joint");
        let spot = |random: &mut Random| {
            let linear = |random: &mut Random| random.range(-200.0, 200.0);
            let words = [
                (b'X', linear(random)),
                (b'Y', linear(random)),
                (b'Z', linear(random)),
                (b'A', random.range(-80.0, 80.0)),
                (b'C', random.range(-180.0, 180.0)),
            ];
            position(&words)
        };
        let (from, to) = (spot(&mut random), spot(&mut random));
        let leg = two(&machine, &words(Position::default(), from), &words(from, to));
        let strays = judge(&machine, &leg, &format!("machine {case}"));
        let deviation = tip_deviation(&machine, &leg, 1e-3).expect("modelled");
        assert!(strays <= deviation.bound_mm + 1e-9, "{case}: {strays} {deviation:?}");
        assert!(strays >= deviation.sampled_mm * 0.98, "{case}: {strays} {deviation:?}");
        strayed += u32::from(strays > 1.0);
    }
    assert!(strayed > 50, "{strayed}");
}

#[test]
fn with_tcp_the_tip_keeps_to_its_line_and_to_its_arc() {
    let machine = builtin("mikron-ucp710").expect("built in");
    let from = vector(Position::default(), [10.0, 0.0, 5.0], Vec3::new(0.2, 0.1, 1.0));
    let to = vector(from.end, [-10.0, 30.0, 8.0], Vec3::new(-0.3, 0.4, 1.0));
    let leg = two(machine, &from, &to);
    assert!(judge(machine, &leg, "line") < 1e-9);
    let middle = BlockPath::new(machine, &leg).expect("a way").at(0.5);
    assert!((middle.tip - Vec3::new(0.0, 15.0, 6.5)).norm() < 1e-9);
    // joint-linear rotaries: the middle of C is the middle of its words
    let c = machine.joint(b'C').expect("C");
    let (a, b) = (
        leg.start.expect("known").joints[c],
        leg.end.clone().expect("known").joints[c],
    );
    assert!((deg(middle.joints[c]) - deg(0.5 * (a + b))).abs() < 1e-9);

    let (start, end) = (Vec3::new(10.0, 0.0, 5.0), Vec3::new(-10.0, 0.0, 5.0));
    let half = arc::Arc::from_centre(
        start,
        end,
        Vec3::new(0.0, 0.0, 5.0),
        Vec3::z(),
        arc::Turning::CounterClockwise,
        0,
    );
    let turn = Motion {
        kind: MotionKind::Arc(half),
        ..vector(from.end, [-10.0, 0.0, 5.0], Vec3::new(-0.3, 0.4, 1.0))
    };
    let leg = two(machine, &from, &turn);
    judge(machine, &leg, "arc");
    let top = BlockPath::new(machine, &leg).expect("a way").at(0.5).tip;
    assert!((top - Vec3::new(0.0, 10.0, 5.0)).norm() < 1e-9, "{top}");
}
