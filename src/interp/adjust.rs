//! How a control interprets words before it acts on them: increments and diameters of a lathe, and numbers without a decimal point.
use crate::codes::{Found, dwell_reads};
use crate::core::LINEAR;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{FaultKind, FeedMode, ImplicitDecimals};
use trunnion_dialect::{Action, Role};

/// Letters of distances and the axes that they move.
const INCREMENTS: [(u8, usize); 4] = [(b'U', 0), (b'V', 1), (b'W', 2), (b'H', 5)];

impl Iso<'_> {
    /// Replaces the words of the block by their meaning.
    #[cold]
    pub(crate) fn adjust(&self, codes: &[Found<'_>], words: &mut Words, report: &mut Report<'_>) {
        let has = |action: Action| codes.iter().any(|found| found.code.action == action);
        if self.core.dialect.quirks.diameter {
            self.increments(words, report);
        }
        match self.core.setup.control.implicit_decimals {
            Some(ImplicitDecimals::LeastIncrement) => {
                let inch = if has(Action::Inch) || has(Action::Metric) {
                    has(Action::Inch)
                } else {
                    self.core.state.coordinates.unit_mm() != 1.0
                };
                self.least_increments(codes, words, inch);
            }
            Some(ImplicitDecimals::Calculator) => words.axes.point |= words.axes.given,
            None => {}
        }
        self.x_as_radius(codes, words, report);
        self.core.drawing_words(codes, words);
    }

    /// U, V, W, H are distances of X, Y, Z, C. Which of both counts in a block with X and U is in no source of this project.
    fn increments(&self, words: &mut Words, report: &mut Report<'_>) {
        for (letter, axis) in INCREMENTS {
            if self.core.dialect.role(letter) != Some(Role::Increment) {
                continue;
            }
            let bit = 1 << axis;
            let said = words.letter(letter);
            if said.is_given() && (words.axes.given | words.axes.unread) & bit != 0 {
                let absolute = char::from(crate::AXIS_LETTERS[axis]);
                let what = format!(
                    "{absolute} and {} in one block: which of both counts (write one of them)",
                    char::from(letter)
                );
                report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
                words.axes.given &= !bit;
                words.axes.unread |= bit;
                continue;
            }
            match said {
                WordValue::Nothing => {}
                WordValue::Number(number) => {
                    words.axes.values[axis] = number.value;
                    words.axes.given |= bit;
                    words.axes.incremental |= bit;
                    words.axes.point |= u16::from(number.has_point) << axis;
                    words.first = words.first.or(Some(number.range));
                }
                WordValue::Name(_) | WordValue::Unread => words.axes.unread |= bit,
            }
        }
    }

    /// Coordinates without a decimal point are in units of 0.001 mm or degrees, 0.0001 inch; F 1 mm/min, 0.01 inch/min, 0.01 mm/turn, 0.0001 inch/turn
    /// (Fanuc Series 30i operator's manual, least input increment IS-B).
    fn least_increments(&self, codes: &[Found<'_>], words: &mut Words, inch: bool) {
        let divisor = if inch { 10_000.0 } else { 1000.0 };
        let whole = words.axes.given & !words.axes.point;
        for axis in (0..9).filter(|axis| whole & (1 << axis) != 0) {
            let linear = LINEAR & (1 << axis) != 0;
            words.axes.values[axis] /= if linear { divisor } else { 1000.0 };
        }
        words.axes.point |= whole;
        if !self.core.state.tool_axis.vectors() {
            let whole = words.centre.given & !words.centre.point;
            for place in (0..3).filter(|place| whole & (1 << place) != 0) {
                words.centre.values[place] /= divisor;
            }
            words.centre.point |= whole;
        }
        let scale = |said: &mut WordValue, divisor: f64| {
            if let WordValue::Number(number) = said
                && !number.has_point
            {
                number.value /= divisor;
                number.has_point = true;
            }
        };
        // R of a rotation is an angle
        let turns = codes.iter().any(|found| found.code.action == Action::RotationOn);
        scale(&mut words.radius, if turns { 1000.0 } else { divisor });
        let mode = codes
            .iter()
            .rev()
            .find_map(|found| crate::feed_speed::meaning_of_feed(found.code))
            .unwrap_or(self.core.state.feed.mode());
        let feed = match (mode, inch) {
            (FeedMode::PerMinute, true) | (FeedMode::PerRevolution, false) => 100.0,
            (FeedMode::PerRevolution, true) => 10_000.0,
            _ => 1.0,
        };
        scale(&mut words.feed, feed);
    }

    /// Reports F without a decimal point where a setting of the control reads it as written or as least increments. On a Haas that is every F. On a
    /// Fanuc F in mm/min is whole mm/min either way; in inch, per turn, as a lead and in inverse time it is not (FANUC B-64490EN, parameters
    /// 1404, 1405 and 3401; B-62764EN, inverse time feed).
    pub(crate) fn whole_feed(&mut self, codes: &[Found<'_>], words: &Words, report: &mut Report<'_>) {
        let feed = words.feed.number().filter(|feed| !feed.has_point && feed.value != 0.0);
        let Some(feed) = feed.filter(|_| !dwell_reads(codes, "F")) else {
            return;
        };
        let (mode, metric) = (
            self.core.state.feed.mode(),
            self.core.state.coordinates.unit_mm() == 1.0,
        );
        let of_setting = self.core.dialect.quirks.whole_numbers.feeds_ambiguous();
        let thread = |action| matches!(action, Action::Thread | Action::VariableThread);
        let leads = codes.iter().any(|found| thread(found.code.action)) || self.core.state.motion.is_some_and(thread);
        let implicit = self.core.setup.control.implicit_decimals;
        let open = match mode {
            _ if of_setting => mode != FeedMode::InverseTime,
            // the manuals read do not agree on the least increment of an inverse time
            FeedMode::InverseTime if implicit == Some(ImplicitDecimals::LeastIncrement) => true,
            _ if implicit.is_some() => false,
            FeedMode::PerMinute => !metric || leads,
            FeedMode::PerRevolution | FeedMode::InverseTime => true,
        };
        if !open {
            return;
        }
        report.fault(feed.range, FaultKind::AmbiguousDecimal);
        if mode == FeedMode::PerMinute && (of_setting || metric) {
            return;
        }
        // the two readings are a factor of 100 and more apart
        let what = if implicit.is_some() {
            "the feed F without a decimal point under G93: write the point"
        } else {
            "the feed F without a decimal point: a parameter decides its unit (write the point, or declare [control] implicit_decimals)"
        };
        report.fault(feed.range, FaultKind::NotModelled { what: what.to_owned() });
        self.core.state.feed.set(None);
        self.core.feed_unread = true;
    }

    /// Whether a parameter decides how long a dwell is that an axis word without a decimal point gives: seconds or least increments
    /// (FANUC B-64490EN, parameter 3401, bit 0).
    pub(crate) fn is_whole_dwell(&self, words: &Words, axis: usize) -> bool {
        let open = self.core.setup.control.implicit_decimals.is_none();
        let whole = words.axes.point & (1 << axis) == 0 && words.axes.values[axis] != 0.0;
        open && whole && self.core.dialect.quirks.whole_numbers.lengths_ambiguous()
    }
}
