//! Real programs of every dialect, cut off and changed at random places: no byte is lost, nothing is refused, a second layout changes nothing.
//! A control that is recognised but not read (Mitsubishi, NUM) is read as the dialect that stands in for it.
#![expect(clippy::print_stdout, reason = "a test that is skipped says so")]
use crate::real_files::{files, is_program};
use crate::support::program;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trunnion_dialect::{BUILTIN_NAMES, builtin, detect};
use trunnion_interp::Setup;
use trunnion_layout::{Layout, Style, layout};

/// Copies of programs of one dialect.
const COPIES: usize = 60;
/// Bytes of a program that are taken.
const LONGEST: usize = 4000;

/// Scraps that mean something in one of the languages.
const SCRAPS: [&[u8]; 24] = [
    b"(",
    b")",
    b"[",
    b"]",
    b"\"",
    b";",
    b"~\n",
    b"\n",
    b"\r",
    b"$",
    b"$$",
    b"=",
    b"/",
    b"%",
    b"GOTO/",
    b"CYCL DEF ",
    b"Q1",
    b"#1",
    b"V1",
    b"DEF REAL A",
    b"NLAP1 ",
    b"\0",
    b"\xff",
    b"1e9",
];

/// Knuth's MMIX.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit.max(1)
    }
}

fn changed(random: &mut Random, source: &[u8]) -> Vec<u8> {
    let from = random.below(source.len().saturating_sub(LONGEST));
    let until = source.len().min(from + LONGEST);
    // cut off anywhere, inside a word, a comment or a continued block
    let mut text = source[from..from + random.below(until - from + 1)].to_vec();
    for _ in 0..random.below(4) {
        let at = random.below(text.len() + 1);
        let end = text.len().min(at + random.below(12));
        match random.below(3) {
            0 => drop(text.drain(at..end)),
            1 => drop(text.splice(at..end, SCRAPS[random.below(SCRAPS.len())].iter().copied())),
            _ => text.insert(at, random.below(256) as u8),
        }
    }
    text
}

#[test]
fn cut_and_changed_programs_of_every_dialect_keep_their_bytes() {
    let mut paths: Vec<PathBuf> = Vec::new();
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    files(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/programs"),
        &mut paths,
    );
    files(&beside, &mut paths);
    if !beside.is_dir() {
        println!("only the samples: {} is absent", beside.display());
    }
    let mut of: BTreeMap<&str, Vec<Vec<u8>>> = BTreeMap::new();
    for path in paths.iter().filter(|path| is_program(path)) {
        let source = std::fs::read(path).expect("readable");
        let detected = detect(path.file_name().and_then(|name| name.to_str()), &source, None);
        of.entry(detected.dialect.name.as_str()).or_default().push(source);
    }
    let mut random = Random(1);
    for name in BUILTIN_NAMES {
        let dialect = builtin(name).expect("built in");
        // a dialect without a program of its own reads those of all others
        let own: Vec<&Vec<u8>> = match of.get(name) {
            Some(own) => own.iter().collect(),
            None => of.values().flatten().collect(),
        };
        assert!(!own.is_empty(), "{name}");
        for copy in 0..COPIES {
            let source = own[random.below(own.len())];
            let text = changed(&mut random, source);
            let shown = || format!("{name} {copy}: {:?}", String::from_utf8_lossy(&text));
            let read = program(&text, dialect);
            let mut at = 0;
            for id in 0..read.tokens().len() as u32 {
                let range = read.tokens().range(id);
                assert_eq!(range.start, at, "{}", shown());
                at = range.end;
            }
            assert_eq!(at as usize, text.len(), "{}", shown());
            match layout(&read, dialect, &Setup::default(), &Style::default()) {
                Layout::Unchanged => {}
                Layout::Changed(laid) => {
                    let again = layout(&program(&laid, dialect), dialect, &Setup::default(), &Style::default());
                    assert_eq!(again, Layout::Unchanged, "{}", shown());
                }
                Layout::Refused(why) => panic!("{why:?}: {}", shown()),
            }
        }
    }
}
