//! The data of the replay: points along the path with time, joints and line.
use crate::cli::load::Loaded;
use serde_json::json;
use trunnion_machine::{AxisKind, Machine};
use trunnion_plot::{Mark, Record, Unit};
use trunnion_syntax::LineIndex;

/// So many points are kept: what a browser turns smoothly.
const MOST: usize = 20_000;
/// A line of program is cut there, characters.
const LONGEST: usize = 120;

/// The data as JSON, without any `<`; `None` where no path is known.
pub(super) fn data(loaded: &Loaded, machine: &Machine, record: &Record, marks: &[Mark]) -> Option<String> {
    if record.samples.len() < 2 {
        return None;
    }
    let unit = record.unit;
    let every = record.samples.len().div_ceil(MOST).max(1);
    let (mut points, mut joints, mut lines, mut kinds) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for block in &record.blocks {
        let samples = record.of(block);
        let last = samples.len().saturating_sub(1);
        for (at, sample) in samples.iter().enumerate() {
            // ends of blocks stay, unless there are too many blocks
            let end = at == 0 || at == last;
            let kept = at.is_multiple_of(every) || end && record.blocks.len() * 2 < MOST;
            if !kept {
                continue;
            }
            let time = if sample.time.is_finite() { sample.time } else { -1.0 };
            points.extend(
                sample
                    .tip
                    .iter()
                    .map(|mm| unit.of_mm(*mm))
                    .chain(sample.axis.iter().copied())
                    .chain([time])
                    .map(|value| round(value, unit)),
            );
            joints.extend(machine.own_axes().map(|(index, axis)| {
                let value = sample.joints[index];
                match axis.kind {
                    AxisKind::Linear => round(unit.of_mm(value), unit),
                    AxisKind::Rotary => round(value, unit),
                }
            }));
            lines.push(block.line);
            // 0 feed, 1 rapid; 2 more: not joined to the point before
            let gap = at == 0 && !block.joined;
            kinds.push(u8::from(block.rapid) + if gap { 2 } else { 0 });
        }
    }
    let source = loaded.program.source();
    let index = LineIndex::new(source);
    let mut texts = serde_json::Map::new();
    for &line in &lines {
        texts
            .entry(line.to_string())
            .or_insert_with(|| json!(line_text(source, &index, line)));
    }
    let letters: Vec<String> = machine
        .own_axes()
        .map(|(_, axis)| char::from(axis.letter).to_string())
        .collect();
    let rotary: Vec<bool> = machine
        .own_axes()
        .map(|(_, axis)| axis.kind == AxisKind::Rotary)
        .collect();
    let marked: Vec<_> = marks.iter().map(|mark| json!([mark.line, mark.rule])).collect();
    let document = json!({
        "points": points, "joints": joints, "letters": letters, "lines": lines, "kinds": kinds, "texts": texts, "marks": marked,
        "unit": unit.name(), "digits": unit.digits(3), "rotary": rotary,
    });
    // nothing in the text of a program ends the script
    Some(
        document
            .to_string()
            .replace('<', "\\u003c")
            .replace('>', "\\u003e")
            .replace('&', "\\u0026"),
    )
}

fn round(value: f64, unit: Unit) -> f64 {
    let parts = match unit {
        Unit::Mm => 1e4,
        Unit::Inch => 1e6,
    };
    let rounded = (value * parts).round() / parts + 0.0;
    if rounded.is_finite() { rounded } else { 0.0 }
}

/// The text of a line, from 1.
pub(super) fn line_text(source: &[u8], index: &LineIndex, line: u32) -> String {
    let start = index
        .offset(source, line, 1)
        .map_or(source.len(), |start| start as usize);
    let rest = source.get(start..).unwrap_or_default();
    let end = rest
        .iter()
        .position(|byte| matches!(byte, b'\n' | b'\r'))
        .unwrap_or(rest.len());
    let text = String::from_utf8_lossy(&rest[..end]);
    let text = text.trim_end();
    let mut cut: String = text.chars().take(LONGEST).collect();
    if cut.len() < text.len() {
        cut.push('\u{2026}');
    }
    cut
}
