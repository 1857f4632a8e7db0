//! Calls and returns: M97, M98, M198, G65, G66, M99.
use super::alarms::{Mistake, is_fanuc, rejected};
use super::variables::{Locals, Variables};
use super::{Deep, FlowCode};
use crate::Sink;
use crate::flow::{Back, Calling, Level as Kept, Running};
use crate::iso::Iso;
use crate::{Fault, FaultKind, Refusal};
use trunnion_dialect::{Action, Dialect};
use trunnion_flow::{Key, Search};
use trunnion_syntax::{Address, BlockId, Program, TextRange, Value, Word};

/// Macro calls inside macro calls on a Fanuc 30i (trade knowledge; four on a 16i: B-63684EN/01, p. 278).
const MACRO_LEVELS: usize = 5;
/// Calls by M98 inside each other on a Fanuc 30i (trade knowledge).
const CALL_LEVELS: usize = 10;

/// What a call of Macro B hands over.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct With {
    pub(crate) code: FlowCode,
    pub(crate) arguments: Option<Box<Locals>>,
    /// The modal call that this is.
    pub(crate) modal: Option<usize>,
}

/// What is stored for a call.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    modal_active: usize,
    /// A macro call: the caller's variables, and the arguments, for each repetition.
    variables_of_call: Option<Box<(Locals, Locals)>>,
    /// The modal call that this is.
    modal: Option<usize>,
}

impl Level {
    /// The called program starts again.
    pub(crate) fn again(&self, variables: &mut Variables) {
        if let Some(level) = &self.variables_of_call {
            variables.locals = level.1;
        }
    }
}

