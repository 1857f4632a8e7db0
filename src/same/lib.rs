//! Floor 5: whether two programs do the same, motion for motion.
//!
//! [`Steps`] runs a program and yields what it does, in order: motions with everything that is in effect, and all other events.
//! [`compare`] compares two such streams and names the first difference. It is the one place that decides what "the same"
//! means; whoever compares programs (proofs, `diff`, layout) asks it.
//!
//! It does not know rules, rewrites or text for people beyond the one sentence of a [`Difference`].
mod across;
mod actions;
mod begin;
mod change;
mod changed;
mod claim;
mod compare;
mod counted;
mod curve;
mod cut;
mod elsewhere;
mod ending;
mod exact;
mod happens;
mod in_effect;
mod initial;
mod input;
mod item;
mod judge;
mod klartext;
mod motions;
mod near;
mod notes;
mod numbers;
mod process;
mod rapids;
mod refit;
mod retracts;
mod said;
mod sentences;
mod since;
mod steps;
mod twins;
mod undeclared;
mod unit;
mod verdict;

pub use across::are_two_controls;
pub use change::{Change, Part};
pub use changed::{Apart, compare_changed};
pub use claim::Claim;
pub use compare::compare;
pub use cut::{COUPLING_KEYS, couples_feed};
pub use exact::Exact;
pub use input::Input;
pub use item::{Item, Sort, Step, Stop};
pub use judge::Judge;
pub use near::{Near, arcs_apart};
pub use process::{Held, Process, offset_name, shown};
pub use refit::{Refit, Refitted};
pub use said::variables_differ;
pub use steps::Steps;
pub use twins::run_alike;
pub use undeclared::{assumed, only_by_chance, undeclared, unrelated, with_stand_ins, with_zeros};
pub use verdict::{Difference, Verdict};
