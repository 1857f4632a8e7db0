//! Symbols, folding, selection, links to called files, code lens.
use crate::{analysis::Source, folder::Folder, navigate::called_file, position::Encoding, snapshot::Snapshot};
use serde_json::json;
use tower_lsp::lsp_types::{
    CodeLens, Command, DocumentLink, DocumentSymbol, FoldingRange, FoldingRangeKind, Location, Position,
    SelectionRange, SymbolInformation, SymbolKind,
};
use trunnion_ide::{Kind, Node, NodeKind, Role, Selections, calls_of, folds, operation_times};

fn kind(node: NodeKind) -> SymbolKind {
    match node {
        NodeKind::Program => SymbolKind::FUNCTION,
        NodeKind::Operation => SymbolKind::EVENT,
        NodeKind::Label => SymbolKind::KEY,
    }
}

/// The outline of a document.
pub(crate) fn document_symbols(snapshot: &Snapshot) -> Vec<DocumentSymbol> {
    let list = snapshot.source().map(Source::outline).unwrap_or_default();
    list.iter().map(|node| symbol(snapshot, node)).collect()
}

#[expect(
    deprecated,
    reason = "the type has a field that nobody uses any more and that must be given"
)]
fn symbol(snapshot: &Snapshot, node: &Node) -> DocumentSymbol {
    DocumentSymbol {
        name: node.name.clone(),
        detail: Some(node.detail.clone()).filter(|detail| !detail.is_empty()),
        kind: kind(node.kind),
        tags: None,
        deprecated: None,
        range: snapshot.range(node.range),
        selection_range: snapshot.range(node.selection),
        children: Some(node.children.iter().map(|child| symbol(snapshot, child)).collect()),
    }
}

/// Programs, operations and labels of the workspace whose names contain the letters of the query in their order.
pub(crate) fn workspace_symbols(folder: &Folder, query: &str, encoding: Encoding) -> Vec<SymbolInformation> {
    const MOST: usize = 1000;
    let mut found = Vec::new();
    for other in folder.all() {
        let Some(source) = other.source() else { continue };
        let mut open: Vec<(&Node, Option<&str>)> = source.outline().iter().rev().map(|node| (node, None)).collect();
        while let Some((node, around)) = open.pop() {
            let text = if node.detail.is_empty() {
                node.name.clone()
            } else {
                format!("{} {}", node.name, node.detail)
            };
            if fits(&text, query) && found.len() < MOST {
                #[expect(
                    deprecated,
                    reason = "the type has a field that nobody uses any more and that must be given"
                )]
                found.push(SymbolInformation {
                    name: text,
                    kind: kind(node.kind),
                    tags: None,
                    deprecated: None,
                    location: Location::new(other.uri.clone(), other.range(node.selection, encoding)),
                    container_name: around.map(str::to_owned),
                });
            }
            open.extend(
                node.children
                    .iter()
                    .rev()
                    .map(|child| (child, Some(node.name.as_str()))),
            );
        }
    }
    found
}

fn fits(text: &str, query: &str) -> bool {
    let mut letters = text.chars().flat_map(char::to_lowercase);
    query
        .chars()
        .flat_map(char::to_lowercase)
        .all(|wanted| letters.any(|letter| letter == wanted))
}

/// So many regions are folded where the client states no limit: editors keep a few thousand.
pub(crate) const MOST_FOLDS: usize = 20_000;

/// What can be folded: the longest `most` regions.
pub(crate) fn folding(snapshot: &Snapshot, most: usize) -> Vec<FoldingRange> {
    let Some(source) = snapshot.source() else {
        return Vec::new();
    };
    let one = |fold: trunnion_ide::Fold| {
        let range = snapshot.range(fold.range);
        (range.end.line > range.start.line).then(|| FoldingRange {
            start_line: range.start.line,
            end_line: range.end.line,
            kind: fold.comment.then_some(FoldingRangeKind::Comment),
            ..FoldingRange::default()
        })
    };
    let found = folds(&source.program, source.resolved.dialect, source.names());
    longest(found, most).into_iter().filter_map(one).collect()
}

