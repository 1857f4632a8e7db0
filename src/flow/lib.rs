//! Floor 2: the order in which a control runs the blocks of a program: jumps, loops, calls, repeated sections, bounds.
//!
//! It is a library, not a framework. A language reads its statements, decides its conditions and says what a block asks for
//! ([`Transfer`]); this floor keeps where the run is ([`Course`]), where jumps may lead ([`Index`]), which other files are called
//! ([`Library`]), and proves that a loop never ends. *It does not know a word of any language, nor what a motion is.*
mod chains;
mod course;
mod index;
mod library;
mod loops;
mod ran;
mod transfer;

pub use chains::Chains;
pub use course::{Call, Course, Ends, Fuel, Going, Place};
pub use index::{Index, Key, Search};
pub use library::{Called, Library};
pub use loops::{Loop, Loops};
pub use ran::Ran;
pub use transfer::Transfer;
pub use trunnion_vocabulary::{ChainId, Frame};
