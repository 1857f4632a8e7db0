//! The programmed feed and the one that is reached, along the path.
use crate::canvas::{BLUE, GREY, Header, PlotError, Swatch, VERMILION, sheet};
use crate::grid::{Frame, Panel};
use crate::scale::range;
use plotters::style::text_anchor::{HPos, VPos};

/// One feed motion: path length, mm, and feeds, mm/min.
#[derive(Clone, Debug, PartialEq)]
pub struct FeedSpan {
    /// Line in the file, from 1.
    pub line: u32,
    /// mm.
    pub length: f64,
    /// F.
    pub feed: f64,
    /// Highest, and lowest at an end.
    pub reached: [f64; 2],
    /// What holds it back.
    pub limited_by: String,
}

/// Draws it.
///
/// # Errors
/// The reached feed of no motion is known.
pub fn feed(header: &Header, spans: &[FeedSpan]) -> Result<String, PlotError> {
    let worst = spans
        .iter()
        .min_by(|a, b| (a.reached[0] / a.feed).total_cmp(&(b.reached[0] / b.feed)));
    let Some(worst) = worst else {
        return Err(PlotError(
            "nothing to draw: the reached feed of no feed motion is known; the axes need speeds and accelerations (dyn = { vmax, amax })".into(),
        ));
    };
    let mut ends = vec![0.0];
    for span in spans {
        ends.push(ends[ends.len() - 1] + span.length);
    }
    let length = ends[ends.len() - 1];
    let top = spans
        .iter()
        .map(|span| span.feed.max(span.reached[0]))
        .fold(0.0, f64::max);
    let legend = vec![
        (Swatch::Dashed(GREY), "programmed feed".into()),
        (Swatch::Line(BLUE), "highest feed in the block".into()),
        (Swatch::Line(VERMILION), "lowest feed in the block".into()),
    ];
    sheet(header, &legend, |body| {
        let panel = Panel::new(
            body,
            &Frame {
                x: range([0.0, length].into_iter(), 1e-3),
                y: [0.0, 1.1 * top],
                x_name: Some("path in feed / mm"),
                y_name: "feed / (mm/min)",
                labels: [10, 8],
                decades: false,
                right: 0.0,
            },
        )?;
        let stairs = |of: fn(&FeedSpan) -> f64| {
            spans
                .iter()
                .zip(ends.windows(2))
                .flat_map(move |(span, ends)| [(ends[0], of(span)), (ends[1], of(span))])
        };
        panel.dashed(stairs(|span| span.feed), GREY, 1.4)?;
        panel.line(stairs(|span| span.reached[1]), VERMILION, 1.2)?;
        panel.line(stairs(|span| span.reached[0]), BLUE, 1.8)?;
        let at = spans.iter().position(|span| span == worst).unwrap_or(0);
        let x = 0.5 * (ends[at] + ends[at + 1]);
        panel.ring(x, worst.reached[0], VERMILION, 6.0)?;
        let text = format!(
            "line {}: {:.0} of {:.0} mm/min, {}",
            worst.line, worst.reached[0], worst.feed, worst.limited_by
        );
        let side = if x > 0.5 * length { HPos::Right } else { HPos::Left };
        panel.text((x, worst.reached[0]), &text, VERMILION, (side, VPos::Bottom))
    })
}
