//! The shipped machines against the formulas that LinuxCNC publishes for its five-axis modules, on 10 000 random poses each and in both
//! sign conventions (LinuxCNC documentation, "5-axis kinematics" and the notes of the switchable kinematics). They are derived here, not
//! taken over: the point on the workpiece is carried through the turns of the tables one plane at a time ([`turned_plane`]), and a
//! nutating head turns what lies across its axis. LinuxCNC's position is the tip plus the tool length along Z. Inverse kinematics of
//! xyzbc-trt with the factor `con` in its offset terms (kinematics notes 8).
use crate::kinematics::selftest::SplitMix;
use crate::{Joints, MAX_AXES, Machine, builtin, builtin_source, forward, inverse, load};
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{cos, sin};

/// Joints may differ by this, mm.
const SAME: f64 = 1e-9;

/// The file of a shipped machine without its check rows, with pieces replaced.
fn changed(name: &str, replace: &[(&str, &str)]) -> Machine {
    let source = builtin_source(name).expect("shipped");
    let mut text = source.split("[[check]]").next().expect("a part").to_owned();
    for (from, to) in replace {
        assert!(text.contains(from), "{name}: {from}");
        text = text.replace(from, to);
    }
    load(name, &text).expect("valid")
}

/// A shipped machine whose rotary axes turn the other way round.
fn turned(name: &str) -> Machine {
    let source = builtin_source(name).expect("shipped");
    let axes = source.split("[[check]]").next().expect("a part");
    let flip = |axis: &str| {
        if !axis.contains("kind = \"rotary\"") {
            axis.to_owned()
        } else if axis.contains("sign = -1") {
            axis.replace("sign = -1", "sign = 1")
        } else {
            axis.replace("sign = 1", "sign = -1")
        }
    };
    let text: Vec<String> = axes.split("[[axis]]").map(flip).collect();
    load(name, &text.join("[[axis]]")).expect("valid")
}

/// One pose: where LinuxCNC's position is, the rotary words in rad, W, and the tool length.
struct Given {
    p: Vec3,
    a: f64,
    b: f64,
    c: f64,
    w: f64,
    length: f64,
}

/// Joints X Y Z of the machine and of the formula agree on 10 000 random poses, and the joints lead back to the tip.
fn agree(machine: &Machine, formula: impl Fn(&Given) -> [f64; 3]) {
    let mut random = SplitMix(1998);
    let mut worst: f64 = 0.0;
    for _ in 0..10_000 {
        let mut number = |size: f64| random.between(-size, size);
        let tip = Vec3::new(number(300.0), number(300.0), number(300.0));
        let (a, b, c, w) = (number(PI), number(PI), number(PI), number(100.0));
        let length = random.between(0.0, 200.0);
        let mut joints: Joints = [0.0; MAX_AXES];
        for (letter, value) in [(b'A', a), (b'B', b), (b'C', c), (b'W', w)] {
            if let Some(joint) = machine.joint(letter) {
                joints[joint] = value;
            }
        }
        inverse(machine, &mut joints, &tip, length).expect("solvable");
        let p = tip + Vec3::z() * length;
        let wanted = formula(&Given { p, a, b, c, w, length });
        for (letter, wanted) in b"XYZ".iter().zip(wanted) {
            let found = joints[machine.joint(*letter).expect("an axis")];
            worst = worst.max((found - wanted).abs());
        }
        assert!((forward(machine, &joints, length).tip - tip).norm() < SAME);
    }
    assert!(worst < SAME, "{}: {worst:e} mm", machine.id);
}

/// A table turns by an angle: where the coordinates (a, b) of a point on it go, seen from the machine, in the plane of the turn with a
/// turning towards b. The table turns the other way round than the tool would.
fn turned_plane(angle: f64, (a, b): (f64, f64)) -> (f64, f64) {
    (a * cos(angle) + b * sin(angle), b * cos(angle) - a * sin(angle))
}

/// xyzac-trt: `con` +1 conventional, -1 the default; offsets y, z of A against C; rotation point. C lies on A: first the point goes round
/// C, then round A, whose axis passes by the offsets; the position is measured from the spindle's nose, so the tool's length lies
/// between it and the axis.
fn xyzac(g: &Given, con: f64, [dy, dz]: [f64; 2], r: [f64; 3]) -> [f64; 3] {
    let (x, y) = turned_plane(con * g.c, (g.p.x - r[0], g.p.y - r[1]));
    let from_axis = dz + g.length;
    let (y, z) = turned_plane(con * g.a, (y - dy, g.p.z - r[2] - from_axis));
    [x + r[0], y + dy + r[1], z + from_axis + r[2]]
}

