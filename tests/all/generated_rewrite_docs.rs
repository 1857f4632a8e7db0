//! docs/rewrites is made from the rewrites' headers. `UPDATE=1 cargo test --test all generated_rewrite_docs` writes it again.
use crate::generated_pages::assert_fresh;
use std::path::Path;
use trunnion::rewrite::{Rewrite, rewrites};

fn page(rewrite: &Rewrite) -> String {
    let body = rewrite.docs.replace("\n# ", "\n## ");
    let fence = |line: &str| match line.strip_prefix("```gcode ") {
        Some(info) if info.starts_with("before") => "Before:\n```gcode".to_owned(),
        Some(_) => "After:\n```gcode".to_owned(),
        None => line.to_owned(),
    };
    let body = body.lines().map(fence).collect::<Vec<_>>().join("\n");
    let file = rewrite.name.replace('-', "_");
    let cures = rewrite
        .cures
        .iter()
        .map(|rule| format!("[{rule}](../rules/{rule}.md)"))
        .collect::<Vec<_>>()
        .join(", ");
    let cures = if cures.is_empty() {
        "no finding; it is asked for by name".to_owned()
    } else {
        cures
    };
    format!(
        "<!-- made from src/rewrite/rewrites/{file}.rs -->\n# {}\n\n{body}\n\nCan fix: {cures}.\n",
        rewrite.name
    )
}

fn list() -> String {
    let head =
        "<!-- made from the headers in src/rewrite/rewrites -->\n# Rewrites\n\n| rewrite | what it does |\n|---|---|\n";
    let row = |rewrite: &&Rewrite| {
        let summary = rewrite.docs.lines().next().unwrap_or_default();
        format!("| [{0}]({0}.md) | {summary} |\n", rewrite.name)
    };
    let rows: Vec<String> = rewrites().iter().map(row).collect();
    format!("{head}{}", rows.concat())
}

#[test]
fn rewrite_pages_are_fresh() {
    let mut wanted: Vec<(String, String)> = rewrites()
        .iter()
        .map(|rewrite| (format!("{}.md", rewrite.name), page(rewrite)))
        .collect();
    wanted.push(("README.md".to_owned(), list()));
    assert_fresh("docs/rewrites", &wanted, "generated_rewrite_docs");
}

#[test]
fn every_file_is_listed_and_every_cure_is_a_rule() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/rewrite/rewrites");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .expect("the folder is there")
        .flatten()
        .map(|entry| {
            entry
                .file_name()
                .to_string_lossy()
                .trim_end_matches(".rs")
                .replace('_', "-")
        })
        .collect();
    files.sort();
    let mut names: Vec<&str> = rewrites().iter().map(|rewrite| rewrite.name).collect();
    names.sort_unstable();
    assert_eq!(files, names);
    for rewrite in rewrites() {
        for cure in rewrite.cures {
            assert!(
                trunnion::check::rule(cure).is_some(),
                "{} cures the unknown rule {cure}",
                rewrite.name
            );
        }
    }
}
