//! New paths of rapids stay at the level of the old ones, and clear of the part.
use crate::{Attempt, Options, attempt, rewrite};
use trunnion_check::{Assume, Settings};
use trunnion_geometry::plane::{Point, Polygon};
use trunnion_interp::{Setup, Tool};
use trunnion_machine::{Footprint, Machine, Obstacle, ObstacleKind, builtin};
use trunnion_syntax::parse;

const HEAD: &str = "O1\nG21 G90 G94 G17 G54 G40 G49 G80\nT1 M6\nS1000 M3\n";

/// A box between two corners.
fn block(name: &str, kind: ObstacleKind, [x, y, z]: [[f64; 2]; 3]) -> Obstacle {
    let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(Point::from);
    Obstacle {
        name: name.to_owned(),
        axis: None,
        footprint: Footprint::Polygon(Polygon::new(&corners).expect("a rectangle")),
        bottom: z[0],
        top: z[1],
        kind,
    }
}

fn machine(name: &str, obstacles: Vec<Obstacle>) -> Machine {
    let mut machine = builtin(name).expect("built in").clone();
    machine.obstacles.0 = obstacles;
    machine
}

fn clamp() -> Obstacle {
    block(
        "clamp",
        ObstacleKind::Body,
        [[200.0, 220.0], [200.0, 220.0], [-50.0, 30.0]],
    )
}

fn reroute(blocks: &str, machine: &Machine) -> (String, Attempt) {
    let setup = Setup {
        tools: vec![Tool {
            number: 1,
            shape: None,
            diameter_mm: Some(8.0),
            length_mm: Some(50.0),
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
    let mut settings = Settings::new(dialect, Some(machine), setup);
    settings.assume = Assume::ALL;
    let text = format!("{HEAD}{blocks}");
    let program = parse(text.clone().into_bytes(), dialect.lex);
    let rewrite = rewrite("reroute-rapid").expect("a rewrite");
    let attempt = attempt(rewrite, &program, &settings, &Options::default());
    (text, attempt)
}

/// The program after.
fn after(blocks: &str, machine: &Machine) -> String {
    let (text, attempt) = reroute(blocks, machine);
    match attempt.outcome() {
        Ok(Some(proved)) => String::from_utf8(proved.after).expect("text"),
        Ok(None) => text,
        Err(why) => panic!("{why}"),
    }
}

fn stays(blocks: &str, machine: &Machine) {
    assert_eq!(after(blocks, machine), format!("{HEAD}{blocks}"));
}

#[test]
fn the_lift_between_two_passes_of_a_face_mill_stays() {
    let passes = "G0 X-20. Y0.\nG43 H1 Z5.\nG0 Z-1.\nG0 X-12.\nG1 X105. F500.\nG0 X115.\nG0 Z5.\nG0 X-20. Y6.\nG0 Z-1.\nG0 X-12.\nG1 X105. F500.\nG0 Z50.\nM30\n";
    stays(passes, &machine("mill-3axis", vec![clamp()]));
}

#[test]
fn a_detour_between_two_slots_is_shortened_above_them() {
    let slots = "G0 X0. Y0.\nG43 H1 Z50.\nG0 Z2.\nG1 Z-10. F100.\nG1 X20. F500.\nG0 X19. Y1.\nG0 Z50.\nG0 Y100.\nG0 X100.\nG0 Y0.\nG0 Z2.\nG0 X99. Z-9.\nG1 Z-10. F100.\nG0 Z50.\nM30\n";
    let short = slots.replace("G0 Y100.\nG0 X100.\nG0 Y0.\n", "G0 Y0. X100.\n");
    assert_eq!(
        after(slots, &machine("mill-3axis", vec![clamp()])),
        format!("{HEAD}{short}")
    );
}

#[test]
fn the_lift_after_a_hole_stays() {
    let hole = "G0 X-20. Y0.\nG43 H1 Z50.\nG99 G81 X10. Y10. Z-5. R2. F100.\nG80\nG0 X20.\nG0 Z50.\nG0 X100.\nG0 Y50. Z3.\nG1 Z-1. F100.\nG0 Z50.\nM30\n";
    stays(hole, &machine("mill-3axis", vec![clamp()]));
}

#[test]
fn the_level_is_measured_along_a_tilted_tool() {
    let tilted = "G0 A90. C0.\nG0 X0. Y0.\nG43 H1 Z150.\nG0 Z100.\nG0 X-20.\nG1 X20. F500.\nG0 X21.\nG0 Z200.\nG0 Y100.\nG0 X100.\nG0 Y0.\nG0 Z101.\nG0 X99. Z100.\nG1 X120. F500.\nM30\n";
    let short = tilted.replace("G0 Y100.\nG0 X100.\nG0 Y0.\n", "G0 Y0. X100.\n");
    assert_eq!(
        after(tilted, &machine("mikron-ucp710", vec![clamp()])),
        format!("{HEAD}{short}")
    );
}

/// Where the beginning of the old way is not clear, the tool rises along its axis and goes at the level.
#[test]
fn past_an_obstacle_below_the_level_the_tool_goes_at_the_level() {
    let wall = block(
        "wall",
        ObstacleKind::Body,
        [[40.0, 60.0], [-300.0, 300.0], [-20.0, 35.0]],
    );
    let low = "G0 X0. Y0.\nG43 H1 Z50.\nG1 Z0. F100.\nG0 X90.\nG0 Z40.\nG0 Y10.\nG0 Z0.\nG1 Z-1.\nM30\n";
    let text = after(low, &machine("mill-3axis", vec![wall]));
    assert!(
        text.contains("G1 Z0. F100.\nG0 Z40.\nG0 X90. Y10.\nG0 Z0.\nG1")
            || text.contains("G1 Z0. F100.\nG0 Z40.\nG0 Y10. X90.\nG0 Z0.\nG1"),
        "{text}"
    );
}

#[test]
fn a_new_way_keeps_clear_of_the_declared_part() {
    let part = block("part", ObstacleKind::Part, [[0.0, 100.0], [-50.0, 50.0], [-40.0, 0.0]]);
    let round = "G0 X-20. Y0.\nG43 H1 Z50.\nG1 Z-5. F100.\nG1 X-10.\nG0 Y-90.\nG0 X110.\nG0 Y0.\nG1 X105. F500.\nG0 Z50.\nM30\n";
    let without = after(round, &machine("mill-3axis", vec![clamp()]));
    assert!(without.contains("G1 X-10.\nG0 Y0. X110.\nG1 X105."), "{without}");
    let with = after(round, &machine("mill-3axis", vec![clamp(), part]));
    assert!(
        with.contains("G1 X-10.\nG0 Z1.\nG0 X110.\nG0 Y0. X110. Z-5.\nG1")
            || with.contains("G1 X-10.\nG0 Z1.\nG0 X110.\nG0 Y0. Z-5.\nG1"),
        "{with}"
    );
}

#[test]
fn a_run_that_block_delete_changes_is_refused_with_the_reason() {
    let wall = block(
        "wall",
        ObstacleKind::Body,
        [[40.0, 60.0], [-100.0, 100.0], [-20.0, 35.0]],
    );
    let slash = "G0 X0. Y0.\nG43 H1 Z10.\nG1 X10. F500.\n/G0 Z200.\nG0 X90.\n/G0 Z10.\nG1 X95. F500.\nG0 Z200.\nM30\n";
    let (_, attempt) = reroute(slash, &machine("mill-3axis", vec![wall]));
    let why = attempt.outcome().expect_err("refused");
    assert!(why.contains("block_delete") && why.contains("skipped"), "{why}");
}
