//! Whoever waits for the run of a long text sees where it is, whatever the language.
use crate::support::Log;
use trunnion_interp::{Interpreter, Progress, Setup};
use trunnion_syntax::parse;

/// Blocks between the head of a program and its end.
const BLOCKS: usize = 8000;

fn text(head: &str, block: &str, end: &str) -> String {
    format!("{head}{}{end}", block.repeat(BLOCKS))
}

#[test]
fn a_long_run_shows_where_it_is_and_none_when_it_is_over() {
    let cases = [
        ("fanuc-30i", text("G21 G90\n", "G1 X1. F100.\n", "M30\n")),
        ("sinumerik-840d", text("G71 G90\n", "G1 X1 F100\n", "M30\n")),
        ("linuxcnc", text("G21 G90\n", "G1 X1 F100\n", "M2\n")),
        (
            "heidenhain-klartext",
            text("0 BEGIN PGM A MM\n", "1 L X+1 F100\n", "2 M30\n3 END PGM A MM\n"),
        ),
        ("apt", text("UNITS/MM\n", "GOTO/1,2,3\n", "FINI\n")),
    ];
    for (name, text) in cases {
        let dialect = trunnion_dialect::builtin(name).expect("built in");
        let program = parse(text.into_bytes(), dialect.lex);
        let setup = Setup {
            progress: Progress::watched(),
            ..Setup::default()
        };
        let mut interpreter = Interpreter::new(dialect, &setup);
        let mut seen = Vec::new();
        while interpreter.advance(&program, &mut Log::default()).is_some() {
            seen.extend(setup.progress.share());
        }
        assert_eq!(setup.progress.share(), None, "{name}");
        assert!(seen.is_sorted() && seen.iter().all(|(_, run)| *run == 1), "{name}");
        let (first, last) = (
            seen.first().map(|(share, _)| *share),
            seen.last().map(|(share, _)| *share),
        );
        assert!(first <= Some(5) && last >= Some(95), "{name}: {first:?} to {last:?}");
    }
}
