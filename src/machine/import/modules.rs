//! What the kinematics modules of LinuxCNC say about the chain: published formulas, compared with the machines here in the oracle tests.
//! Offsets are pins; their defaults are the modules' own.
use super::draft::{DraftAxis, usual};
use super::hal::{Pin, Pins};
use crate::MachineError;
use trunnion_geometry::math::sin_cos;
use trunnion_geometry::rad;

/// The modules that are known.
pub(super) const KNOWN: &[&str] = &[
    "trivkins",
    "xyzac-trt-kins",
    "xyzbc-trt-kins",
    "xyzab_tdr_kins",
    "5axiskins",
    "maxkins",
    "xyzacb_trsrn",
    "xyzbca_trsrn",
];

/// A chain, and what had to be assumed.
pub(super) struct Chain {
    pub(super) axes: Vec<DraftAxis>,
    /// The module keeps the tip on its path.
    pub(super) tcp: bool,
    pub(super) unknown: Vec<&'static str>,
}

/// Reads pins and records what they leave unknown.
pub(super) struct Offsets<'a> {
    pub(super) pins: Pins<'a>,
    pub(super) open: Vec<String>,
}

impl Offsets<'_> {
    /// The pin, or the module's default where nothing touches it; `None` where its value comes from somewhere else.
    fn get(&mut self, name: &str, default: f64) -> Result<Option<f64>, MachineError> {
        Ok(match self.pins.get(name)? {
            Pin::Set(value) => Some(value),
            Pin::Untouched => {
                self.open.push(format!(
                    "pin {name}: nothing in this file sets it; {default}, the module's default, is assumed (a HAL file may set it: --set {name}=VALUE)"
                ));
                Some(default)
            }
            Pin::Elsewhere => {
                self.open.push(format!(
                    "pin {name}: its value comes from a panel or HAL file that is not read; give it with --set {name}=VALUE"
                ));
                None
            }
        })
    }
    /// The pin `conventional-directions` as a sign.
    fn sense(&mut self) -> Result<Option<i8>, MachineError> {
        let value = self.get("conventional-directions", 0.0)?;
        Ok(value.map(|value| if value == 0.0 { -1 } else { 1 }))
    }
    /// A point from pins that are all known.
    fn point(&mut self, names: [&str; 3]) -> Result<[Option<f64>; 3], MachineError> {
        let [x, y, z] = names;
        Ok([self.get(x, 0.0)?, self.get(y, 0.0)?, self.get(z, 0.0)?])
    }
}

/// All three, or nothing.
fn all(point: [Option<f64>; 3]) -> Option<[f64; 3]> {
    let [x, y, z] = point;
    Some([x?, y?, z?])
}

/// The sum of two numbers that are known.
fn sum(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    Some(a? + b?)
}

/// The chain of a module for the axis letters of the configuration; `None`: not a module that is known.
pub(super) fn chain(module: &str, letters: &[char], offsets: &mut Offsets<'_>) -> Result<Option<Chain>, MachineError> {
    let name: String = module.to_ascii_lowercase().replace('-', "_");
    Ok(Some(match name.trim_end_matches("_kins") {
        "trivkins" => trivial(letters),
        "xyzac_trt" => tilting('A', offsets)?,
        "xyzbc_trt" => tilting('B', offsets)?,
        "xyzab_tdr" => dual(offsets)?,
        "5axiskins" => bridge(letters, offsets)?,
        "maxkins" => max(offsets)?,
        "xyzacb_trsrn" => nutating('A', 'B', offsets)?,
        "xyzbca_trsrn" => nutating('B', 'A', offsets)?,
        _ => return Ok(None),
    }))
}

fn cartesian() -> impl Iterator<Item = DraftAxis> {
    ['X', 'Y', 'Z'].into_iter().map(DraftAxis::linear)
}

fn tcp(axes: Vec<DraftAxis>) -> Chain {
    Chain {
        axes,
        tcp: true,
        unknown: Vec::new(),
    }
}

/// Joints are words: linear axes are along their letters; nothing is assumed about rotary axes.
fn trivial(letters: &[char]) -> Chain {
    let rotary = |letter: &&char| ('A'..='C').contains(*letter);
    let extra = |letter: &&char| ('U'..='W').contains(*letter);
    let turning = letters.iter().filter(rotary).count();
    let quills = letters.iter().filter(extra).count();
    let axes = letters
        .iter()
        .filter(rotary)
        .map(|letter| DraftAxis::unknown_rotary(*letter));
    let axes = axes
        .chain(cartesian())
        .chain(letters.iter().filter(extra).map(|letter| {
            let mut axis = DraftAxis::linear(*letter);
            axis.notes = vec!["assumed parallel to its letter's usual direction".to_owned()];
            axis
        }));
    Chain {
        axes: axes.collect(),
        tcp: false,
        unknown: if turning > 1 || (turning > 0 && quills > 0) {
            vec!["order"]
        } else {
            Vec::new()
        },
    }
}

