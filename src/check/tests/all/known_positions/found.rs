//! Programs whose axis positions were taken to be known although they are not, each cut down to what it takes.
use super::language::LANGUAGES;
use super::same_with_values;
use proptest::prelude::*;

/// Dialect, and the lines after the head of its programs.
const FOUND: [(&str, &str); 25] = [
    // a zero point of no known value
    ("linuxcnc", "G52 X#5161\nX5.\n"),
    // the level to which a cycle returns
    ("linuxcnc", "G98\nZ#5161\nG83 R2. Q1. Z#5162\n"),
    // the corner and the path of a motion that waits for the next one
    ("fanuc-30i", "G41 D1\nX#500\nG91 G28 X#500\n"),
    ("fanuc-30i", "G43.4 H1\nG1 ,C5. X5.\nX#500\n"),
    ("fanuc-30i", "G1 ,C5. X#500\nG54\nG68.2 X0. Y0. Z0. I#500 J#500 K5.\n"),
    ("fanuc-30i", "G1 ,C5. X#500\nG10 L2 P0 Z#500\nG1 X#501\n"),
    ("haas-lathe", "G1 Z-3.5 C#500\nG1 X#500\n"),
    ("fanuc-30i-lathe-c", "G1 R#500 X5.\nG1 Z-3.5\n"),
    ("fanuc-30i-lathe-b", "G1 U#500 Z-3.5 C#500\nG1 X#500\n"),
    // a written offset
    ("fanuc-30i-lathe-c", "G1 X5.\nG10 L2 P1 X#500\nG1 X5. Z-3.5\n"),
    // turns onto planes
    ("fanuc-30i", "G68.2 X0. Y0. Z0. I#500 J#500 K#500\nG53.1\nG0 X5.\n"),
    (
        "fanuc-30i",
        "G68.2 X5. Y0. Z5. I0. J30. K0.\nG10 L2 P1 X#500\nG53.6 H1\n",
    ),
    (
        "heidenhain-klartext",
        "PLANE SPATIAL SPA+0 SPB+30 SPC+Q1 MOVE DIST50 F500\nL X+1 F100\n",
    ),
    (
        "heidenhain-klartext",
        "M128\nCYCL DEF 7.0 D\nCYCL DEF 7.1 X+Q1\nPLANE SPATIAL SPA+0 SPB+5 SPC+0 TURN FMAX\n",
    ),
    (
        "heidenhain-klartext",
        "PLANE SPATIAL SPA+5 SPB+0 SPC+0 STAY\nL IA+Q1 F100\nL X+1 F100\n",
    ),
    // a word in the plane moves all linear axes
    (
        "heidenhain-klartext",
        "PLANE SPATIAL SPA+0 SPB+5 SPC+0 TURN FMAX\nCYCL DEF 7.0 D\nCYCL DEF 7.1 X+Q1\nL Z+Q1 F100\n",
    ),
    // shifts of rotary axes
    ("heidenhain-klartext", "CYCL DEF 7.0 D\nCYCL DEF 7.1 C+Q1\nL C+5 F100\n"),
    (
        "heidenhain-klartext",
        "CYCL DEF 7.0 D\nCYCL DEF 7.1 X+Q1\nCYCL DEF 7.2 C+5\nL C+5 F100\n",
    ),
    // the length of the tool
    ("heidenhain-klartext", "TOOL CALL 1 Z S1000 DL+Q1\nL Z+5 F100\n"),
    // a cycle that ends another one
    (
        "heidenhain-klartext",
        "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+Q1\nCYCL DEF 8.0 M\nCYCL DEF 8.1\nL X+5 F100\n",
    ),
    (
        "heidenhain-klartext",
        "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+Q1\nCYCL DEF 10.1 IROT+5\nL X+5 F100\n",
    ),
    // a vector after one that was known, and a plain motion behind it
    (
        "sinumerik-840d",
        "TRAORI\nG1 X1 A3=0.1 B3=0 C3=1\nX2 A3=R1 B3=0 C3=1\nX3\n",
    ),
    (
        "heidenhain-klartext",
        "M128\nLN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 TX+0 TY+0.1 TZ+0.99 F100\nLN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 TX+0 TY+Q1 TZ+0.99\nL X+3\n",
    ),
    (
        "fanuc-30i",
        "G43.5 H1\nX1. Y0. Z0. I0.1 J0. K1.\nX2. I#500 J0. K1.\nX3.\n",
    ),
    // the next hole of a cycle
    ("fanuc-30i", "G43.4 H1\nG81 R2. X#500 Z-3.5\nX#500\n"),
];

