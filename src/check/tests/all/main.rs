//! Whole programs through a check.
mod any_input;
mod known_positions;
mod loops;
mod no_silence;
mod planted_own;
mod tool_change;
