//! A machine in words and numbers, for people: chain, signs, limits, speeds, tool axis formula, reach and pole.
use crate::file::formula::tool_axis_formula;
use crate::file::text::{direction, number, triple};
use crate::kinematics::reach::{pole, postures_by_tilt, reach};
use crate::kinematics::uncertainty::{PIVOT_SENSITIVITY, worst_pivot_error};
use crate::{Axis, AxisKind, Limits, Machine, RapidPath, Side};
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::LengthUnit;

/// One axis in words and numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisDescription {
    /// Letter.
    pub letter: char,
    /// `linear` or `rotary`.
    pub kind: &'static str,
    /// `table` or `head`.
    pub side: &'static str,
    /// Unit direction at home, machine frame.
    pub direction: [f64; 3],
    /// A point of a rotary axis at home, machine frame, mm; `None` for a linear axis.
    pub point: Option<[f64; 3]>,
    /// +1: ISO 841; -1: reversed.
    pub sign: i8,
    /// What a positive motion does.
    pub sentence: String,
    /// Lowest and highest value, mm or deg; `None`: endless or not declared, see `limits`.
    pub range: Option<[f64; 2]>,
    /// The travel in words.
    pub limits: String,
    /// Highest speed, mm/s or deg/s; `None`: not declared.
    pub max_speed: Option<f64>,
    /// The speed in words.
    pub speed: String,
    /// Properties, sources and assumptions.
    pub notes: Vec<String>,
}

/// A machine in words and numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// `mikron-ucp710`.
    pub id: String,
    /// Name for people.
    pub name: String,
    /// Axes from workpiece to tool.
    pub axes: Vec<AxisDescription>,
    /// Tool axis at home, tip to spindle.
    pub tool_axis: [f64; 3],
    /// Gauge point at home, mm.
    pub gauge_point: [f64; 3],
    /// Tool axis in the workpiece frame as a formula in the rotary joints.
    pub formula: String,
    /// Which tool axes can be reached.
    pub reach: String,
    /// Where the first rotary axis is free; empty for machines without a pole.
    pub pole: String,
    /// How many postures inside the travels each range of tilts from the first rotary axis has.
    pub postures: Vec<String>,
    /// Warnings about the file, and the result of its check rows.
    pub remarks: Vec<String>,
    /// What is known about the control.
    pub control: Vec<String>,
    /// What the file declares and nothing uses yet.
    pub not_used: Vec<String>,
    /// Thresholds: name, value and unit.
    pub tolerances: Vec<(&'static str, f64, &'static str)>,
    /// Where the numbers come from.
    pub sources: Vec<String>,
}

/// Describes a machine.
pub fn describe(machine: &Machine) -> Description {
    let tolerances = &machine.tolerances;
    Description {
        id: machine.id.clone(),
        name: machine.name.clone(),
        axes: machine.own_axes().map(|(joint, _)| axis(machine, joint)).collect(),
        tool_axis: machine.home.tool_axis.into(),
        gauge_point: machine.home.gauge_point.into(),
        formula: tool_axis_formula(machine),
        reach: reach(machine),
        pole: pole(machine),
        postures: postures_by_tilt(machine),
        remarks: remarks(machine),
        control: control(machine),
        not_used: machine.not_used.clone(),
        tolerances: vec![
            ("tip", tolerances.tip_mm, "mm"),
            ("orientation", deg(tolerances.orientation), "deg"),
            ("swept", tolerances.swept_mm, "mm"),
            ("pole_cone", deg(tolerances.pole_cone), "deg"),
            ("pole_angle", deg(tolerances.pole_angle), "deg"),
            ("swap_excess", deg(tolerances.swap_excess), "deg"),
            ("rotary_ratio", tolerances.rotary_ratio, "deg/deg"),
            ("linear_ratio", tolerances.linear_ratio, "mm/mm"),
            ("rapid_ratio", tolerances.rapid_ratio, "mm/mm"),
            ("feed_drop", tolerances.feed_drop_warning, "of the programmed feed"),
            ("feed_drop_error", tolerances.feed_drop_error, "of the programmed feed"),
            ("pivot", tolerances.pivot_mm, "mm"),
            ("collision_near", tolerances.near_mm, "mm"),
        ],
        sources: machine.sources.clone(),
    }
}