#[test]
fn none_of_them_is_known() -> Result<(), TestCaseError> {
    for (dialect, lines) in FOUND {
        let language = LANGUAGES
            .iter()
            .find(|language| language.dialect == dialect)
            .expect("listed");
        for machine in language.machines {
            let machine = trunnion_machine::builtin(machine).expect("built in");
            for offsets in [false, true] {
                same_with_values(language, machine, &format!("{}{lines}", language.head), offsets)?;
            }
        }
    }
    Ok(())
}

/// A row of a datum table may shift rotary axes: they are unknown until each has a shift again.
#[test]
fn a_datum_from_a_table_may_shift_rotary_axes() {
    let language = LANGUAGES
        .iter()
        .find(|language| language.dialect == "heidenhain-klartext")
        .expect("listed");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let level = "CYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\nCYCL DEF 7.3 Z+0\n";
    for (shift, known) in [
        ("CYCL DEF 7.1 #5\n".to_owned(), false),
        (format!("CYCL DEF 7.1 #5\n{level}"), false),
        (
            format!("CYCL DEF 7.1 #5\n{level}CYCL DEF 7.4 A+0\nCYCL DEF 7.5 C+0\n"),
            true,
        ),
        ("CYCL DEF 7.1 #5\nTRANS DATUM RESET\n".to_owned(), true),
        (level.to_owned(), true),
    ] {
        let text = format!("{}CYCL DEF 7.0 D\n{shift}L X+1 Y+1 Z+1 A+5 C+5 F100\n", language.head);
        let followed = super::follow(language, machine, &text, true, None);
        let last = followed.after.last().expect("a motion");
        for (joint, axis) in last.joints.iter().zip(&machine.axes) {
            let rotary = b"AC".contains(&axis.letter);
            assert!(!rotary || joint.is_some() == known, "{text}{last:?}");
        }
    }
}

/// The words of FUNCTION TCPM AXIS SPAT are angles of the tool: they turn the rotary axes that the machine has, and a letter that it has not is no
/// mistake.
#[test]
fn spatial_angles_leave_no_rotary_axis_where_it_was() {
    let language = LANGUAGES
        .iter()
        .find(|language| language.dialect == "heidenhain-klartext")
        .expect("listed");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let spatial = "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL VECTOR\n";
    for word in ["A+5", "B+5", "IB+5", "C+5", "A+0 B+0 C+0"] {
        for after in ["", "L X+2 Y+2 Z+3 F100\n", "FUNCTION RESET TCPM\nL X+2 Y+2 Z+3 F100\n"] {
            let text = format!("{}{spatial}L X+1 Y+2 Z+3 {word} F100\n{after}", language.head);
            let followed = super::follow(language, machine, &text, true, None);
            let last = followed.after.last().expect("a motion");
            for (joint, axis) in last.joints.iter().zip(&machine.axes) {
                assert!(!b"AC".contains(&axis.letter) || joint.is_none(), "{text}{last:?}");
            }
            assert!(
                !matches!(last.end, Err(trunnion_machine::NoStance::NoSuchAxis(_))),
                "{text}"
            );
        }
    }
}

/// The length of a tool acts along the axis of TOOL CALL: where that is not the axis of the spindle, the axes are at unknown positions until a
/// TOOL CALL names it.
#[test]
fn a_tool_axis_that_is_not_that_of_the_spindle() {
    let language = LANGUAGES
        .iter()
        .find(|language| language.dialect == "heidenhain-klartext")
        .expect("listed");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    for (calls, known) in [
        ("TOOL CALL 1 Z S1000\n", true),
        ("TOOL CALL 1 Y S1000\n", false),
        ("TOOL CALL 1 X S1000\n", false),
        ("TOOL CALL 1 Y S1000\nTOOL CALL S2000\n", false),
        ("TOOL CALL 1 Y S1000\nTOOL CALL 1 Z S1000\n", true),
    ] {
        let text = format!("{}{calls}L X+1 Y+2 Z+3 A+5 C+5 F100\n", language.head);
        let followed = super::follow(language, machine, &text, true, None);
        let last = followed.after.last().expect("a motion");
        for (joint, axis) in last.joints.iter().zip(&machine.axes) {
            let rotary = b"AC".contains(&axis.letter);
            assert_eq!(joint.is_some(), known || rotary, "{text}{last:?}");
        }
    }
}
