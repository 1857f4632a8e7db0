//! HEIDENHAIN Klartext: the unit of BEGIN PGM holds for one program; its caller goes on in its own.
use crate::klartext::{NAME, program};
use crate::support::{fault_line, line, run_bytes};
use std::sync::Arc;
use trunnion_interp::{Files, Library, Loaded, Searched, Setup};

struct Programs;

impl Files for Programs {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let text = match name.split('.').next().unwrap_or_default() {
            "INCH" => "BEGIN PGM INCH INCH\nL X+1 R0 F100\nEND PGM INCH INCH\n",
            "EARLY" => "BEGIN PGM EARLY INCH\nL X+1 R0 F100\nM2\nL X+2\nEND PGM EARLY INCH\n",
            "LABEL" => "BEGIN PGM LABEL INCH\nCALL LBL 1\nM30\nLBL 1\nL X+1 R0 F100\nM2\nLBL 0\nEND PGM LABEL INCH\n",
            "NESTED" => "BEGIN PGM NESTED INCH\nCALL PGM MM\nL X+1 F100\nEND PGM NESTED INCH\n",
            "MM" => "BEGIN PGM MM MM\nL X+7 R0 F100\nEND PGM MM MM\n",
            "HOLE" => "BEGIN PGM HOLE INCH\nM99\nEND PGM HOLE INCH\n",
            "DEFINES" => {
                "BEGIN PGM DEFINES INCH\nCYCL DEF 200 Q200=+1 Q201=-1 Q206=+10 Q202=+9 Q203=+0 Q204=+1\nEND PGM DEFINES INCH\n"
            }
            _ => return Err(Vec::new()),
        };
        Ok(Loaded {
            path: name.to_owned(),
            bytes: text.as_bytes().into(),
        })
    }
}

/// Motions after the first, and faults.
fn run(text: &str) -> (Vec<String>, Vec<String>) {
    let setup = Setup {
        library: Library(Some(Arc::new(Programs))),
        ..Setup::default()
    };
    let (program, log) = run_bytes(NAME, text.as_bytes(), &setup);
    let motions = log.motions[1..].iter().map(line).collect();
    let mut faults: Vec<String> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    faults.retain(|fault| !fault.contains("ToolLengthUnset"));
    (motions, faults)
}

const START: &str = "L X+0 Y+0 Z+0 R0 FMAX\n";

#[test]
fn the_caller_goes_on_in_its_own_unit() {
    for called in ["INCH", "EARLY", "LABEL"] {
        let (motions, faults) = run(&program(&format!("{START}CALL PGM {called}\nL X+5\nL IX+5 F200\n")));
        let expected = ["L X25.4 Y0 Z0 F254", "L X5 Y0 Z0 F254", "L X10 Y0 Z0 F200"];
        assert_eq!(motions, expected, "{called}");
        // not so M2 and M30 in a called program
        assert!(
            faults.iter().all(|fault| fault.contains("in a called program")),
            "{faults:?}"
        );
    }
    let inch = format!("BEGIN PGM T INCH\n{START}CALL PGM MM\nL X+1\nL X+2 F100\nEND PGM T INCH\n");
    let (motions, faults) = run(&inch);
    let expected = ["L X7 Y0 Z0 F100", "L X25.4 Y0 Z0 F100", "L X50.8 Y0 Z0 F254"];
    assert_eq!(motions, expected);
    assert_eq!(faults, [""; 0]);
}

#[test]
fn programs_inside_each_other_each_have_their_unit() {
    let (motions, faults) = run(&program(&format!(
        "{START}CALL PGM NESTED\nL X+5 F200\nSEL PGM \"INCH\"\nCALL SELECTED PGM\nL X+3\n"
    )));
    let expected = [
        "L X7 Y0 Z0 F100",
        "L X25.4 Y0 Z0 F254",
        "L X5 Y0 Z0 F200",
        "L X25.4 Y0 Z0 F254",
        "L X3 Y0 Z0 F254",
    ];
    assert_eq!(motions, expected);
    assert_eq!(faults, [""; 0]);
}

/// The parameters of a cycle are numbers: no source says in which unit they count in a program with another one.
#[test]
fn a_cycle_of_a_program_with_another_unit_is_not_decided() {
    let hole = "CYCL DEF 200 Q200=+2 Q201=-5 Q206=+100 Q202=+9 Q203=+0 Q204=+2\n";
    for blocks in [
        format!("{hole}CALL PGM HOLE\n"),
        "CALL PGM DEFINES\nCYCL CALL\n".to_owned(),
    ] {
        let (motions, faults) = run(&program(&format!("{START}{blocks}")));
        assert_eq!(motions, ["U X0 Y0"], "{blocks}");
        assert!(faults[0].contains("a program in another unit"), "{faults:?}");
    }
    let (motions, faults) = run(&program(&format!("{START}{hole}CALL PGM INCH\nCYCL CALL\n")));
    assert!(!motions.iter().any(|line| line.starts_with('U')), "{motions:?}");
    assert_eq!(faults, [""; 0]);
}
