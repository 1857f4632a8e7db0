//! The interpreter of all dialects: it chooses the engine of the language and hands over to it.
use crate::apt::Apt;
use crate::core::Core;
use crate::engine::Engine;
use crate::iso::Iso;
use crate::klartext::Klartext;
use crate::rs274::Ngc;
use crate::{ChainId, Frame, ModalState, ProgramRun, Setup, Sink, Tool};
use trunnion_dialect::{Dialect, Language};
use trunnion_syntax::{BlockId, Format, Program};

/// An interpreter between two blocks. Cloning it makes a check-point to continue from.
#[derive(Clone)]
pub struct Interpreter<'d> {
    engine: Engines<'d>,
}

#[derive(Clone)]
enum Engines<'d> {
    Iso(Box<Iso<'d>>),
    Apt(Box<Apt<'d>>),
    Klartext(Box<Klartext<'d>>),
    Ngc(Box<Ngc<'d>>),
}

/// Does the same for every engine.
macro_rules! with_engine {
    ($interpreter:expr, $engine:ident => $do:expr) => {
        match $interpreter {
            Engines::Iso($engine) => $do,
            Engines::Apt($engine) => $do,
            Engines::Klartext($engine) => $do,
            Engines::Ngc($engine) => $do,
        }
    };
}

impl<'d> Interpreter<'d> {
    /// At the start of a program.
    pub fn new(dialect: &'d Dialect, setup: &Setup) -> Self {
        let mut core = Core::new(dialect, setup);
        if setup.control.tcp_codes.as_ref().is_some_and(|codes| codes.at_start) {
            core.state.tool_axis.set_tcp(true);
        }
        core.merge_tool();
        let engine = match (dialect.lex.format, dialect.quirks.language) {
            (Format::Apt, _) => Engines::Apt(Box::new(Apt::new(core))),
            (Format::Klartext, _) => Engines::Klartext(Box::new(Klartext::new(core))),
            (Format::Iso, Language::Linuxcnc) => Engines::Ngc(Box::new(Ngc::new(core))),
            (Format::Osp, _)
            | (Format::Iso, Language::Words | Language::MacroB | Language::Sinumerik | Language::UserTask) => {
                Engines::Iso(Box::new(Iso::new(core)))
            }
        };
        Self { engine }
    }

    /// Runs one block, for callers that choose the blocks themselves: jumps, loops and calls are never followed, so all variables
    /// are unknown after the first of them. The first step also reads the program's own declarations of tools; the step of
    /// the last block reports a missing program end. Blocks after the program's end are not run. LinuxCNC's own engine chooses its lines
    /// itself: the first step replaces it by the engine of the other controls.
    pub fn step(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        if let Engines::Ngc(engine) = &self.engine {
            self.engine = Engines::Iso(Box::new(Iso::new(engine.core().clone())));
        }
        let is_there = (block.0 as usize) < program.block_count();
        let is_last = block.0 as usize + 1 == program.block_count();
        match &mut self.engine {
            Engines::Iso(engine) if is_there => {
                engine.step(program, block, sink);
                if is_last {
                    engine.finish(program, sink);
                }
            }
            Engines::Apt(engine) if is_there => {
                engine.step(program, block, sink);
                if is_last {
                    engine.core().missing_end(program, sink);
                }
            }
            Engines::Klartext(engine) if is_there => {
                engine.step(program, block, sink);
                if is_last {
                    engine.finish(program, block, sink);
                }
            }
            Engines::Iso(_) | Engines::Apt(_) | Engines::Klartext(_) | Engines::Ngc(_) => {}
        }
    }

    /// Runs the next block in the order in which the control runs them: jumps, loops and calls are followed. The block, or `None`
    /// when nothing is left to run. For a block of another file it is the block of the main program whose call led there.
    ///
    /// With the last block it also reports a missing program end, and what is wrong with the text of blocks that did not run. M99
    /// of the main program ends the run: one pass is run.
    #[inline]
    pub fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        with_engine!(&mut self.engine, engine => {
            let ran = engine.advance(program, sink);
            let progress = &engine.core().setup.progress;
            match ran {
                Some(block) => progress.reach(block.0, program.block_count()),
                None => progress.end(),
            }
            ran
        })
    }

    /// Reads what the run needs of the whole text before its first block; whether that could be something else if the text went on.
    pub fn reads_whole(&mut self, program: &Program) -> bool {
        with_engine!(&mut self.engine, engine => {
            engine.read_whole(program);
            let core = engine.core();
            core.standing.is_open() || core.drawing.is_open()
        })
    }

    /// Whether a clone continues as this run would on another text that is the same up to here: no jump, loop or call was followed, no motion
    /// is held back, and the engine keeps nothing of the text.
    pub fn may_continue_elsewhere(&self) -> bool {
        match &self.engine {
            Engines::Iso(engine) => {
                let core = engine.core();
                let read = !core.standing.is_open() && !core.drawing.is_open();
                read && engine.is_straight() && !engine.motions_wait()
            }
            Engines::Apt(_) | Engines::Klartext(_) | Engines::Ngc(_) => false,
        }
    }

    /// How many entries of lists that grow with the program a clone copies: so many blocks, at least, should lie between two check-points.
    pub fn copied(&self) -> usize {
        with_engine!(&self.engine, engine => engine.core().copied() + engine.copied())
    }

    /// Whether a jump, loop or call was followed, where the engine says so.
    pub fn follows_flow(&self) -> bool {
        matches!(&self.engine, Engines::Iso(engine) if !engine.is_straight())
    }

    /// Whether a block belongs to the contour of the turning cycle before it.
    pub fn passes_over(&self, block: BlockId) -> bool {
        match &self.engine {
            Engines::Iso(engine) => engine.passes_over(block),
            Engines::Apt(_) | Engines::Klartext(_) | Engines::Ngc(_) => false,
        }
    }

    /// Whether LinuxCNC's own engine runs.
    pub fn is_linuxcnc(&self) -> bool {
        matches!(self.engine, Engines::Ngc(_))
    }

    /// What is in effect.
    #[inline]
    pub fn state(&self) -> &ModalState {
        with_engine!(&self.engine, engine => &engine.core().state)
    }

    /// The same, mutable, to assume something before the first block.
    pub fn state_mut(&mut self) -> &mut ModalState {
        with_engine!(&mut self.engine, engine => &mut engine.core_mut().state)
    }

    /// Axes that stand at 0 because the machine lacks them or the program never names them: bits as in [`crate::Position::known`].
    pub fn standing(&self) -> u16 {
        with_engine!(&self.engine, engine => engine.core().standing.axes())
    }

    /// Asks for effects: without, [`Sink::effect`] is never called.
    pub fn watch_effects(&mut self) {
        with_engine!(&mut self.engine, engine => engine.core_mut().effects.watch());
    }

    /// Asks for the numbers of blocks among the effects: where a program that is missing may return to one of them.
    pub fn watch_block_numbers(&mut self) {
        with_engine!(&mut self.engine, engine => engine.core_mut().effects.watch_numbers());
    }

    /// The modal state, for something that is not modelled.
    pub fn situation(&self) -> crate::Situation {
        with_engine!(&self.engine, engine => {
            let state = &engine.core().state;
            crate::Situation::new(state, engine.returns_to_r(), engine.turned(), engine.cycle_data())
        })
    }

    /// How the coordinates of the words are turned, scaled, mirrored, tilted or polar, and corners rounded: numbers that are equal where that
    /// is. Empty where nothing is active.
    pub fn turned(&self) -> Vec<f64> {
        with_engine!(&self.engine, engine => engine.turned())
    }

    /// How many times everything modal became unknown so far: a program that is missing may have changed it.
    pub fn losses(&self) -> u64 {
        with_engine!(&self.engine, engine => engine.core().losses)
    }

    /// How many motions the cycles of the run have made so far, and steps that they worked out in vain.
    pub fn cycle_work(&self) -> u64 {
        with_engine!(&self.engine, engine => engine.cycle_work())
    }

    /// Variables that hold texts, keep them after the program ends and are known.
    pub fn outliving_texts(&self) -> Vec<(String, String)> {
        with_engine!(&self.engine, engine => engine.outliving_texts())
    }

    /// All variables that are known, or were known before something ran that is not followed, by name.
    pub fn known_variables(&self) -> Vec<crate::Argument> {
        with_engine!(&self.engine, engine => engine.known_variables())
    }

    /// Adds the values of the variables that words name.
    pub fn add_values(&self, words: &mut Vec<crate::Argument>) {
        let hashed = |word: &crate::Argument| {
            word.name.contains('#') || matches!(&word.value, crate::Value::Text(text) if text.contains('#'))
        };
        let names = with_engine!(&self.engine, engine => engine.core().dialect.quirks.user_names());
        if !names && !words.iter().any(hashed) {
            return;
        }
        let text: Vec<String> = words.iter().map(ToString::to_string).collect();
        let text = text.join(" ");
        words.extend(with_engine!(&self.engine, engine => engine.values_in(&text)));
    }

    /// The text of a block with the variables in it replaced by their values.
    pub fn resolved_text(&self, text: &str) -> String {
        with_engine!(&self.engine, engine => engine.resolved_text(text))
    }

    /// What is declared about the tool in use, merged; `None` when nothing is declared and its number is unknown.
    pub fn tool(&self) -> Option<Tool> {
        self.state().tool.data()
    }
}

impl ProgramRun for Interpreter<'_> {
    fn state(&self) -> &ModalState {
        self.state()
    }
    fn chain(&self, chain: ChainId) -> Vec<Frame> {
        with_engine!(&self.engine, engine => engine.chain(chain))
    }
    fn motions_wait(&self) -> bool {
        with_engine!(&self.engine, engine => engine.motions_wait())
    }
    fn variable(&self, text: &str) -> Option<f64> {
        with_engine!(&self.engine, engine => engine.variable(text))
    }
    fn outliving(&self) -> Vec<(String, f64)> {
        with_engine!(&self.engine, engine => engine.outliving())
    }
}

/// Runs a whole program.
pub fn run(program: &Program, dialect: &Dialect, setup: &Setup, sink: &mut impl Sink) {
    let mut interpreter = Interpreter::new(dialect, setup);
    while let Some(block) = interpreter.advance(program, sink) {
        sink.block_done(block, &interpreter);
    }
}
