//! Every program beside the repository: laid out once, it says the same and is done; laid out again, nothing happens.
#![expect(clippy::print_stdout, reason = "a test that is skipped says so")]
use crate::support::program;
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};
use trunnion_dialect::detect;
use trunnion_interp::Setup;
use trunnion_layout::{Case, Layout, Spacing, Style, Zeros, layout};

pub(crate) fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            files(&path, found);
        } else {
            found.push(path);
        }
    }
}

/// Whether a file may be a program: no tables, machine files or point lists.
pub(crate) fn is_program(path: &Path) -> bool {
    let name = path
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .to_ascii_lowercase();
    let foreign = [
        ".ini",
        ".tbl",
        ".tsv",
        ".md",
        ".expected",
        "expected",
        ".csv",
        ".template",
    ];
    let points = path.to_string_lossy().contains("waypoints") && !name.contains("gcode");
    !points && !foreign.iter().any(|ending| name.ends_with(ending))
}

#[test]
fn every_program_keeps_its_words_and_motions_and_is_stable() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let mut paths = Vec::new();
    files(&root, &mut paths);
    paths.retain(|path| is_program(path));
    if paths.is_empty() {
        println!("skipped: {} is absent", root.display());
        return;
    }
    let styles = [
        Style::default(),
        Style {
            case: Case::Lower,
            spacing: Spacing::Packed,
            zeros: Zeros::Two,
            comment_column: Some(40),
            indent: 4,
            blank_lines: 0,
        },
    ];
    let (mut changed, mut refused) = (0, Vec::new());
    let mut read: BTreeMap<&str, u32> = BTreeMap::new();
    for path in &paths {
        let source = std::fs::read(path).expect("readable");
        let name = path.file_name().and_then(|name| name.to_str());
        let detected = detect(name, &source, None);
        if detected.foreign.is_some() {
            // no command lays out what it cannot read
            continue;
        }
        let dialect = detected.dialect;
        *read.entry(dialect.name.as_str()).or_default() += 1;
        let before = program(&source, dialect);
        for style in &styles {
            match layout(&before, dialect, &Setup::default(), style) {
                Layout::Unchanged => {}
                Layout::Changed(text) => {
                    changed += 1;
                    let again = layout(&program(&text, dialect), dialect, &Setup::default(), style);
                    assert_eq!(again, Layout::Unchanged, "{} is stable", path.display());
                }
                Layout::Refused(why) => refused.push(format!("{} ({}): {why:?}", path.display(), dialect.name)),
            }
        }
    }
    println!("{} files, {read:?}, {changed} layouts changed", paths.len());
    for (dialect, least) in [("heidenhain-klartext", 40), ("okuma-osp", 6), ("sinumerik-840d", 60)] {
        assert!(read.get(dialect).copied().unwrap_or_default() >= least, "{read:?}");
    }
    assert!(refused.is_empty(), "{}", refused.join("\n"));
    assert!(changed > paths.len(), "most of them have something to change");
}
