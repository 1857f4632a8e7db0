//! Paths that a Sinumerik program gives by angles, intermediate points and corners, in frames that turn, scale and mirror. The numbers are
//! worked out by hand.
use crate::support::{faults, lines};

const DIALECT: &str = "sinumerik-840d";

/// What a program does after `G0 X0 Y0 Z0`.
fn after_zero(blocks: &str) -> Vec<String> {
    lines(DIALECT, &format!("G0 X0 Y0 Z0\nF100\n{blocks}\n")).split_off(1)
}

fn is_refused(blocks: &str) {
    let source = format!("G0 X0 Y0 Z0\nF100\n{blocks}\n");
    assert!(!faults(DIALECT, &source).is_empty(), "{blocks}");
}

#[test]
fn polar_coordinates_count_from_the_pole() {
    assert_eq!(
        after_zero("G111 X5 Y5\nG1 AP=90 RP=10\nAP=IC(90)\nG3 AP=270\nG110 X0 Y0\nG1 AP=180 RP=5"),
        [
            "L X5 Y15 Z0 F100",
            "L X-5 Y5 Z0 F100",
            "A(5 5 0; 90) X5 Y-5 Z0 F100",
            "L X0 Y-5 Z0 F100"
        ]
    );
    assert_eq!(after_zero("G111 X1 Y1\nG112 X2 Y3\nG1 AP=0 RP=1"), ["L X4 Y4 Z0 F100"]);
    assert_eq!(after_zero("G18\nG111 X0 Z0\nG1 AP=90 RP=10"), ["L X10 Y0 Z0 F100"]);
    for blocks in [
        "G1 AP=30 RP=10",
        "G111 X0\nG1 AP=30 RP=10",
        "G111 X0 Y0\nG1 AP=30",
        // a new pole takes the radius with it
        "G111 X0 Y0\nG1 AP=10 RP=10\nG111 X0 Y0\nAP=30",
        "G111 X0 Y0\nG1 AP=IC(30) RP=10",
        "G111 X0 Y0\nG1 AP=30 RP=-10",
        "G111 X0 Y0\nG1 AP=30 RP=10 X5",
        "G111 X0 Y0\nTRANS X5\nG1 AP=30 RP=10",
        "G111 X0 Y0\nG91 G1 AP=30 RP=10",
        "G111 X0 Y0\nG1 AP=R1 RP=10",
    ] {
        is_refused(blocks);
    }
}

#[test]
fn arcs_by_their_angle_and_through_a_point() {
    let quarter = ["A(10 0 0; -90) X10 Y10 Z0 F100"];
    assert_eq!(after_zero("G2 X10 Y10 AR=90"), quarter);
    assert_eq!(after_zero("G2 I10 J0 AR=90"), quarter);
    assert_eq!(after_zero("CIP X10 Y10 I1=2.9289321881 J1=7.0710678119"), quarter);
    assert_eq!(
        after_zero("G1 Y1\nY0\nG3 X10 Y10 AR=270")[2..],
        ["A(10 0 0; 270) X10 Y10 Z0 F100"]
    );
    assert_eq!(after_zero("CIP X10 Y0 I1=5 J1=-5"), ["A(5 0 0; 180) X10 Y0 Z0 F100"]);
    assert_eq!(
        after_zero("G1 X10\nCT X20 Y10")[1..],
        ["A(10 10 0; 90) X20 Y10 Z0 F100"]
    );
    // and on from the arc: up along Y, then right about (25, 10)
    assert_eq!(
        after_zero("G1 X10\nCT X20 Y10\nX30 Y10")[2..],
        ["A(25 10 0; -180) X30 Y10 Z0 F100"]
    );
    for blocks in [
        "G2 X10 Y10 AR=360",
        "G2 X10 Y10 I10 AR=90",
        "G2 X10 Y10 CR=10 AR=90",
        "G2 AR=90",
        "G1 X10 AR=90",
        "CIP X10 Y0",
        "CIP X10 Y0 I1=5 J1=0",
        "CIP X10 Y0 I1=5",
        "CIP X10 Y0 I1=5 J1=5 K1=1",
        "CIP X10 Y0 Z5 I1=5 J1=5",
        "G91 CIP X10 Y0 I1=5 J1=5",
        "G2 X10 Y0 I1=5 J1=5",
        "CT X20 Y10",
        "G1 X10\nG0 X20\nCT X30 Y10",
        "G1 X10\nCT X20 Y0",
        "G1 X10 Z5\nCT X20 Y10",
        "G1 X10\nTRANS X5\nCT X20 Y10",
    ] {
        is_refused(blocks);
    }
}

#[test]
fn lines_by_their_angle() {
    assert_eq!(after_zero("G1 ANG=30 X8.6602540378")[0], "L X8.660254 Y5 Z0 F100");
    assert_eq!(after_zero("G1 ANG=135 Y10")[0], "L X-10 Y10 Z0 F100");
    for blocks in [
        "G1 ANG=30",
        "G1 ANG=30 X5 Y5",
        "G1 ANG=90 X5",
        "G1 ANG=30 X-5",
        "G0 ANG=30 X5",
    ] {
        is_refused(blocks);
    }
}

