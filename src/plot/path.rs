//! The path of the tool tip in space: isometric with three views beside it, or in its plane where it lies in one.
use crate::canvas::{Area, BLUE, Entry, GREY, Header, ORANGE, PlotError, Swatch, VERMILION, px, sheet};
use crate::grid::{Frame, Panel, equal};
use crate::isometric::{draw_box, draw_scale, see};
use crate::record::{Block, Record};
use crate::scale::{counted, range};
use trunnion_geometry::Vec3;

/// Draws it. `tolerance`: blocks whose tip deviates farther are drawn in another colour, mm.
///
/// # Errors
/// No path is known.
pub fn path(header: &Header, record: &Record, tolerance: f64) -> Result<String, PlotError> {
    if record.samples.is_empty() {
        return Err(PlotError("nothing to draw: no path is known".into()));
    }
    let part = Part::of(record, tolerance);
    let legend = part.legend();
    sheet(header, &legend, |body| {
        if let Some(view) = part.flat() {
            return part.draw_plane(body, view, None);
        }
        let (width, height) = body.dim_in_pixel();
        let (left, right) = body.split_horizontally(width as i32 - px(BESIDE));
        part.draw_space(&left)?;
        let each = height as i32 / 3;
        for ((view, name), top) in VIEWS.into_iter().zip([0, each, 2 * each]) {
            let field = right.clone().shrink((0, top), (px(BESIDE) as u32, each as u32));
            part.draw_plane(&field, view, Some(name))?;
        }
        Ok(())
    })
}

/// Room for the three views beside the isometric one, pixels.
const BESIDE: f64 = 440.0;

/// The coordinates that stand across and upwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct View {
    across: usize,
    upwards: usize,
}

/// The three views of a drawing.
const VIEWS: [(View, &str); 3] = [
    (View { across: 0, upwards: 1 }, "from above"),
    (View { across: 0, upwards: 2 }, "from the front"),
    (View { across: 1, upwards: 2 }, "from the right"),
];

/// What is thinner has no extent in that direction, mm.
const THIN: f64 = 1e-6;

/// What is shorter is seen as a point, mm.
const END_ON: f64 = 1e-4;

/// A path and the box about it.
struct Part<'r> {
    record: &'r Record,
    /// The box about the cuts, mm; without cuts, or where all are in one point, about everything.
    low: Vec3,
    high: Vec3,
    /// Ends of rapids near the box: all that is shown lies in it or is one of them.
    near: Vec<Vec3>,
    /// Rapids that begin or end farther away: the frame cuts them off.
    cut_off: usize,
    /// The tool axis turns: else it says nothing, and looks like moves.
    tilts: bool,
    tolerance: f64,
}

impl<'r> Part<'r> {
    fn of(record: &'r Record, tolerance: f64) -> Self {
        let tips = |rapid: bool| {
            let blocks = record.blocks.iter().filter(move |block| block.rapid == rapid);
            blocks.flat_map(move |block| record.of(block)).map(|sample| sample.tip)
        };
        let (mut low, mut high) = extent(tips(false));
        if (high - low).max() <= THIN {
            (low, high) = extent(record.samples.iter().map(|sample| sample.tip));
        }
        // a rapid from far away must not make the part small: it is cut off at the edge
        let reach = 0.35 * (high - low).norm();
        let is_near = |tip: &Vec3| (tip - tip.sup(&low).inf(&high)).norm() < reach;
        let rapids = record.blocks.iter().filter(|block| block.rapid);
        let cut_off = rapids.filter(|block| !record.of(block).iter().all(|sample| is_near(&sample.tip)));
        let first = record.samples.first().map_or(Vec3::z(), |sample| sample.axis);
        Self {
            near: tips(true).filter(is_near).collect(),
            cut_off: cut_off.count(),
            tilts: record.samples.iter().any(|sample| (sample.axis - first).norm() > 1e-9),
            record,
            low,
            high,
            tolerance,
        }
    }

    fn legend(&self) -> Vec<Entry> {
        let record = self.record;
        let mut legend: Vec<Entry> = vec![(Swatch::Line(BLUE), "feed".into())];
        let views = self
            .flat()
            .map_or_else(|| VIEWS.map(|view| view.0).to_vec(), |view| vec![view]);
        if views.iter().any(|view| self.end_on(*view).next().is_some()) {
            legend.push((Swatch::Dot(BLUE), "feed seen end-on (hole, plunge)".into()));
        }
        let rapids = record.blocks.iter().filter(|block| block.rapid).count();
        let cut_off = match self.cut_off {
            0 => String::new(),
            some => format!(" ({some} of {rapids} reach beyond a view)"),
        };
        legend.push((Swatch::Dashed(GREY), format!("rapid{cut_off}")));
        if self.tilts {
            legend.push((Swatch::Line(ORANGE), "tool axis".into()));
        }
        let straying = record
            .blocks
            .iter()
            .filter(|block| strays(block, self.tolerance))
            .count();
        if straying > 0 {
            let (limit, blocks) = (record.unit.declared(self.tolerance), counted(straying, "block"));
            legend.push((
                Swatch::Line(VERMILION),
                format!("deviates more than {limit} ({blocks})"),
            ));
        }
        legend.extend(record.not_drawn().map(|text| (Swatch::Plain, text)));
        legend
    }

