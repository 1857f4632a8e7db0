//! Texts of `trunnion.toml`, read whole and broken.
use super::super::offsets::is_work_offset;
use super::*;
use trunnion_interp::ToolShape;

const WHOLE: &str = r#"
machine = "mikron-ucp710"
dialect = "sinumerik-840d"
subprogram_path = ["subs", "/nc/shared"]
port_to = ["linuxcnc"]
[limits]
blocks = 5000
depth = 8
[rules]
pole-flip = "error"
feed-drop = "allow"
[tolerances]
tip = 0.02
[[tool]]
number = 1
shape = "ball"
diameter = 10
length = 80.5
[work_offsets]
G54 = { X = 1, Y = 0, Z = -2.5 }
"#;

#[test]
fn a_whole_file_is_read() {
    let config = parse(WHOLE).unwrap();
    assert_eq!(config.machine.as_deref(), Some("mikron-ucp710"));
    let folders: Vec<&str> = config.subprogram_path.iter().map(|(path, _)| path.as_str()).collect();
    assert_eq!(folders, ["subs", "/nc/shared"]);
    assert_eq!(config.port_to, ["linuxcnc"]);
    let limits = config.setup.limits;
    assert_eq!((limits.blocks, limits.depth), (5000, 8));
    assert_eq!(config.rules[0], ("feed-drop".to_owned(), RuleLevel::Allow));
    assert_eq!(
        config.rules[1],
        ("pole-flip".to_owned(), RuleLevel::At(Severity::Error))
    );
    assert_eq!(config.tolerances, [("tip".to_owned(), 0.02)]);
    assert_eq!(config.setup.tools[0].shape, Some(ToolShape::Ball));
    assert_eq!(config.setup.tools[0].length_mm, Some(80.5));
    assert_eq!(config.setup.work_offsets[0].values[..3], [1.0, 0.0, -2.5]);
}

#[test]
fn errors_point_at_their_place() {
    for (text, wrong) in [
        ("machin = \"x\"", "machin"),
        ("[rules]\npole-flop = \"error\"", "pole-flop"),
        ("[rules]\npole-flip = \"loud\"", "\"loud\""),
        ("[tolerances]\ntipp = 1", "tipp"),
        ("[tolerances]\ntip = -1", "-1"),
        ("[tolerances]\nlinear_ratio = 0.5", "0.5"),
        ("[tolerances]\nfeed_drop_error = 30", "30"),
        ("dialect = \"klingon\"", "\"klingon\""),
        ("dialect = \"linuxcnc\"\ndialect_table = \"shop.toml\"", "\"shop.toml\""),
        ("port_to = [\"linuxcnc\", \"klingon\"]", "\"klingon\""),
        ("[[obstacle]]\npoligon = [[0, 0]]", "poligon"),
        (
            "[[obstacle]]\npolygon = [[0, 0], [1, 0], [2, 0]]\nz = [0, 1]",
            "[[0, 0], [1, 0], [2, 0]]",
        ),
        (
            "[[obstacle]]\npolygon = [[0, 0], [1, 0], [1, 1]]",
            "[[0, 0], [1, 0], [1, 1]]",
        ),
        ("[[obstacle]]\npolygon = [[0, 0], [1, 0], [1, 1]]\nz = [2, 1]", "[2, 1]"),
        ("[[obstacle]]\nbox = [[0, 0, 0], [1, -1, 1]]", "[[0, 0, 0], [1, -1, 1]]"),
        (
            "[[obstacle]]\ncylinder = { centre = [0, 0], radius = 0, z = [0, 1] }",
            "0",
        ),
        ("[[obstacle]]\nbox = [[0, 0, 0], [1, 1, 1]]\naxis = \"Q\"", "\"Q\""),
        ("[tolerances]\nclearanc = 1", "clearanc"),
        ("[[tool]]\nnumber = 1\nholder = { diametr = 5 }", "{ diametr = 5 }"),
        ("subprogram_path = [\"a\", \"\"]", "\"\""),
        ("[limits]\nblocks = 0", "0"),
        ("[limits]\ndepth = 10001", "10001"),
        ("[limits]\ndeep = 3", "deep"),
        ("[work_offsets]\nG54 = { Q = 1 }", "Q"),
        ("[work_offsets]\nG54 = { X = nan }", "nan"),
        ("[work_offsets]\nG643 = { X = 1 }", "G643"),
        ("[work_offsets]\n\"G54.1\" = { X = 1 }", "\"G54.1\""),
        ("[[tool]]\nnumber = 1\ndiametre = 3", "diametre"),
        ("[[tool]]\nnumber = 1\nlength = -3", "-3"),
        ("[[tool]]\nnumber = 1\nshape = \"cone\"", "\"cone\""),
        ("[[tool]]\nnumber = 1\nshape = \"ball\"\ndiameter = 0", "0"),
        (
            "[[tool]]\nnumber = 1\nshape = \"bull\"\ndiameter = 8\ncorner_radius = 5",
            "5",
        ),
        ("[[tool]]\nnumber = 1\n[[tool]]\nlength = 2\nnumber = 1", "1"),
    ] {
        let error = parse(text).unwrap_err();
        let span = error
            .span
            .clone()
            .unwrap_or_else(|| panic!("{text}: {error} has no place"));
        assert_eq!(&text[span], wrong, "{text}: {error}");
    }
    assert!(parse("= 1").unwrap_err().span.is_some());
}

