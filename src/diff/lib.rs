//! Floor 7: where two programs do something different, motion for motion, for people and for tools.
//!
//! [`trunnion_same`] decides whether they are the same; this floor lists what is not. It does not know terminals, JSON or files.
mod align;
mod changes;
mod event;
mod keys;
mod match_up;
mod point;
mod run;

pub use changes::{Change, Found, Pair, TechChange, compare, list};
pub use event::{Body, Tech};
pub use point::{PathKind, Point, Tolerance};
