//! Two machines that should be one: the calibration sweep finds a pivot that is 0.05 mm off, in numbers.
use crate::kinematics::uncertainty::worst_pivot_error;
use crate::{Comparison, Effort, MAX_AXES, Machine, builtin, builtin_source, forward, load, pivot_sensitivity_between};
use trunnion_geometry::math::sin;
use trunnion_geometry::{Vec3, rad};

mod effort;

/// More effort than these tests need.
fn plenty() -> Effort {
    Effort::new(u64::from(u32::MAX))
}

/// A shipped machine with one line of one axis replaced.
fn planted(name: &str, letter: char, from: &str, to: &str) -> Machine {
    let source = builtin_source(name)
        .expect("shipped")
        .split("[[check]]")
        .next()
        .expect("a part");
    let (head, axis) = source.split_once(&format!("letter = \"{letter}\"")).expect("the axis");
    let changed = axis.replacen(from, to, 1);
    assert_ne!(changed, axis);
    load("planted", &format!("{head}letter = \"{letter}\"{changed}")).expect("valid")
}

#[test]
fn a_pivot_error_of_0_05_mm_is_found_by_the_fixed_tip_sweep() {
    for (name, letter, from, to) in [
        ("mikron-ucp710", 'A', "point = [0, 0, 0]", "point = [0, 0.05, 0]"),
        ("mikron-ucp710", 'C', "point = [0, 0, 0]", "point = [0.05, 0, 0]"),
        (
            "linuxcnc-xyzac-trt",
            'A',
            "point = [0, 20, 10]",
            "point = [0, 20, 10.05]",
        ),
        ("fork-head-ca", 'A', "point = [0, 0, 250]", "point = [0, 0, 250.05]"),
        (
            "nutating-head-b50",
            'B',
            "point = [0, 0, 160]",
            "point = [0.05, 0, 160]",
        ),
        (
            "linuxcnc-xyzacb-trsrn",
            'B',
            "point = [0, 50, 120]",
            "point = [0, 50.05, 120]",
        ),
    ] {
        let (believed, truth) = (builtin(name).expect("shipped"), planted(name, letter, from, to));
        let comparison = Comparison::new(believed, &truth).expect("the same axes");
        let worst = comparison
            .fixed_tip_sweep(&Vec3::new(10.0, 5.0, 30.0), 120.0, 360)
            .expect("a sweep");
        // at the least the error itself, at most twice
        assert!((0.02..=0.1001).contains(&worst.tip_mm), "{name} {letter}: {worst:?}");
        let entries = comparison.entries();
        assert!(
            entries.len() == 1 && entries[0].contains("0.05 mm apart"),
            "{entries:?}"
        );
        // with the axis at zero nothing shows: a comparison at home would miss it
        assert!(comparison.at(&[0.0; MAX_AXES], 120.0).tip_mm < 1e-12);
        let same = Comparison::new(believed, believed).expect("the same axes");
        assert!(
            same.fixed_tip_sweep(&Vec3::zeros(), 120.0, 360)
                .expect("a sweep")
                .tip_mm
                < 1e-12
        );
        assert!(same.entries().is_empty());
    }
}

#[test]
fn the_error_is_twice_the_sine_of_half_the_angle() {
    let believed = builtin("mikron-ucp710").expect("shipped");
    let truth = planted("mikron-ucp710", 'A', "point = [0, 0, 0]", "point = [0, 0.03, 0.04]");
    let comparison = Comparison::new(believed, &truth).expect("the same axes");
    for angle in [1.0, 30.0, 90.0, 120.0] {
        let mut joints = [0.0; MAX_AXES];
        joints[believed.joint(b'A').expect("A")] = rad(angle);
        joints[believed.joint(b'C').expect("C")] = rad(77.0);
        let found = comparison.at(&joints, 50.0).tip_mm;
        assert!((found - 0.1 * sin(rad(angle / 2.0))).abs() < 1e-12, "{angle}: {found}");
    }
}

