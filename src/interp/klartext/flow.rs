//! The order in which blocks run: LBL, CALL LBL, REP, CALL PGM, jumps of FN 9 to FN 12.
//!
//! `CALL LBL n` runs the blocks from the label to LBL 0; with REP m the section from the label to the call runs m times more; a called program
//! ends with END PGM, M2 or M30, and what it has shifted and turned stays. Source: TNC 640 user's manual, subprograms and program sections.
use super::Klartext;
use super::calls::Caller;
use super::labels::{files, labels, no_label};
use crate::flow::through::Through;
use crate::{Fault, FaultKind, Frame, Sink};
use std::collections::HashMap;
use std::sync::Arc;
use trunnion_flow::{BlockBudget, Called, Course, Ends, Index, Key, Library, PendingCall, Search};
use trunnion_syntax::{BlockId, Program, TextRange};

/// What a block requests of the flow.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Request {
    Next,
    /// FN 9 to FN 12.
    Jump(Key),
    /// A subprogram of this file.
    Call(Key),
    /// The section from the label to here, so many times more.
    Repeat(Key, u32),
    /// Another program.
    Program(String),
    /// LBL 0.
    Return,
    /// END PGM, M2, M30.
    EndOfProgram,
    /// The run cannot be followed from here on.
    Stop,
}

/// What is kept for a caller.
#[derive(Clone, Debug)]
pub(crate) enum Level {
    Label,
    Program(Caller),
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flow {
    pub(crate) course: Course<Level>,
    next: u32,
    begun: bool,
    finished: bool,
    pub(super) library: Library,
    labels: HashMap<u16, Arc<Index<()>>>,
    /// Labels that a file has more than once, with the lines of two of them.
    pub(super) doubled: HashMap<u16, HashMap<Key, [u32; 2]>>,
    /// Sections that are being repeated: file, block of the call, depth, and how often still.
    repeats: HashMap<(u16, u32, usize), u32>,
    turns: u64,
    pub(super) selected: Option<String>,
    pub(super) reported: crate::flow::reported::ReportedFaults,
}

impl Klartext<'_> {
    /// What the program says as a whole, before its first block.
    fn begin_once(&mut self, main: &Program, sink: &mut impl Sink) {
        if std::mem::replace(&mut self.flow.begun, true) {
            return;
        }
        for (block, kind) in self.doubled_labels(0, main, None) {
            sink.fault(Fault {
                place: None,
                block,
                range: main.block(block).range(),
                kind,
            });
        }
        if self.core.effects.wanted() {
            self.head_effects(main);
            self.core.emit_effects(sink);
        }
    }

    /// Runs the next block in the control's order.
    pub(crate) fn run_next(&mut self, main: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        if self.flow.finished || main.block_count() == 0 {
            return None;
        }
        self.core.declare(main);
        self.begin_once(main, sink);
        let next = self.flow.next;
        let place = self.flow.course.place();
        let called = self.flow.library.file(place.file);
        let block = if called.is_none() { BlockId(next) } else { place.main };
        let program = called.as_deref().map_or(main, |called: &Called| &called.program);
        let bytes = program.block(BlockId(next)).range().as_usize().len() as u64;
        let limits = &self.core.setup.limits;
        let most = limits.work(main.block_count() as u64, main.source().len() as u64);
        let budget = self.flow.course.count(bytes, most);
        if let BlockBudget::Out { most, proved, blocks } = budget {
            let at = match most {
                Some((0, block)) => BlockId(block),
                _ => block,
            };
            let range = main.block(at).range();
            let kind = FaultKind::EndlessLoop { blocks, proved };
            sink.fault(Fault {
                place: None,
                block: at,
                range,
                kind,
            });
            self.stop(main, block, sink);
            return Some(block);
        }
        self.flow.next = next + 1;
        let content = self.core.last_content;
        let chain = self.core.chain;
        if let Some(called) = called.as_deref() {
            self.core.chain = self
                .flow
                .course
                .stand(chain, next, || frame(program, called, next, true));
        }
        let mut through = Through {
            reported: std::mem::take(&mut self.flow.reported),
            again: called.is_none() && self.flow.course.has_run(next),
            place,
            called: called.as_deref(),
            moved: false,
            sink,
        };
        let request = self.run_block(program, BlockId(next), &mut through);
        self.core.chain = chain;
        let request = if matches!(request, Request::Next) {
            request
        } else {
            // a corner and an approach wait for the next motion wherever it is in this file
            if matches!(request, Request::Program(_) | Request::EndOfProgram | Request::Stop) {
                self.flush_in(program, BlockId(next), &mut through);
            }
            self.obey(request, program, called.as_deref(), next, &mut through)
        };
        self.flow.reported = through.reported;
        if called.is_some() {
            self.core.last_content = content;
        }
        match request {
            Request::Stop => self.stop(main, block, sink),
            Request::EndOfProgram => self.end_of_program(main, block, sink),
            _ => {
                let file = self.flow.course.place().file;
                let blocks = match self.flow.library.file(file) {
                    Some(called) => called.program.block_count(),
                    None => main.block_count(),
                };
                if self.flow.next as usize >= blocks {
                    if file != 0 {
                        self.end_of_program(main, block, sink);
                    } else {
                        self.finished(main, block, sink);
                    }
                }
            }
        }
        Some(block)
    }

