//! Feed and spindle of drilling cycles that are called with their numbers.
use super::called::{Given, HoleCall, Sort};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, FeedMode, MotionKind};
use trunnion_syntax::TextRange;

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
                // PIT in mm, or in the units in effect; threads per inch and MPIT are other numbers
                let pitch = match (call.number(7), call.number(8), call.number(13).or_zero()) {
                    (size, Given::Number(pitch), Some(unit_of_pitch)) if size.or_zero() == Some(0.0) => {
                        let mm = match unit_of_pitch as i64 {
                            0 => Some(pitch * unit),
                            1 => Some(pitch),
                            3 => Some(pitch * 25.4),
                            _ => None,
                        };
                        mm.map(f64::abs).filter(|mm| *mm > 0.0)
                    }
                    _ => None,
                };
                if pitch.is_none() {
                    let what = format!("{}: the pitch", call.id);
                    report.fault(TextRange::default(), FaultKind::NotModelled { what });
                }
                pitch.map_or(Feed::Unknown, Feed::PerRevolution)
            }
            // ENC 1: F gives the lead; else PIT does, and MPIT names a thread
            Sort::FloatingTap if call.number(8).or_zero() != Some(1.0) => {
                let lead = match (call.number(9).or_zero(), call.number(10)) {
                    (Some(0.0), Given::Number(pitch)) if pitch != 0.0 => Some((pitch * unit).abs()),
                    _ => None,
                };
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
