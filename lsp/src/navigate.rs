//! Definition, references, highlight and rename.
use crate::{folder::Other, snapshot::Snapshot};
use std::{collections::HashMap, sync::Arc};
use tower_lsp::{
    jsonrpc::{Error, Result},
    lsp_types::{
        DocumentHighlight, DocumentHighlightKind, Location, Position, PrepareRenameResponse, TextEdit, Url,
        WorkspaceEdit,
    },
};
use trunnion_ide::{Kind, Occurrence, RenameError, Role, Scope, rename};
use trunnion_syntax::{Block, TextRange};

/// The name at a position. A block number that nothing refers to is a name too.
fn at(snapshot: &Snapshot, position: Position) -> Option<Occurrence> {
    let source = snapshot.source()?;
    let offset = snapshot.offset(position);
    source.names().at(offset).cloned().or_else(|| {
        let block = source.program.block(source.program.block_at(offset)?);
        own_number(&block).filter(|one| one.range.touches(offset))
    })
}

fn own_number(block: &Block<'_>) -> Option<Occurrence> {
    let range = block.number()?;
    let digits = TextRange::new(range.start + 1, range.end);
    let text = block.program().text(digits).trim().to_owned();
    let whole = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    whole.then(|| Occurrence {
        range: digits,
        kind: Kind::Block,
        role: Role::Definition,
        name: text.trim_start_matches('0').into(),
        scope: Scope::Part(u32::MAX),
    })
}

/// Other files with the name, if it is known there.
fn users(snapshot: &Snapshot, of: &Occurrence) -> Vec<Arc<Other>> {
    if of.scope != Scope::Shared {
        return Vec::new();
    }
    let mut others = snapshot.others();
    others.retain(|other| {
        other
            .source()
            .is_some_and(|source| source.names().same(of).next().is_some())
    });
    others
}

/// Where the thing at a position is defined.
pub(crate) fn definition(snapshot: &Snapshot, position: Position) -> Option<Vec<Location>> {
    let of = at(snapshot, position)?;
    let names = snapshot.source()?.names();
    let mut found: Vec<Location> = names
        .definitions(&of)
        .iter()
        .map(|one| snapshot.location(one.range))
        .collect();
    let here = names.same(&of).any(|one| one.role == Role::Definition);
    if !here {
        let mut others = Vec::new();
        for other in users(snapshot, &of) {
            let Some(source) = other.source() else { continue };
            let defined = source.names().same(&of).filter(|one| one.role == Role::Definition);
            others.extend(defined.map(|one| snapshot.elsewhere(&other, one.range)));
        }
        if !others.is_empty() {
            found = others;
        }
    }
    if found.is_empty() && of.kind == Kind::Program {
        found.extend(
            called_file(snapshot, &of.name).map(|uri| Location::new(uri, tower_lsp::lsp_types::Range::default())),
        );
    }
    (!found.is_empty()).then_some(found)
}

/// The file of a program that is called by its name.
pub(crate) fn called_file(snapshot: &Snapshot, name: &str) -> Option<Url> {
    let stem = |uri: &Url| {
        let last = uri.path_segments()?.next_back()?.to_ascii_uppercase();
        let stem = last.rsplit_once('.').map_or(last.as_str(), |(stem, _)| stem);
        Some(stem.trim_start_matches(['O', '0']).to_owned())
    };
    let wanted = name.to_ascii_uppercase();
    let wanted = wanted.trim_start_matches(['O', '0']);
    snapshot
        .others()
        .iter()
        .find(|other| stem(&other.uri).as_deref() == Some(wanted))
        .map(|other| other.uri.clone())
}

/// The most places of one thing in an answer: as a message each takes 2 kB of memory.
const MOST_PLACES: usize = 50_000;

/// Refuses an answer of too many places.
fn not_too_many(count: usize, what: &str, name: &str) -> Result<()> {
    if count > MOST_PLACES {
        let text = format!("not {what}: more than {MOST_PLACES} places name `{name}`; search for it in the text");
        return Err(refused(text));
    }
    Ok(())
}

/// Every place of the thing at a position.
pub(crate) fn references(snapshot: &Snapshot, position: Position, declaration: bool) -> Result<Option<Vec<Location>>> {
    let (Some(of), Some(source)) = (at(snapshot, position), snapshot.source()) else {
        return Ok(None);
    };
    let wanted = |one: &&Occurrence| declaration || one.role != Role::Definition;
    let own = source.names().same(&of).filter(wanted);
    let own = own.map(|one| snapshot.location(one.range));
    let mut found: Vec<Location> = own.take(MOST_PLACES + 1).collect();
    for other in users(snapshot, &of) {
        if let Some(source) = other.source() {
            let theirs = source.names().same(&of).filter(wanted);
            let theirs = theirs.map(|one| snapshot.elsewhere(&other, one.range));
            found.extend(theirs.take(MOST_PLACES + 1));
        }
        not_too_many(found.len(), "listed", &of.name)?;
    }
    not_too_many(found.len(), "listed", &of.name)?;
    Ok(Some(found))
}

