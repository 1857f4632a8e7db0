//! Runs of rapids that differ: what is below the level of the old run is not declared.
use super::super::certify;
use crate::{Claim, Outcome};
use trunnion_geometry::plane::{Point, Polygon};
use trunnion_interp::{Setup, Tool};
use trunnion_machine::{Footprint, Obstacle, ObstacleKind};

const CLEAR: Claim = Claim::ClearRapids {
    tolerance_mm: 1e-6,
    tolerance_deg: 1e-6,
    clearance_mm: 1.0,
    assumed_zeros: true,
};

/// A box between two corners.
fn block(kind: ObstacleKind, [x, y, z]: [[f64; 2]; 3]) -> Obstacle {
    let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(Point::from);
    Obstacle {
        name: "box".to_owned(),
        axis: None,
        footprint: Footprint::Polygon(Polygon::new(&corners).expect("a rectangle")),
        bottom: z[0],
        top: z[1],
        kind,
    }
}

fn prove_on(name: &str, further: Option<Obstacle>, before: &str, after: &str) -> Outcome {
    let mut machine = trunnion_machine::builtin(name).expect("built in").clone();
    let clamp = block(ObstacleKind::Body, [[200.0, 220.0], [200.0, 220.0], [-50.0, 30.0]]);
    machine.obstacles.0 = [clamp].into_iter().chain(further).collect();
    let setup = Setup {
        tools: vec![Tool {
            number: 0,
            shape: None,
            diameter_mm: Some(8.0),
            length_mm: None,
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let dialect = trunnion_dialect::builtin("iso-6983").expect("built in");
    certify(before.as_bytes(), after.as_bytes(), dialect, &machine, &setup, &CLEAR)
}

fn prove(before: &str, after: &str) -> Outcome {
    prove_on("mill-3axis", None, before, after)
}

fn lower(outcome: &Outcome) {
    let Outcome::Refuted(witness) = outcome else {
        panic!("not refuted: {outcome:?}")
    };
    assert!(
        witness.message.contains("only declared obstacles are known"),
        "{witness}"
    );
}

fn proved(outcome: &Outcome) {
    assert!(matches!(outcome, Outcome::Proved(_)), "{outcome:?}");
}

const FACE: &str =
    "G0 X-20 Y0 Z5\nG0 Z-1\nG0 X-12\nG1 X105 F500\nG0 X115\nG0 Z5\nG0 X-20 Y6\nG0 Z-1\nG0 X-12\nG1 X105\nM30\n";

#[test]
fn a_rapid_at_cutting_depth_is_refuted() {
    let run = "G0 X115\nG0 Z5\nG0 X-20 Y6\nG0 Z-1\nG0 X-12\n";
    lower(&prove(FACE, &FACE.replace(run, "G0 X-12 Y6\n")));
    lower(&prove(FACE, &FACE.replace(run, "G0 Z4.999\nG0 X-12 Y6\nG0 Z-1\n")));
    // a slanted way down beside the old one
    lower(&prove(
        FACE,
        &FACE.replace(run, "G0 X115\nG0 Z5\nG0 X-20 Y6\nG0 X-12 Z-1\n"),
    ));
    proved(&prove(FACE, &FACE.replace(run, "G0 Z5\nG0 X-12 Y6\nG0 Z-1\n")));
    proved(&prove(
        FACE,
        &FACE.replace(run, "G0 X115\nG0 Z5\nG0 X-20 Y6\nG0 Z7\nG0 X-12\nG0 Z-1\n"),
    ));
}

#[test]
fn the_level_after_a_hole_is_that_of_the_rapids() {
    let hole = "G0 X10 Y10 Z50\nG0 Z2\nG1 Z-5 F100\nG0 Z2\nG0 X20\nG0 Z50\nG0 X100\nG0 Y50 Z3\nG1 Z-1\nM30\n";
    let run = "G0 X20\nG0 Z50\nG0 X100\nG0 Y50 Z3\n";
    lower(&prove(hole, &hole.replace(run, "G0 Z3\nG0 X100 Y50\n")));
    proved(&prove(hole, &hole.replace(run, "G0 Z50\nG0 X100 Y50\nG0 Z3\n")));
}

#[test]
fn the_level_is_that_of_all_rapids_since_the_last_cut() {
    let coolant = "G0 X0 Y0 Z50\nG1 Z-1 F500\nG0 Z50\nG0 X50\nM8\nG0 Z3\nG0 X60\nG0 Y50\nG0 X90\nG1 Z-2\nM30\n";
    let run = "G0 X60\nG0 Y50\nG0 X90\n";
    lower(&prove(coolant, &coolant.replace(run, "G0 X90 Y50\n")));
    // a cut begins anew
    let cut = coolant.replace("G0 X60\n", "G1 X51\nG0 X60\n");
    proved(&prove(&cut, &cut.replace(run, "G0 X90 Y50\n")));
}

#[test]
fn the_level_is_measured_along_the_tool() {
    let tilted = "G0 X-20 Y0 Z100 A90 C0\nG1 X20 F500\nG0 X21\nG0 Z200\nG0 Y100\nG0 X100\nG0 Y0\nG0 Z101\nG0 X99 Z100\nG1 X120\nM30\n";
    let run = "G0 Z200\nG0 Y100\nG0 X100\nG0 Y0\nG0 Z101\n";
    let prove = |after: &str| prove_on("mikron-ucp710", None, tilted, &tilted.replace(run, after));
    lower(&prove("G0 Z101\nG0 X100\n"));
    proved(&prove("G0 Z200\nG0 X100\nG0 Z101\n"));
}

/// On its old way, and straight above its ends, the tool is in the part as it was before; nowhere else.
#[test]
fn a_new_way_keeps_clear_of_the_part() {
    let part = || Some(block(ObstacleKind::Part, [[0.0, 100.0], [-50.0, 50.0], [-40.0, 0.0]]));
    let round = "G0 X-10 Y0 Z-5\nG1 X3 F500\nG0 X-10\nG0 Y-90\nG0 X110\nG0 Y0\nG1 X105\nM30\n";
    let run = "G0 X-10\nG0 Y-90\nG0 X110\nG0 Y0\n";
    let prove = |after: &str| prove_on("mill-3axis", part(), round, &round.replace(run, after));
    let Outcome::Refuted(witness) = prove("G0 X110\n") else {
        panic!("through the part")
    };
    assert!(witness.message.contains("goes through box"), "{witness}");
    proved(&prove("G0 Z1\nG0 X110\nG0 Z-5\n"));
    proved(&prove("G0 X-10\nG0 Y-60\nG0 X110\nG0 Y0\n"));
}