/// A0 to A90 with the pivot of A 0.05 mm off: 2 sin(45 deg) 0.05 = 0.0707107 mm, proven from both sides; without motion of A nothing.
#[test]
fn along_a_block_the_bound_closes_on_the_truth() {
    let believed = builtin("mikron-ucp710").expect("shipped");
    let truth = planted("mikron-ucp710", 'A', "point = [0, 0, 0]", "point = [0, 0.05, 0]");
    let comparison = Comparison::new(believed, &truth).expect("the same axes");
    let wanted = 0.1 * sin(rad(45.0));
    for tcp in [false, true] {
        let leg = turn_of_a(believed, tcp, 0.0, 90.0);
        let found = comparison.along(&leg, 0.01, &mut plenty()).expect("known");
        assert!((found.worst.tip_mm - wanted).abs() < 1e-9, "{found:?}");
        assert!(found.bound_mm >= wanted && found.bound_mm <= 1.2 * wanted, "{found:?}");
        // a tolerance above the truth is proven to be kept
        let kept = comparison.along(&leg, wanted * 1.01, &mut plenty()).expect("known");
        assert!(kept.bound_mm <= wanted * 1.01 && kept.bound_mm >= wanted, "{kept:?}");
        // the worst is inside the block: A -80 to 80 passes through zero, its ends are the worst; 60 to 300 has it at 180
        let across = turn_of_a(believed, tcp, -60.0, 60.0);
        let found = comparison.along(&across, 1e-3, &mut plenty()).expect("known");
        assert!((found.worst.tip_mm - 0.05).abs() < 1e-9, "{found:?}");
    }
    assert_eq!(
        comparison
            .along(&turn_of_a(believed, true, 90.0, 90.0), 1e-3, &mut plenty())
            .map(|f| f.worst.tip_mm > 0.07),
        Some(true)
    );
}

/// C turns in the opposite direction: from 0 to 180 deg both machines end at one place, and half way the tips are on opposite sides of the axis,
/// two radii apart. Both bends are needed for the first bound, 2 pi^2 r / 8 = 2.467 r: half of it would pass for less than 1.5 r.
#[test]
fn both_paths_bend() {
    let believed = builtin("mikron-ucp710").expect("shipped");
    let truth = planted("mikron-ucp710", 'C', "sign = 1", "sign = -1");
    let comparison = Comparison::new(believed, &truth).expect("the same axes");
    let at = |c: f64| {
        let mut position = trunnion_interp::Position::default();
        for (axis, value) in [(0, 10.0), (1, 5.0), (2, 0.0), (3, 0.0), (5, c)] {
            position.set(axis, value);
        }
        position
    };
    let mut follower = crate::Follower::new(believed);
    follower.follow(&line(false, trunnion_interp::Position::default(), at(0.0)));
    let leg = follower.follow(&line(false, at(0.0), at(180.0)));
    let radius = 125_f64.sqrt();
    let found = comparison.along(&leg, 1.5 * radius, &mut plenty()).expect("known");
    assert!((found.worst.tip_mm - 2.0 * radius).abs() < 1e-9, "{found:?}");
    assert!(
        found.bound_mm >= 2.0 * radius * (1.0 - 1e-12) && found.bound_mm <= 2.4 * radius,
        "{found:?}"
    );
}

/// A feed motion along a line.
fn line(tcp: bool, start: trunnion_interp::Position, end: trunnion_interp::Position) -> trunnion_interp::Motion {
    trunnion_interp::Motion {
        tcp,
        tool_length_mm: 60.0,
        ..trunnion_interp::Motion::line(start, end)
    }
}

fn turn_of_a(machine: &Machine, tcp: bool, from: f64, to: f64) -> crate::Leg {
    let mut follower = crate::Follower::new(machine);
    let at = |a: f64| {
        let mut position = trunnion_interp::Position::default();
        for (axis, value) in [(0, 10.0), (1, 5.0), (2, 30.0), (3, a), (5, 40.0)] {
            position.set(axis, value);
        }
        position
    };
    let go = |start, end| line(tcp, start, end);
    follower.follow(&go(trunnion_interp::Position::default(), at(from)));
    follower.follow(&go(at(from), at(to)))
}

