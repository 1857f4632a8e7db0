//! Calls of other programs and returns from them, for all languages.
use super::{Back, Calling, Level, Running, With, index_of};
use crate::Sink;
use crate::iso::Iso;
use crate::macro_b::{ProgramName, macro_words};
use crate::{FaultKind, Frame, sinumerik};
use trunnion_dialect::Dialect;
use trunnion_flow::{Ends, Key, PendingCall};
use trunnion_syntax::{BlockId, TextRange};

/// Where a called program was found: file and block; else the folders that were searched.
pub(crate) type Found = Result<(u16, u32), Vec<trunnion_vocabulary::Searched>>;

/// The text of the block `from`, where that is one of the main program's file.
pub(crate) fn main_range(running: &Running<'_>, from: u32) -> TextRange {
    match running.called {
        None => running.main.block(BlockId(from)).range(),
        Some(_) => TextRange::default(),
    }
}

/// What is not known of a call by a path.
const BY_PATH: &str = "a call by a path or from outside: the file of the last name is taken, and whether the path leads to it is not known";

/// The name of a program as the text of a file gives it.
fn name_inside(dialect: &Dialect, name: &Key) -> Key {
    if dialect.quirks.declares_names() {
        sinumerik::without_ending(name)
    } else {
        name.clone()
    }
}

/// The call at the block `from`, for messages.
pub(crate) fn frame_of(running: &Running<'_>, from: u32) -> Frame {
    let program = running.program();
    Frame {
        file: running.called.map_or_else(String::new, |called| called.path.clone()),
        line: from + 1,
        what: program.text(program.block(BlockId(from)).range()).trim().to_owned(),
        is_place: false,
    }
}

