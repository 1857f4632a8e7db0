//! The path of the tool tip in space, seen from the front, the right and above.
use crate::canvas::{BLUE, Entry, GREY, Header, INK, ORANGE, PlotError, Swatch, VERMILION, anchored, sheet};
use crate::grid::Panel;
use crate::record::{Block, Record};
use crate::scale::{counted, short};
use crate::unit::Unit;
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};
use trunnion_geometry::Vec3;

/// Colour of the box.
const FLOOR: RGBColor = RGBColor(170, 170, 170);

/// Draws it. `tolerance`: blocks whose tip deviates farther are drawn in another colour, mm.
///
/// # Errors
/// No path is known.
pub fn path(header: &Header, record: &Record, tolerance: f64) -> Result<String, PlotError> {
    if record.samples.is_empty() {
        return Err(PlotError("nothing to draw: no path is known".into()));
    }
    let strays = |block: &Block| !block.rapid && block.deviation.is_some_and(|[most, _]| most > tolerance);
    let straying = record.blocks.iter().filter(|block| strays(block)).count();
    let mut legend: Vec<Entry> = vec![
        (Swatch::Line(BLUE), "feed".into()),
        (Swatch::Dashed(GREY), "rapid".into()),
        (Swatch::Line(ORANGE), "tool axis".into()),
    ];
    if straying > 0 {
        legend.push((
            Swatch::Line(VERMILION),
            format!(
                "deviates more than {} ({})",
                record.unit.declared(tolerance),
                counted(straying, "block")
            ),
        ));
    }
    if record.unknown > 0 {
        legend.push((
            Swatch::Plain,
            format!(
                "{} without a known start or end not drawn",
                counted(record.unknown, "motion")
            ),
        ));
    }
    let cut = record.blocks.iter().filter(|block| !block.rapid);
    let (mut low, mut high) = extent(cut.flat_map(|block| record.of(block)).map(|sample| sample.tip));
    if low.x > high.x {
        (low, high) = extent(record.samples.iter().map(|sample| sample.tip));
    }
    sheet(header, &legend, |body| {
        let corners = (0..8).map(|i| {
            let pick = |bit: usize, k: usize| if i & bit == 0 { low[k] } else { high[k] };
            see(&Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2)))
        });
        let rapids = record
            .blocks
            .iter()
            .filter(|block| block.rapid)
            .flat_map(|block| record.of(block));
        // a rapid from far away must not make the part small: it is cut off at the edge
        let size = (high - low).norm().max(1e-3);
        let near = rapids.map(|sample| sample.tip).filter(|tip| {
            let held = tip.sup(&low).inf(&high);
            (tip - held).norm() < 0.35 * size
        });
        let flat = Panel::bare(body, corners.chain(near.map(|tip| see(&tip))));
        draw_box(&flat, record.unit, &low, &high)?;
        draw_axes(&flat, record, size)?;
        for rapid in [true, false] {
            let mut points = Vec::new();
            for block in &record.blocks {
                if block.rapid == rapid && !strays(block) {
                    if !block.joined {
                        points.push((f64::NAN, f64::NAN));
                    }
                    points.extend(record.of(block).iter().map(|sample| see(&sample.tip)));
                } else {
                    points.push((f64::NAN, f64::NAN));
                }
            }
            if rapid {
                flat.dashed(points.into_iter(), GREY, 1.2)?;
            } else {
                flat.line(points.into_iter(), BLUE, 1.5)?;
            }
        }
        for block in record.blocks.iter().filter(|block| strays(block)) {
            flat.line(record.of(block).iter().map(|sample| see(&sample.tip)), VERMILION, 1.5)?;
        }
        Ok(())
    })
}

/// Isometric view with Z upwards, X to the right and down, Y to the right and up.
fn see(p: &Vec3) -> (f64, f64) {
    const ACROSS: f64 = core::f64::consts::FRAC_1_SQRT_2;
    const UP: f64 = 0.408_248_290_463_863;
    ((p.x + p.y) * ACROSS, (p.y - p.x) * UP + p.z * 2.0 * UP)
}

fn extent(points: impl Iterator<Item = Vec3>) -> (Vec3, Vec3) {
    let empty = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    points
        .filter(|point| point.iter().all(|value| value.is_finite()))
        .fold(empty, |(low, high), point| (low.inf(&point), high.sup(&point)))
}

