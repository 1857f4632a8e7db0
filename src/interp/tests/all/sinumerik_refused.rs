//! Sinumerik: blocks at which the control stops, and blocks whose effect no source decides: each has a finding.
use crate::sinumerik_calls::run;
use crate::sinumerik_flow::SINUMERIK;
use crate::support::run_bytes;
use trunnion_interp::{FaultKind, Refusal, Setup};

fn kinds_of(source: &str) -> Vec<FaultKind> {
    let log = run_bytes(SINUMERIK, source.as_bytes(), &Setup::default()).1;
    log.faults.into_iter().map(|fault| fault.kind).collect()
}

/// Whether MCALL acts inside a cycle, or after it, no source says; the drilling cycle of MCALL runs at each hole of a row.
#[test]
fn a_cycle_that_is_called_while_mcall_is_active_is_not_decided() {
    let head = "G17 G90 G54 G71 G94\nG0 X0 Y0 Z50 F100\nS500 M3\n";
    for (modal, call) in [
        ("CYCLE81(10,0,2,-5)", "CYCLE82(10,0,2,-8,,1)"),
        ("CYCLE81(10,0,2,-5)", "CYCLE84(10,0,2,-8,,,3,,1)"),
        ("PLAIN", "CYCLE82(10,0,2,-8,,1)"),
        ("PLAIN", "HOLES1(0,0,30,0,10,2)"),
        ("PLAIN", "HOLES2(0,0,10,90,0,4)"),
        ("PLAIN", "CYCLE801(1,1,0,10,5,2,2)"),
        ("PLAIN", "CYCLE802(1,1,10,20)"),
    ] {
        let (motions, said) = run(&format!("{head}MCALL {modal}\n{call}\nMCALL\nX9\nM30\n"));
        assert_eq!(motions, ["R X0 Y0 Z50"], "{modal} {call}");
        let wanted = "whether MCALL acts in";
        assert!(
            said.iter().any(|said| said.contains(wanted)),
            "{modal} {call}: {said:?}"
        );
    }
    for text in [
        "MCALL CYCLE81(10,0,2,-5)\nHOLES2(0,0,10,90,0,4)\nMCALL\nCYCLE82(10,0,2,-8,,1)\n",
        "MCALL PLAIN\nX5\nMCALL\nHOLES1(0,0,30,0,10,2)\n",
        "MCALL DRILLS\nX5\nMCALL\n",
        "MCALL CYCLE81(10,0,2,-5)\nMCALL CYCLE82(10,0,2,-8,,1)\nX5\nMCALL\n",
    ] {
        let (_, said) = run(&format!("{head}{text}X9\nM30\n"));
        assert!(!said.iter().any(|said| said.contains("MCALL")), "{text}: {said:?}");
    }
}

/// What MCALL does with CYCLE800 no source says, before it and while it is active.
#[test]
fn a_swivel_under_mcall_is_not_decided() {
    let head = "G17 G90 G54 G71 G94\nG0 X0 Y0 Z50 F100\nS500 M3\n";
    let swivel = |direction: &str| format!("CYCLE800(0,\"\",0,57,0,0,0,10,0,0,0,0,0,{direction})");
    for modal in ["CYCLE81(10,0,2,-5)", "PLAIN"] {
        for call in [swivel("1"), swivel("-1"), "CYCLE800(1,\"0\")".to_owned()] {
            let (motions, said) = run(&format!("{head}MCALL {modal}\n{call}\nX5\nMCALL\nM30\n"));
            assert_eq!(motions, ["R X0 Y0 Z50"], "{modal} {call}");
            let wanted = "whether MCALL acts in CYCLE800";
            assert!(
                said.iter().any(|said| said.contains(wanted)),
                "{modal} {call}: {said:?}"
            );
        }
        for call in [swivel("0"), "CYCLE800()".to_owned()] {
            let (_, said) = run(&format!("{head}MCALL {modal}\n{call}\nMCALL\nM30\n"));
            assert!(
                !said.iter().any(|said| said.contains("MCALL")),
                "{modal} {call}: {said:?}"
            );
        }
    }
    for call in [swivel("1"), swivel("0"), "CYCLE800()".to_owned()] {
        let (motions, said) = run(&format!("{head}MCALL {call}\nX5\nMCALL\nX9\nM30\n"));
        assert!(
            said.iter().any(|said| said.contains("CYCLE800 after MCALL")),
            "{call}: {said:?}"
        );
        assert!(
            motions[1..].iter().all(|line| !line.contains("X5")),
            "{call}: {motions:?}"
        );
    }
}

