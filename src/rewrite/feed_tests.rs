//! Feeds in rewrites: of a turn in the air, and without a decimal point where a setting decides.
use crate::{Attempt, Options, attempt, rewrite};
use trunnion_check::{Assume, Settings};
use trunnion_geometry::plane::{Point, Polygon};
use trunnion_interp::{Setup, Tool, ToolShape};
use trunnion_machine::{Footprint, Machine, Obstacle, ObstacleKind, builtin};
use trunnion_syntax::parse;

fn run(name: &str, dialect: &str, machine: &Machine, text: &str) -> Attempt {
    let setup = Setup {
        tools: vec![Tool {
            number: 1,
            shape: Some(ToolShape::Flat),
            diameter_mm: Some(6.0),
            length_mm: Some(50.0),
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let mut settings = Settings::new(dialect, Some(machine), setup);
    settings.assume = Assume::ALL;
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    let rewrite = rewrite(name).expect("a rewrite");
    attempt(rewrite, &program, &settings, &Options::default())
}

/// The program after.
fn after(name: &str, dialect: &str, machine: &Machine, text: &str) -> String {
    match run(name, dialect, machine, text).outcome() {
        Ok(Some(proved)) => String::from_utf8(proved.after).expect("text"),
        Ok(None) => text.to_owned(),
        Err(why) => panic!("{why}"),
    }
}

/// The tip stands still in a turn straight above where the tool left the part: what F means then depends on the control.
#[test]
fn the_tip_moves_while_the_machine_turns_at_feed() {
    let mut machine = builtin("mikron-ucp710").expect("built in").clone();
    let corners = [[-30.0, -30.0], [30.0, -30.0], [30.0, 30.0], [-30.0, 30.0]].map(Point::from);
    machine.obstacles.0.push(Obstacle {
        name: "part".to_owned(),
        axis: Some(b'C'),
        footprint: Footprint::Polygon(Polygon::new(&corners).expect("a square")),
        bottom: -60.0,
        top: 10.0,
        kind: ObstacleKind::Part,
    });
    let text = "G710 G90 G94 G17 G54\nT1 M6\nD1\nS8000 M3\nG0 A15 C8\nTRAORI\nG0 X0 Y0 Z60\nG1 Z5 F400\nG1 X3 Y0 Z5 A15.4 C7.7\nG1 X6.6 Y0 Z5 A15 C7\nG1 X11 Y0 Z5 A-15 C187\n\
                G1 X16 Y0 Z5 A-15.2 C187.5\nG0 Z60\nTRAFOOF\nM30\n";
    let made = after("insert-retract", "sinumerik-840d", &machine, text);
    assert_ne!(made, text);
    assert!(
        made.ends_with("G1 X11 Y0 Z5 A-15 C187\nG1 X16 Y0 Z5 A-15.2 C187.5\nG0 Z60\nTRAFOOF\nM30\n"),
        "{made}"
    );
}

/// A Haas reads F500 by a setting: the block stays, and what follows it is put together.
#[test]
fn a_feed_without_a_decimal_point_stays_in_its_block() {
    let machine = builtin("mill-3axis").expect("built in");
    let head = "O1\nG21 G90 G94 G17 G40 G49 G80 G54\nT1 M6\nS8000 M3\nG0 X0. Y0. Z60.\nG1 Z5. F400\n";
    let text = format!("{head}G1 X10. F500\nX15.\nX20.\nX30. Y5.\nM30\n");
    let short = format!("{head}G1 X10. F500\nX20.\nX30. Y5.\nM30\n");
    assert_eq!(after("drop-redundant", "haas-ngc", machine, &text), short);
    // on a control that reads it as it is written, and with a point, nothing holds it back
    let whole = short.replace("G1 X10. F500\nX20.\n", "G1 X20. F500.\n");
    let text = text.replace("F400", "F400.").replace("F500", "F500.");
    assert_eq!(
        after("drop-redundant", "haas-ngc", machine, &text),
        whole.replace("F400", "F400.")
    );
}

/// A feed that is restored has a point where the one in effect has one, whatever other blocks have.
#[test]
fn a_feed_that_is_written_again_keeps_its_decimal_point() {
    let mut machine = builtin("mill-3axis").expect("built in").clone();
    let slow = machine.joint(b'Z').expect("Z");
    machine.axes[slow].max_speed = Some(100.0);
    let text = "O1\nG21 G90 G94 G17 G40 G49 G80 G54\nT1 M6\nS8000 M3\nG0 X0. Y0. Z60.\nG1 X1. F400\nG1 X100. F12000.5\nZ160.\nX300.\nM30\n";
    let made = after("adapt-feed", "haas-ngc", &machine, text);
    assert!(
        made.contains("X100. F12000.5\nZ160. F6000.\nX300. F12000.5\n"),
        "{made}"
    );
}
