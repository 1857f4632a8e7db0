//! Axis positions of the machine over the path or the time, one field per axis, with limits and notable blocks.
use crate::canvas::{BLUE, Entry, GREY, Header, PlotError, Swatch, VERMILION, sheet};
use crate::grid::{Frame, Panel};
use crate::marks::Rules;
use crate::record::{Mark, Record, Sample};
use crate::scale::range;
use crate::unit::Unit;
use trunnion_geometry::deg;
use trunnion_machine::{Axis, AxisKind, Limits, Machine};

/// The horizontal axis of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// Travel of the tip, mm.
    Way,
    /// Time, s.
    Time,
}

impl Along {
    fn of(self, record: &Record, sample: &Sample) -> f64 {
        match self {
            Self::Way => record.way(sample),
            Self::Time => sample.time,
        }
    }
    fn name(self, unit: Unit) -> &'static str {
        match self {
            Self::Way => unit.travel(),
            Self::Time => "time at programmed feed / s",
        }
    }
}

/// Draws them.
///
/// # Errors
/// Nothing is known about any motion.
pub fn joints(
    header: &Header,
    machine: &Machine,
    record: &Record,
    marks: &[Mark],
    along: Along,
) -> Result<String, PlotError> {
    if record.samples.is_empty() {
        return Err(PlotError(
            "nothing to draw: the axis positions are unknown in every motion".into(),
        ));
    }
    let across = range(record.samples.iter().map(|sample| along.of(record, sample)), 1e-3);
    // no empty room before the start
    let across = [across[0].max(0.0), across[1]];
    if across[1] <= across[0]
        || record
            .samples
            .iter()
            .all(|sample| !along.of(record, sample).is_finite())
    {
        return Err(PlotError(
            "the time of every motion is unknown: draw over the travel instead".into(),
        ));
    }
    let rules = Rules::of(marks);
    let mut legend: Vec<Entry> = vec![
        (Swatch::Line(BLUE), "feed".into()),
        (Swatch::Line(GREY), "rapid".into()),
    ];
    if machine.axes.iter().any(|axis| matches!(axis.limits, Limits::Range(..))) {
        legend.push((Swatch::Dashed(VERMILION), "limit".into()));
    }
    legend.extend(rules.entries());
    sheet(header, &legend, |body| {
        let count = machine.own_axes().count();
        let (width, height) = body.dim_in_pixel();
        // the last field has the labels below it
        let labels = 500;
        let each = (height as i32 - labels) / count as i32;
        for (joint, axis) in machine.own_axes() {
            let last = joint + 1 == count;
            let top = each * joint as i32;
            let bottom = if last { height as i32 } else { top + each };
            let field = body.clone().shrink((0, top), (width, (bottom - top) as u32));
            let sign = match axis.kind {
                AxisKind::Rotary => "deg",
                AxisKind::Linear => record.unit.name(),
            };
            let name = format!("{} / {sign}", char::from(axis.letter));
            let at = |sample: &Sample| shown(record.unit, axis, sample.joints[joint]);
            let values = range(record.samples.iter().map(at), shown(record.unit, axis, LEAST));
            let limits = travel(record.unit, axis);
            let [low, high] = with_limits(values, limits);
            let digits = match axis.kind {
                AxisKind::Rotary => 0,
                AxisKind::Linear => record.unit.digits(0),
            };
            let spot = |sample: &Sample| (along.of(record, sample), at(sample));
            // a strip above the curve for the note on limits
            let upwards = [low, high + NOTE_SHARE * (high - low)];
            let panel = Panel::new(
                &field,
                &Frame {
                    x: across,
                    y: upwards,
                    x_name: last.then_some(along.name(record.unit)),
                    y_name: &name,
                    labels: [10, (each / 350).clamp(2, 6) as usize],
                    decades: false,
                    right: 0.0,
                },
            )?;
            draw_limits(&panel, (limits, digits), across, upwards)?;
            draw_marks(&panel, record, marks, &rules, spot)?;
            for rapid in [true, false] {
                let points = curve(record, rapid, spot);
                panel.line(
                    points.into_iter(),
                    if rapid { GREY } else { BLUE },
                    if rapid { 1.2 } else { 1.8 },
                )?;
            }
        }
        Ok(())
    })
}

/// The samples of rapids (or feeds), parted where others lie between.
fn curve(record: &Record, rapid: bool, spot: impl Fn(&Sample) -> (f64, f64)) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for block in &record.blocks {
        if block.rapid == rapid {
            if !block.joined {
                points.push((f64::NAN, f64::NAN));
            }
            points.extend(record.of(block).iter().map(&spot));
        } else {
            points.push((f64::NAN, f64::NAN));
        }
    }
    points
}

/// A position of an axis, mm or deg, as it is shown.
fn shown(unit: Unit, axis: &Axis, value: f64) -> f64 {
    match axis.kind {
        AxisKind::Rotary => value,
        AxisKind::Linear => unit.of_mm(value),
    }
}

/// Travel of an axis as it is shown.
fn travel(unit: Unit, axis: &Axis) -> Option<[f64; 2]> {
    let Limits::Range(low, high) = axis.limits else {
        return None;
    };
    Some(match axis.kind {
        AxisKind::Rotary => [deg(low), deg(high)],
        AxisKind::Linear => [low, high].map(|limit| unit.of_mm(limit)),
    })
}

/// Height of a field of an axis that hardly moves, mm or deg: in a smaller one each number needs more digits than fit.
const LEAST: f64 = 0.1;

/// Height of the note on limits as a share of a field without it.
const NOTE_SHARE: f64 = 0.22;

/// The range with those limits that lie near it.
fn with_limits(range: [f64; 2], limits: Option<[f64; 2]>) -> [f64; 2] {
    let span = range[1] - range[0];
    let near = |limit: f64| limit > range[0] - span && limit < range[1] + span;
    limits
        .into_iter()
        .flatten()
        .filter(|limit| near(*limit))
        .fold(range, |wide, limit| {
            [wide[0].min(limit - 0.1 * span), wide[1].max(limit + 0.1 * span)]
        })
}

fn draw_limits(
    panel: &Panel<'_>,
    (limits, digits): (Option<[f64; 2]>, usize),
    across: [f64; 2],
    upwards: [f64; 2],
) -> Result<(), PlotError> {
    let note = match limits {
        None => "no limits".to_owned(),
        Some([low, high]) => format!("limits {low:.digits$} to {high:.digits$}").replace('-', "\u{2212}"),
    };
    for limit in limits.into_iter().flatten() {
        if limit > upwards[0] && limit < upwards[1] {
            panel.dashed(across.map(|x| (x, limit)).into_iter(), VERMILION, 1.4)?;
        }
    }
    panel.note(&note)
}

fn draw_marks(
    panel: &Panel<'_>,
    record: &Record,
    marks: &[Mark],
    rules: &Rules,
    spot: impl Fn(&Sample) -> (f64, f64),
) -> Result<(), PlotError> {
    let lines = record.by_line();
    // the rarest on top, each a little smaller
    for (place, marked) in rules.drawn.iter().enumerate() {
        let mut dots = Vec::new();
        for mark in marks.iter().filter(|mark| mark.rule == marked.rule) {
            for block in lines.get(&mark.line).into_iter().flatten() {
                if let Some(end) = record.of(block).last() {
                    dots.push(spot(end));
                }
            }
        }
        panel.symbols(dots.into_iter(), marked, 7.0 - place as f64, true)?;
    }
    Ok(())
}
