//! The page: everything in one file, nothing loaded from elsewhere. Text of programs is escaped at one place, [`escape`].
use super::{
    Part,
    replay::{self, line_text},
    sheet::Table,
};
use crate::cli::{failure::shown, load::Loaded, short};
use std::fmt::Write;
use trunnion_check::{Diagnostic, Report, Scope, Verdict};
use trunnion_syntax::LineIndex;

/// Findings of one program that are listed with their lines; more are counted.
const MOST: usize = 300;

/// A finding as the page shows it.
pub(super) struct Shown {
    weight: &'static str,
    rule: &'static str,
    line: u32,
    column: u32,
    message: String,
    more: Vec<String>,
    text: String,
}

/// The findings, the worst first where there are many.
pub(super) fn findings(loaded: &Loaded, report: &Report) -> Vec<Shown> {
    let source = loaded.program.source();
    let lines = LineIndex::new(source);
    let shown = |d: &Diagnostic| {
        let (line, column) = lines.line_column(source, d.range.start);
        Shown {
            weight: short::weight(d),
            rule: d.rule,
            line,
            column,
            message: format!("{}{}", d.message, short::repeats(loaded, &lines, d)),
            more: d.notes.iter().chain(&d.help).cloned().collect(),
            text: line_text(source, &lines, line),
        }
    };
    let mut all: Vec<Shown> = short::worst(report, MOST).into_iter().map(shown).collect();
    let left = report.diagnostics.len() - all.len();
    if left > 0
        && let Some(last) = all.last_mut()
    {
        last.more.push(format!(
            "{left} more findings are not shown; `trunnion check --limit 0` lists them all"
        ));
    }
    all
}

/// Machine, dialect and coverage.
pub(super) fn facts(loaded: &Loaded, report: &Report, scope: Scope) -> Vec<(&'static str, String)> {
    let resolved = &loaded.resolved;
    let c = &report.coverage;
    let mut facts = vec![
        (
            "Machine",
            resolved
                .machine
                .as_ref()
                .map_or("none".to_owned(), |m| format!("{} ({})", m.name, m.id)),
        ),
        (
            "Dialect",
            format!(
                "{} ({})",
                loaded.dialect_name().unwrap_or("none"),
                resolved.dialect_reason
            ),
        ),
        ("Judged", scope.name().to_owned()),
        ("Blocks run", format!("{} of {}", c.blocks_run, c.blocks)),
        (
            "Motions with a known end",
            format!("{} of {}", c.motions_known, c.motions),
        ),
    ];
    let lines = LineIndex::new(loaded.program.source());
    let line = |block| {
        lines
            .line_column(loaded.program.source(), loaded.program.block(block).range().start)
            .0
    };
    for part in &c.not_run {
        let text = format!(
            "lines {} to {}: {}",
            line(part.first),
            line(part.last),
            part.reason.name()
        );
        facts.push(("Not run", text));
    }
    for lacking in &c.not_judged {
        let text = format!("{}: the machine file does not declare {}", lacking.rule, lacking.needs);
        facts.push(("Not judged", text));
    }
    if let Some(end) = &c.given_up {
        facts.push(("Given up", format!("line {}: {}", line(end.block), end.reason)));
    }
    facts
}

/// What the page of a program says in one line of an overview.
pub(super) struct Row {
    pub(super) verdict: Verdict,
    /// In what it was found: ` on mill-3axis`.
    pub(super) judged_in: String,
    pub(super) name: String,
    pub(super) not_looked_at: Vec<String>,
    /// The program moves in inch.
    pub(super) inch: bool,
    /// Where the rest is.
    pub(super) link: String,
}

/// The title of a page about these programs.
pub(super) fn title(rows: &[Row]) -> String {
    match rows {
        [one] => format!("{}{}: {}", word(one.verdict), one.judged_in, one.name),
        many => counted(many.len()),
    }
}

