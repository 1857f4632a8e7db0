//! What is left open while a zero point or a tool length is not declared. Travel of mill-3axis: X 0 to 750 mm or as its file says; the tests
//! read it from the machine.
use crate::fixture::Fixture;
use crate::{Diagnostic, Report, Status, ValueKey};
use trunnion_machine::Limits;

fn check(info: &str, text: &str) -> Report {
    Fixture::parse(&format!("{info} undeclared"), text).check().unwrap()
}

fn travel(axis: usize) -> [f64; 2] {
    match trunnion_machine::builtin("mill-3axis").unwrap().axes[axis].limits {
        Limits::Range(low, high) => [low, high],
        Limits::Unbounded => panic!("an axis without travel limits"),
    }
}

fn of<'r>(report: &'r Report, rule: &str) -> Vec<&'r Diagnostic> {
    report.diagnostics.iter().filter(|found| found.rule == rule).collect()
}

fn number(found: &Diagnostic, key: &str) -> Option<f64> {
    found
        .values
        .iter()
        .find(|(known, _)| *known == key)
        .map(|(_, value)| match value {
            ValueKey::Number(value) => *value,
            ValueKey::Text(_) => panic!("{key} is text"),
        })
}

#[test]
fn the_zero_points_that_fit_are_reported_and_the_verdict_is_unknown() {
    let [low, high] = travel(0);
    let report = check(
        "gcode fanuc-30i mill-3axis",
        "G21 G90 G54\nG0 X-10. Y0. Z20.\nX40. Y5.\nG1 Z-3. F100.\nM30\n",
    );
    let found = of(&report, "axis-limit");
    assert_eq!(found.len(), 1, "{:?}", report.diagnostics);
    assert_eq!(found[0].status, Status::Unknown);
    assert_eq!(number(found[0], "fits_x_min_mm"), Some(low + 10.0));
    assert_eq!(number(found[0], "fits_x_max_mm"), Some(high - 40.0));
    assert_eq!(number(found[0], "fits_z_min_mm"), Some(travel(2)[0] + 3.0));
    assert_eq!(number(found[0], "fits_z_max_mm"), Some(travel(2)[1] - 20.0));
    assert_eq!(report.summary.unknown, 1);
}

#[test]
fn a_span_of_the_travel_fits_one_zero_and_a_longer_one_none() {
    let [low, high] = travel(0);
    let width = high - low;
    let text = |last: f64| format!("G21 G90 G55\nG0 X100. Y0. Z0.\nX{last:.4}\nX300.\nM30\n");
    let fits = check("gcode fanuc-30i mill-3axis", &text(100.0 + width));
    assert_eq!(number(of(&fits, "axis-limit")[0], "fits_x_min_mm"), Some(low - 100.0));
    let fails = check("gcode fanuc-30i mill-3axis", &text(100.01 + width));
    let found = of(&fails, "axis-limit");
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].status, Status::Fail);
    assert!(
        found[0].message.contains("no value of G55 fits"),
        "{}",
        found[0].message
    );
    assert!((number(found[0], "excess_mm").unwrap() - 0.01).abs() < 1e-9);
}

#[test]
fn an_arc_spans_beyond_its_ends() {
    let report = check(
        "gcode fanuc-30i mill-3axis",
        "G21 G90 G54\nG0 X0. Y0. Z0.\nG2 X20. Y0. I10. J0. F100.\nM30\n",
    );
    let found = of(&report, "axis-limit")[0];
    assert!((number(found, "fits_y_max_mm").unwrap() - (travel(1)[1] - 10.0)).abs() < 1e-9);
    assert_eq!(number(found, "fits_y_min_mm"), Some(travel(1)[0]));
}

/// Z0 of the machine is no place of the part, and the increments after it count from there.
#[test]
fn machine_coordinates_do_not_count_for_the_offset() {
    let text = "G21 G90 G53 G0 Z0.\nG54 G0 X0. Y0.\nG91 G1 Z-5. F100.\nG90 Z100.\nZ90.\nM30\n";
    let report = check("gcode fanuc-30i mill-3axis", text);
    let found = of(&report, "axis-limit")[0];
    assert_eq!(number(found, "fits_z_min_mm"), Some(travel(2)[0] - 90.0));
    assert_eq!(number(found, "fits_z_max_mm"), Some(travel(2)[1] - 100.0));
}

#[test]
fn what_the_program_writes_is_declared_axis_by_axis() {
    let text = "G21 G90 G10 L2 P1 X300. Y200.\nG54 G0 X0. Y0. Z0.\nM30\n";
    let report = check("gcode fanuc-30i mill-3axis", text);
    let found = of(&report, "axis-limit")[0];
    assert_eq!(number(found, "fits_x_min_mm"), None);
    assert!(number(found, "fits_z_min_mm").is_some());
}

