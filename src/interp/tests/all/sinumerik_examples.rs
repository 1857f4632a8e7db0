//! Worked examples of Sinumerik manuals and of interpreters that were run, each as the smallest program that shows it. What the interpreters
//! answer and no manual states stays unknown.
use crate::support::{faults, line, lines, run_bytes, run_text};
use trunnion_interp::{FrameAngles, Posture, Setup, Swivel};

const NAME: &str = "sinumerik-840d";

/// X of the last motion of a program, and whether all is known.
fn x_of(program: &str) -> (Option<f64>, usize) {
    let text = format!("G90 G71 G1 X-999 F100\n{program}\n");
    let end = run_text(NAME, &text)
        .motions
        .last()
        .and_then(|motion| motion.end.get(0));
    (
        end,
        faults(NAME, &text)
            .iter()
            .filter(|fault| fault.contains("NotModelled"))
            .count(),
    )
}

/// Priority of the operations: a comparison binds weakest (five editions of the programming manual, 2000 to 2019).
#[test]
fn priority_of_the_operations() {
    for (expression, value) in [
        ("5 > 3 AND 2 > 1", 0.0),
        ("1 OR 0 AND 0", 1.0),
        ("6 B_OR 1 B_AND 0", 6.0),
        ("2+6 DIV 4", 3.0),
        ("1+7 MOD 4", 4.0),
        ("2+3*4", 14.0),
        ("-7 DIV 2", -3.0),
        ("-7 MOD 4", -3.0),
        ("ROUND(-2.5)", -3.0),
        ("TRUNC(-2.7)", -2.0),
        ("ATAN2(1,-1)", 135.0),
        ("NOT 0 + 2", 3.0),
        ("'H1F' + 'B1011'", 42.0),
        (".1EX1", 1.0),
    ] {
        let (x, unknown) = x_of(&format!("R1={expression}\nX=R1"));
        assert!(
            x.is_some_and(|x| (x - value).abs() < 1e-12) && unknown == 0,
            "{expression}: {x:?}"
        );
    }
}

#[test]
fn loops_and_jumps() {
    for (program, x) in [
        // the counter is one past its last value, and a loop from 3 to 1 never runs
        ("FOR R1=1 TO 3\nENDFOR\nX=R1", 4.0),
        ("R2=7\nFOR R1=3 TO 1\nR2=8\nENDFOR\nX=R2", 7.0),
        // labels may be built twice: the nearest in the direction of the search
        ("R1=0\nAA: R1=R1+1\nIF R1<3 GOTOB AA\nX=R1", 3.0),
        ("GOTOF AA\nX1\nAA: X2\nGOTOF BB\nAA: X3\nBB: Y1", 2.0),
        // a target that is missing matters only where it is jumped to
        ("IF 0 GOTOF NOWHERE\nX4", 4.0),
        ("GOTOC NOWHERE\nX5", 5.0),
        (
            "R1=2\nCASE(R1) OF 1 GOTOF AA 2 GOTOF BB DEFAULT GOTOF CC\nAA: X1\nBB: X2\nCC: Y1",
            2.0,
        ),
        // a target that is built
        ("R1=7\nGOTOF \"AA\"<<R1\nX1\nAA7: X8", 8.0),
        ("R1=10\nGOTOF \"N\"<<R1*2\nX1\nN20 X9", 9.0),
        ("DEF INT I1=2\nGOTOF \"AA\"<<\"B\"<<I1\nX1\nAAB2: X3", 3.0),
        ("R1=9\nCASE(R1) OF 1 GOTOF AA\nX6\nGOTOF CC\nAA: X1\nCC: Y1", 6.0),
        // ENDLABEL ends the section; once more by default
        ("R1=0\nAA: R1=R1+1\nENDLABEL:\nR2=1\nREPEAT AA P=3\nX=R1", 4.0),
        ("R1=0\nAA: R1=R1+1\nREPEATB AA\nX=R1", 2.0),
        ("R1=0\nAA: R1=R1+1\nBB: R1=R1+10\nREPEAT AA BB P=2\nX=R1", 33.0),
        ("R1=0\nLOOP\nR1=R1+1\nIF R1>4 GOTOF OUT\nENDLOOP\nOUT: X=R1", 5.0),
        ("R1=0\nREPEAT\nR1=R1+1\nUNTIL R1>=3\nX=R1", 3.0),
        ("R1=0\nWHILE R1<5\nR1=R1+2\nENDWHILE\nX=R1", 6.0),
    ] {
        let (found, unknown) = x_of(program);
        assert_eq!((found, unknown), (Some(x), 0), "{program}");
    }
}

