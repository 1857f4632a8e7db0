//! Rapids of which only some axes are known: `G0 X Y` before the first Z. They stay motions of their own, so that the tool does not move
//! in X, Y and Z at once where it moved in X and Y first.
use crate::Refused;
use crate::plan::{Mode, Out, Planner};
use crate::sample::Frame;
use trunnion_certify::conversion::{Posed, moved_axes, same_words};
use trunnion_interp::{LengthOf, Orientation, Tilt};

impl Planner<'_> {
    /// What becomes of a rapid with an unknown end that may be left out.
    pub(crate) fn partial(&self, index: usize, posed: &Posed, frame: &Frame) -> Result<Out, Refused> {
        let Some(moved) = moved_axes(posed) else {
            // in a tilted plane its words cannot be repeated
            if self.is_approach(index) && self.joins_the_next(index) {
                let message = "this rapid turns or approaches in a tilted plane before the position of the tool is known. In the output it would be \
                               joined with the next rapid, in all axes at once: program all axes before the plane (G0 with the rotary axes, too)";
                return Err(self.refuse(posed, message.to_owned()));
            }
            return Ok(Out::Left);
        };
        if moved.is_empty() {
            return Ok(Out::Left);
        }
        if !self.is_approach(index) {
            return Ok(Out::Left);
        }
        let target = match self.mode {
            Mode::Tip => None,
            Mode::TipRotary(machine) | Mode::Joints(machine) => Some(machine),
        };
        let vectors = self.options.orientation == crate::OrientationWords::Vectors;
        let zero = posed.motion.zero.iter().zip(&frame.zero).all(|(is, own)| is == own);
        let led = posed.motion.tcp;
        // the tip is guided by the same machine, or not at all
        let leads = !led || target.is_some() && matches!(self.mode, Mode::TipRotary(_));
        if !self.apt && !vectors && zero && leads && same_words(self.source, target) {
            let length = posed.length_of != LengthOf::Nothing;
            return Ok(Out::Words {
                known: moved,
                led,
                length,
            });
        }
        // CL data have no points with an unknown coordinate
        if self.apt || !self.merges(index, &moved) {
            return Ok(Out::Left);
        }
        let message = "this rapid moves some axes before the others are known. In the output it would be joined with the next rapid, in \
             all axes at once: program a complete position here, or remove the block";
        Err(self.refuse(posed, message.to_owned()))
    }

    /// Whether a rapid in a tilted plane or with a tool vector, or one that turns to a plane, comes before a known position of the same tool.
    fn joins_the_next(&self, index: usize) -> bool {
        let motions = &self.reading.motions;
        let motion = &motions[index].motion;
        let tilted = motion.tilt != Tilt::default() || motion.orientation != Orientation::Words;
        let next = self.known().next_from(index).map(|next| motions[next].motion.tool);
        !self.apt && tilted && next == Some(motion.tool)
    }

    /// Whether no position of the tool is known before.
    fn is_approach(&self, index: usize) -> bool {
        let tool = self.reading.motions[index].motion.tool;
        self.known().none_before(index, tool)
    }

    /// Whether the next motion to a known position relies on X, Y or Z being where this one moves it: without this rapid it would move it.
    fn merges(&self, index: usize, moved: &[(usize, f64)]) -> bool {
        let motions = &self.reading.motions;
        let tool = motions[index].motion.tool;
        let next = self.known().next_from(index + 1);
        let next = next.map(|next| &motions[next]);
        next.filter(|next| next.motion.tool == tool).is_some_and(|next| {
            let stays = |axis: usize| {
                let (start, end) = (next.motion.start.get(axis), next.motion.end.get(axis));
                start.is_some() && start == end
            };
            let there = |axis: usize, value: f64| next.motion.end.get(axis) == Some(value);
            moved
                .iter()
                .any(|(axis, value)| *axis < 3 && (stays(*axis) || there(*axis, *value)))
        })
    }
}
