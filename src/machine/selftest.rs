//! Forward after inverse is the identity: proved on random poses, with the residual.
use crate::Machine;

/// What a self-test found.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfTest {
    /// Poses tried.
    pub poses: usize,
    /// Worst tip residual, mm.
    pub worst_tip_mm: f64,
    /// Worst tool axis residual, rad.
    pub worst_axis: f64,
    /// Poses whose true posture was not among the answers.
    pub posture_missing: usize,
}

/// Tries `poses` random poses (deterministic for a `seed`).
pub fn self_test(machine: &Machine, poses: usize, seed: u64) -> SelfTest {
    let _ = (machine, poses, seed);
    todo!()
}