/// The floor of the box about the cut, with ticks along X and Y in front and along Z at the left.
fn draw_box(flat: &Panel<'_>, unit: Unit, low: &Vec3, high: &Vec3) -> Result<(), PlotError> {
    let at = |x: f64, y: f64, z: f64| see(&Vec3::new(x, y, z));
    let floor = [
        at(low.x, low.y, low.z),
        at(high.x, low.y, low.z),
        at(high.x, high.y, low.z),
        at(low.x, high.y, low.z),
        at(low.x, low.y, low.z),
    ];
    flat.line(floor.into_iter(), FLOOR, 1.0)?;
    flat.line(
        [at(low.x, low.y, low.z), at(low.x, low.y, high.z)].into_iter(),
        FLOOR,
        1.0,
    )?;
    let size = (high - low).max().max(1e-3);
    let shown = unit.of_mm(size);
    let step = unit.to_mm(step(shown / 6.0));
    for axis in 0..3 {
        let letter = ['X', 'Y', 'Z'][axis];
        let span = high[axis] - low[axis];
        // a flat part has no scale of its own there
        let ticks = ((high[axis] / step).floor() - (low[axis] / step).ceil()).max(-1.0) as i64;
        let (anchor, beside) = match axis {
            0 => ((HPos::Right, VPos::Top), Vec3::new(0.0, -0.03 * size, 0.0)),
            1 => ((HPos::Left, VPos::Top), Vec3::new(0.03 * size, 0.0, 0.0)),
            _ => ((HPos::Right, VPos::Center), Vec3::new(-0.02 * size, -0.02 * size, 0.0)),
        };
        let place = |value: f64| {
            let mut point = match axis {
                1 => Vec3::new(high.x, low.y, low.z),
                _ => *low,
            };
            point[axis] = value;
            point
        };
        for tick in 0..=ticks {
            let value = ((low[axis] / step).ceil() + tick as f64) * step;
            let from = place(value);
            let to = from + beside;
            flat.line([see(&from), see(&to)].into_iter(), FLOOR, 1.0)?;
            let text = short(unit.of_mm(value), shown);
            flat.write(
                see(&(to + beside * 0.3)),
                &text,
                anchored(13.0, anchor.0, anchor.1).color(&INK),
            )?;
        }
        let middle = place(low[axis] + 0.5 * span) + beside * if axis == 2 { 4.0 } else { 4.5 };
        flat.write(
            see(&middle),
            &format!("{letter} / {}", unit.name()),
            anchored(15.0, anchor.0, anchor.1).color(&INK),
        )?;
    }
    Ok(())
}

fn step(value: f64) -> f64 {
    let base = (-9..=9)
        .map(|e: i32| (0..e.abs()).fold(1.0, |v: f64, _| if e > 0 { v * 10.0 } else { v / 10.0 }))
        .flat_map(|power| [power, 2.0 * power, 5.0 * power]);
    base.into_iter().find(|nice| *nice >= value).unwrap_or(value)
}

/// The tool axis at some of the feed samples, evenly along the path.
fn draw_axes(flat: &Panel<'_>, record: &Record, size: f64) -> Result<(), PlotError> {
    let feeds = || {
        record
            .blocks
            .iter()
            .filter(|block| !block.rapid)
            .flat_map(|block| record.of(block))
    };
    let total: f64 = record
        .blocks
        .iter()
        .filter(|block| !block.rapid)
        .map(|block| {
            let samples = record.of(block);
            samples.last().map_or(0.0, |s| s.way) - samples.first().map_or(0.0, |s| s.way)
        })
        .sum();
    let every = (total / 160.0).max(1e-6);
    let mut next = f64::NEG_INFINITY;
    for sample in feeds() {
        if sample.way >= next {
            next = sample.way + every;
            let top = sample.tip + sample.axis * (0.06 * size);
            flat.line([see(&sample.tip), see(&top)].into_iter(), ORANGE, 0.8)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_view_is_isometric() {
        let length = |v: Vec3| {
            let (x, y) = see(&v);
            (x * x + y * y).sqrt()
        };
        let [x, y, z] = [Vec3::x(), Vec3::y(), Vec3::z()].map(length);
        assert!((x - y).abs() < 1e-9 && (y - z).abs() < 1e-9);
        assert!(see(&Vec3::z()).1 > 0.0 && see(&Vec3::x()).1 < 0.0);
        assert_eq!((step(17.0), step(0.3)), (20.0, 0.5));
    }
}