/// The control stops at the block that computes it, whether or not anything reads the variable.
#[test]
fn arithmetic_without_a_value_is_refused_where_it_stands() {
    for (text, why) in [
        ("R1=1/0", "division by zero in `1/0`"),
        ("R1=5 MOD 0", "division by zero in `5 MOD 0`"),
        ("R1=5 DIV (R2-R2)", "division by zero"),
        ("R1=SQRT(-1)", "square root of a negative number"),
        ("R1=LN(0)", "LN of zero"),
        ("R1=2*ASIN(2)", "ASIN of a number outside"),
        ("R1=ACOS(-1.5)", "ACOS of a number outside"),
        ("A1=1/R2", "division by zero"),
        ("F1[1]=1/R2", "division by zero"),
        ("F1[0]=SET(1,1/R2)", "division by zero"),
        ("IF 1/R2>3 GOTOF LA", "division by zero"),
    ] {
        let kinds = kinds_of(&format!("DEF REAL A1, F1[3]\nR2=0\n{text}\nLA: G0 X5\nM30\n"));
        let refused = kinds.iter().filter(|kind| {
            matches!(kind, FaultKind::Rejected { refusal: Refusal::Expression, message, .. } if message.contains(why))
        });
        assert_eq!(refused.count(), 1, "{text}: {kinds:?}");
    }
    let defined = kinds_of("DEF REAL A1=1/0, B1=SQRT(4)\nG0 X=B1\nM30\n");
    assert_eq!(defined.len(), 1, "{defined:?}");
    // the variable has no value then
    let (_, said) = run("R1=1/0\nG0 X=R1\nM30\n");
    assert!(
        said[0].starts_with("1 `R1=1/0` Expression") && said[1].starts_with("2 `R1`"),
        "{said:?}"
    );
}

/// What is not known may have a value with which it has a result.
#[test]
fn arithmetic_of_unknown_operands_is_no_fault() {
    for text in [
        "R1=R5/0",
        "R1=1/R5",
        "R1=SQRT(R5)",
        "R1=R5 MOD 0",
        "R1=LN($AA_IM[X]-1)",
        "R1=SQRT(4)/2",
    ] {
        let (_, said) = run(&format!("{text}\nG0 X5\nM30\n"));
        assert_eq!(said, [""; 0], "{text}");
    }
}

#[test]
fn what_a_variable_does_not_hold_is_named() {
    for (text, what) in [
        ("DEF INT AB[2]\nAB[5]=3", "AB[5]: the field has no such element"),
        ("DEF INT AB[2]\nR1=2\nAB[R1]=3", "AB[R1]: the field has no such element"),
        ("DEF REAL AB[2]\nAB[-1]=3", "no such element"),
        ("DEF REAL AB[2,2]\nAB[1]=3", "has 2 dimensions"),
        ("DEF REAL AB[2]\nAB[2]=SET(1)", "no such element"),
        ("DEF STRING[5] AB[2]\nAB[2]=\"A\"", "no such element"),
        (
            "DEF INT A1[2]=SET(1,2,3)",
            "A1: `SET(1,2,3)` does not fit into the field of 2 elements",
        ),
        ("DEF INT A1[2]\nA1[0]=SET(1,2,3)", "does not fit"),
        ("DEF INT A1[2]\nA1[1]=SET(1,2)", "does not fit"),
        ("DEF INT A1[2]=REP(1,3)", "does not fit"),
        ("DEF INT A1=5000000000", "A1: 5000000000 is outside of the range of INT"),
        ("DEF INT A1\nA1=-3EX9", "outside of the range of INT"),
        ("DEF INT A1[2]\nA1[1]=3000000000", "outside of the range of INT"),
        ("DEF INT A1[2]=SET(1,3000000000)", "outside of the range of INT"),
        ("R[-1]=5", "there is no R parameter with the number -1"),
    ] {
        let kinds = kinds_of(&format!("{text}\nG0 X5\nM30\n"));
        assert_eq!(kinds.len(), 1, "{text}: {kinds:?}");
        assert!(format!("{:?}", kinds[0]).contains(what), "{text}: {kinds:?}");
    }
    for text in [
        "DEF INT AB[2]\nAB[1]=3\nAB[0]=SET(1,2)\nAB[R9]=4",
        "DEF INT AB[2,3]=SET(1,2,3,4,5,6)\nAB[1,2]=7\nAB[0,1]=REP(2,3)",
        "DEF STRING[5] AB[2]\nAB[1]=\"A\"\nAB[1,0]=\"B\"",
        "DEF INT A1=2147483647\nDEF REAL B1=5000000000",
    ] {
        let (_, said) = run(&format!("{text}\nG0 X5\nM30\n"));
        assert_eq!(said, [""; 0], "{text}");
    }
}

