//! A path or a time that is not known always has a finding that names it.
use crate::support::{faults, run_text};
use trunnion_interp::MotionKind;

const SIEMENS: &str = "sinumerik-840d";
const KLARTEXT: &str = "heidenhain-klartext";

fn klartext(blocks: &str) -> String {
    format!("0 BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F100\nL X+0 Y+0 Z+0 R0 FMAX\n{blocks}\n9 END PGM A MM\n")
}

#[track_caller]
fn named(dialect: &str, text: &str, reason: &str) {
    let found = faults(dialect, text);
    assert!(found.iter().any(|fault| fault.contains(reason)), "{text}: {found:?}");
}

#[test]
fn arcs_that_are_none_any_more_are_named() {
    let head = "G17 G90 G94\nG0 X0 Y0 Z0\n";
    for blocks in ["SCALE X2\nG3 X20 Y10 CR=15 F100", "SCALE X2 Y1\nG2 X10 Y10 I10 J0 F100"] {
        let text = format!("{head}{blocks}\n");
        named(SIEMENS, &text, "scaled by different factors");
        let last = run_text(SIEMENS, &text).motions.pop().expect("an arc");
        assert_eq!(last.kind, MotionKind::Arc(None));
    }
    named(
        "fanuc-30i",
        "G0 X0. Y0. Z0.\nG51 X0. Y0. Z0. I2. J-1. K1.\nG1 X3. Y4. F100.\nG2 X5. R1.\n",
        "scaled by different factors",
    );
    // one factor for both axes keeps the arc
    let text = format!("{head}SCALE X2 Y2\nG2 X10 Y10 CR=10 F100\n");
    assert!(!faults(SIEMENS, &text).iter().any(|fault| fault.contains("NotModelled")));
    named(
        SIEMENS,
        &format!("{head}G1 X10 F100\nG2 X13 CR=5 TURN=-1\n"),
        "the turns of an arc",
    );
}

#[test]
fn corners_of_scaled_axes_are_named() {
    let head = "G17 G90 G94\nG0 X0 Y0 Z0\n";
    for corner in ["RND=2", "CHF=2", "CHR=2"] {
        named(
            SIEMENS,
            &format!("{head}SCALE X2 Y2\nG1 X10 F100 {corner}\nY10\n"),
            "corners while the axes are scaled",
        );
        let text = format!("{head}MIRROR X0\nG1 X10 F100 {corner}\nY10\n");
        assert!(
            !faults(SIEMENS, &text).iter().any(|fault| fault.contains("NotModelled")),
            "{corner}"
        );
    }
}

#[test]
fn dwells_without_a_time_are_named() {
    named(SIEMENS, "G4 F-2\n", "negative");
    named(SIEMENS, "G4\n", "a dwell without its time");
    named("fanuc-30i", "G4\n", "a dwell without its time");
    assert!(
        !faults("fanuc-30i", "G4 P0\n")
            .iter()
            .any(|fault| fault.contains("dwell"))
    );
}

/// Whether cycle 247 ends them is not taken from a source.
#[test]
fn what_stays_at_another_preset_is_named() {
    let preset = "CYCL DEF 247 DATUM SETTING ~\n  Q339=+1\nL X+10 Y+0 Z+10";
    for (before, reason) in [
        ("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10", "whether the shift stays"),
        (
            "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+90",
            "whether the rotation stays",
        ),
        (
            "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X",
            "whether the mirror image stays",
        ),
    ] {
        let text = klartext(&format!("{before}\n{preset}"));
        named(KLARTEXT, &text, reason);
        let last = run_text(KLARTEXT, &text).motions.pop().expect("a line");
        assert_eq!(last.end.xyz(), None, "{before}");
    }
    // ended before: known
    let text = klartext(&format!(
        "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+90\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+0\n{preset}"
    ));
    assert!(
        !faults(KLARTEXT, &text)
            .iter()
            .any(|fault| fault.contains("NotModelled"))
    );
}

/// A tool vector in machine axes, an LN block whose tool is corrected, an arc that turns back, an arc in rapid.
#[test]
fn what_no_source_settles_is_named() {
    let told = |dialect: &str, text: &str, what: &str| {
        let faults = faults(dialect, text);
        faults.iter().any(|fault| fault.contains(what))
    };
    let vector = |words: &str| {
        format!("G71 G17 G90 G54 G94\nG0 X0 Y0 Z50 A0 C0\nTRAORI\n{words}\nG1 X3 Y2 Z1 A3=0 B3=0 C3=1 F100\nM30\n")
    };
    assert!(told("sinumerik-840d", &vector("ORIMKS\nROT X20"), "ORIMKS"));
    for known in ["ORIMKS", "ORIWKS\nROT X20", "ORIMKS\nORIWKS\nROT X20"] {
        assert!(!told("sinumerik-840d", &vector(known), "ORIMKS"), "{known}");
    }
    let klartext = |words: &str| format!("BEGIN PGM A MM\nL X+0 Y+0 Z+10 R0 FMAX\n{words}\nM30\nEND PGM A MM\n");
    for (words, what) in [
        (
            "TOOL CALL 1 Z S1000 F500 DR+0.5\nL X+0 Y+0 Z+10 R0 FMAX M3\nLN X+5 Y+0 Z+5 NX+1 NY+0 NZ+0 F100",
            "LN with DL, DR or DR2",
        ),
        ("CC X+5 Y+0\nC X+10 Y+0 DR+ FMAX", "FMAX beside an arc"),
        ("L X+10 F200\nL X+10 Y+10 RL\nDEP CT CCA-90 R5", "DEP: its words"),
    ] {
        assert!(told("heidenhain-klartext", &klartext(words), what), "{words}");
    }
    for (words, what) in [
        (
            "TOOL CALL 1 Z S1000 F500\nL X+0 Y+0 Z+10 R0 FMAX M3\nLN X+5 Y+0 Z+5 NX+1 NY+0 NZ+0 F100",
            "LN with DL, DR or DR2",
        ),
        ("L X+10 F200\nL X+10 Y+10 RL\nDEP CT CCA90 R5", "DEP: its words"),
    ] {
        assert!(!told("heidenhain-klartext", &klartext(words), what), "{words}");
    }
}
