//! A machine file with a planted fault: a rotary axis that is not where the file says.
use crate::cli::failure::Failure;
use std::path::Path;
use toml::{Table, Value};
use trunnion_machine::builtin_source;

/// How far off, mm.
const OFF: f64 = 0.05;

/// The machine's file with the last rotary axis of the chain `OFF` mm away, along the coordinate most at right angles to it.
pub(super) fn pivot_off(name: &str) -> Result<String, Failure> {
    let text = match builtin_source(name) {
        Some(text) => text.to_owned(),
        None => trunnion_files::read_text(Path::new(name))?,
    };
    let broken = |why: &str| Failure::new(format!("--plant pivot: machine {name}: {why}"));
    let mut table: Table = text.parse().map_err(|error: toml::de::Error| broken(error.message()))?;
    let axes = table.get_mut("axis").and_then(Value::as_array_mut);
    let axes = axes.ok_or_else(|| broken("its file lists no axes"))?;
    let rotary = axes
        .iter_mut()
        .rev()
        .filter_map(Value::as_table_mut)
        .find(|axis| axis.get("kind").and_then(Value::as_str) == Some("rotary"))
        .ok_or_else(|| broken("it has no rotary axis"))?;
    let triple = |axis: &Table, key: &str| -> [f64; 3] {
        let mut values = [0.0; 3];
        let list = axis.get(key).and_then(Value::as_array);
        for (slot, value) in values.iter_mut().zip(list.into_iter().flatten()) {
            *slot = value
                .as_float()
                .or_else(|| value.as_integer().map(|i| i as f64))
                .unwrap_or(0.0);
        }
        values
    };
    let (direction, mut point) = (triple(rotary, "dir"), triple(rotary, "point"));
    // of equal ones the last: across a tilting axis that is upwards
    let across = (0..3)
        .rev()
        .min_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs()))
        .unwrap_or(2);
    point[across] += OFF;
    rotary.insert("point".into(), Value::Array(point.map(Value::Float).to_vec()));
    // the rows by which a file checks itself would refuse it: this is a file without such rows
    table.remove("check");
    toml::to_string(&table).map_err(|error| broken(&error.to_string()))
}