/// xyzac-trt and xyzbc-trt: the part on C, C on the tilting axis.
fn tilting(tilt: char, offsets: &mut Offsets<'_>) -> Result<Chain, MachineError> {
    let sign = offsets.sense()?;
    let [x, y, z] = offsets.point(["x-rot-point", "y-rot-point", "z-rot-point"])?;
    let across = offsets.get(if tilt == 'A' { "y-offset" } else { "x-offset" }, 0.0)?;
    let up = offsets.get("z-offset", 0.0)?;
    let pivot = if tilt == 'A' {
        [x, sum(y, across), sum(z, up)]
    } else {
        [sum(x, across), y, sum(z, up)]
    };
    let table = DraftAxis::rotary('C', "table", all([x, y, z]), sign);
    let tilting = DraftAxis::rotary(tilt, "table", all(pivot), sign);
    Ok(tcp([table, tilting].into_iter().chain(cartesian()).collect()))
}

/// xyzab-tdr: the part on A, A on B.
fn dual(offsets: &mut Offsets<'_>) -> Result<Chain, MachineError> {
    let [x, y, z] = offsets.point(["x-rot-point", "y-rot-point", "z-rot-point"])?;
    let up = offsets.get("z-offset", 0.0)?;
    let first = DraftAxis::rotary('A', "table", all([Some(0.0), y, sum(z, up)]), Some(1));
    let second = DraftAxis::rotary('B', "table", all([x, Some(0.0), z]), Some(1));
    Ok(tcp([first, second].into_iter().chain(cartesian()).collect()))
}

/// 5axiskins: head C then B, W along the tool.
fn bridge(letters: &[char], offsets: &mut Offsets<'_>) -> Result<Chain, MachineError> {
    let pivot = offsets.get("pivot-length", 250.0)?;
    let point = all([Some(0.0), Some(0.0), pivot]);
    let mut axes: Vec<DraftAxis> = cartesian().collect();
    axes.push(DraftAxis::rotary('C', "head", point, Some(1)));
    axes.push(DraftAxis::rotary('B', "head", point, Some(-1)));
    if letters.contains(&'W') {
        axes.push(DraftAxis {
            sign: Some(-1),
            notes: vec!["positive W lengthens the tool".to_owned()],
            ..DraftAxis::linear('W')
        });
    }
    Ok(tcp(axes))
}

/// maxkins: table C below X and Y, head B.
fn max(offsets: &mut Offsets<'_>) -> Result<Chain, MachineError> {
    let sign = offsets.sense()?;
    let pivot = offsets.get("pivot-length", 0.666)?;
    let table = DraftAxis::rotary('C', "table", Some([0.0; 3]), Some(1));
    let head = DraftAxis::rotary('B', "head", all([Some(0.0), Some(0.0), pivot]), sign);
    Ok(tcp([table].into_iter().chain(cartesian()).chain([head]).collect()))
}

/// Along Y for the table A, along X for the table B.
fn across<T>(table: char, value: T, rest: T) -> [T; 2] {
    if table == 'A' { [rest, value] } else { [value, rest] }
}

/// xyzacb-trsrn and xyzbca-trsrn: a rotary table, a head that turns with C and nutates. The table is held: the tilted planes of these
/// configurations use the head.
fn nutating(table: char, head: char, offsets: &mut Offsets<'_>) -> Result<Chain, MachineError> {
    let along = if table == 'A' { 'y' } else { 'x' };
    let place = offsets.get(&format!("{along}-rot-axis"), 0.0)?;
    let height = offsets.get("z-rot-axis", 0.0)?;
    let lever = offsets.get(&format!("{along}-pivot"), 0.0)?;
    let up = offsets.get("z-pivot", 0.0)?;
    let (dx, dy) = (offsets.get("x-offset", 0.0)?, offsets.get("y-offset", 0.0)?);
    let nutation = offsets.get("nut-angle", 0.0)?;
    let zero = Some(0.0);
    let [x, y] = across(table, place, zero);
    let mut turning = DraftAxis::rotary(table, "table", all([x, y, height]), Some(1));
    turning.hold = Some(0.0);
    turning
        .notes
        .push("held: kinematics are solved for the two axes of the head".to_owned());
    let [x, y] = across(table, lever, zero);
    let primary = DraftAxis::rotary('C', "head", all([sum(x, dx), sum(y, dy), up]), Some(1));
    let mut secondary = DraftAxis::rotary(head, "head", all([x, y, up]), Some(1));
    secondary.dir = nutation.map(|angle| {
        let (sin, cos) = sin_cos(rad(angle));
        let [x, y] = across(table, sin, 0.0);
        [x, y, cos]
    });
    Ok(tcp([turning]
        .into_iter()
        .chain(cartesian())
        .chain([primary, secondary])
        .collect()))
}

/// The axis that a second joint of the same letter becomes.
pub(super) fn follower(letter: char, leader: char) -> DraftAxis {
    DraftAxis {
        letter,
        follow: Some(leader),
        rotary: ('A'..='C').contains(&leader),
        side: Some("head"),
        dir: Some(usual(leader)),
        sign: Some(1),
        notes: vec![format!(
            "the second joint of {leader}; named {letter} here, since every letter may occur once"
        )],
        ..DraftAxis::default()
    }
}
