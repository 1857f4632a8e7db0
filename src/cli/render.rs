//! Diagnostics as miette reports: the only file that names miette.
use super::{
    failure::{is_hidden, shown},
    load::Loaded,
    screen, short,
};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, SourceCode,
    SourceSpan, SpanContents,
};
use std::fmt::{self, Write};
use trunnion_check::{Report, Severity, Status};
use trunnion_syntax::{LineIndex, TextRange};

/// Columns of the report.
const WIDTH: usize = 110;
/// Up to so many findings that are more than infos are shown with their lines of program; more would not fit on a screen.
pub(super) const EXCERPTS: usize = 3;
/// Lines of program shown before and after the finding.
const CONTEXT: usize = 1;
/// Lines longer than this are cut around the finding, bytes.
const LONGEST_LINE: usize = 240;

/// The findings of one file: as many as fit on a screen, or at most `limit` of them (0: all); and a line that counts the rest.
pub(super) fn pretty(loaded: &Loaded, lines: &LineIndex, report: &Report, limit: Option<usize>, color: bool) -> String {
    let page = Page { loaded, lines, color };
    let (found, excerpts) = match limit {
        Some(limit) => {
            let found = short::worst(report, limit);
            let few = found.iter().filter(|d| !is_info(d)).count() <= EXCERPTS;
            let excerpts = found.iter().map(|d| few && !is_info(d)).collect();
            (found, excerpts)
        }
        None => screen::chosen(&page, report),
    };
    let mut out = page.text(&found, &excerpts);
    let rest = short::rest(report, &found, &loaded.name);
    out.push_str(&shown(&rest));
    out
}

/// Shown in a line or two, never with lines of program.
pub(super) fn is_info(d: &trunnion_check::Diagnostic) -> bool {
    d.status == Status::Fail && d.severity == Severity::Info
}

/// What the findings of a report are drawn with.
pub(super) struct Page<'a> {
    loaded: &'a Loaded,
    lines: &'a LineIndex,
    color: bool,
}

impl Page<'_> {
    /// These findings; of each whether it has its lines of program.
    pub(super) fn text(&self, shown: &[&trunnion_check::Diagnostic], excerpts: &[bool]) -> String {
        let Self { loaded, lines, color } = *self;
        let theme = if color {
            GraphicalTheme::unicode()
        } else {
            GraphicalTheme::unicode_nocolor()
        };
        let handler = GraphicalReportHandler::new_themed(theme)
            .with_width(WIDTH)
            .with_context_lines(CONTEXT)
            .with_links(false);
        let mut out = String::new();
        let mut before: Option<&trunnion_check::Diagnostic> = None;
        for (&d, excerpt) in shown.iter().zip(excerpts) {
            if !excerpt {
                // what to do about several findings of one rule is said once
                let again = before
                    .is_some_and(|before| before.rule == d.rule && before.help == d.help && before.notes == d.notes);
                compact(&mut out, loaded, lines, (d, again), color);
                before = Some(d);
                continue;
            }
            let excerpt = Excerpt::new(loaded, lines, d.range);
            let repeats = short::repeats(loaded, lines, d);
            let finding = Finding { d, excerpt, repeats };
            // Writing into a String cannot fail; if rendering fails, the one-line form of the finding replaces it.
            if handler.render_report(&mut out, &finding).is_err() {
                let _ = writeln!(out, "{}[{}] {}", short::weight(d), d.rule, d.message);
            }
            out.push('\n');
        }
        out
    }
}

/// A finding without its lines of program: an info, or one of many; without its notes and help where the one before has the same.
fn compact(
    out: &mut String,
    loaded: &Loaded,
    lines: &LineIndex,
    (d, again): (&trunnion_check::Diagnostic, bool),
    color: bool,
) {
    let (line, column) = lines.line_column(loaded.program.source(), d.range.start);
    let head = format!("{}[{}]", short::weight(d), d.rule);
    let place = format!("{}:{line}:{column}:", shown(&loaded.name));
    let message = format!("{place} {}{}", shown(&d.message), short::repeats(loaded, lines, d));
    let code = match (d.status, d.severity) {
        (Status::Fail, Severity::Error) => "31",
        (Status::Fail, Severity::Warning) => "33",
        _ => "36",
    };
    let styled = if color {
        format!("\u{1b}[1;{code}m{head}\u{1b}[0m")
    } else {
        head.clone()
    };
    let mut rows = wrapped(&format!("{head} {message}"), "  ").into_iter();
    let first = rows.next().unwrap_or_default();
    if again && out.ends_with("\n\n") {
        out.pop();
    }
    // writing into a String cannot fail
    let _ = writeln!(out, "{styled}{}", &first[head.len().min(first.len())..]);
    let more = d.notes.iter().chain(&d.help).filter(|_| !again).map(|text| shown(text));
    for row in rows.chain(more.flat_map(|text| wrapped(&format!("  {text}"), "    "))) {
        let _ = writeln!(out, "{row}");
    }
    out.push('\n');
}

