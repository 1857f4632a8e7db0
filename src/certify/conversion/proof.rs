//! Compares two readings.
use super::axis::axes_apart;
use super::effects::{Terms, same_requests};
use super::known::Known;
use super::words::{moved_axes, same_words, words_apart};
use super::{ConversionClaim, ConversionProof, Part, Posed, Reading, Track};
use crate::Outcome;
use std::cell::OnceCell;
use std::sync::Arc;
use trunnion_geometry::deg;
use trunnion_geometry::math::angle_between;
use trunnion_interp::{Fault, Feed, MotionKind};
use trunnion_machine::{Machine, Pose};
use trunnion_syntax::{BlockId, LineIndex, Program};

/// Most moments at which two paths are compared.
const MOST_SAMPLES: f64 = 4096.0;

pub(super) struct Proof<'a> {
    pub(super) before: (&'a Reading, Option<&'a Machine>),
    pub(super) after: (&'a Reading, Option<&'a Machine>),
    claim: &'a ConversionClaim,
    found: ConversionProof,
    /// The work offset of the program that names one, where the other names none.
    pub(super) offset: Option<Arc<str>>,
    /// Work offsets of the original, and those of the other control's names that stand for them.
    pub(super) renamed: Vec<(Arc<str>, Arc<str>)>,
    /// Known positions of the original, once a motion is left out.
    known: OnceCell<Known>,
}

/// Proves that `after` does what `before` says. The readings must be fresh: [`super::read`] of the texts.
///
/// # Errors
/// Refuted with a witness, or unknown with the reason. Lines are those of the program after.
pub fn converted(
    before: (&Reading, Option<&Machine>),
    after: (&Reading, Option<&Machine>),
    parts: &[Part],
    claim: &ConversionClaim,
) -> Result<ConversionProof, Outcome> {
    converted_on(before, after, parts, claim, &Terms::default())
}

/// As [`converted`], with what the user leaves out and what the post declares about its own codes.
///
/// # Errors
/// As [`converted`].
pub fn converted_on(
    before: (&Reading, Option<&Machine>),
    after: (&Reading, Option<&Machine>),
    parts: &[Part],
    claim: &ConversionClaim,
    terms: &Terms<'_>,
) -> Result<ConversionProof, Outcome> {
    if let Some(fault) = after.0.faults.first() {
        let line = line(&after.0.program, fault.block);
        let text = fault_text(&after.0.program, fault);
        return Err(Outcome::unknown(format!(
            "line {line} of the converted program is not understood: `{text}`{}",
            super::fault_words::why(&fault.kind)
        )));
    }
    let mut proof = Proof {
        before,
        after,
        claim,
        found: ConversionProof::default(),
        offset: None,
        renamed: Vec::new(),
        known: OnceCell::new(),
    };
    let (mut was, mut is) = (0, 0);
    for part in parts {
        match *part {
            Part::Moves(count) => {
                proof.moves(was, is, count as usize)?;
                was += 1;
                is += count as usize;
            }
            Part::Words => {
                proof.words(was, is)?;
                was += 1;
                is += 1;
            }
            Part::Left => {
                proof.left(was)?;
                was += 1;
            }
            Part::Added(count) => {
                proof.added(was, is, count as usize)?;
                is += count as usize;
            }
        }
    }
    let (all_was, all_is) = (before.0.motions.len(), after.0.motions.len());
    if (was, is) != (all_was, all_is) {
        return Err(Outcome::unknown(format!(
            "{was} of {all_was} motions of the original and {is} of {all_is} of the converted program were compared"
        )));
    }
    same_requests(before.0, after.0, parts, terms)?;
    (proof.found.motions_before, proof.found.motions_after) = (all_was as u64, all_is as u64);
    Ok(proof.found)
}

fn line(program: &Program, block: BlockId) -> u32 {
    let source = program.source();
    LineIndex::new(source)
        .line_column(source, program.block(block).range().start)
        .0
}

fn fault_text(program: &Program, fault: &Fault) -> String {
    program.text(fault.range).chars().take(40).collect()
}

/// Feeds per revolution are small: of their rounding counts what share of the feed it is. Six digits of an inch keep feeds from 0.0127 mm/rev on.
const PER_TURN_SHARE: f64 = 1e-3;

