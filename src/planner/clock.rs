//! The time of a whole program: legs, what it says about corners, tool changes and M codes, in the order in which they run.
use crate::{PathControl, Planner, Timed};
use trunnion_dialect::Dialect;
use trunnion_interp::{Argument, Effect, Fault, Interpreter, ModalState, Motion, Placed, Setup, Sink, Value};
use trunnion_machine::{Follower, Leg, Machine};
use trunnion_syntax::{BlockId, Program};

/// What a clock tells, in the order of the run.
pub trait Listener {
    /// A leg, before its time is known. Its number is that of [`Timed::motion`].
    fn leg(&mut self, leg: &Leg, state: &ModalState, motion: u32);
    /// The time of a leg, or of a wait (a tool change, an M code: [`Timed::motion`] is then the number of the leg after it and `wait` is set).
    fn timed(&mut self, timed: &Timed, wait: bool);
    /// A fault of the run.
    fn fault(&mut self, fault: Fault) {
        let _ = fault;
    }
    /// Whether faults are read; see [`Sink::reads_faults`].
    fn reads_faults(&self) -> bool {
        true
    }
}

/// Runs a program on a machine and tells the time of each motion. The effects of the program are watched: path control, tool changes, M codes.
/// The axes stand where a tool change of the machine leaves them.
pub fn time(program: &Program, dialect: &Dialect, setup: &Setup, machine: &Machine, listener: &mut impl Listener) {
    let mut setup = setup.clone();
    setup.control.tool_change = machine.control.tool_change;
    let mut interpreter = Interpreter::new(dialect, &setup);
    interpreter.watch_effects();
    let mut clock = Clock {
        follower: Follower::new(machine),
        planner: Planner::new(machine, dialect.advice.rotary_feed),
        modes: Modes::new(dialect),
        tool: vec![Argument::code("T")],
        motions: 0,
        listener,
    };
    while let Some(block) = interpreter.advance(program, &mut clock) {
        clock.block_done(block, &interpreter);
    }
    let Clock {
        mut planner,
        modes,
        listener,
        ..
    } = clock;
    planner.end(modes.last());
    planner.finish(&mut |timed| listener.timed(&timed, false));
}

struct Clock<'m, 'l, L> {
    follower: Follower<'m>,
    planner: Planner<'m>,
    modes: Modes,
    /// The tool in use, as its effect says it.
    tool: Vec<Argument>,
    motions: u32,
    listener: &'l mut L,
}

impl<L: Listener> Sink for Clock<'_, '_, L> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        self.listener.leg(&leg, state, self.motions);
        self.motions += 1;
        let control = self.modes.advance();
        let listener = &mut *self.listener;
        self.planner
            .leg(&leg, control, &mut |timed| listener.timed(&timed, false));
    }
    fn fault(&mut self, fault: Fault) {
        self.listener.fault(fault);
    }
    fn reads_faults(&self) -> bool {
        self.listener.reads_faults()
    }
    fn effect(&mut self, placed: Placed) {
        if let Effect::Set { key, to } = &placed.effect
            && key == "tool in use"
            && *to != self.tool
        {
            self.tool.clone_from(to);
            let change = self.follower.machine().control.planning.tool_change_time;
            self.wait(placed.block, change.unwrap_or(0.0));
        }
        if let Some(seconds) = self.modes.take(&placed.effect, self.follower.machine()) {
            self.wait(placed.block, seconds);
        }
    }
}

impl<L: Listener> Clock<'_, '_, L> {
    /// The machine stops, and stands still for so many seconds.
    fn wait(&mut self, block: BlockId, seconds: f64) {
        // what comes out first belongs to motions before
        self.planner.end(self.modes.last());
        let listener = &mut *self.listener;
        self.planner.finish(&mut |timed| listener.timed(&timed, false));
        if seconds > 0.0 {
            self.planner
                .wait(block, Some(seconds), &mut |timed| listener.timed(&timed, true));
        }
    }
}

