//! Words whose effect is not taken from a source: each has a finding that names it and says what is missing, and nothing follows from it silently.
use crate::support::{faults, run_text};

const SIEMENS: &str = "sinumerik-840d";
const KLARTEXT: &str = "heidenhain-klartext";
const FANUC: &str = "fanuc-30i";

fn program(dialect: &str, blocks: &str) -> String {
    match dialect {
        KLARTEXT => {
            format!("0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+50 R0\n{blocks}\nEND PGM A MM\n")
        }
        FANUC => format!("G17 G21 G90 G94 G54 F100.\nG1 X0 Y0 Z50.\n{blocks}\nM30\n"),
        _ => format!("G17 G90 G71 G94 F100\nG1 X0 Y0 Z50\n{blocks}\nM30\n"),
    }
}

#[test]
fn each_word_is_named_with_its_reason() {
    const PLANE: &str = "PLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY\n";
    const L: &str = "L X+1 Y+2 Z+3 R0";
    const G: &str = "G1 X1. Y2. Z3.";
    // what follows is unknown, too
    for (dialect, blocks, reason) in [
        (
            KLARTEXT,
            format!("CYCL DEF 26.0 S\nCYCL DEF 26.1 X1.4 Y0.6\n{L}"),
            "cycle 26",
        ),
        (
            KLARTEXT,
            format!("{PLANE}CYCL DEF 26.0 S\nCYCL DEF 26.1 X1.4 Y0.6 CCX+15 CCY+20\n{L}"),
            "cycle 26",
        ),
        (
            KLARTEXT,
            format!("{PLANE}CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL0.5\n{L}"),
            "cycle 11",
        ),
        (
            SIEMENS,
            format!("CYCLE800(0,\"\",0,192,0,0,0,30,40,0,0,0,0,0)\n{G}"),
            "with positions of the rotary axes",
        ),
        (
            SIEMENS,
            format!("CYCLE800(0,\"\",0,128,0,0,0,30,40,0,0,0,0,0)\n{G}"),
            "with projection angles",
        ),
        (
            SIEMENS,
            format!("CYCLE800(0,\"\",0,64,0,0,0,30,40,0,0,0,0,0)\n{G}"),
            "with solid angles",
        ),
        (
            SIEMENS,
            format!("CYCLE800(0,\"\",0,57,R9,0,0,30,40,0,0,0,0,0)\n{G}"),
            "an argument that is not known",
        ),
        (
            SIEMENS,
            format!("TRANS X1\nCYCLE800(0,\"\",0,57,0,0,0,30,40,0,0,0,0,0)\n{G}"),
            "with a frame of the program",
        ),
        (
            FANUC,
            format!("G68.2 X0 Y0 Z0 I0 J90. K0\nG52 X10.\n{G}"),
            "G52 in a tilted plane",
        ),
        (FANUC, format!("G68 X0 Y0 R90.\nG52 X10.\n{G}"), "G52 in a turned"),
    ] {
        let text = program(dialect, &blocks);
        let last = run_text(dialect, &text).motions.pop().expect("a motion");
        assert_eq!(last.end.xyz(), None, "{blocks}");
        let found = faults(dialect, &text);
        assert!(found.iter().any(|fault| fault.contains(reason)), "{blocks}: {found:?}");
    }
}

/// What follows them is known where all coordinates are given.
#[test]
fn each_word_without_positions_is_named_with_its_reason() {
    for (dialect, blocks, reason) in [
        (
            KLARTEXT,
            "L X+10 Y+0\nCHF 2\nL X+10 Y+20\nL X+0",
            "CHF: what its length measures",
        ),
        (
            KLARTEXT,
            "CYCL DEF 200 Q200=2 Q201=-10 Q206=150 Q202=20 Q203=+0 Q204=50\nCYCL CALL POS X+10 Y+20 Z+0 FMAX",
            "CYCL CALL POS: the path",
        ),
        (
            KLARTEXT,
            "L X+10 Y+0 RL\nL X+10 Y+20\nL X+0 R0",
            "cutter radius compensation",
        ),
        (
            KLARTEXT,
            "Q9 = SQ 3 * 2\nL X+Q9 Y+0 Z+0",
            "Q9: the formula that sets it",
        ),
        (
            SIEMENS,
            "GROUP_BEGIN(0,\"ROUGH\",0,0)\nG1 X5\nGROUP_END(0,0)\nX1 Y2 Z3",
            "GROUP_BEGIN",
        ),
        (SIEMENS, "G1 X5\nGROUP_END(0,0)\nX1 Y2 Z3", "GROUP_END"),
        (SIEMENS, "SEFORM(\"ROUGH\",0,\"\")\nG1 X1 Y2 Z3", "SEFORM"),
    ] {
        let text = program(dialect, blocks);
        let found = faults(dialect, &text);
        assert!(found.iter().any(|fault| fault.contains(reason)), "{blocks}: {found:?}");
        assert!(
            !found.iter().any(|fault| fault.contains("MissingSubprogram")),
            "{blocks}: {found:?}"
        );
    }
}

/// A program of the shop with one of these names is run as before.
#[test]
fn a_program_that_is_called_like_a_heading_is_run() {
    let text = program(SIEMENS, "SEFORM(\"A\",0,\"\")\nG1 X5 Y0 Z0");
    let last = run_text(SIEMENS, &text).motions.pop().expect("a motion");
    assert_eq!(last.end.xyz().map(|end| end[0]), Some(5.0));
    // Y and Z from before it are not taken over
    let text = program(SIEMENS, "SEFORM(\"A\",0,\"\")\nG1 X5");
    let last = run_text(SIEMENS, &text).motions.pop().expect("a motion");
    assert_eq!(last.end.xyz(), None);
}
