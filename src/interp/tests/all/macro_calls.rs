//! What calls report: where motions of other files are, programs that are missing, M99 of the main program.
use crate::support::{Log, fault_line, run_bytes};
use std::sync::Arc;
use trunnion_interp::{FaultKind, Files, Interpreter, Library, Loaded, ProgramRun, Searched, Setup};

struct Folder;

impl Files for Folder {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let text: &[u8] = match name {
            "O0001.nc" => b"%\nO1\nG0X1.\nG65P2A5.\nG0X2.\nM99\n%\n",
            "O0002" => b"G1X#1F9.\nM99\n",
            "CUT.NC" => b"%\nO<CUT>\nG0X7.\nM99\n%\n",
            _ => return Err(vec!["subs".into()]),
        };
        Ok(Loaded {
            path: format!("subs/{name}"),
            bytes: text.into(),
        })
    }
}

fn run(source: &str) -> (Vec<Vec<String>>, Vec<String>) {
    let setup = Setup {
        library: Library(Some(Arc::new(Folder))),
        ..Setup::default()
    };
    let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
    let program = trunnion_syntax::parse(source.as_bytes().to_vec(), dialect.lex);
    let mut log = Log::default();
    let mut interpreter = Interpreter::new(dialect, &setup);
    while interpreter.advance(&program, &mut log).is_some() {}
    let chain = |id| {
        let frames = interpreter.chain(id).into_iter();
        frames
            .map(|f| {
                format!(
                    "{}{}:{}:{}",
                    if f.is_place { "at " } else { "" },
                    f.file,
                    f.line,
                    f.what
                )
            })
            .collect()
    };
    let chains = log.motions.iter().map(|motion| chain(motion.chain)).collect();
    (
        chains,
        log.faults.iter().map(|fault| fault_line(&program, fault)).collect(),
    )
}

#[test]
fn motions_of_other_files_know_their_place() {
    let (chains, faults) = run("G0X0.\nM98P1\nX3.\nM30\n");
    let call = "2:M98P1".to_owned();
    let call = || format!(":{call}");
    assert_eq!(
        chains,
        [
            vec![],
            vec![call(), "at subs/O0001.nc:3:G0X1.".to_owned()],
            vec![
                call(),
                "subs/O0001.nc:4:G65P2A5.".to_owned(),
                "at subs/O0002:1:G1X#1F9.".to_owned()
            ],
            vec![call(), "at subs/O0001.nc:5:G0X2.".to_owned()],
            vec![],
        ]
    );
    assert_eq!(faults, [""; 0]);
}

#[test]
fn programs_are_called_by_name() {
    let (chains, faults) = run("M98<CUT>\nM98<NONE>\nM30\n");
    assert_eq!(chains, [[":1:M98<CUT>", "at subs/CUT.NC:3:G0X7."]]);
    assert_eq!(
        faults,
        ["2: M98: MissingSubprogram { name: \"<NONE>\", searched: [\"subs\"], alarm: None, caller: None }"]
    );
    // no call, no meaning
    let (_, faults) = run("G0X1.<CUT>\nM30\n");
    assert_eq!(faults, ["1: <CUT>: UnknownWord"]);
}

#[test]
fn missing_programs_without_a_library() {
    let (program, log) = run_bytes("fanuc-30i", b"G0X1.\nM98P9\nX2.Y2.\nM30\n", &Setup::default());
    let faults: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    assert_eq!(
        faults,
        ["2: M98P9: MissingSubprogram { name: \"O0009\", searched: [], alarm: None, caller: None }"]
    );
}

#[test]
fn m99_of_a_main_program_is_told_once_without_m30() {
    let said = |source: &str| {
        let (_, log) = run_bytes("fanuc-30i", source.as_bytes(), &Setup::default());
        log.faults
            .iter()
            .filter(|f| matches!(f.kind, FaultKind::NotModelled { .. }))
            .count()
    };
    assert_eq!(said("O1\nG0X1.\nM99\n"), 1);
    assert_eq!(said("O1\nN1G0X1.\nM99P1\n"), 1);
    assert_eq!(said("O1\nG0X1.\n/M99\nM30\n"), 0);
    assert_eq!(said("O1\nG0X1.\nM98P2\nM30\nO2\nM99\n"), 0);
}

#[test]
fn haas_feeds_without_a_point_are_told() {
    let said = |dialect: &str, source: &str| {
        let (program, log) = run_bytes(dialect, source.as_bytes(), &Setup::default());
        let wrong = log.faults.iter().filter(|f| f.kind == FaultKind::AmbiguousDecimal);
        wrong.map(|f| program.text(f.range).into_owned()).collect::<Vec<_>>()
    };
    assert_eq!(said("haas-ngc", "G1X1.F100\nF0\nG93X2.F3\nG94X1.F20.\nM30\n"), ["F100"]);
    assert_eq!(said("fanuc-30i", "G1X1.F100\nM30\n"), [""; 0]);
}

/// Specification II has ten triples of I, J and K; more are reported, however many they are.
#[test]
fn more_triples_than_there_are_variables() {
    for count in [9, 10, 11, 85, 90, 60_000] {
        let source = format!("O1\nG65P2{}\nM30\nO2\nG0X#32\nM99\n", "I1.J2.K3.".repeat(count));
        let (_, log) = run_bytes("fanuc-30i", source.as_bytes(), &Setup::default());
        let unknown = log.faults.iter().filter(|fault| fault.kind == FaultKind::UnknownWord);
        assert_eq!(unknown.count(), 3 * count.saturating_sub(10), "{count}");
    }
}