#[test]
fn xyzac_trt_in_both_conventions() {
    let offsets = [20.0, 10.0];
    let default = builtin("linuxcnc-xyzac-trt").expect("shipped");
    agree(default, |g| xyzac(g, -1.0, offsets, [0.0; 3]));
    let conventional = builtin("linuxcnc-xyzac-trt-conventional").expect("shipped");
    agree(conventional, |g| xyzac(g, 1.0, offsets, [0.0; 3]));
    // another rotation point moves both axes
    let moved = changed(
        "linuxcnc-xyzac-trt",
        &[
            (
                "dir = [0, 0, 1]\npoint = [0, 0, 0]",
                "dir = [0, 0, 1]\npoint = [7, -8, 9]",
            ),
            ("point = [0, 20, 10]", "point = [7, 12, 19]"),
        ],
    );
    agree(&moved, |g| xyzac(g, -1.0, offsets, [7.0, -8.0, 9.0]));
}

/// xyzbc-trt: as above with B and offsets x, z; B turns Z towards X.
fn xyzbc(g: &Given, con: f64, [dx, dz]: [f64; 2]) -> [f64; 3] {
    let (x, y) = turned_plane(con * g.c, (g.p.x, g.p.y));
    let from_axis = dz + g.length;
    let (z, x) = turned_plane(con * g.b, (g.p.z - from_axis, x - dx));
    [x + dx, y, z + from_axis]
}

#[test]
fn xyzbc_trt_in_both_conventions() {
    let offsets = [-20.0, -15.0];
    agree(builtin("linuxcnc-xyzbc-trt").expect("shipped"), |g| {
        xyzbc(g, -1.0, offsets)
    });
    agree(builtin("linuxcnc-xyzbc-trt-conventional").expect("shipped"), |g| {
        xyzbc(g, 1.0, offsets)
    });
    // the notes' row: without the factor X would be 35.71 and Z 23.57 for joints that start at 10 and 30
    let machine = changed("linuxcnc-xyzbc-trt", &[("point = [-20, 0, -15]", "point = [5, 0, 20]")]);
    let mut joints: Joints = [0.0; MAX_AXES];
    for (letter, value) in [
        (b'X', 10.0),
        (b'Z', 30.0),
        (b'B', 40_f64.to_radians()),
        (b'C', 25_f64.to_radians()),
    ] {
        joints[machine.joint(letter).expect("an axis")] = value;
    }
    let tip = forward(&machine, &joints, 0.0).tip;
    let before = joints;
    inverse(&machine, &mut joints, &tip, 0.0).expect("solvable");
    for (found, wanted) in joints.iter().zip(before) {
        assert!((found - wanted).abs() < 1e-12);
    }
}

/// xyzab-tdr: the part turns with A, which lies on B and is dz above its point; the x offset of the module cancels out.
fn xyzab_tdr(g: &Given, s: f64, r: [f64; 3], dz: f64) -> [f64; 3] {
    let (y, z) = turned_plane(s * g.a, (g.p.y - r[1], g.p.z - r[2] - dz - g.length));
    let (z, x) = turned_plane(s * g.b, (z + dz, g.p.x - r[0]));
    [x + r[0], y + r[1], z + r[2] + g.length]
}

#[test]
fn xyzab_tdr_in_both_conventions() {
    let point = [-50.0, -50.0, -100.0];
    agree(builtin("linuxcnc-xyzab-tdr").expect("shipped"), |g| {
        xyzab_tdr(g, 1.0, point, -10.0)
    });
    agree(&turned("linuxcnc-xyzab-tdr"), |g| xyzab_tdr(g, -1.0, point, -10.0));
}

/// The bridge mill: spherical coordinates of the tool about the pivot.
fn bridge(g: &Given, s: f64, pivot: f64) -> [f64; 3] {
    let (b, c) = (s * g.b, s * g.c);
    let reach = pivot + g.length + g.w;
    [
        g.p.x - reach * sin(b) * cos(c),
        g.p.y - reach * sin(b) * sin(c),
        g.p.z + reach * cos(b) - pivot - g.length,
    ]
}

#[test]
fn five_axis_bridge_mill_in_both_conventions() {
    agree(builtin("linuxcnc-bridge-mill").expect("shipped"), |g| {
        bridge(g, 1.0, 250.0)
    });
    agree(&turned("linuxcnc-bridge-mill"), |g| bridge(g, -1.0, 250.0));
}

/// maxkins, inverse: head B, table C.
fn max(g: &Given, con: f64, turn: f64, pivot: f64) -> [f64; 3] {
    let (sb, cb, sc, cc) = (con * sin(g.b), cos(g.b), turn * sin(g.c), cos(g.c));
    let reach = pivot + g.length;
    [
        cc * g.p.x + sc * g.p.y + reach * sb,
        cc * g.p.y - sc * g.p.x,
        g.p.z + reach * cb - pivot - g.length,
    ]
}

