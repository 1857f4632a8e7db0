//! Who calls a program, and what it calls.
use crate::{folder::Other, snapshot::Snapshot};
use std::sync::Arc;
use tower_lsp::lsp_types::{
    CallHierarchyIncomingCall, CallHierarchyItem, CallHierarchyOutgoingCall, Position, Range, SymbolKind, Url,
};
use trunnion_ide::{CallSite, Kind, Names, Occurrence, Role, calls_of};
use trunnion_syntax::TextRange;

/// One file with what is needed of it.
enum File<'s> {
    Own(&'s Snapshot),
    Other(Arc<Other>),
}

impl File<'_> {
    fn source(&self) -> Option<&crate::analysis::Source> {
        match self {
            Self::Own(snapshot) => snapshot.source(),
            Self::Other(other) => other.source(),
        }
    }
    fn uri(&self) -> &Url {
        match self {
            Self::Own(snapshot) => &snapshot.parsed.uri,
            Self::Other(other) => &other.uri,
        }
    }
    fn range(&self, snapshot: &Snapshot, bytes: TextRange) -> Range {
        match self {
            Self::Own(own) => own.range(bytes),
            Self::Other(other) => other.range(bytes, snapshot.encoding),
        }
    }
}

fn files(snapshot: &Snapshot) -> Vec<File<'_>> {
    let mut files = vec![File::Own(snapshot)];
    files.extend(snapshot.others().into_iter().map(File::Other));
    files
}

fn file_name(uri: &Url) -> String {
    uri.path_segments()
        .and_then(|mut all| all.next_back())
        .unwrap_or_default()
        .to_owned()
}

/// An entry: the program that is defined, or a whole file that has no name of its own.
fn item(snapshot: &Snapshot, file: &File<'_>, of: Option<&Occurrence>) -> CallHierarchyItem {
    let range = of.map_or(Range::default(), |one| file.range(snapshot, one.range));
    let name = of.map_or_else(|| file_name(file.uri()), |one| one.name.to_string());
    CallHierarchyItem {
        name: name.clone(),
        kind: SymbolKind::FUNCTION,
        tags: None,
        detail: Some(file_name(file.uri())),
        uri: file.uri().clone(),
        range,
        selection_range: range,
        data: Some(serde_json::json!({ "name": of.map(|one| one.name.to_string()) })),
    }
}

fn definition<'n>(names: &'n Names, name: &str) -> Option<&'n Occurrence> {
    names
        .all
        .iter()
        .find(|one| one.kind == Kind::Program && one.role == Role::Definition && &*one.name == name)
}

/// The program at a position.
pub(crate) fn prepare(snapshot: &Snapshot, position: Position) -> Option<Vec<CallHierarchyItem>> {
    let of = snapshot.source()?.names().at(snapshot.offset(position))?;
    if of.kind != Kind::Program {
        return None;
    }
    for file in files(snapshot) {
        if let Some(found) = file.source().and_then(|source| definition(source.names(), &of.name)) {
            return Some(vec![item(snapshot, &file, Some(found))]);
        }
    }
    Some(vec![item(snapshot, &File::Own(snapshot), Some(of))])
}

fn name_of(item: &CallHierarchyItem) -> Option<String> {
    item.data.as_ref()?.get("name")?.as_str().map(str::to_owned)
}

fn sites(file: &File<'_>) -> Vec<CallSite> {
    file.source()
        .map(|source| calls_of(&source.program, source.names()))
        .unwrap_or_default()
}

/// The calls of a program, by caller.
pub(crate) fn incoming(snapshot: &Snapshot, of: &CallHierarchyItem) -> Vec<CallHierarchyIncomingCall> {
    let Some(name) = name_of(of) else { return Vec::new() };
    let mut found: Vec<CallHierarchyIncomingCall> = Vec::new();
    for file in files(snapshot) {
        for site in sites(&file).into_iter().filter(|site| *site.call.name == *name) {
            let from = item(snapshot, &file, site.caller.as_ref());
            let range = file.range(snapshot, site.call.range);
            match found
                .iter_mut()
                .find(|known| known.from.uri == from.uri && known.from.range == from.range)
            {
                Some(known) => known.from_ranges.push(range),
                None => found.push(CallHierarchyIncomingCall {
                    from,
                    from_ranges: vec![range],
                }),
            }
        }
    }
    found
}

/// What a program calls.
pub(crate) fn outgoing(snapshot: &Snapshot, of: &CallHierarchyItem) -> Vec<CallHierarchyOutgoingCall> {
    let name = name_of(of);
    let files = files(snapshot);
    let mut found: Vec<CallHierarchyOutgoingCall> = Vec::new();
    let Some(own) = files.iter().find(|file| *file.uri() == of.uri) else {
        return found;
    };
    for site in sites(own) {
        if site.caller.as_ref().map(|caller| caller.name.to_string()) != name {
            continue;
        }
        let target = files.iter().find_map(|file| {
            let one = definition(file.source()?.names(), &site.call.name)?;
            Some(item(snapshot, file, Some(one)))
        });
        let to = target.unwrap_or_else(|| item(snapshot, own, Some(&site.call)));
        let range = own.range(snapshot, site.call.range);
        match found
            .iter_mut()
            .find(|known| known.to.uri == to.uri && known.to.name == to.name)
        {
            Some(known) => known.from_ranges.push(range),
            None => found.push(CallHierarchyOutgoingCall {
                to,
                from_ranges: vec![range],
            }),
        }
    }
    found
}
