//! A corner as the servo loops run it: reference and path in the plane of the corner, and the errors over time.
use crate::canvas::{BLUE, GREEN, GREY, Header, PlotError, Swatch, VERMILION, sheet};
use crate::grid::{Frame, Panel, equal};
use crate::scale::range;
use crate::unit::Unit;
use plotters::style::text_anchor::{HPos, VPos};
use trunnion_geometry::math::hypot;

/// One moment: s, reference and axes in the plane of the corner (mm from it), and the errors by name, um.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoSpot {
    /// s; the reference passes the corner at 0.
    pub time: f64,
    /// Reference.
    pub reference: [f64; 2],
    /// Axes.
    pub position: [f64; 2],
    /// Exact distance from the path, um.
    pub exact: f64,
    /// Length of the corner vector, um.
    pub radial: f64,
}

/// Draws it, with lengths in `unit`; errors are in micrometres or in thousandths of an inch.
///
/// # Errors
/// There are no spots with finite values.
pub fn servo(header: &Header, spots: &[ServoSpot], unit: Unit) -> Result<String, PlotError> {
    let finite = |spot: &&ServoSpot| spot.position.iter().all(|x| x.abs() < 1e6) && spot.exact.is_finite();
    let spots: Vec<ServoSpot> = spots.iter().filter(finite).copied().collect();
    let worst = spots.iter().max_by(|a, b| a.exact.total_cmp(&b.exact));
    let Some(worst) = worst.copied() else {
        return Err(PlotError(
            "nothing to draw: the loop is unstable from the first sample on".into(),
        ));
    };
    turns(&worst)?;
    // what matters of the path is some times the error about the corner
    let reach = (60.0 * worst.exact / 1000.0)
        .max(4.0 * hypot(worst.position[0], worst.position[1]))
        .max(1e-3);
    let near: Vec<&ServoSpot> = spots
        .iter()
        .filter(|spot| hypot(spot.position[0], spot.position[1]) < reach)
        .collect();
    let [along, across, error] = names(unit);
    let place = |p: [f64; 2]| (unit.of_mm(p[0]), unit.of_mm(p[1]));
    // um are thousandths of a mm
    let error_of = |um: f64| unit.of_mm(um);
    let legend = vec![
        (Swatch::Line(GREY), "reference".into()),
        (Swatch::Line(BLUE), "path of the axes".into()),
        (Swatch::Line(VERMILION), "exact distance".into()),
        (Swatch::Line(GREEN), "corner vector (radial error)".into()),
    ];
    sheet(header, &legend, |body| {
        let (left, right) = body.split_horizontally(body.dim_in_pixel().0 / 2);
        let all = near.iter().flat_map(|spot| [spot.position, spot.reference]);
        let inside: Vec<[f64; 2]> = all.filter(|p| hypot(p[0], p[1]) < 1.2 * reach).collect();
        let (x, y) = equal(
            range(inside.iter().map(|&p| place(p).0), unit.of_mm(1e-4)),
            range(inside.iter().map(|&p| place(p).1), unit.of_mm(1e-4)),
            left.dim_in_pixel(),
            0.0,
        );
        let panel = Panel::new(
            &left,
            &Frame {
                x,
                y,
                x_name: Some(along),
                y_name: across,
                labels: [5, 8],
                decades: false,
                right: 0.0,
            },
        )?;
        panel.line(spots.iter().map(|s| place(s.reference)), GREY, 1.4)?;
        panel.line(spots.iter().map(|s| place(s.position)), BLUE, 1.8)?;
        let at = place(worst.position);
        panel.ring(at.0, at.1, VERMILION, 6.0)?;
        let text = match unit {
            Unit::Mm => format!("{:.2} um", worst.exact),
            Unit::Inch => unit.text(worst.exact / 1000.0, 5),
        };
        panel.text(at, &text, VERMILION, (HPos::Right, VPos::Bottom), 8.0)?;
        let span = near.iter().map(|spot| spot.time * 1e3);
        let errors = near
            .iter()
            .flat_map(|spot| [spot.exact, spot.radial].map(error_of))
            .chain([0.0]);
        let panel = Panel::new(
            &right,
            &Frame {
                x: range(span, 1e-3),
                y: range(errors.map(|error| 1.05 * error), error_of(1e-3)),
                x_name: Some("time from the corner / ms"),
                y_name: error,
                labels: [6, 8],
                decades: false,
                right: 0.0,
            },
        )?;
        panel.line(near.iter().map(|s| (s.time * 1e3, error_of(s.radial))), GREEN, 1.4)?;
        panel.line(near.iter().map(|s| (s.time * 1e3, error_of(s.exact))), VERMILION, 1.8)?;
        Ok(())
    })
}

/// Refuses what is no corner, by the spot with the largest error.
fn turns(worst: &ServoSpot) -> Result<(), PlotError> {
    // half a nanometre: below what a control resolves
    if worst.exact >= 5e-4 {
        return Ok(());
    }
    Err(PlotError(
        "nothing to draw: the path goes straight on there, and the axes do not leave it".into(),
    ))
}

/// The axes of the picture: along the incoming leg, across it, error.
fn names(unit: Unit) -> [&'static str; 3] {
    match unit {
        Unit::Mm => ["along the incoming leg / mm", "across / mm", "error / um"],
        Unit::Inch => ["along the incoming leg / in", "across / in", "error / 0.001 in"],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texts::header;

    #[test]
    fn a_straight_path_is_no_corner() {
        let spots = |error: f64| {
            [-1.0, 0.0, 1.0].map(|time| ServoSpot {
                time,
                reference: [time, 0.0],
                position: [time - 0.1, error / 1000.0],
                exact: error,
                radial: 0.0,
            })
        };
        let refused = servo(&header(), &spots(1e-9), Unit::Mm).expect_err("refused");
        assert!(refused.0.contains("goes straight on"), "{refused}");
        assert!(servo(&header(), &spots(3.0), Unit::Mm).is_ok());
    }
}
