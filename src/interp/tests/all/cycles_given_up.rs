//! Cycles that are not worked out, and say so.
use crate::support::{fault_line, faults, run_bytes};
use trunnion_interp::{MotionKind, Setup};

/// A step that is a thousand times too small, or a count that is too large, must not fill the memory.
#[test]
fn a_block_of_very_many_motions_is_given_up() {
    for source in [
        "G0 X1. Y2. Z9.\nG91 G83 X1. Z-10. R-1. Q0.001 F100. K9999\nG80\nM30\n",
        "G0 X1. Y2. Z9.\nG98 G83 Z-10. R1. Q0.002 F100. L0\nG70 I50. J0. L9999\nG80\nM30\n",
    ] {
        let dialect = if source.contains("G70") {
            "haas-ngc"
        } else {
            "fanuc-30i"
        };
        let (program, log) = run_bytes(dialect, source.as_bytes(), &Setup::default());
        assert!(log.motions.len() < 300_000, "{}", log.motions.len());
        let said: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
        assert!(
            said.iter().any(|said| said.contains("motions in one block")),
            "{said:?}"
        );
        assert_eq!(log.motions.last().expect("some").kind, MotionKind::Unknown);
    }
}

/// A cycle that is given up half way ends where it says, and the next motion begins there.
#[test]
fn a_pattern_that_is_given_up_joins_on() {
    let contour = "G1 W-.01\n".repeat(40);
    let source =
        format!("G0 X50. Z2.\nG73 U4. W2. R9999\nG73 P1 Q2 F.3\nN1 G0 X20.\n{contour}N2 G1 X30.\nG0 X60.\nM30\n");
    let (program, log) = run_bytes("fanuc-30i-lathe-a", source.as_bytes(), &Setup::default());
    let said: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    assert!(
        said.iter().any(|said| said.contains("motions in one block")),
        "{said:?}"
    );
    for pair in log.motions.windows(2) {
        assert_eq!(pair[0].end, pair[1].start);
    }
}

/// Increments of a cycle whose start is unknown have an unknown end, and that is reported.
#[test]
fn levels_that_count_from_an_unknown_place_are_told() {
    let said = faults("fanuc-30i", "G0 X1. Y2.\nG91 G81 X5. Z-3. R-1. F100.\nG80\nM30\n");
    assert!(said.len() == 1 && said[0].contains("levels refer to Z"), "{said:?}");
}

/// Pecks beside each other are counted also where each is a single motion.
#[test]
fn pecks_without_depth_are_given_up() {
    let source = "G0 X50. Z-25.\nG76 R1.\nG76 X999999. Z-25. P919 Q3 F.1\nM30\n";
    let (program, log) = run_bytes("fanuc-30i-lathe-c", source.as_bytes(), &Setup::default());
    assert!(log.motions.len() < 10, "{}", log.motions.len());
    let said: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    assert!(
        said.iter().any(|said| said.contains("more than 10000 steps")),
        "{said:?}"
    );
}

/// Cycles with many repeats in a loop end as the loop would: their motions count for the bound on executed blocks.
#[test]
fn cycles_in_a_loop_are_given_up() {
    let deep_holes = format!(
        "UNITS/MM\nFEDRAT/100\nCYCLE/DEEP,DEPTH,500,STEP,1,MMPM,100,CLEAR,2\n{}FINI\n",
        "GOTO/1,2,0\n".repeat(500)
    );
    let shallow_cuts = format!(
        "G0 X50. Z2.\nG76 P010060 Q0 R.001\n#1=0\nWHILE[#1LT240]DO1\n#1=#1+1\n{}END1\nM30\n",
        "G76 X38.16 Z-25. P919 Q1 F1.5\n".repeat(5)
    );
    // the blocks of the contour count, though nothing comes of them
    let refused_contour = format!(
        "G0 X50. Z2.\nG71 U1. R.1\nG75 R1.\n#1=0\nWHILE[#1LT240]DO1\n#1=#1+1\nG71 P10 Q20 F.1\nG75 X49. Z2. P9000 Q9000 F.1\nEND1\nGOTO 30\nN10 G0 X20.\n{}N20 G1 X50.\nN30 M30\n",
        "G1 X21. Z-1.\nG1 X20. Z-2.\n".repeat(20)
    );
    for (dialect, source, why) in [
        (
            "fanuc-30i-lathe-a",
            refused_contour.as_str(),
            "G75: more than 2000 motions in the cycles of the program",
        ),
        (
            "fanuc-30i",
            "G0 X1. Y2. Z9.\n#1=0\nWHILE[#1LT500]DO1\n#1=#1+1\nG91 G81 X1. Z-1. R-1. F100. K300\nEND1\nM30\n",
            "motions in the cycles of the program",
        ),
        (
            "fanuc-30i-lathe-a",
            "G0 X50. Z2.\n#1=0\nG75 R1.\nWHILE[#1LT500]DO1\n#1=#1+1\nG75 X20. Z-9. P900 Q3000 F.1\nEND1\nM30\n",
            "motions in the cycles of the program",
        ),
        (
            "fanuc-30i-lathe-a",
            "G0 X50. Z2.\n#1=0\nWHILE[#1LT500]DO1\n#1=#1+1\nG76 P010060 Q100 R.05\nG76 X38.16 Z-25. P919 Q100 F1.5\nEND1\nM30\n",
            "motions in the cycles of the program",
        ),
        (
            "sinumerik-840d",
            "G71 G90 G17 G94 G0 X1 Y2 Z9 F100\nMCALL CYCLE81(10,0,1,-5)\nFOR R1=1 TO 400\nHOLES2(0,0,10,0,1,300)\nENDFOR\nM30\n",
            "more than 2000 motions in the cycles of the program",
        ),
        (
            "sinumerik-840d",
            "G71 G90 G17 G94 G0 X1 Y2 Z9\nG1 F100\nFOR R1=1 TO 400\nPOLY PO[X]=(10,50,50) PO[Y]=(5,10,10)\nG1 X0 Y0\nENDFOR\nM30\n",
            "POLY: more than 2000 motions in the cycles of the program",
        ),
        (
            "fanuc-30i-lathe-a",
            &shallow_cuts,
            "motions in the cycles of the program",
        ),
        ("apt", &deep_holes, "motions in the cycles of the program"),
        (
            "linuxcnc",
            "G0 X1 Y2 Z9\n#1=0\no1 while [#1 lt 500]\n#1=[#1+1]\nG91 G81 X1 Z-1 R-1 F100 L300\no1 endwhile\nM2\n",
            "more motions than the limit",
        ),
        (
            "linuxcnc",
            "G0 X1 Y2 Z9\nG91 G83 X1 Z-10 R-1 Q0.5 F100 L300\nM2\n",
            "more motions than the limit",
        ),
    ] {
        let mut setup = Setup::default();
        setup.limits.blocks = 2000;
        let (program, log) = run_bytes(dialect, source.as_bytes(), &setup);
        assert!(
            (500..4000).contains(&log.motions.len()),
            "{dialect}: {}",
            log.motions.len()
        );
        let said: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
        assert!(said.iter().any(|said| said.contains(why)), "{dialect}: {said:?}");
    }
}

