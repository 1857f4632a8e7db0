//! docs/rules is made from the rules' headers. `UPDATE=1 cargo test --test all generated_docs` writes it anew.
use crate::generated_pages::assert_fresh;
use std::fmt::Write;
use trunnion::check::{Guarantee, Rule, Severity, rules};

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
    assert_fresh("docs/rules", &wanted, "generated_docs");
}
