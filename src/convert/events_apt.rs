//! What an APT record says beside motions.
use crate::Options;
use crate::events::{Cannot, Said, comment};
use crate::job::{Coolant, Event};
use trunnion_syntax::{AptArg, Block, Record};

/// Records that are carried over otherwise: by motions and the modal state, or by the header.
const KNOWN: &[&str] = &[
    "GOTO", "GODLTA", "FROM", "RAPID", "CIRCLE", "DELAY", "FEDRAT", "UNITS", "UNIT", "MULTAX", "TLAXIS", "CUTTER",
    "CUTCOM", "CSYS", "END", "FINI", "CYCLE",
];

/// What a record says.
pub(crate) fn said(block: &Block<'_>, options: &Options) -> Result<Said, Cannot> {
    let mut said = Said::default();
    let program = block.program();
    for found in block.comments() {
        said.before.extend(comment(&program.text(found.inner)));
    }
    let Some(record) = block.record() else { return Ok(said) };
    let major = program.text(record.major).to_ascii_uppercase();
    match major.as_str() {
        major if KNOWN.contains(&major) => {}
        "LOADTL" | "LOAD" | "TOOLNO" => said.tool_change = true,
        "SPINDL" => {
            if has(&record, "CCLW") {
                said.counter_clockwise = Some(true);
            } else if has(&record, "CLW") {
                said.counter_clockwise = Some(false);
            }
        }
        "COOLNT" => {
            let coolant = [
                ("OFF", Coolant::Off),
                ("MIST", Coolant::Mist),
                ("THRU", Coolant::Thru),
                ("AIR", Coolant::Air),
            ];
            let kind = coolant.iter().find(|(word, _)| has(&record, word));
            let event = Event::Coolant(kind.map_or(Coolant::Flood, |(_, kind)| *kind));
            said.before.push(event);
        }
        "STOP" => said.after.push(Event::Stop(false)),
        "OPSTOP" => said.after.push(Event::Stop(true)),
        "PPRINT" | "REMARK" | "TITLES" => said.before.extend(comment(&text(&record))),
        "DISPLY" => said.before.push(Event::Message(text(&record))),
        "INSERT" if options.insert_is_remark => said.before.extend(comment(&text(&record))),
        "PARTNO" => said.name = Some(text(&record)).filter(|name| !name.is_empty()),
        "AUXFUN" => {
            let number = record.args().find_map(|arg| match arg {
                AptArg::Number(number, _) => number.to_integer(),
                _ => None,
            });
            match number.and_then(|number| u32::try_from(number).ok()) {
                Some(number) => said.before.push(Event::Auxiliary(number)),
                None => return Err((record.range, "AUXFUN takes the number of an M code".to_owned())),
            }
        }
        "DWELL" => {
            let message = "DWELL is not read as a dwell: write DELAY/seconds";
            return Err((record.range, message.to_owned()));
        }
        other => said.left_out.push(other.to_owned()),
    }
    Ok(said)
}

fn has(record: &Record<'_>, word: &str) -> bool {
    record.args().any(|arg| match arg {
        AptArg::Word(range) => record.program.text(range).eq_ignore_ascii_case(word),
        _ => false,
    })
}

/// The text behind the major word and its slash.
fn text(record: &Record<'_>) -> String {
    let range = trunnion_syntax::TextRange::new(record.major.end, record.range.end);
    let text = record.program.text(range);
    let text = text.trim_start();
    text.strip_prefix('/').unwrap_or(text).trim().to_owned()
}