#[test]
fn corners_of_two_lines() {
    let cut = ["L X8 Y0 Z0 F100", "L X10 Y2 Z0 F100", "L X10 Y10 Z0 F100"];
    assert_eq!(after_zero("G1 X10 CHR=2\nY10"), cut);
    // the face of a right angle is the root of 2 longer than its legs
    assert_eq!(after_zero("G1 X10 CHF=2.8284271247\nY10"), cut);
    let round = ["L X8 Y0 Z0 F100", "A(8 2 0; 90) X10 Y2 Z0 F100", "L X10 Y10 Z0 F100"];
    assert_eq!(after_zero("G1 X10 RND=2\nY10"), round);
    assert_eq!(
        after_zero("RNDM=2\nG1 X10\nY10\nZ5\nRNDM=0"),
        [&round[..], &["L X10 Y10 Z5 F100"]].concat()
    );
    // FRC and FRCM are the feed of the corner alone, FRC of one
    let fed = |lines: &[&str]| -> Vec<String> {
        let mut lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
        lines[1] = lines[1].replace("F100", "F40");
        lines
    };
    assert_eq!(after_zero("G1 X10 CHF=2.8284271247 FRC=40\nY10 FRC=40"), fed(&cut));
    assert_eq!(after_zero("G1 X10 RND=2 FRC=40\nY10 FRC=40"), fed(&round));
    assert_eq!(after_zero("FRCM=40\nG1 X10 RND=2\nY10"), fed(&round));
    assert_eq!(after_zero("RNDM=2 FRCM=40\nG1 X10\nY10\nRNDM=0 FRCM=0"), fed(&round));
    assert_eq!(after_zero("FRCM=30\nG1 X10 RND=2 FRC=40\nY10 FRC=40"), fed(&round));
    assert_eq!(after_zero("FRCM=30\nFRCM=0\nG1 X10 RND=2\nY10"), round);
    // which of both blocks gives the feed is machine data; the path is the same
    for blocks in [
        "G1 X10 RND=2 FRC=40\nY10",
        "G1 X10 RND=2\nY10 FRC=40",
        "FRCM=40\nG1 X10 RND=2\nY10 FRC=50",
    ] {
        is_refused(blocks);
        let unfed: Vec<String> = fed(&round).iter().map(|line| line.replace(" F40", "")).collect();
        assert_eq!(after_zero(blocks), unfed, "{blocks}");
    }
    assert_eq!(
        after_zero("G1 X10 FRC=40\nY10"),
        ["L X10 Y0 Z0 F100", "L X10 Y10 Z0 F100"]
    );
    // a motion along Z has no corner in the plane
    assert_eq!(after_zero("G1 X10 RND=2\nZ5"), ["L X10 Y0 Z0 F100", "L X10 Y0 Z5 F100"]);
    for blocks in [
        "G1 X10 RND=20\nY10",
        "G1 X10 RND=2\nY10 F50",
        "G1 X10 RND=2\nM8\nY10",
        "G1 X10 RND=2\nM8 Y10",
        "G1 X10 RND=2\nG0 Y10",
        "G1 X10 RND=2\nG2 X20 Y10 I10 J0",
        "G1 X10 RND=2 CHR=2\nY10",
        "G1 X10 RND=2 FRC=0\nY10",
        "FRCM=-1\nG1 X10 RND=2\nY10",
        "FRCM=R1\nG1 X10 RND=2\nY10",
        "G1 X10 RND=-2\nY10",
        "G1 X10 RND=R1\nY10",
        "RNDM=2\nG1 X10\nRNDM=0\nY10",
    ] {
        is_refused(blocks);
    }
}

