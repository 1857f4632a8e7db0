//! Parts that were written by hand for each control, as its programmers would: polar words and loops, drilled rows by a subprogram, lines under tool
//! centre point control by angles and by vectors, mirrored and turned parts. The motions are the same.
use crate::support::{fault_line, line, run_bytes};
use trunnion_interp::{Setup, WorkOffset};

const KLARTEXT: &str = "heidenhain-klartext";
const SIEMENS: &str = "sinumerik-840d";
const FANUC: &str = "fanuc-30i";
const OKUMA: &str = "okuma-osp";

/// The motions of a program about which nothing is said, without the first ones.
fn motions(dialect: &str, source: &str, first: usize) -> Vec<String> {
    let mut setup = Setup::default();
    for name in ["G54", "G15 H1"] {
        setup.work_offsets.push(WorkOffset {
            name: name.to_owned(),
            values: [0.0; 9],
        });
    }
    for number in 1..4 {
        setup.tools.push(trunnion_interp::Tool {
            number,
            shape: None,
            diameter_mm: None,
            length_mm: Some(0.0),
            holder_mm: None,
        });
    }
    let (program, log) = run_bytes(dialect, source.as_bytes(), &setup);
    let told: Vec<String> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    assert_eq!(told, [""; 0], "{dialect}:\n{source}");
    log.motions.iter().skip(first).map(line).collect()
}

/// Each program does what the first one does; `least`: how many motions that are.
fn same(least: usize, programs: &[(&str, &str)]) {
    let wanted = motions(programs[0].0, programs[0].1, 1);
    assert!(wanted.len() >= least, "{wanted:#?}");
    for (dialect, source) in &programs[1..] {
        assert_eq!(motions(dialect, source, 1), wanted, "{dialect}:\n{source}");
    }
}

#[test]
fn polar_words() {
    same(
        12,
        &[
            (
                KLARTEXT,
                "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S2000 F500\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 CC X+10 Y+10\n4 LP PR+20 PA+30 FMAX\n5 L Z-2 F200\n6 CP PA+120 DR+ F400\n\
                 7 LP IPA+60 PR+25\n8 CP IPA-90 DR-\n9 CC X+0 Y+0\n10 LP PR+30 PA+0\n11 CP IPA+720 IZ-4 DR+\n12 L Z+50 FMAX\n13 Q1 = 0\n14 LBL 1\n15 Q1 = Q1 + 1\n\
                 16 Q2 = Q1 * 2\n17 L X+Q1 Y+Q2 Z+5 FMAX\n18 FN 12: IF +Q1 LT +4 GOTO LBL 1\n19 L Z+50 FMAX M30\n20 END PGM A MM\n",
            ),
            (
                SIEMENS,
                "G17 G54 G71 G90 G94 G40\nT1 M6\nD1\nG0 X0 Y0 Z50 S2000 M3 F500\nG111 X10 Y10\nG0 AP=30 RP=20\nG1 Z-2 F200\nG3 AP=120 RP=20 F400\nG1 AP=180 RP=25\n\
                 G2 AP=90 RP=25\nG111 X0 Y0\nG1 AP=0 RP=30\nG3 X30 Y0 Z-6 I=AC(0) J=AC(0) TURN=1\nG0 Z50\nR1=0\nREPEAT\nR1=R1+1\nG0 X=R1 Y=R1*2 Z5\nUNTIL R1>=4\nG0 Z50\nM30\n",
            ),
        ],
    );
}

#[test]
fn rows_of_a_subprogram() {
    same(
        30,
        &[
            (
                SIEMENS,
                "%_N_E_MPF\nDEF REAL PITCH=7.5\nDEF INT ROW\nG17 G54 G71 G90 G94 G40\nT1 M6\nD1\nG0 X0 Y0 Z50 S2000 M3 F500\nR10=3\nFOR ROW=0 TO R10-1\nG0 X0 Y=ROW*PITCH\n\
                 HOLE P3\nENDFOR\nR20=SQRT(R10*3)+POT(2)*2-TRUNC(7.9)\nG0 X=R20 Y=-R20\nG0 Z50\nM30\n%_N_HOLE_SPF\nG91 G0 X5\nG90\nG1 Z-3 F200\nG0 Z5\nM17\n",
            ),
            (
                FANUC,
                "O0001\nG17 G54 G21 G90 G94 G40\nT1 M6\nS2000 M3 F500.\nG0 X0. Y0. Z50.\n#10=3\n#11=0\n#1=7.5\nWHILE[#11LT#10]DO1\n#12=#11*#1\nG0 X0. Y#12\nM98 P30100\n\
                 #11=#11+1\nEND1\n#20=SQRT[#10*3]+2*2*2-FIX[7.9]\nG0 X#20 Y-#20\nG0 Z50.\nM30\nO0100\nG91 G0 X5.\nG90 G1 Z-3. F200.\nG0 Z5.\nM99\n",
            ),
            (
                OKUMA,
                "$E.MIN%\nG15 H1\nG90 G94 G40\nT1 M6\nS2000 M3 F500\nG0 X0 Y0 Z50\nV1=3\nV2=0\nV3=7.5\nNROW V4=V2*V3\nG0 X0 Y=V4\nCALL OHOL Q3\nV2=V2+1\nIF [V2 LT V1] NROW\n\
                 V20=SQRT[V1*3]+2*2*2-FIX[7.9]\nG0 X=V20 Y=-V20\nG0 Z50\nM30\nOHOL\nG91 G0 X5\nG90 G1 Z-3 F200\nG0 Z5\nRTS\n",
            ),
            (
                KLARTEXT,
                "0 BEGIN PGM E MM\n1 TOOL CALL 1 Z S2000 F500\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 Q10 = 3\n4 Q11 = 0\n5 QL1 = 7.5\n6 LBL \"ROW\"\n7 Q12 = Q11 * QL1\n\
                 8 L X+0 Y+Q12 FMAX\n9 CALL LBL 5\n10 CALL LBL 5\n11 CALL LBL 5\n12 Q11 = Q11 + 1\n13 FN 12: IF +Q11 LT +Q10 GOTO LBL \"ROW\"\n14 Q20 = SQRT(Q10 * 3) + 1\n\
                 15 L X+Q20 Y-Q20 FMAX\n16 L Z+50 FMAX M30\n17 LBL 5\n18 L IX+5 FMAX\n19 L Z-3 F200\n20 L Z+5 FMAX\n21 LBL 0\n22 END PGM E MM\n",
            ),
        ],
    );
}

