//! The tree of a program: blocks, their items with addresses and values, expressions by their parts, and problems.
use super::expression::{Part, parts};
use crate::cli::{
    failure::{Failure, is_hidden},
    load::Loaded,
};
use serde::{Serialize, Serializer, ser::SerializeMap as _};
use serde_json::{Value, json};
use std::{borrow::Cow, io::Write};
use trunnion_syntax::{Address, AptArg, Block, Item, LineIndex, Program, TextRange, Value as Said, Word};

/// Deeper parts are indented no further.
const DEEPEST: u32 = 20;

/// One node below a block.
struct Node {
    kind: &'static str,
    range: TextRange,
    /// `address` and `value` of words, `name` of calls; what the node says in short.
    facts: Vec<(&'static str, Value)>,
    /// The range whose parts are shown below it.
    inside: Option<TextRange>,
}

impl Node {
    fn plain(kind: &'static str, range: TextRange) -> Self {
        Self {
            kind,
            range,
            facts: Vec::new(),
            inside: None,
        }
    }
}

/// The form for people: one line per node, bytes on the left.
pub(super) fn text(out: &mut impl Write, loaded: &Loaded) -> Result<(), Failure> {
    let program = &loaded.program;
    let lines = LineIndex::new(program.source());
    let mut errors = program.errors().iter().peekable();
    for block in program.blocks() {
        let mut nodes = nodes(loaded, &block).peekable();
        let range = block.range();
        if nodes.peek().is_some() {
            let (line, _) = lines.line_column(program.source(), range.start);
            row(out, range, 0, &format!("block line {line}"))?;
        }
        for node in nodes {
            row(out, node.range, 1, &describe(loaded, &node))?;
            for part in node
                .inside
                .map(|range| parts(program, &block, range))
                .unwrap_or_default()
            {
                let text = format!("{} {}", part.kind, program.text(part.range));
                row(out, part.range, 2 + part.depth.min(DEEPEST), &text)?;
            }
        }
        while let Some(error) = errors.next_if(|error| error.range.start < range.end.max(range.start + 1)) {
            let (line, column) = lines.line_column(program.source(), error.range.start);
            let text = format!(
                "problem {line}:{column} {:?} {:?}",
                error.kind,
                program.text(error.range)
            );
            row(out, error.range, 1, &text)?;
        }
    }
    for error in errors {
        row(out, error.range, 0, &format!("problem {:?}", error.kind))?;
    }
    Ok(())
}

fn row(out: &mut impl Write, range: TextRange, depth: u32, text: &str) -> Result<(), Failure> {
    let digits = |number: u32| number.checked_ilog10().unwrap_or(0) as usize + 1;
    let before = 13_usize.saturating_sub(digits(range.start) + digits(range.end));
    let indent = 2 * depth as usize;
    write!(out, "{:before$}{}..{}  {:indent$}", "", range.start, range.end, "")?;
    // one row is one line, whatever the text holds
    let breaks = |c: char| c == '\n' || c == '\t' || is_hidden(c);
    if text.contains(breaks) {
        for c in text.chars() {
            if breaks(c) {
                write!(out, "{}", c.escape_default())?;
            } else {
                write!(out, "{c}")?;
            }
        }
    } else {
        out.write_all(text.as_bytes())?;
    }
    out.write_all(b"\n")?;
    Ok(())
}

/// One line on a node.
fn describe(loaded: &Loaded, node: &Node) -> String {
    let facts: Vec<String> = node
        .facts
        .iter()
        .map(|(key, value)| {
            let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            if matches!(*key, "address" | "name" | "value") {
                text
            } else {
                format!("{key} {text}")
            }
        })
        .collect();
    if node.facts.is_empty() {
        format!("{} {}", node.kind, loaded.program.text(node.range))
    } else {
        format!("{} {}", node.kind, facts.join(" "))
    }
}

/// The form for programs, item by item: no more than one item is held as a document.
pub(super) fn json(out: &mut impl Write, loaded: &Loaded) -> Result<(), Failure> {
    let program = &loaded.program;
    let lines = LineIndex::new(program.source());
    let dialect = json!(loaded.resolved.dialect.name);
    write!(
        out,
        "{{\"schema\":\"trunnion-tree/2\",\"dialect\":{dialect},\"blocks\":["
    )?;
    for (number, block) in program.blocks().enumerate() {
        let (line, _) = lines.line_column(program.source(), block.range().start);
        let (start, end) = (block.range().start, block.range().end);
        let comma = if number == 0 { "\n" } else { ",\n" };
        write!(out, "{comma}{{\"end\":{end},\"items\":[")?;
        for (at, node) in nodes(loaded, &block).enumerate() {
            out.write_all(if at == 0 { b"" } else { b"," })?;
            node_json(out, loaded, &block, &node)?;
        }
        write!(out, "],\"line\":{line},\"start\":{start}}}")?;
    }
    write!(out, "\n],\"errors\":")?;
    errors_json(out, loaded)?;
    writeln!(out, "}}")?;
    Ok(())
}

/// Writes a node; its parts one after the other: each byte of a file may be one.
fn node_json(out: &mut impl Write, loaded: &Loaded, block: &Block<'_>, node: &Node) -> Result<(), Failure> {
    let program = &loaded.program;
    let own = [("kind", json!(node.kind)), ("text", json!(program.text(node.range)))];
    let places = [("start", json!(node.range.start)), ("end", json!(node.range.end))];
    let mut members: Vec<(&str, Value)> = own
        .into_iter()
        .chain(places)
        .chain(node.facts.iter().cloned())
        .collect();
    let inside = node.inside.map(|range| parts(program, block, range));
    if inside.is_some() {
        members.push((PARTS, Value::Null));
    }
    // as the members of every other document
    members.sort_by_key(|(key, _)| *key);
    let whole = NodeJson {
        members,
        parts: inside.unwrap_or_default(),
        program,
    };
    serde_json::to_writer(out, &whole).map_err(|error| Failure::from(std::io::Error::from(error)))
}

/// The key of the parts of a node.
const PARTS: &str = "parts";

/// A node with its members; the one of the parts is a place for them.
struct NodeJson<'p> {
    members: Vec<(&'static str, Value)>,
    parts: Vec<Part>,
    program: &'p Program,
}

impl Serialize for NodeJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.members.len()))?;
        for (key, value) in &self.members {
            if *key == PARTS {
                map.serialize_entry(key, &PartsJson(&self.parts, self.program))?;
            } else {
                map.serialize_entry(key, value)?;
            }
        }
        map.end()
    }
}