/// The longest regions, in the order of the text.
fn longest(mut found: Vec<trunnion_ide::Fold>, most: usize) -> Vec<trunnion_ide::Fold> {
    if found.len() > most {
        found.sort_by_key(|fold| core::cmp::Reverse(fold.range.end - fold.range.start));
        found.truncate(most);
        found.sort_unstable();
    }
    found
}

/// What "expand selection" takes at each position.
pub(crate) fn selection(snapshot: &Snapshot, positions: &[Position]) -> Vec<SelectionRange> {
    let source = snapshot.source();
    let mut selections = source.map(|source| Selections::new(&source.program, source.names(), source.outline()));
    let at = |position: &Position| {
        let here = tower_lsp::lsp_types::Range::new(*position, *position);
        let ranges = selections
            .as_mut()
            .map(|selections| selections.at(snapshot.offset(*position)));
        let outer = ranges
            .unwrap_or_default()
            .into_iter()
            .rev()
            .fold(None, |parent, range| {
                Some(Box::new(SelectionRange {
                    range: snapshot.range(range),
                    parent,
                }))
            });
        outer.map_or(
            SelectionRange {
                range: here,
                parent: None,
            },
            |outer| *outer,
        )
    };
    positions.iter().map(at).collect()
}

/// Calls of programs that are files of their own.
pub(crate) fn links(snapshot: &Snapshot) -> Vec<DocumentLink> {
    let Some(source) = snapshot.source() else {
        return Vec::new();
    };
    let names = source.names();
    let defined = |name: &str| {
        names
            .all
            .iter()
            .any(|one| one.kind == Kind::Program && one.role == Role::Definition && &*one.name == name)
    };
    let mut found = Vec::new();
    for site in calls_of(&source.program, names) {
        if defined(&site.call.name) {
            continue;
        }
        if let Some(target) = called_file(snapshot, &site.call.name) {
            found.push(DocumentLink {
                range: snapshot.range(site.call.range),
                target: Some(target),
                tooltip: Some(format!("open the program {}", site.call.name)),
                data: None,
            });
        }
    }
    found
}

/// The time of each operation, above it.
pub(crate) fn lenses(snapshot: &Snapshot) -> Vec<CodeLens> {
    let Some(source) = snapshot.source().filter(|_| snapshot.shown.lens) else {
        return Vec::new();
    };
    let mut operations = Vec::new();
    collect(source.outline(), &mut operations);
    let starts: Vec<_> = operations
        .iter()
        .filter_map(|node| source.program.block_at(node.range.start))
        .collect();
    let times = operation_times(&source.program, &source.resolved.settings(), &starts);
    let lens = |node: &Node, title: String, command: &str| {
        let range = snapshot.range(node.selection);
        let arguments = vec![json!(snapshot.parsed.uri), json!(range.start.line)];
        CodeLens {
            range,
            command: Some(Command::new(title, command.to_owned(), Some(arguments))),
            data: None,
        }
    };
    let mut lenses = Vec::new();
    for (node, time) in operations.into_iter().zip(times) {
        let time = duration(time, source.resolved.machine.is_some());
        lenses.push(lens(node, format!("{}: {time}", node.name), "trunnion.showOperation"));
        if snapshot.shown.commands {
            lenses.push(lens(node, "show in backplot".to_owned(), "trunnion.showInBackplot"));
        }
    }
    lenses
}

fn collect<'n>(nodes: &'n [Node], found: &mut Vec<&'n Node>) {
    for node in nodes {
        if node.kind == NodeKind::Operation {
            found.push(node);
        }
        collect(&node.children, found);
    }
}

fn duration(seconds: Option<f64>, machine: bool) -> String {
    match seconds {
        Some(seconds) if seconds >= 60.0 => {
            format!("{:.0} min {:.0} s", (seconds / 60.0).floor(), (seconds % 60.0).floor())
        }
        Some(seconds) => format!("{seconds:.1} s"),
        None if machine => "time not known".to_owned(),
        None => "time not known without a machine".to_owned(),
    }
}
