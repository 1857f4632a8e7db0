//! Help while writing: completion, signatures, hints, formatting; and colours.
use crate::snapshot::Snapshot;
use tower_lsp::{
    jsonrpc::{Error, Result},
    lsp_types::{
        CompletionItem, CompletionItemKind, CompletionTextEdit, Documentation, InlayHint, InlayHintKind,
        InlayHintLabel, MarkupContent, MarkupKind, ParameterInformation, ParameterLabel, Position, Range,
        SemanticToken, SignatureHelp, SignatureInformation, TextEdit,
    },
};
use trunnion_ide::{
    CompletionKind, HintKind, Kind, Role, completions, format, hints, signature, style, tokens, toml_completions,
};
use trunnion_syntax::TextRange;

fn markdown(value: String) -> MarkupContent {
    MarkupContent {
        kind: MarkupKind::Markdown,
        value,
    }
}

/// What fits at a position.
pub(crate) fn completion(snapshot: &Snapshot, position: Position) -> Vec<CompletionItem> {
    let offset = snapshot.offset(position);
    if let Some(file) = snapshot.parsed.toml {
        let (keys, place) = toml_completions(file, snapshot.parsed.characters(), offset as usize);
        let range = snapshot.range(TextRange::new(place.start as u32, place.end as u32));
        let one = |(key, docs): (String, String)| CompletionItem {
            label: key.clone(),
            kind: Some(CompletionItemKind::PROPERTY),
            documentation: (!docs.is_empty()).then(|| Documentation::MarkupContent(markdown(docs))),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit::new(range, key))),
            ..CompletionItem::default()
        };
        return keys.into_iter().map(one).collect();
    }
    let Some(source) = snapshot.source() else {
        return Vec::new();
    };
    let mut programs = Vec::new();
    for other in snapshot.others() {
        let Some(theirs) = other.source() else { continue };
        let defined = theirs
            .names()
            .all
            .iter()
            .filter(|one| one.kind == Kind::Program && one.role == Role::Definition);
        programs.extend(defined.map(|one| one.name.to_string()));
    }
    let one = |(at, item): (usize, trunnion_ide::Completion)| CompletionItem {
        label: item.label.clone(),
        kind: Some(match item.kind {
            CompletionKind::Code => CompletionItemKind::FUNCTION,
            CompletionKind::Name => CompletionItemKind::KEYWORD,
            CompletionKind::Address => CompletionItemKind::FIELD,
            CompletionKind::Variable => CompletionItemKind::VARIABLE,
            CompletionKind::Label => CompletionItemKind::REFERENCE,
            CompletionKind::Program => CompletionItemKind::MODULE,
        }),
        detail: Some(item.detail),
        documentation: (!item.docs.is_empty()).then(|| Documentation::MarkupContent(markdown(item.docs))),
        // G1, G2, ... in the order of their numbers
        sort_text: Some(format!("{at:05}")),
        text_edit: Some(CompletionTextEdit::Edit(TextEdit::new(
            snapshot.range(item.replace),
            item.label,
        ))),
        ..CompletionItem::default()
    };
    completions(
        &source.program,
        source.resolved.dialect,
        source.names(),
        &programs,
        offset,
    )
    .into_iter()
    .enumerate()
    .map(one)
    .collect()
}

/// The words of the code at a position.
pub(crate) fn signature_help(snapshot: &Snapshot, position: Position) -> Option<SignatureHelp> {
    let source = snapshot.source()?;
    let found = signature(&source.program, source.resolved.dialect, snapshot.offset(position))?;
    let parameters = found
        .words
        .into_iter()
        .map(|((start, end), docs)| ParameterInformation {
            label: ParameterLabel::LabelOffsets([start, end]),
            documentation: Some(Documentation::String(docs)),
        });
    Some(SignatureHelp {
        signatures: vec![SignatureInformation {
            label: found.label,
            documentation: Some(Documentation::MarkupContent(markdown(found.docs))),
            parameters: Some(parameters.collect()),
            active_parameter: found.active,
        }],
        active_signature: Some(0),
        active_parameter: found.active,
    })
}

