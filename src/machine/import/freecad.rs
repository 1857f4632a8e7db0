//! A machine file from a machine of FreeCAD's CAM workbench (`.fcm`, JSON): axes with type, role, parent, joint, limits and highest speed.
//!
//! Speeds are per minute. The file has no accelerations, and does not say in which direction a positive rotary word turns (dir is the axis of
//! rotation, its sense depends on the post processor), so the sign of rotary axes stays unknown.
use super::Imported;
use super::draft::{Draft, DraftAxis};
use crate::MachineError;
use serde::Deserialize;
use serde_json::value::RawValue;
use std::collections::BTreeMap;

#[derive(Deserialize)]
struct File<'a> {
    #[serde(borrow)]
    machine: Option<&'a RawValue>,
}

#[derive(Deserialize)]
struct Machine<'a> {
    name: Option<String>,
    manufacturer: Option<String>,
    units: Option<String>,
    #[serde(borrow)]
    axes: BTreeMap<String, &'a RawValue>,
}

#[derive(Deserialize)]
struct Entry {
    #[serde(rename = "type")]
    kind: String,
    role: Option<String>,
    parent: Option<String>,
    joint: Option<Joint>,
    limits: Option<Limits>,
    max_velocity: Option<f64>,
}

/// Both shapes that FreeCAD has written: a table, or two vectors (origin, direction; for old linear axes direction first).
#[derive(Deserialize)]
#[serde(untagged)]
enum Joint {
    Named { origin: [f64; 3], axis: [f64; 3] },
    Pair([[f64; 3]; 2]),
}

#[derive(Deserialize)]
struct Limits {
    min: Option<f64>,
    max: Option<f64>,
}

/// Positions of pieces in the file, for the places of errors.
struct Source<'a> {
    text: &'a str,
}

impl<'a> Source<'a> {
    /// Where a piece begins: pieces are slices of the text.
    fn offset(&self, piece: &str) -> usize {
        (piece.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize)
    }
    fn parse<T: Deserialize<'a>>(&self, piece: &'a str) -> Result<T, MachineError> {
        serde_json::from_str(piece).map_err(|error| {
            let line = error.line().saturating_sub(1);
            let start: usize = piece.split_inclusive('\n').take(line).map(str::len).sum();
            let at = self.offset(piece) + (start + error.column().saturating_sub(1)).min(piece.len());
            let text = error.to_string();
            let message = text.split(" at line ").next().unwrap_or(&text).to_owned();
            MachineError {
                message,
                span: Some(at..at),
            }
        })
    }
    fn error(&self, piece: &str, message: String) -> MachineError {
        let at = self.offset(piece);
        MachineError {
            message,
            span: Some(at..at + piece.len()),
        }
    }
}

/// One axis with what places it in the chain.
struct Placed {
    axis: DraftAxis,
    parent: Option<String>,
}

