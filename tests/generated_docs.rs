//! docs/rules is made from the rules' headers. `UPDATE=1 cargo test --test generated_docs` writes it anew.
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trunnion::check::{Guarantee, Rule, Severity, rules};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/rules")
}

fn severity(rule: &Rule) -> &'static str {
    match rule.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info => "info",
    }
}

fn guarantee(rule: &Rule) -> &'static str {
    match rule.guarantee {
        Guarantee::Sound => "sound",
        Guarantee::Heuristic => "heuristic",
    }
}

fn page(rule: &Rule) -> String {
    let facts = format!(
        "Reads: {}. Severity: {}. Silence: {}.",
        rule.level.name(),
        severity(rule),
        guarantee(rule)
    );
    let body = rule.docs.replace("\n# ", "\n## ");
    let fences = body
        .lines()
        .map(|line| if line.starts_with("```gcode") { "```gcode" } else { line });
    let body = fences.collect::<Vec<_>>().join("\n");
    format!(
        "<!-- made from src/check/rules/{}.rs -->\n# {}\n\n{body}\n\n{facts}\n",
        rule.name.replace('-', "_"),
        rule.name
    )
}

fn list() -> String {
    let mut text = String::from(
        "<!-- made from the headers in src/check/rules -->\n# Rules\n\n| rule | severity | what it finds |\n|---|---|---|\n",
    );
    for rule in rules() {
        let _ = writeln!(
            text,
            "| [{0}]({0}.md) | {1} | {2} |",
            rule.name,
            severity(rule),
            rule.summary()
        );
    }
    text
}

#[test]
fn rule_pages_are_fresh() {
    let mut wanted: Vec<(String, String)> = rules()
        .iter()
        .map(|rule| (format!("{}.md", rule.name), page(rule)))
        .collect();
    wanted.push(("README.md".to_owned(), list()));
    let update = std::env::var_os("UPDATE").is_some();
    if update {
        std::fs::create_dir_all(folder()).expect("docs/rules can be made");
    }
    let mut stale = Vec::new();
    for (name, text) in &wanted {
        let path = folder().join(name);
        if std::fs::read_to_string(&path).ok().as_ref() == Some(text) {
            continue;
        }
        if update {
            std::fs::write(&path, text).expect("docs/rules can be written");
        } else {
            stale.push(name.clone());
        }
    }
    for entry in std::fs::read_dir(folder()).expect("docs/rules is there").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if wanted.iter().all(|(known, _)| *known != name) {
            stale.push(format!("{name} (no rule of that name)"));
        }
    }
    assert!(
        stale.is_empty(),
        "stale: {}; run UPDATE=1 cargo test --test generated_docs",
        stale.join(", ")
    );
}
