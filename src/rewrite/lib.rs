//! Floor 7: proposes. A rewrite reads an analysed program and proposes edits with a claim; `certify` decides.
//!
//! It does no I/O and never vouches for itself.
mod attempt;
mod beside;
mod chain_words;
mod circle;
mod cubic;
mod divide;
mod edited;
mod excursion;
#[cfg(test)]
mod feed_tests;
mod fewest;
mod gains;
mod known;
mod lanes;
mod line_points;
mod named_blocks;
mod no_worse;
mod pieces;
mod pitch;
mod polyline;
mod posed_words;
mod propose;
mod rapid_rounding;
mod rapid_route;
mod rapid_runs;
#[cfg(test)]
mod rapid_tests;
mod reposition;
mod rewrites;
mod shortest_path;
mod slots;
mod smooth;
mod spline;
mod spline_words;
mod style;
mod survey;
mod taut_string;
mod unwrap;
mod whole_circle;
mod whole_feed;

pub use attempt::{Attempt, Judged, Proved, State, attempt, attempt_at};
pub use gains::{Gain, Gains, gains};
pub use known::Known;
pub use propose::{Change, Options, Place, ProgrammedPoint, Proposal, Proposed, Refusal, Rewrite};
pub use rewrites::{rewrite, rewrites};