/// The parts, made as they are written.
struct PartsJson<'p>(&'p [Part], &'p Program);

impl Serialize for PartsJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|part| PartJson {
            depth: part.depth,
            end: part.range.end,
            kind: part.kind,
            start: part.range.start,
            text: self.1.text(part.range),
        }))
    }
}

/// A part of an expression, its members in the order of their names.
#[derive(Serialize)]
struct PartJson<'p> {
    depth: u32,
    end: u32,
    kind: &'static str,
    start: u32,
    text: Cow<'p, str>,
}

/// A problem of the text, its members in the order of their names.
#[derive(Serialize)]
struct ErrorJson {
    end: u32,
    kind: String,
    start: u32,
}

/// The problems of the text, one after the other: each byte of a file may be one.
pub(super) fn errors_json(out: &mut impl Write, loaded: &Loaded) -> Result<(), Failure> {
    let errors = loaded.program.errors().iter();
    list_json(
        out,
        errors.map(|error| ErrorJson {
            end: error.range.end,
            kind: format!("{:?}", error.kind),
            start: error.range.start,
        }),
    )
}

/// A list of documents, of which one is held at a time.
pub(super) fn list_json(out: &mut impl Write, list: impl Iterator<Item = impl Serialize>) -> Result<(), Failure> {
    out.write_all(b"[")?;
    for (at, value) in list.enumerate() {
        out.write_all(if at == 0 { b"" } else { b"," })?;
        serde_json::to_writer(&mut *out, &value).map_err(|error| Failure::from(std::io::Error::from(error)))?;
    }
    out.write_all(b"]")?;
    Ok(())
}

/// The contents of a block, one after the other: a line may be as long as a file.
fn nodes<'a>(loaded: &'a Loaded, block: &'a Block<'a>) -> impl Iterator<Item = Node> + 'a {
    let record = block.record();
    let apt = record.is_some();
    let record = record.into_iter().flat_map(|record| {
        let args = record.args().map(|arg| match arg {
            AptArg::Number(number, range) => Node {
                facts: vec![("value", json!(number.to_string()))],
                ..Node::plain("number", range)
            },
            AptArg::Word(range) => Node::plain("word", range),
            AptArg::Other(range) => Node {
                inside: Some(range),
                ..Node::plain("other", range)
            },
        });
        std::iter::once(Node::plain("major", record.major)).chain(args)
    });
    record.chain(block.items().filter_map(move |item| match item {
        Item::Comment(comment) => Some(Node::plain("comment", comment.range)),
        _ if apt => None,
        Item::Word(each) => Some(word(loaded, &each)),
        Item::Call(call) => Some(Node {
            facts: vec![("name", json!(loaded.program.text(call.name)))],
            inside: call.arguments,
            ..Node::plain("call", call.range)
        }),
        Item::Skip(level, range) => Some(Node {
            facts: vec![("level", json!(level))],
            ..Node::plain("skip", range)
        }),
        Item::Percent(range) => Some(Node::plain("percent", range)),
        Item::Label(range) => Some(Node::plain("label", range)),
        Item::Other(range) => Some(Node {
            inside: Some(range),
            ..Node::plain("other", range)
        }),
    }))
}

fn word(loaded: &Loaded, word: &Word) -> Node {
    let text = |range| loaded.program.text(range).into_owned();
    let address = match word.address {
        Address::Letter(letter) => char::from(letter).to_string(),
        Address::Indexed(letter, index) => format!("{}{index}", char::from(letter)),
        Address::Named(range) => text(range),
    };
    let (value, inside) = match word.value {
        Said::Number(number) => (json!(number.to_string()), None),
        Said::Call(name, number) => (json!(format!("{}({number})", text(name))), None),
        Said::Text(range) => (json!(text(range)), None),
        Said::Expression(range) => (json!("expression"), Some(range)),
        Said::Missing => (json!("missing"), None),
        Said::Bad => (json!(format!("bad {}", text(word.value_range))), None),
    };
    Node {
        facts: vec![("address", json!(address)), ("value", value)],
        inside,
        ..Node::plain("word", word.range)
    }
}
