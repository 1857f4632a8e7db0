//! How far the tip deviates from the programmed segments along the path, with the tolerance.
use crate::canvas::{BLUE, Entry, Header, PlotError, SKY, Swatch, VERMILION, sheet};
use crate::grid::{Frame, Panel};
use crate::record::{Block, Record};
use crate::scale::{Height, counted, range};
use crate::unit::Unit;
use plotters::style::text_anchor::{HPos, VPos};

/// Draws it; `tolerance` in mm.
///
/// # Errors
/// No deviation of any feed block is known, or all are proven to be too small to be seen.
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
    let unjudged = record.blocks.iter().filter(|block| is_unjudged(block)).count();
    nothing(&known, unjudged, tolerance, record.unit)?;
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

/// A cut whose deviation is unknown.
fn is_unjudged(block: &Block) -> bool {
    !block.rapid && block.deviation.is_none()
}

/// A deviation below this share of the tolerance is not seen beside it.
const UNSEEN: f64 = 0.02;

/// Says in a sentence what a picture of nothing would show.
fn nothing(known: &[(&Block, [f64; 2])], unjudged: usize, tolerance: f64, unit: Unit) -> Result<(), PlotError> {
    let most = known.iter().map(|(_, [_, bound])| *bound).fold(0.0, f64::max);
    if most > UNSEEN * tolerance {
        return Ok(());
    }
    let digits = unit.digits(4);
    let rest = match unjudged {
        0 => "feed block".to_owned(),
        some => format!(
            "feed block where it is known; it is unknown in {}",
            counted(some, "block")
        ),
    };
    Err(PlotError(format!(
        "nothing to draw: the tip stays within {} {} of the programmed segment (proven; tolerance {}) in every {rest}",
        above(unit.of_mm(most), digits),
        unit.name(),
        unit.declared(tolerance)
    )))
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
    use super::*;
    use crate::texts::{header, record};
    use trunnion_geometry::Vec3;

    #[test]
    fn where_nothing_is_seen_a_sentence_says_so() {
        let moves = [0.0, 9.0, 20.0, 30.0].map(|x| ('f', Vec3::new(x, 0.0, 0.0)));
        let mut record = record(&moves, |_| Vec3::z());
        let refused = deviation(&header(), &record, 0.01).expect_err("nothing").0;
        assert!(
            refused.ends_with("0.0001 mm of the programmed segment (proven; tolerance 0.01 mm) in every feed block"),
            "{refused}"
        );
        record.blocks[0].deviation = None;
        let refused = deviation(&header(), &record, 0.01).expect_err("nothing").0;
        assert!(refused.ends_with("it is unknown in 1 block"), "{refused}");
        // the proven bound counts, not the largest sample
        record.blocks[2].deviation = Some([0.0, 0.003]);
        assert!(deviation(&header(), &record, 0.01).is_ok());
    }

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