#[test]
fn a_length_that_is_not_declared_is_named_with_its_range() {
    let text = "G21 G90 G10 L2 P1 X300. Y200. Z-300.\nG54 G0 X0. Y0.\nG43 H3 Z50.\nG1 Z-5. F100.\nM30\n";
    let report = check("gcode fanuc-30i mill-3axis", text);
    assert!(of(&report, "axis-limit").is_empty(), "{:?}", report.diagnostics);
    let found = of(&report, "tool-length-unset");
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].status, Status::Unknown);
    assert!(found[0].message.starts_with("the length of tool 3 is not declared"));
    assert_eq!(
        number(found[0], "fits_length_max_mm"),
        Some(travel(2)[1] + 300.0 - 50.0)
    );
}

#[test]
fn rotary_axes_leave_the_travel_unknown_and_the_rest_judged() {
    let text = "G54\nTRAORI\nG1 X0 Y0 Z100 A0 C0 F1000\nX9000 A-40\nM30\n";
    let report = check("gcode sinumerik-840d mikron-ucp710", text);
    let unset = of(&report, "work-offset-unset");
    assert_eq!(unset.len(), 1, "{:?}", report.diagnostics);
    assert_eq!(unset[0].status, Status::Unknown);
    // X is not judged, A is
    let limits = of(&report, "axis-limit");
    assert_eq!(limits.len(), 1, "{:?}", report.diagnostics);
    assert!(limits[0].message.starts_with("A reaches -40 deg"));
    assert_eq!(limits[0].status, Status::Fail);
}

#[test]
fn what_is_assumed_is_listed_and_judged() {
    let text = "G21 G90 G54\nG0 X0. Y0. Z0.\nG43 H2 Z10.\nM30\n";
    let report = Fixture::parse("gcode fanuc-30i mill-3axis", text).check().unwrap();
    assert_eq!(
        report.assumptions,
        ["G54 = 0 (not declared)", "the length of tool 2 = 0 (not declared)"]
    );
    assert_eq!(report.summary.unknown, 0);
    let report = check("gcode fanuc-30i mill-3axis", text);
    assert!(report.assumptions.is_empty());
}

/// Where a tool change leaves an axis is a place of the machine, and no word in G54.
#[test]
fn the_place_of_a_tool_change_is_no_word() {
    let [low, high] = travel(2);
    for first in ["G0 X0. Y0.\nZ20.", "G0 X0. Y0. Z20."] {
        let text = format!("G21 G90 G17 G54\nT1 M6\n{first}\nG1 Z-350. F100.\nM30\n");
        let report = check("gcode fanuc-30i mill-3axis", &text);
        let found = of(&report, "axis-limit");
        assert_eq!(found.len(), 1, "{:?}", report.diagnostics);
        assert_eq!(found[0].status, Status::Unknown);
        assert_eq!(number(found[0], "fits_z_min_mm"), Some(low + 350.0));
        assert_eq!(number(found[0], "fits_z_max_mm"), Some(high - 20.0));
    }
}

/// Two tools with offsets of a lathe: one finding, as both X and Z depend on them; T0300 has none.
#[test]
fn the_offset_of_a_lathes_tool_is_undeclared() {
    let text = "G21 G18 G99 G10 L2 P1 X-200. Z-400.\nG54 G97 S500 M3\nT0202\nG0 X62. Z5.\nG1 Z-40. F0.2\nT0303\nG0 X62. Z5.\nG1 Z-40. F0.2\nM30\n";
    let report = check("gcode fanuc-30i-lathe-a lathe-2axis", text);
    let found = of(&report, "tool-length-unset");
    assert_eq!(found.len(), 1, "{:?}", report.diagnostics);
    assert!(
        found[0]
            .message
            .starts_with("the tool offset that T names is not declared"),
        "{}",
        found[0].message
    );
    assert_eq!(found[0].status, Status::Unknown);
    // an offset may lead X out of its travel, or back into it
    let far = check("gcode fanuc-30i-lathe-a lathe-2axis", &text.replace("X62.", "X420."));
    assert!(of(&far, "axis-limit").is_empty(), "{:?}", far.diagnostics);
    let assumed = Fixture::parse("gcode fanuc-30i-lathe-a lathe-2axis", text)
        .check()
        .unwrap();
    assert!(
        of(&assumed, "tool-length-unset").is_empty(),
        "{:?}",
        assumed.diagnostics
    );
    // Y of G54 is not written
    assert_eq!(
        assumed.assumptions[1..],
        [
            "the tool offset 2 = 0 (not declared)",
            "the tool offset 3 = 0 (not declared)"
        ]
    );
    let none = check(
        "gcode fanuc-30i-lathe-a lathe-2axis",
        &text.replace("T0202", "T0200").replace("T0303", "T0300"),
    );
    assert!(of(&none, "tool-length-unset").is_empty(), "{:?}", none.diagnostics);
}

