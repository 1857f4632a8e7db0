//! The isometric view of a part, and a box about it that has a scale.
use crate::canvas::{INK, PlotError, anchored};
use crate::grid::Panel;
use crate::scale::short;
use crate::unit::Unit;
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};
use trunnion_geometry::Vec3;

/// Colour of the box.
const FLOOR: RGBColor = RGBColor(170, 170, 170);

/// Isometric view with Z upwards, X to the right and down, Y to the right and up.
pub(crate) fn see(p: &Vec3) -> (f64, f64) {
    const ACROSS: f64 = core::f64::consts::FRAC_1_SQRT_2;
    const UP: f64 = 0.408_248_290_463_863;
    ((p.x + p.y) * ACROSS, (p.y - p.x) * UP + p.z * 2.0 * UP)
}

/// The floor of the box about the part, and its edge along Z.
pub(crate) fn draw_box(flat: &Panel<'_>, low: &Vec3, high: &Vec3) -> Result<(), PlotError> {
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
    )
}

/// The names of the axes, with ticks along X and Y in front and along Z at the left.
pub(crate) fn draw_scale(
    flat: &Panel<'_>,
    (unit, names): (Unit, &[String; 3]),
    low: &Vec3,
    high: &Vec3,
) -> Result<(), PlotError> {
    let size = (high - low).max().max(1e-3);
    let shown = unit.of_mm(size);
    let step = unit.to_mm(step(shown / 6.0));
    for axis in 0..3 {
        let span = high[axis] - low[axis];
        // a flat part has no scale of its own there: its name has the range
        let ticks = ((high[axis] / step).floor() - (low[axis] / step).ceil()).max(-1.0) as i64;
        let ticks = if ticks < 1 { -1 } else { ticks };
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
        let name = if ticks < 0 {
            range(&names[axis], unit, [low[axis], high[axis]])
        } else {
            format!("{} / {}", names[axis], unit.name())
        };
        let middle = place(low[axis] + 0.5 * span) + beside * if axis == 2 { 4.0 } else { 4.5 };
        if axis == 2 && (ticks < 0 || !flat.shows(see(&(middle + beside * 3.0)))) {
            // no room beside the edge: above it
            let top = see(&place(high.z));
            let (off, side) = if ticks < 0 {
                (6.0, HPos::Left)
            } else {
                (-6.0, HPos::Right)
            };
            flat.write_inside(top, (off, -14.0), &name, (15.0, side, VPos::Bottom))?;
        } else {
            flat.write_inside(see(&middle), (0.0, 0.0), &name, (15.0, anchor.0, anchor.1))?;
        }
    }
    Ok(())
}

/// `Z −0.1 to 0 in`, `Z = 5 mm`.
fn range(name: &str, unit: Unit, ends: [f64; 2]) -> String {
    let [low, high] = ends.map(|end| unit.of_mm(end));
    let of = (high - low).max(unit.of_mm(0.01));
    let [from, to] = [low, high].map(|end| short(end, of));
    if from == to {
        format!("{name} = {from} {}", unit.name())
    } else {
        format!("{name} {from} to {to} {}", unit.name())
    }
}

fn step(value: f64) -> f64 {
    let base = (-9..=9)
        .map(|e: i32| (0..e.abs()).fold(1.0, |v: f64, _| if e > 0 { v * 10.0 } else { v / 10.0 }))
        .flat_map(|power| [power, 2.0 * power, 5.0 * power]);
    base.into_iter().find(|nice| *nice >= value).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_has_the_digits_that_it_needs() {
        assert_eq!(range("Z", Unit::Inch, [-2.54, 0.0]), "Z \u{2212}0.1 to 0 in");
        assert_eq!(range("Y", Unit::Mm, [5.0, 5.0]), "Y = 5 mm");
    }

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
