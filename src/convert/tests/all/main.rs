//! Conversions: to each control and back, between machines, refusals, properties.
#![allow(clippy::print_stdout, reason = "a skipped test says so")]
mod approach;
mod clamps;
mod code;
mod edits;
mod edits_called;
mod edits_part;
mod edits_proof;
mod guide_vane;
mod holes;
mod kept;
mod klartext;
mod machines;
mod okuma;
mod places;
mod proof;
mod real;
mod refused;
mod round;
mod same_control;
mod shifts;
mod support;
mod unsafe_gaps;
mod zeros;