/// The title of an index.
pub(super) fn counted(programs: usize) -> String {
    crate::cli::verdict::counted(programs as u64, "program")
}

/// The page up to its programs. `inch`: one of them moves in inch. `index`: the page that lists all programs, beside this one.
pub(super) fn begin(title: &str, inch: bool, index: Option<&str>) -> String {
    let title = escape(title);
    let index = index.map_or_else(String::new, |name| {
        format!("<nav><a href=\"{name}\">All programs</a></nav>\n")
    });
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n<style>\n{}</style>\n</head>\n<body>\n\
         {index}<header><h1>{title}</h1><p>Report of trunnion {}. {}, angles in degrees.</p></header>\n",
        include_str!("page.css"),
        env!("CARGO_PKG_VERSION"),
        if inch {
            "Distances in mm, on pictures of inch programs in inch"
        } else {
            "Distances in mm"
        },
    )
}

/// The page after its programs, with what moves the replays if there may be some.
pub(super) fn end(replays: bool) -> String {
    if replays {
        format!("<script>\n{}</script>\n</body>\n</html>\n", include_str!("replay.js"))
    } else {
        "</body>\n</html>\n".to_owned()
    }
}

/// All programs, one line each.
pub(super) fn overview(rows: &[Row], failures: &[String]) -> String {
    let mut out = String::new();
    let count = |verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    let _ = writeln!(
        out,
        "<section><h2>Overview</h2><p>{} pass, {} fail, {} unknown, {} not checked</p><table><tr><th>verdict</th><th>program</th><th>not looked at</th></tr>",
        count(Verdict::Pass),
        count(Verdict::Fail),
        count(Verdict::Unknown),
        failures.len()
    );
    for row in rows {
        let verdict = row.verdict.name();
        let _ = writeln!(
            out,
            "<tr><td class=\"{verdict}\">{}{}</td><td><a href=\"{}\">{}</a></td><td>{}</td></tr>",
            word(row.verdict),
            escape(&row.judged_in),
            escape(&row.link),
            escape(&row.name),
            escape(&row.not_looked_at.join("; "))
        );
    }
    for failure in failures {
        let _ = writeln!(
            out,
            "<tr><td class=\"fail\">NOT CHECKED</td><td>{}</td><td></td></tr>",
            escape(failure)
        );
    }
    out.push_str("</table></section>\n");
    out
}

/// The verdict, in what it was found, and what it says nothing about.
fn head(out: &mut String, at: usize, part: &Part) {
    let verdict = part.verdict.name();
    let _ = writeln!(
        out,
        "<article id=\"p{at}\"><h2><span class=\"badge {verdict}\">{}{}</span> {}</h2>\n",
        word(part.verdict),
        escape(&part.judged_in),
        escape(&part.name),
    );
    if !part.not_looked_at.is_empty() {
        let _ = writeln!(
            out,
            "<p class=\"left unknown\">Not looked at: {}.</p>",
            escape(&part.not_looked_at.join("; "))
        );
    }
    let _ = writeln!(out, "<p class=\"line\">{}</p>", escape(&part.line));
}

