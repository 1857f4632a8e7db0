//! Machining cycles as they are defined: 200 to 209, 240, 241 by their Q parameters, which are found by number; others by number only.
//!
//! Sources: cycle manuals -07 and -08 of the TNC 640; the orders and signs of 200, 201, 203 and 207 also in programs of shops.
use super::Klartext;
use super::old_cycle::OldCycle;
use super::values::Value;
use super::words::{Parameter, Said, Words};
use crate::core::Report;

/// The feed of a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum CycleFeed {
    #[default]
    Missing,
    Value(Value),
    /// FMAX, MAX.
    Rapid,
    /// FAUTO, and FU, FZ, which are not known.
    Auto,
    Unknown,
}

/// A hole.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hole {
    pub(crate) cycle: u32,
    /// The parameters of its definition.
    pub(crate) given: Vec<(Parameter, Value)>,
    /// Q200, Q201, Q203, Q204, in the program's unit.
    pub(crate) clear: Value,
    pub(crate) depth: Value,
    pub(crate) surface: Value,
    pub(crate) second: Value,
    /// Q206, Q208.
    pub(crate) feed: CycleFeed,
    pub(crate) back_feed: CycleFeed,
    /// Q202, Q205, Q212, Q213, Q256.
    pub(crate) peck: Value,
    pub(crate) least_peck: Value,
    pub(crate) shrink: Value,
    pub(crate) breaks: Value,
    pub(crate) chip: Value,
    /// Q210, Q211.
    pub(crate) stay_above: Value,
    pub(crate) stay: Value,
    /// Q214, Q239, Q257, Q343, Q379, Q395.
    pub(crate) direction: Value,
    pub(crate) pitch: Value,
    pub(crate) chip_depth: Value,
    pub(crate) by_diameter: Value,
    pub(crate) start: Value,
    pub(crate) reference: Value,
}

/// More parameters than a cycle has.
const MOST_GIVEN: usize = 64;

impl Hole {
    /// A parameter of the definition: the last value counts. False: there are too many.
    fn give(&mut self, parameter: Parameter, value: Value) -> bool {
        let room = self.given.len() < MOST_GIVEN;
        match self.given.iter_mut().find(|(known, _)| *known == parameter) {
            Some((_, held)) => *held = value,
            None if room => self.given.push((parameter, value)),
            None => return false,
        }
        true
    }
}

/// The cycle that a call runs.
#[derive(Clone, Debug, Default)]
pub(crate) enum Cycle {
    #[default]
    None,
    Hole(Box<Hole>),
    /// One whose path is not followed.
    Other(u32),
    /// One of old controls (1 to 18), whose words depend on the language.
    Old(Box<OldCycle>),
}

impl Klartext<'_> {
    /// The Q parameters of a CYCL DEF above 199.
    pub(crate) fn read_cycle(&mut self, cycle: u32, words: &mut Words<'_>, report: &mut Report<'_>) -> Cycle {
        let mut hole = Hole {
            cycle,
            ..Hole::default()
        };
        let mut beyond = false;
        while let Some(word) = words.next() {
            let Said::Parameter(false, parameter) = word.value else {
                continue;
            };
            if !word.name().is_empty() || !words.takes(b'=') {
                continue;
            }
            words.blanks();
            let said = words.value();
            let feed = match said {
                Said::Nothing => match words.next() {
                    Some(word) if word.is("MAX") || word.is("FMAX") => CycleFeed::Rapid,
                    Some(word) if word.is("FAUTO") => CycleFeed::Auto,
                    _ => CycleFeed::Unknown,
                },
                Said::Sign(_) | Said::Text(_) => CycleFeed::Unknown,
                said => CycleFeed::Value(self.said(said, report)),
            };
            let value = match feed {
                CycleFeed::Value(value) => value,
                _ => None,
            };
            // cycles write their parameters
            self.memory.parameters.set(parameter, value);
            if !hole.give(parameter, value) && !std::mem::replace(&mut beyond, true) {
                let message = format!(
                    "CYCL DEF {cycle} names more than {MOST_GIVEN} parameters: remove those that are not the cycle's"
                );
                Self::rejected(crate::Refusal::CannedCycle, message, report);
            }
            match parameter.number {
                200 => hole.clear = value,
                201 => hole.depth = value,
                203 => hole.surface = value,
                204 => hole.second = value,
                206 => hole.feed = feed,
                208 => hole.back_feed = feed,
                202 => hole.peck = value,
                205 => hole.least_peck = value,
                212 => hole.shrink = value,
                213 => hole.breaks = value,
                256 => hole.chip = value,
                210 => hole.stay_above = value,
                211 => hole.stay = value,
                214 => hole.direction = value,
                239 => hole.pitch = value,
                257 => hole.chip_depth = value,
                343 => hole.by_diameter = value,
                379 => hole.start = value,
                395 => hole.reference = value,
                _ => {}
            }
        }
        match cycle {
            200..=203 | 205..=209 | 240 | 241 => Cycle::Hole(Box::new(hole)),
            _ => Cycle::Other(cycle),
        }
    }
}

impl Hole {
    /// Whether its depth is that of the tip, from the surface on.
    pub(crate) fn is_by_tip(&self) -> bool {
        let zero = |value: Value| value.is_none_or(|value| value == 0.0);
        zero(self.reference) && zero(self.by_diameter) && zero(self.start)
    }
    /// Whether the depth, mm, is reached in one step.
    pub(crate) fn is_single(&self, depth: f64, unit: f64) -> bool {
        let peck = self.peck.map(|peck| peck * unit).filter(|peck| *peck > 0.0);
        peck.is_none_or(|peck| peck >= depth.abs() - super::drill::SAME_LEVEL)
    }
    /// The name of what the tool does, as other controls call it.
    pub(crate) fn taps(&self) -> bool {
        matches!(self.cycle, 206 | 207 | 209)
    }
}
