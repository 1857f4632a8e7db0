//! What `convert` prints of a conversion, in words and as a JSON document.
use crate::cli::load::Loaded;
use crate::cli::verdict::counted;
use serde_json::json;
use trunnion_convert::Converted;
use trunnion_machine::Machine;

/// The work offset that stands for a zero point of the original.
fn renamed(name: &str, converted: &Converted) -> Option<String> {
    let (was, now) = converted.renamed_offset.as_ref()?;
    Some(format!(
        "{name}: {now} takes the place of {was} in the original: set the same zero point there"
    ))
}

/// Feeds that do not follow the spindle any more.
fn per_minute(name: &str, converted: &Converted) -> Option<String> {
    let lines = &converted.feeds_per_minute;
    let places: Vec<String> = lines.iter().take(20).map(u32::to_string).collect();
    (!lines.is_empty()).then(|| {
        format!(
            "{name}: the feed per revolution of {} is written per minute, for the programmed speed: it does not follow the spindle override; lines {}",
            counted(lines.len() as u64, "line"),
            places.join(", ")
        )
    })
}

/// Cutter radius compensation that the control does not do any more.
fn radius(name: &str, converted: &Converted) -> Option<String> {
    let line = converted.radius_in_path?;
    Some(format!(
        "{name}: the program that was written has no radius compensation (line {line}: G41 or G42): the declared radius is in its path, and a radius or \
         wear that is entered at the control has no effect"
    ))
}

/// Tools whose length the output does not compensate.
fn by_hand(name: &str, converted: &Converted) -> Option<String> {
    let tools: Vec<String> = converted.set_by_hand.iter().map(|tool| format!("T{tool}")).collect();
    (!tools.is_empty()).then(|| {
        format!(
            "{name}: {} compensates no tool length: set the zero of Z with the tip of each tool after its change ({})",
            converted.dialect.name,
            tools.join(", ")
        )
    })
}

/// What was proved, in words.
pub(crate) fn summary(name: &str, converted: &Converted) -> Vec<String> {
    let (proof, claim) = (&converted.proof, &converted.claim);
    let mut lines = vec![format!(
        "{name}: converted to {} and proved by running both programs: {} became {}; at their ends the tip is within {:.6} mm and the tool axis \
         within {:.6} deg of the original (allowed {:.6} mm, {:.6} deg)",
        converted.dialect.name,
        counted(proof.motions_before, "motion"),
        proof.motions_after,
        proof.end_mm,
        proof.end_deg,
        claim.end_mm,
        claim.end_deg
    )];
    lines.push(format!(
        "{name}: at every moment of a cut the tip is proved within {:.6} mm (allowed {:.6} mm) and the tool axis within {:.4} deg{}; feeds \
         within {:.6} mm/min, times within {:.4} %",
        proof.path_mm,
        claim.path_mm,
        proof.path_deg,
        claim.path_deg.map_or(String::new(), |limit| format!(" (allowed {limit} deg)")),
        proof.feed_mm_min,
        proof.time_share * 100.0
    ));
    if proof.rapid_mm > 1e-3 {
        lines.push(format!(
            "{name}: rapids are compared at their ends; between them the tip may be {:.3} mm away from the original path",
            proof.rapid_mm
        ));
    }
    if proof.feeds_not_compared > 0 {
        lines.push(format!(
            "{name}: in {} the tip does not move, so its feed could not be compared",
            counted(proof.feeds_not_compared, "cut")
        ));
    }
    if proof.left_out > 0 {
        lines.push(format!(
            "{name}: left out: {} with an unknown end (before the first known position of a tool, or after its last)",
            counted(proof.left_out, "rapid")
        ));
    }
    lines.extend(renamed(name, converted));
    lines.extend(by_hand(name, converted));
    lines.extend(per_minute(name, converted));
    lines.extend(radius(name, converted));
    if !converted.swaps.is_empty() {
        let places: Vec<String> = converted.swaps.iter().take(20).map(u32::to_string).collect();
        lines.push(format!(
            "{name}: changes to the other posture, or winds back, in {}: lines {}",
            counted(converted.swaps.len() as u64, "cut"),
            places.join(", ")
        ));
    }
    for beyond in &converted.beyond {
        lines.push(format!(
            "{name}:{}: {beyond}; this assumes that the part zero is at machine zero: declare yours in [work_offsets]",
            beyond.line
        ));
    }
    if !converted.travel_undecided.is_empty() {
        let places: Vec<String> = converted.travel_undecided.iter().take(20).map(u32::to_string).collect();
        lines.push(format!(
            "{name}: inside {} it is not known whether the axes stay within their travel: lines {}",
            counted(converted.travel_undecided.len() as u64, "motion"),
            places.join(", ")
        ));
    }
    for axis in &converted.clamps {
        lines.push(format!(
            "{name}: {axis} has a clamp, but the output contains no codes for it: add them, or declare them in the machine file (clamp_codes)"
        ));
    }
    for (what, line) in &converted.left_out {
        lines.push(format!("{name}:{line}: {what} has no counterpart and is left out"));
    }
    lines
}

pub(super) fn document(loaded: &Loaded, machine: Option<&Machine>, converted: &Converted) -> String {
    let (proof, claim) = (&converted.proof, &converted.claim);
    let left_out: Vec<_> = converted
        .left_out
        .iter()
        .map(|(what, line)| json!({ "what": what, "line": line }))
        .collect();
    let beyond: Vec<_> = converted
        .beyond
        .iter()
        .map(|one| {
            json!({
                "line": one.line, "axis": one.axis, "unit": one.unit, "value": one.value, "limit": one.limit,
                "inside": one.inside,
            })
        })
        .collect();
    let document = json!({
        "schema": "trunnion-convert/1",
        "version": env!("CARGO_PKG_VERSION"),
        "path": loaded.name,
        "from": loaded.resolved.dialect.name,
        "to": converted.dialect.name,
        "machine": machine.map(|machine| machine.id.clone()),
        "assumptions": loaded.assumptions(),
        "program": converted.text,
        "proof": {
            "motions_before": proof.motions_before,
            "motions_after": proof.motions_after,
            "left_out": proof.left_out,
            "end_mm": proof.end_mm, "end_limit_mm": claim.end_mm,
            "end_deg": proof.end_deg, "end_limit_deg": claim.end_deg,
            "path_mm": proof.path_mm, "path_limit_mm": claim.path_mm,
            "path_deg": proof.path_deg, "path_limit_deg": claim.path_deg,
            "rapid_mm": proof.rapid_mm,
            "feed_mm_min": proof.feed_mm_min, "feed_limit_mm_min": claim.feed_mm_min,
            "time_share": proof.time_share, "time_limit_share": claim.time_share,
            "feeds_not_compared": proof.feeds_not_compared,
        },
        "left_out": left_out,
        "renamed_offset": converted.renamed_offset.as_ref().map(|(was, now)| json!({ "was": was, "now": now })),
        "feeds_per_minute_lines": converted.feeds_per_minute,
        "radius_in_path_line": converted.radius_in_path,
        "set_z_zero_for_tools": converted.set_by_hand,
        "swap_lines": converted.swaps,
        "beyond_travel": beyond,
        "travel_undecided_lines": converted.travel_undecided,
        "clamps": converted.clamps,
    });
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}