/// Everything about one program.
pub(super) fn program(at: usize, part: &Part) -> String {
    let mut text = String::new();
    let out = &mut text;
    head(out, at, part);
    out.push_str("<section><h3>Coverage</h3><table>");
    for (name, value) in &part.facts {
        let _ = writeln!(out, "<tr><th scope=\"row\">{name}</th><td>{}</td></tr>", escape(value));
    }
    out.push_str("</table>");
    if part.assumptions.is_empty() && part.drawn_with.is_empty() {
        out.push_str("<p>Nothing is assumed.</p>");
    } else {
        out.push_str("<h4>Assumptions</h4><ul>");
        for text in &part.assumptions {
            let _ = write!(out, "<li>{}</li>", escape(text));
        }
        for text in &part.drawn_with {
            let _ = write!(
                out,
                "<li>{}: in pictures, replay and set-up sheet; the check leaves it open</li>",
                escape(text)
            );
        }
        out.push_str("</ul>");
    }
    let _ = writeln!(out, "</section>\n<section><h3>Findings ({})</h3>", part.findings.len());
    if part.findings.is_empty() {
        out.push_str("<p>None.</p>");
    }
    for found in &part.findings {
        let _ = write!(
            out,
            "<div class=\"finding {0}\"><p><b class=\"{0}\">{0}</b> <code>{1}</code> line {2}, column {3}: {4}</p>\n\
             <pre><i>{2}</i>{5}</pre>",
            found.weight,
            found.rule,
            found.line,
            found.column,
            escape(&found.message),
            escape(&found.text)
        );
        for text in &found.more {
            let _ = write!(out, "<p class=\"more\">{}</p>", escape(text));
        }
        out.push_str("</div>\n");
    }
    out.push_str("</section>\n");
    if let Some(data) = &part.replay {
        show_replay(out, data);
    }
    if !part.pictures.is_empty() {
        out.push_str("<section class=\"pictures\"><h3>Pictures</h3>\n");
        for (title, picture) in &part.pictures {
            let _ = match picture {
                Ok(svg) => writeln!(out, "<figure><figcaption>{title}</figcaption>{svg}</figure>"),
                Err(why) => writeln!(out, "<p>{title}: {}</p>", escape(why)),
            };
        }
        out.push_str("</section>\n");
    }
    show_sheet(out, &part.sheet);
    out.push_str("</article>\n");
    text
}

/// The set-up sheet.
fn show_sheet(out: &mut String, tables: &[Table]) {
    if tables.is_empty() {
        return;
    }
    out.push_str("<section class=\"sheet\"><h3>Set-up sheet</h3>\n");
    for table in tables.iter().filter(|table| !table.rows.is_empty()) {
        let _ = write!(out, "<h4>{}</h4><div class=\"wide\"><table><tr>", table.title);
        for cell in &table.head {
            let _ = write!(out, "<th>{cell}</th>");
        }
        out.push_str("</tr>\n");
        for row in &table.rows {
            out.push_str("<tr>");
            for cell in row {
                let _ = write!(out, "<td>{}</td>", escape(cell));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</table></div>\n");
    }
    out.push_str("</section>\n");
}

fn show_replay(out: &mut String, data: &replay::Data) {
    let thinned = data.thinned().map_or_else(String::new, |text| format!(" {text}"));
    let data = &data.json;
    let _ = writeln!(
        out,
        "<section class=\"replay\"><h3>Replay</h3>\n<canvas width=\"1100\" height=\"560\" tabindex=\"0\" aria-label=\"The path of the tool tip in \
         space\"></canvas>\n<div class=\"controls\"><button type=\"button\" data-do=\"play\">Play</button>\
         <input type=\"range\" min=\"0\" max=\"1000\" value=\"0\" aria-label=\"position in the program\">\
         <button type=\"button\" data-do=\"iso\">Iso</button><button type=\"button\" data-do=\"front\">Front</button>\
         <button type=\"button\" data-do=\"right\">Right</button><button type=\"button\" data-do=\"top\">Top</button></div>\n\
         <p class=\"state\"></p><pre class=\"now\"></pre>\n\
         <p class=\"hint\">Blue: feed. Grey, dashed: rapid. Orange: run so far. Red squares: findings about axes. Drag to turn, scroll to zoom, shift and drag to move; rapids may reach beyond the frame.{thinned}</p>\n\
         <script type=\"application/json\">{data}</script></section>"
    );
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "PASS",
        Verdict::Fail => "FAIL",
        Verdict::Unknown => "UNKNOWN",
    }
}

/// Text of a program, a name or a message as HTML: nothing in it is markup, control characters are shown.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in shown(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_markup() {
        assert_eq!(
            escape("<img src=x onerror='a'>&\x1b"),
            "&lt;img src=x onerror=&#39;a&#39;&gt;&amp;\\x1b"
        );
    }
}
