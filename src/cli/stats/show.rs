//! What was counted, for people and for programs.
use crate::cli::{json::tidy, load::Loaded};
use serde::{Serialize, Serializer, ser::SerializeMap};
use serde_json::{Map, Value, json};
use std::fmt::Write;
use trunnion_check::with_inches;
use trunnion_interp::AXIS_LETTERS;
use trunnion_stats::{Call, MOST_LINES, Range, Tally};

/// Units of F, per minute, per turn, inverse time.
const FEEDS: [(&str, &str); 3] = [
    ("mm/min", "mm_min"),
    ("mm/rev", "mm_rev"),
    ("1/min (inverse time)", "inverse_time_1_min"),
];

/// How many rows of tools, calls and unmodelled things are shown.
const ROWS: usize = 12;

/// The form for people.
pub(super) fn text(loaded: &Loaded, tally: &Tally, cycle_time_s: Option<[f64; 2]>) -> String {
    let mut out = String::new();
    let resolved = &loaded.resolved;
    let machine = resolved
        .machine
        .as_ref()
        .map_or("no machine", |machine| machine.id.as_str());
    let _ = writeln!(
        out,
        "{}  {} ({}), {machine}",
        loaded.name, resolved.dialect.name, resolved.dialect_reason
    );
    let mut row = |name: &str, text: &str| {
        let _ = writeln!(out, "  {name:<12}  {text}");
    };
    row("blocks", &blocks(tally));
    row("motions", &motions(tally));
    row("path", &path(tally));
    row("time", &time(loaded, tally, cycle_time_s));
    rows(&mut row, "extents", &extents(tally));
    rows(&mut row, "joints", &joints(tally));
    let feeds = tally
        .feed
        .iter()
        .zip(FEEDS)
        .filter_map(|(range, (unit, _))| Some(format!("{} {unit}", span((*range)?, 3))));
    rows(&mut row, "feed", &feeds.collect::<Vec<_>>());
    let spindle = tally.spindle.map(|range| format!("{} 1/min", span(range, 0)));
    rows(&mut row, "spindle", spindle.as_slice());
    rows(&mut row, "tools", &tools(tally));
    let calls = tally.calls.iter().map(|call| {
        let times = if call.count == 1 {
            String::new()
        } else {
            format!(", {} times", number(call.count))
        };
        format!("{} on line {}{times}", call.name, call.line)
    });
    let calls: Vec<String> = calls.take(ROWS).collect();
    rows_of(&mut row, "calls", &calls, tally.calls.len());
    let unmodelled = tally.not_modelled.iter().map(|(what, count)| match count {
        1 => what.clone(),
        count => format!("{what}, {} times", number(*count)),
    });
    rows(&mut row, "not modelled", &unmodelled.collect::<Vec<_>>());
    let stop = tally.stop.as_ref();
    let stop = stop.map(|(line, why)| format!("from line {line}: {why}; nothing after it is counted"));
    rows(&mut row, "not followed", stop.as_slice());
    if tally.inch { with_inches(&out) } else { out }
}

/// Several rows under one name; more than fit are counted.
fn rows(row: &mut impl FnMut(&str, &str), name: &str, texts: &[String]) {
    rows_of(row, name, texts, texts.len());
}

/// The same; there are `count`, of which `texts` are at least the first.
fn rows_of(row: &mut impl FnMut(&str, &str), name: &str, texts: &[String], count: usize) {
    for (at, text) in texts.iter().take(ROWS).enumerate() {
        row(if at == 0 { name } else { "" }, text);
    }
    if count > ROWS {
        row("", &format!("and {} more", number((count - ROWS) as u64)));
    }
}

/// `38 of 38 run`, in the words of `check`.
fn blocks(tally: &Tally) -> String {
    let again = if tally.runs > tally.run {
        format!(", {} times in all", number(tally.runs))
    } else {
        String::new()
    };
    format!("{} of {} run{again}", number(tally.run), number(tally.blocks))
}

fn motions(tally: &Tally) -> String {
    let kinds: Vec<String> = tally
        .motions
        .iter()
        .map(|(kind, count)| format!("{} {kind}", number(*count)))
        .collect();
    match kinds.as_slice() {
        [] => "none".to_owned(),
        kinds => format!("{}: {}", number(tally.motions()), kinds.join(", ")),
    }
}

