//! Frames that the program sets inside a tilted plane: TRANS, ROT, SCALE and MIRROR after CYCLE800, cycle 7 after PLANE. The places of the first tests are
//! worked out by hand, those of the random ones by matrices that know nothing of the interpreter.
use crate::planes_agree::ORDERS;
use crate::support::{faults, run_text};
use proptest::prelude::*;
use std::fmt::Write;
use trunnion_geometry::{Mat3, Vec3};
use trunnion_interp::Motion;

const SIEMENS: &str = "sinumerik-840d";
const KLARTEXT: &str = "heidenhain-klartext";
/// X100, then a quarter turn about Y: a place a b c of the plane is 100 + c, b, -a outside.
const QUARTER: &str = "CYCLE800(0,\"\",0,57,100,0,0,0,90,0,0,0,0,0)";

/// In coordinates of the selected zero point.
fn place(motion: &Motion) -> Option<[f64; 3]> {
    let end = motion.end.xyz()?;
    Some([0, 1, 2].map(|axis| ((end[axis] + motion.zero[axis]) * 1e9).round() / 1e9 + 0.0))
}

fn siemens(blocks: &str) -> String {
    format!("G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\n{QUARTER}\n{blocks}\n")
}

fn klartext(blocks: &str) -> String {
    format!("0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+0 R0\n{blocks}\nEND PGM A MM\n")
}

fn last(dialect: &str, text: &str) -> Option<[f64; 3]> {
    place(run_text(dialect, text).motions.last().expect("a motion"))
}

/// Nothing is said but what no program declares.
fn said(dialect: &str, text: &str) -> Vec<String> {
    let mut said = faults(dialect, text);
    said.retain(|fault| !fault.contains("Unset") && !fault.contains("MissingProgramEnd"));
    said
}

#[test]
fn frames_of_the_program_act_in_the_swivelled_plane() {
    for (blocks, wanted) in [
        ("X1 Y2 Z3", [103.0, 2.0, -1.0]),
        // 11 22 33
        ("TRANS X10 Y20 Z30\nX1 Y2 Z3", [133.0, 22.0, -11.0]),
        ("TRANS X10 Y20 Z30\nATRANS X1\nX1 Y2 Z3", [133.0, 22.0, -12.0]),
        // 10 - 2, 20 + 1, 33
        ("TRANS X10 Y20 Z30\nAROT Z90\nX1 Y2 Z3", [133.0, 21.0, -8.0]),
        // 10 - 2, 20 - 1, 33
        ("TRANS X10 Y20 Z30\nAROT Z90\nAMIRROR X0\nX1 Y2 Z3", [133.0, 19.0, -8.0]),
        // the shift lies in the turned axes: -(5 + 2), 1, 3
        ("ROT Z90\nATRANS Y5\nX1 Y2 Z3", [103.0, 1.0, 7.0]),
        ("ROT RPL=90\nX1 Y2 Z3", [103.0, 1.0, 2.0]),
        ("TRANS X10\nSCALE X2 Y2 Z2\nX1 Y2 Z3", [106.0, 4.0, -2.0]),
        ("TRANS X10 Y20 Z30\nROT\nX1 Y2 Z3", [103.0, 2.0, -1.0]),
        ("TRANS X10\nTRANS Y20\nX1 Y2 Z3", [103.0, 22.0, -1.0]),
        // the machine stays: an axis without a word keeps its place
        ("X1 Y2 Z3\nTRANS X10\nX1 Y2", [103.0, 2.0, -11.0]),
        ("X1 Y2 Z3\nTRANS X10\nY5", [103.0, 5.0, -1.0]),
        ("X1 Y2 Z3\nTRANS X10\nTRANS\nCYCLE800()\nX1 Y2 Z3", [1.0, 2.0, 3.0]),
    ] {
        let text = siemens(blocks);
        assert_eq!(last(SIEMENS, &text), Some(wanted), "{blocks}");
        assert_eq!(said(SIEMENS, &text), [""; 0], "{blocks}");
        let motions = run_text(SIEMENS, &text).motions;
        let normal = motions.iter().rev().find_map(|motion| motion.tilt.normal);
        assert_eq!(normal, Some(Vec3::x()), "{blocks}: the tool stands on the plane");
    }
}