/// Messages of what the control refuses.
fn refused(source: &str) -> Vec<String> {
    let messages = kinds_of(source).into_iter().filter_map(|kind| match kind {
        FaultKind::Rejected { message, .. } => Some(message),
        _ => None,
    });
    messages.collect()
}

/// The control stops where it reads an element that a field does not have, as where it writes one.
#[test]
fn an_element_that_is_not_there_is_refused_where_it_is_read() {
    let head = "DEF INT AB[2], CD[2,2]\nDEF STRING[5] EF[2]\nR2=7\nG0 X1\n";
    for (text, what) in [
        ("R1=AB[5]", "AB[5]: the field has no such element"),
        ("R1=3*(AB[R2]+1)", "AB[R2]: the field has no such element"),
        ("R1=CD[1,2]", "CD[1,2]: the field has no such element"),
        ("R1=R99+AB[-1]", "AB[-1]"),
        ("R1=AB[AB[0]+2]", "AB[AB[0]+2]"),
        ("R1=STRLEN(EF[2])", "EF[2]: the field has no such element"),
        ("G0 X=AB[5]", "AB[5]"),
        ("G0 X=IC(AB[5])", "AB[5]"),
        ("IF AB[5]==3 GOTOF LA", "AB[5]"),
        ("SOMETHING(AB[5])", "AB[5]"),
        ("L140(3,AB[5])", "AB[5]"),
        ("R1=R[-1]", "there is no R parameter with the number -1"),
        ("IF R[-1]==0 GOTOF LA", "there is no R parameter with the number -1"),
    ] {
        let source = format!("EXTERN SOMETHING(INT)\n{head}{text}\nLA: G0 X5\nM30\n");
        let found = refused(&source);
        assert!(found.len() == 1 && found[0].contains(what), "{text}: {found:?}");
    }
    for (text, what) in [
        ("R1=CD[1]", "CD[1]: the field has 2 dimensions"),
        ("R1=AB[0.5]", "AB[0.5]"),
        ("R1=R[0.5]", "R[0.5]"),
    ] {
        let kinds = kinds_of(&format!("{head}{text}\nM30\n"));
        let says = |kind: &FaultKind| matches!(kind, FaultKind::NotModelled { what: said } if said.contains(what));
        assert!(kinds.len() == 1 && says(&kinds[0]), "{text}: {kinds:?}");
    }
    for text in [
        "R1=AB[R99]",
        "R1=AB[1]+CD[1,1]",
        "EF[0]=\"AB[5]\"",
        "R1=STRLEN(EF[1])",
        "G0 X=AB[0]+$P_EP[X]",
    ] {
        assert_eq!(refused(&format!("{head}{text}\nM30\n")), [""; 0], "{text}");
    }
}

