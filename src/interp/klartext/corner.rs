//! RND and CHF, and motions that wait for the one after them.
use super::approach::Approach;
use super::words::{Said, Words};
use super::{Klartext, Made};
use crate::core::Report;
use crate::corner::{Cut, flat};
use crate::{Feed, FeedMode, MotionKind, Refusal};
use trunnion_syntax::BlockId;

/// What needs the next motion.
#[derive(Clone, Debug)]
pub(crate) enum Waiting {
    /// The motion before RND or CHF; what is known of the corner.
    Corner(Box<Made>, Corner),
    /// APPR: the first contour element says where the contour goes.
    Approach(Box<Approach>),
}

/// What is known of a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Corner {
    /// Its RND or CHF comes.
    Awaited,
    /// It is not followed.
    Unknown,
    /// RND with this radius, mm, and its own feed.
    Round(f64, Option<Feed>),
}

/// Blocks without words that are passed over to find the next one.
const PASSED: u32 = 16;

/// Whether RND or CHF follows the block.
#[inline]
pub(crate) fn comes(report: &Report<'_>) -> bool {
    let program = report.program;
    let first = report.block.0 + 1;
    for next in first..(first + PASSED).min(program.block_count() as u32) {
        let view = program.block(BlockId(next));
        let bytes = program.bytes(view.range());
        let mut words = Words::new(bytes);
        let digits = |byte: &u8| byte.is_ascii_digit() || *byte <= b' ';
        words.at = bytes.iter().position(|byte| !digits(byte)).unwrap_or(bytes.len());
        match words.rest() {
            // computations may stand between both
            []
            | [b';' | b'*', ..]
            | [b'Q' | b'q', b'0'..=b'9' | b'L' | b'R' | b'l' | b'r', ..]
            | [b'F' | b'f', b'N' | b'n', ..] => {}
            [a, b, c, ..] => {
                let name = [a, b, c].map(u8::to_ascii_uppercase);
                return name == *b"RND" || name == *b"CHF";
            }
            _ => return false,
        }
    }
    false
}

