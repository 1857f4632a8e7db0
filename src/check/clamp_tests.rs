//! Rule clamped-axis-moves: axes that must not move, and clamp codes.
use crate::fixture::{assert_drawn, check_with, machine};
use std::sync::Arc;
use trunnion_interp::{Files, Library, Loaded, Searched, Setup};

#[test]
fn a_run_of_blocks_is_told_once_and_the_free_axis_may_turn() {
    let report = assert_drawn(
        "gcode sinumerik-840d mikron-ucp710+C.clamp",
        "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 G1 X10 A21 F100\nN40 G1 X20 C1\n;          ^^ clamped-axis-moves: C turns by 2 deg\nN50 G1 X30 C3\nN60 M30\n",
    );
    assert_eq!(report.diagnostics[0].count, 2);
}

/// The tool leans by the same angle at both ends and C has turned by half a turn but a little: on the great circle A comes down towards
/// the pole and goes up again. Exactly over the pole it is unknown.
#[test]
fn an_axis_that_comes_back_on_a_great_circle_has_turned() {
    let program = |j: &str| {
        format!(
            "N10 TRAORI\nN15 ORIWKS ORIVECT\nN20 G0 X0 Y0 Z50 A3=0.6 B3=0 C3=0.8\nN30 G1 X10 A3=-0.6 B3={j} C3=0.8 F100\nN60 M30\n"
        )
    };
    for j in ["0", "0.02"] {
        let machine = "gcode sinumerik-840d mikron-ucp710+A.clamp";
        let report = crate::fixture::Fixture::parse(machine, &program(j))
            .check()
            .expect("there");
        let found = report
            .diagnostics
            .iter()
            .filter(|found| found.rule == "clamped-axis-moves");
        let said: Vec<&str> = found.map(|found| found.message.as_str()).collect();
        let wanted = if j == "0" {
            "it is not known whether A turns between"
        } else {
            "A turns by 3"
        };
        assert!(said.len() == 1 && said[0].starts_with(wanted), "{j}: {said:?}");
    }
}

const CODES: &str = "mikron-ucp710+C.clamp_codes={on=\"M10\",off=\"M11\"}";

fn drawn(dialect: &str, text: &str) {
    assert_drawn(&format!("gcode {dialect} {CODES}"), text);
}

#[test]
fn a_clamp_that_no_code_has_named_is_not_decided() {
    drawn(
        "haas-ngc",
        "G0 X0. Y0. Z50. A20. C0.\n;                    ^^^ clamped-axis-moves: C may be clamped: neither M10 nor M11 has run yet\nG0 C9.\nX5.\nM30\n",
    );
}

#[test]
fn a_code_beside_the_motion_is_not_decided_and_holds_behind_it() {
    drawn(
        "fanuc-30i",
        "M11\nG0 X0. Y0. Z50. A20. C0.\nG0 C9. M10\n;  ^^^ clamped-axis-moves: C may be clamped: it is not known whether its clamp acts before\nG0 A9.\nG0 C5.\n;  ^^^ clamped-axis-moves: C turns by 4 deg while it is clamped\nM30\n",
    );
}

#[test]
fn codes_of_a_subprogram_in_the_file_are_read() {
    let report = assert_drawn(
        &format!("gcode haas-ngc {CODES}"),
        "M11\nG0 X0. Y0. Z50. A20. C0.\nM98 P5\nG0 C9.\nM30\nO5\nM10\nG0 C5.\n;  ^^^ clamped-axis-moves: C turns by 5 deg while it is clamped\nM99\n",
    );
    assert_eq!(report.diagnostics[0].count, 2);
}

#[test]
fn a_code_by_an_expression_counts_where_its_value_is_known() {
    drawn(
        "haas-ngc",
        "M11\nG0 X0. Y0. Z50. A20. C0.\n#1=10\nM#1\nG0 C9.\n;  ^^^ clamped-axis-moves: C turns by 9 deg while it is clamped\nM30\n",
    );
    assert_eq!(
        told("haas-ngc", None, "M11\nG0 X0. Y0. Z50. A20. C0.\nM#500\nG0 C9.\nM30\n"),
        ["C may be clamped: it is not known which of its clamp codes ran last"],
    );
}

/// One file under any name.
struct OneFile(&'static str);

impl Files for OneFile {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let bytes = self.0.as_bytes().into();
        Ok(Loaded {
            path: format!("{name}.nc"),
            bytes,
        })
    }
}

/// What the rule says of a text that may call the file.
fn told(dialect: &str, file: Option<&'static str>, text: &str) -> Vec<String> {
    let setup = Setup {
        library: Library(file.map(|text| Arc::new(OneFile(text)) as Arc<dyn Files>)),
        ..Setup::default()
    };
    of_setup(dialect, setup, text)
}

fn of_setup(dialect: &str, setup: Setup, text: &str) -> Vec<String> {
    of_machine(CODES, dialect, setup, text)
}

