//! Frames of a Sinumerik that turn out of the plane, alone and under TRAORI, and the forms of TRAORI. The numbers are worked out by hand.
use crate::support::{faults, line, run_bytes, run_text};
use trunnion_geometry::Vec3;
use trunnion_interp::{Motion, MotionKind, Orientation, Setup};

const NAME: &str = "sinumerik-840d";
const HEAD: &str = "G17 G90 G71 G94 F100\nG1 X0 Y0 Z0\n";

fn after(blocks: &str) -> Vec<Motion> {
    run_text(NAME, &format!("{HEAD}{blocks}\n")).motions[1..].to_vec()
}

fn place(motion: &Motion) -> Option<[f64; 3]> {
    let end = motion.end.xyz()?;
    Some([0, 1, 2].map(|axis| ((end[axis] + motion.zero[axis]) * 1e9).round() / 1e9 + 0.0))
}

#[test]
fn a_turn_out_of_the_plane() {
    for (blocks, wanted) in [
        ("ROT X90\nX10 Y5 Z2", [10.0, -2.0, 5.0]),
        ("ROT Y90\nX10 Y5 Z2", [2.0, 5.0, -10.0]),
        // chained to the right; the shift lies in the turned axes
        ("ROT Z90\nAROT X90\nX10 Y5 Z2", [2.0, 10.0, 5.0]),
        ("TRANS X1 Y2 Z3\nAROT X90\nX10 Y5 Z2", [11.0, 0.0, 8.0]),
        ("ROT X90\nATRANS X1 Y2 Z3\nX10 Y5 Z2", [11.0, -5.0, 7.0]),
        ("ROT X90\nAROT X-90\nX10 Y5 Z2", [10.0, 5.0, 2.0]),
        // each word without A replaces all
        ("ROT X90\nTRANS X1\nX10 Y5 Z2", [11.0, 5.0, 2.0]),
        ("ROT X90\nROT Y90\nX10 Y5 Z2", [2.0, 5.0, -10.0]),
        ("ROT X90\nROT\nX10 Y5 Z2", [10.0, 5.0, 2.0]),
        ("$P_PFRAME=CTRANS(X,1):CROT(X,90)\nX10 Y5 Z2", [11.0, -2.0, 5.0]),
        ("ROT X90\n$P_PFRAME=CTRANS()\nX10 Y5 Z2", [10.0, 5.0, 2.0]),
        ("ROTS X90\nX10 Y5 Z2", [10.0, -2.0, 5.0]),
    ] {
        let found = after(blocks);
        assert_eq!(place(&found[0]), Some(wanted), "{blocks}");
        assert_eq!(
            found[0].tilt.normal, None,
            "{blocks}: the tool need not stand on the plane"
        );
        let said = faults(NAME, &format!("{HEAD}{blocks}\n"));
        assert_eq!(said, [""; 0], "{blocks}");
    }
}

/// The words of the next block count from the frame; what it does not name is not known. Machine coordinates are not turned.
#[test]
fn what_the_next_block_does_not_name() {
    let found = after("Z5\nROT X90\nX10\nX11 Y1 Z2\nROT\nX1\nX2 Y3 Z4");
    assert_eq!(place(&found[1]), None);
    assert_eq!(place(&found[2]), Some([11.0, -2.0, 1.0]));
    assert_eq!(place(&found[3]), None);
    assert_eq!(place(&found[4]), Some([2.0, 3.0, 4.0]));
    let found = after("ROT X90\nX1 Y1 Z1\nSUPA G0 Z100\nG1 X1 Y2 Z3");
    assert!(
        found[1].machine_coordinates && found[1].end.get(2) == Some(100.0),
        "{:?}",
        found[1]
    );
    assert_eq!(place(&found[2]), Some([1.0, -3.0, 2.0]));
}

