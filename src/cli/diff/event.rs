//! What a program does, in order: motions with what is in force, and what cannot be compared in numbers, by its words.
use super::point::Point;
use std::sync::Arc;
use trunnion_dialect::{Action, Dialect, Role};
use trunnion_interp::{FaultKind, Feed, LengthOf, ModalState, Motion};
use trunnion_syntax::{Address, Block, BlockId, Format, Item, Value};

/// One thing that happens.
#[derive(Clone, Debug)]
pub(super) struct Event {
    pub(super) block: BlockId,
    pub(super) body: Body,
}

#[derive(Clone, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "nearly all events are motions, and a box for each would cost more"
)]
pub(super) enum Body {
    Motion(Point, Tech),
    /// Words that say more than numbers do: stops, ends, what is recognised and not modelled.
    Statement(String),
}

/// What is in force in a motion. Numbers as bits, so that it can be looked up.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Tech {
    feed: (&'static str, u64),
    rpm: Option<u64>,
    spindle: Option<bool>,
    tool: Option<u32>,
    length: u64,
    length_of: LengthOf,
    offset: Option<Arc<str>>,
    zero: [u64; 9],
    compensation: u8,
    coolant: Coolant,
}

/// Coolant: bit 0 mist, bit 1 flood.
pub(super) type Coolant = u8;

impl Tech {
    pub(super) fn new(motion: &Motion, state: &ModalState) -> Self {
        let feed = match motion.feed {
            _ if !motion.is_feed() => ("", 0.0),
            Feed::PerMinute(feed) => ("mm/min", feed),
            Feed::PerRevolution(feed) => ("mm/rev", feed),
            Feed::InverseTime(feed) => ("1/min", feed),
            Feed::Unknown => ("?", 0.0),
            Feed::Rapid => ("", 0.0),
        };
        Self {
            feed: (feed.0, (feed.1 + 0.0).to_bits()),
            rpm: motion.spindle_rpm.map(|rpm| (rpm + 0.0).to_bits()),
            spindle: motion.spindle_on,
            tool: motion.tool,
            length: (motion.tool_length_mm + 0.0).to_bits(),
            length_of: state.length_of,
            offset: state.work_offset.clone(),
            zero: motion.zero.map(|value| (value + 0.0).to_bits()),
            compensation: state.compensation,
            coolant: 0,
        }
    }

    /// With another coolant.
    pub(super) fn with_coolant(self, coolant: Coolant) -> Self {
        Self { coolant, ..self }
    }

    /// What differs: its name, before and after.
    pub(super) fn differences(&self, other: &Self) -> Vec<(&'static str, String, String)> {
        let mut found = Vec::new();
        let mut pair = |name, a: String, b: String| {
            if a != b {
                found.push((name, a, b));
            }
        };
        pair("feed", feed(self.feed), feed(other.feed));
        let rpm = |tech: &Self| {
            tech.rpm
                .map_or("unknown".to_owned(), |bits| format!("{} 1/min", f64::from_bits(bits)))
        };
        pair("spindle speed", rpm(self), rpm(other));
        let on = |tech: &Self| match tech.spindle {
            Some(true) => "on",
            Some(false) => "off",
            None => "unknown",
        };
        pair("spindle", on(self).to_owned(), on(other).to_owned());
        let tool = |tech: &Self| tech.tool.map_or("unknown".to_owned(), |number| format!("T{number}"));
        pair("tool", tool(self), tool(other));
        let mm = |bits| format!("{} mm", f64::from_bits(bits));
        pair("tool length", mm(self.length), mm(other.length));
        pair(
            "tool length in force",
            self.length_of.to_string(),
            other.length_of.to_string(),
        );
        let offset = |tech: &Self| tech.offset.as_deref().unwrap_or("none").to_owned();
        pair("work offset", offset(self), offset(other));
        if self.zero != other.zero && self.offset == other.offset {
            let zero = |tech: &Self| tech.zero.map(f64::from_bits).map(|value| value.to_string()).join(" ");
            pair("zero point", zero(self), zero(other));
        }
        let side = |tech: &Self| match tech.compensation {
            0 => "off".to_owned(),
            code => format!("G{code}"),
        };
        pair("radius compensation", side(self), side(other));
        pair(
            "coolant",
            coolant_name(self.coolant).to_owned(),
            coolant_name(other.coolant).to_owned(),
        );
        found
    }
}