impl Iso<'_> {
    /// Where the program of a call is; `None`: M97 to a sequence number that does not exist.
    pub(crate) fn find_macro(
        &mut self,
        calling: &Calling,
        with: &With,
        running: &Running<'_>,
        from: u32,
    ) -> Option<Result<(u16, u32), Vec<trunnion_vocabulary::Searched>>> {
        if with.code == FlowCode::CallLocal && matches!(calling.program, Key::Number(_)) {
            let file = self.flow.file();
            let index = self.sequence_numbers(running.program());
            let block = index.label(&calling.program, from, index.section(from), Search::ForwardThenStart)?;
            return Some(Ok((file, block)));
        }
        Some(self.find(&calling.program, running, with.code == FlowCode::CallExternal))
    }

    /// Puts the arguments of a call in place of the caller's variables.
    pub(crate) fn enter_macro(&mut self, with: With) -> Level {
        let deep = self.flow.deep.get_or_insert_default();
        deep.variables.changes += 1;
        let variables_of_call = with.arguments.map(|arguments| {
            let own = std::mem::replace(&mut deep.variables.locals, *arguments);
            Box::new((own, *arguments))
        });
        let modal_active = deep.modal_active;
        if let Some(place) = with.modal {
            deep.modal_active = place;
        }
        Level {
            modal_active,
            variables_of_call,
            modal: with.modal,
        }
    }

    /// Why a further call is one too many.
    pub(crate) fn too_deep(&self, calling: &Calling) -> Option<FaultKind> {
        let trail = self.flow.trail.as_ref()?;
        let levels = trail.course.programs().count();
        let of_macro = |level: &&Kept| matches!(level, Kept::MacroB(level) if level.variables_of_call.is_some());
        let is_macro = match &calling.with {
            crate::flow::With::MacroB(with) => with.arguments.is_some(),
            crate::flow::With::Sinumerik(_) | crate::flow::With::Task(_) => false,
        };
        let (depth, limit, what) = if self.core.dialect.quirks.declares_names() {
            return crate::sinumerik::too_deep(levels, self.core.setup.limits.depth as usize);
        } else if !is_fanuc(self.core.dialect) {
            (levels, self.core.setup.limits.depth as usize, "calls")
        } else {
            let macros = trail.course.programs().filter(of_macro).count();
            if is_macro {
                (macros, MACRO_LEVELS, "macro calls")
            } else {
                (levels - macros, CALL_LEVELS, "subprogram calls")
            }
        };
        let message = format!("{what} are nested deeper than {limit} levels: does a program call itself?");
        (depth >= limit).then(|| rejected(self.core.dialect, Mistake::Nesting, Refusal::Subprogram, message))
    }

    /// Why a further modal call (G66) is one too many: each calls those before it.
    pub(crate) fn too_many_modal(&self, active: usize) -> Option<FaultKind> {
        let limit = if is_fanuc(self.core.dialect) {
            MACRO_LEVELS
        } else {
            self.core.setup.limits.depth as usize
        };
        let message = format!("more than {limit} modal macro calls are active: end the others first (G67)");
        (active >= limit).then(|| rejected(self.core.dialect, Mistake::Nesting, Refusal::Subprogram, message))
    }

    /// M99 has left a call: the caller's variables are back, and the run continues at a sequence number if M99 names one.
    pub(crate) fn leave_macro(
        &mut self,
        level: &Level,
        back: Back,
        running: &Running<'_>,
        file: u16,
        sink: &mut impl Sink,
    ) {
        if let Some(deep) = &mut self.flow.deep {
            deep.end_level(level);
            deep.variables.changes += 1;
            deep.modal_active = level.modal_active;
        }
        let Some(label) = back.label else { return };
        let called = self.flow.trail.as_ref().and_then(|trail| trail.library.file(file));
        let caller = Running {
            main: running.main,
            called: called.as_deref(),
        };
        let index = self.sequence_numbers(caller.program());
        let at = self.flow.next.saturating_sub(1);
        // from the start of the calling program
        match index.label(&label, u32::MAX, index.section(at), Search::FromStart) {
            Some(to) if to <= at => self.jump_back(to),
            Some(to) => self.jump(to),
            None => {
                let range = caller.program().block(BlockId(at)).range();
                self.no_label(&label, Search::FromStart, range, &caller, at, sink);
            }
        }
    }

    /// M99 of the main program restarts it forever: one pass is run. M99 P jumps; forward, that is followed.
    pub(crate) fn leave_main(&mut self, back: Back, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        let target = back.label.map(|label| {
            let index = self.sequence_numbers(running.main);
            let block = index.label(&label, u32::MAX, index.section(from), Search::FromStart);
            (label, block)
        });
        match target {
            Some((label, None)) => self.no_label(&label, Search::FromStart, back.range, running, from, sink),
            Some((_, Some(to))) if to > from => self.jump(to),
            _ => {
                if !has_end(running.main, self.core.dialect) {
                    let what = "M99 in the main program, which restarts it: one pass is run".to_owned();
                    self.tell_of_flow(running, from, (back.range, FaultKind::NotModelled { what }), sink);
                }
                self.stop();
            }
        }
    }

    /// The text of a called program is at its end, without M30 or M99.
    pub(crate) fn macro_runs_out(&mut self, main: &Program, sink: &mut impl Sink) {
        let Some(place) = self.flow.trail.as_ref().map(|trail| trail.course.place()) else {
            return;
        };
        let (block, range): (BlockId, TextRange) = match place.file {
            0 => {
                let last = place.section.map_or(0, |section| section.1.saturating_sub(1));
                (BlockId(last), main.block(BlockId(last)).range())
            }
            _ => (place.main, place.main_range),
        };
        let message = "the called program ends without M99".to_owned();
        let kind: FaultKind = rejected(self.core.dialect, Mistake::EndOfRecord, Refusal::ProgramEnd, message);
        sink.fault(Fault {
            place: None,
            block,
            range,
            kind,
        });
        self.stop();
    }
}

/// Whether a program has a code that ends it, other than M99.
fn has_end(program: &Program, dialect: &Dialect) -> bool {
    let ends = |word: &Word| match (word.address, word.value) {
        (Address::Letter(b'M'), Value::Number(number)) if number.scale == 0 => {
            let tenths = u32::try_from(number.mantissa).ok().and_then(|m| m.checked_mul(10));
            let code = tenths
                .filter(|&tenths| tenths != 990)
                .and_then(|tenths| dialect.m(tenths));
            code.is_some_and(|code| code.action == Action::ProgramEnd)
        }
        _ => false,
    };
    program.blocks().any(|block| block.words().any(|word| ends(&word)))
}

impl Deep {
    /// Puts the variables of the caller back. Those of a modal call are kept for its next run.
    fn end_level(&mut self, level: &Level) {
        let Some(kept) = &level.variables_of_call else { return };
        let used = std::mem::replace(&mut self.variables.locals, kept.0);
        if let Some(modal) = level.modal.and_then(|place| self.modal.get_mut(place)) {
            *modal.arguments = used;
        }
    }
}
