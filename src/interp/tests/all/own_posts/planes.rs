//! Planes of the shared 3+2 programs, written in every form of PLANE that has a source, with STAY, MOVE and TURN. The matrix of a plane is worked out here,
//! from the words of CYCLE800, and compared with the ends of lines in it.
use super::{plain, run_posted};
use crate::planes_agree::about;
use crate::support::{faults, shared};
use trunnion_geometry::{Mat3, Vec3};

const NAME: &str = "heidenhain-klartext";

/// A, B and C in space of the planes in a program: CYCLE800 in mode 27 turns about Z, the new Y, the new X.
fn angles(text: &str) -> Vec<[f64; 3]> {
    let mut found: Vec<[f64; 3]> = Vec::new();
    for line in text.lines() {
        let Some((_, call)) = line.split_once("CYCLE800(") else {
            continue;
        };
        let words: Vec<&str> = call
            .trim_end()
            .trim_end_matches(')')
            .split(',')
            .map(str::trim)
            .collect();
        let number = |place: usize| words.get(place).and_then(|text| text.parse().ok()).unwrap_or(0.0);
        if number(3) == 27.0 {
            let of = [number(9), number(8), number(7)];
            if !found.contains(&of) {
                found.push(of);
            }
        }
    }
    found
}

/// The blocks that define one plane, by form; all but the last of them turn nothing.
fn forms([a, b, c]: [f64; 3], turn: &Mat3) -> Vec<(&'static str, Vec<String>)> {
    let (base, normal): (Vec3, Vec3) = (turn.column(0) * 2.0 + turn.column(2) * 0.5, turn.column(2) * 3.0);
    let [bx, by, bz] = <[f64; 3]>::from(base).map(plain9);
    let [nx, ny, nz] = <[f64; 3]>::from(normal).map(plain9);
    let z: Vec3 = turn.column(2).into();
    let nutation = trunnion_geometry::math::atan2(trunnion_geometry::math::hypot(z.x, z.y), z.z).to_degrees();
    let (precession, rotation) = if (1e-9..180.0 - 1e-9).contains(&nutation) {
        (
            trunnion_geometry::math::atan2(z.x, -z.y).to_degrees(),
            trunnion_geometry::math::atan2(turn[(2, 0)], turn[(2, 1)]).to_degrees(),
        )
    } else {
        (
            trunnion_geometry::math::atan2(turn[(1, 0)], turn[(0, 0)]).to_degrees(),
            0.0,
        )
    };
    // three points of the plane somewhere in space: the datum does not move
    let point = |local: [f64; 3]| Vec3::new(5.0, -7.0, 11.0) + turn * Vec3::from(local);
    let points: Vec<String> = [[0.0; 3], [10.0, 0.0, 0.0], [3.0, 8.0, 0.0]]
        .into_iter()
        .enumerate()
        .map(|(at, local)| {
            let [x, y, z]: [f64; 3] = point(local).into();
            let at = at + 1;
            format!("P{at}X{} P{at}Y{} P{at}Z{}", plain9(x), plain9(y), plain9(z))
        })
        .collect();
    vec![
        (
            "SPATIAL",
            vec![format!("SPATIAL SPA{} SPB{} SPC{}", plain9(a), plain9(b), plain9(c))],
        ),
        (
            "EULER",
            vec![format!(
                "EULER EULPR{} EULNU{} EULROT{}",
                plain9(precession),
                plain9(nutation),
                plain9(rotation)
            )],
        ),
        // not of length 1, and the base vector not square to the normal
        (
            "VECTOR",
            vec![format!("VECTOR BX{bx} BY{by} BZ{bz} NX{nx} NY{ny} NZ{nz}")],
        ),
        ("POINTS", vec![format!("POINTS {}", points.join(" "))]),
        (
            "RELATIV",
            vec![
                format!("SPATIAL SPA+0 SPB+0 SPC{}", plain9(c)),
                format!("RELATIV SPB{}", plain9(b)),
                format!("RELATIV SPA{}", plain9(a)),
            ],
        ),
        (
            "RELATIVE of the other way round",
            vec![
                // back by the same angle: the plane before it
                format!("SPATIAL SPA{} SPB{} SPC{}", plain9(a), plain9(b), plain9(c)),
                "RELATIVE SPB+25".to_owned(),
                "RELATIVE SPB-25".to_owned(),
            ],
        ),
    ]
}