/// A TNC holds the length of the tool that is in the spindle, also where the program calls none.
#[test]
fn klartext_without_a_tool_call_has_a_length_that_nothing_declares() {
    let text = "BEGIN PGM A MM\nL X+0 Y+0 Z+50 A+0 C+0 R0 FMAX\nM128\nL A+10 C+20 FMAX\nM30\nEND PGM A MM\n";
    let report = check("gcode heidenhain-klartext mikron-ucp710", text);
    let unknown: Vec<_> = (report.diagnostics.iter())
        .filter(|found| found.status == Status::Unknown)
        .collect();
    assert!(
        unknown.iter().any(|found| found.rule == "tool-length-unset"),
        "{unknown:#?}"
    );
}

/// Findings about limits of a program whose zero point is taken as zero; `length`: so are length and radius of the tool.
fn limits(dialect: &str, text: &str, length: bool) -> Vec<(Status, String)> {
    let dialect = trunnion_dialect::builtin(dialect).unwrap();
    let machine = trunnion_machine::builtin("mill-3axis").unwrap();
    let mut settings = crate::Settings::new(dialect, Some(machine), trunnion_interp::Setup::default());
    settings.assume = crate::Assume {
        tool_length: length,
        ..crate::Assume::ALL
    };
    let report = crate::check(
        &trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex),
        &settings,
    );
    let found = of(&report, "axis-limit");
    found.iter().map(|one| (one.status, one.message.clone())).collect()
}

/// The tool runs beside the programmed path by an unknown amount: a limit that only the programmed path breaks is not proven to be broken.
#[test]
fn a_limit_under_compensation_that_is_not_computed_is_unknown() {
    let text = |on: &str, off: &str| {
        format!(
            "%\nO1\nG21 G17 G90 G94 G54 G40\nM3 S1000\nG0 X0. Y0. Z-5.\n{on} G1 X10. Y5. F100.\nX5000.\n{off} X10. Y0.\nM30\n%\n"
        )
    };
    let fails = |found: &[(Status, String)]| found.iter().filter(|(status, _)| *status == Status::Fail).count();
    let compensated = text("G41 D9", "G40");
    assert_eq!(fails(&limits("fanuc-30i", &compensated, false)), 0);
    // a radius that is taken as zero, and a path without compensation
    assert_eq!(fails(&limits("fanuc-30i", &compensated, true)), 1);
    assert_eq!(fails(&limits("fanuc-30i", &text("", ""), false)), 1);
    let after = text("G41 D9", "G40 X20. Y0.\n")
        .replace("X5000.\n", "")
        .replace("M30", "X5000.\nM30");
    assert_eq!(
        fails(&limits("fanuc-30i", &after, false)),
        1,
        "compensation is off again"
    );
    let klartext = |side: &str| {
        format!(
            "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z-5 R0 FMAX M3\nL X+10 Y+5 {side} F100\nL X+5000\nL X+0 R0\nM30\nEND PGM A MM\n"
        )
    };
    assert_eq!(fails(&limits("heidenhain-klartext", &klartext("RL"), true)), 0);
    assert_eq!(fails(&limits("heidenhain-klartext", &klartext("R0"), true)), 1);
}

/// The zero points that fit are not known where the tool runs beside the path.
#[test]
fn no_range_fits_under_compensation_that_is_not_computed() {
    let report = check(
        "gcode fanuc-30i mill-3axis",
        "G21 G17 G90 G94 G54\nM3 S1000\nG0 X0. Y0. Z5.\nG41 D9 G1 X10. Y5. F100.\nX40.\nG40 X0. Y0.\nM30\n",
    );
    let found = of(&report, "axis-limit");
    assert_eq!(found.len(), 1, "{:?}", report.diagnostics);
    assert_eq!(number(found[0], "fits_x_min_mm"), None);
    assert_eq!(number(found[0], "fits_z_min_mm"), Some(travel(2)[0] - 5.0));
    let note = "X: unknown, because cutter radius compensation is not computed";
    assert!(found[0].notes.iter().any(|own| own == note), "{:?}", found[0].notes);
}

/// `G10 L20` takes the zero point from where the machine is: it is as undeclared as this position.
#[test]
fn a_zero_point_from_an_undeclared_position_is_undeclared() {
    let fails = |before: &str, code: &str| {
        let text = format!("G21 G90 G54 G17 G94\n{before}G0 X5 Y5 Z5\n{code}\nG0 X600 Y5 Z5\nM2\n");
        let report = check("gcode linuxcnc mill-3axis", &text);
        let found = of(&report, "axis-limit");
        found.iter().filter(|one| one.status == Status::Fail).count()
    };
    assert_eq!(fails("", "G10 L20 P1 X1 Y1 Z1"), 0);
    assert_eq!(fails("", "G10 L20 P2 X1 Y1 Z1\nG55"), 0);
    // a value that the program gives, and a position that rests on it
    assert_eq!(fails("", "G10 L2 P1 X5 Y5 Z5"), 1);
    assert_eq!(fails("G10 L2 P1 X5 Y5 Z5\n", "G10 L20 P1 X1 Y1 Z1"), 1);
}