/// Steps that are computed and make no motion, because they are too many, count as well: else each hole of a long program computes them again.
#[test]
fn steps_in_vain_count_for_the_bound() {
    let hole = |step: &str| format!("X1\nMCALL CYCLE83(10,0,2,-100,,,{step},0,0,0,1,0,3)\nX2\nMCALL\n");
    let source = format!("G0 X0 Y0 Z50\nF100\n{}{}M30\n", hole("0.001").repeat(3), hole("50"));
    let said = |blocks: u64| {
        let mut setup = Setup::default();
        setup.limits.blocks = blocks;
        let (program, log) = run_bytes("sinumerik-840d", source.as_bytes(), &setup);
        let faults = log.faults.iter().map(|fault| fault_line(&program, fault));
        faults
            .filter(|fault| fault.contains("what: \"CYCLE83: "))
            .collect::<Vec<_>>()
    };
    // ten thousand steps for each of the three holes
    assert_eq!(said(40_000).len(), 3);
    let bounded = said(25_000);
    assert_eq!(bounded.len(), 4, "{bounded:?}");
    assert!(
        bounded[3].contains("more than 25000 motions in the cycles of the program ([limits] blocks)"),
        "{bounded:?}"
    );
}

/// The motions of a block are held until it is done.
#[test]
fn a_pattern_of_deep_holes_is_given_up_in_its_block() {
    let points: Vec<String> = (0..120).map(|at| format!(" POS{at} (X+{at} Y+1 Z+0)")).collect();
    let points = points.concat();
    let source = format!(
        "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n2 L Z+50 FMAX M3\n\
         3 CYCL DEF 200 Q200=2 Q201=-50 Q206=100 Q202=0.012 Q210=0 Q203=0 Q204=50 Q211=0\n\
         4 PATTERN DEF{points}\n5 CYCL CALL PAT\n6 M30\n7 END PGM A MM\n"
    );
    let mut setup = Setup::default();
    setup.control.peck_clearance_mm = Some(1.0);
    let (_, log) = run_bytes("heidenhain-klartext", source.as_bytes(), &setup);
    assert!((200_000..250_000).contains(&log.motions.len()), "{}", log.motions.len());
    assert_eq!(log.motions.last().expect("some").kind, MotionKind::Unknown);
}

/// A spline of a high order takes long to follow, and a long one is many chords: both count.
#[test]
fn splines_count_for_the_bound() {
    let points = |count: usize| {
        let lines: Vec<String> = (0..count).map(|at| format!("X{at} Y{} P1\n", at % 9)).collect();
        lines.concat()
    };
    let high = format!("G1 X0 Y0 F100\nG5.2 P1 L200 X0 Y0\n{}G5.3\nM2\n", points(200));
    let low = high.replace("L200", "L4");
    let long = format!(
        "G1 X0 Y0 F100\n{}M2\n",
        "G5.1 X1000 Y5 I900 J900\nG5.1 X0 Y0 I900 J-900\n".repeat(50)
    );
    let run = |source: &str| {
        let mut setup = Setup::default();
        setup.limits.blocks = 20_000;
        let (program, log) = run_bytes("linuxcnc", source.as_bytes(), &setup);
        let faults = log.faults.iter().map(|fault| fault_line(&program, fault));
        let told = faults
            .filter(|fault| fault.contains("20000 steps with those before it"))
            .count();
        (told, log.motions.len())
    };
    assert_eq!(run(&low).0, 0);
    assert_eq!(run(&high), (1, 2));
    let (told, motions) = run(&long);
    assert!(told > 10 && motions < 20_000, "{told} {motions}");
}
