//! RND and CHF, and motions that wait for the one after them.
use super::approach::Approach;
use super::words::{Said, Words};
use super::{Klartext, Made};
use crate::core::Report;
use crate::corner::{Cut, flat};
use crate::{MotionKind, Refusal};
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
    /// RND with this radius, mm.
    Round(f64),
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
            [] | [b';' | b'*', ..] => {}
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
        let mut feed = false;
        let mut value = first;
        for word in words.by_ref() {
            match word.name() {
                b"R" => value = word.value,
                b"F" => feed = true,
                _ => {}
            }
        }
        if value == Said::Nothing {
            Self::rejected(Refusal::MissingWord, "RND needs its radius", report);
        } else {
            let unit = self.core.state.coordinates.unit_mm();
            radius = self.said(value, report).map(|radius| radius.abs() * unit);
        }
        if feed {
            self.not_modelled_once("the feed of RND", report);
        }
        self.corner(radius, report);
    }

    /// CHF: whether its length is that of the face or of what it takes off is not taken from a source.
    pub(crate) fn chamfer(&mut self, _length: Said<'_>, report: &mut Report<'_>) {
        Self::not_modelled("CHF: what its length measures", report);
        self.corner(None, report);
    }

    fn corner(&mut self, radius: Option<f64>, report: &mut Report<'_>) {
        match &mut self.memory.waiting {
            Some(Waiting::Corner(_, corner @ Corner::Awaited)) => {
                *corner = radius.map_or(Corner::Unknown, Corner::Round);
            }
            _ => Self::rejected(Refusal::Other, "no path block stands before the corner", report),
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
            Some(Waiting::Corner(before, Corner::Round(radius))) => self.cut(*before, Some(radius), made, report),
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
    fn cut(&mut self, mut before: Made, radius: Option<f64>, mut next: Made, report: &mut Report<'_>) {
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
                for (motion, _) in done {
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
            Some(Waiting::Corner(before, _)) => self.finish_motion(&before),
            Some(Waiting::Approach(approach)) => {
                Self::not_modelled("APPR: no contour element follows", report);
                self.approach_unknown(&approach);
            }
            None => {}
        }
    }
}
