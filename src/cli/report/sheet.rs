//! The set-up sheet: tools, offsets, extents and time.
use crate::cli::load::Loaded;
use trunnion_check::with_inches;
use trunnion_interp::{AXIS_LETTERS, ToolShape};
use trunnion_stats::Tally;

/// A table with its head.
pub(super) struct Table {
    pub(super) title: &'static str,
    pub(super) head: Vec<&'static str>,
    pub(super) rows: Vec<Vec<String>>,
}

/// The tables of a program.
pub(super) fn tables(loaded: &Loaded, assumed: &[String], tally: &Tally, cycle_time_s: Option<[f64; 2]>) -> Vec<Table> {
    let mut tables = vec![
        tools(tally),
        offsets(loaded, assumed),
        extents(tally),
        Table {
            title: "Time and distance",
            head: vec!["what", "value"],
            rows: times(tally, cycle_time_s),
        },
    ];
    if tally.inch {
        let cells = tables.iter_mut().flat_map(|table| &mut table.rows).flatten();
        cells.for_each(|cell| *cell = with_inches(cell));
    }
    tables
}

fn tools(tally: &Tally) -> Table {
    let not = || "not declared".to_owned();
    let rows = tally.tools.iter().map(|(number, used)| {
        let tool = used.declared;
        let mm = |value: Option<f64>| value.map_or_else(not, |value| format!("{} mm", short(value)));
        let shape = tool.and_then(|tool| tool.shape).map_or_else(not, shape_name);
        vec![
            number.map_or_else(|| "in use at the start".to_owned(), |number| format!("T{number}")),
            shape,
            mm(tool.and_then(|tool| tool.diameter_mm)),
            mm(tool.and_then(|tool| tool.length_mm)),
            used.line.to_string(),
            format!("{} mm", short(used.feed_mm)),
        ]
    });
    Table {
        title: "Tools",
        head: vec!["tool", "shape", "diameter", "length", "first line", "path in feed"],
        rows: rows.collect(),
    }
}

fn offsets(loaded: &Loaded, assumed: &[String]) -> Table {
    let rows = loaded.resolved.setup.work_offsets.iter().map(|offset| {
        let values = AXIS_LETTERS
            .iter()
            .zip(offset.values)
            .filter(|(_, value)| *value != 0.0);
        let values: Vec<String> = values
            .map(|(letter, value)| format!("{} {}", char::from(*letter), short(value)))
            .collect();
        let values = if values.is_empty() {
            "zero in all axes".to_owned()
        } else {
            values.join(", ")
        };
        vec![offset.name.clone(), values]
    });
    let mut rows: Vec<Vec<String>> = rows.collect();
    rows.extend(assumed.iter().map(|text| vec!["assumed".to_owned(), text.clone()]));
    Table {
        title: "Work offsets",
        head: vec!["offset", "part zero in machine coordinates / mm, deg"],
        rows,
    }
}

fn extents(tally: &Tally) -> Table {
    let radius = |letter: char| {
        if tally.radii && letter == 'X' {
            ", as radius (words of X are diameters)"
        } else {
            ""
        }
    };
    let programmed = AXIS_LETTERS
        .iter()
        .zip(tally.axes)
        .enumerate()
        .filter_map(|(axis, (letter, range))| {
            let range = range?;
            let unit = if (3..6).contains(&axis) { "deg" } else { "mm" };
            Some(vec![
                format!("{} programmed{}", char::from(*letter), radius(char::from(*letter))),
                format!("{} {unit}", short(range.low)),
                format!("{} {unit}", short(range.high)),
            ])
        });
    let joints = tally.joints.iter().filter_map(|(letter, rotary, range)| {
        let range = (*range)?;
        let unit = if *rotary { "deg" } else { "mm" };
        Some(vec![
            format!("{letter} of the machine{}", radius(*letter)),
            format!("{} {unit}", short(range.low)),
            format!("{} {unit}", short(range.high)),
        ])
    });
    Table {
        title: "Extents",
        head: vec!["axis", "from", "to"],
        rows: programmed.chain(joints).collect(),
    }
}

fn times(tally: &Tally, cycle_time_s: Option<[f64; 2]>) -> Vec<Vec<String>> {
    let time = match cycle_time_s {
        Some([low, high]) => format!("{} to {}", clock(low), clock(high)),
        None => "unknown (`trunnion stats --time` says which motions are not known)".to_owned(),
    };
    let mut rows = vec![
        vec!["cycle time".to_owned(), time],
        vec!["time in feed at the programmed feed".to_owned(), clock(tally.feed_s)],
        vec!["path in rapid".to_owned(), format!("{} mm", short(tally.rapid_mm))],
        vec!["path in feed".to_owned(), format!("{} mm", short(tally.feed_mm))],
        vec!["tool changes".to_owned(), tally.tool_changes.to_string()],
    ];
    if tally.untimed > 0 {
        rows.push(vec![
            "feed motions of unknown time".to_owned(),
            tally.untimed.to_string(),
        ]);
    }
    if let Some((line, why)) = &tally.stop {
        rows.push(vec!["counted up to".to_owned(), format!("line {line}: {why}")]);
    }
    rows
}

fn shape_name(shape: ToolShape) -> String {
    match shape {
        ToolShape::Ball => "ball".to_owned(),
        ToolShape::Flat => "flat".to_owned(),
        ToolShape::Bull(radius) => format!("bull, corner radius {} mm", short(radius)),
        ToolShape::Turning(nose) => format!(
            "turning, nose radius {} mm, tip direction {}",
            short(nose.radius_mm),
            nose.tip
        ),
    }
}

/// Seconds as people say them.
fn clock(seconds: f64) -> String {
    if seconds < 60.0 {
        return format!("{} s", short(seconds));
    }
    let whole = seconds.round() as u64;
    let (hours, minutes, rest) = (whole / 3600, whole / 60 % 60, whole % 60);
    if hours > 0 {
        format!("{hours} h {minutes:02} min {rest:02} s")
    } else {
        format!("{minutes} min {rest:02} s")
    }
}

fn short(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_aloud() {
        assert_eq!(clock(4.25), "4.25 s");
        assert_eq!(clock(61.4), "1 min 01 s");
        assert_eq!(clock(7325.0), "2 h 02 min 05 s");
        assert_eq!(short(-0.0001), "0");
    }
}
