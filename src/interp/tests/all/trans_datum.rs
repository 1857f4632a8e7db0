//! TRANS DATUM in place of cycle 7, and FUNCTION DWELL in place of cycle 9. The places are worked out by hand.
use crate::support::{faults, run_text};

const NAME: &str = "heidenhain-klartext";
const LINE: &str = "L X+1 Y+2 Z+3 R0";
const SHIFT: &str = "TRANS DATUM AXIS X+10 Y+20 Z+30\n";
const RESET: &str = "TRANS DATUM RESET\n";
const TABLE: &str = "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 #5\n";
/// No rotation, no mirror image and no scaling.
const SQUARE: &str = "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+0\nCYCL DEF 8.0 M\nCYCL DEF 8.1\nCYCL DEF 11.0 S\nCYCL DEF 11.1 SCL1\n\
                      CYCL DEF 26.0 S\nCYCL DEF 26.1 X1 Y1 Z1\n";
/// A place a b c of this plane is c, b, -a outside.
const PLANE: &str = "PLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY\n";

fn program(blocks: &str) -> String {
    format!("0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+0 R0\n{blocks}\nEND PGM A MM\n")
}

/// Of the last motion, in coordinates of the preset.
fn last(blocks: &str) -> Option<[f64; 3]> {
    let run = run_text(NAME, &program(blocks));
    let motion = run.motions.last().expect("a motion");
    let end = motion.end.xyz()?;
    Some([0, 1, 2].map(|axis| ((end[axis] + motion.zero[axis]) * 1e9).round() / 1e9 + 0.0))
}

fn said(blocks: &str) -> Vec<String> {
    let mut said = faults(NAME, &program(blocks));
    said.retain(|fault| !fault.contains("Unset") && !fault.contains("MissingProgramEnd"));
    said
}

#[test]
fn a_shift_by_values_and_back() {
    let seven = "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+20\nCYCL DEF 7.3 Z+30\n";
    for (blocks, wanted) in [
        (format!("{SHIFT}{LINE}"), [11.0, 22.0, 33.0]),
        (format!("{SHIFT}{LINE}\n{SHIFT}L X+0"), [10.0, 22.0, 33.0]),
        (format!("{SHIFT}{LINE}\n{RESET}L X+0"), [0.0, 22.0, 33.0]),
        (format!("{SHIFT}{RESET}{LINE}"), [1.0, 2.0, 3.0]),
        (format!("{seven}{RESET}{LINE}"), [1.0, 2.0, 3.0]),
        (format!("{seven}{SHIFT}{LINE}"), [11.0, 22.0, 33.0]),
        (format!("TRANS DATUM AXIS Y+20\n{LINE}"), [1.0, 22.0, 3.0]),
        (
            format!("Q1 = 4\nTRANS DATUM AXIS X+Q1 Y-Q1 Z+0\n{LINE}"),
            [5.0, -2.0, 3.0],
        ),
        // a shift that is not known ends with RESET
        (format!("{TABLE}{RESET}{LINE}"), [1.0, 2.0, 3.0]),
        (format!("TRANS DATUM TABLE TABLINE5\n{RESET}{LINE}"), [1.0, 2.0, 3.0]),
        (format!("{TABLE}{SHIFT}{LINE}"), [11.0, 22.0, 33.0]),
        // in the axes of the plane, about the datum where the plane was set
        (format!("{PLANE}{SHIFT}{LINE}"), [33.0, 22.0, -11.0]),
        (format!("{PLANE}{SHIFT}{LINE}\n{RESET}{LINE}"), [3.0, 2.0, -1.0]),
        (format!("{SHIFT}{PLANE}{LINE}"), [13.0, 22.0, 29.0]),
        (
            format!("{PLANE}{SHIFT}{RESET}PLANE RESET STAY\n{LINE}"),
            [1.0, 2.0, 3.0],
        ),
    ] {
        assert_eq!(last(&blocks), Some(wanted), "{blocks}");
        let expected = usize::from(blocks.contains(TABLE) || blocks.contains("TABLE"));
        assert_eq!(said(&blocks).len(), expected, "{blocks}: {:?}", said(&blocks));
    }
    let inch = program(&format!("{SHIFT}{LINE}")).replace(" MM", " INCH");
    let motions = run_text(NAME, &inch).motions;
    let motion = motions.last().expect("a motion");
    assert!((motion.end.get(0).expect("known") + motion.zero[0] - 11.0 * 25.4).abs() < 1e-9);
}

