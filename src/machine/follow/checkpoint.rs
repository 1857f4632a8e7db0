//! What a follower remembers, without its machine: an owned check-point.
use crate::follow::state::State;
use crate::{Follower, Machine};

/// What a [`Follower`] remembers between two motions.
#[derive(Clone, Debug)]
pub struct Memory {
    state: State,
}

impl<'m> Follower<'m> {
    /// A check-point to continue from with [`Follower::resume`].
    pub fn memory(&self) -> Memory {
        Memory { state: self.state }
    }

    /// Continues from a check-point made on the same machine.
    pub fn resume(machine: &'m Machine, memory: &Memory) -> Self {
        Self::at(machine, &memory.state)
    }
}
