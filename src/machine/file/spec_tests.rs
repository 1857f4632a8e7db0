//! Machine files: every key of the format, and files nobody would write.
use crate::kinematics::selftest::SplitMix;
use crate::{BUILTIN_MACHINES, Limits, RapidPath, Wrap, builtin, builtin_source, describe, load};
use trunnion_geometry::{Vec3, rad};

/// A file with every key of the format.
const EVERYTHING: &str = r#"
schema = "ncmachine/1"
name = "Everything"
sources = ["a data sheet"]
units = { length = "mm", angle = "deg", time = "s" }
spindle = { tool_axis = [0, 0, 1], gauge_point = [0, 0, 0], note = "n", source = "s" }
[[axis]]
letter = "C"
kind = "rotary"
side = "table"
dir = [0, 0, 1]
point = [0, 0, 0]
sign = 1
limits = "unbounded"
wrap = "modulo-sign"
dyn = { vmax = 120, amax = 600, jmax = 6000, kv = 16.667, kff = 0.0 }
clamp = false
cable = true
spindle = true
resolution = 0.001
uncertainty = { point = 0.01, dir_arcsec = 10 }
note = "n"
source = "s"
[[axis]]
letter = "A"
kind = "rotary"
side = "table"
dir = [1, 0, 0]
point = [0, 10, -5]
sign = -1
limits = [-30, 120]
limit_margin = 1
wrap = "shortest"
clamp = true
dyn = { vmax = 90, amax = 300 }
[[axis]]
letter = "X"
kind = "linear"
side = "table"
dir = [1, 0, 0]
sign = 1
limits = [-355.5, 355]
mode = "diameter"
dyn = { vmax = 500, amax = 5000, jmax = 50000, kv = 33 }
[[axis]]
letter = "Y"
sign = 1
[[axis]]
letter = "V"
follow = "Y"
[[axis]]
letter = "Z"
sign = 1
[control]
family = "sinumerik-840d"
tcp = { path = "tip-linear", orientation = "great-circle", feed = "tip" }
branch = { rule = "fanuc", order = ["move1", "move2", "abs1", "abs2"], range = { A = [-30, 120] } }
pole = { cone = 2.0, action = "through", passing_type = 1 }
rapid = "dogleg"
corner = { model = "axis-jump", dv = { X = 5, C = 1 } }
planner = { lookahead = 150, block_time = 0.002, filter_time = 0.004, tool_change_time = 6, m_times = { M3 = 2.5 } }
servo = { bandwidth = 60, sample_time = 0.001 }
units = "inch"
tcp_codes = { on = ["M428"], off = ["M429"] }
[tolerances]
tip = 0.02
orientation = 0.2
swept = 0.06
rotary_ratio = 21
linear_ratio = 6
rapid_ratio = 3
collision_near = 3.0
pole_cone = 3
pole_angle = 11
swap_excess = 6
feed_drop = 0.7
feed_drop_error = 0.2
[[body]]
carrier = "A"
mesh = "trunnion.stl"
[[body]]
carrier = "base"
mesh = "base.stl"
"#;

#[test]
fn every_shipped_file_loads_and_says_where_it_comes_from() {
    assert!(BUILTIN_MACHINES.len() >= 24);
    for name in BUILTIN_MACHINES {
        let source = builtin_source(name).expect("embedded");
        let machine = load(name, source).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(!machine.sources.is_empty(), "{name}");
        assert!(
            machine.checks >= machine.own_axes().count() + 3,
            "{name}: {} check rows",
            machine.checks
        );
        assert_eq!(machine.warnings, Vec::<String>::new(), "{name}");
    }
}

