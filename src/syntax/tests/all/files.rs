//! Real programs: lossless, without problems that are none, also after random damage.
use crate::lossless::check_all;
use crate::show::{APT, CORE, NGC, SINUMERIK, errors};
use std::fs;
use std::path::{Path, PathBuf};
use trunnion_syntax::{Item, LexOptions, Program, Value, parse};

/// Every file below a folder, in a fixed order; none if the folder is missing, with a printed message.
#[expect(clippy::print_stderr, reason = "a skipped test must be visible")]
fn files(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    if !root.is_dir() {
        eprintln!("skipped: no folder {folder}");
        return Vec::new();
    }
    let mut found = Vec::new();
    let mut open = vec![root];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder can be read") {
            let path = entry.expect("an entry can be read").path();
            if path.is_dir() {
                open.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The last part of a file's name, in lower case.
fn ending(path: &Path) -> String {
    path.extension()
        .map(|end| end.to_string_lossy().to_lowercase())
        .unwrap_or_default()
}

fn options_of(path: &Path) -> LexOptions {
    match ending(path).as_str() {
        // Creo counts versions after the ending: `part.ncl.8`.
        "apt" | "cls" | "1" | "8" => APT,
        "mpf" | "spf" => SINUMERIK,
        "ngc" => NGC,
        _ => CORE,
    }
}

fn read(path: &Path) -> Program {
    parse(fs::read(path).expect("a file can be read"), options_of(path))
}

#[test]
fn every_file_is_lossless_under_all_options() {
    let mut seen = 0;
    for path in files("../../../shared/data").iter().chain(&files("../../samples")) {
        let mut source = fs::read(path).expect("a file can be read");
        // The large ones repeat themselves.
        source.truncate(60_000);
        check_all(&source);
        seen += 1;
    }
    assert!(seen > 0, "the samples at least are there");
}

#[test]
fn real_programs_have_no_problems() {
    let kinds = ["mpf", "spf", "ngc", "nc", "tap", "min", "gcode", "apt", "cls", "1", "8"];
    for path in files("../../../shared/data") {
        let extension = ending(&path);
        // controls/ holds programs for controls and constructs that are not read yet, wild/ programs with real mistakes.
        if path
            .components()
            .any(|part| matches!(part.as_os_str().to_str(), Some("controls" | "wild")))
        {
            continue;
        }
        // This file collects odd forms on purpose.
        if !kinds.contains(&extension.as_str()) || path.ends_with("gcodeLexer_samples.ngc") {
            continue;
        }
        assert_eq!(errors(&read(&path)), "", "{}", path.display());
    }
}

#[test]
fn the_pocket_program_reads_as_it_is_written() {
    let Some(path) = files("../../../shared/data/pocket-1999")
        .into_iter()
        .find(|path| path.ends_with("pocket.nc"))
    else {
        return;
    };
    let program = read(&path);
    assert_eq!(errors(&program), "");
    let comments = program.blocks().flat_map(|block| block.comments()).count();
    let numbered = program.blocks().filter(|block| block.number().is_some()).count();
    let words = program.blocks().flat_map(|block| block.words());
    assert!(words.into_iter().all(|word| matches!(word.value, Value::Number(_))));
    let others = program.blocks().flat_map(|block| block.items());
    assert!(
        others
            .into_iter()
            .all(|item| matches!(item, Item::Word(_) | Item::Comment(_)))
    );
    assert_eq!((comments, numbered), (4, 1407));
}

/// A small generator, so that the damage is the same each time.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % limit.max(1)
    }
}

#[test]
fn damaged_programs_are_lossless() {
    let mut random = Random(20_261_121);
    for path in files("../../../shared/data").iter().chain(&files("../../samples")) {
        let source = fs::read(path).expect("a file can be read");
        for _ in 0..6 {
            let start = random.below(source.len());
            let mut text = source[start..source.len().min(start + 600)].to_vec();
            for _ in 0..=random.below(12) {
                let at = random.below(text.len() + 1);
                let byte = b"()[]#=;/*%$\"',.:-+ \n\rXN1\x00\xFF"[random.below(25)];
                match random.below(3) {
                    0 => text.insert(at, byte),
                    1 if at < text.len() => text[at] = byte,
                    _ if at < text.len() => drop(text.remove(at)),
                    _ => {}
                }
            }
            check_all(&text);
        }
    }
}