impl Klartext<'_> {
    /// RND R.
    pub(crate) fn round(&mut self, first: Said<'_>, words: &mut Words<'_>, report: &mut Report<'_>) {
        let mut radius = None;
        let (mut feed, mut unread) = (None, false);
        let mut value = first;
        for word in words.by_ref() {
            match word.name() {
                b"R" => value = word.value,
                // it ends with the corner (iTNC 530 60642x-03, p. 232)
                b"F" => match word.value {
                    Said::Number(_) | Said::Parameter(..) if self.core.state.feed.mode() == FeedMode::PerMinute => {
                        let unit = self.core.state.feed.unit_mm();
                        let said = self.said(word.value, report);
                        feed = Some(said.map_or(Feed::Unknown, |feed| Feed::PerMinute(feed * unit)));
                    }
                    _ => unread = true,
                },
                b"" => {}
                _ => unread = true,
            }
        }
        if value == Said::Nothing {
            Self::rejected(Refusal::MissingWord, "RND needs its radius", report);
        } else {
            let unit = self.core.state.coordinates.unit_mm();
            radius = self.said(value, report).map(|radius| radius.abs() * unit);
            radius = radius.and_then(|radius| self.scaled_radius(radius, report));
        }
        if unread {
            self.not_modelled_once("RND: words beside its radius and a feed in mm/min", report);
        }
        self.corner(
            radius.map_or(Corner::Unknown, |radius| Corner::Round(radius, feed)),
            report,
        );
    }

    /// CHF: whether its length is that of the face or of what it takes off is not taken from a source.
    pub(crate) fn chamfer(&mut self, _length: Said<'_>, report: &mut Report<'_>) {
        Self::not_modelled("CHF: what its length measures", report);
        self.corner(Corner::Unknown, report);
    }

    fn corner(&mut self, found: Corner, report: &mut Report<'_>) {
        match &mut self.memory.waiting {
            Some(Waiting::Corner(_, corner @ Corner::Awaited)) => *corner = found,
            _ => Self::rejected(Refusal::Other, "no path block precedes the corner", report),
        }
    }

    /// The motion after one that waits.
    pub(crate) fn join(&mut self, made: Made, report: &mut Report<'_>) {
        match self.memory.waiting.take() {
            Some(Waiting::Corner(before, Corner::Awaited)) => {
                self.finish_motion(&before);
                self.hold_or_finish(made, report);
            }
            Some(Waiting::Corner(before, Corner::Unknown)) => self.cut(*before, None, made, report),
            Some(Waiting::Corner(before, Corner::Round(radius, feed))) => {
                self.cut(*before, Some((radius, feed)), made, report);
            }
            Some(Waiting::Approach(approach)) => {
                self.finish_approach(&approach, &made, report);
                self.hold_or_finish(made, report);
            }
            None => self.hold_or_finish(made, report),
        }
    }

    fn hold_or_finish(&mut self, made: Made, report: &Report<'_>) {
        if comes(report) {
            self.memory.waiting = Some(Waiting::Corner(Box::new(made), Corner::Awaited));
        } else {
            self.finish_motion(&made);
        }
    }

    /// Rounds the corner between two lines in the plane.
    fn cut(&mut self, mut before: Made, round: Option<(f64, Option<Feed>)>, mut next: Made, report: &mut Report<'_>) {
        let radius = round.map(|(radius, _)| radius);
        let feed = round.and_then(|(_, feed)| feed);
        let axes = self.axes();
        let ways = flat(&before.motion, axes).zip(flat(&next.motion, axes));
        let fits = ways.zip(radius).map(|((first, second), radius)| {
            let cut = Cut::new(axes, first, second, b'R', radius);
            let room = cut.by <= first.norm() + 1e-9 && cut.by <= second.norm() + 1e-9;
            (cut, room)
        });
        match fits {
            Some((cut, true)) if before.tilt == next.tilt => {
                let mut done = Vec::new();
                let mut pending = (next.motion, self.core.state.clone());
                cut.apply((before.motion, self.core.state.clone()), true, &mut pending, &mut done);
                for (mut motion, _) in done {
                    if let (MotionKind::Arc(_), Some(feed)) = (motion.kind, feed) {
                        motion.feed = feed;
                    }
                    self.finish_motion(&Made {
                        motion,
                        tilt: before.tilt,
                    });
                }
                next.motion = pending.0;
            }
            Some((_, false)) => {
                Self::rejected(
                    Refusal::Other,
                    "the corner takes more than one of its motions is long",
                    report,
                );
                self.finish_motion(&before);
            }
            _ => {
                if radius.is_some() {
                    Self::not_modelled("RND: a corner that is not between two lines in the plane", report);
                }
                for axis in &axes[..2] {
                    before.motion.end.forget(*axis);
                    next.motion.start.forget(*axis);
                }
                for made in [&mut before, &mut next] {
                    if let MotionKind::Arc(arc) = &mut made.motion.kind {
                        *arc = None;
                    }
                }
                self.finish_motion(&before);
            }
        }
        self.hold_or_finish(next, report);
    }

    /// Nothing joins what waits.
    pub(crate) fn flush(&mut self, report: &mut Report<'_>) {
        match self.memory.waiting.take() {
            Some(Waiting::Corner(before, Corner::Awaited)) => self.finish_motion(&before),
            Some(Waiting::Corner(mut before, _)) => {
                Self::not_modelled("RND or CHF without a path block that follows at once", report);
                for axis in &self.axes()[..2] {
                    before.motion.end.forget(*axis);
                    self.core.state.position.forget(*axis);
                }
                if let MotionKind::Arc(arc) = &mut before.motion.kind {
                    *arc = None;
                }
                self.finish_motion(&before);
            }
            Some(Waiting::Approach(approach)) => {
                Self::not_modelled("APPR: no contour element follows", report);
                self.approach_unknown(&approach);
            }
            None => {}
        }
    }
}
