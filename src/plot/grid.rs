//! One field of a picture: axes with ticks and units, and drawing in the units of the data.
mod text;

use crate::canvas::{Area, GREY, PALE, PlotError, SCALE, draw_symbol, font, px};
use crate::dash::{dashed, distinct};
use crate::labels::Labels;
use crate::marks::Marked;
use crate::runs::Runs;
use crate::scale::{power, short};
use crate::thin::{clip, thin};
use plotters::prelude::*;
use std::collections::HashSet;

/// How a field is framed.
pub(crate) struct Frame<'t> {
    /// Lowest and highest value across.
    pub(crate) x: [f64; 2],
    /// Lowest and highest value upwards; powers of ten where `decades` is set.
    pub(crate) y: [f64; 2],
    /// Name and unit across; `None`: no labels below.
    pub(crate) x_name: Option<&'t str>,
    /// Name and unit upwards.
    pub(crate) y_name: &'t str,
    /// Approximate number of labels across and upwards.
    pub(crate) labels: [usize; 2],
    /// The values upwards are exponents of ten.
    pub(crate) decades: bool,
    /// Room at the right, pixels.
    pub(crate) right: f64,
}

/// A framed field.
pub(crate) struct Panel<'a> {
    area: Area<'a>,
    /// The area that the frame was drawn on: what is outside the field is drawn there.
    around: Area<'a>,
    x: [f64; 2],
    y: [f64; 2],
    width: f64,
    height: f64,
    labels: Labels,
}

/// Room for the labels at the left and below, pixels.
const LEFT: f64 = 78.0;
const BELOW: f64 = 50.0;
/// Room at the right for half of the last label below, at the top, and below the labels, pixels.
const RIGHT: f64 = 26.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 4.0;

/// A line that is longer than so many times width and height of its field is not dashed.
const MOST_DASHED: f64 = 40.0;

/// A line of more points runs over itself: segments that were there before are left out.
const CROWDED: usize = 20_000;

/// Length of a polyline.
fn length(points: &[(f64, f64)]) -> f64 {
    let parts = points
        .windows(2)
        .map(|two| trunnion_geometry::math::hypot(two[1].0 - two[0].0, two[1].1 - two[0].1));
    parts.sum()
}

/// Ranges of equal scale about the given ones for the field of an area of this size (with labels at left and below).
pub(crate) fn equal(x: [f64; 2], y: [f64; 2], size: (u32, u32), right: f64) -> ([f64; 2], [f64; 2]) {
    let scale = f64::from(SCALE);
    let (width, height) = (
        f64::from(size.0) / scale - LEFT - RIGHT - right,
        f64::from(size.1) / scale - BELOW - TOP - BOTTOM,
    );
    let per_px = ((x[1] - x[0]) / width).max((y[1] - y[0]) / height);
    let about = |range: [f64; 2], pixels: f64| {
        let (middle, half) = (0.5 * (range[0] + range[1]), 0.5 * per_px * pixels);
        [middle - half, middle + half]
    };
    (about(x, width), about(y, height))
}

impl<'a> Panel<'a> {
    /// Draws the frame on an area.
    pub(crate) fn new(area: &Area<'a>, frame: &Frame<'_>) -> Result<Self, PlotError> {
        let below = if frame.x_name.is_some() { BELOW } else { 6.0 };
        let mut builder = ChartBuilder::on(area);
        builder
            .margin_top(px(TOP))
            .margin_left(px(12.0))
            .margin_bottom(px(BOTTOM))
            .margin_right(px(frame.right + RIGHT))
            .x_label_area_size(px(below))
            .y_label_area_size(px(LEFT - 12.0));
        let ([x0, x1], [y0, y1]) = (frame.x, frame.y);
        let mut chart = builder.build_cartesian_2d(x0..x1, y0..y1)?;
        let (across, upwards) = (x1 - x0, y1 - y0);
        let name_x = |value: &f64| short(*value, across);
        let name_y = |value: &f64| {
            if !frame.decades {
                short(*value, upwards)
            } else if (value - value.round()).abs() < 1e-6 {
                power(value.round() as i32)
            } else {
                String::new()
            }
        };
        let mut mesh = chart.configure_mesh();
        mesh.x_labels(frame.labels[0])
            .y_labels(frame.labels[1])
            .x_label_formatter(&name_x)
            .y_label_formatter(&name_y)
            .label_style(font(13.0))
            .axis_desc_style(font(14.0))
            .axis_style(GREY.stroke_width(px(1.0) as u32))
            .bold_line_style(PALE.stroke_width(px(0.8) as u32))
            .light_line_style(TRANSPARENT)
            .set_all_tick_mark_size(px(4.0))
            .y_desc(frame.y_name);
        match frame.x_name {
            Some(name) => mesh.x_desc(name),
            None => mesh.x_label_formatter(&|_| String::new()),
        };
        mesh.draw()?;
        let plotting = chart.plotting_area().strip_coord_spec();
        let (width, height) = plotting.dim_in_pixel();
        Ok(Self {
            area: plotting,
            around: area.clone(),
            x: frame.x,
            y: frame.y,
            width: f64::from(width),
            height: f64::from(height),
            labels: Labels::default(),
        })
    }

