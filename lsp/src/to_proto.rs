//! Our plain data to lsp-types.
use crate::{
    analysis::{Analysed, Parsed},
    position::{Encoding, range},
};
use std::fmt::Write;
use tower_lsp::lsp_types::{
    Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, Location, NumberOrString, Position, Range,
};
use trunnion_check::{Severity, Status};
use trunnion_syntax::TextRange;

/// More findings than this are useless in an editor; the last one then states how many there are.
pub(crate) const MOST: usize = 2000;

/// So many of the findings that one leads are links of it.
const MOST_LED: usize = 50;

/// The findings of an analysis; a settings error is one finding at the start of the document.
pub(crate) fn diagnostics(analysed: &Analysed, encoding: Encoding) -> Vec<Diagnostic> {
    if let Err(error) = &analysed.parsed.outcome {
        let text = format!("{error}; nothing is checked until this is corrected");
        return vec![plain("settings", DiagnosticSeverity::ERROR, text)];
    }
    let Some((_, session)) = analysed.judged() else {
        return Vec::new();
    };
    of(&analysed.parsed, &session.report.diagnostics, encoding)
}

/// Findings of a parsed version.
pub(crate) fn of(parsed: &Parsed, all: &[trunnion_check::Diagnostic], encoding: Encoding) -> Vec<Diagnostic> {
    let mut out: Vec<Diagnostic> = all.iter().take(MOST).map(|d| one(parsed, d, encoding)).collect();
    if let Some(more @ 1..) = all.len().checked_sub(MOST) {
        let text = format!(
            "{more} more findings are not shown here; `trunnion check` lists all {}",
            all.len()
        );
        out.push(plain("too-many-findings", DiagnosticSeverity::INFORMATION, text));
    }
    out
}

fn plain(code: &str, severity: DiagnosticSeverity, message: String) -> Diagnostic {
    Diagnostic {
        range: Range::new(Position::new(0, 0), Position::new(0, 0)),
        severity: Some(severity),
        code: Some(NumberOrString::String(code.into())),
        source: Some("trunnion".into()),
        message,
        ..Diagnostic::default()
    }
}

/// What is wrong with a settings or machine file.
pub(crate) fn of_toml(parsed: &Parsed, encoding: Encoding) -> Vec<Diagnostic> {
    let Some((message, place)) = parsed.toml.and_then(|file| file.problem(parsed.characters())) else {
        return Vec::new();
    };
    let bytes = place.map_or(TextRange::default(), |place| {
        TextRange::new(place.start as u32, place.end as u32)
    });
    let mut found = plain("settings", DiagnosticSeverity::ERROR, message);
    found.range = range(&parsed.text, &parsed.starts, bytes, encoding);
    vec![found]
}

fn one(parsed: &Parsed, d: &trunnion_check::Diagnostic, encoding: Encoding) -> Diagnostic {
    let place = |bytes: TextRange| range(&parsed.text, &parsed.starts, bytes, encoding);
    let mut message = d.message.clone();
    if d.status == Status::Unknown {
        message.insert_str(0, "Not decided: ");
    }
    if d.count > 1 {
        let last = place(d.last).start.line;
        // Writing into a String cannot fail.
        let _ = if last == place(d.range).start.line {
            write!(message, " ({} times)", d.count)
        } else {
            write!(message, " ({} blocks, to line {})", d.count, last + 1)
        };
    }
    for more in d.notes.iter().chain(&d.help) {
        message.push('\n');
        message.push_str(more);
    }
    let near = |bytes, message| DiagnosticRelatedInformation {
        location: Location::new(parsed.uri.clone(), place(bytes)),
        message,
    };
    let places = d.related.iter().map(|(bytes, text)| near(*bytes, text.clone()));
    let led = d.also.iter().take(MOST_LED);
    let led = led.map(|led| near(led.range, format!("{}: {}", led.rule, led.message)));
    let related: Vec<_> = places.chain(led).collect();
    Diagnostic {
        range: place(d.range),
        severity: Some(match d.severity {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
            Severity::Info => DiagnosticSeverity::INFORMATION,
        }),
        code: Some(NumberOrString::String(d.rule.into())),
        source: Some("trunnion".into()),
        message,
        related_information: (!related.is_empty()).then_some(related),
        ..Diagnostic::default()
    }
}
