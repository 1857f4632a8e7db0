//! Okuma OSP, machining centres.
use crate::support::{fault_line, faults, line, lines, run_bytes, run_text, shared};
use trunnion_geometry::Vec3;
use trunnion_interp::{Motion, MotionKind, Setup, Tool, WorkOffset};

const NAME: &str = "okuma-osp";

fn moves(blocks: &str) -> Vec<String> {
    lines(NAME, &format!("G0 X0 Y0 Z0\n{blocks}M2\n"))[1..].to_vec()
}

fn told(blocks: &str) -> Vec<String> {
    faults(NAME, &format!("{blocks}M2\n"))
}

#[test]
fn names_lines_and_skipped_blocks() {
    let text = "$PART-1.MIN%\nO1001\nN1 G0 X1 Y2 Z3\nNAB1 G1 X2 F100\n$ Y5\n$(more) Z6\n/N20 X9\nN30 /X8\nOLIB1\n";
    let mut setup = Setup::default();
    setup.control.block_delete = Some(true);
    let (program, log) = run_bytes(NAME, text.as_bytes(), &setup);
    assert!(program.errors().is_empty(), "{:?}", program.errors());
    let found: Vec<String> = log.motions.iter().map(line).collect();
    assert_eq!(found, ["R X1 Y2 Z3", "L X2 Y5 Z6 F100"]);
    setup.control.block_delete = Some(false);
    let log = run_bytes(NAME, text.as_bytes(), &setup).1;
    assert_eq!(log.motions.len(), 4);
}

#[test]
fn a_name_needs_a_blank_and_has_at_most_four_characters() {
    for (blocks, wanted) in [
        ("N10G1 X5 F9\n", "`N10` must be followed by a blank"),
        ("NLOOPS G1 X5 F9\n", "at most 4 letters or digits"),
        ("OPART1 (A)\n", "at most 4 letters or digits"),
    ] {
        let found = told(blocks);
        assert!(found.iter().any(|fault| fault.contains(wanted)), "{blocks}{found:?}");
    }
    assert_eq!(told("N1 X=1\nN0010 G4 F1\nNAB G40\nN123456 G40\n").len(), 1);
}

#[test]
fn work_systems_and_lengths() {
    let mut setup = Setup::default();
    for (name, x) in [("G15 H1", 100.0), ("G15 H2", 200.0)] {
        let mut values = [0.0; 9];
        values[0] = x;
        setup.work_offsets.push(WorkOffset {
            name: name.to_owned(),
            values,
        });
    }
    let text = "G15 H1\nG0 X1 Y0 Z5\nG16 H2 X2\nX3\nG16 H0 X4\nX5\nM2\n";
    let log = run_bytes(NAME, text.as_bytes(), &setup).1;
    let zeros: Vec<(f64, String)> = log
        .motions
        .iter()
        .map(|motion| (motion.zero[0], line(motion)))
        .collect();
    let shown: Vec<(f64, &str)> = zeros.iter().map(|(zero, line)| (*zero, line.as_str())).collect();
    assert_eq!(
        shown,
        [
            (100.0, "R X1 Y0 Z5"),
            (200.0, "R X2 Y0 Z5"),
            (100.0, "R X3 Y0 Z5"),
            (100.0, "R X4 Y0 Z5 machine"),
            (100.0, "R X5 Y0 Z5")
        ]
    );
    // the start of a motion in another system is the same place
    assert_eq!(
        (log.motions[1].start.get(0), log.motions[2].start.get(0)),
        (Some(-99.0), Some(102.0))
    );
}

#[test]
fn a_loop_with_a_variable() {
    assert_eq!(
        moves("V1=0\nNLP1 V1=V1+1\nG0 X=V1*2 Y=-V1\nIF [V1 LT 3] GOTO NLP1\nG1 Z=V1 F=V1*100\n"),
        ["R X2 Y-1 Z0", "R X4 Y-2 Z0", "R X6 Y-3 Z0", "L X6 Y-3 Z3 F300"]
    );
    assert_eq!(
        moves("V1 = 2\nIF [V1 EQ 2] N0010\nN010 X1\nGOTO NEND\nN0010 X2\nNEND Y1\n"),
        ["R X2 Y0 Z0", "R X2 Y1 Z0"],
        "names are compared as text"
    );
}

