//! What a rule file imports.
pub(crate) use crate::Severity;
pub(crate) use crate::needs::Needs;
pub(crate) use crate::place::{axis_word, code_range, once_at, orientation_range};
pub(crate) use crate::refusal::refused;
pub(crate) use crate::rule::{Body, Guarantee, Level};
pub(crate) use crate::sink::Reporter;
pub(crate) use crate::view::{LegView, Overview};
pub(crate) use crate::words::{
    bound_degrees, bound_mm, degrees, hash, highest_rate, joint, letter, mm, number, past_pole, speed,
};
pub(crate) use trunnion_geometry::deg;
pub(crate) use trunnion_interp::{Fault, FaultKind, Refusal};
pub(crate) use trunnion_syntax::{SyntaxError, SyntaxErrorKind, TextRange};