#[test]
fn arguments_and_words_without_a_value_are_refused() {
    for (text, what) in [
        ("L140(1/0)", "division by zero in `1/0`"),
        ("L140(SQRT(-1),1/0)", "square root"),
        ("PCALL L140(1/0)", "division by zero"),
        ("G0 X=1/0", "division by zero"),
        ("G0 X=IC(1/0)", "division by zero"),
        ("G1 X5 F=LN(0)", "LN of zero"),
    ] {
        let found = refused(&format!("G0 X1\n{text}\nM30\n"));
        assert!(!found.is_empty() && found[0].contains(what), "{text}: {found:?}");
    }
    let kinds = kinds_of("G0 X1\nR1=TAN(90)\nM30\n");
    assert!(
        kinds.len() == 1 && format!("{kinds:?}").contains("TAN of 90"),
        "{kinds:?}"
    );
}

#[test]
fn an_end_without_its_beginning_breaks_the_structure() {
    for text in ["UNTIL 1", "ENDIF", "UNTIL 0", "ELSE", "ENDLOOP", "ENDFOR", "ENDWHILE"] {
        let (motions, said) = run(&format!("G0 X1\n{text}\nX2\nM30\n"));
        let word = text.split(' ').next().unwrap_or_default();
        assert_eq!(said.len(), 1, "{text}: {said:?}");
        assert!(
            said[0].starts_with("2 `") && said[0].contains("Structure"),
            "{word}: {said:?}"
        );
        assert_eq!(motions, ["R X1"], "{text}");
    }
    let (_, said) = run("R1=1\nREPEAT\nIF R1\nR1=0\nENDIF\nUNTIL R1==0\nG0 X2\nM30\n");
    assert_eq!(said, [""; 0]);
}

#[test]
fn numbers_that_begin_with_zero_are_not_negative() {
    for text in [
        "D-1",
        "S-100",
        "T-1",
        "N-5 X2",
        "T=-1 M6",
        "LIMS=-5",
        "G96 S100 LIMS=-5",
        "R1=-3\nS=R1 M3",
        "G96 S-100",
    ] {
        let kinds = kinds_of(&format!("G0 X1\n{text}\nX2\nM30\n"));
        let refused = kinds.iter().filter(|kind| {
            matches!(
                kind,
                FaultKind::Rejected {
                    refusal: Refusal::Number,
                    ..
                }
            )
        });
        assert_eq!(refused.count(), 1, "{text}: {kinds:?}");
    }
    let dwell = kinds_of("G0 X1\nG4 S-2\nM30\n");
    assert_eq!(dwell.len(), 1, "{dwell:?}");
    for text in ["D0", "T0", "S0", "LIMS=0", "H-3"] {
        let kinds = kinds_of(&format!("G0 X1\n{text}\nM30\n"));
        assert!(
            !kinds.iter().any(|kind| matches!(kind, FaultKind::Rejected { .. })),
            "{text}: {kinds:?}"
        );
    }
}

#[test]
fn two_times_of_a_dwell_and_words_beside_mcall_are_named() {
    let (motions, said) = run("G0 X1\nS500 M3\nG4 F1 S2\nM30\n");
    assert_eq!(motions, ["R X1", "D? X1"]);
    assert!(said.len() == 1 && said[0].contains("a dwell with F and S"), "{said:?}");
    let (motions, said) = run("G0 X1\nS500 M3\nG4 F1\nG4 S5\nM30\n");
    assert_eq!(motions, ["R X1", "D1 X1", "D0.6 X1"]);
    assert_eq!(said, [""; 0]);
    for words in ["X5", "F200", "R1=5", "X5 Y6"] {
        let text = format!("G17 G0 X1 Y1 Z9 F100 S500 M3\nMCALL CYCLE81(10,0,2,-5)\nMCALL {words}\nG0 Z7\nM30\n");
        let (motions, said) = run(&text);
        assert!(
            said.len() == 1 && said[0].contains("words beside MCALL"),
            "{words}: {said:?}"
        );
        let known = motions.iter().any(|line| line.contains("X5"));
        assert!(!known, "{words}: {motions:?}");
    }
    let (_, said) = run("G17 G0 X1 Y1 Z9 F100 S500 M3\nMCALL CYCLE81(10,0,2,-5)\nN20 MCALL\nG0 X5\nM30\n");
    assert_eq!(said, [""; 0]);
}
