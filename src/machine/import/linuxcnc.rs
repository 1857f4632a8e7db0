//! A machine file from a LinuxCNC INI file: `[KINS]`, `[TRAJ]`, `[AXIS_*]`, `[JOINT_*]`, and the HALCMD lines that set offsets.
use super::Imported;
use super::draft::{Draft, DraftAxis};
use super::hal::Pins;
use super::ini::Ini;
use super::modules::{Chain, KNOWN, Offsets, chain, follower};
use crate::MachineError;

/// Makes a machine file. `name` is its title where the file has none; `given` are pins and their values that the file leaves to others.
///
/// # Errors
/// Not an INI file, no or an unknown kinematics module, no axes, unknown units, or a value that is not a number; with the bytes concerned.
pub fn import_linuxcnc(name: &str, text: &str, given: &[(String, f64)]) -> Result<Imported, MachineError> {
    let ini = Ini::read(text)?;
    let kins = kinematics(&ini)?;
    let letters = letters(&ini, &kins)?;
    let mut offsets = Offsets {
        pins: Pins::new(&ini, &kins.module, given),
        open: Vec::new(),
    };
    let Some(Chain { axes, tcp, unknown }) = chain(&kins.module, &letters, &mut offsets)? else {
        return Err(MachineError {
            message: format!(
                "unknown kinematics module {:?}; known modules: {}",
                super::short(&kins.module),
                KNOWN.join(", ")
            ),
            span: Some(kins.span),
        });
    };
    let scale = Scale::read(&ini)?;
    let title = ini.get("EMC", "MACHINE").map_or(name, |entry| entry.value);
    let mut draft = Draft {
        name: title.to_owned(),
        sources: vec![format!(
            "LinuxCNC INI file {name}: module {}, travels, speeds and accelerations (the narrower of [AXIS_*] and [JOINT_*]){}",
            kins.module,
            if scale.length == 1.0 {
                String::new()
            } else {
                format!(", lengths times {} to mm", scale.length)
            }
        )],
        axes,
        family: "linuxcnc",
        tcp,
        unknown,
        open: offsets.open,
    };
    double_joints(&letters, &mut draft);
    for axis in &mut draft.axes {
        limits(&ini, &letters, &scale, axis, &mut draft.open)?;
    }
    for letter in letters
        .iter()
        .filter(|letter| !draft.axes.iter().any(|axis| axis.letter == **letter))
    {
        let text = format!("axis {letter}: the module passes it on without defining what it moves; it is left out");
        draft.open.push(text);
    }
    if draft.tcp && ini.entries.iter().any(|entry| entry.key == "REMAP") {
        draft.open.push(
            "the REMAP files define which codes switch the kinematics, and they are not read: declare [control] tcp_codes".to_owned(),
        );
    }
    includes(&ini, &mut draft.open);
    if kins.section != "KINS" {
        draft
            .open
            .push(format!("the module is named in [{}], not in [KINS]", kins.section));
    }
    if ini
        .entries
        .iter()
        .any(|entry| entry.key == "HALFILE" || entry.key == "POSTGUI_HALFILE")
    {
        draft
            .open
            .push("HAL files are not read: offsets set there are missing here".to_owned());
    }
    Ok(draft.finish())
}

/// Files that are included and not read; where there are many, how many more.
fn includes(ini: &Ini<'_>, open: &mut Vec<String>) {
    const NAMED: usize = 10;
    for file in ini.includes.iter().take(NAMED) {
        open.push(format!(
            "#INCLUDE {}: not read; its contents are missing here",
            super::short(file)
        ));
    }
    if let more @ 1.. = ini.includes.len().saturating_sub(NAMED) {
        open.push(format!(
            "#INCLUDE: {more} more lines, not read; their contents are missing here"
        ));
    }
}

/// The module and its arguments.
struct Kinematics {
    section: String,
    module: String,
    arguments: Vec<String>,
    span: core::ops::Range<usize>,
}

fn kinematics(ini: &Ini<'_>) -> Result<Kinematics, MachineError> {
    let entry = ini.get("KINS", "KINEMATICS");
    let entry = entry.or_else(|| ini.entries.iter().find(|entry| entry.key == "KINEMATICS"));
    let Some(entry) = entry else {
        let message = "[KINS] KINEMATICS is missing: it is not known which module moves the joints".to_owned();
        return Err(MachineError { message, span: None });
    };
    let mut words = entry.value.split_whitespace().map(str::to_owned);
    Ok(Kinematics {
        section: entry.section.to_owned(),
        module: words.next().unwrap_or_default(),
        arguments: words.collect(),
        span: entry.span.clone(),
    })
}

/// Joints of a LinuxCNC machine (`EMCMOT_MAX_JOINTS` in emcmotcfg.h).
const MOST_JOINTS: usize = 16;