fn path(tally: &Tally) -> String {
    let mut text = format!(
        "rapid {} mm, feed {} mm",
        decimal(tally.rapid_mm, 3),
        decimal(tally.feed_mm, 3)
    );
    if tally.spindle_off_mm > 0.0 {
        let _ = write!(
            text,
            " ({} mm of it with the spindle off or in an unknown state)",
            decimal(tally.spindle_off_mm, 3)
        );
    }
    if tally.unmeasured > 0 {
        let _ = write!(
            text,
            "; without {} whose start or end in the part is not known ({})",
            many(tally.unmeasured, "motion"),
            in_lines(&tally.unmeasured_lines)
        );
    }
    text
}

/// `line 4`, `lines 4, 8, 10`, `lines 4, 8, 10 and more`.
fn in_lines(lines: &[u32]) -> String {
    const NAMED: usize = MOST_LINES - 1;
    let named: Vec<String> = lines.iter().take(NAMED).map(ToString::to_string).collect();
    let (plural, more) = (
        if lines.len() == 1 { "" } else { "s" },
        if lines.len() > NAMED { " and more" } else { "" },
    );
    format!("line{plural} {}{more}", named.join(", "))
}

fn time(loaded: &Loaded, tally: &Tally, cycle_time_s: Option<[f64; 2]>) -> String {
    let mut text = match (cycle_time_s, &loaded.resolved.machine) {
        (Some([low, high]), _) => format!("cycle {} to {}", duration(low), duration(high)),
        (None, Some(_)) => {
            "cycle unknown: the time of some block is unknown on this machine (`--time` says which)".to_owned()
        }
        (None, None) => "cycle unknown without --machine".to_owned(),
    };
    let _ = write!(text, "; feed motions at the programmed feed {}", duration(tally.feed_s));
    if tally.untimed > 0 {
        let _ = write!(text, " ({} of unknown time not counted)", number(tally.untimed));
    }
    if tally.dwell_s > 0.0 {
        let _ = write!(text, "; dwell {}", duration(tally.dwell_s));
    }
    text
}

fn extents(tally: &Tally) -> Vec<String> {
    let known = AXIS_LETTERS.iter().zip(tally.axes).enumerate();
    known
        .filter_map(|(axis, (letter, range))| {
            let row = wide(char::from(*letter), range?, is_rotary(axis));
            Some(row + radius(tally, char::from(*letter)))
        })
        .collect()
}

/// What follows the values of X where its words are diameters.
fn radius(tally: &Tally, letter: char) -> &'static str {
    if tally.radii && letter == 'X' {
        " (radius; words of X are diameters)"
    } else {
        ""
    }
}

fn joints(tally: &Tally) -> Vec<String> {
    tally
        .joints
        .iter()
        .filter_map(|(letter, rotary, range)| Some(wide(*letter, (*range)?, *rotary) + radius(tally, *letter)))
        .collect()
}

/// The letters of axes with blanks between them.
fn is_rotary(axis: usize) -> bool {
    (3..6).contains(&axis)
}

/// `X    -25.409 ..     40.000 mm    65.409`.
fn wide(letter: char, range: Range, rotary: bool) -> String {
    let unit = if rotary { "deg" } else { "mm" };
    let (low, high) = (decimal(range.low, 3), decimal(range.high, 3));
    format!(
        "{letter} {low:>12} .. {high:>12} {unit:<3}  over {}",
        decimal(range.high - range.low, 3)
    )
}

fn tools(tally: &Tally) -> Vec<String> {
    let mut list: Vec<_> = tally.tools.iter().collect();
    list.sort_by_key(|(_, used)| used.line);
    let list = list.into_iter().map(|(tool, used)| {
        let name = tool.map_or_else(|| "not known".to_owned(), |number| format!("T{number}"));
        format!(
            "{name} from line {}: {}, feed {} mm",
            used.line,
            many(used.motions, "motion"),
            decimal(used.feed_mm, 3)
        )
    });
    list.collect()
}

/// `1 motion`, `2 motions`.
fn many(count: u64, what: &str) -> String {
    format!("{} {what}{}", number(count), if count == 1 { "" } else { "s" })
}

/// One value, or the lowest and highest.
fn span(range: Range, digits: usize) -> String {
    let short = |value: f64| decimal(value, digits).trim_end_matches(".000").to_owned();
    if range.low == range.high {
        short(range.low)
    } else {
        format!("{} .. {}", short(range.low), short(range.high))
    }
}

/// `12 345`.
fn number(value: u64) -> String {
    grouped(&value.to_string())
}

/// `-12 345.678`.
fn decimal(value: f64, digits: usize) -> String {
    let text = format!("{:.digits$}", tidy(value).abs());
    let (whole, fraction) = text.split_at(text.find('.').unwrap_or(text.len()));
    let zero = text.bytes().all(|byte| matches!(byte, b'0' | b'.'));
    let sign = if value < 0.0 && !zero { "-" } else { "" };
    format!("{sign}{}{fraction}", grouped(whole))
}

