//! What a new tool length moves, and what G28 and G53 leave of it.
use crate::support::{Log, faults, line, lines, run_bytes};
use crate::tools::tool;
use trunnion_dialect::Dialect;
use trunnion_interp::{Position, Setup, WorkOffset, run};
use trunnion_syntax::parse;

const MOVES: &str = "length-change = \"moves\"\n";
pub(crate) const SHIFTS: &str = "length-change = \"shifts\"\n";

/// Tools 1 and 2 of 100 and 150 mm, and Z0 at the reference point.
fn setup() -> Setup {
    let mut home = Position::default();
    home.set(2, 0.0);
    let mut setup = Setup {
        tools: vec![tool(1, None, Some(10.0), Some(100.0)), tool(2, None, None, Some(150.0))],
        work_offsets: vec![WorkOffset {
            name: "G54".into(),
            values: [0.0, 0.0, -500.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        }],
        ..Setup::default()
    };
    setup.control.reference_points = vec![home, home];
    setup
}

/// The run of a program in an own table with these quirks.
pub(crate) fn run_with(extends: &str, quirks: &str, source: &str, setup: &Setup) -> Log {
    let table = format!("name = \"mine\"\nextends = \"{extends}\"\n[quirks]\n{quirks}");
    let dialect = Dialect::from_table(&table, "mine.toml").expect("a table");
    let program = parse(source.as_bytes().to_vec(), dialect.lex);
    let mut log = Log::default();
    run(&program, &dialect, setup, &mut log);
    log
}

/// Motions behind `G43 H1 Z50.`, and how many faults there are.
fn after(quirks: &str, rest: &str) -> (Vec<String>, usize) {
    let source = format!("G90 G54 G0 X0 Y0\nG43 H1 Z50.\n{rest}M30\n");
    let log = run_with("fanuc-30i", quirks, &source, &setup());
    (log.motions[2..].iter().map(line).collect(), log.faults.len())
}

fn words(lines: &[&str]) -> Vec<String> {
    lines.iter().map(|line| (*line).to_owned()).collect()
}

#[test]
fn a_length_alone_moves_the_axis_or_the_coordinates() {
    let source = "G49\nX5.\n";
    assert_eq!(after(SHIFTS, source), (words(&["R X5 Y0 Z150"]), 0));
    assert_eq!(after(MOVES, source), (words(&["R X0 Y0 Z50", "R X5 Y0 Z50"]), 0));
    assert_eq!(after("", source), (words(&["R X5 Y0"]), 2));
    // H2 alone changes the length in effect too
    assert_eq!(after(SHIFTS, "H2\nX5.\n"), (words(&["R X5 Y0 Z0"]), 0));
    assert_eq!(after(MOVES, "H2\nX5.\n"), (words(&["R X0 Y0 Z50", "R X5 Y0 Z50"]), 0));
    assert_eq!(after("", "H2\nX5.\n"), (words(&["R X5 Y0"]), 1));
}

/// With the length of before, the axis is where it was, whatever the control does: unless it moved, or the zero point is another one.
#[test]
fn the_same_length_again_leaves_nothing_open() {
    assert_eq!(after("", "H2\nG43 H1\nX5.\n"), (words(&["R X5 Y0 Z50"]), 0));
    assert_eq!(after("", "G49\nG43 H1\nX5.\n"), (words(&["R X5 Y0 Z50"]), 1));
    assert_eq!(after("", "H2\nG49\nG43 H1\nX5.\n"), (words(&["R X5 Y0 Z50"]), 1));
    let moved_along_x = (words(&["R X1 Y0", "R X5 Y0 Z50"]), 2);
    assert_eq!(after("", "G49\nX1.\nG43 H1\nX5.\n"), moved_along_x);
    assert_eq!(
        after("", "G49\nG91 Z5.\nG90 G43 H1\nX5.\n"),
        (words(&["R X0 Y0", "R X5 Y0"]), 3)
    );
    let (lines, faults) = after("", "G49\nG55\nG43 H1\nX5.\n");
    assert!(faults > 0 && !lines[0].contains('Z'), "{lines:?}");
}

#[test]
fn the_axis_travels_from_where_it_stands() {
    let source = "G54 G0 X0 Y0\nG43 H1 Z50.\nG1 F100. G49\nM30\n";
    let log = run_with("fanuc-30i", MOVES, source, &setup());
    let motion = log.motions[2];
    assert_eq!((motion.start.get(2), motion.end.get(2)), (Some(150.0), Some(50.0)));
    assert_eq!(line(&motion), "L X0 Y0 Z50 F100");
}

#[test]
fn an_increment_travels_the_change_or_not() {
    // G49: 100 mm down and 5 mm up, or 5 mm up alone
    assert_eq!(after(MOVES, "G91 G49 Z5.\n"), (words(&["R X0 Y0 Z55"]), 0));
    assert_eq!(after(SHIFTS, "G91 G49 Z5.\n"), (words(&["R X0 Y0 Z155"]), 0));
    assert_eq!(after("", "G91 G49 Z5.\n"), (words(&["R X0 Y0"]), 1));
    assert_eq!(after("", "G91 G43 H2 Z-32.\n"), (words(&["R X0 Y0"]), 1));
    assert_eq!(after("", "G91 G43 H2 Z-32.\nG90 Z10.\nX1.\n").1, 1);
    // without a word of the axis in the block of another one
    assert_eq!(after(MOVES, "G43 H2 X9.\n"), (words(&["R X9 Y0 Z50"]), 0));
    assert_eq!(after("", "G43 H2 X9.\n"), (words(&["R X9 Y0"]), 1));
    let setup = setup();
    for dialect in ["iso-6983", "haas-ngc"] {
        let source = b"G54 G0 X0. Y0.\nG43 H1 Z50.\nG91 G49 Z5.\nM30\n";
        let (_, log) = run_bytes(dialect, source, &setup);
        assert_eq!(log.faults.len(), 1, "{dialect}: {:?}", log.faults);
    }
}

#[test]
fn what_moves_nothing_or_leads_to_a_place_is_clean() {
    for rest in [
        "G40 G80\nG49 Z60.\nX1.\n",
        "G49 G53 Z0.\nX1.\n",
        "G49 G28 G91 Z0.\nX1.\n",
        "G28 G91 Z0. G49\nX1.\n",
        "G28 G91 Z0.\nG49\nX1.\n",
        "G53 Z0.\nG49\nG91 X1.\n",
        "G43 H1\nX1.\n",
        "G43 H2 Z60.\nX1.\n",
    ] {
        let (found, faults) = after("", rest);
        assert_eq!(faults, 0, "{rest}: {found:?}");
        assert!(found.last().is_some_and(|last| last.contains('Z')), "{rest}: {found:?}");
    }
    let (_, log) = run_bytes(
        "fanuc-30i",
        b"G40 G49 G80\nG0 X1. Y1. Z9.\nG40 G49 G80\nX2.\nM30\n",
        &setup(),
    );
    assert_eq!(log.faults, []);
    assert_eq!(line(&log.motions[1]), "R X2 Y1 Z9");
}

/// With TOS = 0 the axis goes down by the length in the block of G49, whatever follows.
#[test]
fn a_length_that_ends_without_its_axis_is_unknown() {
    for rest in [
        "G49\nZ160.\n",
        "G49\nG53 Z0.\n",
        "G49\nG28 G91 Z0.\n",
        "G43 H2 Z50.\nH1\nZ60.\n",
    ] {
        let (found, faults) = after("", rest);
        assert_eq!(faults, 1, "{rest}: {found:?}");
        assert_eq!(after(SHIFTS, rest).1, 0, "{rest}");
        assert_eq!(after(MOVES, rest).1, 0, "{rest}");
    }
    let (_, log) = run_bytes("fanuc-30i", b"G54 G0 X0. Y0.\nG43 H7 Z50.\nG49\nZ160.\nM30\n", &setup());
    let end = log
        .faults
        .iter()
        .filter(|fault| format!("{fault:?}").contains("ends or gets shorter"));
    assert_eq!(end.count(), 1, "{:?}", log.faults);
    let (_, log) = run_bytes("fanuc-30i", b"G54 G0 X0. Y0. Z9.\nG43 H7\nZ160.\nM30\n", &setup());
    let end = log
        .faults
        .iter()
        .filter(|fault| format!("{fault:?}").contains("ends or gets shorter"));
    assert_eq!(end.count(), 0, "{:?}", log.faults);
}

/// G28 Z, G30 Z and G53 Z of a Fanuc cancel the length and leave G43 in force: Z after them is unknown until G43 or H comes again.
#[test]
fn a_return_leaves_the_length_open() {
    for home in ["G28 G91 Z0.\nG90", "G30 G91 Z0.\nG90", "G53 Z0."] {
        let (found, faults) = after("", &format!("{home}\nX5.\nZ10.\n"));
        let last = found.last().expect("motions");
        assert_eq!((last.as_str(), faults), ("R X5 Y0", 1), "{home}: {found:?}");
        let (found, faults) = after("", &format!("{home}\nX5.\nG43 H1 Z10.\n"));
        assert_eq!(
            (found.last().map(String::as_str), faults),
            (Some("R X5 Y0 Z10"), 0),
            "{home}"
        );
        let (found, faults) = after("length-after-return = \"cancelled\"\n", &format!("{home}\nX5.\nZ10.\n"));
        assert_eq!(
            (found.last().map(String::as_str), faults),
            (Some("R X5 Y0 Z10"), 0),
            "{home}"
        );
        let kept = after("length-after-return = \"kept\"\n", &format!("{home}\nX5.\n"));
        assert_eq!(
            (kept.0.last().map(String::as_str), kept.1),
            (Some("R X5 Y0 Z400"), 0),
            "{home}"
        );
    }
    // other axes leave it as it is
    let (found, faults) = after("", "G53 X0.\nZ10.\n");
    assert_eq!((found.last().map(String::as_str), faults), (Some("R X0 Y0 Z10"), 0));
    // a cycle in force has its depth from before
    let cycle = after("", "G81 X1. Z-5. R2. F100.\nG28 G91 Z0.\nG90 X5.\n");
    assert!(cycle.1 > 0, "{cycle:?}");
    // the coordinates and the length that a macro reads
    for read in ["#5003", "#5083"] {
        let (found, faults) = after("", &format!("G53 Z0.\nG1 F[{read}+700.] X5.\n"));
        assert!(
            found.last().is_some_and(|last| last.contains("F?")) || faults > 0,
            "{read}: {found:?}"
        );
    }
}

#[test]
fn g53_of_a_fanuc_is_a_rapid() {
    let source = "G0 X1. Y1. Z1.\nG1 F100.\nG53 Z0.\nX2.\n";
    assert_eq!(
        lines("fanuc-30i", source),
        ["R X1 Y1 Z1", "R X1 Y1 Z0 machine", "L X2 Y1 Z0 F100"]
    );
    assert_eq!(lines("haas-ngc", source)[1], "L X1 Y1 Z0 F100 machine");
    // U is a distance: the code needs coordinates
    let lathe = "G18 G0 X40. Z2.\nG53 U-5.\n";
    assert_eq!(lines("fanuc-30i-lathe-a", lathe), ["R X20 Z2", "U Z2 machine"]);
    assert!(faults("fanuc-30i-lathe-a", lathe)[0].contains("G53 with distances"));
}

/// G92 ends G52 of the axes that it names.
#[test]
fn g92_ends_g52() {
    for dialect in ["fanuc-30i", "haas-ngc"] {
        let source = "G0 X10. Y0. Z0.\nG52 X5. Y3.\nG92 X0.\nG52 X0 Y0\nG0 X10.\n";
        // 10 mm from G54 is 0 in G92; G52 X0 has nothing to end in X
        let found = run_bytes(dialect, source.as_bytes(), &setup()).1;
        let last = found.motions.last().expect("motions");
        let machine = last.end.get(0).expect("known") + last.zero[0];
        assert!((machine - 20.0).abs() < 1e-9, "{dialect}: {machine}");
    }
}
