//! No equality and no digest rests on Debug text: renaming a field would change it, and what does not print would not count.
use super::{files, root};

/// Places that still compare Debug text: file, and what the line contains. To be emptied, never to grow.
const STILL_COMPARED: &[(&str, &str)] = &[
    // debug assertions: they decide nothing in what is released
    ("src/check/pass.rs", ".is_none_or(|own| format!(\"{own:?}\")"),
    ("src/interp/rs274/steady.rs", "let full = format!(\"{:?}\", (full,"),
    ("src/interp/rs274/steady.rs", "format!(\"{:?}\", (motion.end, machine))"),
    (
        "src/machine/follow/lookahead.rs",
        "debug_assert_eq!(format!(\"{:?}\", (self.sin, self.cos))",
    ),
    (
        "src/machine/follow/joint_line.rs",
        "debug_assert_eq!(format!(\"{own:?}\"), format!(\"{motion:?}\")",
    ),
];

/// Places that print Debug text for people, and nothing else but values.
const PRINTED: &[(&str, &str)] = &[
    ("src/vocabulary/library.rs", "self.folder"),
    ("src/cli/parse.rs", "let kind = format!(\"{:?}\", tokens.kind(id));"),
    ("src/cli/parse.rs", "writeln!(out, \"{:>8} {kind:16} {:?}\""),
    (
        "src/cli/parse.rs",
        "json!({ \"kind\": format!(\"{:?}\", tokens.kind(id))",
    ),
    ("src/cli/parse/tree.rs", "kind: format!(\"{:?}\", error.kind)"),
    (
        "src/machine/file/validate.rs",
        "message: format!(\"{:?} {why}\", word.get_ref()),",
    ),
    ("src/ngc/print.rs", "other => format!(\"{other:?}\"),"),
];

/// A file without comments and without the module of tests at its end; lines stay where they are.
pub(super) fn code(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let is_tests = |at: usize| {
        let next = lines[at + 1..].iter().find(|line| !line.starts_with("#["));
        lines[at] == "#[cfg(test)]" && next.is_some_and(|line| line.contains("mod ") && line.ends_with('{'))
    };
    let end = (0..lines.len()).find(|at| is_tests(*at)).unwrap_or(lines.len());
    let is_comment = |line: &str| line.trim_start().starts_with("//");
    lines[..end]
        .iter()
        .map(|line| if is_comment(line) { "" } else { line })
        .collect::<Vec<_>>()
        .join("\n")
}

/// Where a string literal that begins at `from` (its quote) ends, and its text.
fn literal(code: &str, from: usize) -> Option<&str> {
    let rest = code.get(from + 1..)?;
    let mut escaped = false;
    let end = rest.find(|c| {
        let ends = c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        ends
    })?;
    rest.get(..end)
}

/// Where the parenthesis that opens at `open` is closed. Parentheses in strings are as good as always balanced.
fn closing(code: &str, open: usize) -> usize {
    let mut depth = 0;
    for (at, c) in code[open..].char_indices() {
        match c {
            '(' => depth += 1,
            ')' if depth == 1 => return open + at,
            ')' => depth -= 1,
            _ => {}
        }
    }
    code.len()
}

/// Whether a format consists of values alone, without a word for people.
fn is_bare(format: &str) -> bool {
    let mut inside = false;
    !format.replace("\\n", " ").chars().any(|c| {
        match c {
            '{' => inside = true,
            '}' => inside = false,
            _ => return !inside && c.is_alphanumeric(),
        }
        false
    })
}

/// Lines (from 1) that make Debug text to compare or to digest: text that is compared on the spot, text of nothing but values, and any
/// Debug text in a file that digests.
fn suspects(text: &str) -> Vec<usize> {
    let code = code(text);
    let digests = ["Sha256", "Hasher", "digest("].iter().any(|word| code.contains(word));
    let mut found = Vec::new();
    for name in ["format!(", "write!(", "writeln!(", "format_args!("] {
        for (at, _) in code.match_indices(name) {
            let open = at + name.len() - 1;
            let close = closing(&code, open);
            let Some(quote) = code[open..close].find('"') else {
                continue;
            };
            let Some(format) = literal(&code, open + quote) else {
                continue;
            };
            if !(format.contains(":?}") || format.contains(":#?}")) {
                continue;
            }
            let before = code[..at].trim_end_matches(|c: char| c.is_whitespace() || c == '&');
            let after = code.get(close + 1..).unwrap_or_default();
            let after = after.trim_start_matches(|c: char| c.is_whitespace() || c == ')');
            let compared = ["==", "!=", "assert_eq!(", "assert_ne!("]
                .iter()
                .any(|operator| before.ends_with(operator))
                || after.starts_with("==")
                || after.starts_with("!=");
            if compared || digests || is_bare(format) {
                found.push(code[..at].matches('\n').count() + 1);
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

#[test]
fn nothing_is_compared_or_digested_by_its_debug_text() {
    let (mut wrong, mut used) = (Vec::new(), Vec::new());
    let mut looked_at = 0;
    for folder in ["src", "lsp"] {
        for path in files(&root().join(folder), &["rs"]) {
            let name = path
                .strip_prefix(root())
                .unwrap_or(&path)
                .to_string_lossy()
                .into_owned();
            if name.contains("/tests/") || name.ends_with("tests.rs") {
                continue;
            }
            looked_at += 1;
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            for number in suspects(&text) {
                let line = text.lines().nth(number - 1).unwrap_or_default();
                let listed = STILL_COMPARED
                    .iter()
                    .chain(PRINTED)
                    .find(|(file, part)| *file == name && line.contains(part));
                match listed {
                    Some(entry) => used.push(entry),
                    None => wrong.push(format!("{name}:{number}: {}", line.trim())),
                }
            }
        }
    }
    assert!(looked_at > 300, "only {looked_at} files were looked at");
    assert!(
        wrong.is_empty(),
        "compare values, digest their canonical encoding (src/certify/canonical.rs); if it is only printed, list it here:\n{}",
        wrong.join("\n")
    );
    let idle: Vec<_> = STILL_COMPARED
        .iter()
        .chain(PRINTED)
        .filter(|entry| !used.contains(entry))
        .collect();
    assert!(idle.is_empty(), "listed, but no longer there: {idle:?}");
}

#[test]
fn debug_text_is_found_where_it_decides() {
    for wrong in [
        "a == b || format!(\"{a:?}\") == format!(\"{b:?}\")",
        "if format!(\"kind {:?}\", a) != other {",
        "if other == &format!(\"kind {a:?}\") {",
        "let same = (format!(\"kind {:#?}\", f(a))) == b;",
        "assert_eq!(format!(\"kind {a:?}\"), b);",
        "let key = format!(\n    \"{:?} {:?}\",\n    a, b\n);",
        "let _ = writeln!(facts, \"{} {:?}\\n\", a, b);",
        "use sha2::Sha256;\nlet facts = format!(\"axis {:?}\", a);",
    ] {
        assert!(!suspects(wrong).is_empty(), "{wrong}");
    }
    for fine in [
        "// format!(\"{a:?}\") == format!(\"{b:?}\")",
        "say(a.kind != b.kind, format!(\"kind {:?} against {:?}\", a.kind, b.kind));",
        "let message = format!(\"unknown {name} {:?}\", word);",
        "if format!(\"{a} {b}\") == text {",
        "#[cfg(test)]\nmod tests {\n    assert_eq!(format!(\"{a:?}\"), \"A\");\n}",
    ] {
        assert!(suspects(fine).is_empty(), "{fine}");
    }
}