/// Hints between the words of a range.
pub(crate) fn inlay_hints(snapshot: &Snapshot, range: Range) -> Vec<InlayHint> {
    let Some((source, session)) = snapshot.analysed.as_deref().and_then(|analysed| analysed.judged()) else {
        return Vec::new();
    };
    let shown = snapshot.shown;
    let wanted = |kind| match kind {
        HintKind::Value => shown.values,
        HintKind::Modal => shown.modal,
    };
    let settings = source.resolved.settings();
    let list = hints(
        &source.program,
        &settings,
        session,
        source.outline(),
        snapshot.bytes(range),
        &wanted,
    );
    let one = |hint: trunnion_ide::Hint| InlayHint {
        position: snapshot.range(TextRange::new(hint.at, hint.at)).start,
        label: InlayHintLabel::String(hint.text),
        kind: Some(InlayHintKind::TYPE),
        text_edits: None,
        tooltip: None,
        padding_left: Some(true),
        padding_right: None,
        data: None,
    };
    list.into_iter().map(one).collect()
}

/// The edits that lay out the document, or the lines of a range.
pub(crate) fn formatting(snapshot: &Snapshot, range: Option<Range>) -> Result<Option<Vec<TextEdit>>> {
    let Some(source) = snapshot.source() else {
        return Ok(None);
    };
    let resolved = &source.resolved;
    let lines = range.map(|range| snapshot.bytes(range));
    let edits = format(
        &source.program,
        resolved.dialect,
        &resolved.setup,
        &style(&resolved.format),
        lines,
    );
    match edits {
        Ok(edits) => Ok(Some(snapshot.edits(edits))),
        Err(why) => {
            let mut error = Error::invalid_params(format!("not formatted: {why}"));
            // LSP 3.17: RequestFailed
            error.code = tower_lsp::jsonrpc::ErrorCode::ServerError(-32803);
            Err(error)
        }
    }
}

/// On a new line: the line above it, if it can be laid out.
pub(crate) fn on_type(snapshot: &Snapshot, position: Position) -> Option<Vec<TextEdit>> {
    let line = position.line.checked_sub(1)?;
    let range = Range::new(Position::new(line, 0), Position::new(line, u32::MAX));
    formatting(snapshot, Some(range)).ok().flatten()
}

/// Above this size, bytes, only the colours of a range are sent: those of a whole text take forty times its size. Editors ask for the lines
/// that they show. Visual Studio Code takes an empty answer for the colours of the whole text, so its extension asks for ranges itself.
const MOST_COLOURED: usize = 4 << 20;

/// The colours of all lines; `None` where the text is too long for that.
pub(crate) fn all_colours(snapshot: &Snapshot) -> Option<Vec<SemanticToken>> {
    let whole = Range::new(Position::new(0, 0), Position::new(u32::MAX, 0));
    (snapshot.parsed.text.len() <= MOST_COLOURED).then(|| colours(snapshot, whole))
}

/// The colours of the lines of a range.
pub(crate) fn colours(snapshot: &Snapshot, range: Range) -> Vec<SemanticToken> {
    let Some(source) = snapshot.source() else {
        return Vec::new();
    };
    let (text, starts) = (&snapshot.parsed.text, &snapshot.parsed.starts);
    let line = |line: u32| starts.get(line as usize).map_or(text.len(), |&start| start as usize);
    let first = range.start.line;
    let (from, to) = (line(first), line(range.end.line.saturating_add(1)));
    let Some(piece) = text.get(from..to) else {
        return Vec::new();
    };
    let list = tokens(piece, source.resolved.dialect.lex, source.resolved.dialect);
    let local = crate::position::Lines::new(piece);
    let mut found = Vec::with_capacity(list.len());
    let (mut last_line, mut last_column) = (0, 0);
    for token in list {
        let place = crate::position::range(piece, &local, token.range, snapshot.encoding);
        for at in place.start.line..=place.end.line {
            let start = if at == place.start.line {
                place.start.character
            } else {
                0
            };
            let end = if at == place.end.line {
                place.end.character
            } else {
                let end = local.get(at as usize + 1).map_or(piece.len() as u32, |next| next - 1);
                crate::position::position(piece, &local, end as usize, snapshot.encoding).character
            };
            if end <= start {
                continue;
            }
            let line = first + at;
            let delta_line = line - last_line;
            let delta_start = if delta_line == 0 { start - last_column } else { start };
            found.push(SemanticToken {
                delta_line,
                delta_start,
                length: end - start,
                token_type: token.kind,
                token_modifiers_bitset: 0,
            });
            (last_line, last_column) = (line, start);
        }
    }
    found
}
