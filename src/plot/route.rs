//! Rapid motions past obstacles, seen from above: obstacles, their control barriers, and the ways before and after.
use crate::canvas::{BLUE, Entry, GREEN, GREY, Header, INK, PlotError, Swatch, VERMILION, anchored, sheet};
use crate::grid::{Frame, Panel, equal};
use crate::record::Record;
use crate::unit::Unit;
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};
use trunnion_geometry::plane::Point;
use trunnion_geometry::{Vec3, rad};
use trunnion_machine::{AxisKind, Footprint, Joints, Machine, Space};

/// Colours of obstacles and of what is around them.
const BODY: RGBColor = RGBColor(150, 150, 150);
const AROUND: RGBColor = RGBColor(250, 228, 180);

/// Draws it. The barriers are those at the lowest height of the rapid motions in the space of the obstacles.
///
/// # Errors
/// No rapid motion is known.
pub fn route(
    header: &Header,
    (machine, space): (&Machine, &Space),
    record: &Record,
    after: Option<&Record>,
) -> Result<String, PlotError> {
    let unit = record.unit;
    let ways = |record: &Record, rapid: bool| -> Vec<Vec3> {
        let blocks = record.blocks.iter().filter(move |block| block.rapid == rapid);
        let points = blocks.flat_map(|block| {
            let samples = record.of(block).iter();
            let gap = (!block.joined).then(|| Vec3::repeat(f64::NAN));
            gap.into_iter()
                .chain(samples.map(|sample| space.tip(machine, &in_rad(machine, &sample.joints))))
        });
        points.chain([Vec3::repeat(f64::NAN)]).collect()
    };
    let before = ways(record, true);
    let then = after.map(|after| ways(after, true));
    let known = || {
        before
            .iter()
            .chain(then.iter().flatten())
            .filter(|point| point.iter().all(|value| value.is_finite()))
    };
    let lowest = known().map(|point| point.z).fold(f64::INFINITY, f64::min);
    if !lowest.is_finite() {
        return Err(PlotError("nothing to draw: no rapid motion with a known path".into()));
    }
    let barriers = space.rings(lowest);
    let outlines: Vec<(String, Vec<Point>)> = space
        .obstacles()
        .iter()
        .map(|obstacle| (obstacle.name.clone(), outline(&obstacle.footprint)))
        .collect();
    let legend = legend(after.is_some());
    let names = ["X in the frame of the obstacles", "Y"].map(|name| format!("{name} / {}", unit.name()));
    let flat = |point: &Point| shown(unit, point);
    sheet(header, &legend, |body| {
        let corners = barriers
            .iter()
            .flatten()
            .chain(outlines.iter().flat_map(|(_, corners)| corners));
        let all: Vec<Point> = known().map(Vec3::xy).chain(corners.copied()).collect();
        let range = |axis: usize| about(all.iter().map(|point| unit.of_mm(point[axis])), unit.of_mm(1.0));
        let (x, y) = equal(range(0), range(1), body.dim_in_pixel(), 0.0);
        let frame = Frame {
            x,
            y,
            x_name: Some(&names[0]),
            y_name: &names[1],
            labels: [10, 8],
            decades: false,
            right: 0.0,
        };
        let panel = Panel::new(body, &frame)?;
        for ring in &barriers {
            panel.fill(ring.iter().map(&flat), AROUND, 1.0)?;
        }
        for (name, corners) in &outlines {
            panel.fill(corners.iter().map(&flat), BODY, 1.0)?;
            let middle = corners.iter().sum::<Point>() / corners.len().max(1) as f64;
            panel.write(
                flat(&middle),
                name,
                anchored(13.0, HPos::Center, VPos::Center).color(&INK),
            )?;
        }
        panel.line(ways(record, false).iter().map(|point| flat(&point.xy())), BLUE, 1.5)?;
        panel.line(before.iter().map(|point| flat(&point.xy())), VERMILION, 2.0)?;
        if let Some(then) = &then {
            panel.line(then.iter().map(|point| flat(&point.xy())), GREEN, 2.0)?;
            panel.dots(then.iter().map(|point| flat(&point.xy())), GREEN, 3.0)?;
        }
        let heights = format!("barriers at Z {}", unit.text(lowest, 3));
        panel.write(
            (x[0] + 0.01 * (x[1] - x[0]), y[1]),
            &heights,
            anchored(13.0, HPos::Left, VPos::Top).color(&GREY),
        )
    })
}

/// What the colours mean.
fn legend(compared: bool) -> Vec<Entry> {
    let mut legend: Vec<Entry> = vec![
        (Swatch::Filled(BODY), "obstacle".into()),
        (Swatch::Filled(AROUND), "within radius and clearance".into()),
        (Swatch::Line(BLUE), "cut".into()),
        (
            Swatch::Line(VERMILION),
            if compared { "rapid before" } else { "rapid" }.into(),
        ),
    ];
    if compared {
        legend.push((Swatch::Line(GREEN), "rapid after".into()));
    }
    legend
}

/// A range about values, with room around them; `least`: a width below which it has the same room.
fn about(values: impl Iterator<Item = f64>, least: f64) -> [f64; 2] {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let room = 0.05 * (high - low).max(least);
    [low - room, high + room]
}

/// A point in mm as it is shown.
fn shown(unit: Unit, point: &Point) -> (f64, f64) {
    (unit.of_mm(point.x), unit.of_mm(point.y))
}

/// Joints of a sample in mm and rad.
fn in_rad(machine: &Machine, joints: &Joints) -> Joints {
    let mut out = *joints;
    for (value, axis) in out.iter_mut().zip(&machine.axes) {
        if axis.kind == AxisKind::Rotary {
            *value = rad(*value);
        }
    }
    out
}

/// Corners of an obstacle; of a circle enough to look round.
fn outline(footprint: &Footprint) -> Vec<Point> {
    match footprint {
        Footprint::Polygon(polygon) => polygon.corners().to_vec(),
        Footprint::Circle { centre, radius } => (0..96)
            .map(|index| {
                let (sin, cos) = trunnion_geometry::math::sin_cos(core::f64::consts::TAU * f64::from(index) / 96.0);
                centre + Point::new(cos, sin) * *radius
            })
            .collect(),
    }
}
