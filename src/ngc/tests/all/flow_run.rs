//! What a check needs of a run: all errors at their places, bounds, reasons, chains of calls.
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use trunnion_ngc::{
    At, Canon, Engine, Error, FileId, Files, Limits, Loaded, Searched, Setup, Sink, Source, Start, State, Step,
};

#[derive(Default)]
pub(crate) struct Heard {
    calls: u64,
    pub(crate) feeds: Vec<At>,
    pub(crate) errors: Vec<(u32, String, String)>,
    source: Vec<u8>,
}

impl Sink for Heard {
    fn call(&mut self, call: &Canon, at: At, _: &State) {
        self.calls += 1;
        if matches!(call, Canon::Traverse(_)) {
            self.feeds.push(at);
        }
    }
    fn error(&mut self, error: &Error, at: At) {
        let text = if error.file == FileId::MAIN {
            String::from_utf8_lossy(&self.source[error.range.start as usize..error.range.end as usize]).into_owned()
        } else {
            String::new()
        };
        self.errors.push((at.line + 1, error.message().to_owned(), text));
    }
}

struct Folder(BTreeMap<&'static str, &'static str>);

impl Files for Folder {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let text = self.0.get(name).ok_or_else(|| vec!["folder".into()])?;
        Ok(Loaded {
            path: format!("{name}.ngc"),
            bytes: Arc::from(text.as_bytes()),
        })
    }
}

pub(crate) fn run(program: &[u8], setup: &Setup, stop: bool) -> (Engine, Heard, Step) {
    let mut heard = Heard {
        source: program.to_vec(),
        ..Heard::default()
    };
    let source = Arc::new(Source::new("t.ngc".to_owned(), Arc::from(program)));
    let mut engine = Engine::new(source, setup);
    let step = engine.run(stop, &mut heard);
    (engine, heard, step)
}

fn bounded(blocks: u64) -> Setup {
    let mut setup = Setup::default();
    setup.limits = Limits { blocks, ..setup.limits };
    setup
}

pub(crate) fn unknown() -> Setup {
    Setup {
        start: Start::Unknown,
        ..Setup::default()
    }
}

#[test]
fn all_errors_are_told_with_their_places() {
    let program =
        "o1 if [#<missing>]\ng0 x1 x2\no1 endif\no2 foo\ng1 y[1/0] q\no3 while [1/0]\n(open\no3 endwhile\nm2\n";
    let (_, heard, step) = run(program.as_bytes(), &Setup::default(), false);
    let expected = [
        (1, "Named parameter #<missing> not defined", "#<missing>"),
        (2, "Multiple x words on one line", "x2"),
        (4, "Unknown control command in o word", "foo"),
        (5, "Attempt to divide by zero", "1/0"),
        (5, "No characters found in reading real value", ""),
        (6, "Attempt to divide by zero", "1/0"),
        (7, "Unclosed comment found", "(open"),
    ];
    let heard: Vec<_> = heard
        .errors
        .iter()
        .map(|(line, message, text)| (*line, message.as_str(), text.as_str()))
        .collect();
    assert_eq!(heard, expected);
    assert_eq!(step, Step::Ended);
}

#[test]
fn lines_that_never_ran_are_read() {
    let program = "o1 if [0]\ng0 x\no1 endif\no2 sub\ng1 y[1\no2 endsub\nm2\nany text (really\no3 sub\ng0 z[\no3 endsub\nmore text[\n";
    let (mut engine, mut heard, _) = run(program.as_bytes(), &Setup::default(), false);
    assert!(heard.errors.is_empty(), "{:?}", heard.errors);
    engine.read_rest(&mut heard);
    let lines: Vec<u32> = heard.errors.iter().map(|error| error.0).collect();
    assert_eq!(lines, [2, 5, 10], "{:?}", heard.errors);
}

#[test]
fn an_endless_loop_ends_at_the_line_that_opens_it() {
    let program = "g0 x1\no1 while [1]\no2 repeat [5]\n#1=[#1+1]\no2 endrepeat\no1 endwhile\nm2\n";
    let (_, _, step) = run(program.as_bytes(), &bounded(5000), false);
    let Step::OutOfFuel(at) = step else { panic!("{step:?}") };
    assert_eq!(at.line, 1);
}

