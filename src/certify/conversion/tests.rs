//! Bends of ways and what follows from them, term by term.
use super::*;
use crate::Outcome;
use trunnion_geometry::math::{atan2, cos, sin};
use trunnion_geometry::{Vec3, arc::Arc, deg, rad};
use trunnion_interp::Setup;
use trunnion_machine::{Machine, builtin};

const MIKRON: &str = "mikron-ucp710";

fn mikron() -> &'static Machine {
    builtin(MIKRON).expect("built in")
}

fn reading(text: &str, dialect: &str, machine: Option<&Machine>) -> Reading {
    read(&Run {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin(dialect).expect("built in"),
        machine,
        setup: &Setup::default(),
        assume: Assume::default(),
    })
}

fn is(found: f64, wanted: f64) {
    assert!(
        (found - wanted).abs() <= 1e-9 * (1.0 + wanted.abs()),
        "{found}, not {wanted}"
    );
}

/// Bends of tip and tool axis in the last motion but the dwell.
fn bend(text: &str, machine: Option<&Machine>) -> (f64, f64) {
    let reading = reading(text, "sinumerik-840d", machine);
    let posed = reading.motions.last().expect("a motion");
    Track::new(posed, machine).expect("known").bend()
}

#[test]
fn ways_bend_as_the_terms_say() {
    let turn = rad(10.0);
    // an arc of radius 10 by a quarter, of the tip or of the joints
    let quarter = 10.0 * rad(90.0) * rad(90.0);
    let (tip, axis) = bend("G17 G0 X10 Y0 Z5\nG3 X0 Y10 I-10 J0 F100\n", None);
    is(tip, quarter);
    is(axis, 0.0);
    let (tip, axis) = bend("G17 G0 X10 Y0 Z5 A0 C0\nG3 X0 Y10 I-10 J0 F100\n", Some(mikron()));
    is(tip, quarter);
    is(axis, 0.0);
    // joints: A alone at 50 mm, then with 20 mm outward
    let (tip, axis) = bend("G0 X0 Y30 Z40 A0 C0\nG1 A10 F100\n", Some(mikron()));
    is(tip, turn * turn * 50.0);
    is(axis, turn * turn);
    let (tip, _) = bend("G0 X0 Y0 Z40 A0 C0\nG1 Z60 A10 F100\n", Some(mikron()));
    is(tip, 2.0 * turn * 20.0 + turn * turn * 0.5 * (40.0 + 60.0 + 20.0));
    // led: the axis by both turns, or by the angle between both ends
    let (tip, axis) = bend("TRAORI\nG0 X0 Y0 Z40 A20 C0\nG1 X5 A30 C25 F100\n", Some(mikron()));
    is(tip, 0.0);
    is(axis, rad(35.0) * rad(35.0));
    let (_, axis) = bend("TRAORI\nG0 X0 Y0 Z40 A3=0 B3=0 C3=1\nG1 X5 A3=0 B3=1 C3=1 F100\n", None);
    is(axis, rad(45.0) * rad(45.0));
}

/// The same motion with another turn of the frame's hand.
#[test]
fn an_arc_in_a_mirror_turns_the_other_way() {
    let (sin, cos) = (sin(0.7), cos(0.7));
    let arc = Arc {
        start: Vec3::new(10.0, 0.0, 0.0),
        end: Vec3::new(10.0 * cos, 10.0 * sin, 0.0),
        centre: Vec3::zeros(),
        normal: Vec3::z(),
        sweep: 0.7,
        radius_start: 10.0,
        radius_end: 10.0,
    };
    for hand in [1.0, -1.0] {
        let map = |point: &Vec3| Vec3::new(hand * point.x + 3.0, point.z, -point.y);
        let found = carried(&arc, |point| Some(map(point))).expect("rigid");
        assert!(
            (found.point_at(0.3) - map(&arc.point_at(0.3))).norm() < 1e-9,
            "{hand}: {found:?}"
        );
    }
    assert_eq!(carried(&arc, |point| Some(point * 2.0)), None);
}