#[test]
fn calls_with_arguments() {
    let text = "G0 X0 Y0 Z0\nDIA=7\nCALL OSUB Q2 DIA=40 ZL=-2\nX=DIA\nM02\n\
                OSUB\nIF DIA N1\nX99\nN1 X=DIA\nIF [YL EQ EMPTY] N2\nX98\nN2 Z=ZL\nRTS\n";
    assert_eq!(
        lines(NAME, text),
        [
            "R X0 Y0 Z0",
            "R X40 Y0 Z0",
            "R X40 Y0 Z-2",
            "R X40 Y0 Z-2",
            "R X40 Y0 Z-2",
            "R X7 Y0 Z-2"
        ]
    );
    let found = faults(NAME, text);
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn modin_calls_after_each_block_that_moves() {
    let text = "G0 X0 Y0 Z9\nMODIN OHOL DP=-3\nX1\nF50\nX2\nMODOUT\nX3\nM2\nOHOL\nG1 Z=DP F50\nG0 Z9\nRTS\n";
    assert_eq!(
        lines(NAME, text),
        [
            "R X0 Y0 Z9",
            "R X1 Y0 Z9",
            "L X1 Y0 Z-3 F50",
            "R X1 Y0 Z9",
            "R X2 Y0 Z9",
            "L X2 Y0 Z-3 F50",
            "R X2 Y0 Z9",
            "R X3 Y0 Z9"
        ]
    );
}

/// A word whose value is not known says which variable it lacks, and why.
#[test]
fn an_unknown_value_has_a_reason() {
    for (blocks, wanted) in [
        ("X=V5\n", "V5: the program does not set its value"),
        ("Z=VC3+1 F100\n", "VC3: the program does not set its value"),
        ("V7=V5+1\nX=2*V7\n", "V7: from V5+1"),
        ("V7=V5+1\nV7=3\nX=V7+VZOFX\n", "VZOFX: a variable of the control"),
        ("X=VZOFX[1]\n", "VZOFX: a variable of the control"),
        ("X=LOC1\n", "LOC1: not written before"),
        ("LOC1=V5\nX=LOC1\n", "LOC1: its value is unknown here"),
        ("V1=4 X=V1\n", "V1: written in the same block"),
        ("CALL ONOT\nX=V5\n", "V5: jumps or calls before it are not followed"),
    ] {
        let found = told(blocks);
        let wanted = format!("what: \"{wanted}\"");
        assert!(found.iter().any(|fault| fault.contains(&wanted)), "{blocks}{found:?}");
    }
}

#[test]
fn what_is_not_decided_ends_the_run_by_name() {
    for (blocks, wanted) in [
        ("IF [V7 EQ 1] NA\nNA X1\n", "V7: the program does not set its value"),
        ("IF [VZOFX[1] EQ 1] NA\nNA X1\n", "VZOFX: a variable of the control"),
        ("IF AB NA\nNA X1\n", "whether AB has a value"),
        (
            "V1=1\nIF [[V1 EQ 1] AND [V1 EQ 1] OR [V1 EQ 1]] NA\nNA X1\n",
            "not documented",
        ),
        ("NA X1\nNA X2\nGOTO NA\n", "more than once"),
        ("GOTO 10\nN10 X1\n", "a sequence name is N"),
        ("MODIN OA\nMODIN OA\nX1\n", "MODIN inside MODIN"),
        ("X1 CALL OA\n", "other words in the block"),
        ("CALL OA\nM2\nOA\nX1\nOB\nRTS\n", "ends without RTS"),
        ("GOTO NX\n", "there is no label NX"),
    ] {
        let found = told(blocks);
        assert!(found.iter().any(|fault| fault.contains(wanted)), "{blocks}{found:?}");
    }
}

#[test]
fn what_no_source_states_is_unknown_by_name() {
    for (blocks, name) in [
        (
            "G71 Z50\nG81 X1 Y1 Z-5 R2 F100 M54\n",
            "G81: the level to which it returns",
        ),
        ("G81 X1 Y1 Z-5 R2 F100 M53\n", "G81: the level to which it returns"),
        (
            "G71 Z1\nG81 X1 Y1 Z-5 R2 F100 M53\n",
            "G81: the level to which it returns",
        ),
        (
            "G91 G71 Z50\nG90 G81 X1 Y1 Z-5 R2 F100 M53\n",
            "G81: the level to which it returns",
        ),
        ("G71 Z50\nG83 X1 Y1 Z-5 R2 I2 J4 F100 M53\n", "G83: I and J"),
        ("NCYL G81 Z-5 R2 F100\nX5 Y5\n", "NCYL"),
        ("G56\n", "a length offset without H"),
        ("H2\n", "H without a code"),
        ("G53\nG91 G16 H0 Z5\n", "G16 H0 with G91"),
        ("G41 D1\nG1 X5 F100\nX9\nG40 X0\n", "ompensation"),
        ("G15 H0\n", "G15 H0"),
        ("G16 H0 Z5\n", "G16 H0 with a tool length"),
        ("G81 X1 Y1 Z-5 R2 F100\n", "G81: the level to which it returns"),
        ("NCYL G81 X1 Y1 Z-5 R2 F100\n", "NCYL"),
        ("NOEX X1\n", "NOEX"),
        ("G116 T5\n", "G116"),
        ("LAA X1 Y1 I5 K3 J45\n", "LAA"),
        ("BHC X1 Y1 I5 K3 J45\n", "BHC"),
        ("OMIT R3\n", "OMIT"),
        ("G11 X1 Y1 P30\n", "machine_builder: true"),
        ("G20 HP=4\n", "HP"),
        ("DA=2\n", "DA"),
        ("VZOFX[1]=5\n", "VZOFX[1]=5"),
        ("X=ATAN2[1,2]\n", "ATAN2[1,2]"),
    ] {
        let mut setup = Setup::default();
        setup.tools.push(Tool {
            number: 1,
            shape: None,
            diameter_mm: None,
            length_mm: Some(50.0),
            holder_mm: None,
        });
        let text = format!("T1 M6\nG56 H1\nG0 X0 Y0 Z9\n{blocks}M2\n");
        let (program, log) = run_bytes(NAME, text.as_bytes(), &setup);
        let found: Vec<String> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
        assert!(found.iter().any(|fault| fault.contains(name)), "{blocks}{found:?}");
    }
    // a code that may shift or turn the coordinates hides all that follow
    let log = run_text(NAME, "G15 H1\nG0 X0 Y0 Z0\nG11 X1 P30\nG1 X5 Y5 Z5 A3 F100\nM2\n");
    assert!(
        log.motions
            .last()
            .expect("a motion")
            .zero
            .iter()
            .all(|zero| *zero == 0.0)
    );
    assert!(log.state.expect("a state").zero.is_lost());
}

#[test]
fn drilling_keeps_what_is_known() {
    assert_eq!(
        moves("G81 X10 Y5 Z-8 R2 F100\nX20\nG80\nG0 Z50\n"),
        [
            "R X10 Y5 Z0",
            "R X10 Y5 Z2",
            "L X10 Y5 Z-8 F100",
            "R X10 Y5",
            "R X20 Y5",
            "R X20 Y5 Z2",
            "L X20 Y5 Z-8 F100",
            "R X20 Y5",
            "R X20 Y5 Z50"
        ]
    );
}

/// G71 Z is the level under M53, until another one; it moves nothing.
#[test]
fn drilling_returns_to_the_level_of_g71() {
    assert_eq!(
        moves("G71 Z30\nG81 X10 Y5 Z-8 R2 F100 M53\nX20\nG80\nG71 Z40\nG82 X30 Z-3 R1 P1 M53\nG80\nX0\n"),
        [
            "R X10 Y5 Z0",
            "R X10 Y5 Z2",
            "L X10 Y5 Z-8 F100",
            "R X10 Y5 Z30",
            "R X20 Y5 Z30",
            "R X20 Y5 Z2",
            "L X20 Y5 Z-8 F100",
            "R X20 Y5 Z30",
            "R X30 Y5 Z30",
            "R X30 Y5 Z1",
            "L X30 Y5 Z-3 F100",
            "D1 X30 Y5 Z-3",
            "R X30 Y5 Z40",
            "R X0 Y5 Z40"
        ]
    );
    for cycle in ["G73 Q9", "G74", "G84", "G284", "G85", "G89"] {
        let found = moves(&format!("G71 Z30\nM3 S100\n{cycle} X10 Y5 Z-8 R2 F100 M53\n"));
        assert!(
            found.iter().any(|line| line.starts_with("L X10 Y5 Z-8")),
            "{cycle}: {found:?}"
        );
        assert_eq!(found.last().map(String::as_str), Some("R X10 Y5 Z30"), "{cycle}");
    }
    // after a cycle in a block that is not followed, its levels are unknown: that is no mistake of the program
    let said = told("NCYL G83 Z-5 R2 Q1 F100\nX5 Y5\n");
    assert!(!said.iter().any(|fault| fault.contains("Rejected")), "{said:?}");
}

#[test]
fn tip_control() {
    let found = lines(
        NAME,
        "G56 H1\nG0 X0 Y0 Z9 A0 C0\nG53\nG169 H1\nG1 X1 Y1 Z1 A10 C20 F100\nG170\nG0 Z50\nM2\n",
    );
    assert_eq!(found[1], "L X1 Y1 Z1 A10 C20 F100 tcp");
    assert!(!found[2].contains("tcp"), "{found:?}");
    let log = run_text(
        NAME,
        "G169 H1\nG1 X1 Y1 Z1 A10 C20 F100\nG170\nG0 X5 Y5 Z50\nG53\nG0 X6 Y6 Z60\nM2\n",
    );
    assert!(log.state.is_some());
}

/// End points of the motions that are known, each once.
fn targets(motions: &[Motion]) -> Vec<Vec3> {
    let known = motions
        .iter()
        .filter(|motion| !matches!(motion.kind, MotionKind::Dwell(_)) && !motion.machine_coordinates);
    let mut found: Vec<Vec3> = known.filter_map(|motion| motion.end.xyz()).collect();
    found.dedup();
    found
}

#[test]
fn the_same_part_for_three_controls() {
    let files = [
        (NAME, "okuma/2.5D_MILLING.min"),
        ("fanuc-30i", "fanuc/2.5D_MILLING.NC"),
        ("sinumerik-840d", "siemens/2.5D_Milling.mpf"),
    ];
    let mut all = Vec::new();
    for (dialect, file) in files {
        let Some(bytes) = shared(&format!("four-controls/{file}")) else {
            return;
        };
        all.push(run_bytes(dialect, &bytes, &Setup::default()).1);
    }
    let own: Vec<String> = (all[0]
        .motions
        .iter()
        .filter(|motion| motion.machine_coordinates)
        .map(line))
    .collect();
    // what differs: each tool retracts in machine coordinates (G16 H0), where the others go to the reference point
    assert_eq!(own.len(), 8, "{own:?}");
    let unknown: Vec<&Motion> = all[0]
        .motions
        .iter()
        .filter(|motion| motion.kind == MotionKind::Unknown)
        .collect();
    assert_eq!(unknown.len(), 0);
    let [own, fanuc, siemens] = [0, 1, 2].map(|at| targets(&all[at].motions));
    assert!(own.len() > 750, "{}", own.len());
    for other in [fanuc, siemens] {
        assert_eq!(own.len(), other.len());
        let far = own.iter().zip(&other).filter(|(a, b)| (*a - *b).norm() > 1e-3).count();
        assert_eq!(far, 0);
    }
}

/// Whether G170 leaves the length of G169 in effect is not stated: the first motion says so, unless G56, G53 or machine coordinates come first.
#[test]
fn the_length_after_tip_control_is_unknown_by_name() {
    const TIP: &str = "G0 X0 Y0 Z9 A0 C0\nG169 H1\nG1 X1 Y1 Z1 A10 C20 F100\nG170\n";
    let open = |blocks: &str| {
        let found = told(&format!("{TIP}{blocks}"));
        found
            .iter()
            .filter(|fault| fault.contains("the tool length of G169"))
            .count()
    };
    for blocks in [
        "G0 Z100\nX5\nG1 X1 Y1 Z1\n",
        "G1 X5\nG0 Z9\n",
        "G16 H0 Z0\nG0 X1\n",
        "G15 H1\nG0 A0 C0\nX1\n",
    ] {
        assert_eq!(open(blocks), 1, "{blocks}");
    }
    for blocks in [
        "G53\nG0 Z100\n",
        "G56 H1\nG0 X1 Y1 Z100\n",
        "G16 H0 Z0\nG53\nG0 X1\n",
        "G0 A0 C0\nM5\n",
    ] {
        assert_eq!(open(blocks), 0, "{blocks}");
    }
    let log = run_text(NAME, &format!("{TIP}G0 Z100\nX5\nM2\n"));
    for (motion, named) in log.motions[2..].iter().zip([4, 1]) {
        let moved = motion.says_way & !motion.end.known;
        assert!(motion.end.xyz().is_none() && moved & named == named, "{motion:?}");
    }
}