/// Random pairs of a machine and itself with one place, direction or gauge point off: no pose is farther off than what is proven
/// everywhere, no moment of a block farther than what is proven along it, and a place alone is proven tightly.
#[test]
fn bounds_of_planted_errors_are_never_below_random_poses() {
    let mut random = crate::kinematics::selftest::SplitMix(17);
    let mut judged = 0;
    for name in crate::BUILTIN_MACHINES {
        let believed = builtin(name).expect("shipped");
        let source = builtin_source(name)
            .expect("shipped")
            .split("[[check]]")
            .next()
            .expect("a part");
        for _ in 0..12 {
            let Some(truth) = spoiled(name, source, &mut random) else {
                continue;
            };
            let comparison = Comparison::new(believed, &truth).expect("the same axes");
            let everywhere = comparison.everywhere(200.0);
            let worst = comparison.random_poses(300, random.0).expect("poses").tip_mm;
            assert!(
                worst <= everywhere * (1.0 + 1e-9) + 1e-12,
                "{name}: {worst} {everywhere}"
            );
            judged += usize::from(everywhere.is_finite() && worst > 1e-6);
            // along a block between two poses the bound holds at every moment, also between the ends
            let (along, truth) = along_and_sampled(&comparison, believed, &mut random);
            assert!(
                along.bound_mm >= truth * (1.0 - 1e-9) - 1e-12,
                "{name}: {along:?} {truth}"
            );
            assert!(along.worst.tip_mm <= truth * 1.001 + 1e-9, "{name}: {along:?} {truth}");
        }
    }
    assert!(judged > 100, "{judged}");
}

/// A block between two random poses, with linear interpolation: the bound along it, and the worst of many samples.
fn along_and_sampled(
    comparison: &Comparison<'_>,
    machine: &Machine,
    random: &mut crate::kinematics::selftest::SplitMix,
) -> (crate::AlongBlock, f64) {
    let mut pose = || {
        let mut position = trunnion_interp::Position::default();
        if let Some(absent) = machine.absent_axis() {
            position.set(usize::from(absent), 0.0);
        }
        for (_, axis) in machine.own_axes() {
            let Some(letter) = trunnion_interp::AxisLetter::new(axis.letter) else {
                continue;
            };
            let value = match axis.extra.hold {
                Some(hold) => trunnion_geometry::deg(hold),
                None => random.between(-150.0, 150.0),
            };
            position.set(usize::from(letter.0), value);
        }
        position
    };
    let (from, to) = (pose(), pose());
    let mut follower = crate::Follower::new(machine);
    follower.follow(&line(false, trunnion_interp::Position::default(), from));
    let leg = follower.follow(&line(false, from, to));
    let along = comparison.along(&leg, 1e-3, &mut plenty()).expect("known");
    let (start, end) = (leg.start.as_ref().expect("known"), leg.end.as_ref().expect("known"));
    let sampled = (0..=400).map(|step| {
        let mut joints = start.joints;
        for (value, to) in joints.iter_mut().zip(end.joints) {
            *value += (to - *value) * f64::from(step) / 400.0;
        }
        comparison.at(&joints, end.tool_length).tip_mm
    });
    (along, sampled.fold(along.worst.tip_mm, f64::max))
}

/// The machine with one of its places moved by up to 0.1 mm, or one of its directions tilted by up to 0.001 in each component.
fn spoiled(name: &str, source: &str, random: &mut crate::kinematics::selftest::SplitMix) -> Option<Machine> {
    let words: Vec<(usize, usize)> = ["point = [", "dir = [", "tool_axis = ["]
        .iter()
        .flat_map(|word| source.match_indices(word).map(|(at, _)| (at, word.len())))
        .collect();
    let which = (random.between(0.0, words.len() as f64) as usize).min(words.len().checked_sub(1)?);
    let (at, length) = words[which];
    let is_direction = !source[at..].starts_with("point");
    let end = at + source[at..].find(']')?;
    let values: Vec<f64> = source[at + length..end]
        .split(',')
        .filter_map(|text| text.trim().parse().ok())
        .collect();
    let [x, y, z] = values[..] else { return None };
    let mut moved = Vec3::new(x, y, z);
    let size = if is_direction { 0.001 } else { 0.1 };
    for value in moved.iter_mut() {
        *value += random.between(-size, size);
    }
    if is_direction {
        moved = moved.normalize();
    }
    let text = format!(
        "{}{}, {}, {}{}",
        &source[..at + length],
        moved.x,
        moved.y,
        moved.z,
        &source[end..]
    );
    load(name, &text).ok()
}