impl Description {
    /// The description as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("{} ({})", self.name, self.id), String::new()];
        lines.push("Axes from workpiece to tool:".to_owned());
        for axis in &self.axes {
            lines.push(format!(
                "  {}  {} axis on the {}: {}",
                axis.letter, axis.kind, axis.side, axis.sentence
            ));
            let point = axis.point.map_or_else(String::new, |point| {
                format!(", point {} mm", triple(&Vec3::from(point)))
            });
            lines.push(format!(
                "     sign {:+}, direction {}{point}",
                axis.sign,
                triple(&Vec3::from(axis.direction))
            ));
            lines.push(format!("     {}; {}", axis.limits, axis.speed));
            lines.extend(axis.notes.iter().map(|note| format!("     {note}")));
        }
        lines.push(String::new());
        lines.push(format!(
            "Tool axis at home (tip to spindle): {}",
            triple(&Vec3::from(self.tool_axis))
        ));
        lines.push(format!(
            "Gauge point at home: {} mm; tip = gauge point - length * tool axis",
            triple(&Vec3::from(self.gauge_point))
        ));
        lines.push(format!("Tool axis in the part: {}", self.formula));
        lines.push(format!("Reach: {}", self.reach));
        if !self.pole.is_empty() {
            lines.push(format!("Pole: {}", self.pole));
        }
        if !self.postures.is_empty() {
            lines.push(format!(
                "Postures by tilt from the first rotary axis: {}",
                self.postures.join("; ")
            ));
        }
        lines.extend(self.control.iter().map(|line| format!("Control: {line}")));
        lines.extend(self.remarks.iter().cloned());
        lines.extend(
            self.not_used
                .iter()
                .map(|line| format!("Declared, not used yet: {line}")),
        );
        let limits: Vec<String> = self
            .tolerances
            .iter()
            .map(|(name, value, unit)| format!("{name} {} {unit}", number(*value)))
            .collect();
        lines.push(format!("Tolerances: {}", limits.join(", ")));
        lines.extend(self.sources.iter().map(|source| format!("Source: {source}")));
        lines
    }
}

fn axis(machine: &Machine, joint: usize) -> AxisDescription {
    let axis = &machine.axes[joint];
    let rotary = axis.kind == AxisKind::Rotary;
    let unit = if rotary { "deg" } else { "mm" };
    let plain = |value: f64| if rotary { deg(value) } else { value };
    let range = match axis.limits {
        Limits::Unbounded => None,
        Limits::Range(min, max) => Some([plain(min), plain(max)]),
    };
    let limits = match range {
        Some([min, max]) => format!("travel {} to {} {unit}", number(min), number(max)),
        None if axis.extra.limits_declared => "endless".to_owned(),
        None => "travel not declared, so no limit is checked".to_owned(),
    };
    let max_speed = axis.max_speed.map(plain);
    let speed = match max_speed {
        Some(speed) => format!(
            "at most {} {unit}/s ({} {unit}/min)",
            number(speed),
            number(speed * 60.0)
        ),
        None => "speed not declared, so it limits no feed".to_owned(),
    };
    AxisDescription {
        letter: char::from(axis.letter),
        kind: if rotary { "rotary" } else { "linear" },
        side: if axis.side == Side::Table { "table" } else { "head" },
        direction: axis.direction.into(),
        point: rotary.then(|| axis.point.into()),
        sign: if axis.sign < 0.0 { -1 } else { 1 },
        sentence: sentence(axis),
        range,
        limits,
        max_speed,
        speed,
        notes: notes(axis, unit, plain)
            .into_iter()
            .chain(uncertainty(machine, joint))
            .collect(),
    }
}

/// Distance of the tip from the axis' point for which an uncertain direction is printed, mm.
const ARM: f64 = 100.0;

/// The effect of the declared uncertainty of an axis on the tip.
fn uncertainty(machine: &Machine, joint: usize) -> Option<String> {
    let worst = worst_pivot_error(machine, joint, ARM)?;
    let extra = &machine.axes[joint].extra;
    let far = if worst > PIVOT_SENSITIVITY { "more" } else { "not more" };
    Some(format!(
        "uncertainty: point {} mm, direction {} arcsec; under tool centre point control the tip is off by up to {} mm inside the travel, \
         {} mm away from the axis' point ({far} than {} mm)",
        number(extra.point_uncertainty.unwrap_or(0.0)),
        number(deg(extra.direction_uncertainty.unwrap_or(0.0)) * 3600.0),
        number(worst),
        number(ARM),
        number(PIVOT_SENSITIVITY)
    ))
}

/// Warnings, and what was checked when the file was loaded.
fn remarks(machine: &Machine) -> Vec<String> {
    let mut lines: Vec<String> = machine.warnings.iter().map(|line| format!("Warning: {line}")).collect();
    lines.push(match machine.checks {
        0 => "Check rows: none; a wrong sign, point or order in this file would not be noticed".to_owned(),
        count => format!("Check rows: {count}, all hold"),
    });
    lines
}

