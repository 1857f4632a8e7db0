//! What `fix` did and what is gained: for people, and as JSON (`trunnion-fix/1`).
use super::retarget::Retargeted;
use crate::cli::{
    failure::{Failure, remark},
    load::Loaded,
    out::Out,
};
use serde_json::{Map, Value, json};
use std::io::Write;
use trunnion_rewrite::{Attempt, Gain, Gains, State, gains};
use trunnion_syntax::{TextEdit, TextRange, parse};

/// One rewrite and what became of it.
pub(super) struct Step {
    pub(super) rewrite: &'static str,
    pub(super) attempt: Attempt,
    /// What is gained at each place; empty if nothing is changed or nobody asks.
    pub(super) gains: Vec<Gains>,
    /// What `retarget` wrote.
    pub(super) retargeted: Option<Retargeted>,
}

impl Step {
    /// Whether the program is changed.
    fn applied(&self) -> bool {
        self.attempt.proved.is_some() || self.retargeted.is_some()
    }

    fn state(&self) -> &'static str {
        match (self.applied(), self.attempt.places.is_empty()) {
            (true, _) => "applied",
            (false, true) => "nothing-to-do",
            (false, false) => "refused",
        }
    }

    fn summary(&self) -> Option<&str> {
        let retargeted = self.retargeted.as_ref().and_then(|one| one.summary.first());
        let proved = self.attempt.proved.as_ref().map(|proved| &proved.summary);
        proved.or(retargeted).map(String::as_str)
    }
}

/// The result of all rewrites together.
pub(super) struct Outcome {
    pub(super) after: Vec<u8>,
    pub(super) steps: Vec<Step>,
}

impl Outcome {
    /// A rewrite changes nothing, although there would be something to do.
    pub(super) fn refused(&self) -> bool {
        self.steps.iter().any(|step| step.state() == "refused")
    }

    /// What all rewrites together gain.
    fn gains(&self, loaded: &Loaded) -> Option<Gains> {
        let machine = loaded.resolved.machine.as_ref()?;
        let before = loaded.program.source();
        // figures of two machines are not compared
        if self.after == before || self.steps.iter().any(|step| step.retargeted.is_some()) {
            return None;
        }
        let after = parse(self.after.clone(), loaded.resolved.dialect.lex);
        let all = TextEdit {
            range: TextRange::new(0, before.len() as u32),
            new_text: String::new(),
        };
        let settings = loaded.resolved.settings();
        Some(gains([&loaded.program, &after], &[all], &settings, machine, &[]).0)
    }
}

/// One line on what is gained, where anything is.
pub(super) fn print_gains(quiet: bool, loaded: &Loaded, outcome: &Outcome) {
    let Some(gains) = outcome.gains(loaded) else { return };
    let changed = gains.figures.iter().filter_map(|(name, gain)| {
        let (before, after) = gain.before.zip(gain.after)?;
        let changed = (before - after).abs() > 1e-6 * before.abs().max(after.abs());
        let (what, unit) = in_words(name);
        changed.then(|| format!("{what} {} -> {}{unit}", short(before), short(after)))
    });
    let changed: Vec<String> = changed.collect();
    if !changed.is_empty() {
        remark(quiet, &format!("{}: {}", loaded.name, changed.join(", ")));
    }
}

/// At most three decimals; small numbers with three digits.
fn short(value: f64) -> String {
    let text = if value.abs() >= 0.1 || value == 0.0 {
        format!("{value:.3}")
    } else {
        format!("{value:.6}")
    };
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// A figure's name for people, and its unit.
fn in_words(name: &str) -> (&str, &str) {
    match name {
        "deviation_mm" => ("largest deviation", " mm"),
        "rotary_travel_deg" => ("rotary travel", " deg"),
        "largest_step_deg" => ("largest rotary step", " deg"),
        "largest_slope_deg_mm" => ("largest slope", " deg/mm"),
        "feed_limit_mm_min" => ("lowest feed limit", " mm/min"),
        "time_s" => ("time", " s"),
        "length_mm" => ("path length", " mm"),
        other => (other, ""),
    }
}

/// Prints the document.
pub(super) fn print_json(loaded: &Loaded, outcome: &Outcome) -> Result<(), Failure> {
    let mut places = Vec::new();
    for step in &outcome.steps {
        for (index, place) in step.attempt.places.iter().enumerate() {
            let (state, reason) = match &place.state {
                State::Proved => ("applied", None),
                State::Possible(reason) => ("possible", Some(reason)),
                State::Refused(reason) => ("refused", Some(reason)),
            };
            let gains = (place.state == State::Proved).then(|| step.gains.get(index)).flatten();
            places.push(json!({
                "rewrite": step.rewrite,
                "line": place.lines.0,
                "last_line": place.lines.1,
                "state": state,
                "reason": reason,
                "gains": gains.map(object),
            }));
        }
    }
    let rewrites: Vec<Value> = outcome
        .steps
        .iter()
        .map(|step| json!({ "rewrite": step.rewrite, "state": step.state(), "summary": step.summary() }))
        .collect();
    let document = json!({
        "schema": "trunnion-fix/1",
        "version": env!("CARGO_PKG_VERSION"),
        "path": loaded.name,
        "dialect": loaded.dialect_name(),
        "machine": loaded.resolved.machine.as_ref().map(|machine| &machine.id),
        "changed": outcome.after != loaded.program.source(),
        "rewrites": rewrites,
        "places": places,
        "gains": outcome.gains(loaded).as_ref().map(object),
    });
    let mut out = Out::standard();
    serde_json::to_writer_pretty(&mut out, &document).map_err(|error| Failure::new(error.to_string()))?;
    writeln!(out)?;
    Ok(())
}

fn object(gains: &Gains) -> Value {
    let pair = |gain: &Gain| json!({ "before": gain.before, "after": gain.after });
    let pairs = gains
        .figures
        .iter()
        .map(|(name, gain)| ((*name).to_owned(), pair(gain)));
    Value::Object(pairs.collect::<Map<_, _>>())
}