/// An arc is turned with its frame, its centre too.
#[test]
fn arcs_in_a_frame_of_the_plane() {
    let text = siemens("TRANS X10 Y20 Z30\nAROT Z90\nG1 X5 Y0 Z0\nG3 X0 Y5 I-5 J0");
    let log = run_text(SIEMENS, &text);
    let trunnion_interp::MotionKind::Arc(Some(arc)) = log.motions.last().expect("a motion").kind else {
        panic!("an arc");
    };
    // centre 10 20 30 of the plane; about its third axis, which is X outside
    assert!((arc.centre - Vec3::new(130.0, 20.0, -10.0)).norm() < 1e-9, "{arc:?}");
    assert!((arc.normal * arc.sweep.signum() - Vec3::x()).norm() < 1e-9, "{arc:?}");
    assert!((arc.sweep.abs().to_degrees() - 90.0).abs() < 1e-9, "{arc:?}");
}

/// What is not followed is unknown, until the frame is written anew where that is stated.
#[test]
fn what_stays_unknown_in_a_swivelled_plane() {
    for blocks in [
        "AROT X30\nX1 Y2 Z3",
        "TRANS A10\nX1 Y2 Z3",
        "TRANS X10\nCYCLE800()\nX1 Y2 Z3",
        "ROT Z90\nCYCLE800()\nX1 Y2 Z3",
        "TRANS X10\nCYCLE800(0,\"\",1,57,0,0,0,0,0,30,0,0,0,0)\nX1 Y2 Z3",
        "ROT Z90\nCYCLE800(0,\"\",0,57,0,0,0,0,0,30,0,0,0,0)\nCYCLE800()\nX1 Y2 Z3",
        "ROT Z90\nTRAORI\nX1 Y2 Z3",
    ] {
        let text = siemens(blocks);
        assert_eq!(last(SIEMENS, &text), None, "{blocks}");
        assert_ne!(said(SIEMENS, &text), [""; 0], "{blocks}");
    }
    for (blocks, wanted) in [
        ("TRANS X10\nCYCLE800()\nTRANS\nX1 Y2 Z3", [1.0, 2.0, 3.0]),
        ("ROT Z90\nCYCLE800()\nTRANS X10\nX1 Y2 Z3", [11.0, 2.0, 3.0]),
        ("AROT X30\nX1 Y2 Z3\nTRANS X10\nX1 Y2 Z3", [103.0, 2.0, -11.0]),
    ] {
        assert_eq!(last(SIEMENS, &siemens(blocks)), Some(wanted), "{blocks}");
    }
    // from before the plane
    let before = format!("G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\nTRANS X10\n{QUARTER}\nX1 Y2 Z3\n");
    assert_eq!(last(SIEMENS, &before), None);
}

/// A rounded corner waits for its second block, in the coordinates of its own plane.
#[test]
fn a_frame_in_a_plane_inside_a_corner_is_unknown() {
    let text = siemens("X0 Y0 Z5\nX20 RND=2\nTRANS X10\nY20\nX1");
    let said = said(SIEMENS, &text);
    assert!(said.iter().any(|fault| fault.contains("inside a corner")), "{said:?}");
    assert_eq!(last(SIEMENS, &text), None);
}

/// TRAORI takes no mirror image: the vectors of the tool would not be mirrored.
#[test]
fn a_mirror_image_under_traori_is_unknown() {
    let text = "G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\nMIRROR X0\nTRAORI\nX1 Y2 Z3 A3=1 B3=0 C3=1\n";
    assert_eq!(last(SIEMENS, text), None);
    assert_ne!(said(SIEMENS, text), [""; 0]);
}

