//! The `[control]` part of a machine file: how the numerical control interpolates, picks postures and plans.
use crate::file::planning::{corner_model, planning};
use crate::file::power_on::power_on;
use crate::file::raw::{Number, RawBranch, RawControl, RawOrientation, RawRapid, RawTcpCodes, Word};
use crate::file::text::number;
use crate::file::validate::{Fault, finite, non_negative};
use crate::follow::requests::posture_words;
use crate::{Axis, AxisKind, Branch, Control, Criterion, FeedMeaning, Planning, PoleAction, PostureRule, RapidPath};
use std::collections::BTreeMap;
use trunnion_geometry::{deg, rad};
use trunnion_interp::{AxisLetter, DrillingAxis, LengthUnit, Position, RoughingEscape, TcpCodes};

/// Names that `family` may have (docs/contract.md#machine-files).
const FAMILIES: &[&str] = &[
    "generic",
    "iso-6983",
    "linuxcnc",
    "fanuc-30i",
    "haas-ngc",
    "haas-lathe",
    "sinumerik-840d",
    "heidenhain-klartext",
    "okuma-osp",
    "okuma-osp-lathe",
    "mitsubishi-m700",
    "grbl",
    "apt",
];

/// Checks this part and keeps what later floors read.
pub(crate) fn control(raw: &RawControl, axes: &[Axis]) -> Result<Control, Fault> {
    let family = one_of("family", raw.family.as_ref(), FAMILIES)?;
    let mut orientation = None;
    if let Some(tcp) = &raw.tcp {
        one_of("path", tcp.path.as_ref(), &["tip-linear"])?;
        one_of("feed", tcp.feed.as_ref(), &["tip"])?;
        orientation = tcp.orientation;
    }
    let family = family.unwrap_or_else(|| "generic".to_owned());
    let feed = one_of("feed", raw.feed.as_ref(), &["xyz", "combined"])?;
    let mut control = Control {
        tcp_great_circle: orientation == Some(RawOrientation::GreatCircle),
        tcp_declared: orientation.is_some(),
        rapid: match raw.rapid {
            // coordinated rapids are documented for LinuxCNC; elsewhere a parameter decides (Fanuc 1401 LRP, Haas setting 335)
            None if family == "linuxcnc" => RapidPath::Synchronous,
            None => RapidPath::Undeclared,
            Some(RawRapid::Synchronous) => RapidPath::Synchronous,
            Some(RawRapid::Dogleg) => RapidPath::Dogleg,
        },
        branch: branch(raw.branch.as_ref(), &family, axes)?,
        power_on: power_on(raw.power_on.as_deref(), &family)?,
        pole_cone: None,
        pole_action: PoleAction::Through,
        feed: match feed.as_deref() {
            Some("xyz") => Some(FeedMeaning::Xyz),
            Some(_) => Some(FeedMeaning::Combined),
            None => None,
        },
        family,
        corner_model: None,
        block_time: None,
        tcp_codes: raw.tcp_codes.as_ref().map(tcp_codes).transpose()?,
        posture_words: posture_words(&raw.posture_words, axes)?,
        units: units(raw.units.as_ref())?,
        reference_points: points("reference_points", raw.reference_points.as_ref(), axes)?,
        fixed_points: points("fixed_points", raw.fixed_points.as_ref(), axes)?,
        peck_clearance_mm: non_negative("peck_clearance", raw.peck_clearance.as_ref())?,
        chip_break_retract_mm: non_negative("chip_break_retract", raw.chip_break_retract.as_ref())?,
        main_spindle: main_spindle(raw.main_spindle.as_ref())?,
        drilling_axis: drilling_axis(raw.drilling_axis.as_ref())?,
        roughing_escape: roughing_escape(raw.roughing_escape.as_ref())?,
        thread_pull_out: non_negative("thread_pull_out", raw.thread_pull_out.as_ref())?,
        roughing_retract_mm: non_negative("roughing_retract", raw.roughing_retract.as_ref())?,
        thread_least_cut_mm: non_negative("thread_least_cut", raw.thread_least_cut.as_ref())?,
        thread_finish_mm: non_negative("thread_finish", raw.thread_finish.as_ref())?,
        spline_arcs_mm: non_negative("spline_arcs", raw.spline_arcs.as_ref())?,
        tool_change: tool_change(raw, axes)?,
        planning: Planning::default(),
    };
    if let Some(pole) = &raw.pole {
        let action = one_of("action", pole.action.as_ref(), &["through", "hold", "alarm"])?;
        control.pole_action = match action.as_deref() {
            Some("hold") => PoleAction::Hold,
            Some("alarm") => PoleAction::Alarm,
            _ => PoleAction::Through,
        };
        control.pole_cone = non_negative("cone", pole.cone.as_ref())?.map(rad);
        if let (true, None, Some(word)) = (
            control.pole_action != PoleAction::Through,
            control.pole_cone,
            &pole.action,
        ) {
            return Err(Fault {
                message: format!(
                    "action {:?} needs a cone: add `cone`, the half angle around the pole in degrees",
                    word.get_ref()
                ),
                span: word.span(),
            });
        }
        control.branch.passing_type = passing_type(pole.passing_type.as_ref())?;
    }
    if let Some(corner) = &raw.corner {
        control.corner_model = corner_model(corner)?;
    }
    if let Some(planner) = &raw.planner {
        control.block_time = non_negative("block_time", planner.block_time.as_ref())?;
    }
    control.planning = planning(raw, axes)?;
    Ok(control)
}