/// Only C's place is off by 0.05 mm across it: 0.1 mm at the most, wherever the linear axes are.
#[test]
fn everywhere_a_moved_pivot_costs_at_most_twice_its_error() {
    let believed = builtin("mikron-ucp710").expect("shipped");
    let truth = planted("mikron-ucp710", 'C', "point = [0, 0, 0]", "point = [0.03, 0.04, 7]");
    let comparison = Comparison::new(believed, &truth).expect("the same axes");
    assert!((comparison.everywhere(200.0) - 0.1).abs() < 1e-9);
    // A runs from -30 to 120 deg: 2 sin(60 deg) 0.05
    let truth = planted("mikron-ucp710", 'A', "point = [0, 0, 0]", "point = [0, 0.05, 0]");
    let comparison = Comparison::new(believed, &truth).expect("the same axes");
    assert!((comparison.everywhere(200.0) - 0.1 * sin(rad(60.0))).abs() < 1e-9);
    let same = Comparison::new(believed, believed).expect("the same axes");
    assert_eq!(same.everywhere(200.0), 0.0);
}

#[test]
fn machines_with_other_axes_are_not_compared() {
    let (a, b) = (
        builtin("mikron-ucp710").expect("shipped"),
        builtin("ferrari-bc").expect("shipped"),
    );
    let error = Comparison::new(a, b).err().expect("A against B");
    assert!(
        error.contains("mikron-ucp710 has A") && error.contains("ferrari-bc has B"),
        "{error}"
    );
}

/// The declared uncertainty bounds what a planted error of that size does, in every direction.
#[test]
fn the_uncertainty_bounds_what_planted_errors_do() {
    let name = "nutating-table-b45";
    let machine = builtin(name).expect("shipped");
    let joint = machine.joint(b'B').expect("B");
    let arc = machine.axes[joint].extra.direction_uncertainty.expect("declared");
    let mut largest: f64 = 0.0;
    let mut random = crate::kinematics::selftest::SplitMix(3);
    for _ in 0..200 {
        let mut number = |size: f64| random.between(-size, size);
        let off = Vec3::new(number(1.0), number(1.0), number(1.0)).normalize() * 0.01;
        let e = machine.axes[joint].direction;
        let tilt = e.cross(&Vec3::new(number(1.0), number(1.0), number(1.0))).normalize();
        let turned = trunnion_geometry::math::rotate(&tilt, arc, &e);
        let point = Vec3::new(0.0, 0.0, -120.0) + off;
        let source = builtin_source(name)
            .expect("shipped")
            .split("[[check]]")
            .next()
            .expect("a part");
        let (head, axis) = source.split_once("letter = \"B\"").expect("B");
        let dir = axis.lines().find(|line| line.starts_with("dir")).expect("a direction");
        let axis = axis
            .replacen(dir, &format!("dir = [{}, {}, {}]", turned.x, turned.y, turned.z), 1)
            .replacen(
                "point = [0, 0, -120]",
                &format!("point = [{}, {}, {}]", point.x, point.y, point.z),
                1,
            );
        let truth = load("planted", &format!("{head}letter = \"B\"{axis}")).expect("valid");
        let mut joints = [0.0; MAX_AXES];
        for (slot, axis) in joints.iter_mut().zip(&machine.axes) {
            *slot = if axis.kind == crate::AxisKind::Rotary {
                number(3.0)
            } else {
                number(200.0)
            };
        }
        // zeroed with the axis at zero: there both machines have the tip at one place
        let found = (forward(&truth, &joints, 80.0).tip - forward(machine, &joints, 80.0).tip).norm();
        let stated: Vec<_> = pivot_sensitivity_between(machine, &joints, &joints, 80.0);
        let stated = stated.iter().find(|axis| axis.letter == b'B').expect("declared").tip_mm;
        assert!(found <= stated * 1.0001, "{found} {stated}");
        largest = largest.max(found / stated);
    }
    assert!(largest > 0.7, "the bound is far from what happens: {largest}");
    // travel to 185 deg: the worst is at half a turn
    let worst = worst_pivot_error(machine, joint, 100.0).expect("declared");
    assert!((worst - 2.0 * (0.01 + 100.0 * arc)).abs() < 1e-12);
    assert!(
        pivot_sensitivity_between(
            builtin("mikron-ucp710").expect("shipped"),
            &[1.0; MAX_AXES],
            &[1.0; MAX_AXES],
            80.0
        )
        .is_empty()
    );
}