fn grouped(digits: &str) -> String {
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(' ');
        }
        out.push(digit);
    }
    out
}

/// `1 h 02 min 03 s`, `3 min 04 s`, `5.6 s`.
pub(super) fn duration(seconds: f64) -> String {
    if seconds < 59.95 {
        return format!("{seconds:.1} s");
    }
    let whole = seconds.round() as u64;
    let (hours, minutes, rest) = (whole / 3600, whole / 60 % 60, whole % 60);
    if hours > 0 {
        format!("{hours} h {minutes:02} min {rest:02} s")
    } else {
        format!("{minutes} min {rest:02} s")
    }
}

fn ends(range: Range) -> Value {
    json!([tidy(range.low), tidy(range.high)])
}

/// The form for programs.
pub(super) struct File<'t> {
    /// All fields but the calls.
    fields: Value,
    /// A million of them are written as they are.
    calls: &'t [Call],
}

impl Serialize for File<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let fields = self.fields.as_object();
        let mut map = serializer.serialize_map(None)?;
        for (key, value) in fields.into_iter().flatten() {
            match key.as_str() {
                "calls" => map.serialize_entry(key, &Calls(self.calls))?,
                _ => map.serialize_entry(key, value)?,
            }
        }
        map.end()
    }
}

struct Calls<'t>(&'t [Call]);

impl Serialize for Calls<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(
            self.0
                .iter()
                .map(|call| json!({ "name": call.name, "line": call.line, "count": call.count })),
        )
    }
}

/// See [`File`].
pub(super) fn json<'t>(
    loaded: &Loaded,
    tally: &'t Tally,
    cycle_time_s: Option<[f64; 2]>,
    time: Option<Value>,
) -> File<'t> {
    let resolved = &loaded.resolved;
    let unit = |rotary: bool| if rotary { "deg" } else { "mm" };
    let mut extents = Map::new();
    for (axis, (letter, range)) in AXIS_LETTERS.iter().zip(tally.axes).enumerate() {
        if let Some(range) = range {
            let key = format!("{}_{}", char::from(*letter).to_ascii_lowercase(), unit(is_rotary(axis)));
            extents.insert(key, ends(range));
        }
    }
    let mut joints = Map::new();
    for (letter, rotary, range) in &tally.joints {
        let key = format!("joint_{}_{}", letter.to_ascii_lowercase(), unit(*rotary));
        joints.insert(key, range.map_or(Value::Null, ends));
    }
    let mut feeds = Map::new();
    for (range, (_, key)) in tally.feed.iter().zip(FEEDS) {
        if let Some(range) = range {
            feeds.insert(key.to_owned(), ends(*range));
        }
    }
    let tools = tally.tools.iter().map(|(tool, used)| {
        json!({ "tool": tool, "line": used.line, "motions": used.motions, "feed_length_mm": tidy(used.feed_mm) })
    });
    let mut fields = json!({
        "path": loaded.name,
        "dialect": resolved.dialect.name,
        "dialect_reason": resolved.dialect_reason,
        "machine": resolved.machine.as_ref().map(|machine| &machine.id),
        "blocks": tally.blocks,
        "blocks_run": tally.run,
        "block_runs": tally.runs,
        "motions": tally.motions(),
        "motions_by_kind": tally.motions,
        "rapid_length_mm": tidy(tally.rapid_mm),
        "feed_length_mm": tidy(tally.feed_mm),
        "feed_length_spindle_off_mm": tidy(tally.spindle_off_mm),
        "motions_of_unknown_length": tally.unmeasured,
        "cycle_time_s": cycle_time_s.map(|time| time.map(tidy)),
        "feed_time_s": tidy(tally.feed_s),
        "feed_motions_of_unknown_time": tally.untimed,
        "dwell_s": tidy(tally.dwell_s),
        "extents": extents,
        "joints": joints,
        "x_is_radius": tally.radii,
        "feed": feeds,
        "spindle_rpm": tally.spindle.map(ends),
        "tools": tools.collect::<Vec<_>>(),
        "tool_changes": tally.tool_changes,
        "calls": null,
        "not_modelled": tally.not_modelled,
        "not_followed": tally.stop.as_ref().map(|(line, why)| json!({ "line": line, "why": why })),
    });
    if let (Some(time), Some(object)) = (time, fields.as_object_mut()) {
        object.insert("time".to_owned(), time);
    }
    let calls = &tally.calls;
    File { fields, calls }
}