/// What a target is built from must be known, and whole.
#[test]
fn a_target_that_is_not_known_is_not_decided() {
    for target in ["\"AA\"<<R99", "\"AA\"<<R1", "R1"] {
        let text = format!("G1 X1 F9\nR1=1.5\nGOTOF {target}\nX2\nAA1: X3\n");
        assert_eq!(lines(NAME, &text).len(), 1, "{target}");
        assert!(!faults(NAME, &text).is_empty(), "{target}");
    }
}

/// Words that move an axis, couple one, or end the motion at a signal are not taken for variables of the program.
#[test]
fn words_that_move_an_axis_are_said() {
    for block in [
        "AX[SP1]=7",
        "POS[X]=50",
        "X1 POSA[Y]=5",
        "POSP[X]=(5,1,0)",
        "MOV[X]=1",
        "OS[X]=1",
        "FXS[X]=1 X5",
        "MEAS=1 X5",
        "MEASA[X]=(1,1) X5",
    ] {
        let text = format!("G1 X0 Y0 Z0 F9\n{block}\nY5\n");
        assert!(
            faults(NAME, &text).iter().any(|fault| fault.contains("NotModelled")),
            "{block}"
        );
        assert!(
            run_text(NAME, &text).motions.last().expect("one").end.xyz().is_none(),
            "{block}"
        );
    }
}

/// Fields: SET fills row by row and keeps what it leaves out, REP repeats.
#[test]
fn fields() {
    for (program, x) in [
        ("DEF REAL A[10,3]=SET(0,,,9,0,1,2,-10,-11,-12,-20)\nX=A[1,0]", 9.0),
        ("DEF REAL A[10,3]=SET(0,,,9,0,1,2,-10,-11,-12,-20)\nX=A[3,1]", -20.0),
        ("DEF INT A[2,3,4]=REP(1,24)\nX=A[1,2,3]", 1.0),
        ("DEF INT B=1\nX=B", 1.0),
    ] {
        assert_eq!(x_of(program), (Some(x), 0), "{program}");
    }
}

/// A frame of one angle; of several the order is machine data, so it is not known unless that is declared. Declared, angles read back in their
/// ranges (function manual).
#[test]
fn frames() {
    assert_eq!(x_of("$P_PFRAME=CTRANS(X,5):CMIRROR(X)\nX1").1, 0);
    let mut setup = Setup::default();
    setup.control.frame_angles = Some(FrameAngles::RollPitchYaw);
    for (value, read) in [
        ("CROT(X,10,Y,90,Z,40)", [0.0, 90.0, 30.0]),
        ("CROT(X,190,Y,0,Z,-200)", [-170.0, 0.0, 160.0]),
    ] {
        let text = format!(
            "G1 X0 Y0 Z0 F9\n$P_PFRAME={value}\nR1=$P_PFRAME[X,RT] R2=$P_PFRAME[Y,RT] R3=$P_PFRAME[Z,RT]\nTRANS\nX=R1 Y=R2 Z=R3\nM30\n"
        );
        let log = run_bytes(NAME, text.as_bytes(), &setup).1;
        let found: [f64; 3] = log.motions[1].end.xyz().expect("known").into();
        assert!(
            (0..3).all(|axis| (found[axis] - read[axis]).abs() < 1e-9),
            "{value}: {found:?}"
        );
    }
    for value in ["CROT(X,10,Y,90,Z,40)", "CROT(X,190,Y,0,Z,-200)"] {
        let text = format!("G1 X0 Y0 Z0 F9\n$P_PFRAME={value}\nX1 Y1 Z1\n");
        assert!(faults(NAME, &text).iter().any(|fault| fault.contains(value)), "{value}");
        assert!(run_text(NAME, &text).motions[1].end.xyz().is_none(), "{value}");
    }
}

