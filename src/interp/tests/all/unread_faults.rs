//! A reader of motions that leaves the faults alone sees the same run.
use crate::support::faults;
use trunnion_dialect::builtin;
use trunnion_interp::{Argument, Effect, Fault, Interpreter, ModalState, Motion, Placed, Setup, Sink};
use trunnion_syntax::parse;

#[derive(Default)]
struct Seen {
    reads_faults: bool,
    motions: Vec<(Motion, ModalState)>,
    effects: Vec<Placed>,
    faults: usize,
}

impl Sink for Seen {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.motions.push((*motion, state.clone()));
    }
    fn fault(&mut self, _: Fault) {
        self.faults += 1;
    }
    fn reads_faults(&self) -> bool {
        self.reads_faults
    }
    fn effect(&mut self, effect: Placed) {
        self.effects.push(effect);
    }
}

fn seen(dialect: &str, text: &str, reads_faults: bool) -> Seen {
    let dialect = builtin(dialect).expect("a built-in dialect");
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    let setup = Setup::default();
    let mut seen = Seen {
        reads_faults,
        ..Seen::default()
    };
    let mut run = Interpreter::new(dialect, &setup);
    run.watch_effects();
    while run.advance(&program, &mut seen).is_some() {}
    seen
}

#[test]
fn a_run_whose_faults_are_not_read_is_the_same() {
    let wrong = [
        "",
        "QQ0 @ W! \\ ~0",
        "G999 X3",
        "G1 X4",
        "G38.2 X5",
        "G43 H99",
        "G2 X9 I1",
        "#<_a> = [1/0]",
        "o99 call",
        "o<missing> call [1]",
        "M66 P99 L9",
        "(abort, stop)",
        "G33 X1 K1",
        "%",
        "o1 endif",
    ];
    let mut silent = 0;
    for line in wrong {
        for end in ["M2\n", ""] {
            let text = format!("G21 G90 G54\nG0 X1 Y1 Z1\n{line}\nG1 X2 F100\n{line}\nX3 Y4\n{end}");
            let [read, unread] = [true, false].map(|reads| seen("linuxcnc", &text, reads));
            assert!(read.motions == unread.motions, "{text}");
            assert!(read.effects == unread.effects, "{text}");
            silent += read.faults - unread.faults;
        }
    }
    assert!(silent > 20, "{silent} faults were left out");
}

/// `PCALL /_N_SPF_DIR/_N_SG_SPF(9)`: the path is a part of the statement, whose slashes delete nothing.
#[test]
fn a_call_by_a_path_is_one_statement() {
    let does = |call: &str| {
        let effects = seen("sinumerik-840d", &format!("G0 X1\n{call}\nX2\nM30\n"), true).effects;
        let here = effects.into_iter().filter(|placed| placed.block.0 == 1);
        here.map(|placed| placed.effect)
            .filter(|effect| matches!(effect, Effect::Unmodelled(_) | Effect::Event(_)))
            .collect::<Vec<_>>()
    };
    for (call, text) in [
        ("PCALL /_N_SPF_DIR/_N_SG_SPF(9)", "PCALL / _N_SPF_DIR / _N_SG_SPF(9)"),
        ("N20 CALL /_N_SPF_DIR/_N_SG_SPF ; side", "CALL / _N_SPF_DIR / _N_SG_SPF"),
        ("EXTCALL(\"C:/_N_SG_SPF\")", "EXTCALL(\"C:/_N_SG_SPF\")"),
        ("CALL \"/_N_SPF_DIR/_N_SG_SPF\"", "CALL\"/_N_SPF_DIR/_N_SG_SPF\""),
        ("CALL BLOCK AA TO BB", "CALL BLOCK AA TO BB"),
    ] {
        assert_eq!(
            does(call),
            [Effect::Unmodelled(vec![Argument::text("", text)])],
            "{call}"
        );
        let told = faults("sinumerik-840d", &format!("G0 X1\n{call}\nX2\nM30\n"));
        let why = ["which program it calls", "no file of that name"];
        assert!(
            told.len() == 1 && why.iter().any(|why| told[0].contains(why)),
            "{told:?}"
        );
    }
    // a block that the switch may leave out
    assert_eq!(does("/ CALL /_N_SPF_DIR/_N_SG_SPF").len(), 2);
    assert_ne!(does("PCALL /A/_N_SG_SPF(9)"), does("PCALL /B/_N_SG_SPF(9)"));
    assert_ne!(does("PCALL /A/_N_SG_SPF(9)"), does("PCALL A/_N_SG_SPF(9)"));
}