#[test]
fn what_is_not_sourced_is_unknown_by_name() {
    for (blocks, reason) in [
        (
            format!("{SHIFT}TRANS DATUM AXIS Y+5\n{LINE}"),
            "leaves out a shifted axis",
        ),
        (
            format!("{TABLE}TRANS DATUM AXIS Y+5\n{LINE}"),
            "leaves out a shifted axis",
        ),
        (format!("TRANS DATUM AXIS IX+5\n{LINE}"), "increments"),
        (format!("TRANS DATUM TABLE TABLINE5\n{LINE}"), "TRANS DATUM TABLE"),
        (format!("TRANS DATUM\n{LINE}"), "TRANS DATUM in another form"),
        (format!("TRANS DATUM AXIS\n{LINE}"), "needs the shift of an axis"),
        (
            format!("{SHIFT}{PLANE}{RESET}{LINE}"),
            "TRANS DATUM RESET in a tilted plane",
        ),
        (
            format!("CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\n{SHIFT}{LINE}"),
            "in a turned",
        ),
        (format!("TRANS MIRROR AXIS X\n{LINE}"), "TRANS MIRROR"),
    ] {
        assert_eq!(last(&blocks), None, "{blocks}");
        let said = said(&blocks);
        assert!(said.iter().any(|fault| fault.contains(reason)), "{blocks}: {said:?}");
    }
}

/// A table gives every axis, so one axis that cycle 7 takes back leaves the others unknown.
#[test]
fn one_axis_taken_back_leaves_the_shift_of_a_table() {
    let back = |axes: &[&str]| {
        let lines: Vec<String> = axes
            .iter()
            .enumerate()
            .map(|(at, axis)| format!("CYCL DEF 7.{} {axis}+0", at + 1))
            .collect();
        format!("CYCL DEF 7.0 DATUM\n{}\n", lines.join("\n"))
    };
    for shift in [TABLE, "CALL PGM NOWHERE\n"] {
        assert_eq!(
            last(&format!("{shift}{}PLANE RESET STAY\n{LINE}", back(&["X"]))),
            None,
            "{shift}"
        );
        let all = format!("{shift}{SQUARE}{}PLANE RESET STAY\n{LINE}", back(&["X", "Y", "Z"]));
        assert_eq!(last(&all), Some([1.0, 2.0, 3.0]), "{shift}");
    }
}

/// TIME is in seconds; turns take a time that depends on the spindle.
#[test]
fn function_dwell_waits() {
    let waits = |block: &str| {
        let motions = run_text(NAME, &program(block)).motions;
        let dwells = motions.iter().filter_map(|motion| match motion.kind {
            trunnion_interp::MotionKind::Dwell(seconds) => Some(seconds),
            _ => None,
        });
        dwells.collect::<Vec<_>>()
    };
    for (block, wanted) in [
        ("FUNCTION DWELL TIME10", Some(10.0)),
        ("FUNCTION DWELL TIME 1,5", Some(1.5)),
        ("Q1 = 3\nFUNCTION DWELL TIMEQ1", Some(3.0)),
        ("FUNCTION DWELL REV2", None),
    ] {
        assert_eq!(waits(block), [wanted], "{block}");
        assert_eq!(
            said(block).len(),
            usize::from(wanted.is_none()),
            "{block}: {:?}",
            said(block)
        );
    }
    assert!(
        said("FUNCTION DWELL")
            .iter()
            .any(|fault| fault.contains("needs TIME or REV"))
    );
    assert_eq!(last(&format!("FUNCTION DWELL TIME2\n{LINE}")), Some([1.0, 2.0, 3.0]));
}

/// Cycle 10 does not take back another reason why positions are not known.
#[test]
fn a_rotation_does_not_make_a_wrong_tool_axis_right() {
    let mut setup = trunnion_interp::Setup::default();
    setup.control.axes_declared = true;
    for (axis, known) in [("Z", true), ("X", false)] {
        let text = format!(
            "BEGIN PGM A MM\nTOOL CALL 1 {axis} S1000\nCYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\nL X+1 Y+2 Z+3 R0 F100\nEND PGM A MM\n"
        );
        let log = crate::support::run_bytes("heidenhain-klartext", text.as_bytes(), &setup).1;
        let last = log.motions.last().expect("a motion");
        assert_eq!(last.end.xyz().is_some(), known, "{axis}");
    }
}
