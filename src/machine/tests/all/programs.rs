//! Whole programs on their machines.
use crate::controls::plain;
use trunnion_geometry::deg;
use trunnion_interp::{Fault, Feed, ModalState, Motion, MotionKind, Setup, Sink, run};
use trunnion_machine::{Follower, Leg, Machine};
use trunnion_syntax::{Program, parse};

/// Follows a program.
struct Followed<'m> {
    follower: Follower<'m>,
    legs: Vec<(u32, Leg)>,
}

impl Sink for Followed<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        self.legs.push((motion.block.0 + 1, leg));
    }
    fn fault(&mut self, _: Fault) {}
}

/// Legs with the line of each; `None`, with a printed message, where the file is missing.
fn followed<'m>(machine: &'m Machine, dialect: &str, file: &str) -> Option<Followed<'m>> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(file);
    let Ok(source) = std::fs::read(&path) else {
        crate::guide_vane::skipped(file);
        return None;
    };
    Some(text_followed(machine, dialect, source))
}

/// Legs of a text, with the line of each.
fn text_followed<'m>(machine: &'m Machine, dialect: &str, source: Vec<u8>) -> Followed<'m> {
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let program: Program = parse(source, dialect.lex);
    let mut followed = Followed {
        follower: Follower::new(machine),
        legs: Vec::new(),
    };
    let mut setup = Setup::default();
    Machine::tell(Some(machine), &mut setup.control);
    run(&program, dialect, &setup, &mut followed);
    followed
}

/// The plane is tilted by 30 deg about X: A30 C0 or A-30 C180 are perpendicular to it. G53.1 turns there with X Y Z as they are, G53.6 with the tip where
/// it is; P names the solution, where the machine file says which one that is.
#[test]
fn a_turn_about_the_tip_takes_the_solution_that_p_names() {
    let said = "family = \"fanuc-30i\"\nposture_words = { solutions = { 1 = \"A+\", 2 = \"A-\" } }";
    for (control, code, a, open) in [
        (said, "G53.6 P1", 30.0, false),
        (said, "G53.6 P2", -30.0, false),
        (said, "G53.6", 30.0, false),
        (said, "G53.1 P1", 30.0, false),
        (said, "G53.1 P2", -30.0, false),
        ("family = \"fanuc-30i\"", "G53.6 P2", 30.0, true),
    ] {
        let machine = plain("", control);
        let text = format!(
            "G0 X100. Y20. Z50. A0. C10.\nG68.2 X0. Y0. Z0. I0. J30. K0.\n{code}\nG1 X5. Y0. Z10. F100.\nM30\n"
        );
        let followed = text_followed(&machine, "fanuc-30i", text.into_bytes());
        let (_, turn) = &followed.legs[1];
        let (start, end) = (turn.start.expect("known"), turn.end.as_ref().expect("reached"));
        assert!((deg(end.joints[1]) - a).abs() < 1e-9, "{code}: {:?}", end.joints);
        assert_eq!(turn.open.is_some(), open, "{code}");
        let shift = (end.tip - start.tip).norm();
        let stays = start.joints[2..5] == end.joints[2..5];
        if code.starts_with("G53.6") {
            assert!(shift < 1e-9 && !stays, "{code}: {shift}");
        } else {
            assert!(shift > 1.0 && stays, "{code}: {shift}");
        }
        // the motion after it is in the plane, whatever the solution: the tip 5 along X, 10 up the normal
        let (_, cut) = &followed.legs[2];
        let tip = cut.end.as_ref().expect("known").tip;
        let wanted = trunnion_geometry::Vec3::new(5.0, -5.0, 75.0_f64.sqrt());
        assert!((tip - wanted).norm() < 1e-9, "{code}: {tip:?}");
    }
}

