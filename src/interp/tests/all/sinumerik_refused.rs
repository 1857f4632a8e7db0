//! Sinumerik: blocks at which the control stops, and blocks whose effect no source decides: each has a finding.
use crate::sinumerik_calls::run;

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
