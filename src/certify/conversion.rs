//! One program against another in another language, for another machine: motion for motion, pose by pose.
//!
//! Both texts are read from scratch by floors 0 to 3. The converter only says which motions belong together; a wrong hint
//! can make a good conversion be refused, but never proves a bad one.
mod alike;
mod ask;
mod ask_apt;
mod ask_code;
mod ask_iso;
mod ask_klartext;
mod axis;
mod certificate;
mod claim;
mod coolants;
mod effects;
mod fault_words;
mod folded;
mod known;
mod posed;
mod proof;
mod reading;
mod reason;
mod track;
mod words;
mod zero_names;
mod zeros_apart;

pub use crate::curve::{great_circle, joint_bend};
pub use ask::{Ask, Asked, Coolant, Own, Why, asked_in};
pub use certificate::{
    CONVERSION_SCHEMA, Conversion, ConversionCertificate, Meaning, OwnCode, Parts, Side, Told, certify_conversion,
};
pub use claim::{ConversionClaim, ConversionProof, Part};
pub use effects::Terms;
pub use known::Known;
pub use proof::{converted, converted_on};
pub(crate) use reading::is_grave;
pub use reading::{Assume, Posed, Ran, Reading, Run, read};
pub(crate) use reason::turns_spent;
pub use track::{Track, carried, rotary};
pub use words::{moved_axes, same_words};
pub use zero_names::ZeroNames;
pub use zeros_apart::{holds_with_zeros_apart, left_behind};

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_asks;
