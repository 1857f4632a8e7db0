//! RND and CHF, and motions that wait for the one after them.
use super::approach::Approach;
use super::words::{Said, Words};
use super::{Klartext, Made};
use crate::core::Report;
use crate::corner::{Cut, flat};
use crate::{ChamferLength, Feed, FeedMode, MotionKind, Refusal};
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
    /// RND or CHF.
    Cut(Size, Option<Feed>),
}

/// How large a corner is, and what its block calls it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    /// `R` for a radius, `C` and `F` for a chamfer by its side and by its face: see [`Cut::new`].
    letter: u8,
    /// mm
    mm: f64,
}

impl Size {
    fn name(self) -> &'static str {
        if self.letter == b'R' { "RND" } else { "CHF" }
    }
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
        self.sized("RND", Some(b'R'), first, words, report);
    }

    /// CHF: what its length measures is declared.
    pub(crate) fn chamfer(&mut self, first: Said<'_>, words: &mut Words<'_>, report: &mut Report<'_>) {
        let letter = self.core.setup.control.chamfer_length.map(|length| match length {
            ChamferLength::Side => b'C',
            ChamferLength::Face => b'F',
        });
        self.sized("CHF", letter, first, words, report);
    }

    /// The size of a corner; `letter`: see [`Size`], `None` where the settings do not say how it is meant.
    fn sized(
        &mut self,
        name: &str,
        letter: Option<u8>,
        first: Said<'_>,
        words: &mut Words<'_>,
        report: &mut Report<'_>,
    ) {
        let (mut feed, mut unread) = (None, false);
        let mut value = first;
        for word in words.by_ref() {
            unread |= feed.is_some() && word.name().starts_with(b"F");
            match word.name() {
                b"R" if letter == Some(b'R') => value = word.value,
                // it ends with the corner (iTNC 530 60642x-03, p. 232)
                b"F" => match word.value {
                    Said::Number(_) | Said::Parameter(..) if self.core.state.feed.mode() == FeedMode::PerMinute => {
                        let unit = self.core.state.feed.unit_mm();
                        let said = self.said(word.value, report);
                        feed = Some(said.map_or(Feed::Unknown, |feed| Feed::PerMinute(feed * unit)));
                    }
                    _ => (feed, unread) = (Some(Feed::Unknown), true),
                },
                b"FMAX" | b"FAUTO" | b"FU" | b"FZ" => (feed, unread) = (Some(Feed::Unknown), true),
                b"" => {}
                _ => unread = true,
            }
        }
        let is_round = letter == Some(b'R');
        let size = if value == Said::Nothing {
            let what = if is_round {
                "RND needs its radius"
            } else {
                "CHF needs its length"
            };
            Self::rejected(Refusal::MissingWord, what, report);
            None
        } else if let Some(letter) = letter {
            let unit = self.core.state.coordinates.unit_mm();
            let said = self.said(value, report);
            let mm = Self::from_zero(if is_round { "R of RND" } else { "CHF" }, said, report);
            let mm = mm
                .map(|size| size * unit)
                .and_then(|mm| self.scaled_size(name, mm, report));
            mm.map(|mm| Size { letter, mm })
        } else {
            let what = "CHF: what its length measures (declare [control] chamfer_length)";
            Self::not_modelled(what, report);
            None
        };
        if unread {
            let what = if is_round { "its radius" } else { "its length" };
            let what = format!("{name}: words beside {what} and a feed in mm/min");
            self.not_modelled_once(&what, report);
        }
        self.corner(size.map_or(Corner::Unknown, |size| Corner::Cut(size, feed)), report);
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
            Some(Waiting::Corner(before, Corner::Cut(size, feed))) => {
                self.cut(*before, Some((size, feed)), made, report);
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

    /// Rounds or chamfers the corner between two lines in the plane.
    fn cut(&mut self, mut before: Made, known: Option<(Size, Option<Feed>)>, mut next: Made, report: &mut Report<'_>) {
        let size = known.map(|(size, _)| size);
        let feed = known.and_then(|(_, feed)| feed);
        let axes = self.axes();
        let ways = flat(&before.motion, axes).zip(flat(&next.motion, axes));
        let fits = ways.zip(size).map(|((first, second), size)| {
            let cut = Cut::new(axes, first, second, size.letter, size.mm);
            let room = cut.by <= first.norm() + 1e-9 && cut.by <= second.norm() + 1e-9;
            (cut, room)
        });
        match fits {
            Some((cut, true)) if before.tilt == next.tilt => {
                let mut done = Vec::new();
                let mut pending = (next.motion, self.core.state.clone());
                let round = size.is_some_and(|size| size.letter == b'R');
                let first = (before.motion, self.core.state.clone());
                cut.apply(first, round, &mut pending, &mut done);
                // the motion up to the corner, and the corner
                for (place, (mut motion, _)) in done.into_iter().enumerate() {
                    if let (1, Some(feed)) = (place, feed) {
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
                if let Some(size) = size {
                    let what = format!("{}: a corner that is not between two lines in the plane", size.name());
                    Self::not_modelled(&what, report);
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
