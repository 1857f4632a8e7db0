//! Axis positions of the machine over the path or the time, one field per axis, with limits and notable blocks.
use crate::canvas::{BLUE, Entry, GREY, Header, PlotError, Swatch, VERMILION, sheet};
use crate::grid::{Frame, Panel};
use crate::marks::Rules;
use crate::record::{AxisLetters, Block, Mark, Record, Sample};
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
    let legend = legend(machine, record, &rules);
    let places = places(record, marks, &rules);
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
            let name = format!("{} / {sign}", record.axis_name(char::from(axis.letter)));
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
                    labels: [10, (each / 220).clamp(3, 8) as usize],
                    decades: false,
                    right: 0.0,
                },
            )?;
            draw_limits(&panel, (limits, digits), across, upwards)?;
            for rapid in [true, false] {
                let points = curve(record, rapid, spot);
                panel.line(
                    points.into_iter(),
                    if rapid { GREY } else { BLUE },
                    if rapid { 1.2 } else { 1.8 },
                )?;
            }
            if let Some(limits) = limits {
                panel.line(beyond(record, limits, spot).into_iter(), VERMILION, 3.0)?;
            }
            // the rarest on top, each a little smaller
            for (place, (marked, places)) in rules.drawn.iter().zip(&places).enumerate() {
                let own = places.iter().filter(|(axes, _)| axes.hold(char::from(axis.letter)));
                let spots = own.map(|(_, at)| spot(&record.samples[*at as usize]));
                panel.symbols(spots, marked, 7.0 - place as f64, true)?;
            }
        }
        Ok(())
    })
}

fn legend(machine: &Machine, record: &Record, rules: &Rules) -> Vec<Entry> {
    let mut legend: Vec<Entry> = vec![
        (Swatch::Line(BLUE), "feed".into()),
        (Swatch::Line(GREY), "rapid".into()),
    ];
    if machine.axes.iter().any(|axis| matches!(axis.limits, Limits::Range(..))) {
        legend.push((Swatch::Dashed(VERMILION), "limit".into()));
    }
    let leaves = machine.own_axes().filter(|(joint, axis)| {
        let limits = travel(record.unit, axis);
        let out = |sample: &Sample| {
            limits.is_some_and(|limits| is_beyond(shown(record.unit, axis, sample.joints[*joint]), limits))
        };
        record.samples.iter().any(out)
    });
    let leaves: Vec<String> = leaves.map(|(_, axis)| char::from(axis.letter).to_string()).collect();
    if !leaves.is_empty() {
        legend.push((
            Swatch::Line(VERMILION),
            format!("beyond a limit: {}", leaves.join(", ")),
        ));
    }
    legend.extend(rules.entries());
    legend
}

/// Rounding does not leave a limit, mm or deg (or inch).
const ROUNDING: f64 = 1e-6;

fn is_beyond(value: f64, [low, high]: [f64; 2]) -> bool {
    value < low - ROUNDING || value > high + ROUNDING
}

/// The parts of the curve beyond the limits, cut where they are crossed.
fn beyond(record: &Record, limits: [f64; 2], spot: impl Fn(&Sample) -> (f64, f64)) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for block in &record.blocks {
        for two in record.of(block).windows(2) {
            let [from, to] = [spot(&two[0]), spot(&two[1])];
            let sides = [(-1.0, limits[0]), (1.0, limits[1])];
            for (sign, limit) in sides {
                // how far beyond this limit
                let [a, b] = [from.1, to.1].map(|value| sign * (value - limit));
                if a.max(b) <= ROUNDING {
                    continue;
                }
                let cross = |share: f64| (from.0 + share * (to.0 - from.0), limit);
                let start = if a < 0.0 { cross(a / (a - b)) } else { from };
                let end = if b < 0.0 { cross(a / (a - b)) } else { to };
                points.extend([(f64::NAN, f64::NAN), start, end]);
            }
        }
    }
    points
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

/// For each rule that is drawn, the samples at the ends of its blocks, and the axes that each is about.
fn places(record: &Record, marks: &[Mark], rules: &Rules) -> Vec<Vec<(AxisLetters, u32)>> {
    let lines = record.by_line();
    let of = |rule: &str| {
        let marks = marks.iter().filter(|mark| mark.rule == rule);
        let end = |block: &Block| block.samples.clone().next_back().map(|last| last as u32);
        let ends = marks.flat_map(|mark| {
            lines
                .of(mark.line)
                .filter_map(move |block| Some((mark.axes, end(block)?)))
        });
        ends.collect()
    };
    rules.drawn.iter().map(|marked| of(marked.rule)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texts::{header, record};
    use trunnion_geometry::Vec3;
    use trunnion_machine::builtin;

    /// X of a mill goes to these positions, cut by cut.
    fn along_x(values: &[f64]) -> Record {
        let moves: Vec<(char, Vec3)> = values.iter().map(|x| ('f', Vec3::new(*x, 0.0, 0.0))).collect();
        let mut record = record(&moves, |_| Vec3::z());
        for sample in &mut record.samples {
            sample.joints[0] = sample.tip.x;
        }
        record
    }

    #[test]
    fn what_is_beyond_a_limit_is_cut_at_the_limit() {
        let record = along_x(&[-10.0, 5.0, 0.0, -5.0]);
        let spot = |sample: &Sample| (sample.way, sample.joints[0]);
        let parts = beyond(&record, [-8.0, 0.0], spot);
        let parts: Vec<_> = parts.into_iter().filter(|p| p.0.is_finite()).collect();
        assert_eq!(
            parts,
            [
                (0.0, -10.0),
                (2.0, -8.0),
                (10.0, 0.0),
                (15.0, 5.0),
                (15.0, 5.0),
                (20.0, 0.0)
            ]
        );
        assert!(beyond(&record, [-10.0, 5.0], spot).is_empty());
    }

    #[test]
    fn the_legend_names_the_axes_beyond_their_limits() {
        let machine = builtin("mill-3axis").expect("built in");
        let (_, axis) = machine.own_axes().next().expect("an axis");
        let Limits::Range(low, high) = axis.limits else {
            panic!("no limits")
        };
        let texts = |end: f64| {
            let legend = legend(machine, &along_x(&[low, end]), &Rules::of(&[]));
            legend.into_iter().map(|entry| entry.1).collect::<Vec<_>>().join("; ")
        };
        assert_eq!(texts(high), "feed; rapid; limit");
        assert_eq!(texts(high + 1.0), "feed; rapid; limit; beyond a limit: X");
    }

    /// A symbol stands in the field of its axis alone, whole.
    #[test]
    fn a_mark_stands_at_the_axis_that_it_is_about() {
        let machine = builtin("mill-3axis").expect("built in");
        let polygons = |axes: AxisLetters| {
            let mark = Mark {
                line: 2,
                rule: "axis-limit",
                axes,
            };
            let svg = joints(&header(), machine, &along_x(&[0.0, 10.0, 20.0]), &[mark], Along::Way).expect("drawn");
            svg.matches("<polygon").count()
        };
        // one more in the legend
        let [y, q] = ['Y', 'Q'].map(AxisLetters::one);
        assert_eq!((polygons(AxisLetters::default()), polygons(y), polygons(q)), (4, 2, 1));
    }
}
