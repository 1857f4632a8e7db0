//! The machine file: read, checked, written out in words; the machines that are built in.
pub(crate) mod absent;
pub(crate) mod builtin;
pub(crate) mod check_rows;
pub(crate) mod control;
pub(crate) mod describe;
pub(crate) mod formula;
pub(crate) mod gantry;
pub(crate) mod obstacle;
pub(crate) mod places;
pub(crate) mod planning;
mod power_on;
pub(crate) mod raw;
pub(crate) mod spec;
pub(crate) mod text;
pub(crate) mod unused_keys;
pub(crate) mod validate;

#[cfg(test)]
mod fault_tests;
#[cfg(test)]
mod mutant_tests;
#[cfg(test)]
mod spec_tests;
