//! `parse`: tokens or tree, for people who build on the toolkit.
mod expression;
mod tree;

use super::{
    Done,
    args::{Global, ListFormat, Parse},
    failure::Failure,
    load::{self, Loaded},
    waiting,
};
use crate::cli::out::Out;
use serde_json::json;
use std::io::Write;

/// Runs `parse`. Problems of the text make the exit status 1.
pub(super) fn run(global: &Global, command: &Parse) -> Result<Done, Failure> {
    let loaded = load::load_any(global, &command.file)?;
    let mut out = Out::standard();
    waiting::beside_output(global, "parsing", &command.file, || {
        match (command.tokens, command.format) {
            (true, ListFormat::Text) => tokens_text(&mut out, &loaded),
            (true, ListFormat::Json) => tokens_json(&mut out, &loaded),
            (false, ListFormat::Text) => tree::text(&mut out, &loaded),
            (false, ListFormat::Json) => tree::json(&mut out, &loaded),
        }
    })?;
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

fn tokens_json(out: &mut impl Write, loaded: &Loaded) -> Result<(), Failure> {
    let tokens = loaded.program.tokens();
    let dialect = json!(loaded.resolved.dialect.name);
    write!(
        out,
        "{{\"schema\":\"trunnion-tokens/1\",\"dialect\":{dialect},\"tokens\":"
    )?;
    let token = |id| {
        let range = tokens.range(id);
        json!({ "kind": format!("{:?}", tokens.kind(id)), "start": range.start, "end": range.end,
                "text": loaded.program.text(range) })
    };
    tree::list_json(out, (0..tokens.len() as u32).map(token))?;
    write!(out, ",\"errors\":")?;
    tree::errors_json(out, loaded)?;
    writeln!(out, "}}")?;
    Ok(())
}
