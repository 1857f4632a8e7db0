//! The tool axis seen along the pole: its curve over the lines on which a rotary axis keeps its value.
//!
//! Where the lines of equal turn crowd together, a small change of the tool axis turns that rotary axis far (paper on five-axis
//! high-speed milling of hydraulic blades, 2006, figure 11).
use crate::canvas::{BLUE, GREEN, PALE};
use crate::canvas::{Entry, GREY, Header, INK, PlotError, Swatch, VERMILION, px, sheet};
use crate::grid::{Frame, Panel, equal};
use crate::marks::{Groups, Rules};
use crate::net::{Net, beside_rim};
use crate::record::{Mark, Record};
use crate::scale::range;
use core::f64::consts::TAU;
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_machine::{Machine, Orientations, orientations, tool_axis_at};

/// Colour of the lines of equal turn.
const RAY: RGBColor = RGBColor(150, 185, 215);

/// Draws it. `after`: a second run of the same machine, drawn over the first. `within`: only what is within this many degrees of the pole.
///
/// # Errors
/// The machine does not have two rotary axes, or no tool axis is known.
pub fn axis_plane(
    header: &Header,
    machine: &Machine,
    record: &Record,
    marks: &[Mark],
    after: Option<&Record>,
    within: Option<f64>,
) -> Result<String, PlotError> {
    let plane = Plane::new(machine)?;
    if record.samples.is_empty() {
        return Err(PlotError(
            "nothing to draw: the tool axis is unknown in every motion".into(),
        ));
    }
    let rules = Rules::of(marks);
    let letter = |slot: usize| char::from(machine.axes[machine.rotary[slot]].letter);
    let mut legend: Vec<Entry> = vec![
        (
            Swatch::Line(BLUE),
            if after.is_some() { "before" } else { "tool axis" }.to_owned(),
        ),
        (Swatch::Line(RAY), format!("equal {}", letter(0))),
        (Swatch::Dashed(GREY), format!("equal {}", letter(1))),
        (Swatch::Filled(PALE), format!("pole cone {} deg", trim(plane.cone))),
    ];
    if after.is_some() {
        legend.insert(1, (Swatch::Line(GREEN), "after".to_owned()));
    }
    legend.extend(rules.entries());
    sheet(header, &legend, |body| {
        let records = core::iter::once(record).chain(after);
        let seen: Vec<(f64, f64)> = records
            .flat_map(|r| r.samples.iter())
            .map(|s| plane.see(&s.axis))
            .collect();
        let (x, y) = match within {
            Some(angle) => {
                let radius = trunnion_geometry::math::sin(rad(angle));
                ([-radius, radius], [-radius, radius])
            }
            // the pole is part of the picture
            None => (
                range(seen.iter().map(|p| p.0).chain([0.0]), 1e-4),
                range(seen.iter().map(|p| p.1).chain([0.0]), 1e-4),
            ),
        };
        let (x, y) = equal(x, y, body.dim_in_pixel(), 0.0);
        let (across, upwards) = (
            format!("{} of the tool axis (unit vector, no unit)", plane.names[0]),
            format!("{} of the tool axis (no unit)", plane.names[1]),
        );
        let panel = Panel::new(
            body,
            &Frame {
                x,
                y,
                x_name: Some(&across),
                y_name: &upwards,
                labels: [10, 8],
                decades: false,
                right: 0.0,
            },
        )?;
        let net = Net::new(x, y);
        plane.draw_lines(&panel, &net)?;
        draw_curve(&panel, &plane, record, BLUE)?;
        if let Some(after) = after {
            draw_curve(&panel, &plane, after, GREEN)?;
        }
        // nothing is drawn over the labels
        draw_marks(&panel, &plane, record, marks, &rules)?;
        plane.label(&panel, &net, widest(&rules))
    })
}

fn draw_curve(panel: &Panel<'_>, plane: &Plane<'_>, record: &Record, colour: RGBColor) -> Result<(), PlotError> {
    let mut points = Vec::new();
    let mut ends = Vec::new();
    for block in record.blocks.iter().filter(|block| !block.rapid) {
        if !block.joined {
            points.push((f64::NAN, f64::NAN));
        }
        points.extend(record.of(block).iter().map(|sample| plane.see(&sample.axis)));
        ends.extend(record.of(block).last().map(|sample| plane.see(&sample.axis)));
    }
    panel.line(points.into_iter(), colour, 2.0)?;
    if ends.len() <= 2000 {
        panel.dots(ends.into_iter(), colour, 3.0)?;
    }
    Ok(())
}

/// The radius of the symbols of a rule, pixels: those of several rules in one place stand about each other.
fn radius(place: usize) -> f64 {
    6.0 + 2.5 * place as f64
}

/// The radius of the largest symbol.
fn widest(rules: &Rules) -> f64 {
    radius(rules.drawn.len().saturating_sub(1))
}

