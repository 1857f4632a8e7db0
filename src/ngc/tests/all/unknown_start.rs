//! A check knows neither the position nor what parameters hold: such numbers are unknown until the program says them.
use std::sync::Arc;
use trunnion_ngc::{At, Canon, Engine, Error, Pose, Setup, Sink, Source, Start, State};

#[derive(Default)]
struct Motions(Vec<Pose>, Vec<String>);

impl Sink for Motions {
    fn call(&mut self, call: &Canon, _: At, _: &State) {
        if let Canon::Traverse(pose) | Canon::Feed(pose) = call {
            self.0.push(*pose);
        }
    }
    fn error(&mut self, error: &Error, _: At) {
        self.1.push(error.message().to_owned());
    }
}

fn run(program: &str) -> Motions {
    let source = Source::new(String::new(), Arc::from(program.as_bytes()));
    let setup = Setup {
        start: Start::Unknown,
        ..Setup::default()
    };
    let mut motions = Motions::default();
    Engine::new(Arc::new(source), &setup).run(true, &mut motions);
    motions
}

/// Which of X Y Z are known.
fn known(pose: &Pose) -> [bool; 3] {
    [0, 1, 2].map(|axis| !pose[axis].is_nan())
}

#[test]
fn axes_are_known_from_their_first_word() {
    let motions = run("g0 x1\ng0 z2\ng91 y1\ng90 y5\nm2\n");
    assert_eq!(motions.1, [""; 0]);
    let known: Vec<_> = motions.0.iter().map(known).collect();
    assert_eq!(
        known,
        [
            [true, false, false],
            [true, false, true],
            [true, false, true],
            [true, true, true]
        ]
    );
    assert_eq!(motions.0[3][..3], [1.0, 5.0, 2.0]);
}

#[test]
fn stored_points_are_unknown_and_raise_no_errors() {
    let motions = run("g0 x1 y2 z3\ng28 z4\nf100\ng2 x3 y2 i1\ng2 x9 y9 i1 j1 z1\nm2\n");
    // G28 passes through Z4, then Z is wherever the stored point is
    assert_eq!(motions.0[1][2], 4.0);
    assert_eq!(known(&motions.0[2]), [true, true, false]);
    // the second arc's radii differ: that is known
    assert_eq!(motions.1.len(), 1);
    assert!(
        motions.1[0].starts_with("Radius to end of arc differs"),
        "{:?}",
        motions.1
    );
}

#[test]
fn an_arc_from_an_unknown_point_is_no_error() {
    let motions = run("f100 g2 x3 y2 i1\ng2 x5 y2 r1\ng1 x1\nm2\n");
    assert_eq!(motions.1, [""; 0]);
    assert_eq!(motions.0.len(), 1);
}

#[test]
fn rotation_of_the_table_does_not_spoil_other_axes() {
    let motions = run("g0 x1 y2 z3 a10\ng53 g0 z0\ng0 x5\nm2\n");
    assert_eq!(known(&motions.0[1]), [true, true, false]);
    assert_eq!(known(&motions.0[2]), [true, true, false]);
}

/// Where a probe touched is unknown, also as a parameter; whether it did is known after G38.2, which stops the program where it did not.
#[test]
fn a_probed_point_is_unknown_and_that_there_is_one_may_be_known() {
    let before = "f100\ng0 x0 y0 z0\n";
    let motions = run(&format!(
        "{before}g38.2 z-10\n#1=#5063\n#2=#5061\ng0 x[#2+1] z[#1+5]\nm2\n"
    ));
    assert_eq!(motions.0.last().map(known), Some([true, true, false]));
    let motions = run(&format!(
        "{before}g38.2 z-10\no1 if [#5070 eq 1]\ng0 z5\no1 endif\nm2\n"
    ));
    assert_eq!(motions.0.last().map(|pose| pose[2]), Some(5.0));
    // the run stops where it would have to know more
    let motions = run(&format!(
        "{before}g38.3 z-10\no1 if [#5070 eq 1]\ng0 z5\no1 endif\nm2\n"
    ));
    assert_eq!(motions.0.len(), 1);
}