impl Iso<'_> {
    /// Begins a call.
    pub(crate) fn enter(&mut self, calling: Calling, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        if calling.times == 0 {
            return;
        }
        let found = match &calling.with {
            With::MacroB(with) => {
                let Some(found) = self.find_macro(&calling, with, running, from) else {
                    let search = trunnion_flow::Search::ForwardThenStart;
                    return self.no_label(&calling.program, search, calling.range, running, from, sink);
                };
                found
            }
            // a path leads to another program than those of this text
            With::Sinumerik(with) => self.find(&calling.program, running, with.is_elsewhere),
            With::Task(_) => self.find(&calling.program, running, false),
        };
        let by_path = matches!(&calling.with, With::Sinumerik(with) if with.is_elsewhere);
        let place = match found {
            Ok(place) => {
                if by_path {
                    let what = BY_PATH.to_owned();
                    self.tell_of_flow(running, from, (calling.range, FaultKind::NotModelled { what }), sink);
                }
                place
            }
            Err(searched) => {
                let name = match &calling.program {
                    Key::Name(name) if self.core.dialect.quirks.user_names() => name.to_string(),
                    key => ProgramName(key).to_string(),
                };
                let kind = if by_path && searched.iter().all(|place| place.refused.is_none()) {
                    let what =
                        format!("{name} is called by a path or from outside, and no file of that name was found");
                    FaultKind::NotModelled { what }
                } else {
                    FaultKind::MissingSubprogram {
                        name,
                        searched,
                        alarm: None,
                        caller: None,
                    }
                };
                self.tell_of_flow(running, from, (calling.range, kind), sink);
                self.missing_macro(&calling, from);
                return self.call_is_not_followed();
            }
        };
        if let Some(kind) = self.too_deep(&calling) {
            self.tell_of_flow(running, from, (calling.range, kind), sink);
            return self.stop();
        }
        let Calling { with, times, range, .. } = calling;
        let level = match with {
            With::MacroB(with) => Level::MacroB(self.enter_macro(with)),
            With::Sinumerik(with) => match self.enter_subprogram(with, place, running) {
                Ok(level) => Level::Sinumerik(level),
                Err(what) => {
                    self.tell_of_flow(running, from, (range, FaultKind::NotDecided { what }), sink);
                    return self.stop();
                }
            },
            With::Task(with) => Level::Task(Box::new(self.enter_task(with))),
        };
        self.push_call(level, times, place, running, from);
    }

    /// What a missing modal macro would read: its arguments, which are in the block of its G66.
    fn missing_macro(&mut self, calling: &Calling, from: u32) {
        let With::MacroB(with) = &calling.with else { return };
        let Some(locals) = with.arguments.as_ref().filter(|_| self.core.effects.wanted()) else {
            return;
        };
        let words = macro_words(&calling.program, calling.times, locals);
        let block = self.core.main_block(BlockId(from));
        self.core.effects.add(block, crate::Effect::Unmodelled(words));
    }

    /// What a missing program does is unknown.
    pub(crate) fn call_is_not_followed(&mut self) {
        self.core.forget_everything();
        self.memory.own.lose();
        if let Some(deep) = &mut self.flow.deep {
            deep.variables.lose();
        }
        if let Some(trail) = &mut self.flow.trail {
            trail.called_unread = true;
        }
    }

    fn push_call(&mut self, level: Level, times: u32, (file, start): (u16, u32), running: &Running<'_>, from: u32) {
        let (chain, back) = (self.core.chain, self.flow.next);
        let Some(trail) = &mut self.flow.trail else { return };
        let going = PendingCall {
            from,
            back,
            file,
            start,
            section: trail.known_index(file).map(|index| index.section(start)),
            times,
            ends: Ends::Return,
            level,
        };
        self.core.chain = trail
            .course
            .enter(going, chain, main_range(running, from), || frame_of(running, from));
        self.flow.next = start;
        self.core.called_at = (file != 0).then_some(trail.course.place().main);
    }

    /// A program by its number or name: in the file that runs, in the main program's, in others that were called, in the library.
    pub(crate) fn find(&mut self, name: &Key, running: &Running<'_>, only_library: bool) -> Found {
        let (dialect, own) = (self.core.dialect, self.flow.file());
        let trail = self.flow.trail();
        if !only_library {
            let inside = name_inside(dialect, name);
            let here = trail.index(own, || index_of(dialect, running.program()));
            if let Some(block) = here.program(&inside) {
                return Ok((own, block));
            }
            let main = trail.index(0, || index_of(dialect, running.main));
            if let Some(block) = main.program(&inside) {
                return Ok((0, block));
            }
        }
        let Some(library) = &self.core.setup.library.0 else {
            return Err(Vec::new());
        };
        let tried = || {
            if dialect.quirks.declares_names() {
                sinumerik::files(name)
            } else if dialect.quirks.user_task() {
                crate::osp::files(name)
            } else {
                crate::macro_b::files(name)
            }
        };
        let load = |file: &str| library.load(file).map(|loaded| (loaded.path, loaded.bytes));
        let file = trail.library.find(name, tried, dialect.lex, load)?;
        let found = self.first_block(file, name);
        if self.is_of_others(file, name) {
            let called = self.flow.trail().library.file(file);
            return Err(called.iter().map(|called| called.path.clone().into()).collect());
        }
        Ok((file, found))
    }

    /// The block where a program of another file begins: at its number or header, else after the `%` at its start.
    fn first_block(&mut self, file: u16, name: &Key) -> u32 {
        let dialect = self.core.dialect;
        let trail = self.flow.trail();
        let Some(called) = trail.library.file(file) else {
            return 0;
        };
        let index = trail.index(file, || index_of(dialect, &called.program));
        index.program(&name_inside(dialect, name)).unwrap_or_else(|| {
            let first = called.program.blocks().next();
            let percent = first.is_some_and(|block| {
                let text = called.program.bytes(block.range());
                text.trim_ascii_start().first() == Some(&b'%')
            });
            u32::from(percent).max(crate::leader(&called.program, dialect))
        })
    }

    /// Whether a file that was indexed says which programs are in it, and this is none of them. On an Okuma it always says so; elsewhere a file
    /// without a number is the program whose number is its name.
    fn is_of_others(&self, file: u16, name: &Key) -> bool {
        let index = self.flow.trail.as_ref().and_then(|trail| trail.known_index(file));
        let says = |others: bool| self.core.dialect.quirks.user_task() || others && matches!(name, Key::Number(_));
        index.is_none_or(|index| says(index.names_programs()) && index.program(name).is_none())
    }

    /// A return.
    pub(crate) fn leave(&mut self, back: Back, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        // sections that are repeated end with the program that contains them
        while let Some(trail) = &mut self.flow.trail
            && trail.course.repeated().is_some()
        {
            trail.course.leave(self.flow.next);
        }
        let (changes, block) = (self.changes() + 1, self.core.main_block(BlockId(from)));
        let Some(trail) = &mut self.flow.trail else { return };
        if !trail.course.is_called() {
            return if self.core.dialect.quirks.user_names() {
                self.leave_main_program(&back, running, from, sink);
            } else {
                self.leave_main(back, running, from, sink);
            };
        }
        if back.label.is_none()
            && let Some((start, level)) = trail.course.once_more()
        {
            let mut saved = None;
            match level {
                Level::MacroB(level) => {
                    if let Some(deep) = &mut self.flow.deep {
                        deep.variables.changes += 1;
                        level.again(&mut deep.variables);
                    }
                }
                Level::Sinumerik(level) => {
                    level.again(&mut self.memory.own);
                    saved = level.saved();
                }
                Level::Task(level) => level.again(&mut self.memory.own),
                Level::Section => {}
            }
            self.flow.next = trail.course.jump_back(self.flow.next, start, changes);
            if let Some(kind) = saved.and_then(|saved| self.bring_back(&saved, block)) {
                self.tell_of_flow(running, from, (back.range, kind), sink);
            }
            return;
        }
        let Some(call) = trail.course.leave(self.flow.next) else {
            return;
        };
        self.core.chain = call.chain;
        self.flow.next = call.back;
        self.core.called_at = (call.place.file != 0).then_some(call.place.main);
        match call.level {
            Level::MacroB(level) => self.leave_macro(&level, back, running, call.place.file, sink),
            Level::Sinumerik(level) => {
                if let Some(kind) = self.leave_subprogram(*level, block) {
                    self.tell_of_flow(running, from, (back.range, kind), sink);
                }
            }
            Level::Task(level) => self.leave_task(*level),
            Level::Section => {}
        }
    }

    /// The text of the program that runs is at its end, without a statement that ends it.
    pub(crate) fn ran_out(&mut self, main: &trunnion_syntax::Program, sink: &mut impl Sink) {
        let called = self.flow.trail.as_ref().is_some_and(|trail| trail.course.is_called());
        if !called {
            self.core.state.ended = true;
        } else if self.core.dialect.quirks.user_names() {
            self.subprogram_runs_out(main, sink);
        } else {
            self.core.state.ended = true;
            self.macro_runs_out(main, sink);
        }
    }
}