/// What a positive motion of the axis does (docs/kinematics.md#machine-model).
fn sentence(axis: &Axis) -> String {
    let letter = char::from(axis.letter);
    let turned = axis.sign < 0.0;
    let odd = if turned { " (sign -1: opposite to ISO 841)" } else { "" };
    match (axis.kind, axis.side) {
        (AxisKind::Linear, side) => {
            let tool = axis.direction * axis.sign;
            match side {
                Side::Head => format!("{letter}+ moves the tool along {}{odd}", direction(&tool)),
                Side::Table => format!(
                    "{letter}+ moves the table along {}, so the tool moves along {} relative to the part{odd}",
                    direction(&-tool),
                    direction(&tool)
                ),
            }
        }
        (AxisKind::Rotary, side) => {
            let way = |clockwise: bool| if clockwise { "clockwise" } else { "counter-clockwise" };
            let from = direction(&axis.direction);
            let place = if axis.point == Vec3::zeros() {
                String::new()
            } else {
                format!(", about a line through {} mm", triple(&axis.point))
            };
            match side {
                Side::Head => format!("{letter}+ turns the tool {} seen from {from}{place}{odd}", way(turned)),
                Side::Table => format!(
                    "{letter}+ turns the part {} seen from {from}{place}, so the tool moves {} relative to the part{odd}",
                    way(!turned),
                    way(turned)
                ),
            }
        }
    }
}

fn notes(axis: &Axis, unit: &str, plain: impl Fn(f64) -> f64) -> Vec<String> {
    let extra = &axis.extra;
    let mut notes = Vec::new();
    if let Some(acceleration) = axis.max_acceleration {
        notes.push(format!(
            "acceleration at most {} {unit}/s^2",
            number(plain(acceleration))
        ));
    }
    if let Some(margin) = extra.limit_margin {
        notes.push(format!(
            "warns {} {unit} before a limit (declared, not used yet)",
            number(plain(margin))
        ));
    }
    if let Some(value) = extra.hold {
        notes.push(format!(
            "held at {} {unit}: the kinematics are solved for the other rotary axes; a program that moves this axis is not followed",
            number(plain(value))
        ));
    }
    if let Some(codes) = extra.clamp_codes {
        notes.push(format!("clamped by M{}, released by M{}", codes.on, codes.off));
    }
    let flags = [
        (extra.clamp, "must stand still while cutting"),
        (extra.cable, "winds up a cable"),
        (extra.spindle, "also a spindle, whose speeds are not judged"),
        (extra.diameter, "words are diameters"),
    ];
    notes.extend(flags.iter().filter(|(set, _)| *set).map(|(_, text)| (*text).to_owned()));
    notes.extend(axis.note.iter().map(|text| format!("note: {text}")));
    notes.extend(axis.source.iter().map(|text| format!("source: {text}")));
    notes
}

fn control(machine: &Machine) -> Vec<String> {
    let control = &machine.control;
    let orientation = if control.tcp_great_circle {
        "on a great circle"
    } else {
        "joint by joint"
    };
    let said = if control.tcp_declared {
        ""
    } else {
        " (assumed: the file does not say)"
    };
    let mut lines = vec![
        format!("family {}", control.family),
        format!("with tool centre point control the tip moves straight and the orientation {orientation}{said}"),
    ];
    if let Some(unit) = control.units {
        let name = match unit {
            LengthUnit::Millimetre => "mm",
            LengthUnit::Inch => "inch",
        };
        lines.push(format!("lengths are in {name} until a program says otherwise"));
    }
    lines.extend(crate::file::places::places(control));
    if let Some(codes) = &control.tcp_codes {
        let list = |codes: &[String]| {
            if codes.is_empty() {
                "no code".to_owned()
            } else {
                codes.join(", ")
            }
        };
        let start = if codes.at_start {
            "; it is on when a program starts"
        } else {
            ""
        };
        lines.push(format!(
            "tool centre point control is switched on by {}, off by {}{start}",
            list(&codes.on),
            list(&codes.off)
        ));
    }
    match control.rapid {
        RapidPath::Undeclared => {}
        RapidPath::Synchronous => lines.push("in rapid motions all axes arrive together".to_owned()),
        RapidPath::Dogleg => {
            lines.push(
                "in rapid motions each axis runs at its own speed: the path between the ends is unknown".to_owned(),
            );
        }
    }
    lines.extend(crate::file::control::in_words(control));
    lines.extend(machine.gantries.iter().map(|gantry| {
        format!(
            "axis {} mirrors {}: travel and speed are limited to what both allow",
            char::from(gantry.letter),
            char::from(gantry.leader)
        )
    }));
    lines.extend(machine.obstacles.iter().map(crate::Obstacle::in_words));
    lines
}
