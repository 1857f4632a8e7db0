//! Edits of a whole program: unit, positions, and a path that is shifted, scaled, mirrored or turned. Each is proved before it is offered; a refusal
//! is said with its reason.
use crate::{
    analysis::{Parsed, Source},
    position::{Encoding, range},
    snapshot::Snapshot,
};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use tower_lsp::{
    jsonrpc::{Error, ErrorCode, Result},
    lsp_types::{
        CodeAction, CodeActionContext, CodeActionDisabled, CodeActionKind, CodeActionTriggerKind, Range,
        TextDocumentIdentifier, TextEdit, WorkspaceEdit,
    },
};
use trunnion_convert::{Edit, Edited, Part, Positions, Refused, Shape, edit_part};
use trunnion_interp::LengthUnit;
use trunnion_syntax::{Program, TextRange};

/// `trunnion/edit`: the program and what is asked for.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct EditParams {
    pub(crate) text_document: TextDocumentIdentifier,
    edit: Asked,
    /// The lines that are edited; without it, all.
    range: Option<Range>,
}

/// An edit as clients name it. Lengths in the unit of the program, angles in degrees.
#[derive(Clone, Copy, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
enum Asked {
    Unit { unit: Unit },
    Positions { positions: How },
    Shift { by: [f64; 3] },
    Scale { factor: f64 },
    Mirror { axis: Axis },
    Rotate { axis: Axis, degrees: f64 },
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Unit {
    Mm,
    Inch,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum How {
    Absolute,
    Incremental,
}

#[derive(Clone, Copy, Deserialize)]
enum Axis {
    X,
    Y,
    Z,
}

impl Asked {
    fn edit(self) -> Edit {
        match self {
            Self::Unit { unit: Unit::Mm } => Edit::Unit(LengthUnit::Millimetre),
            Self::Unit { unit: Unit::Inch } => Edit::Unit(LengthUnit::Inch),
            Self::Positions {
                positions: How::Absolute,
            } => Edit::Positions(Positions::Absolute),
            Self::Positions {
                positions: How::Incremental,
            } => Edit::Positions(Positions::Incremental),
            Self::Shift { by } => Edit::Shape(Shape::Shift(by)),
            Self::Scale { factor } => Edit::Shape(Shape::Scale(factor)),
            Self::Mirror { axis } => Edit::Shape(Shape::Mirror(axis as usize)),
            Self::Rotate { axis, degrees } => Edit::Shape(Shape::Rotate(axis as usize, degrees)),
        }
    }
}

/// The answer: the edits, and what was proved and must be known.
#[derive(Debug, Serialize)]
pub(crate) struct EditAnswer {
    edits: Vec<TextEdit>,
    summary: String,
    notes: Vec<String>,
}

fn made(source: &Source, asked: Edit, part: Option<Part>) -> core::result::Result<Edited, Refused> {
    let resolved = &source.resolved;
    edit_part(&source.program, resolved.dialect, &resolved.setup, asked, None, part)
}

/// The blocks that bytes touch. A range that ends where a line begins ends with the line before, as editors select whole lines.
fn part_of(program: &Program, bytes: TextRange) -> Option<Part> {
    let last = if bytes.end > bytes.start {
        bytes.end - 1
    } else {
        bytes.end
    };
    Some(Part {
        first: program.block_at(bytes.start)?,
        last: program.block_at(last)?,
    })
}

pub(crate) const NO_PROGRAM: &str = "this is no program, or its settings cannot be used";

/// A refusal.
pub(crate) fn failed(why: String) -> Error {
    let mut error = Error::invalid_params(why);
    // LSP 3.17: RequestFailed
    error.code = ErrorCode::ServerError(-32803);
    error
}

/// Makes an edit; a refusal is an error with its reason.
pub(crate) fn answer(snapshot: &Snapshot, params: &EditParams) -> Result<EditAnswer> {
    let source = snapshot.source().ok_or_else(|| failed(NO_PROGRAM.to_owned()))?;
    let part = match params.range {
        None => None,
        Some(range) => Some(
            part_of(&source.program, snapshot.bytes(range))
                .ok_or_else(|| failed("there is no block in these lines".to_owned()))?,
        ),
    };
    let edited = made(source, params.edit.edit(), part).map_err(|refused| {
        let place = refused
            .place
            .map_or_else(String::new, |(line, _)| format!("line {line}: "));
        failed(format!("{place}{}", refused.message))
    })?;
    let summary = edited.summary();
    Ok(EditAnswer {
        edits: snapshot.edits(edited.edits),
        summary,
        notes: edited.notes,
    })
}

/// Whether the user asks for such edits: a program is run twice for each, which the mark in the margin must not do at every move of the
/// cursor.
pub(crate) fn wanted(context: &CodeActionContext) -> bool {
    match &context.only {
        Some(kinds) => kinds
            .iter()
            .any(|kind| [CodeActionKind::REFACTOR, CodeActionKind::REFACTOR_REWRITE].contains(kind)),
        None => context.trigger_kind == Some(CodeActionTriggerKind::INVOKED),
    }
}

/// The edits without numbers, each for the whole program, or for the blocks that are chosen where there are several; or why they are refused.
/// What there is nothing to do for is left out.
pub(crate) fn actions(parsed: &Parsed, encoding: Encoding, asked: TextRange) -> Vec<CodeAction> {
    let Ok(source) = &parsed.outcome else { return Vec::new() };
    let part = part_of(&source.program, asked).filter(|part| part.first < part.last);
    let [absolute, incremental] = [Positions::Absolute, Positions::Incremental].map(Edit::Positions);
    let mut all = vec![
        ("write in inch", Edit::Unit(LengthUnit::Inch), None),
        ("write in mm", Edit::Unit(LengthUnit::Millimetre), None),
        ("write absolute positions (G90)", absolute, None),
        ("write incremental positions (G91)", incremental, None),
    ];
    if part.is_some() {
        all.push(("write absolute positions (G90) in the chosen lines", absolute, part));
        all.push((
            "write incremental positions (G91) in the chosen lines",
            incremental,
            part,
        ));
    }
    let one = |(title, asked, part): (&str, Edit, Option<Part>)| {
        let base = CodeAction {
            title: title.to_owned(),
            kind: Some(CodeActionKind::REFACTOR_REWRITE),
            ..CodeAction::default()
        };
        match made(source, asked, part) {
            Ok(edited) => {
                let edits = edited.edits.into_iter().map(|edit| {
                    TextEdit::new(range(&parsed.text, &parsed.starts, edit.range, encoding), edit.new_text)
                });
                let changes = HashMap::from([(parsed.uri.clone(), edits.collect())]);
                Some(CodeAction {
                    title: format!("{title} (proved)"),
                    edit: Some(WorkspaceEdit::new(changes)),
                    ..base
                })
            }
            Err(refused) if refused.is_nothing => None,
            Err(refused) => {
                let place = refused
                    .place
                    .map_or_else(String::new, |(line, _)| format!("line {line}: "));
                let reason = format!("{place}{}", refused.message);
                Some(CodeAction {
                    title: format!("{title}: not offered: {reason}"),
                    disabled: Some(CodeActionDisabled { reason }),
                    ..base
                })
            }
        }
    };
    all.into_iter().filter_map(one).collect()
}
