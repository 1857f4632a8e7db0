//! CYCLE832 in both forms, DIAMOF on a machine whose X words are diameters, positions of the machine as values.
use crate::support::{fault_line, run_bytes};
use trunnion_interp::Setup;

/// Whether each line is one of the tip, its end if known, and what was reported.
fn run(text: &str, setup: &Setup) -> (Vec<(bool, bool)>, Vec<String>) {
    let (program, log) = run_bytes("sinumerik-840d", text.as_bytes(), setup);
    let told = log.faults.iter().map(|fault| fault_line(&program, fault));
    (
        log.motions
            .iter()
            .map(|motion| (motion.tcp, motion.end.xyz().is_some()))
            .collect(),
        told.filter(|fault| fault.contains("NotModelled")).collect(),
    )
}

#[test]
fn the_older_form_of_cycle832_switches_the_transformation() {
    let setup = Setup::default();
    for (before, call, tip) in [
        // new: 0 to 4, and plus 10
        ("", "CYCLE832(0.01,1,1)", false),
        ("TRAORI", "CYCLE832(0.01,12,0.5)", true),
        ("TRAORI", "CYCLE832(0.01,_ORI_FINISH,0.5)", true),
        ("TRAORI", "CYCLE832()", true),
        ("TRAORI", "CYCLE832(0.01)", true),
        // old: the third digit from the right
        ("", "CYCLE832(0.01,112101)", true),
        ("TRAORI", "CYCLE832(0.01,112101)", true),
        ("TRAORI", "CYCLE832(0.01,112001)", false),
        ("", "CYCLE832(0.01,2001)", false),
        ("R1=112101", "CYCLE832(0.01,R1)", true),
    ] {
        let text = format!("{before}\n{call}\nG1 X1 Y2 Z3 F100\n");
        let (found, told) = run(&text, &setup);
        assert_eq!((found, told), (vec![(tip, true)], vec![]), "{text}");
    }
    for mode in ["112201", "112901", "R99"] {
        let text = format!("CYCLE832(0.01,{mode})\nG1 X1 Y2 Z3 F100\nTRAFOOF\nG1 X1 Y2 Z3\n");
        let (found, told) = run(&text, &setup);
        let ends: Vec<bool> = found.iter().map(|(_, known)| *known).collect();
        assert_eq!(ends, [false, true], "{text}: {told:?}");
        assert!(
            told.iter().any(|fault| fault.contains("which transformation")),
            "{told:?}"
        );
    }
}

#[test]
fn a_radius_on_a_machine_of_diameters_is_unknown_by_name() {
    let mut setup = Setup::default();
    let text = "DIAMOF\nG1 X10 Y2 Z3 F100\n";
    assert_eq!(run(text, &setup), (vec![(false, true)], vec![]));
    setup.control.x_diameter = true;
    let (found, told) = run(text, &setup);
    assert_eq!(found, [(false, false)]);
    assert!(told.iter().any(|fault| fault.contains("DIAMOF")), "{told:?}");
}

/// $AA_IM is known where the zero point and the tool's length are declared, $P_TOOLR where the tool is.
#[test]
fn positions_of_the_machine_and_the_radius_of_the_tool() {
    let mut setup = trunnion_interp::Setup::default();
    let mut values = [0.0; 9];
    (values[0], values[2], values[5]) = (100.0, -50.0, 7.0);
    setup.work_offsets.push(trunnion_interp::WorkOffset {
        name: "G54".to_owned(),
        values,
    });
    setup.tools.push(trunnion_interp::Tool {
        number: 1,
        shape: None,
        diameter_mm: Some(12.0),
        length_mm: Some(80.0),
        holder_mm: None,
    });
    let ends = |text: &str, setup: &trunnion_interp::Setup| {
        let log = crate::support::run_bytes("sinumerik-840d", text.as_bytes(), setup).1;
        log.motions.last().expect("a motion").end
    };
    let head = "G54 G90 G71 T1 D1\nM6\nG1 X1 Y2 Z3 C20 F100\n";
    for (name, x) in [
        ("$AA_IM[X]", Some(101.0)),
        ("$AA_IM[Y]", Some(2.0)),
        // the length of 80 mm lies along Z
        ("$AA_IM[Z]", Some(33.0)),
        ("$AA_IM[C]", Some(27.0)),
        ("$P_TOOLR", Some(6.0)),
    ] {
        assert_eq!(ends(&format!("{head}X={name}"), &setup).get(0), x, "{name}");
        let undeclared = ends(&format!("{head}X={name}"), &trunnion_interp::Setup::default());
        assert_eq!(undeclared.get(0), None, "{name}");
        let other = if name == "$P_TOOLR" { "D2" } else { "TRAORI" };
        assert_eq!(
            ends(&format!("{head}{other}\nX={name}"), &setup).get(0),
            None,
            "{name} {other}"
        );
    }
}