#[test]
fn frames_chain() {
    assert_eq!(after_zero("TRANS X5\nAROT Z90\nG1 X10 Y0")[0], "L X0 Y10 Z0 F100");
    let turned = |blocks: &str| {
        let source = format!("G0 X0 Y0 Z0\nF100\n{blocks}\nSUPA G0 Z0\n");
        let log = crate::support::run_text(DIALECT, &source);
        let [.., before, _] = log.motions[..] else {
            panic!("{blocks}")
        };
        let place = |axis: usize| ((before.end.values[axis] + before.zero[axis]) * 1e6).round() / 1e6;
        [place(0), place(1)]
    };
    // TRANS, then turned; turned, then shifted along the turned axis
    assert_eq!(turned("TRANS X5\nAROT Z90\nG1 X10 Y0"), [5.0, 10.0]);
    assert_eq!(turned("ROT Z90\nATRANS X5\nG1 X10 Y0"), [0.0, 15.0]);
    // each of them replaces what is there
    assert_eq!(turned("TRANS X5\nROT Z90\nG1 X10 Y0"), [0.0, 10.0]);
    assert_eq!(turned("ROT Z90\nTRANS X5\nG1 X10 Y0"), [15.0, 0.0]);
    assert_eq!(turned("ROT RPL=30\nAROT Z60\nG1 X10 Y0"), [0.0, 10.0]);
    assert_eq!(turned("SCALE X2\nATRANS X5\nG1 X10 Y3"), [30.0, 3.0]);
    assert_eq!(turned("TRANS X5\nASCALE X2\nG1 X10 Y3"), [25.0, 3.0]);
    assert_eq!(turned("MIRROR X0\nAROT Z90\nG1 X10 Y0"), [0.0, 10.0]);
    assert_eq!(turned("ROT Z90\nAMIRROR X0\nG1 X10 Y0"), [0.0, -10.0]);
    // a mirror changes the sense of an arc, a scale its size
    assert_eq!(
        after_zero("MIRROR X0\nG2 X10 Y10 CR=10"),
        ["A(-10 0 0; 90) X-10 Y10 Z0 F100"]
    );
    assert_eq!(
        after_zero("SCALE X2 Y2 Z2\nG2 X10 Y10 I10 J0"),
        ["A(20 0 0; -90) X20 Y20 Z0 F100"]
    );
    // in a plane of which no coordinate was given since it turned, the other one is not known, except at the centre
    assert_eq!(after_zero("ROT Z90\nG1 X10"), ["L X0 Y10 Z0 F100"]);
    assert_eq!(after_zero("G1 Y5\nROT Z90\nG1 X10")[1..], ["L Y10 Z0 F100"]);
    for blocks in [
        "ROT Z30 X10\nX5 Y5",
        "ROT RPL=R1\nX5 Y5",
        "SCALE X=R1\nX5 Y5",
        "SCALE C2\nX5 Y5",
        "SCALE X2 Y1\nG2 X10 Y10 I10 J0",
    ] {
        let known = after_zero(blocks)
            .iter()
            .all(|line| line.contains('X') && !line.contains("A?"));
        assert!(!known, "{blocks}");
    }
}

#[test]
fn turns_about_several_axes_name_the_machine_data() {
    for block in ["ROT X10 Z20", "AROT X1 Y2 Z3"] {
        let found = faults(
            "sinumerik-840d",
            &format!("G17 G90 G71\nG1 X0 Y0 Z0 F9\n{block}\nX5 Y5 Z5\nROT\nX1 Y1 Z1\n"),
        );
        assert!(
            found.len() == 1 && found[0].contains("machine data 10600"),
            "{block}: {found:?}"
        );
    }
}

/// Whether an increment adds the change of a frame is setting data 42440.
#[test]
fn an_increment_after_a_frame_is_not_known() {
    for (frame, axis) in [
        ("TRANS X5", "Y"),
        ("ATRANS X5", "Y"),
        ("ROT Z90", "X"),
        ("MIRROR X0", "Y"),
        ("SCALE X2", "Y"),
    ] {
        let first = after_zero(&format!("{frame}\nG91 G1 X10\nG90 X3 Y3")).remove(0);
        assert_eq!(first, format!("L {axis}0 Z0 F100"), "{frame}");
        let first = after_zero(&format!("{frame}\nG1 X=IC(10)\nX3 Y3")).remove(0);
        assert_eq!(first, format!("L {axis}0 Z0 F100"), "{frame}");
        let first = after_zero(&format!("{frame}\nG91 G1 X=AC(10) Y=AC(5)")).remove(0);
        assert!(first.contains('X') && first.contains('Y'), "{frame}: {first}");
    }
}

#[test]
fn fields_have_values() {
    let source = "DEF REAL A_1[4]=SET(1,,3)\nDEF INT I_1[3]=REP(2.6)\nDEF INT N_1=2\nA_1[1]=7 I_1[N_1]=9\nG0 X=A_1[0] Y=A_1[1] Z=A_1[N_1]\nX=I_1[0] Y=I_1[2] Z=A_1[3]\nA_1[1]=SET(4,5)\nX=A_1[1] Y=A_1[2]\n";
    assert_eq!(lines(DIALECT, source), ["R X1 Y7 Z3", "R X3 Y9 Z0", "R X4 Y5 Z0"]);
    assert_eq!(faults(DIALECT, source), [""; 0]);
    for lost in [
        "A_1[9]=1",
        "A_1[R1]=1",
        "A_1[1]=SET(1,2,3,4)",
        "A_1[0]=R1",
        "A_1=SET(5,6)",
    ] {
        let source = format!("DEF REAL A_1[3]=SET(1,2,3)\n{lost}\nG0 X=A_1[0]\n");
        assert_eq!(lines(DIALECT, &source), ["R -"], "{lost}");
    }
    assert_eq!(
        lines(DIALECT, "DEF REAL A_1[2,2]=SET(1,2,3,4)\nG0 X=A_1[0,1]\n"),
        ["R X2"]
    );
}