fn units(word: Option<&Word>) -> Result<Option<LengthUnit>, Fault> {
    let unit = one_of("units", word, &["mm", "inch"])?;
    Ok(unit.map(|unit| match unit.as_str() {
        "inch" => LengthUnit::Inch,
        _ => LengthUnit::Millimetre,
    }))
}

fn main_spindle(number: Option<&Number>) -> Result<Option<u32>, Fault> {
    let Some(number) = number else { return Ok(None) };
    let value = *number.get_ref();
    if value.fract() != 0.0 || !(1.0..=99.0).contains(&value) {
        return Err(Fault {
            message: format!("main_spindle = {value} must be the number of a spindle, 1 to 99"),
            span: number.span(),
        });
    }
    Ok(Some(value as u32))
}

fn drilling_axis(word: Option<&Word>) -> Result<Option<DrillingAxis>, Fault> {
    let axis = one_of("drilling_axis", word, &["z", "across-plane"])?;
    Ok(axis.map(|axis| match axis.as_str() {
        "z" => DrillingAxis::Z,
        _ => DrillingAxis::AcrossPlane,
    }))
}

fn roughing_escape(word: Option<&Word>) -> Result<Option<RoughingEscape>, Fault> {
    let escape = one_of("roughing_escape", word, &["feed", "rapid"])?;
    Ok(escape.map(|escape| match escape.as_str() {
        "feed" => RoughingEscape::Feed,
        _ => RoughingEscape::Rapid,
    }))
}

/// Codes that switch the kinematics: each a G or M code with its number, in one of the two lists.
fn tcp_codes(raw: &RawTcpCodes) -> Result<TcpCodes, Fault> {
    let is_code =
        |code: &str| matches!(code.split_at_checked(1), Some(("G" | "M", number)) if number.parse::<u16>().is_ok());
    for word in raw.on.iter().chain(&raw.off) {
        if !is_code(word.get_ref()) {
            return Err(Fault {
                message: format!(
                    "{:?} is not a code: write G or M and a number, for example \"M428\"",
                    word.get_ref()
                ),
                span: word.span(),
            });
        }
    }
    if let Some(twice) = raw
        .off
        .iter()
        .find(|off| raw.on.iter().any(|on| on.get_ref() == off.get_ref()))
    {
        return Err(Fault {
            message: format!(
                "{:?} cannot switch tool centre point control both on and off",
                twice.get_ref()
            ),
            span: twice.span(),
        });
    }
    let names = |words: &[Word]| words.iter().map(|word| word.get_ref().clone()).collect();
    Ok(TcpCodes {
        on: names(&raw.on),
        off: names(&raw.off),
        at_start: raw.at_start,
    })
}