/// PLANE SPATIAL SPB+90: a b c of the plane is c, b, -a outside.
#[test]
fn a_datum_shift_after_plane_acts_in_the_plane() {
    const PLANE: &str = "PLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY\n";
    const SHIFT: &str = "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+20\nCYCL DEF 7.3 Z+30\n";
    const BACK: &str = "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\nCYCL DEF 7.3 Z+0\n";
    const RESET: &str = "PLANE RESET STAY\n";
    const LEVEL: &str = "PLANE SPATIAL SPA+0 SPB+0 SPC+0 STAY\n";
    const LINE: &str = "L X+1 Y+2 Z+3 R0";
    for (blocks, wanted) in [
        (format!("{PLANE}{LINE}"), [3.0, 2.0, -1.0]),
        (format!("{PLANE}{SHIFT}{LINE}"), [33.0, 22.0, -11.0]),
        (format!("{PLANE}{LINE}\n{SHIFT}L Y+2"), [3.0, 22.0, -1.0]),
        (
            format!("{PLANE}{SHIFT}CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 IX+5\n{LINE}"),
            [33.0, 22.0, -16.0],
        ),
        (format!("{PLANE}{SHIFT}{LINE}\n{BACK}{LINE}"), [3.0, 2.0, -1.0]),
        (format!("{PLANE}{SHIFT}{BACK}{RESET}{LINE}"), [1.0, 2.0, 3.0]),
        // before the plane: the datum about which it turns
        (format!("{SHIFT}{PLANE}{LINE}"), [13.0, 22.0, 29.0]),
        (format!("{SHIFT}{PLANE}{RESET}{LINE}"), [11.0, 22.0, 33.0]),
        (format!("{LEVEL}{SHIFT}{LINE}"), [11.0, 22.0, 33.0]),
        (format!("{LEVEL}{SHIFT}{RESET}{PLANE}{LINE}"), [13.0, 22.0, 29.0]),
        (format!("{LEVEL}{SHIFT}{BACK}{PLANE}{LINE}"), [3.0, 2.0, -1.0]),
        // a rotation after the shift turns about the shifted datum: 10 - 2, 20 + 1, 33
        (
            format!("{PLANE}{SHIFT}CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+90\n{LINE}"),
            [33.0, 21.0, -8.0],
        ),
    ] {
        let text = klartext(&blocks);
        assert_eq!(last(KLARTEXT, &text), Some(wanted), "{blocks}");
        assert_eq!(said(KLARTEXT, &text), [""; 0], "{blocks}");
    }
    for blocks in [
        // which of both is replaced
        format!("{SHIFT}{PLANE}{SHIFT}{LINE}"),
        format!("{SHIFT}{PLANE}CYCL DEF 7.0 D\nCYCL DEF 7.1 X+0\n{LINE}"),
        format!("{SHIFT}{PLANE}{BACK}{LINE}"),
        // where the shift is once its plane has ended
        format!("{PLANE}{SHIFT}{RESET}{LINE}"),
        format!("{PLANE}{SHIFT}{PLANE}{LINE}"),
        format!("{LEVEL}{SHIFT}{PLANE}{LINE}"),
        format!("{PLANE}{SHIFT}PLANE RELATIV SPA+30 STAY\n{LINE}"),
        // the axes of the preset are not known, whatever the shift is
        format!("CYCL DEF 247 Q339=+Q7\n{BACK}{LINE}"),
        format!("PRESET SELECT #3\n{BACK}{LINE}"),
        // taken back is the shift, not the rotation
        format!("TRANS ROTATION ROT+30\n{BACK}{LINE}"),
    ] {
        let text = klartext(&blocks);
        assert_eq!(last(KLARTEXT, &text), None, "{blocks}");
        assert_ne!(said(KLARTEXT, &text), [""; 0], "{blocks}");
    }
    for (blocks, wanted) in [
        // nothing is left of a shift and a plane that were both taken back
        (format!("{SHIFT}{PLANE}{BACK}{RESET}{LINE}"), [1.0, 2.0, 3.0]),
        (format!("{PLANE}{SHIFT}{RESET}{BACK}{LINE}"), [1.0, 2.0, 3.0]),
        (format!("{PLANE}{SHIFT}{RESET}{SHIFT}{LINE}"), [11.0, 22.0, 33.0]),
    ] {
        assert_eq!(last(KLARTEXT, &klartext(&blocks)), Some(wanted), "{blocks}");
    }
}

/// Frames of the tool and of the workpiece are none of the program: TRANS does not end them, nor do their ends end a frame of the program.
#[test]
fn each_frame_ends_with_a_word_of_its_own() {
    let after = |blocks: &str| {
        last(
            SIEMENS,
            &format!("G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\n{blocks}\nX1 Y2 Z3\n"),
        )
    };
    for blocks in [
        "TOROT",
        "TOROT\nTRANS",
        "TOROT\nATRANS Z10",
        "TOFRAME\nROT Z90",
        "TOROTX\nTRANS",
        "TOFRAMEZ\nTRANS",
        "PAROT\nTRANS\nTOROTOF",
        // the order of the angles is machine data
        "ROT X10 Y20\nTOROTOF\nPAROTOF",
    ] {
        assert_eq!(after(blocks), None, "{blocks}");
    }
    for blocks in [
        "TOROT\nTOROTOF",
        "TOFRAME\nTOROTOF",
        "TOROTY\nTOROTOF",
        "PAROT\nPAROTOF",
        "ROT X10 Y20\nTRANS",
    ] {
        assert_eq!(after(blocks), Some([1.0, 2.0, 3.0]), "{blocks}");
    }
}

