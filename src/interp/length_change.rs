//! What a change of the tool length moves. While the axes are joints, [`Iso::set_length`] leaves the machine where it is, so that the programmed
//! position shifts. That is all where the coordinates shift. Where the axis travels the change, a block starts from there and ends where the words lead from
//! the programmed position of before; and where it is not known which of both a control does, only absolute coordinates say where the block ends.
use crate::codes::BlockCodes;
use crate::core::Report;
use crate::frames::Return;
use crate::iso::Iso;
use crate::words::Words;
use crate::{Argument, Effect, FaultKind, LengthOf, Position};
use trunnion_dialect::{Action, LengthAfterReturn, LengthChange};
use trunnion_vocabulary::{ToolLength, Zero};

/// What was in effect before the first code of a block that may change the length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Before(ToolLength);

/// The length has changed, and where the axis of the tool is since then is not known.
#[derive(Clone, Debug)]
pub(crate) struct Open {
    /// As long as nothing but changes of the length may have moved the axis, the length, the zero point and the place of before: with that length the axis
    /// is there again, whether it travels or the coordinates shift.
    stood: Option<(ToolLength, Zero, Position)>,
}

impl Iso<'_> {
    /// A code is about to set the length.
    pub(crate) fn note_length(&mut self) {
        let before = Before(self.core.state.length);
        self.memory.length_before.get_or_insert(before);
    }

    /// The axes that the length of the tool shifts.
    fn length_axes(&self) -> u16 {
        let along = self.core.setup.length_along().into_iter().enumerate();
        along.fold(0, |axes, (axis, along)| axes | u16::from(along != 0.0) << axis)
    }

    /// Before the motion of a block: what its new length moves. A motion of its own goes out before that of the words.
    pub(crate) fn length_travels(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) {
        if let Some(before) = self.memory.length_before.take() {
            self.new_length(before, words, block, report);
        }
        let axes = self.length_axes();
        let leads = self.leads_absolutely(axes, words, block);
        let led = self.memory.frames.active || self.core.state.tool_axis.tcp();
        let Some(open) = &mut self.memory.length_open else {
            return;
        };
        if led || (words.axes.given | words.axes.unread) & axes != 0 || takes_over(words, block) {
            open.stood = None;
        }
        if leads {
            self.memory.length_open = None;
        } else if words.axes.any() && !block.takes_coordinates || block.returns.is_some() {
            let what = "a motion after a new tool length: whether the axis travels the change (Fanuc: 5006 bit 6, TOS) (declare `length-change` in the \
                        [quirks] of a dialect table, or give the axis an absolute coordinate first: `G43 H1 Z50.`)";
            let kind = FaultKind::NotModelled { what: what.to_owned() };
            report.fault(words.first.unwrap_or_default(), kind);
        }
    }

    fn new_length(&mut self, Before(before): Before, words: &Words, block: &BlockCodes, report: &mut Report<'_>) {
        let mode = self.core.dialect.quirks.length_change;
        let now = self.core.state.length;
        let other = before.is_open() || before.of() != now.of();
        let unclear = other && (before.is_undeclared() || now.is_undeclared());
        let change = now.mm().unwrap_or(0.0) - before.mm().unwrap_or(0.0);
        // what a return has cancelled is not cancelled again
        let nothing = change == 0.0 && !unclear || before.is_open() && now.mm().is_none();
        let axes = self.length_axes();
        let stood = self.memory.length_open.as_ref().and_then(|open| open.stood.clone());
        if let Some((length, zero, place)) = stood
            && length == now
            && zero == self.core.state.zero
        {
            for axis in (0..9).filter(|axis| axes & (1 << axis) != 0) {
                self.core.state.position.values[axis] = place.values[axis];
            }
            self.core.state.position.known |= axes;
            self.memory.length_open = None;
            return;
        }
        if nothing || mode == LengthChange::Shifts || self.leads_absolutely(axes, words, block) {
            return;
        }
        let moves = words.axes.any() || takes_over(words, block);
        let straight = matches!(self.core.state.motion, Some(Action::Rapid | Action::Linear));
        let plain = straight && !takes_over(words, block) && !block.machine_coordinates;
        let known = self.core.state.position.known & axes == axes;
        let lowers = change < 0.0 || unclear && before.mm().is_some();
        let alone = !moves && !block.machine_coordinates && !before.is_open();
        if alone && lowers && mode == LengthChange::Undeclared && (known || self.memory.length_open.is_some()) {
            let what = "a tool length that ends or gets shorter in a block without its axis: whether the axis travels the change, towards the part (Fanuc: 5006 \
                        bit 6, TOS) (declare `length-change` in the [quirks] of a dialect table, or write both in one block: `G0 G49 Z100.`)";
            report.fault(report.whole(), FaultKind::NotModelled { what: what.to_owned() });
        }
        if !known {
            return;
        }
        let mut base = self.core.state.position;
        // the programmed position of before
        let mut place = base;
        for (value, along) in place.values.iter_mut().zip(self.core.setup.length_along()) {
            *value += change * along;
        }
        if mode == LengthChange::Moves && !unclear && plain {
            self.memory.length_base = Some(place);
            if !moves {
                let motion = self.modelled_motion(words, block, report);
                self.memory.out.push(motion);
            }
            return;
        }
        let still = plain && alone;
        let stood = (before, self.core.state.zero.clone(), place);
        self.memory.length_open = Some(Open {
            stood: still.then_some(stood),
        });
        base.known &= !axes;
        if plain && moves {
            self.memory.length_base = Some(base);
            return;
        }
        self.core.state.position = base;
        if self.core.effects.wanted() {
            let words = vec![Argument::code("a new tool length without its axis")];
            self.core
                .effects
                .add(self.core.main_block(report.block), Effect::Unmodelled(words));
        }
    }

    /// Whether the block leads the axes to places that do not depend on where they come from.
    fn leads_absolutely(&self, axes: u16, words: &Words, block: &BlockCodes) -> bool {
        let named = words.axes.given & axes == axes;
        if let Some((to, _)) = block.returns {
            return match to {
                Return::Fixed(_) | Return::Home => named,
                Return::To(_) => named && self.stays_or_leads(axes, words) || !words.axes.any(),
                Return::Check | Return::From => false,
            };
        }
        if block.machine_coordinates {
            return named && words.axes.incremental & axes == 0;
        }
        let straight = matches!(self.core.state.motion, Some(Action::Rapid | Action::Linear));
        named && straight && !takes_over(words, block) && self.distances(words) & axes == 0
    }

    /// Coordinates that are distances.
    pub(crate) fn distances(&self, words: &Words) -> u16 {
        let axes = &words.axes;
        let modal = if self.core.state.coordinates.incremental() {
            (axes.given | axes.unread) & !(axes.absolute | axes.shortest | axes.positive | axes.negative)
        } else {
            0
        };
        axes.incremental | modal
    }

    /// Whether the intermediate point of a return is absolute, or where the axes stand (`G91 Z0`).
    fn stays_or_leads(&self, axes: u16, words: &Words) -> bool {
        let named = self.distances(words) & axes;
        (0..9)
            .filter(|axis| named & (1 << axis) != 0)
            .all(|axis| words.axes.values[axis] == 0.0)
    }

    /// After G28, G30 and G53 have moved axes to machine coordinates: what remains of the length (FANUC B-63844EN/02, p. 204: cancelled upon the
    /// motion, and G43 stays in force). When it acts again that page does not say.
    pub(crate) fn length_after_return(&mut self, moved: u16) {
        let length = self.core.state.length;
        let active = length.is_undeclared() || length.mm().is_some_and(|mm| mm != 0.0);
        if moved & self.length_axes() == 0 || !active || self.core.state.tool_axis.tcp() {
            return;
        }
        match self.core.dialect.quirks.length_after_return {
            LengthAfterReturn::Kept | LengthAfterReturn::CancelledByG28 => {}
            LengthAfterReturn::Cancelled => self.set_length(Some(0.0), LengthOf::Nothing),
            LengthAfterReturn::Undeclared => {
                self.set_length(Some(0.0), length.of());
                if length.is_undeclared() {
                    self.core.state.length.set_declared(None, length.of());
                }
                self.core.state.length.leave_open();
            }
        }
    }

    /// Where the length in force is not known after a return: the block with the coordinates that depend on it as words without a value.
    pub(crate) fn after_return(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) -> Option<Words> {
        let axes = self.length_axes();
        let named = (words.axes.given | words.axes.unread) & axes;
        let cycle = self.core.state.motion.is_some_and(Action::is_hole_cycle) && words.axes.any();
        let still =
            block.returns.is_some() && self.stays_or_leads(axes, words) && self.distances(words) & named == named;
        if named == 0 && !cycle || block.machine_coordinates || block.takes_coordinates || still {
            return None;
        }
        let what = "coordinates of the tool's axis after G28, G30 or G53: whether the tool length acts (declare `length-after-return` in the [quirks] of a \
                    dialect table, or program G43 H again)";
        report.fault(
            words.first.unwrap_or_default(),
            FaultKind::NotModelled { what: what.to_owned() },
        );
        let mut unread = *words;
        let lost = if cycle { axes } else { named };
        unread.axes.given &= !lost;
        unread.axes.unread |= lost;
        Some(unread)
    }
}

/// Whether the block does something else than move its axes on a path from where they stand.
fn takes_over(words: &Words, block: &BlockCodes) -> bool {
    block.takes_coordinates
        || block.not_modelled
        || block.dwell
        || block.returns.is_some()
        || block.pattern.is_some()
        || block.repeated.is_some()
        || block.pocket
        || words.unknown_code
        || words.forgets_all
        || words.polynomial
}