fn proof(
    before: (&Reading, Option<&Machine>),
    after: (&Reading, Option<&Machine>),
    path_mm: f64,
) -> Result<ConversionProof, Outcome> {
    converted(before, after, &[Part::Moves(1), Part::Moves(1)], &claim(path_mm, 1e9))
}

fn claim(path_mm: f64, time_share: f64) -> ConversionClaim {
    ConversionClaim {
        end_mm: 1e-6,
        end_deg: 1e-5,
        path_mm,
        path_deg: None,
        feed_mm_min: 1e9,
        time_share,
    }
}

#[track_caller]
fn refused(outcome: Result<ConversionProof, Outcome>, why: &str) {
    match outcome {
        Err(Outcome::Refuted(witness)) => assert!(witness.message.contains(why), "{witness}"),
        other => panic!("{other:?}"),
    }
}

/// A quarter of a circle and its chord: 2.93 mm apart in the middle, where no sample lies.
#[test]
fn what_lies_between_the_samples_counts() {
    let arc = reading(
        "G17 G0 X10 Y0 Z5\nG3 X0 Y10 I-10 J0 F100\nM30\n",
        "sinumerik-840d",
        None,
    );
    let chord = reading("G17 G0 X10 Y0 Z5\nG1 X0 Y10 F100\nM30\n", "sinumerik-840d", None);
    let truth = 10.0 * (1.0 - cos(rad(45.0)));
    for share in [0.9, 0.95, 0.97, 0.985, 0.999] {
        let refused = proof((&arc, None), (&chord, None), truth * share).expect_err("too far");
        assert!(matches!(refused, Outcome::Refuted(_)), "{share}: {refused:?}");
    }
    // the bound at the samples that the claim asks for: 5 steps, the farthest at two fifths
    let path = |claim: f64| proof((&arc, None), (&chord, None), claim).map(|proof| proof.path_mm);
    let bend = 10.0 * rad(90.0) * rad(90.0);
    let steps = (bend / (0.4 * 1.1 * truth)).sqrt().ceil();
    assert_eq!(steps, 5.0);
    let off = |t: f64| {
        let point = Vec3::new(cos(rad(90.0) * t), sin(rad(90.0) * t), 0.0) * 10.0;
        (point - Vec3::new(10.0 - 10.0 * t, 10.0 * t, 0.0)).norm()
    };
    let sampled = (0..=5).map(|i| off(f64::from(i) / 5.0)).fold(0.0, f64::max);
    is(path(1.1 * truth).expect("near enough"), sampled + bend / (8.0 * 25.0));
}

/// The tip runs straight, so that two samples are enough for it; the tool axis runs evenly by C before, on a great circle after.
#[test]
fn the_tool_axis_between_the_samples_counts() {
    let s = sin(rad(20.0));
    let [half_sin, half_cos] = [sin(rad(15.0)), cos(rad(15.0))];
    // A20 points along (sin A sin C, -sin A cos C, cos A)
    let vector = |sign: f64| format!("A3={} B3={} C3={}", sign * s * half_sin, -s * half_cos, cos(rad(20.0)));
    let words = reading(
        "TRAORI\nG0 X0 Y0 Z40 A20 C-15\nG1 X5 C15 F100\nM30\n",
        "sinumerik-840d",
        Some(mikron()),
    );
    let text = format!(
        "TRAORI\nG0 X0 Y0 Z40 {}\nG1 X5 {} F100\nM30\n",
        vector(-1.0),
        vector(1.0)
    );
    let vectors = reading(&text, "sinumerik-840d", None);
    // half way the cone's axis is tilted by 20 deg, that of the great circle by less
    let truth = 20.0 - deg(atan2(s * half_cos, cos(rad(20.0))));
    for (before, after) in [
        ((&words, Some(mikron())), (&vectors, None)),
        ((&vectors, None), (&words, Some(mikron()))),
    ] {
        let found = proof(before, after, 0.01).expect("the same tip");
        is(found.path_mm, 0.0);
        // a proven bound, and hardly more than the truth
        assert!((truth..truth + 1e-4).contains(&found.path_deg), "{truth} {found:?}");
    }
}