/// G74: the axes that it names are lost, the others stay.
#[test]
fn homing_loses_the_axes_that_it_names() {
    let ends = |blocks: &str| {
        let text = format!("G17 G90 G71 G94 F100\nG1 X1 Y2 Z3\n{blocks}\n");
        assert_ne!(said(SIEMENS, &text), [""; 0], "{blocks}");
        let end = run_text(SIEMENS, &text).motions.last().expect("a motion").end;
        [0, 1, 2].map(|axis| end.get(axis))
    };
    assert_eq!(ends("G74 Z0"), [Some(1.0), Some(2.0), None]);
    assert_eq!(ends("G74 Z0\nG1 X5"), [Some(5.0), Some(2.0), None]);
    assert_eq!(ends("G74 X=0 Y=0\nG1 Z9"), [None, None, Some(9.0)]);
    assert_eq!(ends("G74 Z0\nG1 Z7"), [Some(1.0), Some(2.0), Some(7.0)]);
    // axes of the machine need not be those of the program
    assert_eq!(ends("G74 Z1=0\nG1 X5"), [Some(5.0), None, None]);
    assert_eq!(ends("G74\nG1 X5"), [Some(5.0), None, None]);
    assert_eq!(ends("TRAORI\nG1 X1 Y2 Z3\nG74 Z0"), [None; 3]);
}

/// One frame of a random program.
#[derive(Clone, Debug)]
enum Frame {
    Shift([f64; 3]),
    Turn(f64),
    Scale(f64),
    Mirror(usize),
}

impl Frame {
    fn any() -> impl Strategy<Value = Self> {
        let whole = || (-400i32..400).prop_map(|value| f64::from(value) / 4.0);
        prop_oneof![
            [whole(), whole(), whole()].prop_map(Self::Shift),
            (-180i32..180).prop_map(|degrees| Self::Turn(f64::from(degrees))),
            (1i32..12).prop_map(|factor| Self::Scale(f64::from(factor) / 4.0)),
            (0usize..3).prop_map(Self::Mirror),
        ]
    }
    fn text(&self) -> String {
        match self {
            Self::Shift([x, y, z]) => format!("ATRANS X{x} Y{y} Z{z}"),
            Self::Turn(degrees) => format!("AROT Z{degrees}"),
            Self::Scale(factor) => format!("ASCALE X{factor} Y{factor} Z{factor}"),
            Self::Mirror(axis) => format!("AMIRROR {}0", ["X", "Y", "Z"][*axis]),
        }
    }
    fn of(&self, point: Vec3) -> Vec3 {
        match self {
            Self::Shift(by) => point + Vec3::from(*by),
            Self::Turn(degrees) => turn(2, *degrees) * point,
            Self::Scale(factor) => point * *factor,
            Self::Mirror(axis) => {
                let mut point = point;
                point[*axis] = -point[*axis];
                point
            }
        }
    }
}

fn turn(axis: usize, degrees: f64) -> Mat3 {
    let (sin, cos) = trunnion_geometry::math::sin_cos(degrees.to_radians());
    let mut turn = Mat3::identity();
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    (turn[(a, a)], turn[(a, b)], turn[(b, a)], turn[(b, b)]) = (cos, -sin, sin, cos);
    turn
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    /// Chains of frames in planes of all six orders: the product of the matrices, outermost first.
    #[test]
    fn chains_of_frames_are_products(order in 0usize..6, angles in [-180i32..180, -180i32..180, -180i32..180],
        frames in prop::collection::vec(Frame::any(), 0..6), point in [-200i32..200, -200i32..200, -200i32..200]) {
        let (mode, axes) = ORDERS[order];
        let [a, b, c] = angles.map(f64::from);
        let mut text = format!("G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\nCYCLE800(0,\"\",0,{mode},7,-8,9,{a},{b},{c},1,2,3,0)\nTRANS\n");
        for frame in &frames {
            let _ = writeln!(text, "{}", frame.text());
        }
        let [x, y, z] = point.map(f64::from);
        let _ = writeln!(text, "G1 X{x} Y{y} Z{z}");
        let inside = frames.iter().rev().fold(Vec3::new(x, y, z), |point, frame| frame.of(point));
        let plane = turn(axes[0], a) * turn(axes[1], b) * turn(axes[2], c);
        let wanted = Vec3::new(7.0, -8.0, 9.0) + plane * (Vec3::new(1.0, 2.0, 3.0) + inside);
        let log = run_text(SIEMENS, &text);
        let motion = log.motions.last().expect("a motion");
        let found = motion.end.xyz().expect("a known end") + Vec3::new(motion.zero[0], motion.zero[1], motion.zero[2]);
        prop_assert!((found - wanted).norm() < 1e-7, "{text}{found} {wanted}");
    }
}
