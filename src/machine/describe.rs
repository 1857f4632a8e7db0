//! A machine in words and numbers, for people: chain, signs, limits, speeds, tool axis formula, reach and pole.
use crate::formula::tool_axis_formula;
use crate::text::{direction, number, triple};
use crate::{Axis, AxisKind, Limits, Machine, Orientations, RapidPath, Side, orientations, windings};
use trunnion_geometry::math::atan2;
use trunnion_geometry::{Vec3, deg};

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
    /// +1: ISO 841; -1: turned round.
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
    /// What is known of the control.
    pub control: Vec<String>,
    /// What the file declares and nothing honours yet.
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
        axes: machine.axes.iter().map(axis).collect(),
        tool_axis: machine.tool_axis.into(),
        gauge_point: machine.gauge_point.into(),
        formula: tool_axis_formula(machine),
        reach: reach(machine),
        pole: pole(machine),
        control: control(machine),
        not_used: machine.not_used.clone(),
        tolerances: vec![
            ("tip", tolerances.tip_mm, "mm"),
            ("orientation", deg(tolerances.orientation), "deg"),
            ("pole_cone", deg(tolerances.pole_cone), "deg"),
            ("pole_angle", deg(tolerances.pole_angle), "deg"),
            ("pole_touch", deg(tolerances.pole_touch), "deg"),
            ("swap_excess", deg(tolerances.swap_excess), "deg"),
            ("feed_drop", tolerances.feed_drop_warning, "of the programmed feed"),
            ("feed_drop_error", tolerances.feed_drop_error, "of the programmed feed"),
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
        lines.extend(self.control.iter().map(|line| format!("Control: {line}")));
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

fn axis(axis: &Axis) -> AxisDescription {
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
        notes: notes(axis, unit, plain),
    }
}

/// What a positive motion of the axis does (kinematics notes 2.1 and 7).
fn sentence(axis: &Axis) -> String {
    let letter = char::from(axis.letter);
    let turned = axis.sign < 0.0;
    let odd = if turned {
        " (sign -1: the other way round than ISO 841)"
    } else {
        ""
    };
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
    let flags = [
        (extra.clamp, "clamped while cutting (declared, not used yet)"),
        (extra.cable, "winds up a cable (declared, not used yet)"),
        (extra.spindle, "also a spindle (declared, not used yet)"),
        (extra.diameter, "words are diameters"),
    ];
    notes.extend(flags.iter().filter(|(set, _)| *set).map(|(_, text)| (*text).to_owned()));
    notes.extend(axis.note.iter().map(|text| format!("note: {text}")));
    notes.extend(axis.source.iter().map(|text| format!("source: {text}")));
    notes
}

/// The cone of tool axes that the geometry allows, and what is left of it inside the travel of the second rotary axis.
fn reach(machine: &Machine) -> String {
    let constants = &machine.constants;
    let Some(pair) = &constants.pair else {
        let home = direction(&machine.tool_axis);
        return match constants.rotary_count {
            0 => format!("the tool axis is always {home}"),
            _ => format!(
                "the cone that {home} describes about {}",
                direction(&constants.rotary[0].direction)
            ),
        };
    };
    let first = direction(&constants.rotary[0].direction);
    let whole = if pair.reach_min < 1e-9 && pair.reach_max > core::f64::consts::PI - 1e-9 {
        "every direction".to_owned()
    } else {
        format!(
            "tool axes {} to {} deg from {first}",
            number(deg(pair.reach_min)),
            number(deg(pair.reach_max))
        )
    };
    let second = &machine.axes[constants.rotary[1].joint];
    let Limits::Range(min, max) = second.limits else {
        return whole;
    };
    let [low, high] = legal_cone(machine, [min, max]);
    format!(
        "{whole} by geometry; inside the travel of {}: {} to {} deg from {first}",
        char::from(second.letter),
        number(deg(low)),
        number(deg(high))
    )
}

/// Smallest and largest angle between tool axis and first rotary axis while the second rotary axis runs over its travel, rad.
fn legal_cone(machine: &Machine, [min, max]: [f64; 2]) -> [f64; 2] {
    let constants = &machine.constants;
    let e1 = constants.rotary[0].direction;
    let angle = |q2: f64| {
        let axis = crate::tool_axis_at(machine, [0.0, q2]);
        atan2(e1.cross(&axis).norm(), e1.dot(&axis))
    };
    let azimuth = constants.pair.as_ref().map_or(0.0, |pair| pair.k_azimuth) * constants.rotary[1].sign;
    // the angle is extreme at the ends and where S = 0: at q2 = k pi - azimuth; one turn holds them all
    let pi = core::f64::consts::PI;
    let first = ((min + azimuth) / pi).ceil();
    let inside = (0..3)
        .map(|k| (first + f64::from(k)) * pi - azimuth)
        .filter(|&q2| q2 <= max);
    let angles = [min, max].into_iter().chain(inside).map(angle);
    angles.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], a| {
        [low.min(a), high.max(a)]
    })
}

fn pole(machine: &Machine) -> String {
    let constants = &machine.constants;
    if constants.pair.is_none() {
        return String::new();
    }
    let [first, second] = constants
        .rotary
        .map(|rotary| char::from(machine.axes[rotary.joint].letter));
    let e1 = constants.rotary[0].direction;
    let ends: Vec<String> = [e1, -e1]
        .iter()
        .filter_map(|end| match orientations(machine, end) {
            Orientations::Pole(q2) => {
                let legal = !windings(machine, constants.rotary[1].joint, q2, 0.0).is_empty();
                let outside = if legal { "" } else { ", outside its travel" };
                Some(format!(
                    "{} ({second} = {} deg{outside})",
                    direction(end),
                    number(deg(q2))
                ))
            }
            _ => None,
        })
        .collect();
    if ends.is_empty() {
        return format!("none: the tool never stands along the axis of {first}");
    }
    format!(
        "{first} is free where the tool stands along {}; near it, {first} must turn fast",
        ends.join(" or ")
    )
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
        format!("with tool centre point control the tip runs straight and the orientation {orientation}{said}"),
    ];
    match control.rapid {
        RapidPath::Undeclared => {}
        RapidPath::Synchronous => lines.push("in rapid motions all axes arrive together".to_owned()),
        RapidPath::Dogleg => {
            lines.push("in rapid motions each axis runs at its own speed (declared, not used yet)".to_owned());
        }
    }
    lines.extend(
        control
            .branch_rule
            .iter()
            .map(|rule| format!("picks postures by the rule {rule:?} (declared, not used yet)")),
    );
    lines.extend(machine.gantries.iter().map(|gantry| {
        format!(
            "axis {} mirrors {}",
            char::from(gantry.letter),
            char::from(gantry.leader)
        )
    }));
    lines
}
