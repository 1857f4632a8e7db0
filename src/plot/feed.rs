//! Programmed feed, the highest feed that no axis limits, and the feed that is planned, along the path.
use crate::canvas::{BLUE, Entry, GREEN, Header, PlotError, Swatch, VERMILION, sheet};
use crate::grid::{Frame, Panel};
use crate::record::{Block, Record};
use crate::scale::{Height, counted, range};
use crate::unit::Unit;

/// Draws it, on a logarithmic scale where the limit is far below what is programmed.
///
/// # Errors
/// Neither feed is known in any feed block.
pub fn feed(header: &Header, record: &Record) -> Result<String, PlotError> {
    let cuts: Vec<&Block> = record.blocks.iter().filter(|block| !block.rapid).collect();
    let values = || {
        cuts.iter()
            .flat_map(|block| block.feed)
            .flatten()
            .filter(|feed| *feed > 0.0)
    };
    let (least, most) = values().fold((f64::INFINITY, 0.0_f64), |(low, high), feed| {
        (low.min(feed), high.max(feed))
    });
    if most <= 0.0 {
        return Err(PlotError(
            "nothing to draw: the feed of every feed block is unknown".into(),
        ));
    }
    let programmed = cuts.iter().filter_map(|block| block.feed[0]).fold(0.0, f64::max);
    let top = top(values(), programmed).unwrap_or(most);
    let least = least.min(top);
    let decades = top > 20.0 * least;
    let unit = record.unit;
    let floor = 1e-3;
    let scale = Height { unit, decades, floor };
    let value = |feed: f64| scale.of(feed);
    let upwards = if decades {
        [value(least) - 0.2, value(top) + 0.1]
    } else {
        [0.0, value(top)]
    };
    // the cuts alone: a rapid to a far tool change would leave no room for them
    travels(record, &cuts)?;
    let across = range(
        cuts.iter()
            .flat_map(|block| record.of(block))
            .map(|sample| record.way(sample)),
        1e-3,
    );
    let across = [across[0].max(0.0), across[1]];
    let planned = cuts.iter().any(|block| block.planned.is_some());
    let mut legend = legend(&cuts, planned, (top, unit));
    legend.extend(turned(record, unit));
    let name = scale.name("feed of the tip", "/min");
    sheet(header, &legend, |body| {
        let frame = Frame {
            x: across,
            y: upwards,
            x_name: Some(unit.travel()),
            y_name: &name,
            labels: [10, scale.labels(upwards)],
            decades,
            right: 0.0,
        };
        let panel = Panel::new(body, &frame)?;
        let stairs = |which: usize| {
            let mut last = 0.0;
            cuts.iter().flat_map(move |block| {
                let samples = record.of(block);
                let [from, to] =
                    [samples.first(), samples.last()].map(|sample| sample.map_or(0.0, |sample| record.way(sample)));
                // nothing is drawn across a rapid, nor above the picture
                let gap = (from - core::mem::replace(&mut last, to)).abs() > 1e-6;
                let feed = block.feed[which].filter(|feed| *feed <= top * (1.0 + 1e-9));
                let at = feed.map_or(f64::NAN, |feed| value(feed).max(upwards[0]));
                let gap = gap.then_some((from, f64::NAN));
                gap.into_iter().chain([(from, at), (to, at)])
            })
        };
        let height = |feed: f64| value(feed.min(top)).max(upwards[0]);
        panel.line(stairs(1), BLUE, 1.6)?;
        if planned {
            panel.line(course(record, height).into_iter(), GREEN, 1.8)?;
        }
        // dashed, over the others: both are seen where they are the same
        panel.dashed(stairs(0), VERMILION, 1.4)?;
        panel.dots(places(record, not_reached(&cuts), height), VERMILION, 3.0)?;
        if planned {
            panel.dots(places(record, slow(&cuts), height), GREEN, 3.0)?;
        }
        Ok(())
    })
}

/// Refuses cuts in which the tip rests: nothing stands over a travel of nothing.
fn travels(record: &Record, cuts: &[&Block]) -> Result<(), PlotError> {
    let travel = |block: &&Block| {
        let samples = record.of(block);
        samples.last().map_or(0.0, |s| s.way) - samples.first().map_or(0.0, |s| s.way)
    };
    if cuts.iter().any(|block| travel(block) > 1e-6) {
        return Ok(());
    }
    Err(PlotError(
        "nothing to draw over the travel of the tip: it rests in every feed block".into(),
    ))
}

/// Cuts whose programmed feed some axis does not allow, each with what it allows.
fn not_reached<'b>(cuts: &[&'b Block]) -> impl Iterator<Item = (&'b Block, f64)> {
    cuts.iter().filter_map(|block| match block.feed {
        [Some(feed), Some(limit)] if limit < feed => Some((*block, limit)),
        _ => None,
    })
}

