//! Rewrites as code actions, and the request `trunnion/rewrite`, which hands over the certificate too. What is offered is proved; a refusal is shown
//! with its reason.
use crate::{
    analysis::Analysed,
    edits,
    position::{Encoding, range},
    snapshot::Snapshot,
    to_proto,
};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::HashMap;
use tower_lsp::{
    jsonrpc::Result,
    lsp_types::{
        CodeAction, CodeActionDisabled, CodeActionKind, Command, Diagnostic, NumberOrString, Range,
        TextDocumentIdentifier, TextEdit, WorkspaceEdit,
    },
};
use trunnion_check::Settings;
use trunnion_rewrite::{Attempt, Known, Options, Place, Proved, Rewrite, State, attempt_at, rewrite, rewrites};
use trunnion_syntax::{BlockId, Program, TextRange};

/// All rewrites are tried unasked only for programs with at most so many blocks: each runs the program several times.
const MOST_BLOCKS: usize = 20_000;

/// The rewrites that need nothing but the program: `retarget` needs another machine.
pub(crate) fn offered() -> impl Iterator<Item = &'static Rewrite> {
    rewrites().iter().copied().filter(|rewrite| rewrite.name != "retarget")
}

/// A rewrite's name and what it does, as `capabilities.experimental.rewrites` lists them.
pub(crate) fn list() -> serde_json::Value {
    let one =
        |rewrite: &Rewrite| json!({ "name": rewrite.name, "summary": rewrite.docs.lines().next().unwrap_or_default() });
    offered().map(one).collect()
}

/// Makes code actions of rewrites, for the bytes asked.
pub(crate) struct Offer<'a> {
    analysed: &'a Analysed,
    encoding: Encoding,
    asked: (u32, u32),
    /// The client knows our commands.
    commands: bool,
    known: Known,
}

impl<'a> Offer<'a> {
    pub(crate) fn new(analysed: &'a Analysed, encoding: Encoding, asked: (u32, u32), commands: bool) -> Self {
        Self {
            analysed,
            encoding,
            asked,
            commands,
            known: Known::default(),
        }
    }

    /// Every rewrite that finds something to change.
    pub(crate) fn all(&mut self) -> Vec<CodeAction> {
        let blocks = self.analysed.judged().map(|(source, _)| source.program.block_count());
        if blocks.is_none_or(|blocks| blocks > MOST_BLOCKS) {
            return Vec::new();
        }
        offered()
            .flat_map(|one| self.actions(one, &CodeActionKind::REFACTOR_REWRITE))
            .collect()
    }

    /// A rewrite as a quick fix.
    pub(crate) fn fixes(&mut self, one: &Rewrite) -> Vec<CodeAction> {
        self.actions(one, &CodeActionKind::QUICKFIX)
    }

    /// For the whole program, and for the places that touch the asked bytes alone where it changes others too; or why it is refused.
    fn actions(&mut self, one: &Rewrite, kind: &CodeActionKind) -> Vec<CodeAction> {
        let Some((source, _)) = self.analysed.judged() else {
            return Vec::new();
        };
        let (program, settings) = (&source.program, source.resolved.settings());
        let options = Options::of(&source.resolved.fix);
        let whole = attempt_at(one, program, &settings, &options, |_| true, &self.known);
        let Some(proved) = &whole.proved else {
            return whole
                .reasons()
                .map(|reason| self.refused(one, kind, &reason))
                .into_iter()
                .collect();
        };
        let touches = touches(program, self.asked);
        let mut list = Vec::new();
        let changed = || whole.places.iter().filter(|place| place.state == State::Proved);
        let here = changed().any(|place| touches(place.first, place.last));
        if here && !changed().all(|place| touches(place.first, place.last)) {
            let wanted = |place: &Place| touches(place.first, place.last);
            let here = attempt_at(one, program, &settings, &options, wanted, &self.known);
            if let Some(here) = &here.proved {
                list.push(self.offer(one, kind, here, format!("{}: here only (proved)", one.name)));
                list.extend(self.show(one, kind, true));
            }
        }
        list.push(self.offer(one, kind, proved, format!("{}: {} (proved)", one.name, proved.summary)));
        list.extend(self.show(one, kind, false));
        list
    }

    fn base(&self, one: &Rewrite, kind: &CodeActionKind, title: String) -> CodeAction {
        CodeAction {
            title,
            kind: Some(kind.clone()),
            diagnostics: (*kind == CodeActionKind::QUICKFIX).then(|| cured(self.analysed, one, self.encoding)),
            ..CodeAction::default()
        }
    }

