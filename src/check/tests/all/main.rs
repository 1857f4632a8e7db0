//! Whole programs through a check.
mod any_input;
mod loops;
mod no_silence;
mod planted_own;
