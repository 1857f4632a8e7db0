//! Quick fixes: rewrites that fix a finding, offered only when proved; a refusal is shown with its reason.
use crate::{
    analysis::Analysed,
    position::{Encoding, offset, range},
    to_proto,
};
use std::collections::{BTreeSet, HashMap};
use tower_lsp::lsp_types::{
    CodeAction, CodeActionDisabled, CodeActionKind, CodeActionOrCommand, CodeActionParams, Diagnostic, NumberOrString,
    TextEdit, WorkspaceEdit,
};
use trunnion_rewrite::{Attempt, Options, Rewrite, attempt, rewrite};

/// The quick fixes for the findings that touch the asked range.
#[expect(clippy::unnecessary_wraps, reason = "the shape of the protocol's answer")]
pub(crate) fn code_actions(
    analysed: &Analysed,
    params: &CodeActionParams,
    encoding: Encoding,
) -> Option<Vec<CodeActionOrCommand>> {
    let Ok(judged) = &analysed.outcome else {
        return Some(Vec::new());
    };
    let wanted = params
        .context
        .only
        .as_ref()
        .is_none_or(|kinds| kinds.contains(&CodeActionKind::QUICKFIX));
    if !wanted {
        return Some(Vec::new());
    }
    let start = offset(&analysed.text, &analysed.starts, params.range.start, encoding) as u32;
    let end = offset(&analysed.text, &analysed.starts, params.range.end, encoding) as u32;
    let touched: Vec<_> = judged
        .session
        .report
        .diagnostics
        .iter()
        .filter(|d| d.range.start <= end && start <= d.range.end)
        .collect();
    let names: BTreeSet<&'static str> = touched.iter().flat_map(|d| d.fixes.iter().copied()).collect();
    let likely = touched.iter().filter_map(|d| likely(analysed, d, encoding));
    let actions = names
        .into_iter()
        .filter_map(rewrite)
        .filter_map(|r| action(analysed, r, encoding));
    Some(likely.chain(actions).map(CodeActionOrCommand::CodeAction).collect())
}

/// The text that a finding takes for likely, in place of what is there.
fn likely(analysed: &Analysed, found: &trunnion_check::Diagnostic, encoding: Encoding) -> Option<CodeAction> {
    let replacement = found.replacement.as_ref()?;
    let place = range(&analysed.text, &analysed.starts, found.range, encoding);
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
        edit: Some(WorkspaceEdit::new(HashMap::from([(analysed.uri.clone(), vec![edit])]))),
        ..CodeAction::default()
    })
}

fn action(analysed: &Analysed, rewrite: &Rewrite, encoding: Encoding) -> Option<CodeAction> {
    let judged = analysed.outcome.as_ref().ok()?;
    let base = CodeAction {
        title: rewrite.name.into(),
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: Some(cured(analysed, rewrite, encoding)),
        ..CodeAction::default()
    };
    match attempt(
        rewrite,
        &judged.program,
        &judged.resolved.settings(),
        &Options::default(),
    ) {
        Attempt::NothingToDo => None,
        Attempt::Refused(reason) => Some(CodeAction {
            title: format!("{}: not offered: {reason}", rewrite.name),
            disabled: Some(CodeActionDisabled { reason }),
            ..base
        }),
        Attempt::Certified { edits, summary, .. } => {
            let edits = edits
                .iter()
                .map(|edit| {
                    TextEdit::new(
                        range(&analysed.text, &analysed.starts, edit.range, encoding),
                        edit.new_text.clone(),
                    )
                })
                .collect();
            Some(CodeAction {
                title: format!("{}: {summary} (proved)", rewrite.name),
                edit: Some(WorkspaceEdit::new(HashMap::from([(analysed.uri.clone(), edits)]))),
                is_preferred: Some(true),
                ..base
            })
        }
    }
}

/// The findings of the document that the rewrite fixes.
fn cured(analysed: &Analysed, rewrite: &Rewrite, encoding: Encoding) -> Vec<Diagnostic> {
    let cures = |d: &Diagnostic| matches!(&d.code, Some(NumberOrString::String(code)) if rewrite.cures.contains(&code.as_str()));
    to_proto::diagnostics(analysed, encoding)
        .into_iter()
        .filter(cures)
        .collect()
}
