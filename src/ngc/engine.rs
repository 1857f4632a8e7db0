//! The engine: one line after the other, in the order in which the control runs them.
use crate::flow::Flow;
use crate::{Block, Canon, Error, FileId, Setup, Source, State};
use foldhash::HashMap;
use std::sync::Arc;
use trunnion_formula::Variables;
use trunnion_syntax::TextRange;

/// A chain of calls; 0: the main program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ChainId(pub u32);

/// One call in a chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// File of the call.
    pub file: FileId,
    /// Line of the call, from 0.
    pub line: u32,
    /// As written, or the name that is called.
    pub what: String,
}

/// The origin of a call.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct At {
    /// File.
    pub file: FileId,
    /// Line, from 0.
    pub line: u32,
    /// Calls before it.
    pub chain: ChainId,
}

/// Receives what a run does, in order.
pub trait Sink {
    /// A canonical call; `state` is what is in effect after the part of the line that made it.
    fn call(&mut self, call: &Canon, at: At, state: &State);
    /// [`Canon::Traverse`] (`rapid`) or [`Canon::Feed`] to a pose, which [`Self::call`] emits differently.
    fn straight(&mut self, rapid: bool, end: &crate::Pose, at: At, state: &State) {
        let call = if rapid {
            Canon::Traverse(*end)
        } else {
            Canon::Feed(*end)
        };
        self.call(&call, at, state);
    }
    /// A line was refused. `main`: the first error, where the control stops; further ones are of the same line.
    fn error(&mut self, error: &Error, at: At);
    /// A line that runs contains a NUL: the control does not read the bytes from there to the end of the line.
    fn cut(&mut self, _range: TextRange, _at: At) {}
    /// A subprogram that nothing calls is entered ([`crate::Setup::enter_definitions`]): spindle and arguments are unknown.
    fn entered(&mut self, _name: &str, _at: At) {}
}

/// The result of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// One line was run.
    Line,
    /// The program has ended (M2, M30, `%`), or the file has: then an error was reported before.
    Ended,
    /// The line was refused; `Engine::step` may be called to continue with the next line as if it had not been there.
    Refused,
    /// A condition, call or jump depends on something unknown: what runs next is not known.
    Undecided(String),
    /// The bounds are used up; line that opens the innermost loop or call.
    OutOfFuel(At),
    /// The loop that this line opens never ends: it sends nothing to the machine, and all values are as they were before. With it
    /// how many lines ran a second time or more often until then.
    Endless(At, u64),
}

/// The interpreter between two lines. Cloning it makes a check-point.
#[derive(Clone)]
pub struct Engine {
    pub(crate) setup: Arc<Setup>,
    pub(crate) files: Vec<Arc<Source>>,
    /// The files that were opened after the main program, by their paths.
    pub(crate) opened: Arc<HashMap<String, FileId>>,
    /// What is in effect.
    pub state: State,
    /// The order of execution.
    pub(crate) flow: Flow,
    /// Kept for its storage.
    pub(crate) block: Option<Box<Block>>,
    /// Parameters.
    pub(crate) store: crate::parameters::Store,
    /// Moves that cutter compensation holds back, and calls queued after them.
    pub(crate) queue: crate::comp::Queue,
    /// The spline that is being described.
    pub(crate) spline: crate::cycles::Spline,
    /// The turning cycle whose contour is being read.
    pub(crate) turning: Option<Box<crate::cycles::Turning>>,
}

impl Engine {
    /// At the start of a program.
    pub fn new(main: Arc<Source>, setup: &Setup) -> Self {
        Self {
            setup: Arc::new(setup.clone()),
            files: vec![main],
            opened: Arc::default(),
            state: State::new(setup.start == crate::Start::Unknown),
            flow: Flow::new(setup),
            block: None,
            store: crate::parameters::Store::new(setup),
            queue: crate::comp::Queue::default(),
            spline: crate::cycles::Spline::default(),
            turning: None,
        }
    }
    /// Whether the run skips the definition of a subroutine.
    pub fn is_defining(&self) -> bool {
        self.flow.is_defining()
    }
    /// How many names, labels, chains of calls, calls that wait, control points and tools a check-point copies.
    pub fn copied(&self) -> usize {
        let kept = self.queue.count() + self.spline.points().len() + self.state.tools.count();
        self.flow.copied() + self.store.copied() + kept
    }
    /// How many files the run has opened, the main program among them.
    pub fn file_count(&self) -> usize {
        self.files.len()
    }
    /// The name of a file for messages; empty for the main program.
    pub fn path(&self, file: FileId) -> &str {
        self.files.get(file.0 as usize).map_or("", |source| &source.path)
    }
    /// Control points of a spline (G5.2) that was left without G5.3: another motion came, or the program ended.
    pub fn left_spline(&self, ended: bool) -> &[[f64; 3]] {
        if ended || self.state.motion != 52 {
            self.spline.points()
        } else {
            &[]
        }
    }
    /// The value of a parameter as it is written, `#1` or `#<name>`, between two lines; NaN where it is unknown, `None` where there is none.
    pub fn variable(&self, text: &str) -> Option<f64> {
        let name = text.trim().strip_prefix('#')?;
        let values = crate::parameters::Values::new(self);
        match name.strip_prefix('<') {
            Some(inside) => {
                let plain = inside.strip_suffix('>')?.split_whitespace().collect::<String>();
                values.named(&plain.to_ascii_lowercase()).ok()
            }
            None => values.told(name.trim().parse().ok()?),
        }
    }
    /// Parameters that are kept after the program ends and are known: `#31` to `#5000`, those of the parameter file (`#5161` to `#5390`: home
    /// positions, G92, coordinate systems), and global names (LinuxCNC user manual, G-code overview, parameters).
    pub fn outliving(&self) -> Vec<(String, f64)> {
        let numbers = (31..=5000).chain(5161..=5390);
        let held = numbers.map(|index| (index, self.store.number(index)));
        // few of the thousands are known: only those get a name
        let known = held.filter(|(_, value)| !value.is_nan());
        let named = self.store.globals().filter(|(_, value)| !value.is_nan());
        known
            .map(|(index, value)| (format!("#{index}"), value))
            .chain(named)
            .collect()
    }
    /// The text of a line (from 0) without the blanks around it; empty where there is no such line.
    pub fn text_of(&self, file: FileId, line: u32) -> String {
        let source = self.files.get(file.0 as usize);
        let range = self.line_range(file, line);
        let bytes = source
            .zip(range)
            .map_or(&[][..], |(source, range)| &source.bytes()[range.as_usize()]);
        String::from_utf8_lossy(bytes.trim_ascii()).into_owned()
    }
    /// The codes and words of a line that has just run; `None` where it is not a block (an O line, a comment).
    pub fn block_at(&self, at: At) -> Option<&Block> {
        let line = self.line_range(at.file, at.line)?;
        let block = self.block.as_deref()?;
        (line.start <= block.range.start && block.range.end <= line.end).then_some(block)
    }
    /// Emits a canonical call. While cutter compensation holds moves back, calls are queued after them in order.
    #[inline]
    pub(crate) fn emit(&mut self, call: Canon, at: At, sink: &mut dyn Sink) {
        if !self.queue.is_empty() && crate::comp::waits(&call) {
            self.queue.hold(call, at);
            return;
        }
        self.state.told.follow(&call);
        sink.call(&call, at, &self.state);
    }
}
