//! Ten thousand random mutations of the samples: no panic, every finding has its range inside the file, tokens stay lossless,
//! and whatever a rewrite proposes is certified or refused.
use crate::random::Random;
use std::{
    fs,
    path::{Path, PathBuf},
};
use trunnion::{
    check::{Settings, check},
    dialect::{Dialect, detect},
    interp::{Limits, Setup},
    machine::{BUILTIN_MACHINES, builtin},
    rewrite::{Options, attempt, rewrites},
    syntax::{LineIndex, parse},
};

const MUTATIONS: usize = 10_000;

pub(crate) fn samples() -> Vec<(PathBuf, Vec<u8>)> {
    fn walk(folder: &Path, out: &mut Vec<(PathBuf, Vec<u8>)>) {
        let mut entries: Vec<_> = fs::read_dir(folder)
            .expect("samples")
            .map(|e| e.expect("readable").path())
            .collect();
        entries.sort();
        for path in entries {
            if path.is_dir() {
                walk(&path, out);
            } else if path.extension().is_some_and(|e| e != "md" && e != "toml") {
                out.push((path.clone(), fs::read(&path).expect("readable")));
            }
        }
    }
    let mut out = Vec::new();
    walk(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/programs"),
        &mut out,
    );
    out
}

/// The samples, and programs of real controls beside the repository where they are.
#[expect(clippy::print_stdout, reason = "a test that is skipped says so")]
pub(crate) fn programs() -> Vec<(PathBuf, Vec<u8>)> {
    let mut programs = samples();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    if folder.is_dir() {
        collect(&folder, &mut programs);
    } else {
        println!("skipped: no real programs in {}", folder.display());
    }
    programs
}

fn collect(folder: &Path, programs: &mut Vec<(PathBuf, Vec<u8>)>) {
    let mut entries: Vec<_> = fs::read_dir(folder)
        .expect("a folder")
        .flatten()
        .map(|entry| entry.path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            collect(&path, programs);
        } else if trunnion::dialect::is_program_file_name(&path.to_string_lossy())
            && fs::metadata(&path).is_ok_and(|metadata| metadata.len() < 200_000)
        {
            programs.push((path.clone(), fs::read(&path).expect("readable")));
        }
    }
}

pub(crate) fn mutate(random: &mut Random, source: &[u8]) -> Vec<u8> {
    const SCRAPS: [&[u8]; 24] = [
        b"(",
        b")",
        b";",
        b"\n",
        b"\r\n",
        b"G2",
        b"X",
        b"#1",
        b"[",
        b"=",
        b"A3=",
        b"IC(",
        b"$",
        b"/",
        b"\"",
        b"\0",
        b"\xff\xfe",
        b"99999999999999999999",
        b"-.",
        b"1e400",
        b"GOTO/",
        b"G43.5",
        b"TRAORI",
        b"\xc3\xa4",
    ];
    let mut out = source.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(out.len() + 1);
        let end = (at + random.below(12)).min(out.len());
        match random.below(5) {
            0 => drop(out.drain(at..end)),
            1 => drop(out.splice(at..end, SCRAPS[random.below(SCRAPS.len())].iter().copied())),
            2 => out.insert(at, random.below(256) as u8),
            3 if at < out.len() => out[at] ^= 1 << random.below(8),
            _ => {
                let piece = out[at..end].to_vec();
                let to = random.below(out.len() + 1);
                drop(out.splice(to..to, piece));
            }
        }
    }
    out
}

fn examine(name: &str, text: Vec<u8>, dialect: &'static Dialect, machine: usize) {
    let program = parse(text, dialect.lex);
    let source = program.source();
    let tokens = program.tokens();
    let mut at = 0;
    for id in 0..tokens.len() as u32 {
        let range = tokens.range(id);
        assert_eq!(range.start as usize, at, "{name}: tokens tile the file");
        at = range.end as usize;
    }
    assert_eq!(at, source.len(), "{name}: tokens tile the file");
    let machine = builtin(BUILTIN_MACHINES[machine % BUILTIN_MACHINES.len()]);
    let settings = Settings::new(dialect, machine, bounded());
    let report = check(&program, &settings);
    let lines = LineIndex::new(source);
    for d in &report.diagnostics {
        for range in [d.range, d.last]
            .into_iter()
            .chain(d.related.iter().map(|(range, _)| *range))
        {
            assert!(
                range.start <= range.end && range.end as usize <= source.len(),
                "{name}: {d:?}"
            );
            let (line, column) = lines.line_column(source, range.start);
            assert!(line >= 1 && column >= 1);
        }
        assert!(!d.message.is_empty() && !d.message.contains("NaN"), "{name}: {d:?}");
    }
}

/// A mutated loop may never end: it is given up early.
fn bounded() -> Setup {
    Setup {
        limits: Limits {
            blocks: 2_000,
            ..Limits::default()
        },
        ..Setup::default()
    }
}

#[test]
fn ten_thousand_mutations_of_the_samples() {
    let samples = samples();
    assert!(samples.len() >= 9, "the samples are there");
    let mut random = Random(20_261_121);
    for i in 0..MUTATIONS {
        // Of the long pocket program a piece at random: it is 1407 times the same kind of block.
        let (path, source) = &samples[random.below(samples.len())];
        let from = if source.len() > 6000 {
            random.below(source.len() - 3000)
        } else {
            0
        };
        let until = source.len().min(from + 6000);
        let text = mutate(&mut random, &source[from..until]);
        let dialect = detect(path.file_name().and_then(|n| n.to_str()), &text, None).dialect;
        examine(&format!("{} mutation {i}", path.display()), text, dialect, i);
    }
}

#[test]
fn rewrites_of_mutated_strips_are_certified_or_refused() {
    let samples = samples();
    let strips: Vec<_> = samples
        .iter()
        .filter(|(p, _)| p.to_string_lossy().contains("strategy-"))
        .collect();
    assert!(strips.len() >= 8);
    let mut random = Random(7);
    let machine = builtin("mikron-ucp710");
    let (mut certified, mut refused) = (0, 0);
    for i in 0..400 {
        let (path, source) = strips[i % strips.len()];
        let text = if i < strips.len() {
            source.clone()
        } else {
            mutate(&mut random, source)
        };
        let dialect = detect(path.file_name().and_then(|n| n.to_str()), &text, None).dialect;
        let program = parse(text, dialect.lex);
        let settings = Settings::new(dialect, machine, bounded());
        for rewrite in rewrites() {
            match attempt(
                rewrite,
                &program,
                &settings,
                &Options {
                    tolerance_mm: 0.001,
                    tolerance_deg: 0.08,
                    ..Options::default()
                },
            )
            .outcome()
            {
                Ok(None) => {}
                Err(reason) => {
                    assert!(!reason.is_empty());
                    refused += 1;
                }
                Ok(Some(_)) => certified += 1,
            }
        }
    }
    assert!(
        certified > 0 && refused > 0,
        "both happen: {certified} certified, {refused} refused"
    );
}
