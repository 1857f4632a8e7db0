//! A code is in a block without a word that it needs.
//!
//! # Why
//! The control stops, or takes a value from an earlier block. LinuxCNC says for example `Dwell time missing with
//! g4`.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 G0 X10.
//! N20 M98 L3
//! ;   ^^^ missing-word:
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 G0 X10.
//! N20 M98 P1000 L3
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound for the codes whose words are modelled. Feed, arc centres and cycles have their own rules.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::MissingWord, plain)]);