/// Above the limit, or not a number.
pub(super) fn above(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

impl Proof<'_> {
    pub(super) fn refute<T>(&self, is: usize, message: String) -> Result<T, Outcome> {
        match self.after.0.motions.get(is) {
            Some(posed) => {
                let line = line(&self.after.0.program, posed.motion.block);
                Err(Outcome::refuted_at(is, line, message))
            }
            None => Err(Outcome::refuted(message)),
        }
    }

    fn motion(&self, was: usize) -> Result<&Posed, Outcome> {
        let motions = &self.before.0.motions;
        motions
            .get(was)
            .ok_or_else(|| Outcome::unknown(format!("the original has no motion {was}")))
    }

    /// A motion that is left out: a rapid to an unknown position, before all known poses of its tool or after the last.
    fn left(&mut self, was: usize) -> Result<(), Outcome> {
        let motions = &self.before.0.motions;
        let posed = self.motion(was)?;
        let known = self.known.get_or_init(|| Known::of(motions));
        let may = known.is_outside(motions, was) && !known.leaves_a_cut(motions, was);
        if posed.end.is_ok() || !may {
            return self.refute(usize::MAX, format!("motion {was} of the original must not be left out"));
        }
        self.found.left_out += 1;
        Ok(())
    }

    /// A rapid of which only some axes are known, in the same words.
    fn words(&mut self, was: usize, is: usize) -> Result<(), Outcome> {
        let (before, after) = (self.before.0, self.after.0);
        let (Some(old), Some(new)) = (before.motions.get(was), after.motions.get(is)) else {
            return Err(Outcome::unknown("the converted program ends too early"));
        };
        let lifts = |posed| moved_axes(posed).is_none_or(|moved| moved.iter().any(|(axis, _)| *axis == 2));
        self.alike(old, new, is, lifts(old) || lifts(new))?;
        let apart = words_apart(old, new).filter(|_| same_words(self.before.1, self.after.1));
        match apart {
            Some((mm, degrees)) if !above(mm, self.claim.end_mm) && !above(degrees, self.claim.end_deg) => Ok(()),
            _ => self.refute(is, "a rapid in some of the axes differs from the original".to_owned()),
        }
    }

    /// Motions that only position, where the start of the tool is unknown.
    fn added(&mut self, was: usize, is: usize, count: usize) -> Result<(), Outcome> {
        let open = self
            .before
            .0
            .motions
            .get(was)
            .is_none_or(|next| next.start.is_none() || next.end.is_err());
        let motions = self.after.0.motions.get(is..is + count).unwrap_or_default();
        let rapid = |posed: &Posed| matches!(posed.motion.kind, MotionKind::Rapid | MotionKind::Unknown);
        if !open || motions.len() != count || !motions.iter().all(rapid) {
            return self.refute(is, "an added motion is not a positioning move".to_owned());
        }
        self.found.added += count as u64;
        Ok(())
    }

    /// One motion before, and those that make it.
    fn moves(&mut self, was: usize, is: usize, count: usize) -> Result<(), Outcome> {
        let (before, after) = (self.before.0, self.after.0);
        let Some(old) = before.motions.get(was) else {
            return Err(Outcome::unknown(format!("the original has no motion {was}")));
        };
        let Some(new) = after.motions.get(is..is + count).filter(|new| !new.is_empty()) else {
            return Err(Outcome::unknown("the converted program ends too early"));
        };
        for (index, posed) in new.iter().enumerate() {
            self.alike(old, posed, is + index, true)?;
        }
        if let MotionKind::Dwell(_) = old.motion.kind {
            return Ok(());
        }
        let Ok(end) = &old.end else {
            let why = old.end.as_ref().err().cloned().unwrap_or_default();
            return Err(Outcome::unknown(format!("motion {was} of the original: {why}")));
        };
        let is_rapid = old.motion.kind == MotionKind::Rapid;
        let track = Track::new(old, self.before.1);
        match (&track, old.start) {
            (None, None) if count == 1 && !matches!(old.motion.kind, MotionKind::Arc(_)) => {
                // from an unknown start: only the end is compared
                return self.end(end, &new[0], is);
            }
            (None, _) => {
                return Err(Outcome::unknown(format!(
                    "motion {was} of the original: its path is unknown"
                )));
            }
            (Some(_), _) => {}
        }
        let Some(track) = track else { return Ok(()) };
        for (index, posed) in new.iter().enumerate() {
            let (from, to) = (share(index, count), share(index + 1, count));
            self.end(&track.at(to), posed, is + index)?;
            let degrees = self.way(&track, (from, to), posed, is + index, is_rapid)?;
            self.same_orientation(old, posed, degrees, is + index)?;
        }
        if is_rapid { Ok(()) } else { self.feed(old, new, is) }
    }

    /// The end of one motion after.
    fn end(&mut self, wanted: &Pose, new: &Posed, is: usize) -> Result<(), Outcome> {
        let found = match &new.end {
            Ok(found) => found,
            Err(why) => return self.refute(is, why.clone()),
        };
        let (mm, degrees) = (
            (found.tip - wanted.tip).norm(),
            deg(angle_between(&found.axis, &wanted.axis)),
        );
        if above(mm, self.claim.end_mm) || above(degrees, self.claim.end_deg) {
            return self.refute(
                is,
                format!(
                    "the tip ends {mm:.6} mm and the tool axis {degrees:.6} deg from where it was; the limits are {:.6} mm, {:.6} deg",
                    self.claim.end_mm, self.claim.end_deg
                ),
            );
        }
        self.found.end_mm = self.found.end_mm.max(mm);
        self.found.end_deg = self.found.end_deg.max(degrees);
        Ok(())
    }

    /// The path of one motion of the output, compared with its share of the original one: for the difference of the two points, bent by at most Q, the
    /// largest sample + Q / (8 m^2) at m equal steps. Gives the bound of the angle between the tool axes, deg; 0 for rapids.
    fn way(
        &mut self,
        track: &Track<'_>,
        (from, to): (f64, f64),
        new: &Posed,
        is: usize,
        is_rapid: bool,
    ) -> Result<f64, Outcome> {
        let Some(made) = Track::new(new, self.after.1) else {
            if is_rapid {
                return Ok(0.0);
            }
            return self.refute(is, "its path is unknown".to_owned());
        };
        let h2 = (to - from) * (to - from);
        let bend = track.bend().0 * h2 + made.bend().0;
        // so many that the bound is at most a twentieth of the tolerance above the samples
        let steps = (bend / (0.4 * self.claim.path_mm))
            .sqrt()
            .ceil()
            .clamp(1.0, MOST_SAMPLES);
        let mut off = 0.0f64;
        for step in 0..=(steps as u32) {
            let t = f64::from(step) / steps;
            let (was, is) = (track.at(from + (to - from) * t), made.at(t));
            off = off.max((was.tip - is.tip).norm());
        }
        let mm = off + bend / (8.0 * steps * steps);
        if is_rapid {
            self.found.rapid_mm = self.found.rapid_mm.max(mm);
            return Ok(0.0);
        }
        let degrees = deg(axes_apart(track, (from, to), &made));
        if above(mm, self.claim.path_mm) {
            let limit = self.claim.path_mm;
            return self.refute(
                is,
                format!("inside the block the tip may be {mm:.6} mm from where it was; {limit:.6} mm is allowed"),
            );
        }
        if let Some(limit) = self.claim.path_deg.filter(|limit| above(degrees, *limit)) {
            return self.refute(
                is,
                format!(
                    "inside the block the tool axis may be {degrees:.6} deg from where it was; {limit:.6} deg is allowed (--tolerance-deg)"
                ),
            );
        }
        self.found.path_mm = self.found.path_mm.max(mm);
        self.found.path_deg = self.found.path_deg.max(degrees);
        Ok(degrees)
    }

    /// Where the program says how the tool axis runs between the ends (ORIAXES, ORIVECT), it must do the same in the output, or the same by default.
    fn same_orientation(&self, old: &Posed, new: &Posed, degrees: f64, is: usize) -> Result<(), Outcome> {
        let (Some(asked), Some(machine)) = (old.motion.great_circle, self.after.1) else {
            return Ok(());
        };
        let runs = new.motion.great_circle.unwrap_or(machine.control.tcp_great_circle);
        if new.leg.is_none() || !new.tip_words() || runs == asked || degrees <= self.claim.end_deg {
            return Ok(());
        }
        let (was, now) = if asked {
            ("on a great circle (ORIVECT)", "in its rotary axes")
        } else {
            ("in its rotary axes (ORIAXES)", "on a great circle")
        };
        self.refute(
            is,
            format!("the tool axis moves {now}, but the original program asks for {was}"),
        )
    }

    /// Feeds in the same unit are compared as numbers, others by the time that the motion takes.
    fn feed(&mut self, old: &Posed, new: &[Posed], is: usize) -> Result<(), Outcome> {
        let per_minute = |posed: &Posed| match posed.motion.feed {
            Feed::PerMinute(feed) if posed.feeds_the_tip() => Some(feed),
            _ => None,
        };
        if let Some(was) = per_minute(old) {
            let all: Option<Vec<f64>> = new.iter().map(per_minute).collect();
            if let Some(all) = all {
                let off = all.iter().fold(0.0f64, |worst, is| worst.max((was - is).abs()));
                if above(off, self.claim.feed_mm_min) {
                    return self.refute(is, format!("the feed differs by {off:.6} mm/min"));
                }
                self.found.feed_mm_min = self.found.feed_mm_min.max(off);
                return Ok(());
            }
        }
        let per_turn = |posed: &Posed| match posed.motion.feed {
            Feed::PerRevolution(feed) if posed.feeds_the_tip() => Some(feed),
            _ => None,
        };
        let all: Option<Vec<f64>> = new.iter().map(per_turn).collect();
        if let (Some(was), Some(all)) = (per_turn(old), all) {
            for now in all {
                let share = if was == now {
                    0.0
                } else {
                    (was - now).abs() / was.min(now)
                };
                if above(share, PER_TURN_SHARE) {
                    let message = format!("the feed is {now:.6} mm/rev, and {was:.6} mm/rev in the original");
                    return self.refute(is, message);
                }
                self.found.time_share = self.found.time_share.max(share);
            }
            return Ok(());
        }
        let took: Option<f64> = new.iter().map(Posed::duration_s).sum();
        match (old.duration_s(), took) {
            (Some(was), Some(took)) if was > 0.0 => {
                let share = (took - was).abs() / was;
                if above(share, self.claim.time_share) {
                    return self.refute(is, format!("it takes {took:.6} s, and {was:.6} s in the original"));
                }
                self.found.time_share = self.found.time_share.max(share);
            }
            // the tip does not move: the feed has no time
            (None, _) => self.found.feeds_not_compared += 1,
            _ => return self.refute(is, "the feed is lost".to_owned()),
        }
        Ok(())
    }
}

fn share(index: usize, count: usize) -> f64 {
    index as f64 / count as f64
}
