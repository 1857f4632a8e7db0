//! A program as a stream of what it does: only the steps of the current block are kept.
use crate::actions::Actions;
use crate::counted::Counted;
use crate::elsewhere::Elsewhere;
use crate::ending::ends;
use crate::input::Input;
use crate::item::{Item, Sort, Step, Stop, Waiting, Waits};
use crate::notes::{arguments_in_order, with_values};
use crate::process::{Held, Process};
use crate::since::Since;
use crate::undeclared::Zeros;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use trunnion_interp::{Argument, Effect, Fault, FaultKind, Frame, Interpreter, ModalState, Motion, is_left};
use trunnion_interp::{Placed, ProgramRun as _, Reach, Sink, Value};
use trunnion_machine::Follower;
use trunnion_syntax::BlockId;

/// Runs a program and yields what it does.
pub struct Steps<'a> {
    pub(crate) input: Input<'a>,
    pub(crate) interpreter: Interpreter<'a>,
    pub(crate) run: Run<'a>,
    ready: VecDeque<Item>,
    pub(crate) since: Since,
    ran: Vec<u64>,
    /// Whether a block may move the coordinates or the machine, once it was read.
    pub(crate) disturbs: Vec<Option<bool>>,
    over: bool,
    pub(crate) counted: Option<Counted>,
    /// The program that is missing and may return to a block number.
    pub(crate) returning: Option<String>,
}

pub(crate) struct Run<'a> {
    follower: Option<Follower<'a>>,
    /// Motions of the block: what depends on those before them is filled in when it has run.
    motions: VecDeque<Box<Step>>,
    pub(crate) waiting: VecDeque<Waiting>,
    /// Effects so far.
    pub(crate) count: u32,
    /// What was done so far apart from motions, and how much of that is followed.
    pub(crate) actions: Actions,
    pub(crate) process: Arc<Process>,
    stores: BTreeMap<String, Value>,
    stop: Option<Stop>,
    /// So many motions of one block (a pecking cycle with a tiny Q), and things between them, are kept, with all in effect.
    most_in_block: usize,
    /// A block does more than is kept: the run ends with it.
    pub(crate) given_up: bool,
    /// Blocks of the main program whose called program is missing.
    pub(crate) missing: Vec<BlockId>,
    /// Faults, if they are requested.
    faults: Option<Vec<Fault>>,
    pub(crate) zeros: Zeros,
    /// The first thing that is not modelled and may run other lines.
    pub(crate) elsewhere: Elsewhere,
    /// Effects with their numbers in the run, if they are requested.
    log: Option<Vec<(u32, Placed)>>,
}

impl Sink for Run<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        if self.motions.len() >= self.most_in_block {
            self.give_up(motion.block);
            return;
        }
        self.zeros.note(motion, state);
        let leg = self.follower.as_mut().map(|follower| follower.follow(motion));
        let step = Step::new(motion, leg, Held::new(state), &self.process);
        self.motions.push_back(Box::new(step));
    }
    fn fault(&mut self, fault: Fault) {
        if matches!(fault.kind, FaultKind::MissingSubprogram { .. }) {
            // what it would do is in its name and arguments
            self.missing.push(fault.block);
        }
        if let Some(why) = ends(&fault.kind) {
            self.stop.get_or_insert(Stop {
                block: fault.block,
                why,
                by_bound: matches!(fault.kind, FaultKind::EndlessLoop { proved: false, .. }),
            });
        }
        if let Some(faults) = &mut self.faults {
            faults.push(fault);
        }
    }
    fn effect(&mut self, effect: Placed) {
        if let Some(log) = &mut self.log {
            log.push((self.count, effect.clone()));
        }
        self.count += 1;
        let Placed { block, effect, reach } = effect;
        if matches!(effect, Effect::Unmodelled(_)) || reach == Reach::Everything {
            self.actions.add(Actions::OPEN);
        }
        if let Effect::Unmodelled(words) = &effect {
            self.elsewhere.note(block, words);
        }
        self.wait(self.count, block, Waits::Effect(effect, reach));
    }
}

impl Run<'_> {
    /// Keeps something until the motions before it are known; `before`: how many effects come before the motions that follow it.
    pub(crate) fn wait(&mut self, before: u32, block: BlockId, what: Waits) {
        let at = self.waiting.partition_point(|other| other.before <= before);
        let around = None;
        self.waiting.insert(
            at,
            Waiting {
                before,
                block,
                what,
                around,
            },
        );
    }
    /// The block makes more motions than are kept: the run ends with it, and a fault is reported.
    #[cold]
    fn give_up(&mut self, block: BlockId) {
        if !std::mem::replace(&mut self.given_up, true) {
            let (most, by_bound) = (self.most_in_block, true);
            let why = format!("one block makes more than {most} motions: raise `held` of [limits] in trunnion.toml");
            let fault = Fault {
                block,
                range: trunnion_syntax::TextRange::default(),
                kind: FaultKind::NotDecided { what: why.clone() },
                place: None,
            };
            self.faults.iter_mut().for_each(|faults| faults.push(fault.clone()));
            self.stop.get_or_insert(Stop { block, why, by_bound });
        }
    }
}

