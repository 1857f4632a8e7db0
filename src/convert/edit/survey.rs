//! A run of the program that is to be edited, block by block, with what is in effect before and after each.
use crate::refuse::Refused;
use std::collections::HashSet;
use trunnion_dialect::Dialect;
use trunnion_interp::{ChainId, Fault, Interpreter, ModalState, Motion, MotionKind, ProgramRun, Setup, Sink};
use trunnion_syntax::{Block, BlockId, Program};

/// A block that ran.
pub(super) struct Here<'a> {
    /// The block.
    pub(super) block: Block<'a>,
    /// Before it.
    pub(super) was: &'a ModalState,
    /// After it.
    pub(super) is: &'a ModalState,
    /// The coordinates are turned, scaled, mirrored or polar, before it or after it.
    pub(super) turned: bool,
}

/// The blocks that ran.
pub(super) struct Ran(Vec<bool>);

impl Ran {
    pub(super) fn has(&self, block: BlockId) -> bool {
        self.0.get(block.0 as usize).copied().unwrap_or(false)
    }
}

/// Calls that have led to motions of the part.
#[derive(Default)]
struct Calls {
    known: HashSet<ChainId>,
    new: Vec<(BlockId, ChainId)>,
}

impl Sink for Calls {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let stands = matches!(motion.kind, MotionKind::Dwell(_)) || motion.start == motion.end;
        let of_part = motion.chain != ChainId::MAIN && !motion.machine_coordinates && !stands;
        if of_part && self.known.insert(motion.chain) {
            self.new.push((motion.block, motion.chain));
        }
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

impl Calls {
    /// An edit changes one file: what another file moves would stay where it is.
    fn stay_in_file(&mut self, program: &Program, run: &Interpreter<'_>) -> Result<(), Refused> {
        for (block, chain) in self.new.drain(..) {
            let frames = ProgramRun::chain(run, chain);
            let Some(place) = frames.last().filter(|frame| frame.is_place && !frame.file.is_empty()) else {
                continue;
            };
            let file = place.file.rsplit(['/', '\\']).next().unwrap_or_default();
            let message = format!(
                "this block calls {file}, which moves the tool (line {}): a called file is not edited with this one; put its blocks into this program first",
                place.line
            );
            return Err(Refused::at(program, block, message));
        }
        Ok(())
    }
}

/// Runs a program and shows each block.
pub(super) fn survey(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    mut visit: impl FnMut(&Here<'_>) -> Result<(), Refused>,
) -> Result<Ran, Refused> {
    let mut setup = setup.clone();
    setup.limits = setup.limits.of_steps();
    let mut interpreter = Interpreter::new(dialect, &setup);
    let mut ran = vec![false; program.block_count()];
    let mut was = interpreter.state().clone();
    let mut turned = !interpreter.turned().is_empty();
    let mut calls = Calls::default();
    while let Some(id) = interpreter.advance(program, &mut calls) {
        calls.stay_in_file(program, &interpreter)?;
        let Some(seen) = ran.get_mut(id.0 as usize) else { break };
        *seen = true;
        let turns = !interpreter.turned().is_empty();
        visit(&Here {
            block: program.block(id),
            was: &was,
            is: interpreter.state(),
            turned: turned || turns,
        })?;
        was.clone_from(interpreter.state());
        turned = turns;
    }
    calls.stay_in_file(program, &interpreter)?;
    Ok(Ran(ran))
}