#[test]
fn a_loop_that_comes_back_to_the_same_values_never_ends() {
    let endless = [
        "o1 while [1]\no1 endwhile\nm2\n",
        "g0 x1\n#1=0\no1 while [1]\n#1=[1-#1]\no2 if [#1]\n#<a>=[#1*2]\no2 endif\no1 endwhile\nm2\n",
        "#1=5\no1 do\no2 while [#2 lt 3]\n#2=[#2+1]\no2 endwhile\n#2=0\no1 while [#1 gt 2]\nm2\n",
    ];
    for program in endless {
        let opener = program.lines().position(|line| line.starts_with("o1 "));
        let (_, _, step) = run(program.as_bytes(), &bounded(1_000_000), false);
        let Step::Endless(at, _) = step else {
            panic!("{program}{step:?}")
        };
        assert_eq!(Some(at.line as usize), opener, "{program}");
    }
}

#[test]
fn a_loop_that_moves_counts_or_repeats_is_no_such_loop() {
    let others = [
        // what it moves may be meant: only the bound ends it
        "o1 while [1]\ng0 x1\no1 endwhile\nm2\n",
        "o1 while [1]\n#1=[#1+1]\no1 endwhile\nm2\n",
        "o1 while [1]\no2 repeat [2]\no2 endrepeat\no1 endwhile\nm2\n",
        "o3 sub\no3 endsub\no1 while [1]\no3 call\no1 endwhile\nm2\n",
    ];
    for program in others {
        let (_, _, step) = run(program.as_bytes(), &bounded(20_000), false);
        assert!(matches!(step, Step::OutOfFuel(_)), "{program}{step:?}");
    }
    let ends = "#1=20000\no1 while [#1 gt 0]\n#1=[#1-1]\no1 endwhile\nm2\n";
    assert_eq!(run(ends.as_bytes(), &bounded(100_000), false).2, Step::Ended);
}

#[test]
fn a_missing_subprogram_tells_the_folders_and_an_error_its_file() {
    let setup = Setup {
        files: Some(Arc::new(Folder(BTreeMap::from([(
            "a",
            "o<a> sub\ng1 x1\no<a> endsub\n",
        )])))),
        ..Setup::default()
    };
    let mut errors = Kept::default();
    let program = "o<a> call\no<b> call\nm2\n";
    let source = Arc::new(Source::new(String::new(), Arc::from(program.as_bytes())));
    Engine::new(source, &setup).run(false, &mut errors);
    let [zero_feed, missing] = &errors.0[..] else {
        panic!("{:?}", errors.0)
    };
    assert_eq!((&*zero_feed.path, zero_feed.missing.is_none()), ("a.ngc", true));
    let missing = missing.missing.as_ref().expect("the subprogram is named");
    assert_eq!(
        (missing.name.as_str(), &missing.searched[..]),
        ("b", &["folder".into()][..])
    );
}

#[test]
fn what_a_nul_cuts_off_is_told() {
    let mut errors = Kept::default();
    let source = Arc::new(Source::new(String::new(), Arc::from(&b"g0 x1\0y2\nm2\n"[..])));
    Engine::new(source, &Setup::default()).run(false, &mut errors);
    assert_eq!((errors.0.len(), &errors.1[..]), (0, &[(5, 9)][..]));
}

/// Errors, and what was cut off.
#[derive(Default)]
struct Kept(Vec<Error>, Vec<(u32, u32)>);

impl Sink for Kept {
    fn call(&mut self, _: &Canon, _: At, _: &State) {}
    fn error(&mut self, error: &Error, _: At) {
        self.0.push(error.clone());
    }
    fn cut(&mut self, range: trunnion_syntax::TextRange, _: At) {
        self.1.push((range.start, range.end));
    }
}

#[test]
fn a_long_straight_program_needs_no_fuel() {
    let program = "g0 x1\n".repeat(3000) + "m2\n";
    let (_, heard, step) = run(program.as_bytes(), &bounded(10), false);
    assert_eq!((step, heard.errors.len(), heard.feeds.len()), (Step::Ended, 0, 3000));
}