/// What the program says about corners, and the times of its M codes: a reader of its effects.
pub struct Modes {
    linuxcnc: bool,
    now: PathControl,
    /// That of the motion before.
    before: PathControl,
    /// An exact stop at the end of one block (G9).
    once: bool,
    /// The spindle's setting, and which coolants are on: mist and flood.
    spindle: Vec<Argument>,
    coolants: [bool; 2],
}

impl Modes {
    /// Before the first block.
    pub fn new(dialect: &Dialect) -> Self {
        Self {
            linuxcnc: dialect.quirks.rs274(),
            now: PathControl::ByMachine,
            before: PathControl::ByMachine,
            once: false,
            spindle: vec![Argument::code("M5")],
            coolants: [false; 2],
        }
    }

    /// The mode at the end of the last motion.
    pub fn last(&self) -> PathControl {
        self.before
    }

    /// The mode at the corner between the last motion and the next one: that of the last one.
    pub fn advance(&mut self) -> PathControl {
        let now = if core::mem::take(&mut self.once) {
            PathControl::ExactStop
        } else {
            self.now
        };
        core::mem::replace(&mut self.before, now)
    }

    /// Reads an effect; the time of its M codes, s. `Some(0.0)`: a stop of the program (M0), for a time that the operator decides.
    pub fn take(&mut self, effect: &Effect, machine: &Machine) -> Option<f64> {
        let arguments = match effect {
            Effect::Set { key, to } => {
                match &**key {
                    "path-control" => self.now = self.mode(to),
                    "mist coolant" | "flood coolant" => return self.coolant(key == "flood coolant", to, machine),
                    // a code that changes nothing takes no time
                    "spindle" if *to == self.spindle => return None,
                    "spindle" => self.spindle.clone_from(to),
                    _ => {}
                }
                to
            }
            Effect::Event(arguments) | Effect::Unmodelled(arguments) | Effect::End(arguments) => arguments,
            Effect::Store(_) => return None,
        };
        let mut seconds = None;
        for argument in arguments {
            let code = argument.to_string();
            if code == "G9" || code == "G09" {
                self.once = true;
            }
            let number = code.strip_prefix('M').and_then(|number| number.parse::<u16>().ok());
            if matches!(number, Some(0 | 60)) {
                seconds.get_or_insert(0.0);
            }
            if let Some(time) = number.and_then(|number| time_of(machine, number)) {
                seconds = Some(seconds.unwrap_or(0.0) + time);
            }
        }
        seconds
    }

    /// The time of M7, M8 or M9 where it changes a coolant, s.
    fn coolant(&mut self, flood: bool, to: &[Argument], machine: &Machine) -> Option<f64> {
        let on = !to.is_empty();
        if core::mem::replace(&mut self.coolants[usize::from(flood)], on) == on {
            return None;
        }
        match (on, flood) {
            (true, false) => time_of(machine, 7),
            (true, true) => time_of(machine, 8),
            // once, when the last one ends
            (false, _) if self.coolants == [false; 2] => time_of(machine, 9),
            (false, _) => None,
        }
    }

    fn mode(&self, to: &[Argument]) -> PathControl {
        let code = to.first().map(ToString::to_string).unwrap_or_default();
        match (code.as_str(), self.linuxcnc) {
            ("G61", true) => PathControl::ExactPath,
            ("G61.1", true) | ("G60" | "G61", false) => PathControl::ExactStop,
            ("G64", true) => PathControl::Blend(to.iter().find(|word| word.name == "P").and_then(
                |word| match word.value {
                    Value::Number(tolerance) if tolerance > 0.0 => Some(tolerance),
                    _ => None,
                },
            )),
            _ => PathControl::ByMachine,
        }
    }
}

/// The time that the machine file gives an M code, s.
fn time_of(machine: &Machine, number: u16) -> Option<f64> {
    let times = &machine.control.planning.m_times;
    times.iter().find(|(code, _)| *code == number).map(|(_, time)| *time)
}