/// Signed, with a comma, and nine decimals.
fn plain9(value: f64) -> String {
    let value = if value.abs() < 5e-10 { 0.0 } else { value };
    format!("{value:+.9}").replace('.', ",")
}

const HOW: [&str; 8] = [
    "STAY",
    "MOVE DIST0 FMAX",
    "MOVE ABST0 F1000 SEQ-",
    "MOVE F2000 SEQ+ COORD ROT",
    "TURN FMAX",
    "TURN MB MAX FMAX SEQ-",
    "TURN MB50 F1000 SEQ+",
    "TURN F5000",
];

/// The program of one plane: four lines in it.
fn program(blocks: &[String], how: &str) -> String {
    let mut text = String::from("0 BEGIN PGM PLANE MM\n1 TOOL CALL 1 Z S1000\n2 M3\n3 L X+0 Y+0 Z+100 R0 FMAX\n");
    for (at, block) in blocks.iter().enumerate() {
        let how = if at + 1 == blocks.len() { how } else { "STAY" };
        text += &format!("{} PLANE {block} {how}\n", at + 4);
    }
    if how == "STAY" {
        text += "L A+Q120 C+Q122 R0 FMAX\n";
    }
    for [x, y, z] in PLACES {
        text += &format!("L X{} Y{} Z{} F500\n", plain(x), plain(y), plain(z));
    }
    text + "PLANE RESET STAY\nL M30\nEND PGM PLANE MM\n"
}

const PLACES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [3.0, -4.0, 25.0]];

#[test]
fn each_plane_in_every_form_has_its_matrix() {
    let mut all = vec![
        [0.0, 0.0, 30.0],
        [90.0, 0.0, 0.0],
        [-30.0, 20.0, 115.0],
        [180.0, 0.0, 0.0],
    ];
    for file in ["four-controls/siemens/Demo_1.mpf", "sinumerik/CAM_TEST.MPF"] {
        let Some(bytes) = shared(file) else { return };
        all.extend(angles(&String::from_utf8_lossy(&bytes)));
    }
    assert!(all.len() > 8, "{}", all.len());
    for angles in all {
        let [a, b, c] = angles;
        let turn = about(2, c) * about(1, b) * about(0, a);
        for (form, blocks) in forms(angles, &turn) {
            for how in HOW {
                let name = format!("{form} {angles:?} {how}");
                let motions = run_posted(NAME, &name, &program(&blocks, how), &["MB MAX: where the retract"]);
                let cuts: Vec<_> = motions.iter().filter(|motion| motion.is_feed()).collect();
                assert_eq!(cuts.len(), PLACES.len(), "{name}");
                for (cut, place) in cuts.iter().zip(PLACES) {
                    let wanted = turn * Vec3::from(place);
                    let found = cut.end.xyz().unwrap_or_else(|| panic!("{name}: an unknown end"));
                    assert!((found - wanted).norm() < 1e-6, "{name}: {found} and {wanted}");
                }
            }
        }
    }
}

/// Positions of rotary axes say nothing about the plane without the machine.
#[test]
fn a_plane_by_its_axes_is_unknown_by_name() {
    for how in HOW {
        let text = program(&["AXIAL A-45 C+30".to_owned()], how);
        let told = faults(NAME, &text);
        assert!(
            told.iter().any(|fault| fault.contains("PLANE AXIAL")),
            "{how}: {told:?}"
        );
    }
}