/// The top of the picture: a limit far above what is programmed is of no interest, and not drawn. `None`: nothing is programmed.
fn top(values: impl Iterator<Item = f64>, programmed: f64) -> Option<f64> {
    let drawn = values.filter(|feed| *feed <= 3.0 * programmed);
    (programmed > 0.0).then(|| 1.1 * drawn.fold(0.0, f64::max))
}

/// Cuts whose mean is below 80 % of the programmed feed, each with what it reaches.
fn slow<'b>(cuts: &[&'b Block]) -> impl Iterator<Item = (&'b Block, f64)> {
    cuts.iter().filter_map(|block| match (block.feed[0], block.planned) {
        (Some(feed), Some(plan)) if plan.mean() < 0.8 * feed => Some((*block, plan.most)),
        _ => None,
    })
}

/// The middle of each block at its feed.
fn places<'b>(
    record: &Record,
    blocks: impl Iterator<Item = (&'b Block, f64)>,
    height: impl Fn(f64) -> f64,
) -> impl Iterator<Item = (f64, f64)> {
    blocks.filter_map(move |(block, feed)| {
        let samples = record.of(block);
        Some((
            0.5 * (record.way(samples.first()?) + record.way(samples.last()?)),
            height(feed),
        ))
    })
}

fn legend(cuts: &[&Block], planned: bool, (top, unit): (f64, Unit)) -> Vec<Entry> {
    let is_above = |feed: f64| feed > top * (1.0 + 1e-9);
    let limits = || cuts.iter().filter_map(|block| block.feed[1]);
    let mut legend: Vec<Entry> = vec![(Swatch::Dashed(VERMILION), "programmed feed".into())];
    let top = format!("{}/min", unit.text(top, 0));
    let drawn = limits().any(|feed| !is_above(feed));
    match (drawn, limits().any(is_above)) {
        (true, true) => legend.push((
            Swatch::Line(BLUE),
            format!("highest feed that the axes allow (not drawn above {top})"),
        )),
        (true, false) => legend.push((Swatch::Line(BLUE), "highest feed that the axes allow".into())),
        (false, true) => legend.push((Swatch::Plain, format!("the axes allow more than {top}"))),
        (false, false) => {}
    }
    let low = not_reached(cuts).count();
    if low > 0 {
        let text = format!("not reached in {}", counted(low, "block"));
        legend.push((Swatch::Dot(VERMILION), text));
    }
    if planned {
        legend.push((Swatch::Line(GREEN), "planned feed (corners, acceleration, jerk)".into()));
        let slow = slow(cuts).count();
        if slow > 0 {
            let text = format!("mean below 80 % of F in {}", counted(slow, "block"));
            legend.push((Swatch::Dot(GREEN), text));
        }
    }
    legend
}

/// Why the planned feed does not fall to 0 where the path turns round.
fn turned(record: &Record, unit: Unit) -> Option<Entry> {
    let feed = unit.text(turning_feed(record)?, 0);
    let text = format!("turns round without a stop at up to {feed}/min: the corner model of the machine");
    Some((Swatch::Plain, text))
}

/// The highest planned feed with which a cut ends where the path turns round, as at the bottom of a hole. The machine file lets an axis change its
/// speed by so much at once.
fn turning_feed(record: &Record) -> Option<f64> {
    let pairs = record.blocks.windows(2).filter_map(|two| {
        let (cut, next) = (&two[0], &two[1]);
        let end = cut
            .planned
            .filter(|plan| !cut.rapid && next.joined && plan.end > 0.0)?
            .end;
        let (before, after) = (record.of(cut), record.of(next));
        let comes = before.last()?.tip - before.len().checked_sub(2).and_then(|at| before.get(at))?.tip;
        let goes = after.get(1)?.tip - after.first()?.tip;
        (comes.dot(&goes) < -0.999 * comes.norm() * goes.norm()).then_some(end)
    });
    pairs.reduce(f64::max)
}

/// Feeds between two others, at even acceleration: where, 0..=1, and how much.
fn ramp(before: f64, after: f64) -> [(f64, f64); 3] {
    [0.1, 0.35, 0.65].map(|way| {
        (
            way,
            (before * before + way * (after * after - before * before))
                .max(0.0)
                .sqrt(),
        )
    })
}

