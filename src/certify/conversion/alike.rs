//! What two motions that belong together have in common apart from their path: kind, spindle, zero point, tool and its length.
use super::folded::SHIFT;
use super::proof::{Proof, above};
use super::{Posed, Reading, ZeroNames};
use crate::Outcome;
use std::sync::Arc;
use trunnion_interp::{LengthOf, MotionKind};
use trunnion_syntax::Format;

/// Tool lengths that differ by less are the same, mm.
const LENGTH_MM: f64 = 1e-6;

impl Proof<'_> {
    /// Kind, tool and spindle; where the motion moves along the tool, also its length.
    pub(super) fn alike(&mut self, old: &Posed, new: &Posed, is: usize, moves_z: bool) -> Result<(), Outcome> {
        // the bounds of a conversion have no room for what a curve may be beside its lines
        if [old, new].iter().any(|posed| posed.motion.slack_mm > 0.0) {
            return Err(Outcome::unknown(
                "a curve (G5, POLY) is followed as lines near it, and what lies between is not compared: a program with curves is not converted",
            ));
        }
        let fits = match (old.motion.kind, new.motion.kind) {
            (MotionKind::Dwell(Some(was)), MotionKind::Dwell(Some(is))) => (was - is).abs() <= 5e-4 + 1e-9,
            (MotionKind::Rapid, MotionKind::Rapid)
            | (MotionKind::Linear, MotionKind::Linear)
            | (MotionKind::Arc(Some(_)), MotionKind::Arc(Some(_)) | MotionKind::Linear) => true,
            _ => false,
        };
        if !fits {
            return self.refute(is, "the kind of motion differs".to_owned());
        }
        // where it is not known whether the spindle turns, a cut may run at the speed
        let rpm = |posed: &Posed| {
            let may_turn = match posed.motion.spindle_on {
                None => old.motion.is_feed(),
                Some(on) => on,
            };
            posed.motion.spindle_rpm.filter(|_| may_turn)
        };
        let same_speed = match (rpm(old), rpm(new)) {
            (Some(was), Some(is)) => (was - is).abs() <= 5e-4,
            (was, is) => was.is_none() && is.is_none(),
        };
        // if the original does not start it, the output must not start it either
        // nor may it stop a cut in which the original leaves the spindle to the machine
        let same_turning = match old.motion.spindle_on {
            None if old.spindle_left && old.motion.is_feed() => new.spindle_left,
            None => new.motion.spindle_on != Some(true),
            on => new.motion.spindle_on == on,
        };
        let turns = old.motion.spindle_on == Some(true) && new.motion.spindle_on == Some(true);
        let same_full_turns =
            !turns || old.counter_clockwise.unwrap_or(false) == new.counter_clockwise.unwrap_or(false);
        if !same_turning || !same_speed || !same_full_turns {
            let [was, now] = [old, new].map(turning);
            let turned = old.motion.spindle_on == Some(true) || old.spindle_left;
            let way_out = if turned && new.motion.spindle_on == Some(false) {
                "; where a tool change or a stop (M0) stops it on the target, program M3 or M4 after it"
            } else {
                ""
            };
            let why = format!("the spindle differs: in the original program it {was}, in the output it {now}{way_out}");
            return self.refute(is, why);
        }
        let by_hand = !self.after.0.changes_tools && new.motion.tool.is_none();
        if old.motion.tool != new.motion.tool && !by_hand {
            return self.refute(is, "the tool differs".to_owned());
        }
        self.same_zero(old, new, is)?;
        let told = !by_hand && self.before.0.tells_lengths && self.after.0.tells_lengths;
        if told && moves_z && !matches!(new.motion.kind, MotionKind::Dwell(_)) {
            self.same_length(old, new, is)?;
        }
        Ok(())
    }

    /// The tool's length. One that is not active, or that of another number, puts the tip in another position on the machine, whatever X Y Z are.
    fn same_length(&mut self, old: &Posed, new: &Posed, is: usize) -> Result<(), Outcome> {
        if old.motion.machine_coordinates && new.motion.machine_coordinates {
            return Ok(());
        }
        let is_active = |posed: &Posed| posed.length_of != LengthOf::Nothing;
        let both_active = is_active(old) && is_active(new);
        // a rapid without a length: its pose says where the tip is, if the length is declared
        let known = |posed: &Posed, reading: &Reading| {
            let is_apt = reading.program.options().format == Format::Apt;
            is_apt || is_active(posed) || posed.leg.is_some() && posed.tool_length.abs() > LENGTH_MM
        };
        let poses_tell = known(old, self.before.0) && known(new, self.after.0);
        let by_pose = !new.motion.is_feed() && !both_active && poses_tell;
        if by_pose {
            return Ok(());
        }
        if (old.tool_length - new.tool_length).abs() > LENGTH_MM {
            let why = format!(
                "{:.4} mm of tool length are active, but the original program has {:.4} mm: activate the length of the tool in the spindle",
                new.tool_length, old.tool_length
            );
            return self.refute(is, why);
        }
        // for undeclared lengths, and for words without a machine, all that is known is which tool they belong to
        let blind = new.tool_length.abs() <= LENGTH_MM || new.leg.is_none();
        if blind && old.length_of != new.length_of {
            let why = format!(
                "the active tool length is {}, but the original program has {}: activate the length of the tool in the spindle, or declare the lengths \
                 and name the machine",
                new.length_of, old.length_of
            );
            return self.refute(is, why);
        }
        Ok(())
    }

    /// A zero point of the original and one of the output, which have names of different controls: each stands for one other.
    fn stands_for(&mut self, was: &Arc<str>, now: &Arc<str>, is: usize) -> Result<(), Outcome> {
        let found = self.renamed.iter().find(|(old, new)| old == was || new == now);
        match found {
            None => self.renamed.push((was.clone(), now.clone())),
            Some((old, new)) if old == was && new == now => {}
            Some((old, new)) => {
                return self.refute(
                    is,
                    format!("{now} corresponds to {was}, but earlier {new} corresponded to {old}"),
                );
            }
        }
        Ok(())
    }

    /// The zero point: its name, and what the program shifts in addition. CL data have none.
    fn same_zero(&mut self, old: &Posed, new: &Posed, is: usize) -> Result<(), Outcome> {
        if matches!(old.motion.kind, MotionKind::Dwell(_)) {
            return Ok(());
        }
        // machine coordinates know nothing of a shift
        let shifts = |posed: &Posed| {
            if posed.motion.machine_coordinates {
                [0.0; 9]
            } else {
                posed.shift
            }
        };
        let apart = shifts(old)
            .iter()
            .zip(&shifts(new))
            .any(|(was, is)| above((was - is).abs(), SHIFT));
        if apart {
            let why = "the original program shifts the zero point (G52, G92, G10, TRANS) and does not take that back before its end. A conversion writes \
                 coordinates without shifts, and the zero point would differ after the program: end the shift (G52 X0 Y0 Z0, G92.1, TRANS) and convert \
                 that program";
            return self.refute(is, why.to_owned());
        }
        match (&old.work_offset, &new.work_offset) {
            (Some(was), Some(now)) if ZeroNames::of(was) != ZeroNames::of(now) => self.stands_for(was, now, is),
            (Some(was), Some(now)) if was != now => self.refute(
                is,
                format!("the work offset is {now}, but the original program has {was}"),
            ),
            // one of them names none (CL data): then the other may not change it
            (Some(name), None) | (None, Some(name)) if self.offset.get_or_insert_with(|| name.clone()) != name => self
                .refute(
                is,
                "several work offsets became one: the output names none, so convert the part of each offset by itself"
                    .to_owned(),
            ),
            _ => Ok(()),
        }
    }
}

/// What the spindle does, as the end of a sentence.
fn turning(posed: &Posed) -> String {
    match (posed.motion.spindle_on, posed.motion.spindle_rpm) {
        (None, _) => "is in an unknown state".to_owned(),
        (Some(false), _) => "stands".to_owned(),
        (Some(true), rpm) => {
            let counter = if posed.counter_clockwise == Some(true) {
                "counter-"
            } else {
                ""
            };
            let speed = rpm.map_or("an unknown speed".to_owned(), |rpm| format!("{rpm} 1/min"));
            format!("turns {counter}clockwise at {speed}")
        }
    }
}