/// Which tool is in the spindle, whether that turns and which coordinate system acts is not known before the program says so.
#[test]
fn what_the_program_has_not_set_is_unknown() {
    for (name, set) in [
        ("_current_tool", "t1 m6"),
        ("_selected_tool", "t1"),
        ("_tool_offset", "g49"),
        ("_spindle_on", "m5"),
        ("_rpm", "s100"),
        ("_flood", "m9"),
        ("_coord_system", "g54"),
    ] {
        let program = |before: &str| format!("{before}\no1 if [#<{name}> ne 5]\ng53 g0 x1\no1 endif\nm2\n");
        assert_eq!(run(&program("")).0.len(), 0, "{name}");
        assert_eq!(run(&program(set)).0.len(), 1, "{name}");
    }
    assert_eq!(run("o1 if [#5400 ne 5]\ng53 g0 x1\no1 endif\nm2\n").0.len(), 0);
    assert_eq!(run("t1 m6\no1 if [#5400 ne 5]\ng53 g0 x1\no1 endif\nm2\n").0.len(), 1);
}

/// What was reported before does not stand for a value that comes from elsewhere: a comment may allow the one and not the other.
#[test]
fn each_word_says_what_its_value_was_computed_from() {
    let said = run("g0 z#5422\n#1=#5420\ng0 x[#1+1]\ng0 x#1\nm2\n").1;
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(said[0].starts_with("#5422, the position of the machine"), "{said:?}");
    assert!(
        said[1].starts_with("#1, which was computed from unknown values"),
        "{said:?}"
    );
}

#[test]
fn what_is_in_effect_keeps_its_length_when_the_unit_changes() {
    // LinuxCNC, convert_length_units: tool offsets and F are read again from the machine, in the new units
    let z = |change: &str| {
        let motions = run(&format!(
            "g21 f100\ng10 l2 p1 x0 y0 z0\ng0 x0 y0 z5\n{change}\ng0 x1\nm2\n"
        ));
        assert_eq!(motions.1, [""; 0], "{change}");
        motions.0.last().expect("a motion")[2]
    };
    for (change, expected) in [
        ("g20\ng43.1 z1\ng21\ng49", 5.0),
        ("g43.1 z25.4\ng20\ng49\ng21", 5.0),
        ("g43.1 z25.4\ng20\ng43.1 z2\ng21", 5.0 - 50.8),
        ("g43.1 z25.4\ng20\ng43.1 x2\ng21", 5.0 - 25.4),
        ("g10 l1 p1 z10\ng20\ng43.1 z1\ng43.2 h1\ng21\ng49", 5.0),
        ("g92 z30.4\ng20\ng92.1\ng21", 5.0),
        ("g52 z25.4\ng20\ng52 z0\ng21", 5.0),
        ("g20\ng10 l2 p1 z1\ng21\ng10 l2 p1 z0\ng54", 5.0),
        ("g20\ng10 l20 p1 z1\ng21\ng10 l2 p1 z0\ng54", 5.0),
        ("g20\ng43.1 z1\ng28.1\ng21\ng49\ng0 z50\ng28", 5.0),
    ] {
        let got = z(change);
        assert!((got - expected).abs() < 1e-9, "{change}: {got}");
    }
}

#[test]
fn f_is_the_same_feed_in_other_units() {
    let read = |start: &str| run(&format!("{start}\ng0 x#<_feed>\nm2\n")).0[0][0];
    assert!((read("g21\ng94 f254\ng20") - 10.0).abs() < 1e-9);
    assert!((read("g20\ng94 f10\ng21") - 254.0).abs() < 1e-9);
    assert!((read("g21\ng95 f2\ng20") - 2.0).abs() < 1e-9);
}