/// Makes a machine file. `name` is its title where the file has none.
///
/// # Errors
/// Not JSON, no axes, an axis without direction, of an unknown type or role, mounted on an axis that is missing; with the place.
pub fn import_freecad(name: &str, text: &str) -> Result<Imported, MachineError> {
    let source = Source { text };
    let file: File<'_> = source.parse(text)?;
    let machine: Machine<'_> = source.parse(file.machine.map_or(text, RawValue::get))?;
    let scale = match machine.units.as_deref() {
        Some("metric") => 1.0,
        Some("imperial") => 25.4,
        None => {
            let message = "`units` is missing: write \"metric\" or \"imperial\"".to_owned();
            return Err(MachineError { message, span: None });
        }
        Some(other) => {
            let message = format!(
                "unknown units {:?}; write \"metric\" or \"imperial\"",
                super::short(other)
            );
            return Err(MachineError { message, span: None });
        }
    };
    let mut draft = Draft {
        name: [machine.manufacturer.as_deref(), machine.name.as_deref().or(Some(name))]
            .into_iter()
            .flatten()
            .filter(|part| !part.is_empty())
            .collect::<Vec<_>>()
            .join(" "),
        sources: vec![format!(
            "FreeCAD machine {name}: axes, directions, positions, travels and speeds{}",
            if scale == 1.0 { "" } else { ", converted from inch" }
        )],
        family: "generic",
        ..Draft::default()
    };
    let mut placed = Vec::new();
    for (letter, raw) in &machine.axes {
        placed.push(axis(&source, letter, raw, scale, &mut draft.open)?);
    }
    for (one, raw) in placed.iter().zip(machine.axes.values()) {
        if let Some(parent) = &one.parent
            && !machine.axes.contains_key(parent)
        {
            let message = format!(
                "axis {} is mounted on {:?}, which is not an axis of this machine",
                one.axis.letter,
                super::short(parent)
            );
            return Err(source.error(raw.get(), message));
        }
    }
    unread(
        &source,
        file.machine.map_or(text, RawValue::get),
        &machine.axes,
        &mut draft.open,
    )?;
    order(placed, &mut draft)?;
    draft.open.push(
        "accelerations and the gauge point are not part of a FreeCAD machine; the gauge point is taken as the origin"
            .to_owned(),
    );
    draft
        .open
        .push("it is not known whether the control keeps the tip on its path (TCP)".to_owned());
    Ok(draft.finish())
}

fn axis(
    source: &Source<'_>,
    name: &str,
    raw: &RawValue,
    scale: f64,
    open: &mut Vec<String>,
) -> Result<Placed, MachineError> {
    let text = raw.get();
    let entry: Entry = parse_here(source, raw)?;
    let letter = match name.chars().collect::<Vec<_>>()[..] {
        [letter] if "XYZABCUVW".contains(letter) => letter,
        _ => {
            return Err(source.error(
                text,
                format!(
                    "{:?} is not an axis letter; use one of X Y Z A B C U V W",
                    super::short(name)
                ),
            ));
        }
    };
    let rotary = match entry.kind.as_str() {
        "linear" => false,
        "rotary" | "angular" => true,
        other => {
            return Err(source.error(
                text,
                format!(
                    "axis {name}: unknown type {:?}; write linear or rotary",
                    super::short(other)
                ),
            ));
        }
    };
    let side = match entry.role.as_deref() {
        Some("table_linear" | "table_rotary") => Some("table"),
        Some("head_linear" | "head_rotary") => Some("head"),
        None => None,
        Some(other) => return Err(source.error(text, format!("axis {name}: unknown role {:?}", super::short(other)))),
    };
    let (origin, direction) = match entry.joint {
        Some(Joint::Named { origin, axis }) => (Some(origin), Some(axis)),
        Some(Joint::Pair([first, second])) if !rotary && first.iter().any(|v| *v != 0.0) => (Some(second), Some(first)),
        Some(Joint::Pair([first, second])) => (Some(first), Some(second)),
        None => (None, None),
    };
    let dir =
        direction.map(|d| unit(d).ok_or_else(|| source.error(text, format!("axis {name}: its direction is zero"))));
    let speed = if rotary { 1.0 / 60.0 } else { scale / 60.0 };
    let length = if rotary { 1.0 } else { scale };
    let mut notes = Vec::new();
    if !rotary {
        notes.push("sign assumed: a positive word moves the tool along dir relative to the part".to_owned());
    }
    let limits = entry
        .limits
        .and_then(|limits| Some([limits.min? * length, limits.max? * length]));
    for (missing, what) in [
        (limits.is_none(), "limits"),
        (entry.max_velocity.is_none(), "max_velocity"),
    ] {
        if missing {
            open.push(format!("axis {name}: {what} not given"));
        }
    }
    Ok(Placed {
        axis: DraftAxis {
            letter,
            rotary,
            side,
            dir: dir.transpose()?,
            point: origin.map(|point| point.map(|v| v * scale)),
            sign: (!rotary).then_some(1),
            limits,
            vmax: entry.max_velocity.map(|v| v * speed),
            notes,
            ..DraftAxis::default()
        },
        parent: entry.parent,
    })
}

