//! F and S of a block, and what its codes make of them.
use crate::codes::{Found, dwell_reads};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, FeedMode};
use trunnion_dialect::{Action, Code, CodeKind};
use trunnion_syntax::TextRange;

/// A foot in m: S of G96 is in feet per minute where lengths are in inches.
pub(crate) const METRES_PER_FOOT: f64 = 0.3048;

impl Iso<'_> {
    pub(crate) fn feed_mode(&mut self, mode: FeedMode) {
        if self.core.state.feed.mode() != mode {
            self.core.state.feed.switch_mode(mode);
            self.core.feed_unread = false;
        }
    }

    pub(crate) fn feed_word(&mut self, codes: &[Found<'_>], words: &Words) {
        if self.core.state.feed.mode() == FeedMode::InverseTime {
            self.core.state.feed.set(None);
            self.core.feed_unread = false;
        }
        if words.other_feed {
            self.core.state.feed.set(None);
            self.core.feed_unread = true;
            return;
        }
        if !words.feed.is_given() || dwell_reads(codes, "F") {
            return;
        }
        let unit = if self.core.state.feed.mode() == FeedMode::InverseTime {
            1.0
        } else {
            self.core.state.feed.unit_mm()
        };
        self.core
            .state
            .feed
            .set(words.feed.number().map(|number| number.value * unit));
        self.core.feed_unread = self.core.state.feed.value().is_none();
    }

    /// OVR= and OVRRAP=: another share than 100 % makes feeds and rapids unknown, as do the switches of the operator, which are taken as 100 %.
    pub(crate) fn override_words(&mut self, words: &Words, report: &mut Report<'_>) {
        let overridden = &mut self.core.overridden;
        for (said, other, what) in [
            (
                words.feed_share,
                &mut overridden.0,
                "OVR: feeds of another share than 100 %",
            ),
            (
                words.rapid_share,
                &mut overridden.1,
                "OVRRAP: rapids of another share than 100 %",
            ),
        ] {
            if !said.is_given() {
                continue;
            }
            let share = said.number();
            *other = share.map(|share| share.value) != Some(100.0);
            if *other {
                let range = share.map_or_else(TextRange::default, |share| share.range);
                report.fault(range, FaultKind::NotModelled { what: what.to_owned() });
            }
        }
    }

    pub(crate) fn speed_word(&mut self, codes: &[Found<'_>], words: &Words) {
        // G92 S, G26 S and the like limit the speed
        let limits = |found: &Found<'_>| match found.code.action {
            Action::FrameChange | Action::PositionSet => !words.axes.any(),
            Action::NotFollowed => found.code.kind == CodeKind::G,
            _ => false,
        };
        let limit = || codes.iter().any(limits);
        if words.speed.is_given() && !dwell_reads(codes, "S") && !limit() {
            let value = words.speed.number().map(|number| number.value);
            let state = &mut self.core.state;
            if state.spindle.surface_speed() {
                // S is in feet per minute where lengths are in inches
                let unit = if state.coordinates.unit_mm() == 1.0 {
                    1.0
                } else {
                    METRES_PER_FOOT
                };
                state.spindle.set_cutting_speed(value.map(|value| value * unit));
            } else {
                state.spindle.set_rpm(value);
            }
        }
    }
}

/// What F means after a code; `None`: the code leaves that as it is.
pub(crate) fn meaning_of_feed(code: &Code) -> Option<FeedMode> {
    match code.feed.unwrap_or(code.action) {
        Action::FeedInverseTime => Some(FeedMode::InverseTime),
        Action::FeedPerMinute => Some(FeedMode::PerMinute),
        Action::FeedPerRevolution => Some(FeedMode::PerRevolution),
        _ => None,
    }
}
