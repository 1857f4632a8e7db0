//! One plane in every form of every control, on random matrices: what each program makes of four points.
//!
//! CYCLE800 in its six orders, ROT, AROT and CROT, PLANE SPATIAL, EULER, VECTOR, POINTS and RELATIV, G68.2 P0 to P3 and G68.4. What the sources leave open stays
//! unknown: PLANE PROJECTED, G68.2 P4, G68.3. PLANE AXIAL needs a machine: `plane_axial`.
use crate::support::{faults, run_bytes};
use trunnion_geometry::math::{asin, atan2, cos, hypot, sin};
use trunnion_geometry::{Mat3, Vec3};
use trunnion_interp::{FrameAngles, RollPitchYaw, Setup};

/// The six orders of the axes with the mode of CYCLE800.
pub(crate) const ORDERS: [(u32, [usize; 3]); 6] = [
    (57, [0, 1, 2]),
    (45, [0, 2, 1]),
    (54, [1, 0, 2]),
    (30, [1, 2, 0]),
    (39, [2, 0, 1]),
    (27, [2, 1, 0]),
];

const SIEMENS: &str = "sinumerik-840d";
const KLARTEXT: &str = "heidenhain-klartext";
const FANUC: &str = "fanuc-30i";

/// Degrees, -180 to 180 with four decimals, from a linear congruence (Knuth's MMIX).
struct Angles(u64);

impl Angles {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % 3_600_000) as f64 / 10_000.0 - 180.0
    }
}

/// Right-handed about X, Y or Z: written once more here, so that the program's own turns are not compared with themselves.
pub(crate) fn about(axis: usize, degrees: f64) -> Mat3 {
    let (sin, cos) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turn = Mat3::identity();
    (turn[(a, a)], turn[(b, b)], turn[(a, b)], turn[(b, a)]) = (cos, cos, -sin, sin);
    turn
}

/// The angles about the axes `order`, each about the axis as it comes out of the turns before, that make a matrix.
fn angles(order: [usize; 3], turn: &Mat3) -> [f64; 3] {
    let [i, j, k] = order;
    let sign = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
    [
        atan2(-sign * turn[(j, k)], turn[(k, k)]),
        asin((sign * turn[(i, k)]).clamp(-1.0, 1.0)),
        atan2(-sign * turn[(i, j)], turn[(i, i)]),
    ]
    .map(f64::to_degrees)
}

/// Angles about Z, the new X, the new Z.
fn euler(turn: &Mat3) -> [f64; 3] {
    let z = turn.column(2);
    let nutation = atan2(hypot(z[0], z[1]), z[2]);
    let precession = atan2(z[0], -z[1]);
    let rotation = atan2(turn[(2, 0)], turn[(2, 1)]);
    [precession, nutation, rotation].map(f64::to_degrees)
}

