//! Calls and returns: M97, M98, M198, G65, G66, M99.
use super::alarms::{Mistake, rejected};
use super::name::ENDINGS;
use super::run::Running;
use super::variables::Locals;
use super::{Call, Called, Calling, Deep, FlowCode, Place, ProgramName};
use crate::run::{Interpreter, Sink};
use crate::{FaultKind, Frame, Refusal};
use std::sync::Arc;
use trunnion_dialect::{Action, Dialect};
use trunnion_syntax::{Address, BlockId, Program, TextRange, Value, Word, parse};

/// Macro calls inside macro calls on a Fanuc 30i (trade knowledge; four on a 16i: B-63684EN/01, p. 278).
const MACRO_LEVELS: usize = 5;
/// Calls by M98 inside each other on a Fanuc 30i (trade knowledge).
const CALL_LEVELS: usize = 10;

/// Where a called program was found: file and block; else the folders that were searched.
type Found = Result<(u16, u32), Vec<String>>;

impl Interpreter<'_> {
    /// Begins a call.
    pub(crate) fn enter(&mut self, calling: Calling, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        if calling.times == 0 {
            return;
        }
        let found = match (calling.code, &calling.program) {
            (FlowCode::CallLocal, &ProgramName::Number(number)) => match self.local(number, running, from) {
                Some(place) => Ok(place),
                None => return self.no_label(number, calling.range, running, from, sink),
            },
            (code, program) => self.find(program, running, code == FlowCode::CallExternal),
        };
        let place = match found {
            Ok(place) => place,
            Err(searched) => {
                let name = calling.program.to_string();
                let kind = FaultKind::MissingSubprogram {
                    name,
                    searched,
                    alarm: None,
                    caller: None,
                };
                self.tell_of_flow(running, from, (calling.range, kind), sink);
                return self.call_is_not_followed();
            }
        };
        if let Some(message) = self.too_deep(&calling) {
            let kind = rejected(self.dialect, Mistake::Nesting, Refusal::Subprogram, message);
            self.tell_of_flow(running, from, (calling.range, kind), sink);
            return self.stop();
        }
        self.push_call(calling, place, running, from);
    }

    /// What a program does that is not there is not known.
    pub(crate) fn call_is_not_followed(&mut self) {
        self.forget_everything();
        if let Some(deep) = &mut self.flow.deep {
            deep.variables.lose();
        }
    }

    fn push_call(&mut self, calling: Calling, (file, block): (u16, u32), running: &Running<'_>, from: u32) {
        let back = self.flow.next;
        let Some(deep) = &mut self.flow.deep else { return };
        deep.variables.changes += 1;
        let caller = deep.place;
        let program = running.program();
        let frame = || Frame {
            file: running.called.map_or_else(String::new, |called| called.path.clone()),
            line: from + 1,
            what: program.text(program.block(BlockId(from)).range()).trim().to_owned(),
            is_place: false,
        };
        let chain = Arc::make_mut(&mut deep.chains).enter(self.chain, caller.file, from, frame);
        let macro_level = calling.arguments.map(|arguments| {
            let own = std::mem::replace(&mut deep.variables.locals, *arguments);
            Box::new((own, *arguments))
        });
        deep.calls.push(Call {
            back,
            place: caller,
            chain: self.chain,
            start: block,
            times: calling.times - 1,
            modal_active: deep.modal_active,
            macro_level,
            modal: calling.modal,
        });
        if let Some(place) = calling.modal {
            deep.modal_active = place;
        }
        self.chain = chain;
        if caller.file == 0 {
            deep.ran.jump(back, block);
        }
        deep.ran.from = block;
        let section = match &deep.indexes.get(usize::from(file)) {
            Some(Some(index)) => Some(index.section(block)),
            _ => None,
        };
        let main = match caller.file {
            0 => (BlockId(from), running.main.block(BlockId(from)).range()),
            _ => (caller.main, caller.main_range),
        };
        deep.place = Place {
            file,
            section,
            main: main.0,
            main_range: main.1,
        };
        self.flow.next = block;
        self.flow.called_at = (file != 0).then_some(main.0);
    }

    /// Why a further call is one too many.
    fn too_deep(&self, calling: &Calling) -> Option<String> {
        let calls = &self.flow.deep.as_ref()?.calls;
        let macros = calls.iter().filter(|call| call.macro_level.is_some()).count();
        let (depth, limit, what) = if !super::alarms::is_fanuc(self.dialect) {
            (calls.len(), self.setup.limits.depth as usize, "calls")
        } else if calling.arguments.is_some() {
            (macros, MACRO_LEVELS, "macro calls")
        } else {
            (calls.len() - macros, CALL_LEVELS, "subprogram calls")
        };
        (depth >= limit).then(|| format!("{what} are nested deeper than {limit} levels: does a program call itself?"))
    }

    /// M97: a sequence number of the program that runs.
    fn local(&mut self, number: u32, running: &Running<'_>, from: u32) -> Option<(u16, u32)> {
        let deep = self.flow.deep.as_mut()?;
        let file = deep.place.file;
        let index = deep.index(file, running.program());
        index
            .label(number, from, index.section(from))
            .map(|block| (file, block))
    }

    /// A program by its number or name: in the file that runs, in the main program's, in others that were called, in the library.
    fn find(&mut self, name: &ProgramName, running: &Running<'_>, only_library: bool) -> Found {
        let Some(deep) = &mut self.flow.deep else {
            return Err(Vec::new());
        };
        if !only_library {
            let own = deep.place.file;
            if let Some(block) = deep.index(own, running.program()).program(name) {
                return Ok((own, block));
            }
            if let Some(block) = deep.index(0, running.main).program(name) {
                return Ok((0, block));
            }
        }
        if let Some(place) = deep.files.iter().position(|called| called.name == *name) {
            let file = place as u16 + 1;
            return Ok((file, deep.first_block(file, name)));
        }
        let Some(library) = &self.setup.library.0 else {
            return Err(Vec::new());
        };
        let mut searched = Vec::new();
        for file in name.files() {
            for ending in ENDINGS {
                match library.load(&format!("{file}{ending}")) {
                    Ok(loaded) => {
                        if deep.files.len() >= usize::from(u16::MAX) - 1 {
                            return Err(searched);
                        }
                        let program = parse(loaded.bytes.to_vec(), self.dialect.lex);
                        deep.files.push(Arc::new(Called {
                            name: name.clone(),
                            path: loaded.path,
                            program,
                        }));
                        let file = deep.files.len() as u16;
                        return Ok((file, deep.first_block(file, name)));
                    }
                    Err(folders) => searched = folders,
                }
            }
        }
        Err(searched)
    }

    /// M99.
    pub(crate) fn leave(
        &mut self,
        label: Option<u32>,
        range: TextRange,
        running: &Running<'_>,
        from: u32,
        sink: &mut impl Sink,
    ) {
        let Some(deep) = &mut self.flow.deep else { return };
        let Some(call) = deep.calls.last_mut() else {
            return self.leave_main(label, range, running, from, sink);
        };
        if call.times > 0 && label.is_none() {
            call.times -= 1;
            deep.variables.changes += 1;
            let start = call.start;
            if let Some(level) = &call.macro_level {
                deep.variables.locals = level.1;
            }
            return self.jump_back(start);
        }
        let Some(call) = deep.calls.pop() else { return };
        if deep.place.file == 0 {
            deep.ran.jump(self.flow.next, call.back);
        }
        if call.place.file == 0 {
            deep.ran.from = call.back;
        }
        deep.end_level(&call);
        deep.variables.changes += 1;
        deep.place = call.place;
        deep.modal_active = call.modal_active;
        self.chain = call.chain;
        self.flow.next = call.back;
        self.flow.called_at = (call.place.file != 0).then_some(call.place.main);
        let Some(number) = label else { return };
        let Some(deep) = &mut self.flow.deep else { return };
        let called = Self::called(deep, call.place.file);
        let caller = Running {
            main: running.main,
            called: called.as_deref(),
        };
        let index = deep.index(call.place.file, caller.program());
        let at = call.back.saturating_sub(1);
        // from the start of the calling program
        match index.label(number, u32::MAX, index.section(at)) {
            Some(to) if to <= at => self.jump_back(to),
            Some(to) => self.jump(to),
            None => {
                let range = caller.program().block(BlockId(at)).range();
                self.no_label(number, range, &caller, at, sink);
            }
        }
    }

    /// M99 of the main program begins it anew for ever: one pass is run. M99 P jumps; forward, that is followed.
    fn leave_main(
        &mut self,
        label: Option<u32>,
        range: TextRange,
        running: &Running<'_>,
        from: u32,
        sink: &mut impl Sink,
    ) {
        let target = label.and_then(|number| {
            let deep = self.flow.deep.as_mut()?;
            let index = deep.index(0, running.main);
            Some((number, index.label(number, u32::MAX, index.section(from))))
        });
        match target {
            Some((number, None)) => self.no_label(number, range, running, from, sink),
            Some((_, Some(to))) if to > from => self.jump(to),
            _ => {
                if !has_end(running.main, self.dialect) {
                    let what = "M99 of the main program, which begins it anew: one pass is run".to_owned();
                    self.tell_of_flow(running, from, (range, FaultKind::NotModelled { what }), sink);
                }
                self.stop();
            }
        }
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
    /// The block where a program of another file begins: at its number, else behind the `%` at its start.
    fn first_block(&mut self, file: u16, name: &ProgramName) -> u32 {
        let Some(called) = self.files.get(usize::from(file) - 1).map(Arc::clone) else {
            return 0;
        };
        let at_number = self.index(file, &called.program).program(name);
        at_number.unwrap_or_else(|| {
            let first = called.program.blocks().next();
            let percent = first.is_some_and(|block| {
                let text = called.program.bytes(block.range());
                text.trim_ascii_start().first() == Some(&b'%')
            });
            u32::from(percent)
        })
    }

    /// Puts the variables of the caller back. Those of a modal call stay for its next time.
    fn end_level(&mut self, call: &Call) {
        let Some(level) = &call.macro_level else { return };
        let (own, _): &(Locals, Locals) = level;
        let used = std::mem::replace(&mut self.variables.locals, *own);
        if let Some(modal) = call.modal.and_then(|place| self.modal.get_mut(place)) {
            *modal.arguments = used;
        }
    }
}