fn draw_marks(
    panel: &Panel<'_>,
    plane: &Plane<'_>,
    record: &Record,
    marks: &[Mark],
    rules: &Rules,
) -> Result<(), PlotError> {
    let widest = widest(rules);
    let lines = record.by_line();
    let mut groups = Groups::default();
    for (place, marked) in rules.drawn.iter().enumerate() {
        let mut spots = Vec::new();
        for mark in marks.iter().filter(|mark| mark.rule == marked.rule) {
            for block in lines.of(mark.line) {
                let Some(end) = record.of(block).last() else { continue };
                let spot = plane.see(&end.axis);
                if panel.shows(spot) {
                    groups.add(mark.line, spot, panel.at(spot.0, spot.1), 1.2 * f64::from(px(widest)));
                    spots.push(spot);
                }
            }
        }
        panel.symbols(spots.into_iter(), marked, radius(place), false)?;
    }
    for (spot, _) in groups.all() {
        panel.keep_free(*spot, widest);
    }
    for (spot, group) in groups.all() {
        panel.text(*spot, &group.text(), INK, (HPos::Left, VPos::Bottom), widest)?;
    }
    Ok(())
}

/// The plane at right angles to the first rotary axis.
struct Plane<'m> {
    machine: &'m Machine,
    across: Vec3,
    upwards: Vec3,
    names: [&'static str; 2],
    /// Second rotary joint at the pole, rad.
    at_pole: f64,
    /// deg.
    cone: f64,
}

impl<'m> Plane<'m> {
    fn new(machine: &'m Machine) -> Result<Self, PlotError> {
        if !machine.constants.has_pair() {
            return Err(PlotError(format!(
                "the tool axis plot needs two rotary axes; {} has {}",
                machine.id,
                machine.rotary.len()
            )));
        }
        let pole = machine.axes[machine.rotary[0]].direction;
        let (across, names) = if pole.z.abs() > 0.9 {
            (Vec3::x(), ["i", "j"])
        } else if pole.x.abs() > 0.9 {
            (Vec3::y(), ["j", "k"])
        } else if pole.y.abs() > 0.9 {
            (Vec3::z(), ["k", "i"])
        } else {
            (Vec3::x(), ["component across", "component upwards"])
        };
        let across = (across - pole * pole.dot(&across)).normalize();
        let mut upwards = pole.cross(&across);
        if pole.sum() < 0.0 {
            // i and j (or k) both increase whatever the direction of the axis
            upwards = -upwards;
        }
        let at_pole = match orientations(machine, &pole) {
            Orientations::Pole(q) => q,
            _ => 0.0,
        };
        Ok(Self {
            machine,
            across,
            upwards,
            names,
            at_pole,
            cone: deg(machine.tolerances.pole_cone),
        })
    }

    fn see(&self, axis: &Vec3) -> (f64, f64) {
        (self.across.dot(axis), self.upwards.dot(axis))
    }

    fn letter(&self, slot: usize) -> char {
        char::from(self.machine.axes[self.machine.rotary[slot]].letter)
    }

    /// Where the tool axis is seen at rotary joints given in rad: turn, and tilt from the pole.
    fn joints(&self, turn: f64, tilt: f64) -> (f64, f64) {
        self.see(&tool_axis_at(self.machine, [turn, self.at_pole + tilt]))
    }

    /// The pole cone, circles of equal tilt, rays of equal turn.
    fn draw_lines(&self, panel: &Panel<'_>, net: &Net) -> Result<(), PlotError> {
        if net.near {
            panel.fill(
                (0..=72).map(|i| self.joints(TAU * f64::from(i) / 72.0, rad(self.cone))),
                PALE,
                0.8,
            )?;
        }
        for circle in 1..=net.circles {
            let tilt = rad(net.step * f64::from(circle));
            let round = (0..=180).map(|i| self.joints(TAU * f64::from(i) / 180.0, tilt));
            panel.dashed(round, RGBColor(190, 190, 190), 1.0)?;
        }
        for ray in (0..360).step_by(15) {
            let turn = rad(f64::from(ray));
            let points = (0..=24).map(|i| self.joints(turn, net.widest * f64::from(i) / 24.0));
            panel.line(points, RAY, if ray % 45 == 0 { 1.4 } else { 0.8 })?;
        }
        if net.near {
            panel.dots(core::iter::once((0.0, 0.0)), VERMILION, 3.5)?;
        }
        Ok(())
    }