/// CYCLE800 against G68.2 with the Euler angles of the same matrix (shared pairs of programs).
#[test]
fn swivelled_planes() {
    for (cycle, euler) in [
        ("27,0,0,0,0,0,30", "I0. J30. K0."),
        ("57,0,0,0,0,-15,0", "I-90. J15. K90."),
        ("57,0,0,0,90,-15,0", "I-15. J90. K0."),
        ("57,0,0,0,0,-90,0", "I-90. J90. K90."),
    ] {
        let points = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [3.0, -4.0, 25.0]];
        let own = format!("G17 G90 G71 F100\nG0 X0 Y0 Z0\nCYCLE800(0,\"T\",0,{cycle},0,0,0,-1)\n");
        let fanuc = format!("G17 G90 G21 G54 F100.\nG0 X0. Y0. Z0.\nG68.2 X0. Y0. Z0. {euler}\n");
        let ends = |dialect: &str, start: &str| -> Vec<[f64; 3]> {
            let mut moves = String::new();
            for [x, y, z] in points {
                moves += &format!("G1 X{x:.1} Y{y:.1} Z{z:.1}\n");
            }
            let motions = run_text(dialect, &format!("{start}{moves}")).motions;
            motions
                .iter()
                .filter(|motion| motion.is_feed())
                .map(|motion| motion.end.xyz().unwrap_or_else(|| panic!("{start}")).into())
                .collect()
        };
        let (one, two) = (ends(NAME, &own), ends("fanuc-30i", &fanuc));
        assert_eq!(one.len(), 4);
        for (one, two) in one.iter().zip(&two) {
            assert!(
                (0..3).all(|i| (one[i] - two[i]).abs() < 1e-9),
                "{cycle}: {one:?} and {two:?}"
            );
        }
    }
}

/// `TU='B010011'` is 19: the bits of axes 1, 2 and 5.
#[test]
fn bits_of_turns() {
    for tu in ["19", "'B010011'", "'H13'"] {
        let text = format!("TRAORI\nG0 X0 Y0 Z0 A0 C0\nPTP\nG0 X1 A10 C20 TU={tu}\n");
        let motions = run_text(NAME, &text).motions;
        let tilt = &motions.last().expect("a motion").tilt;
        assert_eq!(tilt.swivel, Swivel::PointToPoint, "{tu}");
        assert_eq!(
            tilt.posture,
            Posture::Bits {
                status: None,
                turn: Some(19)
            },
            "{tu}"
        );
    }
}

/// A quarter of a circle as a rational polynomial: lines within a bound that they carry.
#[test]
fn a_quarter_circle_as_a_polynomial() {
    let text = "G17 G90 G71 G1 X10 Y0 Z0 F100\nPOLY PO[X]=(0,-10) PO[Y]=(10) PO[]=(2,1)\n";
    let motions = run_text(NAME, text).motions;
    let curve = &motions[1..];
    assert_eq!(
        curve.last().and_then(|motion| motion.end.xyz()),
        Some([0.0, 10.0, 0.0].into())
    );
    let mut way = 0.0;
    for motion in curve {
        let (from, to) = (motion.start.xyz().expect("known"), motion.end.xyz().expect("known"));
        assert!((to.norm() - 10.0).abs() < 1e-9 && motion.is_feed(), "{to}");
        way += (to - from).norm();
    }
    assert!((way - 5.0 * core::f64::consts::PI).abs() < 1e-4, "{way}");
    assert!(curve.iter().all(|motion| motion.slack_mm == 1e-5) && motions[0].slack_mm == 0.0);
    assert_eq!(faults(NAME, text), [] as [String; 0]);
    // where coordinates grow, so does the bound; turned and mirrored ones keep it
    for (frame, slack) in [
        ("SCALE X2 Y2 Z2", 2e-5 * 3f64.sqrt()),
        ("ROT RPL=30", 1e-5),
        ("MIRROR X0", 1e-5),
    ] {
        let text = text.replace("POLY", &format!("{frame}\nPOLY"));
        let motions = run_text(NAME, &text).motions;
        let last = motions.last().expect("a motion");
        assert!((last.slack_mm - slack).abs() < 1e-12, "{frame}: {}", last.slack_mm);
    }
    // X goes to 12.96 and back to 10: the lines turn back with it
    let text = "G17 G90 G71 G1 X0 Y0 Z0 F100\nPOLY PO[X]=(10,-26)\nG1 Y1\n";
    let most = run_text(NAME, text)
        .motions
        .iter()
        .filter_map(|motion| motion.end.xyz())
        .map(|end| end.x)
        .fold(0.0, f64::max);
    assert!((most - 36.0 * 36.0 / (4.0 * 26.0)).abs() < 1e-4, "{most}");
    // axes without PO are linear, and a block without any PO is a line
    let text = "G17 G90 G71 G1 X0 Y0 Z0 F100\nPOLY PO[X]=(9,-1,0,0) Y3 PL=3\nX20 Y5\nG1 X0\n";
    let motions = run_text(NAME, text).motions;
    let at = |place: f64| {
        let near = motions.iter().filter_map(|motion| motion.end.xyz());
        near.min_by(|a, b| (a.y - place).abs().total_cmp(&(b.y - place).abs()))
            .expect("one")
    };
    // x = 6 p - p^2 over 0..3, y = p
    assert!(
        (at(1.5).x - (6.0 * at(1.5).y - at(1.5).y.powi(2))).abs() < 1e-9,
        "{}",
        at(1.5)
    );
    assert_eq!(line(&motions[motions.len() - 2]), "L X20 Y5 Z0 F100");
    // what is not computed has a known end
    for blocks in [
        "G91 POLY PO[X]=(9,1)",
        "POLY PO[X]=(9,R7777)",
        "POLY PO[X]=(9,1) PO[]=(-1)",
        "POLY PO[X]=(9,1) A5",
    ] {
        let text = format!("G17 G90 G71 G1 X0 Y0 Z0 A0 F100\n{blocks}\n");
        let motions = run_text(NAME, &text).motions;
        assert_eq!(
            line(&motions[1]).split(' ').take(2).collect::<Vec<_>>(),
            ["U", "X9"],
            "{blocks}"
        );
        assert!(
            faults(NAME, &text).iter().any(|fault| fault.contains("POLY")),
            "{blocks}"
        );
    }
}

