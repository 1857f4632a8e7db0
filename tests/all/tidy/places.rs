//! How many places an addition touches: CONTRIBUTING lists them for each kind, and here they are counted for the last one added of each
//! kind. A place that the list does not name, and one that it names in vain, make the test fail.
use super::debug_text::code;
use super::{files, root};
use std::collections::BTreeSet;
use std::path::Path;

/// A row of the table in CONTRIBUTING.
struct Row {
    kind: String,
    /// Files, or folders that end in `/`, relative to the root.
    places: Vec<String>,
    /// The last one added: its name, and other names that belong to it.
    names: Vec<String>,
}

/// What stands between backticks.
fn quoted(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn rows() -> Vec<Row> {
    let text = std::fs::read_to_string(root().join("CONTRIBUTING.md")).expect("CONTRIBUTING is there");
    let section = text.split("\n## Places\n").nth(1).expect("a section on places");
    let section = section.split("\n## ").next().unwrap_or_default();
    let lines = section.lines().filter(|line| line.starts_with("| a "));
    lines
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let [kind, places, last] = cells[..] else {
                panic!("three cells: {line}")
            };
            let names = quoted(last);
            let name = |place: &str| {
                let (snake, dashed) = (names[0].replace('-', "_"), names[0].replace('_', "-"));
                let is_code = has_extension(place, "rs") || place.ends_with('/');
                place.replace("NAME", if is_code { &snake } else { &dashed })
            };
            Row {
                kind: kind.to_owned(),
                places: quoted(places).iter().map(|place| name(place)).collect(),
                names: names.clone(),
            }
        })
        .collect()
}

fn has_extension(place: &str, wanted: &str) -> bool {
    Path::new(place).extension().is_some_and(|own| own == wanted)
}

/// Whether a text has a name as a whole word, with dashes or underscores.
fn mentions(text: &str, name: &str) -> bool {
    [name.replace('-', "_"), name.replace('_', "-")].iter().any(|name| {
        let part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '-');
        text.match_indices(name.as_str()).any(|(at, _)| {
            let (before, after) = (&text[..at], &text[at + name.len()..]);
            !part(before.chars().next_back()) && !part(after.chars().next())
        })
    })
}

/// The files that someone who adds or removes a thing has to touch: code without comments and tests, tables, generated pages, manifests.
fn touched(row: &Row) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    // the engine of a language is known to the interpreter alone; its dialect, posts and machines have the same name
    let engine = row.kind.contains("engine");
    let folders: &[&str] = if engine {
        &["src/interp", "src/flow"]
    } else {
        &[
            "src",
            "lsp",
            "grammar/dialects",
            "docs/rules",
            "docs/rewrites",
            "vscode-extension",
        ]
    };
    for folder in folders {
        for path in files(&root().join(folder), &["rs", "toml", "md", "json"]) {
            let place = path
                .strip_prefix(root())
                .expect("below the root")
                .to_string_lossy()
                .replace('\\', "/");
            let is_prose = has_extension(&place, "md") && !place.starts_with("docs/");
            let is_test = is_prose || place.contains("/tests/") || place.ends_with("tests.rs");
            let Ok(text) = std::fs::read_to_string(&path) else {
                continue;
            };
            let is_code = has_extension(&place, "rs");
            let text = if is_code { code(&text) } else { text };
            let own = place
                .rsplit('/')
                .next()
                .and_then(|name| name.split('.').next())
                .unwrap_or_default();
            let of_engine = |name: &String| place.contains(name) || text.to_lowercase().contains(name);
            let named = |name: &String| mentions(own, name) || mentions(&text, name);
            let named = row
                .names
                .iter()
                .any(|name| if engine { of_engine(name) } else { named(name) });
            if !is_test && named {
                found.insert(place);
            }
        }
    }
    found
}

#[test]
fn an_addition_touches_the_places_that_contributing_names() {
    let rows = rows();
    assert_eq!(rows.len(), 5, "one row for each kind");
    for row in rows {
        let found = touched(&row);
        let holds = |listed: &str, place: &str| place == listed || listed.ends_with('/') && place.starts_with(listed);
        let extra: Vec<_> = found
            .iter()
            .filter(|place| !row.places.iter().any(|listed| holds(listed, place)))
            .collect();
        assert!(
            extra.is_empty(),
            "{} `{}` also touches {extra:?}",
            row.kind,
            row.names[0]
        );
        let idle: Vec<_> = row
            .places
            .iter()
            .filter(|listed| !found.iter().any(|place| holds(listed, place)))
            .collect();
        assert!(
            idle.is_empty(),
            "{} `{}` does not touch {idle:?}",
            row.kind,
            row.names[0]
        );
    }
}

/// A fact that exists wakes other rules too; a new one wakes the last rule alone.
#[test]
fn the_rules_that_are_counted_are_of_their_kind() {
    let wakes = |name: &str| {
        let text = std::fs::read_to_string(root().join(format!("src/check/rules/{name}.rs"))).expect("the rule");
        let wake = text.split("Wake::").nth(1).expect("something wakes it");
        wake.split('(').next().unwrap_or_default().to_owned()
    };
    let count = |wake: &str| {
        let rules = files(&root().join("src/check/rules"), &["rs"]);
        let named = rules.iter().filter(|path| {
            let text = std::fs::read_to_string(path).unwrap_or_default();
            text.contains(&format!("Wake::{wake}("))
        });
        named.count()
    };
    for row in rows().iter().filter(|row| row.kind.contains("rule")) {
        let used = count(&wakes(&row.names[0]));
        assert_eq!(used > 1, row.kind.contains("exists"), "{}: {used} rules", row.kind);
    }
}
