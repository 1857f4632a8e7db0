//! What a rule file imports.
pub(crate) use crate::Severity::{Error, Info, Warning};
pub(crate) use crate::facts;
pub(crate) use crate::finding::Draft;
pub(crate) use crate::rule::Body;
pub(crate) use crate::runs::Merge;
pub(crate) use crate::sink::Reporter;
pub(crate) use crate::view::{LegView, Overview};
pub(crate) use crate::wake::{Ending, Wake};
pub(crate) use crate::words::{
    bound_degrees, bound_mm, degrees, hash, highest_rate, joint, letter, mm, number, past_pole, speed,
};
pub(crate) use trunnion_geometry::deg;
pub(crate) use trunnion_interp::{Fault, FaultKind, Refusal};
pub(crate) use trunnion_syntax::{SyntaxError, SyntaxErrorKind, TextRange};

/// Adds nothing to the control's message about a block that it refuses.
pub(crate) fn plain(_: &mut Draft<'_>) {}