/// A straight way of the tip before, an arc about A after: both ends agree, 0.19 mm between them do not.
#[test]
fn the_way_after_bends_too() {
    let swing = "G0 X0 Y30 Z40 A0 C0\nG1 A10 F100\nM30\n";
    let after = reading(swing, "sinumerik-840d", Some(mikron()));
    let end = after.motions[1].end.as_ref().expect("known").tip;
    let text = format!(
        "TRAORI\nG0 X0 Y30 Z40 A0 C0\nG1 X{} Y{} Z{} A10 F100\nM30\n",
        end.x, end.y, end.z
    );
    let before = reading(&text, "sinumerik-840d", Some(mikron()));
    let held = |path_mm: f64| proof((&before, Some(mikron())), (&after, Some(mikron())), path_mm);
    let truth = 50.0 * (1.0 - cos(rad(5.0)));
    for share in [0.5, 0.9, 0.999] {
        refused(held(truth * share), "inside the block the tip");
    }
    let found = held(truth * 1.1).expect("near enough").path_mm;
    assert!(found >= truth && found <= truth * 1.1, "{found}");
}

#[test]
fn another_spindle_speed_is_refuted() {
    let at = |rpm: u32| {
        let text = format!("S{rpm} M3\nG0 X0 Y0 Z0\nG1 X5 F100\nM30\n");
        reading(&text, "sinumerik-840d", None)
    };
    proof((&at(1000), None), (&at(1000), None), 0.01).expect("the same");
    refused(proof((&at(1000), None), (&at(1001), None), 0.01), "the spindle differs");
}

/// F of a turn counts degrees: what is compared is the time, whether longer or shorter.
#[test]
fn a_motion_that_takes_another_time_is_refuted() {
    let at = |feed: u32| {
        let text = format!("G0 X0 Y30 Z40 A0 C0\nG1 A10 F{feed}\nM30\n");
        reading(&text, "sinumerik-840d", Some(mikron()))
    };
    let moves = [Part::Moves(1), Part::Moves(1)];
    let held = |one: u32, two: u32| {
        let (before, after) = (at(one), at(two));
        let machine = Some(mikron());
        converted((&before, machine), (&after, machine), &moves, &claim(0.01, 0.1))
    };
    is(held(100, 105).expect("near enough").time_share, 1.0 - 100.0 / 105.0);
    refused(held(100, 50), "it takes");
    refused(held(100, 200), "it takes");
}

/// A rapid to nowhere known may be left out before all known places of its tool, or behind them, and not between.
#[test]
fn a_rapid_between_known_places_is_not_left_out() {
    let places = ["G0 X0. Y0. Z5.\n", "G0 X1. Y0. Z5.\n"];
    let after = reading(&format!("{}{}M30\n", places[0], places[1]), "fanuc-30i", None);
    let lost = "G28 Z5.\n";
    for (before, left, fine) in [
        (format!("{lost}{}{}M30\n", places[0], places[1]), 0, true),
        (format!("{}{lost}{}M30\n", places[0], places[1]), 1, false),
        (format!("{}{}{lost}M30\n", places[0], places[1]), 2, true),
    ] {
        let before = reading(&before, "fanuc-30i", None);
        let unknown: Vec<usize> = (0..before.motions.len())
            .filter(|&index| before.motions[index].end.is_err())
            .collect();
        assert!(
            !unknown.is_empty() && unknown.contains(&left) || left > 0,
            "{unknown:?}"
        );
        let parts: Vec<Part> = before
            .motions
            .iter()
            .map(|posed| match posed.end {
                Err(_) => Part::Left,
                Ok(_) => Part::Moves(1),
            })
            .collect();
        let outcome = converted((&before, None), (&after, None), &parts, &claim(0.01, 0.1));
        if fine {
            assert_eq!(outcome.expect("only places").left_out as usize, unknown.len());
        } else {
            refused(outcome, "must not be left out");
        }
    }
}