    /// Whether a program that CALL PGM has called is running.
    pub(super) fn is_called(&self) -> bool {
        let mut levels = self.flow.course.programs();
        levels.any(|level| matches!(level, Level::Program(_)))
    }

    /// Nothing is left to run.
    fn finished(&mut self, main: &Program, block: BlockId, sink: &mut impl Sink) {
        self.flow.finished = true;
        self.core.state.ended = true;
        let end = self.flow.next;
        self.flow.course.stop(end);
        self.finish(main, block, sink);
    }

    fn stop(&mut self, main: &Program, block: BlockId, sink: &mut impl Sink) {
        // what is missing was told
        self.core.proper_end = true;
        self.finished(main, block, sink);
    }

    /// END PGM, M2 or M30: of a called program back to the caller.
    fn end_of_program(&mut self, main: &Program, block: BlockId, sink: &mut impl Sink) {
        while let Some(call) = self.flow.course.leave(self.flow.next) {
            self.core.chain = call.chain;
            self.flow.next = call.back;
            self.core.called_at = (call.place.file != 0).then_some(call.place.main);
            if let Level::Program(caller) = call.level {
                return self.come_back(caller);
            }
        }
        self.core.proper_end = true;
        self.finished(main, block, sink);
    }

    /// Does what a block requests.
    fn obey(
        &mut self,
        request: Request,
        program: &Program,
        called: Option<&Called>,
        from: u32,
        sink: &mut impl Sink,
    ) -> Request {
        let range = program.block(BlockId(from)).range();
        let block = BlockId(from);
        let mut tell = |kind: FaultKind| {
            sink.fault(Fault {
                place: None,
                block,
                range,
                kind,
            });
        };
        if let Request::Jump(key) | Request::Call(key) | Request::Repeat(key, _) = &request
            && let Some(refused) = self.refused_target(key)
        {
            tell(refused);
            return Request::Stop;
        }
        match request {
            Request::Return => {
                let call = self.flow.course.leave(self.flow.next);
                if let Some(call) = call {
                    self.core.chain = call.chain;
                    self.flow.next = call.back;
                }
                Request::Next
            }
            Request::Jump(key) => {
                let Some(to) = self.target(&key, program) else {
                    tell(no_label(&key));
                    return Request::Stop;
                };
                let end = from + 1;
                self.flow.next = if to <= from {
                    let changes = self.memory.parameters.changes + self.flow.turns;
                    self.flow.course.jump_back(end, to, changes)
                } else {
                    self.flow.course.jump(end, to)
                };
                Request::Next
            }
            Request::Call(key) => {
                let Some(start) = self.target(&key, program) else {
                    tell(no_label(&key));
                    return Request::Stop;
                };
                if self.flow.course.depth() >= self.core.setup.limits.depth as usize {
                    tell(too_deep());
                    return Request::Stop;
                }
                let file = self.flow.course.place().file;
                self.enter(file, start, Level::Label, program, called, from);
                Request::Next
            }
            Request::Repeat(key, times) => self.repeat(&key, times, program, from, &mut tell),
            Request::Program(name) => self.call_program(&name, program, called, from, &mut tell),
            other => other,
        }
    }

