//! `parse`: tokens or tree, for people who build on the toolkit.
use super::{
    Done,
    args::{Global, ListFormat, Parse},
    failure::Failure,
    json::write_json,
    load::{self, Loaded},
};
use serde_json::{Value, json};
use std::io::{BufWriter, Write};
use trunnion_syntax::{AptArg, Block, Item, LineIndex, TextRange};

/// Runs `parse`. Problems of the text make the exit status 1.
pub(super) fn run(global: &Global, command: &Parse) -> Result<Done, Failure> {
    let loaded = load::load(global, &command.file)?;
    let mut out = BufWriter::new(std::io::stdout().lock());
    match (command.tokens, command.format) {
        (true, ListFormat::Text) => tokens_text(&mut out, &loaded)?,
        (true, ListFormat::Json) => write_json(&mut out, &tokens_json(&loaded))?,
        (false, ListFormat::Text) => tree_text(&mut out, &loaded)?,
        (false, ListFormat::Json) => write_json(&mut out, &tree_json(&loaded))?,
    }
    out.flush()?;
    Ok(if loaded.program.errors().is_empty() {
        Done::Clean
    } else {
        Done::Found
    })
}

fn tokens_text(out: &mut impl Write, loaded: &Loaded) -> Result<(), Failure> {
    let tokens = loaded.program.tokens();
    for id in 0..tokens.len() as u32 {
        let range = tokens.range(id);
        let kind = format!("{:?}", tokens.kind(id));
        writeln!(out, "{:>8} {kind:16} {:?}", range.start, loaded.program.text(range))?;
    }
    Ok(())
}

fn tokens_json(loaded: &Loaded) -> Value {
    let tokens = loaded.program.tokens();
    let list: Vec<_> = (0..tokens.len() as u32)
        .map(|id| {
            let range = tokens.range(id);
            json!({ "kind": format!("{:?}", tokens.kind(id)), "start": range.start, "end": range.end,
                    "text": loaded.program.text(range) })
        })
        .collect();
    json!({ "schema": "trunnion-tokens/1", "dialect": loaded.resolved.dialect.name, "tokens": list,
            "errors": errors_json(loaded) })
}

fn tree_text(out: &mut impl Write, loaded: &Loaded) -> Result<(), Failure> {
    let lines = LineIndex::new(loaded.program.source());
    for block in loaded.program.blocks() {
        let items = items_json(loaded, &block);
        if items.is_empty() {
            continue;
        }
        let (line, _) = lines.line_column(loaded.program.source(), block.range().start);
        writeln!(out, "block line {line}")?;
        for item in items {
            let kind = item["kind"].as_str().unwrap_or_default();
            writeln!(out, "  {kind:8} {}..{} {}", item["start"], item["end"], item["text"])?;
        }
    }
    for error in loaded.program.errors() {
        let (line, column) = lines.line_column(loaded.program.source(), error.range.start);
        writeln!(
            out,
            "problem {line}:{column} {:?} {:?}",
            error.kind,
            loaded.program.text(error.range)
        )?;
    }
    Ok(())
}

fn tree_json(loaded: &Loaded) -> Value {
    let lines = LineIndex::new(loaded.program.source());
    let blocks: Vec<_> = loaded
        .program
        .blocks()
        .map(|block| {
            let (line, _) = lines.line_column(loaded.program.source(), block.range().start);
            json!({ "line": line, "start": block.range().start, "end": block.range().end,
                    "items": items_json(loaded, &block) })
        })
        .collect();
    json!({ "schema": "trunnion-tree/1", "dialect": loaded.resolved.dialect.name, "blocks": blocks,
            "errors": errors_json(loaded) })
}

fn errors_json(loaded: &Loaded) -> Vec<Value> {
    let errors = loaded.program.errors().iter();
    errors
        .map(|e| json!({ "kind": format!("{:?}", e.kind), "start": e.range.start, "end": e.range.end }))
        .collect()
}

fn items_json(loaded: &Loaded, block: &Block<'_>) -> Vec<Value> {
    let node = |kind: &str, range: TextRange| json!({ "kind": kind, "start": range.start, "end": range.end, "text": loaded.program.text(range) });
    let mut nodes = Vec::new();
    if let Some(record) = block.record() {
        nodes.push(node("major", record.major));
        nodes.extend(record.args().map(|arg| match arg {
            AptArg::Number(_, range) => node("number", range),
            AptArg::Word(range) => node("word", range),
            AptArg::Other(range) => node("other", range),
        }));
    }
    nodes.extend(block.items().filter_map(|item| {
        let apt = block.record().is_some();
        Some(match item {
            Item::Comment(comment) => node("comment", comment.range),
            _ if apt => return None,
            Item::Word(word) => node("word", word.range),
            Item::Call(call) => node("call", call.range),
            Item::Skip(_, range) => node("skip", range),
            Item::Percent(range) => node("percent", range),
            Item::Label(range) => node("label", range),
            Item::Other(range) => node("other", range),
        })
    }));
    nodes
}
