//! JUnit XML: one test suite for each file, one test case for its verdict and one for each finding.
//!
//! Source: the elements and attributes that Apache Ant writes and Jenkins reads; tests/schemas/junit.xsd lists those used here.
use super::statistics::Statistics;
use crate::cli::{
    failure::shown,
    json::{File, Item, NotChecked},
};
use std::fmt::Write;

/// The suite of one file. What is denied is a failure, what is unknown is skipped with its reason, the rest passes with its message.
pub(super) fn suite(file: &File, line: &str, denied: impl Fn(&Item) -> bool) -> String {
    let failures = file.diagnostics.iter().filter(|item| denied(item)).count();
    let skipped = |item: &&Item| item.status == "unknown" && !denied(item);
    let unknown = file.diagnostics.iter().filter(skipped).count();
    let name = escape(&file.path);
    let unjudged = usize::from(file.verdict == "unknown");
    let mut out = format!(
        "  <testsuite name=\"{name}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n    <properties>\n",
        file.diagnostics.len() + 1,
        failures + usize::from(file.verdict == "fail"),
        unknown + unjudged,
    );
    let c = &file.coverage;
    let mut properties = vec![
        ("verdict", file.verdict.to_owned()),
        ("scope", file.scope.to_owned()),
        ("machine", file.machine.clone().unwrap_or_default()),
        ("dialect", file.dialect.clone().unwrap_or_default()),
        ("coverage.blocks", c.blocks.to_string()),
        ("coverage.blocks_run", c.blocks_run.to_string()),
        ("coverage.motions", c.motions.to_string()),
        ("coverage.motions_known", c.motions_known.to_string()),
    ];
    for part in &c.not_run {
        properties.push((
            "coverage.not_run",
            format!("lines {} to {}: {}", part.line, part.last_line, part.reason),
        ));
    }
    for lacking in &c.not_judged {
        let text = format!("{}: the machine file does not declare {}", lacking.rule, lacking.needs);
        properties.push(("coverage.not_judged", text));
    }
    if let Some(end) = &c.given_up {
        properties.push(("coverage.given_up", format!("line {}: {}", end.line, end.reason)));
    }
    properties.extend(file.assumptions.iter().map(|text| ("assumption", text.clone())));
    properties.extend(
        file.accepted
            .iter()
            .map(|item| ("accepted", format!("line {}: {}", item.line, item.message))),
    );
    for (key, value) in properties {
        let _ = writeln!(out, "      <property name=\"{key}\" value=\"{}\"/>", escape(&value));
    }
    out.push_str("    </properties>\n");
    let _ = write!(out, "    <testcase classname=\"{name}\" name=\"verdict\">");
    let line = escape(line);
    let _ = match file.verdict {
        "fail" => write!(out, "<failure type=\"verdict\" message=\"{line}\"/>"),
        "unknown" => write!(out, "<skipped message=\"{line}\"/>"),
        _ => write!(out, "<system-out>{line}</system-out>"),
    };
    out.push_str("</testcase>\n");
    for item in &file.diagnostics {
        let place = format!("{} line {} column {}", item.rule, item.line, item.column);
        let _ = write!(out, "    <testcase classname=\"{name}\" name=\"{}\">", escape(&place));
        let head = escape(&item.message);
        let mut text = format!("{}:{}:{}: {}", file.path, item.line, item.column, item.message);
        for more in item.notes.iter().chain(&item.help) {
            text.push('\n');
            text.push_str(more);
        }
        let text = escape_text(&text);
        let _ = if denied(item) {
            write!(
                out,
                "<failure type=\"{}\" message=\"{head}\">{text}</failure>",
                item.rule
            )
        } else if item.status == "unknown" {
            write!(out, "<skipped message=\"unknown: {head}\"/>")
        } else {
            write!(out, "<system-out>{}: {text}</system-out>", item.severity)
        };
        out.push_str("</testcase>\n");
    }
    out.push_str("  </testsuite>\n");
    out
}

/// The suite of what could not be checked.
pub(super) fn not_checked(all: &[NotChecked]) -> String {
    if all.is_empty() {
        return String::new();
    }
    let count = all.len();
    let mut out = format!("  <testsuite name=\"not checked\" tests=\"{count}\" failures=\"0\" errors=\"{count}\">\n");
    for failed in all {
        let place = if failed.place.is_empty() {
            "trunnion"
        } else {
            &failed.place
        };
        let (place, message) = (escape(place), escape(&failed.message));
        let _ = writeln!(
            out,
            "    <testcase classname=\"{place}\" name=\"not checked\"><error type=\"not-checked\" message=\"{message}\"/></testcase>"
        );
    }
    out.push_str("  </testsuite>\n");
    out
}

/// The suite that counts the findings of each rule: a property for each, and the table of the other formats.
pub(super) fn statistics(all: &Statistics) -> String {
    let mut out =
        "  <testsuite name=\"statistics\" tests=\"1\" failures=\"0\" errors=\"0\" skipped=\"0\">\n".to_owned();
    let rows: Vec<_> = all.rows().collect();
    if !rows.is_empty() {
        out.push_str("    <properties>\n");
        for (rule, counts) in rows {
            let counts = counts.map(|(word, count)| format!("{word} {count}")).join(", ");
            let _ = writeln!(
                out,
                "      <property name=\"statistics.{}\" value=\"{counts}\"/>",
                escape(rule)
            );
        }
        out.push_str("    </properties>\n");
    }
    let table = escape_text(&all.table());
    let _ = writeln!(
        out,
        "    <testcase classname=\"trunnion\" name=\"findings by rule\"><system-out>{table}</system-out></testcase>\n  </testsuite>"
    );
    out
}

/// Text in an attribute; line ends are kept as references.
fn escape(text: &str) -> String {
    escape_text(text).replace('\n', "&#10;").replace('\t', "&#9;")
}

/// Text between tags. Characters that XML 1.0 forbids are shown as escapes.
fn escape_text(text: &str) -> String {
    let shown = shown(text);
    let mut out = String::with_capacity(shown.len());
    for c in shown.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_text_stays_text() {
        assert_eq!(
            escape("</x>\"&\n\x01\u{ffff}"),
            "&lt;/x&gt;&quot;&amp;&#10;\\x01\u{fffd}"
        );
    }
}
