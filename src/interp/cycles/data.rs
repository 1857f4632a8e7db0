//! What drilling cycles keep from block to block.
use crate::arc::plane_axes;
use crate::codes::BlockCodes;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, ImplicitDecimals};
use trunnion_dialect::Action;

/// A value that a cycle keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Stored {
    /// Not given yet.
    #[default]
    Nothing,
    /// Given, but its value is unknown.
    Unknown,
    /// mm as a coordinate.
    At(f64),
    /// mm as a distance.
    By(f64),
}

impl Stored {
    /// How it was given, and the value.
    pub(super) fn numbers(self) -> [f64; 2] {
        match self {
            Self::Nothing => [0.0, 0.0],
            Self::Unknown => [1.0, 0.0],
            Self::At(value) => [2.0, value],
            Self::By(value) => [3.0, value],
        }
    }
    /// The coordinate, from the level that a distance is relative to.
    pub(crate) fn from(self, level: Option<f64>) -> Option<f64> {
        match self {
            Self::At(value) => Some(value),
            Self::By(distance) => level.map(|level| level + distance),
            Self::Nothing | Self::Unknown => None,
        }
    }
}

/// What drilling cycles keep.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hole {
    /// Coordinate of the drilling axis when the cycle was begun, mm.
    pub(super) initial: Option<f64>,
    pub(super) bottom: Stored,
    pub(super) r: Stored,
    /// Step or shift, mm.
    pub(super) q: Option<f64>,
    /// Dwell, seconds.
    pub(super) dwell: Option<f64>,
    /// How many times the feed a tap goes out with (J of a Haas).
    pub(super) times: Option<f64>,
    /// I, J, K where the cycle reads them, mm.
    pub(super) ijk: [Option<f64>; 3],
}

impl Hole {
    /// A cycle is defined in a block that is not followed (NCYL of an Okuma): what it keeps is not known.
    pub(crate) fn not_read(&mut self) {
        self.r = Stored::Unknown;
        self.bottom = Stored::Unknown;
    }
    /// All of it; NaN: not given, or unknown.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        let [i, j, k] = self.ijk;
        let plain = [self.initial, self.q, self.dwell, self.times, i, j, k];
        let plain = plain.map(|value| value.unwrap_or(f64::NAN));
        let stored = [self.bottom.numbers(), self.r.numbers()];
        stored.into_iter().flatten().chain(plain)
    }
    /// Nothing but the level before the cycle, mm.
    pub(crate) fn from(initial: Option<f64>) -> Self {
        Self {
            initial,
            ..Self::default()
        }
    }
}

