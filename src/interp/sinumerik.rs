//! The flow of Sinumerik programs: IF, CASE, jumps, loops, repeated sections, subprograms.
//!
//! Sources: Sinumerik 840D sl / ONE Programming Manual (12/2019): jumps 3.1.5, repetition of sections 3.1.6, control structures 3.1.7,
//! subprograms 3.2.2 and 3.2.3; "check structures are found by a search for their keywords while the program runs". What is not documented
//! there (a jump into a loop, out of a repeated section, which of two labels REPEAT takes) is not decided here.
mod call;
mod course;
mod curve;
mod feed_group;
mod frame_value;
mod groups;
mod high_speed;
mod index;
mod names;
mod one_block;
mod path;
mod pole;
mod polynomial;
mod program_call;
mod saved;
mod spline;
mod statement;
mod system_values;
mod text;
mod words;

pub(crate) use crate::frames::FrameValue;
pub(crate) use call::{Level, With, declare_parameters, too_deep};
pub(crate) use feed_group::FeedGroup;
pub(crate) use groups::Groups;
pub(crate) use index::index;
pub(crate) use names::{files, without_ending};
pub(crate) use one_block::one_block;
pub(crate) use path::{Contour, PathWords};
pub(crate) use polynomial::PolynomialWords;
pub(crate) use spline::{Spline, SplineEnds, SplineWords, Splines};
pub(crate) use text::Text;

use crate::flow::Index;
use crate::{FaultKind, Refusal};

/// The fact that a label is missing; with the alarm of a Sinumerik.
pub(crate) fn no_label(message: String, alarm: bool) -> FaultKind {
    FaultKind::Rejected {
        refusal: Refusal::Label,
        message,
        alarm: alarm.then(|| "14080".to_owned()),
    }
}

/// Why the outcome of a jump is unknown: it goes into a structure from outside, or out of a section that is repeated.
pub(crate) fn wrong_target(index: &Index, repeated: Option<(u32, u32)>, (from, to): (u32, u32)) -> Option<FaultKind> {
    let enters = index.loops.entered(from, to, |_| true).is_some();
    let leaves = repeated.is_some_and(|(first, last)| !(first..=last).contains(&to));
    let what = match (enters, leaves) {
        (true, _) => "a jump into a loop or branch from outside, which is not documented",
        (_, true) => "a jump out of a section that REPEAT repeats, which is not documented",
        _ => return None,
    };
    Some(FaultKind::NotDecided { what: what.to_owned() })
}
