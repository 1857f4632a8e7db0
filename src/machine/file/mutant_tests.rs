//! Random mutations of every shipped machine file (A12): one sign, direction, point, order, limit or other entry is changed; of those
//! that change what the machine does, at least 95 in 100 must be noticed when the file is loaded and tested. Prints who noticed what.
use crate::kinematics::selftest::SplitMix;
use crate::{BUILTIN_MACHINES, Comparison, Machine, builtin, builtin_source, load, self_test};
use std::collections::BTreeMap;
use toml::{Table, Value};

/// What can go wrong in a file, by the word it is counted under.
const KINDS: [&str; 17] = [
    "sign",
    "order",
    "point",
    "limit",
    "dir",
    "tilted dir",
    "letter",
    "kind",
    "tool axis",
    "gauge point",
    "hold",
    "speed",
    "acceleration",
    "axis left out",
    "limits left out",
    "second motor",
    "words",
];

/// How many mutants; `TRUNNION_MUTANTS` for more.
fn mutants() -> usize {
    std::env::var("TRUNNION_MUTANTS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(510)
}

/// A random whole number below `n`.
fn below(random: &mut SplitMix, n: usize) -> usize {
    (random.between(0.0, n as f64) as usize).min(n.saturating_sub(1))
}

/// The numbers of an array.
fn numbers(value: Option<&Value>) -> Option<Vec<f64>> {
    let number = |value: &Value| value.as_float().or_else(|| Some(value.as_integer()? as f64));
    value?.as_array()?.iter().map(number).collect()
}

fn array(values: &[f64]) -> Value {
    Value::Array(values.iter().map(|value| Value::Float(*value)).collect())
}

/// A number that is not small, of either sign.
fn step(random: &mut SplitMix, least: f64, most: f64) -> f64 {
    let size = random.between(least, most);
    if random.between(0.0, 1.0) < 0.5 { -size } else { size }
}

/// Adds `by` to one number of an array.
fn nudge(table: &mut Table, key: &str, at: usize, by: f64) -> Option<()> {
    let mut values = numbers(table.get(key))?;
    *values.get_mut(at)? += by;
    table.insert(key.to_owned(), array(&values));
    Some(())
}

/// Changes one thing of the given kind; `None` where the file has nothing of it.
fn mutate(file: &mut Table, kind: &str, random: &mut SplitMix) -> Option<()> {
    if kind == "tool axis" || kind == "gauge point" {
        let spindle = file.get_mut("spindle")?.as_table_mut()?;
        if kind == "gauge point" {
            return nudge(spindle, "gauge_point", below(random, 3), step(random, 0.01, 20.0));
        }
        let mut axis = numbers(spindle.get("tool_axis"))?;
        axis.rotate_left(1);
        spindle.insert("tool_axis".to_owned(), array(&axis));
        return Some(());
    }
    let axes = file.get_mut("axis")?.as_array_mut()?;
    let (count, at) = (axes.len(), below(random, axes.len()));
    match kind {
        "order" => {
            let other = (at + 1 + below(random, count - 1)) % count;
            axes.swap(at, other);
            return Some(());
        }
        "letter" => {
            let other = (at + 1 + below(random, count - 1)) % count;
            let letter = |axes: &[Value], at: usize| axes[at].get("letter").cloned();
            let (a, b) = (letter(axes, at)?, letter(axes, other)?);
            axes[at].as_table_mut()?.insert("letter".to_owned(), b);
            axes[other].as_table_mut()?.insert("letter".to_owned(), a);
            return Some(());
        }
        "axis left out" => {
            axes.remove(at);
            return Some(());
        }
        _ => {}
    }
    of_axis(axes[at].as_table_mut()?, kind, random)
}

/// Changes one thing of one axis.
fn of_axis(axis: &mut Table, kind: &str, random: &mut SplitMix) -> Option<()> {
    match kind {
        "sign" => {
            let sign = axis.get("sign")?.as_integer()?;
            axis.insert("sign".to_owned(), Value::Integer(-sign));
        }
        "point" => nudge(axis, "point", below(random, 3), step(random, 0.01, 50.0))?,
        "limit" => {
            let size = step(random, 0.1, 30.0);
            nudge(axis, "limits", below(random, 2), size)?;
        }
        "dir" => {
            let mut dir = numbers(axis.get("dir"))?;
            if random.between(0.0, 1.0) < 0.5 {
                dir = dir.iter().map(|value| -value).collect();
            } else {
                dir.rotate_left(1 + below(random, 2));
            }
            axis.insert("dir".to_owned(), array(&dir));
        }
        "tilted dir" => {
            let mut dir = numbers(axis.get("dir"))?;
            *dir.get_mut(below(random, 3))? += step(random, 1e-3, 0.1);
            let norm = dir.iter().map(|value| value * value).sum::<f64>().sqrt();
            dir = dir.iter().map(|value| value / norm).collect();
            axis.insert("dir".to_owned(), array(&dir));
        }
        "kind" => {
            let other = if axis.get("kind")?.as_str()? == "rotary" {
                "linear"
            } else {
                "rotary"
            };
            axis.insert("kind".to_owned(), other.into());
        }
        "hold" => {
            axis.get("hold")?;
            axis.insert("hold".to_owned(), Value::Float(step(random, 1.0, 90.0)));
        }
        "speed" | "acceleration" => {
            let key = if kind == "speed" { "vmax" } else { "amax" };
            let limits = axis.get_mut("dyn")?.as_table_mut()?;
            let value = limits.get(key)?;
            let value = value.as_float().or_else(|| Some(value.as_integer()? as f64))?;
            limits.insert(key.to_owned(), Value::Float(value * random.between(1.05, 4.0)));
        }
        "limits left out" => {
            axis.remove("limits")?;
        }
        "second motor" => {
            axis.get("follow")?;
            let size = step(random, 0.1, 30.0);
            nudge(axis, "limits", below(random, 2), size)?;
        }
        // how words become joints: diameters, and what a rotary word means
        _ => {
            if axis.get("kind")?.as_str()? == "rotary" {
                let wrap = if axis.get("wrap").is_some_and(|wrap| wrap.as_str() == Some("shortest")) {
                    "literal"
                } else {
                    "shortest"
                };
                axis.insert("wrap".to_owned(), wrap.into());
            } else if axis.remove("mode").is_none() {
                axis.insert("mode".to_owned(), "diameter".into());
            }
        }
    }
    Some(())
}

/// Whether two machines move differently: other axes, another pose, another travel or speed, another meaning of words.
fn differs(honest: &Machine, mutant: &Machine) -> bool {
    let Ok(comparison) = Comparison::new(honest, mutant) else {
        return true;
    };
    let entry = |text: &String| {
        !text.contains(": side ")
            && !text.contains(": dir ")
            && !text.starts_with("order")
            && !text.contains(": point ")
    };
    let words = |machine: &Machine| {
        let axes = machine.axes.iter();
        axes.map(|axis| (axis.letter, axis.extra.diameter, axis.extra.wrap))
            .collect::<Vec<_>>()
    };
    let (mut a, mut b) = (words(honest), words(mutant));
    a.sort_by_key(|axis| axis.0);
    b.sort_by_key(|axis| axis.0);
    let pose = comparison
        .random_poses(40, 1)
        .is_none_or(|worst| worst.tip_mm > 1e-6 || worst.axis > 1e-9 || worst.tip_mm.is_nan());
    pose || a != b || comparison.entries().iter().any(entry)
}

/// Who noticed: 0 validation, 1 self-test, 2 check rows, 3 nobody; `None` where the mutant does what the honest machine does.
fn noticed(honest: &Machine, file: &Table) -> Option<usize> {
    let mut bare = file.clone();
    bare.remove("check");
    let text = |table: &Table| toml::to_string(table).expect("a table can be written");
    let Ok(mutant) = load("mutant", &text(&bare)) else {
        return Some(0);
    };
    if !differs(honest, &mutant) {
        return None;
    }
    let result = self_test(&mutant, 30, 1);
    if result.posture_missing > 0
        || result.worst_tip_mm.is_nan()
        || result.worst_tip_mm > 1e-9
        || result.worst_axis > 1e-9
    {
        return Some(1);
    }
    Some(if load("mutant", &text(file)).is_err() { 2 } else { 3 })
}

#[test]
#[expect(clippy::print_stderr, reason = "the table of what was missed is worth reading")]
fn mutants_of_machine_files_are_noticed() {
    let mut random = SplitMix(12);
    let mut table: BTreeMap<&str, [usize; 5]> = BTreeMap::new();
    let mut made = 0;
    let files: Vec<Table> = BUILTIN_MACHINES
        .iter()
        .map(|name| builtin_source(name).expect("shipped").parse().expect("TOML"))
        .collect();
    while made < mutants() {
        let kind = KINDS[made % KINDS.len()];
        let at = below(&mut random, files.len());
        let mut file = files[at].clone();
        // another machine where this one has nothing of the kind
        if mutate(&mut file, kind, &mut random).is_none() {
            continue;
        }
        let name = BUILTIN_MACHINES[at];
        made += 1;
        let row = table.entry(kind).or_default();
        match noticed(builtin(name).expect("shipped"), &file) {
            Some(who) => row[who] += 1,
            None => row[4] += 1,
        }
    }
    eprintln!(
        "{:16} {:>10} {:>9} {:>10} {:>7} {:>10}",
        "mutation", "validation", "self-test", "check rows", "missed", "no change"
    );
    let mut all = [0; 5];
    for (kind, row) in &table {
        eprintln!(
            "{kind:16} {:>10} {:>9} {:>10} {:>7} {:>10}",
            row[0], row[1], row[2], row[3], row[4]
        );
        for (sum, one) in all.iter_mut().zip(row) {
            *sum += one;
        }
    }
    let changing = all[0] + all[1] + all[2] + all[3];
    eprintln!(
        "{:16} {:>10} {:>9} {:>10} {:>7} {:>10}",
        "all", all[0], all[1], all[2], all[3], all[4]
    );
    assert!(changing > mutants() / 2 && table.len() == KINDS.len(), "{table:?}");
    let share = 1.0 - all[3] as f64 / changing as f64;
    assert!(share >= 0.95, "only {:.1} % noticed", share * 100.0);
}