/// The word, which must be one of the known ones.
pub(crate) fn one_of(name: &str, word: Option<&Word>, known: &[&str]) -> Result<Option<String>, Fault> {
    let Some(word) = word else { return Ok(None) };
    if known.contains(&word.get_ref().as_str()) {
        return Ok(Some(word.get_ref().clone()));
    }
    let known_list = known.join(", ");
    let hint = trunnion_dialect::did_you_mean(word.get_ref(), known, "");
    let message = format!("unknown {name} {:?}; known: {known_list}{hint}", word.get_ref());
    Err(Fault {
        message,
        span: word.span(),
    })
}

/// Where G28, G30 P2, ... (G75, G75 FP=2, ...) end: mm and degrees, by letters of axes.
fn points(
    key: &str,
    points: Option<&Vec<BTreeMap<Word, Number>>>,
    axes: &[Axis],
) -> Result<Option<Vec<Position>>, Fault> {
    let places = |points: &Vec<_>| points.iter().map(|point| position(key, point, axes)).collect();
    points.map(places).transpose()
}

/// Where a tool change leaves the axes that it moves.
fn tool_change(raw: &RawControl, axes: &[Axis]) -> Result<Option<Position>, Fault> {
    let place = raw.tool_change.as_ref();
    place.map(|place| position("tool_change", place, axes)).transpose()
}

/// A place in machine coordinates, by letters of axes.
fn position(key: &str, place: &BTreeMap<Word, Number>, axes: &[Axis]) -> Result<Position, Fault> {
    let mut out = Position::default();
    for (letter, value) in place {
        known_axis(letter, axes)?;
        let axis = letter.get_ref().bytes().next().and_then(AxisLetter::new);
        if let Some(axis) = axis {
            out.set(usize::from(axis.0), finite(key, value)?);
        }
    }
    Ok(out)
}

pub(crate) fn known_axis(word: &Word, axes: &[Axis]) -> Result<(), Fault> {
    if axes.iter().any(|axis| word.get_ref().as_bytes() == [axis.letter]) {
        return Ok(());
    }
    Err(Fault {
        message: format!("{:?} is not an axis of this machine", word.get_ref()),
        span: word.span(),
    })
}

/// How the control picks postures: what the file names, else what the family documents.
fn branch(raw: Option<&RawBranch>, family: &str, axes: &[Axis]) -> Result<Branch, Fault> {
    let mut branch = Branch {
        rule: PostureRule::of_family(family),
        ..Branch::default()
    };
    let Some(raw) = raw else { return Ok(branch) };
    let names = PostureRule::NAMES.map(|(name, _)| name);
    if let Some(name) = one_of("rule", raw.rule.as_ref(), &names)? {
        branch.rule = PostureRule::named(&name);
        branch.declared = true;
    }
    branch.solution_negative = one_of("seq", raw.seq.as_ref(), &["+", "-"])?.map(|sign| sign == "-");
    if let (Some(word), true) = (&raw.seq, branch.rule != Some(PostureRule::Heidenhain)) {
        return Err(Fault {
            message: "`seq` is the tilting solution of a Heidenhain control: set rule = \"heidenhain\"".to_owned(),
            span: word.span(),
        });
    }
    let criteria = [
        ("time", Criterion::Time),
        ("move1", Criterion::Move(0)),
        ("move2", Criterion::Move(1)),
        ("abs1", Criterion::Value(0)),
        ("abs2", Criterion::Value(1)),
    ];
    for word in &raw.order {
        let name = one_of("order", Some(word), &criteria.map(|(name, _)| name))?;
        let found = criteria.iter().filter(|(known, _)| name.as_deref() == Some(*known));
        branch.order.extend(found.map(|(_, criterion)| *criterion));
    }
    if let (None, Some(word)) = (branch.rule, raw.order.first()) {
        return Err(Fault {
            message: format!("no rule is documented for family {family:?} that `order` could refine; add `rule`"),
            span: word.span(),
        });
    }
    for (letter, range) in &raw.range {
        known_axis(letter, axes)?;
        let [min, max] = *range.get_ref();
        if !(min.is_finite() && max.is_finite() && min < max) {
            let message = format!("range [{min}, {max}]: the lower end must be below the upper one, both finite");
            return Err(Fault {
                message,
                span: range.span(),
            });
        }
        let linear = |axis: &&Axis| letter.get_ref().as_bytes() == [axis.letter] && axis.kind == AxisKind::Linear;
        if axes.iter().any(|axis| linear(&axis)) {
            return Err(Fault {
                message: format!(
                    "{:?} is a linear axis; a posture concerns rotary axes only",
                    letter.get_ref()
                ),
                span: letter.span(),
            });
        }
        branch.range.push((letter.get_ref().as_bytes()[0], rad(min), rad(max)));
    }
    Ok(branch)
}

