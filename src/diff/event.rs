//! What a program does, in order: motions with their modal state, and everything else by its words.
use crate::point::Point;
use std::sync::Arc;
use trunnion_interp::{Feed, LengthOf, Motion};
use trunnion_same::Step;
use trunnion_syntax::BlockId;

/// One event.
#[derive(Clone, Debug)]
pub(crate) struct Event {
    pub(crate) block: BlockId,
    pub(crate) body: Body,
}

/// What happens.
#[derive(Clone, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "nearly all events are motions, and a box for each would cost more"
)]
pub enum Body {
    /// A motion and its modal state.
    Motion(Point, Tech),
    /// Words: stops, ends, outputs, what is recognised and not modelled.
    Statement(String),
}

/// The modal state of a motion. Numbers as bits, so that it can be looked up.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tech {
    feed: (&'static str, u64),
    tool: Option<u32>,
    length: u64,
    length_of: LengthOf,
    offset: Option<Arc<str>>,
    zero: [u64; 9],
    compensation: u8,
    machine_coordinates: bool,
    great_circle: Option<bool>,
    settings: Settings,
}

/// Settings as people read them, in the order of their keys.
pub(crate) type Settings = Arc<[(String, String)]>;

impl Tech {
    /// `settings`: those of the step's process.
    pub(crate) fn new(step: &Step, settings: Settings) -> Self {
        let motion: &Motion = &step.motion;
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
            tool: motion.tool,
            length: (motion.tool_length_mm + 0.0).to_bits(),
            length_of: step.held.length_of,
            offset: step.held.work_offset.clone(),
            zero: motion.zero.map(|value| (value + 0.0).to_bits()),
            compensation: step.held.compensation,
            machine_coordinates: motion.machine_coordinates,
            great_circle: motion.great_circle.filter(|_| motion.tcp),
            settings,
        }
    }

    /// What differs: its name, before and after.
    pub fn differences(&self, other: &Self) -> Vec<(String, String, String)> {
        let mut found = Vec::new();
        let mut pair = |name: &str, a: String, b: String| {
            if a != b {
                found.push((name.to_owned(), a, b));
            }
        };
        pair("feed", feed(self.feed), feed(other.feed));
        let tool = |tech: &Self| tech.tool.map_or("unknown".to_owned(), |number| format!("T{number}"));
        pair("tool", tool(self), tool(other));
        let mm = |bits| format!("{} mm", f64::from_bits(bits));
        pair("tool length", mm(self.length), mm(other.length));
        pair(
            "active tool length",
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
        let yes = |on: bool| if on { "on" } else { "off" }.to_owned();
        pair(
            "machine coordinates",
            yes(self.machine_coordinates),
            yes(other.machine_coordinates),
        );
        let circle = |tech: &Self| {
            match tech.great_circle {
                Some(true) => "great circle",
                Some(false) => "linear in the axes",
                None => "as the machine does it",
            }
            .to_owned()
        };
        pair("tool axis between ends", circle(self), circle(other));
        let value = |tech: &Self, key: &str| {
            let known = tech.settings.iter().find(|(known, _)| known == key);
            known.map_or("not programmed".to_owned(), |(_, value)| value.clone())
        };
        let mut keys: Vec<&str> = self
            .settings
            .iter()
            .chain(other.settings.iter())
            .map(|(key, _)| key.as_str())
            .collect();
        keys.sort_unstable();
        keys.dedup();
        for key in keys {
            pair(key, value(self, key), value(other, key));
        }
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
