//! HEIDENHAIN Klartext: labels that a file has twice, jumps on defined parameters, programs that are not there, and the words of TOOL CALL.
use crate::klartext::{NAME, program};
use crate::support::{faults, line, lines, run_bytes, run_text};
use std::sync::Arc;
use trunnion_interp::{Files, Library, Loaded, Searched, Setup};

/// One file under any name.
struct OneFile(&'static str);

impl Files for OneFile {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        Ok(Loaded {
            path: format!("sub/{name}"),
            bytes: self.0.as_bytes().into(),
        })
    }
}

fn of_labels(blocks: &str) -> Vec<String> {
    let mut found = faults(NAME, &program(blocks));
    found.retain(|fault| fault.contains("Label"));
    found
}

/// The control refuses the program when it is loaded, whether or not something calls the label.
#[test]
fn a_label_that_the_program_has_twice_is_told_without_a_call() {
    for (label, name) in [("5", "5"), ("\"A\"", "\\\"A\\\"")] {
        let twice = format!("L X+1 R0 FMAX\nLBL {label}\nL X+2\nM30\nLBL {label}\nL X+3\nLBL 0\n");
        let wanted = format!("label {name} more than once: in line 4 and in line 7");
        let found = of_labels(&twice);
        assert!(found[0].starts_with("7: ") && found[0].contains(&wanted), "{found:?}");
        assert_eq!(found.len(), 1, "{found:?}");
        // the run of the blocks goes on, so that other mistakes are found as well
        assert_eq!(lines(NAME, &program(&twice)), ["R X1", "L X2"]);
        // three times: each place with the first
        let found = of_labels(&format!("{twice}LBL {label}\n"));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[1].contains("in line 4 and in line 10"), "{found:?}");
        // a call ends the run, and says why
        let found = of_labels(&format!("CALL LBL {label}\n{twice}"));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(
            found.iter().all(|fault| fault.contains("in line 5 and in line 8")),
            "{found:?}"
        );
    }
    for once in ["LBL 0\nLBL 0\n", "LBL 1\nLBL 2\nLBL \"1\"\n", "LBL 5\n; LBL 5\n"] {
        assert_eq!(of_labels(once), [""; 0], "{once}");
    }
}

#[test]
fn a_called_program_with_a_label_twice_is_told_with_its_path() {
    let setup = Setup {
        library: Library(Some(Arc::new(OneFile(
            "BEGIN PGM S MM\nLBL 3\nL X+5 FMAX\nLBL 3\nL Y+5\nEND PGM S MM\n",
        )))),
        ..Setup::default()
    };
    let text = program("CALL PGM S\nCALL PGM S\n");
    let (_, log) = run_bytes(NAME, text.as_bytes(), &setup);
    let told: Vec<String> = log.faults.iter().map(|fault| format!("{:?}", fault.kind)).collect();
    let told: Vec<&String> = told.iter().filter(|fault| fault.contains("Label")).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("sub/S: the program has label 3 more than once: in line 2 and in line 4"),
        "{told:?}"
    );
    assert_eq!(
        log.faults
            .iter()
            .find(|fault| format!("{fault:?}").contains("Label"))
            .map(|fault| fault.block.0),
        Some(2)
    );
}

/// The target of a jump moves to X9.
fn jumps(before: &str, question: &str) -> Vec<String> {
    lines(
        NAME,
        &program(&format!(
            "{before}{question} GOTO LBL 5\nL X+1 R0 FMAX\nLBL 5\nL X+9 R0 FMAX\n"
        )),
    )
}

#[test]
fn a_jump_asks_whether_a_parameter_is_defined() {
    let [through, over] = [vec!["R X1", "R X9"], vec!["R X9"]];
    for (before, asked) in [
        ("Q1 = 3\n", "+Q1"),
        ("FN 0: Q1 = +0\n", "Q1"),
        ("QL4 = 1\n", "+QL4"),
        ("QR7 = 1\n", "+QR7"),
        ("QS2 = \"A\"\n", "QS2"),
        ("QS2 = \"\"\n", "+QS2"),
    ] {
        assert_eq!(jumps(before, &format!("FN 9: IF {asked} IS DEFINED")), over, "{before}");
        assert_eq!(
            jumps(before, &format!("FN 9: IF {asked} IS UNDEFINED")),
            through,
            "{before}"
        );
        assert_eq!(
            of_labels(&format!("{before}FN 9: IF {asked} IS UNDEFINED GOTO LBL 9\n")),
            [""; 0]
        );
    }
    // a label that is missing, and a name as the target
    let found = of_labels("Q1 = 3\nFN 9: IF +Q1 IS DEFINED GOTO LBL 7\n");
    assert!(found[0].contains("no label 7"), "{found:?}");
    let named = program("Q1 = 3\nFN 9: IF +Q1 IS DEFINED GOTO LBL \"END\"\nL X+1 FMAX\nLBL \"END\"\nL X+9 FMAX\n");
    assert_eq!(lines(NAME, &named), ["R X9"]);
}

