//! PLANE AXIAL: its matrix on random positions of many chains, against the product of the turns and against PLANE SPATIAL of the same matrix.
use crate::planes_agree::about;
use crate::support::{fault_line, run_bytes};
use trunnion_geometry::math::{asin, atan2};
use trunnion_geometry::{Mat3, Vec3};
use trunnion_interp::{Position, RotaryTurn, Setup, Swivel, WorkOffset};

const PLACES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [3.0, -4.0, 25.0]];

/// A machine by its rotary axes, workpiece side first; a minus turns the other way.
fn machine(chain: &str) -> Setup {
    let mut setup = Setup::default();
    let turns = chain.split_whitespace().map(|axis| {
        let letter = axis.bytes().last().expect("a letter");
        let along = usize::from(letter - b'A');
        let mut direction = [0.0; 3];
        direction[along] = if axis.starts_with('-') { -1.0 } else { 1.0 };
        RotaryTurn {
            letter: along + 3,
            direction,
            on_table: true,
        }
    });
    setup.control.rotary_turns = Some(turns.collect());
    setup
}

fn program(plane: &str) -> String {
    let mut text = format!("0 BEGIN PGM P MM\n1 TOOL CALL 1 Z S1000\n2 L X+0 Y+0 Z+100 R0 FMAX M3\n{plane}\n");
    for [x, y, z] in PLACES {
        text += &format!("L X{x:+} Y{y:+} Z{z:+} F500\n");
    }
    text + "L M30\nEND PGM P MM\n"
}

/// What the linear axes do in a turn, whether the tip is guided, and where it ends.
type Turned = (Swivel, bool, Position);

/// Ends of the lines, what was reported, and the turns.
fn run(setup: &Setup, plane: &str) -> (Vec<Option<Vec3>>, Vec<String>, Vec<Turned>) {
    let (text, log) = run_bytes("heidenhain-klartext", program(plane).as_bytes(), setup);
    let cuts = log.motions.iter().filter(|motion| motion.is_feed());
    let turns = log.motions.iter().filter(|motion| motion.tilt.swivel != Swivel::No);
    (
        cuts.map(|motion| motion.end.xyz()).collect(),
        log.faults.iter().map(|fault| fault_line(&text, fault)).collect(),
        turns
            .map(|motion| (motion.tilt.swivel, motion.tcp, motion.end))
            .collect(),
    )
}

fn near(found: &[Option<Vec3>], turn: &Mat3, off: f64, name: &str) {
    assert_eq!(found.len(), PLACES.len(), "{name}");
    for (found, place) in found.iter().zip(PLACES) {
        let found = found.unwrap_or_else(|| panic!("{name}: an unknown end"));
        let wanted = turn * Vec3::from(place);
        assert!((found - wanted).norm() < off, "{name}: {found} and {wanted}");
    }
}

/// Degrees, -180 to 180 with four decimals, from a linear congruence (Knuth's MMIX).
fn next(seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    ((*seed >> 33) % 3_600_000) as f64 / 10_000.0 - 180.0
}

const CHAINS: [&str; 10] = ["C A", "A C", "C B", "B C", "A B", "-C -A", "C -B", "-A C", "A", "-B"];

#[test]
fn the_plane_is_what_the_axes_make_of_the_directions_of_the_machine() {
    let (mut seed, mut compared) = (7, 0);
    let ways = ["STAY", "MOVE FMAX", "TURN F2000"];
    while compared < 10_000 {
        for (at, chain) in CHAINS.iter().enumerate() {
            let setup = machine(chain);
            let (mut turn, mut words) = (Mat3::identity(), String::new());
            for axis in chain.split_whitespace() {
                let letter = axis.chars().last().expect("a letter");
                let degrees = next(&mut seed);
                let sense = if axis.starts_with('-') { -1.0 } else { 1.0 };
                turn *= about(usize::from(letter as u8 - b'A'), degrees * sense);
                // the order of the words is free
                words = format!("{letter}{degrees:+.4} {words}");
            }
            let way = ways[(compared + at) % ways.len()];
            let block = format!("PLANE AXIAL {words}{way}");
            let (found, told, _) = run(&setup, &block);
            let name = format!("{chain}: {block}: {told:?}");
            near(&found, &turn, 1e-9, &name);
            // about X, then Y, then Z as they stand
            let (a, b, c) = (
                atan2(turn[(2, 1)], turn[(2, 2)]).to_degrees(),
                -asin(turn[(2, 0)].clamp(-1.0, 1.0)).to_degrees(),
                atan2(turn[(1, 0)], turn[(0, 0)]).to_degrees(),
            );
            if turn[(2, 0)].abs() < 1.0 - 1e-9 {
                let spatial = format!("PLANE SPATIAL SPA{a:+.13} SPB{b:+.13} SPC{c:+.13} STAY");
                let (found, ..) = run(&setup, &spatial);
                near(&found, &turn, 1e-6, &spatial);
            }
            compared += 1;
        }
    }
}

