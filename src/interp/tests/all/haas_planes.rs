//! G268 and G253 of a Haas against PLANE SPATIAL and G68.2 of the same matrix; G254 against the turns of the table.
use crate::support::{fault_line, run_bytes};
use trunnion_geometry::Vec3;
use trunnion_interp::{RotaryTurn, Setup, Swivel, WorkOffset};

/// A trunnion table C on A, and the same machine with A in the head.
fn table(a_on_table: bool) -> Setup {
    let mut setup = Setup::default();
    let axis = |letter: usize, along: usize, on_table| {
        let mut direction = [0.0; 3];
        direction[along] = 1.0;
        RotaryTurn {
            letter,
            direction,
            on_table,
        }
    };
    setup.work_offsets.push(WorkOffset {
        name: "G54".to_owned(),
        values: [0.0; 9],
    });
    setup.control.rotary_turns = Some(vec![axis(5, 2, true), axis(3, 0, a_on_table)]);
    setup
}

/// Ends of the feed motions, and what was reported.
fn run(dialect: &str, setup: &Setup, text: &str) -> (Vec<Option<Vec3>>, Vec<String>) {
    let (program, log) = run_bytes(dialect, text.as_bytes(), setup);
    let cuts = log.motions.iter().filter(|motion| motion.is_feed());
    (
        cuts.map(|motion| motion.end.xyz()).collect(),
        log.faults.iter().map(|fault| fault_line(&program, fault)).collect(),
    )
}

const CUTS: &str = "G1 X0. Y0. Z0. F500.\nX10. Y0. Z0.\nX0. Y10. Z0.\nX3. Y-4. Z25.\n";

fn same(found: &[Option<Vec3>], wanted: &[Option<Vec3>], name: &str) {
    assert_eq!(found.len(), wanted.len(), "{name}");
    for (a, b) in found.iter().zip(wanted) {
        let (a, b) = (
            a.unwrap_or_else(|| panic!("{name}: unknown")),
            b.unwrap_or_else(|| panic!("{name}: unknown")),
        );
        assert!((a - b).norm() < 1e-6, "{name}: {a} and {b}");
    }
}

/// Degrees, -180 to 180 with four decimals, from a linear congruence (Knuth's MMIX).
fn next(seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    ((*seed >> 33) % 3_600_000) as f64 / 10_000.0 - 180.0
}

#[test]
fn a_feature_is_the_plane_of_the_same_spatial_angles() {
    let (setup, mut seed) = (Setup::default(), 3);
    for _ in 0..10_000 {
        let [a, b, c] = [(); 3].map(|()| next(&mut seed));
        let (found, said) = run(
            "haas-ngc",
            &setup,
            &format!("G268 X1. Y2. Z3. I{a:.4} J{b:.4} K{c:.4} Q123\n{CUTS}"),
        );
        let name = format!("{a} {b} {c}: {said:?}");
        let plane = format!("PLANE SPATIAL SPA{a:+.4} SPB{b:+.4} SPC{c:+.4} STAY\n");
        let lines = "L X+0 Y+0 Z+0 F500\nL X+10\nL X+0 Y+10\nL X+3 Y-4 Z+25\n";
        let (spatial, _) = run(
            "heidenhain-klartext",
            &setup,
            &format!("BEGIN PGM P MM\n{plane}{lines}"),
        );
        let origin = Vec3::new(1.0, 2.0, 3.0);
        let wanted: Vec<_> = spatial.iter().map(|end| end.map(|end| end + origin)).collect();
        same(&found, &wanted, &name);
    }
}

/// Orders without a source, P, R, tip control and a plane beside it are unknown by name, with one finding; G269 ends each.
#[test]
fn other_features_are_unknown_until_they_end() {
    for code in [
        "G268 X0. Y0. Z0. I10. J20. K0. Q321",
        "G268 X0. Y0. Z0. I10. J20. K0. Q313",
        "G268 X0. Y0. Z0. I10. J0. K0. Q313",
        "G268 X0. Y0. Z0. I10. J0. K0.",
        "G234 H1\nG268 X0. Y0. Z0. I10. J0. K0. Q123",
    ] {
        let (found, said) = run(
            "haas-ngc",
            &Setup::default(),
            &format!("{code}\n{CUTS}G269\nG49\n{CUTS}"),
        );
        let told = said
            .iter()
            .filter(|fault| fault.contains("G268") && fault.contains("NotModelled"));
        assert_eq!(told.count(), 1, "{code}: {said:?}");
        assert!(found[..4].iter().all(Option::is_none), "{code}: {found:?}");
        assert!(found[4..].iter().all(Option::is_some), "{code}: {found:?}");
    }
    // one angle is the same in each order of three axes
    for order in [123, 132, 213, 231, 312, 321] {
        let text = format!("G268 X0. Y0. Z0. I0. J90. K0. Q{order}\nG1 X1. Y2. Z3. F500.\n");
        let (found, said) = run("haas-ngc", &Setup::default(), &text);
        same(
            &found,
            &[Some(Vec3::new(3.0, 2.0, -1.0))],
            &format!("{order}: {said:?}"),
        );
    }
}

