//! The sheet: header, legend, colours, and the conversion to text.
use crate::marks::Shape;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Tenths of a pixel: plotters draws in whole units, so the sheet is drawn ten times as large and shown at its size.
pub(crate) const SCALE: i32 = 10;
/// Size of the sheet, pixels.
const WIDTH: i32 = 1200;
const HEIGHT: i32 = 800;
/// Height of the header, pixels.
const HEADER: i32 = 92;
/// Height of a further row of the legend, pixels.
const LEGEND_ROW: f64 = 22.0;

/// The sheet.
pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Colours that people with any colour vision can distinguish (Okabe and Ito, 2008).
pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(crate) const ORANGE: RGBColor = RGBColor(230, 159, 0);
pub(crate) const SKY: RGBColor = RGBColor(86, 180, 233);
pub(crate) const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub(crate) const INK: RGBColor = RGBColor(30, 30, 30);
pub(crate) const GREY: RGBColor = RGBColor(120, 120, 120);
pub(crate) const PALE: RGBColor = RGBColor(225, 225, 225);

/// The text above a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// What is shown.
    pub title: String,
    /// Of what: file, machine, dialect.
    pub subtitle: String,
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlotError(pub String);

impl core::fmt::Display for PlotError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PlotError {}

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for PlotError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self(format!("the picture cannot be drawn: {error}"))
    }
}

/// A symbol in the legend.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Swatch {
    Line(RGBColor),
    Dashed(RGBColor),
    Dot(RGBColor),
    Filled(RGBColor),
    Symbol(Shape, RGBColor),
    /// A count of what is not drawn: the text alone.
    Plain,
}

/// One entry of the legend.
pub(crate) type Entry = (Swatch, String);

/// Pixels to units of the sheet.
pub(crate) fn px(pixels: f64) -> i32 {
    (pixels * f64::from(SCALE)).round() as i32
}

/// A text style of a size in pixels.
pub(crate) fn font(size: f64) -> TextStyle<'static> {
    // plotters writes the size divided by 1.24
    TextStyle::from(("sans-serif", size * f64::from(SCALE) * 1.24).into_font()).color(&INK)
}

/// The same, anchored.
pub(crate) fn anchored(size: f64, h: HPos, v: VPos) -> TextStyle<'static> {
    font(size).pos(Pos::new(h, v))
}