#[test]
fn max5_in_both_conventions() {
    let name = "linuxcnc-max5";
    agree(builtin(name).expect("shipped"), |g| max(g, -1.0, 1.0, 0.0));
    agree(&turned(name), |g| max(g, 1.0, -1.0, 0.0));
    let longer = |con: &str| {
        let source = builtin_source(name)
            .expect("shipped")
            .split("[[check]]")
            .next()
            .expect("a part");
        let (table, head) = source.split_once("letter = \"B\"").expect("B");
        let head = head
            .replace("point = [0, 0, 0]", "point = [0, 0, 80]")
            .replace("sign = -1", &format!("sign = {con}"));
        load(name, &format!("{table}letter = \"B\"{head}")).expect("valid")
    };
    agree(&longer("-1"), |g| max(g, -1.0, 1.0, 80.0));
    agree(&longer("1"), |g| max(g, 1.0, 1.0, 80.0));
}

/// What a nutating head 55 deg from its primary axis does to a lever of `along` in the plane of the nutation and `up` along Z: the
/// lever across that plane, in it, and along Z, for a secondary angle whose sense is `s`.
fn nutating(angle: f64, s: f64, along: f64, up: f64) -> [f64; 3] {
    let nu = 55_f64.to_radians();
    let (sv, cv) = (sin(nu), cos(nu));
    // what lies along the nutating axis stays, what lies across it goes round
    let (stays, goes) = (sv * along + cv * up, cv * along - sv * up);
    let (level, across) = (goes * cos(angle), -goes * s * sin(angle));
    [across, stays * sv + level * cv, stays * cv - level * sv]
}

/// Table A about (y -1000, z -2000), head C and B, pivots y 50 and z 120.
fn xyzacb(g: &Given, s: f64) -> [f64; 3] {
    let [across, along, up] = nutating(g.b, s, 50.0, g.length + 120.0);
    let (sw, cw, sp, cp) = (s * sin(g.a), cos(g.a), s * sin(g.c), cos(g.c));
    let (y, z) = (g.p.y + 1000.0, g.p.z - g.length + 2000.0);
    [
        g.p.x + cp * across - sp * along,
        cw * y + sw * z - 1000.0 - 50.0 + sp * across + cp * along,
        cw * z - sw * y - 2000.0 - 120.0 + up,
    ]
}

/// Table B about (x 1000, z -2000), head C and A, pivots x 50 and z 120.
fn xyzbca(g: &Given, s: f64) -> [f64; 3] {
    let [across, along, up] = nutating(g.a, s, 50.0, g.length + 120.0);
    let (sw, cw, sp, cp) = (s * sin(g.b), cos(g.b), s * sin(g.c), cos(g.c));
    let (x, z) = (g.p.x - 1000.0, g.p.z - g.length + 2000.0);
    [
        // here the lever across the plane of nutation points along -Y
        cw * x - sw * z + 1000.0 - 50.0 + cp * along + sp * across,
        g.p.y + sp * along - cp * across,
        cw * z + sw * x - 2000.0 - 120.0 + up,
    ]
}

#[test]
fn nutating_heads_in_both_conventions() {
    agree(builtin("linuxcnc-xyzacb-trsrn").expect("shipped"), |g| xyzacb(g, 1.0));
    agree(&turned("linuxcnc-xyzacb-trsrn"), |g| xyzacb(g, -1.0));
    agree(builtin("linuxcnc-xyzbca-trsrn").expect("shipped"), |g| xyzbca(g, 1.0));
    agree(&turned("linuxcnc-xyzbca-trsrn"), |g| xyzbca(g, -1.0));
}

/// The table of kinematics notes 2.1.
#[test]
fn tool_axes_of_the_notes() {
    type Formula = fn([f64; 3], [f64; 3]) -> [f64; 3];
    let rows: [(&str, Formula); 7] = [
        ("linuxcnc-xyzac-trt-conventional", |s, c| {
            [s[0] * s[2], -s[0] * c[2], c[0]]
        }),
        ("linuxcnc-xyzac-trt", |s, c| [s[0] * s[2], s[0] * c[2], c[0]]),
        ("linuxcnc-xyzbc-trt-conventional", |s, c| {
            [c[2] * s[1], s[2] * s[1], c[1]]
        }),
        ("linuxcnc-xyzbc-trt", |s, c| [-c[2] * s[1], s[2] * s[1], c[1]]),
        ("linuxcnc-xyzab-tdr", |s, c| [s[1], -s[0] * c[1], c[0] * c[1]]),
        ("pocketnc-v2revp", |s, c| [-s[1] * c[0], s[0], c[1] * c[0]]),
        ("linuxcnc-bridge-mill", |s, c| [-s[1] * c[2], -s[1] * s[2], c[1]]),
    ];
    let mut random = SplitMix(5);
    for (name, formula) in rows {
        let machine = builtin(name).expect("shipped");
        for _ in 0..1000 {
            let q = [0; 3].map(|_| random.between(-PI, PI));
            let mut joints: Joints = [0.0; MAX_AXES];
            for (letter, value) in b"ABC".iter().zip(q) {
                if let Some(joint) = machine.joint(*letter) {
                    joints[joint] = value;
                }
            }
            let wanted = Vec3::from(formula(q.map(sin), q.map(cos)));
            let found = forward(machine, &joints, 0.0).axis;
            assert!((found - wanted).norm() < 1e-14, "{name}: {found} {wanted}");
        }
    }
}