/// The forms of a programmable frame of a Sinumerik that turns by angles about Z, the new Y, the new X.
fn turns(a: f64, b: f64, c: f64) -> [(&'static str, String); 4] {
    [
        (
            "ROT Z, AROT Y, AROT X",
            format!("ROT Z{c:.13}\nAROT Y{b:.13}\nAROT X{a:.13}\n"),
        ),
        ("ROT X Y Z", format!("ROT Y{b:.13} X{a:.13} Z{c:.13}\n")),
        ("CROT", format!("$P_PFRAME=CROT(X,{a:.13},Y,{b:.13},Z,{c:.13})\n")),
        (
            "CROT chain",
            format!("$P_PFRAME=CROT(Z,{c:.13}):CROT(Y,{b:.13}):CROT(X,{a:.13})\n"),
        ),
    ]
}

/// The forms of a plane: name, control, and the blocks that begin it.
fn forms(turn: &Mat3) -> Vec<(String, &'static str, String)> {
    let mut forms = Vec::new();
    for (mode, order) in ORDERS {
        let [a, b, c] = angles(order, turn);
        let call = format!("CYCLE800(0,\"T\",0,{mode},0,0,0,{a:.13},{b:.13},{c:.13},0,0,0,0)\n");
        forms.push((format!("CYCLE800 {mode}"), SIEMENS, call));
    }
    let [c, b, a] = angles([2, 1, 0], turn);
    forms.extend(turns(a, b, c).map(|(name, blocks)| (name.to_owned(), SIEMENS, blocks)));
    let [i, j, k] = euler(turn);
    let [x, y, z] = [0, 1, 2].map(|column| Vec3::from(turn.column(column)));
    let mut klartext = |form: &str, words: String| {
        forms.push((
            format!("PLANE {form}"),
            KLARTEXT,
            format!("PLANE {form} {words} STAY\n"),
        ));
    };
    klartext("SPATIAL", format!("SPA{a:+.13} SPB{b:+.13} SPC{c:+.13}"));
    klartext("EULER", format!("EULPR{i:+.13} EULNU{j:+.13} EULROT{k:+.13}"));
    // the base vector need not be square to the normal
    let base = x * 0.5 + z * 0.3;
    klartext(
        "VECTOR",
        format!(
            "BX{:+.15} BY{:+.15} BZ{:+.15} NX{:+.15} NY{:+.15} NZ{:+.15}",
            base.x, base.y, base.z, z.x, z.y, z.z
        ),
    );
    let (second, third) = (x * 7.0, x * 2.0 + y * 3.0);
    klartext(
        "POINTS",
        format!(
            "P1X+0 P1Y+0 P1Z+0 P2X{:+.14} P2Y{:+.14} P2Z{:+.14} P3X{:+.14} P3Y{:+.14} P3Z{:+.14}",
            second.x, second.y, second.z, third.x, third.y, third.z
        ),
    );
    let mut fanuc = |form: &str, blocks: String| forms.push((form.to_owned(), FANUC, blocks));
    let zero = "X0. Y0. Z0.";
    fanuc("G68.2", format!("G68.2 {zero} I{i:.13} J{j:.13} K{k:.13}\n"));
    let [one, two, three] = angles([0, 1, 2], turn);
    fanuc(
        "G68.2 P1 Q123",
        format!("G68.2 P1 Q123 {zero} I{one:.13} J{two:.13} K{three:.13}\n"),
    );
    let [one, two, three] = angles([1, 0, 2], turn);
    fanuc(
        "G68.2 P1 Q213",
        format!("G68.2 P1 Q213 {zero} I{two:.13} J{one:.13} K{three:.13}\n"),
    );
    fanuc(
        "G68.2 P2",
        format!(
            "G68.2 P2 Q1 {zero}\nG68.2 P2 Q2 X{:.14} Y{:.14} Z{:.14}\nG68.2 P2 Q3 X{:.14} Y{:.14} Z{:.14}\n",
            second.x, second.y, second.z, third.x, third.y, third.z
        ),
    );
    fanuc(
        "G68.2 P3",
        format!(
            "G68.2 P3 Q1 {zero} I{:.14} J{:.14} K{:.14}\nG68.2 P3 Q2 I{:.14} J{:.14} K{:.14}\n",
            x.x, x.y, x.z, z.x, z.y, z.z
        ),
    );
    // in two steps: the second is relative to the first
    let rest = euler(&(about(0, 30.0).transpose() * turn));
    let [i, j, k] = rest;
    fanuc(
        "G68.2, G68.4",
        format!("G68.2 {zero} I0. J30. K0.\nG68.4 {zero} I{i:.13} J{j:.13} K{k:.13}\n"),
    );
    forms
}

/// The columns of the matrix, by where four points of the plane are.
fn columns(dialect: &str, blocks: &str, setup: &Setup) -> Option<Mat3> {
    let text = match dialect {
        KLARTEXT => format!(
            "0 BEGIN PGM A MM\nL X0 Y0 Z0 FMAX\n{blocks}L X0 Y0 Z0 F100\nL X100 Y0 Z0\nL X0 Y100 Z0\nL X0 Y0 Z100\n"
        ),
        SIEMENS => format!("G17 G90 G71 F100\nG0 X0 Y0 Z0\n{blocks}G1 X0 Y0 Z0\nX100 Y0 Z0\nX0 Y100 Z0\nX0 Y0 Z100\n"),
        _ => format!(
            "G17 G90 G21 G94 F100.\nG0 X0. Y0. Z0.\n{blocks}G1 X0. Y0. Z0.\nX100. Y0. Z0.\nX0. Y100. Z0.\nX0. Y0. Z100.\n"
        ),
    };
    let motions = run_bytes(dialect, text.as_bytes(), setup).1.motions;
    let ends: Option<Vec<Vec3>> = motions
        .iter()
        .filter(|motion| motion.is_feed())
        .map(|motion| motion.end.xyz())
        .collect();
    let ends = ends?;
    let [zero, x, y, z] = ends.as_slice() else { return None };
    Some(Mat3::from_columns(&[
        (x - zero) / 100.0,
        (y - zero) / 100.0,
        (z - zero) / 100.0,
    ]))
}

#[test]
fn the_same_plane_in_every_form_of_every_control() {
    let mut random = Angles(23);
    let mut setup = Setup::default();
    setup.control.roll_pitch_yaw = Some(RollPitchYaw::Turned);
    setup.control.frame_angles = Some(FrameAngles::RollPitchYaw);
    let mut compared = 0;
    for round in 0..10_000 {
        let [a, b, c] = [random.next(), random.next(), random.next()];
        let turn = about(2, c) * about(1, b) * about(0, a);
        for (index, (form, dialect, blocks)) in forms(&turn).into_iter().enumerate() {
            // every form on each fourth matrix, and all of them on the first
            if round >= 100 && (index + round) % 4 != 0 {
                continue;
            }
            let found = columns(dialect, &blocks, &setup).unwrap_or_else(|| panic!("{form}: not known:\n{blocks}"));
            let off = (found - turn).norm();
            // a middle angle near 90 degrees takes half of the digits from the other two
            assert!(off < 1e-6, "{form}: off by {off}:\n{blocks}");
            compared += 1;
        }
    }
    assert!(compared > 40_000, "{compared}");
}

/// PLANE RELATIV turns about one axis of the plane that is active: as PLANE SPATIAL does where none is, and else about the turned axis.
#[test]
fn a_relative_plane_of_one_angle() {
    let mut random = Angles(7);
    for _ in 0..1_000 {
        let [a, b, c, d] = [0; 4].map(|_| random.next());
        let blocks = format!(
            "PLANE SPATIAL SPA{a:+} SPB+0 SPC{c:+} STAY\nPLANE RELATIV SPB{b:+} STAY\nPLANE RELATIV SPC{d:+} STAY\n"
        );
        let found = columns(KLARTEXT, &blocks, &Setup::default()).expect("known");
        let wanted = about(2, c) * about(0, a) * about(1, b) * about(2, d);
        assert!((found - wanted).norm() < 1e-9, "{blocks}");
        for (axis, word) in ["SPA", "SPB", "SPC"].into_iter().enumerate() {
            let angle = random.next();
            let blocks = format!("PLANE RELATIV {word}{angle:+} STAY\n");
            let found = columns(KLARTEXT, &blocks, &Setup::default()).expect("known");
            assert!((found - about(axis, angle)).norm() < 1e-9, "{blocks}");
        }
    }
}

#[test]
fn forms_without_a_source_stay_unknown_by_name() {
    for (dialect, blocks, name) in [
        (
            KLARTEXT,
            "PLANE PROJECTED PROPR+10 PROMIN+20 ROT+30 STAY\n",
            "PLANE PROJECTED",
        ),
        (KLARTEXT, "PLANE AXIAL A+10 C+20 STAY\n", "PLANE AXIAL"),
        (KLARTEXT, "PLANE RELATIV SPA+10 SPB+20 STAY\n", "PLANE RELATIV"),
        (
            KLARTEXT,
            "PLANE AXIAL A+10 C+20 STAY\nPLANE RELATIV SPB+20 STAY\n",
            "PLANE RELATIV",
        ),
        (FANUC, "G68.2 P4 X0. Y0. Z0. I10. J20. K0.\n", "G68.2"),
        (FANUC, "G68.3 X0. Y0. Z0. R10.\n", "G68.3"),
        (SIEMENS, "CYCLE800(0,\"T\",0,192,0,0,0,10,20,0,0,0,0,0)\n", "CYCLE800"),
        (SIEMENS, "CYCLE800(0,\"T\",0,64,0,0,0,10,20,0,0,0,0,0)\n", "CYCLE800"),
        (SIEMENS, "CYCLE800(0,\"T\",0,128,0,0,0,10,20,0,0,0,0,0)\n", "CYCLE800"),
    ] {
        assert_eq!(columns(dialect, blocks, &Setup::default()), None, "{blocks}");
        let said = faults(dialect, blocks);
        assert!(said.iter().any(|fault| fault.contains(name)), "{blocks}: {said:?}");
    }
}
