//! A run of the program that is to be edited, block by block, with what is in effect before and after each.
use crate::refuse::Refused;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, Setup, Sink};
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

struct Deaf;

impl Sink for Deaf {
    fn motion(&mut self, _: &Motion, _: &ModalState) {}
    fn fault(&mut self, _: Fault) {}
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
    while let Some(id) = interpreter.advance(program, &mut Deaf) {
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
    Ok(Ran(ran))
}