/// The planned speed: in each cut from the speed at the end of the block before to the highest one and to that at its own end.
fn course(record: &Record, height: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let mut before = None;
    let mut course = Vec::new();
    for block in &record.blocks {
        let entry = before.filter(|_| block.joined).unwrap_or(0.0);
        before = block.planned.map(|plan| plan.end);
        let (Some(plan), false) = (block.planned, block.rapid) else {
            course.push((f64::NAN, f64::NAN));
            continue;
        };
        let samples = record.of(block);
        let [from, to] =
            [samples.first(), samples.last()].map(|sample| sample.map_or(0.0, |sample| record.way(sample)));
        let [full, brakes] = plan.even(entry).map(|part| from + part * (to - from));
        let mut change = |[from, to]: [f64; 2], before: f64, after: f64| {
            course.push((from, height(before)));
            if before != after {
                course.extend(ramp(before, after).map(|(way, feed)| (from + way * (to - from), height(feed))));
            }
        };
        change([from, full], entry, plan.most);
        change([full, brakes], plan.most, plan.most);
        change([brakes, to], plan.most, plan.end);
        course.push((to, height(plan.end)));
    }
    course
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::PlannedFeed;
    use crate::texts::{header, record};
    use trunnion_geometry::Vec3;

    /// The legend names what is drawn and nothing else.
    #[test]
    fn the_legend_names_the_lines_that_are_drawn() {
        let moves = [0.0, 9.0, 20.0].map(|x| ('f', Vec3::new(x, 0.0, 0.0)));
        let mut record = record(&moves, |_| Vec3::z());
        let texts = |record: &Record| {
            let cuts: Vec<&Block> = record.blocks.iter().collect();
            let entries = legend(&cuts, false, (1100.0, Unit::Mm));
            entries.into_iter().map(|entry| entry.1).collect::<Vec<_>>()
        };
        assert_eq!(texts(&record), ["programmed feed"]);
        for block in &mut record.blocks {
            block.feed[1] = Some(9000.0);
        }
        assert_eq!(
            texts(&record),
            ["programmed feed", "the axes allow more than 1100 mm/min"]
        );
        record.blocks[0].feed[1] = Some(500.0);
        assert_eq!(
            texts(&record),
            [
                "programmed feed",
                "highest feed that the axes allow (not drawn above 1100 mm/min)",
                "not reached in 1 block"
            ]
        );
    }

    /// A programmed feed that changes in each of a hundred thousand blocks is one line, not a dash for each twelve pixels.
    #[test]
    fn a_picture_of_many_blocks_stays_small() {
        let moves: Vec<(char, Vec3)> = (0..94_400).map(|x| ('f', Vec3::new(f64::from(x), 0.0, 0.0))).collect();
        let mut record = record(&moves, |_| Vec3::z());
        for (at, block) in record.blocks.iter_mut().enumerate() {
            block.feed = [Some(200.0 + 100.0 * (at % 7) as f64), Some(900.0)];
        }
        let svg = feed(&header(), &record).expect("drawn");
        assert!(svg.len() < 400_000, "{} bytes", svg.len());
        // the last number below, 100000 at the very edge, is whole
        for (text, [left, _, right, _]) in crate::texts::texts(&svg) {
            assert!(left >= 0.0 && right <= 12_000.0, "{text}");
        }
        record.blocks.truncate(50);
        let few = feed(&header(), &record).expect("drawn");
        assert!(few.matches("<polyline").count() > 100, "dashes");
    }

    /// At the bottom of a hole the planned line does not reach 0: the legend says why.
    #[test]
    fn the_legend_explains_a_feed_at_which_the_path_turns_round() {
        let hole = [('r', 2.0), ('f', -18.0), ('r', 2.0)].map(|(kind, z)| (kind, Vec3::new(0.0, 0.0, z)));
        let mut record = record(&hole, |_| Vec3::z());
        let ends_at = |record: &mut Record, end: f64| {
            for block in record.blocks.iter_mut().filter(|block| !block.rapid) {
                block.feed[0] = Some(300.0);
                block.planned = Some(PlannedFeed {
                    most: 300.0,
                    end,
                    length: 20.0,
                    seconds: 4.0,
                });
            }
        };
        ends_at(&mut record, 240.0);
        assert_eq!(turning_feed(&record), Some(240.0));
        let svg = feed(&header(), &record).expect("drawn");
        assert!(svg.contains("turns round without a stop at up to 240 mm/min"), "{svg}");
        ends_at(&mut record, 0.0);
        assert_eq!(turning_feed(&record), None);
        // straight on
        let on = [('r', 2.0), ('f', -18.0), ('r', -20.0)].map(|(kind, z)| (kind, Vec3::new(0.0, 0.0, z)));
        let mut on = crate::texts::record(&on, |_| Vec3::z());
        ends_at(&mut on, 240.0);
        assert_eq!(turning_feed(&on), None);
    }

    #[test]
    fn a_tip_that_rests_has_no_feed_over_its_travel() {
        let tip = Vec3::new(1.0, 2.0, 3.0);
        let moves = [('r', Vec3::new(0.0, 0.0, 110.0)), ('r', tip), ('f', tip), ('f', tip)];
        let refused = feed(&header(), &record(&moves, |_| Vec3::z())).expect_err("refused");
        assert!(refused.0.contains("it rests in every feed block"), "{refused}");
        let moves = [('r', tip), ('f', Vec3::new(9.0, 2.0, 3.0))];
        assert!(feed(&header(), &record(&moves, |_| Vec3::z())).is_ok());
    }
}
