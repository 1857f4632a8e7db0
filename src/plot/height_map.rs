//! The error of a trajectory surface as a map: how far the tool deviates over the required surface, with the real path on top.
use crate::canvas::{Entry, Header, INK, PlotError, SCALE, Swatch, sheet};
use crate::grid::{Frame, Panel, equal};
use crate::scale::{range, short};
use crate::unit::Unit;
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};
use trunnion_geometry::Vec3;
use trunnion_surface::{Errors, Found, PictureSample};

/// Cells of the map across its longer side.
const CELLS: usize = 150;
/// Steps of the colour scale.
const LEVELS: usize = 20;
/// Room for the colour bar, pixels.
const BAR: f64 = 120.0;

/// Blocks whose ends are farther apart do not follow each other, mm.
const JOINT: f64 = 1e-3;

/// From pale (no error) to dark (largest): lightness falls evenly, so it reads in grey and with any colour vision.
const SCALE_STOPS: [(u8, u8, u8); 6] = [
    (255, 250, 225),
    (254, 217, 118),
    (253, 160, 70),
    (230, 85, 35),
    (170, 20, 40),
    (75, 0, 45),
];

/// Draws the spots of `errors` seen along the axis `along` (0 X, 1 Y, 2 Z) of the part, with lengths in `unit`.
///
/// # Errors
/// There are no spots.
pub fn height_map(header: &Header, errors: &Errors, along: usize, unit: Unit) -> Result<String, PlotError> {
    if errors.spots.is_empty() {
        return Err(PlotError(
            "nothing to draw: no feed block could be compared with the surface".into(),
        ));
    }
    let view = View::new(along, unit);
    let worst = errors.spots.iter().fold(
        errors.spots[0],
        |worst, spot| if spot.error > worst.error { *spot } else { worst },
    );
    let found: Option<&Found> = if errors.placed > 0 {
        errors.same_place.as_ref()
    } else {
        errors.from_surface.as_ref()
    };
    let top = found
        .map_or(worst.error, |found| found.sampled.max(worst.error))
        .max(1e-9);
    let sense = if errors.placed > 0 {
        "distance of the tip from its nominal point"
    } else {
        "distance of the tip from the surface"
    };
    let legend: Vec<Entry> = vec![
        (Swatch::Filled(colour(1.0)), sense.to_owned()),
        (Swatch::Line(LINE), "real path of the tip".into()),
        (Swatch::Dot(INK), format!("largest error {}", unit.text(top, 4))),
    ];
    sheet(header, &legend, |body| {
        let places = || errors.spots.iter().map(|spot| view.see(&spot.place));
        let tips = || errors.spots.iter().map(|spot| view.see(&spot.tip));
        let x = range(places().chain(tips()).map(|p| p.0), unit.of_mm(1e-3));
        let y = range(places().chain(tips()).map(|p| p.1), unit.of_mm(1e-3));
        let (x, y) = equal(x, y, body.dim_in_pixel(), BAR);
        let names = view.names();
        let panel = Panel::new(
            body,
            &Frame {
                x,
                y,
                x_name: Some(&names[0]),
                y_name: &names[1],
                labels: [10, 8],
                decades: false,
                right: BAR,
            },
        )?;
        let map = Map::new(&errors.spots, &view);
        for (from, to, row, level) in map.runs(top) {
            let (a, b) = (map.corner(from, row), map.corner(to, row + 1));
            let corners = [(a.0, a.1), (b.0, a.1), (b.0, b.1), (a.0, b.1)];
            panel.fill(corners.into_iter(), colour(level as f64 / (LEVELS - 1) as f64), 1.0)?;
        }
        let mut path = Vec::new();
        let mut before: Option<&PictureSample> = None;
        for spot in &errors.spots {
            // blocks that are not compared lie between these two
            if before.is_some_and(|before| spot.leg != before.leg && (spot.tip - before.tip).norm() > JOINT) {
                path.push((f64::NAN, f64::NAN));
            }
            before = Some(spot);
            path.push(view.see(&spot.tip));
        }
        panel.line(path.into_iter(), LINE, 1.0)?;
        let at = view.see(&worst.tip);
        panel.dots(core::iter::once(at), INK, 4.5)?;
        panel.ring(at.0, at.1, INK, 9.0)?;
        colour_bar(&panel, x, y, unit.of_mm(top), unit)
    })
}

/// Colour of the path.
const LINE: RGBColor = RGBColor(40, 90, 140);