/// A text in rows of the width of the report; all but the first begin with `indent`.
fn wrapped(text: &str, indent: &str) -> Vec<String> {
    let mut rows = vec![String::new()];
    let lead = text.len() - text.trim_start().len();
    rows[0].push_str(&text[..lead]);
    let mut begins = true;
    for word in text.split_whitespace() {
        let last = rows.len() - 1;
        if !begins && rows[last].chars().count() + 1 + word.chars().count() > WIDTH {
            rows.push(format!("{indent}{word}"));
            continue;
        }
        if !begins {
            rows[last].push(' ');
        }
        rows[last].push_str(word);
        begins = false;
    }
    rows
}

struct Finding<'a> {
    d: &'a trunnion_check::Diagnostic,
    excerpt: Excerpt,
    /// How often, with a blank before it; empty for once.
    repeats: String,
}

impl fmt::Debug for Finding<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.d, f)
    }
}

impl fmt::Display for Finding<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown(&self.d.message))?;
        f.write_str(&self.repeats)
    }
}

impl std::error::Error for Finding<'_> {}

impl Diagnostic for Finding<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(format!("{}[{}]", short::weight(self.d), self.d.rule)))
    }
    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.d.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
            Severity::Info => miette::Severity::Advice,
        })
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let mut text = self.d.notes.join("\n");
        if let Some(help) = &self.d.help {
            if !text.is_empty() {
                text.push('\n');
            }
            text.push_str(help);
        }
        let text = shown(&text).into_owned();
        (!text.is_empty()).then(|| Box::new(text) as Box<dyn fmt::Display>)
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.excerpt)
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = self
            .d
            .block
            .as_ref()
            .map(|block| shown(&format!("in block {block}")).into_owned());
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(
            label,
            self.excerpt.span,
        ))))
    }
}

/// The lines around a finding. miette would scan the file from its start for each finding; this does not.
#[derive(Debug)]
struct Excerpt {
    name: String,
    /// Valid UTF-8: bytes that are not are shown as `?`, one for one, so that offsets hold.
    data: Vec<u8>,
    /// The finding inside `data`.
    span: SourceSpan,
    /// Line of the first byte, from 0.
    line: usize,
    column: usize,
    /// Line and column of the finding, from 0.
    place: (usize, usize),
}

impl Excerpt {
    fn new(loaded: &Loaded, lines: &LineIndex, range: TextRange) -> Self {
        let source = loaded.program.source();
        let (line, at) = lines.line_column(source, range.start);
        let (last, _) = lines.line_column(source, range.end.max(range.start));
        let start_of = |line: usize| lines.starts.get(line).map_or(source.len(), |&s| s as usize);
        let mut first = (line as usize - 1).saturating_sub(CONTEXT);
        let mut start = start_of(first);
        let mut end = start_of(last as usize + CONTEXT);
        let mut column = 0;
        let from = range.start as usize;
        if from - start > LONGEST_LINE * 2 {
            first = line as usize - 1;
            start = start_of(first).max(from.saturating_sub(LONGEST_LINE / 2));
            column = start - start_of(first);
        }
        let until = (range.end as usize).min(from + LONGEST_LINE);
        end = end.min(until + LONGEST_LINE).max(until).min(source.len());
        while start < from && is_continuation(source[start]) {
            start += 1;
        }
        while end < source.len() && is_continuation(source[end]) {
            end += 1;
        }
        let data = printable(&source[start..end]);
        let span = SourceSpan::new((from - start).into(), (until - from).min(data.len()));
        Self {
            name: shown(&loaded.name).into_owned(),
            data,
            span,
            line: first,
            column,
            place: (line as usize - 1, at as usize - 1),
        }
    }
}

fn is_continuation(byte: u8) -> bool {
    byte & 0b1100_0000 == 0b1000_0000
}

/// The bytes as valid UTF-8 of the same length; without control bytes that would upset a terminal.
fn printable(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        for c in chunk.valid().chars() {
            let mut buffer = [0; 4];
            let encoded = c.encode_utf8(&mut buffer);
            if c != '\r' && is_hidden(c) {
                out.extend(encoded.bytes().map(|_| b'?'));
            } else {
                out.extend_from_slice(encoded.as_bytes());
            }
        }
        out.extend(chunk.invalid().iter().map(|_| b'?'));
    }
    out
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        _after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        if span.offset() + span.len() > self.data.len() {
            return Err(MietteError::OutOfBounds);
        }
        // asked without context for the place shown above the lines
        if before == 0 {
            let (line, column) = self.place;
            return Ok(Box::new(MietteSpanContents::new_named(
                self.name.clone(),
                &self.data[span.offset()..span.offset() + span.len()],
                *span,
                line,
                column,
                1,
            )));
        }
        let whole = SourceSpan::new(0.into(), self.data.len());
        let lines = self.data.split(|&b| b == b'\n').count();
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            &self.data,
            whole,
            self.line,
            self.column,
            lines,
        )))
    }
}
