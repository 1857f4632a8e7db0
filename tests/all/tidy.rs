//! House rules as tests: floors look down only, lists equal folders, files stay short, rule headers are whole.
mod debug_text;
mod places;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use trunnion::check::rules;
use trunnion::rewrite::rewrites;

/// Floors by number: a crate may depend on crates of lower floors only.
const FLOORS: &[(&str, u32)] = &[
    ("trunnion-geometry", 0),
    ("trunnion-syntax", 0),
    ("trunnion-pieces", 1),
    ("trunnion-servo", 1),
    ("trunnion-formula", 1),
    ("trunnion-vocabulary", 1),
    ("trunnion-dialect", 2),
    ("trunnion-flow", 2),
    ("trunnion-ngc", 2),
    ("trunnion-interp", 3),
    ("trunnion-machine", 4),
    ("trunnion-same", 5),
    ("trunnion-stats", 6),
    ("trunnion-diff", 7),
    ("trunnion-certify", 6),
    ("trunnion-surface", 5),
    ("trunnion-planner", 5),
    ("trunnion-check", 6),
    ("trunnion-layout", 6),
    ("trunnion-plot", 6),
    ("trunnion-scene", 6),
    ("trunnion-ide", 7),
    ("trunnion-files", 6),
    ("trunnion-rewrite", 7),
    ("trunnion-convert", 7),
    ("trunnion-workspace", 7),
    ("trunnion-document", 7),
    ("trunnion-wasm", 8),
    ("trunnion-lsp", 8),
    ("trunnion", 9),
];

/// What a crate must not reach, directly or through others of the workspace.
const FORBIDDEN: &[(&str, &[&str])] = &[
    ("trunnion-syntax", &["nalgebra", "serde", "toml", "trunnion-geometry"]),
    ("trunnion-geometry", &["trunnion-syntax", "serde", "toml"]),
    ("trunnion-formula", &["serde", "toml"]),
    ("trunnion-vocabulary", &["serde", "toml"]),
    ("trunnion-ngc", &["serde", "toml", "trunnion-dialect"]),
    ("trunnion-certify", &["trunnion-check", "trunnion-rewrite"]),
    (
        "trunnion-check",
        &["tokio", "clap", "miette", "tower-lsp", "trunnion-certify"],
    ),
    (
        "trunnion-rewrite",
        &["tokio", "clap", "miette", "tower-lsp", "trunnion-files"],
    ),
    (
        "trunnion-convert",
        &["tokio", "clap", "miette", "tower-lsp", "trunnion-files"],
    ),
    (
        "trunnion-ide",
        &[
            "tokio",
            "clap",
            "miette",
            "tower-lsp",
            "trunnion-files",
            "trunnion-certify",
        ],
    ),
    ("trunnion-lsp", &["clap", "miette"]),
];

const LONGEST_FILE: usize = 400;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The manifests of all crates, with their texts.
fn manifests() -> Vec<(PathBuf, String)> {
    let mut manifests = vec![root().join("Cargo.toml"), root().join("lsp/Cargo.toml")];
    for entry in std::fs::read_dir(root().join("src")).expect("src is there").flatten() {
        manifests.push(entry.path().join("Cargo.toml"));
    }
    manifests
        .into_iter()
        .filter_map(|path| std::fs::read_to_string(&path).ok().map(|text| (path, text)))
        .collect()
}

/// Each crate with its folder.
fn crate_folders() -> Vec<(String, PathBuf)> {
    let named = |(path, text): (PathBuf, String)| {
        let name = text.lines().find_map(|line| line.strip_prefix("name = \""))?;
        Some((name.trim_end_matches('"').to_owned(), path.parent()?.to_owned()))
    };
    manifests().into_iter().filter_map(named).collect()
}

/// Each crate with its direct dependencies, as its Cargo.toml lists them (not those for tests).
fn crates() -> BTreeMap<String, BTreeSet<String>> {
    let mut found = BTreeMap::new();
    for (manifest, text) in manifests() {
        let (mut section, mut name, mut uses) = ("", None, BTreeSet::new());
        for line in text.lines().map(str::trim) {
            if line.starts_with('[') {
                section = line;
            } else if let Some((key, value)) = line.split_once('=') {
                let key = key.trim();
                if section == "[package]" && key == "name" {
                    name = Some(value.trim().trim_matches('"').to_owned());
                } else if section == "[dependencies]" && !key.starts_with('#') {
                    uses.insert(key.split('.').next().unwrap_or(key).to_owned());
                }
            }
        }
        found.insert(
            name.unwrap_or_else(|| panic!("{} names a package", manifest.display())),
            uses,
        );
    }
    found
}

