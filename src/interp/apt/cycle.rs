//! CYCLE records: what is said of a hole.
//!
//! Two ways to write it. By words: DEPTH or FEDTO the depth below the point, RAPTO or CLEAR where the feed begins above it, RTRCTO or
//! RETURN where the tool goes back to, STEP, INCR or 1STPECK and SUBPECK the pecks, DWELL. By places: CYCLE/DRILL,z,IPM,f,r or
//! CYCLE/DRILL,z,f,IPM,r,i. FEDTO may be signed along the tool axis; no tool drills away from the work, so its amount counts. With CLEAR,
//! RAPTO is measured from there towards the point; RETURN,0 is a retract plane that the record does not name.
//!
//! Sources: PTC, Creo Parametric help, "CL Output for Holemaking Cycles"; NX CLSF; SolidWorks CAM output and the programs posted from it
//! (depth 5.4 and retract 27.5 of the record are the cycle's depth and distance there).
use crate::{Feed, FeedMode};
use trunnion_syntax::{AptArg, Program, Record};

/// What a cycle does at the bottom of its hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Out {
    /// Back in rapid.
    Rapid,
    /// Back at the feed, the spindle as it is.
    Feed,
    /// Back at the feed, turning the other way.
    Tap,
    /// Back in rapid or at the feed: posts differ.
    Open,
}

/// How a hole is reached in steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pecks {
    /// One stroke.
    None,
    /// The first step and the others, mm; the tool leaves the hole after each.
    Deep(f64, f64),
    /// The same, with a short retract after each.
    Chip(f64, f64),
}

/// Where the tool goes after a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Back {
    /// This far above the point, mm.
    To(f64),
    /// To where it came from (RTRCTO,AUTO).
    Before,
    /// To a plane that the record does not name.
    Plane,
}

/// A time at the bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stay {
    /// Seconds.
    Seconds(f64),
    /// Turns of the spindle.
    Turns(f64),
}

/// A hole cycle that can be worked out, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hole {
    pub(crate) depth: f64,
    /// Where the feed begins, above the point.
    pub(crate) clear: f64,
    pub(crate) back: Back,
    pub(crate) pecks: Pecks,
    pub(crate) stay: Option<Stay>,
    /// `None`: the one in effect.
    pub(crate) feed: Option<Feed>,
    pub(crate) out: Out,
}

/// One argument.
enum Item {
    Word(String),
    Number(f64),
}

fn items(record: &Record<'_>) -> Option<Vec<Item>> {
    let mut items = Vec::new();
    for arg in record.args() {
        items.push(match arg {
            AptArg::Number(number, _) => Item::Number(number.to_f64()),
            AptArg::Word(range) => Item::Word(record.program.text(range).trim().to_ascii_uppercase()),
            AptArg::Other(range) => {
                // `1STPECK` is a word that begins with a digit
                let text = record.program.text(range).trim().to_ascii_uppercase();
                if !text.bytes().all(|byte| byte.is_ascii_alphanumeric()) {
                    return None;
                }
                Item::Word(text)
            }
        });
    }
    Some(items)
}

/// What the words of a record say, in its own unit.
#[derive(Default)]
struct WordValue {
    depth: Option<f64>,
    clear: Option<f64>,
    rapid_to: Option<f64>,
    back: Option<Back>,
    first: Option<f64>,
    step: Option<f64>,
    stay: Option<Stay>,
    feed: Option<Feed>,
}

/// The hole that a record describes, lengths in `unit` mm, or why it is not known. `mode`: that of FEDRAT, where the record names no unit.
pub(crate) fn hole(record: &Record<'_>, unit: f64) -> Result<Hole, String> {
    let items = items(record).ok_or("an argument that is neither a word nor a number")?;
    let Some((Item::Word(kind), rest)) = items.split_first() else {
        return Err("without its kind".to_owned());
    };
    let out = match kind.as_str() {
        "DRILL" | "FACE" | "CSINK" | "DEEP" | "DEEP2" | "BRKCHP" | "BRKCHP2" => Out::Rapid,
        "REAM" => Out::Feed,
        "TAP" => Out::Tap,
        "BORE" => Out::Open,
        _ => return Err(kind.clone()),
    };
    let said = said(rest, kind, unit)?;
    let depth = said.depth.ok_or("without a depth (DEPTH, FEDTO)")?.abs() * unit;
    let clear = match (said.clear, said.rapid_to) {
        (Some(clear), rapid_to) => clear - rapid_to.unwrap_or(0.0),
        (None, Some(rapid_to)) => rapid_to,
        (None, None) => return Err("without a clearance (CLEAR, RAPTO)".to_owned()),
    };
    let back = match said.back {
        Some(Back::To(value)) => Back::To(value * unit),
        Some(other) => other,
        None => Back::To(said.clear.unwrap_or(clear) * unit),
    };
    let pecks = match kind.as_str() {
        "DEEP" | "DEEP2" | "BRKCHP" | "BRKCHP2" => {
            let step = said.step.or(said.first).filter(|step| *step > 0.0);
            let step = step.ok_or("without a step (STEP, INCR, 1STPECK)")? * unit;
            let first = said
                .first
                .filter(|first| *first > 0.0)
                .map_or(step, |first| first * unit);
            if kind.starts_with("DEEP") {
                Pecks::Deep(first, step)
            } else {
                Pecks::Chip(first, step)
            }
        }
        _ if said.step.is_some() || said.first.is_some() => return Err(format!("{kind} with steps")),
        _ => Pecks::None,
    };
    Ok(Hole {
        depth,
        clear: clear * unit,
        back,
        pecks,
        stay: said.stay,
        feed: said.feed,
        out,
    })
}

