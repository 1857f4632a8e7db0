//! Floor 6, below rewrite: the layout of a text and the numbers of its blocks. Motions stay, and that is proved for each text:
//! the words are compared here, and `trunnion_same` runs both texts and compares motions, effects, faults and modal states exactly.
//!
//! It does no I/O. It does not know machines or rules.
mod apt;
mod attempt;
mod blanks;
mod data_entry;
mod iso;
mod named;
mod nesting;
mod proof;
mod references;
mod renumber;
mod same;
mod style;
mod text;
mod words;

pub use attempt::{Layout, Refusal, layout};
pub use nesting::depths;
pub use proof::first_difference;
pub use references::{Call, Obstacle};
pub use renumber::{BlockReference, BlockReferences, Numbers, Renumbered, block_references, renumber};
pub use style::{Case, Spacing, Style, Zeros};
pub use trunnion_same::Difference;
