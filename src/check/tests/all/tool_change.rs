//! After a tool change motions are judged from where it has left the machine.
use trunnion_check::{Diagnostic, Settings, check};
use trunnion_interp::Setup;
use trunnion_machine::Machine;

/// X moves, Z was taken up by the change: 300 mm on the machine.
const PROGRAMS: [(&str, &str); 3] = [
    (
        "sinumerik-840d",
        "G17 G71 G90 G94 G54\nT1 D1 M6\nS1000 M3\nG0 X0 Y0 Z50\nT5 D1 M6\nS200 M3\nG1 X1 F300\nX20\nM30\n",
    ),
    (
        "fanuc-30i",
        "G17 G21 G90 G94 G54\nT1 M6\nS1000 M3\nG43 H1 G0 X0. Y0. Z50.\nT5 M6\nS200 M3\nG1 X1. F300.\nX20.\nM30\n",
    ),
    (
        "heidenhain-klartext",
        "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000 F200\n2 M3\n3 L X0 Y0 Z50 R0 FMAX\n4 TOOL CALL 5 Z S200 F300\n5 M3\n6 L X1 FAUTO\n7 L X20\n9 M30\n10 END PGM T MM\n",
    ),
];

fn judged(dialect: &str, machine: &Machine, text: &str) -> Vec<Diagnostic> {
    let mut setup = Setup::default();
    setup.control.tool_change = machine.control.tool_change;
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let settings = Settings {
        assume: trunnion_check::Assume::ALL,
        ..Settings::new(dialect, Some(machine), setup)
    };
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    check(&program, &settings).diagnostics
}

#[test]
fn an_axis_that_the_change_has_moved_does_not_move_again() {
    let machine = trunnion_machine::builtin("mill-3axis").expect("built in");
    for (dialect, text) in PROGRAMS {
        let found = judged(dialect, machine, text);
        let fast = found.iter().any(|found| found.rule == "axis-overspeed");
        assert!(!fast, "{dialect}: {found:#?}");
        // it is a mistake of the program where it really moves so
        let down = text.replace("X20", "Z-300 F30000");
        let found = judged(dialect, machine, &down);
        let fast = found.iter().any(|found| found.rule == "axis-overspeed");
        assert!(fast, "{dialect}: {found:#?}");
    }
}