#[test]
fn tips_by_angles() {
    let angles = |head: &str, on: &str, off: &str| {
        format!(
            "{head}{on}\nG0 X10. Y0. Z20. A-15. C30.\nG1 Z5. F800.\nX20. Y5. Z4.5 A-20. C45.\nG91 X5. C10.\nG90 X30. Y0. Z4. A-30. C90. F1500.\nG0 Z60.\n{off}\nM30\n"
        )
    };
    let start = "T3 M6\nS8000 M3 F1200.\nG0 X0. Y0. Z200. A0. C0.\n";
    let loaded = start.replace("M6", "M6 D1");
    let siemens = angles(&format!("G17 G54 G71 G90 G94 G40\n{loaded}"), "TRAORI", "TRAFOOF");
    let fanuc = angles(&format!("O0003\nG17 G54 G21 G90 G94 G40\n{start}"), "G43.4 H3", "G49");
    let okuma = angles(&format!("$B.MIN%\nG15 H1\nG90 G94 G40\n{start}"), "G169 H3", "G170");
    same(
        6,
        &[
            (
                KLARTEXT,
                "0 BEGIN PGM B MM\n1 TOOL CALL 3 Z S8000 F1200\n2 L X+0 Y+0 Z+200 A+0 C+0 R0 FMAX M3\n3 M128\n4 L X+10 Y+0 Z+20 A-15 C+30 FMAX\n5 L Z+5 F800\n\
                 6 L X+20 Y+5 Z+4.5 A-20 C+45\n7 L IX+5 IC+10\n8 L X+30 Y+0 Z+4 A-30 C+90 F1500\n9 L Z+60 FMAX\n10 M129\n11 M30\n12 END PGM B MM\n",
            ),
            (SIEMENS, &siemens),
            (FANUC, &fanuc),
            (OKUMA, &okuma),
        ],
    );
}

#[test]
fn mirrored_and_turned() {
    same(
        9,
        &[
            (
                KLARTEXT,
                "0 BEGIN PGM H MM\n1 TOOL CALL 1 Z S2000 F500\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 CYCL DEF 8.0 MIRROR\n4 CYCL DEF 8.1 X\n5 L X+10 Y+5 FMAX\n6 L Z-1 F200\n\
                 7 CC X+10 Y+10\n8 C X+10 Y+15 DR+\n9 L Z+50 FMAX\n10 CYCL DEF 8.0 MIRROR\n11 CYCL DEF 8.1\n12 CYCL DEF 10.0 ROTATION\n13 CYCL DEF 10.1 ROT+35\n\
                 14 L X+10 Y+5 FMAX\n15 L Z-1 F200\n16 CC X+10 Y+10\n17 C X+10 Y+15 DR+\n18 CYCL DEF 10.0 ROTATION\n19 CYCL DEF 10.1 IROT+10\n20 L X+20 Y+5\n\
                 21 CYCL DEF 10.0 ROTATION\n22 CYCL DEF 10.1 ROT+0\n23 L Z+50 FMAX\n24 M30\n25 END PGM H MM\n",
            ),
            (
                SIEMENS,
                "G17 G54 G71 G90 G94 G40\nT1 M6\nD1\nS2000 M3\nG0 X0 Y0 Z50 F500\nMIRROR X0\nG0 X10 Y5\nG1 Z-1 F200\nG3 X10 Y15 I0 J5\nG0 Z50\nMIRROR\nROT Z35\nG0 X10 Y5\n\
                 G1 Z-1 F200\nG3 X10 Y15 I0 J5\nAROT Z10\nG1 X20 Y5\nROT\nG0 Z50\nM30\n",
            ),
            (
                FANUC,
                "O0003\nG17 G54 G21 G90 G94 G40\nT1 M6\nS2000 M3\nG0 X0. Y0. Z50. F500.\nG51.1 X0.\nG0 X10. Y5.\nG1 Z-1. F200.\nG3 X10. Y15. I0. J5.\nG0 Z50.\nG50.1 X0.\n\
                 G68 X0. Y0. R35.\nG0 X10. Y5.\nG1 Z-1. F200.\nG3 X10. Y15. I0. J5.\nG69\nG68 X0. Y0. R45.\nG1 X20. Y5.\nG69\nG0 Z50.\nM30\n",
            ),
        ],
    );
}