#[test]
fn arcs_and_holes_in_a_turned_plane() {
    let found = after("ROT X90\nX10 Y0 Z0\nG3 X0 Y10 CR=10");
    let MotionKind::Arc(Some(arc)) = found[1].kind else {
        panic!("{:?}", found[1].kind)
    };
    assert!(
        (arc.normal - Vec3::new(0.0, -1.0, 0.0)).norm() < 1e-12,
        "{}",
        arc.normal
    );
    assert!((arc.sweep.to_degrees() - 90.0).abs() < 1e-9);
    assert_eq!(place(&found[1]), Some([0.0, 0.0, 10.0]));
    let found = after("ROT X90\nG0 X3 Y4 Z50\nCYCLE81(10,0,2,-5)");
    let ends: Vec<_> = found[1..].iter().map(|motion| place(motion).expect("known")).collect();
    assert_eq!(ends, [[3.0, -2.0, 4.0], [3.0, 5.0, 4.0], [3.0, -10.0, 4.0]]);
}

/// Under TRAORI positions of the tip and vectors are those of the frame.
#[test]
fn frames_under_tip_control() {
    for blocks in ["TRAORI\nROT X90", "ROT X90\nTRAORI", "TRAORI\n$P_PFRAME=CROT(X,90)"] {
        let found = after(&format!("{blocks}\nX10 Y5 Z2 A3=0 B3=0 C3=1"));
        assert_eq!(place(&found[0]), Some([10.0, -2.0, 5.0]), "{blocks}");
        let Orientation::Vector(_, tool) = found[0].orientation else {
            panic!("{blocks}")
        };
        assert!(
            (tool - Vec3::new(0.0, -1.0, 0.0)).norm() < 1e-12 && found[0].tcp,
            "{tool}"
        );
    }
    let found = after("TRAORI\nROT Z90\nX10 Y5 Z2 A10 C20");
    assert_eq!(line(&found[0]), "L X-5 Y10 Z2 A10 C20 F100 tcp");
    let found = after("ROT Z90\nTRAORI\nX10 Y5 Z2 A10 C20\nTRAFOOF\nROT\nX1 Y2 Z3");
    assert_eq!(place(&found[0]), Some([-5.0, 10.0, 2.0]));
    assert_eq!(place(&found[1]), Some([1.0, 2.0, 3.0]));
}

/// What is not followed is said, and no position passes for known.
#[test]
fn frames_that_stay_unknown() {
    for blocks in [
        "SCALE X2\nAROT X90",
        "MIRROR X0\nAROT X90",
        "ROT X90\nATRANS C5",
        "ROT X90 Y10",
        "ROTS X10 Y20 Z30",
        "G41 D1 X5 Y5\nAROT X90",
        "CYCLE800(0,\"T\",0,57,0,0,0,10,0,0,0,0,0,0)\nAROT X90",
        "ROT X90\nCYCLE800(0,\"T\",0,57,0,0,0,10,0,0,0,0,0,0)",
    ] {
        let found = after(&format!("{blocks}\nX10 Y5 Z2"));
        assert_eq!(found.last().and_then(place), None, "{blocks}");
        assert!(
            !faults(NAME, &format!("{HEAD}{blocks}\nX10 Y5 Z2\n")).is_empty(),
            "{blocks}"
        );
    }
    // CYCLE800() ends the swivelled plane, not the frame of the program
    let found = after("ROT X90\nCYCLE800()\nX10 Y5 Z2");
    assert_eq!(found.last().and_then(place), Some([10.0, -2.0, 5.0]));
}

