//! Tool nose radius compensation on lathes, by hand: X is a radius here and a diameter in the programs.
use crate::support::run_bytes;
use trunnion_interp::{FaultKind, MotionKind, Nose, Setup, Tool, ToolShape};

const HEAD: &str = "G21 G18 G99 G40\nT0101\nG97 S1000 M3\nG0 X60. Z5.\n";

/// The ends of the motions after the first, Z and X in mm; and the faults.
fn run(dialect: &str, tip: Option<u8>, text: &str) -> (Vec<[f64; 2]>, Vec<String>) {
    let shape = tip.map(|tip| ToolShape::Turning(Nose { radius_mm: 1.0, tip }));
    let setup = Setup {
        tools: vec![Tool {
            number: 1,
            shape,
            diameter_mm: None,
            length_mm: None,
            holder_mm: None,
        }],
        ..Setup::default()
    };
    let (_, log) = run_bytes(dialect, format!("{HEAD}{text}").as_bytes(), &setup);
    let ends = log.motions.iter().skip(1).map(|motion| {
        if let MotionKind::Arc(Some(arc)) = motion.kind {
            let off = (arc.end[2] - motion.end.values[2]).abs() + (arc.end[0] - motion.end.values[0]).abs();
            assert!(
                off < 1e-9 && (arc.radius_start - arc.radius_end).abs() < 1e-9,
                "{arc:?}"
            );
        }
        [motion.end.values[2], motion.end.values[0]]
    });
    // of the offset of T0101 this is not about
    let kinds = log.faults.iter().map(|fault| &fault.kind);
    let kinds = kinds.filter(|kind| !matches!(kind, FaultKind::ToolLengthUnset { .. }));
    let faults = kinds.map(|kind| format!("{kind:?}")).collect();
    (ends.collect(), faults)
}

fn assert_near(ends: &[[f64; 2]], wanted: &[[f64; 2]]) {
    let near = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs() < 1e-4 && (a[1] - b[1]).abs() < 1e-4;
    assert!(
        ends.len() == wanted.len() && ends.iter().zip(wanted).all(near),
        "{ends:?} instead of {wanted:?}"
    );
}

/// A cylinder and a cone of 45 degrees: the tip stays on the cylinder, and turns off 1 - tan(22.5 deg) of the radius behind the corner.
#[test]
fn a_cone_outside() {
    let text = "G42 G0 X40. Z2.\nG1 Z-20. F.2\nX60. Z-30.\nG40 G0 X70. Z-30.\nM30\n";
    for dialect in ["haas-lathe", "fanuc-30i-lathe-a"] {
        let (ends, faults) = run(dialect, Some(3), text);
        assert_eq!(faults, [""; 0], "{dialect}");
        let corner = 2.0 - 2f64.sqrt();
        let side = 0.5f64.sqrt();
        assert_near(
            &ends,
            &[
                [1.0, 20.0],
                [-20.0 - corner, 20.0],
                [-31.0 + side, 29.0 + side],
                [-30.0, 35.0],
            ],
        );
    }
}

/// The same cone bored with a tool whose tip points the other way: G41 inside.
#[test]
fn a_cone_inside() {
    let text = "G41 G0 X60. Z2.\nG1 Z-20. F.2\nX40. Z-30.\nG40 G0 X30. Z-30.\nM30\n";
    let (ends, faults) = run("haas-lathe", Some(2), text);
    assert_eq!(faults, [""; 0]);
    let corner = 2.0 - 2f64.sqrt();
    let side = 0.5f64.sqrt();
    assert_near(
        &ends,
        &[
            [1.0, 30.0],
            [-20.0 - corner, 30.0],
            [-31.0 + side, 21.0 - side],
            [-30.0, 15.0],
        ],
    );
}

/// Where the centre is programmed, it runs beside the path; an arc keeps its centre.
#[test]
fn the_centre_of_the_nose_is_programmed() {
    let text = "G42 G0 X40. Z2.\nG1 Z-20. F.2\nG2 X60. Z-30. R10.\nG40 G0 X70. Z-30.\nM30\n";
    let (ends, faults) = run("haas-lathe", Some(9), text);
    assert_eq!(faults, [""; 0]);
    assert_near(&ends, &[[2.0, 21.0], [-20.0, 21.0], [-29.0, 30.0], [-30.0, 35.0]]);
    let (shifted, _) = run("haas-lathe", Some(3), text);
    assert_near(&shifted, &[[1.0, 20.0], [-21.0, 20.0], [-30.0, 29.0], [-30.0, 35.0]]);
}

#[test]
fn a_nose_that_is_not_declared_is_said() {
    let text = "G42 G0 X40. Z2.\nG1 Z-20. F.2\nG40 G0 X70.\nM30\n";
    let (ends, faults) = run("haas-lathe", None, text);
    assert_near(&ends, &[[2.0, 20.0], [-20.0, 20.0], [-20.0, 35.0]]);
    assert!(faults.len() == 1 && faults[0].contains("tip_direction"), "{faults:?}");
}
