//! The subprogram of a turning cycle (G70 to G72.2): it is called like any other, but only the motion of its blocks is used, and taken
//! as the contour instead of being made. Where it returns, the cycle runs.
use super::label::Label;
use super::labels::Style;
use super::oline::{Keyword, OLine};
use super::{Compiled, Halt};
use crate::cycles::Turning;
use crate::exec::After;
use crate::{Block, Engine, Sink};
use trunnion_formula::Name;

impl Engine {
    /// Calls the subprogram of the turning cycle that the current line has begun.
    pub(super) fn call_contour(&mut self, compiled: &Compiled, block: &Block) -> Result<(), Halt> {
        let depth = self.flow.calls.len();
        let Some(turning) = self.turning.as_mut().filter(|turning| turning.is_called()) else {
            return Ok(());
        };
        turning.enter(depth);
        let label = Name::new(&turning.subprogram().to_string());
        let name = self.flow.labels.name(&label);
        let range = block.range_of(b'Q');
        let line = OLine {
            keyword: Keyword::Call,
            label: Label::Text(label),
            label_range: range,
            keyword_range: range,
            values: Vec::new(),
            flaw: None,
            tail: None,
            rest: range,
            errors: Vec::new(),
        };
        let mut site = Compiled {
            place: compiled.place,
            next: compiled.next,
            ..Compiled::default()
        };
        let entered = self.enter(&mut site, &line, name, Style::Sub, 1, Some(&[]));
        if entered.is_err() {
            self.turning = None;
        } else {
            // here U and W are increments of X and Z, whatever axes the machine has
            self.store.allow_axes(&self.setup, "UW");
        }
        entered
    }
    /// Whether the current line belongs to a contour.
    pub(super) fn in_contour(&self) -> bool {
        self.turning
            .as_ref()
            .is_some_and(|turning| !turning.is_called() && self.flow.calls.len() > turning.depth())
    }
    /// Takes the motion of a block into the contour.
    pub(super) fn contour_block(&mut self, block: &Block) -> Result<After, Halt> {
        if block.g[1] >= 0 {
            self.state.motion = block.g[1];
        }
        let motion = self.state.motion;
        if let Some(turning) = self.turning.as_mut() {
            turning.add(&self.state, block, motion)?;
        }
        Ok(After::Go)
    }
    /// The cycle whose contour ends with the current call.
    pub(super) fn take_turning(&mut self) -> Option<Box<Turning>> {
        let depth = self.flow.calls.len();
        let ended = self
            .turning
            .take_if(|turning| !turning.is_called() && turning.depth() + 1 == depth);
        if ended.is_some() {
            self.store.allow_axes(&self.setup, "");
        }
        ended
    }
    /// Runs the cycle after its contour.
    pub(super) fn finish_turning(&mut self, turning: Turning, sink: &mut dyn Sink) -> Result<(), Halt> {
        let at = self.flow.at;
        let range = self.files[at.file.0 as usize].line(at.line).unwrap_or_default();
        turning.finish(self, range, sink)?;
        self.refresh_parameters();
        Ok(())
    }
}