fn feed((unit, bits): (&'static str, u64)) -> String {
    match unit {
        "" => "none".to_owned(),
        "?" => "unknown".to_owned(),
        unit => format!("{} {unit}", f64::from_bits(bits)),
    }
}

fn coolant_name(coolant: Coolant) -> &'static str {
    ["off", "mist", "flood", "mist and flood"][usize::from(coolant & 3)]
}

/// The coolant after a block: M7, M8 and M9, or COOLNT of APT.
pub(super) fn coolant(block: &Block<'_>, mut now: Coolant) -> Coolant {
    if block.program().options().format == Format::Apt {
        let Some(record) = block.record().filter(|record| record.is("COOLNT")) else {
            return now;
        };
        let text = block.program().text(record.range).to_ascii_uppercase();
        return if text.contains("OFF") {
            0
        } else if text.contains("MIST") {
            1
        } else {
            2
        };
    }
    for word in block.words() {
        if let (Address::Letter(b'M'), Value::Number(number)) = (word.address, word.value) {
            match number.to_integer() {
                Some(7) => now |= 1,
                Some(8) => now |= 2,
                Some(9 | 2 | 30) => now = 0,
                _ => {}
            }
        }
    }
    now
}

/// Whether a fault means that its block says more than its motions hold.
pub(super) fn says_more(kind: &FaultKind) -> bool {
    !matches!(
        kind,
        FaultKind::MissingFeed { .. }
            | FaultKind::ArcRadiusMismatch { .. }
            | FaultKind::ArcRadiusTooSmall { .. }
            | FaultKind::VectorNotUnit { .. }
            | FaultKind::AmbiguousDecimal
            | FaultKind::TcpState(_)
            | FaultKind::MissingProgramEnd
            | FaultKind::WorkOffsetUnset { .. }
            | FaultKind::ToolLengthUnset { .. }
            | FaultKind::UnknownWord
            | FaultKind::RepeatedWord
            | FaultKind::UnusedWord
    )
}

/// The words of a block that no number holds; of the whole block, if `whole`. `None` where there are none.
pub(super) fn statement(block: &Block<'_>, dialect: &Dialect, whole: bool) -> Option<String> {
    let program = block.program();
    let text = |range| {
        program
            .text(range)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
            .to_ascii_uppercase()
    };
    if program.options().format == Format::Apt {
        let record = block.record()?;
        let ends = record.is("FINI") || record.is("STOP") || record.is("OPSTOP");
        return (whole || ends).then(|| text(record.range));
    }
    let mut parts = Vec::new();
    for item in block.items() {
        match item {
            Item::Word(word) => {
                let role = match word.address {
                    Address::Letter(letter) => dialect.role(letter),
                    _ => None,
                };
                if role != Some(Role::BlockNumber) && (whole || stops(dialect, role, word.value)) {
                    parts.push(canonical(&text(word.range)));
                }
            }
            Item::Call(call) if whole => parts.push(text(call.range)),
            Item::Skip(_, range) => parts.push(text(range)),
            Item::Label(range) | Item::Other(range) if whole => parts.push(text(range)),
            _ => {}
        }
    }
    // block delete alone says only that the block may be skipped, and that belongs to what it does
    (!parts.is_empty()).then(|| parts.join(" "))
}

/// Whether an M word says something that no motion holds: a stop, an end, a function of the machine.
fn stops(dialect: &Dialect, role: Option<Role>, value: Value) -> bool {
    let (Some(Role::M), Value::Number(number)) = (role, value) else {
        return false;
    };
    let code = number
        .to_integer()
        .and_then(|number| dialect.m((number * 10).try_into().ok()?));
    let coolant = matches!(number.to_integer(), Some(7..=9));
    !coolant
        && code.is_none_or(|code| {
            matches!(
                code.action,
                Action::ProgramStop | Action::ProgramEnd | Action::NoMotion | Action::NotModelled
            )
        })
}

/// A word without blanks inside and zeros in front: `M06` and `M 6` are `M6`.
fn canonical(word: &str) -> String {
    let packed: String = word.split_whitespace().collect();
    match (packed.get(..1), packed.get(1..)) {
        (Some(letter @ ("G" | "M" | "T")), Some(rest)) if rest.starts_with('0') && rest.len() > 1 => {
            let digits = rest.trim_start_matches('0');
            let zero = if digits.is_empty() || digits.starts_with('.') {
                "0"
            } else {
                ""
            };
            format!("{letter}{zero}{digits}")
        }
        _ => packed,
    }
}