/// The cycles' own text: CYCLE81 to CYCLE83 with relative depths, and the modes that newer posts write at the end.
#[test]
fn drilling_cycles() {
    let holes = |call: &str| lines(NAME, &format!("G17 G90 G71 G0 X0 Y0 Z50 F100\n{call}\n"));
    let plain = ["R X0 Y0 Z2", "L X0 Y0 Z-5 F100", "R X0 Y0 Z10"];
    for call in [
        "CYCLE81(10,0,2,-5)",
        "CYCLE81(10,0,2,,5)",
        "CYCLE81(10,0,-2,,-5)",
        "CYCLE81(10,0,2,-5,,,0,1,12)",
        "CYCLE81(10,0,2,,5,0,0,1,11)",
        "CYCLE82(10,0,2,-5,0,0)",
        "CYCLE82(10,0,2,-5,,0,0,1,12)",
    ] {
        assert_eq!(holes(call)[1..], plain, "{call}");
    }
    // clearing the chips: out each time, back to 0.6 mm before the last depth (up to 30 mm of depth), each step 2 less,
    // and 2 above the bottom before the last one
    let deep = holes("CYCLE83(10,0,2,-25,,-10,,2,0,0,1,1)");
    assert_eq!(
        deep[1..],
        [
            "R X0 Y0 Z2",
            "L X0 Y0 Z-10 F100",
            "R X0 Y0 Z2",
            "R X0 Y0 Z-9.4",
            "L X0 Y0 Z-18 F100",
            "R X0 Y0 Z2",
            "R X0 Y0 Z-17.4",
            "L X0 Y0 Z-23 F100",
            "R X0 Y0 Z2",
            "R X0 Y0 Z-22.4",
            "L X0 Y0 Z-25 F100",
            "R X0 Y0 Z10",
        ]
    );
    let circle = lines(
        NAME,
        "G17 G90 G71 G0 X0 Y0 Z50 F100\nMCALL CYCLE81(10,0,2,-5)\nHOLES2(0,0,10,0,0,4)\nMCALL\n",
    );
    let bottoms: Vec<&String> = circle.iter().filter(|line| line.starts_with('L')).collect();
    assert_eq!(
        bottoms,
        [
            "L X10 Y0 Z-5 F100",
            "L X0 Y10 Z-5 F100",
            "L X-10 Y0 Z-5 F100",
            "L X0 Y-10 Z-5 F100"
        ]
    );
}