#[test]
fn where_it_is_not_known_whether_a_parameter_is_defined_the_jump_is_unknown_by_name() {
    for (blocks, reason) in [
        ("FN 9: IF +Q1 IS DEFINED GOTO LBL 5", "whether Q1 is defined"),
        (
            "FN 9: IF +Q1 IS UNDEFINED GOTO LBL 5",
            "Q1: the program does not set its value",
        ),
        ("FN 9: IF QS1 IS UNDEFINED GOTO LBL 5", "whether QS1 is defined"),
        (
            "FN 18: SYSREAD Q1 = ID20 NR5\nFN 9: IF +Q1 IS DEFINED GOTO LBL 5",
            "FN 18: SYSREAD Q1",
        ),
        (
            "Q1 = 3\nCALL PGM GONE\nFN 9: IF +Q1 IS DEFINED GOTO LBL 5",
            "whether Q1 is defined",
        ),
        ("Q1 = 3\nFN 10: IF +Q1 IS DEFINED GOTO LBL 5", "FN 10 with IS DEFINED"),
    ] {
        let text = program(&format!("{blocks}\nLBL 5\n"));
        let found = faults(NAME, &text);
        assert!(
            found
                .iter()
                .any(|fault| fault.contains("NotDecided") && fault.contains(reason)),
            "{blocks}: {found:?}"
        );
        assert!(
            !found.iter().any(|fault| fault.contains("Rejected")),
            "{blocks}: {found:?}"
        );
    }
    for wrong in [
        "IF +Q1 IS GOTO LBL 5",
        "IF +3 IS DEFINED GOTO LBL 5",
        "IF +Q1 IS DEFINED LBL 5",
        "IF +Q1 IS DEFINED GOTO",
    ] {
        let found = faults(NAME, &program(&format!("Q1 = 3\nFN 9: {wrong}\nLBL 5\n")));
        assert!(
            found.iter().any(|fault| fault.contains("Rejected")),
            "{wrong}: {found:?}"
        );
    }
}

/// What it leaves stays after its end.
#[test]
fn after_a_program_that_is_missing_each_transformation_must_be_set_again() {
    let back = [
        "CYCL DEF 7.0 D\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\nCYCL DEF 7.3 Z+0\n",
        "CYCL DEF 8.0 M\nCYCL DEF 8.1\n",
        "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+0\n",
        "CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL1\n",
        "CYCL DEF 26.0 S\nCYCL DEF 26.1 X1 Y1 Z1\n",
        "PLANE RESET STAY\n",
    ];
    let ends = |back: &[&str]| {
        let text = program(&format!(
            "L X+0 Y+0 Z+0 R0 FMAX\nCALL PGM GONE\n{}L X+1 Y+2 Z+3 FMAX\n",
            back.concat()
        ));
        run_text(NAME, &text).motions.last().and_then(|motion| motion.end.xyz())
    };
    assert!(ends(&back).is_some());
    for left in 0..back.len() {
        let mut some = back.to_vec();
        some.remove(left);
        assert_eq!(ends(&some), None, "without {}", back[left]);
    }
    // an angle that is added to an unknown one is unknown
    let mut added = back.to_vec();
    added[2] = "CYCL DEF 10.0 R\nCYCL DEF 10.1 IROT+0\n";
    assert_eq!(ends(&added), None);
    // cycle 12 calls a program as well
    let text = program(
        "L X+0 Y+0 Z+0 R0 FMAX\nCYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM GONE\nCYCL CALL\nL X+1 Y+2 Z+3 FMAX\n",
    );
    let last = run_text(NAME, &text).motions.pop().expect("a line");
    assert_eq!(last.end.xyz(), None);
    assert!(faults(NAME, &text).iter().any(|fault| fault.contains("cycle 12")));
}

fn ends(blocks: &str) -> String {
    let text = program(&format!("TOOL DEF 5 L+50 R+4\n{blocks}"));
    run_text(NAME, &text).motions.last().map(line).expect("a motion")
}

/// The machine stays; a tool that counts as longer by 1 mm has its tip 1 mm lower.
#[test]
fn another_length_of_the_same_tool_moves_its_tip_along_it() {
    let at = "TOOL CALL 5 Z S2000\nL X+1 Y+2 Z+3 R0 FMAX\n";
    assert_eq!(ends(&format!("{at}TOOL CALL DL+1\nL IX+1 FMAX\n")), "R X2 Y2 Z2");
    assert_eq!(ends(&format!("{at}TOOL CALL S500\nL IX+1 FMAX\n")), "R X2 Y2 Z3");
    let longer = at.replace("S2000", "S2000 DL+0,5");
    assert_eq!(ends(&format!("{longer}TOOL CALL DL-0,5\nL IX+1 FMAX\n")), "R X2 Y2 Z4");
    // the length of the tool is not declared: nor is where its tip is
    let text = program("L X+1 Y+2 Z+3 R0 FMAX\nTOOL CALL DL+1\nL IX+1 FMAX\n");
    assert_eq!(lines(NAME, &text)[1], "R X2 Y2");
    // a tool that leans moves along other axes too
    let led = format!("{at}M128\nL X+1 Y+2 Z+3 FMAX\nTOOL CALL DL+1\nL IX+1 FMAX\n");
    assert_eq!(ends(&led), "R - tcp");
}

/// `DR2:+0.5`, as HEIDENHAIN writes it.
#[test]
fn a_colon_parts_a_word_from_its_value() {
    let at = "L X+1 Y+2 Z+3 R0 FMAX\n";
    for call in [
        "TOOL CALL 5 Z S2000 DL+0,2 DR2+0,5",
        "TOOL CALL 5 Z S2000 DL+0.2 DR2:+0.5",
        "TOOL CALL 5 Z S2000 DL:+0,2 DR2:0,5",
        "Q1 = 0,2\nTOOL CALL 5 Z S2000 DL:+Q1 DR2: +0,5",
    ] {
        let text = program(&format!("TOOL DEF 5 L+50 R+4\n{call}\n{at}"));
        let motions = run_text(NAME, &text).motions;
        let motion = motions.last().expect("a line");
        assert!(
            (motion.tool_length_mm - 50.2).abs() < 1e-9,
            "{call}: {}",
            motion.tool_length_mm
        );
        assert_eq!(motion.spindle_rpm, Some(2000.0), "{call}");
    }
    // other words have no colon
    assert!(!faults(NAME, &program("L X:+1 Y+2 Z+3 R0 FMAX\n")).is_empty());
}
