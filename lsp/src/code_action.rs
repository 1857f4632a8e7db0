//! Quick fixes: rewrites that fix a finding, offered only when proved; a refusal is shown with its reason. On request also edits of the whole program.
use crate::{
    analysis::{Analysed, Parsed},
    edits,
    position::{Encoding, offset, range},
    rewrites::Offer,
    to_proto,
};
use std::collections::{BTreeSet, HashMap};
use tower_lsp::lsp_types::{
    CodeAction, CodeActionKind, CodeActionOrCommand, CodeActionParams, Diagnostic, NumberOrString, Range, TextEdit,
    WorkspaceEdit,
};
use trunnion_rewrite::rewrite;
use trunnion_syntax::TextRange;

/// The quick fixes for the findings that touch the asked range.
#[expect(clippy::unnecessary_wraps, reason = "the shape of the protocol's answer")]
pub(crate) fn code_actions(
    analysed: &Analysed,
    params: &CodeActionParams,
    encoding: Encoding,
    commands: bool,
) -> Option<Vec<CodeActionOrCommand>> {
    if analysed.parsed.outcome.is_err() {
        let found = to_proto::diagnostics(analysed, encoding);
        return Some(of_settings(&analysed.parsed, &found, encoding));
    }
    let Some((_, session)) = analysed.judged() else {
        return Some(Vec::new());
    };
    let only = params.context.only.as_ref();
    let wanted = only.is_none_or(|kinds| kinds.contains(&CodeActionKind::QUICKFIX));
    let byte = |position| offset(&analysed.parsed.text, &analysed.parsed.starts, position, encoding) as u32;
    let (start, end) = (byte(params.range.start), byte(params.range.end));
    let mut offer = Offer::new(analysed, encoding, (start, end), commands);
    let mut whole = Vec::new();
    if edits::wanted(&params.context) {
        whole = edits::actions(&analysed.parsed, encoding, TextRange::new(start, end.max(start)));
    }
    if only.is_some() && edits::wanted(&params.context) {
        whole.extend(offer.all());
    }
    let whole = whole.into_iter().map(CodeActionOrCommand::CodeAction);
    if !wanted {
        return Some(whole.collect());
    }
    let touched: Vec<_> = session
        .report
        .diagnostics
        .iter()
        .filter(|d| d.range.start <= end && start <= d.range.end)
        .collect();
    let names: BTreeSet<&'static str> = touched.iter().flat_map(|d| d.fixes.iter().copied()).collect();
    let likely = touched.iter().filter_map(|d| likely(analysed, d, encoding));
    let named = names.into_iter().filter_map(rewrite);
    let actions: Vec<_> = named.flat_map(|one| offer.fixes(one)).collect();
    let fixes = likely.chain(actions).map(CodeActionOrCommand::CodeAction);
    Some(fixes.chain(whole).collect())
}

/// The text that a finding takes for likely, in place of what is there.
fn likely(analysed: &Analysed, found: &trunnion_check::Diagnostic, encoding: Encoding) -> Option<CodeAction> {
    let replacement = found.replacement.as_ref()?;
    let place = range(&analysed.parsed.text, &analysed.parsed.starts, found.range, encoding);
    let same = |d: &Diagnostic| {
        d.range == place && matches!(&d.code, Some(NumberOrString::String(code)) if code == found.rule)
    };
    let edit = TextEdit::new(place, replacement.clone());
    Some(CodeAction {
        title: format!("write {replacement}"),
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: Some(
            to_proto::diagnostics(analysed, encoding)
                .into_iter()
                .filter(same)
                .collect(),
        ),
        edit: Some(WorkspaceEdit::new(HashMap::from([(
            analysed.parsed.uri.clone(),
            vec![edit],
        )]))),
        ..CodeAction::default()
    })
}

/// The names that problems of settings take for likely, in place of the wrong ones: in a settings file, or in a `trunnion:` comment of a program.
pub(crate) fn of_settings(parsed: &Parsed, found: &[Diagnostic], encoding: Encoding) -> Vec<CodeActionOrCommand> {
    let mut actions = Vec::new();
    for problem in found {
        let Some((wrong, likely)) = misspelt(&problem.message) else {
            continue;
        };
        let Some(place) = name_at(parsed, problem, wrong, encoding) else {
            continue;
        };
        for meant in likely {
            let edit = TextEdit::new(place, meant.to_owned());
            actions.push(CodeActionOrCommand::CodeAction(CodeAction {
                title: format!("write {meant}"),
                kind: Some(CodeActionKind::QUICKFIX),
                diagnostics: Some(vec![problem.clone()]),
                edit: Some(WorkspaceEdit::new(HashMap::from([(parsed.uri.clone(), vec![edit])]))),
                ..CodeAction::default()
            }));
        }
    }
    actions
}

/// The wrong name and the likely ones in a message like ``unknown key `machin`; did you mean `machine`?``.
fn misspelt(message: &str) -> Option<(&str, Vec<&str>)> {
    let (before, after) = message.split_once("; did you mean ")?;
    let wrong = before.rsplit('`').nth(1).filter(|name| !name.is_empty())?;
    let likely = after.split('?').next()?.split('`').skip(1).step_by(2).collect();
    Some((wrong, likely))
}

/// Where a wrong name stands: at the problem, else in a comment for this program.
fn name_at(parsed: &Parsed, problem: &Diagnostic, wrong: &str, encoding: Encoding) -> Option<Range> {
    let text = parsed.characters();
    let whole = |at: &usize| {
        let part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
        !text[..*at].ends_with(part) && !text[at + wrong.len()..].starts_with(part)
    };
    let from = if parsed.toml.is_some() {
        offset(&parsed.text, &parsed.starts, problem.range.start, encoding)
    } else {
        text.find("trunnion:")?
    };
    let mut found = text.get(from..)?.match_indices(wrong).map(|(at, _)| from + at);
    let at = found.find(whole)?;
    if parsed.toml.is_none() && !text[..at].rsplit('\n').next()?.contains("trunnion:") {
        return None;
    }
    let bytes = TextRange::new(at as u32, (at + wrong.len()) as u32);
    Some(range(&parsed.text, &parsed.starts, bytes, encoding))
}
