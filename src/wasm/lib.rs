//! Floor 8: `check` for browsers and Node, without a disk. A request and the bytes of a program go in, the document of
//! `trunnion check --format json` comes out. The same code finds the dialect, reads settings and machines, runs the rules and writes the document as
//! on the command line, so the verdicts are the same.
mod check;
#[cfg(target_family = "wasm")]
mod exports;
mod lists;
mod request;

pub use check::{check, refused};
pub use lists::lists;
pub use request::Request;