#[test]
fn a_subprogram_that_calls_itself_is_refused_where_it_gets_too_deep() {
    let program = "o1 sub\no1 call\no1 endsub\no1 call\nm2\n";
    let (engine, heard, step) = run(program.as_bytes(), &Setup::default(), false);
    assert_eq!(step, Step::Ended);
    assert_eq!(heard.errors.len(), 1, "{:?}", heard.errors);
    assert_eq!(heard.errors[0].1, "Too many subroutine levels");
    assert!(engine.ended());
}

#[test]
fn a_file_that_calls_itself_is_refused() {
    let setup = Setup {
        files: Some(Arc::new(Folder(BTreeMap::from([(
            "a",
            "o<a> sub\ng0 x1\no<a> call\no<a> endsub\n",
        )])))),
        ..Setup::default()
    };
    let (_, heard, step) = run(b"o<a> call\nm2\n", &setup, false);
    assert_eq!(step, Step::Ended);
    assert_eq!(heard.errors.len(), 1, "{:?}", heard.errors);
    assert_eq!(heard.feeds.len(), 9);
}

#[test]
fn a_motion_knows_how_it_came_about() {
    let setup = Setup {
        files: Some(Arc::new(Folder(BTreeMap::from([(
            "hole",
            "o<hole> sub\ng0 x[#1]\no<hole> endsub\n",
        )])))),
        ..Setup::default()
    };
    let program =
        b"o1 sub\no<hole> call [#1]\no1 endsub\no2 repeat [2]\no1 call [3]\no2 endrepeat\nm98 p7\nm2\no7\ng0 y1\nm99\n";
    let (engine, heard, step) = run(program, &setup, false);
    assert_eq!((step, heard.errors.len()), (Step::Ended, 0), "{:?}", heard.errors);
    let chains: Vec<String> = heard
        .feeds
        .iter()
        .map(|at| {
            let mut text = String::new();
            for frame in engine.chain(at.chain) {
                write!(text, "{}:{} {}; ", frame.file.0, frame.line + 1, frame.what).unwrap();
            }
            format!("{text}{}:{}", at.file.0, at.line + 1)
        })
        .collect();
    let hole = "0:5 o1 call; 0:2 o<hole> call; 1:2";
    assert_eq!(chains, [hole, hole, "0:7 M98 P7; 0:10"]);
}

#[test]
fn what_is_not_known_decides_nothing() {
    let cases = [
        (
            "o1 if [#5070 eq 1]\no1 endif\nm2\n",
            "whether this branch runs depends on #5070, whether the probe touched",
        ),
        (
            "o1 while [#<_z> gt 0]\no1 endwhile\nm2\n",
            "whether this loop continues depends on #<_z>, the position of the machine",
        ),
        (
            "o1 repeat [#100]\no1 endrepeat\nm2\n",
            "how many times this loop runs depends on #100, which keeps its value",
        ),
        (
            "o#<_hal[a.b]> call\nm2\n",
            "which label this is depends on #<_hal[a.b]>, a pin of the machine",
        ),
        ("m98 p#5061\nm2\n", "depends on P, whose value is not known"),
        (";py,import os\nm2\n", "Python"),
    ];
    for (program, reason) in cases {
        let (_, heard, step) = run(program.as_bytes(), &unknown(), false);
        let Step::Undecided(text) = step else {
            panic!("{program}: {step:?} {:?}", heard.errors)
        };
        assert!(text.contains(reason), "{program}: {text}");
    }
    // what does not depend on it is decided
    let (_, _, step) = run(
        b"o1 if [0 and #5070]\no1 endif\n#1=1\no2 if [#1]\no2 endif\nm2\n",
        &unknown(),
        false,
    );
    assert_eq!(step, Step::Ended);
}

#[test]
fn a_hundred_thousand_open_ifs_end() {
    let mut program = String::new();
    for label in 0..100_000 {
        writeln!(program, "o{label} if [1]").unwrap();
    }
    let (_, heard, step) = run(program.as_bytes(), &Setup::default(), false);
    assert_eq!(step, Step::Ended);
    assert_eq!(heard.errors.len(), 1);
    let skipped = program.replacen("[1]", "[0]", 1);
    let (_, heard, step) = run(skipped.as_bytes(), &Setup::default(), false);
    assert_eq!((step, heard.errors.len()), (Step::Ended, 1));
    assert_eq!(
        heard.errors[0].0, 1,
        "it is told at the line that opens: {:?}",
        heard.errors
    );
}

