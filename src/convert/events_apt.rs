//! What an APT record contains apart from motions.
use crate::Options;
use crate::comments::comment;
use crate::events::{BlockEvents, Cannot};
use crate::job::Event;
use trunnion_syntax::{AptArg, Block, Record};

/// The events of a record.
pub(crate) fn said(block: &Block<'_>, options: &Options) -> Result<BlockEvents, Cannot> {
    let mut said = BlockEvents::default();
    let program = block.program();
    for found in block.comments() {
        said.before.extend(comment(&program.text(found.inner)));
    }
    let Some(record) = block.record() else { return Ok(said) };
    let major = program.text(record.major).to_ascii_uppercase();
    match major.as_str() {
        "LOADTL" | "LOAD" | "TOOLNO" => said.tool_change = true,
        "PPRINT" | "REMARK" | "TITLES" => said.before.extend(comment(&text(&record))),
        "DISPLY" => said.before.push(Event::Message(text(&record))),
        "INSERT" if options.insert_is_remark => said.before.extend(comment(&text(&record))),
        "PARTNO" => said.name = Some(text(&record)).filter(|name| !name.is_empty()),
        "AUXFUN" => {
            let number = record.args().find_map(|arg| match arg {
                AptArg::Number(number, _) => number.to_integer(),
                _ => None,
            });
            if number.is_none_or(|number| u32::try_from(number).is_err()) {
                return Err((record.range, "AUXFUN takes the number of an M code".to_owned()));
            }
        }
        "DWELL" => {
            let message = "DWELL is not supported as a dwell: write DELAY/seconds";
            return Err((record.range, message.to_owned()));
        }
        _ => {}
    }
    Ok(said)
}

/// The text after the major word and its slash.
fn text(record: &Record<'_>) -> String {
    let range = trunnion_syntax::TextRange::new(record.major.end, record.range.end);
    let text = record.program.text(range);
    let text = text.trim_start();
    text.strip_prefix('/').unwrap_or(text).trim().to_owned()
}