/// The letters in joint order; a letter that occurs twice has two joints.
fn letters(ini: &Ini<'_>, kins: &Kinematics) -> Result<Vec<char>, MachineError> {
    let own = kins.arguments.iter().find_map(|word| word.strip_prefix("coordinates="));
    let entry = ini.get("TRAJ", "COORDINATES");
    let text = own.or(entry.map(|entry| entry.value));
    let written = entry.filter(|_| own.is_none());
    let span = written.map_or_else(|| kins.span.clone(), |entry| entry.span.clone());
    let span = Some(span).filter(|_| text.is_some());
    let letters: Vec<char> = text
        .unwrap_or("")
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| c.to_ascii_uppercase())
        .collect();
    let whose = if own.is_some() {
        "coordinates="
    } else {
        "[TRAJ] COORDINATES"
    };
    let known = |letter: &char| "XYZABCUVW".contains(*letter);
    if letters.is_empty() || !letters.iter().all(known) {
        let message = format!("{whose} must name the axes, with letters of XYZABCUVW");
        return Err(MachineError { message, span });
    }
    if letters.len() > MOST_JOINTS {
        let message = format!(
            "{whose} has {} letters, one for each joint, and LinuxCNC has at most {MOST_JOINTS} joints: name each axis once, and one that two motors \
             move twice",
            letters.len()
        );
        return Err(MachineError { message, span });
    }
    Ok(letters)
}

/// Units of the file in mm and degrees.
struct Scale {
    length: f64,
    angle: f64,
}

impl Scale {
    fn read(ini: &Ini<'_>) -> Result<Self, MachineError> {
        let read = |key: &str, names: &[(&str, f64)]| match ini.get("TRAJ", key) {
            None => Err(MachineError {
                message: format!("[TRAJ] {key} is missing: the unit of the numbers is unknown"),
                span: None,
            }),
            Some(entry) => {
                let word = entry.value.to_ascii_lowercase();
                if let Some((_, scale)) = names.iter().find(|(name, _)| *name == word) {
                    return Ok(*scale);
                }
                // a number is how many user units make one mm or degree
                match entry.number() {
                    Ok(units) if units > 0.0 => Ok(1.0 / units),
                    _ => Err(MachineError {
                        message: format!("[TRAJ] {key} = {:?} is not a known unit", super::short(entry.value)),
                        span: Some(entry.span.clone()),
                    }),
                }
            }
        };
        Ok(Self {
            length: read(
                "LINEAR_UNITS",
                &[
                    ("mm", 1.0),
                    ("metric", 1.0),
                    ("inch", 25.4),
                    ("in", 25.4),
                    ("imperial", 25.4),
                ],
            )?,
            angle: read(
                "ANGULAR_UNITS",
                &[
                    ("deg", 1.0),
                    ("degree", 1.0),
                    ("grad", 0.9),
                    ("gon", 0.9),
                    ("rad", 180.0 / core::f64::consts::PI),
                    ("radian", 180.0 / core::f64::consts::PI),
                ],
            )?,
        })
    }
}

/// Second joints of a letter follow the first under a letter that is free.
fn double_joints(letters: &[char], draft: &mut Draft) {
    for (index, &letter) in letters.iter().enumerate() {
        if !letters[..index].contains(&letter) {
            continue;
        }
        let free = "VUW"
            .chars()
            .find(|c| !letters.contains(c) && !draft.axes.iter().any(|axis| axis.letter == *c));
        let at = draft.axes.iter().position(|axis| axis.letter == letter);
        match (free, at) {
            (Some(free), Some(at)) => draft.axes.insert(at + 1, follower(free, letter)),
            _ => draft
                .open
                .push(format!("joint {index}, a second one of {letter}, is left out")),
        }
    }
}

/// Travel, speed and acceleration: the narrower of the axis' and of its joint's section.
fn limits(
    ini: &Ini<'_>,
    letters: &[char],
    scale: &Scale,
    axis: &mut DraftAxis,
    open: &mut Vec<String>,
) -> Result<(), MachineError> {
    let named = axis.follow.unwrap_or(axis.letter);
    let mut joints = letters.iter().enumerate().filter(|(_, letter)| **letter == named);
    let joint = if axis.follow.is_some() {
        joints.nth(1)
    } else {
        joints.next()
    };
    let joint = joint.map(|(index, _)| index);
    let mut sections = vec![format!("AXIS_{named}")];
    if let Some(joint) = joint {
        sections.push(format!("JOINT_{joint}"));
        // before LinuxCNC distinguished joints and axes (2.7 and older), axes were numbered
        sections.push(format!("AXIS_{joint}"));
    }
    let factor = if axis.rotary { scale.angle } else { scale.length };
    let mut read = |key: &str, narrower: fn(f64, f64) -> f64| -> Result<Option<f64>, MachineError> {
        let mut found: Option<f64> = None;
        for section in &sections {
            if let Some(value) = ini.number(section, key)? {
                found = Some(found.map_or(value, |known| narrower(known, value)));
            }
        }
        if found.is_none() {
            open.push(format!("axis {}: {key} is missing and stays undeclared", axis.letter));
        }
        Ok(found.map(|value| value * factor))
    };
    let (low, high) = (read("MIN_LIMIT", f64::max)?, read("MAX_LIMIT", f64::min)?);
    axis.vmax = read("MAX_VELOCITY", f64::min)?;
    axis.amax = read("MAX_ACCELERATION", f64::min)?;
    axis.limits = low.zip(high).map(|(low, high)| [low, high]);
    Ok(())
}