/// The same 3+2 part for a Fanuc (rotary words, then G53.1) and an 840D (CYCLE800 with direction -1): the same joints.
#[test]
fn a_part_for_two_controls_has_the_same_joints() {
    let fanuc = plain("", "family = \"fanuc-30i\"");
    let sinumerik = plain("", "family = \"sinumerik-840d\"");
    let (Some(a), Some(b)) = (
        followed(&fanuc, "fanuc-30i", "five-axis-pairs/smpl_sim08_5ax_fanuc_mm.nc"),
        followed(
            &sinumerik,
            "sinumerik-840d",
            "five-axis-pairs/smpl_sim08_5ax_sinumerik_mm.mpf",
        ),
    ) else {
        return;
    };
    // the profile of the first tool
    let joints = |followed: &Followed<'_>, tool: Option<u32>| -> Vec<[f64; 5]> {
        let feeds = followed
            .legs
            .iter()
            .filter(|(_, leg)| leg.motion.is_feed() && leg.motion.tilt.normal.is_some());
        let first = feeds.clone().next().map(|(_, leg)| leg.motion.tool);
        let own =
            feeds.filter(|(_, leg)| leg.motion.tool == tool || (tool.is_none() && Some(leg.motion.tool) == first));
        own.filter_map(|(_, leg)| {
            leg.end
                .as_ref()
                .ok()
                .map(|end| std::array::from_fn(|axis| end.joints[axis]))
        })
        .collect()
    };
    let (a, b) = (joints(&a, Some(4)), joints(&b, None));
    assert!(a.len() > 20 && b.len() >= a.len(), "{} {}", a.len(), b.len());
    for (index, (a, b)) in a.iter().zip(&b).enumerate() {
        for axis in 0..5 {
            assert!((a[axis] - b[axis]).abs() < 2e-3, "{index}: {a:?} {b:?}");
        }
    }
    assert!(
        (deg(a[0][0]) - 90.0).abs() < 1e-6 && (deg(a[0][1]) + 15.0).abs() < 1e-6,
        "{:?}",
        a[0]
    );
}

/// Kinematics notes 10: 4 306 feed moves in inverse time, 1 078.7 s; C over-speeds in 6 blocks, worst 17.91 times at line 494; three jumps
/// of C over 90 deg, all rapids; ranges of A and C.
#[test]
fn the_impeller_has_its_numbers() {
    let machine = trunnion_machine::builtin("linuxcnc-xyzac-trt").expect("built in");
    let Some(run) = followed(machine, "linuxcnc", "linuxcnc-5axis/impeller-7bl-xyzac.ngc") else {
        return;
    };
    let feeds: Vec<_> = run.legs.iter().filter(|(_, leg)| leg.motion.is_feed()).collect();
    assert_eq!(feeds.len(), 4306);
    let seconds: f64 = feeds
        .iter()
        .map(|(_, leg)| match leg.motion.feed {
            Feed::InverseTime(per_minute) => 60.0 / per_minute,
            _ => panic!("not in inverse time"),
        })
        .sum();
    assert!((seconds - 1078.7).abs() < 0.05, "{seconds}");
    let mut over = Vec::new();
    for (line, leg) in &feeds {
        let (Some(start), Ok(end), Feed::InverseTime(per_minute)) = (&leg.start, &leg.end, leg.motion.feed) else {
            panic!("not followed: line {line}")
        };
        let speed = deg((end.joints[0] - start.joints[0]).abs()) * per_minute / 60.0;
        if speed > 30.0 {
            over.push((speed / 30.0, *line));
        }
    }
    let worst = over
        .iter()
        .copied()
        .fold((0.0, 0), |a: (f64, u32), b| if b.0 > a.0 + 1e-9 { b } else { a });
    assert_eq!((over.len(), worst.1), (6, 494), "{over:?}");
    let lines: Vec<u32> = over.iter().map(|(_, line)| *line).collect();
    assert_eq!(lines, [494, 978, 1462, 1946, 2430, 2914]);
    assert!((worst.0 - 17.91).abs() < 0.01, "{}", worst.0);
    let jumps: Vec<u32> = run
        .legs
        .iter()
        .filter(|(_, leg)| deg(leg.rotary_change[0]) > 90.0)
        .map(|(line, leg)| {
            assert_eq!(leg.motion.kind, MotionKind::Rapid);
            *line
        })
        .collect();
    assert_eq!(jumps, [3401, 4146, 4504]);
    let range = |axis: usize| {
        let values = run
            .legs
            .iter()
            .filter_map(|(_, leg)| leg.end.as_ref().ok().map(|end| deg(end.joints[axis])));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    };
    let close = |found: (f64, f64), wanted: (f64, f64)| {
        (found.0 - wanted.0).abs() < 0.006 && (found.1 - wanted.1).abs() < 0.006
    };
    assert!(close(range(1), (-74.49, 0.0)), "{:?}", range(1));
    assert!(close(range(0), (-399.805, 0.0)), "{:?}", range(0));
}