/// The places of the thing in this document, read or written.
pub(crate) fn highlights(snapshot: &Snapshot, position: Position) -> Option<Vec<DocumentHighlight>> {
    let of = at(snapshot, position)?;
    let one = |one: &Occurrence| DocumentHighlight {
        range: snapshot.range(one.range),
        kind: Some(if one.role == Role::Read {
            DocumentHighlightKind::READ
        } else {
            DocumentHighlightKind::WRITE
        }),
    };
    let mut found: Vec<DocumentHighlight> = snapshot
        .source()?
        .names()
        .same(&of)
        .map(one)
        .take(MOST_PLACES + 1)
        .collect();
    // so many are no help, and a part of them would look like all
    if found.len() > MOST_PLACES {
        found.clear();
    }
    Some(found)
}

/// What would be renamed.
pub(crate) fn prepare(snapshot: &Snapshot, position: Position) -> Option<PrepareRenameResponse> {
    let of = at(snapshot, position)?;
    Some(PrepareRenameResponse::RangeWithPlaceholder {
        range: snapshot.range(of.range),
        placeholder: String::from_utf8_lossy(snapshot.parsed.text.get(of.range.as_usize()).unwrap_or_default())
            .into_owned(),
    })
}

fn refused(why: impl Into<String>) -> Error {
    let mut error = Error::invalid_params(why.into());
    // LSP 3.17: RequestFailed
    error.code = tower_lsp::jsonrpc::ErrorCode::ServerError(-32803);
    error
}

/// The edits in all files, or why there are none.
pub(crate) fn renamed(snapshot: &Snapshot, position: Position, new: &str) -> Result<Option<WorkspaceEdit>> {
    let (Some(of), Some(source)) = (at(snapshot, position), snapshot.source()) else {
        return Ok(None);
    };
    let new = new.trim();
    let new = new.trim_matches(['#', '<', '>']);
    let failed = |error: RenameError| refused(format!("not renamed: {}", error.0));
    let mut changes: HashMap<Url, Vec<TextEdit>> = HashMap::new();
    if of.scope == Scope::Part(u32::MAX) {
        // nothing refers to this number: only it changes
        let one = trunnion_syntax::TextEdit {
            range: of.range,
            new_text: new.to_owned(),
        };
        trunnion_ide::check_new_name(&of, source.resolved.dialect, new).map_err(failed)?;
        changes.insert(snapshot.parsed.uri.clone(), snapshot.edits([one]));
        return Ok(Some(WorkspaceEdit::new(changes)));
    }
    let others = users(snapshot, &of);
    let named_file = of.kind == Kind::Program && called_file(snapshot, &of.name).is_some()
        || of.kind == Kind::Program && !others.is_empty() && own_file(&snapshot.parsed.uri, &of.name);
    if named_file {
        return Err(refused(format!(
            "not renamed: the file of `{}` is found by its name; rename the file instead",
            of.name
        )));
    }
    let resolved = &source.resolved;
    let edits = rename(
        &source.program,
        resolved.dialect,
        &resolved.setup,
        source.names(),
        &of,
        new,
    )
    .map_err(failed)?;
    let mut count = edits.len();
    not_too_many(count, "renamed", &of.name)?;
    changes.insert(snapshot.parsed.uri.clone(), snapshot.edits(edits));
    for other in others {
        let Some(theirs) = other.source() else { continue };
        let resolved = &theirs.resolved;
        let edits = rename(
            &theirs.program,
            resolved.dialect,
            &resolved.setup,
            theirs.names(),
            &of,
            new,
        )
        .map_err(failed)?;
        count += edits.len();
        not_too_many(count, "renamed", &of.name)?;
        let edits = edits
            .into_iter()
            .map(|edit| TextEdit::new(other.range(edit.range, snapshot.encoding), edit.new_text));
        changes.insert(other.uri.clone(), edits.collect());
    }
    Ok(Some(WorkspaceEdit::new(changes)))
}

/// Whether the file of a document has the name of the program.
fn own_file(uri: &Url, name: &str) -> bool {
    let last = uri
        .path_segments()
        .and_then(|mut all| all.next_back())
        .unwrap_or_default();
    let stem = last.rsplit_once('.').map_or(last, |(stem, _)| stem);
    stem.trim_start_matches(['O', 'o', '0']).eq_ignore_ascii_case(name)
}
