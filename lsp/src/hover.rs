//! Hover: the code under the cursor, what is in effect, and what the machine does in the block.
use crate::{
    analysis::{Analysed, Source},
    names,
    position::{Encoding, offset, range},
    snapshot::Snapshot,
};
use std::fmt::Write;
use tower_lsp::lsp_types::{Hover, HoverContents, MarkupContent, MarkupKind, Position};
use trunnion_check::{BlockInfo, Session};
use trunnion_dialect::{Code, Dialect};
use trunnion_ide::toml_at;
use trunnion_interp::{FeedMode, ModalState};
use trunnion_machine::{AxisKind, Machine, Row};
use trunnion_syntax::{Address, Block, Item, TextRange, Value, Word};

/// The hover of a program, or of a settings or machine file.
pub(crate) fn at(snapshot: &Snapshot, position: Position) -> Option<Hover> {
    if let Some(file) = snapshot.parsed.toml {
        let (value, place) = toml_at(file, snapshot.parsed.characters(), snapshot.offset(position) as usize)?;
        return Some(Hover {
            contents: HoverContents::Markup(MarkupContent {
                kind: MarkupKind::Markdown,
                value,
            }),
            range: Some(snapshot.range(TextRange::new(place.start as u32, place.end as u32))),
        });
    }
    hover(snapshot.analysed.as_ref()?, position, snapshot.encoding)
}

/// The hover at a position; `None` where there is nothing to show. What one looks for stands first: what the machine does in the block, then
/// the findings, one line each, then the code and what is in effect.
fn hover(analysed: &Analysed, position: Position, encoding: Encoding) -> Option<Hover> {
    let (source, session) = analysed.judged()?;
    let parsed = &analysed.parsed;
    let at = offset(&parsed.text, &parsed.starts, position, encoding) as u32;
    let program = &source.program;
    let id = program.block_at(at)?;
    let block = program.block(id);
    if program.source()[block.range().as_usize()]
        .iter()
        .all(u8::is_ascii_whitespace)
    {
        return None;
    }
    let mut text = String::new();
    let mut shown = block.range();
    let info = session.describe(program, &source.resolved.settings(), id);
    if !info.runs {
        text.push_str("This block does not run: the program ends before it, or every path skips it.\n\n");
    }
    motion(&mut text, &info, source.resolved.machine.as_ref());
    findings(&mut text, session, at);
    if let Some((code, word)) = code_at(source, &block, at) {
        let _ = writeln!(text, "{}\n", code.hover());
        shown = word;
    }
    if let Some((said, word)) = names::at(program, &block, at, &info) {
        let _ = writeln!(text, "{said}\n");
        shown = word;
    }
    modal(&mut text, &info.after);
    Some(Hover {
        contents: HoverContents::Markup(MarkupContent {
            kind: MarkupKind::Markdown,
            value: text,
        }),
        range: Some(range(&parsed.text, &parsed.starts, shown, encoding)),
    })
}

/// The findings that touch the cursor, one line each, with the command that explains the rule.
fn findings(text: &mut String, session: &Session, at: u32) {
    let mut names: Vec<&str> = Vec::new();
    for found in session.report.findings().filter(|d| d.range.touches(at)) {
        if !names.contains(&found.rule) {
            names.push(found.rule);
            let _ = writeln!(
                text,
                "* **{}** {} (`trunnion explain {0}`)",
                found.rule,
                found.message.replace('\n', " ")
            );
        }
    }
    if !names.is_empty() {
        text.push('\n');
    }
}

/// The code the cursor is on.
fn code_at<'a>(source: &'a Source, block: &Block<'_>, at: u32) -> Option<(&'a Code, TextRange)> {
    let dialect = source.resolved.dialect;
    if let Some(record) = block.record() {
        let on = record.major.touches(at);
        return on
            .then(|| {
                dialect
                    .name(&source.program.text(record.major))
                    .map(|code| (code, record.major))
            })
            .flatten();
    }
    block.items().find_map(|item| match item {
        Item::Word(word) if word.range.touches(at) => code_of(dialect, &word).map(|code| (code, word.range)),
        Item::Call(call) if call.name.touches(at) => dialect
            .name(&source.program.text(call.name))
            .map(|code| (code, call.name)),
        _ => None,
    })
}