/// The colour of a share of the largest error.
fn colour(share: f64) -> RGBColor {
    let place = share.clamp(0.0, 1.0) * (SCALE_STOPS.len() - 1) as f64;
    let index = (place.floor() as usize).min(SCALE_STOPS.len() - 2);
    let t = place - index as f64;
    let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * t).round() as u8;
    let (a, b) = (SCALE_STOPS[index], SCALE_STOPS[index + 1]);
    RGBColor(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

fn colour_bar(panel: &Panel<'_>, x: [f64; 2], y: [f64; 2], top: f64, unit: Unit) -> Result<(), PlotError> {
    let per_px = (x[1] - x[0]) / panel.size().0 * f64::from(SCALE);
    let (left, right) = (x[1] + 24.0 * per_px, x[1] + 46.0 * per_px);
    let (low, high) = (y[0] + 0.05 * (y[1] - y[0]), y[1] - 0.1 * (y[1] - y[0]));
    for level in 0..LEVELS {
        let at = |i: usize| low + (high - low) * i as f64 / LEVELS as f64;
        let (a, b) = (at(level), at(level + 1));
        let corners = [(left, a), (right, a), (right, b), (left, b)];
        panel.fill_outside(&corners, colour(level as f64 / (LEVELS - 1) as f64))?;
    }
    for tick in 0..=4 {
        let value = top * f64::from(tick) / 4.0;
        let place = (right + 6.0 * per_px, low + (high - low) * f64::from(tick) / 4.0);
        panel.write_outside(place, &short(value, top), (HPos::Left, VPos::Center))?;
    }
    let name = format!("error / {}", unit.name());
    panel.write_outside((left, high + 16.0 * per_px), &name, (HPos::Left, VPos::Bottom))
}

/// A view along one axis of the part, in a unit.
struct View {
    across: usize,
    upwards: usize,
    unit: Unit,
}

impl View {
    fn new(along: usize, unit: Unit) -> Self {
        let (across, upwards) = [(1, 2), (0, 2), (0, 1)][along.min(2)];
        Self { across, upwards, unit }
    }
    fn see(&self, p: &Vec3) -> (f64, f64) {
        (self.unit.of_mm(p[self.across]), self.unit.of_mm(p[self.upwards]))
    }
    fn names(&self) -> [String; 2] {
        [self.across, self.upwards].map(|axis| format!("{} / {}", ['X', 'Y', 'Z'][axis], self.unit.name()))
    }
}

/// Errors in the cells of a lattice: that of the nearest spot, where one is near.
struct Map {
    low: (f64, f64),
    cell: f64,
    columns: usize,
    rows: usize,
    values: Vec<Option<f64>>,
}

impl Map {
    fn new(spots: &[PictureSample], view: &View) -> Self {
        let places: Vec<(f64, f64)> = spots.iter().map(|spot| view.see(&spot.place)).collect();
        let bounds = places.iter().fold([f64::MAX, f64::MAX, f64::MIN, f64::MIN], |b, p| {
            [b[0].min(p.0), b[1].min(p.1), b[2].max(p.0), b[3].max(p.1)]
        });
        let cell = ((bounds[2] - bounds[0]).max(bounds[3] - bounds[1]) / CELLS as f64).max(1e-6);
        let count = |low: f64, high: f64| ((high - low) / cell).ceil().max(1.0) as usize;
        let (columns, rows) = (count(bounds[0], bounds[2]), count(bounds[1], bounds[3]));
        let mut map = Self {
            low: (bounds[0], bounds[1]),
            cell,
            columns,
            rows,
            values: vec![None; columns * rows],
        };
        map.spread(spots, &places);
        map
    }

    /// Grows the spots outwards ring by ring, so that each cell takes the spot nearest to it (within a tenth of the map).
    fn spread(&mut self, spots: &[PictureSample], places: &[(f64, f64)]) {
        let reach = 0.1 * CELLS as f64 * self.cell;
        let mut owner: Vec<Option<(f64, usize)>> = vec![None; self.values.len()];
        let mut open = std::collections::VecDeque::new();
        for (index, place) in places.iter().enumerate() {
            let column = (((place.0 - self.low.0) / self.cell) as usize).min(self.columns - 1);
            let row = (((place.1 - self.low.1) / self.cell) as usize).min(self.rows - 1);
            self.claim(column, row, index, spots, places, reach, &mut owner, &mut open);
        }
        while let Some((column, row, index)) = open.pop_front() {
            let cell = row * self.columns + column;
            if owner[cell].is_none_or(|(_, own)| own != index) {
                continue;
            }
            let (c, r) = (column as i64, row as i64);
            for (dc, dr) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)] {
                let (c, r) = (c + dc, r + dr);
                if (0..self.columns as i64).contains(&c) && (0..self.rows as i64).contains(&r) {
                    self.claim(
                        c as usize, r as usize, index, spots, places, reach, &mut owner, &mut open,
                    );
                }
            }
        }
        for (value, owner) in self.values.iter_mut().zip(&owner) {
            *value = owner.map(|(_, index)| spots[index].error);
        }
    }

    /// Gives a cell to a spot that is nearer than the one that has it; of spots in the same place the larger error wins.
    #[expect(
        clippy::too_many_arguments,
        reason = "the state of one search, used twice in one function"
    )]
    fn claim(
        &self,
        column: usize,
        row: usize,
        index: usize,
        spots: &[PictureSample],
        places: &[(f64, f64)],
        reach: f64,
        owner: &mut [Option<(f64, usize)>],
        open: &mut std::collections::VecDeque<(usize, usize, usize)>,
    ) {
        let middle = self.corner(column, row);
        let (dx, dy) = (
            middle.0 + 0.5 * self.cell - places[index].0,
            middle.1 + 0.5 * self.cell - places[index].1,
        );
        let away = (dx * dx + dy * dy).sqrt();
        let slot = &mut owner[row * self.columns + column];
        let wins = slot.is_none_or(|(known, own)| {
            away < known - 1e-9 || (away < known + 1e-9 && spots[index].error > spots[own].error)
        });
        if away <= reach && wins {
            *slot = Some((away, index));
            open.push_back((column, row, index));
        }
    }

    /// Lower left corner of a cell.
    fn corner(&self, column: usize, row: usize) -> (f64, f64) {
        (
            self.low.0 + column as f64 * self.cell,
            self.low.1 + row as f64 * self.cell,
        )
    }

    /// Runs of cells of one level in a row: from, to, row, level.
    fn runs(&self, top: f64) -> Vec<(usize, usize, usize, usize)> {
        let level = |value: f64| ((value / top * LEVELS as f64) as usize).min(LEVELS - 1);
        let mut runs = Vec::new();
        for row in 0..self.rows {
            let cells = &self.values[row * self.columns..(row + 1) * self.columns];
            let mut from = 0;
            while from < self.columns {
                let Some(value) = cells[from] else {
                    from += 1;
                    continue;
                };
                let own = level(value);
                let mut to = from + 1;
                while to < self.columns && cells[to].is_some_and(|value| level(value) == own) {
                    to += 1;
                }
                runs.push((from, to, row, own));
                from = to;
            }
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(x: f64, y: f64, error: f64) -> PictureSample {
        let place = Vec3::new(x, y, 0.0);
        PictureSample {
            leg: 0,
            place,
            tip: place,
            error,
        }
    }

    #[test]
    fn cells_take_the_nearest_spot() {
        let spots = [spot(0.0, 0.0, 1.0), spot(100.0, 0.0, 3.0), spot(50.0, 50.0, 2.0)];
        let map = Map::new(&spots, &View::new(2, Unit::Mm));
        let at = |x: f64, y: f64| {
            let (column, row) = ((x / map.cell) as usize, (y / map.cell) as usize);
            map.values[row * map.columns + column]
        };
        assert_eq!(
            (at(5.0, 3.0), at(95.0, 3.0), at(50.0, 45.0)),
            (Some(1.0), Some(3.0), Some(2.0))
        );
        // nothing is known far from all spots
        assert_eq!(at(50.0, 5.0), None);
        let covered: usize = map.runs(3.0).iter().map(|(from, to, ..)| to - from).sum();
        assert_eq!(covered, map.values.iter().flatten().count());
    }

    /// Between two compared blocks lie others, which the map does not show.
    #[test]
    fn no_line_leads_across_blocks_that_are_not_compared() {
        let on = |leg: u32, x: f64| PictureSample {
            leg,
            ..spot(x, 0.0, 0.01)
        };
        let lines = |second: f64| {
            let errors = Errors {
                spots: vec![on(0, 0.0), on(0, 10.0), on(1, second), on(1, second + 10.0)],
                ..Errors::default()
            };
            let svg = height_map(&crate::texts::header(), &errors, 2, Unit::Mm).expect("drawn");
            svg.matches("stroke=\"#285A8C\"").count()
        };
        // one is in the legend
        assert_eq!([lines(10.0), lines(25.0)], [2, 3]);
    }

    #[test]
    fn the_scale_darkens_evenly() {
        let light = |share: f64| {
            let RGBColor(r, g, b) = colour(share);
            0.3 * f64::from(r) + 0.59 * f64::from(g) + 0.11 * f64::from(b)
        };
        assert!((0..20).all(|i| light(f64::from(i) / 20.0) > light(f64::from(i + 1) / 20.0)));
    }
}
