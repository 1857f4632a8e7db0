//! Floor 2: the order in which a control runs the blocks of a program: jumps, loops, calls, repeated sections, bounds.
//!
//! It is a library, not a framework. A language reads its statements, decides its conditions and says what a block requests
//! ([`Transfer`]); this floor keeps where the run is ([`Course`]), where jumps may go ([`Index`]), which other files are called
//! ([`Library`]), and proves that a loop never ends. *It knows no words of any language, and no motions.*
mod chains;
mod course;
mod index;
mod library;
mod loops;
mod ran;
mod transfer;

pub use chains::Chains;
pub use course::{BlockBudget, Call, Course, Ends, PendingCall, Place};
pub use index::{Index, Key, Search};
pub use library::{Called, Library};
pub use loops::{Loop, Loops};
pub use ran::Ran;
pub use transfer::Transfer;
pub use trunnion_vocabulary::{ChainId, Frame};