fn code_of<'a>(dialect: &'a Dialect, word: &Word) -> Option<&'a Code> {
    let Value::Number(number) = word.value else { return None };
    let tenths = number.to_f64() * 10.0;
    if tenths < 0.0 || tenths.fract() != 0.0 {
        return None;
    }
    match word.address {
        Address::Letter(b'G') => dialect.g(tenths as u32),
        Address::Letter(b'M') => dialect.m(tenths as u32),
        _ => None,
    }
}

fn modal(text: &mut String, state: &ModalState) {
    let feed = match (state.feed.value(), state.feed.mode()) {
        (None, _) => "not programmed".to_owned(),
        (Some(feed), FeedMode::PerMinute) => format!("{feed:.1} mm/min"),
        (Some(feed), FeedMode::PerRevolution) => format!("{feed:.4} mm/rev"),
        (Some(feed), FeedMode::InverseTime) => format!("{feed:.4} 1/min (inverse time)"),
    };
    let speed = match (state.spindle.on(), state.spindle.rpm()) {
        (Some(true), Some(rpm)) => format!("{rpm:.0} 1/min"),
        (Some(true), None) => "on".into(),
        (Some(false), _) => "off".into(),
        (None, _) => "unknown".into(),
    };
    let tool = state
        .tool
        .number()
        .map_or_else(|| "unknown".to_owned(), |tool| format!("T{tool}"));
    let mode = if state.tool_axis.tcp() {
        "on: the tip is programmed"
    } else {
        "off"
    };
    let sense = if state.coordinates.incremental() {
        "incremental"
    } else {
        "absolute"
    };
    let unit = if state.coordinates.unit_mm() == 1.0 {
        "mm"
    } else {
        "inch"
    };
    let _ = writeln!(
        text,
        "**Active:** feed {feed}, spindle {speed}, tool {tool}, {sense}, {unit}, TCP {mode}\n"
    );
}

fn motion(text: &mut String, info: &BlockInfo, machine: Option<&Machine>) {
    let Some(machine) = machine else {
        text.push_str(
            "No machine is named, so axis positions are unknown (set `trunnion.machine`, or `machine` in trunnion.toml).\n",
        );
        return;
    };
    for row in &info.rows {
        joints(text, row, machine);
        facts(text, row);
    }
}

fn joints(text: &mut String, row: &Row, machine: &Machine) {
    let _ = write!(text, "**{}** on {}\n\n| axis |", row.motion, machine.id);
    for axis in &machine.axes {
        let _ = write!(text, " {} |", char::from(axis.letter));
    }
    text.push_str("\n|---|");
    text.push_str(&"---:|".repeat(machine.axes.len()));
    text.push_str("\n| end |");
    for (axis, joint) in machine.axes.iter().zip(&row.joints) {
        let unit = if axis.kind == AxisKind::Linear { "mm" } else { "deg" };
        let cell = joint.map_or_else(|| "unknown".to_owned(), |value| format!("{value:.4} {unit}"));
        let _ = write!(text, " {cell} |");
    }
    text.push_str("\n\n");
}

fn facts(text: &mut String, row: &Row) {
    if let Some(branch) = row.branch {
        let posture = match branch {
            0 => "at the pole",
            1.. => "posture +",
            _ => "posture \u{2212}",
        };
        let pole = row
            .pole_angle_deg
            .map_or_else(String::new, |angle| format!(", {angle:.4} deg from the pole"));
        let _ = writeln!(text, "* {posture}{pole}");
    }
    if let Some(bound) = row.tip_deviation_mm {
        let _ = writeln!(
            text,
            "* the tip leaves the programmed line by at most {bound:.4} mm (proven)"
        );
    }
    if let Some(limit) = row.feed_limit_mm_min {
        let axis = row
            .limiting_axis
            .map_or_else(String::new, |axis| format!(", limited by {axis}"));
        let _ = writeln!(text, "* highest possible feed {limit:.0} mm/min{axis}");
    }
    if let Some(time) = row.duration_s {
        let _ = writeln!(text, "* {time:.4} s at the programmed feed");
    }
}