#[test]
fn errors_in_a_tool_are_not_told_at_the_start_of_the_file() {
    for text in [
        "[[tool]]\nlength = 1",
        "x = 1\n[[tool]]\nnumber = -1",
        "[[tool]]\nnumber = \"a\"",
    ] {
        assert!(parse(text).unwrap_err().span.is_some_and(|span| span.end > 0), "{text}");
    }
}

#[test]
fn work_offsets_of_all_dialects_are_known() {
    for name in [
        "G54",
        "g59",
        "G59.3",
        "G54.1 P12",
        "G500",
        "G505",
        "G599",
        "G110",
        "G154 P3",
        "preset 0",
        "preset 12",
        "G15 H3",
    ] {
        assert!(is_work_offset(name), "{name}");
    }
    for name in [
        "G53",
        "G501",
        "G60",
        "G130",
        "G643",
        "G600",
        "G59.4",
        "G54.1 P",
        "G54.1 P0",
        "54",
        "G054",
        "X",
        "preset",
        "preset 01",
        "preset x",
        "G15",
        "G15 H0",
    ] {
        assert!(!is_work_offset(name), "{name}");
    }
}

#[test]
fn an_axis_that_the_machine_lacks_has_its_place() {
    let text = "[work_offsets]\nG54 = { X = 1, A = 2 }";
    let config = parse(text).unwrap();
    let machine = |name| trunnion_machine::builtin(name).unwrap();
    assert_eq!(config.check_axes(machine("mikron-ucp710")), Ok(()));
    let error = config.check_axes(machine("mill-3axis")).unwrap_err();
    assert_eq!(&text[error.span.unwrap()], "A");
}

#[test]
fn a_work_offset_gives_all_linear_axes_of_the_machine() {
    let text = "[work_offsets]\nG55 = { X = 1, Y = 2, Z = 3 }\nG54 = { X = 1, Y = 2 }";
    let config = parse(text).unwrap();
    let machine = |name| trunnion_machine::builtin(name).unwrap();
    let error = config.check_offsets(machine("mill-3axis")).unwrap_err();
    assert_eq!(&text[error.span.unwrap()], "G54");
    assert!(error.message.starts_with("G54 lacks Z"), "{}", error.message);
    // a lathe has no Y; rotary axes may be left out
    let lathe = parse("[work_offsets]\nG54 = { X = 0, Z = 0 }").unwrap();
    assert_eq!(lathe.check_offsets(machine("lathe-2axis")), Ok(()));
    let whole = parse("[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }").unwrap();
    assert_eq!(whole.check_offsets(machine("mikron-ucp710")), Ok(()));
}

#[test]
fn offsets_of_a_lathes_tools() {
    let config = parse("[tool_offsets]\n12 = { X = -5, Z = 1 }\n2 = { X = -120.5, Y = 1, Z = -60 }\n").unwrap();
    let offsets = &config.setup.tool_offsets;
    assert_eq!(offsets.0.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [2, 12]);
    assert_eq!(
        offsets.get(2).map(|values| [values[0], values[1], values[2]]),
        Some([-120.5, 1.0, -60.0])
    );
    assert_eq!(offsets.get(3), None);
    for (entry, wrong) in [
        ("T2 = { X = 0, Z = 0 }", "T2"),
        ("0 = { X = 0, Z = 0 }", "0"),
        ("2 = { X = 0 }", "2"),
        ("2 = { X = 0, Z = 0, C = 0 }", "C"),
        ("2 = { X = 0, Z = inf }", "inf"),
        ("2 = { X = 0, Z = 0 }\n02 = { X = 0, Z = 0 }", "2"),
    ] {
        let text = format!("[tool_offsets]\n{entry}\n");
        let error = parse(&text).expect_err(entry);
        assert_eq!(&text[error.span.clone().expect("a place")], wrong, "{error}");
    }
}