    fn offer(&self, one: &Rewrite, kind: &CodeActionKind, proved: &Proved, title: String) -> CodeAction {
        let parsed = &self.analysed.parsed;
        let edit = |edit: &trunnion_syntax::TextEdit| {
            TextEdit::new(
                range(&parsed.text, &parsed.starts, edit.range, self.encoding),
                edit.new_text.clone(),
            )
        };
        let changes = HashMap::from([(parsed.uri.clone(), proved.edits.iter().map(edit).collect())]);
        CodeAction {
            edit: Some(WorkspaceEdit::new(changes)),
            is_preferred: (*kind == CodeActionKind::QUICKFIX).then_some(true),
            ..self.base(one, kind, title)
        }
    }

    fn refused(&self, one: &Rewrite, kind: &CodeActionKind, reason: &str) -> CodeAction {
        CodeAction {
            disabled: Some(CodeActionDisabled {
                reason: reason.to_owned(),
            }),
            ..self.base(one, kind, format!("{}: not offered: {reason}", one.name))
        }
    }

    /// Shows what the rewrite does and its certificate, for clients that can.
    fn show(&self, one: &Rewrite, kind: &CodeActionKind, here: bool) -> Option<CodeAction> {
        let parsed = &self.analysed.parsed;
        let bytes = TextRange::new(self.asked.0, self.asked.1);
        let asked = here.then(|| range(&parsed.text, &parsed.starts, bytes, self.encoding));
        let title = format!(
            "{}{}: show before and after, or the certificate",
            one.name,
            if here { ": here only" } else { "" }
        );
        self.commands.then(|| CodeAction {
            command: Some(Command {
                title: title.clone(),
                command: "trunnion.rewriteProgram".to_owned(),
                arguments: Some(vec![json!(one.name), json!(asked)]),
            }),
            ..self.base(one, kind, title)
        })
    }
}

/// Whether blocks touch bytes.
fn touches(program: &Program, (start, end): (u32, u32)) -> impl Fn(BlockId, BlockId) -> bool + Copy + '_ {
    move |first, last| program.block(first).range().start <= end && start <= program.block(last).range().end
}

/// The findings of the document that the rewrite fixes.
fn cured(analysed: &Analysed, rewrite: &Rewrite, encoding: Encoding) -> Vec<Diagnostic> {
    let cures = |d: &Diagnostic| matches!(&d.code, Some(NumberOrString::String(code)) if rewrite.cures.contains(&code.as_str()));
    to_proto::diagnostics(analysed, encoding)
        .into_iter()
        .filter(cures)
        .collect()
}

/// `trunnion/rewrite`: a program, a rewrite by name, and the lines that it may change; without them, all.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct RewriteParams {
    pub(crate) text_document: TextDocumentIdentifier,
    rewrite: String,
    range: Option<Range>,
}

/// The answer.
#[derive(Debug, Serialize)]
pub(crate) struct RewriteAnswer {
    edits: Vec<TextEdit>,
    /// What it does, in one sentence.
    summary: String,
    /// Places that stay as they are: the reason, with the line.
    notes: Vec<String>,
    /// The certificate, as `trunnion fix --certificate` writes it.
    certificate: String,
}

/// Makes a rewrite; a refusal is an error with its reason.
pub(crate) fn answer(snapshot: &Snapshot, params: &RewriteParams) -> Result<RewriteAnswer> {
    let one = rewrite(&params.rewrite)
        .filter(|one| offered().any(|other| other.name == one.name))
        .ok_or_else(|| edits::failed(format!("there is no rewrite `{}`", params.rewrite)))?;
    let source = snapshot
        .source()
        .ok_or_else(|| edits::failed(edits::NO_PROGRAM.to_owned()))?;
    let (program, settings): (_, Settings<'_>) = (&source.program, source.resolved.settings());
    let options = Options::of(&source.resolved.fix);
    let asked = params.range.map(|range| snapshot.bytes(range));
    let wanted =
        |place: &Place| asked.is_none_or(|asked| touches(program, (asked.start, asked.end))(place.first, place.last));
    let attempt = attempt_at(one, program, &settings, &options, wanted, &Known::default());
    let reasons = attempt.reasons();
    let Attempt {
        proved: Some(proved), ..
    } = attempt
    else {
        return Err(edits::failed(
            reasons.unwrap_or_else(|| "there is nothing to change".to_owned()),
        ));
    };
    Ok(RewriteAnswer {
        edits: snapshot.edits(proved.edits),
        summary: format!("{}: {}", one.name, proved.summary),
        notes: reasons.into_iter().collect(),
        certificate: proved.certificate.to_json(),
    })
}
