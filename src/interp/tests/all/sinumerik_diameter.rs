//! DIAMON, DIAM90 and DIAMOF: what X words are, with and without a machine whose X words are diameters.
use crate::support::{fault_line, line, run_bytes};
use trunnion_interp::{Motion, Setup};

const HEAD: &str = "G18 G90 G94 G710 F100\n";

/// Motions and what was reported.
fn run(text: &str, (declared, diameters): (bool, bool)) -> (Vec<Motion>, Vec<String>) {
    let mut setup = Setup::default();
    (setup.control.axes_declared, setup.control.x_diameter) = (declared, diameters);
    let (program, log) = run_bytes("sinumerik-840d", format!("{HEAD}{text}").as_bytes(), &setup);
    let told = log.faults.iter().map(|fault| fault_line(&program, fault));
    (
        log.motions,
        told.filter(|fault| fault.contains("NotModelled")).collect(),
    )
}

fn lines(text: &str) -> Vec<String> {
    run(text, (false, false)).0.iter().map(line).collect()
}

#[test]
fn x_words_become_radii() {
    for (text, expected) in [
        ("DIAMON\nG1 X40 Z2", "L X20 Z2 F100"),
        ("G1 DIAMON X40 Z2", "L X20 Z2 F100"),
        ("DIAM90\nG1 X40 Z2", "L X20 Z2 F100"),
        ("DIAMON\nDIAMOF\nG1 X40 Z2", "L X40 Z2 F100"),
        ("DIAMON\nG1 X=AC(40) Z2", "L X20 Z2 F100"),
        ("DIAMON\nR1=40\nG1 X=R1 Z2", "L X20 Z2 F100"),
    ] {
        assert_eq!(lines(text), [expected], "{text}");
    }
}

#[test]
fn distances_are_diameters_under_diamon_and_radii_under_diam90() {
    for (code, by) in [("DIAMON", 5.0), ("DIAM90", 10.0), ("DIAMOF", 10.0)] {
        for distance in ["X=IC(10)", "G91 X10"] {
            let text = format!("G1 X0 Z0\n{code}\n{distance}");
            let (motions, told) = run(&text, (false, false));
            assert_eq!((motions[1].end.get(0), told), (Some(by), vec![]), "{text}");
        }
    }
    // AC() under G91, and G91 in the block
    let (motions, _) = run("G1 X0 Z0\nDIAM90 G91\nX=AC(10)", (false, false));
    assert_eq!(motions[1].end.get(0), Some(5.0));
}

#[test]
fn arcs_in_the_plane_of_a_lathe() {
    // about (Z 0, X 10), with Y unknown
    let expected =
        ["R X10 Z10", "A(10 0 0; 90) X20 Z0 F100"].map(|line| line.replace("A(10 0 0; 90)", "A(10 0 0; -90)"));
    for arc in ["G3 X40 Z0 I0 K-10", "G3 X40 Z0 CR=10"] {
        let found = lines(&format!("DIAMON\nG0 X20 Z10\n{arc}"));
        assert_eq!(found[0], expected[0]);
        assert!(
            found[1].starts_with("A(10 0 0;") && found[1].contains("X20 Z0"),
            "{found:?}"
        );
    }
}

#[test]
fn a_machine_says_whether_x_counts_diameters() {
    let text = "G1 X40 Z2\nDIAMOF\nG1 Z3\nX40\n";
    // it counts them: the place is as written until a code of the program, then a radius
    let (motions, told) = run(text, (true, true));
    let ends: Vec<_> = motions.iter().map(|motion| (motion.end.get(0), motion.radii)).collect();
    assert_eq!(ends, [(Some(40.0), false), (None, true), (Some(40.0), true)]);
    assert_eq!(told, [""; 0]);
    // it does not: DIAMON is not followed
    let (motions, told) = run("DIAMON\nG1 X40 Z2\nDIAMOF\nX40 Z2\n", (true, false));
    let ends: Vec<_> = motions.iter().map(|motion| motion.end.get(0)).collect();
    assert_eq!((ends, told.len()), (vec![None, Some(40.0)], 1), "{told:?}");
}

#[test]
fn other_values_of_x_are_unknown_by_name() {
    for (text, what) in [
        ("DIAMON\nDIAMCYCOF\nG1 X40 Z2", "DIAMCYCOF"),
        ("DIAMON\nTRANS X10\nG1 X40 Z2", "X of TRANS"),
        ("DIAMON\nATRANS X10\nG1 X40 Z2", "X of ATRANS"),
        ("DIAMON\nG111 X10 Z0\nG1 AP=0 RP=5", "X of G111"),
        ("DIAMON\nG0 X20 Z10\nG3 X40 Z0 I=AC(20) K=AC(0)", "I=AC()"),
        ("G0 X0 Y0 Z0\nDIAMON\nPOLY PO[X]=(40,1)", "X of POLY"),
        ("DIAMON\nG0 X20 Z10\nR1=$P_EP[X]\nG1 X=R1", "R1"),
        ("DIAMON\nG17\nG0 X20 Y0 Z10\nHOLES1(0,0,0,5,10,3)", "HOLES1"),
        ("DIAMON\nG19\nG0 X20 Y0 Z10\nCYCLE81(20,10,1,-5)", "CYCLE81"),
    ] {
        let (motions, told) = run(text, (false, false));
        assert!(told.iter().any(|told| told.contains(what)), "{text}: {told:?}");
        let last = motions.last().expect("a motion");
        assert!(
            last.end.get(0).is_none() || format!("{:?}", last.kind).contains("None"),
            "{text}: {last:?}"
        );
    }
    for fine in [
        "DIAMON\nTRANS X0 Z5\nG1 X40 Z2",
        "DIAMON\nMIRROR X0\nG1 X40 Z2",
        "DIAMON\nTRANS X10\nDIAMOF\nTRANS\nG1 X40 Z2",
    ] {
        let (motions, _) = run(fine, (false, false));
        assert!(
            motions.last().is_some_and(|motion| motion.end.get(0).is_some()),
            "{fine}"
        );
    }
}