/// G253 turns the spindle along the normal; where the linear axes are after it is not stated.
#[test]
fn the_spindle_turns_to_the_feature() {
    let text = "G0 X0. Y0. Z50. A0. C0.\nG268 X0. Y0. Z0. I30. J0. K0. Q123\nG253\nG1 X0. Y0. Z10. F500.\n";
    let (_, log) = run_bytes("haas-ngc", text.as_bytes(), &table(true));
    let turn = log
        .motions
        .iter()
        .find(|motion| motion.tilt.swivel != Swivel::No)
        .expect("a turn");
    assert_eq!(turn.tilt.swivel, Swivel::AxesLost);
    assert!(turn.end.get(3).is_none() && turn.end.xyz().is_none());
    let cut = log.motions.last().expect("a cut");
    assert!((cut.end.xyz().expect("known") - Vec3::new(0.0, -5.0, 75f64.sqrt())).norm() < 1e-9);
    // without a feature, or on the turned table of G254, there is nothing to turn to
    for before in ["", "G254\n"] {
        let text = format!("G0 A10. C0.\n{before}G253\nG1 X0. Y0. Z10. F500.\n");
        let (_, said) = run("haas-ngc", &table(true), &text);
        assert!(said.iter().any(|fault| fault.contains("G253")), "{said:?}");
    }
}

/// The part has turned with the table: in its frame the machine's directions are those of the turns, as for PLANE AXIAL.
#[test]
fn a_dynamic_offset_keeps_the_directions_of_the_machine() {
    let (setup, mut seed) = (table(true), 11);
    let cuts = "G0 X0. Y0. Z0.\nG1 X0. Y0. Z0. F500.\nX10. Y0. Z0.\nX0. Y10. Z0.\nX3. Y-4. Z25.\n";
    for _ in 0..10_000 {
        let [a, c] = [(); 2].map(|()| next(&mut seed));
        let (found, said) = run("haas-ngc", &setup, &format!("G0 A{a:.4} C{c:.4}\nG254\n{cuts}G255\n"));
        let plane = format!("PLANE AXIAL A{a:+.4} C{c:+.4} STAY\n");
        let lines = "L X+0 Y+0 Z+0 F500\nL X+10\nL X+0 Y+10\nL X+3 Y-4 Z+25\n";
        let (axial, _) = run(
            "heidenhain-klartext",
            &setup,
            &format!("BEGIN PGM P MM\n{plane}{lines}"),
        );
        same(&found, &axial, &format!("{a} {c}: {said:?}"));
    }
}

#[test]
fn a_dynamic_offset_that_does_not_follow_is_unknown_until_it_ends() {
    let cuts = "G1 X4. Y5. Z6. F500.\nX7. Y5. Z6.\n";
    let mut undeclared = table(true);
    undeclared.work_offsets.clear();
    let cases = [
        (Setup::default(), "G0 A10. C20.\nG254"),
        (undeclared, "G0 A10. C20.\nG254"),
        (table(false), "G0 A10. C20.\nG254"),
        (table(true), "G0 A10.\nG254"),
        (table(true), "G0 A10. C20.\nG234 H1\nG254"),
        (table(true), "G0 A10. C20.\nG268 X0. Y0. Z0. I10. J0. K0. Q123\nG254"),
        // the table turns while it is on
        (table(true), "G0 A10. C20.\nG254\nG0 A15."),
        (table(true), "G0 A10. C20.\nG254\nG91 G0 A5.\nG90"),
        // the same number as an increment
        (table(true), "G0 A10. C20.\nG254\nG91 G0 A10.\nG90"),
        (table(true), "G0 A10. C20.\nG254\nG0 C#510"),
    ];
    for (setup, code) in cases {
        let (found, said) = run("haas-ngc", &setup, &format!("{code}\n{cuts}G255\nG269\nG49\n{cuts}"));
        assert!(found[..2].iter().all(Option::is_none), "{code}: {found:?} {said:?}");
        assert!(found[2..].iter().all(Option::is_some), "{code}: {found:?} {said:?}");
        let told = said
            .iter()
            .filter(|fault| fault.contains("G254") && fault.contains("NotModelled"));
        assert_eq!(told.count(), 1, "{code}: {said:?}");
    }
    // the same position said again turns nothing; G69 does not end it
    let text = format!("G0 A90. C0.\nG254\nG0 A90.\nG69\n{cuts}");
    let (found, said) = run("haas-ngc", &table(true), &text);
    same(
        &found,
        &[Some(Vec3::new(4.0, -6.0, 5.0)), Some(Vec3::new(7.0, -6.0, 5.0))],
        &format!("{said:?}"),
    );
}
