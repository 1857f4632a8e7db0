//! Differences as JSON.
use super::show::{Lines, counts, farthest, first, letter, moved};
use crate::cli::{
    failure::Failure,
    json::{Listed, tidy, write_json},
    load::{Loaded, assumed_by},
};
use serde_json::{Value, json};
use std::io::Write;
use trunnion_diff::{Body, Change, Found, Point, Tolerance};
use trunnion_interp::AXIS_LETTERS;
use trunnion_same::Verdict;
use trunnion_syntax::BlockId;

/// Writes the form for programs.
pub(super) fn write(
    out: &mut impl Write,
    [before, after]: [&Loaded; 2],
    found: &Found,
    tolerance: Tolerance,
) -> Result<(), Failure> {
    let lines = Lines::new(before, after);
    let whole = Listed {
        document: document([before, after], &lines, found, tolerance),
        key: "changes",
        items: || changes(&lines, found),
    };
    write_json(out, &whole)
}

/// The list of changes, each made when it is asked for.
fn changes<'a>(lines: &'a Lines<'_>, found: &'a Found) -> impl Iterator<Item = Value> + 'a {
    let place = move |side: usize, block: BlockId| json!({ "line": lines.line(side, block), "block": lines.number(side, block) });
    let point = move |point: &Point| {
        let known = (0..AXIS_LETTERS.len()).filter(|axis| point.known & (1 << axis) != 0);
        let key = |axis: usize| {
            format!(
                "{}_{}",
                letter(axis).to_ascii_lowercase(),
                if (3..6).contains(&axis) { "deg" } else { "mm" }
            )
        };
        let values: serde_json::Map<_, _> = known.map(|axis| (key(axis), json!(tidy(point.values[axis])))).collect();
        json!({ "motion": point.way.name(), "end": values, "length_mm": point.length_mm.map(tidy) })
    };
    let changes = found.changes.iter().map(move |change| match change {
        Change::Moved(a, b) => json!({
            "kind": "moved", "before": place(0, a.0), "after": place(1, b.0), "from": point(&a.1), "to": point(&b.1),
            "distance_mm": a.1.distance_mm(&b.1).map(tidy), "angle_deg": a.1.angle_deg(&b.1).map(tidy), "text": moved(&a.1, &b.1),
        }),
        Change::Only(is_after, block, body) => {
            let side = usize::from(*is_after);
            let (kind, key) = if *is_after { ("added", "after") } else { ("removed", "before") };
            let mut value = json!({ "kind": kind });
            value[key] = place(side, *block);
            match &**body {
                Body::Motion(end, _) => value["motion"] = point(end),
                Body::Statement(text) => value["statement"] = json!(text),
            }
            value
        }
    });
    let techs = found.techs.iter().map(move |change| {
        let parts = change
            .parts
            .iter()
            .map(|(name, from, to)| json!({ "what": name, "before": from, "after": to }));
        json!({
            "kind": "state", "before": place(0, change.first.0), "after": place(1, change.first.1),
            "last_before": place(0, change.last.0), "last_after": place(1, change.last.1), "motions": change.count,
            "changes": parts.collect::<Vec<_>>(),
        })
    });
    changes.chain(techs)
}

/// Everything else.
fn document(
    [before, after]: [&Loaded; 2],
    lines: &Lines<'_>,
    found: &Found,
    tolerance: Tolerance,
) -> serde_json::Map<String, Value> {
    let [moved, removed, added, state] = counts(found);
    let stop = |side: usize| {
        let stop = found.stops[side].as_ref()?;
        Some(json!({ "line": lines.line(side, stop.block), "why": stop.why }))
    };
    let document = json!({
        "schema": "trunnion-diff/1", "version": env!("CARGO_PKG_VERSION"),
        "before": before.name, "after": after.name, "machine": before.resolved.machine.as_ref().map(|machine| &machine.id),
        "tolerance_mm": tolerance.mm, "tolerance_deg": tolerance.deg, "same": found.same(), "verdict": match found.verdict { Verdict::Same => "same", Verdict::Differs(_) => "different", Verdict::Unknown(_) => "unknown" },
        "assumptions": assumed_by(&[before, after]),
        "first_difference": (!found.same()).then(|| first(lines, found)),
        "not_followed_before": stop(0), "not_followed_after": stop(1),
        "summary": {
            "motions_before": found.motions[0], "motions_after": found.motions[1], "moved": moved, "removed": removed,
            "added": added, "motions_with_other_state": state, "not_compared": found.not_compared,
            "motions_of_unknown_end": found.unknown, "too_different": found.too_different, "one_by_one": found.one_by_one,
            "largest_distance_mm": farthest(lines, found).map(|(distance, _)| tidy(distance)),
        },
        "changes": null,
    });
    match document {
        Value::Object(document) => document,
        _ => serde_json::Map::new(),
    }
}
