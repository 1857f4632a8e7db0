//! How far the tip deviates from the programmed segments along the path, with the tolerance.
use crate::canvas::{BLUE, Entry, Header, PlotError, SKY, Swatch, VERMILION, sheet};
use crate::grid::{Frame, Panel};
use crate::record::{Block, Record};
use crate::scale::{Height, counted, range};
use plotters::style::text_anchor::{HPos, VPos};

/// Draws it; `tolerance` in mm.
///
/// # Errors
/// No deviation of any feed block is known.
pub fn deviation(header: &Header, record: &Record, tolerance: f64) -> Result<String, PlotError> {
    let known: Vec<(&Block, [f64; 2])> = record
        .blocks
        .iter()
        .filter(|block| !block.rapid)
        .filter_map(|block| Some((block, block.deviation?)))
        .collect();
    let Some((worst, [most, bound])) = known.iter().max_by(|a, b| a.1[0].total_cmp(&b.1[0])) else {
        return Err(PlotError(
            "nothing to draw: the deviation is unknown in every feed block".into(),
        ));
    };
    let unjudged = record
        .blocks
        .iter()
        .filter(|block| !block.rapid && block.deviation.is_none())
        .count();
    // far above the tolerance a linear scale would hide it
    let decades = *most > 20.0 * tolerance;
    let unit = record.unit;
    let height = Height {
        unit,
        decades,
        floor: 1e-4_f64.min(tolerance / 10.0),
    };
    let value = |mm: f64| height.of(mm);
    let way = |block: &Block| {
        let samples = record.of(block);
        (
            samples.first().map_or(0.0, |s| record.way(s)),
            samples.last().map_or(0.0, |s| record.way(s)),
        )
    };
    let across = range(record.samples.iter().map(|sample| record.way(sample)), 1e-3);
    let across = [across[0].max(0.0), across[1]];
    let upwards = if decades {
        [value(0.0), value(bound.max(tolerance)) + 0.3]
    } else {
        [0.0, 1.15 * value(bound.max(tolerance))]
    };
    let legend = legend(&unit.declared(tolerance), unjudged);
    let name = height.name("deviation of the tip from the programmed segment", "");
    sheet(header, &legend, |body| {
        let panel = Panel::new(
            body,
            &Frame {
                x: across,
                y: upwards,
                x_name: Some(unit.travel()),
                y_name: &name,
                labels: [10, height.labels(upwards)],
                decades,
                right: 0.0,
            },
        )?;
        let stairs = |which: usize| {
            known.iter().flat_map(move |(block, values)| {
                let (from, to) = way(block);
                [(from, value(values[which])), (to, value(values[which]))]
            })
        };
        let start = stairs(1).next().map_or(0.0, |p| p.0);
        let end = stairs(1).last().map_or(0.0, |p| p.0);
        let outline = core::iter::once((start, upwards[0]))
            .chain(stairs(1))
            .chain([(end, upwards[0])]);
        panel.fill(outline, SKY, 0.45)?;
        panel.line(stairs(0), BLUE, 1.8)?;
        panel.dashed(across.map(|x| (x, value(tolerance))).into_iter(), VERMILION, 1.8)?;
        let (from, to) = way(worst);
        let place = (0.5 * (from + to), value(*most));
        panel.ring(place.0, place.1, VERMILION, 6.0)?;
        let left = place.0 > 0.5 * (across[0] + across[1]);
        let text = format!(
            "line {}: {} (proven below {})",
            worst.line,
            unit.text(*most, 4),
            above(unit.of_mm(*bound), unit.digits(4))
        );
        let side = if left { HPos::Right } else { HPos::Left };
        panel.text(place, &text, VERMILION, (side, VPos::Bottom), 8.0)
    })
}

/// A bound with some decimals, never below itself.
fn above(bound: f64, digits: usize) -> String {
    let parts = (0..digits).fold(1.0, |parts, _| parts * 10.0);
    format!("{:.digits$}", ((bound * parts).floor() + 1.0) / parts)
}

fn legend(tolerance: &str, unjudged: usize) -> Vec<Entry> {
    let mut legend: Vec<Entry> = vec![
        (Swatch::Line(BLUE), "largest in the block".into()),
        (Swatch::Filled(SKY), "proven bound".into()),
        (Swatch::Dashed(VERMILION), format!("tolerance {tolerance}")),
    ];
    if unjudged > 0 {
        legend.push((Swatch::Plain, format!("unknown in {}", counted(unjudged, "block"))));
    }
    legend
}

#[cfg(test)]
mod tests {
    use super::above;

    #[test]
    fn a_bound_is_above_itself() {
        assert_eq!(
            [
                above(0.0, 4),
                above(0.00004, 4),
                above(0.0123, 4),
                above(0.000_001_1, 6)
            ],
            ["0.0001", "0.0001", "0.0124", "0.000002"]
        );
    }
}