#[test]
fn huge_lines_and_empty_lines_end() {
    let line = [b"g0 x1 (".as_slice(), &vec![b'('; 10_000_000], b"\nm2\n"].concat();
    let (_, heard, _) = run(&line, &Setup::default(), false);
    assert_eq!(heard.errors[0].1, "Command too long");
    let empty = vec![b'\n'; 5_000_000];
    let (_, heard, step) = run(&empty, &Setup::default(), false);
    assert_eq!((step, heard.errors.len()), (Step::Ended, 1));
    let empty = [b"g0 x1\n".as_slice(), &empty].concat();
    let (mut engine, mut heard, step) = run(&empty, &Setup::default(), false);
    engine.read_rest(&mut heard);
    assert_eq!((step, heard.errors.len()), (Step::Ended, 1));
}

#[test]
fn a_copy_goes_on_as_the_original() {
    let program = "#1=0\no1 while [#1 lt 5]\n#1=[#1+1]\ng0 x[#1]\no2 if [#1 eq 3]\ng0 y1\no2 endif\no1 endwhile\nm2\n";
    let source = Arc::new(Source::new(String::new(), Arc::from(program.as_bytes())));
    let mut engine = Engine::new(source, &Setup::default());
    let mut heard = Heard::default();
    for _ in 0..9 {
        engine.step(&mut heard);
    }
    let mut copy = engine.clone();
    let (mut first, mut second) = (Heard::default(), Heard::default());
    engine.run(false, &mut first);
    copy.run(false, &mut second);
    assert_eq!(first.feeds, second.feeds);
    assert_eq!(first.calls, second.calls);
    assert!(!first.feeds.is_empty());
}

mod properties {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        /// Any lines end within the bounds, and so does reading what did not run.
        #[test]
        fn any_program_ends(lines in prop::collection::vec(
            prop_oneof![
                "o[12] (if|while|repeat|elseif) \\[[01]\\]",
                "o[12] (else|endif|endwhile|endrepeat|do|break|continue|sub|endsub|call|return)",
                "m98 p[12]( l[0-3])?",
                "(m99|%|m2|o[12]|#1=\\[#1\\+1\\])",
                "[ -~]{0,20}",
            ], 0..25)) {
            let program = lines.join("\n");
            let (mut engine, mut heard, _) = run(program.as_bytes(), &bounded(2000), false);
            engine.read_rest(&mut heard);
            for (_, message, _) in &heard.errors {
                prop_assert!(!message.is_empty());
            }
        }
    }
}

/// One file for every name, and how often it was asked for.
#[derive(Default)]
struct OneFile(AtomicUsize);

impl Files for OneFile {
    fn load(&self, _: &str) -> Result<Loaded, Vec<Searched>> {
        self.0.fetch_add(1, Ordering::Relaxed);
        let subs = (100..150).map(|number| format!("o{number} sub\nG0 X{number}\no{number} endsub\n"));
        Ok(Loaded {
            path: "all.ngc".to_owned(),
            bytes: Arc::from(subs.collect::<Vec<_>>().concat().as_bytes()),
        })
    }
}

/// A file is opened once, under whatever names it is found. All files that were open were searched for each new name.
#[test]
fn a_file_is_opened_once() {
    let files = Arc::new(OneFile::default());
    let setup = Setup {
        files: Some(Arc::clone(&files) as Arc<dyn Files>),
        ..Setup::default()
    };
    let calls = (100..150).rev().map(|number| format!("o{number} call\n"));
    let program = calls.collect::<Vec<_>>().concat() + "M2\n";
    let (engine, heard, _) = run(program.as_bytes(), &setup, true);
    assert!(heard.errors.is_empty(), "{:?}", &heard.errors[..1]);
    assert_eq!((engine.file_count(), heard.feeds.len()), (2, 50));
    assert!(heard.feeds.iter().all(|at| at.file == FileId(1)));
    assert_eq!(files.0.load(Ordering::Relaxed), 50);
}