impl Iso<'_> {
    /// G71 Z of an Okuma: the level to which cycles return. Under G91 no source says from where it counts.
    pub(crate) fn return_level(&mut self, words: &Words, block: &mut BlockCodes) {
        block.takes_coordinates = true;
        let axis = plane_axes(self.core.state.coordinates.plane())[2];
        let unit = self.core.state.coordinates.unit_mm();
        let value = words
            .axes
            .get(axis)
            .filter(|_| !self.core.state.coordinates.incremental());
        self.memory.cycle.level = value.map_or(Stored::Unknown, |value| Stored::At(value * unit));
    }

    /// Where a cycle of an Okuma returns to: the level of G71 under M53. Without both it is not known.
    pub(super) fn level_of_return(&self, words: &Words, r: Option<f64>, report: &mut Report<'_>) -> Option<f64> {
        let cycle = &self.memory.cycle;
        let level = cycle.level.from(None).filter(|_| cycle.to_level);
        let above = level.filter(|level| r.is_none_or(|r| *level >= r));
        if above.is_none() {
            let what = format!(
                "{}: the level to which it returns, without G71 Z above R and M53",
                cycle.id
            );
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
        above
    }

    /// I and J in a cycle of steps of an Okuma: what they do is not followed.
    pub(super) fn asks_depths(&self, words: &Words, report: &mut Report<'_>) -> bool {
        let given = words.letter(b'I').is_given() || words.letter(b'J').is_given();
        let asks = given && self.core.dialect.quirks.user_task();
        if asks {
            let what = format!("{}: I and J, the depths of its steps", self.memory.cycle.id);
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
        asks
    }

    /// Q in a tapping cycle of a Fanuc, also one that G83 before it left: it pecks. Whether the tap goes back by a distance or to R between its
    /// steps is a parameter (FANUC B-64490EN, parameter 5200, bit 5), so the way down is not followed.
    pub(super) fn asks_pecks(&self, words: &Words, report: &mut Report<'_>) {
        let cycle = &self.memory.cycle;
        let taps = matches!(self.core.state.motion, Some(Action::TapCycle | Action::TapLeftCycle));
        if taps && cycle.reads_letter(b'Q') && cycle.hole.q.is_some_and(|q| q != 0.0) {
            let what = format!("{}: how far the tap goes back between the steps of Q", cycle.id);
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
    }

    /// A word that is a length without being a coordinate, mm: Q, I, J, K of a cycle.
    pub(crate) fn length_word(&self, words: &Words, letter: u8) -> Option<f64> {
        let number = words.letter(letter).number()?;
        let least = self.core.setup.control.implicit_decimals == Some(ImplicitDecimals::LeastIncrement);
        let value = match (least && !number.has_point, self.core.state.coordinates.unit_mm() != 1.0) {
            (true, true) => number.value / 10_000.0,
            (true, false) => number.value / 1000.0,
            (false, _) => number.value,
        };
        Some(value * self.core.state.coordinates.unit_mm())
    }

    /// The same of a turning cycle in one block. Without a decimal point controls take it for least increments or for millimetres, whatever
    /// they do with coordinates: `None` where the settings do not say.
    pub(super) fn one_block_length(&self, words: &Words, letter: u8) -> Option<f64> {
        let has_point = words.letter(letter).number()?.has_point;
        (has_point || self.core.setup.control.implicit_decimals.is_some()).then(|| self.length_word(words, letter))?
    }

    /// Keeps the data of a block.
    pub(super) fn store_hole(&mut self, words: &Words, axis: usize) {
        let stored = |said: bool, value: Option<f64>, incremental: bool| match (said, value) {
            (false, _) => None,
            (true, None) => Some(Stored::Unknown),
            (true, Some(value)) if incremental => Some(Stored::By(value)),
            (true, Some(value)) => Some(Stored::At(value)),
        };
        let incremental = self.core.state.coordinates.incremental();
        let unit = self.core.state.coordinates.unit_mm();
        let z = words.axes.get(axis).map(|value| value * unit);
        let z_said = (words.axes.given | words.axes.unread) & (1 << axis) != 0;
        let bottom = stored(z_said, z, incremental);
        let r = words.radius.number().map(|number| number.value * unit);
        let r = stored(words.radius.is_given(), r, incremental);
        let q = self.length_word(words, b'Q');
        // P of a call is a program
        let p = words.p.number().filter(|_| !words.flow);
        let dwell = p.map(|p| {
            let ms = self.core.dialect.quirks.dwell_in_ms && !p.has_point;
            if ms { p.value / 1000.0 } else { p.value }
        });
        let reads = self.memory.cycle.reads;
        let ijk = [(b'I', reads[0]), (b'J', reads[1]), (b'K', reads[2])];
        let ijk = ijk.map(|(letter, reads)| self.length_word(words, letter).filter(|_| reads));
        let taps = matches!(self.core.state.motion, Some(Action::TapCycle | Action::TapLeftCycle));
        let times = words.letter(b'J').number().filter(|_| taps).map(|number| number.value);
        let hole = &mut self.memory.cycle.hole;
        hole.bottom = bottom.unwrap_or(hole.bottom);
        hole.r = r.unwrap_or(hole.r);
        hole.q = q.or(hole.q);
        hole.dwell = dwell.or(hole.dwell);
        hole.times = times.or(hole.times);
        for (kept, given) in hole.ijk.iter_mut().zip(ijk) {
            *kept = given.or(*kept);
        }
    }
}