/// Both motors of a gantry move one body: if the follower's positive direction is the leader's, so are its limits, otherwise they are mirrored.
#[test]
fn the_limits_of_a_gantry_are_those_of_both() {
    let limits = |leader: &str, follower: &str| {
        let text = format!(
            "schema = \"ncmachine/1\"\naxis = [{{letter=\"X\",{leader},limits=[-150,150]}},\
             {{letter=\"U\",follow=\"X\",{follower}limits=[-100,130]}},{{letter=\"Y\",sign=1}},{{letter=\"Z\",sign=1}}]"
        );
        let machine = load("gantry", &text).unwrap_or_else(|error| panic!("{error}: {text}"));
        machine.axes[0].limits
    };
    let (same, mirrored) = (Limits::Range(-100.0, 130.0), Limits::Range(-130.0, 100.0));
    assert_eq!(limits("sign=1", ""), same);
    assert_eq!(limits("sign=1", "sign=1,"), same);
    assert_eq!(limits("sign=1", "sign=-1,"), mirrored);
    assert_eq!(limits("sign=-1", ""), same);
    assert_eq!(limits("sign=-1", "sign=-1,"), same);
    assert_eq!(limits("sign=-1", "sign=1,"), mirrored);
    assert_eq!(limits("sign=1", "dir=[-1,0,0],sign=1,"), mirrored);
    assert_eq!(limits("sign=1", "dir=[-1,0,0],sign=-1,"), same);
    assert_eq!(limits("sign=-1,dir=[-1,0,0]", ""), same);
}

/// The tool axis at home in terms of the words: diameters count twice.
#[test]
fn a_machine_says_along_what_a_length_lies() {
    assert_eq!(builtin("mikron-ucp710").expect("embedded").length_along(), None);
    let along = builtin("mill-turn-bc").expect("embedded").length_along();
    assert_eq!(along, Some([2.0, 0.0, 0.0]));
}

#[test]
fn every_key_is_read() {
    let machine = load("everything", EVERYTHING).expect("valid");
    let [c, a, x, y, z] = &machine.axes[..] else {
        panic!("the gantry is no joint")
    };
    assert_eq!(
        (c.letter, a.letter, x.letter, y.letter, z.letter),
        (b'C', b'A', b'X', b'Y', b'Z')
    );
    assert_eq!(
        (c.limits, c.extra.wrap, c.extra.cable, c.extra.spindle),
        (Limits::Unbounded, Wrap::ModuloSign, true, true)
    );
    assert_eq!(c.max_speed, Some(rad(120.0)));
    assert_eq!(
        (c.extra.max_jerk, c.extra.position_gain, c.extra.feed_forward),
        (Some(rad(6000.0)), Some(16.667), Some(0.0))
    );
    assert_eq!(
        (c.extra.point_uncertainty, c.extra.direction_uncertainty),
        (Some(0.01), Some(rad(10.0 / 3600.0)))
    );
    assert_eq!(
        (a.limits, a.sign, a.extra.clamp),
        (Limits::Range(rad(-30.0), rad(120.0)), -1.0, true)
    );
    assert_eq!(
        (a.point, a.extra.limit_margin),
        (Vec3::new(0.0, 10.0, -5.0), Some(rad(1.0)))
    );
    assert_eq!(
        (x.limits, x.max_speed, x.extra.diameter),
        (Limits::Range(-355.5, 355.0), Some(500.0), true)
    );
    assert_eq!(
        (y.direction, y.extra.limits_declared, y.max_speed),
        (Vec3::y(), false, None)
    );
    assert_eq!((machine.gantries[0].letter, machine.gantries[0].leader), (b'V', b'Y'));
    assert_eq!(machine.control.rapid, RapidPath::Dogleg);
    assert!(machine.control.tcp_great_circle && machine.control.tcp_declared);
    assert_eq!(machine.control.units, Some(trunnion_interp::LengthUnit::Inch));
    let codes = machine.control.tcp_codes.as_ref().expect("declared");
    assert_eq!(
        (codes.meaning("M428"), codes.meaning("m429")),
        (Some(true), Some(false))
    );
    assert_eq!(
        (machine.tolerances.tip_mm, machine.tolerances.feed_drop_error),
        (0.02, 0.2)
    );
    assert_eq!(
        (machine.tolerances.pole_angle, machine.tolerances.swap_excess),
        (rad(11.0), rad(6.0))
    );
    let tolerances = &machine.tolerances;
    assert_eq!((tolerances.orientation, tolerances.swept_mm), (rad(0.2), 0.06));
    assert_eq!(
        (tolerances.rotary_ratio, tolerances.linear_ratio, tolerances.rapid_ratio),
        (21.0, 6.0, 3.0)
    );
    assert_eq!((machine.bodies.len(), machine.sources.len()), (2, 3));
    assert_eq!(
        (&machine.rotary[..], &machine.linear[..]),
        (&[0, 1][..], &[2, 3, 4][..])
    );
    assert_eq!(
        machine.joint_of_letter,
        [Some(2), Some(3), Some(4), Some(1), None, Some(0), None, None, None]
    );
}

