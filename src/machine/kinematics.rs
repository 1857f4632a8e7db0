//! Joints to poses and back: the chain of axes, forward and inverse kinematics, and what follows from them at one pose.
pub(crate) mod chain;
pub(crate) mod constants;
pub(crate) mod forward;
pub(crate) mod held_axes;
pub(crate) mod inverse;
pub(crate) mod pole;
pub(crate) mod reach;
pub(crate) mod selftest;
pub(crate) mod uncertainty;
pub(crate) mod windings;

#[cfg(test)]
mod chain_tests;
#[cfg(test)]
mod oracle_tests;
#[cfg(test)]
mod pose_tests;