impl<'a> Steps<'a> {
    /// At the program's start.
    pub fn new(input: Input<'a>) -> Self {
        let mut setup = input.setup.clone();
        setup.limits = setup.limits.of_steps();
        let mut interpreter = Interpreter::new(input.dialect, &setup);
        interpreter.watch_effects();
        Self {
            returning: crate::numbers::watch(&input, &mut interpreter),
            input,
            interpreter,
            run: Run {
                follower: input.machine.map(Follower::new),
                motions: VecDeque::new(),
                waiting: VecDeque::new(),
                count: 0,
                actions: Actions::new(input.program.block_count(), setup.limits.steps),
                process: Arc::new(Process::at_start(input.dialect)),
                stores: BTreeMap::new(),
                stop: None,
                // two programs are compared, and a step holds twice what a motion does
                most_in_block: (setup.limits.held / 4).max(1) as usize,
                given_up: false,
                missing: Vec::new(),
                faults: None,
                zeros: Zeros::default(),
                elsewhere: Elsewhere::default(),
                log: None,
            },
            ready: VecDeque::new(),
            since: Since::default(),
            ran: vec![0; input.program.block_count().div_ceil(64)],
            disturbs: vec![None; input.program.block_count()],
            over: false,
            counted: None,
        }
    }

    /// With what it was made.
    pub fn input(&self) -> &Input<'a> {
        &self.input
    }

    /// Whether a block of the program ran.
    pub fn has_run(&self, block: BlockId) -> bool {
        let word = self.ran.get(block.0 as usize / 64);
        word.is_some_and(|word| word >> (block.0 % 64) & 1 == 1)
    }

    /// Where and why the run stopped before the end of its program; called when there are no more items.
    pub fn stop(&self) -> Option<&Stop> {
        self.run.stop.as_ref()
    }

    /// Whether there are no more items.
    pub fn is_over(&self) -> bool {
        self.over && self.ready.is_empty()
    }

    /// Whether tool centre point control is on now.
    pub(crate) fn leads_tip(&self) -> bool {
        self.state().tool_axis.tcp()
    }

    /// What the modal state holds now.
    pub(crate) fn held(&self) -> Held {
        Held::new(self.state())
    }

    /// What is in effect now.
    pub fn process(&self) -> &Arc<Process> {
        &self.run.process
    }

    /// Variables that keep their values after the program ends, as far as these are known; called when there are no more items.
    pub fn stored(&self) -> BTreeMap<String, Value> {
        let mut stores = self.run.stores.clone();
        let kept = self.interpreter.outliving().into_iter();
        stores.extend(kept.map(|(name, value)| (name, Value::Number(value))));
        let texts = self.interpreter.outliving_texts().into_iter();
        stores.extend(texts.map(|(name, text)| (name, Value::Text(text.into()))));
        stores
    }

    /// Keeps effects for [`Steps::take_effects`].
    pub fn watch_effects(&mut self) {
        self.run.log = Some(Vec::new());
    }

    /// The effects of the blocks that have run since the last call, as the interpreter reported them, each with its number in the run.
    /// [`Motion::effects`] says how many of them come before a motion.
    pub fn take_effects(&mut self) -> Vec<(u32, Placed)> {
        self.run.log.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// The modal state now.
    pub fn state(&self) -> &ModalState {
        self.interpreter.state()
    }

    /// Whether motions are held back until a later one is known.
    pub fn motions_wait(&self) -> bool {
        self.interpreter.motions_wait()
    }

    /// The calls that led to a motion, outermost first.
    pub fn calls_of(&self, motion: &Motion) -> Vec<Frame> {
        self.interpreter.chain(motion.chain)
    }

    /// Keeps faults for [`Steps::take_faults`].
    pub fn watch_faults(&mut self) {
        self.run.faults = Some(Vec::new());
    }

    /// What was found wrong since the last call.
    pub fn take_faults(&mut self) -> Vec<Fault> {
        self.run.faults.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// What the program did in the blocks that have run.
    pub fn take_ready(&mut self) -> VecDeque<Item> {
        std::mem::take(&mut self.ready)
    }

    /// Runs the next block; `None` at the end.
    pub fn advance(&mut self) -> Option<BlockId> {
        if self.over {
            return None;
        }
        let most = self.run.most_in_block;
        let held = (self.ready.len() > most).then(|| {
            format!("it does more than {most} actions without a motion: raise `held` of [limits] in trunnion.toml")
        });
        if let Some(why) = held.or_else(|| self.run.actions.exceeded()) {
            let block = self.ready.back().map_or(BlockId(0), Item::block);
            let by_bound = true;
            self.run.stop.get_or_insert(Stop { block, why, by_bound });
            self.over = true;
            return None;
        }
        let before = self.interpreter.situation();
        let (losses, effects) = (self.interpreter.losses(), self.run.count);
        let settings = Arc::clone(&self.run.process);
        let block = self.interpreter.advance(self.input.program, &mut self.run);
        self.over = block.is_none() || self.run.given_up;
        if let Some(block) = block
            && let Some(word) = self.ran.get_mut(block.0 as usize / 64)
        {
            *word |= 1 << (block.0 % 64);
            (self.run.elsewhere).note_passed(&self.interpreter, &self.input.program.block(block));
        }
        let (mut missing, mut own_locals) = (false, false);
        for block in std::mem::take(&mut self.run.missing) {
            self.run.actions.add(Actions::MISSING);
            let text = self.input.program.text(self.input.program.block(block).range());
            let text = if self.input.dialect.quirks.declares_names() {
                // what is between parentheses are arguments
                self.interpreter
                    .resolved_text(text.split(';').next().unwrap_or_default())
            } else {
                let text = trunnion_interp::canonical_text(&text);
                let text = self.interpreter.resolved_text(&text);
                let macro_call = self.input.dialect.quirks.macro_b() && text.contains("G65");
                own_locals |= macro_call;
                if macro_call {
                    arguments_in_order(&with_values(&text, &self.interpreter.known_variables()))
                } else {
                    text
                }
            };
            let effect = Effect::Unmodelled(vec![Argument::text("", &text)]);
            // after the motion of its block
            self.run
                .wait(self.run.count + 1, block, Waits::Effect(effect, Reach::Place));
            missing = true;
        }
        let lost = missing || self.interpreter.losses() != losses;
        self.note_situation((before, settings), effects, lost, own_locals);
        if let Some(block) = block {
            self.note_block(block, effects, lost);
        }
        while let Some(mut step) = self.run.motions.pop_front() {
            self.effects_before(step.motion.effects);
            step.starts_anew = self.since.starts_anew(&step.motion);
            step.may_repeat = self.since.motion(&step.motion, &step.held);
            self.say(&mut step);
            self.run.elsewhere.note_said(&step);
            if !Arc::ptr_eq(&step.process, &self.run.process) {
                step.process = Arc::clone(&self.run.process);
            }
            self.ready.push_back(Item::Motion(step));
        }
        if self.over || !self.interpreter.motions_wait() {
            self.effects_before(u32::MAX);
        }
        block
    }

    /// Applies what comes before a motion that was made after so many effects.
    fn effects_before(&mut self, count: u32) {
        let run = &mut self.run;
        while let Some(next) = run.waiting.pop_front_if(|next| next.before <= count) {
            let Waiting {
                block, what, around, ..
            } = next;
            let (effect, reach) = match what {
                Waits::Effect(effect, reach) => (effect, reach),
                Waits::Restated(..) | Waits::Lost | Waits::Written => {
                    Process::note(&mut run.process, what);
                    continue;
                }
            };
            self.since.disturbed |= reach != Reach::Itself;
            // a setting that stays as it is, such as the feed that a block repeats, is none
            let stays = matches!(&effect, Effect::Set { key, to } if run.process.get(key) == to);
            run.actions.add(u64::from(!stays));
            let (sort, words) = match effect {
                Effect::Set { key, to } => {
                    // a spindle that starts, stops or reverses does so at once, whether or not a motion follows
                    let happens = key.starts_with("spindle") && !key.ends_with("words") && !is_left(&to);
                    let left = is_left(run.process.get(&key));
                    if !Process::set(&mut run.process, key, &to) || !happens {
                        continue;
                    }
                    (if left { Sort::Switch } else { Sort::Event }, to)
                }
                Effect::Store(argument) => {
                    run.stores.insert(argument.name.into_owned(), argument.value);
                    continue;
                }
                Effect::Event(words) if self.since.is_set_plainly(&words) => continue,
                // where it differs, the programs may still do the same
                Effect::Event(words) if crate::since::sets_from_here(&words) => (Sort::Unmodelled, words),
                Effect::Event(words) => (Sort::Event, words),
                Effect::End(words) => (Sort::End, words),
                Effect::Unmodelled(words) => (Sort::Unmodelled, words),
            };
            self.ready.push_back(Item::Happens {
                block,
                sort,
                words,
                process: Arc::clone(&run.process),
                around,
            });
        }
    }
}

impl Iterator for Steps<'_> {
    type Item = Item;

    fn next(&mut self) -> Option<Item> {
        while self.ready.is_empty() && !self.over {
            self.advance();
        }
        let item = self.ready.pop_front()?;
        self.counted
            .iter_mut()
            .for_each(|counted| counted.take(&item, &self.input));
        Some(item)
    }
}