/// MOVE holds the tip, TURN the linear axes; both turn exactly the axes of the block. STAY turns nothing and leaves Q120 to Q122.
#[test]
fn it_moves_as_the_other_forms_do() {
    let setup = machine("C A");
    let at = |position: &Position, axis: usize| position.get(axis);
    for (way, swivel, tip) in [
        ("MOVE DIST0 FMAX", Swivel::TipStays, true),
        ("TURN MB MAX FMAX", Swivel::AxesStay, false),
    ] {
        let (_, told, turns) = run(&setup, &format!("PLANE AXIAL A-45 C+30 {way}"));
        let [(found, guided, end)] = turns[..] else {
            panic!("{way}: {turns:?} {told:?}")
        };
        assert_eq!((found, guided), (swivel, tip), "{way}");
        assert_eq!(
            (at(&end, 3), at(&end, 4), at(&end, 5)),
            (Some(-45.0), None, Some(30.0)),
            "{way}"
        );
    }
    let (_, _, turns) = run(&setup, "PLANE AXIAL A-45 C+30 STAY");
    assert!(turns.is_empty(), "{turns:?}");
    let stay = "PLANE AXIAL A-45 C+30 STAY\nL A+Q120 C+Q122 FMAX";
    let (text, log) = run_bytes("heidenhain-klartext", program(stay).as_bytes(), &setup);
    let there = log
        .motions
        .iter()
        .find(|motion| motion.end.get(3).is_some())
        .unwrap_or_else(|| {
            panic!(
                "{:?}",
                log.faults
                    .iter()
                    .map(|fault| fault_line(&text, fault))
                    .collect::<Vec<_>>()
            )
        });
    assert_eq!((at(&there.end, 3), at(&there.end, 5)), (Some(-45.0), Some(30.0)));
    // another plane changes Q120: a value of before is not kept
    let other =
        "PLANE AXIAL A-45 C+30 STAY\nPLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY\nQ1 = Q120\nPLANE RESET STAY\nL A+Q1 FMAX";
    let (_, log) = run_bytes("heidenhain-klartext", program(other).as_bytes(), &setup);
    assert!(log.motions.iter().all(|motion| motion.end.get(3).is_none()));
}

/// What does not follow from the block and the machine is unknown by name, and so are positions in the plane; the reset ends it.
#[test]
fn what_does_not_follow_is_unknown_by_name() {
    let mut shifted = machine("C A");
    shifted.work_offsets.push(WorkOffset {
        name: trunnion_interp::UNNAMED_ZERO.to_owned(),
        values: [0.0, 0.0, 0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0],
    });
    let mut nutating = machine("C A");
    let slant = core::f64::consts::FRAC_1_SQRT_2;
    nutating.control.rotary_turns.as_mut().expect("axes")[1].direction = [0.0, slant, slant];
    let cases = [
        (
            Setup::default(),
            "A-45 C+30",
            "PLANE AXIAL: the plane follows from the rotary axes of the machine",
        ),
        (machine(""), "A-45", "no rotary axis A"),
        (machine("C A"), "A-45", "C has no position in the block"),
        (machine("C A"), "A-45 B+10 C+30", "no rotary axis B"),
        (machine("C A"), "A-45 IC+30", "IC: only positions"),
        (machine("C A"), "A-45 C+Q55", "Q55: the program does not set its value"),
        (nutating, "A-45 C+30", "A is not parallel to X, Y or Z"),
        (shifted, "A-45 C+30", "the zero of a rotary axis"),
    ];
    for (setup, words, why) in cases {
        for way in ["STAY", "MOVE FMAX", "TURN F500"] {
            let (found, told, _) = run(&setup, &format!("PLANE AXIAL {words} {way}"));
            let name = format!("{words} {way}: {told:?}");
            assert!(told.iter().any(|fault| fault.contains(why)), "{name}");
            assert!(found.iter().all(Option::is_none), "{name}");
            let (found, ..) = run(&setup, &format!("PLANE AXIAL {words} {way}\nPLANE RESET STAY"));
            assert!(found.iter().all(Option::is_some), "{name}: after the reset");
        }
    }
}