/// TRAORI(n, x, y, z, a, b): the first transformation with the direction that the tool has at home.
#[test]
fn forms_of_traori() {
    let tip = |form: &str| {
        let text = format!("{HEAD}{form}\nX1 Y2 Z3 A10 C20\n");
        (
            run_text(NAME, &text).motions[1].end.xyz().is_some(),
            faults(NAME, &text).is_empty(),
        )
    };
    for form in [
        "TRAORI",
        "TRAORI()",
        "TRAORI(1)",
        "TRAORI(1,0,0,1)",
        "TRAORI(,0,0,5)",
        "TRAORI(1,,,1,0,0)",
    ] {
        assert_eq!(tip(form), (true, true), "{form}");
    }
    for form in [
        "TRAORI(2)",
        "TRAORI(1,0,1,0)",
        "TRAORI(1,0,1,1)",
        "TRAORI(1,0,0,-1)",
        "TRAORI(1,0,0,0)",
        "TRAORI(1,0,0,1,5)",
        "TRAORI(1,0,0,R1)",
    ] {
        assert_eq!(tip(form), (false, false), "{form}");
    }
    // a machine whose tool lies along Y at home
    let mut setup = Setup::default();
    setup.control.length_along = Some([0.0, 1.0, 0.0]);
    let text = format!("{HEAD}TRAORI(1,0,1,0)\nX1 Y2 Z3 A10 C20\n");
    assert!(
        run_bytes(NAME, text.as_bytes(), &setup).1.motions[1]
            .end
            .xyz()
            .is_some()
    );
}

/// A2 turns about Z, B2 about the new X; C2 turns about the tool. So it is under ORIEULER alone.
#[test]
fn orientation_by_euler_angles() {
    let vector = |blocks: &str| -> Option<[f64; 3]> {
        let text = format!("G17 G90 G71 F100\nTRAORI\nG1 X0 Y0 Z0 A3=0 B3=0 C3=1\n{blocks}\nM30\n");
        let motions = run_text(NAME, &text).motions;
        match motions.last().expect("a motion").orientation {
            trunnion_interp::Orientation::Vector(_, vector) => Some(vector.into()),
            trunnion_interp::Orientation::Words => None,
        }
    };
    for (angles, wanted) in [
        ("A2=90 B2=30", [0.5, 0.0, 0.75f64.sqrt()]),
        ("A2=90 B2=30 C2=77", [0.5, 0.0, 0.75f64.sqrt()]),
        ("A2=0 B2=90", [0.0, -1.0, 0.0]),
        ("A2=-90 B2=90", [-1.0, 0.0, 0.0]),
        ("A2=45 B2=0", [0.0, 0.0, 1.0]),
    ] {
        let found = vector(&format!("ORIEULER\nG1 X1 Y2 Z3 {angles}")).expect("a vector");
        assert!(
            (0..3).all(|at| (found[at] - wanted[at]).abs() < 1e-9),
            "{angles}: {found:?}"
        );
        let text = format!("G17 G90 G71 F100\nTRAORI\nORIEULER G1 X1 Y2 Z3 {angles}\nM30\n");
        assert_eq!(faults(NAME, &text), [] as [String; 0], "{angles}");
    }
    // what is not ORIEULER, not both angles, not plain, or beside a vector
    for blocks in [
        "G1 X1 A2=90 B2=30",
        "ORIEULER\nORIRPY\nG1 X1 A2=90 B2=30",
        "ORIEULER\nORIRPY2\nG1 X1 A2=90 B2=30",
        "ORIEULER\nG1 X1 A2=90",
        "ORIEULER\nG1 X1 B2=90 C2=1",
        "ORIEULER\nG1 X1 A2=IC(90) B2=30",
        "ORIEULER\nG1 X1 A2=R77 B2=30",
        "ORIEULER\nG1 X1 A2=90 B2=30 C3=1",
    ] {
        let text = format!("G17 G90 G71 F100\nTRAORI\nG1 X0 Y0 Z0\n{blocks}\nM30\n");
        assert!(
            faults(NAME, &text).iter().any(|fault| fault.contains("NotModelled")),
            "{blocks}"
        );
        let last = run_text(NAME, &text).motions.last().map(|motion| motion.end.xyz());
        assert_eq!(last, Some(None), "{blocks}");
    }
}
