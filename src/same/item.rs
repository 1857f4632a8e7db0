//! What a program does, step by step: motions, events, stored data.
use crate::process::{Held, Process, Restated};
use std::sync::Arc;
use trunnion_interp::{Argument, Effect, Motion, Reach, Situation, Value};
use trunnion_machine::Leg;
use trunnion_syntax::BlockId;

/// A motion with everything that is in effect.
#[derive(Clone, Debug)]
pub struct Step {
    /// As programmed.
    pub motion: Motion,
    /// What the machine does; `None` without a machine.
    pub leg: Option<Leg>,
    /// The fields of the modal state.
    pub held: Held,
    /// What else is in effect.
    pub process: Arc<Process>,
    /// What its block says, where the motion does not: its end, its feed or its time is not known.
    pub(crate) said: Option<Arc<str>>,
    /// The text of that block in one spelling, where variables are in it.
    pub(crate) with_variables: Option<Arc<str>>,
    /// Since the motion before, nothing can have changed its coordinates: a block that repeats the position does not move.
    pub may_repeat: bool,
    /// The program states where it starts (FROM of APT): no motion before it ends there.
    pub starts_anew: bool,
    /// It is a part of a motion of the program, up to a point at which the other program has one.
    pub is_part: bool,
}

impl Step {
    /// A motion by itself: what depends on those before it is not known yet.
    pub(crate) fn new(motion: &Motion, leg: Option<Leg>, held: Held, process: &Arc<Process>) -> Self {
        Self {
            motion: *motion,
            leg,
            held,
            process: Arc::clone(process),
            said: None,
            with_variables: None,
            may_repeat: false,
            starts_anew: false,
            is_part: false,
        }
    }
}

/// What an [`Item::Happens`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// A stop, an output, data written to the control.
    Event,
    /// The program's end.
    End,
    /// A spindle starts or stops where the machine has left it in a state that is not known: it may be in that state already.
    Switch,
    /// Words whose effect is not modelled.
    Unmodelled,
}

/// What a program does.
#[derive(Clone, Debug)]
pub enum Item {
    /// A motion.
    Motion(Box<Step>),
    /// Something else.
    Happens {
        /// The block.
        block: BlockId,
        /// What it is.
        sort: Sort,
        /// Its words.
        words: Vec<Argument>,
        /// What is in effect.
        process: Arc<Process>,
        /// The state that something unmodelled may read: before and after its block.
        around: Option<Arc<Around>>,
    },
}

impl Item {
    /// The block of the main program.
    pub fn block(&self) -> BlockId {
        match self {
            Self::Motion(step) => step.motion.block,
            Self::Happens { block, .. } => *block,
        }
    }
}

/// Where and why a run stopped before the end of its program.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// The block.
    pub block: BlockId,
    /// Why.
    pub why: String,
    /// It could go on: a bound of the run was reached, which `why` names.
    pub by_bound: bool,
}

/// The state before and after the block of an effect, for something unmodelled that may read it.
#[derive(Clone, Debug)]
pub struct Around {
    /// Before and after.
    pub(crate) situations: [Situation; 2],
    /// What was set before the block.
    pub(crate) process: Arc<Process>,
}

/// Something pending until the motions before it are known.
pub(crate) struct Waiting {
    /// It comes before motions that were made after this many effects.
    pub(crate) before: u32,
    pub(crate) block: BlockId,
    pub(crate) what: Waits,
    pub(crate) around: Option<Arc<Around>>,
}

/// See [`Waiting`].
pub(crate) enum Waits {
    Effect(Effect, Reach),
    /// A word of a group was programmed after something ran that may have changed everything: see [`Process::note`].
    Restated(Restated, Vec<Argument>),
    /// Such a thing ran.
    Lost,
    /// Data that offsets are read from may have been written: see [`Process::note`].
    Written,
}

impl Waiting {
    /// Whether it may read and change the modal state.
    pub(crate) fn is_own_code(&self) -> bool {
        matches!(self.what, Waits::Effect(_, Reach::Everything))
    }

    /// Whether it is an M code that is not modelled.
    pub(crate) fn is_builder_code(&self) -> bool {
        let names_m = |text: &str| {
            let number = text.strip_prefix('M');
            number.is_some_and(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()))
        };
        // Klartext and OSP give the text of the block
        let is_m = |word: &Argument| match &word.value {
            Value::Text(text) => names_m(&word.name) || text.split_whitespace().any(names_m),
            _ => names_m(&word.name),
        };
        matches!(&self.what, Waits::Effect(Effect::Unmodelled(words), _) if words.iter().any(is_m))
    }
    /// Whether its effect is not modelled.
    pub(crate) fn is_unmodelled(&self) -> bool {
        matches!(self.what, Waits::Effect(Effect::Unmodelled(_), _))
    }
}
