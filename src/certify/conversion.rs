//! One program against another in another language, for another machine: motion for motion, pose by pose.
//!
//! Both texts are read from scratch by floors 0 to 3. Who converted them only says which motions belong together; a wrong
//! hint can refuse a good conversion and never prove a bad one.
mod claim;
mod proof;
mod reading;
mod track;

pub use crate::curve::{great_circle, joint_bend};
pub use claim::{ConversionClaim, ConversionProof, Part};
pub use proof::converted;
pub use reading::{Assume, Posed, Ran, Reading, Run, read};
pub use track::{Track, carried, rotary};

#[cfg(test)]
mod tests;