/// Draws a sheet: header and legend, then `body` on what is left (pixels of its size are given by the area, times [`SCALE`]).
pub(crate) fn sheet(
    header: &Header,
    legend: &[Entry],
    body: impl FnOnce(&Area<'_>) -> Result<(), PlotError>,
) -> Result<String, PlotError> {
    let mut text = String::new();
    {
        let size = ((WIDTH * SCALE) as u32, (HEIGHT * SCALE) as u32);
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        let places = places(legend);
        let rows = places.last().map_or(0, |(row, _)| *row);
        let (top, rest) = root.split_vertically(px(f64::from(HEADER) + LEGEND_ROW * rows as f64));
        let bold = font(20.0);
        top.draw(&Text::new(header.title.clone(), (px(24.0), px(12.0)), bold))?;
        top.draw(&Text::new(
            header.subtitle.clone(),
            (px(24.0), px(40.0)),
            font(14.0).color(&GREY),
        ))?;
        for (entry, (row, x)) in legend.iter().zip(&places) {
            draw_entry(&top, entry, (px(*x), px(72.0 + LEGEND_ROW * *row as f64)))?;
        }
        body(&rest)?;
        root.present()?;
    }
    let (large, shown) = (
        format!("width=\"{}\" height=\"{}\"", WIDTH * SCALE, HEIGHT * SCALE),
        format!("width=\"{WIDTH}\" height=\"{HEIGHT}\" font-family=\"Helvetica, Arial, sans-serif\""),
    );
    let text = text.replacen(&large, &shown, 1);
    // lines pass behind the texts
    let halo =
        "<style>text { paint-order: stroke; stroke: #ffffff; stroke-width: 35; stroke-linejoin: round; }</style>";
    Ok(match text.find('>') {
        Some(end) => format!("{}\n{halo}{}", &text[..=end], &text[end + 1..]),
        None => text,
    })
}

/// Row and left edge, px, of each entry of a legend: what does not fit into a row begins the next.
fn places(legend: &[Entry]) -> Vec<(usize, f64)> {
    let (left, mut row) = (24.0, 0);
    let mut x = left;
    let mut out = Vec::with_capacity(legend.len());
    for (_, label) in legend {
        let width = 32.0 + 7.4 * label.chars().count() as f64;
        if x > left && x + width > f64::from(WIDTH) - left {
            (row, x) = (row + 1, left);
        }
        out.push((row, x));
        x += width + 22.0;
    }
    out
}

fn draw_entry(top: &Area<'_>, (swatch, label): &Entry, (x, y): (i32, i32)) -> Result<(), PlotError> {
    let to = x + px(26.0);
    match swatch {
        Swatch::Plain => {}
        Swatch::Line(colour) => {
            top.draw(&PathElement::new(
                vec![(x, y), (to, y)],
                colour.stroke_width(px(2.0) as u32),
            ))?;
        }
        Swatch::Dashed(colour) => {
            for part in 0..3 {
                let from = x + px(9.0) * part;
                top.draw(&PathElement::new(
                    vec![(from, y), (from + px(6.0), y)],
                    colour.stroke_width(px(2.0) as u32),
                ))?;
            }
        }
        Swatch::Dot(colour) => top.draw(&Circle::new((x + px(13.0), y), px(5.0), colour.filled()))?,
        Swatch::Symbol(shape, colour) => draw_symbol(top, (x + px(13.0), y), (*shape, *colour), 6.0, true)?,
        Swatch::Filled(colour) => {
            top.draw(&Rectangle::new([(x, y - px(6.0)), (to, y + px(6.0))], colour.filled()))?;
        }
    }
    top.draw(&Text::new(
        label.clone(),
        (to + px(6.0), y),
        anchored(14.0, HPos::Left, VPos::Center),
    ))?;
    Ok(())
}

/// A symbol of a radius in pixels, filled or as an outline.
pub(crate) fn draw_symbol(
    area: &Area<'_>,
    at: (i32, i32),
    (shape, colour): (Shape, RGBColor),
    pixels: f64,
    filled: bool,
) -> Result<(), PlotError> {
    let corner = |(x, y): (f64, f64)| (at.0 + x.round() as i32, at.1 + y.round() as i32);
    let mut corners: Vec<(i32, i32)> = shape.corners(f64::from(px(pixels))).into_iter().map(corner).collect();
    if filled {
        area.draw(&Polygon::new(corners, colour.filled()))?;
    } else {
        corners.push(corners[0]);
        area.draw(&PathElement::new(corners, colour.stroke_width(px(2.0) as u32)))?;
    }
    Ok(())
}

/// A dashed line through points of the sheet.
pub(crate) fn dashes(points: &[(f64, f64)], dash: f64, gap: f64) -> Vec<Vec<(i32, i32)>> {
    let (dash, gap) = (dash * f64::from(SCALE), gap * f64::from(SCALE));
    let mut out = Vec::new();
    let (mut left, mut on) = (dash, true);
    let mut current: Vec<(i32, i32)> = Vec::new();
    let whole = |p: (f64, f64)| (p.0.round() as i32, p.1.round() as i32);
    for two in points.windows(2) {
        let (mut from, to) = (two[0], two[1]);
        loop {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let length = (dx * dx + dy * dy).sqrt();
            if on && current.is_empty() {
                current.push(whole(from));
            }
            if length.is_nan() || length <= left {
                left -= length.max(0.0);
                if on {
                    current.push(whole(to));
                }
                break;
            }
            from = (from.0 + dx * left / length, from.1 + dy * left / length);
            if on {
                current.push(whole(from));
                out.push(std::mem::take(&mut current));
            }
            on = !on;
            left = if on { dash } else { gap };
        }
    }
    if current.len() > 1 {
        out.push(current);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_is_svg_of_its_size_and_escapes_names() {
        let header = Header {
            title: "a < b".into(),
            subtitle: "f&g".into(),
        };
        let text = sheet(&header, &[(Swatch::Line(BLUE), "one".into())], |_| Ok(())).expect("drawn");
        assert!(
            text.starts_with("<svg width=\"1200\" height=\"800\""),
            "{}",
            &text[..80]
        );
        assert!(text.contains("viewBox=\"0 0 12000 8000\"") && text.contains("a &lt; b") && text.contains("f&amp;g"));
        assert!(text.trim_end().ends_with("</svg>") && text.contains("paint-order: stroke"));
    }

    /// Nothing runs off the sheet, nothing overlaps, and the rows come one below the other.
    #[test]
    fn a_long_legend_goes_on_in_the_next_row() {
        let entry = |text: &str| (Swatch::Line(BLUE), text.to_owned());
        let legend: Vec<Entry> = (0..14).map(|i| entry(&"excess-rotary-travel (12)"[i..])).collect();
        let found = places(&legend);
        let right = |i: usize| found[i].1 + 32.0 + 7.4 * legend[i].1.chars().count() as f64;
        for i in 0..legend.len() {
            assert!(right(i) <= f64::from(WIDTH), "{found:?}");
            if i > 0 {
                let (before, now) = (found[i - 1], found[i]);
                assert!(
                    now.0 == before.0 && now.1 > right(i - 1) || now == (before.0 + 1, 24.0),
                    "{found:?}"
                );
            }
        }
        assert!(found[13].0 >= 2, "{found:?}");
        assert!(places(&[]).is_empty());
    }

    #[test]
    fn dashes_follow_a_line() {
        let parts = dashes(&[(0.0, 0.0), (1000.0, 0.0)], 10.0, 10.0);
        assert_eq!(parts.len(), 5);
        assert_eq!(parts[1], vec![(200, 0), (300, 0)]);
    }
}