    /// Cuts along the line of sight: each is a point.
    fn end_on(&self, view: View) -> impl Iterator<Item = Vec3> {
        let seen = move |from: &Vec3, tip: &Vec3| {
            let [across, upwards] = [view.across, view.upwards].map(|axis| (tip[axis] - from[axis]).abs());
            across.max(upwards)
        };
        let cuts = self.record.blocks.iter().filter(|block| !block.rapid);
        cuts.filter_map(move |block| {
            let samples = self.record.of(block);
            let from = samples.first()?.tip;
            let moves = samples.iter().any(|sample| (sample.tip - from).norm() > 1e-3);
            (moves && samples.iter().all(|sample| seen(&from, &sample.tip) <= END_ON)).then_some(from)
        })
    }

    fn size(&self) -> f64 {
        (self.high - self.low).norm().max(1e-3)
    }

    /// The plane in which everything lies. Along a lathe's tool, not Z, is upwards.
    fn flat(&self) -> Option<View> {
        let (low, high) = extent(self.near.iter().copied().chain([self.low, self.high]));
        let thin = [1, 0, 2].into_iter().find(|axis| high[*axis] - low[*axis] <= THIN)?;
        let [across, upwards] = [[1, 2], [0, 2], [0, 1]][thin];
        let along = |axis: usize| {
            self.record
                .samples
                .iter()
                .map(|sample| sample.axis[axis].abs())
                .fold(0.0, f64::max)
        };
        Some(if along(across) > 0.9 && along(upwards) < 0.1 {
            View {
                across: upwards,
                upwards: across,
            }
        } else {
            View { across, upwards }
        })
    }

    /// The corners of the box, and the ends near it.
    fn corners(&self) -> impl Iterator<Item = Vec3> {
        let corner = |i: usize| {
            Vec3::from_fn(|axis, _| {
                if i & (1 << axis) == 0 {
                    self.low[axis]
                } else {
                    self.high[axis]
                }
            })
        };
        (0..8).map(corner).chain(self.near.iter().copied())
    }

    /// Seen isometrically, with a box that has a scale.
    fn draw_space(&self, area: &Area<'_>) -> Result<(), PlotError> {
        let panel = Panel::bare(area, self.corners().map(|corner| see(&corner)));
        let names = LETTERS.map(|letter| self.record.axis_name(letter));
        draw_box(&panel, &self.low, &self.high)?;
        self.draw(&panel, see)?;
        // last: lines pass behind the texts
        draw_scale(&panel, (self.record.unit, &names), &self.low, &self.high)
    }

    /// Seen at right angles to a plane, with the name of the view where there are several.
    fn draw_plane(&self, area: &Area<'_>, view: View, name: Option<&str>) -> Result<(), PlotError> {
        let unit = self.record.unit;
        let see = |p: &Vec3| (unit.of_mm(p[view.across]), unit.of_mm(p[view.upwards]));
        let least = unit.of_mm(0.02 * self.size());
        let x = range(self.corners().map(|corner| see(&corner).0), least);
        let y = range(self.corners().map(|corner| see(&corner).1), least);
        let (x, y) = equal(x, y, area.dim_in_pixel(), 0.0);
        let [mut across, upwards] = [view.across, view.upwards]
            .map(|axis| format!("{} / {}", self.record.axis_name(LETTERS[axis]), unit.name()));
        if let Some(name) = name {
            across = format!("{across} (seen {name})");
        }
        let frame = Frame {
            x,
            y,
            x_name: Some(&across),
            y_name: &upwards,
            labels: if name.is_some() { [5, 4] } else { [10, 8] },
            decades: false,
            right: 0.0,
        };
        let panel = Panel::new(area, &frame)?;
        self.draw(&panel, see)?;
        panel.dots(self.end_on(view).map(|tip| see(&tip)), BLUE, 3.0)
    }

    /// The tool axis, rapids, and cuts, as a view sees them.
    fn draw(&self, panel: &Panel<'_>, see: impl Fn(&Vec3) -> (f64, f64)) -> Result<(), PlotError> {
        let record = self.record;
        if self.tilts {
            draw_axes(panel, record, self.size(), &see)?;
        }
        for rapid in [true, false] {
            let mut points = Vec::new();
            for block in &record.blocks {
                if block.rapid == rapid && !strays(block, self.tolerance) {
                    if !block.joined {
                        points.push((f64::NAN, f64::NAN));
                    }
                    points.extend(record.of(block).iter().map(|sample| see(&sample.tip)));
                } else {
                    points.push((f64::NAN, f64::NAN));
                }
            }
            if rapid {
                panel.dashed(points.into_iter(), GREY, 1.2)?;
            } else {
                panel.line(points.into_iter(), BLUE, 1.5)?;
            }
        }
        for block in record.blocks.iter().filter(|block| strays(block, self.tolerance)) {
            panel.line(record.of(block).iter().map(|sample| see(&sample.tip)), VERMILION, 1.5)?;
        }
        Ok(())
    }
}

/// A cut whose tip deviates farther than the tolerance.
fn strays(block: &Block, tolerance: f64) -> bool {
    !block.rapid && block.deviation.is_some_and(|[most, _]| most > tolerance)
}

/// The coordinates.
const LETTERS: [char; 3] = ['X', 'Y', 'Z'];

fn extent(points: impl Iterator<Item = Vec3>) -> (Vec3, Vec3) {
    let empty = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    points
        .filter(|point| point.iter().all(|value| value.is_finite()))
        .fold(empty, |(low, high), point| (low.inf(&point), high.sup(&point)))
}

/// The tool axis at some of the feed samples, evenly along the path.
fn draw_axes(flat: &Panel<'_>, record: &Record, size: f64, see: impl Fn(&Vec3) -> (f64, f64)) -> Result<(), PlotError> {
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
mod tests;
