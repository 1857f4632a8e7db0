//! The data of the replay: points along the path with time, joints and line.
use crate::cli::load::Loaded;
use serde_json::json;
use std::collections::BTreeSet;
use trunnion_machine::{AxisKind, Machine};
use trunnion_plot::{Mark, Record, Unit};
use trunnion_syntax::LineIndex;

/// So many points are kept: what a browser turns smoothly.
const MOST: usize = 20_000;
/// A line of program is cut there, characters.
const LONGEST: usize = 120;

/// What a replay shows.
pub(super) struct Data {
    /// Without any `<`.
    pub(super) json: String,
    /// Points that are there, and those of the run.
    points: [usize; 2],
}

impl Data {
    /// That points are left out, as a sentence.
    pub(super) fn thinned(&self) -> Option<String> {
        let [kept, all] = self.points;
        (kept < all).then(|| format!("{kept} of {all} points are shown: the lines between them are straight."))
    }
}

/// The data; `None` where no path is known.
pub(super) fn data(loaded: &Loaded, machine: &Machine, record: &Record, marks: &[Mark]) -> Option<Data> {
    if record.samples.len() < 2 {
        return None;
    }
    let unit = record.unit;
    let marked: BTreeSet<u32> = marks.iter().map(|mark| mark.line).collect();
    let kept = kept(record, &marked);
    let (mut points, mut joints, mut lines, mut kinds) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut gap = false;
    for block in &record.blocks {
        let samples = record.of(block);
        for (at, sample) in samples.iter().enumerate() {
            // 0 feed, 1 rapid; 2 more: not joined to the point before
            gap |= at == 0 && !block.joined;
            if !kept[block.samples.start + at] {
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
            kinds.push(u8::from(block.rapid) + if std::mem::take(&mut gap) { 2 } else { 0 });
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
    // of the lines that are there: no other is looked up
    let there: BTreeSet<u32> = lines.iter().copied().collect();
    let marks = marks.iter().filter(|mark| there.contains(&mark.line));
    let marks: Vec<_> = marks.map(|mark| json!([mark.line, mark.rule])).collect();
    let document = json!({
        "points": points, "joints": joints, "letters": letters, "lines": lines, "kinds": kinds, "texts": texts, "marks": marks,
        "radius": record.radius, "unit": unit.name(), "digits": unit.digits(3), "rotary": rotary,
    });
    // nothing in the text of a program ends the script
    let json = document
        .to_string()
        .replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026");
    let points = [lines.len(), record.samples.len()];
    Some(Data { json, points })
}

/// Which samples are kept: all, or every n-th with the ends of the blocks with findings and of runs of rapids and feeds, as far as there is room.
fn kept(record: &Record, marked: &BTreeSet<u32>) -> Vec<bool> {
    let all = record.samples.len();
    if all <= MOST {
        return vec![true; all];
    }
    let every = all.div_ceil(MOST / 2);
    let mut kept: Vec<bool> = (0..all).map(|at| at.is_multiple_of(every)).collect();
    let mut room = MOST - all.div_ceil(every);
    let mut keep = |at: usize| {
        if room > 0 && !kept[at] {
            kept[at] = true;
            room -= 1;
        }
    };
    keep(all - 1);
    let findings = record.blocks.iter().filter(|block| marked.contains(&block.line));
    findings.for_each(|block| keep(block.samples.end.saturating_sub(1)));
    for two in record.blocks.windows(2) {
        if two[0].rapid != two[1].rapid || !two[1].joined {
            keep(two[0].samples.end.saturating_sub(1));
            keep(two[1].samples.start);
        }
    }
    kept
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

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_plot::{Block, Sample};

    /// Cuts of two samples each, every tenth of them after a rapid.
    fn record(blocks: usize) -> Record {
        let mut record = Record::default();
        for at in 0..blocks {
            let first = record.samples.len();
            for _ in 0..2 {
                record.samples.push(Sample {
                    way: 0.0,
                    time: 0.0,
                    joints: Default::default(),
                    tip: trunnion_geometry::Vec3::zeros(),
                    axis: trunnion_geometry::Vec3::z(),
                });
            }
            record.blocks.push(Block {
                line: at as u32 + 1,
                rapid: at % 10 == 0,
                samples: first..first + 2,
                joined: true,
                deviation: None,
                feed: [None; 2],
                planned: None,
            });
        }
        record
    }

    #[test]
    fn a_long_run_has_no_more_points_than_a_browser_turns() {
        let count = |blocks: usize, marked: &[u32]| {
            let kept = kept(&record(blocks), &marked.iter().copied().collect());
            (kept.iter().filter(|kept| **kept).count(), kept)
        };
        assert_eq!(count(MOST / 2, &[]).0, MOST);
        for blocks in [MOST / 2 + 1, 100_000, 300_000] {
            let (points, kept) = count(blocks, &[777, 77_777]);
            assert!((MOST / 4..=MOST).contains(&points), "{blocks} blocks: {points} points");
            // the ends of what is found, and of the run
            let ends = [777, 77_777].into_iter().filter(|line| *line <= blocks).chain([blocks]);
            assert!(ends.into_iter().all(|line| kept[2 * line - 1]), "{blocks}");
        }
        // of a run that fits nearly, a rapid begins where it did
        assert!(count(MOST / 2 + 1, &[]).1[20]);
    }
}