/// Kinematics notes 10: 1 735 feed moves along lines; at the programmed times Y is over its 20 mm/s in 5 blocks, Z in 13, A over its 30 deg/s in 11;
/// the worst is 1.559 times as fast, at line 1397. That is the mean of a block; at the worst moment inside it 14 blocks are too fast, Z in all
/// of them, and the worst 1.592 times.
#[test]
fn the_boat_has_its_numbers() {
    let machine = trunnion_machine::builtin("linuxcnc-xyzac-trt").expect("built in");
    let Some(run) = followed(machine, "linuxcnc", "linuxcnc-5axis/boat-xyzac.ngc") else {
        return;
    };
    let feeds: Vec<_> = run.legs.iter().filter(|(_, leg)| leg.motion.is_feed()).collect();
    let lines = feeds
        .iter()
        .filter(|(_, leg)| leg.motion.kind == MotionKind::Linear)
        .count();
    // the notes count lines; there are four arcs beside them
    assert_eq!((lines, feeds.len()), (1735, 1739));
    let letters = [b'X', b'Y', b'Z', b'A', b'C'];
    let mut over = [0; 5];
    let mut worst = (0.0, 0);
    let (mut over_inside, mut worst_inside, mut blocks) = ([0; 5], (0.0, 0), Vec::new());
    for (line, leg) in &feeds {
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            panic!("not followed: line {line}")
        };
        let path = trunnion_machine::BlockPath::new(machine, leg).expect("a path");
        let seconds = match leg.motion.feed {
            Feed::InverseTime(per_minute) => 60.0 / per_minute,
            Feed::PerMinute(feed) => 60.0 * leg.length / feed,
            _ => panic!("no feed: line {line}"),
        };
        for (slot, letter) in over.iter_mut().zip(letters) {
            let joint = machine.joint(letter).expect("an axis");
            let (limit, change) = (
                machine.axes[joint].max_speed.expect("declared"),
                end.joints[joint] - start.joints[joint],
            );
            let times = change.abs() / (seconds * limit);
            if times > 1.0 + 1e-9 {
                *slot += 1;
            }
            if times.is_finite() && times > worst.0 + 1e-9 {
                worst = (times, *line);
            }
            let inside = (0..=200)
                .map(|part| path.rates(f64::from(part) / 200.0)[joint].abs() / (seconds * limit))
                .fold(0.0, f64::max);
            if inside.is_finite() && inside > 1.0 + 1e-9 {
                over_inside[letters.iter().position(|own| *own == letter).expect("listed")] += 1;
                blocks.push(*line);
                if inside > worst_inside.0 + 1e-9 {
                    worst_inside = (inside, *line);
                }
            }
        }
    }
    blocks.dedup();
    assert_eq!(
        blocks,
        [
            537, 662, 663, 787, 788, 924, 925, 1277, 1396, 1397, 1524, 1525, 1662, 1663
        ]
    );
    assert_eq!((over_inside, worst_inside.1), ([0, 5, 14, 11, 0], 1397));
    assert!((worst_inside.0 - 1.592).abs() < 0.0015, "{worst_inside:?}");
    assert_eq!((over, worst.1), ([0, 5, 13, 11, 0], 1397), "{worst:?}");
    assert!((worst.0 - 1.559).abs() < 0.001, "{worst:?}");
}

/// Which motions of a program end at a known place.
fn known(machine: &Machine, dialect: &str, source: String) -> Vec<bool> {
    let followed = text_followed(machine, dialect, source.into_bytes());
    followed.legs.iter().map(|(_, leg)| leg.end.is_ok()).collect()
}

/// An increment to a coordinate that the program does not know moves the axis: it does not stay where it is.
#[test]
fn increments_to_unknown_coordinates_are_not_passed_over() {
    let machine = &plain("", "tcp_codes = { on = [\"M428\"], off = [\"M429\"] }");
    let home = "G0 X10. Y20. Z30. A20. C10.\n";
    for (dialect, on) in [
        ("sinumerik-840d", "TRAORI"),
        ("fanuc-30i", "G43.4 H1"),
        ("linuxcnc", "M428"),
    ] {
        let text = format!("{home}{on}\nG91 G0 X5.\nZ5.\nG90 G0 X0. Y0. Z0.\nG91 X1.\nM30\n");
        assert_eq!(
            known(machine, dialect, text),
            [true, false, false, true, true],
            "{dialect}"
        );
        // axes that no word names stay where they are
        let text = format!("{home}{on}\nG0 X5.\nM30\n");
        assert_eq!(known(machine, dialect, text), [true, true], "{dialect}");
    }
    // also where a line before it turned an axis only
    let text = format!("{home}M428\nG91 G0 A5.\nZ5.\nM30\n");
    assert_eq!(known(machine, "linuxcnc", text), [true, true, false]);
    // after a vector the program does not know the rotary axes
    let vector = "TRAORI\nG0 X0 Y0 Z0 A3=0.1 B3=0.2 C3=0.97\n";
    for (block, is_known) in [
        ("G0 X1 C=IC(5)", false),
        ("G91 G0 C5", false),
        ("G0 X1 A10", true),
        ("G0 C=R7", false),
        // direction and amount depend on where the vector has left it
        ("G0 C=ACP(5)", false),
        ("G0 C=DC(5)", false),
        ("G0 C5", true),
    ] {
        let text = format!("{home}{vector}{block}\nM30\n");
        assert_eq!(
            known(machine, "sinumerik-840d", text),
            [true, true, is_known],
            "{block}"
        );
    }
}