fn of_machine(name: &str, dialect: &str, setup: Setup, text: &str) -> Vec<String> {
    let machine = machine(name).expect("built in");
    let report = check_with(&machine, dialect, text, setup);
    let strange = |rule: &str| ["unknown-code", "rejected-block"].contains(&rule);
    assert!(
        !report.diagnostics.iter().any(|found| strange(found.rule)),
        "{report:#?}"
    );
    let found = report.diagnostics.iter();
    let found = found.filter(|found| found.rule == "clamped-axis-moves");
    found.map(|found| found.message.clone()).collect()
}

const TURNS: &str = "C turns by 9 deg while it is clamped";

#[test]
fn codes_of_a_called_file_without_motion_are_read() {
    let main = "M11\nG0 X0. Y0. Z50. A20. C0.\nM98 P7\nG0 C9.\nM30\n";
    assert_eq!(told("haas-ngc", Some("O7\nM10\nM99\n"), main), [TURNS]);
    assert_eq!(told("fanuc-30i", Some("O7\nM10\nM99\n"), main), [TURNS]);
    let closed = main.replace("M98", "M10\nM98");
    assert_eq!(told("fanuc-30i", Some("O7\nM11\nM99\n"), &closed), [""; 0]);
    // after a missing part nothing is known
    let gone = "M11\nM98 P7\nG0 X0. Y0. Z50. A20. C0.\nG0 C9.\nM30\n";
    let found = told("fanuc-30i", None, gone);
    assert_eq!(
        found,
        ["C may be clamped: it is not known which of its clamp codes ran last"]
    );
}

#[test]
fn a_linuxcnc_program_is_read_the_same() {
    let main = "M11\nG0 X0 Y0 Z50 A20 C0\no<seven> call\nG0 C9\nM2\n";
    assert_eq!(
        told("linuxcnc", Some("o<seven> sub\nM10\no<seven> endsub\nM2\n"), main),
        [TURNS]
    );
    assert_eq!(
        told("linuxcnc", Some("o<seven> sub\nM11\no<seven> endsub\nM2\n"), main),
        [""; 0]
    );
    let skipped = "M11\nG0 X0 Y0 Z50 A20 C0\no1 if [0]\nM10\no1 endif\nG0 C9\nM2\n";
    assert_eq!(told("linuxcnc", None, skipped), [""; 0]);
    // beside another code it is clear; of two codes of one clamp it is unknown which comes last
    let beside = "M11\nG0 X0 Y0 Z50 A20 C0\nM10 M8 (M11)\nG0 C9\nM2\n";
    assert_eq!(told("linuxcnc", None, beside), [TURNS]);
    let both = "M11\nG0 X0 Y0 Z50 A20 C0\nM10 m 1 1\nG0 C9\nM2\n";
    assert_eq!(
        told("linuxcnc", None, both),
        ["C may be clamped: it is not known which of its clamp codes ran last"]
    );
    // of two clamps each reacts to its own code, whichever is written last
    for codes in ["M10 M13", "M13 M10"] {
        let text = format!("M11\nM13\nG0 X0 Y0 Z50 A20 C0\n{codes}\nG0 C9\nG0 A29\nM2\n");
        let two = format!("{CODES}+A.clamp_codes={{on=\"M12\",off=\"M13\"}}");
        assert_eq!(
            of_machine(&two, "linuxcnc", Setup::default(), &text),
            [TURNS],
            "{codes}"
        );
    }
}

#[test]
fn blocks_that_are_deleted_close_nothing() {
    for (on, found) in [(true, vec![]), (false, vec![TURNS.to_owned()])] {
        let mut setup = Setup::default();
        setup.control.block_delete = Some(on);
        let text = "M11\nG0 X0. Y0. Z50. A20. C0.\n/M10\nG0 C9.\nM30\n";
        assert_eq!(of_setup("haas-ngc", setup, text), found, "{on}");
    }
}

#[test]
fn a_motion_that_compensation_tells_late_has_the_clamp_of_its_own_block() {
    let contour = |before: &str, behind: &str| {
        let text = format!(
            "(trunnion: tool 1 flat diameter 10 length 100)\nT1 M6\nM11\nG0 X0. Y0. Z50. A0. C0.\nG1 G41 D1 X10. F500.\n{before}\nX20. C9.\n{behind}\nX30. Y10.\nG40 X40.\nM30\n"
        );
        told("haas-ngc", None, &text)
    };
    assert_eq!(contour("M11", "M10"), [""; 0]);
    assert_eq!(contour("M10", "M11"), [TURNS]);
}

#[test]
fn vectors_and_swivels_turn_a_clamped_axis_too() {
    drawn(
        "fanuc-30i",
        "M11\nG0 X0. Y0. Z50. A0. C0.\nM10\nG68.2 X0. Y0. Z0. I30. J20. K0.\nG53.1\n;^^^^ clamped-axis-moves: C turns by\nG69\nM30\n",
    );
}
