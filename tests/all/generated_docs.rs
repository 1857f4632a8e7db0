//! docs/rules is made from the rules' headers. `UPDATE=1 cargo test --test all generated_docs` writes it again.
use crate::generated_pages::assert_fresh;
use std::fmt::Write;
use std::path::{Path, PathBuf};
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

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The anchor that a Markdown heading gets: lower case, blanks as dashes, other signs left out.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter_map(|c| match c {
        ' ' => Some('-'),
        '-' | '_' => Some(c),
        c if c.is_alphanumeric() => Some(c.to_ascii_lowercase()),
        _ => None,
    });
    kept.collect()
}

/// Headings of a Markdown file, outside of fences.
fn headings(text: &str) -> Vec<&str> {
    let mut inside = false;
    let heading = |line: &'_ &str| {
        inside ^= line.starts_with("```");
        !inside && line.starts_with('#')
    };
    let lines = text.lines().filter(heading);
    lines.map(|line| line.trim_start_matches('#').trim()).collect()
}

/// Names of the published works in docs/sources.md, longest first.
fn works(text: &str) -> Vec<&str> {
    let mut names: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("## ")).collect();
    names.sort_by_key(|name| std::cmp::Reverse(name.len()));
    names
}

/// The bullets of the section Sources, each as one line.
fn sources(docs: &str) -> Vec<String> {
    let section = docs.split("\n# Sources\n").nth(1).unwrap_or_default();
    let mut found: Vec<String> = Vec::new();
    for line in section.lines().take_while(|line| !line.starts_with("# ")) {
        if let Some(text) = line.strip_prefix("* ") {
            found.push(text.to_owned());
        } else if let (Some(last), Some(text)) = (found.last_mut(), line.strip_prefix("  ")) {
            last.push(' ');
            last.push_str(text);
        } else if !line.is_empty() {
            found.push(line.to_owned());
        }
    }
    found
}

/// Names of files (`docs/x.md#y`, `grammar/x.toml`) in a source.
fn files_in(source: &str) -> impl Iterator<Item = &str> {
    let words = source.split([' ', ',', ';', '(', ')']);
    words
        .map(|word| word.trim_end_matches(['.', ':']))
        .filter(|word| word.starts_with("docs/") || word.starts_with("grammar/"))
}

/// A source with links, as seen from docs/rules.
fn linked(source: &str, works: &[&str]) -> String {
    let mut text = source.to_owned();
    for name in files_in(source) {
        let target = name
            .strip_prefix("docs/")
            .map_or_else(|| format!("../../{name}"), |rest| format!("../{rest}"));
        text = text.replacen(name, &format!("[{name}]({target})"), 1);
    }
    match works.iter().find(|work| source.starts_with(**work)) {
        Some(work) => format!("[{work}](../sources.md#{}){}", anchor(work), &text[work.len()..]),
        None => text,
    }
}

fn page(rule: &Rule, works: &[&str]) -> String {
    let facts = format!(
        "Reads: {}. Severity: {}. Silence: {}.",
        rule.level(),
        severity(rule),
        guarantee(rule)
    );
    let before = rule.docs.split("\n# Sources\n").next().unwrap_or(rule.docs);
    let mut body = before.replace("\n# ", "\n## ") + "\n## Sources";
    for source in sources(rule.docs) {
        let _ = write!(body, "\n* {}", linked(&source, works));
    }
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
    let known = std::fs::read_to_string(root().join("docs/sources.md")).expect("the list of works is there");
    let works = works(&known);
    let mut wanted: Vec<(String, String)> = rules()
        .iter()
        .map(|rule| (format!("{}.md", rule.name), page(rule, &works)))
        .collect();
    wanted.push(("README.md".to_owned(), list()));
    assert_fresh("docs/rules", &wanted, "generated_docs");
}

/// What is wrong with a link to `target` from the Markdown file `from`; `None`: it resolves, or leads out of the repository.
fn broken(from: &Path, target: &str) -> Option<String> {
    if target.contains("://") {
        return None;
    }
    let (file, wanted) = target.split_once('#').unwrap_or((target, ""));
    let path = if file.is_empty() {
        from.to_owned()
    } else {
        from.parent().unwrap_or(from).join(file)
    };
    let shown = from.strip_prefix(root()).unwrap_or(from).display();
    if !path.exists() {
        return Some(format!("{shown}: there is no file {file}"));
    }
    let resolves = wanted.is_empty()
        || std::fs::read_to_string(&path)
            .is_ok_and(|text| headings(&text).iter().any(|heading| anchor(heading) == wanted));
    (!resolves).then(|| format!("{shown}: {file} has no heading for #{wanted}"))
}

#[test]
fn every_source_resolves_or_names_a_published_work() {
    let known = std::fs::read_to_string(root().join("docs/sources.md")).expect("the list of works is there");
    let works = works(&known);
    let here = root().join("rule header");
    let mut wrong = Vec::new();
    for rule in rules() {
        let sources = sources(rule.docs);
        if sources.is_empty() {
            wrong.push(format!("{}: no sources", rule.name));
        }
        for source in sources {
            let files: Vec<&str> = files_in(&source).collect();
            wrong.extend(
                files
                    .iter()
                    .filter_map(|file| broken(&here, file))
                    .map(|why| format!("{}: {why}", rule.name)),
            );
            let published = works.iter().any(|work| source.starts_with(work));
            if files.is_empty() && !published {
                wrong.push(format!(
                    "{}: `{source}` is neither in the repository nor in docs/sources.md",
                    rule.name
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_published_work_has_a_year_or_a_number() {
    let known = std::fs::read_to_string(root().join("docs/sources.md")).expect("the list of works is there");
    for rule in rules() {
        for source in sources(rule.docs)
            .iter()
            .filter(|source| files_in(source).next().is_none())
        {
            let work = works(&known)
                .into_iter()
                .find(|work| source.starts_with(work))
                .unwrap_or_default();
            assert!(
                work.bytes().filter(u8::is_ascii_digit).count() >= 4,
                "{}: {source}",
                rule.name
            );
        }
    }
}

#[test]
fn links_between_documents_resolve() {
    let mut pages: Vec<PathBuf> = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"]
        .map(|name| root().join(name))
        .into();
    for folder in [
        "docs",
        "docs/rules",
        "docs/decisions",
        "docs/rewrites",
        "docs/tutorials",
        "grammar",
        "samples",
    ] {
        let entries = std::fs::read_dir(root().join(folder))
            .expect("the folder is there")
            .flatten();
        pages.extend(
            entries
                .map(|entry| entry.path())
                .filter(|path| path.extension().is_some_and(|end| end == "md")),
        );
    }
    let mut wrong = Vec::new();
    for page in pages {
        let text = std::fs::read_to_string(&page).expect("the page can be read");
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        wrong.extend(targets.filter_map(|target| broken(&page, target)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_map_stays_short() {
    let text = std::fs::read_to_string(root().join("ARCHITECTURE.md")).expect("the map is there");
    assert!(text.lines().count() <= 150, "{} lines", text.lines().count());
    let long: Vec<&str> = text.lines().filter(|line| line.chars().count() > 150).collect();
    assert!(long.is_empty(), "{}", long.join("\n"));
}