#[test]
fn floors_look_down_only() {
    let floor = |name: &str| FLOORS.iter().find(|(known, _)| *known == name).map(|(_, floor)| *floor);
    for (name, uses) in crates() {
        let own = floor(&name).unwrap_or_else(|| panic!("{name} has no floor: add it to FLOORS"));
        for used in uses {
            if let Some(other) = floor(&used) {
                assert!(other < own, "{name} (floor {own}) depends on {used} (floor {other})");
            }
        }
    }
}

#[test]
fn forbidden_edges_are_absent() {
    let crates = crates();
    for (name, forbidden) in FORBIDDEN {
        let mut reached = BTreeSet::new();
        let mut open = vec![(*name).to_owned()];
        while let Some(next) = open.pop() {
            for used in crates.get(&next).into_iter().flatten() {
                if reached.insert(used.clone()) {
                    open.push(used.clone());
                }
            }
        }
        assert!(crates.contains_key(*name), "{name} is gone");
        for edge in *forbidden {
            assert!(!reached.contains(*edge), "{name} reaches {edge}");
        }
    }
}

/// Names of the files in a folder of the sources, as rules and rewrites are named.
fn names_in(folder: &str) -> Vec<String> {
    let mut names: Vec<String> = files(&root().join(folder), &["rs"])
        .iter()
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().replace('_', "-")))
        .collect();
    names.sort();
    names
}

#[test]
fn the_list_of_rules_is_the_folder() {
    let listed: Vec<&str> = rules().iter().map(|rule| rule.name).collect();
    assert_eq!(listed, names_in("src/check/rules"));
}

#[test]
fn the_list_of_rewrites_is_the_folder() {
    // they are listed in the order in which they are applied
    let mut listed: Vec<&str> = rewrites().iter().map(|rewrite| rewrite.name).collect();
    listed.sort_unstable();
    assert_eq!(listed, names_in("src/rewrite/rewrites"));
}

#[test]
fn rewrites_cure_rules_that_exist() {
    for rewrite in rewrites() {
        for cured in rewrite.cures {
            assert!(
                rules().iter().any(|rule| rule.name == *cured),
                "{} cures {cured}, which is no rule",
                rewrite.name
            );
        }
    }
}

#[test]
fn rule_headers_are_whole() {
    const WANTED: &[&str] = &["Why", "Example", "Use instead", "Guarantee", "Sources"];
    for rule in rules() {
        let first = rule.docs.lines().next().unwrap_or_default();
        assert!(
            first.ends_with('.') && !first.starts_with('#'),
            "{}: the header begins with one sentence",
            rule.name
        );
        let headings: Vec<&str> = rule.docs.lines().filter_map(|line| line.strip_prefix("# ")).collect();
        let compulsory: Vec<&str> = headings
            .iter()
            .copied()
            .filter(|heading| *heading != "Thresholds")
            .collect();
        assert_eq!(compulsory, WANTED, "{}", rule.name);
    }
}

/// All files below `folder` with one of the extensions, without what tools make.
fn files(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    const MADE: &[&str] = &["target", "node_modules", "out", "dist", "snapshots"];
    let mut found = Vec::new();
    let Ok(entries) = std::fs::read_dir(folder) else {
        return found;
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned())
            .unwrap_or_default();
        if path.is_dir() && !name.starts_with('.') && !MADE.contains(&name.as_str()) {
            found.extend(files(&path, extensions));
        } else if extensions
            .iter()
            .any(|extension| path.extension().is_some_and(|own| own == *extension))
        {
            found.push(path);
        }
    }
    found.sort();
    found
}

#[test]
fn files_are_short() {
    let mut long = Vec::new();
    for folder in ["src", "lsp", "tests", "benches", "vscode-extension"] {
        for path in files(&root().join(folder), &["rs", "ts"]) {
            let lines = std::fs::read_to_string(&path).map_or(0, |text| text.lines().count());
            if lines > LONGEST_FILE {
                long.push(format!(
                    "{}: {lines} lines",
                    path.strip_prefix(root()).unwrap_or(&path).display()
                ));
            }
        }
    }
    assert!(
        long.is_empty(),
        "over {LONGEST_FILE} lines: one idea per file\n{}",
        long.join("\n")
    );
}

