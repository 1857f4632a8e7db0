//! Feed and spindle of drilling cycles that are called with their numbers.
use super::called::{Given, HoleCall, Sort};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, FeedMode, MotionKind};
use trunnion_syntax::TextRange;

/// Coarse pitches of metric threads: nominal diameter and pitch, mm. Source: ISO 261:1998, table 2.
const COARSE: [(f64, f64); 23] = [
    (3.0, 0.5),
    (3.5, 0.6),
    (4.0, 0.7),
    (4.5, 0.75),
    (5.0, 0.8),
    (6.0, 1.0),
    (7.0, 1.0),
    (8.0, 1.25),
    (9.0, 1.25),
    (10.0, 1.5),
    (11.0, 1.5),
    (12.0, 1.75),
    (14.0, 2.0),
    (16.0, 2.0),
    (18.0, 2.5),
    (20.0, 2.5),
    (22.0, 2.5),
    (24.0, 3.0),
    (27.0, 3.0),
    (30.0, 3.5),
    (36.0, 4.0),
    (42.0, 4.5),
    (48.0, 5.0),
];

/// The pitch of a thread, mm: PIT, or that of the metric thread that MPIT names by its diameter (8 is M8); `None`: neither is known, or they
/// differ.
fn pitch_of(written: Option<f64>, size: Given) -> Option<f64> {
    let written = written?.abs();
    let size = size.or_zero()?.abs();
    let named = COARSE
        .iter()
        .find(|(diameter, _)| *diameter == size)
        .map(|coarse| coarse.1);
    match (written > 0.0, size != 0.0) {
        (true, false) => Some(written),
        (false, true) => named,
        (true, true) => named.filter(|named| (named - written).abs() <= 1e-9),
        (false, false) => None,
    }
}

impl Iso<'_> {
    /// The feed that a cycle goes down with.
    pub(super) fn call_feed(&mut self, call: &HoleCall, words: &Words, report: &mut Report<'_>) -> Feed {
        let unit = self.core.state.coordinates.unit_mm();
        match call.sort {
            Sort::Ream => {
                let feed = self.own_feed(call.number(6));
                if feed == Feed::Unknown {
                    let what = format!("{}: the feed (FFR)", call.id);
                    report.fault(TextRange::default(), FaultKind::NotModelled { what });
                }
                feed
            }
            Sort::Tap => {
                let written = call.number(8).or_zero().zip(call.number(13).or_zero());
                let written = written.map(|(pitch, unit_of_pitch)| match unit_of_pitch {
                    0.0 => pitch * unit,
                    1.0 => pitch,
                    // threads per inch
                    2.0 if pitch != 0.0 => 25.4 / pitch,
                    3.0 => pitch * 25.4,
                    _ if pitch == 0.0 => 0.0,
                    _ => f64::NAN,
                });
                let pitch = pitch_of(written, call.number(7));
                if pitch.is_none() {
                    let what = format!("{}: the pitch", call.id);
                    report.fault(TextRange::default(), FaultKind::NotModelled { what });
                }
                pitch.map_or(Feed::Unknown, Feed::PerRevolution)
            }
            // ENC 1: F gives the lead
            Sort::FloatingTap if call.number(8).or_zero() != Some(1.0) => {
                let written = call.number(10).or_zero().map(|pitch| pitch * unit);
                let lead = pitch_of(written, call.number(9));
                if lead.is_none() {
                    let what = format!("{}: the pitch", call.id);
                    report.fault(TextRange::default(), FaultKind::NotModelled { what });
                }
                lead.map_or(Feed::Unknown, Feed::PerRevolution)
            }
            _ => self.feed_of(MotionKind::Linear, words, report),
        }
    }

    /// A feed that the call itself gives.
    pub(super) fn own_feed(&self, given: Given) -> Feed {
        let Given::Number(number) = given else {
            return Feed::Unknown;
        };
        let feed = number * self.core.state.feed.unit_mm();
        match self.core.state.feed.mode() {
            _ if feed <= 0.0 => Feed::Unknown,
            FeedMode::PerMinute => Feed::PerMinute(feed),
            FeedMode::PerRevolution => Feed::PerRevolution(feed),
            FeedMode::InverseTime => Feed::Unknown,
        }
    }

    /// CYCLE84: out of the hole along the thread, at the speed SST1 where it is not 0.
    pub(super) fn out_of_thread(&mut self, call: &HoleCall, plan: &super::hole::Plan, report: &mut Report<'_>) {
        let out = call.number(11).or_zero();
        if out != Some(0.0) {
            self.core.state.spindle.set_rpm(out.filter(|speed| *speed > 0.0));
        }
        self.down(plan, MotionKind::Linear, plan.r, report);
        if out != Some(0.0) && out != call.number(10).or_zero() {
            // which of both speeds stays, no source says
            self.core.state.spindle.set_rpm(None);
        }
    }

    /// Cycles that switch the spindle on themselves.
    pub(super) fn call_spindle(&mut self, call: &HoleCall) {
        match call.sort {
            Sort::Tap => {
                self.core.state.spindle.switch(true);
                let speed = call.number(10).or_zero().filter(|speed| *speed > 0.0);
                self.core.state.spindle.set_rpm(speed);
            }
            Sort::Bore | Sort::BoreStop => {
                let place = match (call.sort, call.id) {
                    (Sort::BoreStop, "CYCLE87") => 5,
                    _ => 6,
                };
                if let Some(code) = call.number(place).or_zero() {
                    if code == 3.0 || code == 4.0 {
                        self.core.state.spindle.switch(true);
                    }
                } else {
                    self.core.state.spindle.lose();
                }
            }
            _ => {}
        }
    }
}