#[test]
fn every_key_of_the_planner_is_read() {
    let machine = load("everything", EVERYTHING).expect("valid");
    assert_eq!(machine.control.corner_model.as_deref(), Some("axis-jump"));
    let planning = &machine.control.planning;
    let jump = |letter: u8| planning.corner_jump[machine.joint(letter).expect("an axis")];
    assert_eq!((jump(b'X'), jump(b'C'), jump(b'Y')), (Some(5.0), Some(rad(1.0)), None));
    assert_eq!(
        (planning.lookahead, planning.filter_time, machine.control.block_time),
        (Some(150), Some(0.004), Some(0.002))
    );
    assert_eq!(
        (planning.tool_change_time, &planning.m_times[..]),
        (Some(6.0), &[(3, 2.5)][..])
    );
    assert_eq!(
        (planning.servo_bandwidth_hz, planning.servo_sample),
        (Some(60.0), Some(0.001))
    );
}

/// What is declared and not used is reported, in the machine and in its description; the samples contain nothing of the kind.
#[test]
fn what_is_not_used_is_said() {
    let machine = load("everything", EVERYTHING).expect("valid");
    for (start, count) in [
        ("uncertainty of", 1),
        ("[[body]]", 1),
        ("[control] corner: ", 0),
        ("[control] planner: ", 0),
        ("clamp on A", 0),
        ("cable on C", 0),
        ("[control] branch", 0),
    ] {
        let said = |line: &&String| line.starts_with(start);
        assert_eq!(machine.not_used.iter().filter(said).count(), count, "{start}");
    }
    let lines = describe(&machine).lines();
    for sentence in &machine.not_used {
        assert!(
            lines.contains(&format!("Declared, not used yet: {sentence}")),
            "{sentence}"
        );
    }
    assert_eq!(
        builtin("mikron-ucp710").expect("embedded").not_used,
        Vec::<String>::new()
    );
}

/// The compact forms of docs/kinematics.md#machine-model.
#[test]
fn compact_chains_load() {
    let head_head = r#"schema = "ncmachine/1"
axis = [ {letter="X", sign=1,kind="linear",side="table",dir=[1,0,0]}, {letter="Y", sign=1,kind="linear",side="head",dir=[0,1,0]}, {letter="Z", sign=1,kind="linear",side="head",dir=[0,0,1]},
  {letter="C", sign=1,kind="rotary",side="head",dir=[0,0,1],point=[0,0,250],limits=[-360,360]}, {letter="A", sign=1,kind="rotary",side="head",dir=[1,0,0],point=[0,0,250],limits=[-110,110]} ]"#;
    let fork = load("fork", head_head).expect("valid");
    assert_eq!(fork.constants.shared_segment, Some(0));
    let result = crate::self_test(&fork, 500, 3);
    assert!(result.posture_missing == 0 && result.worst_tip_mm < 1e-10, "{result:?}");
    let nutating = r#"schema = "ncmachine/1"
axis = [ {letter="C", sign=1,side="table"}, {letter="B", sign=1,side="table",dir=[0,0.70710678,-0.70710678],point=[0,0,-120],limits=[0,180]},
  {letter="X", sign=1}, {letter="Y", sign=1}, {letter="Z", sign=1}, {letter="W", sign=1} ]"#;
    let quill = load("quill", nutating).expect("valid");
    let result = crate::self_test(&quill, 500, 3);
    assert!(result.posture_missing == 0 && result.worst_tip_mm < 1e-10, "{result:?}");
}