    /// The values of rays and circles, and the name of the pole, at which there may be symbols of this radius.
    fn label(&self, panel: &Panel<'_>, net: &Net, symbol: f64) -> Result<(), PlotError> {
        if net.near {
            panel.text((0.0, 0.0), "pole", VERMILION, (HPos::Right, VPos::Top), symbol)?;
        }
        let Net { x, y, .. } = *net;
        let (dx, dy) = (0.045 * (x[1] - x[0]), 0.035 * (y[1] - y[0]));
        let inside = |p: (f64, f64)| p.0 > x[0] + dx && p.0 < x[1] - dx && p.1 > y[0] + dy && p.1 < y[1] - dy;
        let mut labelled: Vec<(f64, f64)> = Vec::new();
        // the main directions first, so that they keep their labels where rays are dense
        for ray in (0..360)
            .step_by(90)
            .chain((0..360).step_by(15).filter(|ray| ray % 90 != 0))
        {
            let shown = if ray > 180 { ray - 360 } else { ray };
            let mut place = (1..=200).map(|i| self.joints(rad(f64::from(ray)), net.widest * f64::from(i) / 200.0));
            let Some(last) = place.rfind(|p| inside(*p)) else {
                continue;
            };
            let crowded = |p: &(f64, f64)| (p.0 - last.0).abs() < 1.2 * dx && (p.1 - last.1).abs() < dy;
            if labelled.iter().any(crowded) {
                continue;
            }
            labelled.push(last);
            let text = format!("{}{shown}\u{b0}", self.letter(0)).replace('-', "\u{2212}");
            let (place, side) = beside_rim(last);
            panel.text(place, &text, RGBColor(50, 105, 155), (side, VPos::Center), 0.0)?;
        }
        // the values of the circles on the ray with the most room, away from the rays' labels
        let room = |ray: i32| {
            let tilts =
                (1..=net.circles).filter(|c| inside(self.joints(rad(f64::from(ray)), rad(net.step * f64::from(*c)))));
            tilts.count()
        };
        let Some(best) = (0..24).map(|i| i * 15 + 7).max_by_key(|ray| room(*ray)) else {
            return Ok(());
        };
        for circle in 1..=net.circles {
            let tilt = net.step * f64::from(circle);
            let place = self.joints(rad(f64::from(best)), rad(tilt));
            if inside(place) {
                let value = trim(deg(self.at_pole) + tilt);
                panel.text(
                    place,
                    &format!("{}{value}\u{b0}", self.letter(1)),
                    GREY,
                    (HPos::Center, VPos::Center),
                    0.0,
                )?;
            }
        }
        Ok(())
    }
}

/// A number of degrees without needless zeros.
fn trim(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0')
        .trim_end_matches('.')
        .replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::AxisLetters;
    use crate::texts::{header, overlaps, record};
    use trunnion_machine::builtin;

    #[test]
    fn a_table_machine_is_seen_in_i_and_j() {
        let machine = builtin("mikron-ucp710").expect("built in");
        let plane = Plane::new(machine).expect("two rotary axes");
        assert_eq!(plane.names, ["i", "j"]);
        let (i, j) = plane.see(&Vec3::new(0.3, -0.4, 0.86));
        assert!((i - 0.3).abs() < 1e-12 && (j + 0.4).abs() < 1e-12);
        // u = (sin A sin C, -sin A cos C, cos A)
        let (i, j) = plane.joints(rad(90.0), rad(30.0));
        assert!((i - 0.5).abs() < 1e-12 && j.abs() < 1e-12);
    }

    /// On every machine with a pole, however near it is looked at, and with many findings.
    #[test]
    fn labels_at_the_pole_do_not_overlap() {
        let mut seen = 0;
        for name in trunnion_machine::BUILTIN_MACHINES {
            let machine = builtin(name).expect("built in");
            let Ok(plane) = Plane::new(machine) else { continue };
            for widest in [0.05, 0.4, 3.0, 20.0, 85.0] {
                let axis = |step: usize| {
                    let share = step as f64 / 40.0;
                    let tilt = plane.at_pole + rad(widest * (2.0 * share - 1.0));
                    tool_axis_at(machine, [rad(30.0 + 60.0 * share), tilt])
                };
                let moves: Vec<(char, Vec3)> = (0..=40).map(|i| ('f', Vec3::new(f64::from(i), 0.0, 0.0))).collect();
                let record = record(&moves, axis);
                let rules = [
                    "pole-flip",
                    "fast-pole",
                    "feed-drop",
                    "axis-overspeed",
                    "branch-swap",
                    "axis-limit",
                ];
                let marks: Vec<Mark> = (1..=40)
                    .flat_map(|line| rules.into_iter().take(line as usize % 7).map(move |rule| (line, rule)))
                    .map(|(line, rule)| Mark {
                        line,
                        rule,
                        axes: AxisLetters::default(),
                    })
                    .collect();
                for within in [
                    None,
                    Some(0.5 * widest),
                    Some(2.0 * widest).filter(|angle| *angle < 90.0),
                ] {
                    let svg = axis_plane(&header(), machine, &record, &marks, None, within).expect("drawn");
                    assert_eq!(overlaps(&svg), [], "{name}, {widest} deg, within {within:?}");
                    seen += 1;
                }
            }
        }
        assert!(seen > 100, "{seen} pictures");
    }

    #[test]
    fn a_mill_without_rotary_axes_is_refused() {
        let machine = builtin("mill-3axis").expect("built in");
        assert!(
            Plane::new(machine)
                .err()
                .expect("refused")
                .0
                .contains("two rotary axes")
        );
    }
}