/// Reports what the file contains and nothing here reads. A frame of the base moves every position and direction.
fn unread<'a>(
    source: &Source<'a>,
    machine: &'a str,
    axes: &BTreeMap<String, &'a RawValue>,
    open: &mut Vec<String>,
) -> Result<(), MachineError> {
    let all: BTreeMap<String, &RawValue> = source.parse(machine)?;
    let known = |key: &str, list: &[&str]| list.contains(&key);
    let (frames, others): (Vec<_>, Vec<_>) = all
        .keys()
        .filter(|key| !known(key, &["name", "manufacturer", "description", "units", "axes"]))
        .partition(|key| key.contains("frame") || *key == "reference_system");
    for key in frames {
        open.push(format!(
            "{key} is not read: positions and directions are used as written; they are wrong if it is not the identity"
        ));
    }
    if !others.is_empty() {
        let names: Vec<&str> = others.into_iter().map(String::as_str).collect();
        open.push(format!("not read: {}", names.join(", ")));
    }
    for (letter, raw) in axes {
        let all: BTreeMap<String, &RawValue> = parse_here(source, raw)?;
        let keys = all.keys().filter(|key| {
            !known(
                key,
                &["type", "role", "parent", "joint", "limits", "max_velocity", "name"],
            )
        });
        let keys: Vec<&str> = keys.map(String::as_str).collect();
        if !keys.is_empty() {
            open.push(format!("axis {letter}: not read: {}", keys.join(", ")));
        }
    }
    Ok(())
}

fn parse_here<'a, T: Deserialize<'a>>(source: &Source<'a>, raw: &'a RawValue) -> Result<T, MachineError> {
    source.parse(raw.get())
}

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let norm = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    (norm > 1e-6).then(|| v.map(|c| c / norm))
}

/// From workpiece to tool: among the axes of the table those mounted on another one come first, among those of the head the order is opposite.
fn order(placed: Vec<Placed>, draft: &mut Draft) -> Result<(), MachineError> {
    let parents: BTreeMap<String, Option<String>> = placed
        .iter()
        .map(|one| (one.axis.letter.to_string(), one.parent.clone()))
        .collect();
    let depth = |letter: char| {
        let mut depth = 0_usize;
        let mut at = parents.get(&letter.to_string()).cloned().flatten();
        while let Some(parent) = at {
            depth += 1;
            if depth > parents.len() {
                return None;
            }
            at = parents.get(&parent).cloned().flatten();
        }
        Some(depth)
    };
    let mut ranked = Vec::new();
    for one in placed {
        let Some(depth) = depth(one.axis.letter) else {
            let message = format!("axis {} is mounted on itself through other axes", one.axis.letter);
            return Err(MachineError { message, span: None });
        };
        let head = one.axis.side == Some("head");
        // the table's farthest from the base first, the head's last
        let rank = if head { depth as isize } else { -(depth as isize) };
        ranked.push((head, rank, one.axis));
    }
    ranked.sort_by_key(|(head, rank, _)| (*head, *rank));
    let turning: Vec<_> = ranked.iter().filter(|(.., axis)| axis.rotary).collect();
    let tied = |a: &(bool, isize, DraftAxis), b: &(bool, isize, DraftAxis)| (a.0, a.1) == (b.0, b.1);
    if turning.windows(2).any(|pair| tied(pair[0], pair[1])) {
        draft.unknown.push("order");
        draft.open.push(
            "it is not known which rotary axis is mounted on which: set their parents in FreeCAD, or put the axes in order here"
                .to_owned(),
        );
    } else if turning
        .iter()
        .any(|one| ranked.iter().any(|other| !other.2.rotary && tied(one, other)))
    {
        draft.open.push(
            "some linear and rotary axes have no parent: it is assumed that no rotary axis carries a linear one, so the rotary axes of the table come first and those of the head last".to_owned(),
        );
        ranked.sort_by_key(|(head, rank, axis)| (*head, if *head { axis.rotary } else { !axis.rotary }, *rank));
    }
    draft.axes = ranked.into_iter().map(|(.., axis)| axis).collect();
    Ok(())
}