/// Reads words with the number after each, and numbers by their places.
fn said(items: &[Item], kind: &str, unit: f64) -> Result<WordValue, String> {
    let mut said = WordValue::default();
    let mut rest = items.iter().peekable();
    // numbers before the first word
    let mut places = Vec::new();
    while let Some(Item::Number(value)) = rest.peek() {
        places.push(*value);
        rest.next();
    }
    let mut feed_unit: Option<(FeedMode, f64)> = None;
    let by_place = !places.is_empty();
    while let Some(item) = rest.next() {
        let Item::Word(word) = item else {
            return Err("a number without a word".to_owned());
        };
        let mut values = Vec::new();
        while let Some(Item::Number(value)) = rest.peek() {
            values.push(*value);
            rest.next();
        }
        if let Some(unit) = unit_of_feed(word, unit) {
            feed_unit = Some(unit);
            places.extend(values.iter().copied().filter(|_| by_place));
            if let (false, [value]) = (by_place, values.as_slice()) {
                said.feed = Some(feed(unit, *value));
            } else if !by_place {
                return Err(format!("{word} without one number"));
            }
            continue;
        }
        let value = match values.as_slice() {
            [value] => Some(*value),
            [] => None,
            _ => return Err(format!("more than one number after {word}")),
        };
        match (word.as_str(), value) {
            ("DEPTH" | "FEDTO", Some(_)) => said.depth = value,
            ("CLEAR", Some(_)) => said.clear = value,
            ("RAPTO", Some(_)) => said.rapid_to = value,
            ("RTRCTO", Some(value)) => said.back = Some(Back::To(value)),
            ("RETURN", Some(value)) => said.back = Some(if value == 0.0 { Back::Plane } else { Back::To(value) }),
            ("RTRCTO", None) => match rest.next() {
                Some(Item::Word(auto)) if auto == "AUTO" => said.back = Some(Back::Before),
                _ => return Err("RTRCTO without a number".to_owned()),
            },
            // NX: the distance is the user's, not the one that NX works out
            ("MANUAL", None) if matches!(said.back, Some(Back::To(_))) => {}
            ("STEP" | "INCR" | "SUBPECK", Some(_)) => said.step = value,
            ("1STPECK", Some(_)) => said.first = value,
            ("DWELL", Some(value)) => said.stay = (value > 0.0).then_some(Stay::Seconds(value)),
            ("REV", None) => match said.stay {
                Some(Stay::Seconds(turns)) => said.stay = Some(Stay::Turns(turns)),
                _ => return Err("REV".to_owned()),
            },
            // the feed of a tap is written beside its lead
            ("TPI", Some(_)) if kind == "TAP" => {}
            _ => return Err(format!("{kind} with {word}")),
        }
    }
    if by_place {
        by_places(&mut said, &places, feed_unit, kind)?;
    }
    Ok(said)
}

/// z, f and the unit of f, then r (of a tap after its threads per inch) and the step of a deep hole.
fn by_places(said: &mut WordValue, places: &[f64], unit: Option<(FeedMode, f64)>, kind: &str) -> Result<(), String> {
    let unit = unit.ok_or("a feed without its unit")?;
    let (&[depth, value], more) = places.split_first_chunk::<2>().ok_or("too few numbers")?;
    said.depth = Some(depth);
    said.feed = Some(feed(unit, value));
    let more = if kind == "TAP" && more.len() > 1 {
        &more[1..]
    } else {
        more
    };
    match more {
        &[clear] => said.clear = Some(clear),
        &[clear, step] if kind.starts_with("DEEP") || kind.starts_with("BRKCHP") => {
            (said.clear, said.step) = (Some(clear), Some(step));
        }
        [] => {}
        _ => return Err("more numbers than are known".to_owned()),
    }
    Ok(())
}

/// The unit that a word gives a feed: the mode, and mm for 1.
fn unit_of_feed(word: &str, unit: f64) -> Option<(FeedMode, f64)> {
    Some(match word {
        "MMPM" => (FeedMode::PerMinute, 1.0),
        "IPM" => (FeedMode::PerMinute, 25.4),
        "PERMIN" => (FeedMode::PerMinute, unit),
        "MMPR" => (FeedMode::PerRevolution, 1.0),
        "IPR" => (FeedMode::PerRevolution, 25.4),
        "PERREV" => (FeedMode::PerRevolution, unit),
        _ => return None,
    })
}

fn feed((mode, mm): (FeedMode, f64), value: f64) -> Feed {
    match mode {
        _ if value <= 0.0 => Feed::Unknown,
        FeedMode::PerRevolution => Feed::PerRevolution(value * mm),
        FeedMode::PerMinute | FeedMode::InverseTime => Feed::PerMinute(value * mm),
    }
}

/// Whether a record only ends a cycle, resumes one or announces one: it describes none.
pub(crate) fn describes_none(record: &Record<'_>, program: &Program) -> Option<&'static str> {
    let mut args = record.args();
    let (Some(AptArg::Word(range)), None) = (args.next(), args.next()) else {
        return None;
    };
    let text = program.text(range);
    ["OFF", "ON", "INIT", "NOMORE"]
        .into_iter()
        .find(|word| text.trim().eq_ignore_ascii_case(word))
}
