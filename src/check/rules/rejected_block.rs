//! The control refuses the block.
//!
//! # Why
//! The program stops there. Where the control's own message is known, the note quotes it.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 G10 L2 P9 X0.
//! ;   ^^^ rejected-block:
//! N20 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 G10 L2 P1 X0.
//! N20 M30
//! ```
//!
//! # Guarantee
//! Sound for what is modelled. Other rules report the refusals they are named after (feed, arcs, expressions,
//! labels).
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::Other, plain)]);
