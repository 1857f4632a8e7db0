//! A canned cycle is programmed incorrectly.
//!
//! # Why
//! A cycle without a retract plane, without a depth, or with the retract plane below the bottom of the hole stops
//! the control or drives the tool through the part in rapid. LinuxCNC says `R clearance plane unspecified in
//! cycle`.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 G0 X0. Y0. Z50.
//! N20 G83 X10. Y10. Z-5. R2. F100.
//! ;       ^^^^ canned-cycle: G83 without Q
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 G0 X0. Y0. Z50.
//! N20 G83 X10. Y10. Z-5. R2. Q1. F100.
//! N30 G80
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for the cycles that are modelled; others are reported as not modelled.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::CannedCycle, plain)]);