/// Joints X Y Z at the end of each motion, mm; `None` where they are not known.
fn linear_joints(machine: &Machine, source: String) -> Vec<Option<[f64; 3]>> {
    let followed = text_followed(machine, "fanuc-30i", source.into_bytes());
    let joints = *b"XYZ";
    let at = |leg: &Leg| {
        let end = leg.end.as_ref().ok()?;
        Some(joints.map(|letter| end.joints[machine.joint(letter).expect("an axis")]))
    };
    followed.legs.iter().map(|(_, leg)| at(leg)).collect()
}

/// The plane is tilted by -30 deg about X, the tool is perpendicular to it at A -30: on this machine, whose axes meet in its zero, the plane's X Y Z are
/// the joints then. What a block does not name stays where the machine has it, not where words of another frame seem to put it.
#[test]
fn in_a_tilted_plane_what_is_not_named_stays() {
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let plane = "G68.2 X0. Y0. Z0. I0. J-30. K0.";
    let start = "G21 G90 G54\nG0 X10. Y20. Z50.";
    let joints = |text: String| linear_joints(machine, text);
    let near = |found: Option<[f64; 3]>, wanted: [f64; 3]| {
        let found = found.unwrap_or([f64::NAN; 3]);
        let off = found.iter().zip(wanted).fold(0.0f64, |off, (a, b)| off + (a - b).abs());
        assert!(off < 1e-9, "{found:?}, not {wanted:?}");
    };
    // turned by the control, by hand inside the plane, by hand before it
    for (before, turn) in [("A0. C0.", "G53.1\n"), ("A0. C0.", "G0 A-30. C0.\n"), ("A-30. C0.", "")] {
        let head = format!("{start} {before}\n{plane}\n{turn}");
        let last = |tail: &str| *joints(format!("{head}{tail}")).last().expect("a motion");
        near(last("G1 Z5. F500.\n"), [10.0, 20.0, 5.0]);
        near(last("G0 X12. Y5.\n"), [12.0, 5.0, 50.0]);
        near(last("G0 X12. Y5.\nG0 Z30.\nG1 X14.\n"), [14.0, 5.0, 30.0]);
        near(last("G0 X12. Y5. Z30.\nG69\nG0 Z100.\n"), [12.0, 5.0, 100.0]);
        // the normal does not tell on which side of the plane it moves
        assert_eq!(last("G1 X14. F500.\n"), None);
        // a value that is unknown is not a word that is missing
        assert_eq!(last("G1 X12. Y5. Z#500 F500.\n"), None);
        if !turn.is_empty() {
            near(last(""), [10.0, 20.0, 50.0]);
        }
    }
}

/// X of a turning dialect is halved once, by the control, also where the machine file says that words are diameters; other dialects leave it
/// to the machine file.
#[test]
fn a_diameter_is_halved_once() {
    let machine = trunnion_machine::builtin("mill-turn-bc").expect("built in");
    let x = machine.joint(b'X').expect("X");
    let last = |dialect: &str, text: &str| {
        let text = format!("G21 G40\nG0 X40. Y0. Z5. B0. C0.\n{text}\n");
        let followed = text_followed(machine, dialect, text.into_bytes());
        let (_, leg) = followed.legs.last().expect("a motion");
        leg.end.as_ref().ok().map(|end| end.joints[x])
    };
    for (dialect, text, wanted) in [
        ("fanuc-30i-lathe-a", "G1 X30. F0.1", Some(15.0)),
        ("fanuc-30i-lathe-a", "G1 U-10. F0.1", Some(15.0)),
        ("fanuc-30i-lathe-b", "G91 G1 X-10. F0.1", Some(15.0)),
        ("fanuc-30i-lathe-b", "G3 X30. Z0. I-5. K0. F0.1", Some(15.0)),
        ("fanuc-30i", "G1 X30. F100.", Some(15.0)),
        // an arc in diameters is not modelled where the control does not say what they are
        ("fanuc-30i", "G18 G3 X30. Z0. I-5. K0. F100.", None),
        ("linuxcnc", "G7\nG1 X30. F100.", Some(15.0)),
    ] {
        assert_eq!(last(dialect, text), wanted, "{dialect} {text}");
    }
}