const HEAD: &str = "schema = \"ncmachine/1\"\n";
const XYZ: &str = "{letter=\"X\", sign=1},{letter=\"Y\", sign=1},{letter=\"Z\", sign=1}";

#[test]
fn a_direction_within_rounding_gets_length_one() {
    let text = format!(
        "{HEAD}axis = [{{letter=\"C\", sign=1,side=\"table\"}},{{letter=\"B\", sign=1,side=\"table\",dir=[0,0.7071068,0.7071068]}},{XYZ}]"
    );
    let machine = load("ok", &text).expect("valid");
    assert!((machine.axes[1].direction.norm() - 1.0).abs() < 1e-15);
}

/// Cutting, doubling and overwriting bytes of every sample: an answer each time, and every place inside the file.
#[test]
fn hostile_files_never_panic() {
    let mut random = SplitMix(99);
    let samples: Vec<&str> = BUILTIN_MACHINES
        .iter()
        .filter_map(|name| builtin_source(name))
        .chain([EVERYTHING])
        .collect();
    let pieces = [
        "nan",
        "-inf",
        "1e308",
        "[",
        "]",
        "{}",
        "\"",
        "9223372036854775808",
        "\u{1F529}",
        "[[axis]]\n",
        "=",
        "0",
        "-",
        "''",
    ];
    let (mut refused, mut taken) = (0, 0);
    for round in 0..3000 {
        let text = samples[round % samples.len()];
        let place = |random: &mut SplitMix| {
            let mut at = random.between(0.0, text.len() as f64) as usize;
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let (a, b) = (place(&mut random), place(&mut random));
        let piece = pieces[random.between(0.0, pieces.len() as f64) as usize];
        let mutated = match round % 3 {
            0 => format!("{}{piece}{}", &text[..a], &text[a..]),
            1 => format!("{}{}", &text[..a.min(b)], &text[a.max(b)..]),
            _ => format!("{}{}", &text[..a.max(b)], &text[a.min(b)..]),
        };
        match load("mutant", &mutated) {
            Ok(machine) => {
                taken += 1;
                let result = crate::self_test(&machine, 3, 1);
                assert!(result.posture_missing == 0, "{mutated}");
                assert!(!describe(&machine).lines().is_empty());
            }
            Err(error) => {
                refused += 1;
                if let Some(span) = error.span {
                    assert!(span.start <= span.end && span.end <= mutated.len(), "{}", error.message);
                }
            }
        }
    }
    assert!(refused > 500 && taken > 5, "{refused} {taken}");
}

/// A sign or an offset that is changed in a file changes what the machine does.
#[test]
fn a_changed_sign_or_offset_is_noticed() {
    let source = builtin_source("mikron-ucp710").expect("embedded");
    let honest = builtin("mikron-ucp710").expect("embedded");
    let mut joints = [0.3; crate::MAX_AXES];
    joints[2] = 40.0;
    let pose = crate::forward(honest, &joints, 100.0);
    for (from, to) in [
        ("sign = 1", "sign = -1"),
        (
            "dir = [1, 0, 0]\npoint = [0, 0, 0]",
            "dir = [1, 0, 0]\npoint = [0, 5, 0]",
        ),
        ("dir = [0, 0, 1]", "dir = [0, 0, -1]"),
    ] {
        let text = source.replacen(from, to, 1);
        let refused = load("changed", &text).expect_err("a check row contradicts it");
        assert!(refused.message.contains("if the row is right"), "{refused}");
        let unchecked = text.split("[[check]]").next().expect("a part");
        let changed = load("changed", unchecked).expect("valid");
        let other = crate::forward(&changed, &joints, 100.0);
        assert!((other.tip - pose.tip).norm() > 1.0, "{from} -> {to}");
    }
}

#[test]
fn descriptions() {
    for name in BUILTIN_MACHINES {
        let machine = builtin(name).expect("embedded");
        insta::assert_snapshot!(format!("describe_{name}"), describe(machine).lines().join("\n"));
    }
    insta::assert_snapshot!(
        "describe_everything",
        describe(&load("everything", EVERYTHING).expect("valid"))
            .lines()
            .join("\n")
    );
}