fn passing_type(number: Option<&Number>) -> Result<Option<u8>, Fault> {
    match number {
        Some(number) if ![1.0, 2.0].contains(number.get_ref()) => Err(Fault {
            message: format!("passing_type = {} is unknown; write 1 or 2", number.get_ref()),
            span: number.span(),
        }),
        number => Ok(number.map(|number| if *number.get_ref() < 1.5 { 1 } else { 2 })),
    }
}

/// What is known about the choice of postures, the pole and the meaning of F, for people.
pub(crate) fn in_words(control: &Control) -> Vec<String> {
    let branch = &control.branch;
    let mut lines = Vec::new();
    match branch.rule {
        Some(PostureRule::Generic) if !branch.declared => {}
        Some(rule) => {
            let said = if branch.declared { "" } else { " (documented for the family)" };
            lines.push(format!("chooses postures for tool vectors by the rule {:?}{said}", rule.name()));
        }
        // programmed without tool vectors
        None if matches!(control.family.as_str(), "linuxcnc" | "grbl") => {}
        None => lines.push(
            "its choice of posture for tool vectors is neither documented nor declared: reported as unknown where it matters"
                .to_owned(),
        ),
    }
    if let Some(negative) = branch.solution_negative {
        let sign = if negative { "below" } else { "above" };
        lines.push(format!(
            "SEQ{}: of two postures the one with the rotary axis nearest the tool (on a table the last from the workpiece) {sign} zero",
            if negative { '-' } else { '+' }
        ));
    }
    posture_words_in_words(control, &mut lines);
    for &(letter, low, high) in &branch.range {
        lines.push(format!(
            "looks for values of {} between {} and {} deg",
            char::from(letter),
            number(deg(low)),
            number(deg(high))
        ));
    }
    if let Some(passing) = branch.passing_type {
        lines.push(format!("passes the pole according to type {passing}"));
    }
    match (control.pole_action, control.pole_cone) {
        (PoleAction::Hold, Some(cone)) => lines.push(format!(
            "holds the first rotary axis within {} deg of the pole",
            number(deg(cone))
        )),
        (PoleAction::Alarm, Some(cone)) => lines.push(format!(
            "stops with an alarm within {} deg of the pole",
            number(deg(cone))
        )),
        _ => {}
    }
    match control.feed {
        Some(FeedMeaning::Xyz) => lines.push("without tool centre point control F is the speed along X Y Z".to_owned()),
        Some(FeedMeaning::Combined) => {
            lines.push("without tool centre point control F is the speed along sqrt(mm2 + deg2)".to_owned());
        }
        // RS274/NGC says so, on a Sinumerik F is the speed along the geometry axes
        None if matches!(control.family.as_str(), "linuxcnc" | "grbl" | "sinumerik-840d" | "generic" | "apt") => {}
        None => lines.push(
            "it is not declared what F means when rotary and linear axes move together without tool centre point control: reported as unknown where it matters"
                .to_owned(),
        ),
    }
    lines
}

/// What STAT, TU and G53.1 P mean.
fn posture_words_in_words(control: &Control, lines: &mut Vec<String>) {
    let words = &control.posture_words;
    let sign = |negative: bool| if negative { '-' } else { '+' };
    for (letter, bit) in &words.turn {
        lines.push(format!("bit {bit} of TU: {} below zero", char::from(*letter)));
    }
    if let Some((bit, said)) = &words.status {
        lines.push(format!(
            "bit {bit} of STAT: the posture with {}{}",
            char::from(said.letter),
            sign(said.negative)
        ));
    }
    for (number, said) in &words.solutions {
        lines.push(format!(
            "solution {number} (G53.1 P{number}): the posture with {}{}",
            char::from(said.letter),
            sign(said.negative)
        ));
    }
}