    /// A field without a frame and with equal scales, as large as the points need.
    pub(crate) fn bare(area: &Area<'a>, points: impl Iterator<Item = (f64, f64)>) -> Self {
        let empty = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let [x, y] = points.fold(empty, |[x, y], p| {
            [[x[0].min(p.0), x[1].max(p.0)], [y[0].min(p.1), y[1].max(p.1)]]
        });
        let area = area.margin(px(16.0), px(48.0), px(48.0), px(48.0));
        let (width, height) = area.dim_in_pixel();
        let (width, height) = (f64::from(width), f64::from(height));
        // labels need room around the points
        let per = ((x[1] - x[0]) / (0.9 * width))
            .max((y[1] - y[0]) / (0.88 * height))
            .max(1e-9);
        let about = |range: [f64; 2], pixels: f64| {
            let (middle, half) = (0.5 * (range[0] + range[1]), 0.5 * per * pixels);
            [middle - half, middle + half]
        };
        Self {
            around: area.clone(),
            area,
            x: about(x, width),
            y: about(y, height),
            width,
            height,
            labels: Labels::default(),
        }
    }

    /// Place of a value on the field.
    pub(crate) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            (x - self.x[0]) / (self.x[1] - self.x[0]) * self.width,
            (self.y[1] - y) / (self.y[1] - self.y[0]) * self.height,
        )
    }

    fn whole(p: (f64, f64)) -> (i32, i32) {
        (p.0.round() as i32, p.1.round() as i32)
    }

    fn holds(&self, p: (f64, f64)) -> bool {
        p.0 >= -1.0 && p.0 <= self.width + 1.0 && p.1 >= -1.0 && p.1 <= self.height + 1.0
    }

    /// The parts of a polyline inside the field, thinned.
    fn visible(&self, points: impl Iterator<Item = (f64, f64)>) -> Vec<Vec<(f64, f64)>> {
        let mut runs = Runs::default();
        let mut open: Vec<(f64, f64)> = Vec::new();
        let mut before: Option<(f64, f64)> = None;
        for (x, y) in points {
            let p = self.at(x, y);
            if !(p.0.is_finite() && p.1.is_finite()) {
                before = None;
                runs.add(std::mem::take(&mut open));
                continue;
            }
            match before {
                None => open.extend(self.holds(p).then_some(p)),
                Some(from) => {
                    if let Some((a, b)) = clip(from, p, (self.width, self.height)) {
                        if open.last() != Some(&a) {
                            runs.add(std::mem::take(&mut open));
                            open.push(a);
                        }
                        open.push(b);
                    }
                }
            }
            before = Some(p);
        }
        runs.add(open);
        runs.finish()
    }

    /// A line.
    pub(crate) fn line(
        &self,
        points: impl Iterator<Item = (f64, f64)>,
        colour: RGBColor,
        pixels: f64,
    ) -> Result<(), PlotError> {
        let mut runs = self.visible(points);
        if runs.iter().map(Vec::len).sum::<usize>() > CROWDED {
            runs = distinct(runs);
        }
        let runs = runs.into_iter().map(|run| run.into_iter().map(Self::whole).collect());
        self.strokes(runs, colour, pixels)
    }

    /// A dashed line, which stays dashed where it goes to and fro.
    pub(crate) fn dashed(
        &self,
        points: impl Iterator<Item = (f64, f64)>,
        colour: RGBColor,
        pixels: f64,
    ) -> Result<(), PlotError> {
        let runs = distinct(self.visible(points));
        let length: f64 = runs.iter().map(|run| length(run)).sum();
        if length > MOST_DASHED * (self.width + self.height) {
            // it fills the field: dashes would not be told apart, and each is an element of its own
            let whole = runs.into_iter().map(|run| run.into_iter().map(Self::whole).collect());
            return self.strokes(whole, colour, 0.5 * pixels);
        }
        self.strokes(dashed(&runs, 7.0, 5.0).into_iter(), colour, pixels)
    }

    fn strokes(
        &self,
        runs: impl Iterator<Item = Vec<(i32, i32)>>,
        colour: RGBColor,
        pixels: f64,
    ) -> Result<(), PlotError> {
        let style = colour.stroke_width(px(pixels) as u32);
        for run in runs {
            self.area.draw(&PathElement::new(run, style))?;
        }
        Ok(())
    }

    /// Where points of a symbol of this radius are drawn: those that would hide each other once.
    fn spots(&self, points: impl Iterator<Item = (f64, f64)>, pixels: f64) -> Vec<(i32, i32)> {
        let cell = 0.5 * f64::from(px(pixels));
        let mut taken = HashSet::new();
        let mut spots = Vec::new();
        for (x, y) in points {
            let p = self.at(x, y);
            if self.holds(p) && taken.insert([p.0, p.1].map(|way| (way / cell).floor() as i64)) {
                spots.push(Self::whole(p));
            }
        }
        spots
    }

    /// Dots.
    pub(crate) fn dots(
        &self,
        points: impl Iterator<Item = (f64, f64)>,
        colour: RGBColor,
        pixels: f64,
    ) -> Result<(), PlotError> {
        for spot in self.spots(points, pixels) {
            let spot = self.outward(spot);
            self.around.draw(&Circle::new(spot, px(pixels), colour.filled()))?;
        }
        Ok(())
    }

    /// The symbols of a rule, filled or as outlines.
    pub(crate) fn symbols(
        &self,
        points: impl Iterator<Item = (f64, f64)>,
        look: &Marked,
        pixels: f64,
        filled: bool,
    ) -> Result<(), PlotError> {
        for spot in self.spots(points, pixels) {
            let spot = self.outward(spot);
            draw_symbol(&self.around, spot, (look.shape, look.colour), pixels, filled)?;
        }
        Ok(())
    }

    /// A value is on the field.
    pub(crate) fn shows(&self, (x, y): (f64, f64)) -> bool {
        self.holds(self.at(x, y))
    }

    /// A ring about a place.
    pub(crate) fn ring(&self, x: f64, y: f64, colour: RGBColor, pixels: f64) -> Result<(), PlotError> {
        let p = self.at(x, y);
        if self.holds(p) {
            self.around.draw(&Circle::new(
                self.outward(Self::whole(p)),
                px(pixels),
                colour.stroke_width(px(2.0) as u32),
            ))?;
        }
        Ok(())
    }

    /// A filled polygon, held to the field.
    pub(crate) fn fill(
        &self,
        points: impl Iterator<Item = (f64, f64)>,
        colour: RGBColor,
        opacity: f64,
    ) -> Result<(), PlotError> {
        let points: Vec<(f64, f64)> = points
            .map(|(x, y)| self.at(x, y))
            .map(|(x, y)| (x.clamp(0.0, self.width), y.clamp(0.0, self.height)))
            .collect();
        let points = thin(&points).into_iter().map(Self::whole).collect::<Vec<_>>();
        self.area.draw(&Polygon::new(points, colour.mix(opacity)))?;
        Ok(())
    }

    /// Width and height of the field, tenths of a pixel.
    pub(crate) fn size(&self) -> (f64, f64) {
        (self.width, self.height)
    }

    /// Place on the area around the field of a place on the field: what is drawn there is not cut off at the edge of the field.
    fn outward(&self, p: (i32, i32)) -> (i32, i32) {
        let (own, around) = (self.area.get_base_pixel(), self.around.get_base_pixel());
        (p.0 + own.0 - around.0, p.1 + own.1 - around.1)
    }

    /// Place of a value on the area around the field.
    fn beside(&self, (x, y): (f64, f64)) -> (i32, i32) {
        self.outward(Self::whole(self.at(x, y)))
    }

    /// A filled polygon that may be outside the field.
    pub(crate) fn fill_outside(&self, points: &[(f64, f64)], colour: RGBColor) -> Result<(), PlotError> {
        let points: Vec<(i32, i32)> = points.iter().map(|p| self.beside(*p)).collect();
        self.around.draw(&Polygon::new(points, colour.filled()))?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::axis_plane;
    use crate::record::{AxisLetters, Mark};
    use crate::texts::{header, record};
    use trunnion_geometry::{Vec3, rad};
    use trunnion_machine::{builtin, tool_axis_at};

    /// Half a million blocks that go to and fro made a picture of 400 MB.
    #[test]
    fn symbols_that_lie_on_each_other_are_drawn_once() {
        let machine = builtin("mikron-ucp710").expect("built in");
        let size = |count: u32| {
            let axis = |step: usize| {
                tool_axis_at(
                    machine,
                    [rad(30.0), rad(if step.is_multiple_of(2) { -5.0 } else { -20.0 })],
                )
            };
            let moves: Vec<(char, Vec3)> = (0..=count)
                .map(|i| ('f', Vec3::new(f64::from(i % 9), 0.0, 0.0)))
                .collect();
            let mark = |line| Mark {
                line,
                rule: "pole-flip",
                axes: AxisLetters::default(),
            };
            let marks: Vec<Mark> = (1..=count).map(mark).collect();
            let svg = axis_plane(&header(), machine, &record(&moves, axis), &marks, None, None).expect("drawn");
            // closed outlines of 32 corners
            svg.lines().filter(|line| line.split(',').count() > 32).count()
        };
        assert_eq!(size(2000), size(20));
    }
}