/// Every test binary links the whole program again: a crate has one, `tests/all/main.rs`, and its files are modules of that.
/// A terminal shows that a command works on a long program: a bar, or a line with the time.
#[test]
fn commands_that_read_programs_show_that_they_work() {
    let folder = root().join("src/cli");
    let mut commands = 0;
    for file in files(&folder, &["rs"]) {
        let text = std::fs::read_to_string(&file).expect("readable");
        if !text.contains("load::load") {
            continue;
        }
        commands += 1;
        let shows = text.contains("waiting::") || text.contains("ProgressBar");
        assert!(
            shows,
            "{} shows nothing while it works: use waiting::during",
            file.display()
        );
    }
    assert!(commands > 10, "{commands}");
}

#[test]
fn a_crate_has_one_test_binary() {
    let mut others = Vec::new();
    for (name, folder) in crate_folders() {
        for entry in std::fs::read_dir(folder.join("tests")).into_iter().flatten().flatten() {
            let path = entry.path();
            // src/dialect/tests holds modules of the library
            let module = name == "trunnion-dialect";
            let binary = path.extension().is_some_and(|own| own == "rs") || path.join("main.rs").is_file();
            if binary && !module && !path.ends_with("tests/all") {
                others.push(format!("{name}: {}", path.display()));
            }
        }
    }
    assert!(
        others.is_empty(),
        "make them modules of tests/all/main.rs\n{}",
        others.join("\n")
    );
}

/// Crates that may talk to the world: files, environment, processes, network, clocks.
const WORLDLY: &[&str] = &["trunnion", "trunnion-files", "trunnion-lsp", "trunnion-workspace"];

/// Paths of std that reach the world.
const WORLD: &[&str] = &["fs", "env", "process", "net", "time", "os"];

/// Places in a source where one of `WORLD` is named: `std::fs`, or `fs` in a list `use std::{...}`. Its unit tests, at its end, may.
fn reaches_the_world(text: &str) -> Vec<&str> {
    let code = text.split("mod tests {").next().unwrap_or_default();
    let listed = code
        .split("use std::{")
        .skip(1)
        .filter_map(|rest| rest.split(';').next())
        .flat_map(|list| list.split(['{', '}', ',']))
        .map(|item| item.trim().split("::").next().unwrap_or_default());
    let named = code.split("std::").skip(1).map(|rest| {
        let end = rest.find(|sign: char| !sign.is_ascii_alphanumeric() && sign != '_');
        &rest[..end.unwrap_or(rest.len())]
    });
    listed.chain(named).filter(|name| WORLD.contains(name)).collect()
}

#[test]
fn only_the_top_floors_touch_the_world() {
    assert_eq!(reaches_the_world("use std::fs;\n"), ["fs"]);
    assert_eq!(
        reaches_the_world("use std::{\n    fmt::Write,\n    time::{Duration, Instant},\n};"),
        ["time"]
    );
    assert_eq!(reaches_the_world("let a = ::std::env::var(name);"), ["env"]);
    assert_eq!(
        reaches_the_world("use std::io::Write;\n#[cfg(test)]\nmod tests { use std::fs; }"),
        [""; 0]
    );
    for (name, folder) in crate_folders() {
        if WORLDLY.contains(&name.as_str()) {
            continue;
        }
        for path in files(&folder, &["rs"]) {
            let of_tests = path
                .components()
                .any(|part| part.as_os_str() == "tests" || part.as_os_str() == "benches")
                || path
                    .file_stem()
                    .is_some_and(|stem| stem.to_string_lossy().ends_with("tests"));
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            let found = reaches_the_world(&text);
            assert!(
                of_tests || found.is_empty(),
                "{} uses std::{}: only {WORLDLY:?} may",
                path.display(),
                found.join(", std::")
            );
        }
    }
}

/// What touches nothing of the world compiles for WebAssembly, and CI sees to it: `.ci/wasm.sh` lists these crates.
#[test]
fn the_floors_for_webassembly_are_all_but_the_worldly() {
    let script = std::fs::read_to_string(root().join(".ci/wasm.sh")).expect("it is there");
    let list = script
        .lines()
        .find_map(|line| line.strip_prefix("floors=\""))
        .expect("a list");
    let listed: BTreeSet<String> = list
        .trim_end_matches('"')
        .split(' ')
        .map(|floor| format!("trunnion-{floor}"))
        .collect();
    let all = crate_folders().into_iter().map(|(name, _)| name);
    let wanted: BTreeSet<String> = all.filter(|name| !WORLDLY.contains(&name.as_str())).collect();
    assert_eq!(listed, wanted);
}

#[test]
fn every_source_file_begins_with_its_idea() {
    for folder in ["src", "lsp", "tests", "benches"] {
        for path in files(&root().join(folder), &["rs"]) {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            assert!(text.starts_with("//! "), "{} begins without a //! line", path.display());
        }
    }
}
