//! The documentation site: docs/SUMMARY.md lists every page once, and the lists in it and in other pages are made from the program.
//! `UPDATE=1 cargo test --test all site` writes the lists again.
use std::{collections::BTreeSet, fmt::Write, fs, path::Path};
use trunnion::{
    check::rules,
    dialect::{BUILTIN_NAMES, UNSUPPORTED},
    machine::BUILTIN_MACHINES,
    rewrite::rewrites,
};

fn docs() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

/// Compares the part of a page between `<!-- NAME: ... -->` and `<!-- end of NAME -->`, or writes it again under `UPDATE=1`.
fn assert_part(page: &str, name: &str, wanted: &str) {
    let path = docs().join(page);
    let text = fs::read_to_string(&path).expect("the page is there");
    let begin = text.find(&format!("<!-- {name}: ")).expect("the part begins");
    let begin = begin + text[begin..].find("-->\n").expect("the comment ends") + 4;
    let end = text.find(&format!("<!-- end of {name} -->")).expect("the part ends");
    if std::env::var_os("UPDATE").is_some() {
        let new = [&text[..begin], wanted, &text[end..]].concat();
        fs::write(&path, new).expect("the page can be written");
    } else {
        assert!(
            &text[begin..end] == wanted,
            "{page}: the list of {name} is stale; run UPDATE=1 cargo test --test all site"
        );
    }
}

#[test]
fn the_summary_lists_rules_and_rewrites() {
    let mut text = String::from("- [Rules](rules/README.md)\n");
    for rule in rules() {
        let _ = writeln!(text, "  - [{0}](rules/{0}.md)", rule.name);
    }
    text.push_str("- [Rewrites](rewrites/README.md)\n");
    for rewrite in rewrites() {
        let _ = writeln!(text, "  - [{0}](rewrites/{0}.md)", rewrite.name);
    }
    assert_part("SUMMARY.md", "lists", &text);
    let mut names: Vec<String> = fs::read_dir(docs().join("decisions"))
        .expect("the folder is there")
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name != "README.md")
        .collect();
    names.sort();
    let mut text = String::from("- [Decisions](decisions/README.md)\n");
    for name in names {
        let page = fs::read_to_string(docs().join("decisions").join(&name)).expect("the page can be read");
        let title = page.lines().next().unwrap_or_default().trim_start_matches("# ");
        let _ = writeln!(text, "  - [{title}](decisions/{name})");
    }
    assert_part("SUMMARY.md", "decisions", &text);
}

#[test]
fn the_page_of_machines_lists_the_built_in_ones() {
    let mut text =
        String::from("| machine | what it is | axes from workpiece to tool | control |\n|---|---|---|---|\n");
    for name in BUILTIN_MACHINES {
        let machine = trunnion::machine::builtin(name).expect("built in");
        let axes: Vec<String> = machine
            .own_axes()
            .map(|(_, axis)| char::from(axis.letter).to_string())
            .collect();
        let family = &machine.control.family;
        let _ = writeln!(
            text,
            "| `{name}` | {} | {} | `{family}` |",
            machine.name,
            axes.join(" ")
        );
    }
    assert_part("machines.md", "machines", &text);
}

#[test]
fn the_page_of_dialects_lists_what_is_read_and_what_is_not() {
    let mut text = String::from("| dialect | control | file extensions |\n|---|---|---|\n");
    for name in BUILTIN_NAMES {
        let dialect = trunnion::dialect::builtin(name).expect("built in");
        let ends: Vec<String> = dialect.extensions.iter().map(|end| format!("`.{end}`")).collect();
        let _ = writeln!(text, "| `{name}` | {} | {} |", dialect.title, ends.join(" "));
    }
    assert_part("dialects.md", "dialects", &text);
    let mut text = String::from("| name | control |\n|---|---|\n");
    for control in UNSUPPORTED {
        let _ = writeln!(text, "| `{}` | {} |", control.name, control.title);
    }
    assert_part("dialects.md", "unsupported", &text);
}

/// The Markdown files below a folder, by their names relative to docs.
fn pages(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).expect("the folder is there").flatten() {
        let path = entry.path();
        if path.is_dir() {
            pages(&path, found);
        } else if path.extension().is_some_and(|end| end == "md") && !path.ends_with("SUMMARY.md") {
            let name = path.strip_prefix(docs()).expect("below docs").to_string_lossy();
            found.insert(name.replace('\\', "/"));
        }
    }
}

/// A page that is not listed is not in the site, and links to it would be dead.
#[test]
fn the_summary_lists_every_page_once() {
    let summary = fs::read_to_string(docs().join("SUMMARY.md")).expect("the summary is there");
    let mut listed = BTreeSet::new();
    for target in summary.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(listed.insert(target.to_owned()), "{target} is listed twice");
    }
    let mut there = BTreeSet::new();
    pages(&docs(), &mut there);
    let not_both: Vec<_> = listed.symmetric_difference(&there).collect();
    assert!(
        not_both.is_empty(),
        "listed without a page, or a page that is not listed: {not_both:?}"
    );
}