    fn repeat(
        &mut self,
        key: &Key,
        times: u32,
        program: &Program,
        from: u32,
        tell: &mut dyn FnMut(FaultKind),
    ) -> Request {
        let Some(to) = self.target(key, program) else {
            tell(no_label(key));
            return Request::Stop;
        };
        if to > from {
            let what = "REP with a label after it, which is no section that has run".to_owned();
            tell(FaultKind::NotDecided { what });
            return Request::Stop;
        }
        let place = (self.flow.course.place().file, from, self.flow.course.depth());
        let left = self.flow.repeats.entry(place).or_insert(times);
        if *left == 0 {
            self.flow.repeats.remove(&place);
            return Request::Next;
        }
        *left -= 1;
        self.flow.turns += 1;
        let changes = self.memory.parameters.changes + self.flow.turns;
        self.flow.next = self.flow.course.jump_back(from + 1, to, changes);
        Request::Next
    }

    fn call_program(
        &mut self,
        written: &str,
        program: &Program,
        called: Option<&Called>,
        from: u32,
        tell: &mut dyn FnMut(FaultKind),
    ) -> Request {
        let base = written.rsplit(['\\', '/', ':']).next().unwrap_or_default().trim();
        let key = Key::Name(base.to_ascii_uppercase().into());
        let found = match &self.core.setup.library.0 {
            Some(library) => {
                let load = |file: &str| library.load(file).map(|loaded| (loaded.path, loaded.bytes));
                self.flow
                    .library
                    .find(&key, || files(base), self.core.dialect.lex, load)
            }
            None => Err(Vec::new()),
        };
        match found {
            Err(searched) => {
                tell(FaultKind::MissingSubprogram {
                    name: base.to_owned(),
                    searched,
                    alarm: None,
                    caller: None,
                });
                self.call_is_not_followed();
                Request::Next
            }
            Ok(_) if self.flow.course.depth() >= self.core.setup.limits.depth as usize => {
                tell(too_deep());
                Request::Stop
            }
            Ok(file) => {
                self.doubled_in_called(file).into_iter().for_each(&mut *tell);
                let caller = self.caller();
                self.enter(file, 0, Level::Program(caller), program, called, from);
                Request::Next
            }
        }
    }

    fn enter(&mut self, file: u16, start: u32, level: Level, program: &Program, called: Option<&Called>, from: u32) {
        let going = PendingCall {
            from,
            back: self.flow.next,
            file,
            start,
            section: None,
            times: 1,
            ends: Ends::Return,
            level,
        };
        let range = if called.is_none() {
            program.block(BlockId(from)).range()
        } else {
            TextRange::default()
        };
        let chain = self.core.chain;
        self.core.chain = self.flow.course.enter(going, chain, range, || match called {
            Some(called) => frame(program, called, from, false),
            None => Frame {
                file: String::new(),
                line: from + 1,
                what: program.text(range).trim().to_owned(),
                is_place: false,
            },
        });
        self.flow.next = start;
        self.core.called_at = (file != 0).then_some(self.flow.course.place().main);
    }

    fn target(&mut self, key: &Key, program: &Program) -> Option<u32> {
        let file = self.flow.course.place().file;
        let index = self
            .flow
            .labels
            .entry(file)
            .or_insert_with(|| Arc::new(labels(program)));
        index.label(key, 0, (0, program.block_count() as u32), Search::FromStart)
    }
}

fn too_deep() -> FaultKind {
    FaultKind::NotDecided {
        what: "calls inside calls beyond the bound of the run".to_owned(),
    }
}

fn frame(program: &Program, called: &Called, block: u32, is_place: bool) -> Frame {
    Frame {
        file: called.path.clone(),
        line: block + 1,
        what: program.text(program.block(BlockId(block)).range()).trim().to_owned(),
        is_place,
    }
}
